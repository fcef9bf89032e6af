//! Poses given on the command line, and closings within joint limits.

use kutzbach::format::read;
use kutzbach::report::{Options, Report, Verdict, report};

/// A parallelogram with a crank of 1 m and a base of 2 m, drawn upright, whose crank is limited.
fn parallelogram(lower: &str, upper: &str) -> String {
    format!(
        r#"<robot name="bar"><link name="ground"/><link name="crank"/><link name="coupler"/><link name="rocker"/>
        <joint name="A" type="revolute"><parent link="ground"/><child link="crank"/><axis xyz="0 0 1"/>
          <limit lower="{lower}" upper="{upper}"/></joint>
        <joint name="B" type="continuous"><parent link="crank"/><child link="coupler"/><origin xyz="0 1 0"/><axis xyz="0 0 1"/></joint>
        <joint name="D" type="continuous"><parent link="ground"/><child link="rocker"/><origin xyz="2 0 0"/><axis xyz="0 0 1"/></joint>
        <loop name="C" type="revolute"><predecessor link="coupler"><origin xyz="2 0 0"/></predecessor>
          <successor link="rocker"><origin xyz="0 1 0"/></successor><axis xyz="0 0 1"/></loop></robot>"#
    )
}

/// The exit code and what was printed, and what was complained of, of `kutzbach report` of a file with this text.
fn reported(name: &str, text: &str, arguments: &[&str]) -> (Option<i32>, String, String) {
    let file = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("poses_{name}.urdf"));
    std::fs::write(&file, text).unwrap();
    let output = crate::support::program()
        .arg("report")
        .arg(&file)
        .args(arguments)
        .output()
        .unwrap();
    let words = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
    (
        output.status.code(),
        words(&output.stdout),
        words(&output.stderr),
    )
}

fn json(name: &str, text: &str, pose: &[&str]) -> serde_json::Value {
    let mut arguments = vec!["--format", "json"];
    arguments.extend(pose.iter().flat_map(|pose| ["--pose", pose]));
    let (code, printed, complaint) = reported(name, text, &arguments);
    assert_eq!(code, Some(0), "{complaint}");
    serde_json::from_str(&printed).unwrap()
}

/// The angle of a joint after assembly, in degrees.
fn angle(report: &serde_json::Value, joint: &str) -> f64 {
    let joints = report["assembly"]["joints"].as_array().unwrap();
    let place = joints.iter().find(|place| place["name"] == joint).unwrap();
    place["values"][0].as_f64().unwrap().to_degrees()
}

#[test]
fn a_pose_on_the_command_line_holds_what_it_names() {
    let text = parallelogram("-3", "3");
    for (pose, degrees) in [("A=30deg", 30.0), ("A=pi/6", 30.0), ("A=0.5", 28.6479)] {
        let report = json("held", &text, &[pose]);
        assert_eq!(report["home"]["configuration"], *pose);
        assert_eq!(report["mobility"]["finite"], 1);
        assert!((angle(&report, "A") - degrees).abs() < 1e-3, "{pose}");
        assert!((angle(&report, "D") - degrees).abs() < 1e-3, "{pose}");
        assert_eq!(report["assembly"]["held"], serde_json::json!(["A"]));
    }
}

#[test]
fn a_pose_outside_limits_comes_with_an_offer_that_serves() {
    let text = parallelogram("0.5", "1.5");
    let (_, home, _) = reported("offered", &text, &[]);
    let home = home.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        home.contains("`A` is at 0°, 28.6° below its limit of 28.6°"),
        "{home}"
    );
    assert!(
        home.contains("`--pose limits` analyses the middle"),
        "{home}"
    );
    let middle = json("middle", &text, &["limits"]);
    assert!((28.64..85.95).contains(&angle(&middle, "A")));
    assert_eq!(middle["assembly"]["outside_limits"], serde_json::json!([]));
    // What else is given is held, in the limits or not.
    let both = json("both", &text, &["limits", "D=70deg"]);
    assert!((angle(&both, "A") - 70.0).abs() < 1e-3);
    assert_eq!(both["assembly"]["held"], serde_json::json!(["D"]));
}

#[test]
fn poses_that_cannot_be_meant_are_refused_with_a_hint() {
    let text = parallelogram("-3", "3");
    for (pose, problem, hint) in [
        (
            "A=5mm",
            "`5mm` is no value for joint `A`: this degree of freedom turns",
            "`deg` or `rad`",
        ),
        (
            "A=north",
            "`north` is no value for joint `A`",
            "an expression such as `pi/4`",
        ),
        ("A", "states no value", "joint=value"),
        ("Z=1", "no joint named `Z`", "lists the joints"),
        (
            "A=1 2",
            "joint `A` has 1 degree of freedom, given: 2 values",
            "one value for each",
        ),
    ] {
        let (code, _, complaint) = reported("refused", &text, &["--pose", pose]);
        assert_eq!(code, Some(2), "{pose}");
        let complaint = complaint.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(
            complaint.contains(problem) && complaint.contains(hint),
            "{complaint}"
        );
    }
}

