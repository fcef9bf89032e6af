//! The robot element: definitions first, then every other element in file order, then the checks that need all of them.

use super::actuation::{ACTUATION, Motor};
use super::assumed::Assumed;
use super::definitions::Definitions;
use super::element::{Element, Owner};
use super::error::{Fault, MOST_FAULTS, Outcome, lines_and_columns};
use super::hints;
use super::kept::{Kept, KeptMotors};
use super::loop_joint::SecondPoint;
use super::mimic::{Follows, joint_names};
use super::names::{Directory, Named};
use super::restated::Restated;
use super::unread::{Parts, Tally, Unread};
use super::words::{alternatives, cut, did_you_mean};
use super::{ReadOptions, Reading, Skipped, Warning, WarningKind, relax, xml};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{
    Entity, Frame, JointBuilder, JointKind, Mechanism, MechanismBuilder,
};
use roxmltree::Document;
use std::cell::{Cell, OnceCell};
use std::collections::{HashMap, HashSet};
use std::ops::Range;

/// How much of the dialect a file uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Dialect {
    Urdf,
    UrdfPlus,
    Own,
}

/// What another file adds to a robot: joints that close loops, and the names of joints with motors.
#[derive(Default)]
pub(super) struct Added {
    pub(super) joints: Vec<JointBuilder>,
    pub(super) motors: Vec<String>,
}

/// What is known while a file is being read.
pub(super) struct Reader<'a> {
    pub(super) builder: MechanismBuilder,
    pub(super) dialect: Dialect,
    pub(super) definitions: Definitions<'a>,
    pub(super) directory: Directory<'a>,
    /// Short literals that were read already.
    pub(super) literals: HashMap<&'a str, Number>,
    pub(super) root: Element<'a>,
    pub(super) root_namespace: Option<&'a str>,
    warnings: Vec<(usize, WarningKind, String)>,
    pub(super) unread: Tally<'a>,
    /// Elements that are not read, until all names are known.
    pub(super) set_aside: Vec<Element<'a>>,
    /// The joint that places each link so far.
    pub(super) placed_by: HashMap<&'a str, &'a str>,
    /// The kind of each joint that was read so far; a `floating` joint is none.
    pub(super) kinds: HashMap<&'a str, JointKind>,
    /// What the file says of motors.
    pub(super) motors: Vec<Motor<'a>>,
    /// The elements that say so.
    pub(super) kept_motors: Vec<KeptMotors>,
    /// The links of each joint of the tree.
    pub(super) sides_of: HashMap<&'a str, [&'a str; 2]>,
    /// The first joint or loop between two links, by their names in order.
    pub(super) joined: HashMap<[&'a str; 2], &'a str>,
    /// Joints that are read when all links are known.
    pub(super) late: Vec<Element<'a>>,
    /// Links that stand inside `<gazebo>`, and where: element, link, what it is placed in, and its frame there.
    pub(super) late_links: Vec<(Element<'a>, &'a str, &'a str, Frame)>,
    pub(super) sdf_links: HashSet<&'a str>,
    /// Links placed by a floating joint.
    pub(super) floating: HashSet<&'a str>,
    /// The link that nothing places, known when all links are.
    pub(super) tree_root: Option<&'a str>,
    /// Whether a joint inside `<gazebo>` holds it in the world.
    pub(super) root_is_held: bool,
    /// Whether a joint connects to a world that is no link of the file.
    pub(super) joins_world: bool,
    /// How many freedoms each joint inside `<gazebo>` has, by the name it has here.
    pub(super) in_gazebo: HashMap<String, usize>,
    /// Where the first of them stands.
    pub(super) first_in_gazebo: Option<usize>,
    /// Joints that follow another one, and how.
    pub(super) followers: HashMap<&'a str, Follows<'a>>,
    /// How many of them do so by what stands inside `<gazebo>`.
    pub(super) followers_in_gazebo: usize,
    /// Joints of the tree that stand inside `<gazebo>` too.
    pub(super) restated: Vec<Restated<'a>>,
    /// The names of all joints of the file.
    pub(super) joint_names: HashSet<&'a str>,
    /// Where the elements stand that are read out of what is set aside.
    pub(super) taken: HashSet<usize>,
    /// MuJoCo's loops, which are read when all links are known.
    pub(super) connects: Vec<Element<'a>>,
    /// Joints that MuJoCo's equalities hold, and what says so.
    pub(super) held: HashMap<&'a str, Element<'a>>,
    /// What joints leave out.
    pub(super) assumed: Assumed<'a>,
    /// Whether links were told that look like the sides of a loop.
    pub(super) closing_frames_told: bool,
    /// Points written twice, which must be one.
    pub(super) second_points: Vec<SecondPoint<'a>>,
    /// Whether loops or couplings stand elsewhere than inside `<gazebo>`.
    pub(super) other_closures: bool,
    /// How many constraints without a name were given one.
    pub(super) unnamed: usize,
    /// Whether a joint names `world`.
    pub(super) meets_world: bool,
    /// Whether the file has a world that it does not write.
    pub(super) implicit_world: bool,
    pub(super) ground: Option<Range<usize>>,
    scene: Option<Range<usize>>,
    expectation: Option<Range<usize>>,
    /// Where expressions are to stay open, how many have been read.
    pub(super) open: Option<&'a Cell<usize>>,
}

/// Reads a text, with what another file adds to it; faults are unsorted. A text that was expanded from xacro comes with the numbers that
/// it names.
pub(super) fn read(
    text: &str,
    options: &ReadOptions,
    expanded: Option<&[Number]>,
    added: &Added,
) -> Result<Reading, Vec<Fault>> {
    let one = |fault| vec![fault];
    let (relaxed, mut notes) = (OnceCell::new(), Vec::new());
    let document = match xml::parse(text) {
        Ok(document) => document,
        Err(fault) => {
            let (lenient, why) = relax::relaxed(text).ok_or_else(|| one(fault))?;
            notes = why;
            xml::parse(relaxed.get_or_init(|| lenient)).map_err(one)?
        }
    };
    read_parsed(&document, text, notes, options, expanded, added)
}

/// Reads a text that is parsed, with what was changed in it for that, and where.
pub(super) fn read_parsed<'a>(
    document: &'a Document<'a>,
    text: &'a str,
    notes: Vec<(usize, String)>,
    options: &'a ReadOptions,
    expanded: Option<&'a [Number]>,
    added: &Added,
) -> Result<Reading, Vec<Fault>> {
    let root = Element::root(document, text);
    let mut reader = Reader::new(root);
    for (at, message) in notes {
        reader.warn_of(at, WarningKind::NotXml, message);
    }
    if let Some(numbers) = expanded {
        reader.definitions.numbers = numbers;
    }
    reader.read_root(text, options, added)
}

