//! The equations of motion of bodies that constraints hold.
//!
//! M a = f + Gᵀ λ, with accelerations that keep G a = −γ, in coordinates of all bodies: positions of the centres of mass, quaternions of
//! the principal axes, velocities, and angular velocities along those axes. In units in which every mass and moment is one, the
//! multipliers come from S λ = −γ − G f with S = G Gᵀ (`factor`).
//!
//! The constraints are no part of the differential equation: they are kept by projection. Within a step that begins at y₀ a state y stands
//! for the state P(y) on the constraints that is reached along M⁻¹ G(y₀)ᵀ, and the derivative at y is that at P(y). So y' = F(P(y)) is an
//! ordinary differential equation, smooth, that leaves the constraints' manifold alone, and any method for such equations keeps its order
//! (Hairer and Wanner 1996, *Solving Ordinary Differential Equations II*, VII.2). Nothing drifts, and a redundant row contradicts nothing.

use super::constraint::{Gradient, Held, Moving, Placed, Row, Turning};
use super::factor::{Elimination, End, Factor};
use super::relation::{Coordinate, Measure, Relation, Share};
use nalgebra::{Matrix3, Quaternion, UnitQuaternion, Vector3};
use std::ops::Range;

/// Numbers of a body's state: centre, quaternion (x, y, z, w), velocity, angular velocity along its own axes.
pub(super) const NUMBERS: usize = 13;

/// A body that moves.
#[derive(Clone, Debug)]
pub(super) struct Body {
    /// kg.
    pub mass: f64,
    /// kg m², about the principal axes.
    pub moments: Vector3<f64>,
}

/// A mechanism as bodies and constraints.
#[derive(Debug)]
pub(super) struct System {
    pub bodies: Vec<Body>,
    pub joints: Vec<Held>,
    pub relations: Vec<Relation>,
    /// Damped coordinates (N s/m, N m s).
    pub dampings: Vec<(Coordinate, f64)>,
    /// m/s².
    pub gravity: Vector3<f64>,
    /// Characteristic length (m).
    pub length: f64,
    layout: Layout,
}

/// Where the rows of the constraints are.
#[derive(Debug)]
struct Layout {
    groups: Vec<Range<usize>>,
    ends: Vec<End>,
    /// For every relation and term, the places of the two ends; `None` on the ground.
    terms: Vec<Vec<[Option<usize>; 2]>>,
    /// The same of joints.
    sides: Vec<[Option<usize>; 2]>,
    bodies: usize,
    rows: usize,
    jacobians: usize,
    elimination: Elimination,
}

/// The constraints' Jacobian at a state, in units of one mass, and S factored.
#[derive(Clone, Debug, Default)]
pub(super) struct Linearised {
    jacobians: Vec<[f64; 6]>,
    factor: Factor,
}

impl Linearised {
    /// How many constraints are independent here.
    pub fn rank(&self) -> usize {
        self.factor.rank()
    }
}

/// What an evaluation needs beside.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    rotations: Vec<Matrix3<f64>>,
    centres: Vec<Vector3<f64>>,
    velocities: Vec<Vector3<f64>>,
    spins: Vec<Vector3<f64>>,
    placed: Vec<Placed>,
    values: Vec<f64>,
    right: Vec<f64>,
    multipliers: Vec<f64>,
    begun: Vec<f64>,
    pushed: Vec<[f64; 6]>,
    forces: Vec<[f64; 6]>,
    /// States from which the constraints were reached slowly.
    hard: usize,
}

/// Why a state has no derivative.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Lost {
    /// The constraints cannot be reached from it: the step is too long, or the pose singular.
    Unreachable,
    /// Constraints that followed from others do so no longer.
    Independent,
}

/// Constraints are kept to this (characteristic lengths, rad): some roundings of numbers that are near one.
const CLOSED: f64 = 1e-13;

/// To this where rounding leaves no less.
const NEARLY_CLOSED: f64 = 1e-10;

