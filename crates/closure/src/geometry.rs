//! From the exact numbers of a mechanism to frames in an arithmetic of choice.

use super::coupling_equation::CouplingEquation;
use super::cycle::Walk;
use super::displacement::{JointDisplacement, JointState};
use super::jacobian::variable_unit;
use kutzbach_math::matrix::{Extended, Real};
use kutzbach_math::number::Number;
use kutzbach_math::space::{Rigid, Vector, length, three};
use kutzbach_model::mechanism::{
    Configuration, Coupling, Direction, Frame, Joint, JointId, JointKind, Mechanism, Placement,
    Precision,
};
use std::collections::BTreeMap;

/// How to turn an exact number into the arithmetic `R`: rounding to double, or evaluating to some number of bits.
pub struct Arithmetic<R> {
    convert: Box<dyn Fn(&Number) -> R>,
    one: R,
}

impl Arithmetic<f64> {
    /// Double precision.
    #[must_use]
    pub fn double() -> Self {
        Self {
            convert: Box::new(Number::value),
            one: 1.0,
        }
    }
}

impl Arithmetic<Extended> {
    /// As many bits as asked for.
    #[must_use]
    pub fn bits(bits: u32) -> Self {
        Self {
            // A few bits more than the working precision, so that conversion rounds once.
            convert: Box::new(move |number| {
                Extended::from_float(&number.evaluate(bits as usize + 8), bits)
            }),
            one: Extended::new(1.0, bits),
        }
    }
}

impl<R: Real> Arithmetic<R> {
    /// A number in this arithmetic.
    pub fn number(&self, number: &Number) -> R {
        (self.convert)(number)
    }

    /// One, from which other constants are made.
    pub fn one(&self) -> &R {
        &self.one
    }

    fn vector(&self, components: &[Number; 3]) -> Vector<R> {
        three(|i| self.number(&components[i]))
    }

    /// A direction, not normalised.
    fn direction(&self, direction: &Direction) -> Vector<R> {
        self.vector(&direction.0)
    }

    /// URDF's fixed-axis convention: `R = Rz(yaw) Ry(pitch) Rx(roll)`.
    fn frame(&self, frame: &Frame) -> Rigid<R> {
        let mut pose = Rigid::translation(self.vector(&frame.position));
        for axis in [2, 1, 0] {
            let angle = &frame.roll_pitch_yaw[axis];
            if angle.is_zero() {
                continue;
            }
            let (sine, cosine) = self.number(angle).sin_cos();
            let mut direction = three(|_| self.one.zero_like());
            direction[axis] = self.one.clone();
            pose = pose.compose(&Rigid::rotation(&direction, &cosine, &sine));
        }
        pose
    }
}

/// A mechanism in an arithmetic: joint frames, displacement sets, and the pose that the file gives.
#[derive(Clone, Debug)]
pub struct Geometry<R> {
    /// `link_from_joint` of the predecessor and of the successor, for every joint.
    pub sides: Vec<[Rigid<R>; 2]>,
    /// What every joint allows.
    pub displacements: Vec<JointDisplacement<R>>,
    /// `world_from_link` of every link as the file places it.
    pub home: Vec<Rigid<R>>,
    /// Every joint's state at the file pose: exact for tree joints, fitted for loops.
    pub states: Vec<JointState<R>>,
    /// Couplings as equations between variables of joints of one freedom.
    pub couplings: Vec<CouplingEquation<R>>,
    /// What the digits of every coupling's factors leave open, relative to all of them together.
    pub coupling_digits: Vec<f64>,
    /// What the stated precision leaves open of every joint's numbers.
    pub uncertainties: Vec<Uncertainty>,
    /// The longest arm ([`Geometry::arm`]) of every joint's independent sub-mechanism (m); 0 for joints in no loop.
    pub arms: Vec<f64>,
    /// One, in the arithmetic.
    pub one: R,
}

/// No mechanism is smaller than this (m): a hundredth of an atom. Coordinates below it are the noise of a zero.
const SMALLEST_LENGTH: f64 = 1e-12;

