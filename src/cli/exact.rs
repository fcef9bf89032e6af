//! `kutzbach exact FILE`: what the closure equations prove as polynomials.

use super::failure::Failure;
use super::interrupt::{self, INTERRUPTED};
use super::{DONE, UNDECIDED, load, output, terminal};
use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressDrawTarget};
use kutzbach::algebra::{
    Budget, ExactOptions, Formulation, Limits, Method, MonomialOrder, Progress, Stop, SystemError,
    SystemOptions, assembly_conditions, exact_answer, motion_conditions, polynomial_system,
    relation_by_relation, relations_of,
};
use kutzbach::mechanism::Mechanism;
use kutzbach::report::exact::{
    Request, conditions_report, exact_report, relations_report, render, render_conditions,
    render_relations,
};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Prove what holds at every pose: equations as polynomials, their Groebner basis, dimension, pieces
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    source: load::Source,
    /// Unknowns of the equations
    #[arg(long, value_enum)]
    variables: Option<Variables>,
    /// How the basis is computed [default: divide where the equations fall into parts that share no unknown, else brute]
    #[arg(long, value_enum)]
    method: Option<Way>,
    /// Order of the basis
    #[arg(long, value_enum, default_value_t = Order::Degrevlex)]
    order: Order,
    /// Add the relations one by one: which are accepted, redundant, inconsistent
    #[arg(long)]
    incremental: bool,
    /// Leave a property of the file open and say which values let the mechanism be put together; may be repeated
    #[arg(long, value_name = "PROPERTY", conflicts_with = "incremental")]
    symbolic: Vec<String>,
    /// With --symbolic: say which values let this joint take every position
    #[arg(long, value_name = "JOINT", requires = "symbolic")]
    moving: Option<String>,
    /// Relations of lines and planes without regard to sense (positional and tree form)
    #[arg(long)]
    unoriented: bool,
    /// List the equations or the basis; may be repeated
    #[arg(long, value_enum)]
    print: Vec<Print>,
    /// Stop after so many seconds and say what is known
    #[arg(long, value_name = "SECONDS", default_value_t = 60.0)]
    time: f64,
    /// Exit with code 3 if it stopped before everything was answered
    #[arg(long)]
    strict: bool,
    /// Start at a configuration of the file instead of the home pose
    #[arg(long, value_name = "CONFIGURATION")]
    at: Option<String>,
    /// Form of the answer
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    #[command(flatten)]
    destination: output::Destination,
    /// Show every row
    #[arg(long)]
    verbose: bool,
    /// Say how long the steps took
    #[arg(long)]
    timing: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Variables {
    /// The joints' freedoms, cycle by cycle
    Canonical,
    /// The freedoms of a tree of joints, and what the others ask for
    Tree,
    /// The entries of every link's matrix
    Positional,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Way {
    /// All equations at once
    Brute,
    /// Every cycle by itself, then all together
    Divide,
    /// Cycle by cycle, putting what is known into the next
    Incremental,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Order {
    /// By degree; the cheapest
    Degrevlex,
    /// Triangular, and often out of reach
    Lex,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Print {
    /// The equations
    Equations,
    /// The basis
    Basis,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// A page for a person
    Text,
    /// Everything, for a program
    Json,
}

/// Runs the command.
///
/// # Errors
/// Where the file cannot be read, its numbers are not algebraic, or the output cannot be written.
pub fn run(arguments: &Arguments) -> Result<u8, Failure> {
    let reading = arguments.source.read_symbolic(&arguments.symbolic)?;
    let request = arguments.request();
    let refused = |error: SystemError| Failure::Plain {
        message: format!("{}: {error}", arguments.source.file.display()),
        help: None,
    };
    let (text, stopped) = watched(arguments.time, |budget| {
        if !arguments.symbolic.is_empty() {
            arguments.conditions(&reading.mechanism, &request, budget)
        } else if arguments.incremental {
            arguments.relations(&reading.mechanism, &request, budget)
        } else {
            arguments.answer(&reading.mechanism, &request, budget)
        }
    })
    .map_err(|failure| match failure {
        Ended::Refused(error) => refused(error),
        Ended::Failed(failure) => failure,
    })?;
    arguments.destination.put(&text)?;
    Ok(match stopped {
        Some(Stop::Cancelled) => INTERRUPTED,
        Some(_) if arguments.strict => UNDECIDED,
        _ => DONE,
    })
}

/// Why there is no text.
enum Ended {
    Refused(SystemError),
    Failed(Failure),
}

impl Arguments {
    fn request(&self) -> Request {
        let formulation = match (self.variables, self.incremental) {
            (Some(Variables::Canonical), _) | (None, false) => Formulation::Canonical,
            (Some(Variables::Tree), _) => Formulation::Tree,
            (Some(Variables::Positional), _) | (None, true) => Formulation::Positional,
        };
        Request {
            file: self.source.file.display().to_string(),
            options: ExactOptions {
                system: SystemOptions {
                    formulation,
                    configuration: self.at.clone(),
                    unoriented: self.unoriented,
                    ..SystemOptions::default()
                },
                method: self.method.map(|way| match way {
                    Way::Brute => Method::Brute,
                    Way::Divide => Method::Divide,
                    Way::Incremental => Method::Incremental,
                }),
                order: match self.order {
                    Order::Degrevlex => MonomialOrder::Degrevlex,
                    Order::Lex => MonomialOrder::Lexicographic,
                },
            },
            equations: self.print.contains(&Print::Equations),
            basis: self.print.contains(&Print::Basis),
            timing: self.timing,
        }
    }

    fn answer(
        &self,
        mechanism: &Mechanism,
        request: &Request,
        budget: &Budget,
    ) -> Result<(String, Option<Stop>), Ended> {
        let answer = exact_answer(mechanism, &request.options, budget).map_err(Ended::Refused)?;
        let report = exact_report(mechanism, &answer, request);
        let text = match self.format {
            Format::Text => render(&report, self.layout()),
            Format::Json => output::json(&report).map_err(Ended::Failed)?,
        };
        Ok((text, answer.stopped.map(|(_, stop)| stop)))
    }

    fn relations(
        &self,
        mechanism: &Mechanism,
        request: &Request,
        budget: &Budget,
    ) -> Result<(String, Option<Stop>), Ended> {
        let (system, always, relations) =
            relations_of(mechanism, &request.options.system).map_err(Ended::Refused)?;
        let (findings, stopped) =
            match relation_by_relation(&always, &relations, system.variables.len(), budget) {
                Ok(findings) => (findings, None),
                Err((stop, findings)) => (findings, Some(stop)),
            };
        let report = relations_report(mechanism, &system, &findings, stopped, request);
        let text = match self.format {
            Format::Text => render_relations(&report, self.layout()),
            Format::Json => output::json(&report).map_err(Ended::Failed)?,
        };
        Ok((text, stopped))
    }

    fn conditions(
        &self,
        mechanism: &Mechanism,
        request: &Request,
        budget: &Budget,
    ) -> Result<(String, Option<Stop>), Ended> {
        let system =
            polynomial_system(mechanism, &request.options.system).map_err(Ended::Refused)?;
        let found = match &self.moving {
            None => assembly_conditions(&system, budget),
            Some(name) => {
                let joint = mechanism.joint_named(name).ok_or_else(|| {
                    Ended::Failed(Failure::Plain {
                        message: format!("there is no joint named `{name}`"),
                        help: None,
                    })
                })?;
                // Nothing found is no condition; no variable is no question.
                motion_conditions(&system, joint, budget)
                    .transpose()
                    .ok_or_else(|| {
                        Ended::Failed(Failure::Plain {
                            message: format!(
                                "joint `{name}` has no variable of its own in this form"
                            ),
                            help: Some("ask with `--variables canonical`".to_owned()),
                        })
                    })?
            }
        };
        let moving = self.moving.as_deref();
        let data = found.as_ref().map_err(|stop| *stop);
        // Time that is over takes nothing away from the conditions.
        let families = found
            .as_ref()
            .ok()
            .filter(|found| found.conditions.len() > 1);
        let families = families.and_then(|found| found.families(&system, budget).ok());
        let report =
            conditions_report(mechanism, &system, data, families.as_ref(), moving, request);
        let text = match self.format {
            Format::Text => render_conditions(&report, self.layout()),
            Format::Json => output::json(&report).map_err(Ended::Failed)?,
        };
        Ok((text, found.err()))
    }

    fn layout(&self) -> kutzbach::report::text::Layout {
        terminal::layout(self.destination.file().is_some(), self.verbose)
    }
}

/// Does the work under a time limit, with a sign of life on standard error after a second, and ends it at Ctrl-C.
fn watched<T>(seconds: f64, work: impl FnOnce(&Budget) -> T) -> T {
    interrupt::listen();
    let progress = Arc::new(Progress::default());
    let cancelled = Arc::new(AtomicBool::new(false));
    let over = AtomicBool::new(false);
    let limits = Limits {
        cancelled: Some(Arc::clone(&cancelled)),
        progress: Some(Arc::clone(&progress)),
        ..Limits::seconds(seconds)
    };
    std::thread::scope(|scope| {
        scope.spawn(|| {
            let began = Instant::now();
            let mut sign: Option<ProgressBar> = None;
            while !over.load(Ordering::Relaxed) {
                std::thread::park_timeout(Duration::from_millis(100));
                if interrupt::asked() {
                    cancelled.store(true, Ordering::Relaxed);
                }
                if began.elapsed() > Duration::from_secs(1) {
                    let sign = sign.get_or_insert_with(|| {
                        let target = ProgressDrawTarget::stderr_with_hz(10);
                        ProgressBar::with_draw_target(None, target)
                    });
                    sign.set_message(format!("{}, {} entries", progress.phase(), progress.work()));
                    sign.tick();
                }
            }
            if let Some(sign) = sign {
                sign.finish_and_clear();
            }
        });
        let result = work(&Budget::new(limits));
        over.store(true, Ordering::Relaxed);
        result
    })
}
