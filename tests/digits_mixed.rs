//! Numbers of one file that are known differently well: offsets of micrometres in full, directions in full beside rounded lengths,
//! ratios of gears, and the noise of a kernel in a loop that holds fast.

use kutzbach::mobility::{AnalysisOptions, analyse};

/// The finite freedom of a file.
fn finite(text: &str) -> Option<usize> {
    let reading = kutzbach::format::read(text, "mixed.urdf", &[]).unwrap();
    let analysis = analyse(&reading.mechanism, &AnalysisOptions::default()).unwrap();
    analysis.mobility.finite()
}

/// A slider-crank in a plane, its slide along `(cos, 0, sin)` of a tilt; lengths of four decimals.
fn slider_crank(tilt: f64) -> String {
    let (cos, sin) = (tilt.cos(), tilt.sin());
    format!(
        r#"<robot name="pump"><link name="base"/><link name="crank"/><link name="rod"/><link name="piston"/>
        <joint name="shaft" type="revolute"><parent link="base"/><child link="crank"/><origin xyz="0.2137 0.1429 0"/><axis xyz="0 0 1"/></joint>
        <joint name="bore" type="prismatic"><parent link="base"/><child link="piston"/><origin xyz="1.6214 0.1429 0"/><axis xyz="{cos:?} 0.0 {sin:?}"/></joint>
        <joint name="pin" type="revolute"><parent link="crank"/><child link="rod"/><origin xyz="0.3081 0.4477 0"/><axis xyz="0 0 1"/></joint>
        <loop name="wrist" type="revolute"><predecessor link="rod"><origin xyz="1.0996 -0.4477 0"/></predecessor>
        <successor link="piston"><origin xyz="0 0 0"/></successor><axis xyz="0 0 1"/></loop></robot>"#
    )
}

#[test]
fn a_direction_in_full_is_no_more_open_than_its_digits() {
    assert_eq!(finite(&slider_crank(0.0)), Some(1));
    for tilt in [2e-3, 1e-3] {
        assert_ne!(finite(&slider_crank(tilt)), Some(1), "{tilt}");
    }
}

/// Three wheels in a ring, with the ratios given.
fn wheels(ratios: [&str; 3]) -> String {
    let wheel = |i: usize| {
        format!(
            r#"<link name="w{i}"/><joint name="s{i}" type="continuous"><parent link="base"/><child link="w{i}"/>
            <origin xyz="{i} 0 0"/><axis xyz="0 0 1"/></joint>"#
        )
    };
    let gear = |i: usize, a: usize, b: usize| {
        format!(
            r#"<coupling name="g{i}"><predecessor link="w{a}"/><successor link="w{b}"/><ratio value="{}"/></coupling>"#,
            ratios[i]
        )
    };
    format!(
        r#"<robot name="wheels"><link name="base"/>{}{}{}{}{}{}</robot>"#,
        wheel(0),
        wheel(1),
        wheel(2),
        gear(0, 0, 1),
        gear(1, 1, 2),
        gear(2, 0, 2)
    )
}

#[test]
fn ratios_are_known_to_their_digits() {
    // 19 to 29 to 37 teeth.
    assert_eq!(
        finite(&wheels(["-0.655172", "-0.783784", "0.513514"])),
        Some(1)
    );
    assert_eq!(
        finite(&wheels(["${-19/29}", "${-29/37}", "${19/37}"])),
        Some(1)
    );
    // One tooth more.
    assert_eq!(
        finite(&wheels(["-0.655172", "-0.783784", "0.540541"])),
        Some(0)
    );
    assert_eq!(
        finite(&wheels(["${-19/29}", "${-29/37}", "${20/37}"])),
        Some(0)
    );
}

/// A four-bar in a plane whose last hinge is tilted, every number with the noise of a kernel.
fn tilted_four_bar(tilt: f64) -> String {
    // Of some 1e-12, in another order for every number.
    let mut last = 0.37;
    let mut noise = move |x: f64| {
        last = (last * 7.13 + 0.217) % 1.0;
        format!("{:?}", x + (last - 0.5) * 2e-12)
    };
    let mut vector = |v: [f64; 3]| v.map(&mut noise).join(" ");
    let up = [0.0, 0.0, 1.0];
    let tilted = [tilt.sin(), 0.0, tilt.cos()];
    format!(
        r#"<robot name="kernel"><link name="base"/><link name="a"/><link name="b"/><link name="c"/>
        <joint name="j1" type="revolute"><parent link="base"/><child link="a"/><origin xyz="{}"/><axis xyz="{}"/></joint>
        <joint name="j4" type="revolute"><parent link="base"/><child link="c"/><origin xyz="{}"/><axis xyz="{}"/></joint>
        <joint name="j2" type="revolute"><parent link="a"/><child link="b"/><origin xyz="{}"/><axis xyz="{}"/></joint>
        <loop name="j3" type="revolute"><predecessor link="b"><origin xyz="{}"/></predecessor>
        <successor link="c"><origin xyz="{}"/></successor><axis xyz="{}"/></loop></robot>"#,
        vector([0.0, 0.0, 0.0]),
        vector(up),
        vector([2.1, 0.3, 0.0]),
        vector(up),
        vector([0.31, 0.87, 0.0]),
        vector(up),
        vector([1.49, 0.56, 0.0]),
        vector([-0.3, 1.13, 0.0]),
        vector(tilted),
    )
}

