//! The verdict on the whole, from what the claims about each part come to ([`PartFinding`]).
//!
//! Parts do not influence one another, so that the configuration space near the pose is a product: freedoms add, a branch
//! of the whole is one branch of every part, and the pose is singular where that of some part is.

use super::intended::{AsWritten, Change, Kept};
use super::judge::PartFinding;
use super::vocabulary::{CertificateLevel, MobilityClass, PoseKind, SingularKind, Verdict};
use kutzbach_closure::Assembly;
use kutzbach_closure::Structure;
use kutzbach_closure::with_owners;
use kutzbach_model::mechanism::Mechanism;

/// A mobile mechanism within the stated precision of a rigid file (D13).
#[derive(Clone, Debug, PartialEq)]
pub struct Nominal {
    /// Its finite freedom.
    pub finite: usize,
    /// How far the file's numbers, taken literally, are from closing along the motion (m).
    pub tolerance: f64,
    /// How far it is from the file's numbers (m; angles by the length of the part), where it was computed.
    pub distance: Option<f64>,
    /// The closure tolerance that stood in for the precision of the digits (m, rad), where these left the mobility open.
    pub known_to: Option<f64>,
    /// Whether it was found within what the file's digits, or [`known_to`](Self::known_to), leave open.
    pub within_digits: bool,
    /// Whether it differs by the noise of numbers that a program printed: less than a millionth of the loop's size.
    pub noise: bool,
    /// The numbers that it has otherwise, where it was computed.
    pub changes: Vec<Change>,
    /// What it was found by: relations that the numbers nearly satisfy, and that it satisfies exactly.
    pub kept: Vec<Kept>,
}

