//! The equations of a part, compiled once and evaluated without allocating.
//!
//! A part of a mechanism ([`Part`]) is a list of joints, the basic cycles through them and the couplings between them.
//! Every joint is a product of elementary factors ([`crate::closure::JointDisplacement`]): a turn, a slide, a screw, or a
//! ball. Going around a cycle is then a product of constant displacements and factors. Constants that follow one another
//! are multiplied when the system is compiled; what is left per factor is one sine and cosine and two products.
//!
//! Rows: six per cycle (rotation vector in rad, displacement of the cycle's centre in units of the cycle's length), then
//! one per coupling, as [`crate::closure::jacobian`] has them; centre and length of a cycle are those of the pose the
//! system was compiled at and do not change with the pose, so that rows are smooth functions. Unknowns are counted in the
//! metric `z`: radians, and metres divided by the part's length.

use crate::closure::{
    Factor, Geometry, JointDisplacement, JointState, Part, Rigid, Vector, cross_product, jacobian,
};
use crate::matrix::MatrixError;
use crate::mechanism::{FreedomPart, JointKind, Mechanism};

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

/// A coupling `Σ factor · variable = offset`, brought to unit length in the metric.
#[derive(Clone, Debug)]
struct CompiledCoupling {
    terms: Vec<(usize, f64)>,
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
#[derive(Clone, Debug)]
pub struct SystemPose {
    /// One value per unknown (rad, m).
    pub values: Vec<f64>,
    frames: Vec<Rigid<f64>>,
}

/// The equations of a part at a pose.
#[derive(Clone, Debug, Default)]
pub struct Evaluation {
    /// One number per equation: rad, cycle lengths; couplings in the metric.
    pub residual: Vec<f64>,
    /// Six entries per factor variable passed, in the order of [`LoopSystem::pattern`].
    entries: Vec<[f64; 6]>,
}

impl Evaluation {
    /// The largest equation left.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.residual.iter().fold(0.0f64, |m, x| {
            if m.is_nan() || x.abs() <= m {
                m
            } else {
                x.abs()
            }
        })
    }
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
            let (terms, offset) = &geometry.couplings[coupling];
            let terms: Vec<(usize, f64)> = terms
                .iter()
                .filter_map(|(joint, factor)| {
                    own[*joint].map(|index| (system.joints[index].first, *factor))
                })
                .collect();
            let norm = terms
                .iter()
                .map(|(unknown, factor)| (factor / system.weights[*unknown]).powi(2))
                .sum::<f64>()
                .sqrt();
            let unit = if norm > 0.0 { 1.0 / norm } else { 1.0 };
            system.couplings.push(CompiledCoupling {
                terms: terms.into_iter().map(|(u, f)| (u, f * unit)).collect(),
                offset: offset * unit,
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
                        before: constant.compose(&factor.before),
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
                    constant = factors[offset].before.inverse();
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

    /// Takes over the states of the part's joints from those of the mechanism.
    #[must_use]
    pub fn pose(&self, states: &[JointState<f64>]) -> SystemPose {
        let mut pose = SystemPose {
            values: vec![0.0; self.unknowns()],
            frames: vec![Rigid::identity(&1.0); self.factors.len()],
        };
        for joint in &self.joints {
            let state = &states[joint.joint];
            for (value, known) in pose.values[joint.first..].iter_mut().zip(&state.values) {
                *value = *known;
            }
            let (first, count) = joint.factors;
            for (index, frame) in (first..first + count).zip(state.factors()) {
                pose.frames[index] = frame.clone();
                self.settle(&mut pose, index, true);
            }
            if joint.kind == JointKind::Distance {
                self.straighten(&mut pose, first);
            }
        }
        pose
    }

    /// Puts the part's joints into the states of the mechanism.
    pub fn put(&self, pose: &SystemPose, states: &mut [JointState<f64>]) {
        for joint in &self.joints {
            let (first, count) = joint.factors;
            states[joint.joint] = JointState::from_factors(
                pose.frames[first..first + count].to_vec(),
                pose.values[joint.first..joint.first + joint.kind.freedom()].to_vec(),
            );
        }
    }

    /// Makes a factor's frame agree with its values, or the values of a ball with its frame.
    fn settle(&self, pose: &mut SystemPose, index: usize, anew: bool) {
        let factor = &self.factors[index];
        match &factor.elementary {
            Elementary::Turn { axis, pitch } => {
                let angle = pose.values[factor.first];
                let (sine, cosine) = angle.sin_cos();
                let frame = &mut pose.frames[index];
                frame.rotation = Rigid::rotation(axis, &cosine, &sine).rotation;
                frame.translation = axis.map(|a| a * pitch * angle);
            }
            Elementary::Slide { direction } => {
                let way = pose.values[factor.first];
                pose.frames[index].translation = direction.map(|d| d * way);
            }
            Elementary::Ball => {
                let frame = &mut pose.frames[index];
                orthonormalise(&mut frame.rotation);
                let turn = frame.rotation_vector();
                let own = factor.first..factor.first + factor.generators.len();
                let before: Vec<f64> = pose.values[own.clone()].to_vec();
                let turn = if anew {
                    turn
                } else {
                    nearest_turn(&turn, &factor.generators, &before)
                };
                for (value, (angular, _)) in pose.values[own].iter_mut().zip(&factor.generators) {
                    *value = angular.iter().zip(&turn).map(|(a, t)| a * t).sum();
                }
            }
        }
    }

    /// Moves every joint: `z` in the metric, each factor by the exponential of its part of `z`.
    pub fn advance(&self, pose: &mut SystemPose, z: &[f64]) {
        for (index, factor) in self.factors.iter().enumerate() {
            let first = factor.first;
            match factor.elementary {
                Elementary::Turn { .. } | Elementary::Slide { .. } => {
                    pose.values[first] += z[first] / self.weights[first];
                }
                Elementary::Ball => {
                    let mut turn = [0.0; 3];
                    for (offset, (angular, _)) in factor.generators.iter().enumerate() {
                        for (t, a) in turn.iter_mut().zip(angular) {
                            *t += a * z[first + offset];
                        }
                    }
                    let frame = &mut pose.frames[index];
                    let step = Rigid::exponential(&turn, &[0.0; 3]);
                    frame.rotation = frame.compose(&step).rotation;
                }
            }
            self.settle(pose, index, false);
        }
        for joint in self.joints.iter().filter(|j| j.kind == JointKind::Distance) {
            self.straighten(pose, joint.factors.0);
        }
    }

    /// The two swings of a distance joint are the shortest rotation to the direction they reach; what spin they picked up
    /// about the rod on the way is handed on to the ball at its end, which leaves the displacement as it is.
    fn straighten(&self, pose: &mut SystemPose, swing: usize) {
        let frame = pose.frames[swing].clone();
        let to = [0, 1, 2].map(|i| frame.rotation[i][0]);
        if to[0] < -0.999_999 {
            return;
        }
        let short = swing_to(&to);
        let spin = short.inverse().compose(&frame);
        pose.frames[swing].rotation = short.rotation;
        pose.frames[swing + 1].rotation = spin.compose(&pose.frames[swing + 1]).rotation;
        self.settle(pose, swing, false);
        self.settle(pose, swing + 1, false);
    }

    /// By which [`Self::advance`] leads from one pose to another (written to `z`); turns of a ball the short way, turns of
    /// hinges as counted.
    pub fn way(&self, from: &SystemPose, to: &SystemPose, z: &mut [f64]) {
        let mut spin: Option<Rigid<f64>> = None;
        for (index, factor) in self.factors.iter().enumerate() {
            let first = factor.first;
            if let Elementary::Ball = factor.elementary {
                let turn = from.frames[index]
                    .inverse()
                    .compose(&to.frames[index])
                    .rotation_vector();
                for (offset, (angular, _)) in factor.generators.iter().enumerate() {
                    z[first + offset] = angular.iter().zip(&turn).map(|(a, t)| a * t).sum();
                }
                if factor.generators.len() == 2 {
                    spin = Some(swing_way(
                        &from.frames[index],
                        &to.frames[index],
                        &mut z[first..],
                    ));
                } else if let Some(spin) = spin.take() {
                    let turn = spin
                        .compose(&from.frames[index])
                        .inverse()
                        .compose(&to.frames[index])
                        .rotation_vector();
                    z[first..first + 3].copy_from_slice(&turn);
                }
            } else {
                z[first] = (to.values[first] - from.values[first]) * self.weights[first];
            }
        }
    }

    /// The velocity with which the chart of a pose sees a motion at `z`, given in the chart of that place: the same numbers
    /// for hinges and slides, `J_r⁻¹(z)` times them for balls.
    #[must_use]
    pub fn chart_velocity(&self, z: &[f64], velocity: &[f64]) -> Vec<f64> {
        let mut seen = velocity.to_vec();
        for factor in self.factors.iter().filter(|f| f.generators.len() == 3) {
            let own = factor.first..factor.first + 3;
            let (mut turn, mut step) = ([0.0; 3], [0.0; 3]);
            for (i, (angular, _)) in own.clone().zip(&factor.generators) {
                for k in 0..3 {
                    turn[k] += angular[k] * z[i];
                    step[k] += angular[k] * velocity[i];
                }
            }
            let image = inverse_right_jacobian(&turn, &step);
            for (slot, (angular, _)) in seen[own].iter_mut().zip(&factor.generators) {
                *slot = angular.iter().zip(&image).map(|(a, x)| a * x).sum();
            }
        }
        seen
    }

    /// The pose `from` counted anew so that every hinge is within half a turn of `to`: the same pose of all links.
    #[must_use]
    pub fn wound_towards(&self, from: &SystemPose, to: &SystemPose) -> SystemPose {
        let mut wound = from.clone();
        for unknown in 0..self.unknowns() {
            if self.is_periodic(unknown) {
                let turns =
                    ((to.values[unknown] - from.values[unknown]) / std::f64::consts::TAU).round();
                wound.values[unknown] += turns * std::f64::consts::TAU;
            }
        }
        for (index, factor) in self.factors.iter().enumerate() {
            if matches!(factor.elementary, Elementary::Ball) {
                let own = factor.first..factor.first + factor.generators.len();
                wound.values[own.clone()].copy_from_slice(&to.values[own]);
                self.settle(&mut wound, index, false);
            }
        }
        wound
    }

    /// How far two poses are apart, in the metric, by where the joints stand and not by how the turns are counted: the
    /// largest turn or slide between the displacements of a joint.
    #[must_use]
    pub fn separation(&self, a: &SystemPose, b: &SystemPose) -> f64 {
        let mut largest = 0.0f64;
        for (joint, displacement) in self.joints.iter().zip(&self.displacements) {
            let (first, count) = joint.factors;
            let of = |pose: &SystemPose| {
                let mut total = Rigid::identity(&1.0);
                for (factor, frame) in displacement
                    .factors()
                    .iter()
                    .zip(&pose.frames[first..first + count])
                {
                    total = total.compose(&factor.before).compose(frame);
                }
                total
            };
            let off = of(a).inverse().compose(&of(b));
            let turn = norm(&off.rotation_vector());
            largest = largest.max(turn).max(norm(&off.translation) / self.length);
        }
        largest
    }

    /// Residual and Jacobian at a pose. Allocates only the first time.
    pub fn evaluate(&self, pose: &SystemPose, out: &mut Evaluation) {
        out.residual.clear();
        out.entries.clear();
        for cycle in &self.cycles {
            let mut here = Rigid::identity(&1.0);
            let mut start = true;
            for passage in &cycle.passages {
                here = if start {
                    passage.before.clone()
                } else {
                    here.compose(&passage.before)
                };
                start = false;
                let factor = &self.factors[passage.factor];
                let frame = &pose.frames[passage.factor];
                if passage.forward {
                    here = here.compose(frame);
                }
                let sign = if passage.forward { 1.0 } else { -1.0 };
                let arm = [0, 1, 2].map(|i| here.translation[i] - cycle.centre[i]);
                for (offset, (angular, linear)) in factor.generators.iter().enumerate() {
                    let unit = sign / self.weights[factor.first + offset];
                    let turn = here.rotate(angular);
                    let slide = here.rotate(linear);
                    let moment = cross_product(&arm, &turn);
                    let inverse = unit * cycle.inverse_length;
                    out.entries.push([
                        unit * turn[0],
                        unit * turn[1],
                        unit * turn[2],
                        inverse * (moment[0] + slide[0]),
                        inverse * (moment[1] + slide[1]),
                        inverse * (moment[2] + slide[2]),
                    ]);
                }
                if !passage.forward {
                    here = here.compose(&frame.inverse());
                }
            }
            here = here.compose(&cycle.after);
            let turn = here.rotation_vector();
            let moved = here.apply(&cycle.centre);
            out.residual.extend(turn);
            out.residual
                .extend((0..3).map(|i| (moved[i] - cycle.centre[i]) * cycle.inverse_length));
        }
        for coupling in &self.couplings {
            let sum: f64 = coupling
                .terms
                .iter()
                .map(|(unknown, factor)| factor * pose.values[*unknown])
                .sum();
            out.residual.push(sum - coupling.offset);
        }
    }

    /// Writes the Jacobian row by row into a dense array of `equations × unknowns` numbers.
    pub fn fill_dense(&self, evaluation: &Evaluation, rows: &mut [f64]) {
        let columns = self.unknowns();
        rows[..self.equations() * columns].fill(0.0);
        for (&(cycle, unknown), entry) in self.pattern.iter().zip(&evaluation.entries) {
            for (row, value) in entry.iter().enumerate() {
                rows[(6 * cycle + row) * columns + unknown] = *value;
            }
        }
        for (index, coupling) in self.couplings.iter().enumerate() {
            let row = 6 * self.cycles.len() + index;
            for (unknown, factor) in &coupling.terms {
                rows[row * columns + unknown] = factor / self.weights[*unknown];
            }
        }
    }

    /// The entries of the Jacobian as (row, column, value).
    pub fn triplets<'a>(
        &'a self,
        evaluation: &'a Evaluation,
    ) -> impl Iterator<Item = (usize, usize, f64)> + 'a {
        let cycles =
            self.pattern
                .iter()
                .zip(&evaluation.entries)
                .flat_map(|(&(cycle, unknown), entry)| {
                    entry
                        .iter()
                        .enumerate()
                        .map(move |(row, value)| (6 * cycle + row, unknown, *value))
                });
        let first = 6 * self.cycles.len();
        let couplings = self.couplings.iter().enumerate().flat_map(move |(i, c)| {
            c.terms.iter().map(move |(unknown, factor)| {
                (first + i, *unknown, factor / self.weights[*unknown])
            })
        });
        cycles.chain(couplings)
    }

    /// The derivative of an unknown's *value* with respect to the metric unknowns, in the metric: a unit vector for hinges
    /// and slides; for a ball the row of the rotation vector's derivative. Written to `row`.
    pub fn value_row(&self, pose: &SystemPose, unknown: usize, row: &mut [f64]) {
        row.fill(0.0);
        let Some(factor) = self
            .factors
            .iter()
            .find(|f| (f.first..f.first + f.generators.len()).contains(&unknown))
        else {
            return;
        };
        if factor.generators.len() == 1 {
            row[unknown] = 1.0;
            return;
        }
        let own = factor.first..factor.first + factor.generators.len();
        let mut turn = [0.0; 3];
        for (value, (angular, _)) in pose.values[own.clone()].iter().zip(&factor.generators) {
            for (t, a) in turn.iter_mut().zip(angular) {
                *t += a * value;
            }
        }
        let wanted = factor.generators[unknown - factor.first].0;
        for (slot, (angular, _)) in row[own].iter_mut().zip(&factor.generators) {
            let image = inverse_right_jacobian(&turn, angular);
            *slot = wanted.iter().zip(&image).map(|(w, i)| w * i).sum();
        }
    }
}

