//! Everything around the data: axes, grid, legend, marks and levels.

use super::axis::{Axis, Ruler};
use super::ticks::{Ticks, superscript};
use super::{COLOURS, Form, Level, Mark, MarkKind, Plot};
use crate::picture::markup::{escaped, put, px, text_width};
use crate::text::clipped;

/// Font sizes of the style (px).
const FONT: f64 = 11.5;
const TICK_FONT: f64 = 10.5;
const SMALL_FONT: f64 = 10.0;
const LEGEND_ROW: f64 = 17.0;
const LEGEND_SAMPLE: f64 = 24.0;
/// Longest name in a legend, in columns; the rest shows when pointed at.
const LONGEST_NAME: usize = 36;
const LONGEST_MARK: usize = 30;

/// Where things are (px).
pub struct Frame {
    pub size: [f64; 2],
    pub left: f64,
    pub right: f64,
    pub top: f64,
    pub bottom: f64,
    pub x: Ruler,
    pub y: Ruler,
    x_ticks: Ticks,
    y_ticks: Ticks,
    /// Of the legend: place and series.
    legend: Vec<(f64, f64, usize)>,
}

impl Frame {
    pub fn new(plot: &Plot) -> Self {
        let sane = |x: f64, least: f64| {
            if x.is_finite() {
                x.clamp(least, 4000.0)
            } else {
                least
            }
        };
        let size = [sane(plot.size[0], 200.0), sane(plot.size[1], 120.0)];
        let [width, height] = size;
        let right = width - 16.0;
        let title = if plot.title.is_empty() { 8.0 } else { 26.0 };
        let (legend, rows) = legend_places(plot, right, title);
        let top = title + LEGEND_ROW * rows as f64 + if rows > 0 { 6.0 } else { 2.0 };
        let under_axis = if plot.x.label.is_empty() { 24.0 } else { 42.0 };
        let bottom = (height - under_axis).max(top + 30.0);
        let y_ticks = plot
            .y
            .ticks((((bottom - top) / 38.0) as usize).clamp(2, 12));
        let widest = y_ticks
            .major
            .iter()
            .map(|(_, text)| text_width(text, TICK_FONT))
            .fold(14.0, f64::max);
        let label = if plot.y.label.is_empty() { 6.0 } else { 24.0 };
        let left = (label + widest + 8.0).min(0.4 * width);
        let x_ticks = plot
            .x
            .ticks((((right - left) / 76.0) as usize).clamp(2, 14));
        Self {
            size,
            left,
            right,
            top,
            bottom,
            x: Ruler::new(&plot.x, [left, right]),
            y: Ruler::new(&plot.y, [bottom, top]),
            x_ticks,
            y_ticks,
            legend,
        }
    }

