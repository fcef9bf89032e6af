//! MJCF, the format of MuJoCo: bodies inside bodies, joints in the body that they move, and equalities that close loops.
//!
//! Read from the text, since its decimals say how well numbers are known; MuJoCo's compiler hands over seventeen digits of each. The pose
//! drawn, `qpos0`, is that of all joints at their `ref`, which is 0 here: limits are shifted by it.
//!
//! | MJCF | here |
//! |---|---|
//! | body | link; with several joints, a link more for each but the last |
//! | hinge, slide, ball, free | revolute, prismatic, spherical, a floating link |
//! | `<connect>` | spherical joint, closed at the pose drawn, or between two sites |
//! | two of them between the same two bodies, by anchors or by sites; three | the hinge on the line of both; a fixed joint |
//! | `<weld>` | fixed joint, or spherical where `torquescale` is 0 |
//! | `<joint>` in `<equality>` | `<mimic>`; without a second joint, a fixed joint |
//! | `<tendon>` in `<equality>`, of fixed tendons of two joints | `<mimic>` |
//! | actuators of joints | motors |
//! | `<replicate>`, `<attach>` | copies, and what is attached, written out before anything is read |
//! | `<inertial>`, `<geom>` | masses and shapes |
//! | `<key>` | configuration; where there are equalities, of starting values |
//!
//! Names are those of the file; what has none is named after its body. What would lose bodies or constraints is an error.
//!
//! Source: the XML reference of MuJoCo 3 and 4, and what its compiler makes of such files.

mod anchors;
mod attach;
mod attached_keys;
mod bodies;
mod classes;
mod closures;
mod congruence;
mod equality;
mod flags;
mod include;
mod joint;
mod keys;
mod mass;
mod pose;
mod replicate;
mod shapes;

use super::element::Element;
use super::error::{Fault, Outcome};
use super::frames::{is_turned, sum};
use super::kept::Kept;
use super::names::unused;
use super::reader::{counted_skips, counted_warnings};
use super::unread::Tally;
use super::words::{did_you_mean, quoted};
use super::{ReadOptions, Reading, WarningKind, xml};
use classes::{ATTACHED, Classes};
use flags::SwitchedOff;
pub(super) use include::{Whole, whole};
use keys::Coordinate;
use kutzbach_model::mechanism::{Entity, Frame, JointKind, MechanismBuilder};
use mass::Load;
use pose::Source;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// The link that stands for MuJoCo's world.
pub(super) const WORLD: &str = "world";

/// Elements of the root that say nothing about the motion.
const STANDARD: [&str; 9] = [
    "option",
    "size",
    "visual",
    "statistic",
    "asset",
    "contact",
    "sensor",
    "custom",
    "extension",
];

/// Attributes of `<compiler>` that change masses and are not read.
const CHANGES_MASSES: [&str; 5] = [
    "inertiagrouprange",
    "boundmass",
    "boundinertia",
    "balanceinertia",
    "settotalmass",
];

/// Elements that make soft bodies, which are not read; they hang on what is around them and hold nothing but by equalities that name them.
const SOFT: [&str; 2] = ["composite", "flexcomp"];

/// A joint of the file.
struct Known<'a> {
    kind: JointKind,
    element: Element<'a>,
}

/// A frame in a link, as the frames one after another that lead to it.
#[derive(Clone)]
struct Place {
    link: String,
    chain: Vec<Frame>,
}

struct Mjcf<'a> {
    builder: MechanismBuilder,
    source: Source<'a>,
    classes: Classes<'a>,
    /// Links and joints by the names that they have here, and where they are written.
    links: BTreeMap<String, Range<usize>>,
    names: BTreeMap<String, Range<usize>>,
    joints: BTreeMap<&'a str, Known<'a>>,
    sites: BTreeMap<&'a str, Place>,
    /// Where each body is in the one around it.
    homes: BTreeMap<String, Place>,
    /// Bodies that a user moves.
    mocap: BTreeSet<String>,
    /// Most decimals of any axis.
    decimals_of_axes: i32,
    /// What `<flag>` says.
    switched_off: SwitchedOff,
    /// All names that the file gives bodies and joints, which nothing else is called by.
    given: BTreeSet<&'a str>,
    /// Which joint every follower follows.
    followers: BTreeMap<&'a str, &'a str>,
    /// Joints that an equality holds where they are drawn.
    held: BTreeSet<&'a str>,
    /// What `qpos` of a key is made of, in its order.
    coordinates: Vec<Coordinate<'a>>,
    key_names: BTreeSet<String>,
    warnings: Vec<(usize, WarningKind, String)>,
    unread: Tally<'a>,
}

