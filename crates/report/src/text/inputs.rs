//! What moves the mechanism: its inputs, whether they are enough, and how its freedoms are shared among its limbs.

use super::cite;
use super::page::Page;
use super::sections::limit;
use super::style::Tint;
use super::words::{mirrored_runs, names};
use crate::natural::natural_order;
use crate::schema::{DependentInput, InputSource, Inputs, Limb, Report};

/// Limbs named on a first screen.
const LIMBS: usize = 8;

/// Inputs named on a first screen where there are more.
const NAMED: usize = 6;

/// Dependent inputs told one by one.
const DEPENDENT: usize = 4;

/// The paragraphs; left out where it would say nothing that is not plain.
pub(crate) fn inputs(report: &Report, page: &mut Page) {
    let Some(inputs) = &report.inputs else { return };
    let title = format!("Motors ({}): ", cite::INPUT);
    for (index, (text, tint)) in sentences(report, inputs, limit(page)).iter().enumerate() {
        let lead = if index == 0 { title.as_str() } else { "" };
        page.paragraph(&format!("{lead}{text}"), *tint, "", "");
    }
}

fn sentences(report: &Report, inputs: &Inputs, most: usize) -> Vec<(String, Tint)> {
    let tied = report.size.loops > 0 || report.size.couplings > 0;
    let mut all = Vec::new();
    match inputs.source {
        None => {
            // Of a tree every joint is an input, and one crank is quickly found.
            let useful = report
                .freedoms
                .as_ref()
                .map_or(0, |freedoms| freedoms.useful);
            if !tied || useful < 2 || inputs.proposed.is_empty() {
                return all;
            }
            let text = if inputs.complete {
                format!(
                    "none in the file. Sufficient: {}.",
                    listed(&inputs.proposed, most)
                )
            } else {
                format!(
                    "none in the file. Needed among others: {}.",
                    listed(&inputs.proposed, most)
                )
            };
            all.push((text, Tint::Plain));
            all.extend(dead_centre_together(inputs));
        }
        Some(source) => {
            let incomplete = inputs.left != Some(0) || !inputs.dependent.is_empty();
            if !tied && source != InputSource::Asked && !incomplete {
                return all;
            }
            all.push(verdict(report, inputs, source, most));
            if tied && !inputs.dependent.is_empty() {
                all.push((dependent(inputs, most), Tint::Notable));
            }
            if let (Some(here), Some(independent)) = (inputs.independent_here, inputs.independent)
                && here < independent
            {
                all.push(dead_centre(&here.to_string()));
            }
            if let Some(text) = missing(inputs, most) {
                all.push((text, Tint::Notable));
                all.extend(dead_centre_together(inputs));
            }
        }
    }
    if tied && let Some(text) = limbs(inputs) {
        all.push((text, Tint::Plain));
    }
    all
}

/// That inputs do less at the pose itself than elsewhere.
fn dead_centre(number: &str) -> (String, Tint) {
    let text = format!(
        "Singular for these motors at this pose (parallel singularity): only {number} act independently; locked, they leave an infinitesimal motion."
    );
    (text, Tint::Notable)
}

/// The same of the inputs proposed, with those given, where it was not said of the given ones alone.
fn dead_centre_together(inputs: &Inputs) -> Option<(String, Tint)> {
    let independent = inputs.independent?;
    let lost = independent.saturating_sub(inputs.independent_here?);
    let all = independent + inputs.proposed.len();
    let here = inputs.together_here?;
    (all.saturating_sub(here) > lost).then(|| match inputs.given.len() {
        0 => dead_centre(&here.to_string()),
        _ => dead_centre(&format!("{here} of them all")),
    })
}

