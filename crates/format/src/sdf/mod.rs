//! SDFormat, the format of Gazebo: links that are drawn in one pose, and joints between any two of them.
//!
//! Joints are a graph, and the pose drawn is assembled by construction: a joint's frame is given once, most often in its child, and where it
//! is in the parent follows. A spanning tree of the joints places the links here, the others close loops.
//!
//! | SDFormat | here |
//! |---|---|
//! | `<link>` | link, called `model::link` inside nested models and beside other models |
//! | `<frame>`, `<pose relative_to>`, `placement_frame` | a graph of poses, which numbers are read from as they are written |
//! | revolute, continuous, prismatic, screw, ball, universal, revolute2, fixed, piston | joints |
//! | gearbox | a sum over the joints that bear its two links on the reference body |
//! | `<mimic>` | `<mimic>` |
//! | `world`, `<static>` | the ground, and links that are fixed to it |
//! | the plugin `DetachableJoint` | a fixed joint, as drawn |
//! | `drake:joint` and Drake's constraints | joints |
//! | `<inertial>`, `<visual>`, `<collision>` | masses and shapes |
//!
//! Up to version 1.4 an axis is given in the model's frame, from 1.5 on in the joint's. Where a model has no joint to the world, its
//! canonical link is held, as the root link of URDF is.
//!
//! | file | what it knows |
//! |---|---|
//! | `models` | what is inside of worlds and models |
//! | `names` | what a name stands for |
//! | `pose` | the graph of poses |
//! | `joints` | joints |
//! | `constraints` | gearboxes, plugins and Drake's constraints |
//! | `solids` | masses and shapes |
//! | `tree` | what places the links, and what is held |
//! | `words` | attributes that are not read |
//!
//! Source: the specification at sdformat.org and its tutorials on frames and composition.

mod constraints;
mod joints;
mod models;
mod names;
mod pose;
mod solids;
mod tree;
mod words;

use super::element::{Element, only};
use super::error::{Fault, MOST_FAULTS, Outcome};
use super::kept::Kept;
use super::names::unused;
use super::reader::{counted_skips, counted_warnings};
use super::unread::{Tally, slip_of};
use super::words::{alternatives, cut};
use super::{ReadOptions, Reading, WarningKind, relax, xml};
use constraints::Gear;
use joints::{Listed, Made, Mimic};
use kutzbach_model::mechanism::{Entity, MechanismBuilder};
use models::{Extra, Link, Pending};
use names::{Scope, Thing};
use pose::Graph;
use std::cell::{OnceCell, RefCell};
use std::collections::BTreeMap;
use std::ops::Range;

/// A link by its index; `None` is the world.
type Body = Option<usize>;

/// Versions up to this one give axes in the model's frame.
const AXES_IN_MODEL: (u32, u32) = (1, 4);

struct Sdf<'a> {
    builder: MechanismBuilder,
    version: (u32, u32),
    /// What the link that stands for the world is called here.
    world: String,
    graph: Graph,
    /// Models; the first one is the world around them.
    scopes: Vec<Scope<'a>>,
    links: Vec<Link<'a>>,
    /// Frames that are no links, with the model that they are in.
    frames: Vec<Extra<'a>>,
    joints: Vec<Listed<'a>>,
    /// Plugins and constraints of other tools.
    extras: Vec<Extra<'a>>,
    /// The links that things are rigid with, as far as they are known.
    bodies: RefCell<BTreeMap<Thing, Body>>,
    /// Poses whose references are still to be found.
    pending: Vec<Pending<'a>>,
    made: Vec<Made>,
    gears: Vec<Gear<'a>>,
    mimics: Vec<Mimic<'a>>,
    /// Where links, and joints and couplings, are written, by the names that they have here.
    link_names: BTreeMap<String, Range<usize>>,
    names: BTreeMap<String, Range<usize>>,
    warnings: Vec<(usize, WarningKind, String)>,
    unread: Tally<'a>,
}

/// Reads SDFormat.
///
/// # Errors
/// Up to twenty faults, the first one foremost.
pub(super) fn read(text: &str, options: &ReadOptions) -> Result<Reading, Vec<Fault>> {
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
    let root = Element::root(&document, text);
    if let Some(fault) = options.without_measures("SDFormat") {
        return Err(one(fault));
    }
    let mut sdf = Sdf::new(root).map_err(one)?;
    for (at, message) in notes {
        sdf.warnings.push((at, WarningKind::NotXml, message));
    }
    sdf.all(root, options)?;
    if options.strict {
        let faults = sdf.unread.faults(text);
        if !faults.is_empty() {
            return Err(faults);
        }
    }
    sdf.finish(text, root)
}

