//! Curves, points and bars over two axes.
//!
//! A [`Plot`] is data; [`Plot::fragment`] writes it for a page that includes [`STYLE`], [`Plot::document`] as a file of its
//! own. The fragment tells a script how to get back from pixels to values: `data-x` and `data-y` hold the range, the scale
//! and the pixels of its ends, and whatever stands for values has `data-name` and `data-unit`.

mod axis;
mod frame;
mod series;
mod sheet;
mod ticks;

pub use axis::{Axis, Scale};
pub use sheet::sheet;
pub(crate) use ticks::{decades, power_of_ten};

use super::markup::{escaped, put, px};
use frame::Frame;

/// The style of plots, all of it below `svg.plot`.
pub const STYLE: &str = include_str!("plot/style.css");

/// How many colours (with dashes) there are: classes `s0` to `s11`. Higher indices begin again.
pub const COLOURS: usize = 12;

/// How the values of a series are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// A line from value to value, broken where one is not finite.
    Line,
    /// Full points, with their labels.
    Points,
    /// Hollow points, with their labels.
    Rings,
    /// Bars from zero, or from the lower end of a logarithmic axis.
    Bars,
}

/// A value of a series.
#[derive(Clone, Debug, PartialEq)]
pub struct Value {
    /// Along the horizontal axis.
    pub x: f64,
    /// Along the vertical axis.
    pub y: f64,
    /// What is written beside it; not for lines.
    pub label: Option<String>,
}

impl From<(f64, f64)> for Value {
    fn from((x, y): (f64, f64)) -> Self {
        Self { x, y, label: None }
    }
}

/// Values that belong together.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// For the legend.
    pub name: String,
    /// Of its values, such as `rad`; empty for none.
    pub unit: String,
    /// Which colour, modulo [`COLOURS`].
    pub colour: usize,
    /// How it is drawn.
    pub form: Form,
    /// In the order in which lines join them.
    pub values: Vec<Value>,
}

impl Series {
    /// A line through points.
    #[must_use]
    pub fn line(
        name: impl Into<String>,
        unit: impl Into<String>,
        colour: usize,
        values: impl IntoIterator<Item = (f64, f64)>,
    ) -> Self {
        Self {
            name: name.into(),
            unit: unit.into(),
            colour,
            form: Form::Line,
            values: values.into_iter().map(Value::from).collect(),
        }
    }
}

/// What a vertical line stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MarkKind {
    /// A dead centre, a limit, the start.
    Event,
    /// A singular pose.
    Singular,
}

/// A vertical line.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// Where, along the horizontal axis. Outside of its range, nothing is drawn.
    pub at: f64,
    /// What is there.
    pub label: String,
    /// Of which kind.
    pub kind: MarkKind,
}

/// A horizontal line.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Where, along the vertical axis. Outside of its range, nothing is drawn.
    pub at: f64,
    /// What it means.
    pub label: String,
}

/// A plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// Its title; empty for none.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// What is shown; the first lies lowest.
    pub series: Vec<Series>,
    /// Vertical lines.
    pub marks: Vec<Mark>,
    /// Horizontal lines.
    pub levels: Vec<Level>,
    /// Whether the horizontal axis is the arclength of a motion that a script follows with a cursor.
    pub follows_arclength: bool,
    /// Width and height (px); at least 200 by 120.
    pub size: [f64; 2],
}

