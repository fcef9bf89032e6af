//! The picture: errors over time, and below it the ways to the answer.
//!
//! Above, both axes are logarithmic: how far off a pose is, over the time that a second of motion takes. Simulations and
//! traces differ in shape and colour, and a line joins what nothing beats. Below, a row for each way of the analysis, its
//! point at the time it takes, and beside it in words what it says: an analysis is right or open, and has no error in
//! lengths.

use super::tables::step_text;
use crate::picture::markup::{escaped, put, px};
use crate::picture::plot::{Axis, Form, Level, Mark, MarkKind, Plot, STYLE, Scale, Series, Value};
use crate::text::clipped;
use crate::text::words::duration;
use kutzbach_simulate::accuracy::{Accuracy, Claim, Setting, Way};
use kutzbach_simulate::{Integrator, Solver};

/// Width of the picture and height of the plot in it (px).
const WIDTH: f64 = 860.0;
const PLOT: f64 = 430.0;

/// The rows below: where they begin under the plot, how high each is, where their columns are (px).
const ROWS_FROM: f64 = 56.0;
const ROW: f64 = 19.0;
const NAMES: f64 = 190.0;
const TIMES: [f64; 2] = [204.0, 500.0];
const WORDS: f64 = 516.0;

/// Poses of a trace for a second of motion.
const POSES: f64 = 240.0;

/// Errors below this are drawn there: rounding, whose digits say nothing.
const LEAST: f64 = 1e-17;

/// The picture of one mechanism.
#[derive(Clone, Debug)]
pub struct Figure<'a> {
    accuracy: &'a Accuracy,
    title: String,
}

/// The picture of what was measured.
#[must_use]
pub fn figure(accuracy: &Accuracy) -> Figure<'_> {
    Figure {
        title: format!("{}: what accuracy costs", accuracy.mechanism),
        accuracy,
    }
}

