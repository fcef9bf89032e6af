//! What a file says, number by number.

use kutzbach::format::{Reading, property_names};
use kutzbach::mechanism::{Joint, Mechanism, Side};
use kutzbach::number::Number;
use serde_json::{Value, json};

/// Name, links, joints with their numbers, couplings, configurations, and what was read otherwise than it may have been meant.
pub fn description(reading: &Reading, bytes: &[u8], file: &str) -> Value {
    let mechanism = &reading.mechanism;
    let links: Vec<&str> = mechanism
        .links()
        .iter()
        .map(|link| link.name.as_str())
        .collect();
    let joints = mechanism.joints().iter();
    let couplings = mechanism.couplings().iter();
    let configurations = mechanism.configurations().iter();
    let warnings = reading.warnings.iter();
    json!({
        "name": mechanism.name(),
        "file": file,
        "format": reading.format,
        "ground": mechanism.link(mechanism.ground()).name,
        "links": links,
        "joints": joints.map(|own| joint(mechanism, own)).collect::<Vec<_>>(),
        "couplings": couplings.map(|own| json!({
            "name": own.name,
            "terms": own.terms.iter().map(|term| json!({
                "joint": mechanism.joint(term.joint).name,
                "factor": number(&term.factor),
            })).collect::<Vec<_>>(),
            "offset": number(&own.offset),
        })).collect::<Vec<_>>(),
        "configurations": configurations.map(|own| own.name.as_str()).collect::<Vec<_>>(),
        "measures": property_names(&String::from_utf8_lossy(bytes)),
        "freedom": mechanism.freedom(),
        "warnings": warnings.map(|own| json!({
            "line": own.line, "column": own.column, "message": own.message,
        })).collect::<Vec<_>>(),
        "skipped": reading.skipped.iter().map(|own| own.count).sum::<usize>(),
    })
}

fn joint(mechanism: &Mechanism, joint: &Joint) -> Value {
    let side = |side: &Side| {
        json!({
            "link": mechanism.link(side.link).name,
            "position": side.frame.position.each_ref().map(number),
            "roll_pitch_yaw": side.frame.roll_pitch_yaw.each_ref().map(number),
        })
    };
    let axis = joint.kind.uses_axis();
    let axis2 = joint.kind.uses_second_axis();
    json!({
        "name": joint.name,
        "kind": joint.kind.word(),
        "class": joint.kind.class(),
        "freedom": joint.freedom(),
        "variables": (0..joint.freedom()).map(|index| joint.freedom_name(index)).collect::<Vec<_>>(),
        "closes_loop": joint.closes_loop,
        "predecessor": side(&joint.predecessor),
        "successor": side(&joint.successor),
        "axis": axis.then(|| joint.axis.0.each_ref().map(number)),
        "axis2": axis2.then(|| joint.axis2.0.each_ref().map(number)),
        "lead": joint.lead.as_ref().map(number),
        "distance": joint.distance.as_ref().map(number),
        "bounds": joint.bounds().map(|(lower, upper)| [finite(lower), finite(upper)]),
    })
}

/// An exact number: a fraction where it is one, and its text in a file.
fn number(number: &Number) -> Value {
    let fraction = number
        .rational()
        .map(|own| format!("{}/{}", own.numerator(), own.denominator()));
    json!({"fraction": fraction, "source": number.source()})
}

/// JSON has no infinity; where there is no limit it has `null`.
fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}
