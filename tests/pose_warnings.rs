//! What a report warns of at a pose: joint limits, dead centres, singular poses nearby.

use kutzbach::format::read;
use kutzbach::report::{Options, Verdict, report};

fn warnings(text: &str) -> Vec<String> {
    let reading = read(text, "file.urdf", &[]).unwrap_or_else(|error| panic!("{error}"));
    let report = report(&reading, "file.urdf", &Options::default()).unwrap();
    assert_eq!(report.mobility.verdict, Verdict::Mobile);
    report.warnings.into_iter().map(|w| w.text).collect()
}

/// A parallelogram of bars 1 and 2, its crank turned by an angle (rad) from the flat pose, where it has two motions.
fn parallelogram(angle: &str) -> String {
    format!(
        r#"<robot name="p"><link name="base"/><link name="crank"/><link name="coupler"/><link name="rocker"/>
        <joint name="a" type="revolute"><parent link="base"/><child link="crank"/><axis xyz="0 0 1"/></joint>
        <joint name="b" type="revolute"><parent link="crank"/><child link="coupler"/>
          <origin xyz="${{cos({angle})}} ${{sin({angle})}} 0"/><axis xyz="0 0 1"/></joint>
        <joint name="c" type="revolute"><parent link="coupler"/><child link="rocker"/><origin xyz="2 0 0"/><axis xyz="0 0 1"/></joint>
        <loop name="d" type="revolute"><predecessor link="rocker"><origin xyz="${{-cos({angle})}} ${{-sin({angle})}} 0"/></predecessor>
          <successor link="base"><origin xyz="2 0 0"/></successor><axis xyz="0 0 1"/></loop></robot>"#
    )
}

#[test]
fn poses_next_to_a_singular_one_are_told_with_a_clearer_one() {
    let near = warnings(&parallelogram("1/2000"));
    let [text] = near.as_slice() else {
        panic!("{near:?}")
    };
    assert!(text.starts_with("nearly singular: "), "{text}");
    assert!(text.contains("moved by") && text.contains('°'), "{text}");
    assert!(warnings(&parallelogram("1/2")).is_empty());
    // A long, thin mechanism is no nearer to a singular pose than others.
    let small = parallelogram("1/2").replace("2 0 0", "2000 0 0");
    assert!(warnings(&small).is_empty());
}

#[test]
fn a_singular_pose_comes_with_another_where_limits_say_which() {
    let flat = parallelogram("0");
    assert!(warnings(&flat).is_empty());
    let limited = flat.replacen(
        r#"<axis xyz="0 0 1"/></joint>"#,
        r#"<axis xyz="0 0 1"/><limit lower="0" upper="1"/></joint>"#,
        1,
    );
    let told = warnings(&limited);
    let offered =
        |text: &String| text.starts_with("singular pose: ") && text.contains("`--pose limits`");
    assert!(told.iter().any(offered), "{told:?}");
}

/// A crank of length 1, a rod of length 2 and a slider, stretched or not.
fn slider_crank(angle: &str) -> String {
    format!(
        r#"<robot name="s"><link name="base"/><link name="crank"/><link name="rod"/><link name="slider"/>
        <joint name="shaft" type="revolute"><parent link="base"/><child link="crank"/><axis xyz="0 0 1"/></joint>
        <joint name="pin" type="revolute"><parent link="crank"/><child link="rod"/><origin xyz="${{cos({angle})}} ${{sin({angle})}} 0"/><axis xyz="0 0 1"/></joint>
        <joint name="slide" type="prismatic"><parent link="base"/><child link="slider"/>
          <origin xyz="${{cos({angle}) + sqrt(4 - sin({angle})**2)}} 0 0"/><axis xyz="1 0 0"/></joint>
        <loop name="wrist" type="revolute"><predecessor link="rod"><origin xyz="${{sqrt(4 - sin({angle})**2)}} ${{-sin({angle})}} 0"/></predecessor>
          <successor link="slider"/><axis xyz="0 0 1"/></loop></robot>"#
    )
}

#[test]
fn couplings_that_lock_what_the_loops_leave_free_are_told() {
    let told = |ratio: &str| {
        // On the parallelogram the rocker turns on the coupler as the crank does on the base.
        let mimic = format!("<mimic joint=\"a\" multiplier=\"{ratio}\"/></joint>\n        <loop");
        let text = parallelogram("1/2").replace("</joint>\n        <loop", &mimic);
        let reading = read(&text, "file.urdf", &[]).unwrap();
        let report = report(&reading, "file.urdf", &Options::default()).unwrap();
        let lock = |warning: &&String| warning.contains("lock it together");
        (
            report.mobility.verdict,
            report.warnings.iter().map(|w| &w.text).find(lock).cloned(),
        )
    };
    assert_eq!(told("1"), (Verdict::Mobile, None));
    let (verdict, warning) = told("2");
    assert_eq!(verdict, Verdict::Rigid);
    let warning = warning.unwrap();
    assert!(
        warning.contains("by the loops alone it would have 1 instantaneous freedom at this pose; "),
        "{warning}"
    );
}

#[test]
fn dead_centres_are_told() {
    let stretched = warnings(&slider_crank("0"));
    assert!(
        stretched
            .iter()
            .any(|text| text.starts_with("extreme position: `slide` at this pose")),
        "{stretched:?}"
    );
    assert!(warnings(&slider_crank("1")).is_empty());
}

#[test]
fn limits_are_held_against_the_pose_and_the_couplings() {
    let arm = |first: &str, second: &str| {
        format!(
            r#"<robot name="r"><link name="a"/><link name="b"/><link name="c"/>
            <joint name="one" type="revolute"><parent link="a"/><child link="b"/><axis xyz="1 0 0"/>{first}</joint>
            <joint name="two" type="prismatic"><parent link="b"/><child link="c"/><axis xyz="1 0 0"/>{second}</joint></robot>"#
        )
    };
    let limit = |lower: &str, upper: &str| format!(r#"<limit lower="{lower}" upper="{upper}"/>"#);
    assert!(warnings(&arm(&limit("-1", "1"), "")).is_empty());
    assert_eq!(
        warnings(&arm(&limit("${pi/6}", "1"), &limit("-0.2", "-0.1"))),
        [
            "this pose is outside joint limits: `one` is at 0°, 30° below its limit of 30°; `two` is at 0 mm, 100 mm above its \
          limit of -100 mm; `--pose limits` analyses the middle of the limits, `--pose joint=value` any other pose"
        ]
    );
    assert!(warnings(&arm(&limit("0", "0"), ""))[0].starts_with("1 joint has a range of zero"));
    let mimic = r#"<mimic joint="one" multiplier="-1"/>"#;
    let pinned = warnings(&arm(&limit("0", "1"), &(limit("0", "1") + mimic)));
    assert!(
        pinned[0].contains("one value each") && pinned[0].contains("`one`"),
        "{pinned:?}"
    );
    let empty = r#"<mimic joint="one" multiplier="-1" offset="-1"/>"#;
    let found = warnings(&arm(&limit("0", "1"), &(limit("0", "1") + empty)));
    assert!(
        found
            .iter()
            .any(|text| text.contains("no values within the limits")),
        "{found:?}"
    );
}
