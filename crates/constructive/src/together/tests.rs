use super::*;
use crate::analysis::s_tree;
use crate::samples::{Random, named};

/// Points at random whole coordinates, with the distances that they have: the square roots of whole numbers.
fn drawn(edges: &[[usize; 2]], points: usize, random: &mut Random) -> Sketch {
    loop {
        let places: Vec<[i64; 2]> = (0..points)
            .map(|_| [0, 1].map(|_| random.below(21) as i64 - 10))
            .collect();
        let value = |[u, v]: [usize; 2]| {
            let [x, y] = [0, 1].map(|k| places[u][k] - places[v][k]);
            Number::integer(x * x + y * y).sqrt().unwrap()
        };
        let constraints = edges.iter().map(|&ends| Constraint {
            ends,
            value: value(ends),
        });
        let elements = places.iter().map(|p| Element::Point(p.map(|x| x as f64)));
        if let Ok(sketch) = Sketch::new(elements.collect(), constraints.collect()) {
            return sketch;
        }
    }
}

fn solved(sketch: &Sketch) -> Together {
    together(sketch, &s_tree(sketch.graph()))
}

/// Largest deviation of a solution from the constraints of its core.
fn residual(sketch: &Sketch, core: &Core, placed: &Placed) -> f64 {
    let at = |e: usize| core.elements.iter().position(|&o| o == e);
    let off = |c: &Constraint| {
        let (u, v) = (at(c.ends[0])?, at(c.ends[1])?);
        let found = Construction::value_between(&placed.shapes[u], &placed.shapes[v]);
        Some((found - c.value.value()).abs())
    };
    let all = sketch.constraints().iter().filter_map(off);
    all.fold(0.0, f64::max)
}

/// Capco and others (2018), table 1: most realizations over the complex numbers; of the two triconnected graphs of six
/// vertices the prism has 24, K3,3 16.
#[test]
fn the_prism_has_twenty_four_complex_solutions_and_k33_sixteen() {
    let mut random = Random::new(36);
    for (name, expected) in [("K3,3", 16), ("prism", 24)] {
        for _ in 0..4 {
            let sketch = drawn(named(name).unwrap().edges(), 6, &mut random);
            let found = solved(&sketch);
            let [core] = &found.cores[..] else {
                panic!("{name}: {} cores", found.cores.len());
            };
            let CoreOutcome::Solved { complex, places } = &core.outcome else {
                panic!("{name}: {:?}", core.outcome);
            };
            assert_eq!(*complex, Some(expected), "{name}");
            // The drawing and its mirror image.
            assert!(places.len() >= 2 && places.len() % 2 == 0, "{name}");
            let total = found.total.unwrap();
            assert_eq!((total.least, total.all), (places.len() as u128, true));
            for placed in places {
                let off = residual(&sketch, core, placed);
                assert!(off < 1e-9, "{name}: {off}");
            }
        }
    }
}

/// Newton's method from the drawing and around it against exact algebra: what the one finds the other has, the drawing and its mirror image among it.
#[test]
fn what_is_found_near_the_drawing_is_among_all_solutions() {
    let mut random = Random::new(77);
    let mut compared = 0;
    for name in ["K3,3", "prism"] {
        for _ in 0..3 {
            let sketch = drawn(named(name).unwrap().edges(), 6, &mut random);
            let all = solved(&sketch);
            let none = seconds(0.0);
            let some = together_within(&sketch, &s_tree(sketch.graph()), &none);
            let CoreOutcome::Found { places, .. } = &some.cores[0].outcome else {
                panic!("{name}: {:?}", some.cores[0].outcome);
            };
            // Two points in one place leave it movable.
            let CoreOutcome::Solved { places: exact, .. } = &all.cores[0].outcome else {
                continue;
            };
            compared += 1;
            assert!((2..=exact.len()).contains(&places.len()), "{name}");
            for (i, placed) in places.iter().enumerate() {
                let same = |other: &&Placed| {
                    crate::senses::same_figure(&placed.shapes, &other.shapes, &[])
                };
                assert_eq!(exact.iter().filter(same).count(), 1, "{name}");
                assert_eq!(places.iter().filter(same).count(), 1, "{name} {i}");
            }
            let total = some.total.unwrap();
            assert_eq!((total.least, total.all), (places.len() as u128, false));
            assert!(some.solutions(&sketch, 100).is_none());
        }
    }
    assert!(compared >= 4, "{compared}");
}

