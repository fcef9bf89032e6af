//! Whether the configuration space is a manifold at a pose, of the dimension that the rank promises.
//!
//! With δ = dim ker J, hold the δ coordinates along the kernel at some small y and close the cycles by moving across it.
//! At a regular pose that succeeds for every y: the kernel's coordinates are a chart. At a singular one the equations that
//! J does not see leave something over, which vanishes with |y| like a power of at least two (the germ of the
//! configuration space: Golubitsky and Schaeffer 1985, section I.3, Lyapunov–Schmidt reduction). So:
//!
//! - *regular* where nothing is left over, in several directions and at radii where a germ of order up to
//!   [`ORDERS_SEEN`] would leave far more than the noise does;
//! - *singular* where what is left is far above the noise and falls like a power of the radius;
//! - otherwise more digits decide, or nothing does.
//!
//! The noise is rounding, and for rounded numbers what their stated precision leaves open. Where that is too coarse to decide
//! anything, but the numbers have the same rank taken literally, they are taken literally here too, which the test says
//! ([`ChartTest::literal`]), unless what they leave over then could be rounding of second order. Radii follow the smallest
//! singular value σ kept: a chart reaches as far as the equations bend by less than σ.
//!
//! A finite number of directions and orders proves nothing about all of them: the certificate is numeric.

mod far;
mod guide;

use super::more_digits::MoreDigits;
use super::pose_rank::{LADDER, PartRank, Pose};
pub(super) use far::{far_chart, moving_far};
use guide::Guide;
use kutzbach_closure::{Closing, Metric, Part, Section};
use kutzbach_math::matrix::{MatrixError, NullVectors, Real, SplitMix64};
use kutzbach_model::mechanism::JointId;

/// A germ whose leftover vanishes to a higher order than this is not told from none. Order 4 decides all that is known;
/// two more are a margin, which rounded numbers do not have.
const ORDERS_SEEN: i32 = 6;
const ORDERS_SEEN_ROUNDED: i32 = 4;

/// The coefficient that a germ of that order is expected to have at least, with radii in units of the chart's size.
const COEFFICIENT: f64 = 1e-2;

/// What exceeds the noise by this factor is no noise.
const CLEAR: f64 = 100.0;

/// Largest radius (rad, part lengths): beyond, other branches interfere.
const LARGEST_RADIUS: f64 = 0.3;

/// Directions whose singular value is smaller cannot be followed.
const LEAST_KEPT: f64 = 1e-8;

/// The parts with more unknowns than this are moved in double precision only.
pub(super) const LADDER_UNKNOWNS: usize = 400;

/// At most so many directions are tried.
const DIRECTIONS: usize = 6;

/// The seed of the directions.
pub const SEED: u64 = 20;

/// What the chart test found.
#[derive(Clone, Debug, PartialEq)]
pub enum ChartOutcome {
    /// The configuration space is a manifold here, of the dimension of the kernel.
    Regular,
    /// It is not; the leftover vanishes like this power of the distance.
    Singular {
        /// The power, as measured.
        order: f64,
    },
    /// The margin is too thin to tell.
    Thin,
}

/// A chart test with its figures.
#[derive(Clone, Debug, PartialEq)]
pub struct ChartTest {
    /// What it found.
    pub outcome: ChartOutcome,
    /// The largest radius tried (length in the metric of unit columns).
    pub radius: f64,
    /// The largest equation left over there (rad, cycle lengths).
    pub leftover: f64,
    /// What rounding and stated precision account for.
    pub noise: f64,
    /// Directions tried.
    pub directions: usize,
    /// Bits of the arithmetic that decided.
    pub bits: u32,
    /// How far the motion was followed (metric); zero where it was not.
    pub followed: f64,
    /// Whether the numbers had to be taken literally, their stated precision being too coarse to decide anything.
    pub literal: bool,
}

/// The kernel at the pose, and the metric it is orthonormal in.
pub struct Kernel {
    /// Orthonormal basis.
    pub basis: NullVectors<f64>,
    /// The metric.
    pub metric: Metric,
}

