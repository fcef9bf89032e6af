//! Four-bar linkages, a line each.

use super::page::Page;
use super::style::{Tint, Units};
use super::words::figure;
use crate::schema::Report;
use kutzbach_motion::{FourBar, GrashofClass, Swing};

/// Linkages of a first screen.
const SHOWN: usize = 3;

/// What each of them is, how far its links go, and how well it transmits.
pub(crate) fn four_bars(report: &Report, units: Units, page: &mut Page) {
    let shown = match page.layout().verbose {
        true => report.four_bars.len(),
        false => SHOWN,
    };
    for bar in report.four_bars.iter().take(shown) {
        page.paragraph(&told(bar, units), Tint::Plain, "  ", "    ");
    }
}

fn told(bar: &FourBar, units: Units) -> String {
    let class = match bar.class {
        GrashofClass::Grashof => "Grashof",
        GrashofClass::ChangePoint => "change point: all links can be in line",
        GrashofClass::NonGrashof => "not Grashof",
    };
    let swings: Vec<String> = bar.swings.iter().map(|one| swing(one, units)).collect();
    let what = match bar.without_limits {
        None => bar.kind.word().to_owned(),
        Some(kind) => format!(
            "{} by its lengths, stopped by the limit of {}",
            kind.word(),
            bar.stopped_by.join(" and that of ")
        ),
    };
    let which = match bar.within_larger {
        true => format!(
            "four-bar of {}, {} and {}",
            bar.links[1], bar.links[2], bar.links[3]
        ),
        false => "four-bar".to_owned(),
    };
    format!(
        "{which}: {what} ({class}); {}; transmission angle {}, driven at {}{}",
        swings.join(", "),
        between(bar.transmission, units),
        bar.swings[0].joint,
        if bar.within_larger {
            "; as far as the other loops let it"
        } else {
            ""
        }
    )
}

/// `crank turns fully`, `rocker swings by 66.3°`: between which values its joint goes, the table of joints says from where that is counted.
fn swing(one: &Swing, units: Units) -> String {
    match one.extremes {
        None => format!("{} turns fully", one.link),
        Some([from, to]) => format!("{} swings by {}", one.link, angle(to - from, units)),
    }
}

fn between([from, to]: [f64; 2], units: Units) -> String {
    let (factor, _) = scale(units);
    format!("{} … {}", figure(factor * from), angle(to, units))
}

fn angle(angle: f64, units: Units) -> String {
    let (factor, unit) = scale(units);
    format!("{}{unit}", figure(factor * angle))
}

fn scale(units: Units) -> (f64, &'static str) {
    match units {
        Units::Drawing => (180.0 / std::f64::consts::PI, "°"),
        Units::Si => (1.0, " rad"),
    }
}
