//! Joints that are closed at home by construction: one frame says where the joint is, and both sides follow from where the
//! links are placed.
//!
//! Formats that describe a mechanism as a graph of bodies in one pose (SDFormat) give a joint's frame once. Here each side
//! needs its own: with `T_P` and `T_S` the home poses of predecessor and successor and `H` that of the joint's frame, they
//! are `T_P⁻¹ H` and `T_S⁻¹ H`. Only the way from the nearest common ancestor of the links counts, which keeps numbers
//! short and the cost to the length of the loop.
//!
//! Where all rotations on the way have cosines and sines in closed form, as those of plain translations and quarter turns,
//! the frames are exact. Where they have not, they are computed in doubles and closed to some 1e-16 of the loop's size. Either way they
//! know the literals that they were worked out from: an exact sum of rounded numbers is as uncertain as these.

use super::checks::check_frame;
use super::far_frames::FarFrames;
use super::names::Names;
use super::placements::placed_by;
use crate::mechanism::derived_frames::{Step, inputs_along};
use crate::mechanism::{Entity, Frame, Joint, JointId, Link, LinkId, MechanismError, Placement};
use kutzbach_math::number::Number;
use std::ops::{Add, Mul, Neg};

/// Where a joint's frame is at home.
#[derive(Clone, Debug)]
pub(super) struct HomeFrame {
    /// The link that it is given in.
    pub(super) link: String,
    /// The frame in that link.
    pub(super) frame: Frame,
    /// Whether its orientation is not that of `frame` but the root link's.
    pub(super) parallel_to_root: bool,
}

/// Gives joints their frames.
pub(super) fn close_at_home(
    specs: Vec<(JointId, HomeFrame)>,
    joints: &mut [Joint],
    links: &[Link],
    names: &Names,
) -> Result<(), MechanismError> {
    let far = match specs.is_empty() {
        true => None,
        false => FarFrames::new(links, joints),
    };
    for (id, spec) in specs {
        let entity = Entity::Joint(joints[id.0].name.clone());
        let anchor = names.link(&entity, &spec.link)?;
        let sides = [joints[id.0].predecessor.link, joints[id.0].successor.link];
        let jumped = far
            .as_ref()
            .and_then(|far| far.frames(anchor, &spec, sides));
        if let Some([predecessor, successor]) = jumped {
            check_frame(&entity, &predecessor)?;
            check_frame(&entity, &successor)?;
            let joint = &mut joints[id.0];
            (joint.predecessor.frame, joint.successor.frame) = (predecessor, successor);
            continue;
        }
        let tree = Tree { links, joints };
        let frames = tree.frames::<Number>(anchor, &spec, sides);
        let [predecessor, successor] = match frames {
            Some(frames) => frames,
            None => tree.frames::<f64>(anchor, &spec, sides).ok_or_else(|| {
                MechanismError::new(entity.clone(), "its place at home is not finite")
            })?,
        };
        let predecessor = tree.derived(predecessor, sides[0], anchor, &spec);
        let successor = tree.derived(successor, sides[1], anchor, &spec);
        check_frame(&entity, &predecessor)?;
        check_frame(&entity, &successor)?;
        joints[id.0].predecessor.frame = predecessor;
        joints[id.0].successor.frame = successor;
    }
    Ok(())
}

impl Frame {
    /// The frame at the end of one chain, seen from the end of another one that starts at the same place; each frame of a chain is given in
    /// the one before. Exact where the cosines and sines on the way have closed forms, otherwise in doubles; the numbers know the literals
    /// that they were [worked out](Number::derived_from) from. `None` where it is not finite.
    ///
    /// ```
    /// # use kutzbach_model as kutzbach;
    /// use kutzbach::mechanism::Frame;
    /// # fn found() -> Option<()> {
    /// let (up, side) = (Frame::at_point([0.0, 0.0, 3.0])?, Frame::at_point([2.0, 0.0, 0.0])?);
    /// let found = Frame::between(&[&side], &[&up, &side])?;
    /// assert_eq!(found, up);
    /// # Some(()) }
    /// # assert!(found().is_some());
    /// ```
    #[must_use]
    pub fn between(from: &[&Self], to: &[&Self]) -> Option<Self> {
        let found = between::<Number>(from, to).or_else(|| between::<f64>(from, to))?;
        Some(found.derived_from(Self::inputs_between(from, to)))
    }
}

