//! What the page says of how the loops close.

use super::cite;
use super::page::Page;
use super::sections::{more, rows_of};
use super::style::Tint;
use super::table::{Cell, Column, Subject, Table};
use super::words::{counted, figure, in_degrees, metres, names};
use crate::asked::HOME;
use crate::schema::{Assembly, Gap, JointPlace, Report};
use kutzbach_mobility::Verdict;

/// Joints in the table of those that moved, unless everything is asked for.
const ROWS: usize = 4;

/// Corrections below this (rad, m) are not shown: a hair's breadth seen from ten kilometres.
const SHOWN: f64 = 1e-9;

/// Lists of names in a sentence show this many.
const NAMES: usize = 6;

/// The gap up to which a tolerance of one's own is suggested (m).
const SMALL_GAP: f64 = 1e-3;

/// How the loops close.
pub(crate) fn section(report: &Report, page: &mut Page) {
    let assembly = &report.assembly;
    if report.mobility.verdict == Verdict::Unassembled || assembly.closed == Some(false) {
        open(assembly, page);
        return;
    }
    let moved = assembly.moved.filter(|moved| *moved > 0.0);
    if moved.is_none() && assembly.held.is_empty() && assembly.corrected.is_empty() {
        return;
    }
    page.heading("Assembly");
    if moved.is_some() {
        let mut text = how_far(report);
        let all = farthest_first(&assembly.joints).len();
        if !page.layout().verbose && all > ROWS {
            text.push_str(&format!(" All {all} that moved: `--verbose`."));
        }
        page.paragraph(&text, Tint::Plain, "  ", "  ");
    }
    if let Some(text) = held(assembly) {
        page.paragraph(&text, Tint::Plain, "  ", "  ");
    }
    if !assembly.corrected.is_empty() {
        let text = format!(
            "The loops do not close with the configuration's rounded values as they are: {} corrected.",
            joints_are(&assembly.corrected)
        );
        page.paragraph(&text, Tint::Doubtful, "  ", "  ");
    }
    if moved.is_some() {
        corrections(&assembly.joints, page);
        if let Some(text) = outside(assembly) {
            page.paragraph(&text, Tint::Doubtful, "  ", "  ");
        }
    }
}

/// A closed pose that was not drawn.
fn how_far(report: &Report) -> String {
    let assembly = &report.assembly;
    let drawn = match report.home.configuration.as_str() {
        HOME => "As the file draws it".to_owned(),
        name => format!("With the values of `{name}`"),
    };
    let worst = assembly
        .gaps
        .iter()
        .max_by(|a, b| a.position.total_cmp(&b.position));
    let mut text = match worst {
        Some(gap) => format!(
            "{drawn}, loop `{}` is open by {} and {}°.",
            gap.cycle,
            metres(gap.position),
            in_degrees(gap.angle)
        ),
        None => "The file's pose does not satisfy its couplings.".to_owned(),
    };
    text.push_str(match assembly.dimensions_changed {
        true => " It was closed by moving joints, with the nearest dimensions that move.",
        false => " It was closed by moving joints.",
    });
    text.push_str(" This report is on the closed pose.");
    if let Some(starts) = assembly.starts.filter(|starts| *starts > 1) {
        text.push_str(&format!(
            " From the drawn pose no closing was found, or none within the joint limits: the nearest of {} was used.",
            counted(starts, "start")
        ));
    }
    let farthest = |by: fn(&JointPlace) -> f64| {
        assembly
            .joints
            .iter()
            .max_by(|a, b| by(a).total_cmp(&by(b)))
            .filter(|place| by(place) > SHOWN)
    };
    let turned = farthest(|place| place.turned)
        .map(|place| format!("`{}` by {}°", place.name, in_degrees(place.turned)));
    let shifted = farthest(|place| place.shifted)
        .map(|place| format!("`{}` by {}", place.name, metres(place.shifted)));
    let corrections: Vec<String> = turned.into_iter().chain(shifted).collect();
    if !corrections.is_empty() {
        text.push_str(&format!(" Largest change: {}.", corrections.join(", ")));
    }
    text
}

