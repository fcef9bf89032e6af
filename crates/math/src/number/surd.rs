//! Sums of rational multiples of square roots of integers: elements of multiquadratic fields.
//!
//! The terms carry pairwise independent roots, so a sum is zero only when it has no terms. Sums and products stay of this
//! form; a quotient does by multiplying with conjugates; the root of a rational is of this form, and that of a sum where
//! it denests. Every operation returns `None` instead of a result beyond the limits below; the caller then keeps the
//! expression as a tree.

use super::ball::{Ball, Bits, Clear};
use super::roots::{
    coprime_base, divides_oddly, exact_root, is_moderate, root_product, root_ratio, split_square,
};
use dashu_base::{BitTest, Sign};
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;

/// Largest number of terms of a sum.
pub(super) const MAX_TERMS: usize = 64;
/// Largest number of bits of a numerator or denominator in a normal form.
pub(super) const MAX_BITS: usize = 20_000;
/// Largest sum whose square root is tried, and how deep the search goes.
const MAX_DENESTING: (usize, usize) = (8, 3);

/// Whether a rational is small enough for a normal form.
pub(super) fn fits(x: &RBig) -> bool {
    x.numerator().bit_len() <= MAX_BITS && x.denominator().bit_len() <= MAX_BITS
}

/// A finite sum Σ cᵢ·√dᵢ with rational cᵢ ≠ 0 and natural dᵢ, sorted by dᵢ, the roots linearly independent over the
/// rationals (d = 1 for the rational part).
#[derive(Clone, Debug)]
pub struct Surd {
    terms: Vec<(UBig, RBig)>,
}

impl Surd {
    /// The terms (radicand, coefficient), by rising radicand. A radicand is free of squares of primes below 1024; a larger
    /// hidden square is possible where a radicand is too long to be factored.
    pub fn terms(&self) -> impl ExactSizeIterator<Item = (&UBig, &RBig)> {
        self.terms.iter().map(|(d, c)| (d, c))
    }

    /// Number of terms.
    pub(super) fn len(&self) -> usize {
        self.terms.len()
    }

    pub(super) fn rational(x: RBig) -> Self {
        let terms = if x.is_zero() {
            Vec::new()
        } else {
            vec![(UBig::ONE, x)]
        };
        Self { terms }
    }

    /// √x for x ≥ 0.
    pub(super) fn root(x: &RBig) -> Option<Self> {
        if x.is_zero() {
            return Some(Self::rational(RBig::ZERO));
        }
        let (numerator, denominator) = x.clone().into_parts();
        let numerator = numerator.into_parts().1;
        if !is_moderate(&numerator) || !is_moderate(&denominator) {
            // The root may still be rational; nothing else is worth the work.
            let (n, d) = (exact_root(&numerator)?, exact_root(&denominator)?);
            return Some(Self::rational(RBig::from_parts(n.into(), d)));
        }
        // √(n/d) = √n·√d / d.
        let (n_out, n_in) = split_square(&numerator);
        let (d_out, d_in) = split_square(&denominator);
        let (out, radicand) = root_product(&n_in, &d_in);
        let coefficient = RBig::from_parts((n_out * d_out * out).into(), denominator);
        let mut root = Self { terms: Vec::new() };
        root.insert(radicand, coefficient);
        root.checked()
    }

