//! The chart far away from the pose, in more digits than doubles have: what begins with a high power shows there only.

use super::super::hidden::{bits_for_ratios, squarings};
use super::super::more_digits::MoreDigits;
use super::super::pose_rank::{LADDER, PartRank, Pose};
use super::{ChartOutcome, ChartTest, Kernel, LADDER_UNKNOWNS, Probes, first_radius};
use kutzbach_closure::Part;
use kutzbach_math::matrix::MatrixError;

/// Radii (metric) tried, largest first.
const RADII: [f64; 3] = [1.0, 0.5, 0.25];

/// Where double precision does not lead far, the neighbourhood is seen in this many bits at least.
const NEARBY_BITS: u32 = 212;

/// What the last digits of numbers taken literally leave over grows with a lower power of the radius than this; what begins with one as
/// low shows in double precision.
const LOW_ORDER: f64 = 4.0;

/// What exceeds rounding by this factor, over the smallest singular value kept, is motion.
const CLEAR: f64 = 1e3;

/// Bits in which nothing is hidden by powers or by ratios, as far as the number of loops and couplings tells; 53 where doubles do.
fn bits_for(pose: &Pose<'_>, part: &Part, rank: &PartRank, kernel: &Kernel) -> u32 {
    let last = LADDER[LADDER.len() - 1];
    let powers = match squarings(pose.mechanism, part, rank, &kernel.basis) {
        0 => 53,
        rungs => LADDER[rungs.min(LADDER.len()) - 1],
    };
    let ratios = match bits_for_ratios(pose.mechanism, pose.geometry, part) {
        None => 53,
        Some(needed) => {
            let rung = LADDER.into_iter().find(|bits| *bits as usize >= needed);
            rung.unwrap_or(last)
        }
    };
    powers.max(ratios)
}

impl Probes<'_> {
    /// The largest radius beyond `near` at which the chart is closed in double precision.
    fn far_radius(&mut self, more: &mut MoreDigits, near: f64) -> Result<Option<f64>, MatrixError> {
        for radius in RADII.into_iter().filter(|r| *r > near) {
            let double = self.in_bits(more, (radius, 0.0), 53)?;
            if double.leftover <= double.noise {
                return Ok(Some(radius));
            }
        }
        Ok(None)
    }

    /// Whether what a test leaves over falls off with a low power towards the pose.
    fn is_low_order(
        &mut self,
        more: &mut MoreDigits,
        test: &ChartTest,
        bits: u32,
    ) -> Result<bool, MatrixError> {
        let half = self.in_bits(more, (0.5 * test.radius, 0.0), bits)?;
        Ok(test.leftover < half.leftover * 2.0f64.powf(LOW_ORDER))
    }
}

/// A regular outcome for exact numbers, tested again as far away as double precision follows the chart, in as many bits as its loops
/// ask for: what touches to a high order shows there only. Returned is the test given, and how far its outcome holds, or the one
/// that contradicts it.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub(in super::super) fn far_chart(
    pose: &Pose<'_>,
    more: &mut MoreDigits,
    part: &Part,
    rank: &PartRank,
    kernel: &Kernel,
    near: ChartTest,
) -> Result<ChartTest, MatrixError> {
    let mut probes = Probes::new(pose, part, kernel);
    let mut bits = bits_for(pose, part, rank, kernel);
    let far = probes.far_radius(more, near.radius)?;
    if far.is_none() {
        bits = bits.max(NEARBY_BITS);
    }
    let radius = far.unwrap_or(near.radius);
    if bits > 53 && (bits > near.bits || far.is_some()) {
        let test = probes.in_bits(more, (radius, 0.0), bits)?;
        let rounding = near.literal && probes.is_low_order(more, &test, bits)?;
        if test.outcome != ChartOutcome::Regular && !rounding {
            return Ok(ChartTest {
                literal: near.literal,
                ..test
            });
        }
    }
    Ok(ChartTest {
        followed: radius,
        ..near
    })
}

/// Which variables of a part at a regular pose move along its chart, seen in as many digits as it may take; `None` where doubles see
/// all there is, or where nobody can look closer.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub(in super::super) fn moving_far(
    pose: &Pose<'_>,
    more: &mut MoreDigits,
    part: &Part,
    rank: &PartRank,
) -> Result<Option<Vec<bool>>, MatrixError> {
    let rounded = rank.open_by_digits() > 0.0 && rank.as_written != rank.instantaneous;
    if rounded || rank.unknowns() > LADDER_UNKNOWNS || rank.instantaneous == Some(0) {
        return Ok(None);
    }
    let Some(kernel) = Kernel::of(pose, rank, super::DIRECTIONS)? else {
        return Ok(None);
    };
    let bits = bits_for(pose, part, rank, &kernel);
    if bits == 53 {
        return Ok(None);
    }
    let mut probes = Probes::new(pose, part, &kernel);
    let near = first_radius(rank);
    let radius = probes.far_radius(more, near)?.unwrap_or(near);
    let mut moving = vec![false; rank.unknowns()];
    for index in 0..probes.ways.len() {
        let (way, closing) = probes.displaced(more, (index, radius), bits)?;
        let rest = CLEAR * closing.rounding / rank.decision.kept.min(1.0);
        for (moves, by) in moving.iter_mut().zip(way) {
            *moves |= closing.residual <= 4.0 * closing.rounding && by.abs() > rest;
        }
    }
    Ok(Some(moving))
}