/// A point tied to two of K3,3 has two places for each of its solutions where its circles meet: it is tied as it is drawn, and
/// with long bars, which meet wherever the two points are.
#[test]
fn what_stands_on_a_core_is_constructed_from_each_of_its_solutions() {
    let mut random = Random::new(5);
    let mut edges = named("K3,3").unwrap().edges().to_vec();
    let alone = drawn(&edges, 6, &mut random);
    let core = solved(&alone).total.unwrap();
    edges.extend([[0, 6], [1, 6]]);
    let mut constraints = alone.constraints().to_vec();
    for ends in [[0, 6], [1, 6]] {
        constraints.push(Constraint {
            ends,
            value: Number::integer(60),
        });
    }
    let mut elements = alone.elements().to_vec();
    elements.push(Element::Point([0.0, 50.0]));
    let sketch = Sketch::new(elements, constraints).unwrap();
    let found = solved(&sketch);
    assert_eq!(found.cores[0].elements, (0..6).collect::<Vec<usize>>());
    let total = found.total.unwrap();
    assert_eq!((total.least, total.all), (2 * core.least, true));
}

/// Two copies of K3,3 that share a point and are tied by one bar: their solutions multiply, twice for the bar.
#[test]
fn cores_multiply() {
    let k33 = named("K3,3").unwrap();
    let one = drawn(k33.edges(), 6, &mut Random::new(7));
    let count = solved(&one).total.unwrap().least;
    let mut constraints = one.constraints().to_vec();
    let moved = |e: usize| if e == 0 { 0 } else { e + 5 };
    constraints.extend(one.constraints().iter().map(|c| Constraint {
        ends: c.ends.map(moved),
        value: c.value.clone(),
    }));
    // The bar is shorter than both of its arms together, and longer than their difference, in every solution: the arms are
    // constraints.
    let arm = one.constraints().iter().find(|c| c.ends[0] == 0).unwrap();
    constraints.push(Constraint {
        ends: [arm.ends[1], moved(arm.ends[1])],
        value: arm.value.clone(),
    });
    let mut elements = one.elements().to_vec();
    elements.extend(one.elements()[1..].iter().copied());
    let sketch = Sketch::new(elements, constraints).unwrap();
    let found = solved(&sketch);
    assert_eq!(found.cores.len(), 2);
    let total = found.total.unwrap();
    assert_eq!((total.least, total.all), (2 * count * count, true));
}

/// A prism whose triangles are rigid bodies, never turned over: six complex solutions, as of the planar platform on three legs
/// (Gosselin, Sefrioui, Richard 1992), of which at most six are real.
#[test]
fn rigid_triangles_of_a_prism_are_not_turned_over() {
    let mut random = Random::new(11);
    for _ in 0..4 {
        let sketch = drawn(named("prism").unwrap().edges(), 6, &mut random);
        let places: Vec<Element> = sketch.elements().to_vec();
        let triangles = [[0, 1, 2], [3, 4, 5]].map(|t| (t, t.map(|e| places[e])));
        let all = solved(&sketch).total.unwrap().least;
        let sketch = sketch.with_rigid(triangles.to_vec());
        let found = solved(&sketch);
        let CoreOutcome::Solved { complex, places } = &found.cores[0].outcome else {
            panic!("{:?}", found.cores[0].outcome);
        };
        assert_eq!(*complex, Some(6));
        assert!(!places.is_empty() && places.len() <= 6);
        assert!(2 * places.len() as u128 <= all, "{} of {all}", places.len());
        assert!(
            places
                .iter()
                .all(|p| residual(&sketch, &found.cores[0], p) < 1e-9)
        );
    }
}

/// On a circle all of K3,3 is shaky: the drawing is a double solution.
#[test]
fn double_solutions_count_twice() {
    let places = [[5, 0], [-3, 4], [0, -5], [4, 3], [-4, 3], [-3, -4]];
    let constraints = named("K3,3")
        .unwrap()
        .edges()
        .to_vec()
        .into_iter()
        .map(|ends| {
            let [x, y] = [0, 1].map(|k: usize| places[ends[0]][k] - places[ends[1]][k]);
            Constraint {
                ends,
                value: Number::integer(x * x + y * y).sqrt().unwrap(),
            }
        });
    let elements = places.iter().map(|p| Element::Point(p.map(|x| x as f64)));
    let sketch = Sketch::new(elements.collect(), constraints.collect()).unwrap();
    let found = solved(&sketch);
    let places = found.cores[0].places().unwrap();
    assert_eq!(places.iter().filter(|p| p.multiplicity == 2).count(), 2);
}
