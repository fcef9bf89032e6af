//! Predicted motion: the reference mechanisms followed along their branches, and motions that formulas give.
use crate::support;

use kutzbach::closure::{Arithmetic, Geometry, Rigid};
use kutzbach::format::read;
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{Analysis, AnalysisOptions, Verdict, analyse};
use kutzbach::motion::{
    EndReason, EventKind, Motion, Spacing, Trace, TraceError, TraceOptions, trace,
};
use std::f64::consts::{PI, TAU};
use support::rewrite::Draft;
use support::{analysis, assert_none, in_parallel, zoo, zoo_mechanism};

fn options() -> TraceOptions {
    TraceOptions::default()
}

fn driven(joint: &str, range: Option<(f64, f64)>) -> TraceOptions {
    TraceOptions {
        drive: Some(joint.to_owned()),
        range,
        ..options()
    }
}

fn on(branch: &str) -> TraceOptions {
    TraceOptions {
        branch: Some(branch.to_owned()),
        ..options()
    }
}

fn moving(mechanism: &Mechanism, options: &TraceOptions) -> Motion {
    let analysis = analysis(mechanism);
    trace(mechanism, &analysis, options)
        .unwrap()
        .into_motion()
        .unwrap()
}

/// A file in one line: a planar linkage about z.
fn parsed(text: &str) -> Mechanism {
    read(text, "test.urdf", &[]).unwrap().mechanism
}

/// A planar four-bar: ground from (0, 0) to (ground, 0), drawn with its crank at an angle.
fn four_bar(
    crank: f64,
    coupler: f64,
    rocker: f64,
    ground: f64,
    angle: f64,
    limits: &str,
) -> Mechanism {
    let a = [crank * angle.cos(), crank * angle.sin()];
    let d = [ground - a[0], -a[1]];
    let far = d[0].hypot(d[1]);
    let along = (coupler * coupler - rocker * rocker + far * far) / (2.0 * far);
    let up = (coupler * coupler - along * along).sqrt();
    let b = [
        (along * d[0] - up * d[1]) / far,
        (along * d[1] + up * d[0]) / far,
    ];
    parsed(&format!(
        r#"<robot name="four_bar"><link name="ground"/><link name="crank"/><link name="coupler"/><link name="rocker"/>
        <joint name="O" type="revolute"><parent link="ground"/><child link="crank"/><axis xyz="0 0 1"/>{limits}</joint>
        <joint name="A" type="revolute"><parent link="crank"/><child link="coupler"/><origin xyz="{} {} 0"/><axis xyz="0 0 1"/></joint>
        <joint name="C" type="revolute"><parent link="ground"/><child link="rocker"/><origin xyz="{ground} 0 0"/><axis xyz="0 0 1"/></joint>
        <loop name="B" type="revolute"><predecessor link="coupler"><origin xyz="{} {} 0"/></predecessor>
        <successor link="rocker"><origin xyz="{} {} 0"/></successor><axis xyz="0 0 1"/></loop></robot>"#,
        a[0],
        a[1],
        b[0],
        b[1],
        a[0] + b[0] - ground,
        a[1] + b[1]
    ))
}

fn range<'m>(motion: &'m Motion, name: &str) -> &'m kutzbach::motion::Range {
    motion
        .ranges
        .iter()
        .find(|r| r.variable.name == name)
        .unwrap()
}

/// The values of one variable in all samples.
fn column(mechanism: &Mechanism, motion: &Motion, name: &str) -> Vec<f64> {
    let index = kutzbach::motion::Variable::all(mechanism)
        .iter()
        .position(|v| v.name == name)
        .unwrap();
    motion.samples.iter().map(|s| s.values[index]).collect()
}

