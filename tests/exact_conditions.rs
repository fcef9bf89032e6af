//! Conditions on measures that were left open: which values let a mechanism be put together, which let it move.

use kutzbach::algebra::{
    Budget, DesignConditions, Exceptions, Formulation, Limits, Meaning, MonomialOrder, Polynomial,
    PolynomialSystem, SystemOptions, assembly_conditions, groebner_basis, motion_conditions,
    polynomial_system,
};
use kutzbach::format::{ReadOptions, read_with};
use kutzbach::mechanism::{JointId, Mechanism};
use kutzbach::mobility::{AnalysisOptions, Depth, analyse};
use std::path::Path;

/// Generous: a slow machine must not fail a test of mathematics.
fn budget() -> Budget {
    Budget::new(Limits::seconds(300.0))
}

/// A file of `tests/conditions` with some measures left open and others set.
fn open(file: &str, symbolic: &[&str], settings: &[(&str, &str)]) -> Mechanism {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/conditions")
        .join(format!("{file}.urdf"));
    let options = ReadOptions {
        symbolic: symbolic.iter().map(|name| (*name).to_owned()).collect(),
        settings: settings
            .iter()
            .map(|(name, value)| ((*name).to_owned(), (*value).to_owned()))
            .collect(),
        ..ReadOptions::default()
    };
    let text = std::fs::read_to_string(path).unwrap();
    read_with(&text, file, &options).unwrap().mechanism
}

fn system(mechanism: &Mechanism, formulation: Formulation) -> PolynomialSystem {
    let options = SystemOptions {
        formulation,
        ..SystemOptions::default()
    };
    polynomial_system(mechanism, &options).unwrap()
}

/// Every condition as its factors, `or` between them.
fn texts(system: &PolynomialSystem, found: &DesignConditions) -> Vec<String> {
    let names = system.names();
    let mut texts: Vec<String> = found
        .conditions
        .iter()
        .map(|condition| {
            let factors = condition.factors.iter();
            let mut factors: Vec<String> = factors.map(|f| f.primitive().text(&names)).collect();
            factors.sort();
            factors.join(" or ")
        })
        .collect();
    texts.sort();
    texts
}

fn fits(file: &str, symbolic: &[&str]) -> Vec<String> {
    let mechanism = open(file, symbolic, &[]);
    let both = [Formulation::Canonical, Formulation::Tree].map(|formulation| {
        let system = system(&mechanism, formulation);
        texts(&system, &assembly_conditions(&system, &budget()).unwrap())
    });
    assert_eq!(both[0], both[1], "{file}");
    both[0].clone()
}

fn moves(file: &str, symbolic: &[&str], settings: &[(&str, &str)], joint: &str) -> Vec<String> {
    let mechanism = open(file, symbolic, settings);
    let joint = mechanism.joint_named(joint).unwrap();
    let system = system(&mechanism, Formulation::Canonical);
    let found = motion_conditions(&system, joint, &budget()).unwrap();
    texts(&system, &found.unwrap())
}

#[test]
fn in_the_plane() {
    // A bar between two pins 5 apart; its direction may be reversed.
    assert_eq!(fits("bar_between_pins", &["L"]), ["L + 5 or L - 5"]);
    // A triangle always fits (complex poses included), and turns where two of its corners coincide.
    assert!(fits("hinged_triangle", &["L"]).is_empty());
    assert_eq!(moves("hinged_triangle", &["L"], &[], "left_foot"), ["L"]);
}

#[test]
fn a_third_crank_on_a_parallelogram() {
    assert!(fits("three_cranks", &["L3"]).is_empty());
    for pivot in ["pivot_1", "pivot_2", "pivot_3"] {
        let length = moves("three_cranks", &["L3"], &[], pivot);
        assert_eq!(length, ["L3 + 2 or L3 - 2"], "{pivot}");
    }
    let both = moves("three_cranks", &["L3", "D"], &[], "pivot_1");
    assert_eq!(both, ["D - 1", "L3 + 2 or L3 - 2"]);
}

