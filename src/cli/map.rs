//! `kutzbach map out.csv -x a -y b`: a sweep as a picture over two of its measures.

use super::failure::Failure;
use super::files::cannot_read;
use super::load::STANDARD_INPUT;
use super::{DONE, output};
use clap::{Args, ValueEnum};
use kutzbach::report::html::map_page;
use kutzbach::report::map::{Map, MapAsked, MapError, MapReader};
use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};

/// Draw a sweep over two of its measures: where it moves, locks, is singular or does not assemble
#[derive(Debug, Args)]
pub struct Arguments {
    /// Rows that `kutzbach sweep` has written as CSV, those of all shares where there are several; `-` for standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Measure along the horizontal axis; the first one if not given
    #[arg(short, value_name = "MEASURE")]
    x: Option<String>,
    /// Measure along the vertical axis; the next one if not given
    #[arg(short, value_name = "MEASURE")]
    y: Option<String>,
    /// Colour by this column, for example `margin` (on a logarithmic scale), `class` or `finite`; by how it moves, if not given
    #[arg(long, alias = "color", value_name = "COLUMN")]
    colour: Option<String>,
    /// Form of the map; as the name of the output ends, or SVG, if not given
    #[arg(long, value_enum)]
    format: Option<Format>,
    #[command(flatten)]
    destination: output::Destination,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// A picture
    Svg,
    /// The picture and the command that makes the report of each cell, for any browser
    Html,
}

/// Runs the command.
///
/// # Errors
/// Where the files are no rows of one sweep, it has no such measures or column, or the output cannot be written.
pub fn run(arguments: &Arguments) -> Result<u8, Failure> {
    let map = read(arguments)?;
    let text = match format(arguments) {
        Format::Svg => map.document(),
        Format::Html => map_page(&map),
    };
    arguments.destination.put(&text)?;
    Ok(DONE)
}

fn read(arguments: &Arguments) -> Result<Map, Failure> {
    let mut reader = MapReader::new(MapAsked {
        x: arguments.x.clone(),
        y: arguments.y.clone(),
        colour: arguments.colour.clone(),
    });
    for file in &arguments.files {
        if file == Path::new("-") {
            reader
                .read(STANDARD_INPUT, std::io::stdin().lock())
                .map_err(no_map)?;
            continue;
        }
        let opened = File::open(file).map_err(|error| cannot_read(file, &error))?;
        reader
            .read(&file.display().to_string(), BufReader::new(opened))
            .map_err(no_map)?;
    }
    reader.finish().map_err(no_map)
}

fn format(arguments: &Arguments) -> Format {
    let ending = arguments.destination.file().and_then(Path::extension);
    match arguments.format {
        Some(format) => format,
        None if ending.is_some_and(|own| own == "html" || own == "htm") => Format::Html,
        None => Format::Svg,
    }
}

fn no_map(error: MapError) -> Failure {
    Failure::Plain {
        message: error.message,
        help: Some(error.help),
    }
}
