//! The log of a simulation: opened before anything is simulated, finished whatever happens.

use super::Arguments;
use crate::cli::failure::Failure;
use crate::cli::progress::Progress;
use crate::cli::{load, output};
use kutzbach::closure::Geometry;
use kutzbach::format::Reading;
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{Analysis, Branch};
use kutzbach::motion::{TraceOptions, trace};
use kutzbach::record::{
    Header, Level, LogFile, RecordError, Recorder, Role, Roles, SimulationLog, Summary,
    record_motion,
};
use kutzbach::report::Options;
use kutzbach::simulate::verification::{
    Finding, Moment, Observer, Passage, VerificationOptions,
};
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::Path;

/// Seconds between the predicted motion and what follows.
const PAUSE: f64 = 0.5;

/// The log, if one is wanted, and the progress bar.
pub struct Log<'a> {
    mechanism: &'a Mechanism,
    geometry: &'a Geometry<f64>,
    analysis: &'a Analysis,
    path: Option<&'a Path>,
    recorder: Option<Recorder<'a, LogFile>>,
    /// Time that the log has come to (s).
    until: f64,
}

impl<'a> Log<'a> {
    /// Opens the log and plays the predicted motion into it.
    ///
    /// # Errors
    /// Where the log cannot be written, or the report that it holds cannot be made.
    pub fn begin(
        arguments: &'a Arguments,
        reading: &'a Reading,
        geometry: &'a Geometry<f64>,
        analysis: &'a Analysis,
        options: &VerificationOptions,
    ) -> Result<Self, Failure> {
        let mut log = Self {
            mechanism: &reading.mechanism,
            geometry,
            analysis,
            path: arguments.mcap.as_deref(),
            recorder: None,
            until: 0.0,
        };
        let Some(path) = log.path else {
            return Ok(log);
        };
        let report = load::report_on(
            reading,
            &arguments.file,
            &Options {
                configuration: arguments.at.clone(),
                ..Options::default()
            },
        )?;
        let report = output::json(&report)?;
        let source = std::fs::read(&arguments.file).map_err(|error| Failure::Plain {
            message: format!("cannot read `{}`: {error}", arguments.file.display()),
            help: None,
        })?;
        let name = arguments.file.file_name().unwrap_or_default();
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
        log.recorder = Some(recorder);
        log.play(arguments, options)
            .map_err(|error| unwritten(path, &error))?;
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

    /// The predicted motion of every branch that is verified.
    fn play(
        &mut self,
        arguments: &Arguments,
        options: &VerificationOptions,
    ) -> Result<(), RecordError> {
        let branches = self.analysis.branches.as_deref().unwrap_or_default();
        for branch in branches {
            if options.branch.as_ref().is_some_and(|b| *b != branch.name) {
                continue;
            }
            let wanted = TraceOptions {
                branch: Some(branch.name.clone()),
                drive: options.drive.clone(),
                samples: arguments.samples,
                configuration: options.configuration.clone(),
                ..TraceOptions::default()
            };
            // What cannot be traced is told where it is verified.
            let Ok(traced) = trace(self.mechanism, self.analysis, &wanted) else {
                continue;
            };
            let Some(motion) = traced.into_motion() else {
                continue;
            };
            let roles = self.roles(Some(branch), Some(motion.driven.joint));
            if let Some(recorder) = &mut self.recorder {
                recorder.set_roles(self.until, &roles)?;
                self.until = record_motion(recorder, &motion, self.until)? + PAUSE;
            }
        }
        Ok(())
    }

    /// What links and joints do along a branch.
    fn roles(&self, branch: Option<&Branch>, driven: Option<usize>) -> Roles {
        let locked = |locked| if locked { Role::Locked } else { Role::Moving };
        let branches = self.analysis.branches.as_deref().unwrap_or_default();
        let Some(branch) = branch.or_else(|| branches.first()) else {
            // Nothing moves, or nothing is known to.
            return Roles {
                links: Vec::new(),
                joints: self
                    .analysis
                    .roles
                    .iter()
                    .map(|role| locked(role.locked == Some(true)))
                    .collect(),
            };
        };
        let mut roles = Roles {
            links: vec![Role::Moving; self.mechanism.links().len()],
            joints: branch
                .roles
                .iter()
                .map(|role| locked(role.locked == Some(true)))
                .collect(),
        };
        for motion in &branch.motions {
            if motion.freedom == 0 {
                roles.links[motion.link] = Role::Locked;
            }
        }
        for idle in &branch.idle {
            roles.links[idle.link] = Role::Idle;
        }
        if let Some(joint) = driven {
            roles.joints[joint] = Role::Driven;
        }
        roles
    }

    /// Does something while it is logged and its progress shown; Ctrl-C breaks it off.
    ///
    /// # Errors
    /// Those of the work; where the log cannot be written.
    pub fn watch<T>(
        &mut self,
        work: impl FnOnce(&mut dyn Observer) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        let mut progress = Progress::new("simulating");
        let Some(mut recorder) = self.recorder.take() else {
            let mut watcher = Watcher {
                log: None,
                progress: &mut progress,
            };
            return work(&mut watcher);
        };
        let analysis = self.analysis;
        let roles_of = |passage: &Passage| {
            let branches = analysis.branches.as_deref().unwrap_or_default();
            let branch = branches.iter().find(|b| b.name == passage.branch);
            self.roles(branch, passage.driven.as_ref().map(|v| v.joint))
        };
        let mut log = SimulationLog::new(
            &mut recorder,
            self.mechanism,
            self.geometry,
            self.until,
            &roles_of,
        );
        let mut watcher = Watcher {
            log: Some(&mut log),
            progress: &mut progress,
        };
        let done = work(&mut watcher);
        let until = log.finish();
        let path = self.path.unwrap_or(Path::new(""));
        self.until = until.map_err(|error| unwritten(path, &error))? + PAUSE;
        self.recorder = Some(recorder);
        done
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
        let Some((mut recorder, path)) = self.recorder.take().zip(self.path) else {
            return Ok(None);
        };
        let text = format!("{}: {}", finding.outcome.word(), finding.why);
        let finished = recorder
            .log(self.until, Level::Info, &text)
            .and_then(|()| {
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

/// Hands everything on to the log and the progress bar.
struct Watcher<'w, 'r, 'a> {
    log: Option<&'w mut SimulationLog<'r, 'a, LogFile>>,
    progress: &'w mut Progress,
}

/// Steps of a progress bar.
const TICKS: f64 = 1000.0;

impl Observer for Watcher<'_, '_, '_> {
    fn begin(&mut self, passage: &Passage) -> ControlFlow<()> {
        match &mut self.log {
            Some(log) => log.begin(passage),
            None => ControlFlow::Continue(()),
        }
    }

    fn moment(&mut self, moment: &Moment<'_>) -> ControlFlow<()> {
        if let Some(log) = &mut self.log {
            log.moment(moment)?;
        }
        let done = (moment.done.clamp(0.0, 1.0) * TICKS) as u64;
        self.progress.tick(done, TICKS as u64)
    }

    fn say(&mut self, text: &str) {
        if let Some(log) = &mut self.log {
            log.say(text);
        }
    }
}