    /// The value, if it is rational.
    pub(super) fn as_rational(&self) -> Option<RBig> {
        match self.terms.as_slice() {
            [] => Some(RBig::ZERO),
            [(d, c)] if d.is_one() => Some(c.clone()),
            _ => None,
        }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    fn checked(self) -> Option<Self> {
        let fine = self.terms.len() <= MAX_TERMS
            && self.terms.iter().all(|(d, c)| fits(c) && is_moderate(d));
        fine.then_some(self)
    }

    /// Adds a term, merging it with the one whose root it is a multiple of.
    fn insert(&mut self, mut radicand: UBig, mut coefficient: RBig) {
        if coefficient.is_zero() {
            return;
        }
        for (d, _) in &self.terms {
            if let Some((n, m)) = root_ratio(&radicand, d) {
                coefficient *= RBig::from_parts(n.into(), m);
                radicand = d.clone();
                break;
            }
        }
        match self.terms.binary_search_by(|(d, _)| d.cmp(&radicand)) {
            Err(place) => self.terms.insert(place, (radicand, coefficient)),
            Ok(place) => {
                self.terms[place].1 += coefficient;
                if self.terms[place].1.is_zero() {
                    self.terms.remove(place);
                }
            }
        }
    }

    pub(super) fn add(&self, other: &Self) -> Option<Self> {
        let mut sum = self.clone();
        for (d, c) in &other.terms {
            sum.insert(d.clone(), c.clone());
        }
        sum.checked()
    }

    pub(super) fn negated(&self) -> Self {
        let terms = self.terms.iter();
        Self {
            terms: terms.map(|(d, c)| (d.clone(), -c.clone())).collect(),
        }
    }

    fn sub(&self, other: &Self) -> Option<Self> {
        self.add(&other.negated())
    }

    fn halved(&self) -> Self {
        let half = RBig::from_parts(IBig::ONE, UBig::from(2u8));
        let terms = self.terms.iter();
        Self {
            terms: terms.map(|(d, c)| (d.clone(), c * &half)).collect(),
        }
    }

    pub(super) fn mul(&self, other: &Self) -> Option<Self> {
        let mut product = Self { terms: Vec::new() };
        for (d, c) in &self.terms {
            for (e, b) in &other.terms {
                let (outside, inside) = root_product(d, e);
                product.insert(inside, c * b * RBig::from(outside));
            }
            if product.terms.len() > MAX_TERMS {
                return None;
            }
        }
        product.checked()
    }

    pub(super) fn square(&self) -> Option<Self> {
        self.mul(self)
    }

    /// One over a non-zero sum: multiply by the conjugate over one generator after the other until a rational is left.
    pub(super) fn inverse(&self) -> Option<Self> {
        if self.is_zero() {
            return None;
        }
        let mut factor = Self::rational(RBig::ONE);
        let mut rest = self.clone();
        loop {
            if let Some(x) = rest.as_rational() {
                return factor.mul(&Self::rational(RBig::ONE / x));
            }
            let generator = rest.generators().pop()?;
            let (even, odd) = rest.parts(&generator);
            let conjugate = even.sub(&odd)?;
            factor = factor.mul(&conjugate)?;
            rest = even.square()?.sub(&odd.square()?)?;
        }
    }

    fn generators(&self) -> Vec<UBig> {
        coprime_base(self.terms.iter().map(|(d, _)| d))
    }

    /// The terms kept and those negated when the sign of the generator's root is flipped.
    fn parts(&self, generator: &UBig) -> (Self, Self) {
        let terms = self.terms.iter().cloned();
        let (odd, even) = terms.partition(|(d, _)| divides_oddly(generator, d));
        (Self { terms: even }, Self { terms: odd })
    }

    /// The square root of a sum, where that is again such a sum and is found. Its value is not negative.
    ///
    /// For s = E + O, split by a generator, c = √(E² − O²) and r = √((E ± c)/2) give √s = r + O/(2r); both inner roots are
    /// sought by the same rule (Borodin, Fagin, Hopcroft, Tompa 1985, section 2, applied level by level). A root c that would itself
    /// need a new irrationality cannot help and is not followed.
    pub(super) fn sqrt(&self) -> Option<Self> {
        if self.terms.len() > MAX_DENESTING.0 {
            return None;
        }
        self.denested(MAX_DENESTING.1)
    }

    fn denested(&self, depth: usize) -> Option<Self> {
        if let Some(x) = self.as_rational() {
            return (x.sign() == Sign::Positive).then(|| Self::root(&x))?;
        }
        if depth == 0 || self.terms.len() > MAX_DENESTING.0 || self.sign()? == Sign::Negative {
            return None;
        }
        for generator in self.generators().into_iter().take(MAX_DENESTING.1) {
            let (even, odd) = self.parts(&generator);
            let norm = even.square()?.sub(&odd.square()?)?;
            let inner = match norm.as_rational() {
                Some(x) if x.sign() == Sign::Negative => continue,
                Some(x) => Self::root(&x).filter(|c| c.as_rational().is_some()),
                None => norm.denested(depth - 1),
            };
            let Some(inner) = inner else { continue };
            for inner in [inner.negated(), inner] {
                let Some(root) = even.add(&inner)?.halved().denested(depth - 1) else {
                    continue;
                };
                if root.is_zero() {
                    continue;
                }
                let whole = root.add(&odd.mul(&root.inverse()?)?.halved())?;
                if whole.square()?.sub(self)?.is_zero() {
                    return match whole.sign()? {
                        Sign::Positive => Some(whole),
                        Sign::Negative => Some(whole.negated()),
                    };
                }
            }
        }
        None
    }

    /// The sign of a non-zero sum.
    fn sign(&self) -> Option<Sign> {
        let mut bits = 64;
        // A normal form within the limits is never closer to zero than this many bits can tell in practice; giving up
        // costs a normal form, not correctness.
        while bits <= 1 << 14 {
            if let Some(sign) = self.ball(Bits(bits)).ok()?.sign() {
                return Some(sign);
            }
            bits *= 2;
        }
        None
    }

    pub(super) fn ball(&self, bits: Bits) -> Clear<Ball> {
        let mut sum = bits.rational(&RBig::ZERO)?;
        for (d, c) in &self.terms {
            let coefficient = bits.rational(c)?;
            let term = if d.is_one() {
                coefficient
            } else {
                bits.mul(&coefficient, &bits.root_of_integer(d)?)?
            };
            sum = bits.add(&sum, &term)?;
        }
        Ok(sum)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn root(n: i64) -> Surd {
        Surd::root(&RBig::from(n)).unwrap()
    }

    fn sum(terms: &[(i64, i64)]) -> Surd {
        let mut sum = Surd::rational(RBig::ZERO);
        for &(c, d) in terms {
            let term = root(d).mul(&Surd::rational(RBig::from(c))).unwrap();
            sum = sum.add(&term).unwrap();
        }
        sum
    }

    fn same(a: &Surd, b: &Surd) -> bool {
        a.sub(b).unwrap().is_zero()
    }

    #[test]
    fn roots_of_rationals() {
        assert_eq!(root(72).terms, [(UBig::from(2u8), RBig::from(6))]);
        let x = RBig::from_parts(3.into(), 4u8.into());
        assert!(same(&Surd::root(&x).unwrap(), &root(3).halved()));
        assert_eq!(root(49).as_rational(), Some(RBig::from(7)));
    }

    #[test]
    fn inverse_times_itself_is_one() {
        for terms in [
            vec![(1, 2)],
            vec![(1, 1), (1, 2)],
            vec![(1, 2), (1, 3), (1, 5)],
            vec![(3, 1), (-2, 2), (7, 6), (1, 10), (1, 77)],
        ] {
            let s = sum(&terms);
            let product = s.mul(&s.inverse().unwrap()).unwrap();
            assert_eq!(product.as_rational(), Some(RBig::ONE), "{terms:?}");
        }
        assert!(Surd::rational(RBig::ZERO).inverse().is_none());
    }

    #[test]
    fn squares_denest() {
        for terms in [
            vec![(1, 2), (1, 3)],
            vec![(1, 6), (-1, 2)],
            vec![(1, 2), (1, 3), (1, 6)],
            vec![(5, 1), (4, 3)],
            vec![(1, 1), (1, 2), (1, 3), (1, 6)],
        ] {
            let s = sum(&terms);
            assert!(same(&s.square().unwrap().sqrt().unwrap(), &s), "{terms:?}");
        }
    }

    #[test]
    fn what_does_not_denest_is_left() {
        assert!(sum(&[(2, 1), (1, 2)]).sqrt().is_none());
        assert!(sum(&[(10, 1), (-2, 5)]).sqrt().is_none());
        assert!(sum(&[(1, 2)]).sqrt().is_none());
    }

    #[test]
    fn limits_hold() {
        let mut many = Surd::rational(RBig::ONE);
        for p in [2, 3, 5, 7, 11, 13] {
            many = many.mul(&sum(&[(1, 1), (1, p)])).unwrap();
        }
        assert_eq!(many.terms().len(), 64);
        assert!(many.mul(&sum(&[(1, 1), (1, 17)])).is_none());
    }
}
