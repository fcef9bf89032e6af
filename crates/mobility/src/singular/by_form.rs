//! Singular poses at which one quadratic form of full rank is left over.
//!
//! By Morse's lemma the germ is then the cone of that form up to a change of coordinates, however many variables it has and whatever
//! its terms of higher degree are: of rank three or more and indefinite it is one branch of one dimension less. Folded polygons and
//! flat vertices are of this kind. Other equations might still cut the cone down; that a point of it closes on all of them, and
//! moves with that dimension, shows that none does, since an irreducible germ has no other part of its dimension.

use super::super::claim::{Answer, Bounds, Claim};
use super::super::germ::{Germ, quadratic_form, signature};
use super::super::judge::PartFinding;
use super::super::lifting::{Start, lift_all};
use super::super::pose_rank::PartRank;
use super::super::vocabulary::{EngineName, Scope};
use super::known_branches::{cone, sheet};
use kutzbach_math::matrix::MatrixError;

/// Fills a finding where one indefinite form of full rank is left over and its cone is a branch; tells whether it did.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub(super) fn by_form(
    found: &mut PartFinding,
    start: &Start<'_>,
    rank: &PartRank,
) -> Result<bool, MatrixError> {
    let Some(germ) = Germ::of_part_across(start.pose.mechanism, rank, 2, start.idle)? else {
        return Ok(false);
    };
    let [equation] = germ.equations() else {
        return Ok(false);
    };
    let Some((plus, minus)) = signature(equation, germ.noise(2)) else {
        return Ok(false);
    };
    if plus == 0 || minus == 0 || plus + minus < 3 {
        return Ok(false);
    }
    let dimension = germ.freedom() - 1;
    let eigen = quadratic_form(equation).symmetric_eigen();
    let vectors = eigen.eigenvectors.column_iter();
    let vectors: Vec<Vec<f64>> = vectors.map(|v| v.iter().copied().collect()).collect();
    let points = cone(eigen.eigenvalues.as_slice(), &vectors, &[]);
    let Ok(lifted) = lift_all(start, &germ, &[sheet(dimension, points)])? else {
        return Ok(false);
    };
    if lifted.iter().any(|lifted| lifted.shaky) {
        return Ok(false);
    }
    let idle = start.idle.len();
    let text = format!(
        "one quadratic form of full rank in {} variables, signature ({plus}, {minus}): its cone is irreducible (Morse's lemma)",
        germ.freedom()
    );
    let answer = Answer {
        branches: Some(lifted.into_iter().map(|l| l.branch).collect()),
        ..Answer::numeric(
            "what the equations leave over is one quadratic form of full rank, so that near this pose the solutions are its cone, one \
             branch (Morse's lemma), which the loops close along",
        )
    };
    let finite = Bounds::exactly(dimension + idle);
    let claim = Claim::of(
        EngineName::SecondOrder,
        Scope::RealNeighbourhood,
        finite,
        text,
    );
    found.take(claim.decides(answer));
    Ok(true)
}
