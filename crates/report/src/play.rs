//! The play that joints need for a motion which the numbers as written bind.

use super::asked::{Options, PlayAsked};
use super::schema::{JointPlay, Play, Report, Warning, WarningKind};
use kutzbach_mobility::{Analysis, AnalysisOptions, Verdict, analyse};
use kutzbach_model::mechanism::Mechanism;
use kutzbach_motion::{NoPlay, PlayOptions};

/// Deviations below this share of what a joint needs are none.
const NONE: f64 = 1e-6;

/// Lays the play of the first branch over a report. Where there is none to tell, a warning says why.
pub(super) fn lay_over(
    report: &mut Report,
    given: &Mechanism,
    analysis: &Analysis,
    configuration: Option<&str>,
    options: &Options,
) {
    let Some(asked) = options.play else { return };
    match found(given, analysis, configuration, options, asked) {
        Ok(play) => report.play = Some(play),
        Err(why) => {
            let text = format!("no play can be told: {why}");
            report
                .warnings
                .push(Warning::new(WarningKind::Unanswered, text));
        }
    }
}

fn found(
    given: &Mechanism,
    analysis: &Analysis,
    configuration: Option<&str>,
    options: &Options,
    asked: PlayAsked,
) -> Result<Play, String> {
    let questions = PlayOptions {
        branch: None,
        configuration: configuration.map(str::to_owned),
        bearing: asked.bearing,
    };
    let tell = |meant: &Mechanism, of: &Analysis| {
        kutzbach_motion::play(given, meant, of, &questions)
            .map(|found| told(meant, &found, asked))
            .map_err(|why: NoPlay| why.to_string())
    };
    if analysis.mobility.verdict == Verdict::Mobile {
        return tell(analysis.of(given), analysis);
    }
    let Some(nearest) = &analysis.nearest else {
        return Err(match analysis.mobility.verdict {
            Verdict::Rigid => {
                "it does not move, and no mechanism near it that does was looked for or found (one is looked for where numbers are \
                 rounded; `--precision` says how well they are known)"
            },
            _ => "no mechanism near it was found that moves",
        }
        .to_owned());
    };
    let of = analyse(
        &nearest.mechanism,
        &AnalysisOptions {
            configuration: configuration.map(str::to_owned),
            exact: options.exact,
            ..AnalysisOptions::default()
        },
    )
    .map_err(|error| error.to_string())?;
    tell(&nearest.mechanism, &of)
}

fn told(mechanism: &Mechanism, found: &kutzbach_motion::Play, asked: PlayAsked) -> Play {
    let name = |joint: usize| mechanism.joints()[joint].name.clone();
    let least = NONE * found.needed;
    let felt = |d: &&kutzbach_motion::Deviation| d.shift.hypot(d.tilt * found.arm) > least;
    let or_none = |deviation: f64, lever: f64| match deviation * lever > least {
        true => deviation,
        false => 0.0,
    };
    Play {
        branch: found.branch.clone(),
        needed: found.needed,
        at_least: found.at_least,
        arm: found.arm,
        variable: found.driven.name.clone(),
        at: found.worst,
        angle: found.driven.unit(mechanism) == "rad",
        joints: found
            .joints
            .iter()
            .filter(felt)
            .map(|d| JointPlay {
                name: name(d.joint),
                shift: or_none(d.shift, 1.0),
                tilt: or_none(d.tilt, found.arm),
            })
            .collect(),
        whole: found.whole,
        held: found.held.clone(),
        left_out: found.left_out,
        clearance: asked.clearance,
        passes: asked.clearance.map(|clearance| found.needed <= clearance),
        forgiven: asked
            .clearance
            .filter(|_| found.needed > 0.0)
            .map(|clearance| clearance / found.needed),
    }
}
