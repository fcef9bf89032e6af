//! `kutzbach accuracy FILE`: what every way to an answer costs, and how far off it is.

use super::failure::{Failure, refuse_idle};
use super::pose::Pose;
use super::progress::Progress;
use super::simulate::aside::{Listener, Sender, aside};
use super::{DONE, interrupt, load, output, terminal};
use clap::{Args, ValueEnum};
use kutzbach::accuracy::{Accuracy, AccuracyOptions, Grid, measure};
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{Analysis, AnalysisOptions, ExactBudget, Followed, analyse_to_follow};
use kutzbach::report::accuracy::{figure, page};
use kutzbach::report::html::accuracy_page;
use std::ops::ControlFlow;

/// Measure every way to an answer, from counting to simulating: what it costs, how far off it is
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    source: load::Source,
    /// Form of the answer
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    #[command(flatten)]
    destination: output::Destination,
    /// Name the cheapest setting of a simulation that stays within this error (characteristic lengths, rad)
    #[arg(long, value_name = "ERROR", value_parser = error)]
    want: Option<f64>,
    /// Branch to trace and simulate; the first if not given
    #[arg(long)]
    branch: Option<String>,
    /// Joint to drive; one that serves if not given
    #[arg(long, value_name = "JOINT")]
    drive: Option<String>,
    #[command(flatten)]
    pose: Pose,
    /// A first impression: fewer settings and fewer runs
    #[arg(long)]
    quick: bool,
    /// Leave out simulations that take longer than about so many seconds, counted in work so that the same are left out on
    /// every machine [default: 4, with `--quick` 1]
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    budget: Option<f64>,
    /// Show every detail
    #[arg(long)]
    verbose: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Tables for a person
    Text,
    /// Everything, for a program
    Json,
    /// Figure and tables, for any browser
    Html,
    /// The figure
    Svg,
}

/// Reads an error that can be wanted.
///
/// # Errors
/// Where it is no positive number.
pub fn error(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(error) if error > 0.0 && error.is_finite() => Ok(error),
        _ => Err("a positive number, for example 1e-6".to_owned()),
    }
}

/// A budget of no time leaves everything out.
fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds >= 0.0 && seconds.is_finite() => Ok(seconds),
        _ => Err("a number of seconds, 0 or more".to_owned()),
    }
}

/// The share of its own budget that a single setting has in that of all.
const SETTINGS: f64 = 6.0;

/// Runs the command.
///
/// # Errors
/// Where the file cannot be read, has no such configuration, branch or joint, or output cannot be written.
pub fn run(arguments: &Arguments) -> Result<u8, Failure> {
    refuse_idle(&[(
        arguments.verbose && arguments.format != Format::Text,
        "--verbose",
        "`--format text`: the other forms have every detail",
    )])?;
    let mut reading = arguments.source.read()?;
    let configuration = arguments.pose.configure(&mut reading)?;
    let mechanism = &reading.mechanism;
    let plain = |message: String, help: Option<String>| Failure::Plain {
        message: format!("{}: {message}", arguments.source.file.display()),
        help,
    };
    let Followed {
        mechanism,
        analysis,
        ..
    } = analyse_to_follow(
        mechanism,
        &AnalysisOptions {
            configuration: configuration.clone(),
            ..AnalysisOptions::default()
        },
    )
    .map_err(|error| {
        plain(
            error.to_string(),
            Some("`kutzbach report FILE` tells more".to_owned()),
        )
    })?;
    let mechanism = &mechanism;
    if let Some(name) = &arguments.drive {
        kutzbach::motion::variable_named(mechanism, name)
            .map_err(|error| plain(error.to_string(), Some(error.help())))?;
    }
    let mut grid = if arguments.quick {
        Grid::quick()
    } else {
        Grid::full()
    };
    if let Some(budget) = arguments.budget {
        grid.work = budget;
        grid.all_work = SETTINGS * budget;
    }
    let options = AccuracyOptions {
        configuration,
        branch: arguments.branch.clone(),
        drive: arguments.drive.clone(),
        wanted: arguments.want,
        exact: ExactBudget::default(),
        grid,
        quick: arguments.quick,
    };
    let accuracy = measured(mechanism, &analysis, &options)
        .map_err(|message| plain(message, Some("see `kutzbach accuracy --help`".into())))?;
    let text = match arguments.format {
        Format::Text => page(
            &accuracy,
            terminal::layout(arguments.destination.file().is_some(), arguments.verbose),
        )
        .into_text(),
        Format::Json => output::json(&accuracy)?,
        Format::Html => accuracy_page(&accuracy),
        Format::Svg => figure(&accuracy).document(),
    };
    arguments.destination.put(&text)?;
    Ok(if accuracy.stopped {
        interrupt::INTERRUPTED
    } else {
        DONE
    })
}

/// Measures aside, with a progress bar, so that Ctrl-C is answered.
///
/// # Errors
/// Why nothing was measured, in words.
pub fn measured(
    mechanism: &Mechanism,
    analysis: &Analysis,
    options: &AccuracyOptions,
) -> Result<Accuracy, String> {
    watched("measuring", |watch| {
        measure(mechanism, analysis, options, &mut |_, done| watch(done))
    })?
    .map_err(|error| error.to_string())
}

/// Does work that tells how far it has come, with a progress bar; Ctrl-C breaks it off.
///
/// # Errors
/// What the system says where it has no thread to give.
pub fn watched<T: Send>(
    what: &'static str,
    work: impl FnOnce(&mut dyn FnMut(f64) -> ControlFlow<()>) -> T + Send,
) -> Result<T, String> {
    let mut bar = Bar(Progress::new(what));
    let done = aside(&mut bar, |sender: &Sender<'_, f64>| {
        work(&mut |done| {
            if sender.tell(done) && !interrupt::asked() {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        })
    })
    .map_err(|error| format!("cannot measure: {error}"))?;
    bar.0.finish();
    Ok(done)
}

/// Shows how far the work has come.
struct Bar(Progress);

impl Listener<f64> for Bar {
    fn hear(&mut self, done: f64) {
        // Whoever works looks for Ctrl-C.
        let _ = self.0.tick((done.clamp(0.0, 1.0) * 1e3) as u64, 1000);
    }

    fn abandon(&mut self) -> ! {
        Failure::Plain {
            message: "interrupted".to_owned(),
            help: None,
        }
        .tell();
        std::process::exit(i32::from(interrupt::INTERRUPTED))
    }
}