/// Rounding leaves zeros of about 1e-16 of the coordinates they come from; a thousand times that is still no length.
const NOISE_OF_SIZE: f64 = 1e-13;

/// What a coordinate has to exceed to be a length (m), where it is computed from coordinates of up to a size (m).
#[must_use]
pub fn least_length(size: f64) -> f64 {
    SMALLEST_LENGTH.max(NOISE_OF_SIZE * size)
}

/// What the digits of a coupling's factors leave open, relative to all of them together: half a unit of the last decimal of each, where it
/// has more than somebody chooses; of what was worked out from literals, what theirs leave open.
fn digits_of(coupling: &Coupling) -> f64 {
    let of_literal = |number: &Number| match number.stated() {
        Some(stated) if stated.decimals > Precision::EXACT_DECIMALS => {
            0.5 * 0.1f64.powi(stated.decimals)
        }
        _ => 0.0,
    };
    let half = |number: &Number| match number.inputs() {
        [] => of_literal(number),
        inputs => {
            let shares = inputs.iter();
            shares.map(|own| own.slope * of_literal(&own.literal)).sum()
        }
    };
    let open: Vec<f64> = coupling
        .terms
        .iter()
        .flat_map(|term| term.factors().map(half))
        .collect();
    let size: Vec<f64> = coupling
        .terms
        .iter()
        .flat_map(|term| term.factors().map(Number::value))
        .collect();
    let size = 0.0.norm(&size);
    if size > 0.0 {
        0.0.norm(&open) / size
    } else {
        0.0
    }
}

impl<R: Real> Geometry<R> {
    /// Largest coordinate of some joints' frames in their links (m).
    pub fn size_of(&self, joints: impl IntoIterator<Item = usize>) -> f64 {
        let sides = joints.into_iter().flat_map(|joint| &self.sides[joint]);
        sides
            .flat_map(|frame| &frame.translation)
            .fold(0.0, |far: f64, x| far.max(x.to_f64().abs()))
    }

    /// Evaluates a mechanism at the home pose or at a configuration. Cost: linear in the mechanism.
    pub fn new(
        mechanism: &Mechanism,
        configuration: Option<&Configuration>,
        arithmetic: &Arithmetic<R>,
    ) -> Self {
        let one = arithmetic.one().clone();
        let mut configured: Vec<Option<Vec<R>>> = vec![None; mechanism.joints().len()];
        for (joint, values) in configuration.iter().flat_map(|c| &c.positions) {
            configured[joint.0] = Some(values.iter().map(|v| arithmetic.number(v)).collect());
        }
        let sides: Vec<[Rigid<R>; 2]> = mechanism
            .joints()
            .iter()
            .map(|joint| {
                [&joint.predecessor, &joint.successor].map(|side| arithmetic.frame(&side.frame))
            })
            .collect();
        // A distance that is not stated is that at home, whatever the configuration.
        let measured = configuration.is_some()
            && mechanism
                .joints()
                .iter()
                .any(|joint| joint.kind == JointKind::Distance && joint.distance.is_none());
        let at_home = measured.then(|| Self::new(mechanism, None, arithmetic));
        let mut displacements: Vec<Option<JointDisplacement<R>>> = vec![None; sides.len()];
        let mut states: Vec<Option<JointState<R>>> = vec![None; sides.len()];
        let mut home = vec![Rigid::identity(&one); mechanism.links().len()];
        for &link in mechanism.placement_order() {
            match &mechanism.link(link).placement {
                Placement::World => {}
                Placement::Floating { parent, origin, .. } => {
                    home[link.0] = home[parent.0].compose(&arithmetic.frame(origin));
                }
                Placement::Joint(id) => {
                    let joint = mechanism.joint(*id);
                    let displacement = joint_displacement(joint, arithmetic, &one);
                    let state = match &configured[id.0] {
                        Some(values) => displacement.at(values),
                        None => displacement.home(),
                    };
                    home[link.0] = home[joint.predecessor.link.0]
                        .compose(&sides[id.0][0])
                        .compose(&displacement.displacement(&state))
                        .compose(&sides[id.0][1].inverse());
                    displacements[id.0] = Some(displacement);
                    states[id.0] = Some(state);
                }
            }
        }
        for (index, joint) in mechanism.joints().iter().enumerate() {
            if displacements[index].is_some() {
                continue;
            }
            let relative = relative(&home, joint, &sides[index]);
            let reach = match &at_home {
                Some(at_home) => at_home.displacements[index].distance().clone(),
                None => length(&relative.translation),
            };
            let displacement = joint_displacement(joint, arithmetic, &reach);
            states[index] = Some(match &configured[index] {
                Some(values) => displacement.at(values),
                None => displacement.fit(&relative),
            });
            displacements[index] = Some(displacement);
        }
        let couplings = mechanism.couplings().iter();
        let couplings = couplings.map(|coupling| CouplingEquation::of(coupling, arithmetic));
        let mut geometry = Self {
            arms: Vec::new(),
            sides,
            displacements: displacements.into_iter().flatten().collect(),
            home,
            states: states.into_iter().flatten().collect(),
            couplings: couplings.collect(),
            coupling_digits: mechanism.couplings().iter().map(digits_of).collect(),
            uncertainties: mechanism
                .joints()
                .iter()
                .enumerate()
                .map(|(index, joint)| {
                    Uncertainty::of(mechanism.precision_of(JointId(index)), joint)
                })
                .collect(),
            one,
        };
        geometry.arms = geometry.longest_arms(mechanism);
        geometry
    }