    /// Grid, border, numbers and what the axes show.
    pub fn write_axes(&self, svg: &mut String, plot: &Plot) {
        let mut minor = String::new();
        let mut major = String::new();
        let (left, right, top, bottom) =
            (px(self.left), px(self.right), px(self.top), px(self.bottom));
        for (ticks, ruler, vertical) in [
            (&self.x_ticks, &self.x, true),
            (&self.y_ticks, &self.y, false),
        ] {
            let line = |path: &mut String, value: f64| {
                let at = px(ruler.at(value));
                if vertical {
                    put(path, format_args!("M{at} {top}V{bottom}"));
                } else {
                    put(path, format_args!("M{left} {at}H{right}"));
                }
            };
            for value in &ticks.minor {
                line(&mut minor, *value);
            }
            for (value, _) in &ticks.major {
                line(&mut major, *value);
            }
        }
        for (class, path) in [("grid minor", minor), ("grid", major)] {
            if !path.is_empty() {
                put(
                    svg,
                    format_args!("<path class=\"{class}\" d=\"{path}\"/>\n"),
                );
            }
        }
        let [low, high] = plot.y.drawn_range();
        if low < 0.0 && high > 0.0 {
            let zero = px(self.y.at(0.0));
            put(
                svg,
                format_args!("<path class=\"grid zero\" d=\"M{left} {zero}H{right}\"/>\n"),
            );
        }
        put(
            svg,
            format_args!("<path class=\"frame\" d=\"M{left} {top}V{bottom}H{right}V{top}Z\"/>\n"),
        );
        for (value, text) in &self.x_ticks.major {
            let at = self.x.at(*value);
            put(
                svg,
                format_args!(
                    "<text class=\"tick middle\" x=\"{}\" y=\"{}\">{text}</text>\n",
                    px(at),
                    px(self.bottom + 14.0)
                ),
            );
        }
        for (value, text) in &self.y_ticks.major {
            let at = self.y.at(*value);
            put(
                svg,
                format_args!(
                    "<text class=\"tick end\" x=\"{}\" y=\"{}\">{text}</text>\n",
                    px(self.left - 6.0),
                    px(at + 3.6)
                ),
            );
        }
        let room = |length: f64| (length / (0.57 * FONT)) as usize;
        let across = label(&plot.x, &self.x_ticks);
        if !across.is_empty() {
            put(
                svg,
                format_args!(
                    "<text class=\"middle\" x=\"{}\" y=\"{}\">{}</text>\n",
                    px(0.5 * (self.left + self.right)),
                    px(self.bottom + 32.0),
                    escaped(&clipped(&across, room(self.right - self.left)))
                ),
            );
        }
        let along = label(&plot.y, &self.y_ticks);
        if !along.is_empty() {
            put(
                svg,
                format_args!(
                    "<text class=\"middle\" transform=\"translate(14 {}) rotate(-90)\">{}</text>\n",
                    px(0.5 * (self.top + self.bottom)),
                    escaped(&clipped(&along, room(self.bottom - self.top + 30.0)))
                ),
            );
        }
    }

    /// Title and legend.
    pub fn write_names(&self, svg: &mut String, plot: &Plot) {
        if !plot.title.is_empty() {
            let room = ((self.right - 8.0) / (0.6 * 13.0)) as usize;
            put(
                svg,
                format_args!(
                    "<text class=\"title\" x=\"8\" y=\"17\">{}</text>\n",
                    escaped(&clipped(&plot.title, room))
                ),
            );
        }
        for &(x, y, index) in &self.legend {
            let series = &plot.series[index];
            let class = series.colour % COLOURS;
            let (from, to) = (px(x), px(x + LEGEND_SAMPLE));
            let middle = px(x + 0.5 * LEGEND_SAMPLE);
            let line = px(y - 4.0);
            svg.push_str("<g class=\"legend\">");
            match series.form {
                Form::Line => put(
                    svg,
                    format_args!("<path class=\"series s{class}\" d=\"M{from} {line}H{to}\"/>"),
                ),
                Form::Points => put(
                    svg,
                    format_args!(
                        "<circle class=\"fill s{class}\" cx=\"{middle}\" cy=\"{line}\" r=\"4\"/>"
                    ),
                ),
                Form::Rings => put(
                    svg,
                    format_args!(
                        "<circle class=\"hollow s{class}\" cx=\"{middle}\" cy=\"{line}\" r=\"3.6\"/>"
                    ),
                ),
                Form::Bars => put(
                    svg,
                    format_args!(
                        "<rect class=\"fill s{class}\" x=\"{}\" y=\"{}\" width=\"10\" height=\"9\"/>",
                        px(x + 0.5 * LEGEND_SAMPLE - 5.0),
                        px(y - 8.5)
                    ),
                ),
            }
            let shown = clipped(&series.name, LONGEST_NAME);
            put(
                svg,
                format_args!(
                    "<text x=\"{}\" y=\"{}\">{}",
                    px(x + LEGEND_SAMPLE + 5.0),
                    px(y),
                    escaped(&shown)
                ),
            );
            if shown != series.name {
                put(
                    svg,
                    format_args!("<title>{}</title>", escaped(&series.name)),
                );
            }
            svg.push_str("</text></g>\n");
        }
    }

