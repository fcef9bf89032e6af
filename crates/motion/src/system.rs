//! The equations of a part, compiled once and evaluated without allocating.
//!
//! A part of a mechanism ([`Part`]) is a list of joints, the basic cycles through them and the couplings between them.
//! Every joint is a product of elementary factors ([`kutzbach_closure::JointDisplacement`]): a turn, a slide, a screw, or a
//! ball. Going around a cycle is then a product of constant displacements and factors. Constants that follow one another
//! are multiplied when the system is compiled; what is left per factor is one sine and cosine and two products.
//!
//! Rows: six per cycle (rotation vector in rad, displacement of the cycle's centre in units of the cycle's length), then
//! one per coupling, as [`kutzbach_closure::jacobian`] has them; centre and length of a cycle are those of the pose the
//! system was compiled at and do not change with the pose, so that rows are smooth functions. Unknowns are counted in the
//! metric `z`: radians, and metres divided by the part's length.

mod evaluation;
mod poses;
mod rotations;

pub use evaluation::Evaluation;

use kutzbach_closure::{
    CouplingShare, Factor, Geometry, JointDisplacement, JointState, Part, Rigid, Vector, jacobian,
};
use kutzbach_math::matrix::MatrixError;
use kutzbach_model::mechanism::{FreedomPart, JointKind, Mechanism};

/// How the displacement of one factor follows from its variables.
#[derive(Clone, Debug)]
enum Elementary {
    /// About a fixed axis, with a travel per radian along it (m/rad; zero for hinges).
    Turn { axis: Vector<f64>, pitch: f64 },
    /// Along a fixed direction.
    Slide { direction: Vector<f64> },
    /// Two or three generators that turn about a point.
    Ball,
}

/// One elementary factor of a joint.
#[derive(Clone, Debug)]
struct CompiledFactor {
    elementary: Elementary,
    /// First unknown.
    first: usize,
    generators: Vec<(Vector<f64>, Vector<f64>)>,
}

/// One factor passed on the way around a cycle.
#[derive(Clone, Debug)]
struct Passage {
    /// Constant displacement before it.
    before: Rigid<f64>,
    /// Index of the factor; `None` for a joint outside the part, which stands still.
    factor: usize,
    forward: bool,
}

#[derive(Clone, Debug)]
struct CompiledCycle {
    passages: Vec<Passage>,
    /// Constant displacement after the last factor.
    after: Rigid<f64>,
    centre: Vector<f64>,
    inverse_length: f64,
}

/// A coupling, divided by the length of all its factors in the metric.
#[derive(Clone, Debug)]
struct CompiledCoupling {
    /// Unknowns, and what each gives.
    terms: Vec<(usize, CouplingShare<f64>)>,
    offset: f64,
}

/// One joint of the part.
#[derive(Clone, Debug)]
struct CompiledJoint {
    /// Index in the mechanism.
    joint: usize,
    kind: JointKind,
    /// First factor and number of factors.
    factors: (usize, usize),
    /// First unknown.
    first: usize,
}

/// Where the joints of a part stand.
///
/// Variables of hinges and slides are counted continuously (two turns are 4π). Those of a ball are the components of its
/// rotation vector, continued from pose to pose.
#[derive(Clone, Debug, Default)]
pub struct SystemPose {
    /// One value per unknown (rad, m).
    pub values: Vec<f64>,
    frames: Vec<Rigid<f64>>,
}

/// The loop equations of a part of a mechanism, compiled.
#[derive(Clone, Debug)]
pub struct LoopSystem {
    joints: Vec<CompiledJoint>,
    factors: Vec<CompiledFactor>,
    cycles: Vec<CompiledCycle>,
    couplings: Vec<CompiledCoupling>,
    /// (cycle, unknown) of every block of six entries.
    pattern: Vec<(usize, usize)>,
    displacements: Vec<JointDisplacement<f64>>,
    parts: Vec<FreedomPart>,
    /// Metric length of a unit of every unknown: 1 for turns, 1 / length for slides.
    weights: Vec<f64>,
    length: f64,
}

fn is_zero(v: &Vector<f64>) -> bool {
    v.iter().all(|x| *x == 0.0)
}

fn compile_factor(factor: &Factor<f64>, first: usize) -> CompiledFactor {
    let generators: Vec<(Vector<f64>, Vector<f64>)> = factor
        .generators
        .iter()
        .map(|g| (g.angular, g.linear))
        .collect();
    let elementary = match generators.as_slice() {
        [(angular, linear)] if is_zero(angular) => Elementary::Slide { direction: *linear },
        [(angular, linear)] => Elementary::Turn {
            axis: *angular,
            pitch: angular.iter().zip(linear).map(|(a, l)| a * l).sum(),
        },
        _ => Elementary::Ball,
    };
    CompiledFactor {
        elementary,
        first,
        generators,
    }
}

