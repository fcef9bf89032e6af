//! The play that joints need.

use super::page::Page;
use super::style::Tint;
use super::table::{Cell, Column, Subject, Table};
use super::words::{counted, figure, in_degrees, metres, names, times};
use crate::schema::Play;
use crate::schema::Report;

/// A gap below this (m) needs no play that anybody could make.
const SEEN: f64 = 1e-9;

/// Names in a sentence.
const NAMES: usize = 4;

/// How much play the motion needs, where, and whether a clearance suffices.
pub(super) fn play(report: &Report, page: &mut Page) {
    let Some(play) = &report.play else { return };
    page.heading("Play");
    page.paragraph(&needed(play), Tint::Plain, "  ", "  ");
    if let Some(text) = clearance(play) {
        let tint = if play.passes == Some(true) {
            Tint::Good
        } else {
            Tint::Bad
        };
        page.paragraph(&text, tint, "  ", "  ");
    }
    if play.needed <= SEEN {
        return;
    }
    let mut table = Table::new()
        .column("joint", Column::Shrinking)
        .column("shift", Column::Numbers)
        .column("tilt (°)", Column::Numbers);
    for joint in &play.joints {
        table.row_about(
            Subject::Joint(joint.name.clone()),
            vec![
                Cell::new(&joint.name).tint(Tint::Strong),
                Cell::new(metres(joint.shift)),
                Cell::new(in_degrees(joint.tilt)),
            ],
        );
    }
    page.table(table, "joints");
}

fn needed(play: &Play) -> String {
    let how_far = match play.whole {
        true => "along the whole motion",
        false => "as far as the motion was followed",
    };
    let held = match play.held.is_empty() {
        true => String::new(),
        false => {
            let quoted: Vec<String> = play.held.iter().map(|name| format!("`{name}`")).collect();
            format!(" with {} held", names(&quoted, NAMES))
        }
    };
    if play.needed <= SEEN {
        return format!(
            "None is needed {how_far}{held}: the loops close with the numbers as written."
        );
    }
    let at = match play.angle {
        true => format!("{}°", in_degrees(play.at)),
        false => metres(play.at),
    };
    let left_out = match play.left_out {
        0 => String::new(),
        poses => format!(
            " {} at or beside singular poses left out.",
            counted(poses, "pose")
        ),
    };
    format!(
        "For the motion to go through with the numbers as written, every joint has to give way by {} {how_far}{held}; most at \
         `{}` = {at}, as below. A tilt counts by {} of lever (`--bearing`). To first order in the misfit.{left_out}",
        metres(play.needed),
        play.variable,
        metres(play.arm),
    )
}

fn clearance(play: &Play) -> Option<String> {
    let clearance = metres(play.clearance?);
    let Some(forgiven) = play.forgiven else {
        return Some(format!("A clearance of {clearance} is not needed."));
    };
    Some(match play.passes? {
        true => format!(
            "A clearance of {clearance} suffices, and would for {} this misalignment.",
            times(forgiven)
        ),
        false => format!(
            "A clearance of {clearance} does not suffice: it forgives {} of this misalignment.",
            figure(forgiven)
        ),
    })
}
