//! From a path to a sketch: a file with one, or a planar mechanism.

use super::assemble::held;
use super::failure::Failure;
use super::load::{STANDARD_INPUT, Source, standard_input};
use kutzbach::constructive::named::NamedSketch;
use kutzbach::constructive::planar;
use kutzbach::format::{is_sketch, read_sketch, read_sketch_file, read_with, within_memory};
use kutzbach::mechanism::Mechanism;
use std::path::Path;

/// Reads the sketch in the file, or on standard input. Where that is a mechanism, `hold` says which of its joints are held,
/// each as `joint=value`.
///
/// # Errors
/// What is wrong with the file, and where; why a mechanism is no sketch; a joint that cannot be held.
pub fn read(source: &Source, hold: &[String]) -> Result<NamedSketch, Failure> {
    within_memory(source.memory, || read_within(source, hold))
}

fn read_within(source: &Source, hold: &[String]) -> Result<NamedSketch, Failure> {
    if source.file == Path::new("-") {
        let text = standard_input(source.memory)?;
        if is_sketch(&text) {
            return Ok(read_sketch(&text, STANDARD_INPUT, &source.settings)?);
        }
        let options = source.options(&[], false);
        return of(&read_with(&text, STANDARD_INPUT, &options)?.mechanism, hold);
    }
    // What cannot be read at all is told when it is read in earnest.
    let text = std::fs::read_to_string(&source.file).unwrap_or_default();
    if is_sketch(&text) {
        return Ok(read_sketch_file(&source.file, &source.settings)?);
    }
    of(&source.read()?.mechanism, hold)
}

fn of(mechanism: &Mechanism, hold: &[String]) -> Result<NamedSketch, Failure> {
    let plain = |message: String, help: Option<&str>| Failure::Plain {
        message,
        help: help.map(str::to_owned),
    };
    let joints = hold.iter().map(|item| held(mechanism, item));
    let joints = joints.collect::<Result<Vec<_>, _>>()?;
    let fixed = mechanism
        .with_joints_held(&joints)
        .map_err(|why| plain(why.to_string(), None))?;
    planar::sketch(&fixed).map_err(|why| {
        let help = "sketches are made of hinges that are parallel, and of sliders across them";
        plain(format!("no planar sketch: {why}"), Some(help))
    })
}
