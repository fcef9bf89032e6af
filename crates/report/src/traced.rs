//! A traced motion as data: `kutzbach trace --format json`.

use kutzbach_closure::Rigid;
use kutzbach_model::mechanism::Mechanism;
use kutzbach_motion::{EndReason, EventKind, Motion, Spacing, Trace, Variable};
use serde_json::{Value, json};

/// The version of the JSON.
pub const TRACE_SCHEMA: &str = "kutzbach-trace-1";

/// A point fixed to a link.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkPoint {
    /// What it is called: the link and the coordinates, as in `coupler(1 0.5 0)`.
    pub name: String,
    /// Index of the link.
    pub link: usize,
    /// Its coordinates in the link's frame (m).
    pub at: [f64; 3],
}

impl LinkPoint {
    /// Where it is in the world (m), at the poses `world_from_link` of all links; `None` where the link is not among them.
    #[must_use]
    pub fn place(&self, links: &[Rigid<f64>]) -> Option<[f64; 3]> {
        links.get(self.link).map(|pose| pose.apply(&self.at))
    }

    /// Its places (m) at the samples of a motion, one after another.
    #[must_use]
    pub fn path(&self, motion: &Motion) -> Vec<[f64; 3]> {
        let samples = motion.samples.iter();
        samples
            .filter_map(|sample| self.place(&sample.links))
            .collect()
    }
}

/// The rotation of a pose as a unit quaternion (w, x, y, z).
#[must_use]
pub fn quaternion(pose: &Rigid<f64>) -> [f64; 4] {
    let [x, y, z, w] = pose.quaternion();
    [w, x, y, z]
}

fn event_json(kind: &EventKind) -> Value {
    match kind {
        EventKind::DeadCentre {
            variable,
            value,
            greatest,
        } => {
            json!({"kind": "dead_centre", "joint": variable.name, "value": value, "greatest": greatest})
        }
        EventKind::JointLimit { variable, value } => {
            json!({"kind": "joint_limit", "joint": variable.name, "value": value})
        }
        EventKind::Singular { freedom, home, .. } => {
            json!({"kind": kind.word(), "freedom": freedom, "home": home})
        }
        EventKind::Cusp { home } => json!({"kind": "cusp", "home": home}),
    }
}

fn reason_json(reason: &EndReason) -> Value {
    match reason {
        EndReason::JointLimit { variable, value } => {
            json!({"kind": "joint_limit", "joint": variable.name, "value": value})
        }
        EndReason::GoesOn => json!({"kind": "goes_on"}),
        EndReason::CannotGoOn => json!({"kind": "cannot_go_on"}),
    }
}

/// Everything, with the names of columns once: radians and metres, `world_from_link` of every link at every sample.
///
/// `changed` is how far the dimensions are from those written (m), where they are others; `points` are those whose paths are wanted.
#[must_use]
pub fn data(
    mechanism: &Mechanism,
    changed: Option<f64>,
    trace: &Trace,
    points: &[LinkPoint],
) -> Value {
    let motion = match trace {
        Trace::Still(still) => {
            return json!({
                "schema": TRACE_SCHEMA,
                "mechanism": mechanism.name(),
                "moves": false,
                "reason": still.reason,
                "branch": still.branch,
            });
        }
        Trace::Moving(motion) => motion,
    };
    let variables = Variable::all(mechanism);
    let samples: Vec<Value> = motion
        .samples
        .iter()
        .map(|sample| {
            let links: Vec<Value> = sample
                .links
                .iter()
                .map(|pose| json!({"position": pose.translation, "quaternion": quaternion(pose)}))
                .collect();
            json!({
                "drive": sample.drive,
                "arclength": sample.arclength,
                "closure": sample.closure,
                "values": sample.values,
                "links": links,
            })
        })
        .collect();
    json!({
        "schema": TRACE_SCHEMA,
        "mechanism": mechanism.name(),
        "dimensions_changed": changed,
        "moves": true,
        "branch": motion.branch,
        "branches": motion.branches,
        "dimension": motion.dimension,
        "driven": {"joint": motion.driven.name, "unit": motion.driven.unit(mechanism)},
        "held": motion.held.iter().map(|h| json!({
            "joint": h.variable.name, "value": h.value, "unit": h.variable.unit(mechanism),
        })).collect::<Vec<_>>(),
        "starts_at_home": motion.starts_at_home,
        "closed": motion.closed,
        "ends": motion.ends.iter().map(|e| json!({
            "arclength": e.arclength, "drive": e.drive, "reason": reason_json(&e.reason),
        })).collect::<Vec<_>>(),
        "events": motion.events.iter().map(|e| json!({
            "arclength": e.arclength, "drive": e.drive, "event": event_json(&e.kind), "values": e.values,
        })).collect::<Vec<_>>(),
        "ranges": motion.ranges.iter().map(|r| json!({
            "joint": r.variable.name, "unit": r.variable.unit(mechanism), "min": r.min, "max": r.max,
            "travel": r.travel, "turns": r.turns, "moves": r.moves, "dead_centres": r.dead_centres,
        })).collect::<Vec<_>>(),
        "spacing": match motion.spacing { Spacing::Drive => "drive", Spacing::Arclength => "arclength" },
        "unreached": motion.unreached.iter().map(|u| json!({
            "wanted": u.wanted, "reached": u.reached, "reason": u.reason,
        })).collect::<Vec<_>>(),
        "length_unit": motion.length_unit,
        "largest_closure": motion.largest_closure,
        "allowed_closure": motion.allowed_closure,
        "notes": motion.notes,
        "columns": variables.iter().map(|v| json!({"joint": v.name, "unit": v.unit(mechanism)})).collect::<Vec<_>>(),
        "links": mechanism.links().iter().map(|l| l.name.as_str()).collect::<Vec<_>>(),
        "samples": samples,
        "curves": points.iter().map(|point| json!({
            "link": mechanism.links()[point.link].name, "at": point.at, "path": point.path(motion),
        })).collect::<Vec<_>>(),
    })
}