/// Legs on one crank that a motor drives: each a rod from the crank's end to a rocker, drawn open, whose limits allow one of
/// the two ways in which it can be put together.
fn walker(legs: usize) -> String {
    let mut text = r#"<robot name="walker"><link name="body"/><link name="crank"/>
        <joint name="shaft" type="continuous"><parent link="body"/><child link="crank"/><axis xyz="0 0 1"/></joint>
        <transmission name="t"><joint name="shaft"/></transmission>"#
        .to_owned();
    for leg in 0..legs {
        let around = format!("2*pi*{leg}/{legs}");
        // The rocker stands about 1 rad to one side of the line to the shaft.
        let (lower, upper) = match leg % 2 {
            0 => ("0.2", "2.5"),
            _ => ("-2.5", "-0.2"),
        };
        text += &format!(
            r#"<link name="rod{leg}"/><link name="rocker{leg}"/>
            <joint name="pin{leg}" type="continuous"><parent link="crank"/><child link="rod{leg}"/><origin xyz="0.3 0 0"/><axis xyz="0 0 1"/></joint>
            <joint name="hip{leg}" type="revolute"><parent link="body"/><child link="rocker{leg}"/>
              <origin xyz="${{2*cos({around})}} ${{2*sin({around})}} 0" rpy="0 0 ${{{around} + pi}}"/><axis xyz="0 0 1"/>
              <limit lower="{lower}" upper="{upper}"/></joint>
            <loop name="knee{leg}" type="revolute"><predecessor link="rod{leg}"><origin xyz="2 0 0"/></predecessor>
              <successor link="rocker{leg}"><origin xyz="1 0 0"/></successor><axis xyz="0 0 1"/></loop>"#
        );
    }
    text + "</robot>"
}

fn analysed(text: &str) -> Report {
    let reading = read(text, "file.urdf", &[]).unwrap_or_else(|error| panic!("{error}"));
    report(&reading, "file.urdf", &Options::default()).unwrap()
}

/// All legs at once hit the one of 2ⁿ ways that the limits allow hardly ever; each by itself does at once.
#[test]
fn legs_of_one_crank_are_closed_one_by_one_within_their_limits() {
    let report = analysed(&walker(10));
    assert_eq!(report.mobility.verdict, Verdict::Mobile);
    assert_eq!(report.mobility.finite, Some(1));
    assert!(
        report.assembly.outside_limits.is_empty(),
        "{:?}",
        report.assembly.outside_limits
    );
    assert!(report.assembly.residual.unwrap() < 1e-12);
}

/// Coarse numbers do not excuse a coarse closing where the joints can do better.
#[test]
fn a_closing_of_coarse_numbers_is_polished_to_rounding() {
    let text = walker(6)
        .replace("xyz=\"0.3 0 0\"", "xyz=\"0.301 0 0\"")
        .replace("xyz=\"1 0 0\"", "xyz=\"1.013 0 0\"");
    let report = analysed(&text);
    assert!(
        report.assembly.residual.unwrap() < 1e-12,
        "{:?}",
        report.assembly.residual
    );
}

/// A hinge and a screw between two links, made to close where the hinge is turned by 1.8 rad and the screw, of 0.2 m a turn,
/// by −0.8 rad; its distance as drawn is that of another turn.
#[test]
fn a_screw_that_closes_a_loop_is_found_whatever_its_turn() {
    let text = r#"<robot name="r"><link name="l0"/><link name="l1"/>
        <joint name="hinge" type="continuous"><parent link="l0"/><child link="l1"/><origin xyz="-0.6 0.1 -0.8" rpy="0.5 1.3 -1"/>
          <axis xyz="0.5 -0.3 -1.2"/></joint>
        <loop name="screw" type="screw"><predecessor link="l1"><origin xyz="0.3 0.6 -0.2" rpy="0.8 0.5 -0.2"/></predecessor>
          <successor link="l0"><origin xyz="X" rpy="R"/></successor><axis xyz="0 0 1"/><screw lead="0.2"/></loop></robot>"#;
    let (xyz, rpy) = closing_side();
    let report = analysed(&text.replace('X', &xyz).replace('R', &rpy));
    assert_eq!(report.mobility.verdict, Verdict::Rigid);
    assert!(report.assembly.residual.unwrap() < 1e-12);
    let place = |name: &str| {
        let joints = &report.assembly.joints;
        joints
            .iter()
            .find(|place| place.name == name)
            .unwrap()
            .values[0]
    };
    assert!((place("hinge") - 1.8).abs() < 1e-9 && (place("screw") + 0.8).abs() < 1e-9);
}