/// The shortest rotation from x to a direction, which must not be −x.
fn swing_to(to: &Vector<f64>) -> Rigid<f64> {
    let sine = to[1].hypot(to[2]);
    if !(sine > 0.0) {
        return Rigid::identity(&1.0);
    }
    Rigid::rotation(&[0.0, -to[2] / sine, to[1] / sine], &to[0], &sine)
}

/// The two swings that lead from one direction of a rod to another (rotations about y and z, written to `z`), and the spin
/// that is then handed on to the ball.
fn swing_way(from: &Rigid<f64>, to: &Rigid<f64>, z: &mut [f64]) -> Rigid<f64> {
    let direction = [0, 1, 2].map(|i| to.rotation[i][0]);
    let seen = from.rotate_back(&direction);
    let sine = seen[1].hypot(seen[2]);
    let angle = sine.atan2(seen[0]);
    let factor = if sine > 0.0 { angle / sine } else { 0.0 };
    z[0] = -seen[2] * factor;
    z[1] = seen[1] * factor;
    let reached = from.compose(&Rigid::exponential(&[0.0, z[0], z[1]], &[0.0; 3]));
    to.inverse().compose(&reached)
}

fn norm(v: &Vector<f64>) -> f64 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}

/// J_r⁻¹(ρ) δ: by how much the rotation vector of `exp(ρ)` changes when it is multiplied by `exp(δ)` from the right
/// (Murray, Li & Sastry 1994, section 2.3; Chirikjian 2012, section 10.8.5). Diverges at a full turn.
fn inverse_right_jacobian(turn: &Vector<f64>, step: &Vector<f64>) -> Vector<f64> {
    let angle = norm(turn);
    let first = cross_product(turn, step);
    let second = cross_product(turn, &first);
    let factor = if angle < 1e-3 {
        // 1/θ² − cot(θ/2)/(2θ) = 1/12 + θ²/720 + …
        1.0 / 12.0 + angle * angle / 720.0
    } else {
        let half = 0.5 * angle;
        (1.0 - half * half.cos() / half.sin()) / (angle * angle)
    };
    [0, 1, 2].map(|i| step[i] + 0.5 * first[i] + factor * second[i])
}

