//! `kutzbach graph FILE`: links, joints, the spanning tree and both sets of cycles.

use super::failure::Failure;
use super::{DONE, load, output};
use clap::{Args, ValueEnum};
use kutzbach::graph::{
    ConstraintGraph, CycleBasis, GraphSummary, SpanningTree, to_dot, to_svg,
};
use kutzbach::report::text::visible;
use std::path::PathBuf;

/// Show links, joints, spanning tree and cycles
#[derive(Debug, Args)]
pub struct Arguments {
    /// Mechanism file
    file: PathBuf,
    /// Form of the answer
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Write to this file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Give a property of the file another value, a number or an expression; may be repeated
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = load::setting)]
    settings: Vec<(String, String)>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Lists for a person
    Text,
    /// Graphviz
    Dot,
    /// A picture
    Svg,
    /// Everything, for a program
    Json,
}

/// Runs the command.
///
/// # Errors
/// Where the file cannot be read or the output cannot be written.
pub fn run(arguments: &Arguments) -> Result<u8, Failure> {
    let reading = load::mechanism(&arguments.file, &arguments.settings)?;
    let graph = ConstraintGraph::of(&reading.mechanism);
    let tree = SpanningTree::low_depth(&graph);
    let summary = || GraphSummary::new(&graph, &tree, &CycleBasis::minimum(&graph, &tree));
    let text = match arguments.format {
        Format::Text => harmless(&summary().to_string()),
        Format::Json => output::json(&summary())?,
        Format::Dot => to_dot(&graph, &tree),
        Format::Svg => to_svg(&graph, &tree),
    };
    output::put(&text, arguments.output.as_deref())?;
    Ok(DONE)
}

/// Names may hold terminal escapes: line by line, what would steer the terminal is written out.
fn harmless(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for line in text.lines() {
        shown.push_str(&visible(line));
        shown.push('\n');
    }
    shown
}