/// What is wrong with a trace of a mechanism that moves.
fn faults(name: &str, mechanism: &Mechanism, analysis: &Analysis, branch: &str) -> Vec<String> {
    let mut wrong = Vec::new();
    let motion = match trace(mechanism, analysis, &on(branch)) {
        Ok(Trace::Moving(motion)) => *motion,
        Ok(Trace::Still(still)) => return vec![format!("{name} {branch}: {}", still.reason)],
        Err(error) => return vec![format!("{name} {branch}: {error}")],
    };
    let branches = analysis.branches.as_ref().unwrap();
    let known = branches.iter().find(|b| b.name == branch).unwrap();
    // Where a branch is shaky all along, and singular besides, a pose of hardly any margin may not be closed.
    let shaky = known.instantaneous != Some(known.dimension);
    let least = if shaky { 90 } else { 100 };
    if motion.samples.len() < least {
        wrong.push(format!("{name} {branch}: {} samples", motion.samples.len()));
    }
    if !(motion.largest_closure <= 1e-12) {
        wrong.push(format!(
            "{name} {branch}: closure {:e}",
            motion.largest_closure
        ));
    }
    if motion.held.len() + 1 > motion.dimension {
        wrong.push(format!("{name} {branch}: {} held", motion.held.len()));
    }
    for (joint, role) in mechanism.joints().iter().zip(&known.roles) {
        let own =
            |r: &&kutzbach::motion::Range| mechanism.joints()[r.variable.joint].name == joint.name;
        let moves = motion.ranges.iter().filter(own).any(|r| r.moves);
        if role.locked == Some(true) && moves {
            wrong.push(format!(
                "{name} {branch}: {} is locked and moves",
                joint.name
            ));
        }
        if role.locked == Some(false) && known.dimension == 1 && !moves {
            wrong.push(format!("{name} {branch}: {} does not move", joint.name));
        }
    }
    for held in &motion.held {
        let values = column(mechanism, &motion, &held.variable.name);
        if values.iter().any(|v| (v - held.value).abs() > 1e-9) {
            wrong.push(format!(
                "{name} {branch}: held {} moves",
                held.variable.name
            ));
        }
    }
    // Samples are on the curve: asked for again by arclength, the same poses come back; each is between its neighbours.
    let mut curve = motion.curve.clone();
    for sample in motion.samples.iter().step_by(9) {
        let again = curve.pose_at_arclength(sample.arclength).unwrap();
        let values: Vec<f64> = curve
            .states(&again.pose)
            .iter()
            .flat_map(|s| s.values.clone())
            .collect();
        let off = values
            .iter()
            .zip(&sample.values)
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f64::max);
        if !(off < 1e-7) {
            wrong.push(format!("{name} {branch}: sample off the curve by {off:e}"));
            break;
        }
    }
    for pair in motion.samples.windows(2) {
        let gap = pair[1].arclength - pair[0].arclength;
        if !(gap > 0.0) {
            wrong.push(format!("{name} {branch}: samples go back by {gap:e}"));
            break;
        }
    }
    if motion
        .ends
        .iter()
        .any(|e| e.reason == EndReason::CannotGoOn)
    {
        wrong.push(format!("{name} {branch}: stuck, {:?}", motion.ends));
    }
    wrong
}

#[test]
fn four_bars_have_the_ranges_of_the_law_of_cosines() {
    // Grashof: the shortest goes round where shortest + longest < the others (Hunt 1978, section 3.4).
    for (crank, coupler, rocker, ground) in [
        (1.0, 3.0, 2.5, 3.2),
        (0.7, 2.0, 2.2, 1.9),
        (2.0, 2.5, 2.2, 1.0),
        (2.0, 3.0, 1.2, 3.5),
        (3.0, 2.0, 2.2, 2.6),
    ] {
        let mechanism = four_bar(crank, coupler, rocker, ground, 0.9, "");
        let motion = moving(&mechanism, &driven("O", None));
        let mut sides = [crank, coupler, rocker, ground];
        sides.sort_by(f64::total_cmp);
        let grashof = sides[0] + sides[3] < sides[1] + sides[2];
        let goes_round = grashof && (sides[0] == crank || sides[0] == ground);
        let own = range(&motion, "O");
        assert_eq!(
            own.turns != 0,
            goes_round,
            "{crank} {coupler} {rocker} {ground}"
        );
        if !goes_round {
            // Coupler and rocker in line: stretched, or one folded on the other.
            let angle = |reach: f64| {
                let c = (crank * crank + ground * ground - reach * reach) / (2.0 * crank * ground);
                (c.abs() <= 1.0).then(|| c.acos())
            };
            let bounds: Vec<f64> = [coupler + rocker, (coupler - rocker).abs()]
                .into_iter()
                .filter_map(angle)
                .collect();
            for extreme in [own.min + 0.9, own.max + 0.9] {
                let near = bounds
                    .iter()
                    .flat_map(|b| [*b, -b, TAU - b])
                    .map(|b| (b - extreme).abs())
                    .fold(f64::INFINITY, f64::min);
                assert!(near < 1e-10, "{extreme} is off by {near:e}");
            }
        }
        // The rocker's extremes: crank and coupler in line.
        let extreme = |reach: f64| {
            let c = (rocker * rocker + ground * ground - reach * reach) / (2.0 * rocker * ground);
            PI - c.clamp(-1.0, 1.0).acos()
        };
        if goes_round && sides[0] == crank {
            let own = range(&motion, "C");
            let swing = (extreme(coupler + crank) - extreme(coupler - crank)).abs();
            assert!((own.max - own.min - swing).abs() < 1e-10);
            assert_eq!(own.dead_centres, 2);
        }
        assert!(motion.closed.is_some());
    }
}

