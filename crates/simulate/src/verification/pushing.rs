//! Pushing what is said to be rigid.
//!
//! Every freedom of every joint is pushed in turn, one way and the other, by a drive with a capped force, from rest at the
//! home pose. A mechanism that can move yields: in the time given the drive would turn free links a good part of a radian.
//! One that is rigid stays, but for what the simulated joints give way: a gap that the solver leaves lets a joint move by
//! as much as the gap over the lever it acts on, and at a shaky pose by the square root of it.

use super::VerificationError;
use super::budget::{Budget, Size};
use super::closing::{closes, walks};
use super::ladder::{Finding, LEVEL_ORDER, Outcome, order_between};
use super::observer::{Moment, Observer, Passage};
use crate::{Drive, Masses, Solver, World, WorldOptions};
use kutzbach_closure::{Geometry, JointState, variable_unit};
use kutzbach_mobility::Structure;
use kutzbach_model::mechanism::Mechanism;
use kutzbach_motion::Variable;
use serde::Serialize;

/// Seconds that a push lasts.
const DURATION: f64 = 0.5;

/// Rate that the drive goes for (rad/s, characteristic lengths per s).
const RATE: f64 = 1.0;

/// Largest torque, in moments of inertia of the whole mechanism (mass × length²) per s²: enough to bring it to speed in
/// a fifth of the time if it can move at all.
const EFFORT: f64 = 10.0;

/// A joint that has moved by less than this (rad, characteristic lengths) has stayed. Free ones go ten times as far.
pub const STAYED: f64 = 0.03;

/// A joint that goes this far with all gaps below [`TIGHT`] goes as far as a free one: finer substeps will not stop it. That
/// by itself contradicts nothing: loops that miss by less than the gaps are rigid on paper all the same.
const WENT_FREELY: f64 = 0.2;

/// Where in addition the loops close to rounding, 1e-15, next to every pose on the way, this far is no isolated pose: one that holds to the
/// order k leaves its loops open by 0.1ᵏ there, and none above eight is known.
const WENT_CLOSED: f64 = 0.1;

/// Corrections that close the loops of a simulated pose are at most so many of its gaps: many joints in a row add theirs.
const NEAR: f64 = 100.0;

/// Moments of one push whose poses all close exactly, from a joint's having moved by [`STAYED`] on: that many poses on the way are no
/// isolated ones.
const ENOUGH: usize = 3;

/// Gaps (characteristic lengths, rad) that explain no motion of [`WENT_FREELY`]: even where they hold a joint by their
/// fourth root only, as at the flattest isolated poses known, they would have to be 0.2⁴.
const TIGHT: f64 = 1e-5;

/// Moments of a push that an observer sees.
const MOMENTS: usize = 12;

/// All pushes at one number of substeps.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PushRung {
    /// Substeps per step.
    pub substeps: usize,
    /// The push that moved something farthest: name of the freedom pushed, with the sign of the way.
    pub farthest: String,
    /// How far any joint moved then (rad, characteristic lengths).
    pub moved: f64,
    /// Largest gap of any joint in that push (characteristic lengths, rad).
    pub closure_error: f64,
    /// Whether the loops of every pose looked at in that push can be closed to rounding next to it, once it had moved.
    pub closes: bool,
    /// Pushes made.
    pub pushes: usize,
    /// Seconds on the clock.
    #[serde(skip)]
    pub wall_time: f64,
}

/// What pushing every joint came to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Pushing {
    /// The ladder of substeps, coarse to fine.
    pub rungs: Vec<PushRung>,
    /// What follows.
    pub finding: Finding,
    /// Whether an observer broke it off.
    pub stopped: bool,
}

