//! Joints taken apart into what the physics engine can hold.
//!
//! The engine holds joints that lock some of the six axes of a frame (x along the axis), and in its multibodies one linear
//! relation between two coordinates. So
//!
//! | joint | held as |
//! |---|---|
//! | fixed, R, P, C, S, planar, T2, T3, X | one joint with the matching axes free |
//! | screw, Y | cylindrical or X joint whose travel is tied to its turn: multibody only |
//! | universal | R, small body, R: locking two angular axes is no universal joint |
//! | line on plane | R about the line, small body, planar in the plane |
//! | distance | S, rod, S; the rod's spin is idle |
//! | point on line, point on plane | one joint with the line or plane on the first body |
//!
//! All frames are baked: at the start pose the two frames of a joint coincide wherever it closes, so that every coordinate
//! starts at zero and counts from there.

use super::convert::{along, turn};
use kutzbach_closure::{Geometry, JointDisplacement, JointState, Rigid, cross_product};
use kutzbach_model::mechanism::{JointKind, Mechanism};

/// Axes of a joint frame, as bits: x, y, z, then the rotations about them.
pub(super) mod axes {
    pub const X: u8 = 1;
    pub const Y: u8 = 1 << 1;
    pub const Z: u8 = 1 << 2;
    pub const TURN_X: u8 = 1 << 3;
    pub const TRANSLATIONS: u8 = 0b111;
    pub const ROTATIONS: u8 = 0b11_1000;
}

/// One joint as the engine holds it. Frames are given in the bodies' link frames.
#[derive(Clone, Debug)]
pub(super) struct Elementary {
    /// The mechanism's joint that it is (a part of).
    pub joint: usize,
    /// First and second body.
    pub bodies: [usize; 2],
    /// `body_from_joint` on either side.
    pub frames: [Rigid<f64>; 2],
    /// The free axes.
    pub free: u8,
    /// Travel along x per turn about x (m/rad), where the two are tied together.
    pub pitch: Option<f64>,
    /// Whether a multibody can hold it with either body as the parent.
    pub reducible: bool,
}

/// Where the rate of one freedom of a joint is felt: along or about an axis of a frame on the first body, as motion of the
/// second body's frame origin, times a sign.
#[derive(Clone, Debug)]
pub(super) struct Handle {
    pub bodies: [usize; 2],
    pub frames: [Rigid<f64>; 2],
    /// 0 to 5.
    pub axis: usize,
    pub sign: f64,
}

/// A small body between two halves of a joint.
#[derive(Clone, Debug)]
pub(super) struct Intermediate {
    /// The joint it belongs to.
    pub joint: usize,
    /// `world_from_body` at the start.
    pub pose: Rigid<f64>,
    /// Its extent (m): the length of a rod, zero for a body at a point.
    pub length: f64,
    /// The two links that it connects.
    pub links: [usize; 2],
}

/// A mechanism taken apart. Bodies are the links, by index, then the intermediate ones.
#[derive(Clone, Debug, Default)]
pub(super) struct TakenApart {
    pub joints: Vec<Elementary>,
    pub intermediates: Vec<Intermediate>,
    /// By joint and freedom.
    pub handles: Vec<Vec<Handle>>,
    /// The idle spin of a distance joint's rod, by joint. It has no part in the joint's variables; while one of them is
    /// driven it has to rest.
    pub spins: Vec<Option<Handle>>,
}

impl TakenApart {
    /// Takes a mechanism apart at a pose. `poses` are the links' poses there.
    pub fn new(
        mechanism: &Mechanism,
        geometry: &Geometry<f64>,
        states: &[JointState<f64>],
        poses: &[Rigid<f64>],
    ) -> Self {
        let mut apart = Self::default();
        for (index, joint) in mechanism.joints().iter().enumerate() {
            let links = [joint.predecessor.link.0, joint.successor.link.0];
            let taking = Taking {
                index,
                links,
                sides: &geometry.sides[index],
                displacement: &geometry.displacements[index],
                state: &states[index],
                pitch: joint
                    .lead
                    .as_ref()
                    .map_or(0.0, |lead| lead.value() / std::f64::consts::TAU),
                pose: &poses[links[0]],
                next_body: poses.len() + apart.intermediates.len(),
            };
            let part = taking.apart();
            apart.joints.extend(part.joints);
            apart.intermediates.extend(part.intermediates);
            apart.handles.push(part.handles);
            apart.spins.push(part.spin);
        }
        apart
    }
}