#[test]
fn a_driven_value_singles_out_the_pose_reached_from_home() {
    let (a, b, c, d) = (1.0, 3.0, 2.5, 3.2);
    let mechanism = four_bar(a, b, c, d, 0.9, "");
    let wanted = TraceOptions {
        samples: 629,
        ..driven("O", Some((0.0, TAU)))
    };
    let motion = moving(&mechanism, &wanted);
    assert_eq!((motion.samples.len(), motion.unreached.len()), (629, 0));
    assert_eq!(motion.spacing, Spacing::Drive);
    for (index, sample) in motion.samples.iter().enumerate() {
        let value = TAU * index as f64 / 628.0;
        assert!((sample.drive - value).abs() < 1e-12);
        // Freudenstein's equation between crank and rocker angle (1955).
        let crank = value + 0.9;
        let tip = sample.links[mechanism.link_named("crank").unwrap().0].apply(&[
            a * 0.9f64.cos(),
            a * 0.9f64.sin(),
            0.0,
        ]);
        assert!((tip[0] - a * crank.cos()).abs() + (tip[1] - a * crank.sin()).abs() < 1e-12);
        assert!(sample.closure < 1e-13);
    }
    // Half a turn either way is the same pose, counted differently.
    let mut curve = motion.curve.clone();
    let ahead = curve.pose_at_drive(PI).unwrap();
    let behind = curve.pose_at_drive(-PI).unwrap();
    for (x, y) in curve
        .link_poses(&ahead.pose)
        .iter()
        .zip(&curve.link_poses(&behind.pose))
    {
        for i in 0..3 {
            assert!((x.translation[i] - y.translation[i]).abs() < 1e-11);
        }
    }
}

#[test]
fn what_is_not_reached_is_told_with_the_reason() {
    // A double rocker: crank the longest but one, no full turn.
    let mechanism = four_bar(3.0, 2.0, 2.2, 2.6, 0.9, "");
    let motion = moving(&mechanism, &driven("O", Some((0.0, TAU))));
    assert_eq!(motion.unreached.len(), 1);
    let missed = &motion.unreached[0];
    assert!(missed.reason.contains("dead centre"), "{}", missed.reason);
    let c: f64 = (9.0 + 2.6 * 2.6 - 4.2 * 4.2) / (2.0 * 3.0 * 2.6);
    assert!((missed.reached + 0.9 - c.acos()).abs() < 1e-10);
    assert!(!motion.samples.is_empty() && motion.samples.len() < 100);
    let limit = r#"<limit lower="-0.5" upper="0.75" effort="1" velocity="1"/>"#;
    let mechanism = four_bar(1.0, 3.0, 2.5, 3.2, 0.9, limit);
    let motion = moving(&mechanism, &driven("O", Some((0.0, 1.0))));
    assert!(
        motion.unreached[0].reason.contains("limit"),
        "{}",
        motion.unreached[0].reason
    );
    assert_eq!(motion.unreached[0].reached, 0.75);
    assert_eq!(motion.closed, None);
    let own = range(&motion, "O");
    assert_eq!((own.min, own.max), (-0.5, 0.75));
    for end in &motion.ends {
        assert!(matches!(end.reason, EndReason::JointLimit { .. }));
    }
}

