//! Bounds of the dimension at the drawn pose that take no basis.
//!
//! Every component through a solution of m equations in n unknowns has dimension n − m at least (Krull's height theorem), and its
//! tangent space lies in the kernel of their derivatives. The tree form has few equations, and as many dimensions at a pose as
//! the others or less: they determine the poses of all links. A rank modulo a prime is never larger than the true one.

use super::ExactOptions;
use crate::system::ModularSystem;
use crate::{Formulation, Origin, PolynomialSystem, SystemOptions, polynomial_system};
use kutzbach_model::mechanism::Mechanism;

/// Memory that the equations moved to the pose may take (bytes).
const MEMORY: u64 = 200_000_000;

/// Least and largest complex dimension at the drawn pose; `None` where it is no exact solution.
pub(super) fn bounds(
    mechanism: &Mechanism,
    options: &ExactOptions,
    system: &PolynomialSystem,
) -> Option<(usize, usize)> {
    system.home.exact()?;
    let most = nullity(&system.home_modulo(0, MEMORY)?);
    let tree = SystemOptions {
        formulation: Formulation::Tree,
        ..options.system.clone()
    };
    let tree = polynomial_system(mechanism, &tree).ok();
    let exact = tree.filter(|tree| tree.home.exact().is_some());
    let least = exact.as_ref().map_or(0, least);
    Some((least.max(self::least(system)).min(most), most))
}

/// Unknowns less equations.
fn least(system: &PolynomialSystem) -> usize {
    let unknowns = system.variables.iter();
    let unknowns = unknowns
        .filter(|v| !v.meaning.is_algebraic_number())
        .count();
    let of_numbers = |origin| matches!(origin, Origin::MinimalPolynomial { .. });
    let equations = system.equations.iter().filter(|e| !of_numbers(e.origin));
    unknowns.saturating_sub(equations.count())
}

/// Unknowns less the rank of the linear terms.
fn nullity(system: &ModularSystem) -> usize {
    let count = system.variables.len();
    let p = u128::from(system.prime);
    let times = |a: u64, b: u64| (u128::from(a) * u128::from(b) % p) as u64;
    let inverse = |a: u64| {
        let (mut power, mut base, mut left) = (1, a, system.prime - 2);
        while left > 0 {
            if left & 1 == 1 {
                power = times(power, base);
            }
            base = times(base, base);
            left >>= 1;
        }
        power
    };
    let mut pivots: Vec<Option<Vec<u64>>> = vec![None; count];
    for equation in &system.equations {
        let mut row = vec![0; count];
        for (exponents, coefficient) in equation {
            if exponents.iter().sum::<u32>() == 1
                && let Some(place) = exponents.iter().position(|&e| e == 1)
            {
                row[place] = *coefficient;
            }
        }
        for place in 0..count {
            if row[place] == 0 {
                continue;
            }
            match &pivots[place] {
                Some(pivot) => {
                    let factor = row[place];
                    for (entry, &own) in row.iter_mut().zip(pivot) {
                        let less = times(factor, own);
                        *entry = ((u128::from(*entry) + p - u128::from(less)) % p) as u64;
                    }
                }
                None => {
                    let scale = inverse(row[place]);
                    row.iter_mut()
                        .for_each(|entry| *entry = times(*entry, scale));
                    pivots[place] = Some(row);
                    break;
                }
            }
        }
    }
    count - pivots.iter().flatten().count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_terms_have_a_rank() {
        // x + y + x², 2x + 2y, z: rank two of three.
        let system = ModularSystem {
            prime: 1_000_003,
            variables: vec![0, 1, 2],
            equations: vec![
                vec![(vec![1, 0, 0], 1), (vec![0, 1, 0], 1), (vec![2, 0, 0], 1)],
                vec![(vec![1, 0, 0], 2), (vec![0, 1, 0], 2)],
                vec![(vec![0, 0, 1], 5)],
            ],
        };
        assert_eq!(nullity(&system), 1);
    }
}
