//! What a joint can do, as a product of elementary displacements.
//!
//! Every joint kind is a product of constant displacements and *factors*; a factor carries one to three variables and is
//! advanced by right multiplication with an exponential, `F ← F exp(Σ ξᵢ dxᵢ)`. A ball is one factor with three
//! generators, so there is no gimbal lock at any pose; at every state the derivative with respect to a variable is a
//! screw fixed in the frame behind its factor.

use kutzbach_math::matrix::Real;
use kutzbach_math::space::{
    PlacedScrew, Rigid, Vector, cross, dot, length, perpendicular, scale, subtract, three, unit,
};
use kutzbach_model::mechanism::JointKind;

/// A generator through the origin of its factor's frame: (angular; linear).
#[derive(Clone, Debug)]
pub struct Generator<R> {
    /// Angular velocity per unit of the variable.
    pub angular: Vector<R>,
    /// Velocity of the origin per unit of the variable.
    pub linear: Vector<R>,
}

/// An elementary part of a joint's displacement: a constant one, then the exponential of its variables' generators.
#[derive(Clone, Debug)]
pub struct Factor<R> {
    /// Constant displacement before the factor; none is the identity.
    pub before: Option<Rigid<R>>,
    /// One for each variable of the factor.
    pub generators: Vec<Generator<R>>,
}

/// The displacement set of one joint, in the arithmetic `R`: directions are unit vectors, the pitch is in metres per
/// radian.
#[derive(Clone, Debug)]
pub struct JointDisplacement<R> {
    kind: JointKind,
    axis: Vector<R>,
    axis2: Vector<R>,
    pitch: R,
    distance: R,
    factors: Vec<Factor<R>>,
}

/// Where a joint stands: one displacement per factor, and the accumulated value of every variable.
#[derive(Clone, Debug)]
pub struct JointState<R> {
    factors: Vec<Rigid<R>>,
    /// Value of every variable (rad, m). For balls, the accumulated increments, of use near the home pose only.
    pub values: Vec<R>,
}

impl<R> JointState<R> {
    /// A state from one displacement per factor and the values of the variables.
    pub fn from_factors(factors: Vec<Rigid<R>>, values: Vec<R>) -> Self {
        Self { factors, values }
    }

    /// The displacement of every factor.
    pub fn factors(&self) -> &[Rigid<R>] {
        &self.factors
    }
}

impl<R: Real> JointDisplacement<R> {
    /// The elementary factors, in order.
    pub fn factors(&self) -> &[Factor<R>] {
        &self.factors
    }