#[test]
fn limits_of_another_joint_are_met_at_the_driven_value_of_the_formula() {
    // The slider stops at a value; the crank angle there follows from the law of cosines.
    let mechanism = parsed(
        r#"<robot name="slider_crank"><link name="ground"/><link name="crank"/><link name="rod"/><link name="slider"/>
        <joint name="crank_pin" type="revolute"><parent link="ground"/><child link="crank"/><axis xyz="0 0 1"/></joint>
        <joint name="rod_pin" type="revolute"><parent link="crank"/><child link="rod"/><origin xyz="0 0.6 0"/><axis xyz="0 0 1"/></joint>
        <joint name="guide" type="prismatic"><parent link="ground"/><child link="slider"/><origin xyz="0.8 0 0"/><axis xyz="1 0 0"/>
        <limit lower="-0.3" upper="0.5" effort="1" velocity="1"/></joint>
        <loop name="wrist" type="revolute"><predecessor link="rod"><origin xyz="0.8 -0.6 0"/></predecessor>
        <successor link="slider"/><axis xyz="0 0 1"/></loop></robot>"#,
    );
    let motion = moving(&mechanism, &driven("crank_pin", None));
    assert_eq!(motion.ends.len(), 2);
    for end in &motion.ends {
        let EndReason::JointLimit { variable, value } = &end.reason else {
            panic!("{end:?}")
        };
        assert_eq!(variable.name, "guide");
        let far: f64 = 0.8 + value;
        let angle = ((0.36 + far * far - 1.0) / (1.2 * far)).acos();
        assert!((end.drive + PI / 2.0 - angle).abs() < 1e-12, "{end:?}");
    }
}

/// A directed line: a point and a unit vector.
type Line = ([f64; 3], [f64; 3]);

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// The directed axes of hinges `J1` to `J4` in a pose of the links.
fn axes(mechanism: &Mechanism, links: &[Rigid<f64>], signs: [f64; 4]) -> [Line; 4] {
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    [0, 1, 2, 3].map(|i| {
        let joint = mechanism.joint_named(&format!("J{}", i + 1)).unwrap().0;
        let known = &mechanism.joints()[joint];
        let frame = links[known.predecessor.link.0].compose(&geometry.sides[joint][0]);
        let axis = [0, 1, 2].map(|c| known.axis.0[c].value());
        let size = signs[i] / dot(&axis, &axis).sqrt();
        (frame.translation, frame.rotate(&axis.map(|x| x * size)))
    })
}

/// Direction and length of the common normal from one line to the next, and the twist about it.
fn normal(from: &Line, to: &Line) -> ([f64; 3], f64, f64) {
    let across = cross(&from.1, &to.1);
    let size = dot(&across, &across).sqrt();
    let gap = [0, 1, 2].map(|i| to.0[i] - from.0[i]);
    let way = dot(&gap, &across) / size;
    let unit = across.map(|x| x * way.signum() / size);
    (
        unit,
        way.abs(),
        (way.signum() * size).atan2(dot(&from.1, &to.1)),
    )
}

#[test]
fn bennett_keeps_the_product_of_its_half_tangents() {
    // tan(θ₁/2) tan(θ₂/2) = sin((β+α)/2) / sin((β−α)/2), with twists α from axis 1 to 2 and β from 2 to 3, and angles θ
    // from one common normal to the next (Bennett 1914; Baker 1979, eq. 10). Nothing is fitted: twists come from the pose
    // at home, angles from every sample.
    for name in ["bennett_generic", "bennett_ratio2"] {
        let mechanism = zoo_mechanism(name);
        let motion = moving(&mechanism, &options());
        assert!(motion.closed.is_some());
        assert_eq!(
            motion.ranges.iter().filter(|r| r.turns.abs() == 1).count(),
            4
        );
        // Axes are directed so that opposite twists are equal and lengths go as sines.
        let links = &motion.samples[0].links;
        let close = |a: f64, b: f64| (a - b).abs() < 1e-9;
        let directed = (0..8u8)
            .map(|bits| {
                let sign = |bit: u8| if bits >> bit & 1 == 1 { -1.0 } else { 1.0 };
                [1.0, sign(0), sign(1), sign(2)]
            })
            .find(|signs| {
                let a = axes(&mechanism, links, *signs);
                let n = [0, 1, 2, 3].map(|i| normal(&a[i], &a[(i + 1) % 4]));
                close(n[0].2, n[2].2)
                    && close(n[1].2, n[3].2)
                    && close(n[0].1 * n[1].2.sin(), n[1].1 * n[0].2.sin())
            })
            .unwrap();
        let mut worst = 0.0f64;
        let mut constants = Vec::new();
        for sample in &motion.samples {
            let a = axes(&mechanism, &sample.links, directed);
            let n = [0, 1, 2, 3].map(|i| normal(&a[i], &a[(i + 1) % 4]));
            let angle = |before: &[f64; 3], after: &[f64; 3], about: &[f64; 3]| {
                dot(&cross(before, after), about).atan2(dot(before, after))
            };
            let first = 0.5 * angle(&n[3].0, &n[0].0, &a[0].1);
            let second = 0.5 * angle(&n[0].0, &n[1].0, &a[1].1);
            let (alpha, beta) = (n[0].2, n[1].2);
            constants.push((alpha, beta));
            // Free of poles.
            let off = first.sin() * second.sin() * (0.5 * (beta - alpha)).sin()
                - first.cos() * second.cos() * (0.5 * (beta + alpha)).sin();
            worst = worst.max(off.abs());
        }
        assert!(worst < 1e-12, "{name}: {worst:e}");
        assert!(
            constants
                .iter()
                .all(|c| close(c.0, constants[0].0) && close(c.1, constants[0].1))
        );
    }
}

