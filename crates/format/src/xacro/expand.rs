//! Elements to plain elements.

use super::element::{Attribute, Element, Node};
use super::files::File;
use super::leftover;
use super::output::Expanded;
use super::scope::{Entry, Table};
use super::text::Text;
use super::value::Value;
use super::{Outcome, Place, Run, Sort, Told, Trouble, arguments, map};
use crate::ReadOptions;
use crate::WarningKind;
use crate::error::FormatError;
use crate::words::{did_you_mean, quoted};
use std::path::Path;
use std::rc::Rc;

/// What is known where an element stands: macros, and properties and parameters.
#[derive(Clone)]
pub(super) struct Names {
    pub(super) macros: Rc<Table>,
    pub(super) symbols: Rc<Table>,
}

/// What an element is being made of.
#[derive(Default)]
pub(super) struct Making {
    pub(super) nodes: Vec<Node>,
    /// Attributes of the element that the nodes stand in: `<xacro:attribute>` adds to them.
    attributes: Vec<Attribute>,
    /// Where the nodes come to stand.
    pub(super) level: Level,
}

/// What elements stand in, macros and conditions aside.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Level {
    Robot,
    Link,
    #[default]
    Other,
}

impl Level {
    /// What stands inside an element here.
    fn inside(self, element: &Element) -> Self {
        match self {
            Self::Robot if &*element.name == "link" => Self::Link,
            Self::Robot => Self::Other,
            inner => inner,
        }
    }
}

impl Making {
    /// A place for nodes that may come to stand where the others do.
    pub(super) fn inside(other: &Making) -> Self {
        Self {
            level: other.level,
            ..Self::default()
        }
    }
}

/// Elements of a robot, which are never meant as calls of a macro.
const OF_ROBOT: [&str; 11] = [
    "link",
    "joint",
    "loop",
    "coupling",
    "gazebo",
    "transmission",
    "material",
    "sensor",
    "ground",
    "ros2_control",
    "plugin",
];

impl<'o> Run<'o> {
    pub(super) fn new(options: &'o ReadOptions) -> Self {
        let arguments = options
            .settings
            .iter()
            .map(|(name, value)| (name.clone(), arguments::setting(value)))
            .collect();
        Self {
            options,
            files: super::Files::default(),
            file_stack: Vec::new(),
            calls: Vec::new(),
            call: None,
            arguments,
            met_names: Default::default(),
            evaluating: Vec::new(),
            namespaces: Vec::new(),
            macros: Default::default(),
            is_alone: false,
            warnings: Vec::new(),
            budget: Default::default(),
        }
    }

    /// Expands the text of the main file.
    pub(super) fn expand(
        mut self,
        text: &str,
        file: &str,
        base: Option<&Path>,
    ) -> Result<Expanded, FormatError> {
        let result = self.expand_main(text, file, base);
        for namespace in &self.namespaces {
            namespace.clear();
        }
        match result {
            Ok(root) => {
                let prefixes = self.files.prefixes().to_vec();
                super::output::written(&root, &prefixes, &self)
                    .map_err(|trouble| map::located_trouble(&self, *trouble))
            }
            Err(trouble) => {
                let trouble = arguments::with_all_missing(&self, *trouble);
                Err(map::located_trouble(&self, trouble))
            }
        }
    }

    fn expand_main(&mut self, text: &str, file: &str, base: Option<&Path>) -> Outcome<Rc<Element>> {
        let main = self.files.add(File::new(file, base, text))?;
        let root = self.files.root(main);
        self.is_alone = !leftover::can_call(&root);
        self.file_stack.push(main);
        let names = Names {
            macros: Rc::default(),
            symbols: Rc::default(),
        };
        let made = self.expand_plain(&root, &names, Level::Robot);
        self.file_stack.pop();
        let made = made?;
        names.macros.clear();
        names.symbols.clear();
        self.check_settings(&root)?;
        self.check_links(&made)?;
        Ok(made)
    }