#[test]
fn on_the_sphere() {
    // The strap's hinges have to be as far apart as those of the base, either way round.
    let strap = fits("spherical_strap", &["arc"]);
    assert_eq!(
        strap,
        ["5*cos(arc) - 3", "5*sin(arc) + 4 or 5*sin(arc) - 4"]
    );
    assert!(fits("spherical_triangle", &["arc"]).is_empty());
    let turning = moves("spherical_triangle", &["arc"], &[], "left_foot");
    assert_eq!(turning, ["cos(arc) - 1", "sin(arc)"]);
}

#[test]
fn lengths_of_bennetts_linkage() {
    // Of twists with sines 4/5 and 3/5.
    let one = moves("bennett_measures", &["a"], &[], "hinge_1");
    assert_eq!(one, ["a - 4"]);
    for hinge in ["hinge_1", "hinge_2", "hinge_3", "hinge_4"] {
        let all = moves("bennett_measures", &["a", "b", "a2", "b2"], &[], hinge);
        assert_eq!(
            all,
            ["3*a2 + 4*b2 or 3*a2 - 4*b2", "a - a2", "b - b2"],
            "{hinge}"
        );
    }
}

#[test]
fn bennetts_condition() {
    // Nothing but equal opposite links is put in: a sin β = ± b sin α comes out.
    let equal = [("a2", "a"), ("b2", "b")];
    let open = ["a", "b", "alpha", "beta"];
    let found = moves("bennett_measures", &open, &equal, "hinge_1");
    assert_eq!(
        found,
        ["sin(alpha)*b + a*sin(beta) or sin(alpha)*b - a*sin(beta)"]
    );
}

/// The families of mechanisms in which a joint takes every position: equations and dimension.
fn families(file: &str, symbolic: &[&str], joint: &str) -> Vec<(Vec<String>, usize)> {
    let mechanism = open(file, symbolic, &[]);
    let joint = mechanism.joint_named(joint).unwrap();
    let system = system(&mechanism, Formulation::Canonical);
    let found = motion_conditions(&system, joint, &budget()).unwrap();
    let (families, complete) = found.unwrap().families(&system, &budget()).unwrap();
    assert!(complete, "{file}");
    let names = system.names();
    families
        .iter()
        .map(|family| {
            let equations = family.equations.iter();
            let texts = equations.map(|e| e.primitive().text(&names)).collect();
            (texts, family.dimension)
        })
        .collect()
}

#[test]
fn families_of_third_cranks() {
    let mut found = families("three_cranks", &["L3", "D"], "pivot_1");
    for (equations, _) in &mut found {
        equations.sort();
    }
    found.sort();
    let family = |length: &str| (vec!["D - 1".to_owned(), length.to_owned()], 0);
    assert_eq!(found, [family("L3 + 2"), family("L3 - 2")]);
}

#[test]
fn a_joint_without_variables_is_no_question() {
    let mechanism = open("bennett_measures", &["a"], &[]);
    let system = system(&mechanism, Formulation::Tree);
    let joints = (0..mechanism.joints().len()).map(JointId);
    let without: Vec<&str> = joints
        .filter(|joint| system.joint_variables[joint.0].is_empty())
        .map(|joint| {
            assert!(
                motion_conditions(&system, joint, &budget())
                    .unwrap()
                    .is_none()
            );
            mechanism.joint(joint).name.as_str()
        })
        .collect();
    assert_eq!(without.len(), 1);
    let output = crate::support::program()
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(["exact", "tests/conditions/bennett_measures.urdf"])
        .args(["--symbolic", "a", "--variables", "tree", "--moving"])
        .arg(without[0])
        .output()
        .unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(!output.status.success());
    assert!(said.contains("--variables canonical"), "{said}");
}