#[test]
fn a_slider_crank_turns_back_where_it_is_stretched() {
    let mechanism = parsed(
        r#"<robot name="slider_crank"><link name="ground"/><link name="crank"/><link name="rod"/><link name="slider"/>
        <joint name="crank_pin" type="revolute"><parent link="ground"/><child link="crank"/><axis xyz="0 0 1"/></joint>
        <joint name="rod_pin" type="revolute"><parent link="crank"/><child link="rod"/><origin xyz="0 0.6 0"/><axis xyz="0 0 1"/></joint>
        <joint name="guide" type="prismatic"><parent link="ground"/><child link="slider"/><origin xyz="0.8 0 0"/><axis xyz="1 0 0"/></joint>
        <loop name="wrist" type="revolute"><predecessor link="rod"><origin xyz="0.8 -0.6 0"/></predecessor>
        <successor link="slider"/><axis xyz="0 0 1"/></loop></robot>"#,
    );
    let motion = moving(&mechanism, &driven("crank_pin", None));
    let guide = range(&motion, "guide");
    assert!(
        (guide.max - 0.8).abs() < 1e-10 && (guide.min + 0.4).abs() < 1e-10,
        "{guide:?}"
    );
    let dead: Vec<f64> = motion
        .events
        .iter()
        .filter(|e| matches!(&e.kind, EventKind::DeadCentre { variable, .. } if variable.name == "guide"))
        .map(|e| (e.drive + PI / 2.0).rem_euclid(TAU))
        .collect();
    assert_eq!(dead.len(), 2);
    for angle in dead {
        // Crank along the guide, stretched or folded: a root of the slider's rate, as sharp as rounding.
        assert!((angle.sin()).abs() < 1e-12, "{angle}");
    }
    // Driven by the slider, the motion ends nowhere, but the value of the slider does.
    let motion = moving(&mechanism, &driven("guide", Some((0.0, 1.0))));
    assert!((motion.unreached[0].reached - 0.8).abs() < 1e-10);
}

#[test]
fn order_of_the_file_changes_nothing() {
    for name in [
        "planar_slider_crank",
        "bennett_generic",
        "planar_3RRR",
        "rssr",
    ] {
        let mechanism = zoo_mechanism(name);
        let mut draft = Draft::of(&mechanism);
        draft.joints.reverse();
        let shuffled = draft.build();
        let (one, two) = (
            moving(&mechanism, &options()),
            moving(&shuffled, &options()),
        );
        assert_eq!(one.driven.name, two.driven.name, "{name}");
        let held = |m: &Motion| -> Vec<String> {
            m.held.iter().map(|h| h.variable.name.clone()).collect()
        };
        assert_eq!(held(&one), held(&two), "{name}");
        assert_eq!(one.events.len(), two.events.len(), "{name}");
        for joint in mechanism.joints() {
            for freedom in 0..joint.freedom() {
                let variable = joint.freedom_name(freedom);
                let (a, b) = (range(&one, &variable), range(&two, &variable));
                assert!(
                    (a.min - b.min).abs() < 1e-9 && (a.max - b.max).abs() < 1e-9,
                    "{name} {variable}: {a:?} {b:?}"
                );
            }
        }
    }
}

