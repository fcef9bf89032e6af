//! One driven turn of a crank, simulated and traced: how far the loop comes open, and how long it takes.
//!
//! Both ways are measured alike. The closure error is the largest gap of any joint at any pose, from the poses of the links
//! alone. A simulation is run once for its errors and again for its time, since looking takes time too; it is deterministic,
//! so that both runs are the same motion.

use kutzbach::closure::{Arithmetic, Geometry, Rigid};
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{Analysis, AnalysisOptions, analyse};
use kutzbach::motion::{Curve, TraceOptions, trace};
use kutzbach::simulate::verification::{Prediction, largest_gap};
use kutzbach::simulate::{Drive, Solver, World, WorldOptions, joint_gaps};
use std::error::Error;
use std::f64::consts::TAU;
use std::hint::black_box;
use std::time::Instant;

/// What is measured may fail only where the repository is broken: any error ends the program.
pub type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// A mechanism that is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Subject {
    /// What the table calls it.
    pub name: &'static str,
    /// The text of its file.
    pub text: &'static str,
    /// The joint that is driven once around.
    pub crank: &'static str,
}

/// All that are measured: a planar loop and a spatial one. Both have three redundant constraints; only the spatial one needs
/// particular lengths and twists for that.
pub const SUBJECTS: [Subject; 2] = [
    Subject {
        name: "four-bar",
        text: include_str!("../../mechanisms/planar_four_bar.urdf"),
        crank: "crank_pivot",
    },
    Subject {
        name: "Bennett",
        text: include_str!("../../mechanisms/bennett.urdf"),
        crank: "hinge_1",
    },
];

/// How trees are held, and what the table calls it.
pub const SOLVERS: [(Solver, &str); 2] = [
    (Solver::Multibody, "multibody"),
    (Solver::Impulse, "impulses"),
];

/// Substeps of a step that are measured.
pub const SUBSTEPS: [usize; 9] = [1, 2, 4, 8, 16, 32, 64, 128, 256];

/// Poses of a turn that are traced: few, and as many as a simulation has steps.
pub const POSES: [usize; 2] = [240, STEPS];

/// Steps per second.
pub const STEP_RATE: f64 = 240.0;

/// Steps of a turn at 1 rad/s: the least number that completes it.
pub const STEPS: usize = 1508;

/// The distance from the predicted motion is taken at every so many steps. Following it is Newton's method, which takes
/// longer than a step.
const COMPARED: usize = 6;

/// Rates at the start are central differences of traced poses this far apart (rad): the error, of second order, is below
/// the rounding of the poses divided by it.
const DIFFERENCE: f64 = 1e-5;

/// A mechanism ready to be simulated and traced.
pub struct Ready {
    /// Which.
    pub subject: Subject,
    /// As read.
    pub mechanism: Mechanism,
    /// In double precision.
    pub geometry: Geometry<f64>,
    /// What is predicted.
    pub analysis: Analysis,
    /// Index of the driven joint.
    pub crank: usize,
    /// Rates of all joints at the start while the crank turns at 1 rad/s.
    pub rates: Vec<Vec<f64>>,
    /// Characteristic length (m).
    pub length: f64,
}

/// What a simulated turn shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shown {
    /// Largest gap of a joint after any step (characteristic lengths, rad).
    pub closure_error: f64,
    /// Largest distance of a link from the predicted motion (characteristic lengths, rad).
    pub distance: f64,
    /// How far the crank came (rad); wanted is a full turn.
    pub turned: f64,
}

/// What a traced turn shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Traced {
    /// Largest gap of a joint at any pose (characteristic lengths, rad).
    pub closure_error: f64,
    /// Largest equation left at any pose, as the trace itself states it (rad, loop lengths).
    pub equations: f64,
}

/// Seconds that a traced turn takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TraceTime {
    /// From the mechanism as read to the last pose: mobility, curve, poses.
    pub whole: f64,
    /// The poses alone, those of all links included.
    pub poses: f64,
}

impl Ready {
    /// Reads and analyses a mechanism.
    pub fn new(subject: Subject) -> Result<Self> {
        let mechanism = kutzbach::format::read(subject.text, subject.name, &[])?.mechanism;
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
        let analysis = analyse(&mechanism, &AnalysisOptions::default())?;
        let crank = mechanism
            .joints()
            .iter()
            .position(|joint| joint.name == subject.crank)
            .ok_or("the crank is not in the file")?;
        let home = World::new(
            &mechanism,
            &geometry,
            &analysis.assembly.states,
            &WorldOptions::default(),
        )?;
        let mut ready = Self {
            subject,
            crank,
            rates: Vec::new(),
            length: home.scale().0,
            mechanism,
            geometry,
            analysis,
        };
        ready.rates = ready.rates_at_home()?;
        Ok(ready)
    }

    fn rates_at_home(&self) -> Result<Vec<Vec<f64>>> {
        let mut curve = follow(self.subject, &self.mechanism, &self.analysis)?;
        let home = self.home_angle();
        let mut at = |angle: f64| -> Result<_> {
            let found = curve.pose_at_drive(home + angle).ok_or("no pose at home")?;
            Ok(curve.states(&found.pose))
        };
        let (before, after) = (at(-DIFFERENCE)?, at(DIFFERENCE)?);
        let pairs = self.geometry.displacements.iter().zip(&before).zip(&after);
        Ok(pairs
            .map(|((joint, before), after)| {
                let increments = joint.increments(before, after);
                increments.iter().map(|x| x / (2.0 * DIFFERENCE)).collect()
            })
            .collect())
    }