    /// The longest distance of two joints that follow one another on a cycle, or stated by a joint of it (m), of those that no
    /// rounding within the stated precision can have made of zero; 0 if there is none.
    pub fn arm(&self, cycle: &Walk) -> f64 {
        let pairs = cycle.iter().zip(cycle.iter().cycle().skip(1));
        pairs.fold(0.0, |longest: f64, (&(joint, forward), &(next, onward))| {
            let between =
                self.between([(joint, usize::from(forward)), (next, usize::from(!onward))]);
            longest.max(between).max(self.stated_distance(joint))
        })
    }

    /// The distance of two joints' frames, each on a side of its joint (0: predecessor), on one link; 0 where rounding may have
    /// made it of zero.
    ///
    /// If two points are the same, of which each coordinate is known to ±u and ±v, then they are written within `√Σ(u + v)²` of
    /// one another, which is at most `√2` times the root of all `Σ(u² + v²)`.
    fn between(&self, [one, other]: [(usize, usize); 2]) -> f64 {
        let at = |(joint, side): (usize, usize)| &self.sides[joint][side].translation;
        let (p, q) = (at(one), at(other));
        let apart = [0, 1, 2].map(|i| (p[i].clone() - q[i].clone()).to_f64());
        let distance = length(&apart);
        let open = [one, other].map(|(joint, _)| self.uncertainties[joint].lengths);
        let size = p
            .iter()
            .chain(q)
            .fold(0.0, |m: f64, x| m.max(x.to_f64().abs()));
        let least = (std::f64::consts::SQRT_2 * open[0].hypot(open[1])).max(least_length(size));
        if distance > least { distance } else { 0.0 }
    }

    fn stated_distance(&self, joint: usize) -> f64 {
        let displacement = &self.displacements[joint];
        let distance = match displacement.kind() {
            JointKind::Distance => displacement.distance().to_f64(),
            _ => 0.0,
        };
        if distance > self.uncertainties[joint].lengths {
            distance
        } else {
            0.0
        }
    }

    /// Radians or metres per unit of the variable of a joint of one freedom, where translations count in units of a length (m).
    pub fn coupled_unit(&self, joint: usize, length: f64) -> f64 {
        let freedoms = self.displacements[joint].kind().freedoms();
        let first = freedoms.first();
        first.map_or(1.0, |part| variable_unit(*part, length))
    }

