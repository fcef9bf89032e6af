//! Degrees of freedom as the rank of the response to random impulses.
//!
//! At a generic pose of a branch all links receive random impulses at once, many times over, and each time the velocities
//! that the joints leave them are noted. Those velocities are all the velocities it can have: their span is
//! the tangent space of the configuration space there, and its rank the number of freedoms. Nothing of the prediction goes
//! into the count but the pose.
//!
//! A blow is spread over one very short step. In the steps after it, as short, nothing moves noticeably while the solver,
//! sweep by sweep, comes to the velocities that fit all joints; what still violates them is measured, joint by joint.

use super::budget::Size;
use super::scale::LinkInertia;
use super::{Finding, Outcome, VerificationError};
use crate::{Masses, Solver, World, WorldOptions};
use faer::Mat;
use kutzbach_closure::{Geometry, JointState, Rigid, cross_product, spanning_poses};
use kutzbach_math::matrix::SplitMix64;
use kutzbach_model::mechanism::Mechanism;
use nalgebra::Vector3;
use serde::Serialize;

/// Blows beyond the freedoms expected: so many singular values show what a direction without freedom responds with.
const SPARE_BLOWS: usize = 4;

/// A step so short (s) that at the speeds a blow gives, about one characteristic length per second, a link goes some
/// millionths of a length in [`SETTLING_STEPS`] of them: the tangent space turns by no more. Yet not so short that rounding
/// in the poses, which the solver corrects within a substep, makes velocities: 1e-16 over a substep of 3e-10 s is 3e-7.
const SHORT: f64 = 1e-8;

/// Solver iterations of a step.
pub(super) const SUBSTEPS: usize = 32;

/// Steps after which velocities that do not settle are given up.
const SETTLING_STEPS: usize = 1000;

/// Fewer where work is limited, but not fewer than that many.
const FEWEST_SETTLING_STEPS: usize = 8;

/// Velocities have settled when no joint's are off by more than this share of the largest velocity. Directions that the
/// joints hold back by a small singular value σ only settle to share/σ: where the first count is not the one expected, it
/// is repeated with the second.
const SETTLED: [f64; 2] = [1e-4, 1e-6];

/// Where the inertias of links lie farther apart than this, all links get the same: the sweeps of the solver pass an impulse
/// on through a light link in as many small corrections as its neighbours are heavier.
pub(super) const MOST_SPREAD: f64 = 100.0;

/// Responses in free directions have to stand out of those in locked ones by this factor. The singular values of random
/// projections spread by about the number of blows over the spare ones, (n + 4)/4.
const LEAST_GAP: f64 = 30.0;

/// Responses below this share of what has not settled are none: no freedom is looked for there.
const ROUNDING: f64 = 0.1;

/// How many freedoms the simulated mechanism has at a pose.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FreedomCount {
    /// Instantaneous freedoms predicted at the pose.
    pub expected: usize,
    /// Finite freedoms predicted there; fewer where the branch gives way in further directions to first order only.
    pub finite: usize,
    /// Freedoms found.
    pub found: usize,
    /// Singular values of the responses, largest first, in parts of the largest.
    pub singular_values: Vec<f64>,
    /// The last of those counted over the first of those not; infinite where nothing is left.
    pub gap: f64,
    /// Seed of the blows.
    pub seed: u64,
    /// Steps of the engine that all blows took until they settled.
    #[serde(skip)]
    pub steps: usize,
    /// What follows.
    pub finding: Finding,
}