    /// The crank's angle at the start (rad).
    fn home_angle(&self) -> f64 {
        self.analysis.assembly.states[self.crank].values[0]
    }

    /// A world about to turn: set in motion along the tangent at 1 rad/s of the crank, and driven at that rate.
    pub fn world(&self, solver: Solver, substeps: usize) -> Result<World> {
        let options = WorldOptions {
            solver,
            time_step: 1.0 / STEP_RATE,
            substeps,
            ..WorldOptions::default()
        };
        let start = &self.analysis.assembly.states;
        let mut world = World::new(&self.mechanism, &self.geometry, start, &options)?;
        world.set_rates(&self.rates)?;
        world.drive(Drive {
            joint: self.crank,
            freedom: 0,
            velocity: 1.0,
            largest_force: f64::INFINITY,
        })?;
        Ok(world)
    }

    /// Simulates a turn and looks at every step.
    pub fn simulate(&self, solver: Solver, substeps: usize) -> Result<Shown> {
        let mut world = self.world(solver, substeps)?;
        let start = &self.analysis.assembly.states;
        let mut states = start.clone();
        let mut prediction = Prediction::new(
            &self.mechanism,
            &self.geometry,
            &self.analysis.structure,
            start,
            1,
            self.length,
        )?;
        let mut shown = Shown {
            closure_error: 0.0,
            distance: 0.0,
            turned: 0.0,
        };
        for step in 1..=STEPS {
            world.step()?;
            let poses = world.link_poses();
            shown.closure_error = shown.closure_error.max(self.closure_error(&poses));
            states = world.states(&states);
            if step % COMPARED == 0 || step == STEPS {
                prediction.follow(&states)?;
                shown.distance = shown.distance.max(prediction.distance(&poses));
            }
        }
        shown.turned = states[self.crank].values[0] - self.home_angle();
        Ok(shown)
    }

    /// Seconds that the steps of a turn take; building the world is not counted.
    pub fn simulation_time(&self, solver: Solver, substeps: usize) -> Result<f64> {
        let mut world = self.world(solver, substeps)?;
        let begun = Instant::now();
        for _ in 0..STEPS {
            world.step()?;
        }
        let seconds = begun.elapsed().as_secs_f64();
        black_box(world.link_poses());
        Ok(seconds)
    }

    /// The predicted motion.
    pub fn curve(&self) -> Result<Curve> {
        follow(self.subject, &self.mechanism, &self.analysis)
    }

    /// Traces a turn and looks at every pose.
    pub fn trace(&self, poses: usize) -> Result<Traced> {
        let mut curve = self.curve()?;
        let mut traced = Traced {
            closure_error: 0.0,
            equations: 0.0,
        };
        self.each_pose(&mut curve, poses, |links, closure| {
            traced.closure_error = traced.closure_error.max(self.closure_error(links));
            traced.equations = traced.equations.max(closure);
        })?;
        Ok(traced)
    }

    /// Seconds that tracing a turn takes, from the mechanism as read.
    pub fn trace_time(&self, poses: usize) -> Result<TraceTime> {
        let begun = Instant::now();
        let analysis = analyse(black_box(&self.mechanism), &AnalysisOptions::default())?;
        let mut curve = follow(self.subject, &self.mechanism, &analysis)?;
        let followed = Instant::now();
        self.each_pose(&mut curve, poses, |links, _| {
            black_box(links);
        })?;
        Ok(TraceTime {
            whole: begun.elapsed().as_secs_f64(),
            poses: followed.elapsed().as_secs_f64(),
        })
    }

    /// Goes once around in equal turns of the crank: the poses of the links, and the equations left.
    pub fn each_pose(
        &self,
        curve: &mut Curve,
        poses: usize,
        mut look: impl FnMut(&[Rigid<f64>], f64),
    ) -> Result<()> {
        for index in 1..=poses {
            let angle = self.home_angle() + TAU * index as f64 / poses as f64;
            let found = curve
                .pose_at_drive(angle)
                .ok_or("the crank does not reach a full turn")?;
            look(&curve.link_poses(&found.pose), found.closure);
        }
        Ok(())
    }

    /// The largest gap of any joint (characteristic lengths, rad) where the links are in given poses (`world_from_link`).
    pub fn closure_error(&self, poses: &[Rigid<f64>]) -> f64 {
        let gaps = joint_gaps(&self.mechanism, &self.geometry, poses);
        largest_gap(&gaps, self.length)
    }
}

fn follow(subject: Subject, mechanism: &Mechanism, analysis: &Analysis) -> Result<Curve> {
    let options = TraceOptions {
        drive: Some(subject.crank.to_owned()),
        samples: 2,
        ..TraceOptions::default()
    };
    let motion = trace(mechanism, analysis, &options)?.into_motion();
    Ok(motion.ok_or("the crank does not turn")?.curve)
}
