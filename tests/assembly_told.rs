//! What a report says of how loops close: gaps of every size, how far and where joints had to move, what is held, what was
//! corrected, and what is proven.

use kutzbach::format::{Reading, WriteOptions, read};
use kutzbach::mobility::{Analysis, Verdict};
use kutzbach::report::text::{Layout, render};
use kutzbach::report::{Options, Report, analysed_report, assembled_file};

/// A four-bar in the x-y plane from its corners: ground, crank, coupler and rocker pins.
///
/// ```text
///   B ── coupler ── C
///   │ crank         │ rocker        the loop closes at D, the ground's side of which is off by `gap`
///   A ── ground ─── D
/// ```
fn four_bar(corners: [[f64; 2]; 4], gap: [f64; 3], turned: &str, extra: &str) -> Reading {
    let [a, b, c, d] = corners;
    let step =
        |from: [f64; 2], to: [f64; 2]| format!("{:.16} {:.16} 0", to[0] - from[0], to[1] - from[1]);
    let text = format!(
        r#"<robot name="four_bar"><link name="ground"/><link name="crank"/><link name="coupler"/><link name="rocker"/>
        <joint name="A" type="revolute"><parent link="ground"/><child link="crank"/><axis xyz="0 0 1"/><limit lower="-6" upper="6" effort="1" velocity="1"/></joint>
        <joint name="B" type="continuous"><parent link="crank"/><child link="coupler"/><origin xyz="{}"/><axis xyz="0 0 1"/></joint>
        <joint name="C" type="continuous"><parent link="coupler"/><child link="rocker"/><origin xyz="{}"/><axis xyz="0 0 1"/></joint>
        <loop name="D" type="continuous"><predecessor link="rocker"><origin xyz="{}"/></predecessor>
        <successor link="ground"><origin xyz="{:.16} {:.16} {:.16}" {turned}/></successor><axis xyz="0 0 1"/></loop>{extra}</robot>"#,
        step(a, b),
        step(b, c),
        step(c, d),
        d[0] - a[0] + gap[0],
        d[1] - a[1] + gap[1],
        gap[2],
    );
    read(&text, "four_bar.urdf", &[]).unwrap_or_else(|e| panic!("{e}"))
}

const OPEN: [[f64; 2]; 4] = [[0.0, 0.0], [0.1, 0.2], [0.45, 0.55], [0.4, 0.0]];

fn analysed(reading: &Reading, options: &Options) -> (Report, Analysis, String) {
    let (report, analysis) = analysed_report(reading, "four_bar.urdf", options).unwrap();
    let layout = Layout {
        verbose: false,
        ..Layout::default()
    };
    let text = render(&report, layout);
    (
        report,
        analysis,
        text.split_whitespace().collect::<Vec<_>>().join(" "),
    )
}

fn at_home(reading: &Reading) -> (Report, Analysis, String) {
    analysed(reading, &Options::default())
}

fn at(reading: &Reading, configuration: &str) -> (Report, Analysis, String) {
    let options = Options {
        configuration: Some(configuration.to_owned()),
        ..Options::default()
    };
    analysed(reading, &options)
}

#[test]
fn gaps_of_every_size_are_told_with_what_they_took() {
    for gap in [1e-5, 1e-3, 0.1] {
        let reading = four_bar(OPEN, [gap, 0.0, 0.0], "", "");
        let (report, _, text) = at_home(&reading);
        let assembly = &report.assembly;
        assert_eq!(assembly.closed, Some(true), "{gap}");
        assert_eq!(report.mobility.finite, Some(1), "{gap}");
        assert!((assembly.gaps[0].position - gap).abs() < 1e-12);
        assert!(assembly.moved.unwrap() > 0.1 * gap && assembly.moved.unwrap() < 5.0 * gap);
        let farthest = assembly
            .joints
            .iter()
            .max_by(|a, b| a.turned.total_cmp(&b.turned))
            .unwrap();
        assert!(
            farthest.turned > 0.5 * gap && farthest.turned < 20.0 * gap,
            "{farthest:?}"
        );
        assert!(
            text.contains(&format!("Largest change: `{}` by", farthest.name)),
            "{text}"
        );
    }
}

