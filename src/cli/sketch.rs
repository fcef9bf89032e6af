//! From a path to a sketch.

use super::failure::Failure;
use super::load::{STANDARD_INPUT, Source, standard_input};
use kutzbach::constructive::sketch::NamedSketch;
use kutzbach::format::{read_sketch, read_sketch_file};
use std::path::Path;

/// Reads the sketch in the file, or on standard input.
///
/// # Errors
/// What is wrong with it, and where.
pub fn read(source: &Source) -> Result<NamedSketch, Failure> {
    if source.file == Path::new("-") {
        let text = standard_input()?;
        return Ok(read_sketch(&text, STANDARD_INPUT, &source.settings)?);
    }
    Ok(read_sketch_file(&source.file, &source.settings)?)
}
