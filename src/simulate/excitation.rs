//! Counting freedoms by shaking.
//!
//! At a generic pose of a branch the mechanism is struck at random, all links at once, many times over, and each time the
//! velocities that its joints leave it with are noted. Those velocities are all the velocities it can have: their span is
//! the tangent space of the configuration space there, and its rank the number of freedoms. Nothing of the prediction goes
//! into the count but the pose.
//!
//! A blow is spread over one very short step of many substeps, in which nothing moves noticeably and the solver comes to
//! the velocities that fit all joints.

use super::{Finding, Outcome, Solver, VerificationError, World, WorldOptions};
use crate::closure::{Geometry, JointState, Rigid};
use crate::matrix::SplitMix64;
use crate::mechanism::Mechanism;
use faer::Mat;
use serde::Serialize;

/// Blows beyond the freedoms expected: so many singular values show what a direction without freedom responds with.
const SPARE_BLOWS: usize = 4;

/// A step so short (s) that at the speeds a blow gives, about one characteristic length per second, a link goes a
/// millionth of a length.
const SHORT: f64 = 1e-6;

/// Solver iterations of a blow.
const SUBSTEPS: usize = 64;

/// Responses in free directions have to stand out of those in locked ones by this factor. Blows of random direction
/// through random inertia spread over less than a decade each for a handful of freedoms.
const LEAST_GAP: f64 = 30.0;

/// Responses below this share of the largest are the solver's rounding: no freedom is looked for there.
const ROUNDING: f64 = 1e-10;

/// How many freedoms the simulated mechanism has at a pose.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FreedomCount {
    /// Instantaneous freedoms predicted at the pose.
    pub expected: usize,
    /// Freedoms found.
    pub found: usize,
    /// Singular values of the responses, largest first, in parts of the largest.
    pub singular_values: Vec<f64>,
    /// The last of those counted over the first of those not; infinite where nothing is left.
    pub gap: f64,
    /// Seed of the blows.
    pub seed: u64,
    /// What follows.
    pub finding: Finding,
}

/// Strikes the mechanism at a closed pose and counts the directions in which it gives way.
///
/// # Errors
/// Where no world can be made there, or it diverges.
pub fn count_freedoms(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    expected: usize,
    seed: u64,
) -> Result<FreedomCount, VerificationError> {
    let options = WorldOptions {
        solver: Solver::Multibody,
        time_step: SHORT,
        substeps: SUBSTEPS,
        ..WorldOptions::default()
    };
    let blows = expected + SPARE_BLOWS;
    let mut random = SplitMix64::new(seed);
    let mut responses = Vec::with_capacity(blows);
    for _ in 0..blows {
        let mut world = World::new(mechanism, geometry, states, &options)?;
        let poses = world.link_poses();
        let (length, effort) = world.scale();
        for link in 0..mechanism.links().len() {
            world.push(link, blow(&mut random, &poses[link], length, effort / SHORT))?;
        }
        world.step()?;
        responses.push(response(&world, &poses, length));
    }
    let rows = responses.first().map_or(0, Vec::len);
    let matrix = Mat::from_fn(rows, blows, |row, column| responses[column][row]);
    let values = matrix.singular_values().unwrap_or_default();
    Ok(counted(&values, expected, seed))
}

/// A random wrench on a link: force and moment about the link's own origin of like effect.
fn blow(random: &mut SplitMix64, pose: &Rigid<f64>, length: f64, effort: f64) -> [f64; 6] {
    let mut three = || [0; 3].map(|_| random.symmetric());
    let force = three().map(|x| x * effort / length);
    let moment = three().map(|x| x * effort);
    let p = &pose.translation;
    let arm = crate::closure::cross_product(p, &force);
    [
        force[0],
        force[1],
        force[2],
        moment[0] + arm[0],
        moment[1] + arm[1],
        moment[2] + arm[2],
    ]
}

/// Angular velocities and velocities of the links' own origins in characteristic lengths.
fn response(world: &World, poses: &[Rigid<f64>], length: f64) -> Vec<f64> {
    world
        .link_twists()
        .iter()
        .zip(poses)
        .flat_map(|(twist, pose)| {
            let [a, b, c, x, y, z] = *twist;
            let turned = crate::closure::cross_product(&[a, b, c], &pose.translation);
            [
                a,
                b,
                c,
                (x + turned[0]) / length,
                (y + turned[1]) / length,
                (z + turned[2]) / length,
            ]
        })
        .collect()
}

/// Reads the number of freedoms off the singular values, largest first.
fn counted(values: &[f64], expected: usize, seed: u64) -> FreedomCount {
    let largest = values.first().copied().unwrap_or(0.0);
    let singular_values: Vec<f64> = values
        .iter()
        .map(|v| if largest > 0.0 { v / largest } else { 0.0 })
        .collect();
    // The widest step between neighbours; what is rounding counts as a level floor.
    let level = |index: usize| {
        singular_values
            .get(index)
            .map_or(ROUNDING, |v| v.max(ROUNDING))
    };
    let (mut found, mut gap) = (0, 1.0);
    if largest > 0.0 {
        for count in 1..=singular_values.len() {
            let step = level(count - 1) / level(count);
            if step > gap {
                (found, gap) = (count, step);
            }
        }
    }
    let finding = if largest > 0.0 && !(gap >= LEAST_GAP) {
        Finding::new(
            Outcome::Inconclusive,
            format!("no gap stands out among the responses; the widest is a factor of {gap:.1}"),
        )
    } else if found == expected {
        Finding::new(
            Outcome::Confirmed,
            format!("blows at random leave velocities of rank {found}, as predicted"),
        )
    } else {
        Finding::new(
            Outcome::Contradicted,
            format!("blows at random leave velocities of rank {found}; {expected} were predicted"),
        )
    };
    FreedomCount {
        expected,
        found,
        singular_values,
        gap,
        seed,
        finding,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn the_widest_gap_counts() {
        let two = counted(&[3.0, 1.0, 1e-6, 1e-7], 2, 1);
        assert_eq!((two.found, two.finding.outcome), (2, Outcome::Confirmed));
        assert!((two.gap - 1e6).abs() < 1.0);
        let other = counted(&[3.0, 1.0, 1e-6, 1e-7], 1, 1);
        assert_eq!(other.finding.outcome, Outcome::Contradicted);
        let level = counted(&[3.0, 1.0, 0.3, 0.1], 2, 1);
        assert_eq!(level.finding.outcome, Outcome::Inconclusive);
    }

    #[test]
    fn what_does_not_answer_has_no_freedom() {
        let none = counted(&[0.0, 0.0], 0, 1);
        assert_eq!((none.found, none.finding.outcome), (0, Outcome::Confirmed));
    }
}
