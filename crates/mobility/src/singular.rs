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
use super::claim::{Answer, Bounds, Claim, Says};
use super::idle_directions::idle_directions;
use super::judge::PartFinding;
use super::lifting::{Start, idle_branch};
use super::pose_rank::{PartRank, Pose, TALL, height_at};
use super::vocabulary::{EngineName, Scope, SingularKind};
use kutzbach_closure::Part;
use kutzbach_math::matrix::MatrixError;

/// Looks for the branches through a pose that the chart test calls singular.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub(super) fn by_branches(
    pose: &Pose<'_>,
    part: &Part,
    rank: &PartRank,
    kernel: &Kernel,
    chart: &ChartTest,
    found: &mut PartFinding,
) -> Result<(), MatrixError> {
    let freedom = kernel.basis.nullity;
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
        let text = "along the only direction that the equations allow to first order they fail at higher order, and an equation in one \
                    variable that does not vanish identically has an isolated solution";
        let claim = isolated(
            &start,
            EngineName::Chart,
            "one equation in one variable",
            text,
        )?;
        found.take(Claim {
            scope: Scope::Neighbourhood,
            complex: Bounds::exactly(idle.len()),
            ..claim
        });
        return Ok(());
    }
    let open = by_search(found, &start, &doubtful)?;
    let decided = |found: &PartFinding| found.open().is_none();
    let mut why = open.unwrap_or_default();
    // What double precision takes for multiple may be several that hardly differ, or a cusp.
    let multiple = |found: &PartFinding| {
        found.branches().into_iter().flatten().any(|branch| {
            let generic = branch.poses.first().and_then(|pose| pose.instantaneous);
            generic.is_some_and(|freedom| freedom > branch.dimension)
        })
    };
    let unsure = !decided(found) || multiple(found);
    if unsure
        && !rounded
        && rank.instantaneous == Some(2 + idle.len())
        && let Some(reason) = by_polygon(found, &start, &doubtful)?
        && !decided(found)
    {
        why = reason;
    }
    if multiple(found) && !rounded {
        by_splitting(found, &start, &doubtful)?;
    }
    if !decided(found)
        && !rounded
        && rank
            .instantaneous
            .is_some_and(|freedom| freedom > 2 + idle.len())
    {
        let _ = by_form(found, &start, &doubtful)?
            || by_arrangement(found, &start, &doubtful)?
            || by_splitting(found, &start, &doubtful)?;
    }
    if !decided(found) && found.contradictions().is_empty() {
        let complex = found.complex_dimension();
        found.amend(|claim| {
            if let Some(complex) = complex {
                claim.finite.upper = Some(complex.max(claim.finite.lower));
            }
            claim.says = Says::Open(format!(
                "which branches pass through this singular pose is not settled: {why}; a pose beside it would be easier"
            ));
        });
    }
    Ok(())
}

/// The claim that nothing moves but what is idle.
fn isolated(
    start: &Start<'_>,
    engine: EngineName,
    text: impl Into<String>,
    certificate: impl Into<String>,
) -> Result<Claim, MatrixError> {
    let dimension = start.idle.len();
    let mut answer = Answer::numeric(certificate);
    if dimension == 0 {
        answer.kind = Some(SingularKind::Shaky);
        answer.branches = Some(Vec::new());
    } else {
        answer.kind = Some(SingularKind::PermanentlyShaky);
        answer.certificate.push_str("; only what is idle moves");
        answer.branches = Some(vec![idle_branch(start)?]);
    }
    let finite = Bounds::exactly(dimension);
    Ok(Claim::of(engine, Scope::RealNeighbourhood, finite, text).decides(answer))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