/// Strikes the mechanism at a closed pose and counts the directions in which it gives way: as many as there are finite
/// freedoms at least, and instantaneous ones at most. Directions in which a pose gives way to first order only are
/// blocked, stiffly, as soon as it has moved at all, or not, as the solver has it. Large mechanisms are given less time to
/// settle where settling all blows must not take more than a given work (s, as a budget counts it).
///
/// # Errors
/// Where no world can be made there, or it diverges.
pub fn count_freedoms(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    (finite, expected): (usize, usize),
    seed: u64,
    settling: Option<f64>,
) -> Result<FreedomCount, VerificationError> {
    let predicted = (finite.min(expected), expected);
    let masses = match World::new(mechanism, geometry, states, &WorldOptions::default())?
        .inertia_spread()
        > MOST_SPREAD
    {
        true => Masses::Alike,
        false => Masses::Stated,
    };
    let blows = (expected + SPARE_BLOWS) as f64;
    let step = Size::of(mechanism, 0).steps(blows, SUBSTEPS);
    let most = settling.map_or(SETTLING_STEPS, |work| {
        ((work / step) as usize).clamp(FEWEST_SETTLING_STEPS, SETTLING_STEPS)
    });
    let count = |masses| {
        let how = Shaking { masses, most, seed };
        count_with(mechanism, geometry, states, predicted, &how)
    };
    let first = count(masses)?;
    // What masses make of it is no matter of freedom.
    if first.finding.outcome == Outcome::Confirmed || masses == Masses::Alike {
        return Ok(first);
    }
    let second = count(Masses::Alike)?;
    let steps = first.steps + second.steps;
    let count = match second.finding.outcome {
        Outcome::Confirmed => second,
        Outcome::Contradicted | Outcome::Inconclusive => first,
    };
    Ok(FreedomCount { steps, ..count })
}

/// How a mechanism is struck.
struct Shaking {
    masses: Masses,
    /// Steps after which velocities that do not settle are given up.
    most: usize,
    /// Seed of the blows.
    seed: u64,
}

fn count_with(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    predicted: (usize, usize),
    how: &Shaking,
) -> Result<FreedomCount, VerificationError> {
    let expected = predicted.1;
    let [roughly, well] = SETTLED;
    let first = count_settled(
        mechanism,
        geometry,
        states,
        predicted,
        (roughly, false),
        how,
    )?;
    if first.finding.outcome == Outcome::Confirmed {
        return Ok(first);
    }
    let mut second = count_settled(mechanism, geometry, states, predicted, (well, true), how)?;
    second.steps += first.steps;
    let steady = steady(&first.singular_values, &second.singular_values);
    if steady < second.found {
        second.finding = if (predicted.0..=expected).contains(&steady) {
            Finding::new(
                Outcome::Confirmed,
                format!(
                    "random impulses excite {}, as predicted; in {} more the response dies away slowly: \
                     the joints hardly resist it",
                    excited(steady),
                    counted_directions(second.found - steady)
                ),
            )
        } else {
            Finding::new(
                Outcome::Inconclusive,
                format!("in some directions the response dies away; in {steady} it stays"),
            )
        };
        second.found = steady;
    }
    Ok(second)
}

/// `1 degree of freedom`.
fn excited(count: usize) -> String {
    match count {
        1 => "1 degree of freedom".to_owned(),
        _ => format!("{count} degrees of freedom"),
    }
}

fn counted_directions(count: usize) -> String {
    match count {
        1 => "one direction".to_owned(),
        more => format!("{more} directions"),
    }
}

/// How many responses stay while the velocities settle by a factor of a hundred: those in free directions do not change,
/// those that a constraint holds back, however weakly, fall with what is left of its violation.
fn steady(before: &[f64], after: &[f64]) -> usize {
    before
        .iter()
        .zip(after)
        .take_while(|(before, after)| **after > 0.5 * **before)
        .count()
}