    /// The longest arm of every joint's independent sub-mechanism: on each link from one of its joints to the others.
    fn longest_arms(&self, mechanism: &Mechanism) -> Vec<f64> {
        let mut first = BTreeMap::new();
        let mut longest: Vec<f64> = Vec::new();
        let blocks: Vec<Option<usize>> = (0..mechanism.joints().len())
            .map(|joint| mechanism.sub_mechanism(JointId(joint)))
            .collect();
        for (joint, block) in blocks.iter().enumerate() {
            let Some(block) = *block else { continue };
            if longest.len() <= block {
                longest.resize(block + 1, 0.0);
            }
            let ends = &mechanism.joints()[joint];
            for (side, end) in [&ends.predecessor, &ends.successor].into_iter().enumerate() {
                let start = *first.entry((block, end.link)).or_insert((joint, side));
                longest[block] = longest[block].max(self.between([start, (joint, side)]));
            }
            longest[block] = longest[block].max(self.stated_distance(joint));
        }
        let arm = |block: Option<usize>| block.map_or(0.0, |block| longest[block]);
        blocks.into_iter().map(arm).collect()
    }

    /// A distance joint without length: its two points coincide where the distance was to be read off.
    pub fn degenerate_distance(&self) -> Option<usize> {
        self.displacements
            .iter()
            .position(|d| d.kind() == JointKind::Distance && !(d.distance().to_f64() > 0.0))
    }
}

/// How far some numbers may together be from those meant: roots of the sums of their squared uncertainties, by unit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Uncertainty {
    /// Of positions, leads and distances (m).
    pub lengths: f64,
    /// Of directions and angles (rad).
    pub angles: f64,
}

impl Uncertainty {
    /// What a precision leaves open of one joint; zero where its numbers are exact.
    pub fn of(precision: &Precision, joint: &Joint) -> Self {
        let mut sum = Self::default();
        if precision.is_exact() {
            return sum;
        }
        let of = |place: usize, numbers: &[Number; 3]| -> Vector<f64> {
            three(|i| precision.uncertainty(place + i, &numbers[i]))
        };
        for (side, frame) in [&joint.predecessor.frame, &joint.successor.frame]
            .into_iter()
            .enumerate()
        {
            let place = 6 * side;
            sum.lengths = sum.lengths.hypot(length(&of(place, &frame.position)));
            sum.angles = sum
                .angles
                .hypot(length(&of(place + 3, &frame.roll_pitch_yaw)));
        }
        for (place, axis, used) in [
            (12, &joint.axis, joint.kind.uses_axis()),
            (15, &joint.axis2, joint.kind.uses_second_axis()),
        ] {
            if used {
                let size = length(&three(|i| axis.0[i].value()));
                sum.angles = sum.angles.hypot(length(&of(place, &axis.0)) / size);
            }
        }
        for (place, scalar) in [(18, &joint.lead), (19, &joint.distance)] {
            if let Some(scalar) = scalar {
                sum.lengths = sum.lengths.hypot(precision.uncertainty(place, scalar));
            }
        }
        sum
    }

    /// That of several joints together.
    pub fn total<'a>(all: impl IntoIterator<Item = &'a Self>) -> Self {
        all.into_iter().fold(Self::default(), |sum, other| Self {
            lengths: sum.lengths.hypot(other.lengths),
            angles: sum.angles.hypot(other.angles),
        })
    }
}

/// `predecessor_joint_frame_from_successor_joint_frame` as two link poses have it.
pub(super) fn relative<R: Real>(
    poses: &[Rigid<R>],
    joint: &Joint,
    sides: &[Rigid<R>; 2],
) -> Rigid<R> {
    let predecessor = poses[joint.predecessor.link.0].compose(&sides[0]);
    let successor = poses[joint.successor.link.0].compose(&sides[1]);
    predecessor.inverse().compose(&successor)
}

