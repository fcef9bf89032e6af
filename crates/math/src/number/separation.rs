//! How close to zero an algebraic expression can come without being zero.
//!
//! Write E = α/β with algebraic integers α, β. Let u bound |α| and l bound |β| together with all their conjugates, and let
//! D bound the degree of the field they lie in. If E ≠ 0, the norm of α is at least one, so |α| ≥ u^(1−D) and
//! |E| ≥ 1 / (u^(D−1) · l). The rules for u and l by operation are those of Burnikel, Funke, Mehlhorn, Schirra, Schmitt,
//! "A separation bound for real algebraic expressions", 2001, section 3; D doubles with every square root. Added here:
//! 2cos(kπ/n) is an algebraic integer whose conjugates are at most 2, in a field of degree at most φ(4n) together with the
//! sine, common to all such values if n is taken as the least common denominator.

use super::roots::coprime_base;
use super::surd::Surd;
use super::tree::Operation;
use super::{Exact, Form, Inner, Number};
use dashu_base::{BitTest, Gcd};
use dashu_int::UBig;
use std::collections::{BTreeSet, HashMap};

/// Bounds beyond this many bits are not used: checking them would take too long.
const MAX_PLACES: f64 = 20_000.0;

/// Base-two logarithms of u and l.
#[derive(Clone, Copy)]
struct Sizes {
    u: f64,
    l: f64,
}

/// Binary places b such that the value is zero if it is below 2^-b.
pub(super) fn bound(number: &Number) -> Option<i64> {
    let mut known: HashMap<*const Inner, Sizes> = HashMap::new();
    let mut radicands: BTreeSet<UBig> = BTreeSet::new();
    let mut nested = 0usize;
    let mut denominator = 1u64;
    let mut stack = vec![(number, false)];
    while let Some((x, ready)) = stack.pop() {
        let key = &raw const *x.0;
        if known.contains_key(&key) {
            continue;
        }
        let sizes = match &x.0.form {
            Form::Exact(Exact::Rational(x)) => Sizes {
                u: bits(&x.numerator().clone().into_parts().1),
                l: bits(x.denominator()),
            },
            Form::Exact(Exact::Surd(surd)) => {
                radicands.extend(surd.terms().map(|(d, _)| d.clone()));
                surd_sizes(surd)
            }
            Form::Exact(Exact::Algebraic(tree)) => {
                if let Operation::Cos | Operation::Sin | Operation::Tan = tree.operation {
                    denominator = denominator.max(1);
                    for operand in &tree.operands {
                        let Some(Exact::Angle(angle)) = operand.exact() else {
                            return None;
                        };
                        let n = u64::try_from(angle.pi_multiple().denominator().clone()).ok()?;
                        denominator = denominator / gcd(denominator, n) * n;
                        if denominator > 10_000 {
                            return None;
                        }
                    }
                    let size = if tree.operation == Operation::Tan {
                        2.0
                    } else {
                        1.0
                    };
                    Sizes { u: size, l: size }
                } else if !ready {
                    stack.push((x, true));
                    stack.extend(tree.operands.iter().map(|x| (x, false)));
                    continue;
                } else {
                    nested += usize::from(tree.operation == Operation::Sqrt);
                    let operands: Vec<Sizes> = tree
                        .operands
                        .iter()
                        .filter_map(|x| known.get(&(&raw const *x.0)).copied())
                        .collect();
                    combined(&tree.operation, &operands)?
                }
            }
            _ => return None,
        };
        known.insert(key, sizes);
    }
    let roots = nested + coprime_base(radicands.iter()).len();
    if roots > 12 {
        return None;
    }
    let circular = if denominator > 1 {
        totient(4 * denominator)
    } else {
        1
    };
    let degree = f64::from(1u32 << roots) * circular as f64;
    let Sizes { u, l } = *known.get(&(&raw const *number.0))?;
    let places = l + (degree - 1.0) * u + 1.0;
    (places <= MAX_PLACES).then_some(places.ceil() as i64)
}

fn combined(operation: &Operation, operands: &[Sizes]) -> Option<Sizes> {
    Some(match (operation, operands) {
        (Operation::Add, [a, b]) => Sizes {
            u: (a.u + b.l).max(a.l + b.u) + 1.0,
            l: a.l + b.l,
        },
        (Operation::Multiply, [a, b]) => Sizes {
            u: a.u + b.u,
            l: a.l + b.l,
        },
        (Operation::Divide, [a, b]) => Sizes {
            u: a.u + b.l,
            l: a.l + b.u,
        },
        (Operation::Negate, [a]) => *a,
        (Operation::Power(n), [a]) => {
            let power = f64::from(n.unsigned_abs());
            let (u, l) = if *n < 0 { (a.l, a.u) } else { (a.u, a.l) };
            Sizes {
                u: u * power,
                l: l * power,
            }
        }
        // √(α/β) = √(αβ)/β = α/√(αβ), whichever is smaller.
        (Operation::Sqrt, [a]) if a.u >= a.l => Sizes {
            u: (a.u + a.l) / 2.0,
            l: a.l,
        },
        (Operation::Sqrt, [a]) => Sizes {
            u: a.u,
            l: (a.u + a.l) / 2.0,
        },
        _ => return None,
    })
}

fn surd_sizes(surd: &Surd) -> Sizes {
    let common = surd.terms().fold(UBig::ONE, |product, (_, c)| {
        let shared = (&product).gcd(c.denominator());
        product / shared * c.denominator()
    });
    let l = bits(&common);
    // Each term times the common denominator is an integer times a root, at most 2^(bits of c + l + half those of d).
    let largest = surd.terms().map(|(d, c)| {
        let numerator = bits(&c.numerator().clone().into_parts().1);
        let quotient = l - bits(c.denominator()) + 1.0;
        numerator + quotient + bits(d) / 2.0
    });
    let count = surd.terms().len() as f64;
    Sizes {
        u: largest.fold(0.0, f64::max) + count.log2() + 1.0,
        l,
    }
}

/// Base-two logarithm rounded up.
fn bits(n: &UBig) -> f64 {
    n.bit_len() as f64
}

fn gcd(a: u64, b: u64) -> u64 {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// Euler's totient, for small n.
fn totient(n: u64) -> u64 {
    (1..=n).filter(|&k| gcd(k, n) == 1).count() as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn totients() {
        assert_eq!([1, 2, 9, 36, 100].map(totient), [1, 1, 6, 12, 40]);
    }

    #[test]
    fn bound_holds_for_a_value_known_to_be_small() {
        // √(2 + √2)^2 + ... : a nested root minus its continued fraction convergent is small, yet above the bound.
        let nested = Number::expression("sqrt(2+sqrt(2)) - 1847759/1000000", &mut |_| Ok(None));
        let Ok(small) = nested else {
            unreachable!("the text is an expression")
        };
        let places = bound(&small).map_or(0.0, |b| b as f64);
        assert!(small.value().abs().log2() > -places && small.value().abs() < 1e-6);
        assert!(places > 20.0 && places < 300.0, "{places}");
    }
}
