//! What has margin is decided, whatever the decimals: platforms on rods, rounded as drawings are.

use crate::support;
use kutzbach::format::read;
use kutzbach::matrix::SplitMix64;
use kutzbach::report::{Options, Report, Verdict, report};

/// A platform that floats above its base on rods of the lengths drawn; all coordinates with so many decimals.
fn platform(rods: &[([f64; 3], [f64; 3])], height: f64, decimals: usize) -> Report {
    let point = |p: &[f64; 3]| p.map(|x| format!("{x:.decimals$}")).join(" ");
    let mut text = format!(
        r#"<robot name="p"><link name="base"/><link name="top"/><joint name="free" type="floating"><parent link="base"/>
        <child link="top"/><origin xyz="0 0 {height:.decimals$}"/></joint>"#
    );
    for (index, (foot, head)) in rods.iter().enumerate() {
        text += &format!(
            r#"<loop name="rod{index}" type="distance"><predecessor link="base"><origin xyz="{}"/></predecessor>
            <successor link="top"><origin xyz="{}"/></successor></loop>"#,
            point(foot),
            point(head)
        );
    }
    text += "</robot>";
    let reading = read(&text, "p.urdf", &[]).unwrap_or_else(|error| panic!("{error}"));
    report(&reading, "p.urdf", &Options::default()).unwrap()
}

/// Feet and heads in turn, as on a Stewart platform of radii 0.5 m and 0.3 m, moved about at random.
fn stewart(random: &mut SplitMix64) -> Vec<([f64; 3], [f64; 3])> {
    let mut point = |radius: f64, angle: f64| {
        let away = 0.05;
        [
            radius * angle.cos() + away * random.symmetric(),
            radius * angle.sin() + away * random.symmetric(),
            away * random.symmetric(),
        ]
    };
    (0..6)
        .map(|leg| {
            let middle = f64::from(leg / 2) * 120f64.to_radians();
            let side = if leg % 2 == 0 { -1.0 } else { 1.0 };
            let foot = point(0.5, middle + side * 0.2);
            (foot, point(0.3, middle + side * 0.85))
        })
        .collect()
}

#[test]
fn platforms_on_rods_are_decided_whatever_their_decimals() {
    let mut random = SplitMix64::new(33);
    for decimals in [4, 5, 6] {
        for case in 0..25 {
            let rods = stewart(&mut random);
            let said = |count: usize| {
                let report = platform(&rods[..count], 0.6, decimals);
                (report.mobility.verdict, report.mobility.finite)
            };
            let place = format!("{decimals} decimals, case {case}");
            assert_eq!(said(6), (Verdict::Rigid, Some(0)), "{place}");
            assert_eq!(said(5), (Verdict::Mobile, Some(1)), "{place}");
        }
    }
}

/// Hexagons that are similar make the rods' lines dependent at every pose (Borel and Bricard's, Griffis and Duffy's platforms
/// are of this kind). Rounding spoils that; nobody can tell from the file whether it was meant.
#[test]
fn platforms_that_rounding_spoils_are_not_taken_for_stiff_ones() {
    // With three decimals these lengths below a metre count as chosen.
    for (decimals, case) in support::sample((0..20u8).map(|n| (4 + usize::from(n / 10), n % 10)), 4)
    {
        let turn = f64::from(case) * 0.1;
        let rods: Vec<_> = [0.1, 0.9, 2.0, 2.8, 4.1, 5.2]
            .iter()
            .map(|angle| {
                let at = |radius: f64, turn: f64| {
                    let angle: f64 = angle + turn;
                    [radius * angle.cos(), radius * angle.sin(), 0.0]
                };
                (at(0.5, 0.0), at(0.3, turn))
            })
            .collect();
        let report = platform(&rods, 0.6, decimals);
        let stiff = report.mobility.verdict == Verdict::Rigid && report.home.redundant == Some(0);
        assert!(
            !stiff,
            "{decimals} decimals, turned by {turn}: {:?}",
            report.mobility
        );
    }
}

/// A door's second hinge cannot add to what its first allows, however coarse the numbers.
#[test]
fn a_door_has_no_more_freedoms_than_one_hinge() {
    let text = r#"<robot name="door"><link name="frame"/><link name="door"/>
        <joint name="lower" type="revolute"><parent link="frame"/><child link="door"/><origin xyz="0 0 0.2"/><axis xyz="0 0 1"/></joint>
        <loop name="middle" type="revolute"><predecessor link="frame"><origin xyz="0.003 0.001 1.1"/></predecessor>
          <successor link="door"><origin xyz="0.003 0.001 0.9"/></successor><axis xyz="0 0 1"/></loop>
        <loop name="upper" type="revolute"><predecessor link="frame"><origin xyz="0 0 1.8"/></predecessor>
          <successor link="door"><origin xyz="0 0 1.6"/></successor><axis xyz="0 0 1"/></loop></robot>"#;
    let reading = read(text, "door.urdf", &[]).unwrap();
    let found = report(&reading, "door.urdf", &Options::default())
        .unwrap()
        .mobility;
    // The middle hinge is three millimetres out of line, six times what its digits leave open.
    assert_eq!(found.verdict, Verdict::Rigid);
    assert!(found.nominal.is_some_and(|n| !n.within_digits));
}

/// A planar ring of hinges along a line; positive links lead out, negative ones back.
fn folded_ring(links: &[&str]) -> Report {
    let last = links.len() - 1;
    let mut text = String::from(r#"<robot name="folded"><link name="l0"/>"#);
    for (link, length) in links[..last].iter().enumerate() {
        text += &format!(
            r#"<link name="l{next}"/><joint name="j{next}" type="continuous"><parent link="l{link}"/><child link="l{next}"/>
            <origin xyz="${{{length}}} 0 0"/><axis xyz="0 0 1"/></joint>"#,
            next = link + 1,
        );
    }
    text += &format!(
        r#"<loop name="last" type="continuous"><predecessor link="l{last}"><origin xyz="${{{}}} 0 0"/></predecessor>
        <successor link="l0"/><axis xyz="0 0 1"/></loop></robot>"#,
        links[last]
    );
    let reading = read(&text, "folded.urdf", &[]).unwrap_or_else(|error| panic!("{error}"));
    report(&reading, "folded.urdf", &Options::default()).unwrap()
}

/// What the lengths allow along the line is a quadratic form of as many squares as there are links that turn, less one: two of each
/// sign, however short two of the links are. Its cone is irreducible, one branch on which every joint moves. In doubles the two small
/// squares vanish, and what is left is a product of two.
#[test]
fn links_too_short_for_doubles_do_not_make_two_branches() {
    for exponent in [6, 9, 11, 13, 14, 17, 25] {
        let (short, back) = (format!("7/10**{exponent}"), format!("-7/10**{exponent}"));
        for (a, b, minus_a, minus_b) in [("1/2", "1/2", "-1/2", "-1/2"), ("2", "1", "-2", "-1")] {
            let found = folded_ring(&[a, &short, b, minus_b, &back, minus_a]);
            let place = format!("links {a}, {b}, two of {short}");
            let mobility = (found.mobility.verdict, found.mobility.finite);
            assert_eq!(mobility, (Verdict::Mobile, Some(3)), "{place}");
            assert_eq!(found.home.instantaneous, Some(4), "{place}");
            let branches = found.branches.unwrap_or_default();
            assert!(branches.len() <= 1, "{place}: {branches:?}");
            let none = |b: &kutzbach::report::Branch| b.locked.is_empty() && b.idle.is_empty();
            assert!(branches.iter().all(none), "{place}: {branches:?}");
        }
    }
}
