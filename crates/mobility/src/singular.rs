//! Singular poses: which branches pass through them.
//!
//! The germ of the configuration space, a few power series in the δ coordinates of the kernel, is cut off at a small order
//! and its real zeros near the origin are found ([`germ_zeros`]). That is a hint. Each branch found is then lifted to the
//! mechanism, closed on *all* equations at a finite distance, ranked there and followed: only what survives this is a
//! branch. What bounds the mobility from above is the search for zeros, which is numeric, and where it can be had the
//! dimension over the complex numbers.
//!
//! What is idle at every pose is taken out first ([`idle_directions`]). One variable left needs no search: an analytic
//! function of one variable that does not vanish identically has an isolated zero, so that only what is idle moves.

mod by_arrangement;
mod by_form;
mod by_polygon;
mod by_search;
mod by_splitting;
mod doubts;
mod kinds;
mod known_branches;
mod resolution;
mod search;

use self::by_arrangement::by_arrangement;
use self::by_form::by_form;
use self::by_polygon::by_polygon;
use self::by_search::by_search;
use self::by_splitting::by_splitting;
pub(super) use self::search::most_starts;
use super::chart::{ChartTest, Kernel};
use super::idle_directions::idle_directions;
use super::lifting::{Start, idle_branch};
use super::part_mobility::{Evidence, PartFinding};
use super::pose_rank::{PartRank, Pose, TALL, height_at};
use super::vocabulary::{CertificateLevel, PoseKind, SingularKind};
use kutzbach_closure::Part;
use kutzbach_math::matrix::MatrixError;

/// What is known of a singular pose.
pub(super) struct SingularFinding {
    pub found: PartFinding,
    pub more_evidence: Vec<Evidence>,
}

/// Looks for the branches through a pose that the chart test calls singular.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub(super) fn singular_finding(
    pose: &Pose<'_>,
    part: &Part,
    rank: &PartRank,
    kernel: &Kernel,
    chart: &ChartTest,
    lower: usize,
) -> Result<SingularFinding, MatrixError> {
    let freedom = kernel.basis.nullity;
    let mut evidence = Vec::new();
    let mut found = PartFinding {
        lower,
        upper: freedom - 1,
        pose: Some(PoseKind::Singular),
        kind: None,
        class: None,
        level: CertificateLevel::Numeric,
        certificate: String::new(),
        complex_dimension: None,
        branches: None,
        at_rest: freedom,
        open: None,
        evidence: Vec::new(),
        nominal: None,
        complex_upper: None,
        contradiction: None,
    };
    // Numbers taken literally close the loops exactly. The coefficients of the series are not for that reason beyond doubt:
    // rounding shifts them by its share of the curvature, of which hardly a tenth remains.
    let doubtful = PartRank {
        stated: if chart.literal {
            0.1 * rank.stated
        } else {
            rank.stated
        },
        ..rank.clone()
    };
    let literal;
    let rank = if chart.literal {
        literal = PartRank {
            stated: 0.0,
            ..rank.clone()
        };
        &literal
    } else {
        rank
    };
    let rounded = doubtful.stated > rank.accuracy;
    // What is idle at all poses is a factor of the configuration space.
    let by_kind = height_at(pose, part) > TALL;
    let idle = idle_directions(pose.mechanism, part, kernel, by_kind);
    let start = Start {
        pose,
        part,
        rank,
        kernel,
        idle: &idle,
    };
    if freedom == 1 + idle.len() {
        "along the only direction that the equations allow to first order they fail at higher order, and an equation in one \
         variable that does not vanish identically has an isolated solution"
            .clone_into(&mut found.certificate);
        isolated(&mut found, &start)?;
        found.complex_dimension = Some(idle.len());
        return Ok(SingularFinding {
            found,
            more_evidence: evidence,
        });
    }
    let open = by_search(&mut found, &mut evidence, &start, &doubtful)?;
    let mut decided = open.is_none();
    let mut why = open.unwrap_or_default();
    // What double precision takes for multiple may be several that hardly differ, or a cusp.
    let multiple = |found: &PartFinding| {
        found.branches.iter().flatten().any(|branch| {
            let generic = branch.poses.first().and_then(|pose| pose.instantaneous);
            generic.is_some_and(|freedom| freedom > branch.dimension)
        })
    };
    let unsure = !decided || multiple(&found);
    if unsure && !rounded && rank.instantaneous == Some(2 + idle.len()) {
        match by_polygon(&mut found, &mut evidence, &start, &doubtful)? {
            None => decided = true,
            Some(_) if decided => {}
            Some(reason) => why = reason,
        }
    }
    if decided && multiple(&found) && !rounded {
        by_splitting(&mut found, &mut evidence, &start, &doubtful)?;
    }
    if !decided
        && !rounded
        && rank
            .instantaneous
            .is_some_and(|freedom| freedom > 2 + idle.len())
    {
        decided = by_form(&mut found, &mut evidence, &start, &doubtful)?
            || by_arrangement(&mut found, &mut evidence, &start, &doubtful)?
            || by_splitting(&mut found, &mut evidence, &start, &doubtful)?;
    }
    if !decided {
        found.certificate =
            "the pose is singular, so that the finite freedom is below the instantaneous one"
                .to_owned();
        found.open = Some(format!(
            "which branches pass through this singular pose is not settled: {why}; a pose beside it would be easier"
        ));
        if let Some(complex) = found.complex_dimension {
            found.upper = found.upper.min(complex).max(found.lower);
        }
    }
    Ok(SingularFinding {
        found,
        more_evidence: evidence,
    })
}

/// Nothing moves but what is idle.
fn isolated(found: &mut PartFinding, start: &Start<'_>) -> Result<(), MatrixError> {
    let dimension = start.idle.len();
    found.lower = dimension;
    found.upper = dimension;
    if dimension == 0 {
        found.kind = Some(SingularKind::Shaky);
        found.branches = Some(Vec::new());
    } else {
        found.kind = Some(SingularKind::PermanentlyShaky);
        found.certificate.push_str("; only what is idle moves");
        found.branches = Some(vec![idle_branch(start)?]);
    }
    Ok(())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