    /// The displacement set of a kind. `axis` in the predecessor's frame and `axis2` in the successor's must not be zero
    /// where the kind uses them; `pitch` is metres per radian; `distance` is in metres.
    pub fn new(
        kind: JointKind,
        axis: &Vector<R>,
        axis2: &Vector<R>,
        pitch: &R,
        distance: &R,
    ) -> Self {
        let like = pitch;
        let zero = || three(|_| like.zero_like());
        let axis = if kind.uses_axis() { unit(axis) } else { zero() };
        let axis2 = if kind.uses_second_axis() {
            unit(axis2)
        } else {
            zero()
        };
        let base = |i: usize| {
            let mut v = zero();
            v[i] = like.one_like();
            v
        };
        let turn = |a: &Vector<R>| Generator {
            angular: a.clone(),
            linear: zero(),
        };
        let slide = |a: &Vector<R>| Generator {
            angular: zero(),
            linear: a.clone(),
        };
        let helix = |a: &Vector<R>| Generator {
            angular: a.clone(),
            linear: a.clone().map(|x| x * pitch.clone()),
        };
        let single = |generator: Generator<R>| Factor {
            before: None,
            generators: vec![generator],
        };
        let ball = |before: Option<Rigid<R>>| Factor {
            before,
            generators: (0..3).map(|i| turn(&base(i))).collect(),
        };
        let factors = match kind {
            JointKind::Fixed => vec![],
            JointKind::Revolute => vec![single(turn(&axis))],
            JointKind::Prismatic => vec![single(slide(&axis))],
            JointKind::Screw => vec![single(helix(&axis))],
            JointKind::Cylindrical => vec![single(slide(&axis)), single(turn(&axis))],
            JointKind::Universal => vec![single(turn(&axis)), single(turn(&axis2))],
            JointKind::PlanarTranslation => {
                let (e1, e2) = perpendicular(&axis);
                vec![single(slide(&e1)), single(slide(&e2))]
            }
            JointKind::Planar => {
                let (e1, e2) = perpendicular(&axis);
                vec![single(slide(&e1)), single(slide(&e2)), single(turn(&axis))]
            }
            JointKind::Spherical => vec![ball(None)],
            JointKind::Translational => (0..3).map(|i| single(slide(&base(i)))).collect(),
            JointKind::TranslatingScrew => {
                let (e1, e2) = perpendicular(&axis);
                vec![single(slide(&e1)), single(slide(&e2)), single(helix(&axis))]
            }
            JointKind::Schoenflies => {
                let mut factors: Vec<Factor<R>> = (0..3).map(|i| single(slide(&base(i)))).collect();
                factors.push(single(turn(&axis)));
                factors
            }
            JointKind::PointOnLine => vec![ball(None), single(slide(&axis2))],
            JointKind::PointOnPlane => {
                let (e1, e2) = perpendicular(&axis2);
                vec![ball(None), single(slide(&e1)), single(slide(&e2))]
            }
            JointKind::LineOnPlane => {
                let (e1, e2) = perpendicular(&axis2);
                let mut first = single(slide(&e1));
                first.before = Some(into_plane(&axis, &axis2));
                vec![
                    single(turn(&axis)),
                    first,
                    single(slide(&e2)),
                    single(turn(&axis2)),
                ]
            }
            JointKind::Distance => {
                let rod = base(0).map(|x| x * distance.clone());
                vec![
                    Factor {
                        before: None,
                        generators: vec![turn(&base(1)), turn(&base(2))],
                    },
                    ball(Some(Rigid::translation(rod))),
                ]
            }
        };
        Self {
            kind,
            axis,
            axis2,
            pitch: pitch.clone(),
            distance: distance.clone(),
            factors,
        }
    }

    /// The joint's kind.
    pub fn kind(&self) -> JointKind {
        self.kind
    }

    /// Number of variables.
    pub fn freedom(&self) -> usize {
        self.kind.freedom()
    }

    /// The state with all variables zero.
    pub fn home(&self) -> JointState<R> {
        JointState {
            factors: self
                .factors
                .iter()
                .map(|_| Rigid::identity(&self.pitch))
                .collect(),
            values: vec![self.pitch.zero_like(); self.freedom()],
        }
    }

    /// The state with given values; a ball takes them as a rotation vector. Missing values count as zero.
    pub fn at(&self, values: &[R]) -> JointState<R> {
        let mut state = self.home();
        let mut increments = values.to_vec();
        increments.resize(self.freedom(), self.pitch.zero_like());
        self.advance(&mut state, &increments);
        state
    }

    /// The displacement `predecessor_frame -> successor_frame` of a state.
    pub fn displacement(&self, state: &JointState<R>) -> Rigid<R> {
        self.displacement_of(&state.factors)
    }

    /// [`Self::displacement`] where its factors are given.
    pub fn displacement_of(&self, factors: &[Rigid<R>]) -> Rigid<R> {
        self.passed(factors, |_, _| {})
    }

    /// One screw per variable, in the predecessor's joint frame, at a state: the successor's twist relative to the
    /// predecessor is their sum weighted by the rates.
    pub fn screws(&self, state: &JointState<R>) -> Vec<PlacedScrew<R>> {
        self.displacement_and_screws(state).1
    }