#[test]
fn several_freedoms_need_inputs() {
    let mechanism = zoo_mechanism("planar_5r");
    let motion = moving(
        &mechanism,
        &TraceOptions {
            hold: vec!["J1".to_owned()],
            ..driven("J5", None)
        },
    );
    assert_eq!(motion.held.len(), 1);
    assert_eq!(motion.held[0].variable.name, "J1");
    let known = analysis(&mechanism);
    let fails = |options: &TraceOptions| trace(&mechanism, &known, options).unwrap_err();
    assert!(matches!(
        fails(&driven("J9", None)),
        TraceError::UnknownVariable {
            nearest: Some(_),
            ..
        }
    ));
    assert!(matches!(fails(&on("Q")), TraceError::UnknownBranch { .. }));
    let held = TraceOptions {
        hold: vec!["J1".to_owned(), "J2".to_owned()],
        ..driven("J5", None)
    };
    assert!(matches!(fails(&held), TraceError::HoldsTooMuch { .. }));
    let few = TraceOptions {
        samples: 1,
        ..options()
    };
    assert!(matches!(fails(&few), TraceError::Samples { .. }));
    assert!(matches!(
        fails(&driven("J1", Some((0.0, f64::NAN)))),
        TraceError::Range { .. }
    ));
}

#[test]
fn balls_and_free_joints_are_driven_too() {
    let mechanism = parsed(
        r#"<robot name="arm"><link name="ground"/><link name="arm"/><link name="hand"/>
        <joint name="shoulder" type="spherical"><parent link="ground"/><child link="arm"/></joint>
        <joint name="slide" type="prismatic"><parent link="arm"/><child link="hand"/><axis xyz="0 0 1"/>
        <limit lower="-0.5" upper="0.5" effort="1" velocity="1"/></joint></robot>"#,
    );
    let motion = moving(&mechanism, &driven("shoulder.rot2", None));
    assert!((motion.closed.unwrap() - TAU).abs() < 1e-9);
    assert_eq!(motion.held.len(), 2);
    let motion = moving(&mechanism, &driven("slide", None));
    assert_eq!(
        (range(&motion, "slide").min, range(&motion, "slide").max),
        (-0.5, 0.5)
    );
}

#[test]
fn nothing_moves_where_nothing_can() {
    for name in ["triangle_3r_rigid", "collinear_3r_shaky"] {
        let mechanism = zoo_mechanism(name);
        let known = analyse(&mechanism, &AnalysisOptions::default()).unwrap();
        let trace = trace(&mechanism, &known, &options()).unwrap();
        let Trace::Still(still) = trace else { panic!() };
        assert!(still.reason.contains("rigid"));
    }
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn every_branch_of_the_reference_mechanisms_is_followed() {
        let zoo = support::sample(zoo(), 3);
        let wrong = in_parallel(&zoo, |(name, mechanism)| {
            let analysis = analysis(mechanism);
            if analysis.mobility.verdict != Verdict::Mobile {
                let trace = trace(mechanism, &analysis, &options()).unwrap();
                return match trace {
                    Trace::Still(_) => Vec::new(),
                    Trace::Moving(_) => vec![format!("{name}: moves")],
                };
            }
            analysis
                .branches
                .iter()
                .flatten()
                .flat_map(|b| faults(name, mechanism, &analysis, &b.name))
                .collect()
        });
        assert_none(&wrong.concat());
    }
}

#[test]
fn what_turns_outside_all_loops_is_not_driven_where_a_loop_moves() {
    // Half a double wishbone, whose arms swing, with a wheel on its upright.
    let hinge = |name: &str, on: [&str; 2], at: &str, axis: &str| {
        format!(
            r#"<joint name="{name}" type="continuous"><parent link="{}"/><child link="{}"/><origin xyz="{at}"/><axis xyz="{axis}"/></joint>"#,
            on[0], on[1]
        )
    };
    let links: String = ["chassis", "low", "high", "upright", "wheel"]
        .map(|name| format!(r#"<link name="{name}"/>"#))
        .concat();
    let text = format!(
        r#"<robot name="wishbone">{links}{}{}{}{}<loop name="top" type="revolute"><predecessor link="high"><origin xyz="3 0 1"/></predecessor>
        <successor link="upright"><origin xyz="-1 0 4"/></successor><axis xyz="0 1 0"/></loop></robot>"#,
        hinge("bush", ["chassis", "low"], "0 0 0", "0 1 0"),
        hinge("top_bush", ["chassis", "high"], "1 0 3", "0 1 0"),
        hinge("ball", ["low", "upright"], "5 0 0", "0 1 0"),
        hinge("axle", ["upright", "wheel"], "1 0 2", "1 0 0"),
    );
    let mechanism = kutzbach::format::read(&text, "wishbone.urdf", &[])
        .unwrap()
        .mechanism;
    let analysis = crate::support::analysis(&mechanism);
    let traced = kutzbach::motion::trace(&mechanism, &analysis, &Default::default()).unwrap();
    let motion = traced.motion().unwrap();
    assert_ne!(motion.driven.name, "axle");
}