/// Several conditions, and the ways to satisfy all of them, as text and as data.
#[test]
fn the_ways_to_satisfy_conditions_are_listed() {
    let ask = |format: &str| {
        let output = crate::support::program()
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .args(["exact", "tests/conditions/bennett_measures.urdf"])
            .args(
                ["a", "b", "a2", "b2"]
                    .iter()
                    .flat_map(|m| ["--symbolic", m]),
            )
            .args(["--moving", "hinge_2", "--format", format])
            .output()
            .unwrap();
        assert!(output.status.success());
        String::from_utf8(output.stdout).unwrap()
    };
    let text = ask("text");
    assert!(text.contains("Ways to satisfy all of it"), "{text}");
    let data: serde_json::Value = serde_json::from_str(&ask("json")).unwrap();
    let families = data["families"].as_array().unwrap();
    assert_eq!(families.len(), 2);
    assert!(families.iter().all(|family| family["dimension"] == 1));
    assert_eq!(data["families_fully_split"], true);
}

/// Too long for every commit.
mod corpus {
    use super::*;

    /// All loops of four hinges without offsets whose opposite links have equal twists and in which a hinge turns for ever.
    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn families_of_four_hinges() {
        let open = ["a", "b", "a2", "b2", "alpha", "beta"];
        let found = families("bennett_measures", &open, "hinge_1");
        let mut counts = [0; 4];
        for (equations, dimension) in &found {
            let has = |wanted: &[&str]| wanted.iter().all(|w| equations.iter().any(|e| e == w));
            let (kind, expected) = if has(&["sin(alpha)", "sin(beta)"]) {
                // Planar: any lengths.
                (0, 4)
            } else if has(&["a - a2", "b - b2"]) {
                // Bennett: b, α and β free, a = ± b sin α / sin β.
                let ratio = equations.iter().find(|e| e.contains("sin(alpha)*"));
                let ratio = ratio.map(String::as_str);
                let ratios = [
                    "sin(beta)*a2 - sin(alpha)*b2",
                    "sin(beta)*a2 + sin(alpha)*b2",
                ];
                assert!(ratio.is_some_and(|r| ratios.contains(&r)), "{equations:?}");
                (1, 3)
            } else if has(&["a", "sin(alpha)"]) || has(&["b2", "sin(beta)"]) {
                // A link of the hinge has both its hinges on one line.
                (2, 3)
            } else {
                // Two pairs of neighbours alike: each folded on the other, the two circles of (7.11).
                let pair = |plus: &str, minus: &str| has(&[plus]) || has(&[minus]);
                assert!(
                    pair("a + b", "a - b") && pair("a2 + b2", "a2 - b2"),
                    "{equations:?}"
                );
                assert!(pair("sin(alpha) + sin(beta)", "sin(alpha) - sin(beta)"));
                (3, 3)
            };
            assert_eq!(*dimension, expected, "{equations:?}");
            counts[kind] += 1;
        }
        // Cosines of 1 and −1, and signs of lengths, count by themselves.
        assert_eq!(counts, [4, 2, 8, 4]);
    }
}

/// A mechanism written here, read with these measures open and set.
fn written(body: &str, symbolic: &[&str], settings: &[(&str, String)]) -> Mechanism {
    let text =
        format!("<robot name=\"m\" xmlns:xacro=\"http://ros.org/wiki/xacro\">{body}</robot>");
    let options = ReadOptions {
        symbolic: symbolic.iter().map(|name| (*name).to_owned()).collect(),
        settings: settings
            .iter()
            .map(|(name, value)| ((*name).to_owned(), value.clone()))
            .collect(),
        ..ReadOptions::default()
    };
    read_with(&text, "m.urdf", &options).unwrap().mechanism
}

