//! Closing from anywhere: mechanisms with loops, all of whose tree joints start at random values.
//!
//! Every file here is drawn closed, so that a closing exists wherever the joints begin. Three starts each by default;
//! `KUTZBACH_ASSEMBLY_STARTS=100` measures as the figures of the book were measured, and
//! `KUTZBACH_ASSEMBLY_FILES=folder` does so with all files of a folder.

use crate::support;

use kutzbach::closure::{Arithmetic, Geometry, assemble};
use kutzbach::matrix::SplitMix64;
use kutzbach::mechanism::{Configuration, FreedomPart, JointId, Mechanism};
use kutzbach::mobility::Structure;
use kutzbach::number::Number;
use std::collections::BTreeSet;
use std::path::Path;
use std::time::Instant;
use support::{folder, in_parallel, mechanism_files};

/// Planar and spatial, mobile and rigid, paradoxical and plain, of one loop and of many.
const MECHANISMS: [&str; 30] = [
    "agile_eye",
    "altmann_6r",
    "bennett_generic",
    "bricard_line_symmetric",
    "bricard_threefold_60",
    "delta_3R_SS2",
    "delta_3RRPaR",
    "general_6r_rigid",
    "general_7r",
    "goldberg_6r",
    "hart_inversor",
    "hoberman_ring_8",
    "hooke_rur",
    "jansen_leg",
    "miura_2x2",
    "oldham_rppr",
    "parallelogram_3cranks",
    "peaucellier_lipkin",
    "planar_3RRR",
    "planar_4r_general",
    "planar_slider_crank",
    "rccc",
    "rssr",
    "sarrus_6r",
    "schatz_turbula_6r",
    "scissor_lift_3",
    "spherical_4r",
    "stephenson_III",
    "stewart_6UPS",
    "tripteron_3PRRR",
];

/// A pose with all tree joints anywhere: angles over a turn, translations over the mechanism's size.
fn anywhere(mechanism: &Mechanism, size: f64, start: usize) -> Configuration {
    let positions = mechanism
        .joints()
        .iter()
        .enumerate()
        .filter(|(_, joint)| !joint.closes_loop && joint.freedom() > 0)
        .map(|(index, joint)| {
            let mut random = SplitMix64::named(&format!("{} {start}", joint.name));
            let values = joint.kind.freedoms().iter().map(|freedom| {
                let far = match freedom {
                    FreedomPart::Translation => size,
                    FreedomPart::Rotation | FreedomPart::Screw => std::f64::consts::PI,
                };
                Number::from_f64(far * random.symmetric()).unwrap()
            });
            (JointId(index), values.collect())
        })
        .collect();
    Configuration {
        free: BTreeSet::new(),
        name: "anywhere".to_owned(),
        positions,
    }
}

/// How many of the starts closed, the most starts the search took, and a line for people.
fn measured(name: &str, mechanism: &Mechanism, starts: usize) -> (usize, String) {
    let begun = Instant::now();
    let parts = Structure::new(mechanism).parts;
    let drawn = Geometry::new(mechanism, None, &Arithmetic::double());
    let (mut closed, mut at_once, mut most, mut falsely_proven) = (0, 0, 0, 0);
    for start in 0..starts {
        let pose = anywhere(
            mechanism,
            drawn.size_of(0..drawn.sides.len()).max(0.1),
            start,
        );
        let geometry = Geometry::new(mechanism, Some(&pose), &Arithmetic::double());
        let assembly = assemble(mechanism, &geometry, &parts, &BTreeSet::new()).unwrap();
        closed += usize::from(assembly.closed);
        at_once += usize::from(assembly.closed && assembly.starts == 1);
        falsely_proven += usize::from(assembly.proven_open.is_some());
        most = most.max(assembly.starts);
    }
    assert_eq!(falsely_proven, 0, "{name} is drawn closed");
    let each = begun.elapsed().as_secs_f64() * 1e3 / starts as f64;
    let line = format!(
        "{name}: {closed} of {starts} closed, {at_once} from the start itself; at most {most} starts, {each:.1} ms each"
    );
    (closed, line)
}

#[test]
fn a_closing_is_found_from_anywhere() {
    let starts = std::env::var("KUTZBACH_ASSEMBLY_STARTS")
        .ok()
        .and_then(|text| text.parse().ok())
        .unwrap_or(3);
    let given = std::env::var_os("KUTZBACH_ASSEMBLY_FILES");
    let path = given
        .as_deref()
        .map_or_else(|| folder("tests/zoo"), |path| Path::new(path).to_path_buf());
    let files: Vec<(String, Mechanism)> = mechanism_files(&path)
        .into_iter()
        .filter(|(name, _)| given.is_some() || MECHANISMS.contains(&name.as_str()))
        .filter_map(|(name, path)| {
            let reading = kutzbach::format::read_file(&path, &[]).ok()?;
            Some((name, reading.mechanism))
        })
        .collect();
    assert!(given.is_some() || files.len() == MECHANISMS.len());
    let found = in_parallel(&files, |(name, mechanism)| {
        measured(name, mechanism, starts)
    });
    let closed: usize = found.iter().map(|(closed, _)| closed).sum();
    let all = starts * files.len();
    for (_, line) in &found {
        println!("{line}");
    }
    println!("{closed} of {all} closed");
    assert!(
        given.is_some() || 100 * closed >= 99 * all,
        "{closed} of {all} closed"
    );
}
