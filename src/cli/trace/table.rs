//! A trace as text.

use crate::cli::units::ValueUnits;
use kutzbach::mechanism::{FreedomPart, Mechanism};
use kutzbach::motion::{Motion, Spacing, Trace, Variable, value_text};
use kutzbach::report::text::visible;
use kutzbach::report::text::words::{degrees, metres};
use kutzbach::report::traced::LinkPoint;
use std::fmt::Write;

/// A mechanism and the units in which its values are told.
struct Told<'a> {
    mechanism: &'a Mechanism,
    units: ValueUnits,
}

impl Told<'_> {
    fn part(&self, variable: &Variable) -> FreedomPart {
        self.mechanism.joints()[variable.joint].kind.freedoms()[variable.freedom]
    }

    fn value(&self, variable: &Variable, value: f64) -> String {
        self.units.value(self.part(variable), value)
    }

    fn unit(&self, variable: &Variable) -> &'static str {
        self.units.of(self.part(variable)).0
    }
}

fn extent(motion: &Motion, told: &Told<'_>) -> String {
    match motion.closed {
        Some(length) => format!(
            "closed curve, one cycle of arclength {}",
            value_text(length)
        ),
        None => {
            let ends: Vec<String> = motion
                .ends
                .iter()
                .map(|end| {
                    format!(
                        "at {} = {}: {}",
                        motion.driven.name,
                        told.value(&motion.driven, end.drive),
                        end.reason
                            .told(&|variable, value| told.value(variable, value))
                    )
                })
                .collect();
            format!("two ends; {}", ends.join("; "))
        }
    }
}

/// A page for a person; `changed` is how far the dimensions are from those written (m), where they are others.
pub fn text(
    mechanism: &Mechanism,
    changed: Option<f64>,
    trace: &Trace,
    points: &[LinkPoint],
    units: ValueUnits,
) -> String {
    let told = Told { mechanism, units };
    let mut page = String::new();
    // Writing into a string does not fail.
    let mut line = |text: String| {
        let _ = writeln!(page, "{}", visible(&text));
    };
    let motion = match trace {
        Trace::Still(still) => {
            line(format!("{}: {}.", mechanism.name(), still.reason));
            return page;
        }
        Trace::Moving(motion) => motion,
    };
    line(format!(
        "{}: branch {} of {}, {}; {}.",
        mechanism.name(),
        motion.branch,
        motion.branches.len(),
        degrees(motion.dimension),
        extent(motion, &told)
    ));
    if let Some(changed) = changed {
        line(format!(
            "  • traced: the nearest dimensions that move, up to {} from those written",
            metres(changed)
        ));
    }
    for note in &motion.notes {
        line(format!("  • {note}"));
    }
    line(format!(
        "  • driven: {} ({})",
        motion.driven.name,
        told.unit(&motion.driven)
    ));
    for held in &motion.held {
        line(format!(
            "  • held: {} = {} {}",
            held.variable.name,
            told.value(&held.variable, held.value),
            told.unit(&held.variable)
        ));
    }
    if !motion.starts_at_home {
        line(
            "  • starts at a generic pose of the branch: the pose analysed is singular".to_owned(),
        );
    }
    for unreached in &motion.unreached {
        line(format!(
            "  • {} = {} is not reached, only {}: {}",
            motion.driven.name,
            told.value(&motion.driven, unreached.wanted),
            told.value(&motion.driven, unreached.reached),
            unreached.reason
        ));
    }
    line(format!(
        "  • {} samples, equidistant in {}; largest closure {} of a loop's length (allowed {:.0e})",
        motion.samples.len(),
        match motion.spacing {
            Spacing::Drive => motion.driven.name.as_str(),
            Spacing::Arclength => "arclength",
        },
        match round_up(motion.largest_closure) {
            0.0 => "0".to_owned(),
            closure => format!("{closure:.0e}"),
        },
        motion.allowed_closure
    ));
    line(String::new());
    if motion.events.is_empty() {
        line("Events: none".to_owned());
    } else {
        line("Events".to_owned());
        let rows: Vec<Vec<String>> = std::iter::once(vec![
            "arclength".to_owned(),
            motion.driven.name.clone(),
            "event".to_owned(),
        ])
        .chain(motion.events.iter().map(|event| {
            vec![
                value_text(event.arclength),
                told.value(&motion.driven, event.drive),
                event
                    .kind
                    .told(&|variable, value| told.value(variable, value)),
            ]
        }))
        .collect();
        aligned(&rows, &[true, true, false])
            .into_iter()
            .for_each(&mut line);
    }
    line(String::new());
    line("Ranges".to_owned());
    let header = [
        "joint",
        "unit",
        "from",
        "to",
        "travel",
        "turns",
        "extreme positions",
    ];
    let rows: Vec<Vec<String>> = std::iter::once(header.map(str::to_owned).to_vec())
        .chain(motion.ranges.iter().map(|range| {
            let mut row = vec![
                range.variable.name.clone(),
                told.unit(&range.variable).to_owned(),
                told.value(&range.variable, range.min),
                told.value(&range.variable, range.max),
                told.value(&range.variable, range.travel),
                range.turns.to_string(),
                range.dead_centres.to_string(),
            ];
            if !range.moves {
                row[4] = "rests".to_owned();
            }
            row
        }))
        .collect();
    aligned(&rows, &[false, false, true, true, true, true, true])
        .into_iter()
        .for_each(&mut line);
    if !points.is_empty() {
        line(String::new());
        let (unit, _) = units.of(FreedomPart::Translation);
        line(format!("Paths of points ({unit})"));
        aligned(&extents(motion, points, units), &[false, false, true, true])
            .into_iter()
            .for_each(&mut line);
    }
    page
}

/// How far the paths of points reach along the axes of the world.
fn extents(motion: &Motion, points: &[LinkPoint], units: ValueUnits) -> Vec<Vec<String>> {
    let mut rows = vec![["point", "axis", "from", "to"].map(str::to_owned).to_vec()];
    for point in points {
        let path = point.path(motion);
        for (index, axis) in ["x", "y", "z"].into_iter().enumerate() {
            let values = || path.iter().map(|at| at[index]);
            rows.push(vec![
                point.name.clone(),
                axis.to_owned(),
                units.value(
                    FreedomPart::Translation,
                    values().fold(f64::INFINITY, f64::min),
                ),
                units.value(
                    FreedomPart::Translation,
                    values().fold(f64::NEG_INFINITY, f64::max),
                ),
            ]);
        }
    }
    rows
}

/// One digit, never below the value: what rounding does to the last bits of a closure is nobody's concern.
fn round_up(value: f64) -> f64 {
    if value > 0.0 {
        10f64.powi(value.log10().ceil() as i32)
    } else {
        0.0
    }
}

fn aligned(rows: &[Vec<String>], right: &[bool]) -> Vec<String> {
    let widths: Vec<usize> = (0..right.len())
        .map(|c| rows.iter().map(|r| r[c].chars().count()).max().unwrap_or(0))
        .collect();
    rows.iter()
        .map(|row| {
            let cells: Vec<String> = row
                .iter()
                .zip(&widths)
                .zip(right)
                .map(|((cell, width), right)| {
                    if *right {
                        format!("{cell:>width$}")
                    } else {
                        format!("{cell:<width$}")
                    }
                })
                .collect();
            format!("  {}", cells.join("  ").trim_end())
        })
        .collect()
}