struct Taking<'a> {
    index: usize,
    links: [usize; 2],
    sides: &'a [Rigid<f64>; 2],
    displacement: &'a JointDisplacement<f64>,
    state: &'a JointState<f64>,
    pitch: f64,
    pose: &'a Rigid<f64>,
    next_body: usize,
}

struct Part {
    joints: Vec<Elementary>,
    intermediates: Vec<Intermediate>,
    handles: Vec<Handle>,
    spin: Option<Handle>,
}

impl Taking<'_> {
    fn apart(&self) -> Part {
        use JointKind as K;
        use axes::{ROTATIONS, TRANSLATIONS, TURN_X, X, Y, Z};
        match self.displacement.kind() {
            K::Fixed => self.single(0, None, &[]),
            K::Revolute => self.single(TURN_X, None, &[3]),
            K::Prismatic => self.single(X, None, &[0]),
            K::Screw => self.single(X | TURN_X, Some(self.pitch), &[3]),
            K::Cylindrical => self.single(X | TURN_X, None, &[0, 3]),
            K::PlanarTranslation => self.single(Y | Z, None, &[1, 2]),
            K::Planar => self.single(Y | Z | TURN_X, None, &[1, 2, 3]),
            K::TranslatingScrew => self.single(TRANSLATIONS | TURN_X, Some(self.pitch), &[1, 2, 3]),
            K::Translational => self.translations(TRANSLATIONS),
            K::Schoenflies => self.translations(TRANSLATIONS | TURN_X),
            K::Spherical => self.ball(),
            K::PointOnLine => self.point_in(X | ROTATIONS),
            K::PointOnPlane => self.point_in(Y | Z | ROTATIONS),
            K::Universal => self.universal(),
            K::LineOnPlane => self.line_on_plane(),
            K::Distance => self.rod(),
        }
    }

    /// The predecessor's frame once the joint's displacement is applied, and the successor's: equal in the world.
    fn frames(&self) -> [Rigid<f64>; 2] {
        let reached = self.displacement.displacement(self.state);
        [self.sides[0].compose(&reached), self.sides[1].clone()]
    }

    fn elementary(
        &self,
        bodies: [usize; 2],
        frames: [Rigid<f64>; 2],
        free: u8,
        pitch: Option<f64>,
    ) -> Elementary {
        Elementary {
            joint: self.index,
            bodies,
            frames,
            free,
            pitch,
            reducible: true,
        }
    }

    /// Frames whose axes are, at the start, parallel to given ones in the predecessor's joint frame.
    fn aligned(&self, with: &Rigid<f64>) -> [Rigid<f64>; 2] {
        let turned = turn(&self.displacement.displacement(self.state))
            .inverse()
            .compose(with);
        self.frames().map(|frame| frame.compose(&turned))
    }

    fn felt(bodies: [usize; 2], frames: &[Rigid<f64>; 2], axis: usize) -> Handle {
        Handle {
            bodies,
            frames: frames.clone(),
            axis,
            sign: 1.0,
        }
    }

    fn single(&self, free: u8, pitch: Option<f64>, felt: &[usize]) -> Part {
        let axis = self.displacement.axis();
        let with = if free == 0 {
            Rigid::identity(&0.0)
        } else {
            along(axis)
        };
        let frames = self.aligned(&with);
        Part {
            spin: None,
            handles: felt
                .iter()
                .map(|&a| Self::felt(self.links, &frames, a))
                .collect(),
            joints: vec![self.elementary(self.links, frames, free, pitch)],
            intermediates: vec![],
        }
    }

    /// All translations, along the predecessor's axes, and perhaps a turn.
    fn translations(&self, free: u8) -> Part {
        let plain = self.aligned(&Rigid::identity(&0.0));
        let mut handles: Vec<Handle> = (0..3)
            .map(|axis| Self::felt(self.links, &plain, axis))
            .collect();
        let mut frames = plain;
        if free & axes::TURN_X != 0 {
            frames = self.aligned(&along(self.displacement.axis()));
            handles.push(Self::felt(self.links, &frames, 3));
        }
        Part {
            spin: None,
            joints: vec![self.elementary(self.links, frames, free, None)],
            intermediates: vec![],
            handles,
        }
    }

    /// The three rates of a ball about axes of the second of two bodies, whose frames at the ball are given.
    fn ball_handles(bodies: [usize; 2], frames: &[Rigid<f64>; 2]) -> impl Iterator<Item = Handle> {
        let [first, second] = frames.clone();
        (3..6).map(move |axis| Handle {
            bodies: [bodies[1], bodies[0]],
            frames: [second.clone(), first.clone()],
            axis,
            sign: -1.0,
        })
    }

    fn ball(&self) -> Part {
        let frames = self.frames();
        Part {
            spin: None,
            handles: Self::ball_handles(self.links, &frames).collect(),
            joints: vec![self.elementary(self.links, frames, axes::ROTATIONS, None)],
            intermediates: vec![],
        }
    }

    /// A point of the predecessor in a line or plane of the successor: the successor comes first.
    fn point_in(&self, free: u8) -> Part {
        let bodies = [self.links[1], self.links[0]];
        let across = along(self.displacement.second_axis());
        let reached = turn(&self.displacement.displacement(self.state)).compose(&across);
        let frames = [
            self.sides[1].compose(&across),
            self.sides[0].compose(&reached),
        ];
        let mut handles: Vec<Handle> = (3..6)
            .map(|axis| Handle {
                bodies,
                frames: [self.sides[1].clone(), self.sides[0].clone()],
                axis,
                sign: -1.0,
            })
            .collect();
        let slides: &[usize] = if free & axes::X != 0 { &[0] } else { &[1, 2] };
        handles.extend(slides.iter().map(|&axis| Handle {
            bodies,
            frames: frames.clone(),
            axis,
            sign: -1.0,
        }));
        Part {
            spin: None,
            joints: vec![Elementary {
                reducible: false,
                ..self.elementary(bodies, frames, free, None)
            }],
            intermediates: vec![],
            handles,
        }
    }

    /// An intermediate body whose frame, seen from the predecessor's joint frame, is given.
    fn intermediate(&self, at: &Rigid<f64>, length: f64) -> Intermediate {
        Intermediate {
            joint: self.index,
            pose: self.pose.compose(&self.sides[0]).compose(at),
            length,
            links: self.links,
        }
    }

    fn universal(&self) -> Part {
        let (d, first) = (self.displacement, along(self.displacement.axis()));
        let second = along(d.second_axis());
        let between = d.at(&self.state.values[..1]);
        let turned = d.displacement(&between);
        let rest = turned.inverse().compose(&d.displacement(self.state));
        let bodies = [self.links[0], self.next_body, self.links[1]];
        let one = [self.sides[0].compose(&turned).compose(&first), first];
        let two = [rest.compose(&second), self.sides[1].compose(&second)];
        self.two_joints(
            bodies,
            self.intermediate(&turned, 0.0),
            (one, axes::TURN_X, &[3]),
            (two, axes::TURN_X, &[3]),
        )
    }

    fn line_on_plane(&self) -> Part {
        let (d, first) = (self.displacement, along(self.displacement.axis()));
        let second = along(d.second_axis());
        let between = d.displacement(&d.at(&self.state.values[..1]));
        // The turn about the line alone, without the tilt that brings the plane's normal across the line.
        let tilt = d.displacement(&d.home());
        let turned = between.compose(&tilt.inverse());
        let rest = between.inverse().compose(&d.displacement(self.state));
        let bodies = [self.links[0], self.next_body, self.links[1]];
        let one = [
            self.sides[0].compose(&turned).compose(&first),
            tilt.inverse().compose(&first),
        ];
        let back = turn(&rest).inverse().compose(&second);
        let two = [rest.compose(&back), self.sides[1].compose(&back)];
        self.two_joints(
            bodies,
            self.intermediate(&between, 0.0),
            (one, axes::TURN_X, &[3]),
            (two, axes::Y | axes::Z | axes::TURN_X, &[1, 2, 3]),
        )
    }

    fn two_joints(
        &self,
        bodies: [usize; 3],
        intermediate: Intermediate,
        (one, free_one, felt_one): ([Rigid<f64>; 2], u8, &[usize]),
        (two, free_two, felt_two): ([Rigid<f64>; 2], u8, &[usize]),
    ) -> Part {
        let (before, behind) = ([bodies[0], bodies[1]], [bodies[1], bodies[2]]);
        let felt = |bodies, frames: &[Rigid<f64>; 2], axes: &[usize]| -> Vec<Handle> {
            axes.iter()
                .map(|&axis| Self::felt(bodies, frames, axis))
                .collect()
        };
        let mut handles = felt(before, &one, felt_one);
        handles.extend(felt(behind, &two, felt_two));
        Part {
            spin: None,
            joints: vec![
                self.elementary(before, one, free_one, None),
                self.elementary(behind, two, free_two, None),
            ],
            intermediates: vec![intermediate],
            handles,
        }
    }

    /// A rod with a ball at either end; its frame sits in the middle, x along it.
    fn rod(&self) -> Part {
        let d = self.displacement;
        let length = *d.distance();
        let [near, far] = [-0.5 * length, 0.5 * length].map(|x| Rigid::translation([x, 0.0, 0.0]));
        let reached = d.displacement(self.state);
        let swung = swing(d, self.state);
        let pose = swung.compose(&far);
        let bodies = [self.links[0], self.next_body, self.links[1]];
        let one = [self.sides[0].compose(&swung), near];
        let rest = turn(&swung).inverse().compose(&turn(&reached));
        let two = [far.compose(&rest), self.sides[1].clone()];
        let mut turns = Self::ball_handles([bodies[0], bodies[1]], &one);
        let spin = turns.next();
        let mut handles: Vec<Handle> = turns.collect();
        handles.extend(Self::ball_handles([bodies[1], bodies[2]], &two));
        Part {
            spin,
            joints: vec![
                self.elementary([bodies[0], bodies[1]], one, axes::ROTATIONS, None),
                self.elementary([bodies[1], bodies[2]], two, axes::ROTATIONS, None),
            ],
            intermediates: vec![self.intermediate(&pose, length)],
            handles,
        }
    }
}

