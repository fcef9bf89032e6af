//! A Stewart platform shaken by its six legs, under gravity.
//!
//! Each leg has a motor. In one period leg number k swings k times, by as much less the faster it swings; all begin and end
//! as drawn, so that a period is a closed way through poses in which all six freedoms take part. A motor keeps a velocity, and
//! no length: told the mean velocity of each step and nothing else, a leg that has come to be short or long stays so.
//! Machines have an encoder on each leg and correct it, which is what the other setting does.
//!
//! The traced motion is the pose at which the loops close with the legs as long as they should be. The energy is the kinetic
//! one, less that of the traced motion with the legs at the same rates, as a share of the largest in the period.

use super::traced::Traced;
use super::watch::{Compared, Play, Result};
use kutzbach::closure::{JointState, assemble};
use kutzbach::simulate::verification::Prediction;
use kutzbach::simulate::{Drive, Effects, Solver, World, WorldOptions};
use std::collections::BTreeSet;
use std::f64::consts::TAU;

/// Steps of a period.
pub const STEPS_OF_A_PERIOD: usize = 1200;

/// Steps per second.
pub const STEP_RATE: f64 = 240.0;

/// The slowest leg swings by this much both ways (m); legs are 2.3 m long.
const SWING: f64 = 0.1;

/// Comparisons in a period.
const PHASES: usize = 40;

const LEGS: [&str; 6] = [
    "left_cylinder_1",
    "right_cylinder_1",
    "left_cylinder_2",
    "right_cylinder_2",
    "left_cylinder_3",
    "right_cylinder_3",
];

/// Standard gravity (m/s²).
const GRAVITY: f64 = 9.80665;

/// A platform on six legs.
pub struct Stewart {
    traced: Traced,
    solver: Solver,
    legs: [usize; 6],
    /// Rates of all joints at the start.
    rates: Vec<Vec<f64>>,
    /// Kinetic energy of the traced motion at each comparison (J).
    kinetic: Vec<f64>,
    /// The largest of them (J).
    most: f64,
    /// Whether the motors make up for what a leg is short or long.
    corrected: bool,
}

impl Stewart {
    /// `mechanisms/stewart.urdf`.
    ///
    /// Where `corrected`, a motor is told to go, within a step, from where its leg is to where it should be at the end;
    /// elsewhere, the mean velocity that it should have.
    pub fn new(solver: Solver, corrected: bool) -> Result<Self> {
        let text = include_str!("../../mechanisms/stewart.urdf");
        let traced = Traced::new(&kutzbach::format::read(text, "stewart", &[])?.mechanism)?;
        let mut legs = [0; 6];
        for (leg, name) in legs.iter_mut().zip(LEGS) {
            *leg = traced.joint(name)?;
        }
        let mut stewart = Self {
            traced,
            solver,
            legs,
            rates: Vec::new(),
            kinetic: Vec::new(),
            most: 0.0,
            corrected,
        };
        // At the start the legs are set in motion as the first step goes on.
        stewart.rates = stewart.rates_between(0, 1, stewart.lengths(0))?;
        for phase in 0..PHASES {
            let step = phase * stewart.compared();
            let before = step + STEPS_OF_A_PERIOD - 1;
            let rates = stewart.rates_between(before, step, stewart.lengths(step))?;
            let states = stewart.pose(&stewart.lengths(step))?;
            let energy = stewart.traced.energy(&states, Some(&rates), effects())?;
            stewart.kinetic.push(energy.kinetic);
        }
        stewart.most = stewart.kinetic.iter().copied().fold(0.0, f64::max);
        Ok(stewart)
    }

    /// By how much each leg is to be longer than drawn, after so many steps (m).
    fn lengths(&self, steps: usize) -> [f64; 6] {
        let phase = (steps % STEPS_OF_A_PERIOD) as f64 / STEPS_OF_A_PERIOD as f64;
        std::array::from_fn(|leg| {
            let swings = (leg + 1) as f64;
            SWING / swings * (TAU * swings * phase).sin()
        })
    }

    /// The closed pose with the legs longer by so much.
    fn pose(&self, lengths: &[f64; 6]) -> Result<Vec<JointState<f64>>> {
        let mut geometry = self.traced.geometry.clone();
        for (&leg, &length) in self.legs.iter().zip(lengths) {
            geometry.states[leg] = geometry.displacements[leg].at(&[length]);
        }
        let held: BTreeSet<usize> = self.legs.into_iter().collect();
        let parts = &self.traced.analysis.structure.parts;
        let assembly = assemble(&self.traced.mechanism, &geometry, parts, &held)?;
        if !assembly.closed {
            return Err("the platform does not reach a pose of its period".into());
        }
        Ok(assembly.states)
    }

    /// Rates of all joints at a pose, the legs at the mean rates between two steps.
    fn rates_between(&self, before: usize, after: usize, at: [f64; 6]) -> Result<Vec<Vec<f64>>> {
        let (before, after) = (self.lengths(before), self.lengths(after));
        // A hundredth of the step both ways: central differences, of second order.
        let moved = |share: f64| -> [f64; 6] {
            std::array::from_fn(|leg| at[leg] + share * (after[leg] - before[leg]))
        };
        let (back, forth) = (self.pose(&moved(-0.01))?, self.pose(&moved(0.01))?);
        Ok(self.traced.rates(&back, &forth, 0.02 / STEP_RATE))
    }
}

fn effects() -> Effects {
    Effects {
        gravity: Some([0.0, 0.0, -GRAVITY]),
        ..Effects::default()
    }
}

impl Play for Stewart {
    fn world(&self, substeps: usize) -> Result<World> {
        let options = WorldOptions {
            solver: self.solver,
            effects: effects(),
            time_step: 1.0 / STEP_RATE,
            substeps,
        };
        let mut world = self.traced.world(&options)?;
        world.set_rates(&self.rates)?;
        Ok(world)
    }

    fn prediction(&self) -> Result<Prediction<'_>> {
        self.traced.prediction(6)
    }

    fn start(&self) -> &[JointState<f64>] {
        self.traced.start()
    }

    fn length(&self) -> f64 {
        self.traced.length
    }

    fn compared(&self) -> usize {
        STEPS_OF_A_PERIOD / PHASES
    }

    fn command(&self, world: &mut World, step: usize) -> Result<()> {
        let (mut now, next) = (self.lengths(step), self.lengths(step + 1));
        if self.corrected {
            let states = world.states(self.start());
            now = self.legs.map(|leg| states[leg].values[0]);
        }
        for (leg, &joint) in self.legs.iter().enumerate() {
            world.drive(Drive {
                joint,
                freedom: 0,
                velocity: (next[leg] - now[leg]) * STEP_RATE,
                largest_force: f64::INFINITY,
            })?;
        }
        Ok(())
    }

    fn compare(&self, world: &World, states: &[JointState<f64>], steps: usize) -> Compared {
        let phase = (steps / self.compared()) % PHASES;
        let wanted = self.lengths(steps);
        let off = |leg: usize| (states[self.legs[leg]].values[0] - wanted[leg]) / self.length();
        let farthest = (0..6)
            .map(off)
            .fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
        Compared {
            energy: (world.energy().kinetic - self.kinetic[phase]) / self.most,
            behind: farthest,
        }
    }
}
