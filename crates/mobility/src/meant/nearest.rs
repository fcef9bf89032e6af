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

use super::dimensions::{Dimensions, turns};
use super::least_largest::least_largest;
use super::poses::{Loops, OnMotion};
use super::relations::Relations;
use faer::Mat;
use kutzbach_closure::{Geometry, JointNumbers, JointState, Part, WalkedCycle};
use kutzbach_math::matrix::MatrixError;

/// How far, and in how many steps, poses are looked for from home in each direction, in the metric of the home pose (a step is
/// about a sixth of a radian): at first, and then to see whether a solution closes elsewhere too. What does not closes at as many
/// poses as it was asked to, and then those poses are asked for as well.
const SAMPLINGS: [Sampling; 4] = [
    Sampling {
        step: 0.25,
        of_one: 6,
        of_many: 2,
    },
    Sampling {
        step: 0.31,
        of_one: 10,
        of_many: 3,
    },
    Sampling {
        step: 0.23,
        of_one: 18,
        of_many: 4,
    },
    Sampling {
        step: 0.29,
        of_one: 20,
        of_many: 5,
    },
];

/// Poses along a motion.
struct Sampling {
    step: f64,
    /// Steps of one freedom, and of several in each direction.
    of_one: usize,
    of_many: usize,
}

/// A search that takes more operations than this is given up.
const MOST_WORK: usize = 1_500_000_000;

/// Rounds of Gauss and Newton.
const ROUNDS: usize = 40;

/// A misfit (rad, cycle lengths) that is the rounding of doubles.
const CLOSED: f64 = 2e-14;

/// A misfit that does not get smaller any more below this is rounding too.
const STALLED: f64 = 2e-12;

/// Where a solution closes at poses that were not asked for, it closes up to this: rounding of more poses, farther away.
const CLOSED_ELSEWHERE: f64 = 1e-10;

/// Relative damping at the first misfit.
const DAMPING: f64 = 1e-3;

/// After so many steps that did not leave less than this share of the best, they are taken back and damped so much more.
const WATCHED: usize = 3;
const HALVED: f64 = 0.5;
const STIFFENED: f64 = 30.0;

/// So much at least then, relative to the largest singular value squared, and at most.
const STIFF: f64 = 1e-13;
const STIFFEST: f64 = 1e-3;

/// A step that does half of what it promised lets the next be damped so much less.
const RELAXED: f64 = 0.1;

/// Singular values of the dimensions' equations below this share of the largest are zero at a solution: difference quotients
/// leave less of them.
const DEPENDENT: f64 = 1e-9;

/// What the second order of all numbers together may be, in units of the square of their first.
const SECOND_ORDER: f64 = 3.0;

/// However coarse the numbers are, directions above this share tell something: the coarsest are mostly along axes, where they do
/// nothing to second order.
const COARSEST: f64 = 3e-3;

/// Rounds of drawing near, each to where the linear equations say; the farthest is nearest where it is no more than so many times
/// what it has to be.
const DRAWN: usize = 5;
const MET: f64 = 1.02;

/// Numbers that change by more than this (rad, or the distance of the joints) make another linkage.
const FAR: f64 = 0.3;

/// Difference quotients of the fourth order are taken over this (rad, part lengths): what they leave out, and rounding, are both below
/// 1e-12 of the derivative.
const QUOTIENT: f64 = 3e-4;

/// Places and weights of these quotients.
const STENCIL: [(f64, f64); 4] = [
    (1.0, 8.0 / 12.0),
    (-1.0, -8.0 / 12.0),
    (2.0, -1.0 / 12.0),
    (-2.0, 1.0 / 12.0),
];

/// The share of the `most` that numbers do below which directions tell nothing: numbers within their digits leave over, to second order,
/// about the square of what they do to first order.
pub(super) fn drowned(most: f64) -> f64 {
    (SECOND_ORDER * most).clamp(DEPENDENT, COARSEST)
}