/// What follows from others is kept to this: rows are independent from singular values of 3e-6 on (`factor`), which may magnify what is
/// left of the others so much.
const IMPLIED: f64 = 1e-7;

/// Turns that are counted are less than that in a step (rad), well below the half turn that they could be mistaken by.
const MOST_TURN: f64 = 2.0;

/// Corrections shrink by the turn in a step.
const MOST_CORRECTIONS: usize = 40;

/// Corrections that double the digits need no more than this; near a singular pose each gives one bit.
const FEW_CORRECTIONS: usize = 8;

/// A motion that passes a singular pose meets some such states, one that stays there nothing else.
const MOST_HARD: usize = 100;

/// Where they shrink by less, it is not by the turn in a step but near a singular pose.
const SLOW: f64 = 0.7;

/// Linear equations are solved to this share of their right side: some roundings.
const SATISFIED: f64 = 1e-13;

/// Each pass but the first takes what rounding left of the one before.
const MOST_PASSES: usize = 3;

/// Whether the constraints are kept, given how far they are from it and were a correction before.
fn is_closed(off: f64, before: f64) -> bool {
    off <= CLOSED || (off <= NEARLY_CLOSED && !(off < 0.5 * before))
}

impl System {
    /// Lays out the rows. `joints` are given with a ground that is body number `bodies.len()`.
    pub fn new(
        bodies: Vec<Body>,
        joints: Vec<Held>,
        relations: Vec<Relation>,
        dampings: Vec<(Coordinate, f64)>,
        (gravity, length): (Vector3<f64>, f64),
    ) -> Self {
        let layout = Layout::new(bodies.len(), &joints, &relations);
        Self {
            bodies,
            joints,
            relations,
            dampings,
            gravity,
            length,
            layout,
        }
    }

    /// Multiplications of one evaluation, about.
    pub fn work(&self) -> f64 {
        // A row is a hundred of them, a body as many.
        self.layout.elimination.work + 100.0 * (self.layout.rows + self.bodies.len()) as f64
    }

    /// Rotations and centres of all bodies, the ground last, and where all joints are.
    fn place(&self, state: &[f64], scratch: &mut Scratch) {
        scratch.rotations.clear();
        scratch.centres.clear();
        for body in state.chunks_exact(NUMBERS) {
            scratch.rotations.push(rotation(body));
            scratch
                .centres
                .push(Vector3::new(body[0], body[1], body[2]));
        }
        scratch.rotations.push(Matrix3::identity());
        scratch.centres.push(Vector3::zeros());
        scratch.placed.clear();
        for joint in &self.joints {
            let placed = joint.place(&scratch.rotations, &scratch.centres);
            scratch.placed.push(placed);
        }
    }

    /// How far every row is from being kept at a time (s), in its own units.
    fn values(&self, time: f64, placed: &[Placed], values: &mut Vec<f64>) {
        values.clear();
        for (joint, placed) in self.joints.iter().zip(placed) {
            values.extend(
                joint
                    .rows
                    .iter()
                    .map(|row| row.value(placed) * self.unit(row)),
            );
        }
        for relation in &self.relations {
            let terms = relation.terms.iter();
            let sum: f64 = terms
                .map(|(coordinate, share)| share.at(coordinate.value(&placed[coordinate.joint]))[0])
                .sum();
            let wanted = relation.offset + relation.rate * time;
            values.push((sum - wanted) * relation.scale(self.length));
        }
    }

    fn unit(&self, row: &Row) -> f64 {
        if row.is_length() {
            1.0 / self.length
        } else {
            1.0
        }
    }

