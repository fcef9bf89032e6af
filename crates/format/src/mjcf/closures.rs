//! What closes loops: `<connect>` and `<weld>`, by bodies or by sites.
//!
//! A `<connect>` by bodies gives a point of the first one; that of the second one is where it is at the pose drawn. One by sites gives a point of
//! each, which need not meet there. Points of the same two bodies are one joint, however each of them is given: one is a ball, several on a line
//! are a hinge ([`anchors`](super::anchors)).

use super::anchors::{Held, Meaning, meaning};
use super::congruence::turn_between;
use super::pose::{exactly, numbers};
use super::{Mjcf, Place, WORLD};
use crate::WarningKind;
use crate::element::{Attribute, Element};
use crate::error::Outcome;
use crate::frames::one_after_another;
use crate::quaternion::roll_pitch_yaw;
use crate::words::{did_you_mean, quoted};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Frame, JointBuilder, JointKind};

/// Points that differ by less than this share of their coordinates, or of 1 m, are one: what doubles leave.
const MEET: f64 = 1e-12;

type Point = [Number; 3];

/// A point that two bodies have in common.
pub(super) struct Connect<'a> {
    element: Element<'a>,
    bodies: [String; 2],
    /// The point in each body; `None` in the one where it follows from the pose drawn.
    points: [Option<Point>; 2],
}

impl Connect<'_> {
    /// The same, its bodies in the other order.
    fn turned_round(self) -> Self {
        let ([a, b], [p, q]) = (self.bodies, self.points);
        Self {
            bodies: [b, a],
            points: [q, p],
            ..self
        }
    }
}

/// All points that the file says two bodies have in common, for each two bodies.
#[derive(Default)]
pub(super) struct Connects<'a>(Vec<Vec<Connect<'a>>>);

impl<'a> Connects<'a> {
    fn add(&mut self, connect: Connect<'a>) {
        let bodies = connect.bodies.clone();
        let [one, other] = &bodies;
        let both = |group: &&mut Vec<Connect<'a>>| {
            group.first().is_some_and(|first| {
                first.bodies == bodies || [&first.bodies[1], &first.bodies[0]] == [one, other]
            })
        };
        match self.0.iter_mut().find(both) {
            Some(group) => {
                let is_turned = group.first().is_some_and(|first| first.bodies != bodies);
                group.push(match is_turned {
                    true => connect.turned_round(),
                    false => connect,
                });
            }
            None => self.0.push(vec![connect]),
        }
    }
}

fn at(point: &Point) -> Frame {
    Frame {
        position: point.clone(),
        ..Frame::identity()
    }
}

/// Where a place is in its link.
fn point_of(place: &Place) -> Point {
    let chain = place.chain.iter();
    let whole = chain.fold(Frame::identity(), |frame, next| {
        one_after_another(&frame, next)
    });
    whole.position
}

impl<'a> Mjcf<'a> {
    /// Takes a `<connect>`.
    pub(super) fn connect(
        &mut self,
        part: Element<'a>,
        connects: &mut Connects<'a>,
    ) -> Outcome<()> {
        if part.attribute("body1").is_some() {
            let anchor = exactly(part.required("anchor")?)?;
            connects.add(Connect {
                element: part,
                bodies: self.two_bodies(part)?.map(str::to_owned),
                points: [Some(anchor), None],
            });
            return Ok(());
        }
        let sites = self.two_sites(part)?;
        if self.is_in_one_body(part, &sites) {
            return Ok(());
        }
        let [one, other] = sites;
        connects.add(Connect {
            element: part,
            points: [Some(point_of(&one)), Some(point_of(&other))],
            bodies: [one.link, other.link],
        });
        Ok(())
    }

    /// Makes the joints of all `<connect>`s.
    pub(super) fn close_all(&mut self, connects: Connects<'a>) -> Outcome<()> {
        connects
            .0
            .into_iter()
            .try_for_each(|group| self.close(&group))
    }

    /// The bodies that an element names; the second one may be left out and is the world then.
    fn two_bodies(&self, part: Element<'a>) -> Outcome<[&'a str; 2]> {
        let one = self.body(part.required("body1")?)?;
        let other = match part.attribute("body2") {
            Some(body) => self.body(body)?,
            None => WORLD,
        };
        Ok([one, other])
    }

