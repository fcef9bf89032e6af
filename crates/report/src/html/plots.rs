//! What is read off a rank, a motion and a simulation.

use super::escape::escaped;
use super::motions::Played;
use super::stage::{Facts, Stage};
use crate::picture::plot::{Axis, Form, Level, Mark, MarkKind, Plot, Scale, Series};
use crate::text::words::{counted, figure};
use kutzbach_closure::jacobian;
use kutzbach_math::matrix::relative_singular_values;
use kutzbach_mobility::PartRank;
use kutzbach_motion::{EventKind, Variable};
use kutzbach_simulate::verification::{Outcome, Verification};

/// All singular values are computed up to this many unknowns: their number is that of the bars, their cost its cube.
const MOST_UNKNOWNS: usize = 160;

/// Along a motion they are computed up to this many, some hundred times.
const FOLLOWED_UNKNOWNS: usize = 40;

/// Along a motion, singular values below this share of the largest are zero: poses are closed to 1e-12, and what vanishes at
/// a pose passed by interpolation does so to its square root.
const SINGULAR: f64 = 1e-6;

/// Blocks whose singular values are shown.
const MOST_BLOCKS: usize = 4;

/// Variables in one plot; more lines nobody tells apart.
const MOST_VARIABLES: usize = 12;

/// Singular values below this share of the largest are drawn there: rounding, whose digits differ from machine to machine.
const LEAST: f64 = 1e-17;

/// All plots, in the order of the questions: how sure is the rank; how does it move; what does simulation say.
pub(super) fn section(facts: &Facts<'_>, stage: &Stage, out: &mut String) {
    let mut inner = String::new();
    spectra(facts, &mut inner);
    for (index, played) in stage.repertoire.played.iter().enumerate() {
        inner.push_str(&format!(
            "<div class=\"motion-plots\" data-motion=\"{index}\"{}>\n<h3>Branch {}, driven by <code>{}</code></h3>\n",
            if index == 0 { "" } else { " hidden" },
            escaped(&played.motion.branch),
            escaped(played.drives.first().map_or("", |drive| &drive.name))
        ));
        motion_plots(facts, stage, played, &mut inner);
        inner.push_str("</div>\n");
    }
    if let Some(verification) = facts.verification {
        simulation(verification, &mut inner);
    }
    if !inner.is_empty() {
        out.push_str(&format!(
            "<section id=\"plots\">\n<h2>Figures</h2>\n{inner}</section>\n"
        ));
    }
}

fn figure_of(plot: &Plot, caption: &str, out: &mut String) {
    out.push_str(&format!(
        "<figure class=\"scroll\">{}<figcaption>{}</figcaption></figure>\n",
        plot.fragment(),
        super::blocks::prose(caption)
    ));
}

