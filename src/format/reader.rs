//! The robot element: definitions first, then every other element in file order, then the checks that need all of them.

use super::definitions::Definitions;
use super::element::{Attribute, Element, Owner};
use super::error::{Fault, MOST_FAULTS, Outcome, lines_and_columns};
use super::names::{Directory, Named};
use super::words::{alternatives, cut, did_you_mean};
use super::{Reading, Skipped, Warning, xml};
use crate::mechanism::{Entity, MechanismBuilder};
use crate::number::Number;
use std::collections::HashMap;
use std::ops::Range;

/// Elements of URDF that say nothing about motion; they may stand inside `robot`, `link` and `joint`.
pub(super) const SKIPPED: [&str; 3] = ["gazebo", "transmission", "sensor"];

/// How much of the dialect a file uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Dialect {
    Urdf,
    UrdfPlus,
    Own,
}

/// What is known while a file is being read.
pub(super) struct Reader<'a> {
    pub(super) builder: MechanismBuilder,
    pub(super) dialect: Dialect,
    pub(super) definitions: Definitions<'a>,
    pub(super) directory: Directory<'a>,
    /// Short literals that were read already.
    pub(super) literals: HashMap<&'a str, Number>,
    root_namespace: Option<&'a str>,
    warnings: Vec<(usize, String)>,
    skipped: Vec<(usize, String)>,
    /// The joint that places each link so far.
    pub(super) placed_by: HashMap<&'a str, &'a str>,
    ground: Option<Range<usize>>,
    scene: Option<Range<usize>>,
    expectation: Option<Range<usize>>,
}

/// Reads a text; faults are unsorted.
pub(super) fn read(
    text: &str,
    settings: &[(String, String)],
    symbolic: &[String],
) -> Result<Reading, Vec<Fault>> {
    let document = xml::parse(text).map_err(|fault| vec![fault])?;
    let root = Element::root(&document);
    let name = robot_name(root).map_err(|fault| vec![fault])?;
    let mut reader = Reader::new(root, name.value);
    let children = root.children().map_err(|fault| vec![fault])?;
    reader
        .note_foreign_attributes(root, &["name", "version"])
        .map_err(|fault| vec![fault])?;
    reader.read_definitions(root, &children, settings, symbolic)?;

    let mut faults = Vec::new();
    for child in children {
        if let Err(fault) = reader.read_child(child) {
            faults.push(fault);
            if faults.len() == MOST_FAULTS {
                break;
            }
        }
    }
    if faults.is_empty() {
        faults = reader.directory.unresolved();
    }
    if !faults.is_empty() {
        return Err(faults);
    }
    reader.finish(text, root)
}

