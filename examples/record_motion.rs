//! Turns a joint of a mechanism step by step and records the motion as a log for a viewer.
//!
//! ```text
//! cargo run --example record_motion -- mechanisms/bennett.urdf bennett.mcap [JOINT]
//! ```
//!
//! The second motion in the log is the first one with a loop pulled open a little, as a simulation would show it.

use kutzbach::closure::{Arithmetic, Geometry, assemble, spanning_poses};
use kutzbach::mobility::Structure;
use kutzbach::record::{
    Closure, ClosureError, Gap, Header, Level, Motion, Prediction, Recorder, Role, Roles,
};
use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::path::Path;

const SAMPLES: usize = 240;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, out, joint @ ..] = arguments.as_slice() else {
        return Err("needed a mechanism file and a log: record_motion FILE OUT [JOINT]".into());
    };
    let mechanism = kutzbach::format::read_file(file, &[])?.mechanism;
    let mut geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
    let parts = Structure::new(&mechanism).parts;
    let drive = match joint.first() {
        Some(name) => mechanism.joint_named(name).ok_or("no such joint")?.0,
        None => 0,
    };
    let mut roles = Roles {
        links: Vec::new(),
        joints: vec![Role::Moving; mechanism.joints().len()],
    };
    roles.joints[drive] = Role::Driven;

    let name = Path::new(file).file_name().unwrap_or_default();
    let header = Header {
        mechanism: &mechanism,
        geometry: &geometry.clone(),
        source_name: &name.to_string_lossy(),
        source: &std::fs::read(file)?,
        report: None,
        facts: &BTreeMap::from([("verdict".to_owned(), "mobile".to_owned())]),
        roles: &roles,
        simulated_at: None,
    };
    let mut recorder = Recorder::create(Path::new(out), &header)?;
    recorder.log(0.0, Level::Info, "one turn of the driven joint")?;
    let step = std::f64::consts::TAU / SAMPLES as f64;
    for sample in 0..=SAMPLES {
        let time = sample as f64 / 24.0;
        if sample > 0 {
            // The driven joint goes on; the others close the loops from where they stood.
            let mut increments = vec![0.0; mechanism.joints()[drive].freedom()];
            increments[0] = step;
            geometry.displacements[drive].advance(&mut geometry.states[drive], &increments);
            let held = BTreeSet::from([drive]);
            let assembly = assemble(&mechanism, &geometry, &parts, &held)?;
            if !assembly.closed {
                let summary = recorder.finish_early("the loops do not close beyond this pose")?;
                println!("{out}: {} moments", summary.moments);
                return Ok(());
            }
            geometry.states = assembly.states;
        }
        let (poses, _) = spanning_poses(&mechanism, &geometry, &geometry.states);
        let values: Vec<Vec<f64>> = geometry.states.iter().map(|s| s.values.clone()).collect();
        let predicted = Motion {
            joints: &values,
            ..Motion::of_links(&poses)
        };

        let mut pulled = poses.clone();
        let mut gaps = Vec::new();
        let size = geometry.size_of(0..geometry.sides.len());
        let shift = 0.1 * size * time.sin();
        let closing = mechanism.joints().iter().rposition(|j| j.closes_loop);
        if let Some(index) = closing {
            let links = [
                mechanism.joints()[index].predecessor.link.0,
                mechanism.joints()[index].successor.link.0,
            ];
            pulled[links[1]].translation[2] += shift;
            let [predecessor, successor] =
                [0, 1].map(|i| pulled[links[i]].apply(&geometry.sides[index][i].translation));
            gaps.push(Gap {
                joint: index,
                predecessor,
                successor,
            });
        }
        let simulated = Motion {
            joints: &values,
            gaps: &gaps,
            ..Motion::of_links(&pulled)
        };
        recorder.moment(time, Some(&predicted), Some(&simulated))?;
        let simulated = ClosureError {
            position: shift.abs(),
            ..ClosureError::default()
        };
        recorder.closure(
            time,
            &Closure {
                predicted: Some(ClosureError::default()),
                simulated: Some(simulated),
            },
        )?;
        recorder.prediction(
            time,
            &Prediction {
                branch: "A".to_owned(),
                parameter: sample as f64 * step,
                drive: mechanism.joints()[drive].name.clone(),
                predicted: sample as f64 * step,
                ..Prediction::default()
            },
        )?;
    }
    let summary = recorder.finish()?;
    println!(
        "{out}: {} moments, {} messages",
        summary.moments, summary.messages
    );
    Ok(())
}
