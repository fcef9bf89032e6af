//! Mechanisms without loops, whose solutions are known without polynomials.
//!
//! Where no loop closes, joints are tied by couplings alone. Where those are linear, the solutions are an affine space, at
//! every pose, and its dimension is the number of joint variables less the rank of the couplings. Fractions decide it. A
//! tree of forty joints would otherwise need forty pairs of sines and cosines, and origins with algebraic angles, to say
//! the same.

use dashu_ratio::RBig;
use kutzbach_model::graph::ConstraintGraph;
use kutzbach_model::mechanism::{Coupling, Mechanism};
use std::collections::BTreeMap;

/// The solutions of a mechanism without loops.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WithoutLoops {
    /// Joint variables, and six for each piece that no joint connects with the ground.
    pub variables: usize,
    /// Coupling equations.
    pub couplings: usize,
    /// How many of them are independent.
    pub rank: usize,
    /// Dimension of the solutions, real and complex alike; `None` where the couplings contradict one another.
    pub dimension: Option<usize>,
}

/// The solutions, if the mechanism has no loop and its couplings are linear, of rational numbers. Linear in the joints, and cubic in
/// the couplings at most.
#[must_use]
pub fn without_loops(mechanism: &Mechanism) -> Option<WithoutLoops> {
    let graph = ConstraintGraph::of(mechanism);
    if graph.loop_count() > 0 {
        return None;
    }
    let rows = rows(mechanism.couplings())?;
    let variables = mechanism.freedom() + 6 * (graph.components().len() - 1);
    let couplings = rows.len();
    let (rank, consistent) = eliminated(rows);
    Some(WithoutLoops {
        variables,
        couplings,
        rank,
        dimension: consistent.then(|| variables - rank),
    })
}

/// The couplings as rows, the right side behind all joints; `None` where a number is not rational or a coupling not linear.
pub(super) fn rows<'a>(
    couplings: impl IntoIterator<Item = &'a Coupling>,
) -> Option<Vec<BTreeMap<usize, RBig>>> {
    let mut rows = Vec::new();
    for coupling in couplings {
        if !coupling.is_linear() {
            return None;
        }
        let mut row = BTreeMap::new();
        for term in &coupling.terms {
            row.insert(term.joint.0, term.factor.rational()?.clone());
        }
        row.insert(usize::MAX, coupling.offset.rational()?.clone());
        rows.push(row);
    }
    Some(rows)
}

/// Rank of the left sides, and whether no row says that nothing is something (Gauss).
pub(super) fn eliminated(mut rows: Vec<BTreeMap<usize, RBig>>) -> (usize, bool) {
    let mut rank = 0;
    let mut consistent = true;
    while let Some(mut pivot) = rows.pop() {
        pivot.retain(|_, x| !x.is_zero());
        let Some((column, leading)) = pivot.iter().next().map(|(c, x)| (*c, x.clone())) else {
            continue;
        };
        if column == usize::MAX {
            consistent = false;
            continue;
        }
        rank += 1;
        for row in &mut rows {
            let Some(entry) = row.get(&column).cloned() else {
                continue;
            };
            let factor = entry / leading.clone();
            for (column, x) in &pivot {
                let slot = row.entry(*column).or_insert(RBig::ZERO);
                *slot = slot.clone() - factor.clone() * x.clone();
            }
            row.remove(&column);
        }
    }
    (rank, consistent)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use kutzbach_math::number::Number;
    use kutzbach_model::mechanism::{JointBuilder, JointKind, MechanismBuilder};

    fn arm() -> MechanismBuilder {
        let mut builder = MechanismBuilder::new("arm");
        builder.link("l0");
        for i in 1..=4 {
            builder.link(&format!("l{i}"));
            builder.joint(JointBuilder::tree(
                &format!("j{i}"),
                JointKind::Revolute,
                &format!("l{}", i - 1),
                &format!("l{i}"),
            ));
        }
        builder
    }

    fn found(builder: &MechanismBuilder) -> WithoutLoops {
        without_loops(&builder.clone().build().unwrap()).unwrap()
    }

    #[test]
    fn a_tree_has_its_joints_freedoms_less_independent_couplings() {
        let mut builder = arm();
        assert_eq!(found(&builder).dimension, Some(4));
        builder.mimic("j2", "j1", Number::one(), Number::zero());
        builder.mimic("j3", "j2", Number::one(), Number::zero());
        let all = found(&builder);
        assert_eq!((all.couplings, all.rank, all.dimension), (2, 2, Some(2)));
    }

    #[test]
    fn what_follows_takes_nothing_and_what_contradicts_leaves_nothing() {
        let row = |terms: &[(usize, i64)], right: i64| {
            let mut row: BTreeMap<usize, RBig> =
                terms.iter().map(|(j, x)| (*j, RBig::from(*x))).collect();
            row.insert(usize::MAX, RBig::from(right));
            row
        };
        let two = || vec![row(&[(0, 1), (1, -1)], 0), row(&[(1, 1), (2, -1)], 0)];
        assert_eq!(eliminated(two()), (2, true));
        let mut follows = two();
        follows.push(row(&[(0, 2), (2, -2)], 0));
        assert_eq!(eliminated(follows), (2, true));
        let mut contradicts = two();
        contradicts.push(row(&[(0, 2), (2, -2)], 1));
        assert_eq!(eliminated(contradicts), (2, false));
    }

    #[test]
    fn loops_are_another_question() {
        let mut builder = arm();
        builder.joint(JointBuilder::closing(
            "loop",
            JointKind::Revolute,
            "l4",
            "l0",
        ));
        assert_eq!(without_loops(&builder.build().unwrap()), None);
    }
}
