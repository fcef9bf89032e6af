//! Singular poses at which the quadratic terms left over vanish on a few linear spaces: modes of motion that exclude one another.
//!
//! Let X be the germ, and L₁, …, Lₘ the linear spaces that are the zeros of its quadratic terms, simply but for the origin
//! ([`linear_arrangement`]). Then the tangent cone of X lies in their union. If each Lᵢ is the tangent space of a smooth
//! branch Bᵢ of X, the cone of the union of these branches contains ∪ Lᵢ as well, so that both cones, and with them both Hilbert
//! functions, are the same from some degree on; and since ∪ Bᵢ lies in X, it is X but for the origin. So there are no other
//! branches, whatever the terms of higher degree are. That the branches exist shows where the mechanism is closed on them and
//! followed.

use super::super::claim::{Answer, Bounds, Claim};
use super::super::germ::{Germ, linear_arrangement, quadratic_form};
use super::super::germ_zeros::GermBranch;
use super::super::judge::PartFinding;
use super::super::lifting::{Start, lift_all};
use super::super::pose_rank::PartRank;
use super::super::vocabulary::{EngineName, Scope, SingularKind};
use super::known_branches::{RADII, curve_along, scaled, sheet};
use kutzbach_math::matrix::{MatrixError, SplitMix64};
use nalgebra::{DMatrix, DVector};

/// A form exceeds its error by this factor, or is none.
const CLEARANCE: f64 = 1e4;

/// Fills a finding where the zeros of the quadratic terms are linear spaces and each of them is a branch; tells whether it did.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub(super) fn by_arrangement(
    found: &mut PartFinding,
    start: &Start<'_>,
    rank: &PartRank,
) -> Result<bool, MatrixError> {
    let Some(germ) = Germ::of_part_across(start.pose.mechanism, rank, 2, start.idle)? else {
        return Ok(false);
    };
    let forms: Vec<DMatrix<f64>> = germ.equations().iter().map(quadratic_form).collect();
    let clear = |form: &DMatrix<f64>| form.norm() > CLEARANCE * germ.noise(2);
    if !forms.iter().all(clear) {
        return Ok(false);
    }
    let Some(spaces) = linear_arrangement(&forms) else {
        return Ok(false);
    };
    let branches: Vec<GermBranch> = spaces.iter().map(branch_along).collect();
    let Ok(lifted) = lift_all(start, &germ, &branches)? else {
        return Ok(false);
    };
    if lifted.iter().any(|lifted| lifted.shaky) {
        return Ok(false);
    }
    let idle = start.idle.len();
    let mut dimensions: Vec<usize> = lifted.iter().map(|l| l.branch.dimension).collect();
    dimensions.sort_unstable();
    let finite = dimensions.last().copied().unwrap_or(0);
    let text = format!(
        "{} quadratic forms in {} variables, whose zeros are {} linear spaces, of dimensions {dimensions:?} with what is idle; each is \
         tangent to a branch",
        forms.len(),
        germ.freedom(),
        spaces.len()
    );
    let answer = Answer {
        kind: match dimensions.as_slice() {
            [] | [_] => None,
            [least, .., most] if least == most => Some(SingularKind::Bifurcation),
            _ => Some(SingularKind::Kinematotropic),
        },
        branches: Some(lifted.into_iter().map(|l| l.branch).collect()),
        ..Answer::numeric(format!(
            "the quadratic terms that the equations leave over vanish on {} linear spaces only; the loops close along a branch tangent \
             to each, so that there are no others (equal Hilbert functions)",
            spaces.len()
        ))
    };
    let finite = Bounds::exactly(finite);
    let claim = Claim::of(
        EngineName::SecondOrder,
        Scope::RealNeighbourhood,
        finite,
        text,
    );
    let complex = spaces.iter().map(DMatrix::ncols).max().unwrap_or(0) + idle;
    found.take(Claim {
        complex: Bounds::exactly(complex),
        ..claim.decides(answer)
    });
    Ok(true)
}

/// A smooth branch with a tangent space, and points of that space in general position.
fn branch_along(space: &DMatrix<f64>) -> GermBranch {
    let mut random = SplitMix64::named("arrangement of branches");
    let direction = |random: &mut SplitMix64| -> Vec<f64> {
        let weights = DVector::from_fn(space.ncols(), |_, _| random.symmetric());
        (space * weights).as_slice().to_vec()
    };
    let points = RADII
        .iter()
        .map(|&radius| scaled(&direction(&mut random), radius))
        .collect();
    match space.ncols() {
        1 => GermBranch {
            points,
            ..curve_along(space.column(0).as_slice(), true)
        },
        many => sheet(many, points),
    }
}
