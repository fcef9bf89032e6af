//! A solution as SVG.

use crate::construction::Shape;
use crate::named::NamedSketch;
use std::fmt::Write;

/// Width and height of a picture in pixels, and the margin around what it shows.
const SIZE: f64 = 320.0;
const MARGIN: f64 = 32.0;

/// Points with their names, lines, circles, and distances between points; `shapes` by element of the sketch, y upwards. Coordinates are
/// rounded to a hundredth of a pixel, so that the picture is the same on every machine.
#[must_use]
pub fn to_svg(named: &NamedSketch, shapes: &[Shape]) -> String {
    let shapes = &named.whole(shapes)[..];
    let view = View::of(shapes);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {SIZE} {SIZE}\" width=\"{SIZE}\" height=\"{SIZE}\" \
         font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"{SIZE}\" height=\"{SIZE}\" fill=\"#fff\"/>\n"
    );
    let mut line = |[a, b]: [[f64; 2]; 2], style: &str| {
        let [x1, y1] = view.at(a);
        let [x2, y2] = view.at(b);
        let _ = writeln!(
            svg,
            "<line x1=\"{x1:.2}\" y1=\"{y1:.2}\" x2=\"{x2:.2}\" y2=\"{y2:.2}\" {style}/>"
        );
    };
    for shape in shapes {
        if let Shape::Line { direction, offset } = *shape {
            line(view.across(direction, offset), "stroke=\"#9aa\"");
        }
    }
    for constraint in named.sketch.constraints() {
        if let [Shape::Point(p), Shape::Point(q)] = constraint.ends.map(|e| shapes[e]) {
            line([p, q], "stroke=\"#246\" stroke-width=\"2\"");
        }
    }
    for (circle, radius) in named.circles.iter().zip(named.radii(shapes)) {
        if let (Some(Shape::Point(p)), Some(radius)) = (shapes.get(circle.centre), radius) {
            let [x, y] = view.at(*p);
            let _ = writeln!(
                svg,
                "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{:.2}\" fill=\"none\" stroke=\"#246\" stroke-width=\"2\"/>",
                radius.abs() * view.scale
            );
        }
    }
    for (name, shape) in named.names.iter().zip(shapes) {
        if let Shape::Point(p) = *shape {
            let [x, y] = view.at(p);
            let _ = writeln!(
                svg,
                "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"3.5\" fill=\"#c30\"/><text x=\"{:.2}\" y=\"{:.2}\">{}</text>",
                x + 6.0,
                y - 6.0,
                escaped(name)
            );
        }
    }
    svg.push_str("</svg>\n");
    svg
}

/// What is shown, and how large.
struct View {
    centre: [f64; 2],
    scale: f64,
}

impl View {
    /// Around all points.
    fn of(shapes: &[Shape]) -> Self {
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for shape in shapes {
            if let Shape::Point(p) = shape {
                for k in 0..2 {
                    low[k] = low[k].min(p[k]);
                    high[k] = high[k].max(p[k]);
                }
            }
        }
        let size = (high[0] - low[0]).max(high[1] - low[1]);
        let known = size.is_finite();
        Self {
            centre: [0, 1].map(|k| if known { (low[k] + high[k]) / 2.0 } else { 0.0 }),
            scale: (SIZE - 2.0 * MARGIN) / if known && size > 0.0 { size } else { 1.0 },
        }
    }

    fn at(&self, p: [f64; 2]) -> [f64; 2] {
        let off = [p[0] - self.centre[0], self.centre[1] - p[1]];
        off.map(|x| SIZE / 2.0 + self.scale * x)
    }

    /// The part of a line that crosses the picture, and a little more.
    fn across(&self, direction: [f64; 2], offset: f64) -> [[f64; 2]; 2] {
        let normal = [-direction[1], direction[0]];
        let to = offset - normal[0] * self.centre[0] - normal[1] * self.centre[1];
        let foot = [0, 1].map(|k| self.centre[k] + to * normal[k]);
        let half = SIZE / self.scale;
        [-half, half].map(|t| [0, 1].map(|k| foot[k] + t * direction[k]))
    }
}

pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;")
}
