//! Named numbers of a file: `<xacro:property>` and `<xacro:arg>`, and the settings that override them.
//!
//! Definitions may name each other in any order. Each is evaluated once; a definition that needs itself is an error.
//! Properties and arguments have separate names, as in xacro: `${a}` is a property, `$(arg a)` an argument.

use super::element::{Attribute, Element, Owner};
use super::error::{Fault, MOST_FAULTS, Outcome};
use super::number_text::{self, Names, Trouble, is_identifier};
use super::words::{did_you_mean, quoted};
use super::xacro::number_named;
use kutzbach_math::number::Number;
use std::collections::{BTreeSet, HashMap};
use std::ops::Range;

/// How many definitions may wait for each other; definitions that only name earlier ones never wait.
const MOST_WAITING: usize = 64;

/// Names that expressions know themselves.
pub(super) const BUILT_IN: [&str; 12] = [
    "pi", "sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "abs", "radians", "degrees",
];

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Sort {
    Property,
    Argument,
}

#[derive(Clone)]
enum State {
    Waiting,
    Evaluating,
    Done(Number),
    Failed(Fault),
}

#[derive(Clone, Copy)]
enum Text<'a> {
    Attribute(Attribute<'a>),
    Setting(&'a str),
    /// `<xacro:arg>` without default.
    None,
}

struct Definition<'a> {
    name: &'a str,
    element: Range<usize>,
    text: Text<'a>,
    state: State,
}

/// All definitions of a file.
#[derive(Default)]
pub(super) struct Definitions<'a> {
    all: Vec<Definition<'a>>,
    by_name: HashMap<(Sort, &'a str), usize>,
    /// Definitions under evaluation, outermost first.
    evaluating: Vec<usize>,
    /// Names that stay symbolic.
    symbolic: BTreeSet<&'a str>,
    /// Numbers that an expanded xacro file names.
    pub(super) numbers: &'a [Number],
}

