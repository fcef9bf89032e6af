//! `<constraint>`, a loop in the words of a proposal, and what loops of all dialects have in common.
//!
//! `<constraint name type><parent link/><parent_origin/><parent_axis/><child link/><child_origin/><child_axis/></constraint>` is proposed
//! for urdfdom (pull request 264); each side has its frame and axis. Its types are also written `spherical_joint`, `revolute_joint`,
//! `universal_joint` and `fixed_joint`.

use super::WarningKind;
use super::element::Element;
use super::error::Outcome;
use super::gazebo::ordered;
use super::names::{Named, unused};
use super::reader::{Dialect, Reader};
use super::unread::Parts;
use super::words::{cut, quoted};
use super::writer::escaped;
use kutzbach_model::mechanism::{Direction, Frame, JointBuilder, JointKind};

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
    pub(super) fn read_constraint(&mut self, constraint: Element<'a>) -> Outcome<()> {
        let name = self.directory.add(Named::Joint, constraint)?;
        let kind = self.closing_kind(constraint)?;
        let (mut links, mut frames) = ([None; 2], [Frame::identity(), Frame::identity()]);
        let mut axes: [Option<Direction>; 2] = [None, None];
        for part in self.parts_of(constraint, &CONSTRAINT)? {
            match part.name() {
                "parent" => links[0] = Some(self.directory.refer(Named::Link, part, "link")?),
                "child" => links[1] = Some(self.directory.refer(Named::Link, part, "link")?),
                "parent_origin" => frames[0] = self.joint_origin(part)?,
                "child_origin" => frames[1] = self.joint_origin(part)?,
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
        let shared = first_of(kind, &axes);
        self.note_axes((constraint.start(), name), kind, [shared, axes[1].as_ref()])
            .map_err(|why| constraint.fault(format!("constraint {}: {why}", quoted(name))))?;
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
    pub(super) fn closing_kind(&mut self, element: Element<'a>) -> Outcome<JointKind> {
        let word = element.required("type")?;
        // `spherical_joint`, as the files write it that were made with the proposal's own parser.
        let plain = word.value.strip_suffix("_joint").unwrap_or(word.value);
        let kind = JointKind::from_word(plain).or_else(|| Self::drake_kind(plain));
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

    pub(super) fn add_closing(&mut self, name: &'a str, kind: JointKind, builder: JointBuilder) {
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
    /// states no such loop. What kind of joint is meant it does not say, so none is made: the loop to write is told.
    pub(super) fn note_closing_frames(&mut self) {
        let mut open: Vec<(usize, String)> = Vec::new();
        for (link, place) in self.directory.link_names() {
            let base = link.strip_prefix("closing_");
            let Some(base) = base.and_then(|rest| rest.strip_suffix("_1")) else {
                continue;
            };
            let other = format!("closing_{base}_2");
            let sides = [link, other.as_str()];
            let joined = self.joined.contains_key(&ordered(sides));
            if self.directory.has(Named::Link, &other) && !joined {
                let wanted = if base.is_empty() { "loop" } else { base };
                let name = unused(wanted, |name| self.directory.has_joint_or_coupling(name));
                open.push((place.start, loop_to_write(&name, sides)));
            }
        }
        self.closing_frames_told = !open.is_empty();
        for (at, message) in open {
            self.warn_of(at, WarningKind::MayJoin, message);
        }
    }
}

/// What is told of two frames that look like the sides of a loop.
fn loop_to_write(name: &str, [one, other]: [&str; 2]) -> String {
    let [name, first, second] = [name, one, other].map(|name| escaped(&cut(name)).into_owned());
    format!(
        "the frames {} and {} look like the two sides of a loop, which the file does not state: it is read without that loop. \
         If they meet in a hinge about their z axes, write <loop name=\"{name}\" type=\"revolute\"><predecessor link=\"{first}\"/>\
         <successor link=\"{second}\"/><axis xyz=\"0 0 1\"/></loop>; in a ball, with the type `spherical` and without <axis>; \
         if they are held together, `fixed`",
        quoted(one),
        quoted(other)
    )
}

/// The axis on the first side, which of a joint of one axis may stand on the second.
fn first_of(kind: JointKind, [first, second]: &[Option<Direction>; 2]) -> Option<&Direction> {
    let other = second.as_ref().filter(|_| !kind.uses_second_axis());
    first.as_ref().or(other)
}
