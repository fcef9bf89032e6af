//! The log of a simulation: opened before anything is simulated, finished whatever happens.

use super::Arguments;
use super::aside::{Listener, Sender, aside};
use crate::cli::failure::Failure;
use crate::cli::progress::Progress;
use crate::cli::{BAD_INPUT, interrupt, load, output};
use kutzbach::closure::{Geometry, JointState, Rigid};
use kutzbach::format::Reading;
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{Analysis, Branch};
use kutzbach::motion::{Trace, TraceOptions, trace};
use kutzbach::record::{
    Header, Level, LogFile, Motion, RecordError, Recorder, Roles, SimulationLog, Summary,
    record_motion,
};
use kutzbach::report::Options;
use kutzbach::report::text::visible;
use kutzbach::report::text::words::degrees;
use kutzbach::simulate::JointGap;
use kutzbach::simulate::verification::{Finding, Moment, Observer, Passage, VerificationOptions};
use std::collections::BTreeMap;
use std::io::IsTerminal;
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Poses of the predicted motion where no number is asked for.
const SAMPLES: usize = 200;

/// Seconds between what is simulated, or predicted, and what follows.
const PAUSE: f64 = 0.5;

/// The log, if one is wanted, and the progress bar.
pub struct Log<'a> {
    mechanism: &'a Mechanism,
    geometry: &'a Geometry<f64>,
    analysis: &'a Analysis,
    options: &'a VerificationOptions,
    /// Poses of each predicted motion.
    samples: usize,
    path: Option<&'a Path>,
    recorder: Option<Recorder<'a, LogFile>>,
    /// Time that the log has come to (s).
    until: f64,
}

impl<'a> Log<'a> {
    /// Opens the log.
    ///
    /// # Errors
    /// Where the log cannot be written, or the report that it holds cannot be made.
    pub fn begin(
        arguments: &'a Arguments,
        reading: &'a Reading,
        geometry: &'a Geometry<f64>,
        analysis: &'a Analysis,
        options: &'a VerificationOptions,
    ) -> Result<Self, Failure> {
        let mut log = Self {
            mechanism: &reading.mechanism,
            geometry,
            analysis,
            options,
            samples: arguments.samples.unwrap_or(SAMPLES),
            path: arguments.mcap.as_deref(),
            recorder: None,
            until: 0.0,
        };
        let Some(path) = log.path else {
            return Ok(log);
        };
        let report = load::report_on(
            reading,
            &arguments.source.file,
            &Options {
                configuration: options.configuration.clone(),
                ..Options::default()
            },
        )?;
        let report = output::json(&report)?;
        let source = std::fs::read(&arguments.source.file).map_err(|error| Failure::Plain {
            message: format!("cannot read `{}`: {error}", arguments.source.file.display()),
            help: None,
        })?;
        let name = arguments.source.file.file_name().unwrap_or_default();
        let roles = log.roles(None, None);
        let facts = log.facts(options);
        let recorder = Recorder::create(
            path,
            &Header {
                mechanism: log.mechanism,
                geometry,
                source_name: &name.to_string_lossy(),
                source: &source,
                report: Some(&report),
                facts: &facts,
                roles: &roles,
                simulated_at: None,
            },
        )
        .map_err(|error| unwritten(path, &error))?;
        let mut recorder = recorder;
        recorder
            .rest(0.0, &Motion::of_links(&geometry.home))
            .map_err(|error| unwritten(path, &error))?;
        log.recorder = Some(recorder);
        Ok(log)
    }

    fn facts(&self, options: &VerificationOptions) -> BTreeMap<String, String> {
        let mobility = &self.analysis.mobility;
        let mut facts = BTreeMap::new();
        let mut add = |key: &str, value: String| {
            facts.insert(key.to_owned(), value);
        };
        add("mechanism", self.mechanism.name().to_owned());
        add("verdict", mobility.verdict.word().to_owned());
        if let Some(finite) = mobility.finite() {
            add("finite", finite.to_string());
        }
        if let Some(class) = mobility.class {
            add("class", class.word().to_owned());
        }
        add("seed", options.seed.to_string());
        add("time_step", options.time_step.to_string());
        let ladder: Vec<String> = options.ladder.iter().map(ToString::to_string).collect();
        add("substeps", ladder.join(","));
        facts
    }