impl Kernel {
    /// The kernel that a decided rank leaves, or `limit` random vectors of a larger one; `None` where it is undecided.
    ///
    /// # Errors
    /// [`MatrixError`] where the null vectors cannot be computed.
    pub fn of(pose: &Pose<'_>, rank: &PartRank, limit: usize) -> Result<Option<Self>, MatrixError> {
        let Some(basis) = rank.null_vectors(limit, SEED)? else {
            return Ok(None);
        };
        Ok(Some(Self {
            basis,
            metric: Metric::of(pose.mechanism, &rank.jacobian, &rank.column_scales),
        }))
    }
}

/// Directions to try: random ones in the kernel, both ways.
fn directions(kernel: &NullVectors<f64>) -> Vec<Vec<f64>> {
    let count = if kernel.vectors.len() == 1 {
        1
    } else {
        (kernel.vectors.len() + 1).min(DIRECTIONS)
    };
    let mut random = SplitMix64::new(SEED);
    (0..count)
        .flat_map(|_| {
            let mut direction = vec![0.0; kernel.length];
            for vector in &kernel.vectors {
                let weight = random.symmetric();
                direction
                    .iter_mut()
                    .zip(vector)
                    .for_each(|(d, x)| *d += weight * x);
            }
            let length = 0.0.norm(&direction);
            direction.iter_mut().for_each(|x| *x /= length);
            let back = direction.iter().map(|x| -x).collect();
            [direction, back]
        })
        .collect()
}

/// Tests whether the kernel's coordinates are a chart of the configuration space. With random members of a large kernel only
/// ([`NullVectors::complete`] is false) it says nothing of the others.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub fn chart_test(
    pose: &Pose<'_>,
    more: &mut MoreDigits,
    part: &Part,
    rank: &PartRank,
    kernel: &Kernel,
) -> Result<ChartTest, MatrixError> {
    let radius = first_radius(rank);
    // What the numbers leave open shifts every equation by about as much, whatever the radius.
    let test = climb(
        pose,
        more,
        part,
        rank,
        kernel,
        radius,
        rank.open_by_digits(),
    )?;
    // Coarse numbers of which both readings have the same rank satisfy whatever makes them special to the last digit: such
    // numbers were chosen.
    if test.outcome == ChartOutcome::Thin
        && rank.open_by_digits() > 0.0
        && rank
            .as_written
            .is_none_or(|written| Some(written) == rank.instantaneous)
    {
        let literal = climb(pose, more, part, rank, kernel, radius, 0.0)?;
        // Rounding leaves something over at second order too: its share of the curvature of the equations, and of that bound
        // hardly a tenth, because roundings cancel. Less says nothing of what was meant.
        let rounded = test.noise * literal.radius.powi(2);
        let tells = match literal.outcome {
            ChartOutcome::Regular => true,
            ChartOutcome::Singular { .. } => literal.leftover > 0.1 * rounded,
            ChartOutcome::Thin => false,
        };
        if tells {
            return Ok(ChartTest {
                literal: true,
                ..literal
            });
        }
    }
    Ok(test)
}

/// What the numbers, taken literally, leave over at the radius of the chart test, if that is more than rounding: a rounded
/// mechanism moves as meant, and as written it does not. Numbers with all the digits of a double are what a program
/// computed, and nobody asks whether their last digits move too.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub(super) fn literal_leftover(
    pose: &Pose<'_>,
    more: &mut MoreDigits,
    part: &Part,
    rank: &PartRank,
    kernel: &Kernel,
) -> Result<Option<f64>, MatrixError> {
    let in_full = |joint: &usize| pose.mechanism.precision_of(JointId(*joint)).is_in_full();
    if part.joints.iter().any(in_full) {
        return Ok(None);
    }
    let reach = (first_radius(rank), 0.0);
    let mut probes = Probes::new(pose, part, kernel);
    let double = probes.in_bits(more, reach, 53)?;
    if double.leftover > double.noise {
        return Ok(Some(double.leftover));
    }
    // Finer rounding than doubles see.
    let Some(bits) = LADDER
        .into_iter()
        .find(|bits| 0.5f64.powi(*bits as i32 - 12) < rank.open_by_digits())
        .filter(|_| rank.unknowns() <= LADDER_UNKNOWNS)
    else {
        return Ok(None);
    };
    let fine = probes.in_bits(more, reach, bits)?;
    Ok((fine.leftover > fine.noise).then_some(fine.leftover))
}