fn between<R: Real>(from: &[&Frame], to: &[&Frame]) -> Option<Frame> {
    let along = |chain: &[&Frame]| {
        chain
            .iter()
            .try_fold(Pose::identity(), |pose: Pose<R>, frame| {
                Some(pose.then(&Pose::of(frame)?))
            })
    };
    along(from)?.inverse().then(&along(to)?).frame()
}

/// The links and the joints that place them.
struct Tree<'a> {
    links: &'a [Link],
    joints: &'a [Joint],
}

impl Tree<'_> {
    /// The joint's frame seen from both sides.
    fn frames<R: Real>(
        &self,
        anchor: LinkId,
        spec: &HomeFrame,
        sides: [LinkId; 2],
    ) -> Option<[Frame; 2]> {
        let own = Pose::<R>::of(&spec.frame)?;
        let [first, second] = sides;
        let side = |link: LinkId| {
            let mut seen = self.between(link, anchor)?.then(&own);
            if spec.parallel_to_root {
                seen.rotation = self.of_root(link)?.inverse().rotation;
            }
            // What is given in a side's own frame stays as it was written.
            if link == anchor && !spec.parallel_to_root {
                return Some(spec.frame.clone());
            }
            seen.frame()
        };
        Some([side(first)?, side(second)?])
    }

    /// The joint's frame on the side of a link, as it was worked out, with the literals behind it.
    fn derived(&self, frame: Frame, link: LinkId, anchor: LinkId, spec: &HomeFrame) -> Frame {
        if link == anchor && !spec.parallel_to_root {
            return frame;
        }
        let mut steps = self.steps(link, anchor);
        steps.push(Step::to(&spec.frame));
        let mut inputs = inputs_along(&steps);
        if spec.parallel_to_root
            && let Some(root) = self.ancestors(link).last()
        {
            let [.., roll, pitch, yaw] = inputs_along(&self.steps(link, *root));
            let [x, y, z, ..] = inputs;
            inputs = [x, y, z, roll, pitch, yaw];
        }
        frame.derived_from(inputs)
    }

    /// The frames on the way from one link to another one.
    fn steps(&self, from: LinkId, to: LinkId) -> Vec<Step<'_>> {
        let [up, down] = self.apart(from, to);
        let up = up
            .into_iter()
            .flat_map(|link| self.steps_to(link).into_iter().rev());
        let down = down.into_iter().rev();
        up.map(Step::reversed)
            .chain(down.flat_map(|link| self.steps_to(link)))
            .collect()
    }

    /// The frames on the way to a link from what it is placed by.
    fn steps_to(&self, link: LinkId) -> Vec<Step<'_>> {
        match &self.links[link.0].placement {
            Placement::World => Vec::new(),
            Placement::Floating { origin, .. } => vec![Step::to(origin)],
            Placement::Joint(joint) => {
                let joint = &self.joints[joint.0];
                vec![
                    Step::to(&joint.predecessor.frame),
                    Step::back_from(&joint.successor.frame),
                ]
            }
        }
    }

    /// The links from one up to the root.
    fn ancestors(&self, link: LinkId) -> Vec<LinkId> {
        let mut chain = vec![link];
        let mut at = link;
        while let Some(parent) = placed_by(&self.links[at.0], self.joints) {
            chain.push(parent);
            at = parent;
        }
        chain
    }

    /// The links from each of two up to their nearest common ancestor, which is left out.
    fn apart(&self, from: LinkId, to: LinkId) -> [Vec<LinkId>; 2] {
        let (mut up, mut down) = (self.ancestors(from), self.ancestors(to));
        while let (Some(a), Some(b)) = (up.last(), down.last()) {
            if a != b {
                break;
            }
            up.pop();
            down.pop();
        }
        [up, down]
    }

    /// The pose of `to` at home, seen from `from`.
    fn between<R: Real>(&self, from: LinkId, to: LinkId) -> Option<Pose<R>> {
        let [up, down] = self.apart(from, to);
        let along = |chain: &[LinkId]| {
            chain
                .iter()
                .rev()
                .try_fold(Pose::identity(), |pose: Pose<R>, link| {
                    Some(pose.then(&self.in_parent(*link)?))
                })
        };
        Some(along(&up)?.inverse().then(&along(&down)?))
    }

    fn of_root<R: Real>(&self, link: LinkId) -> Option<Pose<R>> {
        let root = *self.ancestors(link).last()?;
        self.between(root, link)
    }

    /// The pose of a link at home, seen from the link it is placed by.
    fn in_parent<R: Real>(&self, link: LinkId) -> Option<Pose<R>> {
        match &self.links[link.0].placement {
            Placement::World => Some(Pose::identity()),
            Placement::Floating { origin, .. } => Pose::of(origin),
            Placement::Joint(joint) => {
                let joint = &self.joints[joint.0];
                let successor = Pose::of(&joint.successor.frame)?;
                Some(Pose::of(&joint.predecessor.frame)?.then(&successor.inverse()))
            }
        }
    }
}

