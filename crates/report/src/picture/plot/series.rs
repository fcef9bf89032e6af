//! Renders data series.

use super::axis::Place;
use super::frame::{Frame, named};
use super::{COLOURS, Form, Plot, Series};
use crate::picture::markup::{escaped, put, px, text_width};

/// A value on the page.
#[derive(Clone, Copy)]
struct Spot {
    x: Place,
    y: Place,
}

impl Spot {
    fn beyond(self) -> bool {
        self.x.beyond != 0 || self.y.beyond != 0
    }
}

/// Writes all series, then the names of points, which no series is to cover.
pub fn write(svg: &mut String, frame: &Frame, plot: &Plot) {
    let bars = BarLayout::new(frame, plot);
    let mut bar_series = 0;
    for series in &plot.series {
        let data = format!(
            "data-name=\"{}\" data-unit=\"{}\"",
            escaped(&series.name),
            escaped(&series.unit)
        );
        let colour = series.colour % COLOURS;
        match series.form {
            Form::Line => line(svg, frame, series, colour, &data),
            Form::Points => points(svg, frame, series, &format!("fill s{colour}"), 3.6, &data),
            Form::Rings => points(svg, frame, series, &format!("hollow s{colour}"), 3.4, &data),
            Form::Bars => {
                bars.write(svg, frame, series, (colour, bar_series), &data);
                bar_series += 1;
            }
        }
    }
    point_names(svg, frame, plot);
}

fn spot(frame: &Frame, x: f64, y: f64) -> Option<Spot> {
    if !(x.is_finite() && y.is_finite()) {
        return None;
    }
    Some(Spot {
        x: frame.x.place(x)?,
        y: frame.y.place(y)?,
    })
}

fn line(svg: &mut String, frame: &Frame, series: &Series, colour: usize, data: &str) {
    let spots: Vec<Option<Spot>> = series
        .values
        .iter()
        .map(|value| spot(frame, value.x, value.y))
        .collect();
    for run in spots.split(|spot| spot.is_none()) {
        let run: Vec<Spot> = run.iter().copied().flatten().collect();
        match run.as_slice() {
            [] => {}
            [alone] => put(
                svg,
                format_args!(
                    "<circle class=\"point fill s{colour}\" {data} cx=\"{}\" cy=\"{}\" r=\"2.4\"/>\n",
                    px(alone.x.at),
                    px(alone.y.at)
                ),
            ),
            run => {
                let points: Vec<String> = run
                    .iter()
                    .map(|s| format!("{},{}", px(s.x.at), px(s.y.at)))
                    .collect();
                put(
                    svg,
                    format_args!(
                        "<polyline class=\"series s{colour}\" {data} points=\"{}\"/>\n",
                        points.join(" ")
                    ),
                );
            }
        }
        for outside in run.chunk_by(|a, b| a.y.beyond == b.y.beyond) {
            if let ([first, ..], [.., last]) = (outside, outside)
                && first.y.beyond != 0
            {
                beyond(svg, frame, colour, [first.x.at, last.x.at], first.y);
            }
        }
    }
}

/// A bar along the border where values lie beyond it, and an arrow that says to which side.
fn beyond(svg: &mut String, frame: &Frame, colour: usize, [from, to]: [f64; 2], y: Place) {
    let middle = 0.5 * (from + to);
    // The arrow's base is on the border, its tip outside.
    let (words, tip) = if y.beyond < 0 {
        ("below the axis", frame.bottom + 6.0)
    } else {
        ("above the axis", frame.top - 6.0)
    };
    let border = px(y.at);
    put(
        svg,
        format_args!(
            "<path class=\"clamped fill s{colour}\" d=\"M{} {border}H{}L{} {}Z\"><title>{words}</title></path>\n",
            px(middle - 4.0),
            px(middle + 4.0),
            px(middle),
            px(tip)
        ),
    );
}

fn points(svg: &mut String, frame: &Frame, series: &Series, class: &str, r: f64, data: &str) {
    for value in &series.values {
        let Some(spot) = spot(frame, value.x, value.y) else {
            continue;
        };
        let outside = if spot.beyond() { " clamped" } else { "" };
        put(
            svg,
            format_args!(
                "<circle class=\"point{outside} {class}\" {data} cx=\"{}\" cy=\"{}\" r=\"{r}\"",
                px(spot.x.at),
                px(spot.y.at)
            ),
        );
        match &value.label {
            Some(label) => put(
                svg,
                format_args!("><title>{}</title></circle>\n", escaped(label)),
            ),
            None => svg.push_str("/>\n"),
        }
        if spot.y.beyond != 0 {
            beyond(svg, frame, series.colour % COLOURS, [spot.x.at; 2], spot.y);
        }
    }
}

