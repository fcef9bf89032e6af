//! Polynomial systems of mechanisms: what they count, and that they vanish where the mechanisms stand.
//!
//! The closure equations in floating point know nothing of the polynomials: other variables, other frames, other signs.
//! Wherever they say that a mechanism is assembled, every polynomial has to vanish.

use crate::support;

use kutzbach::algebra::{
    Formulation, HomePose, MEMORY, Meaning, Origin, PolynomialSystem, Relaxation, SystemError,
    SystemOptions, polynomial_system,
};
use kutzbach::closure::{Arithmetic, Geometry, Part, Rigid, assemble, spanning_poses};
use kutzbach::format::{ReadOptions, read, read_with};
use kutzbach::graph::{ConstraintGraph, CycleBasis, SpanningTree};
use kutzbach::mechanism::{Direction, Frame, JointBuilder, JointKind, Mechanism, MechanismBuilder};
use kutzbach::number::Number;
use num_traits::{Signed, ToPrimitive};
use proptest::prelude::*;
use std::collections::BTreeSet;
use support::{assert_none, folder, in_parallel, own_mechanisms, zoo};

const FORMULATIONS: [Formulation; 3] = [
    Formulation::Canonical,
    Formulation::Tree,
    Formulation::Positional,
];

fn options(formulation: Formulation) -> SystemOptions {
    SystemOptions {
        formulation,
        ..SystemOptions::default()
    }
}

fn system(mechanism: &Mechanism, formulation: Formulation) -> PolynomialSystem {
    polynomial_system(mechanism, &options(formulation)).unwrap_or_else(|e| panic!("{e}"))
}

fn own(name: &str) -> Mechanism {
    let path = folder("mechanisms").join(format!("{name}.urdf"));
    kutzbach::format::read_file(path, &[]).unwrap().mechanism
}

/// Link poses of a mechanism assembled from a start that is off its drawn pose by up to `off` in every joint variable;
/// `None` where it does not assemble from there.
fn assembled(mechanism: &Mechanism, off: f64, seed: u64) -> Option<Vec<Rigid<f64>>> {
    let graph = ConstraintGraph::of(mechanism);
    let tree = SpanningTree::low_depth(&graph);
    let part = Part {
        joints: (0..mechanism.joints().len()).collect(),
        cycles: CycleBasis::minimum(&graph, &tree)
            .cycles
            .into_iter()
            .map(|cycle| cycle.edges)
            .collect(),
        couplings: (0..mechanism.couplings().len()).collect(),
    };
    let mut geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let mut random = seed;
    for (displacement, state) in geometry.displacements.iter().zip(&mut geometry.states) {
        let increments: Vec<f64> = (0..displacement.freedom())
            .map(|_| {
                random = random
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1_442_695_040_888_963_407);
                ((random >> 33) as f64 / f64::from(1u32 << 30) - 1.0) * off
            })
            .collect();
        displacement.advance(state, &increments);
    }
    let assembly = assemble(mechanism, &geometry, &[part], &BTreeSet::new()).unwrap();
    // Sixty digits close to rounding; coarser numbers are left as they are.
    (assembly.closed && assembly.residual < 1e-11)
        .then(|| spanning_poses(mechanism, &geometry, &assembly.states).0)
}

/// The largest value of an equation at a point, in units of its coefficients, and where it comes from.
fn largest_residual(system: &PolynomialSystem, point: &[f64]) -> (f64, Option<Origin>) {
    let mut worst = (0.0, None);
    for equation in &system.equations {
        let terms = || equation.polynomial.terms();
        let unit = terms().map(|(_, c)| c.abs()).max().unwrap();
        let (mut value, mut size) = (0.0, 0.0);
        for (exponents, coefficient) in terms() {
            // Integers of thousands of bits are beyond doubles, their quotients are not.
            let start = (coefficient / &unit).to_f64().unwrap();
            let powers = exponents.iter().zip(point);
            value += powers.fold(start, |product, (e, x)| product * x.powi(*e as i32));
            size += start.abs();
        }
        let residual = (value / size).abs();
        if !(residual <= worst.0) {
            worst = (residual, Some(equation.origin));
        }
    }
    worst
}

/// What does not vanish at a pose, in words.
fn faults(name: &str, system: &PolynomialSystem, poses: &[Rigid<f64>]) -> Option<String> {
    let (residual, origin) = largest_residual(system, &system.point_at(poses));
    (!(residual < 1e-9)).then(|| format!("{name}: {residual:e} in {origin:?}"))
}

