//! Why the zeros that a search found may not be those there are.

use super::search::irreducible;
use crate::germ::{ComplexDimension, Germ, inertia};
use crate::germ_zeros::{GermBranch, GermZeros};
use nalgebra::DMatrix;

/// Sheets whose directions all lie in one linear space but for this share of their length may touch.
const TOUCHING: f64 = 0.05;

/// Why some of the branches found may be pieces of one, if they may.
pub(super) fn cut_in_pieces(
    zeros: &GermZeros,
    complex: Option<&ComplexDimension>,
) -> Option<&'static str> {
    // Every branch of full dimension has a share of the multiplicity, at least one.
    if let Some(complex) = complex {
        let full = zeros
            .branches
            .iter()
            .filter(|b| b.dimension == complex.dimension);
        if full.count() > complex.multiplicity {
            return Some(
                "more branches were found than the multiplicity of the pose allows, so that some are parts of one",
            );
        }
    }
    // Sheets that meet in the pose only and have one tangent space there may be one, as z² = x⁴ + y⁴ is.
    let pairs = zeros
        .branches
        .iter()
        .enumerate()
        .flat_map(|(i, a)| zeros.branches[i + 1..].iter().map(move |b| (a, b)));
    let touch = |(a, b): (&GermBranch, &GermBranch)| {
        a.dimension > 1 && a.dimension == b.dimension && directions(a, b) <= a.dimension
    };
    pairs.into_iter().any(touch).then_some(
        "sheets were found that touch in the pose, and whether they are parts of one is not told",
    )
}

/// Why some of the branches of a plane curve may be several, or some be overlooked, if they may: the multiplicity of the curve is the
/// sum of its branches', and what is not real comes in conjugate pairs.
pub(super) fn merged(germ: &Germ, zeros: &GermZeros) -> Option<&'static str> {
    if germ.freedom() != 2
        || germ.equations().len() != 1
        || !zeros.branches.iter().all(|branch| branch.reduced)
    {
        return None;
    }
    let found: Option<usize> = zeros
        .branches
        .iter()
        .map(|branch| branch.ramification)
        .sum();
    (found? % 2 != germ.order()? % 2).then_some(
        "the multiplicity of the pose is another than that of the branches found, so that some are overlooked or taken for one",
    )
}

/// Why the one sheet found may be two at a small angle, if it may: where the quadratic form is a product of two, the germ is u v + g of the
/// other variables (the splitting lemma), two sheets where g vanishes and one elsewhere.
pub(super) fn two_in_one(germ: &Germ, zeros: &GermZeros) -> Option<&'static str> {
    let ([equation], [only]) = (germ.equations(), &zeros.branches[..]) else {
        return None;
    };
    let whole = germ.freedom() >= 3 && only.dimension + 1 == germ.freedom();
    let product = || inertia(equation, germ.noise(2)) == (1, 1);
    (whole && only.reduced && product() && !irreducible(germ))
        .then_some("one sheet was found, and two that cross at a small angle would look the same")
}

/// The dimension of the space that the directions of two branches span, but for a small share.
fn directions(a: &GermBranch, b: &GermBranch) -> usize {
    let tangents: Vec<&Vec<f64>> = a.tangents.iter().chain(&b.tangents).collect();
    let size = tangents.first().map_or(0, |t| t.len());
    if size == 0 {
        return 0;
    }
    let matrix = DMatrix::from_fn(tangents.len(), size, |i, j| tangents[i][j]);
    let values = matrix.singular_values();
    values
        .iter()
        .filter(|value| **value > TOUCHING * values.amax())
        .count()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Branches that are known by no direction may be parts of one.
    #[test]
    fn branches_without_tangents_span_nothing() {
        let branch = GermBranch {
            dimension: 2,
            half_branches: Vec::new(),
            points: Vec::new(),
            tangents: Vec::new(),
            ramification: None,
            reduced: true,
            vanishing_order: None,
            hits: 1,
        };
        assert_eq!(directions(&branch, &branch), 0);
        let zeros = GermZeros {
            branches: vec![branch.clone(), branch],
            isolation: None,
            starts: 0,
            seed: 0,
            radii: Vec::new(),
            thin: None,
            work: 0,
            varies: false,
        };
        assert!(cut_in_pieces(&zeros, None).is_some());
    }
}