/// What is pushed: where, with which settings.
pub(super) struct Pushed<'a> {
    pub mechanism: &'a Mechanism,
    pub geometry: &'a Geometry<f64>,
    pub structure: &'a Structure,
    /// Whether rigidity is proved by exact algebra, which no closing to rounding contradicts.
    pub proved: bool,
    pub states: &'a [JointState<f64>],
    pub solver: Solver,
    pub time_step: f64,
    pub ladder: &'a [usize],
    /// Characteristic length (m).
    pub length: f64,
    pub masses: Masses,
}

/// How one push went.
struct Push {
    moved: f64,
    closure_error: f64,
    /// Moments at which something had moved, and those of them whose poses close to rounding.
    closing: [usize; 2],
    stopped: bool,
}

impl Pushed<'_> {
    /// Pushes every freedom both ways, and at finer and finer substeps those again that moved, until everything stays. Nothing that stays
    /// is taken for rigid whose loops close along the way all the same: redundant constraints lock a solver.
    ///
    /// # Errors
    /// Where no world can be made, or it diverges.
    pub fn push_all(
        &self,
        (size, budget): (&Size, &mut Budget),
        observer: &mut dyn Observer,
    ) -> Result<Pushing, VerificationError> {
        let mut pushing = self.push_each((size, budget), observer)?;
        let open = pushing.finding.outcome != Outcome::Contradicted;
        if open
            && !(self.proved || pushing.stopped || pushing.rungs.is_empty())
            && let Some(way) = walks(self.mechanism, self.geometry, self.structure, self.states)
        {
            let why = format!(
                "the simulation does not show it ({}), but next to the pose drawn its loops close to rounding at every step of a way of {way:.2}",
                pushing.finding.why
            );
            pushing.finding = Finding::new(Outcome::Contradicted, why);
        }
        Ok(pushing)
    }

    fn push_each(
        &self,
        (size, budget): (&Size, &mut Budget),
        observer: &mut dyn Observer,
    ) -> Result<Pushing, VerificationError> {
        let mut rungs: Vec<PushRung> = Vec::new();
        let mut left: Vec<(usize, usize, f64)> = Vec::new();
        for (joint, definition) in self.mechanism.joints().iter().enumerate() {
            for freedom in 0..definition.freedom() {
                left.extend([(joint, freedom, 1.0), (joint, freedom, -1.0)]);
            }
        }
        for &substeps in self.ladder {
            let steps = left.len() as f64 * (DURATION / self.time_step).ceil();
            if !budget.affords(size.steps(steps, substeps)) {
                let finding = match rungs.is_empty() {
                    true => "no joint was pushed: that does not fit into",
                    false => "something moved when pushed, and finer substeps do not fit into",
                };
                let finding = format!("{finding} {}", budget.words());
                return Ok(Pushing {
                    rungs,
                    finding: Finding::new(Outcome::Inconclusive, finding),
                    stopped: false,
                });
            }
            // What has stayed would stay at finer substeps all the more.
            let mut moved = Vec::new();
            let begun = std::time::Instant::now();
            let mut rung = PushRung {
                substeps,
                farthest: String::new(),
                moved: 0.0,
                closure_error: 0.0,
                closes: false,
                pushes: 0,
                wall_time: 0.0,
            };
            for &(joint, freedom, sign) in &left {
                let way = if sign > 0.0 { '+' } else { '−' };
                let name = self.mechanism.joints()[joint].freedom_name(freedom);
                let title = format!("{way}{name}");
                let push = self.push(joint, freedom, sign, substeps, &title, observer)?;
                rung.pushes += 1;
                // What is not a number must not pass for small.
                if !(push.moved <= STAYED) {
                    moved.push((joint, freedom, sign));
                }
                if !(push.moved <= rung.moved) || rung.pushes == 1 {
                    rung.moved = push.moved;
                    rung.closure_error = push.closure_error;
                    rung.closes = push.closing[0] >= ENOUGH && push.closing[0] == push.closing[1];
                    rung.farthest = title;
                }
                if push.stopped {
                    rung.wall_time = begun.elapsed().as_secs_f64();
                    rungs.push(rung);
                    return Ok(Pushing {
                        rungs,
                        finding: Finding::new(
                            Outcome::Inconclusive,
                            "broken off before every joint was pushed",
                        ),
                        stopped: true,
                    });
                }
            }
            left = moved;
            rung.wall_time = begun.elapsed().as_secs_f64();
            rungs.push(rung);
            if let Some(finding) = judge_pushing(&rungs, self.proved) {
                return Ok(Pushing {
                    rungs,
                    finding,
                    stopped: false,
                });
            }
        }
        let finding = gave_way(&rungs);
        Ok(Pushing {
            rungs,
            finding,
            stopped: false,
        })
    }

    fn push(
        &self,
        joint: usize,
        freedom: usize,
        sign: f64,
        substeps: usize,
        title: &str,
        observer: &mut dyn Observer,
    ) -> Result<Push, VerificationError> {
        let options = WorldOptions {
            solver: self.solver,
            time_step: self.time_step,
            substeps,
            ..WorldOptions::default()
        };
        let mut world = World::with_masses(
            self.mechanism,
            self.geometry,
            self.states,
            &options,
            self.masses,
        )?;
        let (_, effort) = world.scale();
        // A force on a slider does the work of a torque on a lever of the characteristic length.
        let parts = self.mechanism.joints()[joint].kind.freedoms();
        let unit = variable_unit(parts[freedom], self.length);
        world.drive(Drive {
            joint,
            freedom,
            velocity: sign * RATE * unit,
            largest_force: EFFORT * effort / unit,
        })?;
        let mut push = Push {
            moved: 0.0,
            closure_error: 0.0,
            closing: [0; 2],
            stopped: false,
        };
        push.stopped = observer
            .begin(&Passage {
                title: format!("push {title}"),
                branch: String::new(),
                driven: Some(Variable::of(self.mechanism, joint, freedom)),
                substeps,
                duration: DURATION,
            })
            .is_break();
        let home = world.link_poses();
        let steps = (DURATION / self.time_step).ceil().max(1.0) as usize;
        let every = steps.div_ceil(MOMENTS);
        for step in 1..=steps {
            if push.stopped {
                break;
            }
            world.step()?;
            if step % every != 0 && step != steps {
                continue;
            }
            let gaps = world.gaps();
            let states = world.states(self.states);
            let closure_error = super::largest_gap(&gaps, self.length);
            let moved = self.moved(&states);
            for (most, now) in [
                (&mut push.moved, moved),
                (&mut push.closure_error, closure_error),
            ] {
                if !(now <= *most) {
                    *most = now;
                }
            }
            if moved > STAYED && closure_error <= TIGHT {
                let reach = NEAR * closure_error.max(f64::EPSILON);
                let (mechanism, structure) = (self.mechanism, self.structure);
                push.closing[0] += 1;
                if closes(mechanism, self.geometry, structure, &states, reach) {
                    push.closing[1] += 1;
                }
            }
            push.stopped = observer
                .moment(&Moment {
                    time: world.time(),
                    done: step as f64 / steps as f64,
                    simulated: &world.link_poses(),
                    states: &states,
                    predicted: Some((&home, self.states)),
                    gaps: &gaps,
                    closure_error,
                    distance: moved,
                })
                .is_break();
        }
        Ok(push)
    }

    /// How far any joint is from where it started (rad, characteristic lengths).
    fn moved(&self, states: &[JointState<f64>]) -> f64 {
        let mut largest: f64 = 0.0;
        let joints = self.mechanism.joints().iter().zip(states).enumerate();
        for (index, (joint, state)) in joints {
            let increments =
                self.geometry.displacements[index].increments(&self.states[index], state);
            for (part, increment) in joint.kind.freedoms().iter().zip(increments) {
                let way = increment.abs() / variable_unit(*part, self.length);
                if !(way <= largest) {
                    largest = way;
                }
            }
        }
        largest
    }
}

