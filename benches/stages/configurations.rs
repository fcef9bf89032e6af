//! All configurations of a mechanism, with proof, and the seam graph of its bodies; K3,3 and the prism solved at once.

use divan::{Bencher, black_box};
use kutzbach::algebra::Limits;
use kutzbach::assembly::modes::{Complete, Question, assembly_modes};
use kutzbach::assembly::words::SeamWords;
use kutzbach::constructive::analysis::s_tree;
use kutzbach::constructive::samples::named;
use kutzbach::constructive::sketch::{Constraint, Element, Sketch};
use kutzbach::constructive::together::together;
use kutzbach::mechanism::Mechanism;
use kutzbach::number::Number;

/// Files of `mechanisms/` whose configurations are finitely many, all of them proven.
const PROVEN: [&str; 8] = [
    "tetra_i",
    "tetra_ii",
    "tetra_iii",
    "tetra_20_10_4",
    "tetra_6_7_8",
    "pent",
    "quad_16_17_18_19",
    "planar_four_bar",
];

fn mechanism(name: &str) -> Mechanism {
    let path = format!("{}/../mechanisms/{name}.urdf", env!("CARGO_MANIFEST_DIR"));
    let read = kutzbach::format::read_file(path, &[]).expect("a file of the project");
    read.mechanism
}

#[divan::bench(args = PROVEN, max_time = 2)]
fn configurations(bencher: Bencher, name: &str) {
    let mechanism = mechanism(name);
    let question = Question {
        held: None,
        limits: Limits::seconds(60.0),
    };
    bencher.bench_local(|| {
        let modes =
            assembly_modes(black_box(&mechanism), &question).expect("joints that can be held");
        assert_eq!(modes.complete, Complete::Proven);
    });
}

#[divan::bench(args = ["tetra_iii", "pent", "quad_16_17_18_19"], max_time = 1)]
fn seams(bencher: Bencher, name: &str) {
    let mechanism = mechanism(name);
    bencher.bench_local(|| SeamWords::of(black_box(&mechanism)).is_ok());
}

/// Six points at whole coordinates, tied as they are drawn.
#[divan::bench(args = ["K3,3", "prism"], max_time = 2)]
fn solved_at_once(bencher: Bencher, name: &str) {
    const PLACES: [[i64; 2]; 6] = [[0, 0], [9, 2], [4, 7], [-3, 5], [6, -4], [11, 8]];
    let graph = named(name).expect("a graph by name");
    let constraint = |&ends: &[usize; 2]| {
        let [x, y] = [0, 1].map(|k: usize| PLACES[ends[0]][k] - PLACES[ends[1]][k]);
        let value = Number::integer(x * x + y * y)
            .sqrt()
            .expect("a square root");
        Constraint { ends, value }
    };
    let elements = PLACES.map(|p| Element::Point(p.map(|x| x as f64)));
    let constraints = graph.edges().iter().map(constraint).collect();
    let sketch = Sketch::new(elements.to_vec(), constraints).expect("points apart");
    let tree = s_tree(sketch.graph());
    bencher.bench_local(|| {
        let found = together(black_box(&sketch), &tree);
        assert!(found.total.is_some_and(|total| total.all));
    });
}
