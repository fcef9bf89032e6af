//! Four-bar linkages: closed formulas of the report against the motion that is traced through the closure equations.

use crate::support;

use kutzbach::matrix::SplitMix64;
use kutzbach::report::{FourBarKind, GrashofClass, JointRow, Options, Report, analysed_report};
use std::f64::consts::TAU;
use support::{assert_none, in_parallel};

/// A number between 1 and 5 of three decimals.
fn length(random: &mut SplitMix64) -> f64 {
    (1000 + random.next_u64() % 4000) as f64 / 1000.0
}

/// The file of a four-bar drawn with its crank at an angle where the loop closes; `None` where it does not there.
fn drawn([g, a, c, b]: [f64; 4], crank: f64) -> Option<String> {
    let (x, y) = (a * crank.cos(), a * crank.sin());
    // From the crank's pin to the rocker's foot, and the triangle on it.
    let (dx, dy) = (g - x, -y);
    let d = dx.hypot(dy);
    let along = (c * c - b * b + d * d) / (2.0 * d);
    let across = (c * c - along * along).sqrt();
    if !(across > 0.1) {
        return None;
    }
    let (px, py) = (
        x + (along * dx - across * dy) / d,
        y + (along * dy + across * dx) / d,
    );
    let joint = |name: &str, parent: &str, child: &str, [x, y]: [f64; 2]| {
        format!(
            "<joint name='{name}' type='continuous'><parent link='{parent}'/><child link='{child}'/>\
             <origin xyz='{x:.17} {y:.17} 0'/><axis xyz='0 0 1'/></joint>"
        )
    };
    Some(format!(
        "<robot name='four_bar'><link name='g'/><link name='a'/><link name='c'/><link name='b'/>{}{}{}\
         <loop name='C' type='continuous'><predecessor link='c'><origin xyz='{:.17} {:.17} 0'/></predecessor>\
         <successor link='b'><origin xyz='{:.17} {:.17} 0'/></successor><axis xyz='0 0 1'/></loop></robot>",
        joint("A", "g", "a", [0.0, 0.0]),
        joint("B", "a", "c", [x, y]),
        joint("D", "g", "b", [g, 0.0]),
        px - x,
        py - y,
        px - g,
        py
    ))
}

fn report_on(text: &str) -> Report {
    let reading = kutzbach::format::read(text, "four_bar", &[]).unwrap();
    let options = Options {
        ranges: true,
        ..Options::default()
    };
    analysed_report(&reading, "four_bar", &options).unwrap().0
}

/// What a trace says of a joint, against what the formulas say: whether it turns fully, and how far it goes.
fn differs(joint: &JointRow, extremes: Option<[f64; 2]>) -> Option<String> {
    let [range] = joint.ranges.as_slice() else {
        return Some(format!("{} has {} ranges", joint.name, joint.ranges.len()));
    };
    let wrong = match extremes {
        None => range.turns == 0,
        Some([from, to]) => {
            range.turns != 0 || ((range.max - range.min) - (to - from)).abs() > 1e-6
        }
    };
    wrong.then(|| format!("{}: {extremes:?}, traced {range:?}", joint.name))
}

fn wrong(lengths: &[f64; 4], text: &str) -> Vec<String> {
    let report = report_on(text);
    let Some(bar) = report.four_bars.first() else {
        return vec![format!("{lengths:?}: no four-bar")];
    };
    let joint = |name: &str| report.joints.iter().find(|row| row.name == name).unwrap();
    let mut all = Vec::new();
    let written = bar.links.each_ref().map(|link| {
        ["g", "a", "c", "b"]
            .iter()
            .position(|name| name == link)
            .unwrap()
    });
    for (length, link) in bar.lengths.iter().zip(written) {
        if (length - lengths[link]).abs() > 1e-12 {
            all.push(format!("length {length} of {}", lengths[link]));
        }
    }
    for swing in &bar.swings {
        all.extend(differs(joint(&swing.joint), swing.extremes));
    }
    // Driven by a crank, the transmission angle is how far the joint between coupler and output goes.
    if bar.swings[0].extremes.is_none() {
        let between = if bar.links[1] == "a" { "C" } else { "B" };
        all.extend(differs(joint(between), Some(bar.transmission)));
    }
    all.iter()
        .map(|what| format!("{lengths:?}: {what}"))
        .collect()
}