impl<'a> Definitions<'a> {
    /// Whether there is no definition.
    pub(super) fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Reads the definitions among the children of the root element and evaluates them, with settings and names that stay symbolic.
    pub(super) fn read(
        &mut self,
        root: Element<'a>,
        children: &[Element<'a>],
        settings: &'a [(String, String)],
        symbolic: &'a [String],
    ) -> Result<(), Vec<Fault>> {
        let mut faults = Vec::new();
        for child in children {
            if child.owner(root.namespace()) == Owner::Xacro {
                faults.extend(self.add(*child).err());
            }
        }
        faults.truncate(MOST_FAULTS);
        for (name, text) in settings {
            faults.extend(self.set(name, text, root.range()).err());
        }
        for name in symbolic {
            faults.extend(self.keep_symbolic(name, root.range()).err());
        }
        if faults.is_empty() {
            faults = self.evaluate_all();
        }
        match faults.is_empty() {
            true => Ok(()),
            false => Err(faults),
        }
    }

    /// Adds a definition if the element, known to be `xacro:`, is one.
    fn add(&mut self, element: Element<'a>) -> Outcome<()> {
        let (sort, value) = match element.name() {
            "property" => (Sort::Property, "value"),
            "arg" => (Sort::Argument, "default"),
            other => {
                return Err(element
                    .fault(format!("<{}> is not evaluated here", element.written_name()))
                    .help(match other {
                        "macro" | "include" | "if" | "unless" | "insert_block" => {
                            "expand the file with xacro first; <xacro:property> and <xacro:arg> are read"
                        }
                        _ => "of xacro, <xacro:property> and <xacro:arg> are read",
                    }));
            }
        };
        element.only_attributes(&["name", value])?;
        if let Some(child) = element.children()?.first() {
            return Err(child.fault("needed nothing inside a definition, found an element"));
        }
        let name = element.required("name")?;
        let text = match sort {
            Sort::Property => Text::Attribute(element.required(value)?),
            Sort::Argument => element.attribute(value).map_or(Text::None, Text::Attribute),
        };
        if !is_identifier(name.value) || name.value.starts_with("__") {
            return Err(name
                .fault(format!("{} cannot be used in an expression", quoted(name.value)))
                .help("names are letters, digits and underscores, start with a letter, and not with two underscores"));
        }
        if sort == Sort::Property && BUILT_IN.contains(&name.value) {
            return Err(name.fault(format!(
                "{} is built in and cannot be defined",
                quoted(name.value)
            )));
        }
        if self.by_name.contains_key(&(sort, name.value)) {
            return Err(name
                .fault(format!("{} is defined twice", quoted(name.value)))
                .help("a definition holds for the whole file; use another name"));
        }
        self.by_name.insert((sort, name.value), self.all.len());
        self.all.push(Definition {
            name: name.value,
            element: element.range(),
            text,
            state: State::Waiting,
        });
        Ok(())
    }

    /// Overrides the arguments and properties of a name; a name that the file does not define is an error about its root.
    fn set(&mut self, name: &str, text: &'a str, root: Range<usize>) -> Outcome<()> {
        let mut found = false;
        for sort in [Sort::Property, Sort::Argument] {
            if let Some(index) = self.by_name.get(&(sort, name)) {
                self.all[*index].text = Text::Setting(text);
                found = true;
            }
        }
        if found {
            return Ok(());
        }
        let names = self.all.iter().map(|definition| definition.name);
        let help = did_you_mean(name, names, ("`", "`"));
        Err(Fault::new(
            root,
            format!(
                "cannot set {}: the file defines no property or argument of that name",
                quoted(name)
            ),
        )
        .help("define it with <xacro:arg name default/>")
        .maybe_help(help))
    }

    /// Keeps the properties and arguments of a name symbolic; a name that the file does not define is an error about its
    /// root.
    fn keep_symbolic(&mut self, name: &'a str, root: Range<usize>) -> Outcome<()> {
        if self.all.iter().any(|definition| definition.name == name) {
            self.symbolic.insert(name);
            return Ok(());
        }
        let names: Vec<String> = self
            .all
            .iter()
            .map(|definition| quoted(definition.name))
            .collect();
        let known = if names.is_empty() {
            "the file defines none".to_owned()
        } else {
            format!("it defines {}", names.join(", "))
        };
        Err(Fault::new(
            root,
            format!(
                "cannot keep {} symbolic: the file defines no property or argument of that name",
                quoted(name)
            ),
        )
        .help(known))
    }

    /// Evaluates every definition, used or not.
    fn evaluate_all(&mut self) -> Vec<Fault> {
        let mut faults: Vec<Fault> = Vec::new();
        for index in 0..self.all.len() {
            if let Err(fault) = self.evaluate(index) {
                // Definitions that need a faulty one carry its fault.
                let known = faults
                    .iter()
                    .any(|f| f.range == fault.range && f.message == fault.message);
                if !known {
                    faults.push(fault);
                }
                if faults.len() == MOST_FAULTS {
                    break;
                }
            }
        }
        faults
    }

    fn evaluate(&mut self, index: usize) -> Outcome<Number> {
        match &self.all[index].state {
            State::Done(number) => return Ok(number.clone()),
            State::Failed(fault) => return Err(fault.clone()),
            State::Waiting | State::Evaluating => {}
        }
        self.all[index].state = State::Evaluating;
        self.evaluating.push(index);
        let name = self.all[index].name;
        let result = self.evaluate_text(index).map(|number| {
            if self.symbolic.contains(name) {
                Number::parameter(name, number)
            } else {
                number
            }
        });
        self.evaluating.pop();
        self.all[index].state = match &result {
            Ok(number) => State::Done(number.clone()),
            Err(fault) => State::Failed(fault.clone()),
        };
        result
    }

    fn evaluate_text(&mut self, index: usize) -> Outcome<Number> {
        let Definition { name, element, .. } = &self.all[index];
        let (name, element) = (*name, element.clone());
        match self.all[index].text {
            Text::Attribute(attribute) => number_text::definition(attribute.value, self)
                .map_err(|trouble| trouble.placed(|range| attribute.part(range))),
            Text::Setting(text) => number_text::definition(text, self).map_err(|trouble| {
                let mut fault = trouble.placed(|_| element);
                fault.message = format!("in the setting {name}={text}: {}", fault.message);
                fault
            }),
            Text::None => Err(Fault::new(
                element,
                format!(
                    "the argument {} has no default and was not set",
                    quoted(name)
                ),
            )
            .help(format!(
                "give it with --set {name}=value, or add default=\"...\""
            ))),
        }
    }

    fn value(&mut self, sort: Sort, name: &str) -> Result<Option<Number>, Trouble> {
        let Some(&index) = self.by_name.get(&(sort, name)) else {
            return Ok(number_named(name, self.numbers).cloned());
        };
        let here = |message: String| Trouble::Here(Fault::new(0..0, message));
        if matches!(self.all[index].state, State::Evaluating) {
            let from = self
                .evaluating
                .iter()
                .position(|i| *i == index)
                .unwrap_or(0);
            let mut circle: Vec<&str> = self.evaluating[from..]
                .iter()
                .take(8)
                .map(|i| self.all[*i].name)
                .collect();
            circle.push(name);
            return Err(here(format!(
                "{} is defined by itself: {}",
                quoted(name),
                circle.join(" -> ")
            )));
        }
        if self.evaluating.len() >= MOST_WAITING && matches!(self.all[index].state, State::Waiting)
        {
            return Err(here(format!(
                "more than {MOST_WAITING} definitions wait for later ones"
            )));
        }
        self.evaluate(index).map(Some).map_err(Trouble::Elsewhere)
    }
}

impl Names for Definitions<'_> {
    fn property(&mut self, name: &str) -> Result<Option<Number>, Trouble> {
        self.value(Sort::Property, name)
    }

    fn argument(&mut self, name: &str) -> Result<Option<Number>, Trouble> {
        self.value(Sort::Argument, name)
    }

    fn suggestions(&self) -> Vec<&str> {
        self.all.iter().map(|definition| definition.name).collect()
    }
}