    /// A setting or symbol that the file never asked for is an error, as in files that need no expansion.
    fn check_settings(&mut self, root: &Rc<Element>) -> Outcome<()> {
        let settings = self.options.settings.iter().map(|(name, _)| (name, "set"));
        let symbols = self.options.symbolic.iter().map(|name| (name, "keep"));
        for (name, wanted) in settings.chain(symbols) {
            if self.met_names.contains(name) {
                continue;
            }
            let known = arguments::known(self);
            let names = known.iter().map(|(name, _)| name.as_str());
            let near = did_you_mean(name, names, ("`", "`"));
            let shown = known
                .iter()
                .map(|(name, _)| quoted(name))
                .collect::<Vec<_>>();
            let symbolic = if wanted == "keep" { " symbolic" } else { "" };
            return Err(Trouble::new(format!(
                "cannot {wanted} {}{symbolic}: the file defines no property or argument of that name",
                quoted(name)
            ))
            .help(match &shown[..] {
                [] => "it has no arguments".to_owned(),
                shown => format!("its arguments are {}", shown.join(", ")),
            })
            .maybe_help(near)
            .at(root.place, None));
        }
        Ok(())
    }

    /// A file of macros that nobody calls is told what it is.
    fn check_links(&self, root: &Rc<Element>) -> Outcome<()> {
        let has_links = root
            .elements()
            .any(|element| element.local_name() == "link");
        if has_links || self.macros.is_empty() || !self.calls.is_empty() {
            return Ok(());
        }
        let shown: Vec<String> = self
            .macros
            .iter()
            .take(10)
            .map(|name| quoted(name))
            .collect();
        let more = if self.macros.len() > shown.len() {
            ", …"
        } else {
            ""
        };
        let (what, calls) = match shown.len() {
            1 => ("the macro", "does not call it"),
            _ => ("the macros", "calls none"),
        };
        Err(Trouble::new(format!(
            "the file defines {what} {}{more} and {calls}: there is no link",
            shown.join(", ")
        ))
        .help("read the file that includes this one, or add a call such as <xacro:name .../>")
        .at(root.place, None))
    }

    /// All of these nodes, where they stand.
    pub(super) fn expand_all(
        &mut self,
        nodes: &[Node],
        names: &Names,
        making: &mut Making,
    ) -> Outcome<()> {
        for node in nodes {
            let place = match node {
                Node::Element(element) => element.place,
                Node::Text(_, place) => *place,
            };
            self.spend(1)
                .map_err(|trouble| trouble.at(place, self.call))?;
            match node {
                Node::Element(element) => {
                    let call = self.call;
                    self.deeper(|run| run.expand_element(element, names, making))
                        .map_err(|trouble| trouble.at(element.place, call))?;
                }
                Node::Text(text, place) => {
                    let value = self.substitute(text, *place, &names.symbols)?;
                    let text = self.paid_text(&value)?;
                    if !text.as_str().trim().is_empty() {
                        making.nodes.push(Node::Text(text, *place));
                    }
                }
            }
        }
        Ok(())
    }

    fn expand_element(
        &mut self,
        element: &Rc<Element>,
        names: &Names,
        making: &mut Making,
    ) -> Outcome<()> {
        if !element.is_xacro {
            if making.level == Level::Robot {
                self.warn_of_old_call(element, names)?;
            }
            let made = self.expand_plain(element, names, making.level.inside(element))?;
            making.nodes.push(Node::Element(made));
            return Ok(());
        }
        match element.local_name() {
            "property" => self.define_property(element, names),
            "macro" => self.define_macro(element, names),
            "arg" => self.define_argument(element, names),
            "include" => self.include(element, names, making),
            "insert_block" => self.insert_block(element, names, making),
            "if" => self.choose(element, names, making, true),
            "unless" => self.choose(element, names, making, false),
            "element" => self.computed_element(element, names, making),
            "attribute" => self.add_attribute(element, names, making),
            "call" => self.call_by_name(element, names, making),
            name => self.call_macro(element, name, names, making),
        }
    }

    /// An element of URDF: its attributes and what is inside it, which stands at this level.
    fn expand_plain(
        &mut self,
        element: &Rc<Element>,
        names: &Names,
        level: Level,
    ) -> Outcome<Rc<Element>> {
        let mut inner = Making {
            level,
            ..Making::default()
        };
        for attribute in &element.attributes {
            if attribute.name.starts_with("xacro:") {
                continue;
            }
            let value = self.substitute(&attribute.value, attribute.place, &names.symbols)?;
            inner.attributes.push(Attribute {
                value: self.paid_text(&value)?,
                ..attribute.clone()
            });
        }
        self.expand_all(&element.children, names, &mut inner)?;
        Ok(Rc::new(Element {
            name: element.name.clone(),
            attributes: inner.attributes,
            children: inner.nodes,
            place: element.place,
            is_xacro: false,
            call: element.call.or(self.call),
        }))
    }