/// Four kinds by the place of the shortest link, and the linkages in which no link turns: fifty of each.
#[test]
fn two_hundred_random_four_bars_go_as_far_as_the_formulas_say() {
    const EACH: usize = 50;
    let mut random = SplitMix64::new(34);
    let mut kinds: Vec<(usize, [f64; 4], String)> = Vec::new();
    while kinds.len() < 4 * EACH {
        let lengths = [0; 4].map(|_| length(&mut random));
        let mut sorted = lengths;
        sorted.sort_by(f64::total_cmp);
        let spare = sorted[1] + sorted[2] - sorted[0] - sorted[3];
        // Next to a change point a trace slows down.
        if spare.abs() < 0.05 {
            continue;
        }
        let shortest = lengths.iter().position(|l| *l == sorted[0]).unwrap();
        // The crank may be either of the two links on the ground.
        let kind = match (spare > 0.0, shortest) {
            (false, _) => 3,
            (true, 3) => 1,
            (true, place) => place,
        };
        let crank = length(&mut random) * TAU;
        if kinds.iter().filter(|(known, ..)| *known == kind).count() < EACH
            && let Some(text) = drawn(lengths, crank)
        {
            kinds.push((kind, lengths, text));
        }
    }
    let results = in_parallel(&kinds, |(kind, lengths, text)| {
        let bar = report_on(text).four_bars.remove(0);
        let expected = [
            (GrashofClass::Grashof, FourBarKind::DoubleCrank),
            (GrashofClass::Grashof, FourBarKind::CrankRocker),
            (GrashofClass::Grashof, FourBarKind::DoubleRocker),
            (GrashofClass::NonGrashof, FourBarKind::DoubleRocker),
        ][*kind];
        let mut all = wrong(lengths, text);
        if (bar.class, bar.kind) != expected {
            all.push(format!("{lengths:?}: {:?}, {:?}", bar.class, bar.kind));
        }
        all
    });
    assert_none(&results.concat());
}

/// With limits on one joint or two the linkage goes as far as its trace does, and says what stops it.
#[test]
fn limits_stop_four_bars_where_the_trace_stops() {
    let mut random = SplitMix64::new(57);
    let mut cases: Vec<([f64; 4], String)> = Vec::new();
    while cases.len() < 80 {
        let lengths = [0; 4].map(|_| length(&mut random));
        let mut sorted = lengths;
        sorted.sort_by(f64::total_cmp);
        if (sorted[1] + sorted[2] - sorted[0] - sorted[3]).abs() < 0.05 {
            continue;
        }
        let crank = length(&mut random) * TAU;
        let Some(mut text) = drawn(lengths, crank) else {
            continue;
        };
        for _ in 0..1 + random.next_u64() % 2 {
            let joint = ["A", "B", "D", "C"][(random.next_u64() % 4) as usize];
            let mut bound = || 0.05 + (random.next_u64() % 2000) as f64 / 1000.0;
            let (lower, upper) = (bound(), bound());
            // Of four limits one has no upper end.
            let upper = match random.next_u64() % 4 {
                0 => "1e308".to_owned(),
                _ => upper.to_string(),
            };
            let limit = format!(" type='revolute'><limit lower='-{lower}' upper='{upper}'/>");
            text = text.replace(
                &format!("name='{joint}' type='continuous'>"),
                &format!("name='{joint}'{limit}"),
            );
        }
        cases.push((lengths, text));
    }
    let results = in_parallel(&cases, |(lengths, text)| {
        (wrong(lengths, text), report_on(text))
    });
    let wrong: Vec<String> = results
        .iter()
        .flat_map(|(wrong, _)| wrong.clone())
        .collect();
    assert_none(&wrong);
    let stopped = results
        .iter()
        .filter(|(_, report)| !report.four_bars[0].stopped_by.is_empty());
    assert!(stopped.count() > 40);
}

