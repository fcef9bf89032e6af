//! Parts that no numbers within the digits let move.

use super::nominal;
use super::parts::PartMeant;
use crate::analysis::Analysis;
use crate::roles::JointRole;
use crate::verdict::judge;
use crate::vocabulary::{CertificateLevel, Verdict};
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
    let mut nominal = nominal(&all, 0);
    if stated.mobility.verdict == Verdict::Undecided {
        for part in parts {
            let finding = &mut stated.findings[part.index];
            finding.lower = 0;
            finding.upper = 0;
            finding.at_rest = 0;
            finding.open = None;
            finding.level = CertificateLevel::Numeric;
            finding.certificate = certificate(part);
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
        if let Some(home) = &mut stated.home {
            // Of equations that hold within the digits only, the rank is not known.
            home.instantaneous = None;
            home.redundant = None;
        }
        nominal.finite = stated.mobility.finite().unwrap_or(0);
    }
    stated.mobility.nominal = Some(nominal);
    stated
}

/// Why a part does not move whatever its digits stand for.
fn certificate(part: &PartMeant) -> String {
    let (open, least) = part.nearest.as_ref().map_or((0.0, 0.0), |nearest| {
        (nearest.misfit * part.length, nearest.at_least)
    });
    format!(
        "the pose allows one motion at most, and along it the loops stay open by up to {open:.1e} m; to close them along a \
         motion near it some number has to change, to first order, by at least {least:.1} times what its digits leave open"
    )
}
