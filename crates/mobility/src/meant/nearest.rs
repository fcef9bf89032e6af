//! The mobile part whose dimensions are nearest to those written.
//!
//! Asked are dimensions for which the loops close all along a motion. A handful of poses on it stands for all of it: at each of
//! them, what the joints cannot mend (`poses.rs`) has to vanish, which are equations for the dimensions alone. Gauss and
//! Newton's step of least length solves them, damped while they disagree (Levenberg and Marquardt; with a damping that vanishes
//! like the square of the misfit the steps converge quadratically although most of these equations repeat one another:
//! Yamashita and Fukushima 2001). At the solution the rank of the equations is clear, and the dimensions are moved to the point
//! of the solutions nearest to what is written: first by the sum of squares in units of each number's uncertainty, then, where
//! some number leaves its uncertainty, by the largest of them (`least_largest.rs`).
//!
//! Relations that the numbers nearly satisfy (`relations.rs`) are further equations: the dimensions are moved to where these hold before
//! a pose is looked at, so that loops that close because of them close from the start.
//!
//! What comes out closes at these poses. That it moves is not said here: it is analysed like any other mechanism.
//!
//! Cost: a singular value decomposition for every pose and step.

mod equations;
mod sampling;
mod solving;

use super::dimensions::{Dimensions, turns};
use super::drowned::{DEPENDENT, drowned, least_of_drowned};
use super::least_largest::{Decomposed, least_largest};
use super::poses::{Loops, OnMotion};
use super::relations::Relations;
use kutzbach_closure::{Geometry, JointState};
use kutzbach_math::matrix::MatrixError;
use sampling::SAMPLINGS;

/// A misfit (rad, cycle lengths) that does not get smaller any more below this is rounding too.
pub(super) const STALLED: f64 = 2e-12;

/// Where a solution closes at poses that were not asked for, it closes up to this: rounding of more poses, farther away.
const CLOSED_ELSEWHERE: f64 = 1e-10;

/// Rounds of drawing near, each to where the linear equations say; the farthest is nearest where it is no more than so many times
/// what it has to be.
const DRAWN: usize = 5;
const MET: f64 = 1.02;

/// Numbers that change by more than this (rad, or the distance of the joints) make another linkage.
const FAR: f64 = 0.3;

/// Dimensions at which a part closes along a motion.
#[derive(Clone, Debug)]
pub(super) struct Nearest {
    /// Changes of the dimensions, in units of their uncertainties.
    pub z: Vec<f64>,
    /// How far the loops of the numbers as written stay open along the motion (rad, cycle lengths).
    pub misfit: f64,
}

/// The poses, and what the dimensions have to mend there.
struct Sample {
    states: Vec<JointState<f64>>,
    here: OnMotion,
}

/// A search for one number of freedoms.
pub(super) struct Search<'a> {
    pub loops: Loops<'a>,
    pub dimensions: &'a Dimensions<'a>,
    /// What has to hold besides.
    pub relations: &'a Relations,
    /// That of the numbers as written, at first.
    pub geometry: Geometry<f64>,
    /// The part's length (m).
    pub length: f64,
    /// How far its loops reach (m), which for axes that nearly coincide is far more.
    pub reach: f64,
    /// Operations that decompositions took so far, but for a factor.
    pub work: usize,
}