/// A leg of two four-bars on one crank: each has its class, beside those that hang on it.
#[test]
fn four_bars_within_larger_mechanisms_are_classed() {
    let (_, leg) = support::own_mechanisms()
        .into_iter()
        .find(|(name, _)| name == "jansen_leg")
        .unwrap_or_else(|| (String::new(), support::zoo_mechanism("jansen_leg")));
    let text = kutzbach::format::write(&leg);
    let bars = report_on(&text).four_bars;
    assert_eq!(bars.len(), 2, "{bars:#?}");
    for bar in bars {
        assert_eq!(
            (bar.class, bar.kind),
            (GrashofClass::Grashof, FourBarKind::CrankRocker)
        );
        assert!(bar.within_larger && bar.swings[0].extremes.is_none());
    }
}

/// Linkages of textbooks: ground, crank, coupler and rocker. Fourteen are the rows of table P4-1 in R. L. Norton, Design of
/// Machinery, chapter 4; the others have names of their own (the same book, chapter 3, on straight-line linkages and
/// inversions): Hoeken's straight-line linkage, Galloway's deltoid, Watt's, Roberts's, a drag link and a parallelogram; row i has
/// the proportions of Chebyshev's.
#[test]
fn the_linkages_of_textbooks_are_classed_and_go_as_far_as_the_formulas_say() {
    use FourBarKind::{CrankRocker, DoubleCrank, DoubleRocker};
    use GrashofClass::{ChangePoint, Grashof, NonGrashof};
    let table: [(&str, [f64; 4], f64, GrashofClass, FourBarKind); 20] = [
        ("P4-1 a", [6.0, 2.0, 7.0, 9.0], 30.0, Grashof, CrankRocker),
        ("P4-1 b", [7.0, 9.0, 3.0, 8.0], 85.0, Grashof, DoubleRocker),
        ("P4-1 c", [3.0, 10.0, 6.0, 8.0], 45.0, Grashof, DoubleCrank),
        (
            "P4-1 d",
            [8.0, 5.0, 7.0, 6.0],
            25.0,
            ChangePoint,
            CrankRocker,
        ),
        ("P4-1 e", [8.0, 5.0, 8.0, 6.0], 75.0, Grashof, CrankRocker),
        ("P4-1 f", [5.0, 8.0, 8.0, 9.0], 15.0, Grashof, DoubleCrank),
        ("P4-1 g", [6.0, 8.0, 8.0, 9.0], 25.0, Grashof, DoubleCrank),
        (
            "P4-1 h",
            [20.0, 10.0, 10.0, 10.0],
            50.0,
            NonGrashof,
            DoubleRocker,
        ),
        ("P4-1 i", [4.0, 5.0, 2.0, 5.0], 80.0, Grashof, DoubleRocker),
        (
            "P4-1 j",
            [20.0, 10.0, 5.0, 10.0],
            33.0,
            NonGrashof,
            DoubleRocker,
        ),
        (
            "P4-1 k",
            [4.0, 6.0, 10.0, 7.0],
            88.0,
            NonGrashof,
            DoubleRocker,
        ),
        (
            "P4-1 l",
            [9.0, 7.0, 10.0, 7.0],
            60.0,
            NonGrashof,
            DoubleRocker,
        ),
        (
            "P4-1 m",
            [9.0, 7.0, 11.0, 8.0],
            50.0,
            NonGrashof,
            DoubleRocker,
        ),
        (
            "P4-1 n",
            [9.0, 7.0, 11.0, 6.0],
            120.0,
            NonGrashof,
            DoubleRocker,
        ),
        ("Hoeken", [2.0, 1.0, 2.5, 2.5], 40.0, Grashof, CrankRocker),
        (
            "Galloway",
            [2.0, 2.0, 4.0, 4.0],
            60.0,
            ChangePoint,
            DoubleCrank,
        ),
        ("Watt", [4.0, 2.0, 1.0, 2.0], 20.0, NonGrashof, DoubleRocker),
        (
            "Roberts",
            [2.0, 1.2, 1.0, 1.2],
            70.0,
            NonGrashof,
            DoubleRocker,
        ),
        (
            "drag link",
            [1.0, 3.0, 2.5, 2.8],
            50.0,
            Grashof,
            DoubleCrank,
        ),
        (
            "parallelogram",
            [4.0, 2.0, 4.0, 2.0],
            50.0,
            ChangePoint,
            DoubleCrank,
        ),
    ];
    let failed = in_parallel(&table, |&(name, lengths, crank, class, kind)| {
        let Some(text) = drawn(lengths, crank.to_radians()) else {
            return vec![format!("{name} does not close")];
        };
        let Some(bar) = report_on(&text).four_bars.into_iter().next() else {
            return vec![format!("{name} is no four-bar")];
        };
        let mut all = Vec::new();
        if (bar.class, bar.kind) != (class, kind) {
            all.push(format!("{name}: {:?}, {:?}", bar.class, bar.kind));
        }
        // A change point is a singular pose of the motion, beyond which there are two.
        if class != ChangePoint {
            all.extend(wrong(&lengths, &text));
        }
        all
    });
    assert_none(&failed.concat());
}

