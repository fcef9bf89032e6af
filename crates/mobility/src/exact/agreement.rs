//! What a proof or a bound of exact algebra claims.

use super::ExactFinding;
use crate::claim::{Answer, Bounds, Claim, Says};
use crate::judge::PartFinding;
use crate::pose_rank::PartRank;
use crate::vocabulary::{
    CertificateLevel, EngineName, MobilityClass, PoseKind, Scope, SingularKind,
};

/// The claim about a part of which other engines found something before.
pub(super) fn claim(found: &PartFinding, rank: &PartRank, exact: ExactFinding) -> Claim {
    let finite = Bounds::between(exact.proven.unwrap_or(0), exact.upper);
    let claim = Claim {
        instantaneous: Bounds::at_most(exact.tangent),
        complex: exact
            .complex_dimension
            .map_or(Bounds::at_most(exact.upper), Bounds::exactly),
        ..Claim::of(EngineName::Exact, Scope::PoseComplex, finite, exact.text)
    };
    let undecided = found.open().is_some();
    match exact.proven {
        Some(_) if !undecided => Claim {
            says: Says::Proves {
                level: CertificateLevel::Exact,
                certificate: exact.certificate,
            },
            ..claim
        },
        Some(freedom) => alone(claim, rank, exact.tangent, freedom, exact.certificate),
        None if undecided && found.lower() == exact.upper => claim.decides(Answer::numeric(
            "other engines leave no fewer freedoms, and no component of the complex solution set through this pose has more \
             dimensions, in exact arithmetic",
        )),
        None => claim,
    }
}

/// The claim about a part that only exact algebra decides.
fn alone(
    mut claim: Claim,
    rank: &PartRank,
    tangent: usize,
    freedom: usize,
    certificate: String,
) -> Claim {
    let surplus = rank.unknowns() as i64 - rank.equations() as i64;
    let mut answer = Answer {
        level: CertificateLevel::Exact,
        branches: (freedom == 0).then(Vec::new),
        ..Answer::numeric(certificate)
    };
    if tangent == freedom {
        claim.pose = Some(PoseKind::Regular);
        answer.class = (freedom > 0 && surplus == freedom as i64).then_some(MobilityClass::Trivial);
    } else if freedom == 0 && rank.instantaneous.is_some_and(|velocities| velocities > 0) {
        claim.pose = Some(PoseKind::Singular);
        answer.kind = Some(SingularKind::Shaky);
    }
    claim.decides(answer)
}
