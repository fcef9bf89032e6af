use super::*;
use crate::collection::{samples, samples::random_collection, standard};
use crate::tree::optimal_incidence_tree;
use kutzbach_math::matrix::SplitMix64;

fn selection(collection: &Collection) -> (IncidenceTree, Selection) {
    let tree = optimal_incidence_tree(collection, &[], |_| true).unwrap();
    let selected = well_formed(collection, &tree);
    (tree, selected)
}

/// The sum over all sets of bodies, as it is defined.
fn by_definition(collection: &Collection, bodies: &[usize]) -> i64 {
    let all = 1..1_u32 << bodies.len();
    all.filter(|set| set.count_ones() > 1)
        .map(|set| {
            let chosen = (0..bodies.len()).filter(|k| set >> k & 1 == 1);
            let sets: Vec<&Vec<usize>> = chosen
                .map(|k| &collection.bodies()[bodies[k]].points)
                .collect();
            let common = sets[0]
                .iter()
                .filter(|p| sets.iter().all(|s| s.contains(p)));
            let freedom = match common.count() {
                0 => 0,
                1 => 3,
                _ => 5,
            };
            if set.count_ones() % 2 == 0 {
                freedom
            } else {
                -freedom
            }
        })
        .sum()
}

/// The rank of incidences at generic places: for each some directions along which the copies of a point coincide, as equations in the
/// velocities of the bodies.
fn rank(incidences: &[Seam], seed: u64) -> usize {
    let mut random = SplitMix64::new(seed);
    let mut number = || (random.next_u64() % 1_000_003) as i64 - 500_001;
    let mut places: BTreeMap<usize, [i64; 3]> = BTreeMap::new();
    let mut found = Elimination::default();
    for seam in incidences {
        let p = *places
            .entry(seam.point)
            .or_insert_with(|| [number(), number(), number()]);
        for _ in 0..seam.equations {
            let d = [number(), number(), number()];
            // d · (t + ω × p) = d · t + (p × d) · ω
            let turn = [
                p[1] * d[2] - p[2] * d[1],
                p[2] * d[0] - p[0] * d[2],
                p[0] * d[1] - p[1] * d[0],
            ];
            let side = |body: usize, sign: i64| {
                let all = d.iter().chain(&turn).enumerate();
                all.map(move |(k, x)| (6 * body + k, sign * x))
                    .collect::<Vec<_>>()
            };
            let [one, other] = seam.bodies;
            found.add(&[side(one, 1), side(other, -1)].concat());
        }
    }
    found.rank()
}

fn all_incidences(collection: &Collection, bodies: &[usize]) -> Vec<Seam> {
    let graph = SeamGraph::of(collection, bodies);
    let whole = |(point, bodies)| Seam {
        point,
        bodies,
        equations: 3,
        of_tree: false,
    };
    graph.point_edges().map(whole).collect()
}

/// The three properties of definition 4: no local cycle; no more equations among any bodies than sharing points removes
/// freedoms there; as many among all. And what they are for: the equations are independent, and imply all others.
fn check(collection: &Collection, name: &str) {
    let (tree, selected) = selection(collection);
    let bodies = &tree.cover;
    let mut together: BTreeMap<usize, UnionFind<usize>> = BTreeMap::new();
    for seam in &selected.seams {
        let copies = together
            .entry(seam.point)
            .or_insert_with(|| UnionFind::new(collection.bodies().len()));
        assert!(
            copies.union(seam.bodies[0], seam.bodies[1]),
            "{name}: a local cycle"
        );
    }
    for set in 1..1_u32 << bodies.len() {
        let chosen: Vec<usize> = (0..bodies.len())
            .filter(|k| set >> k & 1 == 1)
            .map(|k| bodies[k])
            .collect();
        let inside = selected.seams.iter();
        let inside = inside.filter(|s| s.bodies.iter().all(|b| chosen.contains(b)));
        let equations: usize = inside.map(|s| s.equations).sum();
        let removed = by_definition(collection, &chosen);
        assert_eq!(removed, removed_freedoms(collection, &chosen), "{name}");
        assert!(
            equations as i64 <= removed,
            "{name}: {equations} of {removed}"
        );
    }
    assert_eq!(selected.equations() as i64, selected.removed, "{name}");
    let whole = rank(&all_incidences(collection, bodies), 3);
    assert_eq!(rank(&selected.seams, 5), selected.equations(), "{name}");
    assert_eq!(whole, selected.equations(), "{name}");
    // The tree's own edges are among them, with five equations for two points and three for one.
    let of_tree = selected.seams.iter().filter(|s| s.of_tree);
    let of_tree: usize = of_tree.map(|s| s.equations).sum();
    let placed: usize = tree.edges.iter().map(|e| 6 - e.weight).sum();
    assert_eq!(of_tree, placed, "{name}");
}

#[test]
fn the_problems_of_the_papers_have_well_formed_selections() {
    let four_in_a_ring = samples::collection(
        &[
            ("c1", "1 2 5 a"),
            ("c2", "1 2 3 b"),
            ("c3", "3 4 6 c"),
            ("c4", "4 6 5 d"),
        ],
        &[],
    );
    for (name, collection) in [
        ("tetra", samples::tetra_whole()),
        ("pent", samples::pent_whole()),
        ("quad", samples::quad_whole()),
        ("four in a ring", four_in_a_ring.clone()),
    ] {
        check(&collection, name);
    }
    // Second paper, example 2: 5 + 3 + 5 + 3, where a rigid collection of four bodies has 18.
    assert_eq!(removed_freedoms(&four_in_a_ring, &[0, 1, 2, 3]), 16);
    assert_eq!(selection(&four_in_a_ring).1.equations(), 16);
}

#[test]
fn a_thousand_standard_collections_have_well_formed_selections() {
    let mut random = SplitMix64::new(35);
    let (mut checked, mut rings) = (0, 0);
    while checked < 1000 {
        let Some(collection) = random_collection(&mut random) else {
            continue;
        };
        if !standard(&collection).holds(&collection)
            || optimal_incidence_tree(&collection, &[], |_| true).is_none()
        {
            continue;
        }
        let graph = SeamGraph::of(
            &collection,
            &(0..collection.bodies().len()).collect::<Vec<_>>(),
        );
        rings += usize::from(graph.pairs.len() >= 3);
        check(&collection, &format!("{collection:?}"));
        checked += 1;
    }
    assert!(rings > 50, "{rings} with three shared pairs or more");
}
