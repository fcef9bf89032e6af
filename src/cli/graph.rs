//! `kutzbach graph FILE`: links, joints, the spanning tree and both sets of cycles.

use super::failure::Failure;
use super::interrupt::{self, INTERRUPTED};
use super::progress::Sign;
use super::{DONE, load, output, sketch};
use clap::{Args, ValueEnum};
use kutzbach::algebra::{Limits, Progress};
use kutzbach::assembly::placed::Unsuited;
use kutzbach::assembly::words;
use kutzbach::constructive::cluster_words::ClusterWords;
use kutzbach::constructive::named::NamedSketch;
use kutzbach::constructive::together;
use kutzbach::constructive::words::SketchWords;
use kutzbach::graph::{
    Captions, ConstraintGraph, CycleBasis, FoldedGraph, GraphSummary, SpanningTree, to_dot, to_svg,
    to_svg_with,
};
use kutzbach::mechanism::Mechanism;
use kutzbach::report::text::visible;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

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
    /// Show which bodies are best placed by which others: the incidence tree, as text, dot or svg
    #[arg(long)]
    incidence: bool,
    /// With `--incidence`: the lightest tree of the covering set of these bodies, in place of the lightest of all; may be repeated
    #[arg(
        long,
        value_name = "BODY",
        requires = "incidence",
        conflicts_with = "place"
    )]
    cover: Vec<String>,
    /// With `--incidence`: the tree in which CHILD is placed by PARENT, in place of the lightest; may be repeated
    #[arg(long, value_name = "CHILD=PARENT", requires = "incidence")]
    place: Vec<String>,
    /// With `--incidence`: list the covering sets by the weights of their lightest trees
    #[arg(long, requires = "incidence")]
    covers: bool,
    /// Show which equations to ask for of bodies whose data contradict one another a little: the seam graph and a well-formed selection
    /// in it, as text, dot or svg
    #[arg(long, conflicts_with_all = ["incidence", "constructive"])]
    seams: bool,
    /// Show what of a sketch or planar mechanism is over- or under-constrained, how circles and lines construct it, and how many solutions
    /// there are; the s-tree as dot or svg
    #[arg(long, conflicts_with = "incidence")]
    constructive: bool,
    /// Hold a joint of a planar mechanism for `--constructive`, as `joint=value`; may be repeated
    #[arg(long, value_name = "JOINT=VALUE", requires = "constructive")]
    hold: Vec<String>,
    /// With `--constructive`: show the sequence of clusters of the reduction and the ternary tree of the decomposition too
    #[arg(long, requires = "constructive")]
    clusters: bool,
    /// With `--constructive`: take one of the two places of the step that places ELEMENT: `left` or `right` of the way from the first to the second
    /// by which it is placed (of a line: pointing this way or back), `ahead` or `behind` along a line; shows the solution; may be repeated
    #[arg(long, value_name = "ELEMENT=SIDE", requires = "constructive")]
    side: Vec<String>,
    /// With `--constructive`: leave undecided what takes more than about so many seconds of work to solve at once, for each part that circles and
    /// lines do not construct (deterministic)
    #[arg(long, value_name = "SECONDS", default_value_t = 1.5, value_parser = super::report::seconds)]
    budget: f64,
    /// Show the low-depth tree, which exact equations are written by, in place of the one that the file describes
    #[arg(long, conflicts_with_all = ["incidence", "seams", "constructive"])]
    low_depth: bool,
    /// Show the links that are only fixed to others too; JSON always has them
    #[arg(long)]
    verbose: bool,
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
    if arguments.constructive {
        return constructive(arguments);
    }
    let reading = arguments.source.read()?;
    if arguments.incidence {
        return incidence(arguments, &reading.mechanism);
    }
    if arguments.seams {
        return seams(arguments, &reading.mechanism);
    }
    let mut graph = ConstraintGraph::of(&reading.mechanism);
    let mut tree = SpanningTree::of_mechanism(&graph, &reading.mechanism);
    let mut folded = 0;
    if !arguments.verbose && arguments.format != Format::Json {
        let small = FoldedGraph::new(&graph, &tree, &reading.mechanism);
        folded = small.folded.len();
        (graph, tree) = (small.graph, small.tree);
    }
    let shallow = SpanningTree::low_depth(&graph);
    let summary = || {
        let basis = CycleBasis::minimum(&graph, &shallow);
        match arguments.low_depth {
            false => GraphSummary::new(&graph, &tree, &basis),
            true => GraphSummary::new(&graph, &shallow, &basis).of_low_depth(),
        }
    };
    let shown = match arguments.low_depth {
        false => &tree,
        true => &shallow,
    };
    let text = match arguments.format {
        Format::Text => harmless(&format!("{}{}", summary(), not_shown(folded))),
        Format::Json => output::json(&summary())?,
        Format::Dot => to_dot(&graph, shown),
        Format::Svg => to_svg(&graph, shown),
    };
    arguments.destination.put(&text)?;
    Ok(DONE)
}

