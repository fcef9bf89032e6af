//! What the cycles leave their links, in words.

use crate::text::words::names;
use kutzbach_algebra::{CycleAnswer, ProvenMotion, Scope, Settled};
use kutzbach_math::group::DisplacementSubgroup;
use kutzbach_model::mechanism::{LinkId, Mechanism};
use serde::Serialize;

/// Two links of a cycle whose relative motion is less than the joints between them allow.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Motion {
    /// The link that moves.
    pub link: String,
    /// The link it is seen from, where it is drawn.
    pub relative_to: String,
    /// The joints of the cycle that join the two directly.
    pub joints: Vec<String>,
    /// Hervé's letter of the subgroup that holds all relative displacements.
    pub class: &'static str,
    /// Its dimension.
    pub freedom: usize,
    /// The subgroup in words, in world coordinates.
    pub motion: String,
    /// `every solution` of the cycle, or `pieces of the drawn pose`: those of its pieces that the drawn pose lies on.
    pub holds_on: &'static str,
    /// The whole statement.
    pub text: String,
}

/// The motions of a cycle, or of the whole mechanism.
pub(super) fn motions(
    mechanism: &Mechanism,
    cycle: Option<&CycleAnswer>,
    found: &[ProvenMotion],
) -> Vec<Motion> {
    found
        .iter()
        .map(|motion| self::motion(mechanism, cycle, motion))
        .collect()
}

fn motion(mechanism: &Mechanism, cycle: Option<&CycleAnswer>, found: &ProvenMotion) -> Motion {
    let link = |link: LinkId| mechanism.link(link).name.clone();
    let (moving, base) = (link(found.link), link(found.relative_to));
    let joints: Vec<String> = found
        .joints
        .iter()
        .map(|joint| mechanism.joint(*joint).name.clone())
        .collect();
    let mut motion = found.subgroup.to_string();
    let has_own_words = matches!(
        found.subgroup,
        DisplacementSubgroup::Translation { .. }
            | DisplacementSubgroup::PlanarTranslation { .. }
            | DisplacementSubgroup::Planar { .. }
    );
    if found.along_the_joint && has_own_words {
        motion.push_str(", its axis");
    }
    let stands = found.subgroup == DisplacementSubgroup::Identity;
    let mut text = match found.joints.as_slice() {
        _ if stands => format!("{moving} stands still relative to {base}"),
        [joint] => format!(
            "the {} joint {} is left with {motion}",
            mechanism.joint(*joint).kind.word().replace('_', "-"),
            joints[0]
        ),
        [_, ..] if cycle.is_some_and(|cycle| cycle.joints.len() == 2) => {
            format!("reduces to {motion} ({moving} relative to {base})")
        }
        _ => format!("{moving} relative to {base} is left with {motion}"),
    };
    let holds_on = match found.scope {
        Scope::Everywhere => "every solution",
        Scope::PiecesOfHome => {
            text.push_str(", in this assembly mode");
            "pieces of the drawn pose"
        }
    };
    Motion {
        link: moving,
        relative_to: base,
        joints,
        class: found.subgroup.short_name(),
        freedom: found.subgroup.dimension(),
        motion,
        holds_on,
        text,
    }
}

/// What keeps the list of motions from being all of them; `None` where nothing does.
pub(super) fn unsettled(settled: Settled) -> Option<String> {
    match settled {
        Settled::Yes => None,
        Settled::Stopped(stop) => Some(format!(
            "not settled: what its links are left with ({stop})"
        )),
        Settled::WithoutPieces => Some(
            "not settled: whether its links are left with less in this assembly mode (its pieces took too long)"
                .to_owned(),
        ),
        Settled::NoHome => Some(
            "not settled: what its links are left with (the drawn pose is no exact solution to count from)"
                .to_owned(),
        ),
        _ => Some(
            "not settled: what some of its links are left with (a joint is written without variables of its own, or the \
             polynomials are too long)"
                .to_owned(),
        ),
    }
}

/// `links a, b and c are one rigid cluster`.
pub(super) fn cluster_text(links: &[String]) -> String {
    format!("links {} are one rigid cluster", names(links, links.len()))
}
