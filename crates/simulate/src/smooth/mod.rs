//! An integrator for smooth scenes: bodies, joints, gravity, damping and drives whose rate nothing holds up.
//!
//! | file | does |
//! |---|---|
//! | `constraint`, `relation` | joints, couplings and drives as scalar constraints |
//! | `shares` | bodies of many joints, as several in one place |
//! | `factor` | the matrix of all constraints, sparsely |
//! | `system` | the equations of motion, and projection on the constraints |
//! | `runge_kutta` | steps of order five |
//!
//! Where a mechanism touches, sticks or stops, motion is not smooth and no method of high order keeps its order; such scenes are the
//! engine's ([`SERVING`]).

mod constraint;
mod factor;
mod relation;
mod runge_kutta;
mod shares;
mod system;

use super::WorldError;
use super::inertia::{self, Mass};
use super::options::{Energy, Pieces};
use super::scene_run::{Moves, RUNGE_KUTTA_STEP, Scene, SceneOptions, Stopped, looks_in};
use constraint::{Held, Side, Turning, rows_of};
use kutzbach_closure::{Geometry, JointState, Rigid};
use kutzbach_model::mechanism::{JointKind, Mechanism};
use nalgebra::{Matrix3, Vector3};
use relation::{Coordinate, Measure, Relation, Share};
use runge_kutta::{EVALUATIONS, Stepper};
use serde::{Deserialize, Serialize};
use system::{Body, Lost, NUMBERS, System};

/// What makes a scene move step by step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Integrator {
    /// Runge-Kutta steps of order five on the constraints.
    RungeKutta,
    /// The physics engine.
    Engine,
}

/// Which integrator serves an effect, and why.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Serving {
    /// The effect, as it is found in a scene.
    pub effect: &'static str,
    /// What integrates scenes with it.
    pub integrator: Integrator,
    /// Why.
    pub because: &'static str,
}

const fn smooth(effect: &'static str, because: &'static str) -> Serving {
    Serving {
        effect,
        integrator: Integrator::RungeKutta,
        because,
    }
}

const fn engine(effect: &'static str, because: &'static str) -> Serving {
    Serving {
        effect,
        integrator: Integrator::Engine,
        because,
    }
}

const GRAVITY: Serving = smooth("gravity", "a constant force");
const DAMPING: Serving = smooth(
    "damping of a joint of one freedom",
    "a force in proportion to the rate",
);
const DRIVE: Serving = smooth(
    "a drive without a largest force",
    "a constraint that depends on time",
);
const UNREACHED: Serving = smooth("limits that are not reached", "they act on nothing");
pub(super) const REACHED: Serving = engine("limits that are reached", "a stop is an impact");
const CONTACT: Serving = engine("contact", "shapes strike and slide on one another");
const FRICTION: Serving = engine(
    "dry friction",
    "its force jumps where a joint comes to rest",
);
const CAPPED: Serving = engine("a drive with a largest force", "it slips beyond that force");
const SEVERAL: Serving = engine(
    "a drive or damping of a joint of several freedoms",
    "only one variable of its own has a plain measure",
);
pub(super) const SINGULAR: Serving = engine(
    "a pose where the number of independent constraints changes",
    "which way the mechanism goes on is not settled by the equations of motion",
);

/// Which integrator serves which effects.
pub const SERVING: [Serving; 10] = [
    GRAVITY, DAMPING, DRIVE, UNREACHED, REACHED, CONTACT, FRICTION, CAPPED, SEVERAL, SINGULAR,
];

/// Whether the equations of motion say which way a scene moves: not where two branches meet, or where a mechanism is shaky, at its start or,
/// where nothing but these equations moves it, on its way.
///
/// # Errors
/// As [`SmoothWorld::new`].
pub(super) fn goes_one_way(scene: &Scene<'_>) -> Result<bool, WorldError> {
    let Scene {
        mechanism,
        geometry,
        start,
        options,
    } = *scene;
    let mut shortly = options.clone();
    let one_freedom = |joint: usize| {
        mechanism
            .joints()
            .get(joint)
            .is_some_and(|j| j.freedom() == 1)
    };
    shortly.drives.retain(|drive| one_freedom(drive.joint));
    shortly.runge_kutta_step = RUNGE_KUTTA_STEP;
    // Where the engine is asked for, nobody else has been all the way.
    let alone = options.integrator == Some(Integrator::Engine);
    let steps = match alone && refusals(mechanism, options).is_empty() {
        true => (options.duration / RUNGE_KUTTA_STEP).round().max(1.0),
        false => 1.0,
    };
    shortly.duration = steps * RUNGE_KUTTA_STEP;
    let world = SmoothWorld::new(mechanism, geometry, start, &shortly)?;
    Ok(world.is_ok_and(|mut world| (0..steps as u64).all(|_| world.step().is_ok())))
}