#[test]
fn sizes_of_the_worked_examples() {
    // Variables and equations in the three formulations; the first column as in Ruiz (1994) where the tree is the same.
    for (name, sizes) in [
        ("double_peg_and_hole", [(6, 7), (3, 3), (12, 15)]),
        ("three_body_assembly", [(9, 14), (6, 6), (24, 31)]),
        ("block_and_corner", [(21, 40), (3, 3), (12, 17)]),
        ("thomas_torras_assembly", [(18, 25), (9, 13), (36, 54)]),
        ("cartesian_table", [(40, 63), (16, 17), (48, 64)]),
        ("oldham", [(6, 6), (4, 3), (36, 58)]),
    ] {
        let mechanism = own(name);
        for (formulation, size) in FORMULATIONS.into_iter().zip(sizes) {
            let system = system(&mechanism, formulation);
            let found = (system.variables.len(), system.equations.len());
            assert_eq!(found, size, "{name} {formulation:?}");
        }
    }
    let unoriented = SystemOptions {
        formulation: Formulation::Positional,
        unoriented: true,
        ..SystemOptions::default()
    };
    let pegs = polynomial_system(&own("double_peg_and_hole"), &unoriented).unwrap();
    assert_eq!((pegs.variables.len(), pegs.equations.len()), (12, 14));
}

#[test]
fn irrational_numbers_are_variables_with_their_own_equations() {
    let system = system(&own("schatz_six_bar"), Formulation::Canonical);
    let algebraic: Vec<_> = system
        .variables
        .iter()
        .enumerate()
        .filter(|(_, v)| v.meaning.is_algebraic_number())
        .collect();
    assert_eq!(algebraic.len(), 2);
    for (index, variable) in algebraic {
        let Meaning::Algebraic { value } = &variable.meaning else {
            unreachable!("it was asked for");
        };
        let own = system
            .equations
            .iter()
            .find(|e| e.origin == Origin::MinimalPolynomial { variable: index })
            .unwrap();
        let mut point = vec![f64::NAN; system.variables.len()];
        point[index] = value.value();
        let sum: f64 = own
            .polynomial
            .terms()
            .map(|(e, c)| c.to_f64().unwrap() * point[index].powi(e[index] as i32))
            .sum();
        assert!(sum.abs() < 1e-12, "{}: {sum}", variable.name);
    }
}

const CRANKS: &str = r#"<robot name="cranks" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:property name="a" value="1"/> <xacro:property name="b" value="2"/>
  <xacro:property name="alpha" value="pi/3"/>
  <link name="ground"/> <link name="crank"/> <link name="coupler"/> <link name="rocker"/>
  <joint name="A" type="revolute"><parent link="ground"/><child link="crank"/><axis xyz="0 0 1"/></joint>
  <joint name="B" type="revolute"><parent link="crank"/><child link="coupler"/>
    <origin xyz="${a} 0 0" rpy="${alpha/2} 0 0"/><axis xyz="0 0 1"/></joint>
  <joint name="D" type="revolute"><parent link="ground"/><child link="rocker"/>
    <origin xyz="0 ${b} 0"/><axis xyz="0 ${a/b} 1"/></joint>
  <loop name="C" type="revolute">
    <predecessor link="coupler"><origin xyz="0 ${b} 0" rpy="${-alpha/2} 0 0"/></predecessor>
    <successor link="rocker"><origin xyz="${a} ${b*cos(alpha/2) - b} ${b*sin(alpha/2)}"/></successor>
    <axis xyz="0 0 1"/></loop>
</robot>"#;