/// The singular values of the blocks with the thinnest margins, and below what they count as zero.
fn spectra(facts: &Facts<'_>, out: &mut String) {
    let analysis = facts.analysis;
    let mut blocks: Vec<(&PartRank, &str)> = analysis
        .parts
        .iter()
        .zip(&analysis.structure.parts)
        .filter(|(rank, _)| rank.unknowns() > 0 && rank.equations() > 0)
        .map(|(rank, part)| {
            let first = part.joints.first();
            let name = first.map_or("", |&joint| analysis.structure.graph.edge_name(joint));
            (rank, name)
        })
        .collect();
    let several = blocks.len() > 1;
    let margin =
        |rank: &PartRank| rank.decision.kept / rank.decision.tolerance.max(f64::MIN_POSITIVE);
    blocks.sort_by(|a, b| margin(a.0).total_cmp(&margin(b.0)));
    for (rank, name) in blocks.into_iter().take(MOST_BLOCKS) {
        let of_block = match several {
            true => format!(" of the block of `{name}`"),
            false => String::new(),
        };
        let decision = &rank.decision;
        if rank.unknowns() > MOST_UNKNOWNS {
            out.push_str(&format!(
                "<p>{}</p>\n",
                super::blocks::prose(&format!(
                    "The singular values{of_block} are not drawn: it has {}. The smallest kept is estimated as {} of the \
                     largest, those dropped as {} at most; below {} counts as zero.",
                    counted(rank.unknowns(), "unknown"),
                    figure(decision.kept),
                    figure(decision.dropped),
                    figure(decision.tolerance)
                ))
            ));
            continue;
        }
        let Ok(Some(mut values)) = relative_singular_values(&rank.matrix) else {
            continue;
        };
        // Unknowns that no equation is left for are as free as those whose value is zero.
        values.resize(rank.unknowns(), 0.0);
        let least = values.iter().copied().fold(decision.tolerance, f64::min);
        let plot_title = format!("Singular values{}", of_block.replace('`', ""));
        let mut plot = Plot::new(
            plot_title,
            Axis::new("number", Scale::Linear, [0.0, values.len() as f64 + 1.0]),
            Axis::new(
                "relative to the largest",
                Scale::Log,
                [(0.1 * least).clamp(LEAST, 0.1), 2.0],
            ),
        );
        let kept = decision.rank.unwrap_or(decision.candidates.0);
        for (name, colour, range) in [("kept", 0, 0..kept), ("dropped", 1, kept..values.len())] {
            let points =
                range.filter_map(|i| values.get(i).map(|v| (i as f64 + 1.0, v.max(LEAST))));
            let mut series = Series::line(name, "", colour, points);
            series.form = Form::Bars;
            if !series.values.is_empty() {
                plot.series.push(series);
            }
        }
        plot.levels.push(Level {
            at: decision.tolerance,
            label: "counts as zero".to_owned(),
        });
        let mut caption = format!(
            "Each bar is a singular value of the closure equations{of_block} at this pose; those below the line count as \
             zero, and each of them is a freedom (D3)."
        );
        if rank.bits > 53 {
            caption.push_str(&format!(
                " Drawn as double precision sees them; decided with {} bits.",
                rank.bits
            ));
        }
        figure_of(&plot, &caption, out);
    }
}

fn motion_plots(facts: &Facts<'_>, stage: &Stage, played: &Played, out: &mut String) {
    let mechanism = facts.mechanism;
    let variables = Variable::all(mechanism);
    let moving: Vec<usize> = played
        .motion
        .ranges
        .iter()
        .filter(|range| range.moves)
        .filter_map(|range| variables.iter().position(|v| *v == range.variable))
        .collect();
    let (Some(first), Some(last)) = (played.poses.first(), played.poses.last()) else {
        return;
    };
    let span = [first.arclength, last.arclength];
    let arclength = || Axis::new("arclength along the motion", Scale::Linear, span);
    for (unit, shown, label) in [
        ("rad", "°", "joint angle (°)"),
        ("m", "m", "joint travel (m)"),
    ] {
        let factor = if unit == "rad" {
            1f64.to_degrees()
        } else {
            1.0
        };
        let columns: Vec<usize> = moving
            .iter()
            .copied()
            .filter(|&c| variables[c].unit(mechanism) == unit)
            .collect();
        if columns.is_empty() {
            continue;
        }
        let series: Vec<Series> = columns
            .iter()
            .take(MOST_VARIABLES)
            .enumerate()
            .map(|(colour, &column)| {
                let values = played
                    .poses
                    .iter()
                    .map(|pose| (pose.arclength, factor * pose.values[column]));
                Series::line(&variables[column].name, shown, colour, values)
            })
            .collect();
        let all = series.iter().flat_map(|s| s.values.iter().map(|v| v.y));
        let mut plot = Plot::new("", arclength(), Axis::around(label, Scale::Linear, all));
        plot.series = series;
        plot.marks = marks(played, &|kind| {
            !matches!(kind, EventKind::DeadCentre { .. })
        });
        plot.follows_arclength = true;
        let mut caption = "Joint variables along the motion (D1).".to_owned();
        if columns.len() > MOST_VARIABLES {
            caption.push_str(&format!(
                " {} of {}: the first by name.",
                MOST_VARIABLES,
                columns.len()
            ));
        }
        figure_of(&plot, &caption, out);
    }
    let least = least_singular_values(facts, stage, played);
    let (values, caption) = match least {
        Some(values) => (
            values,
            "The smallest singular value of the closure equations that does not vanish all along the motion, relative to the \
             largest: where it goes to zero the pose is singular (D6), and near there a pose is known less well than its loops \
             close.",
        ),
        None => (
            played
                .motion
                .curve
                .margins()
                .filter(|(arclength, _)| (span[0]..=span[1]).contains(arclength))
                .collect(),
            "The smallest singular value that the equations chosen for following the motion keep, with what is held: where it \
             goes to zero the pose is singular (D6).",
        ),
    };
    if values.is_empty() {
        return;
    }
    let positive = values.iter().map(|(_, value)| value.max(SINGULAR));
    let axis = Axis::around("smallest singular value", Scale::Log, positive);
    let mut plot = Plot::new("", arclength(), axis);
    let line = Series::line("smallest singular value", "", 0, values);
    plot.series.push(line);
    plot.marks = marks(played, &|kind| {
        matches!(kind, EventKind::Singular { .. } | EventKind::Cusp { .. })
    });
    plot.follows_arclength = true;
    figure_of(&plot, caption, out);
}