/// A mechanism in motion, in steps of one length.
#[derive(Debug)]
pub(super) struct SmoothWorld {
    system: System,
    stepper: Stepper,
    /// By link: its body, and `link_from_body`; for the ground `world_from_link`.
    places: Vec<(usize, Rigid<f64>)>,
    /// From one look to the next (s).
    interval: f64,
    /// Looks in a step; in the last step, and those of it that are to come.
    looks: u64,
    span: u64,
    ahead: u64,
    /// Looks so far, and those that the scene lasts for.
    seen: u64,
    last: u64,
    /// The state at the last look.
    state: Vec<f64>,
    pieces: Pieces,
}

/// Why an effect of a scene is the engine's, before anything is run.
pub(super) fn refusals(mechanism: &Mechanism, options: &SceneOptions) -> Vec<Serving> {
    let effects = &options.world.effects;
    let joints = mechanism.joints();
    let stated = |number: &Option<kutzbach_math::number::Number>| {
        number.as_ref().is_some_and(|number| number.value() > 0.0)
    };
    let touching = |link: &kutzbach_model::mechanism::Link| !link.collisions.is_empty();
    let dry = joints.iter().filter_map(|joint| joint.dynamics.as_ref());
    let damped = |joint: &&kutzbach_model::mechanism::Joint| {
        let dynamics = joint.dynamics.as_ref();
        dynamics.is_some_and(|dynamics| stated(&dynamics.damping))
    };
    let several = |joint: usize| joints.get(joint).is_none_or(|joint| joint.freedom() != 1);
    let mut found = Vec::new();
    if effects.contact
        && mechanism
            .links()
            .iter()
            .filter(|link| touching(link))
            .count()
            > 1
    {
        found.push(CONTACT);
    }
    if effects.friction && dry.clone().any(|dynamics| stated(&dynamics.friction)) {
        found.push(FRICTION);
    }
    if options
        .drives
        .iter()
        .any(|drive| drive.largest_force.is_finite())
    {
        found.push(CAPPED);
    }
    if options.drives.iter().any(|drive| several(drive.joint))
        || (effects.damping
            && joints
                .iter()
                .filter(damped)
                .any(|joint| joint.freedom() > 1))
    {
        found.push(SEVERAL);
    }
    found
}

impl SmoothWorld {
    /// At rest, each joint as given.
    ///
    /// # Errors
    /// [`WorldError`] for numbers that cannot be computed with; `None` for a pose where the constraints cannot be told apart.
    pub fn new(
        mechanism: &Mechanism,
        geometry: &Geometry<f64>,
        start: &[JointState<f64>],
        options: &SceneOptions,
    ) -> Result<Result<Self, Serving>, WorldError> {
        let (poses, length) = super::build::placed(mechanism, geometry, start)?;
        let mut notes = Vec::new();
        let masses = inertia::of_links(mechanism, geometry, length, &mut notes);
        let mut builder = Builder {
            mechanism,
            geometry,
            start,
            bodies: Vec::new(),
            places: Vec::new(),
            state: Vec::new(),
        };
        builder.bodies(&masses, &poses);
        let mut joints = builder.joints();
        if !joints.iter().all(|joint| constraint::sound(&joint.rows)) {
            return Err(WorldError::NotFinite {
                what: "an axis or distance",
                name: mechanism.name().to_owned(),
            });
        }
        let relations = builder.relations(options);
        let dampings = builder.dampings(options);
        let gravity = options.world.effects.gravity.unwrap_or_default();
        let pieces = Pieces {
            bodies: builder.bodies.len(),
            couplings: geometry.couplings.len(),
            motors: options.drives.len(),
            dampings: dampings.len(),
            ..Pieces::default()
        };
        let moving = builder.bodies.len();
        shares::divide(&mut builder.bodies, &mut builder.state, &mut joints);
        let ground = builder.bodies.len();
        for (body, _) in &mut builder.places {
            if *body == moving {
                *body = ground;
            }
        }
        let mut system = System::new(
            builder.bodies,
            joints,
            relations,
            dampings,
            (gravity.into(), length),
        );
        let stepper = match Stepper::new(&mut system, builder.state) {
            Ok(stepper) => stepper,
            Err(Lost::Unreachable | Lost::Independent) => return Ok(Err(SINGULAR)),
        };
        let looks = looks_in(options.runge_kutta_step);
        let interval = options.runge_kutta_step / looks as f64;
        Ok(Ok(Self {
            system,
            state: stepper.state.clone(),
            stepper,
            places: builder.places,
            interval,
            looks,
            span: 1,
            ahead: 0,
            seen: 0,
            last: (options.duration / interval).round() as u64,
            pieces,
        }))
    }

