//! The one place where engines meet: each gives bounds on the finite mobility, and what they agree on is the verdict.

use super::pose_rank::PartRank;
use super::structure::Structure;
use super::vocabulary::Verdict;
use crate::closure::Assembly;
use crate::mechanism::Mechanism;

/// The verdict with its bounds and reasons.
#[derive(Clone, Debug, PartialEq)]
pub struct Mobility {
    /// The verdict.
    pub verdict: Verdict,
    /// Least and greatest finite mobility that remain possible; `None` where nothing is known.
    pub bounds: (Option<usize>, Option<usize>),
    /// Whether the pose is known to be regular.
    pub regular: bool,
    /// What the verdict rests on, in one sentence.
    pub certificate: String,
    /// Why not more, why not less, or what would decide.
    pub why: Vec<String>,
}

impl Mobility {
    /// The finite mobility where the bounds meet.
    #[must_use]
    pub fn finite(&self) -> Option<usize> {
        match (self.verdict, self.bounds) {
            (Verdict::Mobile | Verdict::Rigid, (Some(low), Some(high))) if low == high => {
                Some(high)
            }
            _ => None,
        }
    }
}

/// Intersects what the rank at the pose says about each part.
///
/// - Upper bound: the kernel of the Jacobian contains the tangents of every motion, so the instantaneous freedom bounds
///   the finite one from above.
/// - Lower bound: where the equations of a part are independent (full row rank), the implicit function theorem makes its
///   configurations a manifold of exactly the instantaneous dimension. Elsewhere nothing is known yet: 0.
#[must_use]
pub fn judge(
    mechanism: &Mechanism,
    structure: &Structure,
    assembly: &Assembly,
    parts: &[PartRank],
) -> Mobility {
    if !assembly.closed {
        return Mobility {
            verdict: Verdict::Unassembled,
            bounds: (None, None),
            regular: false,
            certificate: format!(
                "no closed pose was found from the pose drawn: the best one still misses by {:.2e} (allowed {:.2e})",
                assembly.residual, assembly.tolerance
            ),
            why: vec!["a mechanism that does not close has no motions to count".to_owned()],
        };
    }
    let free: usize = structure
        .free_joints
        .iter()
        .map(|&j| mechanism.joints()[j].freedom())
        .sum();
    let base = free + 6 * structure.loose_pieces;
    let mut low = base;
    let mut high = base;
    let mut regular = true;
    let mut doubtful = false;
    let mut dependent = 0;
    for part in parts {
        // A special mechanism written with too few digits is, taken literally, a generic one: that more equations than
        // unknowns then hold it fast may be due to the digits left out.
        let held_by_rounding = part.taken_literally
            && part.instantaneous == Some(0)
            && part.equations() > part.unknowns();
        let decided = part
            .instantaneous
            .filter(|_| part.note.is_none() && !held_by_rounding);
        doubtful |= decided.is_none();
        high += if held_by_rounding {
            part.unknowns()
        } else {
            part.instantaneous
                .map_or(part.candidates.1, |i| i.max(part.candidates.1))
        };
        match decided {
            Some(freedom) if freedom + part.equations() == part.unknowns() => low += freedom,
            Some(0) => dependent += part.equations() - part.unknowns(),
            Some(freedom) => {
                regular = false;
                dependent += freedom + part.equations() - part.unknowns();
            }
            None => regular = false,
        }
    }
    let mut why = Vec::new();
    let (verdict, certificate) = if low == high && !doubtful {
        let sentence = if high == 0 {
            "no velocity at all satisfies the closure equations at this pose, so no motion starts from it".to_owned()
        } else {
            "where they constrain motion at all, the closure equations at this pose are independent, so its motions form a \
             manifold of exactly this dimension (implicit function theorem)"
                .to_owned()
        };
        let verdict = if high == 0 {
            Verdict::Rigid
        } else {
            Verdict::Mobile
        };
        (verdict, sentence)
    } else {
        if doubtful {
            why.push("the numbers as they are stated leave the rank at this pose open".to_owned());
        }
        if dependent > 0 {
            why.push(format!(
                "{dependent} of the equations repeat the others at this pose; whether they do so all along a motion, or only \
                 here, is not settled by a rank at one pose"
            ));
        }
        (
            Verdict::Undecided,
            "the rank of the closure equations at this pose bounds the freedom from above"
                .to_owned(),
        )
    };
    Mobility {
        verdict,
        bounds: (Some(low), Some(high)),
        regular,
        certificate,
        why,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::closure::samples::{
        CRANK_ROCKER, Place, Written, add_ring, four_bar, general_four, planar, ring,
    };
    use crate::mechanism::{Frame, JointBuilder, JointKind, MechanismBuilder};
    use crate::mobility::{Analysis, AnalysisOptions, analyse};

    fn analysed(mechanism: &Mechanism) -> Analysis {
        analyse(mechanism, &AnalysisOptions::default()).unwrap()
    }

    fn judged(mechanism: &Mechanism) -> Mobility {
        analysed(mechanism).mobility
    }

    /// R C C C at general places: one freedom, nothing redundant.
    fn cylinders(written: Written) -> Mechanism {
        let places: Vec<Place> = vec![
            (JointKind::Revolute, [0.0; 3], [0.0, 0.25, 1.0]),
            (JointKind::Cylindrical, [1.0, 0.25, 0.0], [0.5, 0.0, 1.0]),
            (JointKind::Cylindrical, [1.0, 1.5, 0.5], [0.0, 1.0, 0.5]),
            (JointKind::Cylindrical, [0.25, 1.0, -0.5], [1.0, -0.5, 0.25]),
        ];
        ring(&places, [0.0; 3], written)
    }

    #[test]
    fn independent_equations_make_a_manifold() {
        for written in [Written::Exactly, Written::Decimals(6)] {
            let found = judged(&cylinders(written));
            assert_eq!((found.verdict, found.finite()), (Verdict::Mobile, Some(1)));
            assert!(found.regular && found.why.is_empty());
        }
    }

    #[test]
    fn no_velocity_no_motion() {
        let found = judged(&general_four());
        assert_eq!((found.verdict, found.finite()), (Verdict::Rigid, Some(0)));
        assert!(found.regular);
        let alone = MechanismBuilder::new("block")
            .link("ground")
            .clone()
            .build()
            .unwrap();
        assert_eq!(judged(&alone).finite(), Some(0));
    }

    #[test]
    fn dependent_equations_leave_it_open() {
        let found = judged(&four_bar());
        assert_eq!((found.verdict, found.finite()), (Verdict::Undecided, None));
        assert_eq!(found.bounds, (Some(0), Some(1)));
        assert!(!found.regular && !found.why.is_empty());
    }

    #[test]
    fn what_does_not_close_is_not_ranked() {
        let found = analysed(&ring(
            &planar(&CRANK_ROCKER),
            [0.0, 0.0, 0.5],
            Written::Exactly,
        ));
        assert_eq!(found.mobility.verdict, Verdict::Unassembled);
        assert_eq!(found.mobility.bounds, (None, None));
        assert!(found.home.is_none() && found.parts.is_empty());
    }

    #[test]
    fn free_joints_and_loose_bodies_add_their_freedom() {
        let mut builder = MechanismBuilder::new("arm");
        builder.link("ground").link("arm").link("stone");
        builder.joint(JointBuilder::tree(
            "a",
            JointKind::Spherical,
            "ground",
            "arm",
        ));
        builder.floating("drop", "ground", "stone", Frame::identity());
        let found = judged(&builder.build().unwrap());
        assert_eq!((found.verdict, found.finite()), (Verdict::Mobile, Some(9)));
        // A rigid loop beside a free joint.
        let mut builder = MechanismBuilder::new("arm");
        builder.link("ground").link("arm");
        builder.joint(JointBuilder::tree(
            "a",
            JointKind::Revolute,
            "ground",
            "arm",
        ));
        add_ring(
            &mut builder,
            "t",
            "ground",
            &planar(&CRANK_ROCKER[..3]),
            [0.0; 3],
            Written::Exactly,
        );
        let found = judged(&builder.build().unwrap());
        assert_eq!((found.verdict, found.finite()), (Verdict::Mobile, Some(1)));
    }

    #[test]
    fn a_doubtful_part_makes_all_doubtful() {
        let mechanism = general_four();
        let mut analysis = analysed(&mechanism);
        analysis.parts[0].note = Some("not plain".to_owned());
        let found = judge(
            &mechanism,
            &analysis.structure,
            &analysis.assembly,
            &analysis.parts,
        );
        assert_eq!((found.verdict, found.finite()), (Verdict::Undecided, None));
        assert!(!found.regular && !found.why.is_empty());
        analysis.parts[0].instantaneous = None;
        analysis.parts[0].candidates = (0, 2);
        let found = judge(
            &mechanism,
            &analysis.structure,
            &analysis.assembly,
            &analysis.parts,
        );
        assert_eq!(
            (found.verdict, found.bounds),
            (Verdict::Undecided, (Some(0), Some(2)))
        );
    }

    #[test]
    fn digits_left_out_hold_nothing_fast() {
        // Rigid when taken literally, by equations too many, at a size where three decimals say little.
        let small = |(kind, at, along): Place| (kind, at.map(|x| (x * 8.0).round() / 1e3), along);
        let places: Vec<Place> = [
            (JointKind::Revolute, [0.0, 0.0, 0.0], [0.0, 0.25, 1.0]),
            (JointKind::Revolute, [1.0, 0.25, 0.0], [0.5, 0.0, 1.0]),
            (JointKind::Revolute, [1.0, 1.5, 0.5], [0.0, 1.0, 0.5]),
            (JointKind::Revolute, [0.25, 1.0, -0.5], [1.0, -0.5, 0.25]),
        ]
        .map(small)
        .to_vec();
        let coarse = ring(&places, [0.0; 3], Written::Decimals(3));
        let found = analysed(&coarse);
        assert!(found.parts[0].taken_literally);
        assert_eq!(found.parts[0].instantaneous, Some(0));
        assert_eq!(
            (found.mobility.verdict, found.mobility.finite()),
            (Verdict::Undecided, None)
        );
        assert!(!found.mobility.regular);
        // The same numbers meant exactly.
        let found = judged(&ring(&places, [0.0; 3], Written::Exactly));
        assert_eq!(found.verdict, Verdict::Rigid);
    }

    #[test]
    fn every_verdict_has_its_word() {
        let words = [
            Verdict::Mobile,
            Verdict::Rigid,
            Verdict::Undecided,
            Verdict::Unassembled,
        ]
        .map(Verdict::word);
        assert_eq!(words, ["mobile", "rigid", "undecided", "unassembled"]);
    }
}
