//! Joints as scalar constraints between two bodies, with first and second derivatives in closed form.
//!
//! Every kind of joint is a set of rows of five forms. With frames A on the predecessor and B on the successor, d from the origin of A to
//! that of B, and directions u fixed in A and w fixed in B:
//!
//! | row | says | for |
//! |---|---|---|
//! | offset | u·d = 0, or w·d = 0 | points that stay on a point, a line or a plane |
//! | across | u·w = c | directions that keep their angle |
//! | reach | d·d = L² | the rod of a distance joint |
//! | helix | e·d = p θ | screws |
//! | coordinate | Σ f θ = c(t) | couplings, drives |
//!
//! So joints with two or three axes need no small bodies in between. Lengths are divided by the mechanism's.

use kutzbach_closure::JointDisplacement;
use kutzbach_model::mechanism::JointKind;
use nalgebra::{Matrix3, Vector3};

type Vector = Vector3<f64>;

/// A point of a body: the ground is the last one.
#[derive(Clone, Debug)]
pub(super) struct Side {
    pub body: usize,
    /// From the centre of mass and along the principal axes (m).
    pub at: Vector,
}

/// A joint between two bodies; its directions are given along the bodies' own axes.
#[derive(Clone, Debug)]
pub(super) struct Held {
    pub sides: [Side; 2],
    pub rows: Vec<Row>,
}

#[derive(Clone, Debug)]
pub(super) enum Row {
    /// A direction fixed on one side.
    Offset { side: usize, along: Vector },
    /// Directions on either side, and the cosine of their angle.
    Across {
        near: Vector,
        far: Vector,
        cosine: f64,
    },
    /// The distance (m).
    Reach(f64),
    /// Axis, and travel in a turn by a radian (m).
    Helix { turning: Turning, pitch: f64 },
}

/// The turn of the far side about an axis that both sides share, counted over whole turns from a value before.
#[derive(Clone, Debug)]
pub(super) struct Turning {
    /// On the near side.
    axis: Vector,
    /// Two directions across it, on each side.
    across: [[Vector; 2]; 2],
    /// A turn less than half a turn away (rad).
    pub near: f64,
}

/// How two sides stand.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed {
    /// `world_from_body`.
    pub turns: [Matrix3<f64>; 2],
    /// From each body's centre of mass to its frame's origin (m).
    pub arms: [Vector; 2],
    /// From the first origin to the second (m).
    pub apart: Vector,
}

/// How two sides move: angular velocities, and how the second origin moves and is accelerated against the first where no body is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moving {
    pub turning: [Vector; 2],
    pub sliding: Vector,
    pub centripetal: Vector,
}

/// A row's derivatives: by velocities of the centres of mass and by angular velocities, in the world.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gradient {
    pub linear: [Vector; 2],
    pub angular: [Vector; 2],
}

impl Turning {
    /// About an axis that is given in both joint frames, with the rotations `body_from_joint`.
    pub fn new(axis: &[f64; 3], near: f64, turns: &[Matrix3<f64>; 2]) -> Self {
        let (first, second) = kutzbach_closure::across(axis);
        Self {
            axis: turns[0] * Vector::from(*axis),
            across: turns.map(|turn| [turn * Vector::from(first), turn * Vector::from(second)]),
            near,
        }
    }

    /// The turn (rad).
    pub fn angle(&self, placed: &Placed) -> f64 {
        let [a, b] = [0, 1].map(|side| self.across[side].map(|v| placed.turns[side] * v));
        let sine = b[0].dot(&a[1]) - b[1].dot(&a[0]);
        let cosine = b[0].dot(&a[0]) + b[1].dot(&a[1]);
        let angle = sine.atan2(cosine);
        let turns = ((self.near - angle) / std::f64::consts::TAU).round();
        angle + turns * std::f64::consts::TAU
    }

    /// The axis in the world.
    pub fn direction(&self, placed: &Placed) -> Vector {
        placed.turns[0] * self.axis
    }
}

