//! A body's own coordinates.
//!
//! A triangle that is known by its sides alone has no rational coordinates as a rule: the equilateral one needs √3. But in the
//! basis of one side, the height on it and their product, whose vectors are perpendicular and not of length one, everything
//! is rational in the squares of the sides. So a body's basis may have any lengths, and products take account of them.

use super::Poly;
use kutzbach_algebra::{FieldElement, NumberField};
use std::collections::BTreeMap;

/// A vector with constant components.
pub(super) type Constant = [FieldElement; 3];
/// A vector with polynomial components.
pub(super) type Vector = [Poly; 3];

/// A body in coordinates of its own: a perpendicular basis whose third vector is the product of the first two.
#[derive(Clone, Debug)]
pub(super) struct Local {
    /// Squared lengths of the basis vectors.
    pub(super) metric: Constant,
    /// Its points.
    pub(super) points: BTreeMap<usize, Constant>,
}

impl Local {
    /// A body with coordinates in a basis of unit vectors.
    pub(super) fn given(points: BTreeMap<usize, Constant>) -> Self {
        Self {
            metric: [1, 1, 1].map(FieldElement::integer),
            points,
        }
    }

    /// A triangle by its points and the squares of its sides AB, AC, BC; `None` where it has no area.
    pub(super) fn triangle(
        [a, b, c]: [usize; 3],
        [ab, ac, bc]: [&FieldElement; 3],
        field: &NumberField,
    ) -> Option<Self> {
        // AB·AC = (AB² + AC² − BC²)/2; the foot of the height from C divides AB by μ.
        let half = field.inverse(&FieldElement::integer(2))?;
        let product = field.times(&ab.plus(ac).minus(bc), &half);
        let foot = field.times(&product, &field.inverse(ab)?);
        let height = ac.minus(&field.times(&foot, &product));
        if height.is_zero() {
            return None;
        }
        let zero = FieldElement::default();
        let one = FieldElement::integer(1);
        let points = BTreeMap::from([
            (a, [zero.clone(), zero.clone(), zero.clone()]),
            (b, [one.clone(), zero.clone(), zero.clone()]),
            (c, [foot, one, zero]),
        ]);
        let third = field.times(ab, &height);
        Some(Self {
            metric: [ab.clone(), height, third],
            points,
        })
    }

    /// The largest distance of two points, in doubles (m).
    pub(super) fn extent(&self, field: &NumberField) -> f64 {
        let points: Vec<&Constant> = self.points.values().collect();
        let pairs = points
            .iter()
            .enumerate()
            .flat_map(|(i, a)| points[..i].iter().map(move |b| (a, b)));
        let squares = pairs.map(|(a, b)| {
            let way = minus(a, b);
            field.number(&self.dot(&way, &way, field)).value()
        });
        squares.fold(0.0, f64::max).sqrt()
    }

    /// How much farther off a corner of a triangle may be than its sides: by the base, and by the height.
    pub(super) fn lever(&self, field: &NumberField) -> f64 {
        let [base, height] = [0, 1].map(|i| field.number(&self.metric[i]).value().sqrt());
        let extent = self.extent(field);
        (extent / base).max(1.0) * (extent / height).max(1.0)
    }

    pub(super) fn dot(&self, a: &Constant, b: &Constant, field: &NumberField) -> FieldElement {
        let mut sum = FieldElement::default();
        for i in 0..3 {
            let product = field.times(&a[i], &b[i]);
            sum = sum.plus(&field.times(&product, &self.metric[i]));
        }
        sum
    }

    /// a × b: with e₁ × e₂ = e₃ the others follow as g₂ e₁ = e₂ × e₃ and g₁ e₂ = e₃ × e₁.
    pub(super) fn cross(&self, a: &Constant, b: &Constant, field: &NumberField) -> Constant {
        let part = |i: usize, j: usize| field.times(&a[i], &b[j]).minus(&field.times(&a[j], &b[i]));
        [
            field.times(&part(1, 2), &self.metric[1]),
            field.times(&part(2, 0), &self.metric[0]),
            part(0, 1),
        ]
    }

    /// The scalar product of a constant and a polynomial vector.
    pub(super) fn dot_with(&self, a: &Constant, v: &Vector, field: &NumberField) -> Poly {
        let mut sum = Poly::default();
        for i in 0..3 {
            let factor = field.times(&a[i], &self.metric[i]);
            sum = sum.plus(&v[i].scaled(&factor, field));
        }
        sum
    }

    /// The scalar product of two polynomial vectors.
    pub(super) fn dot_of(&self, a: &Vector, b: &Vector, field: &NumberField) -> Poly {
        let mut sum = Poly::default();
        for i in 0..3 {
            let product = a[i].times(&b[i], field);
            sum = sum.plus(&product.scaled(&self.metric[i], field));
        }
        sum
    }
}

pub(super) fn minus(a: &Constant, b: &Constant) -> Constant {
    [0, 1, 2].map(|i| a[i].minus(&b[i]))
}

pub(super) fn constant(a: &Constant) -> Vector {
    [0, 1, 2].map(|i| Poly::constant(a[i].clone()))
}

pub(super) fn difference(a: &Vector, b: &Vector) -> Vector {
    [0, 1, 2].map(|i| a[i].minus(&b[i]))
}

pub(super) fn sum(a: &Vector, b: &Vector) -> Vector {
    [0, 1, 2].map(|i| a[i].plus(&b[i]))
}