fn verdict(report: &Report, inputs: &Inputs, source: InputSource, most: usize) -> (String, Tint) {
    let whose = match source {
        InputSource::Asked => "assumed",
        InputSource::File => "in the file",
        InputSource::Independent => "marked as independent in the file",
    };
    let given = inputs.given.len();
    let list = format!("{given} {whose}: {}", listed(&inputs.given, most));
    match (inputs.independent, inputs.left) {
        (Some(independent), Some(left)) => {
            let how = if independent == given {
                match given {
                    1 => String::new(),
                    _ => "independent, ".to_owned(),
                }
            } else {
                format!("{independent} of them independent, ")
            };
            let shares = report.freedoms.as_ref();
            let does = match (left, shares.map(|shares| (shares.useful, shares.idle))) {
                (0, Some((1, 0))) => "sufficient for the only degree of freedom".to_owned(),
                (0, Some((useful, 0))) => format!("sufficient for all {useful} degrees of freedom"),
                // What the inputs hold beyond the useful degrees of freedom are idle ones.
                (0, Some((useful, idle))) => match (useful + idle).saturating_sub(independent) {
                    0 => format!(
                        "sufficient for all {} degrees of freedom, the idle ones included",
                        useful + idle
                    ),
                    idle => format!(
                        "sufficient for the useful degrees of freedom ({useful}), with {idle} idle left"
                    ),
                },
                (0, None) => "sufficient".to_owned(),
                (1, _) => "1 degree of freedom is left".to_owned(),
                (left, _) => format!("{left} degrees of freedom are left"),
            };
            let good = left == 0 && independent == given;
            let tint = if good { Tint::Good } else { Tint::Notable };
            (format!("{list}; {how}{does}."), tint)
        }
        _ => (
            format!(
                "{list}; whether they are independent and sufficient is undecided: the margin is too thin."
            ),
            Tint::Doubtful,
        ),
    }
}

/// Which inputs others determine.
fn dependent(inputs: &Inputs, most: usize) -> String {
    let tell = |dependent: &DependentInput| match dependent.on.as_deref() {
        Some([]) => format!("`{}` cannot move", dependent.input),
        Some(on) => format!("`{}` follows from {}", dependent.input, quoted(on, most)),
        None => format!("`{}` follows from others", dependent.input),
    };
    let shown = inputs.dependent.len().min(DEPENDENT);
    let mut parts: Vec<String> = inputs.dependent[..shown].iter().map(tell).collect();
    if shown < inputs.dependent.len() {
        parts.push(format!("and {} more", inputs.dependent.len() - shown));
    }
    format!("Dependent: {}.", parts.join("; "))
}

/// What would have to be driven too.
fn missing(inputs: &Inputs, most: usize) -> Option<String> {
    if inputs.left == Some(0) || inputs.proposed.is_empty() {
        return None;
    }
    let list = listed(&inputs.proposed, most);
    Some(if inputs.complete {
        format!("Missing, for example: {list}.")
    } else {
        format!("Missing, among others: {list}.")
    })
}

fn limbs(inputs: &Inputs) -> Option<String> {
    let base = inputs.base.as_ref()?;
    // Limbs of as many freedoms together, in the order of first mention.
    let mut alike: Vec<(&Limb, Vec<String>)> = Vec::new();
    for limb in inputs.limbs.iter().take(LIMBS) {
        let shares = |known: &&Limb| (known.freedom, known.idle) == (limb.freedom, limb.idle);
        let end = match limb.branches {
            true => format!("`{}` and its branches", limb.end),
            false => format!("`{}`", limb.end),
        };
        match alike.iter_mut().find(|(known, _)| shares(known)) {
            Some((_, ends)) => ends.push(end),
            None => alike.push((limb, vec![end])),
        }
    }
    let tell = |(limb, ends): &(&Limb, Vec<String>)| {
        let useful = limb.freedom.saturating_sub(limb.idle);
        let idle = match limb.idle {
            0 => String::new(),
            idle => format!(" + {idle} idle"),
        };
        let each = if ends.len() > 1 { " each" } else { "" };
        format!("{} {useful}{idle}{each}", names(ends, LIMBS))
    };
    let mut parts: Vec<String> = alike.iter().map(tell).collect();
    if inputs.limbs.len() > LIMBS {
        parts.push(format!("and {} more limbs", inputs.limbs.len() - LIMBS));
    }
    let trunk = match inputs.trunk {
        Some(freedom) if freedom > 0 => format!("; the trunk up to `{base}` {freedom}"),
        _ => String::new(),
    };
    Some(format!(
        "Degrees of freedom by limb, seen from `{base}`: {}{trunk}.",
        parts.join("; ")
    ))
}

/// A list; where it is long and not all is asked for, its first in natural order, mirror images together.
fn listed(list: &[String], most: usize) -> String {
    if list.len() <= NAMED || most == usize::MAX {
        return quoted(list, most);
    }
    let mut sorted = list.to_vec();
    sorted.sort_by(|a, b| natural_order(a, b));
    mirrored_runs(&sorted, NAMED)
}

fn quoted(list: &[String], most: usize) -> String {
    let quoted: Vec<String> = list.iter().map(|name| format!("`{name}`")).collect();
    names(&quoted, most)
}