    /// [`Self::displacement`] and [`Self::screws`] in one go.
    pub fn displacement_and_screws(
        &self,
        state: &JointState<R>,
    ) -> (Rigid<R>, Vec<PlacedScrew<R>>) {
        let mut screws = Vec::with_capacity(self.freedom());
        let displacement = self.passed(&state.factors, |here, generators| {
            screws.extend(generators.iter().map(|generator| PlacedScrew {
                angular: here.rotate_unless_zero(&generator.angular),
                point: here.translation.clone(),
                linear: here.rotate_unless_zero(&generator.linear),
            }));
        });
        (displacement, screws)
    }

    /// Goes through the joint from factor to factor; `behind` is shown the displacement up to and with each of them.
    fn passed(
        &self,
        values: &[Rigid<R>],
        mut behind: impl FnMut(&Rigid<R>, &[Generator<R>]),
    ) -> Rigid<R> {
        let then = |first: Option<Rigid<R>>, second: &Rigid<R>| {
            first.map_or_else(|| second.clone(), |first| first.compose(second))
        };
        let mut total = None;
        for (factor, value) in self.factors.iter().zip(values) {
            if let Some(before) = &factor.before {
                total = Some(then(total, before));
            }
            let here = then(total, value);
            behind(&here, &factor.generators);
            total = Some(here);
        }
        total.unwrap_or_else(|| Rigid::identity(&self.pitch))
    }

    /// A state found in double precision, taken over into this arithmetic. `double` is the same joint there.
    ///
    /// One variable is applied anew, with all its turns. Several are fitted to the displacement: which directions in a
    /// plane are called the first and second may differ between arithmetics where the choice hangs on the last digit.
    /// Either way the result is a displacement that the joint can make to the last bit, off by rounding in doubles.
    pub fn adopt(&self, double: &JointDisplacement<f64>, state: &JointState<f64>) -> JointState<R> {
        let like = &self.pitch;
        if self.freedom() <= 1 {
            let values: Vec<R> = state.values.iter().map(|v| like.constant(*v)).collect();
            return self.at(&values);
        }
        let reached = double.displacement(state);
        let row = |i: usize| reached.rotation[i].map(|x| like.constant(x));
        // The rotation is orthonormal to double precision only.
        let x = unit(&row(0));
        let y = row(1);
        let y = unit(&subtract(&y, &scale(&x, &dot(&x, &y))));
        let z = cross(&x, &y);
        self.fit(&Rigid {
            rotation: [x, y, z],
            translation: reached.translation.map(|x| like.constant(x)),
        })
    }

    /// Advances every variable by an increment (rad, m).
    pub fn advance(&self, state: &mut JointState<R>, increments: &[R]) {
        let mut next = 0;
        for (factor, value) in self.factors.iter().zip(&mut state.factors) {
            let zero = self.pitch.zero_like();
            let mut angular = three(|_| zero.clone());
            let mut linear = angular.clone();
            for generator in &factor.generators {
                let Some(increment) = increments.get(next) else {
                    return;
                };
                for i in 0..3 {
                    angular[i] =
                        angular[i].clone() + generator.angular[i].clone() * increment.clone();
                    linear[i] = linear[i].clone() + generator.linear[i].clone() * increment.clone();
                }
                state.values[next] = state.values[next].clone() + increment.clone();
                next += 1;
            }
            *value = value.compose(&Rigid::exponential(&angular, &linear));
        }
    }

    /// By how much [`Self::advance`] has to advance every variable to get from one state to another; turns of a ball are
    /// taken the short way.
    pub fn increments(&self, from: &JointState<R>, to: &JointState<R>) -> Vec<R> {
        let mut increments = Vec::with_capacity(self.freedom());
        for ((factor, start), end) in self.factors.iter().zip(&from.factors).zip(&to.factors) {
            let zero = self.pitch.zero_like();
            let turns = |g: &&Generator<R>| g.angular.iter().any(|x| *x != zero);
            if factor.generators.iter().filter(turns).count() > 1 {
                let turn = start.inverse().compose(end).rotation_vector();
                increments.extend(
                    factor
                        .generators
                        .iter()
                        .map(|generator| dot(&generator.angular, &turn)),
                );
            } else {
                let first = increments.len();
                let variables = first..first + factor.generators.len();
                increments.extend(variables.map(|v| to.values[v].clone() - from.values[v].clone()));
            }
        }
        increments
    }