    /// A message of the file itself, told where the element stands that says it.
    pub(super) fn said(&mut self, sort: &str, message: String) {
        if sort != "message" {
            let call = self.call.and_then(|call| self.calls.get(call as usize));
            let place = call.map_or(Place::new(0, 0..0), |call| call.place);
            self.warn(place, self.call, (WarningKind::Said, message));
        }
    }

    /// Before version 2 of xacro, macros could be called without a prefix; now such an element stays as it is.
    fn warn_of_old_call(&mut self, element: &Element, names: &Names) -> Outcome<()> {
        self.spend(names.macros.level())?;
        if OF_ROBOT.contains(&&*element.name) || !self.is_like_call(element, names) {
            return Ok(());
        }
        let name = quoted(&element.name);
        let message = format!(
            "<{}> is no call of the macro {name} and stays as it is; <xacro:{}> calls it",
            element.name, element.name
        );
        let kind = WarningKind::NotCalled {
            element: element.name.to_string(),
        };
        self.warn(element.place, self.call, (kind, message));
        Ok(())
    }

    /// Tells something beside the result, once.
    pub(super) fn warn(&mut self, place: Place, call: Option<u32>, told: Told) {
        const MOST: usize = 100;
        let is_told = self.warnings.iter().any(|(.., own)| *own == told);
        if self.warnings.len() < MOST && !is_told {
            self.warnings.push((place, call, told));
        }
    }