/// At every pose shown: the singular value of the moving part's equations whose number is their rank along the motion,
/// relative to the largest. `None` where the part is too large for that.
fn least_singular_values(
    facts: &Facts<'_>,
    stage: &Stage,
    played: &Played,
) -> Option<Vec<(f64, f64)>> {
    let driven = played.motion.driven.joint;
    let mut parts = facts.analysis.structure.parts.iter();
    let part = parts.find(|part| part.joints.contains(&driven))?;
    let mut spectra = Vec::with_capacity(played.poses.len());
    for pose in &played.poses {
        let linearised = jacobian(facts.mechanism, &stage.geometry, &pose.states, part).ok()?;
        let mut matrix = linearised.matrix;
        if matrix.columns() > FOLLOWED_UNKNOWNS {
            return None;
        }
        matrix.scale_columns();
        spectra.push((pose.arclength, relative_singular_values(&matrix).ok()??));
    }
    let rank = |values: &Vec<f64>| values.iter().filter(|value| **value > SINGULAR).count();
    let rank = spectra.iter().map(|(_, values)| rank(values)).max()?;
    let last = rank.checked_sub(1)?;
    spectra
        .into_iter()
        .map(|(arclength, values)| Some((arclength, *values.get(last)?)))
        .collect()
}

fn marks(played: &Played, wanted: &dyn Fn(&EventKind) -> bool) -> Vec<Mark> {
    let events = played.motion.events.iter().filter(|e| wanted(&e.kind));
    events
        .map(|event| Mark {
            at: event.arclength,
            label: event.kind.to_string(),
            kind: match event.kind {
                EventKind::Singular { .. } | EventKind::Cusp { .. } => MarkKind::Singular,
                EventKind::DeadCentre { .. } | EventKind::JointLimit { .. } => MarkKind::Event,
            },
        })
        .collect()
}

/// Closure error against substeps, branch by branch, and what follows of it.
fn simulation(verification: &Verification, out: &mut String) {
    let finding = &verification.finding;
    let class = match finding.outcome {
        Outcome::Confirmed => "good",
        Outcome::Contradicted => "bad",
        Outcome::Inconclusive => "doubtful",
    };
    out.push_str(&format!(
        "<h3>Simulation</h3>\n<p class=\"{class}\">The physics engine says: {}. {}</p>\n",
        finding.outcome.word(),
        super::blocks::prose(&finding.why)
    ));
    let mut series = Vec::new();
    for branch in &verification.branches {
        for ladder in &branch.ladders {
            let rungs = ladder.rungs.iter();
            let points = rungs.map(|rung| (rung.substeps as f64, rung.closure_error));
            let name = format!(
                "{}, {} driven, {}",
                branch.branch,
                ladder.driven,
                ladder.solver.word()
            );
            series.push(Series::line(name, "", series.len(), points));
        }
    }
    if series.iter().all(|s| s.values.is_empty()) {
        return;
    }
    let (mut x, mut y) = (Vec::new(), Vec::new());
    for value in series.iter().flat_map(|s| &s.values) {
        x.push(value.x);
        y.push(value.y);
    }
    let mut plot = Plot::new(
        "",
        Axis::around("substeps of a step", Scale::Log, x),
        Axis::around("closure error (lengths, rad)", Scale::Log, y),
    );
    plot.series = series;
    figure_of(
        &plot,
        "How far the simulated loops are from closing, over the number of substeps. Where a motion is real, the error falls \
         as their square; where it levels off, what is left is a defect of the geometry.",
        out,
    );
}
