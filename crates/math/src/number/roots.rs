//! Square roots of natural numbers: what comes out of the root, and which roots are independent.
//!
//! The square roots of d1, ..., dn are linearly independent over the rationals exactly when no product di·dj is a square
//! (Besicovitch 1940). That is weaker than being squarefree, which matters here: a radicand read from a file with sixty
//! decimals cannot be factored, but whether a product of two is a square is a matter of one gcd.

use dashu_base::{BitTest, Gcd, SquareRoot};
use dashu_int::UBig;

/// Primes below this are divided out.
const SMALL: u32 = 1024;

/// Below this, a number whose small square factors are out is squarefree: what is left has at most two prime factors,
/// each at least [`SMALL`], and is not a square itself.
const FACTORED: u64 = (SMALL as u64) * (SMALL as u64) * (SMALL as u64);

/// The exact square root, if `n` is a square.
pub(super) fn exact_root(n: &UBig) -> Option<UBig> {
    let root = n.sqrt();
    (&root * &root == *n).then_some(root)
}

/// `n = s²·d`: returns (s, d), d with no square of a prime below [`SMALL`], and d = 1 if n is a square. `n` is not zero.
pub(super) fn split_square(n: &UBig) -> (UBig, UBig) {
    if let Some(root) = exact_root(n) {
        return (root, UBig::ONE);
    }
    let mut rest = n.clone();
    let (mut outside, mut inside) = (UBig::ONE, UBig::ONE);
    for p in small_primes() {
        if rest.is_one() {
            break;
        }
        let mut count = 0u32;
        while &rest % p == 0 {
            rest /= p;
            count += 1;
        }
        if count > 0 {
            outside *= UBig::from(p).pow((count / 2) as usize);
            if count % 2 == 1 {
                inside *= p;
            }
        }
    }
    match exact_root(&rest) {
        Some(root) => (outside * root, inside),
        None => (outside, inside * rest),
    }
}

fn small_primes() -> impl Iterator<Item = u32> {
    const fn is_prime(n: u32) -> bool {
        let mut divisor = 2;
        while divisor * divisor <= n {
            if n.is_multiple_of(divisor) {
                return false;
            }
            divisor += 1;
        }
        n > 1
    }
    const SIEVE: [bool; SMALL as usize] = {
        let mut sieve = [false; SMALL as usize];
        let mut n = 2;
        while n < SMALL {
            sieve[n as usize] = is_prime(n);
            n += 1;
        }
        sieve
    };
    (2..SMALL).filter(|&n| SIEVE[n as usize])
}

/// Whether `a`, as returned by [`split_square`], is certainly squarefree.
pub(super) fn is_factored(a: &UBig) -> bool {
    *a < UBig::from(FACTORED)
}

/// `√a·√b = s·√d`: returns (s, d) for radicands that came out of [`split_square`].
pub(super) fn root_product(a: &UBig, b: &UBig) -> (UBig, UBig) {
    if a.is_one() || b.is_one() {
        return (UBig::ONE, a * b);
    }
    let common = a.gcd(b);
    let product = (a / &common) * (b / &common);
    // Coprime squarefree factors have a squarefree product; otherwise look again.
    if is_factored(a) && is_factored(b) {
        (common, product)
    } else {
        let (outside, inside) = split_square(&product);
        (common * outside, inside)
    }
}

/// If √a is a rational multiple of √b, that multiple as (numerator, denominator).
pub(super) fn root_ratio(a: &UBig, b: &UBig) -> Option<(UBig, UBig)> {
    if a == b {
        return Some((UBig::ONE, UBig::ONE));
    }
    if is_factored(a) && is_factored(b) {
        return None;
    }
    let common = a.gcd(b);
    Some((exact_root(&(a / &common))?, exact_root(&(b / &common))?))
}

/// Pairwise coprime non-squares, each greater than one, such that every given number is a product of their powers times
/// a square. Flipping the sign of the square root of one of them is then an automorphism of the field of all roots.
pub(super) fn coprime_base<'a>(numbers: impl Iterator<Item = &'a UBig>) -> Vec<UBig> {
    let mut base: Vec<UBig> = Vec::new();
    for number in numbers {
        let mut work = vec![number.clone()];
        while let Some(x) = work.pop() {
            if x.is_one() {
                continue;
            }
            let shared = base.iter().position(|b| !b.gcd(&x).is_one());
            match shared {
                None => base.push(x),
                Some(index) if base[index] == x => {}
                Some(index) => {
                    let b = base.swap_remove(index);
                    let common = (&b).gcd(&x);
                    work.push(b / &common);
                    work.push(x / &common);
                    work.push(common);
                }
            }
        }
    }
    base.retain(|b| exact_root(b).is_none());
    base.sort();
    base
}

/// Whether `b` divides `n` an odd number of times.
pub(super) fn divides_oddly(b: &UBig, n: &UBig) -> bool {
    let mut rest = n.clone();
    rest.remove(b).unwrap_or(0) % 2 == 1
}

/// Number of bits of the largest radicand kept in a normal form.
pub(super) const MAX_RADICAND_BITS: usize = 4_000;

/// Whether a radicand is small enough to be worked with.
pub(super) fn is_moderate(n: &UBig) -> bool {
    n.bit_len() <= MAX_RADICAND_BITS
}

#[cfg(test)]
mod tests {
    use super::*;

    fn n(x: u64) -> UBig {
        UBig::from(x)
    }

    #[test]
    fn squares_come_out() {
        assert_eq!(split_square(&n(72)), (n(6), n(2)));
        assert_eq!(split_square(&n(49)), (n(7), n(1)));
        assert_eq!(split_square(&n(1_000_003)), (n(1), n(1_000_003)));
        // A prime beyond the table, squared, times a small one.
        assert_eq!(
            split_square(&n(1_000_003 * 1_000_003 * 5)),
            (n(1_000_003), n(5))
        );
    }

    #[test]
    fn hidden_squares_are_found_by_comparison() {
        let (p, q) = (n(1_000_003), n(1_000_033));
        let hidden = &p * &p * &q;
        assert_eq!(split_square(&hidden), (n(1), hidden.clone()));
        assert_eq!(root_ratio(&hidden, &q), Some((p.clone(), n(1))));
        assert_eq!(root_product(&hidden, &q), (p * q, n(1)));
        assert_eq!(root_ratio(&n(6), &n(10)), None);
    }

    #[test]
    fn base_is_coprime() {
        let base = coprime_base([n(6), n(10), n(15), n(7)].iter());
        assert_eq!(base, [n(2), n(3), n(5), n(7)]);
        assert!(divides_oddly(&n(3), &n(6)) && !divides_oddly(&n(3), &n(18)));
        assert_eq!(coprime_base([n(12), n(4), n(9)].iter()), [n(3)]);
    }
}