    fn linearise(&self, scratch: &Scratch, into: &mut Linearised) {
        let Scratch {
            rotations, placed, ..
        } = scratch;
        into.jacobians.clear();
        into.jacobians.resize(self.layout.jacobians, [0.0; 6]);
        let mut add = |place: Option<usize>, side: usize, body: usize, gradient: &Gradient, by| {
            if let (Some(place), Some(own)) = (place, self.bodies.get(body)) {
                let (linear, angular) = (gradient.linear[side], gradient.angular[side]);
                let turned = rotations[body].tr_mul(&angular);
                let root = own.mass.sqrt().recip();
                let entry = &mut into.jacobians[place];
                for i in 0..3 {
                    entry[i] += by * root * linear[i];
                    entry[3 + i] += by * turned[i] / own.moments[i].sqrt();
                }
            }
        };
        for ((joint, placed), places) in self.joints.iter().zip(placed).zip(&self.layout.sides) {
            for (index, row) in joint.rows.iter().enumerate() {
                let gradient = row.gradient(placed);
                for side in [0, 1] {
                    let place = places[side].map(|first| first + index);
                    add(
                        place,
                        side,
                        joint.sides[side].body,
                        &gradient,
                        self.unit(row),
                    );
                }
            }
        }
        for (relation, places) in self.relations.iter().zip(&self.layout.terms) {
            let scale = relation.scale(self.length);
            for ((coordinate, share), places) in relation.terms.iter().zip(places) {
                let joint = &self.joints[coordinate.joint];
                let gradient = coordinate.gradient(&placed[coordinate.joint]);
                let [_, slope, _] = share.at(coordinate.value(&placed[coordinate.joint]));
                for side in [0, 1] {
                    add(
                        places[side],
                        side,
                        joint.sides[side].body,
                        &gradient,
                        scale * slope,
                    );
                }
            }
        }
        self.layout
            .elimination
            .factor(&into.jacobians, &mut into.factor);
    }

    /// Moves a state along the directions of a linearisation until the constraints are kept. Near a singular pose, where these are too far
    /// from the constraints' own, it is moved along those, anew at each correction.
    fn close(
        &self,
        state: &mut [f64],
        time: f64,
        along: &Linearised,
        (here, scratch): (&mut Linearised, &mut Scratch),
    ) -> Result<(), Lost> {
        scratch.begun.clear();
        scratch.begun.extend_from_slice(state);
        scratch.multipliers.clear();
        scratch.multipliers.resize(self.layout.rows, 0.0);
        let mut before = f64::INFINITY;
        for _ in 0..MOST_CORRECTIONS {
            self.look(state, time, scratch);
            let off = self.largest(&scratch.values, |row| !along.factor.leaves_out(row));
            if is_closed(off, before) {
                return Ok(());
            }
            if !(off < SLOW * before) {
                break;
            }
            before = off;
            self.layout
                .elimination
                .solve(&along.factor, &mut scratch.values);
            for (sum, value) in scratch.multipliers.iter_mut().zip(&scratch.values) {
                *sum -= value;
            }
            self.layout
                .transposed(&along.jacobians, &scratch.multipliers, &mut scratch.pushed);
            state.copy_from_slice(&scratch.begun);
            self.displace(state, &scratch.pushed);
        }
        state.copy_from_slice(&scratch.begun);
        before = f64::INFINITY;
        for correction in 0..MOST_CORRECTIONS {
            if correction == FEW_CORRECTIONS {
                scratch.hard += 1;
                if scratch.hard > MOST_HARD {
                    break;
                }
            }
            self.look(state, time, scratch);
            self.linearise(scratch, here);
            let off = self.largest(&scratch.values, |row| !here.factor.leaves_out(row));
            if is_closed(off, before) {
                return Ok(());
            }
            before = off;
            self.layout
                .elimination
                .solve(&here.factor, &mut scratch.values);
            for value in &mut scratch.values {
                *value = -*value;
            }
            self.layout
                .transposed(&here.jacobians, &scratch.values, &mut scratch.pushed);
            self.displace(state, &scratch.pushed);
        }
        Err(Lost::Unreachable)
    }

    /// Where all is, and how far every row is from being kept.
    fn look(&self, state: &[f64], time: f64, scratch: &mut Scratch) {
        self.place(state, scratch);
        let mut values = std::mem::take(&mut scratch.values);
        self.values(time, &scratch.placed, &mut values);
        scratch.values = values;
    }

