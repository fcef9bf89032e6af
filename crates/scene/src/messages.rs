//! Numbers in, typed messages out.

use super::error::RecordError;
use super::vectors::{Point, is_finite};
use foxglove::messages::{Pose, Quaternion, Timestamp, Vector3};
use kutzbach_closure::Rigid;
use kutzbach_model::mechanism::Mechanism;

/// One motion at one moment.
#[derive(Clone, Copy, Debug)]
pub struct Motion<'a> {
    /// `world_from_link` of every link.
    pub links: &'a [Rigid<f64>],
    /// The values of every joint's variables (rad, m); empty where they are not to be logged.
    pub joints: &'a [Vec<f64>],
    /// Their rates (rad/s, m/s), in the same shape; empty where they are not known.
    pub rates: &'a [Vec<f64>],
    /// Joints whose two sides do not meet.
    pub gaps: &'a [Gap],
}

impl<'a> Motion<'a> {
    /// Link poses alone.
    #[must_use]
    pub fn of_links(links: &'a [Rigid<f64>]) -> Self {
        Self {
            links,
            joints: &[],
            rates: &[],
            gaps: &[],
        }
    }

    /// Whether the numbers fit the mechanism and can be shown.
    pub(super) fn check(&self, mechanism: &Mechanism) -> Result<(), RecordError> {
        let count = |what, expected: usize, found: usize| {
            if expected == found {
                return Ok(());
            }
            Err(RecordError::Count {
                what,
                expected,
                found,
            })
        };
        let links = mechanism.links();
        count("link poses", links.len(), self.links.len())?;
        if let Some(bad) = self.links.iter().position(|pose| !is_finite(pose)) {
            return Err(RecordError::NotFinite {
                what: format!("the pose of link `{}`", links[bad].name),
            });
        }
        let joints = mechanism.joints();
        for (what, values) in [("joint values", self.joints), ("joint rates", self.rates)] {
            if values.is_empty() {
                continue;
            }
            count(what, joints.len(), values.len())?;
            for (joint, values) in joints.iter().zip(values) {
                count(what, joint.freedom(), values.len())?;
                if !values.iter().all(|x| x.is_finite()) {
                    return Err(RecordError::NotFinite {
                        what: format!("a value of joint `{}`", joint.name),
                    });
                }
            }
        }
        for gap in self.gaps {
            let Some(joint) = joints.get(gap.joint) else {
                return Err(RecordError::Count {
                    what: "as the index of a joint with a gap",
                    expected: joints.len(),
                    found: gap.joint,
                });
            };
            if !gap
                .predecessor
                .iter()
                .chain(&gap.successor)
                .all(|x| x.is_finite())
            {
                return Err(RecordError::NotFinite {
                    what: format!("the gap at joint `{}`", joint.name),
                });
            }
        }
        Ok(())
    }
}

/// The two places that should be one, in the world frame (m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// Index of the joint.
    pub joint: usize,
    /// Where the predecessor has it.
    pub predecessor: [f64; 3],
    /// Where the successor has it.
    pub successor: [f64; 3],
}

/// How well the loops close, on `/mobility/closure`.
#[derive(Clone, Debug, Default, PartialEq, foxglove::Encode)]
pub struct Closure {
    /// Of the predicted motion.
    pub predicted: Option<ClosureError>,
    /// Of the simulated motion.
    pub simulated: Option<ClosureError>,
}

/// What is left open at one moment.
#[derive(Clone, Debug, Default, PartialEq, foxglove::Encode)]
pub struct ClosureError {
    /// Largest distance between the two sides of a joint, its freedoms taken out (m).
    pub position: f64,
    /// Largest angle between the two sides of a joint, its freedoms taken out (rad).
    pub angle: f64,
    /// The larger of the angle and the distance in units of the mechanism's characteristic length.
    pub relative: f64,
    /// Joint by joint, those that are worth telling.
    pub joints: Vec<JointClosure>,
}