    /// The predicted motion of every branch that is verified: last, so that what is simulated begins at 0 s with the prediction beside it.
    fn play(&mut self) -> Result<(), Failure> {
        let options = self.options;
        let (Some(path), Some(mut recorder)) = (self.path, self.recorder.take()) else {
            return Ok(());
        };
        let unwritten = |error: RecordError| unwritten(path, &error);
        let branches = self.analysis.branches.as_deref().unwrap_or_default();
        for branch in branches {
            if options.branch.as_ref().is_some_and(|b| *b != branch.name) {
                continue;
            }
            if interrupt::asked() {
                break;
            }
            let wanted = TraceOptions {
                branch: Some(branch.name.clone()),
                drive: options.drive.clone(),
                samples: self.samples,
                configuration: options.configuration.clone(),
                ..TraceOptions::default()
            };
            let (mechanism, analysis) = (self.mechanism, self.analysis);
            let mut waiting = Waiting {
                path,
                recorder: Some(recorder),
            };
            let traced = aside(&mut waiting, |_| trace(mechanism, analysis, &wanted))
                .map_err(|error| unwritten(RecordError::Io(error)))?;
            // It is given back unless the process has ended.
            let Some(back) = waiting.recorder else {
                return Ok(());
            };
            recorder = back;
            let missing =
                |reason: String| format!("no predicted motion of branch {}: {reason}", branch.name);
            let motion = match traced {
                Ok(Trace::Moving(motion)) => motion,
                Ok(Trace::Still(still)) => {
                    let text = missing(still.reason);
                    recorder
                        .log(self.until, Level::Warning, &text)
                        .map_err(unwritten)?;
                    continue;
                }
                Err(error) => {
                    let text = missing(error.to_string());
                    recorder
                        .log(self.until, Level::Warning, &text)
                        .map_err(unwritten)?;
                    continue;
                }
            };
            let roles = self.roles(Some(branch), Some(motion.driven.joint));
            recorder.set_roles(self.until, &roles).map_err(unwritten)?;
            self.until =
                record_motion(&mut recorder, &motion, self.until).map_err(unwritten)? + PAUSE;
        }
        self.recorder = Some(recorder);
        Ok(())
    }

    /// What links and joints do along a branch; along the first where none is named.
    fn roles(&self, branch: Option<&Branch>, driven: Option<usize>) -> Roles {
        let branches = self.analysis.branches.as_deref().unwrap_or_default();
        let branch = branch.or_else(|| branches.first());
        Roles::of(self.mechanism, self.analysis, branch, driven)
    }

    /// Does something while it is logged and its progress shown; Ctrl-C breaks it off.
    ///
    /// # Errors
    /// Where the log cannot be written.
    pub fn watch<T: Send>(
        &mut self,
        work: impl FnOnce(&mut dyn Observer) -> T + Send,
    ) -> Result<T, Failure> {
        let path = self.path.unwrap_or(Path::new(""));
        let analysis = self.analysis;
        let recorder = self.recorder.take();
        let roles_of = |passage: &Passage| {
            let branches = analysis.branches.as_deref().unwrap_or_default();
            let branch = branches.iter().find(|b| b.name == passage.branch);
            self.roles(branch, passage.driven.as_ref().map(|v| v.joint))
        };
        let broken = AtomicBool::new(false);
        let mut watcher = Watcher {
            path,
            log: recorder.map(|recorder| {
                SimulationLog::new(
                    recorder,
                    self.mechanism,
                    self.geometry,
                    self.until,
                    &roles_of,
                )
            }),
            progress: Progress::new("simulating"),
            broken: &broken,
            begun: Instant::now(),
            sign: Some(self.sign()),
        };
        let done = aside(&mut watcher, |sender| {
            work(&mut Relay {
                sender,
                broken: &broken,
            })
        })
        .map_err(|error| Failure::Plain {
            message: format!("cannot simulate: {error}"),
            help: None,
        })?;
        watcher.progress.finish();
        if let Some(log) = watcher.log {
            let (recorder, until) = log.finish().map_err(|error| unwritten(path, &error))?;
            self.until = until + PAUSE;
            self.recorder = Some(recorder);
        }
        Ok(done)
    }