/// Two rods beside a bar, their tops turned by a little: nearly a parallelogram, of which it is not decided whether it moves. A flap beside them
/// does.
#[test]
fn joints_outside_loops_move_whatever_the_loops_do() {
    let (bar, out, turned) = (0.05, 0.01, 0.004_f64);
    let rod = |name: &str, side: f64| {
        let top = [bar - side * out * turned.sin(), side * out * turned.cos()];
        let hinge = "<axis xyz='0 0 1'/>";
        format!(
            "<link name='{name}'/><joint name='{name}_foot' type='continuous'><parent link='g'/><child link='{name}'/>\
             <origin xyz='0 {} 0'/>{hinge}</joint><loop name='{name}_top' type='continuous'>\
             <predecessor link='{name}'><origin xyz='{} {} 0'/></predecessor>\
             <successor link='plate'><origin xyz='{} {} 0'/></successor>{hinge}</loop>",
            side * out,
            top[0],
            top[1] - side * out,
            top[0] - bar,
            top[1]
        )
    };
    let text = format!(
        "<robot name='r'><link name='g'/><link name='bar'/><link name='plate'/><link name='flap'/>\
         <joint name='foot' type='continuous'><parent link='g'/><child link='bar'/><axis xyz='0 0 1'/></joint>\
         <joint name='top' type='continuous'><parent link='bar'/><child link='plate'/><origin xyz='{bar} 0 0'/><axis xyz='0 0 1'/></joint>\
         <joint name='lid' type='continuous'><parent link='g'/><child link='flap'/><axis xyz='0 0 1'/></joint>{}{}</robot>",
        rod("one", 1.0),
        rod("other", -1.0)
    );
    let reading = kutzbach::format::read(&text, "r", &[]).unwrap();
    let report = kutzbach::report::report(&reading, "r", &Options::default()).unwrap();
    let text = kutzbach::report::text::render(&report, Default::default());
    let mut rows = text.lines().map(str::trim);
    let lid = rows.find(|row| row.starts_with("lid ") && row.contains("revolute"));
    assert!(lid.is_some_and(|row| row.contains("moves")), "{text}");
    assert!(!lid.unwrap_or_default().contains("infinitesimal"), "{text}");
}
