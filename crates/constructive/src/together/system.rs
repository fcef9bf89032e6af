//! The equations of a core, and what their solutions are.

use super::building::{Building, NOT_ALGEBRAIC, Place};
use super::search::{Found, Search, Start, Terms};
use crate::construction::{Shape, drawn_side};
use crate::sketch::{Element, Sketch};
use kutzbach_algebra::{FieldElement, FieldPolynomial, NumberField, OverRationals};

/// Equations that place all elements of a core.
pub(super) struct System {
    field: NumberField,
    /// By element of the core.
    places: Vec<Place>,
    equations: Vec<FieldPolynomial>,
    unknowns: usize,
    /// Unknowns that are lengths: solutions where one is not above zero are none.
    lengths: Vec<usize>,
    /// Where every unknown is drawn.
    starts: Vec<Start>,
}

impl System {
    /// The equations.
    ///
    /// # Errors
    /// Where a value is no algebraic number, or only angles hold the elements.
    pub(super) fn of(sketch: &Sketch, core: &[usize]) -> Result<Self, &'static str> {
        let mut building = Building::new(sketch, core)?;
        building.pin()?;
        for element in core {
            building.place_by_others()?;
            if !building.places.contains_key(element) {
                building.place_anywhere(*element);
            }
        }
        building.equate()?;
        building.relate()?;
        let place = |e: &usize| building.places.get(e).cloned();
        Ok(Self {
            places: core
                .iter()
                .map(place)
                .collect::<Option<_>>()
                .ok_or(NOT_ALGEBRAIC)?,
            field: building.field,
            equations: building.equations,
            unknowns: building.starts.len(),
            starts: building.starts,
            lengths: building.values.lengths(),
        })
    }

    /// Whether some complex solutions are none for the sign of a length.
    pub(super) const fn has_lengths(&self) -> bool {
        !self.lengths.is_empty()
    }

    /// Whether all lengths among the unknowns are above zero.
    pub(super) fn is_meant(&self, unknowns: &[f64]) -> bool {
        self.lengths.iter().all(|&u| unknowns[u] > 0.0)
    }

    /// Unknowns, equations, and the highest degree of these.
    pub(super) fn size(&self) -> [usize; 3] {
        let degrees = self.equations.iter().map(FieldPolynomial::degree);
        [
            self.unknowns,
            self.equations.len(),
            degrees.max().unwrap_or(0),
        ]
    }

    pub(super) fn over_rationals(&self) -> OverRationals {
        OverRationals::new(&self.equations, self.unknowns, &self.field)
    }

    /// Real solutions that are found from the drawing and around it, each proven to be one; not all of them.
    pub(super) fn near_the_drawing(&self) -> Vec<Found> {
        let terms = |polynomial: &FieldPolynomial| -> Terms {
            let term = |(exponents, coefficient): (&[u8], &FieldElement)| {
                let mut exponents = exponents.to_vec();
                exponents.resize(self.unknowns, 0);
                (self.field.number(coefficient).value(), exponents)
            };
            polynomial.terms().map(term).collect()
        };
        let equations: Vec<Terms> = self.equations.iter().map(terms).collect();
        let search = Search {
            equations: &equations,
            starts: &self.starts,
        };
        let mut found = search.solutions();
        found.retain(|f| self.lengths.iter().all(|&u| f.at[u] > f.within));
        found
    }

    /// Where the elements are for these values of the unknowns.
    pub(super) fn shapes_at(&self, unknowns: &[f64]) -> Vec<Shape> {
        let value = |polynomial: &FieldPolynomial| -> f64 {
            let term = |(exponents, coefficient): (&[u8], &FieldElement)| {
                let powers = exponents.iter().zip(unknowns);
                let power: f64 = powers.map(|(&e, x)| x.powi(i32::from(e))).product();
                power * self.field.number(coefficient).value()
            };
            // Added to zero, so that none is −0.
            polynomial.terms().map(term).fold(0.0, |sum, x| sum + x)
        };
        let shape = |place: &Place| match place {
            Place::Point(p) => Shape::Point([value(&p[0]), value(&p[1])]),
            Place::Line(direction, offset) => Shape::Line {
                direction: [value(&direction[0]), value(&direction[1])],
                offset: value(offset),
            },
        };
        self.places.iter().map(shape).collect()
    }
}

/// Rigid triangles with a line among elements of a core, and on which side the third element is.
pub(super) fn sided_triangles(sketch: &Sketch, core: &[usize]) -> Vec<([usize; 3], f64)> {
    let triangles = sketch.rigid_triangles().into_iter();
    triangles
        .filter(|(three, _)| three.iter().all(|e| core.contains(e)))
        .filter(|(_, places)| places.iter().any(Element::is_line))
        .map(|(three, places)| {
            let [a, b, c] = places.map(|e| Shape::drawn(&e));
            (three, drawn_side([&a, &b], &c))
        })
        .collect()
}