/// Judges the rungs so far; `None` where finer substeps may still decide. What is `proved` rigid by exact algebra is not contradicted by
/// loops that close to rounding.
#[must_use]
pub fn judge_pushing(rungs: &[PushRung], proved: bool) -> Option<Finding> {
    let last = rungs.last()?;
    if last.moved <= STAYED {
        return Some(Finding::new(
            Outcome::Confirmed,
            match rungs.first().map_or(0, |first| first.pushes) {
                0 => "there is no joint that could be pushed".to_owned(),
                pushes => format!(
                    "in {pushes} pushes, every freedom of every joint both ways, nothing moved by \
                     more than {:.1e} ({})",
                    last.moved, last.farthest
                ),
            },
        ));
    }
    if last.moved >= WENT_CLOSED && last.closure_error <= TIGHT && last.closes && !proved {
        return Some(Finding::new(
            Outcome::Contradicted,
            format!(
                "pushed at {}, it moved by {:.2}, and at every pose looked at on the way its loops close to rounding",
                last.farthest, last.moved
            ),
        ));
    }
    if last.moved >= WENT_FREELY && last.closure_error <= TIGHT {
        return Some(Finding::new(
            Outcome::Inconclusive,
            format!(
                "pushed at {}, it moved by {:.2} while no joint gave way by more than {:.1e}: if its loops \
                 miss, it is by so little that a simulation does not feel it",
                last.farthest, last.moved, last.closure_error
            ),
        ));
    }
    None
}