    /// What is told of long work where no bar can be drawn: what is predicted.
    fn sign(&self) -> String {
        let mobility = &self.analysis.mobility;
        let finite = mobility.finite();
        let freedom = finite.map_or(String::new(), |n| format!(" with {}", degrees(n)));
        format!(
            "{}: predicted {}{freedom}; simulating",
            self.mechanism.name(),
            mobility.verdict.word()
        )
    }

    /// A sentence at the time that the log has come to.
    ///
    /// # Errors
    /// Where the log cannot be written.
    pub fn tell(&mut self, text: &str) -> Result<(), Failure> {
        let Some((recorder, path)) = self.recorder.as_mut().zip(self.path) else {
            return Ok(());
        };
        let told = recorder.log(self.until, Level::Info, text);
        told.map_err(|error| unwritten(path, &error))
    }

    /// Writes the outcome and closes the log; what was logged, where there is one.
    ///
    /// # Errors
    /// Where the log cannot be written.
    pub fn finish(
        mut self,
        finding: &Finding,
        stopped: bool,
    ) -> Result<Option<(String, Summary)>, Failure> {
        if !stopped {
            self.play()?;
        }
        let Some((mut recorder, path)) = self.recorder.take().zip(self.path) else {
            return Ok(None);
        };
        let text = format!("{}: {}", finding.outcome.word(), finding.why);
        let finished = recorder.log(self.until, Level::Info, &text).and_then(|()| {
            if stopped {
                recorder.finish_early("interrupted")
            } else {
                recorder.finish()
            }
        });
        match finished {
            Ok(summary) => Ok(Some((path.display().to_string(), summary))),
            Err(error) => Err(unwritten(path, &error)),
        }
    }
}

fn unwritten(path: &Path, error: &RecordError) -> Failure {
    Failure::Plain {
        message: format!("cannot write `{}`: {error}", path.display()),
        help: None,
    }
}

/// Ends the process after Ctrl-C where work does not end by itself: with a complete log, and words on standard error.
fn end_early(path: &Path, recorder: Option<Recorder<'_, LogFile>>) -> ! {
    let finished = recorder.map(|recorder| recorder.finish_early("interrupted"));
    let (failure, code) = match finished {
        Some(Err(error)) => (unwritten(path, &error), i32::from(BAD_INPUT)),
        Some(Ok(summary)) => (
            Failure::Plain {
                message: format!(
                    "interrupted; {}: {} moments in {:.1} s",
                    path.display(),
                    summary.moments,
                    summary.until
                ),
                help: None,
            },
            i32::from(interrupt::INTERRUPTED),
        ),
        None => (
            Failure::Plain {
                message: "interrupted".to_owned(),
                help: None,
            },
            i32::from(interrupt::INTERRUPTED),
        ),
    };
    failure.tell();
    std::process::exit(code)
}

/// Waits for work that tells nothing.
struct Waiting<'p, 'a> {
    path: &'p Path,
    recorder: Option<Recorder<'a, LogFile>>,
}

impl Listener<()> for Waiting<'_, '_> {
    fn hear(&mut self, (): ()) {}

    fn abandon(&mut self) -> ! {
        end_early(self.path, self.recorder.take())
    }
}

/// What a simulation tells, with everything that belongs to it.
enum Told {
    Begin(Passage),
    Moment(Box<Copied>),
    Estimated(Vec<(f64, f64)>),
}

/// Poses of links and states of joints.
type Configuration = (Vec<Rigid<f64>>, Vec<JointState<f64>>);

