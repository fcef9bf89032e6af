//! Circles of a sketch: a centre, a radius, and what touches them.

use super::super::element::{Attribute, Element};
use super::super::error::Outcome;
use super::super::reader::Reader;
use super::super::words::quoted;
use super::lengths::Long;
use super::{Parts, sketch};
use kutzbach_constructive::named::Radius;
use kutzbach_constructive::relation::Relation;
use kutzbach_math::number::Number;

/// A circle as drawn.
pub(super) struct Drawn<'a> {
    pub(super) name: &'a str,
    /// The point in its centre.
    pub(super) centre: usize,
    radius: f64,
}

/// On which side something touches: what the file says, or the drawing.
fn side<'a>(element: Element<'a>, one: &str, other: &str) -> Outcome<Option<bool>> {
    let Some(side) = element.attribute("side") else {
        return Ok(None);
    };
    match side.value {
        word if word == one => Ok(Some(true)),
        word if word == other => Ok(Some(false)),
        _ => Err(side.fault(format!("needed `{one}` or `{other}`"))),
    }
}

/// A radius as a term of a sum, or as a number.
fn add(radius: &Radius, less: bool, terms: &mut Vec<(usize, bool)>, plus: &mut Number) {
    match radius {
        Radius::Known(number) if less => *plus = &*plus - number,
        Radius::Known(number) => *plus = &*plus + number,
        Radius::Unknown(value) => terms.push((*value, less)),
    }
}

impl<'a> Parts<'a> {
    /// The circle of a name.
    pub(super) fn circle(&self, name: &str) -> Option<usize> {
        self.circles.iter().position(|c| c.name == name)
    }

    pub(super) fn draw_circle(
        &mut self,
        reader: &mut Reader<'a>,
        element: Element<'a>,
    ) -> Outcome<()> {
        element.only_attributes(&["name", "center", "radius"])?;
        let name = self.new_name(element)?;
        let radius = element.required("radius")?;
        let drawn = reader.number(radius)?.value();
        if drawn <= 0.0 || !drawn.is_finite() {
            return Err(element
                .required("radius")?
                .fault("the radius of a circle is above zero"));
        }
        let center = element.required("center")?;
        let centre = self.point(&center, center.value)?;
        self.circles.push(Drawn {
            name: name.value,
            centre,
            radius: drawn,
        });
        self.lengths
            .of(Long::Circle(self.circles.len() - 1), element);
        Ok(())
    }

    /// The value of a radius.
    pub(super) fn radius(&mut self, reader: &mut Reader<'a>, element: Element<'a>) -> Outcome<()> {
        element.only_attributes(&["of", "value"])?;
        let of = element.required("of")?;
        let Some(circle) = self.circle(of.value) else {
            return Err(of.fault(format!("no circle is named {}", quoted(of.value))));
        };
        let value = reader.number(element.required("value")?)?;
        if value.signum() <= 0 {
            return Err(element.fault("the radius of a circle is above zero"));
        }
        let length = self.lengths.of(Long::Circle(circle), element);
        match self.lengths.state(length, value) {
            true => Ok(()),
            false => Err(element.fault("the radius of this circle was stated before")),
        }
    }

    /// Whether an element is between something and a circle.
    pub(super) fn names_a_circle(&self, element: Element<'a>) -> bool {
        let between = element.attribute("between");
        between.is_some_and(|names| {
            let mut names = names.value.split_ascii_whitespace();
            names.any(|name| self.circle(name).is_some())
        })
    }

    /// A point on a circle.
    pub(super) fn on_circle(&mut self, element: Element<'a>) -> Outcome<()> {
        element.only_attributes(&["between"])?;
        let between = element.required("between")?;
        let (circle, other) = self.circle_and_other(&between)?;
        let point = self.point(&between, other)?;
        let centre = self.circles[circle].centre;
        if point == centre {
            return Err(between.fault("the center of a circle is not on it"));
        }
        let radius = self.radius_of(circle);
        self.apart(element, [centre, point], &[(radius, false)])
    }