    /// An attribute that must be there.
    pub(super) fn required<'e>(&self, element: &'e Element, name: &str) -> Outcome<&'e Attribute> {
        element.attribute(name).ok_or_else(|| {
            Trouble::new(format!("<{}> needs the attribute `{name}`", element.name))
                .help(format!("<{} {name}=\"...\">", element.name))
                .at(element.place, self.call)
        })
    }

    /// The text of an attribute's value.
    pub(super) fn attribute_text(&mut self, attribute: &Attribute, names: &Names) -> Outcome<Text> {
        let value = self.substitute(&attribute.value, attribute.place, &names.symbols)?;
        self.paid_text(&value)
    }

    /// The truth of an attribute's value: `true`, `false`, or a number.
    pub(super) fn attribute_truth(
        &mut self,
        attribute: &Attribute,
        names: &Names,
    ) -> Outcome<bool> {
        let value = self.substitute(&attribute.value, attribute.place, &names.symbols)?;
        let Value::Text(text) = &value else {
            return value.truth("a condition");
        };
        value.known("a condition")?;
        match text.as_str() {
            "true" | "True" => Ok(true),
            "false" | "False" => Ok(false),
            other => match super::value::Num::read_int(text) {
                Some(number) => Ok(number.double() != 0.0),
                None => Err(
                    Trouble::new(format!("needed true or false, found {}", quoted(other)))
                        .help("a condition is true, false, an integer, or an expression ${...}")
                        .at(attribute.place, self.call),
                ),
            },
        }
    }

    fn choose(
        &mut self,
        element: &Rc<Element>,
        names: &Names,
        making: &mut Making,
        wanted: bool,
    ) -> Outcome<()> {
        let condition = self.required(element, "value")?;
        if self.attribute_truth(condition, names)? != wanted {
            return Ok(());
        }
        self.expand_apart(&element.children, names, making)
    }

    /// All of these nodes; an `<xacro:attribute>` directly among them changes nothing, as in ROS.
    pub(super) fn expand_apart(
        &mut self,
        nodes: &[Node],
        names: &Names,
        making: &mut Making,
    ) -> Outcome<()> {
        let mut apart = Making {
            nodes: std::mem::take(&mut making.nodes),
            ..Making::inside(making)
        };
        self.expand_all(nodes, names, &mut apart)?;
        making.nodes = apart.nodes;
        Ok(())
    }

    /// `<xacro:arg name default/>`: a value, unless it has one.
    fn define_argument(&mut self, element: &Rc<Element>, names: &Names) -> Outcome<()> {
        let name = self.required(element, "name")?.value.as_str().to_owned();
        self.met_names.insert(name.clone());
        if self.arguments.contains_key(&name) {
            return self.open_argument(&name);
        }
        let Some(default) = element.attribute("default") else {
            return Err(
                Trouble::new(format!("the argument {} has no value", quoted(&name)))
                    .sort(Sort::Argument),
            );
        };
        let value = self.attribute_text(default, names)?;
        self.arguments.insert(name.clone(), value);
        self.open_argument(&name)
    }

    /// Keeps the number of an argument open, where that is asked for.
    fn open_argument(&mut self, name: &str) -> Outcome<()> {
        if let Some(text) = self.arguments.get(name).cloned()
            && self.options.symbolic.iter().any(|own| own == name)
            && let Value::Number(number) = self.kept_symbolic(name, Value::literal(&text))?
        {
            let open = Text::of_number(text.as_str(), number.exact.as_ref());
            self.arguments.insert(name.to_owned(), open);
        }
        Ok(())
    }

    /// `<xacro:insert_block name/>`: the element or elements of that name, evaluated here.
    fn insert_block(
        &mut self,
        element: &Rc<Element>,
        names: &Names,
        making: &mut Making,
    ) -> Outcome<()> {
        let name = self.required(element, "name")?;
        self.spend(name.value.as_str().len() / 64 + names.symbols.level())?;
        let block = |sort: &str| {
            let found = names
                .symbols
                .find(&format!("{sort}{}", name.value.as_str()));
            match found {
                Some(Entry::Ready(Value::Block(block))) => Some(block),
                _ => None,
            }
        };
        if let Some(several) = block("**") {
            return self.expand_apart(&several.children, names, making);
        }
        let Some(one) = block("*") else {
            return Err(Trouble::new(format!(
                "there is no block named {}",
                quoted(name.value.as_str())
            ))
            .help("a macro takes blocks as params=\"*name\", or several elements in one as \"**name\"")
            .at(name.place, self.call));
        };
        let made = self.expand_plain(&one, names, making.level.inside(&one))?;
        making.nodes.push(Node::Element(made));
        Ok(())
    }

    /// `<xacro:element xacro:name="...">`: an element whose name is computed.
    fn computed_element(
        &mut self,
        element: &Rc<Element>,
        names: &Names,
        making: &mut Making,
    ) -> Outcome<()> {
        let name = self.required(element, "xacro:name")?;
        let text = self.attribute_text(name, names)?;
        let text = text.as_str();
        self.check_name(text, name.place)?;
        let mut renamed = Element {
            name: text.into(),
            attributes: element.attributes.clone(),
            children: element.children.clone(),
            is_xacro: text.starts_with("xacro:"),
            ..*element.as_ref()
        };
        renamed.attributes.retain(|own| &*own.name != "xacro:name");
        self.deeper(|run| run.expand_element(&Rc::new(renamed), names, making))
    }

    /// `<xacro:attribute name value/>`: an attribute of the element that it stands in.
    fn add_attribute(
        &mut self,
        element: &Rc<Element>,
        names: &Names,
        making: &mut Making,
    ) -> Outcome<()> {
        let name = self.required(element, "name")?;
        let value = self.required(element, "value")?;
        let text = self.attribute_text(name, names)?;
        self.check_name(text.as_str(), name.place)?;
        let made = Attribute {
            name: text.as_str().into(),
            value: self.attribute_text(value, names)?,
            place: value.place,
        };
        making.attributes.retain(|own| own.name != made.name);
        making.attributes.push(made);
        Ok(())
    }

    /// Computed names must be names, lest they change the text around them.
    fn check_name(&self, name: &str, place: Place) -> Outcome<()> {
        let is_part = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | ':');
        let starts = name.starts_with(|c: char| c.is_alphabetic() || c == '_');
        if starts && name.chars().all(is_part) && !name.starts_with("xml") {
            return Ok(());
        }
        Err(Trouble::new(format!("{} is not a name", quoted(name))).at(place, self.call))
    }
}