    fn two_sites(&self, part: Element<'a>) -> Outcome<[Place; 2]> {
        let place = |side: &'static str| {
            let site = part.required(side)?;
            self.sites.get(site.value).cloned().ok_or_else(|| {
                let known = self.sites.keys().copied();
                site.fault(format!("there is no site {}", quoted(site.value)))
                    .maybe_help(did_you_mean(site.value, known, ("`", "`")))
            })
        };
        Ok([place("site1")?, place("site2")?])
    }

    /// Whether two sites are of one body, which no equality moves; told.
    fn is_in_one_body(&mut self, part: Element<'a>, [one, other]: &[Place; 2]) -> bool {
        let is_one = one.link == other.link;
        if is_one {
            let what = format!("<{}> between two sites of one body", part.name());
            self.unread.text(part.start(), what);
        }
        is_one
    }

    /// Whether an equality holds something that a user moves.
    pub(super) fn is_to_mocap(&self, part: Element<'a>) -> bool {
        let names = |side: &'static str| part.attribute(side).map(|name| name.value);
        let bodies = ["body1", "body2"].into_iter().filter_map(names);
        let sites = ["site1", "site2"].into_iter().filter_map(names);
        let of_sites = sites.filter_map(|site| Some(self.sites.get(site)?.link.as_str()));
        bodies.chain(of_sites).any(|body| self.mocap.contains(body))
    }

    pub(super) fn name_of_closure(&mut self, part: Element<'a>, made: &str) -> String {
        let own = part.attribute("name").map_or(made, |own| own.value);
        let name = self.name_for(&self.names, own);
        self.names.insert(name.clone(), part.range());
        name
    }

    /// Closes a loop by points of two bodies.
    fn close(&mut self, group: &[Connect<'a>]) -> Outcome<()> {
        let first = match group {
            [] => return Ok(()),
            [one] => return self.ball(one),
            [first, ..] => first,
        };
        let drawn: Option<Vec<Point>> = group.iter().map(|own| self.as_drawn(own)).collect();
        let Some(points) = drawn else {
            return self.close_apart(group);
        };
        let found = meaning(&points);
        let joint = self.joint_of(first, group.len(), &found);
        let joint = joint.at_home(&first.bodies[0], at(&points[0]), false);
        self.builder.joint(joint);
        Ok(())
    }

    /// Closes a loop by points that do not meet at the pose drawn. Where they can meet nowhere, being farther from one another in one body
    /// than in the other, each is a ball: so the mechanism does not assemble.
    fn close_apart(&mut self, group: &[Connect<'a>]) -> Outcome<()> {
        let side = |index: usize| -> Option<Vec<Point>> {
            let points = group.iter().map(|own| self.point_in(own, index));
            points.collect()
        };
        let (Some(first), Some(p), Some(q)) = (group.first(), side(0), side(1)) else {
            return group.iter().try_for_each(|own| self.ball(own));
        };
        let mut found = meaning(&p);
        let Some((roll_pitch_yaw, exactly)) = turn_between([&p, &q], &found) else {
            return group.iter().try_for_each(|own| self.ball(own));
        };
        found.within_digits |= !exactly;
        let joint = self.joint_of(first, group.len(), &found);
        let joint = joint.origin(at(&p[0])).successor_origin(Frame {
            position: q[0].clone(),
            roll_pitch_yaw,
        });
        self.builder.joint(joint);
        Ok(())
    }

    /// The joint that several points are, which is told.
    fn joint_of(&mut self, first: &Connect<'a>, count: usize, found: &Meaning) -> JointBuilder {
        let [one, other] = &first.bodies;
        let (kind, what) = match found.held {
            Held::Point => (JointKind::Spherical, "one, a ball"),
            Held::Line(_) => (
                JointKind::Revolute,
                "the hinge on the line of their anchors",
            ),
            Held::All => (JointKind::Fixed, "a fixed joint"),
        };
        let name = self.name_of_closure(first.element, &format!("{one}_{other}"));
        let joint = JointBuilder::closing(&name, kind, one, other);
        let joint = match &found.held {
            Held::Line(along) => joint.axis(along.clone()),
            _ => joint,
        };
        let within = match (found.is_unclear, found.within_digits) {
            (true, _) => ", though their anchors differ by few units of their last digits",
            (_, true) => ": within the digits of their anchors they are that",
            _ => "",
        };
        let message = format!(
            "{count} <connect> between {} and {} are read as {what}{within}",
            quoted(one),
            quoted(other)
        );
        let kind = match found.is_unclear {
            true => WarningKind::Guessed,
            false => WarningKind::ReadAs {
                joint: name,
                element: "connect".to_owned(),
            },
        };
        self.warnings.push((first.element.start(), kind, message));
        joint
    }

    /// One point that two bodies have in common.
    fn ball(&mut self, connect: &Connect<'a>) -> Outcome<()> {
        let [one, other] = &connect.bodies;
        let (link, point) = match &connect.points {
            [Some(_), Some(_)] => {
                return self.between_sites(connect.element, JointKind::Spherical);
            }
            [Some(point), None] => (one, point),
            [None, Some(point)] => (other, point),
            [None, None] => return Ok(()),
        };
        let name = self.name_of_closure(connect.element, &format!("{one}_{other}"));
        let joint = JointBuilder::closing(&name, JointKind::Spherical, one, other);
        self.builder.joint(joint.at_home(link, at(point), false));
        Ok(())
    }

    /// The point in the first body, if that of the second one is there at the pose drawn.
    fn as_drawn(&self, connect: &Connect<'a>) -> Option<Point> {
        let point = self.point_in(connect, 0)?;
        let [one, other] = &connect.bodies;
        let [Some(_), Some(own)] = &connect.points else {
            return Some(point);
        };
        let seen = self.seen(one, other, own)?;
        let is_one = (0..3).all(|i| {
            let (a, b) = (point[i].value(), seen[i].value());
            (a - b).abs() <= MEET * (1.0 + a.abs())
        });
        is_one.then_some(point)
    }

    /// The point in one of the bodies.
    fn point_in(&self, connect: &Connect<'a>, side: usize) -> Option<Point> {
        let other = 1 - side;
        match &connect.points[side] {
            Some(point) => Some(point.clone()),
            None => self.seen(
                &connect.bodies[side],
                &connect.bodies[other],
                connect.points[other].as_ref()?,
            ),
        }
    }

    /// A link and those that it is placed in, one in the other.
    fn ancestors<'s>(&'s self, link: &'s str) -> Vec<&'s str> {
        let mut found = vec![link];
        while let Some(place) = found.last().and_then(|last| self.homes.get(*last)) {
            found.push(&place.link);
        }
        found
    }

    /// A point of one link, seen from another one at the pose drawn; `None` where it is not finite.
    fn seen(&self, from: &str, of: &str, point: &Point) -> Option<Point> {
        let [mut up, mut down] = [from, of].map(|link| self.ancestors(link));
        while up.last().is_some() && up.last() == down.last() {
            up.pop();
            down.pop();
        }
        let chain = |links: &[&str]| {
            let places = links.iter().rev().filter_map(|link| self.homes.get(*link));
            places
                .flat_map(|place| &place.chain)
                .collect::<Vec<&Frame>>()
        };
        let own = at(point);
        let mut to = chain(&down);
        to.push(&own);
        Some(Frame::between(&chain(&up), &to)?.position)
    }

    /// A closure between two sites, which need not meet at the pose drawn.
    fn between_sites(&mut self, part: Element<'a>, kind: JointKind) -> Outcome<()> {
        let mut places = self.two_sites(part)?;
        if self.is_in_one_body(part, &places) {
            return Ok(());
        }
        if kind == JointKind::Spherical {
            // A ball has no directions: how the site is turned says nothing.
            for last in places.iter_mut().filter_map(|place| place.chain.last_mut()) {
                last.roll_pitch_yaw = Frame::identity().roll_pitch_yaw;
            }
        }
        let (a, b) = (part.required("site1")?.value, part.required("site2")?.value);
        let (one, from) = self.at(&places[0], a);
        let (other, to) = self.at(&places[1], b);
        let name = self.name_of_closure(part, &format!("{a}_{b}"));
        let joint = JointBuilder::closing(&name, kind, &one, &other);
        self.builder.joint(joint.origin(from).successor_origin(to));
        Ok(())
    }

    /// Takes a `<weld>`. Where it has a `relpose`, that is where the anchor, a point of the second body, is in the first one, and how the second
    /// body is turned there; as `eq_data` of MuJoCo has it.
    pub(super) fn weld(&mut self, part: Element<'a>) -> Outcome<()> {
        let class = self.classes.of(part, None)?;
        let scale = part
            .attribute("torquescale")
            .or_else(|| self.classes.says(class, "equality", "torquescale"));
        let is_point = match scale {
            Some(scale) => numbers(scale)?.iter().all(Number::is_zero),
            None => false,
        };
        let kind = match is_point {
            true => JointKind::Spherical,
            false => JointKind::Fixed,
        };
        if part.attribute("site1").is_some() {
            return self.between_sites(part, kind);
        }
        let [one, other] = self.two_bodies(part)?;
        let name = self.name_of_closure(part, &format!("{one}_{other}"));
        let anchor = match part.attribute("anchor") {
            Some(position) => at(&exactly(position)?),
            None => Frame::identity(),
        };
        let relative = match part.attribute("relpose") {
            Some(pose) => relative_pose(pose)?,
            None => None,
        };
        let joint = JointBuilder::closing(&name, kind, one, other);
        let joint = match relative {
            Some(pose) if is_point => joint.origin(at(&pose.position)).successor_origin(anchor),
            Some(pose) => joint.origin(pose).successor_origin(anchor),
            None => joint.at_home(other, anchor, false),
        };
        self.builder.joint(joint);
        Ok(())
    }
}

/// `relpose`; `None` where its quaternion is zero, which means the pose drawn.
fn relative_pose(pose: Attribute<'_>) -> Outcome<Option<Frame>> {
    let [x, y, z, w, i, j, k]: [Number; 7] = exactly(pose)?;
    let turned = roll_pitch_yaw(&[i, j, k, w]);
    Ok(turned.map(|roll_pitch_yaw| Frame {
        position: [x, y, z],
        roll_pitch_yaw,
    }))
}
