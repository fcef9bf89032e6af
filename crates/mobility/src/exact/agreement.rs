//! What a proof changes about what the other engines found, and what excludes it.

use super::ExactFinding;
use crate::part_mobility::PartFinding;
use crate::pose_rank::PartRank;
use crate::vocabulary::{CertificateLevel, MobilityClass, PoseKind, SingularKind};

/// Puts a proof or a bound together with what the other engines found. What contradicts is said, and nothing is decided then.
pub(super) fn combine(found: &mut PartFinding, rank: &PartRank, exact: ExactFinding) {
    if let Some(text) = contradiction(found, rank, &exact) {
        found.open = Some(text.clone());
        found.contradiction = Some(text);
        found.lower = exact.proven.unwrap_or(0).min(found.lower);
        found.upper = exact.upper.max(found.upper);
        found.level = CertificateLevel::Numeric;
        found.pose = None;
        found.kind = None;
        found.class = None;
        found.complex_dimension = None;
        found.branches = None;
        return;
    }
    let was_open = found.open.is_some();
    found.upper = found.upper.min(exact.upper);
    found.complex_upper = Some(exact.upper);
    if let Some(freedom) = exact.proven {
        found.lower = freedom;
        found.upper = freedom;
        found.level = CertificateLevel::Exact;
        found.certificate = exact.certificate;
        found.open = None;
        if was_open {
            settle(found, rank, exact.tangent, freedom);
        }
    } else if was_open && found.lower == found.upper {
        found.open = None;
        "other engines leave no fewer freedoms, and no component of the complex solution set through this pose has more \
         dimensions, in exact arithmetic"
            .clone_into(&mut found.certificate);
    }
    let meets = (exact.upper == found.lower).then_some(exact.upper);
    let complex = exact.complex_dimension.or(meets);
    // Where it is not known, the bound still is one.
    let excluded = |germ: usize| complex.map_or(germ > exact.upper, |algebra| algebra != germ);
    match (found.complex_dimension, complex) {
        // The real freedom keeps its bounds, whichever of the two is wrong.
        (Some(germ), _) if excluded(germ) => {
            let algebra = complex.map_or_else(
                || format!("at most {}", exact.upper),
                |dimension| dimension.to_string(),
            );
            found.complex_dimension = None;
            found.contradiction = Some(format!(
                "two engines contradict each other, please report this: the dimension over the complex numbers is {germ} by \
                 the power series at this pose and {algebra} by exact algebra"
            ));
        }
        (before, now) => found.complex_dimension = now.or(before),
    }
}

/// What a part is that only exact algebra decided.
fn settle(found: &mut PartFinding, rank: &PartRank, tangent: usize, freedom: usize) {
    let regular = tangent == freedom;
    let surplus = rank.unknowns() as i64 - rank.equations() as i64;
    found.at_rest = rank.instantaneous.unwrap_or(tangent);
    found.branches = (freedom == 0).then(Vec::new);
    if regular {
        found.pose = Some(PoseKind::Regular);
        found.kind = None;
        found.class = (freedom > 0 && surplus == freedom as i64).then_some(MobilityClass::Trivial);
    } else if freedom == 0 && rank.instantaneous.is_some_and(|velocities| velocities > 0) {
        found.pose = Some(PoseKind::Singular);
        found.kind = Some(SingularKind::Shaky);
    }
}

/// Where a proof and what the other engines found exclude each other.
fn contradiction(found: &PartFinding, rank: &PartRank, exact: &ExactFinding) -> Option<String> {
    let text = match (rank.instantaneous, exact.proven) {
        (Some(velocities), _) if exact.tangent < velocities => format!(
            "numeric rank leaves {velocities} instantaneous freedoms, exact arithmetic at most {}",
            exact.tangent
        ),
        (_, Some(proven)) if proven > found.upper => format!(
            "numeric engines find at most {} finite freedoms, exact algebra proves {proven}",
            found.upper
        ),
        _ if exact.upper < found.lower => format!(
            "numeric engines find {} finite freedoms, exact algebra proves that there are at most {}",
            found.lower, exact.upper
        ),
        _ => return None,
    };
    Some(format!(
        "two engines contradict each other, please report this: {text}"
    ))
}