/// Numbers that poses are computed with.
trait Real: Clone + Add<Output = Self> + Mul<Output = Self> + Neg<Output = Self> {
    fn zero() -> Self;
    fn one() -> Self;
    /// `None` where the number or its cosine and sine are not at hand in this arithmetic.
    fn of(number: &Number) -> Option<Self>;
    fn cos_sin(angle: &Number) -> Option<(Self, Self)>;
    fn number(&self) -> Option<Number>;
    /// Roll, pitch and yaw of a rotation.
    fn angles(rotation: &[[Self; 3]; 3]) -> Option<[Number; 3]>;
}

impl Real for f64 {
    fn zero() -> Self {
        0.0
    }

    fn one() -> Self {
        1.0
    }

    fn of(number: &Number) -> Option<Self> {
        Some(number.value())
    }

    fn cos_sin(angle: &Number) -> Option<(Self, Self)> {
        // Of a fraction they have no closed form, and are not worth many digits.
        if angle.rational().is_some() {
            let (sin, cos) = angle.value().sin_cos();
            return Some((cos, sin));
        }
        let (cos, sin) = angle.cos_sin();
        Some((cos.value(), sin.value()))
    }

    fn number(&self) -> Option<Number> {
        Number::from_f64(*self)
    }

    /// Yaw first, and pitch and roll of what remains, which holds for whatever yaw rounding leaves where pitch is ±90°.
    fn angles(r: &[[f64; 3]; 3]) -> Option<[Number; 3]> {
        let yaw = f64::atan2(r[1][0], r[0][0]);
        let (sin, cos) = yaw.sin_cos();
        let pitch = f64::atan2(-r[2][0], cos * r[0][0] + sin * r[1][0]);
        let roll = f64::atan2(sin * r[0][2] - cos * r[1][2], cos * r[1][1] - sin * r[0][1]);
        Some([roll.number()?, pitch.number()?, yaw.number()?])
    }
}

impl Real for Number {
    fn zero() -> Self {
        Number::zero()
    }

    fn one() -> Self {
        Number::one()
    }

    fn of(number: &Number) -> Option<Self> {
        closed(number.clone())
    }

    fn cos_sin(angle: &Number) -> Option<(Self, Self)> {
        let (cos, sin) = angle.cos_sin();
        Some((closed(cos)?, closed(sin)?))
    }