/// What the largest entry of z has to be at least for `a z = b` in the directions that tell nothing else, what z leaves over to second
/// order allowed for: where numbers written in full would have to change, those written with fewer digits do not help.
///
/// Along a left singular vector u of these, `|uᵀb| ≤ ‖Aᵀu‖₁ z + Q z²` where Q bounds the second order of all numbers together.
fn least_of_drowned(a: &Mat<f64>, b: &[f64]) -> f64 {
    let Ok(svd) = a.thin_svd() else {
        return 0.0;
    };
    let (u, s) = (svd.U(), svd.S().column_vector());
    let most = if s.nrows() > 0 { s[0] } else { 0.0 };
    let second = SECOND_ORDER * most * most * a.ncols() as f64;
    let least = |j: usize| {
        let along = |column: &dyn Fn(usize) -> f64| -> f64 {
            (0..a.nrows()).map(|i| u[(i, j)] * column(i)).sum()
        };
        // Poses are closed, and quotients taken, to so much.
        let missing = (along(&|i| b[i]).abs() - 10.0 * STALLED).max(0.0);
        let first: f64 = (0..a.ncols()).map(|k| along(&|i| a[(i, k)]).abs()).sum();
        // Half of it by either order.
        let by_first = 0.5 * missing / first.max(f64::MIN_POSITIVE);
        let by_second = (0.5 * missing / second.max(f64::MIN_POSITIVE)).sqrt();
        by_first.min(by_second)
    };
    (0..s.nrows())
        .filter(|&j| s[j] <= drowned(most) * most)
        .map(least)
        .fold(0.0, f64::max)
}

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
    fn part(&self) -> &Part {
        self.loops.part
    }

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
        let found = least_largest(&matrix, &misfit, drowned);
        let found = found.map_or(0.0, |found| found.at_least);
        Ok(found.max(least_of_drowned(&matrix, &misfit)))
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

    /// Poses on the motion through the one given.
    fn along_the_motion(
        &self,
        home: &[JointState<f64>],
        sampling: &Sampling,
    ) -> Result<Option<Vec<Sample>>, MatrixError> {
        let mut states = home.to_vec();
        let Some(here) = self.loops.settle(&self.geometry, &mut states, 1.0)? else {
            return Ok(None);
        };
        let freedom = here.tangents.len();
        let steps = if freedom == 1 {
            sampling.of_one
        } else {
            sampling.of_many
        };
        let mut samples = vec![Sample { states, here }];
        for direction in directions(freedom) {
            let first = &samples[0];
            let mut states = first.states.clone();
            let columns = first.here.tangents[0].len();
            let mut along = vec![0.0; columns];
            for (tangent, share) in first.here.tangents.iter().zip(&direction) {
                along
                    .iter_mut()
                    .zip(tangent)
                    .for_each(|(a, t)| *a += share * t);
            }
            for _ in 0..steps {
                let step: Vec<f64> = along.iter().map(|a| sampling.step * a).collect();
                self.loops.advance(&self.geometry, &mut states, &step);
                let Some(here) = self
                    .loops
                    .settle(&self.geometry, &mut states, sampling.step)?
                else {
                    break;
                };
                along = projected(&here.tangents, &along);
                samples.push(Sample {
                    states: states.clone(),
                    here,
                });
            }
        }
        Ok(Some(samples))
    }

    /// Moves the dimensions to a solution; `first` is the misfit at those written. Where a few steps together leave no less than there
    /// was, they are taken back, and damped more: single ones may, as the best ways to solutions at which the equations are
    /// dependent do.
    fn solve(
        &mut self,
        samples: &mut [Sample],
        z: &mut Vec<f64>,
        first: f64,
    ) -> Result<Option<()>, MatrixError> {
        let mut damping = DAMPING;
        let mut best = (self.open(samples), (z.clone(), states_of(samples)));
        if best.0 <= STALLED {
            return Ok(Some(()));
        }
        let mut since = 0;
        for _ in 0..ROUNDS {
            let (matrix, misfit) = self.equations(samples, z)?;
            let left = norm(&misfit);
            if left <= CLOSED {
                return Ok(Some(()));
            }
            let relative = damping * (left / first).powi(2).min(1.0);
            self.work += matrix.nrows() * matrix.ncols() * matrix.nrows().min(matrix.ncols());
            if self.work > MOST_WORK {
                return Ok(None);
            }
            let Some(svd) = Steps::of(&matrix) else {
                return Ok(None);
            };
            let step = svd.least(&misfit, |s, top| s / (s * s + relative * top * top));
            z.iter_mut().zip(&step).for_each(|(z, step)| *z -= step);
            let followed = self.is_near(z) && self.follow(samples, z)?;
            let now = if followed {
                self.open(samples)
            } else {
                f64::INFINITY
            };
            let before = norm(&misfit);
            let promised = before - norm(&difference(&misfit, &matrix, &step));
            if before - now > 0.5 * promised {
                damping *= RELAXED;
            }
            since = if now < HALVED * best.0 { 0 } else { since + 1 };
            if now < best.0 {
                best = (now, (z.clone(), states_of(samples)));
            }
            if !followed || since > WATCHED {
                self.restore(samples, z, &best.1)?;
                if best.0 <= STALLED {
                    return Ok(Some(()));
                }
                let share = (best.0 / first).powi(2).min(1.0);
                damping = (damping * STIFFENED).max(STIFF / share);
                since = 0;
                if damping * share > STIFFEST {
                    break;
                }
            }
        }
        self.restore(samples, z, &best.1)?;
        Ok((best.0 <= STALLED).then_some(()))
    }

    /// Takes the dimensions and poses back.
    fn restore(
        &mut self,
        samples: &mut [Sample],
        z: &mut Vec<f64>,
        kept: &(Vec<f64>, Vec<Vec<JointState<f64>>>),
    ) -> Result<(), MatrixError> {
        z.clone_from(&kept.0);
        for (sample, states) in samples.iter_mut().zip(&kept.1) {
            sample.states.clone_from(states);
        }
        self.follow(samples, z).map(|_| ())
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

    /// Gives the loops their changed dimensions and brings the poses onto the motion again.
    fn follow(&mut self, samples: &mut [Sample], z: &[f64]) -> Result<bool, MatrixError> {
        for &joint in &self.loops.part.joints {
            let numbers = self.dimensions.numbers(joint, z);
            let states = samples.iter_mut().map(|s| &mut s.states[joint]);
            self.dimensions
                .set(&mut self.geometry, joint, &numbers, states);
        }
        for sample in samples {
            let Some(here) = self.loops.settle(&self.geometry, &mut sample.states, 1.0)? else {
                return Ok(false);
            };
            sample.here = here;
        }
        Ok(true)
    }

    /// The equations for the dimensions: their derivative, and what is left of them.
    fn equations(
        &mut self,
        samples: &mut [Sample],
        z: &[f64],
    ) -> Result<(Mat<f64>, Vec<f64>), MatrixError> {
        let misfit = self.left(samples);
        let of_loops: usize = samples.iter().map(|s| s.here.misfit.len()).sum();
        let mut matrix = Mat::<f64>::zeros(misfit.len(), z.len());
        let dimensions = self.dimensions;
        let cycles = self.part().cycles.clone();
        for (column, dimension) in dimensions.all.iter().enumerate() {
            let numbers = dimensions.numbers(dimension.joint, z);
            let step = match turns(dimension.place) {
                true => QUOTIENT,
                false => QUOTIENT * self.length,
            };
            let concerned: Vec<usize> = (0..cycles.len())
                .filter(|&c| cycles[c].iter().any(|(joint, _)| *joint == dimension.joint))
                .collect();
            let mut row = 0;
            let mut ends: Vec<Vec<[f64; 6]>> = Vec::new();
            for (place, weight) in STENCIL {
                let mut moved = numbers.clone();
                moved.0[dimension.place] += place * step;
                let mut values = Vec::new();
                for sample in samples.iter_mut() {
                    let kept = sample.states[dimension.joint].clone();
                    let displacement = self.geometry.displacements[dimension.joint].clone();
                    let sides = self.geometry.sides[dimension.joint].clone();
                    dimensions.set(
                        &mut self.geometry,
                        dimension.joint,
                        &moved,
                        [&mut sample.states[dimension.joint]],
                    );
                    for &cycle in &concerned {
                        let walk =
                            WalkedCycle::walk(&self.geometry, &sample.states, &cycles[cycle]);
                        values.push(walk.residual());
                    }
                    sample.states[dimension.joint] = kept;
                    self.geometry.displacements[dimension.joint] = displacement;
                    self.geometry.sides[dimension.joint] = sides;
                }
                ends.push(values);
                for (row, value) in self.related_rows(dimension.joint, &moved) {
                    matrix[(of_loops + row, column)] += weight * value / step * dimension.unit;
                }
            }
            let mut next = 0;
            for sample in samples.iter() {
                let here: Vec<(usize, [f64; 6])> = concerned
                    .iter()
                    .map(|&cycle| {
                        let slope = |i: usize| {
                            let all = STENCIL.iter().zip(&ends);
                            let sum: f64 =
                                all.map(|((_, weight), end)| weight * end[next][i]).sum();
                            sum / step * dimension.unit
                        };
                        let slopes = std::array::from_fn(slope);
                        next += 1;
                        (cycle, slopes)
                    })
                    .collect();
                for left in &sample.here.left {
                    matrix[(row, column)] = here
                        .iter()
                        .map(|(cycle, slope)| {
                            (0..6).map(|i| left[6 * cycle + i] * slope[i]).sum::<f64>()
                        })
                        .sum();
                    row += 1;
                }
            }
        }
        Ok((matrix, misfit))
    }
}