/// Reads a text that is parsed with parameters in place of the values of expressions, named by their texts, and counts these.
pub(super) fn read_open<'a>(
    document: &'a Document<'a>,
    text: &'a str,
    options: &'a ReadOptions,
    count: &'a Cell<usize>,
) -> Result<Mechanism, Vec<Fault>> {
    let mut reader = Reader::new(Element::root(document, text));
    reader.open = Some(count);
    let reading = reader.read_root(text, options, &Added::default())?;
    Ok(reading.mechanism)
}

fn check_root(root: Element<'_>) -> Outcome<()> {
    if root.name() == "robot" {
        return Ok(());
    }
    let fault = root.fault(format!("needed <robot>, found <{}>", root.written_name()));
    Err(match root.name() {
        "mjcf" | "model" => fault
            .help("this is another format; URDF and its extensions, <mujoco> and <sdf> are read"),
        "sketch" => fault.help("a sketch is shown by `kutzbach graph FILE --constructive`"),
        name => fault
            .help("a mechanism file is one <robot name=\"...\"> element")
            .maybe_help(did_you_mean(name, ["robot"], ("<", ">"))),
    })
}

impl<'a> Reader<'a> {
    pub(super) fn new(root: Element<'a>) -> Self {
        // The name is a label; nothing refers to it.
        let name = root.attribute("name").map_or("unnamed", |name| name.value);
        Self {
            builder: MechanismBuilder::new(name),
            dialect: Dialect::Urdf,
            definitions: Definitions::default(),
            literals: HashMap::new(),
            root,
            root_namespace: root.namespace(),
            warnings: Vec::new(),
            unread: Tally::default(),
            set_aside: Vec::new(),
            directory: Directory::default(),
            placed_by: HashMap::new(),
            kinds: HashMap::new(),
            motors: Vec::new(),
            kept_motors: Vec::new(),
            sides_of: HashMap::new(),
            joined: HashMap::new(),
            late: Vec::new(),
            late_links: Vec::new(),
            sdf_links: HashSet::new(),
            floating: HashSet::new(),
            tree_root: None,
            root_is_held: false,
            joins_world: false,
            in_gazebo: HashMap::new(),
            first_in_gazebo: None,
            followers: HashMap::new(),
            followers_in_gazebo: 0,
            restated: Vec::new(),
            joint_names: joint_names(root).collect(),
            taken: HashSet::new(),
            connects: Vec::new(),
            held: Self::held_joints(root),
            assumed: Assumed::default(),
            closing_frames_told: false,
            second_points: Vec::new(),
            other_closures: false,
            unnamed: 0,
            meets_world: false,
            implicit_world: false,
            ground: None,
            scene: None,
            expectation: None,
            open: None,
        }
    }