/// What one joint leaves open.
#[derive(Clone, Debug, Default, PartialEq, foxglove::Encode)]
pub struct JointClosure {
    /// Name of the joint.
    pub joint: String,
    /// Distance (m).
    pub position: f64,
    /// Angle (rad).
    pub angle: f64,
}

/// Where the predicted motion stands, and the simulated one beside it, on `/mobility/prediction`.
#[derive(Clone, Debug, Default, PartialEq, foxglove::Encode)]
pub struct Prediction {
    /// Name of the branch that is followed.
    pub branch: String,
    /// Arc length along the branch, from home (characteristic lengths and radians).
    pub parameter: f64,
    /// Name of the driven variable.
    pub drive: String,
    /// Its predicted value (rad, m).
    pub predicted: f64,
    /// Its simulated value (rad, m).
    pub simulated: Option<f64>,
    /// Distance of the simulated configuration from the predicted branch (characteristic lengths and radians).
    pub distance: Option<f64>,
    /// Margin of the rank: the smallest singular value kept, in units of the largest.
    pub margin: Option<f64>,
    /// What happens here: `dead centre`, `bifurcation`, `limit of hinge_1`, …; empty where nothing does.
    pub event: String,
}

/// About how far a simulated scene is off, by runs in steps of another length, on `/mobility/error`.
#[derive(Clone, Debug, Default, PartialEq, foxglove::Encode)]
pub struct Estimate {
    /// Poses of links (characteristic lengths and radians).
    pub error: f64,
}

/// How urgent an entry of `/log` is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// For whoever looks for a fault.
    Debug,
    /// News.
    Info,
    /// Something to look at.
    Warning,
    /// Something failed.
    Error,
}

/// Times of day of a simulated time: the clock of a log starts at zero.
pub fn nanoseconds(time: f64) -> Result<u64, RecordError> {
    // Seconds have 32 bits in a time stamp.
    if !(time >= 0.0 && time < f64::from(u32::MAX)) {
        return Err(RecordError::Time { time });
    }
    // Whole seconds apart, so that nanoseconds are rounded once.
    let whole = time.floor();
    Ok(whole as u64 * 1_000_000_000 + ((time - whole) * 1e9).round() as u64)
}

/// A time stamp inside a message.
pub fn stamp(nanoseconds: u64) -> Timestamp {
    let seconds = u32::try_from(nanoseconds / 1_000_000_000).unwrap_or(u32::MAX);
    Timestamp::new(seconds, (nanoseconds % 1_000_000_000) as u32)
}

pub fn vector(point: Point) -> Vector3 {
    // Adding zero turns −0 into 0.
    let [x, y, z] = point.map(|x| x + 0.0);
    Vector3 { x, y, z }
}

pub fn rotation(pose: &Rigid<f64>) -> Quaternion {
    let [x, y, z, w] = pose.quaternion();
    Quaternion { x, y, z, w }
}

pub fn pose(pose: &Rigid<f64>) -> Pose {
    Pose {
        position: Some(vector(pose.translation)),
        orientation: Some(rotation(pose)),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn times_are_rounded_once_and_kept_in_range() {
        assert_eq!(nanoseconds(0.0).unwrap(), 0);
        assert_eq!(nanoseconds(0.1).unwrap(), 100_000_000);
        assert_eq!(nanoseconds(2.999_999_999_9).unwrap(), 3_000_000_000);
        assert_eq!(nanoseconds(1e9 + 0.5).unwrap(), 1_000_000_000_500_000_000);
        for time in [-1e-9, f64::NAN, f64::INFINITY, 4_294_967_295.0, 1e300] {
            assert!(nanoseconds(time).is_err(), "{time}");
        }
        let last = nanoseconds(4_294_967_294.999_999).unwrap();
        assert_eq!(stamp(last).sec(), 4_294_967_294);
    }
}
