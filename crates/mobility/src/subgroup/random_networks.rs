//! Subgroups on random networks, against a closure of bounds of their own and against the mechanism moved.

use super::tests::{Between, answer, finding, findings, network};
use super::*;
use crate::chart::{ChartOutcome, Kernel, chart_test};
use crate::part_samples::{Posed, fresh};
use kutzbach_math::group::{Gauge, Subalgebra, Twist};
use kutzbach_math::matrix::SplitMix64;
use kutzbach_model::mechanism::JointKind::{self, *};
use nalgebra::Vector3;

/// 600 have been tried.
const NETWORKS: u64 = 60;

const NAMES: [&str; 8] = ["j0", "j1", "j2", "j3", "j4", "j5", "j6", "j7"];
const LINKS: [&str; 5] = ["a", "b", "c", "d", "e"];

/// Lines that are parallel, meet, or do neither.
const LINES: [([f64; 3], [f64; 3]); 7] = [
    ([0.0, 0.0, 0.0], [0.0, 0.0, 1.0]),
    ([2.0, 1.0, 0.0], [0.0, 0.0, 1.0]),
    ([-1.0, 3.0, 1.0], [0.0, 0.0, 1.0]),
    ([0.0, 0.0, 0.0], [1.0, 0.0, 0.0]),
    ([0.0, 0.0, 0.0], [1.0, 2.0, 2.0]),
    ([3.0, 1.0, 2.0], [1.0, 2.0, 2.0]),
    ([1.0, -2.0, 3.0], [3.0, -1.0, 1.0]),
];

/// Joints on some of the lines, between links that all hang together.
fn drawn(seed: u64) -> Vec<Between<'static>> {
    let mut random = SplitMix64::new(seed);
    let mut below = |count: usize| (random.next_u64() % count as u64) as usize;
    let links = 3 + below(3);
    let joints = links + below(3);
    let kinds = [
        Revolute,
        Revolute,
        Revolute,
        Prismatic,
        Cylindrical,
        Cylindrical,
        Planar,
        Spherical,
    ];
    (0..joints)
        .map(|number| {
            let to = if number + 1 < links {
                number + 1
            } else {
                below(links)
            };
            let from = if number + 1 < links {
                below(to)
            } else {
                (to + 1 + below(links - 1)) % links
            };
            let kind = kinds[below(kinds.len())];
            let (at, along) = LINES[below(LINES.len())];
            (NAMES[number], kind, LINKS[from], LINKS[to], at, along)
        })
        .collect()
}

fn group(kind: JointKind, at: [f64; 3], along: [f64; 3], gauge: &Gauge) -> Subalgebra {
    let (at, along) = (Vector3::from(at), Vector3::from(along));
    let turn = Twist::revolute(along, at);
    let slide = Twist::prismatic(along);
    let other = along.cross(&Vector3::new(0.3, 0.7, -0.2));
    let twists = match kind {
        Revolute => vec![turn],
        Prismatic => vec![slide],
        Cylindrical => vec![turn, slide],
        Planar => vec![
            turn,
            Twist::prismatic(other),
            Twist::prismatic(along.cross(&other)),
        ],
        _ => (0..3)
            .map(|i| Twist::revolute(Vector3::ith(i, 1.0), at))
            .collect(),
    };
    Subalgebra::generated_by(&twists, gauge).unwrap()
}