/// Reads MJCF.
///
/// # Errors
/// Up to twenty faults, the first one foremost.
pub(super) fn read(whole: &Whole, options: &ReadOptions) -> Result<Reading, Vec<Fault>> {
    let text = &whole.text;
    let document = xml::parse(text).map_err(|fault| vec![fault])?;
    let root = Element::root(&document, text);
    if let Some(fault) = options.without_measures("MJCF") {
        return Err(vec![fault]);
    }
    let name = root.attribute("model").map_or("mujoco", |name| name.value);
    let mut mjcf = Mjcf {
        builder: MechanismBuilder::new(name),
        source: Source::default(),
        classes: Classes::default(),
        links: BTreeMap::new(),
        names: BTreeMap::new(),
        joints: BTreeMap::new(),
        sites: BTreeMap::new(),
        homes: BTreeMap::new(),
        mocap: BTreeSet::new(),
        decimals_of_axes: 0,
        switched_off: SwitchedOff::default(),
        given: BTreeSet::new(),
        followers: BTreeMap::new(),
        held: BTreeSet::new(),
        coordinates: Vec::new(),
        key_names: BTreeSet::new(),
        warnings: Vec::new(),
        unread: Tally::default(),
    };
    mjcf.all(root).map_err(|fault| vec![fault])?;
    if options.strict {
        let faults = mjcf.unread.faults(text);
        if !faults.is_empty() {
            return Err(faults);
        }
    }
    mjcf.finish(whole, root)
}

impl<'a> Mjcf<'a> {
    fn all(&mut self, root: Element<'a>) -> Outcome<()> {
        let sections = |name: &'static str| root.elements().filter(move |e| e.name() == name);
        for compiler in sections("compiler") {
            self.source.compiler.take(compiler)?;
            self.tell_unread_settings(compiler);
        }
        for default in sections("default").chain(sections(ATTACHED)) {
            self.classes.read(default)?;
        }
        self.flags(root);
        for equality in sections("equality") {
            self.note_held(equality)?;
        }
        let mut open = vec![root];
        while let Some(element) = open.pop() {
            let named = matches!(element.name(), "body" | "joint" | "freejoint");
            let name = element.attribute("name").filter(|_| named);
            self.given.extend(name.map(|name| name.value));
            open.extend(element.elements());
        }
        self.links.insert(WORLD.to_owned(), root.range());
        let mut ground = Load::default();
        for world in sections("worldbody") {
            let own = self.load_of(world, None)?;
            ground.collisions.extend(own.collisions);
            ground.visuals.extend(own.visuals);
        }
        self.add_link(WORLD, ground);
        for world in sections("worldbody") {
            self.bodies(world)?;
        }
        for equality in sections("equality") {
            self.equalities(equality, root)?;
        }
        for part in root.elements() {
            match part.name() {
                "compiler" | "default" | "equality" | "worldbody" | "keyframe" => {}
                ATTACHED => {}
                "actuator" if self.switched_off.motors() => {}
                "actuator" => self.actuators(part),
                "tendon" => self.limits_of_tendons(part)?,
                name if STANDARD.contains(&name) => self.unread.standard(part),
                _ => self.unread.element(part),
            }
        }
        for keyframe in sections("keyframe") {
            self.keys(keyframe, root)?;
        }
        Ok(())
    }

    /// Tells what settings say that is not read.
    fn tell_unread_settings(&mut self, element: Element<'a>) {
        for name in CHANGES_MASSES {
            if let Some(says) = element.attribute(name) {
                let what = format!("`{name}` of <compiler>");
                self.unread.text(says.range().start, what);
            }
        }
    }

    /// A name that nothing of its sort has, nor will have.
    fn name_for(&self, taken: &BTreeMap<String, Range<usize>>, wanted: &str) -> String {
        unused(wanted, |name| {
            taken.contains_key(name) || self.given.contains(name)
        })
    }