impl Search<'_> {
    /// Whether the loops of the numbers as written close along the motion through a pose.
    ///
    /// # Errors
    /// [`MatrixError`] where numbers overflow.
    pub fn closes_as_written(&self, home: &[JointState<f64>]) -> Result<bool, MatrixError> {
        let samples = self.along_the_motion(home, &SAMPLINGS[0])?;
        Ok(samples.is_some_and(|samples| norm(&misfits(&samples)) <= STALLED))
    }

    /// What some number has to change by at least, in units, for the loops to close along the motion through a pose. To first order at the
    /// numbers as written, which is what numbers within their digits differ by; zero where there are no such poses.
    ///
    /// # Errors
    /// [`MatrixError`] where numbers overflow.
    pub fn least_change(&mut self, home: &[JointState<f64>]) -> Result<f64, MatrixError> {
        let Some(mut samples) = self.along_the_motion(home, &SAMPLINGS[0])? else {
            return Ok(0.0);
        };
        self.least_change_at(&mut samples)
    }

    /// The same for the loops to close at one pose.
    ///
    /// # Errors
    /// [`MatrixError`] where numbers overflow.
    pub fn least_change_to_close(&mut self, home: &[JointState<f64>]) -> Result<f64, MatrixError> {
        let mut states = home.to_vec();
        let Some(here) = self.loops.settle(&self.geometry, &mut states, 1.0)? else {
            return Ok(0.0);
        };
        self.least_change_at(&mut [Sample { states, here }])
    }

    fn least_change_at(&mut self, samples: &mut [Sample]) -> Result<f64, MatrixError> {
        let z = vec![0.0; self.dimensions.all.len()];
        let (matrix, misfit) = self.equations(samples, &z)?;
        if norm(&misfit) <= STALLED {
            return Ok(0.0);
        }
        let Some(equations) = Decomposed::of(&matrix) else {
            return Ok(0.0);
        };
        // A direction in which numbers do little makes much of rounding.
        let beyond = equations.but_for_rounding(&misfit, STALLED);
        let found = equations.least_largest(&beyond, drowned);
        let found = found.map_or(0.0, |found| found.at_least);
        Ok(found.max(least_of_drowned(&equations, &misfit)))
    }

    /// The nearest dimensions, from a pose; `None` where none are found.
    ///
    /// # Errors
    /// [`MatrixError`] where numbers overflow.
    pub fn nearest(&mut self, home: &[JointState<f64>]) -> Result<Option<Nearest>, MatrixError> {
        let written = self.geometry.clone();
        let mut z = vec![0.0; self.dimensions.all.len()];
        let mut home = home.to_vec();
        if !self.related(&mut z, &mut home)? {
            return Ok(None);
        }
        let Some(mut samples) = self.along_the_motion(&home, &SAMPLINGS[0])? else {
            return Ok(None);
        };
        let first = self.open(&samples);
        for sampling in &SAMPLINGS[1..] {
            if self.solve(&mut samples, &mut z, first)?.is_none() {
                return Ok(None);
            }
            let Some(elsewhere) = self.along_the_motion(&samples[0].states, sampling)? else {
                return Ok(None);
            };
            let closed = norm(&misfits(&elsewhere)) <= CLOSED_ELSEWHERE;
            samples.extend(elsewhere);
            if closed {
                self.draw_near(&mut samples, &mut z, first)?;
                let misfit = self.misfit_of(written, &samples)?;
                return Ok(Some(Nearest { z, misfit }));
            }
        }
        Ok(None)
    }

    /// The nearest dimensions that close at the pose, whatever moves there then; `None` where none are found.
    ///
    /// # Errors
    /// [`MatrixError`] where numbers overflow.
    pub fn nearest_at_one_pose(
        &mut self,
        home: &[JointState<f64>],
    ) -> Result<Option<Nearest>, MatrixError> {
        let mut states = home.to_vec();
        let Some(here) = self.loops.settle(&self.geometry, &mut states, 1.0)? else {
            return Ok(None);
        };
        let mut samples = vec![Sample { states, here }];
        let mut z = vec![0.0; self.dimensions.all.len()];
        let misfit = self.open(&samples);
        if self.solve(&mut samples, &mut z, misfit)?.is_none() {
            return Ok(None);
        }
        self.draw_near(&mut samples, &mut z, misfit)?;
        Ok(Some(Nearest { z, misfit }))
    }

    /// Moves the dimensions to where the relations hold, and a pose with them; whether that can be.
    fn related(
        &mut self,
        z: &mut Vec<f64>,
        home: &mut [JointState<f64>],
    ) -> Result<bool, MatrixError> {
        if self.relations.is_empty() {
            return Ok(true);
        }
        let written = self.geometry.clone();
        let first = self.open(&[]);
        if self.solve(&mut [], z, first)?.is_none() {
            return Ok(false);
        }
        self.geometry = written;
        for &joint in &self.loops.part.joints {
            let numbers = self.dimensions.numbers(joint, z);
            self.dimensions
                .set(&mut self.geometry, joint, &numbers, [&mut home[joint]]);
        }
        Ok(true)
    }

    /// How far the loops of the numbers as written stay open along the motion, where poses of it can be told.
    fn misfit_of(
        &mut self,
        written: Geometry<f64>,
        samples: &[Sample],
    ) -> Result<f64, MatrixError> {
        let meant = std::mem::replace(&mut self.geometry, written);
        let mut most = 0.0f64;
        for sample in samples {
            let mut states = sample.states.clone();
            for &joint in &self.loops.part.joints {
                states[joint] = self.geometry.displacements[joint]
                    .adopt(&meant.displacements[joint], &states[joint]);
            }
            if let Some(here) = self.loops.settle(&self.geometry, &mut states, 1.0)? {
                most = most.max(here.open);
            }
        }
        self.geometry = meant;
        Ok(most)
    }

    /// What is left of all equations.
    fn left(&self, samples: &[Sample]) -> Vec<f64> {
        let mut left = misfits(samples);
        left.extend(self.relations.rows(&self.geometry, self.length));
        left
    }

    /// What is left of the equations, as a root of the sum of squares.
    fn open(&self, samples: &[Sample]) -> f64 {
        norm(&self.left(samples))
    }

    /// Where some dimension is farther from what is written than its uncertainty, moves them along the solutions to where the
    /// farthest is nearest.
    fn draw_near(
        &mut self,
        samples: &mut [Sample],
        z: &mut Vec<f64>,
        first: f64,
    ) -> Result<(), MatrixError> {
        let mut nearest = (z.clone(), states_of(samples));
        for _ in 0..DRAWN {
            let before = largest(&nearest.0);
            if before <= 1.0 {
                break;
            }
            let (matrix, misfit) = self.equations(samples, z)?;
            // What the linear equations ask of z from zero on.
            let wanted: Vec<f64> = (0..matrix.nrows())
                .map(|i| (0..z.len()).map(|j| matrix[(i, j)] * z[j]).sum::<f64>() - misfit[i])
                .collect();
            let Some(found) = least_largest(&matrix, &wanted, |_| DEPENDENT) else {
                break;
            };
            // The way to a solution may have led through changes of other numbers that it does not need.
            let idle = norm(&nearest.0) > MET * norm(&found.z);
            if before <= MET * found.at_least && !idle {
                break;
            }
            z.clone_from(&found.z);
            let closed = self.is_near(z)
                && self.follow(samples, z)?
                && self.solve(samples, z, first)?.is_some();
            let now = largest(z);
            let nearer = now < before || now <= MET * before && norm(z) < norm(&nearest.0);
            if !closed || !nearer {
                break;
            }
            nearest = (z.clone(), states_of(samples));
        }
        if *z != nearest.0 {
            self.restore(samples, z, &nearest)?;
        }
        Ok(())
    }

    /// Whether no number changes so much that the linkage is another one.
    fn is_near(&self, z: &[f64]) -> bool {
        let mut changes = self.dimensions.all.iter().zip(z);
        changes.all(|(dimension, z)| {
            let size = match turns(dimension.place) {
                true => 1.0,
                false => self.reach,
            };
            (z * dimension.unit).abs() <= FAR * size
        })
    }
}

/// What the dimensions have to mend at some poses.
fn misfits(samples: &[Sample]) -> Vec<f64> {
    let each = samples.iter().flat_map(|s| &s.here.misfit);
    each.copied().collect()
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn states_of(samples: &[Sample]) -> Vec<Vec<JointState<f64>>> {
    samples.iter().map(|sample| sample.states.clone()).collect()
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, x| {
        if x.is_nan() {
            f64::INFINITY
        } else {
            x.abs().max(most)
        }
    })
}