    /// Horizontal lines; the name stands above the line at its right end, below it where there is no room above.
    pub fn write_levels(&self, svg: &mut String, levels: &[Level]) {
        for level in levels {
            let Some(place) = self.y.place(level.at).filter(|place| place.beyond == 0) else {
                continue;
            };
            let name = place.at - 4.0;
            let name = if name - SMALL_FONT < self.top {
                place.at + 11.0
            } else {
                name
            };
            let words = escaped(&clipped(&level.label, 2 * LONGEST_MARK));
            put(
                svg,
                format_args!(
                    "<g><title>{}</title><line class=\"level\" x1=\"{}\" y1=\"{y}\" x2=\"{}\" y2=\"{y}\"/>{}</g>\n",
                    escaped(&level.label),
                    px(self.left),
                    px(self.right),
                    named(
                        "end level-name",
                        &format!("x=\"{}\" y=\"{}\"", px(self.right - 5.0), px(name)),
                        &words
                    ),
                    y = px(place.at),
                ),
            );
        }
    }

    /// Vertical lines; the name runs up along the line, left out where its neighbour's is too close.
    pub fn write_marks(&self, svg: &mut String, marks: &[Mark]) {
        let mut places: Vec<(f64, &Mark)> = marks
            .iter()
            .filter_map(|mark| {
                let place = self.x.place(mark.at)?;
                (place.beyond == 0).then_some((place.at, mark))
            })
            .collect();
        places.sort_by(|a, b| a.0.total_cmp(&b.0).then_with(|| a.1.label.cmp(&b.1.label)));
        let mut taken = f64::NEG_INFINITY;
        for (at, mark) in places {
            let (line, text) = match mark.kind {
                MarkKind::Event => ("mark", "mark-name"),
                MarkKind::Singular => ("mark singular", "singular-name"),
            };
            put(
                svg,
                format_args!(
                    "<g><title>{}</title><line class=\"{line}\" x1=\"{x}\" y1=\"{}\" x2=\"{x}\" y2=\"{}\"/>",
                    escaped(&mark.label),
                    px(self.top),
                    px(self.bottom),
                    x = px(at),
                ),
            );
            // To the left of the line, to the right of it at the left border.
            let beside = if at - self.left < 1.5 * SMALL_FONT {
                at + 10.0
            } else {
                at - 3.0
            };
            let room = ((self.bottom - self.top - 8.0) / (0.57 * SMALL_FONT)) as usize;
            if !mark.label.is_empty() && beside - taken > 11.0 {
                taken = beside;
                let words = escaped(&clipped(&mark.label, room.min(LONGEST_MARK)));
                let place = format!(
                    "transform=\"translate({} {}) rotate(-90)\"",
                    px(beside),
                    px(self.top + 4.0)
                );
                svg.push_str(&named(&format!("end {text}"), &place, &words));
            }
            svg.push_str("</g>\n");
        }
    }
}

/// A text with a halo behind it: a text of its own, since not every viewer knows `paint-order`.
pub fn named(class: &str, place: &str, words: &str) -> String {
    format!(
        "<text class=\"{class} halo\" {place} aria-hidden=\"true\">{words}</text><text class=\"{class}\" {place}>{words}</text>"
    )
}

fn label(axis: &Axis, ticks: &Ticks) -> String {
    match ticks.power {
        0 => axis.label.clone(),
        power => format!("{} (\u{d7} 10{})", axis.label, superscript(power)),
    }
}

/// Where the legend's entries stand, and how many rows they take. A single series under a title needs none.
fn legend_places(plot: &Plot, right: f64, top: f64) -> (Vec<(f64, f64, usize)>, usize) {
    let mut places = Vec::new();
    let mut named: Vec<usize> = Vec::new();
    for (index, series) in plot.series.iter().enumerate() {
        // Series that are one thing drawn twice, as line and points, are named once.
        let same = |&other: &usize| {
            let other = &plot.series[other];
            other.name == series.name && other.colour == series.colour
        };
        if !series.name.is_empty() && !named.iter().any(same) {
            named.push(index);
        }
    }
    if plot.series.len() < 2 {
        named.clear();
    }
    let left = 10.0;
    let (mut x, mut row) = (left, 0);
    for index in named {
        let shown = clipped(&plot.series[index].name, LONGEST_NAME);
        let width = LEGEND_SAMPLE + 5.0 + text_width(&shown, FONT) + 16.0;
        if x > left && x + width - 16.0 > right {
            x = left;
            row += 1;
        }
        places.push((x, top + LEGEND_ROW * row as f64 + 12.0, index));
        x += width;
    }
    let rows = if places.is_empty() { 0 } else { row + 1 };
    (places, rows)
}
