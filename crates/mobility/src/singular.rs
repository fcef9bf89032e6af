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
use self::by_splitting::{beyond_doubles, by_splitting};
pub(super) use self::search::most_starts;
use super::claim::{Answer, Bounds, Claim, Says};
use super::judge::PartFinding;
use super::lifting::{Start, idle_branch};
use super::options::AnalysisError;
use super::question::{Means, Question};
use super::vocabulary::{EngineName, PoseKind, Scope, SingularKind};
use kutzbach_math::matrix::MatrixError;

type Asked = Result<(), AnalysisError>;

/// Coordinates that are free to first order and not idle; `None` where the kernel is not known.
pub(super) fn variables(question: &Question<'_>) -> Result<Option<usize>, AnalysisError> {
    let start = question.start()?;
    Ok(start.map(|start| start.kernel.basis.nullity - start.idle.len()))
}

/// Whether more moves to first order along some branch than finitely: what double precision takes for multiple may be several
/// branches that hardly differ, or a cusp.
pub(super) fn is_multiple(found: &PartFinding) -> bool {
    let mut branches = found.branches().into_iter().flatten();
    found.pose() == Some(PoseKind::Singular)
        && branches.any(|branch| {
            let generic = branch.poses.first().and_then(|pose| pose.instantaneous);
            generic.is_some_and(|freedom| freedom > branch.dimension)
        })
}

/// One equation in one variable has an isolated solution.
pub(super) fn one_variable(
    question: &Question<'_>,
    _: &mut Means<'_>,
    found: &mut PartFinding,
) -> Asked {
    let Some(start) = question.start()? else {
        return Ok(());
    };
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
        complex: Bounds::exactly(start.idle.len()),
        ..claim
    });
    Ok(())
}

/// The real zeros of power series.
pub(super) fn search(question: &Question<'_>, _: &mut Means<'_>, found: &mut PartFinding) -> Asked {
    if let Some(start) = question.start()?
        && let Some(why) = by_search(found, &start, question.doubtful()?)?
    {
        unsettled(found, &why);
    }
    Ok(())
}

/// Newton's polygon.
pub(super) fn polygon(
    question: &Question<'_>,
    _: &mut Means<'_>,
    found: &mut PartFinding,
) -> Asked {
    if let Some(start) = question.start()?
        && let Some(why) = by_polygon(found, &start, question.doubtful()?)?
    {
        unsettled(found, &why);
    }
    Ok(())
}

/// The splitting lemma.
pub(super) fn splitting(
    question: &Question<'_>,
    _: &mut Means<'_>,
    found: &mut PartFinding,
) -> Asked {
    if let Some(start) = question.start()? {
        by_splitting(found, &start, question.doubtful()?)?;
    }
    Ok(())
}

/// The splitting lemma, where many digits show more than doubles.
pub(super) fn splitting_beyond_doubles(
    question: &Question<'_>,
    _: &mut Means<'_>,
    found: &mut PartFinding,
) -> Asked {
    if let Some(start) = question.start()? {
        beyond_doubles(found, &start, question.doubtful()?)?;
    }
    Ok(())
}

/// One quadratic form of full rank.
pub(super) fn form(question: &Question<'_>, _: &mut Means<'_>, found: &mut PartFinding) -> Asked {
    if let Some(start) = question.start()? {
        by_form(found, &start, question.doubtful()?)?;
    }
    Ok(())
}

/// Quadratic forms that vanish on linear spaces.
pub(super) fn arrangement(
    question: &Question<'_>,
    _: &mut Means<'_>,
    found: &mut PartFinding,
) -> Asked {
    if let Some(start) = question.start()? {
        by_arrangement(found, &start, question.doubtful()?)?;
    }
    Ok(())
}

/// What stays open is bounded by the dimension of complex solutions.
pub(super) fn complex_bound(_: &Question<'_>, _: &mut Means<'_>, found: &mut PartFinding) -> Asked {
    if let Some(complex) = found.complex_dimension() {
        let finite = Bounds::at_most(complex);
        let text = "real solutions are among the complex ones";
        found.take(Claim::of(
            EngineName::Germ,
            Scope::Neighbourhood,
            finite,
            text,
        ));
    }
    Ok(())
}

/// Leaves a singular pose open, unless others have settled it.
fn unsettled(found: &mut PartFinding, why: &str) {
    if found.open().is_some() && found.contradictions().is_empty() {
        found.amend(|claim| {
            claim.says = Says::Open(format!(
                "which branches pass through this singular pose is not settled: {why}; a pose beside it would be easier"
            ));
        });
    }
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