/// Loops that count as closed and are not, quite: what is said of the mechanism is said of another one.
pub(super) fn left_open(assembly: &Assembly) -> Option<String> {
    if assembly.closed != Some(true) {
        return None;
    }
    let visible = |gap: &&Gap| gap.left_position.max(gap.left_angle) > SHOWN;
    let worst = nearest(assembly).filter(visible)?;
    let others = assembly.gaps.iter().filter(visible).count() - 1;
    let others = match others {
        0 => String::new(),
        1 => " (another one by less)".to_owned(),
        _ => format!(" ({others} others by less)"),
    };
    let source = match assembly.tolerance_asked {
        true => "as `--closure-tolerance` allows",
        false => "since the numbers are stated so coarsely",
    };
    // The tolerance holds where the loop's axes come nearest; at a joint far from there a gap may be larger.
    let there = assembly
        .tolerance
        .filter(|tolerance| *tolerance >= worst.left_position);
    let tolerance = match there {
        Some(tolerance) => format!(": up to {} does, {source}", metres(tolerance)),
        None => format!(", {source}"),
    };
    Some(format!(
        "As written it does not close: loop `{}` stays open by {} and {}°{others}. This counts as closed{tolerance}.",
        worst.cycle,
        metres(worst.left_position),
        in_degrees(worst.left_angle),
    ))
}

fn joints_are(list: &[String]) -> String {
    let quoted: Vec<String> = list.iter().map(|name| format!("`{name}`")).collect();
    let verb = if list.len() == 1 { "was" } else { "were" };
    format!("{} {verb}", names(&quoted, NAMES))
}

fn held(assembly: &Assembly) -> Option<String> {
    if assembly.held.is_empty() {
        return None;
    }
    let quoted: Vec<String> = assembly
        .held
        .iter()
        .map(|name| format!("`{name}`"))
        .collect();
    Some(format!(
        "Held as the configuration says: {}.",
        names(&quoted, NAMES)
    ))
}

fn outside(assembly: &Assembly) -> Option<String> {
    let worst = assembly.outside_limits.first()?;
    let by = if worst.angle {
        format!("{}°", in_degrees(worst.by.abs()))
    } else {
        metres(worst.by.abs())
    };
    let side = if worst.by > 0.0 { "above" } else { "below" };
    let more = match assembly.outside_limits.len() - 1 {
        0 => String::new(),
        more => format!(", and {} more", counted(more, "joint")),
    };
    Some(format!(
        "No closing within the joint limits was found: `{}` is {by} {side} its limit{more}.",
        worst.joint
    ))
}

/// The joints that moved, farthest first.
fn farthest_first(joints: &[JointPlace]) -> Vec<&JointPlace> {
    let mut moved: Vec<&JointPlace> = joints
        .iter()
        .filter(|place| place.correction > SHOWN)
        .collect();
    moved.sort_by(|a, b| b.correction.total_cmp(&a.correction));
    moved
}

/// Their table, which a first screen has where it is short.
fn corrections(joints: &[JointPlace], page: &mut Page) {
    let moved = farthest_first(joints);
    if moved.is_empty() || !page.layout().verbose && moved.len() > ROWS {
        return;
    }
    let mut table = Table::new()
        .column("joint", Column::Shrinking)
        .column("drawn", Column::Numbers)
        .column("assembled", Column::Numbers)
        .column("moved by", Column::Numbers);
    for place in &moved {
        table.row_about(
            Subject::Joint(place.name.clone()),
            vec![
                Cell::new(&place.name).tint(Tint::Strong),
                Cell::new(values(place, &place.drawn)),
                Cell::new(values(place, &place.values)),
                Cell::new(amount(place)),
            ],
        );
    }
    page.table(table, "joints");
}

/// Values of a joint of one freedom in ° or in a unit of length; of others as the configuration of a file has them.
fn values(place: &JointPlace, values: &[f64]) -> String {
    match (values, place.turned > 0.0, place.shifted > 0.0) {
        ([angle], true, false) => format!("{:.4}°", angle.to_degrees() + 0.0),
        ([length], false, true) => metres(*length),
        _ => {
            let list: Vec<String> = values.iter().map(|x| format!("{x:.4}")).collect();
            list.join(" ")
        }
    }
}

fn amount(place: &JointPlace) -> String {
    let turned = (place.turned > SHOWN).then(|| format!("{}°", in_degrees(place.turned)));
    let shifted = (place.shifted > SHOWN).then(|| metres(place.shifted));
    let both: Vec<String> = turned.into_iter().chain(shifted).collect();
    both.join(", ")
}

/// The loops that stay open, and what would help.
fn open(assembly: &Assembly, page: &mut Page) {
    if assembly.gaps.is_empty() {
        return;
    }
    page.heading("Open loops");
    if let Some(text) = held(assembly) {
        page.paragraph(&text, Tint::Plain, "  ", "  ");
    }
    for text in [released(assembly), reversal(assembly), tolerance(assembly)]
        .into_iter()
        .flatten()
    {
        page.paragraph(&text, Tint::Doubtful, "  ", "  ");
    }
    let mut table = Table::new()
        .column("loop", Column::Shrinking)
        .column("gap", Column::Numbers)
        .column("angle (°)", Column::Numbers);
    let mut gaps: Vec<_> = assembly.gaps.iter().collect();
    let all = gaps.len();
    if !page.layout().verbose && rows_of(all) < all {
        gaps.sort_by(|a, b| b.left_position.total_cmp(&a.left_position));
        gaps.truncate(rows_of(all));
    }
    let shown = gaps.len();
    for gap in gaps {
        let subject = Subject::Cycle(gap.cycle.clone());
        table.row_about(
            subject,
            vec![
                Cell::new(&gap.cycle),
                Cell::new(metres(gap.left_position)).tint(Tint::Bad),
                Cell::new(in_degrees(gap.left_angle)),
            ],
        );
    }
    page.table(table, "loops");
    more(all - shown, page);
}

