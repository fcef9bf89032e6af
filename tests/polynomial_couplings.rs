//! Couplings with powers of joint variables: cams, and equalities of other programs.
//!
//! Two slides that are coupled move as a point on a plane curve, whatever its singularity: the verdict is known from the curve.

use kutzbach::closure::{Arithmetic, Geometry};
use kutzbach::format::{read, write};
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{Analysis, AnalysisOptions, analyse};

fn coupled(kind: &str, terms: &[(&str, u32, f64)], offset: f64) -> Mechanism {
    let term = |(joint, power, factor): &(&str, u32, f64)| {
        format!(r#"<term joint="{joint}" power="{power}" coefficient="{factor}"/>"#)
    };
    let terms: String = terms.iter().map(term).collect();
    let joint = |name: &str, axis: &str| {
        format!(
            r#"<link name="{name}_part"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
            <joint name="{name}" type="{kind}"><parent link="base"/><child link="{name}_part"/><axis xyz="{axis}"/></joint>"#
        )
    };
    let text = format!(
        r#"<robot name="curve"><link name="base"/>{}{}<coupling name="cam" offset="{offset}">{terms}</coupling></robot>"#,
        joint("x", "1 0 0"),
        joint("y", "0 1 0"),
    );
    read(&text, "curve.urdf", &[]).unwrap().mechanism
}

fn analysed(mechanism: &Mechanism) -> Analysis {
    analyse(mechanism, &AnalysisOptions::default()).unwrap()
}

#[test]
fn two_coupled_slides_move_as_their_curve_does() {
    for (name, terms, finite, branches) in [
        ("parabola", &[("y", 1, 1.0), ("x", 2, -1.0)][..], 1, 1),
        (
            "cubic",
            &[("y", 1, 1.0), ("x", 1, 0.5), ("x", 3, -1.0)],
            1,
            1,
        ),
        ("two lines", &[("y", 2, 1.0), ("x", 2, -1.0)], 1, 2),
        (
            "node",
            &[("y", 2, 1.0), ("x", 2, -1.0), ("x", 3, -1.0)],
            1,
            2,
        ),
        ("cusp", &[("y", 2, 1.0), ("x", 3, -1.0)], 1, 1),
        ("tacnode", &[("y", 2, 1.0), ("x", 4, -1.0)], 1, 2),
        ("isolated point", &[("y", 2, 1.0), ("x", 2, 1.0)], 0, 1),
        ("isolated, flat", &[("y", 2, 1.0), ("x", 4, 1.0)], 0, 1),
    ] {
        for kind in ["prismatic", "continuous"] {
            let mechanism = coupled(kind, terms, 0.0);
            let analysis = analysed(&mechanism);
            assert_eq!(
                analysis.mobility.finite(),
                Some(finite),
                "{name} of {kind} joints: {:?}",
                analysis.mobility
            );
            let found = analysis.branches.as_ref().map_or(0, Vec::len);
            let expected = if finite == 0 { 0 } else { branches };
            assert!(
                found == expected || branches == 1 && found == 0,
                "{name} of {kind} joints: {found}"
            );
        }
    }
}

#[test]
fn a_line_met_twice_stands_still_but_for_its_own_direction() {
    // x² = 0: y is free, x has a velocity that leads nowhere.
    let mechanism = coupled("prismatic", &[("x", 2, 1.0)], 0.0);
    let analysis = analysed(&mechanism);
    assert_eq!(
        analysis.mobility.finite(),
        Some(1),
        "{:?}",
        analysis.mobility
    );
}

#[test]
fn a_coupled_pose_is_found_from_where_it_is_drawn() {
    // y + y³ = 2 has the one solution 1, far from where the slides are drawn.
    let mechanism = coupled("prismatic", &[("y", 1, 1.0), ("y", 3, 1.0)], 2.0);
    let analysis = analysed(&mechanism);
    assert_eq!(
        analysis.mobility.finite(),
        Some(1),
        "{:?}",
        analysis.mobility
    );
}

#[test]
fn what_is_written_is_read_again() {
    let terms = [("y", 1, 1.0), ("x", 2, -0.5), ("x", 4, 0.25)];
    let mechanism = coupled("prismatic", &terms, 0.125);
    let again = read(&write(&mechanism), "again.urdf", &[])
        .unwrap()
        .mechanism;
    assert_eq!(mechanism.couplings(), again.couplings());
    for power in ["0", "5", "1.5", "two"] {
        let text = write(&mechanism).replace(r#"power="4""#, &format!(r#"power="{power}""#));
        let error = read(&text, "again.urdf", &[]).unwrap_err().to_string();
        assert!(error.contains("needed a power of 1 to 4"), "{error}");
    }
}

/// A ratio that was read in four decimals is no exact one, whatever it is multiplied by or divided by.
#[test]
fn factors_of_equalities_keep_their_digits() {
    let coupled = |coefficient: &str, second: &str| {
        let text = format!(
            r#"<mujoco><worldbody><body><joint name="a"/><body><joint name="b"/></body></body><body><joint name="c"/></body></worldbody>
            <tendon><fixed name="t"><joint joint="a" coef="{coefficient}"/></fixed><fixed name="u"><joint joint="b" coef="{second}"/></fixed></tendon>
            <equality><joint joint1="a" joint2="c" polycoef="0 0.3333 0 0 0"/><tendon tendon1="t" tendon2="u" polycoef="0 0.7 0 0 0"/></equality></mujoco>"#
        );
        let mechanism = read(&text, "model.xml", &[]).unwrap().mechanism;
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
        (write(&mechanism), geometry.coupling_digits)
    };
    let (text, digits) = coupled("1", "0.33333");
    assert!(text.contains(r#"multiplier="0.3333""#), "{text}");
    assert!(text.contains(r#"coefficient="-0.233331""#), "{text}");
    // Half a unit of each, of the product by the factor 0.7, relative to the lengths of the equations.
    let expected = [
        0.5e-4 / 1f64.hypot(0.3333),
        0.7 * 0.5e-5 / 1f64.hypot(0.233331),
    ];
    for (found, expected) in digits.iter().zip(expected) {
        assert!((found / expected - 1.0).abs() < 1e-9, "{digits:?}");
    }
    let (_, digits) = coupled("1", "0.25");
    assert!(digits[0] > 0.0 && digits[1] == 0.0, "{digits:?}");
}