#[test]
fn symbolic_properties_are_variables() {
    let symbolic = |names: &[&str]| {
        let options = ReadOptions {
            symbolic: names.iter().map(|n| (*n).to_owned()).collect(),
            ..ReadOptions::default()
        };
        read_with(CRANKS, "cranks.urdf", &options).map(|reading| reading.mechanism)
    };
    let plain = read(CRANKS, "cranks.urdf", &[]).unwrap().mechanism;
    for formulation in FORMULATIONS {
        let plain = system(&plain, formulation);
        let system = system(&symbolic(&["a", "b", "alpha"]).unwrap(), formulation);
        let parameters: Vec<&str> = system
            .variables
            .iter()
            .filter(|v| matches!(v.meaning, Meaning::Parameter { .. }))
            .map(|v| v.name.as_str())
            .collect();
        let expected: BTreeSet<&str> = ["a", "b", "cos(alpha/2)", "sin(alpha/2)"].into();
        assert_eq!(
            parameters.iter().copied().collect::<BTreeSet<_>>(),
            expected
        );
        let circles =
            |e: &&kutzbach::algebra::Equation| matches!(e.origin, Origin::Parameter { .. });
        assert_eq!(system.equations.iter().filter(circles).count(), 1);
        // The axis (0 a/b 1) divides by b, and by its own square.
        assert!(!system.nonzero.is_empty(), "{formulation:?}");
        let values = system.home.exact().unwrap();
        let b = system.variables.iter().position(|v| v.name == "b").unwrap();
        assert_eq!(values[b], Number::integer(2));
        // At the values of the file it is the same system.
        let modulo = |system: &PolynomialSystem| {
            let modulo = system.home_modulo(0, MEMORY).unwrap();
            let names: Vec<String> = modulo
                .variables
                .iter()
                .map(|&v| system.variables[v].name.clone())
                .collect();
            (names, modulo.equations.len())
        };
        assert_eq!(modulo(&system), modulo(&plain), "{formulation:?}");
    }
    let error = symbolic(&["c"]).unwrap_err();
    let text = format!("{error} {}", error.help.clone().unwrap_or_default());
    for word in ["`c`", "`a`", "`b`", "`alpha`"] {
        assert!(text.contains(word), "{text}");
    }
}

#[test]
fn rounded_angles_are_refused_with_advice() {
    let text = CRANKS.replace("pi/3", "1.0472");
    let mechanism = read(&text, "cranks.urdf", &[]).unwrap().mechanism;
    let error = polynomial_system(&mechanism, &SystemOptions::default()).unwrap_err();
    assert!(matches!(error, SystemError::NotAlgebraic { .. }));
    let text = error.to_string();
    for part in ["joint `B`", "origin of the predecessor", "write ${pi/6}"] {
        assert!(text.contains(part), "{text}");
    }
    let options = SystemOptions {
        configuration: Some("open".to_owned()),
        ..SystemOptions::default()
    };
    let error = polynomial_system(&own("oldham"), &options).unwrap_err();
    assert!(matches!(error, SystemError::UnknownConfiguration { .. }));
}

/// Two wheels on the ground about z and one about x.
fn wheels(coupling: &str, more: &str) -> Mechanism {
    let text = format!(
        r#"<robot name="wheels"><link name="ground"/><link name="a"/><link name="b"/><link name="c"/>
        <joint name="A" type="revolute"><parent link="ground"/><child link="a"/><axis xyz="0 0 1"/></joint>
        <joint name="B" type="revolute"><parent link="ground"/><child link="b"/><origin xyz="3 0 0"/><axis xyz="0 1 1"/></joint>
        <joint name="C" type="prismatic"><parent link="ground"/><child link="c"/><axis xyz="0 1 1"/>{more}</joint>
        {coupling}</robot>"#
    );
    read(&text, "wheels.urdf", &[])
        .unwrap_or_else(|e| panic!("{e}"))
        .mechanism
}

fn gear(ratio: &str, wheel: &str) -> String {
    format!(
        r#"<coupling name="gear"><predecessor link="a"/><successor link="{wheel}"/><ratio value="{ratio}"/></coupling>"#
    )
}

#[test]
fn gears_are_equal_points_of_the_circle() {
    for (ratio, turns) in [
        ("-2", (2.0, -4.0)),
        ("1.5", (2.0, 3.0)),
        ("${-3/4}", (4.0, -3.0)),
    ] {
        let mechanism = wheels(&gear(ratio, "b"), "");
        let system = system(&mechanism, Formulation::Canonical);
        assert!(system.is_exact(), "{ratio}: {:?}", system.relaxations);
        assert!(
            system
                .equations
                .iter()
                .any(|e| matches!(e.origin, Origin::Coupling { coupling: 0 }))
        );
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
        let mut states = geometry.states.clone();
        for unit in [0.1, -0.37, 1.4] {
            states[0] = geometry.displacements[0].at(&[turns.0 * unit]);
            states[1] = geometry.displacements[1].at(&[turns.1 * unit]);
            let poses = spanning_poses(&mechanism, &geometry, &states).0;
            assert_eq!(faults(ratio, &system, &poses), None);
            states[1] = geometry.displacements[1].at(&[turns.1 * unit + 0.2]);
            let poses = spanning_poses(&mechanism, &geometry, &states).0;
            assert!(faults(ratio, &system, &poses).is_some(), "a slipped gear");
        }
        let drawn = system.home.exact().unwrap();
        assert_eq!(drawn.len(), system.variables.len());
    }
}