/// How the rod of a distance joint stands in the predecessor's joint frame: its first two freedoms turn it about its own
/// y and z axes.
fn swing(displacement: &JointDisplacement<f64>, state: &JointState<f64>) -> Rigid<f64> {
    let screws = displacement.screws(state);
    let [Some(y), Some(z)] = [0, 1].map(|i| screws.get(i).map(|screw| screw.angular)) else {
        return Rigid::identity(&0.0);
    };
    let x = cross_product(&y, &z);
    Rigid {
        rotation: [0, 1, 2].map(|i| [x[i], y[i], z[i]]),
        translation: [0.0; 3],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kutzbach_closure::Arithmetic;
    use kutzbach_math::number::Number;
    use kutzbach_model::mechanism::{Direction, JointBuilder, MechanismBuilder};

    #[test]
    fn at_any_pose_the_frames_of_every_joint_coincide_where_it_closes() {
        let number = |x: f64| Number::from_f64(x).unwrap_or_else(Number::zero);
        for kind in JointKind::ALL {
            let mut builder = MechanismBuilder::new("one");
            builder.link("a");
            builder.link("b");
            let mut joint = JointBuilder::tree("j", kind, "a", "b");
            if kind.uses_axis() {
                joint = joint.axis(Direction([1.0, -2.0, 0.5].map(number)));
            }
            if kind.uses_second_axis() {
                joint = joint.axis2(Direction([0.25, 1.0, 2.0].map(number)));
            }
            if kind.uses_lead() {
                joint = joint.lead(number(0.5));
            }
            if kind == JointKind::Distance {
                joint = joint.distance(number(0.75));
            }
            builder.joint(joint);
            let Ok(mechanism) = builder.build() else {
                panic!("{kind}")
            };
            let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
            let values: Vec<f64> = (0..kind.freedom()).map(|i| 0.3 + 0.2 * i as f64).collect();
            let displacement = &geometry.displacements[0];
            let state = displacement.at(&values);
            let reached = displacement.displacement(&state);
            let poses = [Rigid::identity(&0.0), reached];
            let apart = TakenApart::new(&mechanism, &geometry, &[state], &poses);
            let pose = |body: usize| match apart.intermediates.get(body.wrapping_sub(2)) {
                Some(small) => &small.pose,
                None => &poses[body],
            };
            let freedoms: u32 = apart
                .joints
                .iter()
                .map(|joint| joint.free.count_ones() - u32::from(joint.pitch.is_some()))
                .sum();
            // The rod of a distance joint spins beside its five freedoms.
            let spin = u32::from(kind == JointKind::Distance);
            assert_eq!(freedoms as usize, kind.freedom() + spin as usize, "{kind}");
            assert_eq!(apart.handles[0].len(), kind.freedom(), "{kind}");
            for joint in &apart.joints {
                let [a, b] = [0, 1].map(|i| pose(joint.bodies[i]).compose(&joint.frames[i]));
                let off = a.inverse().compose(&b);
                for axis in 0..3 {
                    if joint.free >> axis & 1 == 0 {
                        assert!(off.translation[axis].abs() < 1e-14, "{kind} {off:?}");
                    }
                }
                if joint.reducible {
                    let turn = off.rotation_vector();
                    let numbers = off.translation.iter().chain(&turn);
                    assert!(
                        numbers.into_iter().all(|x| x.abs() < 1e-14),
                        "{kind} {off:?}"
                    );
                }
            }
        }
    }
}