/// Two slides at an angle whose carriages a pin joins, at the height `h`.
const WEDGE: &str = r#"<xacro:property name="alpha" value="pi/2"/><xacro:property name="h" value="1"/>
  <link name="g"/><link name="a"/><link name="b"/>
  <joint name="A" type="prismatic"><parent link="g"/><child link="a"/><origin xyz="0 ${h} 0"/><axis xyz="1 0 0"/></joint>
  <joint name="B" type="prismatic"><parent link="g"/><child link="b"/><axis xyz="${cos(alpha)} ${sin(alpha)} 0"/></joint>
  <loop name="C" type="revolute"><predecessor link="a"/><successor link="b"/><axis xyz="0 0 1"/></loop>"#;

/// A crank of length `r`, a rod of length `l` and a slide at the offset `e`.
const SLIDER_CRANK: &str = r#"<xacro:property name="r" value="1"/><xacro:property name="l" value="2"/><xacro:property name="e" value="1/2"/>
  <link name="g"/><link name="a"/><link name="b"/><link name="c"/>
  <joint name="A" type="revolute"><parent link="g"/><child link="a"/><axis xyz="0 0 1"/></joint>
  <joint name="B" type="revolute"><parent link="a"/><child link="b"/><origin xyz="${r} 0 0"/><axis xyz="0 0 1"/></joint>
  <joint name="C" type="prismatic"><parent link="g"/><child link="c"/><origin xyz="0 ${e} 0"/><axis xyz="1 0 0"/></joint>
  <loop name="D" type="revolute"><predecessor link="b"><origin xyz="${l} 0 0"/></predecessor><successor link="c"/><axis xyz="0 0 1"/></loop>"#;

/// A bar between two pins, one of which is on a slide through the other at a slope; its length is 1/L.
const INVERSE: &str = r#"<xacro:property name="L" value="1"/><xacro:property name="d" value="1"/>
  <link name="g"/><link name="a"/><link name="s"/>
  <joint name="A" type="revolute"><parent link="g"/><child link="a"/><axis xyz="0 0 1"/></joint>
  <joint name="S" type="prismatic"><parent link="g"/><child link="s"/><origin xyz="0 ${d} 0"/><axis xyz="${d} 1 0"/></joint>
  <loop name="B" type="revolute"><predecessor link="a"><origin xyz="${1/L} 0 0"/></predecessor><successor link="s"/><axis xyz="0 0 1"/></loop>"#;

/// Whether all of these vanish where the parameters have the values of another system of the same file.
fn vanish(all: &[Polynomial], open: &PolynomialSystem, at: &PolynomialSystem) -> bool {
    let value = |name: &str| {
        let variable = at.variables.iter().find(|v| v.name == name).unwrap();
        match &variable.meaning {
            Meaning::Parameter { value } | Meaning::Algebraic { value } => value.value(),
            other => panic!("{name} is an unknown: {other:?}"),
        }
    };
    all.iter().all(|polynomial| {
        let terms = polynomial.terms().map(|(exponents, coefficient)| {
            let number = coefficient.numer().to_string().parse::<f64>().unwrap()
                / coefficient.denom().to_string().parse::<f64>().unwrap();
            exponents
                .iter()
                .zip(&open.variables)
                .filter(|(e, _)| **e > 0)
                .fold(number, |product, (&e, v)| {
                    product * value(&v.name).powi(i32::try_from(e).unwrap())
                })
        });
        // Values of one digit and powers below six: what does not vanish is far larger.
        terms.sum::<f64>().abs() < 1e-9
    })
}

/// Whether conditions and exceptions together say that there is a solution at the values of another system.
fn said(
    found: &DesignConditions,
    exceptions: &Exceptions,
    open: &PolynomialSystem,
    at: &PolynomialSystem,
) -> bool {
    let conditions: Vec<Polynomial> = found
        .conditions
        .iter()
        .map(|c| c.polynomial.clone())
        .collect();
    let mut all = exceptions.found.iter();
    vanish(&conditions, open, at)
        && all.all(|e| !vanish(&e.on, open, at) || vanish(&e.only_if, open, at))
}