/// The finite mobility, where bounds between all links, each made smaller by every third, give it from above as the sum over a tree, and
/// from below because every joint allows all that the tree's way between its links generates.
fn by_own_closure(joints: &[Between]) -> Option<usize> {
    let gauge = Gauge::new(Vector3::zeros(), 2.0, 1e-12).unwrap();
    let number = |link: &str| LINKS.iter().position(|other| *other == link).unwrap();
    let links = 1 + joints
        .iter()
        .map(|j| number(j.2).max(number(j.3)))
        .max()
        .unwrap();
    let everything =
        Subalgebra::generated_by_system(&kutzbach_math::group::ScrewSystem::full(&gauge)).unwrap();
    let mut bound = vec![vec![everything; links]; links];
    let groups: Vec<Subalgebra> = joints
        .iter()
        .map(|j| group(j.1, j.4, j.5, &gauge))
        .collect();
    for (joint, group) in joints.iter().zip(&groups) {
        let (a, b) = (number(joint.2), number(joint.3));
        let both = bound[a][b].intersection(group).unwrap();
        bound[a][b] = both.clone();
        bound[b][a] = both;
    }
    loop {
        let mut news = false;
        for i in 0..links {
            for j in 0..links {
                for k in 0..links {
                    if i == j || j == k || k == i {
                        continue;
                    }
                    let through = bound[i][k].join(&bound[k][j]).unwrap();
                    let both = bound[i][j].intersection(&through).unwrap();
                    if both.dimension() < bound[i][j].dimension() {
                        bound[i][j] = both.clone();
                        bound[j][i] = both;
                        news = true;
                    }
                }
            }
        }
        if !news {
            break;
        }
    }
    // The tree of least dimension, and for each link the way from the first.
    let mut way: Vec<Option<Vec<(usize, usize)>>> = vec![None; links];
    way[0] = Some(Vec::new());
    let mut sum = 0;
    while way.iter().any(Option::is_none) {
        let reached = (0..links).filter(|i| way[*i].is_some());
        let (dimension, from, to) = reached
            .flat_map(|i| (0..links).map(move |j| (i, j)))
            .filter(|(_, j)| way[*j].is_none())
            .map(|(i, j)| (bound[i][j].dimension(), i, j))
            .min()
            .unwrap();
        sum += dimension;
        let mut longer = way[from].clone().unwrap();
        longer.push((from, to));
        way[to] = Some(longer);
    }
    let allowed = joints.iter().zip(&groups).all(|(joint, group)| {
        let [one, two] = [joint.2, joint.3].map(|link| way[number(link)].clone().unwrap());
        let between = one
            .iter()
            .filter(|step| !two.contains(step))
            .chain(two.iter().filter(|step| !one.contains(step)));
        between
            .map(|(a, b)| bound[*a][*b].clone())
            .reduce(|sum, next| sum.join(&next).unwrap())
            .is_none_or(|all| all.system().is_within(group.system()).unwrap())
    });
    allowed.then_some(sum)
}

#[test]
fn what_is_found_is_what_moves() {
    let (mut decided, mut known, mut open) = (0, 0, 0);
    for seed in 0..NETWORKS {
        let joints = drawn(seed);
        let mechanism = network(&joints);
        let posed = Posed::new(mechanism);
        let own = by_own_closure(&joints);
        let found = findings(&posed.mechanism);
        let free: usize = posed
            .structure
            .free_joints
            .iter()
            .map(|joint| posed.mechanism.joints()[*joint].freedom())
            .sum();
        let all: Option<usize> = found.iter().map(|found| found.finite).sum();
        let lower: usize = found.iter().map(|found| found.lower).sum();
        if let Some(own) = own {
            known += 1;
            assert_eq!(
                all.map(|all| all + free),
                Some(own),
                "network {seed}: {joints:?}"
            );
        }
        let upper: Option<usize> = found.iter().map(|found| found.upper).sum();
        assert!(upper.is_none_or(|upper| lower <= upper), "network {seed}");
        // The first part, moved.
        let Some(finite) = found.first().and_then(|found| found.finite) else {
            open += 1;
            continue;
        };
        let rank = posed.rank();
        assert_eq!(Some(finite), rank.instantaneous, "network {seed}");
        decided += 1;
        let kernel = Kernel::of(&posed.pose(), &rank, 64).unwrap().unwrap();
        if finite > 0 {
            let test =
                chart_test(&posed.pose(), &mut fresh(), posed.part(), &rank, &kernel).unwrap();
            assert!(
                !matches!(test.outcome, ChartOutcome::Singular { .. }),
                "network {seed}: {joints:?}: {test:?}"
            );
        }
    }
    // Most have bounds that meet, and few are left open.
    assert!(
        known >= NETWORKS * 3 / 4 && open <= NETWORKS / 20 && decided > known / 2,
        "{:?}",
        (decided, known, open)
    );
}

const Z: [f64; 3] = [0.0, 0.0, 1.0];
const EXCEPTIONAL: Option<MobilityClass> = Some(MobilityClass::Exceptional);

/// Two jaws in a frame and on each other, a pin through all: four links, each joined to each other, all by cylinders. The pin fixes each jaw in
/// the frame, since its axis is not that of their cylinders, and keeps both its freedoms.
#[test]
fn cylinders_along_six_edges_of_a_tetrahedron() {
    let found = finding(&network(&[
        (
            "frame_one",
            Cylindrical,
            "frame",
            "one",
            [0.0, 1.0, 0.0],
            [2.0, 1.0, 3.0],
        ),
        (
            "frame_two",
            Cylindrical,
            "frame",
            "two",
            [4.0, -1.0, 0.0],
            [1.0, -2.0, 1.0],
        ),
        (
            "one_two",
            Cylindrical,
            "one",
            "two",
            [1.0, 1.0, 2.0],
            [3.0, 1.0, -1.0],
        ),
        ("frame_pin", Cylindrical, "frame", "pin", [2.0, 1.0, 0.0], Z),
        ("one_pin", Cylindrical, "one", "pin", [2.0, 1.0, 1.0], Z),
        ("two_pin", Cylindrical, "two", "pin", [2.0, 1.0, 3.0], Z),
    ]));
    assert_eq!(answer(&found), (Some(2), EXCEPTIONAL), "{}", found.text);
    assert_eq!(found.steps.len(), 3, "{:?}", found.steps);
}

