//! Pieces of the solution set that consist of the same poses.
//!
//! A ball is a unit quaternion q, and q and −q are one turn. Changing the sign of all four components of one ball maps
//! solutions to solutions and every piece to a piece; pieces that are mapped to one another are the same poses twice.

use super::Piece;
use crate::{
    Budget, Meaning, MonomialOrder, Polynomial, PolynomialSystem, Rational, Stop, groebner_basis,
};

/// For every piece the first one that consists of the same poses: its own number where that is itself.
pub(super) fn first_of_same_poses(
    system: &PolynomialSystem,
    pieces: &[Piece],
    budget: &Budget,
) -> Result<Vec<usize>, Stop> {
    let mut first: Vec<usize> = (0..pieces.len()).collect();
    let balls = balls(system);
    if balls.is_empty() || pieces.len() < 2 {
        return Ok(first);
    }
    let n = system.variables.len();
    let basis = |equations: &[Polynomial]| {
        groebner_basis(equations, n, &MonomialOrder::Degrevlex, budget)
            .map(|basis| basis.polynomials().to_vec())
    };
    let bases = pieces
        .iter()
        .map(|piece| basis(&piece.component.equations))
        .collect::<Result<Vec<_>, Stop>>()?;
    for ball in &balls {
        for (place, equations) in bases.iter().enumerate() {
            let flipped: Vec<Polynomial> = equations.iter().map(|p| flipped(p, ball)).collect();
            if flipped == *equations {
                continue;
            }
            let image = basis(&flipped)?;
            if let Some(other) = bases.iter().position(|b| *b == image) {
                let (a, b) = (first[place], first[other]);
                let (low, high) = (a.min(b), a.max(b));
                first
                    .iter_mut()
                    .filter(|f| **f == high)
                    .for_each(|f| *f = low);
            }
        }
    }
    Ok(first)
}

/// The four variables of every quaternion.
fn balls(system: &PolynomialSystem) -> Vec<Vec<usize>> {
    let mut balls: Vec<(kutzbach_model::mechanism::JointId, Vec<usize>)> = Vec::new();
    for (index, variable) in system.variables.iter().enumerate() {
        if let Meaning::Quaternion { joint, .. } = variable.meaning {
            match balls.iter_mut().find(|(j, _)| *j == joint) {
                Some((_, ball)) => ball.push(index),
                None => balls.push((joint, vec![index])),
            }
        }
    }
    balls.into_iter().map(|(_, ball)| ball).collect()
}

/// With the sign of some variables changed; an overall sign is taken out, so that what is even or odd stays as it is.
fn flipped(polynomial: &Polynomial, variables: &[usize]) -> Polynomial {
    let odd = |exponents: &[u32]| variables.iter().map(|&v| exponents[v]).sum::<u32>() % 2 == 1;
    let mut all = polynomial.terms().map(|(exponents, _)| odd(exponents));
    let overall = all.next().unwrap_or(false);
    if all.all(|one| one == overall) {
        return polynomial.clone();
    }
    let terms = polynomial.terms().map(|(exponents, c)| {
        let c: Rational = if odd(exponents) {
            -c.clone()
        } else {
            c.clone()
        };
        (exponents.to_vec(), c)
    });
    Polynomial::from_terms(terms.collect(), polynomial.variables())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn even_and_odd_polynomials_stay_as_they_are() {
        let [q0, q1, x] = [0, 1, 2].map(|i| Polynomial::variable(i, 3));
        let even = &(&q0 * &q1) + &x;
        assert_eq!(flipped(&even, &[0, 1]), even);
        let odd = &(&q0 * &x) + &q1;
        assert_eq!(flipped(&odd, &[0, 1]), odd);
        let mixed = &q0 - &Polynomial::one(3);
        assert_eq!(flipped(&mixed, &[0, 1]), -&(&q0 + &Polynomial::one(3)));
    }
}