fn joint_displacement<R: Real>(
    joint: &Joint,
    arithmetic: &Arithmetic<R>,
    reach: &R,
) -> JointDisplacement<R> {
    let pitch = match &joint.lead {
        Some(lead) => {
            let one = arithmetic.one();
            // A turn is 2π = 2 atan2(0, −1) in the arithmetic at hand.
            let turn = one.zero_like().atan2(&-one.clone()) * one.constant(2.0);
            arithmetic.number(lead) / turn
        }
        None => arithmetic.one().zero_like(),
    };
    let distance = match (&joint.distance, joint.kind) {
        (Some(distance), _) => arithmetic.number(distance),
        (None, JointKind::Distance) => reach.clone(),
        (None, _) => arithmetic.one().zero_like(),
    };
    JointDisplacement::new(
        joint.kind,
        &arithmetic.direction(&joint.axis),
        &arithmetic.direction(&joint.axis2),
        &pitch,
        &distance,
    )
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::samples::{Written, four_bar, planar, ring};
    use super::*;
    use kutzbach_math::matrix::Ring;
    use kutzbach_model::mechanism::{JointBuilder, MechanismBuilder};

    fn decimal(text: &str) -> Number {
        Number::decimal(text).unwrap()
    }

    fn numbers(text: [&str; 3]) -> [Number; 3] {
        text.map(decimal)
    }

    #[test]
    fn roll_pitch_yaw_turn_about_fixed_axes_in_this_order() {
        // A quarter turn about x takes z to −y; then one about z takes that to x. (The other order would give z to −y.)
        let quarter = Number::expression("pi/2", &mut |_| Ok(None)).unwrap();
        let frame = Frame {
            position: numbers(["1", "2", "3"]),
            roll_pitch_yaw: [quarter.clone(), Number::zero(), quarter],
        };
        let pose = Arithmetic::double().frame(&frame);
        let image = pose.apply(&[0.0, 0.0, 1.0]);
        for (x, y) in image.iter().zip([2.0, 2.0, 3.0]) {
            assert!((x - y).abs() < 1e-15, "{image:?}");
        }
        // All three at once, by hand: x → Rz(0.3) Ry(0.2) x = (cos .3 cos .2, sin .3 cos .2, −sin .2).
        let frame = Frame {
            position: numbers(["0", "0", "0"]),
            roll_pitch_yaw: numbers(["0.1", "0.2", "0.3"]),
        };
        let image = Arithmetic::double().frame(&frame).rotate(&[1.0, 0.0, 0.0]);
        let expected = [
            0.3f64.cos() * 0.2f64.cos(),
            0.3f64.sin() * 0.2f64.cos(),
            -(0.2f64.sin()),
        ];
        for (x, y) in image.iter().zip(expected) {
            assert!((x - y).abs() < 1e-15);
        }
        let fine = Arithmetic::bits(212).frame(&frame);
        assert!((fine.rotation[2][0].to_f64() + 0.2f64.sin()).abs() < 1e-15);
        let rows = [0, 1, 2].map(|i| length(&fine.rotation[i]));
        for norm in rows {
            let one = norm.one_like();
            assert!((norm - one).abs().to_f64() < 1e-62);
        }
    }

    #[test]
    fn configured_values_place_the_links() {
        let mut builder = MechanismBuilder::new("arm");
        builder.link("ground").link("arm").link("hand");
        let z = || Direction(numbers(["0", "0", "2"]));
        builder.joint(JointBuilder::tree("turn", JointKind::Revolute, "ground", "arm").axis(z()));
        builder.joint(
            JointBuilder::tree("slide", JointKind::Cylindrical, "arm", "hand")
                .origin(Frame::at(numbers(["1", "0", "0"])))
                .axis(z()),
        );
        let quarter = Number::expression("pi/2", &mut |_| Ok(None)).unwrap();
        builder.configuration(
            "out",
            vec![
                ("slide".to_owned(), vec![decimal("0.5"), Number::zero()]),
                ("turn".to_owned(), vec![quarter]),
            ],
        );
        let arm = builder.build().unwrap();
        let hand = arm.link_named("hand").unwrap().0;
        let home = Geometry::new(&arm, None, &Arithmetic::double());
        assert_eq!(home.home[hand].translation, [1.0, 0.0, 0.0]);
        let out = Geometry::new(&arm, arm.configuration("out"), &Arithmetic::double());
        for (x, y) in out.home[hand].translation.iter().zip([0.0, 1.0, 0.5]) {
            assert!((x - y).abs() < 1e-15);
        }
        assert_eq!(
            out.states[arm.joint_named("slide").unwrap().0].values,
            [0.5, 0.0]
        );
    }

    #[test]
    fn closing_joints_stand_as_the_links_do() {
        let geometry = Geometry::new(&four_bar(), None, &Arithmetic::double());
        assert!(geometry.states.iter().all(|state| state.values == [0.0]));
        assert_eq!(geometry.home.len(), 4);
    }

    fn with_rod(at: [f64; 3], distance: Option<&str>) -> Mechanism {
        let mut builder = MechanismBuilder::new("rod");
        builder.link("ground").link("arm");
        builder.joint(JointBuilder::tree(
            "pin",
            JointKind::Revolute,
            "ground",
            "arm",
        ));
        let mut rod = JointBuilder::closing("rod", JointKind::Distance, "ground", "arm")
            .successor_origin(Frame::at_point(at).unwrap());
        if let Some(distance) = distance {
            rod = rod.distance(decimal(distance));
        }
        builder.joint(rod);
        builder.build().unwrap()
    }

    #[test]
    fn distances_are_read_off_at_home_or_stated() {
        let at = |place, stated| {
            let mechanism = with_rod(place, stated);
            let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
            (
                *geometry.displacements[1].distance(),
                geometry.degenerate_distance(),
            )
        };
        assert_eq!(at([0.0, 3.0, 4.0], None), (5.0, None));
        assert_eq!(at([0.0, 3.0, 4.0], Some("4.5")), (4.5, None));
        assert_eq!(at([0.0; 3], None), (0.0, Some(1)));
        // Squares of such lengths are no doubles, the lengths are.
        assert_eq!(at([0.0, 3e-200, 4e-200], None), (5e-200, None));
    }

    #[test]
    fn leads_count_by_the_turn() {
        let screw = ring(
            &[
                (JointKind::Screw, [0.0; 3], [0.0, 0.0, 1.0]),
                (JointKind::Prismatic, [0.0; 3], [0.0, 0.0, 1.0]),
            ],
            [0.0; 3],
            Written::Exactly,
        );
        let geometry = Geometry::new(&screw, None, &Arithmetic::double());
        let joint = &geometry.displacements[0];
        let after = joint.displacement(&joint.at(&[std::f64::consts::TAU]));
        assert!((after.translation[2] - 0.25).abs() < 1e-15);
    }

    #[test]
    fn numbers_are_evaluated_in_the_arithmetic_asked_for() {
        let tenth = Arithmetic::bits(212).number(&decimal("0.1"));
        let ten = tenth.constant(10.0);
        assert!((tenth * ten.clone() - ten.one_like()).abs().to_f64() < 1e-62);
    }

    #[test]
    fn uncertainty_follows_the_digits_and_the_unit_of_each_number() {
        let points = [[0.0, 0.0], [0.123, 0.2], [1.25, 0.4], [1.0, 0.0]];
        let exact = ring(&planar(&points), [0.0; 3], Written::Exactly);
        let geometry = Geometry::new(&exact, None, &Arithmetic::double());
        assert_eq!(
            Uncertainty::total(&geometry.uncertainties),
            Uncertainty::default()
        );
        let rounded = ring(&planar(&points), [0.0; 3], Written::Decimals(6));
        let geometry = Geometry::new(&rounded, None, &Arithmetic::double());
        let one = geometry.uncertainties[1];
        // Three numbers of a position, three of a direction of length 1, each within half a unit of the last place.
        assert!((one.lengths / (3f64.sqrt() * 0.5e-6) - 1.0).abs() < 1e-12);
        assert!((one.angles / (3f64.sqrt() * 0.5e-6) - 1.0).abs() < 1e-12);
        let all = Uncertainty::total(&geometry.uncertainties);
        assert!(all.lengths > one.lengths && all.lengths < 4.0 * one.lengths);
    }
}