impl LoopSystem {
    /// Compiles the equations of a part, about a pose from which centres, lengths and the metric are taken. Joints that a
    /// cycle passes outside the part stand as they do there.
    ///
    /// # Errors
    /// [`MatrixError`] where coordinates leave the range of numbers or the arguments belong to different mechanisms.
    pub fn new(
        mechanism: &Mechanism,
        geometry: &Geometry<f64>,
        states: &[JointState<f64>],
        part: &Part,
    ) -> Result<Self, MatrixError> {
        let linear = jacobian(mechanism, geometry, states, part)?;
        let length = linear.length;
        let mut system = Self {
            joints: Vec::new(),
            factors: Vec::new(),
            cycles: Vec::new(),
            couplings: Vec::new(),
            pattern: Vec::new(),
            displacements: Vec::new(),
            parts: Vec::new(),
            weights: Vec::new(),
            length,
        };
        let mut own = vec![None; geometry.displacements.len()];
        for &joint in &part.joints {
            let displacement = &geometry.displacements[joint];
            let first_factor = system.factors.len();
            let first = system.weights.len();
            let mut next = first;
            for factor in displacement.factors() {
                system.factors.push(compile_factor(factor, next));
                next += factor.generators.len();
            }
            for freedom in displacement.kind().freedoms() {
                system.parts.push(*freedom);
                system.weights.push(match freedom {
                    FreedomPart::Translation => 1.0 / length,
                    FreedomPart::Rotation | FreedomPart::Screw => 1.0,
                });
            }
            own[joint] = Some(system.joints.len());
            system.joints.push(CompiledJoint {
                joint,
                kind: displacement.kind(),
                factors: (first_factor, system.factors.len() - first_factor),
                first,
            });
            system.displacements.push(displacement.clone());
        }
        for (cycle, walk) in part.cycles.iter().zip(&linear.walks) {
            system.compile_cycle(geometry, states, &own, cycle, walk.centre, walk.length);
        }
        for &coupling in &part.couplings {
            let equation = &geometry.couplings[coupling];
            let unit = |joint: usize| match own[joint] {
                Some(index) => 1.0 / system.weights[system.joints[index].first],
                None => 1.0,
            };
            let norm = equation.norm(unit);
            let terms = equation.shares.iter().filter_map(|share| {
                let unknown = system.joints[own[share.joint]?].first;
                let mut share = share.clone();
                share.coefficients.iter_mut().for_each(|x| *x /= norm);
                Some((unknown, share))
            });
            let terms = terms.collect();
            system.couplings.push(CompiledCoupling {
                terms,
                offset: equation.offset / norm,
            });
        }
        Ok(system)
    }

    fn compile_cycle(
        &mut self,
        geometry: &Geometry<f64>,
        states: &[JointState<f64>],
        own: &[Option<usize>],
        cycle: &[(usize, bool)],
        centre: Vector<f64>,
        length: f64,
    ) {
        let index = self.cycles.len();
        let mut passages = Vec::new();
        let mut constant = Rigid::identity(&1.0);
        for &(joint, forward) in cycle {
            let [predecessor, successor] = &geometry.sides[joint];
            let Some(compiled) = own[joint] else {
                let fixed = predecessor
                    .compose(&geometry.displacements[joint].displacement(&states[joint]))
                    .compose(&successor.inverse());
                constant = constant.compose(&if forward { fixed } else { fixed.inverse() });
                continue;
            };
            let (first, count) = self.joints[compiled].factors;
            let factors = geometry.displacements[joint].factors();
            if forward {
                constant = constant.compose(predecessor);
                for (offset, factor) in factors.iter().enumerate() {
                    passages.push(Passage {
                        before: match &factor.before {
                            Some(before) => constant.compose(before),
                            None => constant,
                        },
                        factor: first + offset,
                        forward,
                    });
                    constant = Rigid::identity(&1.0);
                }
                constant = constant.compose(&successor.inverse());
            } else {
                constant = constant.compose(successor);
                for offset in (0..count).rev() {
                    passages.push(Passage {
                        before: constant,
                        factor: first + offset,
                        forward,
                    });
                    constant = match &factors[offset].before {
                        Some(before) => before.inverse(),
                        None => Rigid::identity(&1.0),
                    };
                }
                constant = constant.compose(&predecessor.inverse());
            }
        }
        for passage in &passages {
            let factor = &self.factors[passage.factor];
            self.pattern
                .extend((0..factor.generators.len()).map(|g| (index, factor.first + g)));
        }
        self.cycles.push(CompiledCycle {
            passages,
            after: constant,
            centre,
            inverse_length: 1.0 / length,
        });
    }

