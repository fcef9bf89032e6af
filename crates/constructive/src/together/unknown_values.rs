//! Unknown values among the unknowns of a core.

use super::building::Building;
use super::search::Start;
use crate::construction::Shape;
use crate::relation::{Relation, measured};
use kutzbach_algebra::{FieldElement, FieldPolynomial};

/// The unknown of every value, or of its square where that is all that is asked for.
#[derive(Clone, Debug, Default)]
pub(super) struct Values {
    /// By value: the index of its unknown.
    unknowns: Vec<usize>,
    /// By value: whether the unknown is its square.
    squared: Vec<bool>,
}

impl Values {
    /// The unknowns, which are lengths or squares of these.
    pub(super) fn lengths(&self) -> Vec<usize> {
        self.unknowns.clone()
    }
}

impl Building<'_> {
    /// Unknowns for all values that relations have, with the equation that each is not zero: two points in one place would satisfy much.
    pub(super) fn measure_values(&mut self) {
        let points = |ends: &[usize; 2]| !ends.iter().any(|&e| self.is_line(e));
        let square_alone = |value: usize| {
            self.relations.iter().all(|(relation, _)| match relation {
                Relation::Measured { ends, terms, plus } => {
                    !terms.iter().any(|t| t.0 == value)
                        || (points(ends) && terms.len() == 1 && plus.is_zero())
                }
                _ => true,
            })
        };
        let count = self.sketch.unknown_values();
        let squared: Vec<bool> = (0..count).map(square_alone).collect();
        let mut unknowns = Vec::with_capacity(count);
        let drawn = self.sketch.elements().iter().map(Shape::drawn);
        let drawn: Vec<Shape> = drawn.collect();
        let drawn = measured(self.sketch.relations().iter(), &drawn, count);
        for (drawn, squared) in drawn.into_iter().zip(&squared) {
            let index = self.starts.len();
            unknowns.push(index);
            let drawn = if drawn.abs() > 0.0 {
                drawn.abs()
            } else {
                self.size
            };
            let (start, far) = match squared {
                true => (drawn * drawn, self.size * self.size),
                false => (drawn, self.size),
            };
            let value = self.fresh(Start::At(start, far));
            let inverse = self.fresh(Start::Inverse(index));
            let one = FieldPolynomial::constant(FieldElement::integer(1));
            let product = value.times(&inverse, &self.field);
            self.equations.push(product.minus(&one));
        }
        self.values = Values { unknowns, squared };
    }

    /// What a relation says that two elements measure: the sum of its values, and whether that is the square of it already.
    pub(super) fn sum(
        &mut self,
        terms: &[(usize, bool)],
        plus: &kutzbach_math::number::Number,
    ) -> Result<(FieldPolynomial, bool), &'static str> {
        let unknown = |values: &Values, v: usize| FieldPolynomial::unknown(values.unknowns[v]);
        if let [(value, _)] = terms
            && self.values.squared[*value]
        {
            return Ok((unknown(&self.values, *value), true));
        }
        let mut sum = self.constant(plus)?;
        for &(value, less) in terms {
            let term = unknown(&self.values, value);
            sum = if less {
                sum.minus(&term)
            } else {
                sum.plus(&term)
            };
        }
        Ok((sum, false))
    }
}
