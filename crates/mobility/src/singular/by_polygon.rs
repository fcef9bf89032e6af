//! Singular poses where two coordinates are free to first order, by Newton's polygon.

use super::super::claim::{Answer, Bounds, Claim};
use super::super::germ::Germ;
use super::super::judge::PartFinding;
use super::super::leftover::Doubt;
use super::super::lifting::{Start, lift_all};
use super::super::plane_germ::{ORDERS, PlaneCurve, plane_curve};
use super::super::pose_rank::PartRank;
use super::super::vocabulary::{EngineName, Scope, SingularKind};
use super::isolated;
use kutzbach_math::matrix::MatrixError;

/// Degree of the series by which points of branches are brought to the mechanism.
const DEGREE: usize = 8;

/// Fills a finding where the numbers are exact and the branches are told apart; gives the reason where they are not.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub(super) fn by_polygon(
    found: &mut PartFinding,
    start: &Start<'_>,
    rank: &PartRank,
) -> Result<Option<String>, MatrixError> {
    let idle = start.idle.len();
    // What is decided already is looked at once more, and not for long.
    let curve = match plane_curve(start, found.branches().is_none()) {
        Ok(curve) => curve,
        Err(doubt) => return Ok(Some(reason(doubt).to_owned())),
    };
    let text = text(&curve);
    if curve.branches.is_empty() {
        let certificate = "near this pose the closure equations have no other real solution: Newton's polygon leaves no half-branch";
        found.take(isolated(
            start,
            EngineName::NewtonPolygon,
            text,
            certificate,
        )?);
        return Ok(None);
    }
    let claim = Claim::of(
        EngineName::NewtonPolygon,
        Scope::RealNeighbourhood,
        Bounds::at_most(1 + idle),
        text,
    );
    let Some(germ) = Germ::of_part_across(start.pose.mechanism, rank, DEGREE, start.idle)? else {
        found.take(claim);
        return Ok(Some("its power series are too many to follow".to_owned()));
    };
    let lifted = lift_all(start, &germ, &curve.branches)?.and_then(|lifted| {
        let mut pairs = lifted.iter().zip(&curve.branches);
        if pairs.any(|(lifted, branch)| lifted.shaky == branch.reduced) {
            let why = "a branch is multiple farther away and not by Newton's polygon, or the other way round";
            return Err(why.to_owned());
        }
        Ok(lifted)
    });
    let mut claim = claim;
    let branches = match lifted {
        Ok(lifted) => Some(lifted.into_iter().map(|l| l.branch).collect()),
        Err(why) if !curve.sole => {
            found.take(claim);
            return Ok(Some(why));
        }
        Err(why) => {
            // That they exist is proved; where they lead was not found.
            claim.text.push_str(&format!("; {why}"));
            None
        }
    };
    claim.finite = Bounds::exactly(1 + idle);
    found.take(claim.decides(Answer {
        kind: kind(&curve),
        branches,
        ..Answer::numeric(certificate(&curve))
    }));
    Ok(None)
}

fn certificate(curve: &PlaneCurve) -> String {
    let many = match curve.branches.len() {
        1 => "one real branch".to_owned(),
        many => format!("{many} real branches"),
    };
    let simple = if curve.branches.iter().all(|branch| branch.reduced) {
        "each of which is simple from some order on".to_owned()
    } else {
        format!(
            "each of which is simple from some order on, or multiple in all orders up to {ORDERS}"
        )
    };
    format!("Newton's polygon gives {many} of the equations' power series, {simple}")
}

fn kind(curve: &PlaneCurve) -> Option<SingularKind> {
    match curve.branches.as_slice() {
        [branch] if !branch.reduced => Some(SingularKind::PermanentlyShaky),
        [branch] => branch
            .ramification
            .filter(|exponent| exponent % 2 == 0)
            .map(|_| SingularKind::Cusp),
        _ if curve.tangential => Some(SingularKind::Tangential),
        _ => Some(SingularKind::Bifurcation),
    }
}

fn text(curve: &PlaneCurve) -> String {
    let branches: Vec<String> = curve
        .branches
        .iter()
        .filter_map(|branch| branch.ramification)
        .map(|exponent| format!("x = t^{exponent}"))
        .collect();
    let found = match branches.len() {
        0 => "no real half-branch".to_owned(),
        1 => format!("one real branch, {}", branches[0]),
        many => format!("{many} real branches, {}", branches.join(", ")),
    };
    format!(
        "order {} in 2 variables, series to degree {} in {} bits: {found}",
        curve.order, curve.degree, curve.bits
    )
}

fn reason(doubt: Doubt) -> &'static str {
    match doubt {
        Doubt::Precision => {
            "a coefficient of its power series is neither zero nor clearly different from it"
        }
        Doubt::Multiple => {
            "branches agree in all terms of the power series computed, or one is multiple"
        }
        Doubt::Arithmetic => "its power series cannot be computed in many digits",
    }
}
