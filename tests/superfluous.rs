//! Loops that gears tie together, planar loops that balls close, and links and couplings that can be left out: groups explain the first two,
//! and what is told of the third is tried by leaving it out.

use kutzbach::format::read;
use kutzbach::mobility::{MobilityClass, Verdict};
use kutzbach::report::text::{Layout, render};
use kutzbach::report::{Options, Report, WarningKind, report};

fn reported(text: &str) -> Report {
    let reading = read(text, "test.urdf", &[]).unwrap();
    report(&reading, "test.urdf", &Options::default()).unwrap()
}

fn hinge(name: &str, parent: &str, child: &str, at: &str) -> String {
    joint(name, "continuous", parent, child, at, "")
}

fn joint(name: &str, kind: &str, parent: &str, child: &str, at: &str, more: &str) -> String {
    format!(
        r#"<link name="{child}"/><joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>
        <origin xyz="{at}"/><axis xyz="0 0 1"/>{more}</joint>"#
    )
}

fn close(name: &str, kind: &str, of: [(&str, &str); 2]) -> String {
    let [(one, here), (other, there)] = of;
    format!(
        r#"<loop name="{name}" type="{kind}"><predecessor link="{one}"><origin xyz="{here}"/></predecessor>
        <successor link="{other}"><origin xyz="{there}"/></successor><axis xyz="0 0 1"/></loop>"#
    )
}

/// The whole: its ground and what stands on it.
fn robot(parts: &[String]) -> String {
    format!(
        r#"<robot name="r"><link name="ground"/>{}</robot>"#,
        parts.concat()
    )
}

/// A four-bar at a place along x, closed by a joint of some kind; `long` is the coupler's reach.
fn four_bar(side: &str, at: i32, kind: &str, long: i32, more: &str) -> String {
    let name = |part: &str| format!("{side}_{part}");
    [
        joint(
            &name("drive"),
            "continuous",
            "ground",
            &name("crank"),
            &format!("{at} 0 0"),
            more,
        ),
        hinge(&name("pin"), &name("crank"), &name("coupler"), "0 3 0"),
        hinge(
            &name("pivot"),
            "ground",
            &name("rocker"),
            &format!("{} 0 0", at + 7),
        ),
        close(
            &name("end"),
            kind,
            [
                (&name("coupler"), &format!("{long} 2 0")),
                (&name("rocker"), &format!("{} 5 0", long - 7)),
            ],
        ),
    ]
    .concat()
}

