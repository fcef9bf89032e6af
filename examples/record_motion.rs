//! Records the motion of a one-loop mechanism as a log: `cargo run --example record_motion -- FILE OUT.mcap`.
//!
//! The first joint is turned step by step; after every step the other joints close the loop again.

use kutzbach::closure::{Arithmetic, Geometry, Rigid, assemble, spanning_poses};
use kutzbach::record::{
    Closure, ClosureError, Gap, Header, Level, Motion, Prediction, Recorder, Role, Roles,
};
use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::path::Path;

const SAMPLES: usize = 240;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let file = arguments
        .next()
        .unwrap_or_else(|| "mechanisms/bennett.urdf".to_owned());
    let out = arguments
        .next()
        .unwrap_or_else(|| "target/bennett.mcap".to_owned());
    let source = std::fs::read_to_string(&file)?;
    let mechanism = kutzbach::format::read(&source)?;
    let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
    let mut roles = Roles {
        links: Vec::new(),
        joints: vec![Role::Moving; mechanism.joints().len()],
    };
    roles.joints[0] = Role::Driven;
    let mut facts = BTreeMap::new();
    facts.insert("verdict".to_owned(), "mobile".to_owned());
    let name = Path::new(&file).file_name().unwrap_or_default();
    let header = Header {
        mechanism: &mechanism,
        geometry: &geometry,
        source_name: &name.to_string_lossy(),
        source: source.as_bytes(),
        report: None,
        facts: &facts,
        roles: &roles,
        simulated_at: None,
    };
    let mut recorder = Recorder::create(Path::new(&out), &header)?;
    recorder.log(0.0, Level::Info, "one turn of the first joint")?;
    let mut states = geometry.states.clone();
    for sample in 0..=SAMPLES {
        let time = sample as f64 / 60.0;
        let step = std::f64::consts::TAU / SAMPLES as f64;
        if sample > 0 {
            geometry.displacements[0].advance(&mut states[0], &[step]);
            // The others close the loop from where they stood.
            let held = BTreeSet::from([0]);
            let closed = close(&mechanism, &geometry, &states, &held)?;
            let Some(closed) = closed else {
                recorder.finish_early("the loop does not close here")?;
                return Ok(());
            };
            states = closed;
        }
        let (poses, _) = spanning_poses(&mechanism, &geometry, &states);
        let values: Vec<Vec<f64>> = states.iter().map(|state| state.values.clone()).collect();
        let predicted = Motion {
            links: &poses,
            joints: &values,
            rates: &[],
            gaps: &[],
        };
        // A second motion beside the first: the last link hangs back, and its joint opens.
        let mut pulled: Vec<Rigid<f64>> = poses.clone();
        let shift = 0.05 * geometry.size * (time * 2.0).sin();
        let mut gaps = Vec::new();
        if let Some(index) = (0..mechanism.joints().len()).rev().find(|i| mechanism.joints()[*i].closes_loop) {
            let joint = &mechanism.joints()[index];
            let link = joint.successor.link.0;
            pulled[link].translation[2] += shift;
            let [a, b] = &geometry.sides[index];
            gaps.push(Gap {
                joint: index,
                predecessor: pulled[joint.predecessor.link.0].apply(&a.translation),
                successor: pulled[link].apply(&b.translation),
            });
        }
        let simulated = Motion {
            links: &pulled,
            joints: &values,
            rates: &[],
            gaps: &gaps,
        };
        recorder.moment(time, Some(&predicted), Some(&simulated))?;
        recorder.closure(
            time,
            &Closure {
                predicted: Some(ClosureError::default()),
                simulated: Some(ClosureError {
                    position: shift.abs(),
                    ..ClosureError::default()
                }),
            },
        )?;
        recorder.prediction(
            time,
            &Prediction {
                branch: "A".to_owned(),
                drive: mechanism.joints()[0].name.clone(),
                predicted: sample as f64 * step,
                ..Prediction::default()
            },
        )?;
    }
    let summary = recorder.finish()?;
    println!("{out}: {} moments, {} messages", summary.moments, summary.messages);
    Ok(())
}