    /// The state whose displacement is a given one, or comes near it where the joint cannot reach it: rotations about
    /// fixed axes are chosen to turn as far as the given rotation does, translations are projected.
    pub fn fit(&self, wanted: &Rigid<R>) -> JointState<R> {
        let zero = self.pitch.zero_like();
        let turn_about = |axis: &Vector<R>, displacement: &Rigid<R>| {
            let r = &displacement.rotation;
            let antisymmetric = [
                r[2][1].clone() - r[1][2].clone(),
                r[0][2].clone() - r[2][0].clone(),
                r[1][0].clone() - r[0][1].clone(),
            ];
            let trace = r[0][0].clone() + r[1][1].clone() + r[2][2].clone();
            dot(axis, &antisymmetric).atan2(&(trace - dot(axis, &displacement.rotate(axis))))
        };
        let angle_between = |axis: &Vector<R>, from: &Vector<R>, to: &Vector<R>| {
            dot(axis, &cross(from, to)).atan2(&(dot(from, to) - dot(axis, from) * dot(axis, to)))
        };
        let rotated_by = |axis: &Vector<R>, angle: &R| {
            let (sine, cosine) = angle.sin_cos();
            Rigid::rotation(axis, &cosine, &sine)
        };
        let t = &wanted.translation;
        match self.kind {
            JointKind::Fixed => self.home(),
            JointKind::Revolute => self.at(&[turn_about(&self.axis, wanted)]),
            JointKind::Prismatic => self.at(&[dot(&self.axis, t)]),
            JointKind::Screw => self.at(&[self.whole_turns(turn_about(&self.axis, wanted), t)]),
            JointKind::Cylindrical => {
                self.at(&[dot(&self.axis, t), turn_about(&self.axis, wanted)])
            }
            JointKind::Universal => {
                let first = angle_between(&self.axis, &self.axis2, &wanted.rotate(&self.axis2));
                let rest = rotated_by(&self.axis, &first).inverse().compose(wanted);
                self.at(&[first, turn_about(&self.axis2, &rest)])
            }
            JointKind::PlanarTranslation | JointKind::Planar | JointKind::TranslatingScrew => {
                let (e1, e2) = perpendicular(&self.axis);
                let angle = self.whole_turns(turn_about(&self.axis, wanted), t);
                let mut values = vec![dot(&e1, t), dot(&e2, t), angle];
                values.truncate(self.freedom());
                self.at(&values)
            }
            JointKind::Translational | JointKind::Schoenflies => {
                let mut values = t.to_vec();
                if self.kind == JointKind::Schoenflies {
                    values.push(turn_about(&self.axis, wanted));
                }
                self.at(&values)
            }
            JointKind::Spherical => self.at(&wanted.rotation_vector()),
            JointKind::PointOnLine | JointKind::PointOnPlane => {
                let behind = wanted.rotate_back(t);
                let mut values = wanted.rotation_vector().to_vec();
                if self.kind == JointKind::PointOnLine {
                    values.push(dot(&self.axis2, &behind));
                } else {
                    let (e1, e2) = perpendicular(&self.axis2);
                    values.extend([dot(&e1, &behind), dot(&e2, &behind)]);
                }
                self.at(&values)
            }
            JointKind::LineOnPlane => {
                let start = into_plane(&self.axis, &self.axis2);
                let normal = start.rotate(&self.axis2);
                let first = angle_between(&self.axis, &normal, &wanted.rotate(&self.axis2));
                let turned = rotated_by(&self.axis, &first).compose(&start);
                let rest = turned.inverse().compose(wanted);
                let (e1, e2) = perpendicular(&self.axis2);
                let values = [
                    first,
                    dot(&e1, &rest.translation),
                    dot(&e2, &rest.translation),
                    turn_about(&self.axis2, &rest),
                ];
                self.at(&values)
            }
            JointKind::Distance => {
                let reach = length(t);
                let mut state = self.home();
                if reach.to_f64() > 0.0 {
                    let mut x = three(|_| zero.clone());
                    x[0] = zero.one_like();
                    state.factors[0] = shortest_rotation(&x, &unit(t));
                }
                state.factors[1] = state.factors[0].inverse().compose(wanted);
                state.factors[1].translation = three(|_| zero.clone());
                state
            }
        }
    }