/// The incidence tree of the bodies that share points.
fn incidence(arguments: &Arguments, mechanism: &Mechanism) -> Result<u8, Failure> {
    let mut found = words::IncidenceWords::of(mechanism).map_err(no_tree)?;
    if !arguments.cover.is_empty() {
        found = found.on_cover(&arguments.cover).map_err(no_such_tree)?;
    }
    if !arguments.place.is_empty() {
        found = found.along(&arguments.place).map_err(no_such_tree)?;
    }
    let text = match (arguments.format, arguments.covers) {
        (Format::Text, true) => harmless(&format!("{}{}", found.text(), found.covers_text())),
        (Format::Text, false) => harmless(&found.text()),
        (Format::Json, true) => output::json(&found.data_with_covers())?,
        (Format::Json, false) => output::json(&found.data())?,
        (Format::Dot | Format::Svg, _) => match found.graph() {
            None => harmless(&found.text()),
            Some(graph) => {
                let tree = SpanningTree::root_at(&graph, found.root());
                match arguments.format {
                    Format::Dot => to_dot(&graph, &tree),
                    _ => {
                        let title = format!("Incidence tree of {} bodies", graph.node_count());
                        let legend = ["placed by", "", "root"];
                        to_svg_with(&graph, &tree, &Captions { title, legend })
                    }
                }
            }
        },
    };
    arguments.destination.put(&text)?;
    Ok(DONE)
}

fn no_such_tree(message: String) -> Failure {
    Failure::Plain {
        message,
        help: Some("`graph FILE --incidence` lists the bodies".to_owned()),
    }
}

fn no_tree(why: Unsuited) -> Failure {
    Failure::Plain {
        message: format!("no incidence tree: {why}"),
        help: Some("it is made of balls, hinges, universal joints and bars".to_owned()),
    }
}

/// The seam graph of the bodies that share points, and the equations selected in it.
fn seams(arguments: &Arguments, mechanism: &Mechanism) -> Result<u8, Failure> {
    let found = words::SeamWords::of(mechanism).map_err(no_tree)?;
    let text = match (arguments.format, found.graph()) {
        (Format::Json, _) => output::json(&found.data())?,
        (Format::Dot, Some(graph)) => to_dot(&graph, &SpanningTree::root_at(&graph, 0)),
        (Format::Svg, Some(graph)) => {
            let captions = Captions {
                title: format!("Seam graph of {} copies of points", graph.node_count()),
                legend: ["spanning tree", "other edges", "first copy"],
            };
            to_svg_with(&graph, &SpanningTree::root_at(&graph, 0), &captions)
        }
        _ => harmless(&found.text()),
    };
    arguments.destination.put(&text)?;
    Ok(DONE)
}

/// What ruler and compass can do with a sketch.
fn constructive(arguments: &Arguments) -> Result<u8, Failure> {
    let named = sketch::read(&arguments.source, &arguments.hold)?;
    let mut found = watched(&named, arguments.budget);
    for choice in &arguments.side {
        let (element, side) = choice.rsplit_once('=').unwrap_or((choice, ""));
        found
            .choose(element, side)
            .map_err(|message| Failure::Plain {
                message,
                help: Some("--side ELEMENT=left".to_owned()),
            })?;
    }
    let clusters = arguments
        .clusters
        .then(|| ClusterWords::of(&named))
        .flatten();
    if matches!(arguments.format, Format::Dot | Format::Svg) && !found.has_tree() {
        return Err(Failure::Plain {
            message:
                "the s-tree is one of constraints between two elements, this sketch has others"
                    .to_owned(),
            help: Some("text and json say what is known of it".to_owned()),
        });
    }
    // The s-tree takes its time: only pictures of it ask for it.
    let graph = || match arguments.format {
        Format::Dot => found.graph(),
        _ => None,
    };
    let text = match (arguments.format, graph()) {
        (Format::Json, _) => {
            let mut data = found.data();
            if let Some(clusters) = &clusters {
                data["clusters"] = clusters.data();
            }
            output::json(&data)?
        }
        (Format::Dot, Some(graph)) => to_dot(&graph, &SpanningTree::root_at(&graph, 0)),
        (Format::Svg, _) => found.tree_svg(),
        _ if found.stopped() => harmless(&format!(
            "{}budget: about {} s of work for what is solved at once; `--budget` allows more\n",
            found.text(),
            arguments.budget
        )),
        _ => harmless(&found.text()),
    };
    let text = match (&clusters, arguments.format) {
        (Some(clusters), Format::Text) => format!("{text}{}", harmless(&clusters.text())),
        _ => text,
    };
    arguments.destination.put(&text)?;
    Ok(match interrupt::asked() {
        true => INTERRUPTED,
        false => DONE,
    })
}

/// Works while Ctrl-C and a sign of life are seen to.
fn watched(named: &NamedSketch, budget: f64) -> SketchWords<'_> {
    interrupt::listen();
    let progress = Arc::new(Progress::default());
    let limits = Limits {
        progress: Some(Arc::clone(&progress)),
        cancelled: Some(interrupt::flag()),
        ..together::seconds(budget)
    };
    let over = AtomicBool::new(false);
    std::thread::scope(|scope| {
        let ticker = scope.spawn(|| {
            let mut sign = Sign::new(budget);
            while !over.load(Ordering::Relaxed) {
                std::thread::park_timeout(Duration::from_millis(100));
                sign.tick(|| format!("solving at once: {}", progress.phase()));
            }
        });
        let found = SketchWords::within(named, &limits);
        over.store(true, Ordering::Relaxed);
        ticker.thread().unpark();
        found
    })
}

/// What a folded graph leaves out.
fn not_shown(folded: usize) -> String {
    match folded {
        0 => String::new(),
        1 => "\nnot shown: a link that is fixed to another (`--verbose` shows it)\n".to_owned(),
        many => {
            format!("\nnot shown: {many} links that are fixed to others (`--verbose` shows them)\n")
        }
    }
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