impl Plot {
    /// A plot of 640 by 300 pixels with nothing in it yet.
    #[must_use]
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self {
            title: title.into(),
            x,
            y,
            series: Vec::new(),
            marks: Vec::new(),
            levels: Vec::new(),
            follows_arclength: false,
            size: [640.0, 300.0],
        }
    }

    /// With as many pixels to a unit along both axes, which have to be linear: one of the ranges grows about its middle.
    #[must_use]
    pub fn with_equal_scales(mut self) -> Self {
        // Numbers beside a longer vertical axis may take more room, which shrinks the horizontal one: a little is left for it.
        const ROOM: f64 = 1.02;
        let grown = |range: [f64; 2], length: f64| {
            let middle = 0.5 * (range[0] + range[1]);
            [middle - 0.5 * length, middle + 0.5 * length]
        };
        for _ in 0..8 {
            let frame = Frame::new(&self);
            let ([left, right], [low, high]) = (self.x.drawn_range(), self.y.drawn_range());
            let pixels = [frame.right - frame.left, frame.bottom - frame.top];
            let wide = (high - low) * pixels[0] / pixels[1];
            if wide >= right - left {
                // The last step, since the horizontal range changes no room.
                self.x.range = grown([left, right], wide);
                break;
            }
            self.y.range = grown([low, high], ROOM * (right - left) * pixels[1] / pixels[0]);
        }
        self
    }

    /// The plot as an element `svg.plot` for a page that includes [`STYLE`].
    #[must_use]
    pub fn fragment(&self) -> String {
        let mut svg = String::new();
        self.write(&mut svg, None);
        svg
    }

    /// The plot as a file of its own, for light and dark screens.
    #[must_use]
    pub fn document(&self) -> String {
        let mut svg = String::new();
        self.write(&mut svg, Some(STYLE));
        svg
    }

    /// What the plot consists of, without the element around it: for a picture that has more in it, and the plot at its upper
    /// left corner.
    pub fn write_content(&self, svg: &mut String) {
        self.write_inside(&Frame::new(self), svg);
    }

    /// Where the ends of both axes lie (px): left and right, then bottom and top.
    #[must_use]
    pub fn window(&self) -> [[f64; 2]; 2] {
        let frame = Frame::new(self);
        [[frame.left, frame.right], [frame.bottom, frame.top]]
    }

    /// The attributes by which a script gets from pixels back to values.
    #[must_use]
    pub fn scale_attributes(&self) -> String {
        let frame = Frame::new(self);
        format!(
            " data-x=\"{}\" data-y=\"{}\"",
            frame.x.described(self.x.word()),
            frame.y.described(self.y.word())
        )
    }

    fn write(&self, svg: &mut String, style: Option<&str>) {
        let frame = Frame::new(self);
        let [width, height] = frame.size;
        let namespace = if style.is_some() {
            " xmlns=\"http://www.w3.org/2000/svg\""
        } else {
            ""
        };
        let follows = if self.follows_arclength {
            " data-follows=\"arclength\""
        } else {
            ""
        };
        put(
            svg,
            format_args!(
                "<svg{namespace} class=\"plot\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" role=\"img\" aria-label=\"{}\" data-x=\"{}\" data-y=\"{}\"{follows}>\n",
                escaped(&self.spoken()),
                frame.x.described(self.x.word()),
                frame.y.described(self.y.word()),
                w = px(width),
                h = px(height),
            ),
        );
        if let Some(style) = style {
            put(
                svg,
                format_args!(
                    "<title>{}</title>\n<style>{style}</style>\n<rect class=\"back\" width=\"100%\" height=\"100%\"/>\n",
                    escaped(&self.spoken())
                ),
            );
        }
        self.write_inside(&frame, svg);
        svg.push_str("</svg>\n");
    }

    fn write_inside(&self, frame: &Frame, svg: &mut String) {
        frame.write_axes(svg, self);
        series::write(svg, frame, self);
        frame.write_levels(svg, &self.levels);
        frame.write_marks(svg, &self.marks);
        frame.write_names(svg, self);
        if self.follows_arclength {
            let x = px(frame.x.at(self.x.drawn_range()[0].max(0.0)));
            put(
                svg,
                format_args!(
                    "<line class=\"cursor\" x1=\"{x}\" y1=\"{}\" x2=\"{x}\" y2=\"{}\"/>\n",
                    px(frame.top),
                    px(frame.bottom)
                ),
            );
        }
    }

    /// What the plot shows, for those who cannot see it.
    fn spoken(&self) -> String {
        let over = format!("{} over {}", self.y.label, self.x.label);
        if self.title.is_empty() {
            over
        } else {
            format!("{}: {over}", self.title)
        }
    }
}

#[cfg(test)]
#[path = "plot/tests.rs"]
#[allow(clippy::unwrap_used)]
mod tests;