/// The verdict with its bounds and reasons.
#[derive(Clone, Debug, PartialEq)]
pub struct Mobility {
    /// The verdict.
    pub verdict: Verdict,
    /// Least and greatest finite mobility that remain possible; `None` where nothing is known.
    pub bounds: (Option<usize>, Option<usize>),
    /// Regular or singular; `None` while not decided.
    pub pose: Option<PoseKind>,
    /// In which way singular.
    pub kind: Option<SingularKind>,
    /// Hervé's class of a mobile mechanism, at a regular pose.
    pub class: Option<MobilityClass>,
    /// Dimension of the complex configuration space at the pose, where it was found.
    pub complex_dimension: Option<usize>,
    /// How strong the certificate is.
    pub level: CertificateLevel,
    /// What the verdict rests on, in one sentence.
    pub certificate: String,
    /// A mobile mechanism within the stated precision, where the file is rigid as written, or less mobile.
    pub nominal: Option<Nominal>,
    /// What the numbers taken literally leave, where the mechanism meant was computed.
    pub as_written: Option<AsWritten>,
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

/// The verdict on a mechanism that does not assemble.
#[must_use]
pub fn unassembled(assembly: &Assembly) -> Mobility {
    Mobility {
        verdict: Verdict::Unassembled,
        bounds: (None, None),
        pose: None,
        kind: None,
        class: None,
        complex_dimension: None,
        level: CertificateLevel::Numeric,
        certificate: format!(
            "{}: the best pose still misses by {:.2e} of its loop's length or rad (allowed {:.2e})",
            match &assembly.proven_open {
                Some(_) if assembly.held.is_empty() => "a loop is proven to close at no pose",
                Some(_) => "a loop is proven to close at no pose with the held joints as they are",
                None => "no closed pose was found",
            },
            assembly.residual,
            assembly.tolerance
        ),
        nominal: None,
        as_written: None,
        why: vec!["a mechanism that does not close has no motions to count".to_owned()],
    }
}

/// The verdict where only the rank was asked for: open, with the bound that the rank gives, if it gives one.
#[must_use]
pub(super) fn not_asked(most: Option<usize>) -> Mobility {
    Mobility {
        verdict: Verdict::Undecided,
        bounds: (Some(0), most),
        pose: None,
        kind: None,
        class: None,
        complex_dimension: None,
        level: CertificateLevel::Numeric,
        certificate: "the rank of the closure equations at this pose bounds the freedom from above"
            .to_owned(),
        nominal: None,
        as_written: None,
        why: vec!["only the rank at this pose was asked for".to_owned()],
    }
}

/// Puts together what was found of each part.
#[must_use]
pub fn judge(mechanism: &Mechanism, structure: &Structure, parts: &[PartFinding]) -> Mobility {
    let free: usize = structure
        .free_joints
        .iter()
        .map(|&j| mechanism.joints()[j].freedom())
        .sum();
    let base = free + 6 * structure.loose_pieces;
    let low = base + parts.iter().map(|p| p.lower()).sum::<usize>();
    let high = base + parts.iter().map(|p| p.upper()).sum::<usize>();
    let names = &structure.part_names[..];
    let open: Vec<(usize, &str)> = each(parts, |p| p.open());
    let poses: Vec<Option<PoseKind>> = parts.iter().map(|p| p.pose()).collect();
    let pose = if poses.contains(&Some(PoseKind::Singular)) {
        Some(PoseKind::Singular)
    } else if poses.contains(&None) {
        None
    } else {
        Some(PoseKind::Regular)
    };
    let verdict = match (low == high && open.is_empty(), high) {
        (false, _) => Verdict::Undecided,
        (true, 0) => Verdict::Rigid,
        (true, _) => Verdict::Mobile,
    };
    let weakest = parts.iter().min_by_key(|p| (p.open().is_none(), p.level()));
    let level = weakest.map_or(CertificateLevel::Subgroup, |p| p.level());
    let certificate = certificate(names, parts, level);
    let contradictions: Vec<(usize, String)> = parts
        .iter()
        .enumerate()
        .flat_map(|(index, p)| {
            p.contradictions()
                .iter()
                .map(move |c| (index, c.to_string()))
        })
        .collect();
    let contradictions = contradictions.iter().map(|(index, c)| (*index, &c[..]));
    let mut why = with_owners(names, contradictions.chain(open));
    why.extend(singular_parts(names, parts));
    let explained = verdict == Verdict::Mobile && pose == Some(PoseKind::Regular);
    let class = explained.then(|| class_of_whole(parts)).flatten();
    let complex_dimension = parts
        .iter()
        .map(|p| p.complex_dimension())
        .sum::<Option<usize>>()
        .map(|dimension| dimension + base);
    if verdict != Verdict::Undecided {
        why.extend(complex_remark(parts, base, high, complex_dimension));
    }
    let decided = verdict != Verdict::Undecided;
    let nominal = decided.then(|| nominal(parts, high)).flatten();
    Mobility {
        verdict,
        bounds: (Some(low), Some(high)),
        pose,
        kind: kind_of_whole(verdict, parts),
        class,
        complex_dimension,
        level,
        certificate,
        nominal,
        as_written: None,
        why,
    }
}

/// The class that explains all parts that may move.
fn class_of_whole(parts: &[PartFinding]) -> Option<MobilityClass> {
    parts
        .iter()
        .filter(|p| p.upper() > 0)
        .map(|p| p.class())
        .try_fold(MobilityClass::Trivial, |worst, class| {
            Some(worst.max(class?))
        })
}

/// Within which digits the freedom is that, where it is not that of the numbers taken literally.
fn nominal(parts: &[PartFinding], finite: usize) -> Option<Nominal> {
    let tolerances = parts.iter().filter_map(|p| p.nominal());
    tolerances.reduce(f64::max).map(|tolerance| Nominal {
        finite,
        tolerance,
        distance: None,
        known_to: None,
        // Not known before the mechanism meant is found.
        within_digits: false,
        noise: false,
        changes: Vec::new(),
        kept: Vec::new(),
    })
}

/// What is known of parts, with their numbers.
fn each<'a>(
    parts: &'a [PartFinding],
    of: impl Fn(&'a PartFinding) -> Option<&'a str>,
) -> Vec<(usize, &'a str)> {
    parts
        .iter()
        .enumerate()
        .filter_map(|(index, part)| of(part).map(|text| (index, text)))
        .collect()
}

/// Certificates told one by one; of more the rest is counted.
const CERTIFICATES: usize = 3;

/// What the verdict rests on: the certificate of each part, those that decide how strong the whole is first.
fn certificate(names: &[String], parts: &[PartFinding], level: CertificateLevel) -> String {
    if parts.is_empty() {
        return "no loop constrains any joint".to_owned();
    }
    let mut order: Vec<usize> = (0..parts.len()).collect();
    order.sort_by_key(|&index| (parts[index].open().is_none(), parts[index].level()));
    let texts: Vec<String> = parts
        .iter()
        .map(|part| {
            let text = part.certificate().trim_end_matches('.');
            // Stronger than the whole is said to be.
            match part.level() == level {
                true => text.to_owned(),
                false => format!("{text} ({})", part.level()),
            }
        })
        .collect();
    let all = with_owners(
        names,
        order.iter().map(|&index| (index, texts[index].as_str())),
    );
    let mut text = all[..all.len().min(CERTIFICATES)].join("; ");
    match all.len().saturating_sub(CERTIFICATES) {
        0 => {}
        1 => text.push_str("; and another certificate"),
        more => text.push_str(&format!("; and {more} more certificates")),
    }
    text
}

/// Which parts are at a singular pose, where others are not.
fn singular_parts(names: &[String], parts: &[PartFinding]) -> Option<String> {
    let singular: Vec<usize> = (0..parts.len())
        .filter(|&index| parts[index].pose() == Some(PoseKind::Singular))
        .collect();
    if singular.is_empty() || singular.len() == parts.len() {
        return None;
    }
    let kinds: Vec<(usize, String)> = singular
        .into_iter()
        .map(|index| {
            let kind = parts[index]
                .kind()
                .map_or("of a kind not known", SingularKind::word);
            (index, kind.replace('_', " "))
        })
        .collect();
    let told = with_owners(names, kinds.iter().map(|(index, kind)| (*index, &kind[..])));
    Some(format!(
        "of the {} blocks that have loops or couplings only these are at a singular pose: {}",
        parts.len(),
        told.join("; ")
    ))
}

/// What the complex solutions say about a finite freedom that is decided: that there are more dimensions of them, or that
/// there are proven to be no more.
fn complex_remark(
    parts: &[PartFinding],
    base: usize,
    finite: usize,
    complex_dimension: Option<usize>,
) -> Option<String> {
    if let Some(complex) = complex_dimension.filter(|c| *c > finite) {
        return Some(format!(
            "over the complex numbers the closure equations have solutions of dimension {complex} at this pose, of which no \
             more than {finite} can be real: as x² + y² = 0 has two complex lines and a single real point"
        ));
    }
    let numeric = |p: &&PartFinding| p.level() == CertificateLevel::Numeric;
    if !parts
        .iter()
        .any(|p| numeric(&p) && p.complex_upper().is_some())
    {
        return None;
    }
    // Other certificates hold for the complex solutions too.
    let bound = |p: &PartFinding| match p.level() {
        CertificateLevel::Numeric => p.complex_upper(),
        _ => Some(p.upper()),
    };
    let most = base + parts.iter().map(bound).sum::<Option<usize>>()?;
    (most == finite).then(|| {
        format!(
            "no component of the complex solution set through this pose has more than {}, which is proved in exact arithmetic",
            match most {
                1 => "1 dimension".to_owned(),
                many => format!("{many} dimensions"),
            }
        )
    })
}

/// D7 for a product: a part that is shaky stays at its pose while others move, and is shaky all along.
fn kind_of_whole(verdict: Verdict, parts: &[PartFinding]) -> Option<SingularKind> {
    let mut kinds: Vec<Option<SingularKind>> = parts
        .iter()
        .filter(|p| p.pose() == Some(PoseKind::Singular))
        .map(|p| p.kind())
        .collect();
    if verdict == Verdict::Rigid {
        return kinds.first().copied().flatten();
    }
    if kinds.iter().any(|k| *k != Some(SingularKind::Shaky)) {
        kinds.retain(|k| *k != Some(SingularKind::Shaky));
    }
    let first = kinds.first().copied().flatten()?;
    if first == SingularKind::Shaky {
        return Some(SingularKind::PermanentlyShaky);
    }
    if kinds.iter().all(|k| *k == Some(first)) {
        return Some(first);
    }
    [SingularKind::Kinematotropic, SingularKind::Bifurcation]
        .into_iter()
        .find(|kind| kinds.contains(&Some(*kind)))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::claim::{Bounds, Claim, Says};
    use crate::vocabulary::{EngineName, Scope};
    use crate::{Analysis, AnalysisOptions, analyse};
    use kutzbach_closure::samples::{
        CRANK_ROCKER, Place, Written, add_ring, four_bar, general_four, planar, ring,
    };
    use kutzbach_model::mechanism::{Frame, JointBuilder, JointKind, MechanismBuilder};

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
            assert!(found.pose == Some(PoseKind::Regular) && found.why.is_empty());
        }
    }

    #[test]
    fn no_velocity_no_motion() {
        let found = judged(&general_four());
        assert_eq!((found.verdict, found.finite()), (Verdict::Rigid, Some(0)));
        assert!(found.pose == Some(PoseKind::Regular));
        let alone = MechanismBuilder::new("block")
            .link("ground")
            .clone()
            .build()
            .unwrap();
        assert_eq!(judged(&alone).finite(), Some(0));
    }

    #[test]
    fn planar_loops_are_explained_by_their_subgroup() {
        let found = judged(&four_bar());
        assert_eq!((found.verdict, found.finite()), (Verdict::Mobile, Some(1)));
        assert_eq!(found.pose, Some(PoseKind::Regular));
        assert_eq!(
            (found.class, found.level),
            (Some(MobilityClass::Trivial), CertificateLevel::Subgroup)
        );
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
        analysis.findings[0].read_anew(Claim {
            says: Says::Open("not plain".to_owned()),
            ..Claim::of(EngineName::Rank, Scope::Pose, Bounds::at_most(2), "")
        });
        let found = judge(&mechanism, &analysis.structure, &analysis.findings);
        assert_eq!((found.verdict, found.finite()), (Verdict::Undecided, None));
        assert_eq!(found.bounds, (Some(0), Some(2)));
        assert_eq!(
            (found.pose, &found.why[..]),
            (None, &["not plain".to_owned()][..])
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
        assert!(found.parts[0].is_taken_literally());
        assert_eq!(found.parts[0].instantaneous, Some(0));
        assert_eq!(
            (found.mobility.verdict, found.mobility.finite()),
            (Verdict::Undecided, None)
        );
        assert!(found.mobility.pose != Some(PoseKind::Regular));
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