impl Figure<'_> {
    /// With another title.
    #[must_use]
    pub fn titled(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// The picture as a file of its own, for light and dark screens.
    #[must_use]
    pub fn document(&self) -> String {
        self.write(true)
    }

    /// The picture as an element for a page that includes the style of plots.
    #[must_use]
    pub fn fragment(&self) -> String {
        self.write(false)
    }

    fn write(&self, alone: bool) -> String {
        let plot = self.plot();
        let top = plot.as_ref().map_or(8.0, |_| PLOT);
        let ways = &self.accuracy.analysis;
        let height = top + ROWS_FROM + ROW * ways.len() as f64 + 40.0;
        let spoken = format!(
            "{}: error over the time for a second of motion, for simulations and traces; below, the time of every way to know \
             how it can move",
            self.title
        );
        let mut svg = String::new();
        let (namespace, style) = if alone {
            (
                " xmlns=\"http://www.w3.org/2000/svg\"",
                format!(
                    "<title>{}</title>\n<style>{STYLE}</style>\n<rect class=\"back\" width=\"100%\" height=\"100%\"/>\n",
                    escaped(&spoken)
                ),
            )
        } else {
            ("", String::new())
        };
        put(
            &mut svg,
            format_args!(
                "<svg{namespace} class=\"plot\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" role=\"img\" aria-label=\"{}\"{}>\n{style}",
                escaped(&spoken),
                plot.as_ref().map_or(String::new(), Plot::scale_attributes),
                w = px(WIDTH),
                h = px(height),
            ),
        );
        if let Some(plot) = &plot {
            plot.write_content(&mut svg);
            put(
                &mut svg,
                format_args!(
                    "<text class=\"note end\" x=\"{}\" y=\"17\">beside points: length of a step \u{f7} its substeps; tolerance of a trace</text>\n",
                    px(WIDTH - 16.0)
                ),
            );
        }
        put(
            &mut svg,
            format_args!("<g transform=\"translate(0 {})\">\n", px(top)),
        );
        rows(&mut svg, ways);
        svg.push_str("</g>\n</svg>\n");
        svg
    }

    /// The upper part; `None` where neither trace nor simulation was measured.
    fn plot(&self) -> Option<Plot> {
        let accuracy = self.accuracy;
        let (settings, predicted) = match &accuracy.scene {
            Some(scene) if accuracy.simulation.rows.is_empty() => (&scene.rows, false),
            _ => (&accuracy.simulation.rows, true),
        };
        let scene = scene_series(accuracy);
        let point = |row: &Setting| Some((row.seconds()?, row.error()?.max(LEAST)));
        let traced: Vec<(f64, f64, String)> = accuracy
            .motion
            .rows
            .iter()
            .filter(|row| row.timing.poses_per_second > 0.0)
            .map(|row| {
                (
                    POSES / row.timing.poses_per_second,
                    row.error().max(LEAST),
                    format!("{:.0e}", row.tolerance),
                )
            })
            .collect();
        let all: Vec<(f64, f64)> = settings
            .iter()
            .filter_map(point)
            .chain(traced.iter().map(|(x, y, _)| (*x, *y)))
            .chain(scene.iter().flat_map(|s| &s.values).map(|v| (v.x, v.y)))
            .collect();
        if all.is_empty() {
            return None;
        }
        let error = if predicted {
            "largest error (characteristic lengths, rad)"
        } else {
            "closure error (characteristic lengths, rad)"
        };
        let mut plot = Plot::new(
            self.title.clone(),
            Axis::around(
                "time on the clock for one second of motion (s)",
                Scale::Log,
                all.iter().map(|p| p.0),
            ),
            Axis::around(error, Scale::Log, all.iter().map(|p| p.1)),
        );
        plot.size = [WIDTH, PLOT];
        let mut front: Vec<(f64, f64)> = settings
            .iter()
            .filter(|row| row.timing.is_some_and(|timing| timing.pareto))
            .filter_map(point)
            .collect();
        front.sort_by(|a, b| a.0.total_cmp(&b.0));
        if front.len() > 1 {
            plot.series.push(Series::line(
                "Pareto front of the simulations",
                "",
                7,
                front,
            ));
        }
        for (solver, name, colour, form) in [
            (Solver::Multibody, "simulated: multibody", 0, Form::Points),
            (Solver::Impulse, "simulated: impulses", 1, Form::Rings),
        ] {
            let values: Vec<Value> = settings
                .iter()
                .filter(|row| row.solver == solver)
                .filter_map(|row| {
                    let (x, y) = point(row)?;
                    let on_front = row.timing.is_some_and(|timing| timing.pareto);
                    let label = on_front
                        .then(|| format!("{} \u{f7} {}", step_text(row.time_step), row.substeps));
                    Some(Value { x, y, label })
                })
                .collect();
            if !values.is_empty() {
                plot.series.push(Series {
                    name: name.to_owned(),
                    unit: String::new(),
                    colour,
                    form,
                    values,
                });
            }
        }
        if !traced.is_empty() {
            plot.series.push(Series {
                name: "traced: 240 poses".to_owned(),
                unit: String::new(),
                colour: 2,
                form: Form::Points,
                values: traced
                    .into_iter()
                    .map(|(x, y, label)| Value {
                        x,
                        y,
                        label: Some(label),
                    })
                    .collect(),
            });
        }
        plot.series.extend(scene);
        // At the border the line would be no line.
        let [first, last] = plot.x.drawn_range();
        if first < 0.99 && last > 1.01 {
            plot.marks.push(Mark {
                at: 1.0,
                label: "as slow as the motion itself".to_owned(),
                kind: MarkKind::Event,
            });
        }
        if let Some(choice) = &accuracy.choice {
            plot.levels.push(Level {
                at: choice.wanted,
                label: format!("wanted: {:.0e}", choice.wanted),
            });
        }
        Some(plot)
    }
}

/// How far the motion of the file's scene is off, by the time that it takes: a line for every integrator that serves it.
fn scene_series(accuracy: &Accuracy) -> Vec<Series> {
    let steps = || accuracy.scene.iter().flat_map(|scene| &scene.steps);
    [
        (Integrator::RungeKutta, "the scene: Runge-Kutta", 3),
        (Integrator::Engine, "the scene: engine", 4),
    ]
    .into_iter()
    .filter_map(|(integrator, name, colour)| {
        let values: Vec<Value> = steps()
            .filter(|row| row.integrator == integrator && row.timing.seconds_per_second > 0.0)
            .filter_map(|row| {
                Some(Value {
                    x: row.timing.seconds_per_second,
                    y: row.off?.max(LEAST),
                    label: Some(step_text(row.time_step)),
                })
            })
            .collect();
        (!values.is_empty()).then(|| Series {
            name: name.to_owned(),
            unit: String::new(),
            colour,
            form: Form::Points,
            values,
        })
    })
    .collect()
}

/// How a claim is drawn, and what it is called in the legend.
fn look(claim: Claim) -> (&'static str, &'static str) {
    match claim {
        Claim::Decides => ("fill s2", "decides the freedom"),
        Claim::Bounds => ("hollow s0", "bounds it"),
        Claim::Equal | Claim::Silent | Claim::Open => ("hollow s7", "says nothing certain"),
        Claim::Wrong => ("fill s6", "gives another number"),
    }
}