#[test]
fn what_is_said_of_open_measures_is_so_at_their_values() {
    let lengths = ["0", "1", "-1", "1/2", "2", "3", "-3", "5"];
    let angles = ["0", "pi/2", "pi", "-pi/2", "pi/6", "acos(3/5)"];
    let mut compared = 0;
    let mut without = 0;
    for (body, names) in [
        (WEDGE, vec!["alpha", "h"]),
        (WEDGE, vec!["alpha"]),
        (SLIDER_CRANK, vec!["r", "l"]),
        (SLIDER_CRANK, vec!["l", "e"]),
        (INVERSE, vec!["L", "d"]),
        (INVERSE, vec!["d"]),
    ] {
        let open = system(&written(body, &names, &[]), Formulation::Canonical);
        let found = assembly_conditions(&open, &budget()).unwrap();
        let exceptions = found.exceptions(&open, None, &budget());
        assert!(exceptions.complete, "{names:?}");
        let values = |name: &str| {
            if name == "alpha" {
                &angles[..]
            } else {
                &lengths[..]
            }
        };
        for first in values(names[0]) {
            for second in names.get(1).map_or(&[""][..], |name| values(name)) {
                let settings = [*first, *second].map(str::to_owned);
                let settings: Vec<(&str, String)> = names.iter().copied().zip(settings).collect();
                if settings
                    .iter()
                    .any(|(name, value)| *name == "L" && value == "0")
                {
                    continue;
                }
                let at = system(&written(body, &names, &settings), Formulation::Canonical);
                let closed = system(&written(body, &[], &settings), Formulation::Canonical);
                let order = MonomialOrder::Degrevlex;
                let basis = groebner_basis(
                    &closed.polynomials(),
                    closed.variables.len(),
                    &order,
                    &budget(),
                );
                let is = !basis.unwrap().is_inconsistent();
                assert_eq!(said(&found, &exceptions, &open, &at), is, "{settings:?}");
                compared += 1;
                without += usize::from(!is);
            }
        }
    }
    assert!(compared > 200 && without > 10, "{compared} {without}");
}

#[test]
fn positions_of_a_joint_are_all_met_but_where_exceptions_say_so() {
    // The crank meets every position, in complex numbers, unless the rod has no length: then it rests where the slide passes.
    let open = written(SLIDER_CRANK, &["l"], &[]);
    let joint = open.joint_named("A").unwrap();
    let open = system(&open, Formulation::Canonical);
    let found = motion_conditions(&open, joint, &budget()).unwrap().unwrap();
    assert!(found.conditions.is_empty());
    let exceptions = found.exceptions(&open, Some(joint), &budget());
    let names = open.names();
    let texts: Vec<String> = exceptions
        .found
        .iter()
        .flat_map(|e| e.on.iter().map(|p| p.text(&names)))
        .collect();
    assert_eq!((texts, exceptions.complete), (vec!["l".to_owned()], true));
}

#[test]
fn roots_are_not_negative() {
    // A bar of length √L between pins 5 apart: √L = −5 is none of the ways.
    let body = r#"<xacro:property name="L" value="25"/><link name="g"/><link name="bar"/>
  <joint name="p1" type="revolute"><parent link="g"/><child link="bar"/><axis xyz="0 0 1"/></joint>
  <loop name="p2" type="revolute"><predecessor link="g"><origin xyz="3 4 0"/></predecessor><successor link="bar"><origin xyz="${sqrt(L)} 0 0"/></successor><axis xyz="0 0 1"/></loop>"#;
    let open = system(&written(body, &["L"], &[]), Formulation::Canonical);
    let found = assembly_conditions(&open, &budget()).unwrap();
    assert_eq!(texts(&open, &found), ["L - 25", "sqrt(L) - 5"]);
    let none = body.replace("${sqrt(L)}", "${-sqrt(L)-1}");
    let open = system(&written(&none, &["L"], &[]), Formulation::Canonical);
    let found = assembly_conditions(&open, &budget()).unwrap();
    assert!(texts(&open, &found).contains(&"sqrt(L) - 4".to_owned()));
}