    /// Number of unknowns.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        self.weights.len()
    }

    /// Number of equations.
    #[must_use]
    pub fn equations(&self) -> usize {
        6 * self.cycles.len() + self.couplings.len()
    }

    /// Metric length of a unit of every unknown: 1 per rad, 1 / [`length`](Self::length) per m.
    #[must_use]
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// The part's length (m): root mean square of the lengths of its cycles.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.length
    }

    /// What every unknown does.
    #[must_use]
    pub fn freedom_parts(&self) -> &[FreedomPart] {
        &self.parts
    }

    /// The unknowns of a joint of the mechanism, as a range; `None` where it is not of this part.
    #[must_use]
    pub fn unknowns_of(&self, joint: usize) -> Option<std::ops::Range<usize>> {
        let own = self.joints.iter().find(|j| j.joint == joint)?;
        Some(own.first..own.first + own.kind.freedom())
    }

    /// (joint of the mechanism, index of the variable in it) of every unknown.
    #[must_use]
    pub fn variables(&self) -> Vec<(usize, usize)> {
        self.joints
            .iter()
            .flat_map(|j| (0..j.kind.freedom()).map(|v| (j.joint, v)))
            .collect()
    }

    /// Whether an unknown is the only variable of its factor, so that its value is a number of its own and steps add up;
    /// the variables of balls are not.
    #[must_use]
    pub fn is_scalar(&self, unknown: usize) -> bool {
        self.factors
            .iter()
            .any(|f| f.first == unknown && f.generators.len() == 1)
    }

    /// Whether a full turn of an unknown leads back to the same pose: a hinge, not a screw nor a slide.
    #[must_use]
    pub fn is_periodic(&self, unknown: usize) -> bool {
        self.factors.iter().any(|f| {
            f.first == unknown
                && matches!(f.elementary, Elementary::Turn { pitch, .. } if pitch == 0.0)
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use kutzbach_closure::Arithmetic;
    use kutzbach_closure::samples::{Place, Written, ring};

    /// A loop of joints of many kinds.
    fn mixed() -> (Mechanism, Geometry<f64>, LoopSystem) {
        let places: Vec<Place> = vec![
            (JointKind::Revolute, [0.0, 0.0, 0.0], [0.0, 0.5, 1.0]),
            (JointKind::Spherical, [1.0, 0.5, 0.0], [1.0, 0.0, 0.0]),
            (JointKind::Cylindrical, [2.0, 0.0, 0.5], [1.0, 0.25, 0.0]),
            (JointKind::Screw, [2.0, -1.0, 0.0], [0.0, 1.0, 1.0]),
            (JointKind::Universal, [1.0, -2.0, 0.0], [0.5, 1.0, 0.0]),
        ];
        let mechanism = ring(&places, [0.0; 3], Written::Exactly);
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
        let joints: Vec<usize> = (0..mechanism.joints().len()).collect();
        // Walked backward, so that both directions are met somewhere.
        let part = Part {
            cycles: vec![joints.iter().rev().map(|j| (*j, false)).collect()],
            couplings: Vec::new(),
            joints,
        };
        let system = LoopSystem::new(&mechanism, &geometry, &geometry.states, &part).unwrap();
        (mechanism, geometry, system)
    }

    #[test]
    fn rows_are_the_derivative_of_the_residual() {
        let (_, geometry, system) = mixed();
        let pose = system.pose(&geometry.states);
        let n = system.unknowns();
        let mut here = Evaluation::default();
        system.evaluate(&pose, &mut here);
        assert!(here.largest() < 1e-15, "closed as drawn");
        let mut rows = vec![0.0; system.equations() * n];
        system.fill_dense(&here, &mut rows);
        for unknown in 0..n {
            let at = |way: f64| {
                let mut z = vec![0.0; n];
                z[unknown] = way;
                let mut there = pose.clone();
                system.advance(&mut there, &z);
                let mut found = Evaluation::default();
                system.evaluate(&there, &mut found);
                found.residual
            };
            let (ahead, behind) = (at(1e-5), at(-1e-5));
            for row in 0..system.equations() {
                let quotient = (ahead[row] - behind[row]) / 2e-5;
                assert!((quotient - rows[row * n + unknown]).abs() < 1e-8);
            }
        }
    }

    #[test]
    fn ways_lead_from_pose_to_pose() {
        let (_, geometry, system) = mixed();
        let from = system.pose(&geometry.states);
        let z: Vec<f64> = (0..system.unknowns())
            .map(|i| 0.3 * (i as f64).sin())
            .collect();
        let mut to = from.clone();
        system.advance(&mut to, &z);
        let mut way = vec![0.0; z.len()];
        system.way(&from, &to, &mut way);
        assert!(z.iter().zip(&way).all(|(a, b)| (a - b).abs() < 1e-14));
        assert!(system.separation(&from, &to) > 0.1);
        let mut states = geometry.states.clone();
        system.put(&to, &mut states);
        assert!(system.separation(&system.pose(&states), &to) < 1e-15);
        // A turn of a hinge is the same pose, counted differently.
        let mut turned = to.clone();
        turned.values[0] += std::f64::consts::TAU;
        let wound = system.wound_towards(&to, &turned);
        assert_eq!(wound.values[0], turned.values[0]);
        assert!(system.separation(&wound, &to) < 1e-15);
    }
}