    fn displace(&self, state: &mut [f64], pushed: &[[f64; 6]]) {
        let bodies = state.chunks_exact_mut(NUMBERS);
        for (body, (own, by)) in bodies.zip(self.bodies.iter().zip(pushed)) {
            displace(body, own, by);
        }
    }

    fn largest(&self, values: &[f64], counts: impl Fn(usize) -> bool) -> f64 {
        let values = values.iter().enumerate().filter(|(row, _)| counts(*row));
        values.fold(0.0, |most: f64, (_, value)| {
            // What is not a number must not pass for small.
            if value.abs() <= most {
                most
            } else {
                value.abs()
            }
        })
    }

    /// Brings a state onto the constraints, linearises there, and gives its derivative.
    ///
    /// # Errors
    /// Where the constraints cannot be reached.
    pub fn derivative(
        &self,
        (state, time): (&mut [f64], f64),
        along: Option<&Linearised>,
        here: &mut Linearised,
        scratch: &mut Scratch,
        derivative: &mut [f64],
    ) -> Result<(), Lost> {
        normalise(state);
        match along {
            Some(along) => self.close(state, time, along, (&mut *here, &mut *scratch))?,
            None => self.place(state, scratch),
        }
        if !self.counts_turns(&scratch.placed) {
            return Err(Lost::Unreachable);
        }
        self.linearise(scratch, here);
        self.keep_speeds(state, here, scratch);
        self.accelerate(state, here, scratch);
        let bodies = state.chunks_exact(NUMBERS).zip(&scratch.forces);
        for (((body, force), own), out) in bodies
            .zip(&self.bodies)
            .zip(derivative.chunks_exact_mut(NUMBERS))
        {
            out[..3].copy_from_slice(&body[7..10]);
            let turned = quaternion(body) * Quaternion::from_parts(0.0, spin(body)) * 0.5;
            out[3..7].copy_from_slice(turned.coords.as_slice());
            for i in 0..3 {
                out[7 + i] = force[i] / own.mass.sqrt();
                out[10 + i] = force[3 + i] / own.moments[i].sqrt();
            }
        }
        Ok(())
    }

    /// Brings a state next to the constraints onto them, as far as that is possible; its speeds stay as they are.
    pub fn settle(
        &self,
        (state, time): (&mut Vec<f64>, f64),
        along: &Linearised,
        here: &mut Linearised,
        scratch: &mut Scratch,
    ) {
        normalise(state);
        let before = state.clone();
        if self.close(state, time, along, (here, scratch)).is_err() {
            *state = before;
        }
    }

    /// Whether turns have not come so far since the step began that they could be mistaken by a whole one.
    fn counts_turns(&self, placed: &[Placed]) -> bool {
        let near = |turning: &Turning, joint: usize| {
            (turning.angle(&placed[joint]) - turning.near).abs() < MOST_TURN
        };
        let joints = self.joints.iter().enumerate();
        let terms = self.relations.iter().flat_map(|relation| &relation.terms);
        joints
            .flat_map(|(joint, held)| held.rows.iter().map(move |row| (joint, row)))
            .all(|(joint, row)| match row {
                Row::Helix { turning, .. } => near(turning, joint),
                _ => true,
            })
            && terms
                .into_iter()
                .all(|(coordinate, _)| match &coordinate.measure {
                    Measure::Turn(turning) => near(turning, coordinate.joint),
                    Measure::Travel(_) => true,
                })
    }

    /// Takes out of the velocities what the constraints do not allow, and puts in what drives want.
    fn keep_speeds(&self, state: &mut [f64], here: &Linearised, scratch: &mut Scratch) {
        let moving = state.chunks_exact(NUMBERS).zip(&self.bodies);
        scratch.forces.clear();
        scratch.forces.extend(moving.map(|(body, own)| {
            std::array::from_fn(|i| match i {
                0..3 => body[7 + i] * own.mass.sqrt(),
                _ => body[7 + i] * own.moments[i - 3].sqrt(),
            })
        }));
        scratch.values.clear();
        scratch.values.resize(self.layout.rows, 0.0);
        let first = self.layout.rows - self.relations.len();
        for (value, relation) in scratch.values[first..].iter_mut().zip(&self.relations) {
            *value = relation.rate * relation.scale(self.length);
        }
        self.satisfy(here, scratch);
        for ((body, speed), own) in state
            .chunks_exact_mut(NUMBERS)
            .zip(&scratch.forces)
            .zip(&self.bodies)
        {
            for i in 0..3 {
                body[7 + i] = speed[i] / own.mass.sqrt();
                body[10 + i] = speed[3 + i] / own.moments[i].sqrt();
            }
        }
    }