impl Search<'_> {
    /// The relations' rows that a joint changes, with other numbers of it.
    fn related_rows(&mut self, joint: usize, numbers: &JointNumbers) -> Vec<(usize, f64)> {
        if self.relations.is_empty() {
            return Vec::new();
        }
        let displacement = self.geometry.displacements[joint].clone();
        let sides = self.geometry.sides[joint].clone();
        self.dimensions.set(&mut self.geometry, joint, numbers, []);
        let rows = self.relations.rows_of(joint, &self.geometry, self.length);
        self.geometry.displacements[joint] = displacement;
        self.geometry.sides[joint] = sides;
        rows
    }
}

/// A singular value decomposition of equations, for steps of least length.
struct Steps(faer::linalg::solvers::Svd<f64>);

impl Steps {
    /// `None` where the decomposition fails.
    fn of(matrix: &Mat<f64>) -> Option<Self> {
        matrix.thin_svd().ok().map(Self)
    }

    /// Σ filter(σ) v uᵀ b over the singular values; `filter` is told the largest as well.
    fn least(&self, b: &[f64], filter: impl Fn(f64, f64) -> f64) -> Vec<f64> {
        let (u, s, v) = (self.0.U(), self.0.S().column_vector(), self.0.V());
        let mut step = vec![0.0; v.nrows()];
        if s.nrows() == 0 || s[0] == 0.0 {
            return step;
        }
        for j in 0..s.nrows() {
            let along: f64 = (0..b.len()).map(|i| u[(i, j)] * b[i]).sum();
            let length = along * filter(s[j], s[0]);
            for (i, x) in step.iter_mut().enumerate() {
                *x += length * v[(i, j)];
            }
        }
        step
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

/// b − A x.
fn difference(b: &[f64], a: &Mat<f64>, x: &[f64]) -> Vec<f64> {
    let row = |i: usize| -> f64 { x.iter().enumerate().map(|(j, x)| a[(i, j)] * x).sum() };
    b.iter().enumerate().map(|(i, b)| b - row(i)).collect()
}

fn states_of(samples: &[Sample]) -> Vec<Vec<JointState<f64>>> {
    samples.iter().map(|sample| sample.states.clone()).collect()
}

/// Directions in which poses are looked for: both ways of one freedom; of several each alone, and their sums with signs.
fn directions(freedom: usize) -> Vec<Vec<f64>> {
    if freedom == 1 {
        return vec![vec![1.0], vec![-1.0]];
    }
    let share = 1.0 / (freedom as f64).sqrt();
    let alone = (0..freedom).map(|i| (0..freedom).map(|j| f64::from(i == j)).collect());
    let sums = (0..freedom + 2).map(|i| {
        (0..freedom)
            .map(|j| {
                // Signs of a fixed pattern without symmetry.
                let odd = (i * i + 3 * i * j + j * j * j + (i >> 1)) % 3 == 0;
                if odd { -share } else { share }
            })
            .collect()
    });
    alone.chain(sums).collect()
}

fn projected(tangents: &[Vec<f64>], along: &[f64]) -> Vec<f64> {
    let mut next = vec![0.0; along.len()];
    for tangent in tangents {
        let share: f64 = tangent.iter().zip(along).map(|(t, a)| t * a).sum();
        next.iter_mut()
            .zip(tangent)
            .for_each(|(n, t)| *n += share * t);
    }
    let length = next.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length > 0.0 {
        next.iter_mut().for_each(|x| *x /= length);
    }
    next
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
