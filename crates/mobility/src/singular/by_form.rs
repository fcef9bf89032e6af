//! Singular poses at which one quadratic form of full rank is left over.
//!
//! By Morse's lemma the germ is then the cone of that form up to a change of coordinates, however many variables it has and whatever
//! its terms of higher degree are: of rank three or more and indefinite it is one branch of one dimension less. Folded polygons and
//! flat vertices are of this kind. Other equations might still cut the cone down; that a point of it closes on all of them, and
//! moves with that dimension, shows that none does, since an irreducible germ has no other part of its dimension.

use super::super::germ::{Germ, quadratic_form, signature};
use super::super::germ_zeros::GermBranch;
use super::super::lifting::{Start, lift_all};
use super::super::part_mobility::{Evidence, PartFinding};
use super::super::pose_rank::PartRank;
use kutzbach_math::matrix::{MatrixError, SplitMix64};

/// Distances from the pose at which points of the cone are brought to the mechanism.
const RADII: [f64; 4] = [0.1, 0.05, 0.02, 0.2];

/// Points tried at each distance.
const POINTS: usize = 3;

/// Fills a finding where one indefinite form of full rank is left over and its cone is a branch; tells whether it did.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub(super) fn by_form(
    found: &mut PartFinding,
    evidence: &mut Vec<Evidence>,
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
    let cone = GermBranch {
        dimension,
        half_branches: Vec::new(),
        points: points(&germ),
        tangents: Vec::new(),
        ramification: None,
        reduced: true,
        vanishing_order: None,
        hits: 0,
    };
    let Ok(lifted) = lift_all(start, &germ, &[cone])? else {
        return Ok(false);
    };
    if lifted.iter().any(|lifted| lifted.shaky) {
        return Ok(false);
    }
    let idle = start.idle.len();
    evidence.push(Evidence {
        engine: "second order",
        scope: "a neighbourhood, real",
        bounds: (dimension + idle, Some(dimension + idle)),
        text: format!(
            "one quadratic form of full rank in {} variables, signature ({plus}, {minus}): its cone is irreducible (Morse's lemma)",
            germ.freedom()
        ),
    });
    found.lower = dimension + idle;
    found.upper = dimension + idle;
    "what the equations leave over is one quadratic form of full rank, so that near this pose the solutions are its cone, one branch \
     (Morse's lemma), which the loops close along"
        .clone_into(&mut found.certificate);
    found.branches = Some(lifted.into_iter().map(|l| l.branch).collect());
    Ok(true)
}

/// Points of the cone of a germ's first equation, in general position.
fn points(germ: &Germ) -> Vec<Vec<f64>> {
    let eigen = quadratic_form(&germ.equations()[0]).symmetric_eigen();
    let mut random = SplitMix64::named("quadratic cone");
    let mut points = Vec::with_capacity(RADII.len() * POINTS);
    for radius in RADII {
        for _ in 0..POINTS {
            // One vector in the space where the form is positive and one where it is negative, of opposite values.
            let mut sides = [vec![0.0; germ.freedom()], vec![0.0; germ.freedom()]];
            let mut values = [0.0f64; 2];
            for (value, vector) in eigen
                .eigenvalues
                .iter()
                .zip(eigen.eigenvectors.column_iter())
            {
                let side = usize::from(*value < 0.0);
                let share = random.symmetric() / value.abs().sqrt();
                values[side] += value.abs() * share * share;
                for (sum, x) in sides[side].iter_mut().zip(vector.iter()) {
                    *sum += share * x;
                }
            }
            let [plus, minus] = values.map(|value| value.sqrt().max(f64::MIN_POSITIVE));
            let point: Vec<f64> = sides[0]
                .iter()
                .zip(&sides[1])
                .map(|(a, b)| a / plus + b / minus)
                .collect();
            let length = point.iter().map(|x| x * x).sum::<f64>().sqrt();
            points.push(point.iter().map(|x| radius * x / length).collect());
        }
    }
    points
}