/// Where the screw's frame is in `l0` at that pose: origin and roll, pitch, yaw, with all digits.
fn closing_side() -> (String, String) {
    use nalgebra::{Isometry3, Translation3, Unit, UnitQuaternion, Vector3};
    let frame = |xyz: [f64; 3], rpy: [f64; 3]| {
        Isometry3::from_parts(
            Translation3::from(xyz),
            UnitQuaternion::from_euler_angles(rpy[0], rpy[1], rpy[2]),
        )
    };
    let turn = |axis: [f64; 3], angle: f64| {
        UnitQuaternion::from_axis_angle(&Unit::new_normalize(Vector3::from(axis)), angle)
    };
    let along = -0.8 * 0.2 / std::f64::consts::TAU;
    let side = frame([-0.6, 0.1, -0.8], [0.5, 1.3, -1.0])
        * turn([0.5, -0.3, -1.2], 1.8)
        * frame([0.3, 0.6, -0.2], [0.8, 0.5, -0.2])
        * Translation3::new(0.0, 0.0, along)
        * turn([0.0, 0.0, 1.0], -0.8);
    let (roll, pitch, yaw) = side.rotation.euler_angles();
    let place = side.translation.vector;
    (
        format!("{} {} {}", place.x, place.y, place.z),
        format!("{roll} {pitch} {yaw}"),
    )
}

/// What is written closes when it is read again, wherever the pose found is, and without moving.
#[test]
fn what_was_assembled_closes_again() {
    use kutzbach::closure::assemble;
    use kutzbach::matrix::SplitMix64;
    use kutzbach::report::assembled_file;
    let mut random = SplitMix64::new(7);
    let mut number = move || format!("{:?}", random.symmetric());
    for _ in 0..60 {
        let mut place = || {
            format!(
                r#"<origin xyz="{} {} {}" rpy="{} {} {}"/>"#,
                number(),
                number(),
                number(),
                number(),
                number(),
                number()
            )
        };
        let mut text = r#"<robot name="r"><link name="l0"/>"#.to_owned();
        for (joint, kind) in [
            "spherical",
            "revolute",
            "cylindrical",
            "revolute",
            "prismatic",
        ]
        .iter()
        .enumerate()
        {
            text += &format!(
                r#"<link name="l{0}"/><joint name="j{joint}" type="{kind}"><parent link="l{joint}"/><child link="l{0}"/>{1}</joint>"#,
                joint + 1,
                place()
            );
        }
        text += &format!(
            r#"<loop name="last" type="spherical"><predecessor link="l5">{}</predecessor><successor link="l0">{}</successor></loop></robot>"#,
            place(),
            place()
        );
        let reading = read(&text, "r.urdf", &[]).unwrap_or_else(|error| panic!("{error}"));
        let found = closed_from(&reading.mechanism, None);
        let Some(file) = assembled_file(&reading.mechanism, &found, &Default::default()) else {
            continue;
        };
        let again = read(&file, "again.urdf", &[]).unwrap().mechanism;
        let there = closed_from(&again, Some("assembled"));
        assert!(
            there.closed && there.steps == 0,
            "{} against {}",
            there.residual,
            there.tolerance
        );
        assert!(there.residual < 0.1 * there.tolerance);
    }

    fn closed_from(
        mechanism: &kutzbach::mechanism::Mechanism,
        at: Option<&str>,
    ) -> kutzbach::closure::Assembly {
        use kutzbach::closure::{Arithmetic, Geometry, Structure};
        let geometry = Geometry::new(
            mechanism,
            at.and_then(|name| mechanism.configuration(name)),
            &Arithmetic::double(),
        );
        assemble(
            mechanism,
            &geometry,
            &Structure::new(mechanism).parts,
            &Default::default(),
        )
        .unwrap()
    }
}