    fn number(&self) -> Option<Number> {
        closed(self.clone())
    }

    fn angles(r: &[[Number; 3]; 3]) -> Option<[Number; 3]> {
        let square = &r[0][0] * &r[0][0] + &r[1][0] * &r[1][0];
        let cos = square.sqrt().ok()?;
        let pitch = Number::atan2(&-&r[2][0], &cos).ok()?;
        if cos.is_zero() {
            // Yaw and roll turn about one axis; all of it is called roll.
            let roll = Number::atan2(&-&r[1][2], &r[1][1]).ok()?;
            return Some([roll, pitch, Number::zero()]);
        }
        let roll = Number::atan2(&r[2][1], &r[2][2]).ok()?;
        let yaw = Number::atan2(&r[1][0], &r[0][0]).ok()?;
        Some([roll, pitch, yaw])
    }
}

/// Numbers in closed form only, so that products of many rotations stay short.
fn closed(number: Number) -> Option<Number> {
    (number.exact().is_some() && number.size() == 1).then_some(number)
}

#[derive(Clone, Debug)]
struct Pose<R> {
    rotation: [[R; 3]; 3],
    position: [R; 3],
}

impl<R: Real> Pose<R> {
    fn identity() -> Self {
        let (zero, one) = (R::zero, R::one);
        Self {
            rotation: [
                [one(), zero(), zero()],
                [zero(), one(), zero()],
                [zero(), zero(), one()],
            ],
            position: [zero(), zero(), zero()],
        }
    }

    /// `R = Rz(yaw) Ry(pitch) Rx(roll)`, as [`Frame`] says.
    fn of(frame: &Frame) -> Option<Self> {
        let [roll, pitch, yaw] = &frame.roll_pitch_yaw;
        let turn = |axis: usize, angle: &Number| {
            let mut pose = Self::identity();
            if angle.is_zero() {
                return Some(pose);
            }
            let (cos, sin) = R::cos_sin(angle)?;
            let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
            pose.rotation[next][next] = cos.clone();
            pose.rotation[last][last] = cos;
            pose.rotation[next][last] = -sin.clone();
            pose.rotation[last][next] = sin;
            Some(pose)
        };
        let mut pose = turn(2, yaw)?.then(&turn(1, pitch)?).then(&turn(0, roll)?);
        for (coordinate, number) in pose.position.iter_mut().zip(&frame.position) {
            *coordinate = R::of(number)?;
        }
        Some(pose)
    }

    /// This pose, and from there another one.
    fn then(&self, other: &Self) -> Self {
        let dot = |row: &[R; 3], column: [&R; 3]| {
            let [a, b, c] = [0, 1, 2].map(|k| row[k].clone() * column[k].clone());
            a + b + c
        };
        let turned =
            |row: &[R; 3], column: usize| dot(row, [0, 1, 2].map(|k| &other.rotation[k][column]));
        let [x, y, z] = &other.position;
        let moved = |row: usize| dot(&self.rotation[row], [x, y, z]) + self.position[row].clone();
        Self {
            rotation: [0, 1, 2].map(|row| [0, 1, 2].map(|c| turned(&self.rotation[row], c))),
            position: [0, 1, 2].map(moved),
        }
    }

    fn inverse(&self) -> Self {
        let transposed = [0, 1, 2].map(|row| [0, 1, 2].map(|c| self.rotation[c][row].clone()));
        let turned = Self {
            rotation: transposed,
            position: [R::zero(), R::zero(), R::zero()],
        };
        let mut back = Self::identity();
        back.position = [0, 1, 2].map(|k| -self.position[k].clone());
        turned.then(&back)
    }

    fn frame(&self) -> Option<Frame> {
        let [x, y, z] = &self.position;
        Some(Frame {
            position: [x.number()?, y.number()?, z.number()?],
            roll_pitch_yaw: R::angles(&self.rotation)?,
        })
    }
}
