//! The play that joints need for a motion which the numbers as written bind.

use super::assemble::Options;
use super::schema::{Report, Warning, WarningKind};
use kutzbach_mobility::{Analysis, AnalysisOptions, Verdict, analyse};
use kutzbach_model::mechanism::Mechanism;
use kutzbach_motion::{NoPlay, PlayOptions};
use serde::{Deserialize, Serialize};

/// Deviations below this share of what a joint needs are none.
const NONE: f64 = 1e-6;

/// The play that joints need for a motion: the least deviation, the same for all joints, that closes the loops of the numbers as
/// written along the motion of the mechanism meant. To first order in the misfit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Play {
    /// The branch followed.
    pub branch: String,
    /// How far every joint has to give way at the worst pose (m): its sides shift by `d` and tilt by `θ` with
    /// `√(d² + (arm θ)²)` up to this.
    pub needed: f64,
    /// A proven lower bound of it (m).
    pub at_least: f64,
    /// The length by which tilts count: half the length of a bearing (m).
    pub arm: f64,
    /// The variable that tells poses apart.
    pub variable: String,
    /// Its value at the worst pose (rad, m).
    pub at: f64,
    /// Whether it is an angle.
    pub angle: bool,
    /// Joints that give way there, in the order of the file.
    pub joints: Vec<JointPlay>,
    /// Whether the motion was followed all round, or from end to end.
    pub whole: bool,
    /// Variables that were held, where the branch has several degrees of freedom.
    #[serde(default)]
    pub held: Vec<String>,
    /// Poses left out, at which the equations have another rank.
    pub left_out: usize,
    /// The clearance asked about (m).
    #[serde(default)]
    pub clearance: Option<f64>,
    /// Whether it suffices.
    #[serde(default)]
    pub passes: Option<bool>,
    /// How many times this misalignment it forgives.
    #[serde(default)]
    pub forgiven: Option<f64>,
}

/// How a joint gives way.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JointPlay {
    /// The joint.
    pub name: String,
    /// Shift of its sides (m).
    pub shift: f64,
    /// Their tilt (rad).
    pub tilt: f64,
}

/// What to say of play.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PlayAsked {
    /// A clearance that joints have (m), which is compared with what they need.
    pub clearance: Option<f64>,
    /// Distance of the two ends of every bearing (m); the length of the moving loops if `None`.
    pub bearing: Option<f64>,
}

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