/// Three links in a plane, each joined to three others (K3,3): what a cylinder, a ball and a plane of another direction leave in
/// it is a hinge, a hinge and a slide.
#[test]
fn planar_bodies_of_a_complete_bipartite_network() {
    let found = finding(&network(&[
        ("ad", Revolute, "a", "d", [0.0, 0.0, 0.0], Z),
        ("ae", Planar, "a", "e", [0.0, 0.0, 0.0], Z),
        ("af", Revolute, "a", "f", [4.0, 1.0, 0.0], Z),
        ("bd", Revolute, "b", "d", [1.0, 3.0, 1.0], Z),
        ("be", Spherical, "b", "e", [2.0, 5.0, 1.0], Z),
        ("bf", Planar, "b", "f", [0.0, 0.0, 0.0], Z),
        ("cd", Cylindrical, "c", "d", [-2.0, 4.0, 0.0], Z),
        ("ce", Prismatic, "c", "e", [0.0, 0.0, 0.0], [3.0, 1.0, 0.0]),
        ("cf", Spherical, "c", "f", [3.0, -4.0, 2.0], Z),
    ]));
    // Seven joints of one freedom and two planar ones, four cycles with three equations each.
    assert_eq!(answer(&found), (Some(1), EXCEPTIONAL), "{}", found.text);
}

/// The same of motions about a point: a ball elsewhere leaves a hinge through both centres.
#[test]
fn spherical_bodies_along_six_edges_of_a_tetrahedron() {
    let o = [0.0; 3];
    let found = finding(&network(&[
        ("ab", Revolute, "a", "b", o, [1.0, 2.0, 3.0]),
        ("ac", Spherical, "a", "c", o, Z),
        ("ad", Revolute, "a", "d", o, [2.0, -1.0, 1.0]),
        ("bc", Spherical, "b", "c", [2.0, 1.0, -3.0], Z),
        ("bd", Spherical, "b", "d", o, Z),
        ("cd", Cylindrical, "c", "d", o, [1.0, -1.0, 4.0]),
    ]));
    assert_eq!(answer(&found), (Some(1), EXCEPTIONAL), "{}", found.text);
}

/// A four-bar closed by a ball, beside a link that a slide and a hinge hold between them.
#[test]
fn what_stands_still_is_no_link_of_its_own() {
    let found = finding(&network(&[
        ("a1", Revolute, "a", "b", [0.0, 0.0, 0.0], Z),
        ("a2", Revolute, "b", "c", [1.0, 2.0, 0.0], Z),
        ("a3", Revolute, "c", "d", [4.0, 3.0, 0.0], Z),
        ("a4", Spherical, "d", "e", [5.0, 0.0, 0.0], Z),
        ("s1", Prismatic, "a", "e", [0.0, 0.0, 0.0], [1.0, 2.0, 2.0]),
        ("s2", Revolute, "e", "a", [0.0, 0.0, 0.0], [2.0, 0.0, 1.0]),
    ]));
    assert_eq!(answer(&found), (Some(1), EXCEPTIONAL), "{}", found.text);
}

/// Two rods and a bar, linked by balls on one line: both rods spin, and the bar is no third.
#[test]
fn what_turns_as_a_whole_is_no_freedom_of_its_own() {
    let found = finding(&network(&[
        ("left", Spherical, "bar", "one", [0.0; 3], Z),
        ("middle", Spherical, "one", "two", [2.0, 0.0, 0.0], Z),
        ("right", Spherical, "two", "bar", [5.0, 0.0, 0.0], Z),
    ]));
    assert_eq!((found.finite, found.lower), (None, 2), "{}", found.text);
}

/// A cylinder whose slide lies in the plane at its one end, and whose turn belongs to the ball at the other: either order of both may be needed.
#[test]
fn a_cylinder_is_taken_apart_in_both_orders() {
    for [from, to] in [["a", "b"], ["b", "a"]] {
        let found = finding(&network(&[
            ("ball", Spherical, "a", "c", [0.0; 3], Z),
            ("plane", Planar, "c", "b", [2.0, 1.0, 0.0], Z),
            ("cylinder", Cylindrical, from, to, [0.0; 3], [1.0, 0.0, 0.0]),
        ]));
        assert_eq!(answer(&found), (Some(3), EXCEPTIONAL), "{}", found.text);
    }
}
