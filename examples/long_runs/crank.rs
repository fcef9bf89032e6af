//! Bennett's linkage, its crank driven round and round.
//!
//! A turn takes [`STEPS_OF_A_TURN`] steps, so that every turn looks at the same poses. The energy is compared with that of
//! the traced motion at the crank's angle and rate. What the drive has done by then, and whatever it put in or took out
//! to keep its rate, is no part of that: the comparison says whether the links move as one freedom makes them move.

use super::traced::Traced;
use super::watch::{Compared, Play, Result};
use kutzbach::closure::JointState;
use kutzbach::families::spoiled_bennett;
use kutzbach::mechanism::Mechanism;
use kutzbach::number::Number;
use kutzbach::simulate::verification::Prediction;
use kutzbach::simulate::{Drive, Effects, Solver, World, WorldOptions};
use std::f64::consts::TAU;

/// Steps of a turn at 1 rad/s.
pub const STEPS_OF_A_TURN: usize = 1000;

/// Angles at which the kinetic energy of the traced motion is known; in between four of them are interpolated. What that
/// overlooks is of fourth order in the angle between them, a few 1e-9 of the energy.
const TABLE: usize = 1000;

/// Rates are central differences of traced poses this far apart (rad): the error, of second order, is below the rounding
/// of the poses divided by it.
const DIFFERENCE: f64 = 1e-5;

/// A linkage with a crank.
pub struct Crank {
    /// The mechanism that is simulated.
    traced: Traced,
    /// How its tree is held.
    solver: Solver,
    crank: usize,
    rates: Vec<Vec<f64>>,
    /// Kinetic energy at 1 rad/s, at equal angles from home.
    kinetic: Vec<f64>,
    /// By how much faster the crank gets in every turn, as a share of its rate at the start.
    faster: f64,
}

impl Crank {
    /// `mechanisms/bennett.urdf`.
    pub fn bennett(solver: Solver) -> Result<Self> {
        let text = include_str!("../../mechanisms/bennett.urdf");
        let mechanism = kutzbach::format::read(text, "bennett", &[])?.mechanism;
        let whole = Traced::new(&mechanism)?;
        Self::new(&mechanism, &whole, "hinge_1", solver)
    }

    /// The family of isograms with one twist off by about `epsilon` rad, set in motion as the one that is not.
    #[allow(dead_code)] // the tests want a linkage that does not fit
    pub fn spoiled(epsilon: &Number, solver: Solver) -> Result<Self> {
        let whole = Traced::new(&spoiled_bennett(&Number::zero())?)?;
        Self::new(&spoiled_bennett(epsilon)?, &whole, "a", solver)
    }

    /// The same linkage with a crank that does not keep its rate.
    #[allow(dead_code)] // the tests want a loop that opens more and more
    pub fn speeding_up(self, faster: f64) -> Self {
        Self { faster, ..self }
    }

    fn new(mechanism: &Mechanism, whole: &Traced, crank: &str, solver: Solver) -> Result<Self> {
        let mut curve = whole.curve(crank)?;
        let joint = whole.joint(crank)?;
        let home = whole.start()[joint].values[0];
        let mut at = |angle: f64| -> Result<_> {
            let found = curve.pose_at_drive(home + angle);
            let found = found.ok_or("the crank does not go all the way round")?;
            Ok(curve.states(&found.pose))
        };
        let mut rates_at = |angle: f64| -> Result<_> {
            let (before, after) = (at(angle - DIFFERENCE)?, at(angle + DIFFERENCE)?);
            Ok((at(angle)?, whole.rates(&before, &after, 2.0 * DIFFERENCE)))
        };
        let mut kinetic = Vec::with_capacity(TABLE);
        for index in 0..TABLE {
            let (states, rates) = rates_at(TAU * index as f64 / TABLE as f64)?;
            let energy = whole.energy(&states, Some(&rates), Effects::default())?;
            kinetic.push(energy.kinetic);
        }
        let rates = rates_at(0.0)?.1;
        let traced = Traced::new(mechanism)?;
        Ok(Self {
            crank: traced.joint(crank)?,
            traced,
            solver,
            rates,
            kinetic,
            faster: 0.0,
        })
    }

    /// Kinetic energy of the traced motion at 1 rad/s, the crank turned from home by an angle (rad).
    fn kinetic_at(&self, angle: f64) -> f64 {
        let along = (angle / TAU).rem_euclid(1.0) * TABLE as f64;
        let x = along.fract();
        let at = |offset: usize| self.kinetic[(along as usize + TABLE + offset - 1) % TABLE];
        // Lagrange's polynomial through the two neighbours on either side.
        let weights = [
            -x * (x - 1.0) * (x - 2.0) / 6.0,
            (x + 1.0) * (x - 1.0) * (x - 2.0) / 2.0,
            -(x + 1.0) * x * (x - 2.0) / 2.0,
            (x + 1.0) * x * (x - 1.0) / 6.0,
        ];
        (0..4).map(|i| weights[i] * at(i)).sum()
    }

    fn time_step() -> f64 {
        TAU / STEPS_OF_A_TURN as f64
    }

    fn turned(&self, states: &[JointState<f64>]) -> f64 {
        states[self.crank].values[0] - self.start()[self.crank].values[0]
    }
}

impl Play for Crank {
    fn world(&self, substeps: usize) -> Result<World> {
        let options = WorldOptions {
            solver: self.solver,
            time_step: Self::time_step(),
            substeps,
            ..WorldOptions::default()
        };
        let mut world = self.traced.world(&options)?;
        world.set_rates(&self.rates)?;
        Ok(world)
    }

    fn prediction(&self) -> Result<Prediction<'_>> {
        self.traced.prediction(1)
    }

    fn start(&self) -> &[JointState<f64>] {
        self.traced.start()
    }

    fn length(&self) -> f64 {
        self.traced.length
    }

    fn compared(&self) -> usize {
        // No part of a turn, so that other angles are seen in every turn.
        37
    }

    fn command(&self, world: &mut World, step: usize) -> Result<()> {
        if step == 0 || (self.faster != 0.0 && step.is_multiple_of(STEPS_OF_A_TURN)) {
            let turns = (step / STEPS_OF_A_TURN) as f64;
            world.drive(Drive {
                joint: self.crank,
                freedom: 0,
                velocity: 1.0 + self.faster * turns,
                largest_force: f64::INFINITY,
            })?;
        }
        Ok(())
    }

    fn compare(&self, world: &World, states: &[JointState<f64>], steps: usize) -> Compared {
        let link = self.traced.mechanism.joints()[self.crank].successor.link.0;
        let turning = world.link_twists()[link];
        // The crank is hinged to the ground: how fast it turns is the rate of its joint.
        let rate_squared: f64 = turning[..3].iter().map(|w| w * w).sum();
        let turned = self.turned(states);
        Compared {
            energy: world.energy().kinetic / (self.kinetic_at(turned) * rate_squared) - 1.0,
            behind: turned - steps as f64 * Self::time_step(),
        }
    }
}