/// A planar four-bar that closes as drawn but for one axis, which is tilted by 1° or turned over.
#[test]
fn a_tilted_axis_is_told_without_a_gap_that_is_not_drawn() {
    for (tilt, told) in [
        ("${pi/180}", "nearest: 0 m and 1° at loop `C`"),
        ("${pi}", "nearest: 0 m and 180° at loop `C`"),
    ] {
        let tilted = format!(r#"<origin xyz="0 1 0" rpy="{tilt} 0 0"/></successor>"#);
        let text =
            parallelogram("-3", "3").replace(r#"<origin xyz="0 1 0"/></successor>"#, &tilted);
        assert_eq!(text.matches("rpy").count(), 1);
        let (_, printed, _) = reported("tilted", &text, &[]);
        let printed = printed.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(
            printed.contains("no pose closes it") && printed.contains(told),
            "{printed}"
        );
    }
}

/// A crank `A` of 1 and a rocker `B` of √10 on the ground, 4 apart, with a coupler of √13: the crank goes round, the rocker swings.
const CRANK_ROCKER: &str = r#"<robot name="cr"><link name="g"/><link name="r"/><link name="c"/><link name="k"/>
    <joint name="B" type="continuous"><parent link="g"/><child link="r"/><origin xyz="4 0 0"/><axis xyz="0 0 1"/></joint>
    <joint name="A" type="continuous"><parent link="g"/><child link="c"/><axis xyz="0 0 1"/></joint>
    <joint name="pin" type="continuous"><parent link="c"/><child link="k"/><origin xyz="0 1 0"/><axis xyz="0 0 1"/></joint>
    <loop name="close" type="revolute"><predecessor link="k"><origin xyz="3 2 0"/></predecessor>
    <successor link="r"><origin xyz="-1 3 0"/></successor><axis xyz="0 0 1"/></loop></robot>"#;

/// By the law of cosines: the rocker's angle on the circuit drawn, from the crank's (degrees).
fn rocker(crank: f64) -> f64 {
    let (sine, cosine) = crank.to_radians().sin_cos();
    let pin = (-sine, cosine);
    let (x, y) = (4.0 - pin.0, -pin.1);
    let diagonal = x.hypot(y);
    let along = (13.0 - 10.0 + diagonal * diagonal) / (2.0 * diagonal);
    let across = (13.0 - along * along).sqrt();
    let (u, v) = (x / diagonal, y / diagonal);
    let close = (
        pin.0 + along * u - across * v,
        pin.1 + along * v + across * u,
    );
    (close.1.atan2(close.0 - 4.0) - 3f64.atan2(-1.0)).to_degrees()
}

/// How far apart two angles are (degrees), whole turns aside.
fn apart(one: f64, other: f64) -> f64 {
    ((one - other + 180.0).rem_euclid(360.0) - 180.0).abs()
}

#[test]
fn a_joint_put_elsewhere_stays_on_the_branch_drawn() {
    for crank in (-180..=180).step_by(30) {
        let report = json("branch", CRANK_ROCKER, &[&format!("A={crank}deg")]);
        let found = angle(&report, "B");
        assert!(
            apart(found, rocker(f64::from(crank))) < 1e-6,
            "{crank}: {found}"
        );
    }
    // The rocker turns back on either side of where it is drawn.
    for wanted in ["-7deg", "-3deg", "15deg", "30deg"] {
        let report = json("branch", CRANK_ROCKER, &[&format!("B={wanted}")]);
        let (crank, found) = (angle(&report, "A"), angle(&report, "B"));
        assert!(
            apart(found, rocker(crank)) < 1e-6,
            "{wanted}: {crank} {found}"
        );
        assert_eq!(report["warnings"], serde_json::json!([]), "{wanted}");
    }
}

#[test]
fn sarrus_lifts_its_plate_wherever_a_foot_is_put() {
    // The lower link stands at 126.87° when drawn: its knee turns twice as far, back.
    let text = std::fs::read_to_string(crate::support::folder("mechanisms/sarrus.urdf")).unwrap();
    for foot in (-120..=45).step_by(11) {
        let report = json("sarrus", &text, &[&format!("front_foot={foot}deg")]);
        assert_eq!(report["mobility"]["finite"], 1, "{foot}");
        let knee = angle(&report, "front_knee");
        assert!(apart(knee, -2.0 * f64::from(foot)) < 1e-4, "{foot}: {knee}");
    }
}

#[test]
fn another_configuration_than_the_one_drawn_is_told() {
    let report = json("other", CRANK_ROCKER, &["B=144deg"]);
    let warnings = report["warnings"].as_array().unwrap();
    assert_eq!(warnings[0]["kind"], "other_configuration");
    let text = warnings[0]["text"].as_str().unwrap();
    assert!(text.contains("2 in all"), "{text}");
    // Here no pose closes at all: that is said, and nothing of another configuration.
    let report = json("none", CRANK_ROCKER, &["B=60deg"]);
    let told = report["warnings"].to_string();
    assert!(!told.contains("other_configuration"), "{told}");
}

#[test]
fn exact_equations_hold_what_a_pose_names() {
    let file = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("poses_exact.urdf");
    std::fs::write(&file, CRANK_ROCKER).unwrap();
    let exact = |more: &[&str]| {
        let program = crate::support::program()
            .args(["exact", "--format", "json"])
            .arg(&file)
            .args(more)
            .output()
            .unwrap();
        serde_json::from_slice::<serde_json::Value>(&program.stdout).unwrap()
    };
    assert_eq!(exact(&[])["dimension"], 1);
    let held = exact(&["--pose", "A=30deg"]);
    assert_eq!(held["dimension"], 0);
    assert_eq!(held["held"], serde_json::json!(["A=30deg"]));
}
