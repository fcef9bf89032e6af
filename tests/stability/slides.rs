//! Slides whose directions become parallel.

use super::drawn::{Place, Triple, built, integers, power_of_ten};
use super::ladder::{Ladder, Law, Rung, regular};
use super::offsets::DEEP;
use kutzbach::mechanism::{JointKind, Mechanism};
use kutzbach::number::Number;

const LINKS: [&str; 4] = ["ground", "first", "second", "third"];
const NAMES: [&str; 4] = ["a", "b", "c", "d"];

/// A ring of slides along these directions.
fn ring(name: &str, directions: Vec<Triple>) -> Mechanism {
    let count = directions.len();
    let places: Vec<Place> = directions
        .into_iter()
        .enumerate()
        .map(|(i, along)| {
            // The last one closes the loop.
            let links = if i + 1 == count {
                [LINKS[0], LINKS[i]]
            } else {
                [LINKS[i], LINKS[i + 1]]
            };
            let at = integers(i as i64, (i * i) as i64, 0);
            Place::new(NAMES[i], JointKind::Prismatic, links, at, along)
        })
        .collect();
    built(name, &places)
}

/// Ways of slides add like vectors: the closure equations are linear, so that every pose is regular, and the freedom is the
/// number of slides less the dimension of the space of their directions.
///
/// In a plane three directions span two dimensions, and one where they are parallel. In space four of the form (1, 0 or e,
/// 0 or e) span three, and one where e is zero.
pub fn ladders() -> Vec<Ladder> {
    let plane = |e: &Number| {
        let zero = Number::zero;
        let directions = vec![
            integers(1, 0, 0),
            [Number::one(), e.clone(), zero()],
            [Number::one(), -e, zero()],
        ];
        ring("slides_in_a_plane", directions)
    };
    let space = |e: &Number| {
        let zero = Number::zero;
        let directions = vec![
            integers(1, 0, 0),
            [Number::one(), e.clone(), zero()],
            [Number::one(), zero(), e.clone()],
            [Number::one(), e.clone(), e.clone()],
        ];
        ring("slides_in_space", directions)
    };
    let ladder = |name, build: &dyn Fn(&Number) -> Mechanism, at_limit| {
        let rung = |exponent: u32| {
            let exponent = -(exponent as i32);
            Rung::at(exponent, build(&power_of_ten(exponent)), regular(1))
        };
        let limit = Rung::limit(build(&Number::zero()), regular(at_limit));
        Ladder {
            name,
            parameter: "angles between the directions (rad)",
            // What they span beside their common direction is as long as they are apart.
            law: Some(Law::new(2.0, |decades| decades)),
            rungs: DEEP.into_iter().map(rung).chain([limit]).collect(),
        }
    };
    vec![
        ladder("slides_in_a_plane", &plane, 2),
        ladder("slides_in_space", &space, 3),
    ]
}
