//! Parts that no numbers within the digits let move.

use super::nominal::nominal;
use super::parts::PartMeant;
use crate::analysis::Analysis;
use crate::claim::{Answer, Bounds, Claim};
use crate::roles::JointRole;
use crate::verdict::judge;
use crate::vocabulary::{EngineName, PoseKind, Scope, SingularKind, Verdict};
use crate::whole_branches::whole_branches;
use kutzbach_closure::{Arithmetic, Geometry};
use kutzbach_model::mechanism::{Configuration, Mechanism};

/// The analysis where no numbers within the digits let an open part move, and how far away the nearest mechanism is that moves.
pub(super) fn held_fast(
    mechanism: &Mechanism,
    configuration: Option<&Configuration>,
    mut stated: Analysis,
    parts: &[PartMeant],
) -> Analysis {
    let all: Vec<&PartMeant> = parts.iter().collect();
    let found = parts.iter().all(|part| part.nearest.is_some());
    let mut nominal = found.then(|| nominal(&all, 0));
    if matches!(
        stated.mobility.verdict,
        Verdict::Undecided | Verdict::Mobile
    ) {
        let mut as_before = true;
        for part in parts.iter().filter(|part| part.excluded) {
            let rank = &stated.parts[part.index];
            as_before &= rank.as_written.is_some() && rank.as_written == rank.instantaneous;
            let finding = &mut stated.findings[part.index];
            // What gives way to first order as written, and does not move, is a singular pose.
            let (pose, kind) = match (rank.as_written, as_before) {
                (Some(0), _) => (Some(PoseKind::Regular), None),
                (_, true) => (Some(PoseKind::Singular), Some(SingularKind::Shaky)),
                _ => (finding.pose(), finding.kind()),
            };
            let certificate = certificate(part);
            let text = certificate.clone();
            let claim = Claim {
                pose,
                instantaneous: Bounds::at_most(0),
                ..Claim::of(EngineName::Digits, Scope::Pose, Bounds::exactly(0), text)
            };
            finding.read_anew(claim.decides(Answer {
                kind,
                branches: Some(Vec::new()),
                ..Answer::numeric(certificate)
            }));
            // Of equations whose rank is open, joints that move to first order are not known to be locked.
            let holds = stated.parts[part.index].as_written == Some(0);
            for &joint in &stated.structure.parts[part.index].joints {
                let moves = mechanism.joints()[joint].freedom() > 0;
                stated.roles[joint] = JointRole {
                    locked: (holds && moves).then_some(true),
                    ..JointRole::default()
                };
            }
        }
        stated.mobility = judge(mechanism, &stated.structure, &stated.findings);
        stated.branches = whole_branches(
            mechanism,
            &Geometry::new(mechanism, configuration, &Arithmetic::double()),
            &stated.structure,
            &stated.assembly.states,
            stated.kutzbach,
            &stated.findings,
        );
        if let Some(home) = stated.home.as_mut().filter(|_| !as_before) {
            // Of equations that hold within the digits only, the rank is not known.
            home.instantaneous = None;
            home.redundant = None;
        }
        if let Some(nominal) = &mut nominal {
            nominal.finite = stated.mobility.finite().unwrap_or(0);
        }
    }
    stated.mobility.nominal = nominal;
    stated
}

/// Why a part does not move whatever its digits stand for.
fn certificate(part: &PartMeant) -> String {
    let least = part.at_least;
    if part.rigid {
        return format!(
            "no velocity satisfies the closure equations at this pose; for one to do so some number has to change, to first order and by \
             the least change found from several starts, by {least:.1} times what its digits leave open"
        );
    }
    let open = part.nearest.as_ref().map_or(String::new(), |nearest| {
        format!(" by up to {:.1e} m", nearest.misfit * part.length)
    });
    format!(
        "the loops stay open{open} along the motions that the pose allows within the digits; to close them along one some number has \
         to change, to first order, by at least {least:.1} times what its digits leave open"
    )
}
