//! Greatest common divisors through primes, and what they give: squarefree parts.

use super::residues::{self, Primes};
use super::{Univariate, integer_gcd};
use num_bigint::BigInt;
use num_traits::Zero;
use polycore::crt::CrtAccumulator;

impl Univariate {
    /// The greatest common divisor, primitive.
    ///
    /// Images modulo primes by Chinese remainders until the result divides both (Brown 1971). An image of too high a
    /// degree comes from an unlucky prime; one of lower degree than before shows that all before were unlucky. Only
    /// finitely many primes are unlucky, so this ends.
    #[must_use]
    pub fn gcd(&self, other: &Self) -> Self {
        if self.is_zero() {
            return other.primitive();
        }
        if other.is_zero() {
            return self.primitive();
        }
        let (a, b) = (self.primitive(), other.primitive());
        let head = integer_gcd(&a.leading(), &b.leading());
        let mut degree = usize::MAX;
        let mut images = CrtAccumulator::new(0);
        let mut last: Option<Self> = None;
        for prime in Primes::new() {
            let unit = residues::residue(&head, prime);
            if unit == 0 {
                continue;
            }
            let (x, y) = (residues::image(&a, prime), residues::image(&b, prime));
            if x.len() != a.0.len() || y.len() != b.0.len() {
                continue;
            }
            let image = residues::gcd(&x, &y, prime);
            if image.len() == 1 {
                return Self::from_integers(&[1]);
            }
            if image.len() > degree {
                continue;
            }
            if image.len() < degree {
                degree = image.len();
                images = CrtAccumulator::new(degree);
                last = None;
            }
            let scaled: Vec<u64> = image
                .iter()
                .map(|&c| residues::modp::mul(c, unit, prime))
                .collect();
            if images.add(prime, &scaled).is_err() {
                break;
            }
            let candidate = symmetric(&images).primitive();
            let settled = last.as_ref() == Some(&candidate);
            if settled && a.divided_by(&candidate).is_some() && b.divided_by(&candidate).is_some() {
                return candidate;
            }
            last = Some(candidate);
        }
        Self::from_integers(&[1])
    }

    /// The squarefree parts with their multiplicities, ascending: the primitive part is the product of their powers.
    ///
    /// Musser 1971.
    #[must_use]
    pub fn squarefree(&self) -> Vec<(Self, u32)> {
        let mut parts = Vec::new();
        if self.degree() == 0 {
            return parts;
        }
        let whole = self.primitive();
        let mut repeated = whole.gcd(&whole.derivative());
        let mut distinct = whole.quotient(&repeated);
        let mut multiplicity = 1;
        while distinct.degree() > 0 {
            let again = distinct.gcd(&repeated);
            let once = distinct.quotient(&again);
            if once.degree() > 0 {
                parts.push((once, multiplicity));
            }
            repeated = repeated.quotient(&again);
            distinct = again;
            multiplicity += 1;
        }
        parts
    }

    /// Divided by a known divisor.
    fn quotient(&self, divisor: &Self) -> Self {
        self.divided_by(divisor).unwrap_or_default().primitive()
    }
}

/// The integers of smallest size with these remainders.
fn symmetric(images: &CrtAccumulator) -> Univariate {
    let modulus = images.modulus();
    let values: Vec<BigInt> = images
        .residues()
        .iter()
        .map(|r| residues::symmetric(r, modulus))
        .collect();
    debug_assert!(!modulus.is_zero());
    Univariate::new(values)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn polynomial(degree: usize) -> impl Strategy<Value = Univariate> {
        proptest::collection::vec(-9_i64..10, degree + 1)
            .prop_map(|c| Univariate::from_integers(&c))
            .prop_filter("not constant", |p| p.degree() > 0)
    }

    proptest! {
        #[test]
        fn common_factors_are_found(a in polynomial(3), b in polynomial(3), c in polynomial(2)) {
            let gcd = (&a * &c).gcd(&(&b * &c));
            prop_assert!(gcd.divided_by(&c.primitive()).is_some());
            prop_assert!((&a * &c).primitive().divided_by(&gcd).is_some());
            prop_assert!((&b * &c).primitive().divided_by(&gcd).is_some());
        }

        #[test]
        fn squarefree_parts_multiply_up(a in polynomial(2), b in polynomial(2), c in polynomial(1)) {
            let whole = &(&a * &(&b * &b)) * &(&c * &(&c * &c));
            let product = whole.squarefree().iter().fold(
                Univariate::from_integers(&[1]),
                |product, (part, power)| (0..*power).fold(product, |p, _| &p * part),
            );
            prop_assert_eq!(product, whole.primitive());
            for (part, _) in whole.squarefree() {
                prop_assert_eq!(part.gcd(&part.derivative()).degree(), 0);
            }
        }
    }
}
