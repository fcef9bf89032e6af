//! Random mechanisms with whole-number coordinates: small numbers make many of them singular.

use super::drawn;
use kutzbach::matrix::SplitMix64;
use kutzbach::mechanism::Mechanism;
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// Where all joints are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Parallel hinges on one line across them.
    Line,
    /// Parallel hinges in a plane.
    Plane,
    /// Hinges whose axes meet in one point.
    Sphere,
    /// Hinges, sliders, sleeves and balls at points of a small cube, along its edges and diagonals.
    Space,
}

/// Links beside the ground, at least and at most.
const LINKS: [u64; 2] = [3, 6];

/// A connected mechanism with one to three loops, drawn by the number of the case.
pub fn random(case: u64) -> (String, Mechanism) {
    let place = [Place::Line, Place::Plane, Place::Sphere, Place::Space][(case % 4) as usize];
    let mut random = SplitMix64::new(0x5EED_0000 + case);
    let mut below = |most: u64| random.next_u64() % most;
    let links = LINKS[0] + below(LINKS[1] - LINKS[0] + 1);
    let loops = 1 + below(3);
    let name = |link: u64| match link {
        0 => "g".to_owned(),
        link => format!("b{link}"),
    };
    let mut ends: Vec<[u64; 2]> = (1..=links).map(|link| [below(link), link]).collect();
    for _ in 0..loops {
        let one = below(links + 1);
        ends.push([one, (one + 1 + below(links)) % (links + 1)]);
    }
    let mut text = format!("= whole_{case} 0 0 0 - - - : drawn at random\n");
    let mut taken: BTreeSet<([u64; 2], [i64; 3])> = BTreeSet::new();
    let mut joints = 0;
    for [one, other] in ends {
        let mut coordinate = |size: i64| below(2 * size as u64 + 1) as i64 - size;
        let at = match place {
            Place::Line => [coordinate(3), 0, 0],
            Place::Plane => [coordinate(2), coordinate(2), 0],
            Place::Sphere => [coordinate(2), coordinate(2), coordinate(2)],
            Place::Space => [coordinate(1), coordinate(1), coordinate(1)],
        };
        let along = [coordinate(1), coordinate(1), coordinate(1)];
        let pair = [one.min(other), one.max(other)];
        // Twice the same hinge is one.
        if !taken.insert((pair, at)) {
            continue;
        }
        let (point, axis) = match place {
            Place::Sphere if at == [0; 3] => (at, [0, 0, 1]),
            Place::Sphere => ([0; 3], at),
            Place::Space if along != [0; 3] => (at, along),
            _ => (at, [0, 0, 1]),
        };
        let kind = match place {
            Place::Space => ["R", "R", "R", "P", "C", "S"][below(6) as usize],
            _ => "R",
        };
        let _ = write!(text, "J{joints} {kind} {} {}", name(one), name(other));
        let axis = if kind == "S" { &[][..] } else { &axis[..] };
        point.iter().chain(axis).for_each(|x| {
            let _ = write!(text, " {x}");
        });
        text.push('\n');
        joints += 1;
    }
    let drawn = drawn::read(&text).remove(0);
    (drawn.name.clone(), drawn.mechanism())
}