    /// The turn of a screw that agrees best with how far it has travelled.
    fn whole_turns(&self, angle: R, travelled: &Vector<R>) -> R {
        if !self.kind.uses_lead() || !(self.pitch.abs().to_f64() > 0.0) {
            return angle;
        }
        let wanted = (dot(&self.axis, travelled) / self.pitch.clone()).to_f64();
        let turns = ((wanted - angle.to_f64()) / std::f64::consts::TAU).round();
        if !turns.is_finite() || turns == 0.0 {
            return angle;
        }
        // Whole turns in the arithmetic at hand: π = atan2(0, −1).
        let pi = angle.zero_like().atan2(&-angle.one_like());
        let two_turns = angle.constant(2.0 * turns);
        angle + pi * two_turns
    }

    /// The unit axis in the predecessor's frame; zero where the kind has none.
    pub fn axis(&self) -> &Vector<R> {
        &self.axis
    }

    /// The unit second axis in the successor's frame; zero where the kind has none.
    pub fn second_axis(&self) -> &Vector<R> {
        &self.axis2
    }

    /// Two unit vectors across the axis, the in-plane directions of planar kinds. Not finite without an axis.
    pub fn across(&self) -> (Vector<R>, Vector<R>) {
        perpendicular(&self.axis)
    }

    /// The fixed distance of a distance joint, in metres.
    pub fn distance(&self) -> &R {
        &self.distance
    }
}

/// A small rotation that makes a plane's normal perpendicular to a line's direction: the smallest one where the two are
/// not nearly parallel, about any perpendicular axis where they are; identity where nothing is to be done.
fn into_plane<R: Real>(line: &Vector<R>, normal: &Vector<R>) -> Rigid<R> {
    let along = dot(line, normal);
    if along.is_zero() {
        return Rigid::identity(&line[0]);
    }
    // The part of the normal across the line: of nearly parallel directions it keeps few digits, and of parallel ones
    // rounding errors only. Above a thousandth of the normal, a second reduction restores what the first one lost.
    let across = subtract(normal, &scale(line, &along));
    let target = if length(&across).to_f64() > 1e-3 {
        let across = unit(&across);
        unit(&subtract(&across, &scale(line, &dot(line, &across))))
    } else {
        perpendicular(line).0
    };
    shortest_rotation(normal, &target)
}

/// A rotation that takes one unit vector to another: by the smallest angle, unless they are nearly opposite, where that
/// axis would be rounding errors and a half turn about a fixed one comes first.
fn shortest_rotation<R: Real>(from: &Vector<R>, to: &Vector<R>) -> Rigid<R> {
    let cosine = dot(from, to);
    if cosine.to_f64() < -0.9 {
        let half_turn = Rigid::rotation(
            &perpendicular(from).0,
            &-cosine.one_like(),
            &cosine.zero_like(),
        );
        return shortest_rotation(&from.clone().map(|x| -x), to).compose(&half_turn);
    }
    let axis = cross(from, to);
    let sine = length(&axis);
    if !(sine.to_f64() > 0.0) {
        return Rigid::identity(&cosine);
    }
    Rigid::rotation(&axis.map(|x| x / sine.clone()), &cosine, &sine)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
