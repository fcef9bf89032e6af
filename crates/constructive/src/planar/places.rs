//! The plane that everything moves in.

use super::body::{Exact, Pair};
use super::{NotPlanar, is_element, millimetres};
use kutzbach_math::number::Number;
use kutzbach_math::space::Rigid;
use kutzbach_model::mechanism::{ExactPose, Joint, JointKind, Mechanism, Side};

type Exact3 = [Number; 3];

/// Two directions of the plane with their lengths, and its normal.
#[derive(Clone, Debug)]
pub(super) struct View {
    across: [(Exact3, Number); 2],
    normal: Exact3,
}

fn dot(a: &Exact3, b: &Exact3) -> Number {
    let [x, y, z] = [0, 1, 2].map(|i| &a[i] * &b[i]);
    &(&x + &y) + &z
}

fn cross(a: &Exact3, b: &Exact3) -> Exact3 {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &(&a[i] * &b[j]) - &(&a[j] * &b[i]))
}

fn is_zero(a: &Exact3) -> bool {
    a.iter().all(Number::is_zero)
}

impl View {
    /// Along the first hinge, y before z before x upwards.
    pub(super) fn of(mechanism: &Mechanism, homes: &[ExactPose]) -> Result<Self, NotPlanar> {
        let hinge = mechanism
            .joints()
            .iter()
            .find(|j| j.kind == JointKind::Revolute)
            .ok_or(NotPlanar::NoHinge)?;
        let normal = direction(hinge, &hinge.predecessor, homes);
        let up = [1, 2, 0]
            .map(|axis| [0, 1, 2].map(|i| Number::integer(i64::from(i == axis))))
            .into_iter()
            .find(|e| !is_zero(&cross(e, &normal)))
            .ok_or(NotPlanar::NoHinge)?;
        let right = cross(&up, &normal);
        let up = cross(&normal, &right);
        let long = |v: Exact3| -> Result<(Exact3, Number), NotPlanar> {
            let length = dot(&v, &v).sqrt().map_err(|_| NotPlanar::NoHinge)?;
            Ok((v, length))
        };
        Ok(Self {
            across: [long(right)?, long(up)?],
            normal,
        })
    }

    /// Both sides of a joint are equally far along the hinges and have the same side up: motions in the plane change neither.
    pub(super) fn check_normal(&self, joint: &Joint, homes: &[ExactPose]) -> Result<(), NotPlanar> {
        let sides = [&joint.predecessor, &joint.successor];
        let poses = sides.map(|s| homes[s.link.0].then(&ExactPose::of(&s.frame)));
        let [up, other_up] = [0, 1].map(|k| poses[k].inverse().rotate(&self.normal));
        if up != other_up {
            return Err(NotPlanar::TurnedOver {
                joint: joint.name.clone(),
            });
        }
        let [one, other] = [0, 1].map(|k| dot(&poses[k].translation, &self.normal));
        let off = &one - &other;
        if off.is_zero() {
            return Ok(());
        }
        let [x, y, z] = self.normal.clone().map(|n| n.value());
        let metres = off.value().abs() / x.hypot(y).hypot(z);
        Err(NotPlanar::Offset {
            joint: joint.name.clone(),
            gap: millimetres(metres),
        })
    }

    /// Coordinates in the plane.
    fn seen(&self, v: &Exact3) -> Option<Pair> {
        let [x, y] = [0, 1].map(|k| {
            let (axis, length) = &self.across[k];
            dot(v, axis).checked_div(length).ok()
        });
        Some([x?, y?])
    }

    /// The motion in space that turns the plane by an angle with this cosine and sine about the origin and then shifts it.
    pub(super) fn lifted(&self, [c, s]: [f64; 2], shift: [f64; 2]) -> Rigid<f64> {
        let [x, y] = [0, 1].map(|k| {
            let (axis, length) = &self.across[k];
            axis.clone().map(|e| e.value() / length.value())
        });
        let z = kutzbach_math::space::cross(&x, &y);
        // B diag(turn, 1) Bᵀ, with B = (x, y, z).
        let entry = |i: usize, j: usize| {
            c * (x[i] * x[j] + y[i] * y[j]) + s * (y[i] * x[j] - x[i] * y[j]) + z[i] * z[j]
        };
        Rigid {
            rotation: [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j))),
            translation: [0, 1, 2].map(|i| shift[0] * x[i] + shift[1] * y[i]),
        }
    }

    /// What a joint is on one of its sides, as drawn.
    pub(super) fn element(
        &self,
        joint: &Joint,
        side: &Side,
        homes: &[ExactPose],
    ) -> Result<Exact, NotPlanar> {
        let name = || joint.name.clone();
        if !is_element(joint.kind) {
            let kind = joint.kind.word();
            return Err(NotPlanar::Kind {
                joint: name(),
                kind,
            });
        }
        let axis = direction(joint, side, homes);
        let at = homes[side.link.0]
            .then(&ExactPose::of(&side.frame))
            .translation;
        let fits = match joint.kind {
            JointKind::Revolute => is_zero(&cross(&axis, &self.normal)),
            _ => dot(&axis, &self.normal).is_zero(),
        };
        let off = || NotPlanar::Axis { joint: name() };
        let at = self.seen(&at).filter(|_| fits).ok_or_else(off)?;
        Ok(match joint.kind {
            JointKind::Revolute => Exact::Point(at),
            _ => Exact::Line(at, self.seen(&axis).ok_or_else(off)?),
        })
    }
}

/// The axis as drawn; its components are the same in the joint's frames on both sides.
fn direction(joint: &Joint, side: &Side, homes: &[ExactPose]) -> Exact3 {
    let pose = homes[side.link.0].then(&ExactPose::of(&side.frame));
    pose.rotate(&joint.axis.0)
}
