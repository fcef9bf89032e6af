//! Loops in the words of other tools: `<loop_joint>` and `<constraint>`.
//!
//! - `<loop_joint name type><link1 link xyz rpy/><link2 link xyz rpy/></loop_joint>`: Isaac Sim's importer
//!   (`UrdfParser.cpp`), and Drake before 2016, which adds an `<axis>`. A frame on each side. Some writers call both sides
//!   `link1`.
//! - `<constraint name type><parent link/><parent_origin/><parent_axis/><child link/><child_origin/><child_axis/></constraint>`:
//!   proposed for urdfdom (pull request 264); each side with its frame and axis.

use super::element::Element;
use super::error::Outcome;
use super::names::Named;
use super::reader::{Dialect, Reader};
use super::unread::{OF_JOINTS, Parts};
use super::words::quoted;
use kutzbach_model::mechanism::{Direction, Frame, JointBuilder, JointKind};

/// What may stand inside `<loop_joint>`; what moves it is nothing else.
const LOOP_JOINT: Parts<'_> = Parts {
    known: &["axis", "axis2", "limit", "dynamics"],
    often: &["link1", "link2"],
    bearing: &OF_JOINTS,
};

/// What may stand inside a side of it: nothing, since its attributes say all.
const SIDE: Parts<'_> = Parts {
    known: &[],
    often: &[],
    bearing: &OF_JOINTS,
};

/// What may stand inside `<constraint>`.
const CONSTRAINT: Parts<'_> = Parts {
    known: &CONSTRAINT_WORDS,
    often: &[],
    bearing: &BEARING_ON_CONSTRAINTS,
};

const CONSTRAINT_WORDS: [&str; 6] = [
    "parent",
    "child",
    "parent_origin",
    "child_origin",
    "parent_axis",
    "child_axis",
];

const BEARING_ON_CONSTRAINTS: [&str; 11] = [
    "parent",
    "child",
    "parent_origin",
    "child_origin",
    "parent_axis",
    "child_axis",
    "origin",
    "axis",
    "axis2",
    "mimic",
    "screw",
];

impl<'a> Reader<'a> {
    pub(super) fn read_loop_joint(&mut self, joint: Element<'a>) -> Outcome<()> {
        let name = self.directory.add(Named::Joint, joint)?;
        let kind = self.closing_kind(joint)?;
        let sides: Vec<Element<'a>> = joint
            .elements()
            .filter(|part| matches!(part.name(), "link1" | "link2"))
            .collect();
        let [first, second] = sides.as_slice() else {
            return Err(joint
                .fault(format!("loop {} needs two sides", quoted(name)))
                .help("<link1 link xyz rpy/> and <link2 link xyz rpy/>"));
        };
        let mut builder = {
            let (link1, frame1) = self.loop_side(*first)?;
            let (link2, frame2) = self.loop_side(*second)?;
            self.join(name, [link1, link2]);
            JointBuilder::closing(name, kind, link1, link2)
                .origin(frame1)
                .successor_origin(frame2)
        };
        for part in self.parts_of(joint, &LOOP_JOINT)? {
            match part.name() {
                "link1" | "link2" => {}
                "axis" if kind.uses_axis() => builder = builder.axis(self.direction(part)?),
                "axis2" if kind.uses_second_axis() => {
                    builder = builder.axis2(self.direction(part)?);
                }
                _ => self.skip(part),
            }
        }
        self.add_closing(name, kind, builder);
        Ok(())
    }

    fn loop_side(&mut self, side: Element<'a>) -> Outcome<(&'a str, Frame)> {
        self.attributes_of(side, &["link", "xyz", "rpy", "quat_xyzw"], true)?;
        self.parts_of(side, &SIDE)?;
        let link = self.directory.refer(Named::Link, side, "link")?;
        Ok((link, self.frame_of(side)?))
    }

