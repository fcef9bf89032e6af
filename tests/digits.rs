//! Rounded files: paradoxical loops written with fewer and fewer digits.
//!
//! Such a loop moves because of equations between its dimensions, and rounding breaks them. Taken literally a rounded file
//! is rigid; what its author meant is mobile. The analysis decides within the precision that the digits state, says what
//! the numbers taken literally give where that differs, and tells its margin.
//!
//! Programs round in three manners, and all of them are tried: to a number of decimals with or without the zeros at the
//! end, and to a number of significant digits.

use crate::support;

use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::Analysis;
use kutzbach::number::Number;
use support::rewrite::Draft;
use support::{analysis, assert_none, decimal, in_parallel, zoo_mechanism};

/// Loops of four to six hinges that move against the count, with one finite freedom, and their instantaneous freedom.
const LOOPS: [(&str, usize); 14] = [
    ("bennett_equilateral", 1),
    ("bennett_generic", 1),
    ("bennett_neardegenerate_1deg", 1),
    ("bennett_ratio2", 1),
    ("bennett_rational", 1),
    ("spherical_4r", 1),
    ("goldberg_5r_L", 1),
    ("goldberg_6r", 1),
    ("bricard_line_symmetric", 1),
    ("bricard_octahedron_plane", 1),
    ("bricard_orthogonal", 1),
    ("bricard_threefold_60", 1),
    ("bricard_threefold_60_bifurcation", 2),
    ("bricard_threefold_90", 1),
];

