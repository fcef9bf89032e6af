//! What exact algebra adds to verdicts, and what it leaves alone.

use crate::support;

use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{
    Analysis, AnalysisOptions, Bounds, CertificateLevel, EngineName, ExactBudget, SingularKind,
    Verdict, analyse,
};
use support::{assert_none, in_parallel, own_mechanisms, zoo, zoo_mechanism};

fn with(mechanism: &Mechanism, exact: ExactBudget) -> Analysis {
    let options = AnalysisOptions {
        exact,
        ..AnalysisOptions::default()
    };
    analyse(mechanism, &options).unwrap()
}

/// What the engine said, part by part.
fn said(analysis: &Analysis) -> Vec<String> {
    analysis
        .claims()
        .filter(|(_, claim)| claim.engine == EngineName::Exact)
        .map(|(_, claim)| claim.text.clone())
        .collect()
}

/// Everything that is said of a mechanism but how it is known.
fn facts(analysis: &Analysis) -> String {
    let m = &analysis.mobility;
    format!(
        "{} {:?} {:?} {:?} {:?} {:?} {:?} {:?}",
        m.verdict,
        m.bounds,
        m.pose,
        m.kind,
        m.class,
        m.complex_dimension,
        m.nominal,
        analysis
            .branches
            .as_ref()
            .map(|b| b.iter().map(|b| b.dimension).collect::<Vec<_>>())
    )
}

/// What is wrong about one mechanism, and whether its certificate is exact.
fn compared(name: &str, mechanism: &Mechanism) -> (Vec<String>, bool) {
    let mut wrong = Vec::new();
    let without = with(mechanism, ExactBudget::none());
    let default = with(mechanism, ExactBudget::default());
    if facts(&without) != facts(&default) {
        wrong.push(format!(
            "{name}: {} became {}",
            facts(&without),
            facts(&default)
        ));
    }
    if !said(&without).is_empty() {
        wrong.push(format!("{name}: asked without a budget"));
    }
    for found in &default.findings {
        for text in found.contradictions() {
            wrong.push(format!("{name}: {text}"));
        }
        if found.level() == CertificateLevel::Exact && found.nominal().is_some() {
            wrong.push(format!("{name}: exact about rounded numbers"));
        }
    }
    let again = with(mechanism, ExactBudget::default());
    if said(&again) != said(&default) || again.mobility.certificate != default.mobility.certificate
    {
        wrong.push(format!("{name}: another run says something else"));
    }
    (wrong, default.mobility.level == CertificateLevel::Exact)
}

fn compare_all(set: &[(String, Mechanism)]) -> usize {
    let found = in_parallel(set, |(name, mechanism)| compared(name, mechanism));
    let exact = found.iter().filter(|(_, exact)| *exact).count();
    let wrong: Vec<String> = found.into_iter().flat_map(|(wrong, _)| wrong).collect();
    assert_none(&wrong);
    exact
}

#[test]
fn what_stands_is_proved_to_stand() {
    for (name, kind) in [
        ("triangle_3r_rigid", None),
        ("planar_3RPR_locked", None),
        ("collinear_3r_shaky", Some(SingularKind::Shaky)),
    ] {
        let found = with(&zoo_mechanism(name), ExactBudget::default()).mobility;
        assert_eq!(
            (found.verdict, found.level, found.kind),
            (Verdict::Rigid, CertificateLevel::Exact, kind),
            "{name}"
        );
        assert_eq!(found.complex_dimension, Some(0), "{name}");
    }
}

/// A point that is isolated among the real solutions and not among the complex ones: both are said, and neither is taken
/// for the other.
#[test]
fn complex_solutions_are_not_motions() {
    for name in ["planar_4r_stretched_isolated", "ppsrr_plane_torus_isolated"] {
        let analysis = with(&zoo_mechanism(name), ExactBudget::default());
        let found = &analysis.mobility;
        assert_eq!(
            (found.verdict, found.finite(), found.complex_dimension),
            (Verdict::Rigid, Some(0), Some(1)),
            "{name}"
        );
        assert_eq!(found.level, CertificateLevel::Numeric, "{name}");
        assert!(
            found.why.iter().any(|w| w.contains("complex")),
            "{:?}",
            found.why
        );
        let said = said(&analysis).concat();
        assert!(
            said.contains("at most 1") && said.contains("no less"),
            "{said}"
        );
    }
}

#[test]
fn rational_numbers_prove_a_paradox() {
    let own = own_mechanisms();
    let named = |name: &str| &own.iter().find(|(n, _)| n == name).unwrap().1;
    let found = with(named("bennett"), ExactBudget::default()).mobility;
    assert_eq!(
        (found.verdict, found.finite(), found.level),
        (Verdict::Mobile, Some(1), CertificateLevel::Exact)
    );
    let spoiled = with(named("bennett_spoiled"), ExactBudget::default()).mobility;
    assert_eq!(
        (spoiled.verdict, spoiled.level),
        (Verdict::Rigid, CertificateLevel::Exact)
    );
}

#[test]
fn rounded_numbers_are_not_taken_for_fractions() {
    let found = with(
        &zoo_mechanism("bennett_perturbed_1e-6"),
        ExactBudget::seconds(10.0),
    );
    assert_eq!(found.mobility.level, CertificateLevel::Numeric);
    assert!(said(&found).iter().all(|text| text.contains("rounded")));
}

#[test]
fn a_budget_is_kept() {
    let mechanism = zoo_mechanism("dixon_I_K33");
    let small = with(&mechanism, ExactBudget::seconds(0.001));
    assert_eq!(small.mobility.level, CertificateLevel::Numeric);
    assert!(said(&small)[0].contains("work limit"), "{:?}", said(&small));
    // What is known without the rest is kept.
    let mut claims = small.claims().map(|(_, claim)| claim);
    let exact = claims.find(|claim| claim.engine == EngineName::Exact);
    assert_eq!(exact.unwrap().finite, Bounds::at_most(1));
    let little = with(&mechanism, ExactBudget::default().within(1_000));
    assert_eq!(little.mobility.level, CertificateLevel::Numeric);
    assert!(said(&little)[0].contains("memory"), "{:?}", said(&little));
    for none in [0.0, -1.0, f64::NAN] {
        assert_eq!(ExactBudget::seconds(none), ExactBudget::none());
    }
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn in_our_own_files_it_changes_certificates_and_no_facts() {
        let own = support::sample(own_mechanisms(), 3);
        let exact = compare_all(&own);
        println!("{exact} of {} certificates are exact", own.len());
        assert!(exact >= support::at_least(25), "{exact}");
    }

    /// Most files of the zoo hold sixty-digit decimals, about which exact algebra is not asked, or have certificates by subgroups.
    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn in_the_zoo_it_changes_certificates_and_no_facts() {
        let zoo = support::sample(zoo(), 3);
        let exact = compare_all(&zoo);
        println!("{exact} of {} certificates are exact", zoo.len());
        assert!(exact >= support::at_least(6), "{exact}");
    }
}