    pub(super) fn read_constraint(&mut self, constraint: Element<'a>) -> Outcome<()> {
        let name = self.directory.add(Named::Joint, constraint)?;
        let kind = self.closing_kind(constraint)?;
        let (mut links, mut frames) = ([None; 2], [Frame::identity(), Frame::identity()]);
        let mut axes: [Option<Direction>; 2] = [None, None];
        for part in self.parts_of(constraint, &CONSTRAINT)? {
            match part.name() {
                "parent" => links[0] = Some(self.directory.refer(Named::Link, part, "link")?),
                "child" => links[1] = Some(self.directory.refer(Named::Link, part, "link")?),
                "parent_origin" => frames[0] = self.origin(part)?,
                "child_origin" => frames[1] = self.origin(part)?,
                "parent_axis" => axes[0] = Some(self.direction(part)?),
                _ => axes[1] = Some(self.direction(part)?),
            }
        }
        let [Some(parent), Some(child)] = links else {
            return Err(constraint.fault(format!(
                "constraint {} needs <parent link=\"...\"/> and <child link=\"...\"/>",
                quoted(name)
            )));
        };
        self.join(name, [parent, child]);
        let [origin, successor_origin] = frames;
        let mut builder = JointBuilder::closing(name, kind, parent, child)
            .origin(origin)
            .successor_origin(successor_origin);
        let [first, mut second] = axes;
        if kind.uses_second_axis() {
            builder = match second.take() {
                Some(axis) => builder.axis2(axis),
                None => builder,
            };
        } else if let (Some(a), Some(b), true) = (&first, &second, kind.uses_axis())
            && a != b
        {
            return Err(constraint
                .fault("the two sides give one axis in different coordinates")
                .help("turn an origin so that <parent_axis> and <child_axis> are the same"));
        }
        if kind.uses_axis()
            && let Some(axis) = first.or(second)
        {
            builder = builder.axis(axis);
        }
        self.add_closing(name, kind, builder);
        Ok(())
    }

    /// The kind of a joint that closes a loop, by the words of all dialects.
    fn closing_kind(&mut self, element: Element<'a>) -> Outcome<JointKind> {
        let word = element.required("type")?;
        let kind = JointKind::from_word(word.value).or_else(|| Self::drake_kind(word.value));
        match kind {
            Some(JointKind::Screw | JointKind::TranslatingScrew | JointKind::Distance) | None => {
                Err(word
                    .fault(format!(
                        "<{}> of the type {} is not read",
                        element.name(),
                        quoted(word.value)
                    ))
                    .help("write it as a <loop>"))
            }
            Some(kind) => Ok(kind),
        }
    }

    fn add_closing(&mut self, name: &'a str, kind: JointKind, builder: JointBuilder) {
        let plain = matches!(
            kind,
            JointKind::Revolute | JointKind::Prismatic | JointKind::Fixed | JointKind::Planar
        );
        self.uses(if plain {
            Dialect::UrdfPlus
        } else {
            Dialect::Own
        });
        self.other_closures = true;
        self.builder.joint(builder);
        self.kinds.insert(name, kind);
    }

    /// Pairs of links that are named as the two sides of a loop by a convention (onshape-to-robot, placo), where the file
    /// states no such loop.
    pub(super) fn note_closing_frames(&mut self) {
        let mut open: Vec<(usize, String)> = Vec::new();
        for (link, place) in self.directory.link_names() {
            let Some(base) = link
                .strip_prefix("closing_")
                .and_then(|l| l.strip_suffix("_1"))
            else {
                continue;
            };
            let other = format!("closing_{base}_2");
            let joined = self
                .joined
                .contains_key(&super::gazebo::ordered([link, &other]));
            if self.directory.has(Named::Link, &other) && !joined {
                open.push((
                    place.start,
                    format!("the frames {} and {} look like the two sides of a loop, which the file does not state: it is read without that loop", quoted(link), quoted(&other)),
                ));
            }
        }
        for (at, message) in open {
            self.warn(at, message);
        }
    }
}