/// The rows of the analysis, under their own axis of time.
fn rows(svg: &mut String, ways: &[Way]) {
    if ways.is_empty() {
        return;
    }
    let asked = ways.iter().filter(|way| way.timing.runs > 0);
    let times = asked.map(|way| way.timing.seconds.max(1e-9));
    let (low, high) = times.fold((f64::INFINITY, 0.0f64), |(low, high), t| {
        (low.min(t), high.max(t))
    });
    let (from, to) = (low.log10().floor(), high.log10().ceil());
    let to = to.max(from + 1.0);
    let [left, right] = TIMES;
    let at =
        |seconds: f64| left + (right - left) * (seconds.max(1e-9).log10() - from) / (to - from);
    put(
        svg,
        format_args!(
            "<text class=\"title\" x=\"8\" y=\"16\">How can it move: what every way to the answer takes</text>\n"
        ),
    );
    legend(svg, ways);
    let bottom = ROWS_FROM + ROW * ways.len() as f64;
    for power in from as i32..=to as i32 {
        let x = px(at(10f64.powi(power)));
        put(
            svg,
            format_args!(
                "<path class=\"grid\" d=\"M{x} {}V{}\"/>\n<text class=\"tick middle\" x=\"{x}\" y=\"{}\">{}</text>\n",
                px(ROWS_FROM - 6.0),
                px(bottom),
                px(bottom + 14.0),
                power_of_seconds(power)
            ),
        );
    }
    for (index, way) in ways.iter().enumerate() {
        let y = ROWS_FROM + ROW * (index as f64 + 0.5);
        let (class, _) = look(way.claim);
        let x = at(way.timing.seconds);
        let name = if way.precision.is_empty() {
            way.name.clone()
        } else {
            format!("{}, {}", way.name, way.precision)
        };
        put(
            svg,
            format_args!(
                "<text class=\"end\" x=\"{}\" y=\"{base}\">{}</text>\n\
                 <text class=\"note\" x=\"{}\" y=\"{base}\">{}</text>\n",
                px(NAMES),
                escaped(&clipped(&name, 28)),
                px(WORDS),
                escaped(&clipped(&claim_text(way), 58)),
                base = px(y + 4.0),
            ),
        );
        if way.timing.runs == 0 {
            continue;
        }
        put(
            svg,
            format_args!(
                "<path class=\"grid zero\" d=\"M{} {y}H{}\"/>\n\
                 <circle class=\"{class}\" cx=\"{}\" cy=\"{y}\" r=\"4\"><title>{}</title></circle>\n",
                px(left),
                px(x),
                px(x),
                escaped(&format!("{}: {}", name, duration(way.timing.seconds))),
                y = px(y),
            ),
        );
    }
    put(
        svg,
        format_args!(
            "<text class=\"middle\" x=\"{}\" y=\"{}\">time on the clock (s)</text>\n",
            px(0.5 * (left + right)),
            px(bottom + 31.0)
        ),
    );
}

fn legend(svg: &mut String, ways: &[Way]) {
    let mut x = 10.0;
    let mut seen: Vec<&str> = Vec::new();
    for claim in [Claim::Decides, Claim::Bounds, Claim::Silent, Claim::Wrong] {
        let (class, words) = look(claim);
        if seen.contains(&words) || !ways.iter().any(|way| look(way.claim).1 == words) {
            continue;
        }
        seen.push(words);
        put(
            svg,
            format_args!(
                "<g class=\"legend\"><circle class=\"{class}\" cx=\"{}\" cy=\"34\" r=\"4\"/><text x=\"{}\" y=\"38\">{words}</text></g>\n",
                px(x + 5.0),
                px(x + 15.0)
            ),
        );
        x += 15.0 + crate::picture::markup::text_width(words, 11.5) + 22.0;
    }
}

/// What a way says, in words.
fn claim_text(way: &Way) -> String {
    let clear = way
        .decades
        .map_or(String::new(), |d| format!(", margin of {d:.0} decades"));
    let certificate = way.certificate.map_or(String::new(), |level| {
        format!(", {} certificate", level.word())
    });
    match way.claim {
        Claim::Decides => format!("{}: decided{clear}{certificate}", way.says),
        Claim::Bounds => format!("{}{clear}", way.says),
        Claim::Equal => format!("{}: right, but proves nothing", way.says),
        Claim::Wrong => format!("{}: not the answer", way.says),
        Claim::Open => format!("{}: not judged, the answer is open", way.says),
        Claim::Silent => way.text.clone(),
    }
}

fn power_of_seconds(power: i32) -> String {
    let (scale, unit) = match power {
        i32::MIN..=-7 => (9, "ns"),
        -6..=-4 => (6, "µs"),
        -3..=-1 => (3, "ms"),
        _ => (0, "s"),
    };
    format!("{} {unit}", 10f64.powi(power + scale).round())
}