/// Keeps a product of many rotations a rotation: one step of Newton's iteration for the polar factor, which squares the
/// error (Higham 1986), `R (3 − RᵀR) / 2`.
fn orthonormalise(r: &mut [[f64; 3]; 3]) {
    let mut square = [[0.0; 3]; 3];
    for (i, row) in square.iter_mut().enumerate() {
        for (j, entry) in row.iter_mut().enumerate() {
            *entry = (0..3).map(|k| r[k][i] * r[k][j]).sum();
        }
    }
    let old = *r;
    for (i, row) in r.iter_mut().enumerate() {
        for (j, entry) in row.iter_mut().enumerate() {
            *entry = 1.5 * old[i][j] - 0.5 * (0..3).map(|k| old[i][k] * square[k][j]).sum::<f64>();
        }
    }
}

/// The rotation vector of the same rotation that is nearest to the values before: whole turns are added along its axis.
fn nearest_turn(
    turn: &Vector<f64>,
    generators: &[(Vector<f64>, Vector<f64>)],
    before: &[f64],
) -> Vector<f64> {
    let angle = norm(turn);
    if angle < 1e-9 {
        return *turn;
    }
    let axis = turn.map(|t| t / angle);
    let mut old = [0.0; 3];
    for (value, (angular, _)) in before.iter().zip(generators) {
        for (o, a) in old.iter_mut().zip(angular) {
            *o += a * value;
        }
    }
    let along: f64 = axis.iter().zip(&old).map(|(a, o)| a * o).sum();
    let turns = ((along - angle) / std::f64::consts::TAU).round();
    axis.map(|a| a * (angle + turns * std::f64::consts::TAU))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::closure::Arithmetic;
    use crate::closure::samples::{Place, Written, ring};

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