#[test]
fn an_axis_that_points_the_wrong_way_is_told_and_tried() {
    let reading = four_bar(OPEN, [0.0; 3], "rpy=\"${pi} 0 0\"", "");
    let (report, _, text) = at_home(&reading);
    assert_eq!(report.mobility.verdict, Verdict::Unassembled);
    assert!(report.assembly.proven_open, "{:?}", report.assembly);
    let reversal = report.assembly.reversal.as_ref().unwrap();
    assert_eq!(reversal.cycle, "D");
    assert!(text.contains("point in opposite directions"), "{text}");
    // Turned over and too short besides: no turned frame closes it, and nobody says so.
    let reading = four_bar(OPEN, [2.0, 0.0, 0.0], "rpy=\"${pi} 0 0\"", "");
    let (report, _, text) = at_home(&reading);
    assert!(report.assembly.reversal.is_none());
    assert!(!text.contains("opposite directions"), "{text}");
}

#[test]
fn what_closes_far_from_the_drawn_pose_is_found() {
    // Drawn stretched: coupler 2, rocker 2, crank 1, and a ground of 2 on the far side.
    let corners = [[0.0, 0.0], [1.0, 0.0], [3.0, 0.0], [5.0, 0.0]];
    let reading = four_bar(corners, [-7.0, 0.0, 0.0], "", "");
    let (report, _, text) = at_home(&reading);
    assert_eq!(report.assembly.closed, Some(true), "{text}");
    assert_eq!(report.mobility.finite, Some(1));
    assert!(
        text.contains("degree of freedom") || text.starts_with("Mobile"),
        "{text}"
    );
}

#[test]
fn nothing_is_called_impossible_without_a_proof() {
    // 0.2 + 0.35 + 0.5 < 2.
    let reading = four_bar(OPEN, [2.0, 0.0, 0.0], "", "");
    let (report, _, text) = at_home(&reading);
    assert!(report.assembly.proven_open);
    assert!(
        text.contains("one side is longer than all the others together"),
        "{text}"
    );
    // A step along the axes.
    let reading = four_bar(OPEN, [0.0, 0.0, 0.01], "", "");
    let (report, _, text) = at_home(&reading);
    assert!(
        report.assembly.proven_open && text.contains("10 mm along them"),
        "{text}"
    );
    for word in ["however the joints", "stays open by"] {
        assert!(!text.contains(word), "{text}");
    }
}

#[test]
fn a_small_gap_at_a_flat_pose_moves_nothing_far() {
    // A parallelogram folded flat: the gap lies where only the second order gives way.
    let flat = [[0.0, 0.0], [0.3, 0.0], [0.45, 0.0], [0.15, 0.0]];
    for gap in [
        [5.6e-6, 0.0, 0.0],
        [-5.6e-6, 0.0, 0.0],
        [0.0, 5.6e-6, 0.0],
        [3e-6, -4e-6, 0.0],
    ] {
        for lean in [0.0, 1e-4, 1e-2] {
            let leaning =
                flat.map(|[x, y]| [x, y + if x == 0.3 || x == 0.45 { lean } else { 0.0 }]);
            let reading = four_bar(leaning, gap, "", "");
            let (report, _, text) = at_home(&reading);
            assert_eq!(report.assembly.closed, Some(true), "{gap:?} {lean}: {text}");
            let farthest = report
                .assembly
                .joints
                .iter()
                .map(|j| j.turned)
                .fold(0.0, f64::max);
            // √(2 · 5.6e-6 / 0.15), the height of an arc with this sagitta, and some more for the mechanism around it.
            assert!(farthest < 5.0 * 8.6e-3, "{gap:?} {lean}: {} rad", farthest);
        }
    }
}

#[test]
fn held_joints_are_named_and_stay() {
    let extra = r#"<configuration name="turned"><position joint="A" value="0.25"/></configuration>
        <configuration name="wrong"><position joint="A" value="0.5"/><position joint="B" value="1"/></configuration>"#;
    let reading = four_bar(OPEN, [0.0; 3], "", extra);
    let (report, _, text) = at(&reading, "turned");
    assert_eq!(report.assembly.held, ["A"]);
    assert!(
        text.contains("Held as the configuration says: `A`."),
        "{text}"
    );
    let crank = report
        .assembly
        .joints
        .iter()
        .find(|j| j.name == "A")
        .unwrap();
    assert_eq!(crank.values, [0.25]);
    let (report, _, text) = at(&reading, "wrong");
    assert_eq!(report.mobility.verdict, Verdict::Unassembled);
    assert!(text.contains("with 2 joints held"), "{text}");
    assert!(
        text.contains("Loops with held joints close once these are released"),
        "{text}"
    );
    assert!(report.assembly.released.is_some());
    // Proven of the pose asked for, and of no other.
    let proof = report.assembly.proof.as_deref().unwrap();
    assert!(proof.contains("with 2 joints held"), "{proof}");
    assert!(!report.assembly.proven_open);
    let certificate = report.mobility.certificate.unwrap().text;
    assert!(
        certificate.contains("at no pose with the held joints"),
        "{certificate}"
    );
}