#[test]
fn gears_between_loops_closed_by_balls_leave_what_groups_explain() {
    // Whatever the lengths and the ratio: a plane with a ball leaves one freedom a loop, and the gear takes one.
    for (left, right, ratio) in [(6, 6, "-1"), (6, 8, "-1"), (5, 9, "3/2")] {
        let gear = format!(r#"<mimic joint="left_drive" multiplier="${{{ratio}}}"/>"#);
        let text = robot(&[
            four_bar("left", 0, "spherical", left, ""),
            four_bar("right", 20, "spherical", right, &gear),
        ]);
        let report = reported(&text);
        assert_eq!(report.mobility.finite, Some(1));
        assert_eq!(
            report.mobility.class,
            Some(MobilityClass::Exceptional),
            "{left} {right} {ratio}"
        );
    }
}

#[test]
fn planar_loops_that_share_a_crank_are_planar_with_balls_too() {
    // Two dyads on one crank, each closed by a ball.
    let dyad = |side: &str, at: i32, kind: &str| {
        let name = |part: &str| format!("{side}_{part}");
        [
            hinge(&name("pin"), "crank", &name("coupler"), "0 3 0"),
            hinge(
                &name("pivot"),
                "ground",
                &name("rocker"),
                &format!("{at} 0 0"),
            ),
            close(
                &name("end"),
                kind,
                [
                    (&name("coupler"), &format!("{} 2 0", at - 1)),
                    (&name("rocker"), "-1 5 0"),
                ],
            ),
        ]
        .concat()
    };
    for kinds in [["revolute", "spherical"], ["spherical", "spherical"]] {
        let [one, other] = kinds;
        let text = robot(&[
            hinge("drive", "ground", "crank", "0 0 0"),
            dyad("a", 7, one),
            dyad("b", -8, other),
        ]);
        let report = reported(&text);
        assert_eq!(report.mobility.finite, Some(1));
        assert_eq!(
            report.mobility.class,
            Some(MobilityClass::Exceptional),
            "{kinds:?}"
        );
    }
    // A ball off the plane of a hinge across it is no planar loop.
    let text = robot(&[
        hinge("drive", "ground", "crank", "0 0 0"),
        dyad("a", 7, "spherical"),
        dyad("b", -8, "spherical").replacen("0 0 1", "0 1 1", 1),
    ]);
    assert_ne!(
        reported(&text).mobility.class,
        Some(MobilityClass::Exceptional)
    );
}

/// A rod of 10 between a slide along x and one along y, and a crank of 5 to its middle, with some of these left out.
fn trammel(without: &str) -> String {
    let slide = |name: &str, axis: &str, at: &str| {
        format!(
            r#"<link name="{name}"/><joint name="on_{name}" type="prismatic"><parent link="ground"/><child link="{name}"/>
            <origin xyz="{at}"/><axis xyz="{axis}"/><limit lower="-20" upper="20" effort="1" velocity="1"/></joint>"#
        )
    };
    let all = [
        (
            "x",
            slide("x", "1 0 0", "6 0 0")
                + &close("of_x", "revolute", [("x", "0 0 0"), ("rod", "3 -4 0")]),
        ),
        (
            "y",
            slide("y", "0 1 0", "0 8 0")
                + &close("of_y", "revolute", [("y", "0 0 0"), ("rod", "-3 4 0")]),
        ),
        (
            "crank",
            hinge("pivot", "ground", "crank", "0 0 0")
                + &close("middle", "revolute", [("crank", "3 4 0"), ("rod", "0 0 0")]),
        ),
    ];
    let parts = all
        .into_iter()
        .filter(|(name, _)| *name != without)
        .map(|(_, part)| part);
    let rod = r#"<link name="rod"/><joint name="free" type="floating"><parent link="ground"/><child link="rod"/><origin xyz="3 4 0"/></joint>"#.to_owned();
    robot(&[vec![rod], parts.collect()].concat())
}

#[test]
fn a_link_that_can_be_left_out_is_named_and_can() {
    let whole = reported(&trammel(""));
    assert_eq!(whole.mobility.verdict, Verdict::Mobile);
    let mut named: Vec<(&str, i64)> = whole
        .advice
        .iter()
        .filter(|advice| advice.from == "link" && advice.to == "none")
        .map(|advice| (advice.joint.as_str(), advice.redundant_after))
        .collect();
    named.sort_unstable();
    assert_eq!(
        named.iter().map(|(name, _)| *name).collect::<Vec<_>>(),
        ["crank", "x", "y"]
    );
    for (name, redundant) in named {
        let rest = reported(&trammel(name));
        assert_eq!(rest.mobility.finite, whole.mobility.finite, "{name}");
        assert_eq!(rest.home.redundant, Some(redundant), "{name}");
    }
    // It fits by the lengths of rod and crank alone, as in any textbook.
    assert_eq!(whole.mobility.class, Some(MobilityClass::Paradoxical));
    let text = render(&whole, Layout::default());
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(!text.contains("no displacement group"), "{text}");
    assert!(
        text.contains("could be left out and fits by them"),
        "{text}"
    );
}

#[test]
fn a_coupling_that_repeats_a_loop_is_named() {
    // A parallelogram whose rocker is told to follow the crank, which it does anyway; a four-bar of other lengths is held by that.
    let bar = |tip: &str, wrist: &str| {
        robot(&[
            hinge("crank", "ground", "a", "0 0 0"),
            hinge("pin", "a", "b", "0 3 0"),
            joint(
                "rocker",
                "continuous",
                "ground",
                "c",
                "5 0 0",
                r#"<mimic joint="crank"/>"#,
            ),
            close("end", "revolute", [("b", tip), ("c", wrist)]),
        ])
    };
    let report = reported(&bar("5 0 0", "0 3 0"));
    assert_eq!(report.mobility.finite, Some(1));
    let named: Vec<&str> = report
        .advice
        .iter()
        .filter(|advice| advice.from == "coupling")
        .map(|advice| advice.joint.as_str())
        .collect();
    assert_eq!(named, ["rocker.mimic"]);
    assert_ne!(report.mobility.class, Some(MobilityClass::Paradoxical));
    let other = reported(&bar("5 1 0", "0 4 0"));
    assert!(other.advice.iter().all(|advice| advice.from != "coupling"));
}

#[test]
fn a_coupling_with_the_right_slope_at_the_pose_is_named_too() {
    // A crank of 3 upright and a rocker of 6 with a level coupler: as long as both stand upright, the rocker turns half as fast.
    let text = robot(&[
        hinge("crank", "ground", "a", "0 0 0"),
        hinge("pin", "a", "b", "0 3 0"),
        joint(
            "rocker",
            "continuous",
            "ground",
            "c",
            "9 -3 0",
            r#"<mimic joint="crank" multiplier="0.5"/>"#,
        ),
        close("end", "revolute", [("b", "9 0 0"), ("c", "0 6 0")]),
    ]);
    let report = reported(&text);
    assert_eq!(report.home.instantaneous, Some(1));
    assert_eq!(report.mobility.finite, Some(0));
    let told: Vec<&String> = report
        .warnings
        .iter()
        .filter(|warning| warning.kind == WarningKind::LockedTogether)
        .map(|warning| &warning.text)
        .collect();
    assert_eq!(told.len(), 1);
    assert!(
        told[0].ends_with("; without `rocker.mimic` it has 1"),
        "{told:?}"
    );
}
