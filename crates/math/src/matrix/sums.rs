//! Sums of products in many digits: added up in integers and rounded once, which takes a third of the time of rounding every term, and
//! loses less.

use dashu_base::BitTest;
use dashu_float::Repr;
use dashu_int::IBig;

/// What lies so many times the precision asked for, and [`GUARD`] bits, below the largest term is left off: far below the rounding of
/// what is left after any cancellation that leaves a digit.
const REACH: isize = 3;
const GUARD: isize = 64;

/// A sum of binary numbers, exact but for what is out of reach of its largest term.
pub(super) struct Sum {
    digits: IBig,
    exponent: isize,
    reach: isize,
}

impl Sum {
    /// Nothing yet, of which so many bits are wanted.
    pub fn new(bits: usize) -> Self {
        let bits = isize::try_from(bits).unwrap_or(isize::MAX);
        Self {
            digits: IBig::ZERO,
            exponent: 0,
            reach: bits.saturating_mul(REACH).saturating_add(GUARD),
        }
    }

    /// Adds a number.
    pub fn add(&mut self, number: &Repr<2>) {
        self.take(number.significand().clone(), number.exponent());
    }

    /// Adds a product.
    pub fn add_product(&mut self, a: &Repr<2>, b: &Repr<2>) {
        let digits = a.significand() * b.significand();
        self.take(digits, a.exponent().saturating_add(b.exponent()));
    }

    fn take(&mut self, digits: IBig, exponent: isize) {
        if digits.is_zero() {
            return;
        }
        if self.digits.is_zero() {
            (self.digits, self.exponent) = (digits, exponent);
            return;
        }
        let most = top(&digits, exponent).max(top(&self.digits, self.exponent));
        let least = self.exponent.min(exponent);
        let least = least.max(most.saturating_sub(self.reach));
        let own = shifted(std::mem::take(&mut self.digits), self.exponent, least);
        self.digits = own + shifted(digits, exponent, least);
        self.exponent = least;
    }

    /// What was added up.
    pub fn into_repr(self) -> Repr<2> {
        Repr::new(self.digits, self.exponent)
    }
}

/// The exponent of the bit above the highest.
fn top(digits: &IBig, exponent: isize) -> isize {
    exponent.saturating_add_unsigned(digits.bit_len())
}

/// Digits at another exponent; what falls below it is cut off.
fn shifted(digits: IBig, from: isize, to: isize) -> IBig {
    let by = from.saturating_sub(to);
    match by {
        0 => digits,
        1.. => digits << by.unsigned_abs(),
        _ => digits >> by.unsigned_abs(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::big::Big;
    use super::super::real::{Real, Ring, dot_term_by_term};
    use super::super::{Extended, SplitMix64};

    #[test]
    fn sums_of_products_are_rounded_once() {
        let mut random = SplitMix64::new(7);
        for bits in [120u32, 300, 736] {
            let like = Big::new(1.0, bits);
            let fine = Big::new(1.0, 4 * bits);
            let mut number = |spread: i32| {
                let size = 2f64.powi((random.symmetric() * f64::from(spread)) as i32);
                let thirds = like.constant(random.symmetric() * size) / like.constant(3.0);
                (thirds.clone(), thirds.with_bits(4 * bits))
            };
            for spread in [1, 60, 500] {
                let (a, exact_a): (Vec<_>, Vec<_>) = (0..9).map(|_| number(spread)).unzip();
                let (b, exact_b): (Vec<_>, Vec<_>) = (0..9).map(|_| number(spread)).unzip();
                let exact = dot_term_by_term(&fine, &exact_a, &exact_b).with_bits(bits);
                assert_eq!(like.dot(&a, &b), exact, "{bits} bits, 2^±{spread}");
                let mut sums = b.clone();
                a[0].add_scaled(&a, &mut sums);
                for ((sum, x), y) in sums.iter().zip(&exact_a).zip(&exact_b) {
                    let exact = y.clone() + exact_a[0].clone() * x.clone();
                    assert_eq!(*sum, exact.with_bits(bits), "{bits} bits, 2^±{spread}");
                }
            }
        }
    }

    /// What cancels leaves what it has to, and nothing far off does harm.
    #[test]
    fn terms_of_any_sizes_are_added() {
        let like = Extended::new(1.0, 200);
        let far = |exponent: i32| -> Extended {
            let base = like.constant(if exponent < 0 { 0.5 } else { 2.0 });
            (0..exponent.abs()).fold(like.one_like(), |x, _| x * base.clone())
        };
        let one = like.one_like();
        let [large, small] = [far(5000), far(-5000)];
        let a = [large.clone(), small.clone(), -large.clone(), one.clone()];
        let b = [one.clone(), one.clone(), one.clone(), like.constant(3.0)];
        assert_eq!(like.dot(&a, &b).to_f64(), 3.0);
        assert_eq!(like.dot(&a[1..2], &b[1..2]), small);
        assert!(like.dot(&[], &[]).is_zero());
        let nan = like.constant(f64::NAN);
        assert!(!like.dot(&[nan], &b[..1]).is_finite());
        // Pairs of doubles among them are taken as they are.
        let short = [Extended::new(2.0, 100)];
        assert_eq!(like.dot(&short, &b[3..]).to_f64(), 6.0);
    }
}