fn count_settled(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    predicted: (usize, usize),
    (settled, couplings): (f64, bool),
    how: &Shaking,
) -> Result<FreedomCount, VerificationError> {
    let options = WorldOptions {
        solver: Solver::Multibody,
        time_step: SHORT,
        substeps: SUBSTEPS,
        ..WorldOptions::default()
    };
    let blows = predicted.1 + SPARE_BLOWS;
    let mut joints = JointTwists::at(mechanism, geometry, states);
    if !couplings {
        joints.couplings.clear();
    }
    let mut random = SplitMix64::new(how.seed);
    let mut responses = Vec::with_capacity(blows);
    let mut unsettled: f64 = 0.0;
    let mut steps = 0;
    for _ in 0..blows {
        let mut world = World::with_masses(mechanism, geometry, states, &options, how.masses)?;
        let poses = world.link_poses();
        let (length, energy) = world.scale();
        let bodies = world.link_inertias();
        for (link, body) in bodies.iter().enumerate() {
            if let Some(body) = body {
                world.push(link, blow(&mut random, &poses[link], body, energy))?;
            }
        }
        let mut left = f64::INFINITY;
        for _ in 0..how.most {
            world.step()?;
            steps += 1;
            let (off, largest) = joints.violation(&world.link_twists(), length);
            left = if largest > 0.0 { off / largest } else { 0.0 };
            if left <= settled {
                break;
            }
        }
        unsettled = unsettled.max(left);
        responses.push(response(&world, &poses, &bodies));
    }
    let rows = responses.first().map_or(0, Vec::len);
    let matrix = Mat::from_fn(rows, blows, |row, column| responses[column][row]);
    let values = matrix.singular_values().unwrap_or_default();
    let count = counted(&values, predicted, (unsettled, settled), how.seed);
    Ok(FreedomCount { steps, ..count })
}

/// What twists the joints allow at a pose: for each joint the two links and an orthonormal basis, angular parts in rad/s and
/// linear ones, about the predecessor's joint frame, in characteristic lengths per second.
struct JointTwists {
    joints: Vec<AllowedTwists>,
    /// Of every coupling its terms: the joint, and its factor.
    couplings: Vec<Vec<(usize, f64)>>,
}

struct AllowedTwists {
    links: [usize; 2],
    about: [f64; 3],
    screws: Vec<[f64; 6]>,
}

impl JointTwists {
    fn at(mechanism: &Mechanism, geometry: &Geometry<f64>, states: &[JointState<f64>]) -> Self {
        let (poses, _) = spanning_poses(mechanism, geometry, states);
        Self {
            couplings: geometry
                .couplings
                .iter()
                .map(|c| c.slopes(states))
                .collect(),
            joints: mechanism
                .joints()
                .iter()
                .enumerate()
                .map(|(index, joint)| {
                    let links = [joint.predecessor.link.0, joint.successor.link.0];
                    let frame = poses[links[0]].compose(&geometry.sides[index][0]);
                    let about = frame.translation;
                    let screws = geometry.displacements[index]
                        .screws(&states[index])
                        .iter()
                        .map(|screw| {
                            let (angular, linear) = screw.moved(&frame).about(&about);
                            six(angular, linear)
                        })
                        .collect();
                    AllowedTwists {
                        links,
                        about,
                        screws,
                    }
                })
                .collect(),
        }
    }

    /// The largest part of a relative velocity that a joint or a coupling does not allow, and the largest velocity of all.
    fn violation(&self, twists: &[[f64; 6]], length: f64) -> (f64, f64) {
        let (mut off, mut largest) = (0.0f64, 0.0f64);
        let mut rates = Vec::with_capacity(self.joints.len());
        for joint in &self.joints {
            let [predecessor, successor] = joint.links.map(|link| {
                let [a, b, c, x, y, z] = twists[link];
                let turned = cross_product(&[a, b, c], &joint.about);
                [
                    a,
                    b,
                    c,
                    (x + turned[0]) / length,
                    (y + turned[1]) / length,
                    (z + turned[2]) / length,
                ]
            });
            largest = largest.max(size(&predecessor)).max(size(&successor));
            let mut relative: [f64; 6] = std::array::from_fn(|i| successor[i] - predecessor[i]);
            rates.push(joint.rate(&relative, length));
            let mut basis: Vec<[f64; 6]> = Vec::new();
            for screw in &joint.screws {
                let mut screw = *screw;
                screw[3..].iter_mut().for_each(|x| *x /= length);
                basis.iter().for_each(|b| remove(&mut screw, b));
                let norm = size(&screw);
                if norm > 0.0 {
                    basis.push(screw.map(|x| x / norm));
                }
            }
            basis.iter().for_each(|b| remove(&mut relative, b));
            off = off.max(size(&relative));
        }
        for terms in &self.couplings {
            let (mut sum, mut all) = (0.0f64, 0.0f64);
            for &(joint, factor) in terms {
                let (rate, unit) = rates[joint];
                sum += factor * unit * rate;
                all += (factor * unit).abs();
            }
            if all > 0.0 {
                off = off.max((sum / all).abs());
            }
        }
        (off, largest)
    }
}

