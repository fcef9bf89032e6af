//! The three problems of Sitharam, Peters and Zhou, by the names of their points.

use super::{Bar, Body, Collection};
use kutzbach_math::matrix::SplitMix64;

/// The points of every body by name, bodies as strings such as `A B g1 d1`.
pub(crate) fn names(collection: &Collection) -> Vec<String> {
    let set = |body: &Body| {
        let mut names: Vec<&str> = body
            .points
            .iter()
            .map(|&p| collection.points()[p].as_str())
            .collect();
        names.sort_unstable();
        names.join(" ")
    };
    collection.bodies().iter().map(set).collect()
}

/// A collection from bodies written as the names of their points.
pub(crate) fn collection(bodies: &[(&str, &str)], bars: &[&str]) -> Collection {
    let mut points: Vec<String> = Vec::new();
    let mut index = |name: &str| match points.iter().position(|p| p == name) {
        Some(found) => found,
        None => {
            points.push(name.to_owned());
            points.len() - 1
        }
    };
    let bodies = bodies
        .iter()
        .map(|(name, set)| Body {
            name: (*name).to_owned(),
            points: set.split(' ').map(&mut index).collect(),
        })
        .collect();
    let bars = bars
        .iter()
        .map(|ends| {
            let mut both = ends.split(' ').map(&mut index);
            Bar {
                name: (*ends).to_owned(),
                ends: [both.next().unwrap_or(0), both.next().unwrap_or(0)],
            }
        })
        .collect();
    match Collection::new(points, bodies, bars) {
        Ok(collection) => collection,
        Err(error) => panic!("{error}"),
    }
}

const TETRA: [(&str, &str); 7] = [
    ("c1", "A B d1 g1"),
    ("c2", "B C d2 g2"),
    ("c3", "A C d3 g3"),
    ("c4", "A B C"),
    ("c5", "B d2 g1"),
    ("c6", "C d3 g2"),
    ("c7", "A d1 g3"),
];

const PENT: [(&str, &str); 6] = [
    ("c1", "0 1 2 3"),
    ("c2", "2 3 4 5"),
    ("c3", "5 6 7 8"),
    ("c4", "0 7 8 9"),
    ("c5", "0 1 9"),
    ("c6", "4 5 6"),
];

const QUAD: [(&str, &str); 9] = [
    ("c1", "a b p1"),
    ("c2", "b c p2"),
    ("c3", "c d p3"),
    ("c4", "a d p4"),
    ("c5", "a b c d"),
    ("k1", "b p1 p2"),
    ("k2", "c p2 p3"),
    ("k3", "d p3 p4"),
    ("k4", "a p1 p4"),
];

fn sets(problem: &[(&str, &str)]) -> Vec<String> {
    problem.iter().map(|(_, set)| (*set).to_owned()).collect()
}

/// Three tetrahedra in a ring with three bars, and the four triangles that they imply.
pub(crate) fn tetra() -> Vec<String> {
    sets(&TETRA)
}

/// Five bodies in a ring with a bar, and the triangle that it implies.
pub(crate) fn pent() -> Vec<String> {
    sets(&PENT)
}

/// A square with four triangles on its sides and four bars, and the four triangles that they imply.
pub(crate) fn quad() -> Vec<String> {
    sets(&QUAD)
}

pub(crate) fn tetra_whole() -> Collection {
    collection(&TETRA, &[])
}

pub(crate) fn pent_whole() -> Collection {
    collection(&PENT, &[])
}

pub(crate) fn quad_whole() -> Collection {
    collection(&QUAD, &[])
}

pub(crate) fn tetra_as_drawn() -> Collection {
    collection(&TETRA[..3], &["g1 d2", "g2 d3", "g3 d1"])
}

pub(crate) fn tetra_in_parts() -> Collection {
    let bodies = [
        TETRA[0],
        ("c21", "B d2 g2"),
        ("c22", "C d2 g2"),
        TETRA[2],
        TETRA[3],
    ];
    collection(&bodies, &["g1 d2", "g2 d3", "g3 d1"])
}

pub(crate) fn pent_as_drawn() -> Collection {
    collection(&PENT[..5], &["4 6"])
}

pub(crate) fn quad_as_drawn() -> Collection {
    collection(&QUAD[..5], &["p1 p2", "p2 p3", "p3 p4", "p4 p1"])
}

/// Bodies of three to five points of a few, no two with more than two in common.
pub(crate) fn random_collection(random: &mut SplitMix64) -> Option<Collection> {
    let mut below = |most: usize| (random.next_u64() % most as u64) as usize;
    let count = 3 + below(4);
    let points = count + 2 + below(5);
    let mut bodies: Vec<Vec<usize>> = Vec::new();
    for _ in 0..count {
        let mut own: Vec<usize> = Vec::new();
        for _ in 0..3 + below(3) {
            own.push(below(points));
        }
        own.sort_unstable();
        own.dedup();
        let fits = |other: &Vec<usize>| own.iter().filter(|p| other.contains(p)).count() <= 2;
        (own.len() >= 3 && bodies.iter().all(fits)).then(|| bodies.push(own.clone()))?;
    }
    let names = (0..points).map(|i| format!("p{i}")).collect();
    let bodies = bodies.into_iter().enumerate().map(|(i, points)| Body {
        name: format!("b{i}"),
        points,
    });
    Collection::new(names, bodies.collect(), Vec::new()).ok()
}