type Manner = (&'static str, fn(&Number, i32) -> Number);

const MANNERS: [Manner; 3] = [
    ("decimals", decimal::with_decimals),
    ("decimals without zeros", decimal::with_decimals_stripped),
    ("significant digits", decimal::with_significant),
];

/// Runs a check over every loop in every manner with the numbers of digits given.
fn check(digits: &[i32], wrong: impl Fn(&Mechanism, &Analysis, usize, i32) -> Vec<String> + Sync) {
    let mut cases = Vec::new();
    for (name, freedom) in LOOPS {
        for &digits in digits {
            cases.extend(MANNERS.map(|manner| (name, freedom, digits, manner)));
        }
    }
    let found = in_parallel(&cases, |(name, freedom, digits, (manner, round))| {
        let rounded = Draft::of(&zoo_mechanism(name))
            .each_number(&|n| round(n, *digits))
            .build();
        let found = wrong(&rounded, &analysis(&rounded), *freedom, *digits);
        let told = |w: &String| format!("{name}, {digits} {manner}: {w}");
        found.iter().map(told).collect::<Vec<_>>()
    });
    assert_none(&found.concat());
}

#[test]
fn six_digits_and_more_leave_the_freedom_that_was_meant() {
    check(&[15, 12, 9, 6], |_, analysis, freedom, _| {
        let mut wrong = inconsistencies(analysis);
        let home = analysis.home.as_ref();
        if home.and_then(|h| h.instantaneous) != Some(freedom) {
            wrong.push(format!("{home:?}, expected {freedom}"));
        }
        wrong
    });
}

/// Three or four digits may be too few to tell. Then the answer is open, or comes with a reservation; it is never a plain
/// wrong one.
#[test]
fn few_digits_never_give_a_plain_wrong_answer() {
    check(&[4, 3], |_, analysis, freedom, _| {
        let mut wrong = inconsistencies(analysis);
        let Some(home) = analysis.home.as_ref() else {
            return wrong;
        };
        if home.instantaneous != Some(freedom) {
            if !analysis.parts.iter().any(|part| part.note.is_some()) {
                wrong.push(format!("{home:?} without a reservation"));
            }
            if !(home.candidates.0..=home.candidates.1).contains(&freedom) {
                wrong.push(format!("{home:?} leaves out {freedom}"));
            }
        }
        if analysis.mobility.finite().is_some_and(|found| found != 1) {
            let verdict = analysis.mobility.verdict.word();
            wrong.push(format!("{verdict}, though more digits could say otherwise"));
        }
        wrong
    });
}

/// What has to hold of any analysis of a rounded file.
fn inconsistencies(analysis: &Analysis) -> Vec<String> {
    let mut wrong = Vec::new();
    let assembly = &analysis.assembly;
    if !assembly.closed {
        return vec![format!(
            "does not close: {:.1e} against {:.1e}",
            assembly.residual, assembly.tolerance
        )];
    }
    let home = analysis.home.as_ref().unwrap();
    let possible = home.candidates.0..=home.candidates.1;
    if home.instantaneous.is_some_and(|i| !possible.contains(&i)) {
        wrong.push(format!("{home:?}: the answer is none of the candidates"));
    }
    let noted = analysis.parts.iter().any(|part| part.note.is_some());
    if home.as_written.is_some() && !noted {
        wrong.push(format!("{home:?}: no word on the difference"));
    }
    if home.as_written.is_some() && home.as_written == home.instantaneous {
        wrong.push(format!("{home:?}: a difference that is none"));
    }
    for part in &analysis.parts {
        let decision = &part.decision;
        if decision.rank.is_some() {
            // What was kept stands clear of the tolerance, what was dropped is below it, and a gap separates them.
            let told = decision.kept >= 10.0 * decision.tolerance
                && decision.dropped <= decision.tolerance
                && decision.gap >= 1e3
                && (decision.dropped == 0.0
                    || (decision.gap * decision.dropped / decision.kept - 1.0).abs() < 1e-12);
            if !told {
                wrong.push(format!("the margin does not carry the rank: {decision:?}"));
            }
        }
        if part.note.is_none()
            && part
                .as_written
                .is_some_and(|w| Some(w) != part.instantaneous)
        {
            wrong.push("another reading without a word on it".to_owned());
        }
    }
    wrong
}

/// A rounded loop is drawn where the mobile one stands, closed to within its digits. It stays about there: closing it to the
/// last bit of a double would drive it along its own motion to wherever rounding happens to cancel.
#[test]
fn a_rounded_file_stays_where_it_is_drawn() {
    check(&[15, 12, 9, 6, 4], |_, analysis, _, digits| {
        // The loops are a few metres large: their joints are off by a few dozen roundings at most.
        let allowed = 100.0 * 10f64.powi(-digits);
        let moved = analysis.assembly.moved;
        if moved > allowed {
            return vec![format!("moved by {moved:.1e} m, {allowed:.0e} m would do")];
        }
        Vec::new()
    });
}

/// More digits, less doubt: the tolerance falls with the precision that the digits state.
#[test]
fn the_tolerance_follows_the_digits() {
    for (name, _) in LOOPS {
        let tolerance = |digits: i32| {
            let rounded = Draft::of(&zoo_mechanism(name))
                .each_number(&|n| decimal::with_decimals(n, digits))
                .build();
            analysis(&rounded).parts[0].decision.tolerance
        };
        let ratio = tolerance(6) / tolerance(9);
        assert!(
            (500.0..2000.0).contains(&ratio),
            "{name}: three decimals more make it {ratio} times smaller"
        );
    }
}

/// A planar crank-rocker in a plane turned about two axes, as a file: positions and axes with decimals of their own.
fn turned_four_bar(turn: [f64; 2], positions: usize, axes: usize) -> String {
    let at = |[x, y, z]: [f64; 3], decimals: usize| {
        let ((s, c), (t, d)) = (turn[0].sin_cos(), turn[1].sin_cos());
        let (y, z) = (c * y - s * z, s * y + c * z);
        let (x, z) = (d * x + t * z, d * z - t * x);
        format!("{x:.decimals$} {y:.decimals$} {z:.decimals$}")
    };
    let place = |x: f64, y: f64| at([x, y, 0.0], positions);
    let axis = format!(r#"<axis xyz="{}"/>"#, at([0.0, 0.0, 1.0], axes));
    let tree = |number: u32, parent: &str, child: &str, place: String| {
        format!(
            r#"<joint name="j{number}" type="revolute"><parent link="{parent}"/><child link="{child}"/><origin xyz="{place}"/>{axis}</joint>"#
        )
    };
    let joints = [
        tree(1, "g", "a", place(0.1, 0.2)),
        tree(2, "a", "b", place(0.05, 0.1)),
        tree(3, "g", "c", place(0.5, 0.15)),
    ];
    let (coupler, rocker) = (place(0.4, 0.15), place(0.05, 0.3));
    format!(
        r#"<robot name="turned"><link name="g"/><link name="a"/><link name="b"/><link name="c"/>{}<loop name="j4" type="revolute"><predecessor link="b"><origin xyz="{coupler}"/></predecessor><successor link="c"><origin xyz="{rocker}"/></successor>{axis}</loop></robot>"#,
        joints.concat()
    )
}

/// Every length is within half a unit of its own last place of one that moves, however the axes are printed.
#[test]
fn lengths_and_axes_have_digits_of_their_own() {
    let decimals = [3, 4, 6, 8, 16];
    let pairs: Vec<(usize, usize)> = decimals
        .iter()
        .flat_map(|p| decimals.iter().map(move |a| (*p, *a)))
        .collect();
    let wrong = in_parallel(&pairs, |&(positions, axes)| {
        let turns = [[0.7, 0.4], [-1.1, 0.9], [2.3, -0.6]];
        let other = turns.iter().filter(|turn| {
            let text = turned_four_bar(**turn, positions, axes);
            let read = kutzbach::format::read(&text, "turned.urdf", &[]).unwrap();
            analysis(&read.mechanism).mobility.finite() != Some(1)
        });
        let count = other.count();
        (count > 0).then(|| format!("{positions} and {axes} decimals: {count} of 3"))
    });
    assert_none(&wrong.into_iter().flatten().collect::<Vec<_>>());
}