#[test]
fn noise_leaves_a_rigid_loop_rigid() {
    assert_eq!(finite(&tilted_four_bar(0.0)), Some(1));
    for tilt in [0.02, 1e-3, 4e-4] {
        assert_eq!(finite(&tilted_four_bar(tilt)), Some(0), "{tilt}");
    }
}

#[test]
fn offsets_in_full_are_measures() {
    // A pin 83 µm beside the frame of its link: both sides say so.
    let text = |here: &str, there: &str| {
        format!(
            r#"<robot name="bush"><link name="base"/><link name="a"/><link name="b"/><link name="c"/>
        <joint name="j1" type="revolute"><parent link="base"/><child link="a"/><origin xyz="0 0 0"/><axis xyz="0 0 1"/></joint>
        <joint name="j4" type="revolute"><parent link="base"/><child link="c"/><origin xyz="1.9000000000000001 0 0"/><axis xyz="0 0 1"/></joint>
        <joint name="j2" type="revolute"><parent link="a"/><child link="b"/><origin xyz="0.31234567890123457 0.8712345678901235 {here}"/><axis xyz="0 0 1"/></joint>
        <loop name="j3" type="revolute"><predecessor link="b"><origin xyz="1.2876543210987654 0.25876543210987655 0"/></predecessor>
        <successor link="c"><origin xyz="-0.30000000000000004 1.13 {there}"/></successor><axis xyz="0 0 1"/></loop></robot>"#
        )
    };
    let offset = "8.314567890123456e-05";
    assert_eq!(finite(&text(offset, offset)), Some(1));
    assert_eq!(finite(&text("0", "0")), Some(1));
}

#[test]
fn what_is_traced_and_simulated_is_what_was_told_mobile() {
    // A four-bar in an oblique plane, in four decimals: taken literally, its axes are not parallel and it binds.
    let text = r#"<robot name="oblique"><link name="g"/><link name="a"/><link name="b"/><link name="c"/>
        <joint name="j1" type="continuous"><parent link="g"/><child link="a"/><axis xyz="0.9222 -0.1915 0.3359"/></joint>
        <joint name="j2" type="continuous"><parent link="a"/><child link="b"/><origin xyz="0.1011 1.0835 0.3404"/><axis xyz="0.9222 -0.1915 0.3359"/></joint>
        <joint name="j3" type="continuous"><parent link="b"/><child link="c"/><origin xyz="0.6888 1.3026 -1.1485"/><axis xyz="0.9222 -0.1915 0.3359"/></joint>
        <loop name="j4" type="revolute"><predecessor link="c"><origin xyz="0.1362 -1.1322 -1.0196"/></predecessor>
          <successor link="g"><origin xyz="0.9260 1.2538 -1.8277"/></successor><axis xyz="0.9222 -0.1915 0.3359"/></loop></robot>"#;
    assert_eq!(finite(text), Some(1));
    let file = crate::support::empty_folder("oblique").join("oblique.urdf");
    std::fs::write(&file, text).unwrap();
    let asked = |arguments: &[&str]| {
        let output = crate::support::program()
            .args(arguments)
            .arg(&file)
            .output()
            .unwrap();
        let value: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let changed = value["dimensions_changed"].as_f64().unwrap();
        assert!(changed > 1e-6 && changed < 1e-4, "{changed}");
        value
    };
    let traced = asked(&["trace", "--format", "json"]);
    assert_eq!(traced["moves"], true);
    let simulated = asked(&["simulate", "--format", "json"]);
    let outcome = &simulated["verification"]["finding"]["outcome"];
    assert_eq!(outcome, "confirmed");
}

#[test]
fn a_nearest_mechanism_with_joints_that_nearly_coincide_is_decided() {
    // A crank to the middle of a rod between two slides at right angles; the tree has six decimals, its loops four. In the nearest
    // mechanism that moves, pins stand billionths of their links from where they are written, which is what computing it left.
    let rod = |name: &str, tip: &str, slide: &str| {
        format!(
            r#"<loop name="{name}" type="revolute"><predecessor link="rod"><origin xyz="{tip}"/></predecessor>
            <successor link="{slide}"/><axis xyz="0 0 1"/></loop>"#
        )
    };
    let text = format!(
        r#"<robot name="trammel"><link name="base"/><link name="crank"/><link name="rod"/><link name="x"/><link name="y"/>
        <joint name="shaft" type="continuous"><parent link="base"/><child link="crank"/><axis xyz="0 0 1"/></joint>
        <joint name="along" type="prismatic"><parent link="base"/><child link="x"/><origin xyz="0.305937 0 0"/><axis xyz="1 0 0"/>
          <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
        <joint name="up" type="prismatic"><parent link="base"/><child link="y"/><origin xyz="0 0.257687 0"/><axis xyz="0 1 0"/>
          <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
        <joint name="pin" type="continuous"><parent link="crank"/><child link="rod"/><origin xyz="0.152968 0.128844 0"/><axis xyz="0 0 1"/></joint>
        {}{}</robot>"#,
        rod("of_x", "0.153 -0.1288 0", "x"),
        rod("of_y", "-0.153 0.1288 0", "y")
    );
    assert_eq!(finite(&text), Some(1));
}