/// A [`Moment`] that owns what it is made of.
struct Copied {
    time: f64,
    done: f64,
    simulated: Vec<Rigid<f64>>,
    states: Vec<JointState<f64>>,
    predicted: Option<Configuration>,
    gaps: Vec<JointGap>,
    closure_error: f64,
    distance: f64,
}

/// Stands by the simulation and tells everything on.
struct Relay<'t, 'b> {
    sender: &'t Sender<'t, Told>,
    broken: &'b AtomicBool,
}

impl Relay<'_, '_> {
    fn tell(&self, told: Told) -> ControlFlow<()> {
        let heard = self.sender.tell(told);
        if heard && !self.broken.load(Ordering::SeqCst) && !interrupt::asked() {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    }
}

impl Observer for Relay<'_, '_> {
    fn begin(&mut self, passage: &Passage) -> ControlFlow<()> {
        self.tell(Told::Begin(passage.clone()))
    }

    fn moment(&mut self, moment: &Moment<'_>) -> ControlFlow<()> {
        self.tell(Told::Moment(Box::new(Copied {
            time: moment.time,
            done: moment.done,
            simulated: moment.simulated.to_vec(),
            states: moment.states.to_vec(),
            predicted: moment
                .predicted
                .map(|(links, states)| (links.to_vec(), states.to_vec())),
            gaps: moment.gaps.to_vec(),
            closure_error: moment.closure_error,
            distance: moment.distance,
        })))
    }

    fn estimated(&mut self, over_time: &[(f64, f64)]) -> ControlFlow<()> {
        self.tell(Told::Estimated(over_time.to_vec()))
    }
}

/// Hands everything on to the log and the progress bar.
struct Watcher<'p, 'r, 'a> {
    path: &'p Path,
    log: Option<SimulationLog<'r, 'a, LogFile>>,
    progress: Progress,
    /// Whether the log cannot be written any more.
    broken: &'p AtomicBool,
    begun: Instant,
    /// What is still to be told of work that takes long.
    sign: Option<String>,
}

/// Work that takes longer says so, where no bar shows it.
const SILENCE: Duration = Duration::from_secs(3);

/// Steps of a progress bar.
const TICKS: f64 = 1000.0;

impl Listener<Told> for Watcher<'_, '_, '_> {
    fn hear(&mut self, told: Told) {
        if let Told::Moment(moment) = &told {
            let done = (moment.done.clamp(0.0, 1.0) * TICKS) as u64;
            // Whoever simulates looks for Ctrl-C.
            let _ = self.progress.tick(done, TICKS as u64);
        }
        let Some(log) = &mut self.log else { return };
        if self.broken.load(Ordering::SeqCst) {
            return;
        }
        let written = match &told {
            Told::Begin(passage) => log.begin(passage),
            Told::Estimated(over_time) => log.estimated(over_time),
            Told::Moment(moment) => log.moment(&Moment {
                time: moment.time,
                done: moment.done,
                simulated: &moment.simulated,
                states: &moment.states,
                predicted: moment
                    .predicted
                    .as_ref()
                    .map(|(links, states)| (&links[..], &states[..])),
                gaps: &moment.gaps,
                closure_error: moment.closure_error,
                distance: moment.distance,
            }),
        };
        if written.is_break() {
            self.broken.store(true, Ordering::SeqCst);
        }
    }

    fn waits(&mut self) {
        if self.begun.elapsed() > SILENCE
            && let Some(sign) = self.sign.take()
            && !std::io::stderr().is_terminal()
        {
            eprintln!("{}", visible(&sign));
        }
    }

    fn abandon(&mut self) -> ! {
        let recorder = match self.log.take().map(SimulationLog::finish) {
            None => None,
            Some(Ok((recorder, _))) => Some(recorder),
            Some(Err(error)) => {
                unwritten(self.path, &error).tell();
                std::process::exit(i32::from(BAD_INPUT))
            }
        };
        end_early(self.path, recorder)
    }
}