/// The sentence for pushes that moved something at every number of substeps.
fn gave_way(rungs: &[PushRung]) -> Finding {
    let (Some(first), Some(last)) = (rungs.first(), rungs.last()) else {
        return Finding::new(Outcome::Inconclusive, "nothing was pushed");
    };
    let order = order_between(
        (first.substeps, first.closure_error),
        (last.substeps, last.closure_error),
    );
    let why = if order.is_some_and(|order| order < LEVEL_ORDER) {
        format!(
            "pushed at {}, it moved by {:.2}, but not because it is free: the closure error levels off \
             at {:.1e}, its loops do not fit and its joints give way by as much",
            last.farthest, last.moved, last.closure_error
        )
    } else {
        format!(
            "pushed at {}, it moved by {:.2e} while its joints gave way by {:.1e}: the simulation is too \
             soft to tell",
            last.farthest, last.moved, last.closure_error
        )
    };
    Finding::new(Outcome::Inconclusive, why)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn rung(moved: f64, closure_error: f64) -> PushRung {
        PushRung {
            substeps: 4,
            farthest: "+crank".to_owned(),
            moved,
            closure_error,
            closes: false,
            pushes: 8,
            wall_time: 0.0,
        }
    }

    #[test]
    fn what_stays_is_rigid_and_what_runs_free_is_not() {
        let of = |moved, error| judge_pushing(&[rung(moved, error)], false).map(|f| f.outcome);
        assert_eq!(of(1e-4, 1e-5), Some(Outcome::Confirmed));
        assert_eq!(of(0.4, 1e-7), Some(Outcome::Inconclusive));
        assert_eq!(of(0.4, 1e-3), None);
        assert_eq!(of(0.1, 1e-7), None);
        assert_eq!(of(f64::NAN, 1e-7), None);
        let closed = PushRung {
            closes: true,
            ..rung(0.4, 1e-7)
        };
        let of = |proved| judge_pushing(std::slice::from_ref(&closed), proved).map(|f| f.outcome);
        assert_eq!(of(false), Some(Outcome::Contradicted));
        let less = PushRung {
            closes: true,
            ..rung(0.15, 1e-7)
        };
        let found = judge_pushing(&[less], false).map(|f| f.outcome);
        assert_eq!(found, Some(Outcome::Contradicted));
        assert_eq!(of(true), Some(Outcome::Inconclusive));
        assert_eq!(gave_way(&[rung(0.4, 1e-3)]).outcome, Outcome::Inconclusive);
    }
}