/// How wide bars are, and which stands where among several at one place.
struct BarLayout {
    width: f64,
    count: usize,
}

impl BarLayout {
    fn new(frame: &Frame, plot: &Plot) -> Self {
        let bars: Vec<&Series> = plot
            .series
            .iter()
            .filter(|series| series.form == Form::Bars)
            .collect();
        let mut places: Vec<f64> = bars
            .iter()
            .flat_map(|series| &series.values)
            .filter_map(|value| frame.x.place(value.x))
            .map(|place| place.at)
            .collect();
        places.sort_by(f64::total_cmp);
        let closest = places
            .windows(2)
            .map(|pair| pair[1] - pair[0])
            .filter(|distance| *distance > 0.5)
            .fold(60.0, f64::min);
        let count = bars.len().max(1);
        Self {
            width: (0.76 * closest / count as f64).clamp(0.8, 36.0),
            count,
        }
    }

    fn write(
        &self,
        svg: &mut String,
        frame: &Frame,
        series: &Series,
        (colour, position): (usize, usize),
        data: &str,
    ) {
        // Zero, or the border nearest to it.
        let base = frame.y.at(0.0);
        let shift = (position as f64 - 0.5 * self.count as f64) * self.width;
        for value in &series.values {
            let Some(spot) = spot(frame, value.x, value.y) else {
                continue;
            };
            let left = (spot.x.at + shift).max(frame.left);
            let right = (spot.x.at + shift + self.width).min(frame.right);
            let (top, bottom) = (spot.y.at.min(base), spot.y.at.max(base));
            put(
                svg,
                format_args!(
                    "<rect class=\"bar fill s{colour}\" {data} x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"",
                    px(left),
                    px(top),
                    px((right - left).max(0.0)),
                    px(bottom - top)
                ),
            );
            match &value.label {
                Some(label) => put(
                    svg,
                    format_args!("><title>{}</title></rect>\n", escaped(label)),
                ),
                None => svg.push_str("/>\n"),
            }
            if spot.y.beyond != 0 {
                beyond(svg, frame, colour, [left, right], spot.y);
            }
        }
    }
}

/// A rectangle, for finding room: left, top, right, bottom.
type Room = [f64; 4];

fn overlap(a: &Room, b: &Room) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

/// Each name stands at the first of a few places around its point where it covers neither a point nor a name; where there
/// is none it is left to the tooltip.
fn point_names(svg: &mut String, frame: &Frame, plot: &Plot) {
    const SIZE: f64 = 10.5;
    let shown = plot
        .series
        .iter()
        .filter(|series| matches!(series.form, Form::Points | Form::Rings));
    let spots: Vec<(f64, f64, Option<&str>)> = shown
        .flat_map(|series| &series.values)
        .filter_map(|value| {
            let spot = spot(frame, value.x, value.y)?;
            Some((spot.x.at, spot.y.at, value.label.as_deref()))
        })
        .collect();
    let mut taken: Vec<Room> = spots
        .iter()
        .map(|&(x, y, _)| [x - 4.0, y - 4.0, x + 4.0, y + 4.0])
        .collect();
    for &(x, y, label) in &spots {
        let Some(label) = label.filter(|label| !label.is_empty()) else {
            continue;
        };
        let width = text_width(label, SIZE);
        let half = 0.5 * SIZE;
        // Left end and base line of the text.
        let places = [
            (x + 6.5, y + 3.6),
            (x - 6.5 - width, y + 3.6),
            (x - 0.5 * width, y - 7.0),
            (x - 0.5 * width, y + 15.0),
            (x + 5.0, y - 5.0),
            (x + 5.0, y + 12.5),
            (x - 5.0 - width, y - 5.0),
            (x - 5.0 - width, y + 12.5),
        ];
        let room = |(left, base): (f64, f64)| -> Room {
            [left, base - half - 3.6, left + width, base + 2.0]
        };
        let free = places.into_iter().find(|&place| {
            let room = room(place);
            room[0] > frame.left
                && room[2] < frame.size[0] - 2.0
                && room[1] > frame.top - 8.0
                && room[3] < frame.bottom + 2.0
                && !taken.iter().any(|other| overlap(&room, other))
        });
        if let Some(place) = free {
            taken.push(room(place));
            let at = format!("x=\"{}\" y=\"{}\"", px(place.0), px(place.1));
            svg.push_str(&named("point-name", &at, &escaped(label)));
            svg.push('\n');
        }
    }
}
