//! Bounds of the dimension at the drawn pose that take no basis.
//!
//! Every component through a solution of m equations in n unknowns has dimension n − m at least (Krull's height theorem), and its
//! tangent space lies in the kernel of their derivatives. The tree form has few equations, and as many dimensions at a pose as
//! the others or less: they determine the poses of all links. A rank modulo a prime is never larger than the true one.

use super::ExactOptions;
use crate::strategy::{RelationFinding, RelationVerdict, Relations};
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

/// Six freedoms of one body seen from another.
const FREE: usize = 6;

/// Of the relations after those with findings, in positional form, which are accepted by what they forbid to first order at the drawn pose; none is
/// where that pose is no exact solution, and of the others nothing is said.
///
/// What earlier relations leave is smooth at the pose if their derivatives are independent there, with as many as each has by itself, and its
/// tangents are their kernel. A relation that vanished wherever they do would have derivatives that vanish on all of these. The pose satisfies it with them, so
/// that it is not inconsistent either. Ranks are those modulo a prime, which are never too large; that they are not too small is seen
/// by the freedoms of the joints and of the bodies.
#[must_use]
pub fn accepted_at_home(
    mechanism: &Mechanism,
    (system, given): (&PolynomialSystem, &Relations),
    findings: &[RelationFinding],
) -> Vec<bool> {
    let later = given.relations.len() - findings.len();
    let mut accepted = vec![false; later];
    if given.bodies.is_none() || system.home.exact().is_none() {
        return accepted;
    }
    let left = |relations: &[usize]| {
        let names = relations.iter().map(|&r| given.relations[r].name.as_str());
        nullity_with(mechanism, system, &names.collect::<Vec<_>>())
    };
    let forbidden = |relation: usize| {
        let joint = mechanism.joint_named(&given.relations[relation].name)?;
        Some(FREE - mechanism.joint(joint).freedom())
    };
    let free = FREE * (mechanism.links().len() - 1);
    if left(&[]) != Some(free) {
        return accepted;
    }
    let told = findings.iter().enumerate();
    let told = told.filter(|(_, finding)| finding.verdict == RelationVerdict::Accepted);
    let mut before: Vec<usize> = told.map(|(relation, _)| relation).collect();
    // What all of these forbid together, and each by itself.
    let smooth = |relations: &[usize]| {
        let own = relations.iter().map(|&r| {
            let forbidden = forbidden(r)?;
            (left(&[r])? + forbidden == free).then_some(forbidden)
        });
        let sum: usize = own.sum::<Option<usize>>()?;
        let left = left(relations)?;
        (left + sum == free).then_some(left)
    };
    for (place, relation) in (findings.len()..given.relations.len()).enumerate() {
        let Some(dimension) = smooth(&before) else {
            break;
        };
        before.push(relation);
        match left(&before) {
            Some(left) if left < dimension => accepted[place] = true,
            _ => break,
        }
    }
    accepted
}

/// Unknowns less the rank at the drawn pose of what always holds and of joints of these names.
fn nullity_with(
    mechanism: &Mechanism,
    system: &PolynomialSystem,
    joints: &[&str],
) -> Option<usize> {
    let mut part = system.clone();
    part.equations.retain(|equation| match equation.origin {
        Origin::Joint { joint } => joints.contains(&mechanism.joint(joint).name.as_str()),
        Origin::Cycle { .. } | Origin::Coupling { .. } => false,
        _ => true,
    });
    Some(nullity(&part.home_modulo(0, MEMORY)?))
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