    /// A circle that touches a line or another circle.
    pub(super) fn tangent(&mut self, element: Element<'a>) -> Outcome<()> {
        element.only_attributes(&["between", "side"])?;
        let between = element.required("between")?;
        let (circle, other) = self.circle_and_other(&between)?;
        if let Some(second) = self.circle(other) {
            return self.two_circles(element, [circle, second]);
        }
        let line = self.find(&between, other)?;
        let centre = self.circles[circle].centre;
        let sketch::Element::Line { through, direction } = self.elements[line] else {
            return Err(between.fault("a circle touches a line, or another circle"));
        };
        let sketch::Element::Point(at) = self.elements[centre] else {
            return Err(between.fault("the center of a circle is a point"));
        };
        let off = [at[0] - through[0], at[1] - through[1]];
        let drawn = direction[0] * off[1] - direction[1] * off[0] >= 0.0;
        let left = side(element, "left", "right")?.unwrap_or(drawn);
        let radius = self.radius_of(circle);
        self.apart(element, [centre, line], &[(radius, !left)])
    }

    /// Circles that touch from outside, or one from inside the other.
    fn two_circles(&mut self, element: Element<'a>, pair: [usize; 2]) -> Outcome<()> {
        let between = element.required("between")?;
        let [one, other] = pair.map(|c| &self.circles[c]);
        let ends = [one.centre, other.centre];
        if ends[0] == ends[1] {
            return Err(between.fault("circles around one center do not touch"));
        }
        let place = |e: usize| match self.elements[e] {
            sketch::Element::Point(p) => p,
            sketch::Element::Line { through, .. } => through,
        };
        let [p, q] = ends.map(place);
        let distance = (p[0] - q[0]).hypot(p[1] - q[1]);
        let apart = (distance - (one.radius + other.radius)).abs();
        let within = (distance - (one.radius - other.radius).abs()).abs();
        let outside = side(element, "outside", "inside")?.unwrap_or(apart <= within);
        let [one, other] = pair.map(|c| self.radius_of(c));
        let same = match (&one, &other) {
            (Radius::Known(a), Radius::Known(b)) => a == b,
            (Radius::Unknown(a), Radius::Unknown(b)) => a == b,
            _ => false,
        };
        if same && !outside {
            return Err(element.fault("of two circles of one radius none touches from inside"));
        }
        self.apart(element, ends, &[(one, false), (other, !outside)])
    }

    /// States how far elements are apart: a sum of radii, some of them subtracted.
    fn apart(
        &mut self,
        element: Element<'a>,
        ends: [usize; 2],
        radii: &[(Radius, bool)],
    ) -> Outcome<()> {
        let (mut terms, mut plus) = (Vec::new(), Number::zero());
        for (radius, less) in radii {
            add(radius, *less, &mut terms, &mut plus);
        }
        if terms.is_empty() {
            let points = ends.iter().all(|&e| self.direction(e).is_none());
            let value = if points { plus.abs() } else { plus };
            self.push(element, ends, value);
        } else {
            self.relations
                .push(Relation::Measured { ends, terms, plus });
        }
        Ok(())
    }

    fn radius_of(&self, circle: usize) -> Radius {
        self.lengths.radius(circle)
    }

    /// A circle that an element names, and the other name.
    fn circle_and_other(&self, between: &Attribute<'a>) -> Outcome<(usize, &'a str)> {
        let names: Vec<&'a str> = between.value.split_ascii_whitespace().collect();
        let [one, other] = names[..] else {
            let message = format!("needed two names, found {}", names.len());
            return Err(between.fault(message).help("between=\"a b\""));
        };
        match (self.circle(one), self.circle(other)) {
            (Some(circle), _) => Ok((circle, other)),
            (None, Some(circle)) => Ok((circle, one)),
            (None, None) => Err(between.fault("none of these is a circle")),
        }
    }
}
