//! `kutzbach exact FILE`: what the closure equations prove as polynomials.

use super::failure::Failure;
use super::interrupt::{self, INTERRUPTED};
use super::pose::Pose;
use super::progress::Sign;
use super::{BAD_INPUT, DONE, UNDECIDED, load, output, terminal};
use clap::{Args, ValueEnum};
use kutzbach::algebra::{
    Budget, ExactOptions, Formulation, Limits, Method, MonomialOrder, Progress, Reader, Stop,
    SystemError, SystemOptions, accepted_at_home, assembly_conditions, entries_in,
    motion_conditions, polynomial_system, relation_by_relation, relations_of, written_for,
};
use kutzbach::mechanism::Mechanism;
use kutzbach::report::exact::{
    EXACT_SCHEMA, Proved, Request, conditions_report, proved, relations_report, render,
    render_blocks, render_conditions, render_loopless, render_relations,
};
use kutzbach::report::text::visible;
use serde_json::json;
use std::io::IsTerminal;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Prove what holds at every pose: equations as polynomials, their Groebner basis, dimension, irreducible components
#[derive(Debug, Args)]
pub struct Arguments {
    #[command(flatten)]
    source: load::Source,
    /// Unknowns of the equations
    #[arg(long, value_enum, help_heading = "How it is computed")]
    variables: Option<Variables>,
    /// How the basis is computed [default: divide where the equations fall into parts that share no unknown, else brute]
    #[arg(long, value_enum, help_heading = "How it is computed")]
    method: Option<Way>,
    /// Order of the basis
    #[arg(long, value_enum, default_value_t = Order::Degrevlex, help_heading = "How it is computed")]
    order: Order,
    /// Make the basis lexicographic in this order of the variables, the most significant first, separated by commas; those not named come after
    #[arg(
        long,
        value_name = "VARIABLES",
        value_delimiter = ',',
        conflicts_with_all = ["symbolic", "incremental"],
        help_heading = "How it is computed"
    )]
    variable_order: Vec<String>,
    /// Add the relations one by one: which are accepted, redundant, inconsistent
    #[arg(long)]
    incremental: bool,
    /// With `--incremental`: relations to add first, in this order, separated by commas; the others follow in the order of the file
    #[arg(
        long,
        value_name = "RELATIONS",
        value_delimiter = ',',
        requires = "incremental"
    )]
    first: Vec<String>,
    /// Leave a property of the file open and say which values let the mechanism be put together; may be repeated
    #[arg(long, value_name = "PROPERTY", conflicts_with = "incremental")]
    symbolic: Vec<String>,
    /// With --symbolic: say which values let this joint take every position
    #[arg(long, value_name = "JOINT", requires = "symbolic")]
    moving: Option<String>,
    /// Relations of lines and planes without regard to sense (positional and tree form)
    #[arg(long, help_heading = "How it is computed")]
    unoriented: bool,
    /// List the equations or the basis; may be repeated
    #[arg(long, value_enum)]
    print: Vec<Print>,
    /// Stop after the work of about so many seconds, the same on every machine, and say what is known
    #[arg(
        long,
        value_name = "SECONDS",
        default_value_t = 30.0,
        help_heading = "Limits of work"
    )]
    time: f64,
    /// Exit with code 3 if it stopped before everything was answered
    #[arg(long)]
    strict: bool,
    #[command(flatten)]
    pose: Pose,
    /// Form of the answer
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    #[command(flatten)]
    destination: output::Destination,
    /// Show every row
    #[arg(long)]
    verbose: bool,
    /// Say how long the steps took
    #[arg(long, help_heading = "How it is computed")]
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
    /// The equations alone, as a program for Singular
    Singular,
    /// The equations alone, as a file for msolve
    Msolve,
}

/// Runs the command.
///
/// # Errors
/// Where the file cannot be read, its numbers are not algebraic, or the output cannot be written.
pub fn run(arguments: &Arguments) -> Result<u8, Failure> {
    let mut reading = arguments.source.read_symbolic(&arguments.symbolic)?;
    if arguments.pose.begins_at_limits() {
        return Err(Failure::Plain {
            message:
                "`--pose limits` is where assembly begins; exact equations need a pose that closes"
                    .to_owned(),
            help: Some("`report --pose limits --write-assembled OUT` writes one".to_owned()),
        });
    }
    reading.mechanism = arguments.pose.hold(&reading.mechanism)?;
    let configuration = arguments.pose.named();
    let request = arguments.request(configuration);
    let refused = |error: SystemError| Failure::Plain {
        message: format!("{}: {error}", arguments.source.file.display()),
        help: matches!(
            error,
            SystemError::NotAlgebraic { .. } | SystemError::Degree { .. }
        )
        .then(|| "`report` gives the verdict within the digits".to_owned()),
    };
    if let Some(reader) = arguments.reader() {
        let text = arguments
            .equations(reader, &reading.mechanism, &request)
            .map_err(refused)?;
        arguments.destination.put(&text)?;
        return Ok(DONE);
    }
    let (text, stopped) = watched(arguments, |budget| {
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
        Some(Left::Stopped(Stop::Cancelled)) => INTERRUPTED,
        Some(_) if arguments.strict => UNDECIDED,
        _ => DONE,
    })
}

