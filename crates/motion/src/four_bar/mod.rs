//! Four-bar linkages: which of their links turn fully, how far the others swing, and the transmission angle.
//!
//! Four revolute joints with parallel axes in a ring, one of whose links is the ground. Seen along the axes it is a
//! quadrilateral of ground g, input a, coupler c and output b; everything follows from the triangle that its diagonal d, between
//! the far ends of a ground link and of the ground, makes on either side. A ground link of length a turns fully where every d from
//! |g − a| to g + a closes a triangle with b and c; otherwise it stops where b and c are in line. Source: Grashof's criterion as in
//! J. J. Uicker, G. R. Pennock, J. E. Shigley, Theory of Machines and Mechanisms, chapter 1. What limits leave of that is followed from
//! the pose drawn (`reach.rs`).

mod found;
mod reach;

pub use found::four_bars;

use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Lengths that differ by less, in parts of the longest, are equal: a change point is one to rounding.
const EQUAL: f64 = 1e-9;

/// A four-bar linkage on the ground.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FourBar {
    /// Ground, input, coupler and output. The input is the link that turns fully where there is one only.
    pub links: [String; 4],
    /// Lengths of these, between their joints, seen along the axes (m).
    pub lengths: [f64; 4],
    /// By Grashof's criterion.
    pub class: GrashofClass,
    /// What the two links on the ground do, within the limits of the four joints.
    pub kind: FourBarKind,
    /// What they would do without limits; `null` where no limit stops them.
    #[serde(default)]
    pub without_limits: Option<FourBarKind>,
    /// The joints whose limits stop it.
    #[serde(default)]
    pub stopped_by: Vec<String>,
    /// Whether other joints hold its links as well: other loops may stop it, of which nothing is said here.
    #[serde(default)]
    pub within_larger: bool,
    /// Input and output.
    pub swings: [Swing; 2],
    /// Least and greatest angle between coupler and output (rad), of all that the input reaches: 0 or π where it stops.
    pub transmission: [f64; 2],
}

/// Grashof's criterion, on the shortest and longest link beside the two others.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum GrashofClass {
    /// Shortest and longest are together shorter than the others: the shortest turns fully against all.
    Grashof,
    /// They are as long: all four can be in line.
    ChangePoint,
    /// They are longer: no link turns fully against another.
    NonGrashof,
}

/// What the links on the ground do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FourBarKind {
    /// One turns fully, the other swings.
    CrankRocker,
    /// Both turn fully.
    DoubleCrank,
    /// Both swing.
    DoubleRocker,
}

impl FourBarKind {
    /// In words.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::CrankRocker => "crank-rocker",
            Self::DoubleCrank => "double-crank (drag link)",
            Self::DoubleRocker => "double-rocker",
        }
    }
}

/// How far a link on the ground goes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Swing {
    /// The link.
    pub link: String,
    /// Its joint on the ground.
    pub joint: String,
    /// Its extreme positions, as angles from the line to the ground's other joint, to either side (rad); `null` where it turns
    /// fully.
    pub extremes: Option<[f64; 2]>,
}

/// A link that swings by no more (rad) is at rest: the others are stretched to their full length.
const AT_REST: f64 = 1e-6;

impl FourBar {
    /// Whether a link can turn at all.
    fn turns(&self) -> bool {
        let swings = |one: &Swing| one.extremes.is_none_or(|[from, to]| to - from > AT_REST);
        self.swings.iter().any(swings)
    }
}

impl FourBar {
    /// Of ground, input, coupler and output, with the ground's joints of input and output. The two are exchanged where only the
    /// output turns fully.
    fn new(links: [String; 4], lengths: [f64; 4], joints: [String; 2]) -> Self {
        let [g, a, c, b] = lengths;
        let [ground, input, coupler, output] = links;
        let [on_input, on_output] = joints;
        let turns = extremes(g, a, c, b).is_none();
        if !turns && extremes(g, b, c, a).is_none() {
            let links = [ground, output, coupler, input];
            return Self::new(links, [g, b, c, a], [on_output, on_input]);
        }
        let swing = |link: &String, joint, extremes| Swing {
            link: link.clone(),
            joint,
            extremes,
        };
        let swings = [
            swing(&input, on_input, extremes(g, a, c, b)),
            swing(&output, on_output, extremes(g, b, c, a)),
        ];
        let kind = kind(&swings);
        let [least, greatest] = diagonals(g, a, c, b);
        Self {
            class: class(&lengths),
            kind,
            without_limits: None,
            stopped_by: Vec::new(),
            within_larger: false,
            transmission: [angle(b, c, least), angle(b, c, greatest)],
            swings,
            lengths,
            links: [ground, input, coupler, output],
        }
    }
}