#[test]
fn couplings_that_are_not_algebraic_are_left_out_and_named() {
    let rack = r#"<mimic joint="A" multiplier="0.1"/>"#;
    for (mechanism, word) in [
        (wheels("", rack), "angle to a length"),
        (wheels(&gear("${sqrt(2)}", "b"), ""), "not rational"),
        (wheels(&gear("0.123", "b"), ""), "too high a degree"),
    ] {
        let system = system(&mechanism, Formulation::Canonical);
        let [Relaxation::Coupling { reason, .. }] = system.relaxations.as_slice() else {
            panic!("{:?}", system.relaxations);
        };
        assert!(reason.contains(word), "{reason}");
        assert!(!system.is_exact());
    }
}

#[test]
fn screws_on_one_line_are_linear() {
    for name in ["differential_screw", "screw_jack"] {
        let system = system(&own(name), Formulation::Canonical);
        assert!(system.is_exact(), "{name}");
        let linear = system.equations.iter().all(|e| e.polynomial.degree() == 1);
        assert!(linear, "{name}: {:?}", system.names());
    }
    let parallel = support::zoo_mechanism("delassus_4h_parallelogram");
    let system = system(&parallel, Formulation::Canonical);
    assert_eq!(system.relaxations.len(), 4);
    assert!(system.relaxations[0].to_string().contains("sleeve"));
}

/// Three links in a ring, all frames parallel where it is drawn.
fn ring(kinds: [JointKind; 3], places: [[i64; 3]; 3], axes: [[i64; 3]; 6]) -> Option<Mechanism> {
    let numbers = |v: [i64; 3]| v.map(|x| Number::ratio(x, 2).unwrap());
    let mut builder = MechanismBuilder::new("ring");
    builder.link("l0").link("l1").link("l2");
    for (index, kind) in kinds.into_iter().enumerate() {
        let (name, next) = (format!("l{index}"), format!("l{}", (index + 1) % 3));
        let joint_name = format!("j{index}");
        let place = || Frame::at(numbers(places[index]));
        let joint = if index == 2 {
            JointBuilder::closing(&joint_name, kind, &name, &next)
        } else {
            JointBuilder::tree(&joint_name, kind, &name, &next)
        };
        let mut joint = joint
            .origin(place())
            .successor_origin(place())
            .axis(Direction(numbers(axes[index])));
        if kind.uses_second_axis() {
            joint = joint.axis2(Direction(numbers(axes[3 + index])));
        }
        if kind.uses_lead() {
            joint = joint.lead(Number::ratio(1, 4).unwrap());
        }
        if kind == JointKind::Distance {
            joint = joint.distance(Number::ratio(1, 2).unwrap());
        }
        builder.joint(joint);
    }
    builder.build().ok()
}

fn kind() -> impl Strategy<Value = JointKind> {
    (0..JointKind::ALL.len()).prop_map(|index| JointKind::ALL[index])
}