    /// About how many seconds of work a simulated second takes. Two multiplications a nanosecond were measured on chains, four-bars and
    /// scissors.
    pub fn seconds_per_second(&self) -> f64 {
        0.5e-9 * self.system.work() * EVALUATIONS / (self.interval * self.looks as f64)
    }

    /// The next step, no longer than the scene lasts; only to the next look where it cannot be taken in one piece.
    fn advance(&mut self) -> Result<(), Lost> {
        let left = self.last.saturating_sub(self.seen).clamp(1, self.looks);
        let length = self.interval * left as f64;
        self.span = match left > 1 && self.stepper.leap(&mut self.system, length)? {
            true => left,
            false => {
                self.stepper.step(&mut self.system, self.interval)?;
                1
            }
        };
        self.ahead = self.span;
        Ok(())
    }

    fn motion_of(&self, body: usize) -> Option<(&Body, &[f64])> {
        let state = self.state.get(body * NUMBERS..(body + 1) * NUMBERS)?;
        Some((self.system.bodies.get(body)?, state))
    }
}

impl Moves for SmoothWorld {
    fn step(&mut self) -> Result<(), Stopped> {
        if self.ahead == 0 {
            let advanced = self.advance();
            advanced.map_err(|_| Stopped::Unserved(SINGULAR))?;
        }
        (self.seen, self.ahead) = (self.seen + 1, self.ahead - 1);
        if self.ahead == 0 {
            self.state.clone_from(&self.stepper.state);
        } else {
            let share = 1.0 - self.ahead as f64 / self.span as f64;
            self.stepper.between(&self.system, share, &mut self.state);
        }
        Ok(())
    }

    fn time(&self) -> f64 {
        self.seen as f64 * self.interval
    }

    fn link_poses(&self) -> Vec<Rigid<f64>> {
        let pose = |(body, offset): &(usize, Rigid<f64>)| match self.motion_of(*body) {
            Some((_, state)) => system::pose(state).compose(&offset.inverse()),
            None => offset.clone(),
        };
        self.places.iter().map(pose).collect()
    }

    fn link_twists(&self) -> Vec<[f64; 6]> {
        let twist = |(body, _): &(usize, Rigid<f64>)| {
            let Some((_, state)) = self.motion_of(*body) else {
                return [0.0; 6];
            };
            system::twist(state)
        };
        self.places.iter().map(twist).collect()
    }

    fn energy(&self) -> Energy {
        let mut energy = Energy::default();
        for index in 0..self.system.bodies.len() {
            if let Some((body, state)) = self.motion_of(index) {
                let (kinetic, height) = system::energy(body, state, &self.system.gravity);
                energy.kinetic += kinetic;
                energy.potential += height;
            }
        }
        energy
    }

    fn contacts(&self) -> usize {
        0
    }

    fn length(&self) -> f64 {
        self.system.length
    }

    fn mass(&self) -> f64 {
        self.system.bodies.iter().map(|body| body.mass).sum()
    }

    fn pieces(&self) -> Pieces {
        self.pieces
    }

    fn not_simulated(&self) -> &[String] {
        &[]
    }
}

/// From a mechanism to bodies and constraints.
struct Builder<'a> {
    mechanism: &'a Mechanism,
    geometry: &'a Geometry<f64>,
    start: &'a [JointState<f64>],
    bodies: Vec<Body>,
    places: Vec<(usize, Rigid<f64>)>,
    state: Vec<f64>,
}