impl AllowedTwists {
    /// Rate of the joint's first variable (rad/s, characteristic lengths per second) in a relative velocity whose linear part
    /// is in characteristic lengths, and what one such unit is in the variable's own. Couplings speak of joints of one
    /// turn or one slide.
    fn rate(&self, relative: &[f64; 6], length: f64) -> (f64, f64) {
        let Some(screw) = self.screws.first() else {
            return (0.0, 0.0);
        };
        let turns = screw[..3].iter().any(|x| *x != 0.0);
        let unit = if turns { 1.0 } else { length };
        let scaled: [f64; 6] =
            std::array::from_fn(|i| screw[i] * unit / if i < 3 { 1.0 } else { length });
        let along: f64 = scaled.iter().zip(relative).map(|(s, v)| s * v).sum();
        (along / scaled.iter().map(|s| s * s).sum::<f64>(), unit)
    }
}

fn six(a: [f64; 3], b: [f64; 3]) -> [f64; 6] {
    [a[0], a[1], a[2], b[0], b[1], b[2]]
}

fn size(x: &[f64; 6]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Takes the part along a unit vector out.
fn remove(x: &mut [f64; 6], along: &[f64; 6]) {
    let part: f64 = x.iter().zip(along).map(|(a, b)| a * b).sum();
    x.iter_mut().zip(along).for_each(|(x, a)| *x -= part * a);
}

/// A random impulse on a link as a wrench over one step: every component of like energy, whatever the link's inertia.
fn blow(random: &mut SplitMix64, pose: &Rigid<f64>, body: &LinkInertia, energy: f64) -> [f64; 6] {
    let mut three = || Vector3::from_fn(|_, _| random.symmetric()) * (energy.sqrt() / SHORT);
    let force: [f64; 3] = (three() * body.mass.sqrt()).into();
    let moment: [f64; 3] = (body.root * three()).into();
    let centre = pose.apply(&body.centre);
    let about_origin = cross_product(&centre, &force);
    let moment = pose.rotate(&moment);
    six(force, std::array::from_fn(|i| moment[i] + about_origin[i]))
}

/// Velocities, each weighted by the root of its inertia. With blows of like energy what the joints leave of them is then
/// a projection: directions that are free answer with all of a blow, others with nothing.
fn response(world: &World, poses: &[Rigid<f64>], bodies: &[Option<LinkInertia>]) -> Vec<f64> {
    let mut rows = Vec::with_capacity(6 * poses.len());
    for ((twist, pose), body) in world.link_twists().iter().zip(poses).zip(bodies) {
        let Some(body) = body else { continue };
        let [a, b, c, x, y, z] = *twist;
        let centre = pose.apply(&body.centre);
        let turned = cross_product(&[a, b, c], &centre);
        let spin = body.root.transpose() * Vector3::from(pose.rotate_back(&[a, b, c]));
        rows.extend(spin.iter());
        let root = body.mass.sqrt();
        rows.extend([x + turned[0], y + turned[1], z + turned[2]].map(|v| v * root));
    }
    rows
}

/// Reads the number of freedoms off the singular values, largest first. What the velocities are still off by comes with what
/// it was to be.
fn counted(
    values: &[f64],
    (finite, expected): (usize, usize),
    (unsettled, wanted): (f64, f64),
    seed: u64,
) -> FreedomCount {
    let largest = values.first().copied().unwrap_or(0.0);
    let singular_values: Vec<f64> = values
        .iter()
        .map(|v| if largest > 0.0 { v / largest } else { 0.0 })
        .collect();
    // The widest step between neighbours; what is rounding counts as a level floor.
    let floor = ROUNDING * wanted.max(f64::EPSILON);
    let level = |index: usize| singular_values.get(index).map_or(floor, |v| v.max(floor));
    let (mut found, mut gap) = (0, 1.0);
    if largest > 0.0 {
        for count in 1..=singular_values.len() {
            let step = level(count - 1) / level(count);
            if step > gap {
                (found, gap) = (count, step);
            }
        }
    }
    let agrees = (finite..=expected).contains(&found);
    // What has not settled shifts no singular value by more than itself times the root of their number (Weyl), and blows only fade: a
    // freedom that is not there by then will not come.
    let shift = unsettled * (singular_values.len() as f64).sqrt();
    let missing = found > 0 && found < finite && level(found - 1) > LEAST_GAP * shift;
    let finding = if !(unsettled <= wanted) && !agrees && !missing {
        Finding::new(
            Outcome::Inconclusive,
            format!(
                "the velocities after an impulse did not settle: joints are off by {unsettled:.1e} of them"
            ),
        )
    } else if largest > 0.0 && !(gap >= LEAST_GAP) {
        Finding::new(
            Outcome::Inconclusive,
            format!("no gap stands out among the responses; the widest is a factor of {gap:.1}"),
        )
    } else if found == expected {
        Finding::new(
            Outcome::Confirmed,
            format!("random impulses excite {}, as predicted", excited(found)),
        )
    } else if agrees {
        Finding::new(
            Outcome::Confirmed,
            format!(
                "random impulses excite {}, the finite mobility: of {} possible to first order, the others are \
                 blocked as the mechanism moves",
                excited(found),
                excited(expected)
            ),
        )
    } else {
        Finding::new(
            Outcome::Contradicted,
            format!(
                "random impulses excite {}; {expected} were predicted",
                excited(found)
            ),
        )
    };
    FreedomCount {
        expected,
        finite,
        found,
        singular_values,
        gap,
        seed,
        steps: 0,
        finding,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn the_widest_gap_counts() {
        let two = counted(&[3.0, 1.0, 1e-6, 1e-7], (2, 2), (0.0, 1e-8), 1);
        assert_eq!((two.found, two.finding.outcome), (2, Outcome::Confirmed));
        assert!((two.gap - 1e6).abs() < 1.0);
        let other = counted(&[3.0, 1.0, 1e-6, 1e-7], (1, 1), (0.0, 1e-8), 1);
        assert_eq!(other.finding.outcome, Outcome::Contradicted);
        let shaky = counted(&[3.0, 1e-6, 1e-7], (1, 2), (0.0, 1e-8), 1);
        assert_eq!(
            (shaky.found, shaky.finding.outcome),
            (1, Outcome::Confirmed)
        );
        let all = counted(&[3.0, 1.0, 0.3, 0.1], (2, 2), (0.0, 1e-8), 1);
        assert_eq!((all.found, all.finding.outcome), (4, Outcome::Contradicted));
        // A freedom too few is one also where velocities have not settled; one too many may still fade.
        let unsettled = |finite| counted(&[3.0, 1.0, 1e-6, 1e-7], finite, (1e-4, 1e-8), 1);
        assert_eq!(unsettled((3, 3)).finding.outcome, Outcome::Contradicted);
        assert_eq!(unsettled((1, 1)).finding.outcome, Outcome::Inconclusive);
        let level = counted(&[1.0, 0.2, 0.02, 2e-3, 2e-4, 2e-5], (2, 2), (0.0, 1e-5), 1);
        assert_eq!(level.finding.outcome, Outcome::Inconclusive);
    }

    #[test]
    fn what_dies_away_is_no_freedom() {
        assert_eq!(
            steady(&[1.0, 0.3, 0.06, 1e-5], &[1.0, 0.29, 0.002, 1e-6]),
            2
        );
        assert_eq!(steady(&[1.0, 0.3], &[1.0, 0.3]), 2);
    }

    #[test]
    fn what_does_not_answer_has_no_freedom() {
        let none = counted(&[0.0, 0.0], (0, 0), (0.0, 1e-8), 1);
        assert_eq!((none.found, none.finding.outcome), (0, Outcome::Confirmed));
    }
}