/// A chart reaches as far as the equations bend by less than the smallest singular value kept.
fn first_radius(rank: &PartRank) -> f64 {
    (0.5 * smallest_kept(rank).min(1.0)).clamp(1e-12, LARGEST_RADIUS)
}

/// The smallest singular value kept. Equations without linear terms keep none, and nothing limits the radius.
fn smallest_kept(rank: &PartRank) -> f64 {
    match rank.decision.rank {
        Some(0) => f64::INFINITY,
        _ => rank.decision.kept,
    }
}

/// The test in as many digits as it takes, with what the stated precision leaves open.
fn climb(
    pose: &Pose<'_>,
    more: &mut MoreDigits,
    part: &Part,
    rank: &PartRank,
    kernel: &Kernel,
    mut radius: f64,
    stated: f64,
) -> Result<ChartTest, MatrixError> {
    let mut probes = Probes::new(pose, part, kernel);
    // Exact numbers that needed more digits for the rank need them here too: what they leave over may be as small as they are.
    let mut bits = if stated == 0.0 && rank.unknowns() <= LADDER_UNKNOWNS {
        rank.bits
    } else {
        53
    };
    let mut test;
    let mut rungs = LADDER.iter().filter(|rung| **rung > rank.bits);
    loop {
        test = probes.in_bits(more, (radius, stated), bits)?;
        test.bits = bits;
        // Steps are computed in double precision, where a singular value this small is damped away: closing then fails at
        // regular poses too.
        if matches!(test.outcome, ChartOutcome::Singular { .. }) && smallest_kept(rank) < LEAST_KEPT
        {
            test.outcome = ChartOutcome::Thin;
        }
        if test.outcome != ChartOutcome::Thin || rank.unknowns() > LADDER_UNKNOWNS {
            break;
        }
        // More digits than the numbers have tell nothing.
        if stated > 0.5 * test.noise {
            break;
        }
        let Some(next) = rungs.next() else { break };
        bits = *next;
        if bits > 53 && test.leftover > CLEAR * test.noise {
            radius *= 0.25;
        }
    }
    Ok(test)
}

/// The test in so many bits and no others, with what the stated precision leaves open.
pub(super) fn chart_in_bits(
    pose: &Pose<'_>,
    more: &mut MoreDigits,
    part: &Part,
    rank: &PartRank,
    kernel: &Kernel,
    bits: u32,
) -> Result<ChartTest, MatrixError> {
    Probes::new(pose, part, kernel).in_bits(more, (first_radius(rank), rank.open_by_digits()), bits)
}

/// What all probes of a chart test share.
struct Probes<'a> {
    pose: &'a Pose<'a>,
    part: &'a Part,
    kernel: &'a Kernel,
    ways: Vec<Vec<f64>>,
    guide: Guide<'a>,
}

impl<'a> Probes<'a> {
    fn new(pose: &'a Pose<'a>, part: &'a Part, kernel: &'a Kernel) -> Self {
        let section = Section {
            mechanism: pose.mechanism,
            geometry: pose.geometry,
            part,
            metric: &kernel.metric,
        };
        Self {
            pose,
            part,
            kernel,
            ways: directions(&kernel.basis),
            guide: Guide::new(section, pose.states, &kernel.basis.vectors),
        }
    }

    /// One probe in so many bits, at a radius and with what the stated precision leaves open.
    fn in_bits(
        &mut self,
        more: &mut MoreDigits,
        reach: (f64, f64),
        bits: u32,
    ) -> Result<ChartTest, MatrixError> {
        let Self {
            pose, part, guide, ..
        } = self;
        if bits <= 53 {
            return pose.try_on(part, |near| {
                probe(&self.ways, reach, 53, &mut |way, radius| {
                    guide.closed(near, way, radius)
                })
            });
        }
        let mut near = pose.states.to_vec();
        let (geometry, base) = more.polished(pose, part, !pose.as_drawn, bits)?;
        let section = Section {
            mechanism: pose.mechanism,
            geometry,
            part,
            metric: &self.kernel.metric,
        };
        let mut states = base.to_vec();
        probe(&self.ways, reach, bits, &mut |way, radius| {
            guide.finished(&section, base, (&mut states, &mut near), way, radius)
        })
    }