impl Held {
    /// Where the two sides are, given every body's rotation and centre.
    pub fn place(&self, rotations: &[Matrix3<f64>], centres: &[Vector]) -> Placed {
        let [a, b] = &self.sides;
        let arms = [a, b].map(|side| rotations[side.body] * side.at);
        Placed {
            turns: [a, b].map(|side| rotations[side.body]),
            arms,
            apart: (centres[b.body] - centres[a.body]) + (arms[1] - arms[0]),
        }
    }

    /// How they move, given every body's velocity and angular velocity in the world.
    pub fn motion(&self, placed: &Placed, velocities: &[Vector], spins: &[Vector]) -> Moving {
        let [a, b] = [self.sides[0].body, self.sides[1].body];
        let (turning, arms) = ([spins[a], spins[b]], &placed.arms);
        let swept = [0, 1].map(|i| turning[i].cross(&arms[i]));
        Moving {
            turning,
            sliding: velocities[b] - velocities[a] + swept[1] - swept[0],
            centripetal: turning[1].cross(&swept[1]) - turning[0].cross(&swept[0]),
        }
    }
}

/// d/dx of u·d for a direction fixed on the first side (`sign` 1) or the second.
pub(super) fn along(direction: Vector, side: usize, placed: &Placed) -> Gradient {
    let [a, b] = &placed.arms;
    let carried = direction.cross(&placed.apart);
    let mut angular = [-a.cross(&direction), b.cross(&direction)];
    // (ω × u)·d = ω·(u × d), for the side that carries u.
    angular[side] += carried;
    Gradient {
        linear: [-direction, direction],
        angular,
    }
}

/// What accelerations of the bodies leave out of the second derivative of u·d.
pub(super) fn along_bias(direction: Vector, side: usize, placed: &Placed, moving: &Moving) -> f64 {
    let spin = moving.turning[side];
    let swept = spin.cross(&direction);
    spin.cross(&swept).dot(&placed.apart)
        + 2.0 * swept.dot(&moving.sliding)
        + direction.dot(&moving.centripetal)
}

impl Row {
    /// How far it is from being kept (lengths in metres).
    pub fn value(&self, placed: &Placed) -> f64 {
        match self {
            Self::Offset { side, along } => (placed.turns[*side] * along).dot(&placed.apart),
            Self::Across { near, far, cosine } => {
                (placed.turns[0] * near).dot(&(placed.turns[1] * far)) - cosine
            }
            Self::Reach(length) => (placed.apart.norm_squared() - length * length) / (2.0 * length),
            Self::Helix { turning, pitch } => {
                turning.direction(placed).dot(&placed.apart) - pitch * turning.angle(placed)
            }
        }
    }

    /// Its derivatives.
    pub fn gradient(&self, placed: &Placed) -> Gradient {
        match self {
            Self::Offset { side, along: u } => along(placed.turns[*side] * u, *side, placed),
            Self::Across { near, far, .. } => {
                let normal = (placed.turns[0] * near).cross(&(placed.turns[1] * far));
                Gradient {
                    linear: [Vector::zeros(); 2],
                    angular: [normal, -normal],
                }
            }
            Self::Reach(length) => {
                let direction = placed.apart / *length;
                let [a, b] = &placed.arms;
                Gradient {
                    linear: [-direction, direction],
                    angular: [-a.cross(&direction), b.cross(&direction)],
                }
            }
            Self::Helix { turning, pitch } => {
                let axis = turning.direction(placed);
                let mut gradient = along(axis, 0, placed);
                gradient.angular[0] += *pitch * axis;
                gradient.angular[1] -= *pitch * axis;
                gradient
            }
        }
    }