/// A four-bar whose plane is tilted, as `convert` writes it from a file of five decimals: poses as they were read, and others in full. Its last hinge is
/// askew by 0.01 degrees, fifteen times what five decimals leave open.
#[test]
fn a_hinge_askew_in_full_beside_rounded_poses_holds_fast() {
    let body = |name: &str, place: &str, joint: &str, inside: &str| {
        format!(
            r#"<body name="{name}" {place}><joint name="{joint}" axis="0 0 1"/><inertial pos="0 0 0" mass="0.1" diaginertia="0.001 0.001 0.001"/>{inside}</body>"#
        )
    };
    let coupler = body(
        "coupler",
        r#"pos="0.11401770824708224 -2.2205462196778214e-6 1.0735016092722205e-6" euler="-5.550263525871968e-6 -4.339086747420522e-6 -0.9827943266961526""#,
        "b",
        "",
    );
    let crank = body(
        "crank",
        r#"pos="0.12300 0.45600 0.78900" euler="-0.28562 -0.47090 2.58129""#,
        "a",
        &coupler,
    );
    let rocker = body(
        "rocker",
        r#"pos="0.24631 0.71739 0.90110" euler="-0.46635 -0.29336 3.05622""#,
        "d",
        "",
    );
    let text = format!(
        r#"<mujoco><compiler angle="radian" eulerseq="XYZ"/><worldbody>{crank}{rocker}</worldbody><equality>
        <connect body1="coupler" body2="rocker" anchor="0.2529752998698849 -1.9270659665227008e-7 -4.0151249403042044e-7"/>
        <connect body1="coupler" body2="rocker" anchor="0.25297727447169915 1.6175994870282862e-5 0.09999959857333877"/></equality></mujoco>"#
    );
    let reading = kutzbach::format::read(&text, "askew.xml", &[]).unwrap();
    let analysis = analyse(&reading.mechanism, &AnalysisOptions::default()).unwrap();
    assert_ne!(analysis.mobility.finite(), Some(1));
}

/// A four-bar whose plane is tilted, in twelve significant digits: its loop misses by rounding along the motion, of which numbers that do next to nothing
/// made 64276 units.
#[test]
fn twelve_digits_of_a_tilted_four_bar_do_not_hold_it_fast() {
    let joint = |name: &str, parent: &str, child: &str, place: &str, axis: &str| {
        format!(
            r#"<link name="{child}"/><joint name="{name}" type="continuous"><parent link="{parent}"/><child link="{child}"/>
            <origin {place}/><axis xyz="{axis}"/></joint>"#
        )
    };
    let crank = joint(
        "a",
        "base",
        "crank",
        r#"xyz="0.123003710212 0.456003710177 0.789003718529" rpy="-0.285623707212 -0.470902401069 2.58128629184""#,
        "-1.48495049887e-06 3.70552769194e-06 0.999996298506",
    );
    let coupler = joint(
        "b",
        "crank",
        "coupler",
        r#"xyz="0.11400969053 -8.90989846238e-06 8.63982935583e-06" rpy="-4.58572558433e-06 -1.45545148225e-06 -0.982798066384""#,
        "4.45959173716e-07 5.79589090895e-07 1.00000080415",
    );
    let rocker = joint(
        "d",
        "base",
        "rocker",
        r#"xyz="0.246306281391 0.717386296426 0.901096311314" rpy="-0.46634629363 -0.293363710486 3.05622370816""#,
        "3.70121008397e-06 -3.7077760271e-06 0.999996289031",
    );
    let text = format!(
        r#"<robot name="tilted"><link name="base"/>{crank}{coupler}{rocker}
        <loop name="c" type="continuous"><predecessor link="coupler"><origin xyz="0.252985494255 9.07456364272e-06 -1.20472112329e-05"/></predecessor>
        <successor link="rocker"><origin xyz="0.19416370157 9.38251259573e-07 1.97436499613e-07" rpy="0.00000428775 0.00000056063 -0.00000000005"/></successor>
        <axis xyz="0.000000601766 0.000000029000323985 0.05000018506551645"/></loop></robot>"#
    );
    assert_ne!(finite(&text), Some(0));
}