fn kind(swings: &[Swing; 2]) -> FourBarKind {
    match swings.each_ref().map(|swing| swing.extremes.is_none()) {
        [true, true] => FourBarKind::DoubleCrank,
        [false, false] => FourBarKind::DoubleRocker,
        _ => FourBarKind::CrankRocker,
    }
}

fn class(lengths: &[f64; 4]) -> GrashofClass {
    let mut sorted = *lengths;
    sorted.sort_by(f64::total_cmp);
    let [shortest, p, q, longest] = sorted;
    let spare = p + q - shortest - longest;
    match spare.abs() <= EQUAL * longest {
        true => GrashofClass::ChangePoint,
        false if spare > 0.0 => GrashofClass::Grashof,
        false => GrashofClass::NonGrashof,
    }
}

/// Least and greatest distance between the far ends of the link `a` and of the ground.
fn diagonals(g: f64, a: f64, c: f64, b: f64) -> [f64; 2] {
    let least = (g - a).abs().max((b - c).abs());
    [least, (g + a).min(b + c)]
}

/// Extreme positions of the link `a`; `None` where it turns fully.
fn extremes(g: f64, a: f64, c: f64, b: f64) -> Option<[f64; 2]> {
    let longest = g.max(a).max(b).max(c);
    let [least, greatest] = diagonals(g, a, c, b);
    let through_zero = least <= (g - a).abs() + EQUAL * longest;
    let through_half = greatest >= g + a - EQUAL * longest;
    let (near, far) = (angle(g, a, least), angle(g, a, greatest));
    match (through_zero, through_half) {
        (true, true) => None,
        (true, false) => Some([-far, far]),
        (false, true) => Some([near, 2.0 * PI - near]),
        (false, false) => Some([near, far]),
    }
}

/// The angle between two sides of a triangle, opposite the third (rad).
fn angle(one: f64, other: f64, opposite: f64) -> f64 {
    let cosine = (one * one + other * other - opposite * opposite) / (2.0 * one * other);
    cosine.clamp(-1.0, 1.0).acos()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(lengths: [f64; 4]) -> FourBar {
        let name = |name: &str| name.to_owned();
        let links = [name("g"), name("a"), name("c"), name("b")];
        FourBar::new(links, lengths, [name("A"), name("B")])
    }

    #[test]
    fn the_shortest_link_decides_the_inversion() {
        let cases = [
            ([5.0, 2.0, 4.0, 4.0], FourBarKind::CrankRocker),
            ([2.0, 4.0, 5.0, 4.0], FourBarKind::DoubleCrank),
            ([5.0, 4.0, 2.0, 4.0], FourBarKind::DoubleRocker),
        ];
        for (lengths, kind) in cases {
            assert_eq!(
                (of(lengths).class, of(lengths).kind),
                (GrashofClass::Grashof, kind)
            );
        }
        let rocking = of([6.0, 2.0, 3.0, 3.0]);
        assert_eq!(
            (rocking.class, rocking.kind),
            (GrashofClass::NonGrashof, FourBarKind::DoubleRocker)
        );
        assert_eq!(of([3.0, 2.0, 3.0, 2.0]).class, GrashofClass::ChangePoint);
    }

    #[test]
    fn the_input_is_the_link_that_turns() {
        let turned = of([5.0, 4.0, 4.0, 2.0]);
        assert_eq!(turned.links[1], "b");
        assert_eq!(turned.swings[0].joint, "B");
        assert!(turned.swings[0].extremes.is_none());
    }

    #[test]
    fn a_stretched_chain_of_links_does_not_turn() {
        assert!(!of([6.0, 2.0, 1.0, 3.0]).turns());
        assert!(of([5.9, 2.0, 1.0, 3.0]).turns());
    }

    #[test]
    fn right_triangles_have_right_angles() {
        // The crank in line with the ground: 3, 4 and 5 at one end.
        let bar = of([4.0, 1.0, 3.0, 4.0]);
        let [_, greatest] = bar.transmission;
        assert!((greatest - PI / 2.0).abs() < 1e-15);
    }
}
