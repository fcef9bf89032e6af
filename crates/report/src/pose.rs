//! What a careful owner should know of the pose: limits, dead centres, singular poses nearby. Sentences for the warnings.

use super::asked::HOME;
use super::schema::{Report, Warning, WarningKind};
use super::text::words::{counted, figure, in_degrees, names};
use kutzbach_mobility::{Analysis, LimitFact, NearSingular, PoseFacts, PoseKind};
use kutzbach_model::mechanism::{FreedomPart, Mechanism};

/// How the sentences begin that are about the pose itself, not about the file.
const OUTSIDE: &str = "this pose is outside joint limits: ";
const DEAD: &str = "extreme position: ";
const SINGULAR: &str = "singular pose: ";
const NEARLY: &str = "nearly singular: the smallest singular value kept";

/// A middle of limits farther than this (rad, m) from the pose drawn is another pose.
const WELL_AWAY: f64 = 1e-3;

/// Joints named in a sentence.
const NAMED: usize = 4;

/// Adds what the pose calls for to the warnings of a report. Nothing here changes the verdict.
pub(super) fn warn(
    report: &mut Report,
    mechanism: &Mechanism,
    analysis: &Analysis,
    configuration: &str,
) {
    if !analysis.assembly.closed {
        return;
    }
    let facts = PoseFacts::of(mechanism, analysis);
    limits(report, mechanism, &facts.limits, configuration);
    resting(report, mechanism, &facts.resting);
    if configuration == HOME && analysis.mobility.pose == Some(PoseKind::Singular) {
        singular(report, mechanism);
    }
    for found in &facts.near {
        let block = report
            .home
            .blocks
            .get(found.part)
            .filter(|_| report.home.blocks.len() > 1)
            .map_or(String::new(), |block| {
                format!("the sub-mechanism of `{}` is ", block.name)
            });
        let text = near_text(mechanism, found, &block);
        let warning = Warning::new(WarningKind::NearlySingular, text);
        report.warnings.push(warning);
    }
}

/// What to do about a home pose outside limits.
const OFFER: &str =
    "; `--pose limits` analyses the middle of the limits, `--pose joint=value` any other pose";

fn limits(report: &mut Report, mechanism: &Mechanism, facts: &[LimitFact], configuration: &str) {
    let mut outside: Vec<(f64, String)> = Vec::new();
    let (mut no_range, mut couplings) = (Vec::new(), Vec::new());
    let joint = |index: usize| &mechanism.joints()[index];
    for fact in facts {
        match *fact {
            LimitFact::Outside {
                joint: index,
                value,
                limit,
            } => {
                let part = joint(index).kind.freedoms()[0];
                let text = format!(
                    "`{}` is at {}, {} {} its limit of {}",
                    joint(index).name,
                    measure(part, value),
                    measure(part, (value - limit).abs()),
                    if value > limit { "above" } else { "below" },
                    measure(part, limit)
                );
                outside.push(((value - limit).abs(), text));
            }
            LimitFact::NoRange { joint: index } => no_range.push(joint(index).name.clone()),
            LimitFact::Empty { coupling } => couplings.push(format!(
                "coupling `{}`: no values within the limits of its joints satisfy it",
                mechanism.couplings()[coupling].name
            )),
            LimitFact::Pinned {
                coupling,
                ref joints,
            } => {
                let held: Vec<String> = joints
                    .iter()
                    .map(|&index| format!("`{}`", joint(index).name))
                    .collect();
                couplings.push(format!(
                    "coupling `{}`: the limits leave {} one value each, so that they cannot move; they count as free here",
                    mechanism.couplings()[coupling].name,
                    names(&held, NAMED)
                ));
            }
        }
    }
    // The worst first; of equals in natural order.
    outside.sort_by(|a, b| {
        b.0.total_cmp(&a.0)
            .then_with(|| super::natural_order(&a.1, &b.1))
    });
    if !outside.is_empty() {
        let mut texts: Vec<String> = outside.iter().take(NAMED).map(|(_, t)| t.clone()).collect();
        if outside.len() > NAMED {
            texts.push(format!("and {} more", outside.len() - NAMED));
        }
        let offer = if configuration == HOME { OFFER } else { "" };
        let text = format!("{OUTSIDE}{}{offer}", texts.join("; "));
        let warning = Warning::new(WarningKind::OutsideLimits, text);
        report.warnings.push(warning);
    }
    if !no_range.is_empty() {
        no_range.sort_by(|a, b| super::natural_order(a, b));
        let quoted: Vec<String> = no_range.iter().map(|name| format!("`{name}`")).collect();
        let text = format!(
            "{} {} a range of zero between the limits ({}); by them it cannot move, here it counts as free",
            counted(no_range.len(), "joint"),
            if no_range.len() == 1 { "has" } else { "have" },
            names(&quoted, NAMED)
        );
        let warning = Warning::new(WarningKind::Limits, text);
        report.warnings.push(warning);
    }
    couplings.sort_by(|a, b| super::natural_order(a, b));
    let couplings = couplings.into_iter();
    let warnings = couplings.map(|text| Warning::new(WarningKind::Limits, text));
    report.warnings.extend(warnings);
}

fn resting(report: &mut Report, mechanism: &Mechanism, joints: &[usize]) {
    let mut resting: Vec<String> = joints
        .iter()
        .map(|&joint| mechanism.joints()[joint].name.clone())
        .collect();
    resting.sort_by(|a, b| super::natural_order(a, b));
    if !resting.is_empty() {
        let quoted: Vec<String> = resting.iter().map(|name| format!("`{name}`")).collect();
        let text = format!(
            "{DEAD}{} at this pose; driving {} cannot start the motion",
            names(&quoted, NAMED),
            if quoted.len() == 1 {
                "it"
            } else {
                "any of them"
            },
        );
        let warning = Warning::new(WarningKind::ExtremePosition, text);
        report.warnings.push(warning);
    }
}

/// What holds at a singular pose need not hold elsewhere; where the limits say where elsewhere is, that is offered.
fn singular(report: &mut Report, mechanism: &Mechanism) {
    let elsewhere = |(_, middle): &(_, f64)| middle.abs() > WELL_AWAY;
    if mechanism.middle_of_limits().iter().any(elsewhere) {
        let text = format!("{SINGULAR}what is said here need not hold elsewhere{OFFER}");
        let warning = Warning::new(WarningKind::SingularPose, text);
        report.warnings.push(warning);
    }
}

fn near_text(mechanism: &Mechanism, found: &NearSingular, block: &str) -> String {
    let start = format!(
        "{block}{NEARLY} is {} of the largest (below {} it would count as zero)",
        figure(found.kept),
        figure(found.tolerance)
    );
    match &found.nearest {
        Some(clearer) => {
            let joint = &mechanism.joints()[clearer.joint];
            format!(
                "{start}; with `{}` moved by {} it is {}",
                joint.freedom_name(clearer.variable),
                measure(joint.kind.freedoms()[clearer.variable], clearer.way),
                figure(clearer.kept)
            )
        }
        None if found.followed => format!("{start}; no pose with a larger margin was found nearby"),
        None => format!("{start}; in so large a sub-mechanism no other pose was tried"),
    }
}

/// A value of a joint in degrees or millimetres.
fn measure(part: FreedomPart, value: f64) -> String {
    match part {
        FreedomPart::Translation => format!("{} mm", figure(1e3 * value)),
        FreedomPart::Rotation | FreedomPart::Screw => format!("{}°", in_degrees(value)),
    }
}