impl<'a> Sdf<'a> {
    fn new(root: Element<'a>) -> Outcome<Self> {
        Ok(Self {
            builder: MechanismBuilder::new(name_of(root)),
            version: version_of(root)?,
            world: "world".to_owned(),
            graph: Graph::new(root.range()),
            scopes: vec![Scope::world()],
            links: Vec::new(),
            frames: Vec::new(),
            joints: Vec::new(),
            extras: Vec::new(),
            bodies: RefCell::default(),
            pending: Vec::new(),
            made: Vec::new(),
            gears: Vec::new(),
            mimics: Vec::new(),
            link_names: BTreeMap::new(),
            names: BTreeMap::new(),
            warnings: Vec::new(),
            unread: Tally::default(),
        })
    }

    fn all(&mut self, root: Element<'a>, options: &ReadOptions) -> Result<(), Vec<Fault>> {
        let one = |fault| vec![fault];
        self.tell_unread_words(root).map_err(one)?;
        self.collect(root).map_err(one)?;
        self.check_attachments().map_err(one)?;
        self.place(options).map_err(one)?;
        let mut faults = Vec::new();
        for joint in 0..self.joints.len() {
            faults.extend(self.read_joint(joint).err());
            if faults.len() == MOST_FAULTS {
                break;
            }
        }
        if !faults.is_empty() {
            return Err(faults);
        }
        self.read_extras().map_err(one)?;
        self.assemble().map_err(one)?;
        self.couple().map_err(one)
    }

    /// Gives a joint or coupling that the file does not name its name.
    fn name_made(&mut self, wanted: &str, range: Range<usize>) -> String {
        let name = unused(wanted, |name| self.names.contains_key(name));
        self.names.insert(name.clone(), range);
        name
    }

    fn warn(&mut self, at: usize, kind: WarningKind, message: String) {
        self.warnings.push((at, kind, message));
    }

    /// Skips an element that is not known, unless its name is nearly one of these.
    fn unknown(&mut self, element: Element<'a>, parent: &str, known: &[&str]) -> Outcome<()> {
        if element.written_name().starts_with("xacro:") {
            let message = format!("<{}> is not evaluated here", cut(element.written_name()));
            return Err(element
                .fault(message)
                .help("expand the file with xacro first"));
        }
        if let Some(meant) = slip_of(element.name(), known.iter().copied()) {
            let message = format!(
                "<{}> is not known inside <{parent}>; it has {}",
                cut(element.written_name()),
                alternatives(known)
            );
            let help = format!("did you mean <{meant}>?");
            return Err(element.fault(message).help(help));
        }
        self.unread.element(element);
        Ok(())
    }

    fn finish(self, text: &str, root: Element<'a>) -> Result<Reading, Vec<Fault>> {
        let mechanism = self.builder.build().map_err(|error| {
            let place = match &error.entity {
                Entity::Link(name) => self.link_names.get(name),
                Entity::Joint(name) | Entity::Coupling(name) => self.names.get(name),
                _ => None,
            };
            let range = place.cloned().unwrap_or_else(|| root.range());
            vec![Fault::new(range, error.to_string()).maybe_help(error.help)]
        })?;
        Ok(Reading {
            mechanism,
            warnings: counted_warnings(text, self.warnings),
            skipped: counted_skips(text, self.unread),
            format: "sdf",
            kept: Kept::default(),
            expect_at: None,
        })
    }
}

/// The first name that says what the file is about.
fn name_of(root: Element<'_>) -> &str {
    let mut named = root.elements().filter(|part| {
        matches!(part.name(), "model" | "world") && part.attribute("name").is_some()
    });
    let first = named.next().and_then(|part| part.attribute("name"));
    first.map_or("sdf", |name| name.value)
}

fn version_of(root: Element<'_>) -> Outcome<(u32, u32)> {
    let version = root
        .required("version")
        .map_err(|fault| fault.help("which version it is decides what an <axis> means"))?;
    let parts = version.value.trim().split_once('.');
    let number = parts.and_then(|(major, rest)| {
        let minor = rest.split('.').next().unwrap_or_default();
        Some((major.parse().ok()?, minor.parse().ok()?))
    });
    number.ok_or_else(|| version.fault("expected a version such as 1.7"))
}