    /// A body that an equality names.
    fn body(&self, attribute: super::element::Attribute<'a>) -> Outcome<&'a str> {
        match self.links.contains_key(attribute.value) {
            true => Ok(attribute.value),
            false => {
                let known = self.links.keys().map(String::as_str);
                Err(attribute
                    .fault(format!("there is no body {}", quoted(attribute.value)))
                    .maybe_help(did_you_mean(attribute.value, known, ("`", "`"))))
            }
        }
    }

    /// The link and the frame in it at the end of a chain. Where turned frames follow one another, links are put between: products of
    /// rounded numbers would have other digits.
    fn at(&mut self, place: &Place, name: &str) -> (String, Frame) {
        let mut chain: Vec<Frame> = Vec::new();
        for frame in &place.chain {
            let straight = chain.last().is_some_and(|last| !is_turned(last));
            match chain.last_mut().filter(|_| straight) {
                Some(last) => {
                    let sum = [0, 1, 2].map(|i| sum(&last.position[i], &frame.position[i]));
                    *last = Frame {
                        position: sum,
                        roll_pitch_yaw: frame.roll_pitch_yaw.clone(),
                    };
                }
                None if frame.is_identity() => {}
                None => chain.push(frame.clone()),
            }
        }
        let own = chain.pop().unwrap_or_else(Frame::identity);
        let mut link = place.link.clone();
        for frame in chain {
            let between = self.name_for(&self.links, &format!("{name}_frame"));
            let joint = self.name_for(&self.names, &format!("{name}_frame"));
            let range = self.links.get(&link).cloned().unwrap_or(0..0);
            self.links.insert(between.clone(), range.clone());
            self.names.insert(joint.clone(), range);
            self.builder.link(&between);
            let fixed = bodies::tree(&joint, JointKind::Fixed, &link, &between);
            self.builder.joint(fixed.origin(frame));
            link = between;
        }
        (link, own)
    }

    /// Limits of tendons, which are not read.
    fn limits_of_tendons(&mut self, all: Element<'a>) -> Outcome<()> {
        for tendon in all.elements() {
            let class = self.classes.of(tendon, None)?;
            let says = |name: &str| {
                let own = tendon.attribute(name);
                own.or_else(|| self.classes.says(class, "tendon", name))
            };
            let is_off = says("limited").is_some_and(|word| word.value == "false");
            if says("range").is_some() && !is_off {
                let what = "`range` of a tendon".to_owned();
                self.unread.text(tendon.start(), what);
            }
        }
        Ok(())
    }

    fn actuators(&mut self, all: Element<'a>) {
        for actuator in all.elements() {
            let joint = actuator
                .attribute("joint")
                .or_else(|| actuator.attribute("jointinparent"));
            let moved = joint.filter(|joint| {
                let known = self.joints.get(joint.value);
                known.is_some_and(|known| known.kind.freedom() == 1)
                    && !self.held.contains(joint.value)
            });
            match moved {
                Some(joint) => {
                    self.builder.actuate(joint.value);
                }
                None => self.unread.element(actuator),
            }
        }
    }

    fn finish(self, whole: &Whole, root: Element<'a>) -> Result<Reading, Vec<Fault>> {
        let mechanism = self.builder.build().map_err(|error| {
            let place = match &error.entity {
                Entity::Link(name) => self.links.get(name),
                Entity::Joint(name) | Entity::Coupling(name) => self.names.get(name),
                _ => None,
            };
            let range = place.cloned().unwrap_or_else(|| root.range());
            vec![Fault::new(range, error.to_string()).maybe_help(error.help)]
        })?;
        let main = whole.main();
        let warnings = self.warnings.into_iter().map(|(at, kind, message)| {
            let (at, beside) = whole.place(at);
            (at, kind, message + &beside)
        });
        let unread = self.unread.moved(|at| whole.place(at));
        Ok(Reading {
            mechanism,
            warnings: counted_warnings(main, warnings.collect()),
            skipped: counted_skips(main, unread),
            format: "mjcf",
            kept: Kept::default(),
            expect_at: None,
        })
    }
}