fn vector() -> impl Strategy<Value = [i64; 3]> {
    prop::array::uniform3(-3i64..4).prop_filter("a direction", |v| v.iter().any(|x| *x != 0))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    /// Joints of every kind between three links, wherever the ring can be closed.
    #[test]
    fn rings_of_any_joints(
        kinds in [kind(), kind(), kind()],
        places in prop::array::uniform3(prop::array::uniform3(-4i64..5)),
        axes in prop::array::uniform6(vector()),
        seed in any::<u64>(),
    ) {
        let mechanism = ring(kinds, places, axes);
        prop_assume!(mechanism.is_some());
        let mechanism = mechanism.unwrap();
        let poses = assembled(&mechanism, 0.4, seed);
        prop_assume!(poses.is_some());
        let poses = poses.unwrap();
        for formulation in FORMULATIONS {
            let system = polynomial_system(&mechanism, &options(formulation));
            let system = system.map_err(|e| TestCaseError::fail(e.to_string()))?;
            let found = faults(&format!("{kinds:?} {formulation:?}"), &system, &poses);
            prop_assert!(found.is_none(), "{found:?}");
        }
    }
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn equations_vanish_where_mechanisms_stand() {
        let all = support::sample(own_mechanisms().into_iter().chain(zoo()), 3);
        let wrong = in_parallel(&all, |(name, mechanism)| {
            let poses: Vec<Vec<Rigid<f64>>> = [(0.0, 0), (0.05, 1), (0.3, 2)]
                .into_iter()
                .filter_map(|(off, seed)| assembled(mechanism, off, seed))
                .collect();
            let mut wrong = Vec::new();
            if poses.is_empty() {
                wrong.push(format!("{name} does not assemble"));
            }
            for formulation in FORMULATIONS {
                let system = system(mechanism, formulation);
                let name = format!("{name} {formulation:?}");
                // With rounded numbers some equations consist of rounding errors alone: entries that would vanish identically.
                // They hold where the mechanism is drawn.
                let literal = formulation == Formulation::Positional || !system.rounded_numbers;
                let trusted = if literal { poses.len() } else { 1 };
                for poses in poses.iter().take(trusted) {
                    wrong.extend(faults(&name, &system, poses));
                }
            }
            wrong
        });
        assert_none(&wrong.concat());
    }

    /// Drawn poses are exact solutions, except those of files that round them to sixty digits.
    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn drawn_poses_are_exact_solutions() {
        const ROUNDED: [&str; 9] = [
            "bennett_chain_2",
            "bricard_octahedron_III_flat__moved",
            "griffis_duffy_I_locked",
            "hoberman_ring_8",
            "k2_3_equal_bars_bif__moved",
            "miura_3x3_flat__moved",
            "parallelogram_chain_flat__moved",
            "tensegrity_prism_shaky",
            "upu3_snu_home_equal__moved",
        ];
        // Drawn open, since their configurations are no numbers that a file can state.
        const OPEN: [&str; 5] = [
            "quad_16_17_18_19",
            "tetra_20_10_4",
            "tetra_6_7_8",
            "tetra_ii",
            "tetra_iii",
        ];
        let mut all = support::sample(own_mechanisms().into_iter().chain(zoo()), 3);
        all.retain(|(name, _)| !OPEN.contains(&name.as_str()));
        let wrong = in_parallel(&all, |(name, mechanism)| {
            let rounded = ROUNDED.contains(&name.as_str());
            let mut wrong = Vec::new();
            for formulation in FORMULATIONS {
                let system = system(mechanism, formulation);
                match &system.home {
                    HomePose::Exact(values) if !rounded => {
                        assert_eq!(values.len(), system.variables.len());
                        let Some(modulo) = system.home_modulo(0, MEMORY) else {
                            wrong.push(format!("{name} {formulation:?}: nothing modulo a prime"));
                            continue;
                        };
                        let constant = |(e, _): &(Vec<u32>, u64)| e.iter().all(|e| *e == 0);
                        assert!(!modulo.equations.iter().flatten().any(constant), "{name}");
                    }
                    HomePose::Open { left, .. } if rounded && left.abs() < 1e-25 => {}
                    other => wrong.push(format!("{name} {formulation:?}: {other:?}")),
                }
            }
            wrong
        });
        assert_none(&wrong.concat());
    }

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn names_are_unique_and_cycles_have_their_equations() {
        let all = support::sample(own_mechanisms().into_iter().chain(zoo()), 3);
        for (name, mechanism) in all {
            let system = system(&mechanism, Formulation::Tree);
            let names: BTreeSet<String> = system.names().into_iter().collect();
            assert_eq!(names.len(), system.variables.len(), "{name}");
            for cycle in &system.cycles {
                for &equation in &cycle.equations {
                    let polynomial = &system.equations[equation].polynomial;
                    let mentioned = (0..names.len()).filter(|&v| polynomial.mentions(v));
                    for variable in mentioned {
                        assert!(cycle.variables.contains(&variable), "{name}");
                    }
                }
            }
            for (joint, variables) in system.joint_variables.iter().enumerate() {
                for &variable in variables {
                    let meant = system.variables[variable].meaning.joint().unwrap();
                    assert_eq!(meant.0, joint);
                }
            }
        }
    }
}
