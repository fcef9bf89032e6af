//! A traced motion drawn: one joint variable over another, and the paths of points of its links.
//!
//! Angles in degrees, lengths in millimetres. Beside the line stand the start, the ends of a motion that is not closed with
//! the reason, and the singular poses on the way.

mod path;
mod plane;

use super::plot::{Axis, Form, Plot, Scale, Series, Value};
use kutzbach_closure::Rigid;
use kutzbach_model::mechanism::Mechanism;
use kutzbach_motion::{EventKind, Motion, Variable};

/// Space around what is drawn, as a share of its size.
const MARGIN: f64 = 0.06;

/// One pose of the motion: all joint variables (rad, m), and `world_from_link` of every link.
struct Pose {
    values: Vec<f64>,
    links: Vec<Rigid<f64>>,
}

/// `y` over `x` (vertical over horizontal axis) along the samples of a motion, in degrees and millimetres.
///
/// A variable that rests gives a straight line. Without samples the plot is empty.
#[must_use]
pub fn relation(mechanism: &Mechanism, motion: &Motion, y: &Variable, x: &Variable) -> Plot {
    let variables = Variable::all(mechanism);
    let column = |wanted: &Variable| variables.iter().position(|known| known == wanted);
    let scale = |wanted: &Variable| match wanted.unit(mechanism) {
        "m" => (1e3, "mm"),
        _ => (1f64.to_degrees(), "°"),
    };
    let [(across, x_unit), (up, y_unit)] = [scale(x), scale(y)];
    let (columns, factors) = ((column(x), column(y)), (across, up));
    let place = |values: &[f64]| -> Option<(f64, f64)> {
        let at = |column: Option<usize>| values.get(column?).copied();
        Some((factors.0 * at(columns.0)?, factors.1 * at(columns.1)?))
    };
    let line: Vec<(f64, f64)> = motion
        .samples
        .iter()
        .filter_map(|sample| place(&sample.values))
        .collect();
    let axis = |name: &str, unit: &str, values: Vec<f64>| {
        Axis::new(format!("{name} ({unit})"), Scale::Linear, around(&values))
    };
    let mut plot = Plot::new(
        format!("{} over {}", y.name, x.name),
        axis(&x.name, x_unit, line.iter().map(|at| at.0).collect()),
        axis(&y.name, y_unit, line.iter().map(|at| at.1).collect()),
    );
    plot.size = [640.0, 400.0];
    plot.series.push(Series::line(&y.name, y_unit, 0, line));
    plot.series
        .extend(landmarks(motion, &|pose| place(&pose.values)));
    plot
}

/// Least and greatest value with a margin; values that agree to nine digits are one.
fn around(values: &[f64]) -> [f64; 2] {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let largest = low.abs().max(high.abs());
    let margin = match high - low <= 1e-9 * largest {
        true => 0.5 * largest.max(f64::MIN_POSITIVE),
        false => MARGIN * (high - low),
    };
    [low - margin, high + margin]
}

/// The start, the ends and the singular poses, as far as the samples go.
fn landmarks(motion: &Motion, place: &dyn Fn(&Pose) -> Option<(f64, f64)>) -> Vec<Series> {
    let arclengths = motion.samples.iter().map(|sample| sample.arclength);
    let (first, last) = arclengths.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| {
        (low.min(at), high.max(at))
    });
    // Rounding must not lose the ends.
    let slack = 1e-9 * (last - first).abs();
    let mut curve = motion.curve.clone();
    let mut values = |wanted: Vec<(f64, String)>| -> Vec<Value> {
        let shown = wanted
            .into_iter()
            .filter(|(at, _)| (first - slack..=last + slack).contains(at));
        shown
            .filter_map(|(at, label)| {
                let found = curve.pose_at_arclength(at)?;
                let states = curve.states(&found.pose);
                let pose = Pose {
                    values: states.into_iter().flat_map(|s| s.values).collect(),
                    links: curve.link_poses(&found.pose),
                };
                let (x, y) = place(&pose)?;
                let label = Some(label);
                Some(Value { x, y, label })
            })
            .collect()
    };
    let starts = values(vec![(0.0, "start".to_owned())]);
    let ends = motion.ends.iter();
    let ends = values(
        ends.map(|end| (end.arclength, end.reason.to_string()))
            .collect(),
    );
    let events = motion.events.iter();
    let singular = events.filter(|event| {
        matches!(
            event.kind,
            EventKind::Singular { .. } | EventKind::Cusp { .. }
        )
    });
    let singular = values(
        singular
            .map(|event| (event.arclength, event.kind.to_string()))
            .collect(),
    );
    [
        ("start", 0, Form::Points, starts),
        ("end", 1, Form::Rings, ends),
        ("singular pose", 6, Form::Rings, singular),
    ]
    .into_iter()
    .filter(|(.., values)| !values.is_empty())
    .map(|(name, colour, form, values)| Series {
        name: name.to_owned(),
        unit: String::new(),
        colour,
        form,
        values,
    })
    .collect()
}