    /// Adds Gᵀ λ to what `forces` holds, so that G times it is what `values` holds; again where rounding left too much.
    fn satisfy(&self, here: &Linearised, scratch: &mut Scratch) {
        let mut first = 0.0;
        for pass in 0..MOST_PASSES {
            self.layout
                .times(&here.jacobians, &scratch.forces, &mut scratch.right);
            for (right, value) in scratch.right.iter_mut().zip(&scratch.values) {
                *right = value - *right;
            }
            let off = self.largest(&scratch.right, |row| !here.factor.leaves_out(row));
            if pass == 0 {
                first = off;
            } else if off <= SATISFIED * first {
                return;
            }
            self.layout
                .elimination
                .solve(&here.factor, &mut scratch.right);
            self.layout
                .transposed(&here.jacobians, &scratch.right, &mut scratch.pushed);
            for (force, pushed) in scratch.forces.iter_mut().zip(&scratch.pushed) {
                for (sum, by) in force.iter_mut().zip(pushed) {
                    *sum += by;
                }
            }
        }
    }

    /// Leaves the accelerations, times the roots of mass and moments, in `forces`.
    fn accelerate(&self, state: &[f64], here: &Linearised, scratch: &mut Scratch) {
        scratch.velocities.clear();
        scratch.spins.clear();
        scratch.forces.clear();
        for ((body, own), turn) in state
            .chunks_exact(NUMBERS)
            .zip(&self.bodies)
            .zip(&scratch.rotations)
        {
            let spin = spin(body);
            scratch
                .velocities
                .push(Vector3::new(body[7], body[8], body[9]));
            scratch.spins.push(turn * spin);
            let gyroscopic = -spin.cross(&own.moments.component_mul(&spin));
            let weight = self.gravity * own.mass.sqrt();
            scratch.forces.push(std::array::from_fn(|i| match i {
                0..3 => weight[i],
                _ => gyroscopic[i - 3] / own.moments[i - 3].sqrt(),
            }));
        }
        scratch.velocities.push(Vector3::zeros());
        scratch.spins.push(Vector3::zeros());
        scratch.values.clear();
        for (joint, placed) in self.joints.iter().zip(&scratch.placed) {
            let moving = joint.motion(placed, &scratch.velocities, &scratch.spins);
            let bias = |row: &Row| -row.bias(placed, &moving) * self.unit(row);
            scratch.values.extend(joint.rows.iter().map(bias));
        }
        let moving = |joint: usize, placed: &Placed| -> Moving {
            self.joints[joint].motion(placed, &scratch.velocities, &scratch.spins)
        };
        for relation in &self.relations {
            let bias = relation.terms.iter().map(|(coordinate, share)| {
                let placed = &scratch.placed[coordinate.joint];
                let [_, slope, curvature] = share.at(coordinate.value(placed));
                let own = coordinate.bias(placed, &moving(coordinate.joint, placed));
                match curvature == 0.0 {
                    true => slope * own,
                    false => slope * own + curvature * self.rate(coordinate, scratch).powi(2),
                }
            });
            let bias: f64 = bias.sum();
            scratch.values.push(-bias * relation.scale(self.length));
        }
        self.damp(scratch);
        self.satisfy(here, scratch);
    }

