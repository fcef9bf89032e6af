//! `kutzbach graph FILE`: links, joints, the spanning tree and both sets of cycles.

use super::failure::Failure;
use super::{DONE, load, output};
use clap::{Args, ValueEnum};
use kutzbach::graph::{ConstraintGraph, CycleBasis, GraphSummary, SpanningTree, to_dot, to_svg};
use kutzbach::report::text::visible;

/// Show links, joints, spanning tree and cycles
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    source: load::Source,
    /// Form of the answer
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    #[command(flatten)]
    destination: output::Destination,
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
    let reading = arguments.source.read()?;
    let graph = ConstraintGraph::of(&reading.mechanism);
    let tree = SpanningTree::low_depth(&graph);
    let summary = || GraphSummary::new(&graph, &tree, &CycleBasis::minimum(&graph, &tree));
    let text = match arguments.format {
        Format::Text => harmless(&summary().to_string()),
        Format::Json => output::json(&summary())?,
        Format::Dot => to_dot(&graph, &tree),
        Format::Svg => to_svg(&graph, &tree),
    };
    arguments.destination.put(&text)?;
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
