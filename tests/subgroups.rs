//! Displacement subgroups on the reference mechanisms: what they decide is right, and what they have to decide they do.

use crate::support;

use kutzbach::closure::{Arithmetic, Geometry};
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{MobilityClass, SubgroupFinding, subgroup_finding};
use serde_json::Value;
use support::{analysis, assert_none, folder, in_parallel, zoo, zoo_mechanism};

/// The findings of all parts, and the freedom of what is in no part.
fn findings(mechanism: &Mechanism) -> (Vec<SubgroupFinding>, usize) {
    let analysis = analysis(mechanism);
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let structure = &analysis.structure;
    let found = structure
        .parts
        .iter()
        .zip(&analysis.parts)
        .map(|(part, rank)| {
            subgroup_finding(
                mechanism,
                &geometry,
                &analysis.assembly.states,
                structure,
                part,
                rank,
            )
            .unwrap()
        })
        .collect();
    let free: usize = structure
        .free_joints
        .iter()
        .map(|&joint| mechanism.joints()[joint].freedom())
        .sum();
    (found, free + 6 * structure.loose_pieces)
}

/// The class of the whole: exceptional where one of the parts that move is.
fn class(findings: &[SubgroupFinding]) -> Option<MobilityClass> {
    findings.iter().filter_map(|finding| finding.class).max()
}

fn expected() -> Value {
    let text = std::fs::read_to_string(folder("tests/zoo/expected.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

/// Mobile mechanisms whose mobility no loop space explains but the subgroups of chains do.
const EXCEPTIONAL: [&str; 12] = [
    "delta_3RRPaR",
    "double_planar_6r_skew10",
    "exechon",
    "fourR_coaxial_link",
    "oldham_rccr",
    "ruiz_cartesian_table",
    "ruiz_double_peg",
    "sarrus_6r",
    "sarrus_column_3",
    "ss_pair",
    "thomas_torras_4body",
    "tripteron_3PRRR",
];

#[test]
fn what_is_decided_is_right() {
    let expected = expected();
    let zoo = zoo();
    let results = in_parallel(&zoo, |(name, mechanism)| {
        let (found, free) = findings(mechanism);
        let finite: Option<usize> = found.iter().map(|f| f.finite).sum();
        let lower: usize = found.iter().map(|f| f.lower).sum();
        let upper: Option<usize> = found.iter().map(|f| f.upper).sum();
        let known = expected[name]["finite"].as_u64().unwrap() as usize;
        let mut wrong = Vec::new();
        if let Some(finite) = finite {
            if finite + free != known {
                wrong.push(format!("{name}: {} instead of {known}", finite + free));
            }
            if expected[name]["pose"] != "regular" {
                wrong.push(format!("{name}: decided at a singular pose"));
            }
        }
        if lower + free > known || upper.is_some_and(|upper| upper + free < known) {
            wrong.push(format!(
                "{name}: {known} is not within {lower} to {upper:?}"
            ));
        }
        for part in &found {
            if part.text.is_empty() || part.text.contains('\n') || !(part.margin > 100.0) {
                wrong.push(format!("{name}: {} ({})", part.text, part.margin));
            }
            if part.finite.is_none() && part.class.is_some() {
                wrong.push(format!("{name}: a class without a decision"));
            }
        }
        (wrong, finite, class(&found))
    });
    let wrong: Vec<String> = results
        .iter()
        .flat_map(|(wrong, _, _)| wrong.clone())
        .collect();
    assert_none(&wrong);
    let named = |wanted: fn(Option<usize>, Option<MobilityClass>) -> bool| -> Vec<&str> {
        zoo.iter()
            .zip(&results)
            .filter(|(_, (_, finite, class))| wanted(*finite, *class))
            .map(|((name, _), _)| name.as_str())
            .collect()
    };
    let exceptional =
        named(|finite, class| finite.is_some() && class == Some(MobilityClass::Exceptional));
    assert_eq!(exceptional, EXCEPTIONAL);
    let trivial = named(|finite, class| {
        finite.is_some_and(|f| f > 0) && class == Some(MobilityClass::Trivial)
    });
    let rigid = named(|finite, _| finite == Some(0));
    assert_eq!(
        (trivial.len(), rigid.len()),
        (43, 12),
        "{trivial:?} {rigid:?}"
    );
    for name in [
        "agile_eye",
        "planar_4r_general",
        "planar_parallelogram_generic",
        "scissor_lift_3",
        "spherical_4r",
    ] {
        assert!(trivial.contains(&name), "{name}");
    }
}

/// Mobile by their dimensions, not by any subgroup; or at poses where chains do not span what they generate.
#[test]
fn what_subgroups_do_not_explain_stays_open() {
    for name in [
        "altmann_6r",
        "bennett_generic",
        "bricard_orthogonal",
        "delassus_4h_parallelogram",
        "goldberg_5r_L",
        "myard_5r",
        "parallelogram_3cranks",
        "planar_parallelogram_flat",
        "sarrus_6r_flat",
        "spherical_4r_flat",
        "wren_platform_6US",
    ] {
        let (found, _) = findings(&zoo_mechanism(name));
        assert!(found.iter().any(|part| part.finite.is_none()), "{name}");
    }
}