#[test]
fn measured_values_are_closed_to_the_nearest_pose() {
    // A closed pose, its values rounded to four decimals and all of them stated.
    let plain = four_bar(
        OPEN,
        [0.0; 3],
        "",
        r#"<configuration name="turned"><position joint="A" value="0.25"/></configuration>"#,
    );
    let (report, _, _) = at(&plain, "turned");
    let positions: String = report
        .assembly
        .joints
        .iter()
        .map(|j| {
            format!(
                r#"<position joint="{}" value="{:.4}"/>"#,
                j.name, j.values[0]
            )
        })
        .collect();
    let reading = four_bar(
        OPEN,
        [0.0; 3],
        "",
        &format!(r#"<configuration name="measured">{positions}</configuration>"#),
    );
    let (report, _, text) = at(&reading, "measured");
    assert_eq!(report.assembly.closed, Some(true), "{text}");
    assert_eq!(report.assembly.corrected.len(), 4);
    assert!(
        report.assembly.joints.iter().all(|j| j.correction < 5e-4),
        "{:?}",
        report.assembly.joints
    );
    assert!(text.contains("rounded values"), "{text}");
    assert_eq!(report.mobility.finite, Some(1), "{text}");
}

#[test]
fn what_is_written_back_closes_at_once() {
    let reading = four_bar(OPEN, [0.02, -0.03, 0.0], "", "");
    let (report, analysis, _) = at_home(&reading);
    let file = assembled_file(
        &reading.mechanism,
        &analysis.assembly,
        &WriteOptions::default(),
    )
    .unwrap();
    let again = read(&file, "four_bar.urdf", &[]).unwrap();
    let (back, _, text) = at(&again, "assembled");
    assert_eq!(back.assembly.closed, Some(true), "{text}");
    assert_eq!(back.assembly.moved, Some(0.0));
    assert_eq!(back.assembly.starts, Some(1));
    let values = |report: &Report| -> Vec<Vec<f64>> {
        report
            .assembly
            .joints
            .iter()
            .map(|j| j.values.clone())
            .collect()
    };
    assert_eq!(values(&report), values(&back));
    assert_eq!(back.mobility.finite, report.mobility.finite, "{text}");
    // Home is still there, as open as it was.
    let (home, _, _) = at_home(&again);
    assert!((home.assembly.gaps[0].position - report.assembly.gaps[0].position).abs() < 1e-12);
    // Nothing is written of what does not close.
    let open = four_bar(OPEN, [2.0, 0.0, 0.0], "", "");
    assert!(
        assembled_file(
            &open.mechanism,
            &at_home(&open).1.assembly,
            &WriteOptions::default()
        )
        .is_none()
    );
}

#[test]
fn a_tolerance_of_ones_own_takes_a_gap_as_closed() {
    // 4 µm along the axes, which no motion removes, in digits that no shorter number has.
    let reading = four_bar(OPEN, [0.0, 0.0, 4.1234567891e-6], "", "");
    let (report, _, text) = at_home(&reading);
    assert_eq!(report.mobility.verdict, Verdict::Unassembled);
    assert!(text.contains("--closure-tolerance"), "{text}");
    let within = |reading: &Reading, tolerance: f64| {
        let options = Options {
            closure_tolerance: Some(tolerance),
            ..Options::default()
        };
        analysed(reading, &options)
    };
    let coarse = |tolerance: f64| within(&reading, tolerance);
    let (report, _, text) = coarse(1e-5);
    assert_eq!(report.assembly.closed, Some(true), "{text}");
    assert_eq!(report.mobility.finite, Some(1), "{text}");
    assert!(text.contains("stays open by 4.12 µm and 0°"), "{text}");
    assert!(
        text.contains("does, as `--closure-tolerance` allows."),
        "{text}"
    );
    let (report, _, _) = coarse(1e-6);
    assert_eq!(report.assembly.closed, Some(false));
    // A millimetre drowns what happens near the pose: then the dimensions are taken to be known to within the tolerance.
    let wide = four_bar(OPEN, [0.0, 0.0, 1.001234567891e-3], "", "");
    let (report, _, text) = within(&wide, 2e-3);
    assert_eq!(report.mobility.finite, Some(1), "{text}");
    // A quarter of the step at each of four places.
    let nominal = report.mobility.nominal.as_ref().unwrap();
    assert!((nominal.distance.unwrap() - 2.5e-4).abs() < 1e-5, "{text}");
    assert!(text.contains("within the 2 mm asked for"), "{text}");
    assert!(text.contains("stays open by 1 mm and 0°"), "{text}");
    assert!(
        text.contains("up to 2 mm does, as `--closure-tolerance` allows"),
        "{text}"
    );
}

#[test]
fn a_gap_that_no_digits_leave_is_told_at_its_joint() {
    // A door whose middle hinge stands half a millimetre beside the others, ten half-units of the number that says so.
    let hinge = |name: &str, x: &str, z: [&str; 2]| {
        format!(
            r#"<loop name="{name}" type="revolute"><predecessor link="frame"><origin xyz="{x} 0 {}"/></predecessor>
            <successor link="door"><origin xyz="0 0 {}"/></successor><axis xyz="0 0 1"/></loop>"#,
            z[0], z[1]
        )
    };
    let file = format!(
        r#"<robot name="door"><link name="frame"/><link name="door"/><joint name="lower" type="revolute"><parent link="frame"/>
        <child link="door"/><origin xyz="0 0 0.2"/><axis xyz="0 0 1"/></joint>{}{}</robot>"#,
        hinge("middle", "0.0005", ["1.0", "0.8"]),
        hinge("upper", "0", ["1.8", "1.6"])
    );
    let (report, _, text) = at_home(&read(&file, "door.urdf", &[]).unwrap());
    assert_eq!(report.mobility.verdict, Verdict::Unassembled, "{text}");
    assert!(text.contains("500 µm and 0° at loop `middle`"), "{text}");
    // The middle of three collinear points moves by half of what the outer ones share.
    let nominal = report.mobility.nominal.as_ref().unwrap();
    assert!(
        !nominal.within_digits && nominal.distance.unwrap() < 3e-4,
        "{text}"
    );
    assert!(
        text.contains("beyond the precision of these numbers"),
        "{text}"
    );
}

#[test]
fn limits_choose_among_closings() {
    // The same four-bar with the elbow on the other side: pulled apart so far that it is assembled anew, within limits only.
    let limited = |lower: f64, upper: f64| {
        let text = kutzbach::format::write(&four_bar(OPEN, [0.3, 0.3, 0.0], "", "").mechanism);
        let text = text
            .replace("lower=\"-6\"", &format!("lower=\"{lower}\""))
            .replace("upper=\"6\"", &format!("upper=\"{upper}\""));
        let reading = read(&text, "four_bar.urdf", &[]).unwrap();
        at_home(&reading)
    };
    let (free, _, _) = limited(-6.0, 6.0);
    let crank = |report: &Report| {
        report
            .assembly
            .joints
            .iter()
            .find(|j| j.name == "A")
            .unwrap()
            .values[0]
    };
    assert_eq!(free.assembly.closed, Some(true));
    let value = crank(&free);
    let (lower, upper) = if value > 0.0 {
        (-1.0, 0.9 * value)
    } else {
        (0.9 * value, 1.0)
    };
    let (kept, _, text) = limited(lower, upper);
    assert_eq!(kept.assembly.closed, Some(true));
    assert!(
        kept.assembly.outside_limits.is_empty(),
        "{:?} {text}",
        kept.assembly.outside_limits
    );
    assert!(crank(&kept) >= lower - 1e-9 && crank(&kept) <= upper + 1e-9);
    // Where it cannot be helped, it is said.
    let (narrow, _, text) = limited(-1e-4, 1e-4);
    if !narrow.assembly.outside_limits.is_empty() {
        assert!(
            text.contains("No closing within the joint limits"),
            "{text}"
        );
    }
}