/// What has to hold in real numbers, as `apart <= others`.
fn reaches(file: &str, symbolic: &[&str], settings: &[(&str, &str)]) -> Vec<String> {
    let mechanism = open(file, symbolic, settings);
    let both = [Formulation::Canonical, Formulation::Positional].map(|formulation| {
        let found = system(&mechanism, formulation).reaches().into_iter();
        let mut found: Vec<String> = found
            .map(|reach| format!("{} <= {}", reach.apart, reach.others.join(" + ")))
            .collect();
        found.sort();
        found
    });
    assert_eq!(both[0], both[1], "{file}");
    both[0].clone()
}

/// Finite mobility at values; `None` where nothing closes.
fn freedom(file: &str, settings: &[(&str, &str)]) -> Option<usize> {
    let options = AnalysisOptions {
        depth: Depth::Verdict,
        ..AnalysisOptions::default()
    };
    let analysis = analyse(&open(file, &[], settings), &options).unwrap();
    analysis.mobility.finite()
}

/// The example of Ruiz 1994, section 2.2: two lines and a length, nothing or one or two freedoms by their distance and whether they are parallel.
#[test]
fn a_bar_on_two_lines_has_to_reach() {
    let file = "bar_on_two_lines";
    for turn in ["pi/2", "pi/3", "0"] {
        let lines = [("turn", turn)];
        assert_eq!(reaches(file, &["L"], &lines), ["2 <= |L|"]);
        let at = |length: &str| freedom(file, &[("L", length), ("turn", turn)]);
        let touching = if turn == "0" { 2 } else { 1 };
        assert_eq!(
            ["3/2", "2", "5/2"].map(at),
            [None, Some(touching), Some(2)],
            "{turn}"
        );
    }
    // Where nothing is open there is nothing to say.
    assert_eq!(reaches(file, &[], &[]), Vec::<String>::new());
}

/// Of a planar polygon they are sufficient as well: 40 four-bars, none of whose lengths is just the sum of the others.
#[test]
fn no_length_is_more_than_the_others_together() {
    let file = "four_bar_lengths";
    let names = ["a", "b", "c", "d"];
    let all = reaches(file, &names, &[]);
    assert_eq!(
        all,
        [
            "|a| <= |b| + |c| + |d|",
            "|b| <= |a| + |c| + |d|",
            "|c| <= |a| + |b| + |d|",
            "|d| <= |a| + |b| + |c|"
        ]
    );
    // What holds whatever `a` is goes without saying.
    assert_eq!(reaches(file, &["a"], &[]), ["|a| <= 4 + 4 + 5"]);
    let long = [("d", "20")];
    assert_eq!(
        reaches(file, &["a"], &long),
        ["20 <= |a| + 4 + 4", "|a| <= 4 + 4 + 20"]
    );
    let mut seed = 11u64;
    let mut closing = 0;
    for _ in 0..40 {
        let mut lengths = [0u64; 4].map(|_| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            1 << ((seed >> 33) % 5)
        });
        // An odd sum.
        lengths[3] += (lengths.iter().sum::<u64>() + 1) % 2;
        let fits = lengths.iter().all(|l| 2 * l <= lengths.iter().sum());
        let texts = lengths.map(|l| l.to_string());
        let settings: Vec<(&str, &str)> = names
            .iter()
            .copied()
            .zip(texts.iter().map(String::as_str))
            .collect();
        assert_eq!(freedom(file, &settings), fits.then_some(1), "{lengths:?}");
        closing += usize::from(fits);
    }
    assert!(closing > 10 && closing < 35, "{closing}");
}