    /// How fast a coordinate changes (rad/s, m/s).
    fn rate(&self, coordinate: &Coordinate, scratch: &Scratch) -> f64 {
        let gradient = coordinate.gradient(&scratch.placed[coordinate.joint]);
        let sides = &self.joints[coordinate.joint].sides;
        let of_side = |side: usize| {
            let body = sides[side].body;
            gradient.linear[side].dot(&scratch.velocities[body])
                + gradient.angular[side].dot(&scratch.spins[body])
        };
        of_side(0) + of_side(1)
    }

    fn damp(&self, scratch: &mut Scratch) {
        for (coordinate, damping) in &self.dampings {
            let gradient = coordinate.gradient(&scratch.placed[coordinate.joint]);
            let bodies = [0, 1].map(|side| self.joints[coordinate.joint].sides[side].body);
            let rate = self.rate(coordinate, scratch);
            for (side, &index) in bodies.iter().enumerate() {
                let Some(body) = self.bodies.get(index) else {
                    continue;
                };
                let turned = scratch.rotations[index].tr_mul(&gradient.angular[side]);
                let force = &mut scratch.forces[index];
                for i in 0..3 {
                    force[i] -= damping * rate * gradient.linear[side][i] / body.mass.sqrt();
                    force[3 + i] -= damping * rate * turned[i] / body.moments[i].sqrt();
                }
            }
        }
    }

    /// Looks at a state that was reached: whether what follows from other constraints is still kept, and how far joints have turned.
    ///
    /// # Errors
    /// Where it is not.
    pub fn arrive(&mut self, state: &[f64], time: f64, scratch: &mut Scratch) -> Result<(), Lost> {
        self.look(state, time, scratch);
        let off = self.largest(&scratch.values, |_| true);
        if !(off <= IMPLIED) {
            return Err(Lost::Independent);
        }
        let helices = self.joints.iter_mut().zip(&scratch.placed);
        let helices = helices.flat_map(|(joint, placed)| {
            joint.rows.iter_mut().filter_map(move |row| match row {
                Row::Helix { turning, .. } => Some((turning, placed)),
                _ => None,
            })
        });
        let terms = self
            .relations
            .iter_mut()
            .flat_map(|relation| &mut relation.terms);
        let turns = terms.filter_map(|(coordinate, _)| match &mut coordinate.measure {
            Measure::Turn(turning) => Some((turning, &scratch.placed[coordinate.joint])),
            Measure::Travel(_) => None,
        });
        for (turning, placed) in helices.chain(turns) {
            turning.near = turning.angle(placed);
        }
        Ok(())
    }
}

impl Layout {
    fn new(bodies: usize, joints: &[Held], relations: &[Relation]) -> Self {
        let (mut groups, mut ends) = (Vec::new(), Vec::new());
        let (mut rows, mut jacobians) = (0, 0);
        let mut end = |body: usize, group: usize, count: usize, ends: &mut Vec<End>| {
            if body >= bodies || count == 0 {
                return None;
            }
            let same = |end: &&End| end.group == group && end.body == body;
            if let Some(known) = ends
                .iter()
                .rev()
                .take_while(|e| e.group == group)
                .find(same)
            {
                return Some(known.first);
            }
            let first = jacobians;
            ends.push(End { body, group, first });
            jacobians += count;
            Some(first)
        };
        let mut sides = Vec::with_capacity(joints.len());
        for joint in joints {
            let (group, count) = (groups.len(), joint.rows.len());
            groups.push(rows..rows + count);
            rows += count;
            sides.push([0, 1].map(|side| end(joint.sides[side].body, group, count, &mut ends)));
        }
        let mut terms = Vec::with_capacity(relations.len());
        for relation in relations {
            let group = groups.len();
            groups.push(rows..rows + 1);
            rows += 1;
            let of = |(coordinate, _): &(Coordinate, Share)| {
                let held = &joints[coordinate.joint];
                [0, 1].map(|side| end(held.sides[side].body, group, 1, &mut ends))
            };
            terms.push(relation.terms.iter().map(of).collect());
        }
        let elimination = Elimination::new(&groups, &ends, bodies);
        Self {
            groups,
            ends,
            terms,
            sides,
            bodies,
            rows,
            jacobians,
            elimination,
        }
    }