/// Why something was left without an answer.
enum Left {
    Stopped(Stop),
    /// Not all blocks have exact equations, or they are not to be trusted.
    Blocks,
    /// A relation of the mechanism is no equation.
    Relations,
}

/// Why there is no text.
enum Ended {
    Refused(SystemError),
    Failed(Failure),
}

impl Arguments {
    /// Whether the answer is for a person to read, or for a program.
    fn for_a_person(&self) -> bool {
        self.format == Format::Text
    }

    /// The program that the equations alone are for.
    fn reader(&self) -> Option<Reader> {
        match self.format {
            Format::Singular => Some(Reader::Singular),
            Format::Msolve => Some(Reader::Msolve),
            Format::Text | Format::Json => None,
        }
    }

    /// The equations for another program.
    fn equations(
        &self,
        reader: Reader,
        mechanism: &Mechanism,
        request: &Request,
    ) -> Result<String, SystemError> {
        let system = polynomial_system(mechanism, &request.options.system)?;
        Ok(written_for(reader, &system.names(), &system.polynomials()))
    }

    fn request(&self, configuration: Option<String>) -> Request {
        let formulation = match (self.variables, self.incremental) {
            (Some(Variables::Canonical), _) | (None, false) => Formulation::Canonical,
            (Some(Variables::Tree), _) => Formulation::Tree,
            (Some(Variables::Positional), _) | (None, true) => Formulation::Positional,
        };
        Request {
            file: self.source.file.display().to_string(),
            held: self.pose.items(),
            options: ExactOptions {
                system: SystemOptions {
                    formulation,
                    configuration,
                    unoriented: self.unoriented,
                    ..SystemOptions::default()
                },
                method: self.method.map(|way| match way {
                    Way::Brute => Method::Brute,
                    Way::Divide => Method::Divide,
                    Way::Incremental => Method::Incremental,
                }),
                order: match self.order {
                    // The basis in the order asked for is made from one that is cheap.
                    Order::Lex if self.variable_order.is_empty() => MonomialOrder::Lexicographic,
                    Order::Degrevlex | Order::Lex => MonomialOrder::Degrevlex,
                },
                variable_order: self.variable_order.clone(),
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
    ) -> Result<(String, Option<Left>), Ended> {
        let plain = self.asks_nothing_special();
        let (report, stopped) =
            proved(mechanism, request, plain, budget).map_err(Ended::Refused)?;
        let text = match (&report, self.for_a_person()) {
            (_, false) => output::json(&report).map_err(Ended::Failed)?,
            (Proved::Loopless(report), true) => render_loopless(report, self.layout()),
            (Proved::Whole(report), true) => render(report, self.layout()),
            (Proved::Blocks(report), true) => render_blocks(report, self.layout()),
        };
        let in_part = matches!(&report, Proved::Blocks(report) if report.outcome.word != "done");
        let stopped = stopped.map(Left::Stopped);
        Ok((text, stopped.or(in_part.then_some(Left::Blocks))))
    }

    /// Whether the answer alone is asked for, and not a form of the equations.
    fn asks_nothing_special(&self) -> bool {
        self.print.is_empty()
            && self.variables.is_none()
            && self.method.is_none()
            && self.variable_order.is_empty()
            && self.pose.is_home()
    }

    /// What is told of work that could not be broken off: a form of its own, since there is no answer.
    fn interrupted(&self, phase: &str) -> String {
        let why = "it was interrupted, and this step could not be broken off; nothing is proved";
        let file = self.source.file.display().to_string();
        let phase = match phase {
            "" => "writing the equations",
            phase => phase,
        };
        match self.for_a_person() {
            true => format!(
                "Undecided: stopped at {phase}: {why}.\n\n{}\n",
                visible(&file)
            ),
            false => {
                let value = json!({
                    "schema": EXACT_SCHEMA,
                    "file": file,
                    "outcome": { "word": "stopped", "at": phase, "why": why },
                });
                format!("{value:#}\n")
            }
        }
    }

    fn relations(
        &self,
        mechanism: &Mechanism,
        request: &Request,
        budget: &Budget,
    ) -> Result<(String, Option<Left>), Ended> {
        let (system, given) =
            relations_of(mechanism, &request.options.system).map_err(Ended::Refused)?;
        let given = given.ordered(&self.first).map_err(|name| {
            Ended::Failed(Failure::Plain {
                message: format!("there is no relation named `{name}` to begin with"),
                help: None,
            })
        })?;
        let (findings, stopped) = match relation_by_relation(&given, budget) {
            Ok(findings) => (findings, None),
            Err((stop, findings)) => (findings, Some(stop)),
        };
        let at_home = match stopped {
            None => Vec::new(),
            Some(_) => accepted_at_home(mechanism, (&system, &given), &findings),
        };
        let report = relations_report(
            mechanism,
            (&system, &given.relations),
            (&findings, &at_home),
            stopped,
            request,
        );
        let text = match self.for_a_person() {
            true => render_relations(&report, self.layout()),
            false => output::json(&report).map_err(Ended::Failed)?,
        };
        Ok((text, stopped.map(Left::Stopped)))
    }

    fn conditions(
        &self,
        mechanism: &Mechanism,
        request: &Request,
        budget: &Budget,
    ) -> Result<(String, Option<Left>), Ended> {
        let system =
            polynomial_system(mechanism, &request.options.system).map_err(Ended::Refused)?;
        let mut joint = None;
        let found = match &self.moving {
            None => assembly_conditions(&system, budget),
            Some(name) => {
                let moving = mechanism.joint_named(name).ok_or_else(|| {
                    Ended::Failed(Failure::Plain {
                        message: format!("there is no joint named `{name}`"),
                        help: None,
                    })
                })?;
                // Nothing found is no condition; no variable is no question.
                joint = Some(moving);
                motion_conditions(&system, moving, budget)
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
        let exceptions = found.as_ref().ok();
        let exceptions = exceptions.map(|found| found.exceptions(&system, joint, budget));
        let report = conditions_report(
            mechanism,
            &system,
            data,
            families.as_ref(),
            exceptions.as_ref(),
            moving,
            request,
        );
        let in_part = report.outcome.word == "in part";
        let text = match self.for_a_person() {
            true => render_conditions(&report, self.layout()),
            false => output::json(&report).map_err(Ended::Failed)?,
        };
        let stopped = found.err().map(Left::Stopped);
        Ok((text, stopped.or(in_part.then_some(Left::Relations))))
    }

    fn layout(&self) -> kutzbach::report::text::Layout {
        terminal::layout(self.destination.file().is_some(), self.verbose)
    }
}

/// Steps that do not ask whether to go on may take so long after Ctrl-C.
const GRACE: Duration = Duration::from_secs(2);

/// Where no bar is drawn, work that takes longer says so once (s).
const SILENCE: Duration = Duration::from_secs(3);

/// Does the work within its limits, with a sign of life on standard error after a second or three, and ends it at Ctrl-C.
/// A step that does not end then is given up some time later: then the process ends here. Nothing else depends on the clock.
fn watched<T>(arguments: &Arguments, work: impl FnOnce(&Budget) -> T) -> T {
    interrupt::listen();
    let seconds = arguments.time;
    let progress = Arc::new(Progress::default());
    let over = AtomicBool::new(false);
    let limits = Limits {
        cancelled: Some(interrupt::flag()),
        progress: Some(Arc::clone(&progress)),
        entries: Some(entries_in(arguments.source.memory)),
        ..Limits::seconds(seconds)
    };
    let file = arguments.source.file.display().to_string();
    std::thread::scope(|scope| {
        scope.spawn(|| {
            let began = Instant::now();
            let mut sign = Sign::new(seconds);
            let mut pressed: Option<Instant> = None;
            let mut silent = !std::io::stderr().is_terminal();
            while !over.load(Ordering::Relaxed) {
                std::thread::park_timeout(Duration::from_millis(50));
                if interrupt::asked() && pressed.get_or_insert_with(Instant::now).elapsed() > GRACE
                {
                    give_up(arguments, &progress.phase());
                }
                sign.tick(|| format!("{}, {} entries", progress.phase(), progress.work()));
                if silent && began.elapsed() > SILENCE && !over.load(Ordering::Relaxed) {
                    silent = false;
                    eprintln!(
                        "{}: {}; for about {seconds} s at most (`--time`)",
                        visible(&file),
                        progress.phase()
                    );
                }
            }
        });
        let result = work(&Budget::new(limits));
        over.store(true, Ordering::Relaxed);
        result
    })
}

/// Says that there is no answer, and ends the process.
fn give_up(arguments: &Arguments, phase: &str) -> ! {
    let text = arguments.interrupted(phase);
    let code = match arguments.destination.put(&text) {
        Ok(()) => INTERRUPTED,
        Err(failure) => {
            failure.tell();
            BAD_INPUT
        }
    };
    std::process::exit(i32::from(code))
}