impl Builder<'_> {
    fn bodies(&mut self, masses: &[Option<Mass>], poses: &[Rigid<f64>]) {
        let moving = masses.iter().flatten().count();
        for (mass, pose) in masses.iter().zip(poses) {
            let Some(mass) = mass else {
                self.places.push((moving, pose.clone()));
                continue;
            };
            let (moments, axes) = principal(&mass.inertia);
            let offset = Rigid {
                rotation: [0, 1, 2].map(|i| [0, 1, 2].map(|j| axes[(i, j)])),
                translation: mass.centre,
            };
            self.places.push((self.bodies.len(), offset.clone()));
            self.state.extend(system::at_rest(&pose.compose(&offset)));
            self.bodies.push(Body {
                mass: mass.mass,
                moments,
            });
        }
    }

    /// Where a joint's frames are on the two bodies.
    fn sides(&self, joint: usize) -> ([Side; 2], [Matrix3<f64>; 2]) {
        let of = &self.mechanism.joints()[joint];
        let links = [of.predecessor.link.0, of.successor.link.0];
        let placed = [0, 1].map(|side| {
            let (body, offset) = &self.places[links[side]];
            let frame = &self.geometry.sides[joint][side];
            if *body < self.bodies.len() {
                offset.inverse().compose(frame)
            } else {
                offset.compose(frame)
            }
        });
        let turns = [0, 1].map(|side| Matrix3::from_fn(|i, j| placed[side].rotation[i][j]));
        let sides = [0, 1].map(|side| Side {
            body: self.places[links[side]].0,
            at: placed[side].translation.into(),
        });
        (sides, turns)
    }

    fn joints(&self) -> Vec<Held> {
        let joints = self.geometry.displacements.iter().enumerate();
        joints
            .map(|(index, displacement)| {
                let turned = self.start[index].values.last().copied().unwrap_or(0.0);
                let (sides, turns) = self.sides(index);
                Held {
                    sides,
                    rows: rows_of(displacement, (self.pitch(index), turned), &turns),
                }
            })
            .collect()
    }

    /// m/rad.
    fn pitch(&self, joint: usize) -> f64 {
        let lead = self.mechanism.joints()[joint].lead.as_ref();
        lead.map_or(0.0, |lead| lead.value() / std::f64::consts::TAU)
    }

    /// The variable of a joint of one freedom.
    fn coordinate(&self, joint: usize) -> Coordinate {
        let displacement = &self.geometry.displacements[joint];
        let (axis, (_, turns)) = (displacement.axis(), self.sides(joint));
        let measure = match displacement.kind() {
            JointKind::Prismatic => Measure::Travel(turns[0] * Vector3::from(*axis)),
            _ => Measure::Turn(Turning::new(axis, self.value(joint), &turns)),
        };
        Coordinate { joint, measure }
    }

    fn value(&self, joint: usize) -> f64 {
        self.start[joint].values.first().copied().unwrap_or(0.0)
    }

    fn relations(&self, options: &SceneOptions) -> Vec<Relation> {
        let couplings = self.geometry.couplings.iter().map(|coupling| Relation {
            terms: coupling
                .shares
                .iter()
                .filter(|share| share.coefficients.iter().any(|x| *x != 0.0))
                .map(|share| (self.coordinate(share.joint), Share(share.clone())))
                .collect(),
            offset: coupling.offset,
            rate: 0.0,
        });
        let drives = options.drives.iter().map(|drive| Relation {
            terms: vec![(
                self.coordinate(drive.joint),
                Share::linear(drive.joint, 1.0),
            )],
            offset: self.value(drive.joint),
            rate: drive.velocity,
        });
        let relations = couplings.chain(drives);
        relations
            .filter(|relation| !relation.terms.is_empty())
            .collect()
    }

    fn dampings(&self, options: &SceneOptions) -> Vec<(Coordinate, f64)> {
        if !options.world.effects.damping {
            return Vec::new();
        }
        let joints = self.mechanism.joints().iter().enumerate();
        joints
            .filter_map(|(index, joint)| {
                let damping = joint.dynamics.as_ref()?.damping.as_ref()?.value();
                // A number beyond this is refused by the engine too.
                (joint.freedom() == 1 && damping > 0.0 && damping < 1e30)
                    .then(|| (self.coordinate(index), damping))
            })
            .collect()
    }
}

/// Principal moments, and the axes as columns of a rotation.
fn principal(inertia: &Matrix3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
    let symmetric = inertia.symmetric_eigen();
    let mut axes = symmetric.eigenvectors;
    if axes.determinant() < 0.0 {
        axes.set_column(2, &-axes.column(2));
    }
    (symmetric.eigenvalues, axes)
}