    /// G x.
    fn times(&self, jacobians: &[[f64; 6]], x: &[[f64; 6]], out: &mut Vec<f64>) {
        out.clear();
        out.resize(self.rows, 0.0);
        for end in &self.ends {
            let by = &x[end.body];
            let rows = self.groups[end.group].clone();
            for (sum, row) in out[rows].iter_mut().zip(&jacobians[end.first..]) {
                *sum += row.iter().zip(by).map(|(a, b)| a * b).sum::<f64>();
            }
        }
    }

    /// Gᵀ λ.
    fn transposed(&self, jacobians: &[[f64; 6]], multipliers: &[f64], out: &mut Vec<[f64; 6]>) {
        out.clear();
        out.resize(self.bodies, [0.0; 6]);
        for end in &self.ends {
            let rows = self.groups[end.group].clone();
            let sum = &mut out[end.body];
            for (by, row) in multipliers[rows].iter().zip(&jacobians[end.first..]) {
                for (sum, entry) in sum.iter_mut().zip(row) {
                    *sum += by * entry;
                }
            }
        }
    }
}

fn quaternion(body: &[f64]) -> Quaternion<f64> {
    Quaternion::new(body[6], body[3], body[4], body[5])
}

fn rotation(body: &[f64]) -> Matrix3<f64> {
    UnitQuaternion::new_unchecked(quaternion(body))
        .to_rotation_matrix()
        .into_inner()
}

fn spin(body: &[f64]) -> Vector3<f64> {
    Vector3::new(body[10], body[11], body[12])
}

fn normalise(state: &mut [f64]) {
    for body in state.chunks_exact_mut(NUMBERS) {
        let length = body[3..7].iter().map(|x| x * x).sum::<f64>().sqrt();
        for x in &mut body[3..7] {
            *x /= length;
        }
    }
}

/// Moves a body, given in units of one mass.
fn displace(body: &mut [f64], own: &Body, by: &[f64; 6]) {
    for i in 0..3 {
        body[i] += by[i] / own.mass.sqrt();
    }
    let turn = Vector3::from_fn(|i, _| by[3 + i] / own.moments[i].sqrt());
    let turned = quaternion(body) * UnitQuaternion::from_scaled_axis(turn).into_inner();
    body[3..7].copy_from_slice(turned.coords.as_slice());
}

/// A state of rest of a body.
pub(super) fn at_rest(pose: &kutzbach_closure::Rigid<f64>) -> [f64; NUMBERS] {
    let mut state = [0.0; NUMBERS];
    state[..3].copy_from_slice(&pose.translation);
    state[3..7].copy_from_slice(&pose.quaternion());
    state
}

/// `world_from_body`.
pub(super) fn pose(body: &[f64]) -> kutzbach_closure::Rigid<f64> {
    let turn = rotation(body);
    kutzbach_closure::Rigid {
        rotation: [0, 1, 2].map(|i| [0, 1, 2].map(|j| turn[(i, j)])),
        translation: [body[0], body[1], body[2]],
    }
}

/// Angular velocity (rad/s) and velocity of the point at the world's origin (m/s), in the world.
pub(super) fn twist(body: &[f64]) -> [f64; 6] {
    let angular = rotation(body) * spin(body);
    let centre = Vector3::new(body[0], body[1], body[2]);
    let linear = Vector3::new(body[7], body[8], body[9]) - angular.cross(&centre);
    let ([a, b, c], [u, v, w]) = (angular.into(), linear.into());
    [a, b, c, u, v, w]
}

/// Kinetic and potential energy (J).
pub(super) fn energy(own: &Body, body: &[f64], gravity: &Vector3<f64>) -> (f64, f64) {
    let speed = Vector3::new(body[7], body[8], body[9]);
    let spin = spin(body);
    let turning = spin.dot(&own.moments.component_mul(&spin));
    let height = gravity.dot(&Vector3::new(body[0], body[1], body[2]));
    (
        0.5 * (own.mass * speed.norm_squared() + turning),
        -own.mass * height,
    )
}
