//! What is said of more than two elements.

use super::super::element::{Attribute, Element};
use super::super::error::Outcome;
use super::super::words::quoted;
use super::lengths::Long;
use super::{Parts, sketch};
use kutzbach_constructive::relation::Relation;

impl<'a> Parts<'a> {
    /// A point that an attribute names.
    pub(super) fn point(&self, at: &Attribute<'a>, name: &str) -> Outcome<usize> {
        let found = self.find(at, name)?;
        match self.elements[found] {
            sketch::Element::Point(_) => Ok(found),
            sketch::Element::Line { .. } => {
                Err(at.fault(format!("{} is a line, needed a point", quoted(name))))
            }
        }
    }

    /// Two segments, two circles, or one of each, of equal length and radius.
    pub(super) fn equal(&mut self, element: Element<'a>) -> Outcome<()> {
        element.only_attributes(&["of", "and"])?;
        let pair = [element.required("of")?, element.required("and")?];
        let pair = [self.long(&pair[0])?, self.long(&pair[1])?];
        if pair[0] == pair[1] {
            return Err(element.fault("a length is equal to itself"));
        }
        let pair = pair.map(|long| self.lengths.of(long, element));
        self.lengths.equate(pair, element);
        Ok(())
    }

    fn long(&self, at: &Attribute<'a>) -> Outcome<Long> {
        let names: Vec<&str> = at.value.split_ascii_whitespace().collect();
        match names[..] {
            [name] => self
                .circle(name)
                .map(Long::Circle)
                .ok_or_else(|| at.fault("needed two points, or a circle")),
            [p, q] => {
                let ends = [self.point(at, p)?, self.point(at, q)?];
                match ends[0] == ends[1] {
                    true => Err(at.fault("a length is between two different points")),
                    false => Ok(Long::segment(ends)),
                }
            }
            _ => Err(at.fault("needed two points, or a circle")),
        }
    }

    /// A point in the middle of two others.
    pub(super) fn midpoint(&mut self, element: Element<'a>) -> Outcome<()> {
        element.only_attributes(&["point", "between"])?;
        let at = element.required("point")?;
        let point = self.point(&at, at.value)?;
        let between = element.required("between")?;
        let of = self.ends(element)?;
        for (e, name) in of.iter().zip(between.value.split_ascii_whitespace()) {
            self.point(&between, name)?;
            if *e == point {
                return Err(at.fault("the middle is not one of the two ends"));
            }
        }
        if of[0] == of[1] {
            return Err(between.fault("a middle is between two different points"));
        }
        self.relate(element, Relation::Middle { point, of })
    }

    /// Two points or two lines that are mirror images in a line; which way the second line points, the drawing says.
    pub(super) fn symmetric(&mut self, element: Element<'a>) -> Outcome<()> {
        element.only_attributes(&["between", "about"])?;
        let about = element.required("about")?;
        let axis = self.find(&about, about.value)?;
        let Some([c, s]) = self.direction(axis) else {
            return Err(about.fault("elements are symmetric about a line"));
        };
        let between = element.required("between")?;
        let pair = self.ends(element)?;
        if pair[0] == pair[1] || pair.contains(&axis) {
            return Err(between.fault("two elements are symmetric about a third one"));
        }
        let against = match pair.map(|e| self.direction(e)) {
            [None, None] => false,
            [Some([a, b]), Some([x, y])] => {
                let square = c * c + s * s;
                let along = 2.0 * (a * c + b * s);
                (along * c - square * a) * x + (along * s - square * b) * y < 0.0
            }
            _ => return Err(between.fault("two points are symmetric, or two lines")),
        };
        let relation = Relation::Mirrored {
            pair,
            axis,
            against,
        };
        self.relate(element, relation)
    }

    /// A relation that was not stated before, in any order of what it is between.
    fn relate(&mut self, element: Element<'a>, relation: Relation) -> Outcome<()> {
        let set = |pair: &[usize; 2]| [pair[0].min(pair[1]), pair[0].max(pair[1])];
        let same = |other: &Relation| match (other, &relation) {
            (
                Relation::Middle { point, of },
                Relation::Middle {
                    point: own_point,
                    of: own,
                },
            ) => point == own_point && set(of) == set(own),
            (
                Relation::Mirrored { pair, axis, .. },
                Relation::Mirrored {
                    pair: own,
                    axis: own_axis,
                    ..
                },
            ) => axis == own_axis && set(pair) == set(own),
            _ => false,
        };
        if self.relations.iter().any(same) {
            return Err(element.fault("this was said of the same elements before"));
        }
        self.relations.push(relation);
        Ok(())
    }
}
