//! What was to be seen of a run, kept to be compared with another one and to be shown later.

use super::options::JointGap;
use super::scene_run::{Moves, STILL, Scene, gravity_of};
use super::trajectory::TrajectoryError;
use super::verification::{Moment, Observer, Passage, distance_between};
use kutzbach_closure::{JointState, Rigid};

/// Travel below this is rounding (characteristic lengths, rad).
const NO_TRAVEL: f64 = 1e-9;

/// All links and joints at the moments shown.
#[derive(Default)]
pub(super) struct Trail {
    moments: Vec<Shown>,
    /// Characteristic length (m).
    length: f64,
}

struct Shown {
    time: f64,
    done: f64,
    poses: Vec<Rigid<f64>>,
    twists: Vec<[f64; 6]>,
    states: Vec<JointState<f64>>,
    gaps: Vec<JointGap>,
    closure_error: f64,
}

impl Trail {
    /// Keeps a moment.
    pub fn keep(&mut self, world: &dyn Moves, moment: &Moment<'_>) {
        self.length = world.length();
        self.moments.push(Shown {
            time: moment.time,
            done: moment.done,
            poses: moment.simulated.to_vec(),
            twists: world.link_twists(),
            states: moment.states.to_vec(),
            gaps: moment.gaps.to_vec(),
            closure_error: moment.closure_error,
        });
    }

    /// Shows all moments that were kept.
    pub fn show(&self, passage: &Passage, observer: &mut dyn Observer) {
        let mut stopped = observer.begin(passage).is_break();
        for shown in &self.moments {
            if stopped {
                return;
            }
            let moment = Moment {
                time: shown.time,
                done: shown.done,
                simulated: &shown.poses,
                states: &shown.states,
                predicted: None,
                gaps: &shown.gaps,
                closure_error: shown.closure_error,
                distance: 0.0,
            };
            stopped = observer.moment(&moment).is_break();
        }
    }

    /// How far poses of links are from those of another run, moment by moment (characteristic lengths, rad).
    fn distances(&self, other: &Self, scene: &Scene<'_>) -> Vec<f64> {
        let pairs = self.moments.iter().zip(&other.moments);
        let (mechanism, geometry) = (scene.mechanism, scene.geometry);
        pairs
            .map(|(own, other)| {
                distance_between(mechanism, geometry, &own.poses, &other.poses, self.length)
            })
            .collect()
    }

    /// About how far this run is off at each moment (s; characteristic lengths, rad): its distance from a run in steps of another length,
    /// as a part of which the error at the worst moment is known.
    pub fn error_over_time(&self, other: &Self, worst: f64, scene: &Scene<'_>) -> Vec<(f64, f64)> {
        let distances = self.distances(other, scene);
        let most = distances.iter().copied().fold(0.0, larger);
        let part = if most > 0.0 { worst / most } else { 0.0 };
        let times = self.moments.iter().map(|shown| shown.time);
        times
            .zip(distances)
            .map(|(time, distance)| (time, part * distance))
            .collect()
    }

    /// The largest differences from a coarser run; infinite where one ended before the other.
    pub fn apart(&self, coarse: &Self, scene: &Scene<'_>) -> TrajectoryError {
        if self.moments.len() != coarse.moments.len() {
            return TrajectoryError {
                worst: f64::INFINITY,
                end: f64::INFINITY,
                speed: f64::INFINITY,
            };
        }
        let over_time = self.distances(coarse, scene);
        let worst = over_time.iter().copied().fold(0.0, larger);
        let end = over_time.last().copied().unwrap_or_default();
        let pairs = self.moments.iter().zip(&coarse.moments);
        // A speed whose energy is hardly any, and one that moves nothing in the time there is.
        let natural = (STILL * gravity_of(scene.options) / self.length).sqrt();
        let mut fastest = natural.max(NO_TRAVEL / scene.options.duration);
        let mut changed = 0.0;
        for (fine, coarse) in pairs {
            for link in 0..fine.poses.len() {
                let [own, less] = [fine, coarse].map(|shown| shown.speeds(link, self.length));
                let apart = std::array::from_fn(|i| own[i] - less[i]);
                fastest = larger(fastest, greatest(&own));
                changed = larger(changed, greatest(&apart));
            }
        }
        TrajectoryError {
            worst,
            end,
            speed: match changed {
                0.0 => 0.0,
                _ => changed / fastest,
            },
        }
    }
}

impl Shown {
    /// Angular velocity (rad/s) and velocity of the link's own origin (characteristic lengths per second).
    fn speeds(&self, link: usize, length: f64) -> [f64; 6] {
        let [a, b, c, u, v, w] = self.twists[link];
        let [x, y, z] = self.poses[link].translation;
        let own = [u + b * z - c * y, v + c * x - a * z, w + a * y - b * x];
        let [u, v, w] = own.map(|speed| speed / length);
        [a, b, c, u, v, w]
    }
}

/// The larger of the two parts of a twist.
fn greatest(twist: &[f64; 6]) -> f64 {
    let norm = |part: &[f64]| part.iter().map(|x| x * x).sum::<f64>().sqrt();
    let (turning, sliding) = twist.split_at(3);
    larger(norm(turning), norm(sliding))
}

/// The larger number; what is none must not pass for a small one.
fn larger(most: f64, next: f64) -> f64 {
    if next <= most { most } else { next }
}