    /// What its second derivative has beside its gradient times the accelerations.
    pub fn bias(&self, placed: &Placed, moving: &Moving) -> f64 {
        let [first, second] = &moving.turning;
        match self {
            Self::Offset { side, along } => {
                along_bias(placed.turns[*side] * along, *side, placed, moving)
            }
            Self::Across { near, far, .. } => {
                let (u, w) = (placed.turns[0] * near, placed.turns[1] * far);
                let (of_u, of_w) = (first.cross(&u), second.cross(&w));
                first.cross(&of_u).dot(&w) + 2.0 * of_u.dot(&of_w) + u.dot(&second.cross(&of_w))
            }
            Self::Reach(length) => {
                (moving.sliding.norm_squared() + placed.apart.dot(&moving.centripetal)) / length
            }
            // The turn's rate is e·(ω₂ − ω₁), and ė is across that difference wherever the joint's other rows are kept.
            Self::Helix { turning, .. } => along_bias(turning.direction(placed), 0, placed, moving),
        }
    }

    /// Whether it is a length.
    pub fn is_length(&self) -> bool {
        !matches!(self, Self::Across { .. })
    }
}

/// The rows of a joint: six less its freedoms. `value` is its screw's turn at the start; `turns` are `body_from_joint`.
pub(super) fn rows_of(
    joint: &JointDisplacement<f64>,
    (pitch, value): (f64, f64),
    turns: &[Matrix3<f64>; 2],
) -> Vec<Row> {
    use JointKind as K;
    const X: [f64; 3] = [1.0, 0.0, 0.0];
    const Y: [f64; 3] = [0.0, 1.0, 0.0];
    const Z: [f64; 3] = [0.0, 0.0, 1.0];
    let e = *joint.axis();
    let w = *joint.second_axis();
    let offset = |side: usize, along: [f64; 3]| Row::Offset {
        side,
        along: turns[side] * Vector::from(along),
    };
    let at_point = || [X, Y, Z].map(|u| offset(0, u)).to_vec();
    let across = |near: [f64; 3], far: [f64; 3]| Row::Across {
        near: turns[0] * Vector::from(near),
        far: turns[1] * Vector::from(far),
        cosine: Vector::from(near).dot(&Vector::from(far)),
    };
    let (y, z) = if joint.kind().uses_axis() {
        kutzbach_closure::across(&e)
    } else {
        (Y, Z)
    };
    let one_axis = || vec![across(y, e), across(z, e)];
    // Near parallel frames the three products are the rotation's components.
    let no_turn = || vec![across(X, Y), across(Y, Z), across(Z, X)];
    let helix = || Row::Helix {
        turning: Turning::new(&e, value, turns),
        pitch,
    };
    match joint.kind() {
        K::Fixed => [at_point(), no_turn()].concat(),
        K::Revolute => [at_point(), one_axis()].concat(),
        K::Prismatic => [vec![offset(0, y), offset(0, z)], no_turn()].concat(),
        K::Cylindrical => [vec![offset(0, y), offset(0, z)], one_axis()].concat(),
        K::Screw => [vec![offset(0, y), offset(0, z), helix()], one_axis()].concat(),
        K::Universal => [at_point(), vec![across(e, w)]].concat(),
        K::Planar => [vec![offset(0, e)], one_axis()].concat(),
        K::PlanarTranslation => [vec![offset(0, e)], no_turn()].concat(),
        K::Translational => no_turn(),
        K::TranslatingScrew => [vec![helix()], one_axis()].concat(),
        K::Schoenflies => one_axis(),
        K::Spherical => at_point(),
        K::PointOnLine => {
            let (u, v) = kutzbach_closure::across(&w);
            vec![offset(1, u), offset(1, v)]
        }
        K::PointOnPlane => vec![offset(1, w)],
        K::LineOnPlane => vec![
            offset(1, w),
            Row::Across {
                near: turns[0] * Vector::from(e),
                far: turns[1] * Vector::from(w),
                cosine: 0.0,
            },
        ],
        K::Distance => vec![Row::Reach(*joint.distance())],
    }
}

