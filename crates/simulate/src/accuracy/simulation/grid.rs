//! Which settings are tried.

use crate::Solver;

/// A setting: solver, length of a step (s), substeps.
pub(super) type Wish = (Solver, f64, usize);

/// Which settings are tried.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// How trees are held.
    pub solvers: Vec<Solver>,
    /// Lengths of a step (s).
    pub time_steps: Vec<f64>,
    /// Substeps of a step.
    pub substeps: Vec<usize>,
    /// A setting is left out where it would take about so many seconds or more. They are counted in work, so that the same
    /// settings are left out on every machine. The cheapest of all may take longer, as long as all may together.
    pub work: f64,
    /// And where all that were run before it have taken about so many.
    pub all_work: f64,
    /// Longest way that the drive goes, in seconds at a pace of a radian per second for the fastest joint.
    pub longest: f64,
    /// Simulated seconds of the scene.
    pub scene: f64,
    /// Rounds over all effects are begun while they would take about so many seconds, counted in work.
    pub effects: f64,
}

impl Grid {
    /// Both solvers, steps of 1/60, 1/240 and 1/1000 s with 1, 4, 16 and 64 substeps; a setting of more than about four
    /// seconds is left out.
    #[must_use]
    pub fn full() -> Self {
        Self {
            solvers: vec![Solver::Multibody, Solver::Impulse],
            time_steps: vec![1.0 / 60.0, 1.0 / 240.0, 1.0 / 1000.0],
            substeps: vec![1, 4, 16, 64],
            work: 4.0,
            all_work: 25.0,
            longest: 10.0,
            scene: 1.0,
            effects: 5.0,
        }
    }

    /// For a first impression: steps of 1/60 s and 1/240 s, and settings of half a second or less.
    #[must_use]
    pub fn quick() -> Self {
        Self {
            time_steps: vec![1.0 / 60.0, 1.0 / 240.0],
            work: 0.5,
            all_work: 2.0,
            scene: 0.5,
            effects: 0.5,
            ..Self::full()
        }
    }

    /// All of them, solver by solver.
    pub(super) fn settings(&self) -> Vec<Wish> {
        let mut all = Vec::new();
        for &solver in &self.solvers {
            for &time_step in &self.time_steps {
                all.extend(self.substeps.iter().map(|&n| (solver, time_step, n)));
            }
        }
        all
    }
}