fn released(assembly: &Assembly) -> Option<String> {
    let places = assembly.released.as_ref()?;
    let farthest = places
        .iter()
        .max_by(|a, b| a.correction.total_cmp(&b.correction))?;
    let way = match amount(farthest) {
        none if none.is_empty() => "by less than a nanometre and a nanoradian".to_owned(),
        amount => format!("farthest, by {amount}"),
    };
    Some(format!(
        "Loops with held joints close once these are released: `{}` then moves {way}.",
        farthest.name
    ))
}

fn reversal(assembly: &Assembly) -> Option<String> {
    let reversal = assembly.reversal.as_ref()?;
    let about: Vec<String> = reversal.about.iter().map(|x| figure(*x)).collect();
    Some(format!(
        "The two sides of `{}` point in opposite directions: this loop closes with one of its two frames turned by 180° \
         (the successor's, about its own direction {}), or with the axis reversed where each side states its own.",
        reversal.cycle,
        about.join(" ")
    ))
}

fn tolerance(assembly: &Assembly) -> Option<String> {
    let worst = nearest(assembly)?;
    let (gap, residual) = (worst.left_position, assembly.residual?);
    if !(gap > 0.0 && gap < SMALL_GAP && residual < SMALL_GAP) {
        return None;
    }
    // A power of ten above the gap at the joint, and above that with angles at the lever of the loop.
    let enough = 10f64.powi((3.0 * gap.max(residual)).log10().ceil() as i32);
    Some(format!(
        "If the file is no more precise than that, `--closure-tolerance {enough:e}` (m) takes the gap as closed."
    ))
}

/// The loop that stays open farthest, an angle of 1 rad counting as 1 m.
fn nearest(assembly: &Assembly) -> Option<&Gap> {
    let miss = |gap: &Gap| gap.left_position.max(gap.left_angle);
    assembly
        .gaps
        .iter()
        .max_by(|a, b| miss(a).total_cmp(&miss(b)))
}

/// Measures that are named in the first sentence.
const MOST_MISFITS: usize = 3;

/// Which measures rule a pose out, each by itself; empty where none is known to.
fn misfits(assembly: &Assembly) -> String {
    let all = assembly.misfits.iter().take(MOST_MISFITS).map(|misfit| {
        let needs = misfit.needs.join(" and ");
        match misfit.value {
            Some(value) => format!("`{}` is {}, and {needs} is needed", misfit.measure, value),
            None => format!("for `{}` {needs} is needed", misfit.measure),
        }
    });
    let all: Vec<String> = all.collect();
    match all.is_empty() {
        true => String::new(),
        false => format!(" With the other measures as they are, {}.", all.join("; ")),
    }
}

/// The first sentence on a mechanism without a closed pose: that there is none is said only where it is proved.
pub(super) fn unassembled(assembly: &Assembly) -> String {
    let nearest = nearest(assembly).map(|gap| {
        format!(
            "nearest: {} and {}° at loop `{}`",
            metres(gap.left_position),
            in_degrees(gap.left_angle),
            gap.cycle
        )
    });
    if let Some(proof) = &assembly.proof {
        let nearest = nearest.map_or(String::new(), |nearest| format!(" ({nearest})"));
        return format!(
            "Does not assemble ({}): no pose closes it, since {proof}{nearest}, so there is no pose to analyse.{}",
            cite::ASSEMBLED,
            misfits(assembly)
        );
    }
    let starts = assembly
        .starts
        .map_or(String::new(), |n| format!(" after {}", counted(n, "start")));
    let held = match assembly.held.len() {
        0 => String::new(),
        count => format!(" with {} held", counted(count, "joint")),
    };
    let limited = match assembly.work_limited {
        true => ", the work allowed for a mechanism of this size",
        false => "",
    };
    let nearest = nearest.map_or(String::new(), |nearest| format!(" ({nearest})"));
    format!(
        "No closing found ({}){starts}{held}{limited}{nearest}: that there is none is not proved. There is no pose to analyse.",
        cite::ASSEMBLED
    )
}