    /// By how much the variables move (metric) where one of the ways leads by a radius, in so many bits (more than 53).
    fn displaced(
        &mut self,
        more: &mut MoreDigits,
        (index, radius): (usize, f64),
        bits: u32,
    ) -> Result<(Vec<f64>, Closing), MatrixError> {
        let pose = self.pose;
        let (geometry, base) = more.polished(pose, self.part, !pose.as_drawn, bits)?;
        let section = Section {
            mechanism: pose.mechanism,
            geometry,
            part: self.part,
            metric: &self.kernel.metric,
        };
        let mut near = pose.states.to_vec();
        let mut states = base.to_vec();
        let way = (index, self.ways[index].as_slice());
        let closing = self
            .guide
            .finished(&section, base, (&mut states, &mut near), way, radius)?;
        Ok((section.way_between(base, &states), closing))
    }
}

/// Up to which order a germ is told from none with such a noise.
fn orders_seen(stated: f64, noise: f64) -> i32 {
    if stated > 0.5 * noise {
        ORDERS_SEEN_ROUNDED
    } else {
        ORDERS_SEEN
    }
}

/// By what factor a test stands clear of the noise: what a germ of the highest order seen would leave over at least, or what
/// is left over; `None` where the test says nothing.
pub(super) fn clearness(test: &ChartTest, stated: f64) -> Option<f64> {
    let orders = orders_seen(stated, test.noise);
    let clear = match test.outcome {
        ChartOutcome::Regular => COEFFICIENT * test.radius.powi(orders) / test.noise,
        ChartOutcome::Singular { .. } => test.leftover / test.noise,
        ChartOutcome::Thin => return None,
    };
    clear.is_finite().then_some(clear)
}

/// A way with its number, closed at a radius.
type Close<'c> = dyn FnMut((usize, &[f64]), f64) -> Result<Closing, MatrixError> + 'c;

/// Goes along each of the ways by the radius and closes, in so many bits.
fn probe(
    ways: &[Vec<f64>],
    (radius, stated): (f64, f64),
    bits: u32,
    close: &mut Close<'_>,
) -> Result<ChartTest, MatrixError> {
    let mut left = |index: usize, radius: f64| close((index, &ways[index]), radius);
    let mut worst = (0, 0.0f64);
    let mut noise = 0.0f64;
    for index in 0..ways.len() {
        let Closing {
            residual, rounding, ..
        } = left(index, radius)?;
        noise = noise.max(4.0 * rounding + stated);
        if residual > worst.1 || !residual.is_finite() {
            worst = (index, residual);
        }
        if residual > 1e3 * CLEAR * noise {
            break;
        }
    }
    let (index, leftover) = worst;
    let orders = orders_seen(stated, noise);
    let visible = COEFFICIENT * radius.powi(orders) > noise;
    let outcome = if leftover <= noise {
        if visible {
            ChartOutcome::Regular
        } else {
            ChartOutcome::Thin
        }
    } else {
        let half = left(index, 0.5 * radius)?.residual;
        let quarter = left(index, 0.25 * radius)?.residual;
        let orders = [(leftover / half).log2(), (half / quarter).log2()];
        let power = |order: f64| (1.5..=ORDERS_SEEN as f64 + 2.5).contains(&order);
        if quarter > CLEAR * noise && orders.iter().all(|o| power(*o)) {
            ChartOutcome::Singular { order: orders[1] }
        } else {
            ChartOutcome::Thin
        }
    };
    Ok(ChartTest {
        outcome,
        radius,
        leftover,
        noise,
        directions: ways.len(),
        bits,
        followed: 0.0,
        literal: false,
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
