//! A polynomial on a line, and coordinates along and across it.

use crate::polynomial::{Polynomial, Rational};
use num_traits::{One, Zero};

/// The points `base + t·direction`. One component of the direction, the one at `pivot`, is 1.
#[derive(Clone, Debug)]
pub(super) struct Line {
    base: Vec<Rational>,
    direction: Vec<Rational>,
    pivot: usize,
}

impl Line {
    /// The line with a number, in a space of `variables` dimensions. Small integers without pattern, of slowly growing size.
    pub(super) fn numbered(number: usize, variables: usize) -> Self {
        let reach = 2 + number as u64;
        let draw = |index: usize| {
            let mut z = (number * 1009 + index * 31 + 7) as u64;
            z = (z ^ (z << 21)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            z = (z ^ (z >> 29)).wrapping_mul(0x94d0_49bb_1331_11eb);
            let value = ((z >> 32) % (2 * reach + 1)) as i64 - reach as i64;
            Rational::from_integer(value.into())
        };
        let base = (0..variables).map(|i| draw(2 * i)).collect();
        let pivot = number % variables;
        let mut direction: Vec<Rational> = (0..variables).map(|i| draw(2 * i + 1)).collect();
        // A direction along a coordinate plane is seldom generic.
        for component in &mut direction {
            if component.is_zero() {
                *component = Rational::from_integer(reach.into());
            }
        }
        direction[pivot] = Rational::one();
        Self {
            base,
            direction,
            pivot,
        }
    }

    /// The index of the variable that becomes the parameter along the line.
    pub(super) fn pivot(&self) -> usize {
        self.pivot
    }

    /// The coefficients in t, ascending, of the polynomial on the line.
    pub(super) fn restrict(&self, polynomial: &Polynomial) -> Vec<Rational> {
        let mut sum = vec![Rational::zero(); polynomial.degree() as usize + 1];
        let mut powers: Vec<Vec<Vec<Rational>>> =
            vec![vec![vec![Rational::one()]]; self.base.len()];
        for (exponents, coefficient) in polynomial.terms() {
            let mut term = vec![coefficient.clone()];
            for (variable, &exponent) in exponents.iter().enumerate() {
                let known = &mut powers[variable];
                while known.len() <= exponent as usize {
                    let linear = [
                        self.base[variable].clone(),
                        self.direction[variable].clone(),
                    ];
                    known.push(product(&known[known.len() - 1], &linear));
                }
                if exponent > 0 {
                    term = product(&term, &known[exponent as usize]);
                }
            }
            for (total, part) in sum.iter_mut().zip(term) {
                *total += part;
            }
        }
        sum
    }

    /// The polynomial in the coordinates t (in the place of the pivot) and y (the distance from the line along the others).
    pub(super) fn to_coordinates(&self, polynomial: &Polynomial) -> Polynomial {
        let n = self.base.len();
        let t = Polynomial::variable(self.pivot, n);
        let replacements: Vec<Polynomial> = (0..n)
            .map(|i| {
                let along =
                    &t.scaled(&self.direction[i]) + &Polynomial::constant(self.base[i].clone(), n);
                if i == self.pivot {
                    along
                } else {
                    &Polynomial::variable(i, n) + &along
                }
            })
            .collect();
        polynomial.substitute(&replacements)
    }

    /// Back from the coordinates along and across the line.
    pub(super) fn out_of_coordinates(&self, polynomial: &Polynomial) -> Polynomial {
        let n = self.base.len();
        let from_base =
            |i: usize| &Polynomial::variable(i, n) - &Polynomial::constant(self.base[i].clone(), n);
        let t = from_base(self.pivot);
        let replacements: Vec<Polynomial> = (0..n)
            .map(|i| {
                if i == self.pivot {
                    t.clone()
                } else {
                    &from_base(i) - &t.scaled(&self.direction[i])
                }
            })
            .collect();
        polynomial.substitute(&replacements)
    }
}

fn product(a: &[Rational], b: &[Rational]) -> Vec<Rational> {
    let mut values = vec![Rational::zero(); a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            values[i + j] += x * y;
        }
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_go_there_and_back() {
        let (x, y) = (Polynomial::variable(0, 2), Polynomial::variable(1, 2));
        let p = &(&(&x * &x) * &y) - &(&y + &Polynomial::integer(3, 2));
        for number in 0..4 {
            let line = Line::numbered(number, 2);
            let moved = line.to_coordinates(&p);
            assert_eq!(line.out_of_coordinates(&moved), p);
            // On the line the distance is zero.
            let restricted = line.restrict(&p);
            for (exponents, coefficient) in moved.terms() {
                if exponents[1 - line.pivot()] == 0 {
                    assert_eq!(restricted[exponents[line.pivot()] as usize], *coefficient);
                }
            }
        }
    }
}