/// Whether all directions of the rows are numbers, and no rod has no length.
pub(super) fn sound(rows: &[Row]) -> bool {
    let finite = |v: &Vector| v.iter().all(|x| x.is_finite());
    rows.iter().all(|row| match row {
        Row::Offset { along, .. } => finite(along),
        Row::Across { near, far, cosine } => finite(near) && finite(far) && cosine.is_finite(),
        Row::Reach(length) => *length > 1e-100,
        Row::Helix { turning, pitch } => finite(&turning.axis) && pitch.is_finite(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use kutzbach_closure::{JointState, Rigid};

    const KINDS: [JointKind; 16] = [
        JointKind::Fixed,
        JointKind::Revolute,
        JointKind::Prismatic,
        JointKind::Screw,
        JointKind::Cylindrical,
        JointKind::Universal,
        JointKind::PlanarTranslation,
        JointKind::Planar,
        JointKind::Spherical,
        JointKind::Translational,
        JointKind::TranslatingScrew,
        JointKind::Schoenflies,
        JointKind::PointOnLine,
        JointKind::LineOnPlane,
        JointKind::PointOnPlane,
        JointKind::Distance,
    ];

    fn joint(kind: JointKind) -> JointDisplacement<f64> {
        JointDisplacement::new(kind, &[0.2, -0.3, 0.9], &[0.7, 0.5, -0.1], &0.3, &1.3)
    }

    fn matrix(rigid: &Rigid<f64>) -> Matrix3<f64> {
        Matrix3::from_fn(|i, j| rigid.rotation[i][j])
    }

    /// `body_from_joint` on either side.
    fn frames() -> [Matrix3<f64>; 2] {
        [0.5, 1.5].map(|x| matrix(&Rigid::exponential(&[x, -0.4, 0.3 * x], &[0.0; 3])))
    }

    /// Two bodies that move as given, with frames off their centres of mass.
    fn held(kind: JointKind, value: f64) -> Held {
        let turns = frames();
        Held {
            sides: [0, 1].map(|body| Side {
                body,
                at: Vector::new(0.3, -0.2, 0.5) * (1.0 + body as f64),
            }),
            rows: rows_of(&joint(kind), (0.3, value), &turns),
        }
    }

    /// Rotations and centres of the two bodies where the joint is at a state and the first body stands somewhere.
    fn stand(held: &Held, first: &Rigid<f64>, reached: &Rigid<f64>) -> [(Matrix3<f64>, Vector); 2] {
        let [a, b] = &held.sides;
        let (rotation, centre) = (matrix(first), Vector::from(first.translation));
        let [near, far] = frames();
        let turn = rotation * near * matrix(reached) * far.transpose();
        let origin = centre + rotation * a.at + rotation * near * Vector::from(reached.translation);
        [(rotation, centre), (turn, origin - turn * b.at)]
    }

    fn place(held: &Held, bodies: &[(Matrix3<f64>, Vector); 2]) -> Placed {
        held.place(&[bodies[0].0, bodies[1].0], &[bodies[0].1, bodies[1].1])
    }

    /// The joint's state after a time in which its variables run quadratically.
    fn state(joint: &JointDisplacement<f64>, time: f64) -> JointState<f64> {
        let mut state = joint.at(&[0.4, -0.2, 0.3, 0.5, -0.1][..joint.freedom()]);
        let rates = [0.7, 0.4, -0.6, 0.2, 0.9].map(|rate| rate * (time + 0.5 * time * time));
        joint.advance(&mut state, &rates[..joint.freedom()]);
        state
    }

    #[test]
    fn rows_are_as_many_as_freedoms_are_taken_and_hold_wherever_the_joint_can_go() {
        for kind in KINDS {
            let (joint, held) = (joint(kind), held(kind, 0.4));
            assert_eq!(held.rows.len() + joint.freedom(), 6, "{kind:?}");
            assert!(sound(&held.rows));
            let first = Rigid::exponential(&[0.3, 0.8, -0.5], &[1.0, 2.0, -1.0]);
            for time in [0.0, 0.5, 1.3] {
                let reached = joint.displacement(&state(&joint, time));
                let placed = place(&held, &stand(&held, &first, &reached));
                for row in &held.rows {
                    assert!(row.value(&placed).abs() < 1e-14, "{kind:?} {row:?}");
                }
            }
        }
    }

    /// Both derivatives of every row, along any motion of the two bodies, against differences of its values.
    #[test]
    fn derivatives_are_those_of_the_values() {
        for kind in KINDS {
            let (joint, held) = (joint(kind), held(kind, 0.4));
            // The joint is kept along the motion, as it has to be where a turn's second derivative is taken.
            let at = |time: f64| {
                let first = Rigid::exponential(
                    &[0.3 + time, 0.8, -0.5 * time],
                    &[1.0, 2.0 * time, -1.0 + time * time],
                );
                stand(&held, &first, &joint.displacement(&state(&joint, time)))
            };
            let h = 1e-4;
            let [before, here, after] = [-h, 0.0, h].map(at);
            let rate = |body: usize| {
                let change =
                    (after[body].0 - before[body].0) / (2.0 * h) * here[body].0.transpose();
                Vector::new(change[(2, 1)], change[(0, 2)], change[(1, 0)])
            };
            let spins = [rate(0), rate(1)];
            let speeds = [0, 1].map(|body| (after[body].1 - before[body].1) / (2.0 * h));
            let placed = place(&held, &here);
            let moving = held.motion(&placed, &speeds, &spins);
            let accelerations = [0, 1].map(|body| {
                let bent = (after[body].1 - 2.0 * here[body].1 + before[body].1) / (h * h);
                let turned = (after[body].0 - 2.0 * here[body].0 + before[body].0) / (h * h)
                    * here[body].0.transpose();
                let skew = (turned - turned.transpose()) * 0.5;
                (bent, Vector::new(skew[(2, 1)], skew[(0, 2)], skew[(1, 0)]))
            });
            for row in &held.rows {
                let gradient = row.gradient(&placed);
                let sum = |linear: [Vector; 2], angular: [Vector; 2]| -> f64 {
                    (0..2)
                        .map(|i| {
                            gradient.linear[i].dot(&linear[i])
                                + gradient.angular[i].dot(&angular[i])
                        })
                        .sum()
                };
                assert!(sum(speeds, spins).abs() < 1e-6, "{kind:?} {row:?}");
                let [(a, alpha), (b, beta)] = accelerations;
                let second = sum([a, b], [alpha, beta]) + row.bias(&placed, &moving);
                assert!(second.abs() < 1e-5, "{kind:?} {row:?}: {second}");
                assert!(
                    gradient_is_that_of_values(&held, row, &here),
                    "{kind:?} {row:?}"
                );
            }
        }
    }

    /// Moves each body along and about each axis, off what the joint allows.
    fn gradient_is_that_of_values(
        held: &Held,
        row: &Row,
        here: &[(Matrix3<f64>, Vector); 2],
    ) -> bool {
        let gradient = row.gradient(&place(held, here));
        let h = 1e-5;
        (0..12).all(|k| {
            let (body, axis) = (k / 6, Vector::ith(k % 3, 1.0));
            let turns = k % 6 >= 3;
            let value = |step: f64| {
                let mut moved = *here;
                if turns {
                    let turn = Rigid::exponential(&(axis * step).into(), &[0.0; 3]);
                    moved[body].0 = matrix(&turn) * moved[body].0;
                } else {
                    moved[body].1 += axis * step;
                }
                row.value(&place(held, &moved))
            };
            let numeric = (value(h) - value(-h)) / (2.0 * h);
            let wanted = match turns {
                true => gradient.angular[body].dot(&axis),
                false => gradient.linear[body].dot(&axis),
            };
            (numeric - wanted).abs() < 1e-8
        })
    }
}