fn robot_name(root: Element<'_>) -> Outcome<Attribute<'_>> {
    if root.name() == "robot" {
        return root.required("name");
    }
    let fault = root.fault(format!("needed <robot>, found <{}>", root.written_name()));
    Err(match root.name() {
        "sdf" | "mujoco" | "mjcf" | "model" => {
            fault.help("this is another format; only URDF and its extensions are read")
        }
        name => fault
            .help("a mechanism file is one <robot name=\"...\"> element")
            .maybe_help(did_you_mean(name, ["robot"], ("<", ">"))),
    })
}

impl<'a> Reader<'a> {
    fn new(root: Element<'a>, name: &str) -> Self {
        Self {
            builder: MechanismBuilder::new(name),
            dialect: Dialect::Urdf,
            definitions: Definitions::default(),
            literals: HashMap::new(),
            root_namespace: root.namespace(),
            warnings: Vec::new(),
            skipped: Vec::new(),
            directory: Directory::default(),
            placed_by: HashMap::new(),
            ground: None,
            scene: None,
            expectation: None,
        }
    }

    fn read_definitions(
        &mut self,
        root: Element<'a>,
        children: &[Element<'a>],
        settings: &'a [(String, String)],
        symbolic: &'a [String],
    ) -> Result<(), Vec<Fault>> {
        let mut faults = Vec::new();
        for child in children {
            if child.owner(self.root_namespace) == Owner::Xacro {
                faults.extend(self.definitions.add(*child).err());
            }
        }
        faults.truncate(MOST_FAULTS);
        for (name, text) in settings {
            faults.extend(self.definitions.set(name, text, root.range()).err());
        }
        for name in symbolic {
            faults.extend(self.definitions.keep_symbolic(name, root.range()).err());
        }
        if faults.is_empty() {
            faults = self.definitions.evaluate_all();
        }
        if !self.definitions.is_empty() {
            self.uses(Dialect::Own);
        }
        if faults.is_empty() {
            Ok(())
        } else {
            Err(faults)
        }
    }

    fn read_child(&mut self, child: Element<'a>) -> Outcome<()> {
        const KNOWN: [&str; 8] = [
            "link",
            "joint",
            "loop",
            "coupling",
            "ground",
            "configuration",
            "scene",
            "expect",
        ];
        match child.owner(self.root_namespace) {
            Owner::Xacro => return Ok(()),
            Owner::Foreign => {
                self.skip(child);
                return Ok(());
            }
            Owner::Format => {}
        }
        match child.name() {
            "link" => self.read_link(child),
            "joint" => self.read_joint(child),
            "loop" => self.read_loop(child),
            "coupling" => self.read_coupling(child),
            "ground" => {
                let place = self.only_one(child, self.ground.clone())?;
                self.ground = Some(place);
                self.read_ground(child)
            }
            "configuration" => self.read_configuration(child),
            "scene" => {
                let place = self.only_one(child, self.scene.clone())?;
                self.scene = Some(place);
                self.read_scene(child)
            }
            "expect" => {
                let place = self.only_one(child, self.expectation.clone())?;
                self.expectation = Some(place);
                self.read_expectation(child)
            }
            name if name == "material" || SKIPPED.contains(&name) => {
                self.skip(child);
                Ok(())
            }
            _ => Err(unknown_element(child, "robot", &KNOWN)),
        }
    }

    fn only_one(
        &self,
        element: Element<'a>,
        earlier: Option<Range<usize>>,
    ) -> Outcome<Range<usize>> {
        match earlier {
            None => Ok(element.range()),
            Some(_) => Err(element
                .fault(format!("a file has at most one <{}>", element.name()))
                .help("merge the two")),
        }
    }

    /// Raises the dialect to at least this one.
    pub(super) fn uses(&mut self, dialect: Dialect) {
        self.dialect = self.dialect.max(dialect);
    }

    pub(super) fn warn(&mut self, at: usize, message: impl Into<String>) {
        self.warnings.push((at, message.into()));
    }

    /// Records an element that is not read.
    pub(super) fn skip(&mut self, element: Element<'a>) {
        let what = format!("<{}>", cut(element.written_name()));
        self.skipped.push((element.start(), what));
    }

    /// Records an element that is not read because of a fault in it.
    pub(super) fn skip_faulty(&mut self, element: Element<'a>, fault: &Fault) {
        let name = cut(element.written_name());
        self.skipped
            .push((element.start(), format!("<{name}>: {}", fault.message)));
    }

    /// Checks the attributes of an element; those of other tools are recorded as skipped.
    pub(super) fn note_foreign_attributes(
        &mut self,
        element: Element<'a>,
        known: &[&str],
    ) -> Outcome<()> {
        for (start, name) in element.only_attributes(known)? {
            let element = cut(element.written_name());
            self.skipped
                .push((start, format!("attribute `{}` of <{element}>", cut(name))));
        }
        Ok(())
    }

    /// The children of an element by the names it may have: `once` at most once each, `often` any number of times.
    ///
    /// What stands in `skipped`, belongs to other tools or is skipped everywhere is recorded; anything else is an error.
    pub(super) fn parts(
        &mut self,
        element: Element<'a>,
        once: &[&str],
        often: &[&str],
        skipped: &[&str],
    ) -> Outcome<Vec<Element<'a>>> {
        let mut parts: Vec<Element<'a>> = element.children()?;
        let mut fault = None;
        let mut seen = 0u64;
        parts.retain(|child| {
            if fault.is_some() {
                return false;
            }
            let owner = child.owner(self.root_namespace);
            let name = child.name();
            match owner {
                Owner::Format if often.contains(&name) => return true,
                Owner::Format => {
                    if let Some(index) = once.iter().position(|known| *known == name) {
                        if seen & (1 << index) != 0 {
                            fault = Some(
                                child
                                    .fault(format!("<{}> has a second <{name}>", element.written_name()))
                                    .help("remove one of the two"),
                            );
                        }
                        seen |= 1 << index;
                        return true;
                    }
                    if !skipped.contains(&name) {
                        let known: Vec<&str> = once.iter().chain(often).copied().collect();
                        fault = Some(unknown_element(*child, element.written_name(), &known));
                        return false;
                    }
                }
                Owner::Xacro => {
                    fault = Some(
                        child
                            .fault(format!("<{}> is not evaluated here", child.written_name()))
                            .help("definitions stand directly inside <robot>; expand other xacro elements with xacro first"),
                    );
                    return false;
                }
                Owner::Foreign => {}
            }
            self.skip(*child);
            false
        });
        match fault {
            Some(fault) => Err(fault),
            None => Ok(parts),
        }
    }

    /// Checks that an element has nothing inside it, and only these attributes.
    pub(super) fn leaf(&mut self, element: Element<'a>, attributes: &[&str]) -> Outcome<()> {
        self.note_foreign_attributes(element, attributes)?;
        self.parts(element, &[], &[], &[]).map(|_| ())
    }

    /// The place of what a builder's error is about.
    fn place_of(&self, entity: &Entity, root: Element<'a>) -> Range<usize> {
        let named = |sort, name: &String| self.directory.place(sort, name);
        let place = match entity {
            Entity::Mechanism => None,
            Entity::Link(name) => named(Named::Link, name),
            Entity::Joint(name) => named(Named::Joint, name),
            Entity::Coupling(name) => named(Named::Coupling, name),
            Entity::Configuration(name) => named(Named::Configuration, name),
            Entity::Ground => self.ground.clone(),
            Entity::Scene => self.scene.clone(),
            Entity::Expectation => self.expectation.clone(),
        };
        place.unwrap_or_else(|| root.range())
    }

    fn finish(mut self, text: &str, root: Element<'a>) -> Result<Reading, Vec<Fault>> {
        let builder = std::mem::take(&mut self.builder);
        let mechanism = builder.build().map_err(|error| {
            let message = error.to_string();
            vec![Fault::new(self.place_of(&error.entity, root), message).maybe_help(error.help)]
        })?;
        Ok(Reading {
            mechanism,
            warnings: with_places(text, self.warnings)
                .map(|(line, column, message)| Warning {
                    line,
                    column,
                    message,
                })
                .collect(),
            skipped: with_places(text, self.skipped)
                .map(|(line, column, what)| Skipped { line, column, what })
                .collect(),
            format: match self.dialect {
                Dialect::Urdf => "urdf",
                Dialect::UrdfPlus => "urdf+",
                Dialect::Own => "kutzbach-urdf",
            },
        })
    }
}

/// Notes with lines and columns, in file order.
fn with_places(
    text: &str,
    mut notes: Vec<(usize, String)>,
) -> impl Iterator<Item = (usize, usize, String)> {
    notes.sort_by_key(|(offset, _)| *offset);
    let offsets: Vec<usize> = notes.iter().map(|(offset, _)| *offset).collect();
    let places = lines_and_columns(text, &offsets);
    notes
        .into_iter()
        .zip(places)
        .map(|((_, message), (line, column))| (line, column, message))
}

fn unknown_element(element: Element<'_>, parent: &str, known: &[&str]) -> Fault {
    let needed = match known {
        [] => "it has nothing inside".to_owned(),
        _ => format!("it has {}", alternatives(known)),
    };
    element
        .fault(format!(
            "<{}> is not known inside <{}>; {needed}",
            cut(element.written_name()),
            cut(parent)
        ))
        .maybe_help(did_you_mean(
            element.name(),
            known.iter().copied(),
            ("<", ">"),
        ))
}