    fn read_root(
        mut self,
        text: &str,
        options: &'a ReadOptions,
        added: &Added,
    ) -> Result<Reading, Vec<Fault>> {
        let one = |fault| vec![fault];
        let root = self.root;
        check_root(root).map_err(one)?;
        self.attributes_of(root, &["name", "version"], true)
            .map_err(one)?;
        self.skip_text(root);
        let children: Vec<Element<'_>> = root.elements().collect();
        let (settings, symbolic) = (&options.settings, &options.symbolic);
        self.definitions.read(root, &children, settings, symbolic)?;
        if !self.definitions.is_empty() {
            self.uses(Dialect::Own);
        }

        let mut faults = Vec::new();
        for child in children {
            if let Err(fault) = self.read_child(child) {
                faults.push(fault);
                if faults.len() == MOST_FAULTS {
                    break;
                }
            }
        }
        self.add(added);
        if faults.is_empty() {
            self.find_world();
            faults = self.read_late_joints();
            faults.extend(self.read_connects());
            faults.extend(self.read_other_mimics());
        }
        if faults.is_empty() {
            faults = self.directory.unresolved();
        }
        self.add_world();
        self.float_roots();
        self.note_tree();
        self.resolve_motors();
        self.note_closing_frames();
        self.tell_assumed(options.literal);
        self.note_equalities();
        self.note_mentions();
        if options.strict {
            faults.extend(self.unread.faults(text));
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        self.finish(text, root)
    }

    fn read_child(&mut self, child: Element<'a>) -> Outcome<()> {
        const KNOWN: [&str; 10] = [
            "link",
            "joint",
            "loop",
            "coupling",
            "ground",
            "configuration",
            "scene",
            "expect",
            "loop_joint",
            "constraint",
        ];
        /// What belongs inside other elements; at the top it is a sign of a tag closed too early.
        const BEARING: [&str; 16] = [
            "link",
            "joint",
            "loop",
            "coupling",
            "ground",
            "configuration",
            "scene",
            "expect",
            "loop_joint",
            "constraint",
            "parent",
            "child",
            "axis",
            "mimic",
            "predecessor",
            "successor",
        ];
        match child.owner(self.root_namespace) {
            Owner::Xacro => return Ok(()),
            Owner::Foreign => return self.read_foreign(child),
            Owner::Format => {}
        }
        match child.name() {
            "link" => self.read_link(child),
            "joint" => self.read_joint(child),
            "loop" => self.read_loop(child),
            "coupling" => self.read_coupling(child),
            "gazebo" => self.read_gazebo(child),
            "loop_joint" => self.read_loop_joint(child),
            "constraint" => self.read_constraint(child),
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
            "sketch" => self.read_sketch(child),
            name if ACTUATION.contains(&name) => {
                if name == "mujoco" {
                    self.read_mujoco(child);
                }
                self.check_for_joints(child)?;
                self.read_actuation(child);
                Ok(())
            }
            _ => {
                let kinds = Parts {
                    known: &KNOWN,
                    often: &[],
                    bearing: &BEARING,
                };
                self.skip_unknown(child, self.root, &kinds)
            }
        }
    }

    /// A sketch is a file of its own; beside links it is skipped, in so many words.
    fn read_sketch(&mut self, sketch: Element<'a>) -> Outcome<()> {
        const ROOT: &str = "<sketch> has to be the root element of a file of its own";
        if self.root.elements().any(|e| e.name() == "link") {
            self.skip_because(sketch, ROOT.to_owned());
            return Ok(());
        }
        let fault = sketch.fault(ROOT);
        Err(fault
            .help("take <robot> away around it; `kutzbach graph FILE --constructive` shows it"))
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

    /// Adds what stands in another file.
    fn add(&mut self, added: &Added) {
        if added.joints.is_empty() && added.motors.is_empty() {
            return;
        }
        self.uses(Dialect::UrdfPlus);
        self.other_closures |= !added.joints.is_empty();
        for joint in &added.joints {
            self.builder.joint(joint.clone());
        }
        for motor in &added.motors {
            self.builder.actuate(motor);
        }
    }

    /// Raises the dialect to at least this one.
    pub(super) fn uses(&mut self, dialect: Dialect) {
        self.dialect = self.dialect.max(dialect);
    }

    pub(super) fn warn_of(&mut self, at: usize, kind: WarningKind, message: impl Into<String>) {
        self.warnings.push((at, kind, message.into()));
    }

    /// Records an element that is not read.
    pub(super) fn skip(&mut self, element: Element<'a>) {
        self.unread.element(element);
    }

    /// Records something that is not read, in words of its own.
    pub(super) fn skip_because(&mut self, element: Element<'a>, what: String) {
        self.unread.text(element.start(), what);
    }

    /// Records an element that is not read because of a fault in it.
    pub(super) fn skip_faulty(&mut self, element: Element<'a>, fault: &Fault) {
        let name = cut(element.written_name());
        self.skip_because(element, format!("<{name}>: {}", fault.message));
    }

    /// Checks the attributes of an element; those of other tools are recorded as skipped.
    pub(super) fn note_foreign_attributes(
        &mut self,
        element: Element<'a>,
        known: &[&str],
    ) -> Outcome<()> {
        for (start, name) in element.only_attributes(known)? {
            let element = cut(element.written_name());
            self.unread
                .text(start, format!("attribute `{}` of <{element}>", cut(name)));
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
        let otherwise = self.restated_otherwise();
        if !otherwise.is_empty() {
            return Err(otherwise);
        }
        let builder = std::mem::take(&mut self.builder);
        let mechanism = builder.build().map_err(|error| {
            let message = error.to_string();
            vec![Fault::new(self.place_of(&error.entity, root), message).maybe_help(error.help)]
        })?;
        self.warn_of_assumptions(&mechanism);
        self.warn_of_limits(&mechanism);
        let apart = self.points_apart(&mechanism);
        if !apart.is_empty() {
            return Err(apart);
        }
        Ok(Reading {
            mechanism,
            warnings: counted_warnings(text, self.warnings),
            skipped: counted_skips(text, self.unread),
            format: match self.dialect {
                Dialect::Urdf => "urdf",
                Dialect::UrdfPlus => "urdf+",
                Dialect::Own => "kutzbach-urdf",
            },
            kept: Kept::of(root, self.kept_motors),
            expect_at: self
                .expectation
                .and_then(|range| lines_and_columns(text, &[range.start]).first().copied()),
        })
    }
}

/// Warnings with lines and columns in file order, those that say the same counted.
pub(super) fn counted_warnings(
    text: &str,
    warnings: Vec<(usize, WarningKind, String)>,
) -> Vec<Warning> {
    let mut tally = Tally::default();
    let mut kind_of = HashMap::new();
    for (start, kind, message) in warnings {
        kind_of.insert(message.clone(), kind);
        tally.text(start, message);
    }
    let kinds = tally.kinds();
    places(text, &kinds)
        .into_iter()
        .zip(kinds)
        .filter_map(|((line, column), said)| {
            Some(Warning {
                line,
                column,
                kind: kind_of.remove(&said.what)?,
                message: said.what,
                count: said.count,
            })
        })
        .collect()
}

/// What was skipped with lines and columns, in file order.
pub(super) fn counted_skips(text: &str, unread: Tally<'_>) -> Vec<Skipped> {
    let kinds = unread.kinds();
    places(text, &kinds)
        .into_iter()
        .zip(kinds)
        .map(|((line, column), kind)| Skipped {
            line,
            column,
            what: kind.what,
            count: kind.count,
            standard: kind.standard,
        })
        .collect()
}

fn places(text: &str, kinds: &[Unread]) -> Vec<(usize, usize)> {
    let offsets: Vec<usize> = kinds.iter().map(|kind| kind.start).collect();
    lines_and_columns(text, &offsets)
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
        .maybe_help(hints::side_of_joint(element.name(), parent))
}
