//! Distances that are as large or as small as they can be.
//!
//! Over the complex numbers a stretched linkage moves: the equations of its configurations have a curve of solutions of which some points
//! are real. What they lack is that there the distance is an extreme one. Where a closure g depends on few turns, all real values of its
//! unknowns form a product of ellipses, which is compact, so that g is least and largest where its derivatives along all of them are zero.
//! If these *critical* points are finitely many, g is zero at some of them and of one sign at all others, then it is of that sign
//! everywhere, and every real zero of g is critical: the derivatives are equations of the real solutions too.

use crate::reduced::{Poly, ReducedSystem, Unknowns};
use kutzbach_algebra::{Budget, FieldElement, NumberField, OverRationals, RealSet};

/// Turns of a closure that is looked at: its critical points are those of a system of twice as many unknowns.
const MOST_TURNS: usize = 2;

/// Critical values that are not zero are larger than this, in parts of the largest coefficient: those that are zero are counted exactly.
const NOT_ZERO: f64 = 1e-9;

/// The equations that closures at an extreme add; none where none is known to be at one.
pub(super) fn equations(system: &ReducedSystem, budget: &Budget) -> Vec<Poly> {
    let of = |closure: &crate::reduced::Closure| of_closure(system, &closure.polynomial, budget);
    let all = system.closures.iter().filter_map(of);
    all.flatten().collect()
}

/// The derivatives of a closure along the turns that it depends on, if it is at an extreme.
fn of_closure(system: &ReducedSystem, closure: &Poly, budget: &Budget) -> Option<Vec<Poly>> {
    let field = &system.field;
    let uses = |index: usize| {
        let mut terms = closure.terms();
        terms.any(|(exponents, _)| exponents.get(index).is_some_and(|&e| e > 0))
    };
    let turns = system.unknowns.iter();
    let turns: Vec<&Unknowns> = turns
        .filter(|turn| (turn.first()..turn.first() + turn.count()).any(uses))
        .collect();
    if turns.is_empty() || turns.len() > MOST_TURNS {
        return None;
    }
    // By themselves: the unknowns of the first turn first.
    let mut places = vec![0; system.unknown_count()];
    let mut relations = Vec::new();
    for (number, turn) in turns.iter().enumerate() {
        let Unknowns::Hinge { first, ratio, axis } = turn else {
            return None;
        };
        let own = Unknowns::Hinge {
            first: 2 * number,
            ratio: ratio.clone(),
            axis: axis.clone(),
        };
        places[*first] = 2 * number;
        places[first + 1] = 2 * number + 1;
        relations.push(own.relation(field));
    }
    let derivatives: Vec<Poly> = turns
        .iter()
        .filter_map(|turn| along(closure, turn, field))
        .collect();
    let moved = |poly: &Poly| moved(poly, &places, field);
    let mut critical: Vec<Poly> = derivatives.iter().map(moved).chain(relations).collect();
    let own = moved(closure);
    let solved = |equations: &[Poly]| {
        let system = OverRationals::new(equations, 2 * turns.len(), field);
        match system.real_set(<[f64]>::to_vec, budget) {
            Ok(RealSet::Finite { real, .. }) => Some(real),
            _ => None,
        }
    };
    let all = solved(&critical)?;
    critical.push(own.clone());
    let zeros = solved(&critical)?.len();
    let largest = own.terms().map(|(_, c)| field.number(c).value().abs());
    let least = NOT_ZERO * largest.fold(0.0, f64::max);
    let values: Vec<f64> = all.iter().map(|(at, _)| system.value(&own, at)).collect();
    let [above, below] =
        [1.0, -1.0].map(|sign| values.iter().filter(|v| sign * *v > least).count());
    let one_sign = above == 0 || below == 0;
    (zeros > 0 && one_sign && above + below + zeros == all.len()).then_some(derivatives)
}

/// The derivative along the ellipse x² + a y² = r of a turn, whose direction is (−a y, x).
fn along(poly: &Poly, turn: &Unknowns, field: &NumberField) -> Option<Poly> {
    let Unknowns::Hinge { first, axis, .. } = turn else {
        return None;
    };
    let [x, y] =
        [*first, first + 1].map(|index| (Poly::unknown(index), derivative(poly, index, field)));
    let back = x.1.times(&y.0.scaled(axis, field), field);
    Some(y.1.times(&x.0, field).minus(&back))
}

fn derivative(poly: &Poly, index: usize, field: &NumberField) -> Poly {
    let terms = poly.terms().filter_map(|(exponents, c)| {
        let &power = exponents.get(index).filter(|&&e| e > 0)?;
        let mut lower = exponents.to_vec();
        lower[index] -= 1;
        let factor = field.times(c, &FieldElement::integer(i64::from(power)));
        Some(product(&lower, |i| i, &factor, field))
    });
    terms.fold(Poly::default(), |sum, term| sum.plus(&term))
}

/// The same with other indices of its unknowns.
fn moved(poly: &Poly, places: &[usize], field: &NumberField) -> Poly {
    let terms = poly.terms();
    terms.fold(Poly::default(), |sum, (exponents, c)| {
        sum.plus(&product(exponents, |i| places[i], c, field))
    })
}

fn product(
    exponents: &[u8],
    place: impl Fn(usize) -> usize,
    factor: &FieldElement,
    field: &NumberField,
) -> Poly {
    let powers = exponents
        .iter()
        .enumerate()
        .flat_map(|(i, &e)| std::iter::repeat_n(i, usize::from(e)));
    let one = Poly::constant(factor.clone());
    powers.fold(one, |product, i| {
        product.times(&Poly::unknown(place(i)), field)
    })
}
