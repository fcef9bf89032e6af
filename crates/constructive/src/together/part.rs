//! A part that is solved at once.

use super::system::{self, System};
use crate::analysis::{LeafKind, Node, STree};
use crate::construction::{Shape, drawn_side, laid_on};
use crate::relation::Relation;
use crate::senses;
use crate::sketch::Sketch;
use kutzbach_algebra::{Budget, RealSet, Stop};

/// A part whose elements are placed all at once.
#[derive(Clone, Debug)]
pub struct Core {
    /// Its elements, ascending.
    pub elements: Vec<usize>,
    /// Unknowns and equations, and the highest degree of these; `None` where there are none that algebra reads.
    pub size: Option<[usize; 3]>,
    /// What came of it.
    pub outcome: CoreOutcome,
}

/// What is known of a core.
#[derive(Clone, Debug)]
pub enum CoreOutcome {
    /// All its real solutions, by exact algebra: proven, of the values as written.
    Solved {
        /// Solutions over the complex numbers, counted with multiplicities, mirror images apart; `None` where some of them turn a
        /// rigid body over.
        complex: Option<usize>,
        /// The real ones, in the order of [`Core::elements`].
        places: Vec<Placed>,
    },
    /// Some of its real solutions, each proven of the values to rounding; whether there are others is not decided.
    Found {
        /// As in the case above, nearest to the drawing first.
        places: Vec<Placed>,
        /// Why it is not decided.
        why: String,
    },
    /// There are infinitely many: some of its elements move.
    Infinite,
    /// Not decided, and why.
    Open(String),
}

/// One way to place the elements of a core: up to a motion of the plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// Where they are, by element of the core.
    pub shapes: Vec<Shape>,
    /// How often it counts: above one, elements touch what they should meet.
    pub multiplicity: usize,
}

impl Core {
    pub(super) fn solved(sketch: &Sketch, elements: Vec<usize>, budget: &Budget) -> Self {
        let system = match System::of(sketch, &elements) {
            Ok(system) => system,
            Err(why) => {
                return Self {
                    elements,
                    size: None,
                    outcome: CoreOutcome::Open(why.to_owned()),
                };
            }
        };
        let size = Some(system.size());
        let outcome = match system.over_rationals().real_set(<[f64]>::to_vec, budget) {
            Ok(RealSet::Finite { complex, mut real }) => {
                real.retain(|(unknowns, _)| system.is_meant(unknowns));
                of_points(sketch, &elements, &system, complex, &real)
            }
            Ok(RealSet::Dimension(_)) => CoreOutcome::Infinite,
            Ok(RealSet::Unclear) => CoreOutcome::Open(
                "infinitely many complex solutions; which are real is not known".to_owned(),
            ),
            Err(Stop::Cancelled) => {
                CoreOutcome::Open(format!("{} in exact algebra", Stop::Cancelled))
            }
            Err(stop) => of_some(
                sketch,
                &elements,
                &system,
                format!("{stop} in exact algebra"),
            ),
        };
        Self {
            elements,
            size,
            outcome,
        }
    }

    /// The ways to place it that are known.
    #[must_use]
    pub fn places(&self) -> Option<&[Placed]> {
        match &self.outcome {
            CoreOutcome::Solved { places, .. } | CoreOutcome::Found { places, .. } => Some(places),
            _ => None,
        }
    }

    /// Whether these are all.
    #[must_use]
    pub const fn has_all(&self) -> bool {
        matches!(self.outcome, CoreOutcome::Solved { .. })
    }
}

/// What is found without algebra.
fn of_some(sketch: &Sketch, elements: &[usize], system: &System, why: String) -> CoreOutcome {
    let real: Vec<(Vec<f64>, usize)> = system
        .near_the_drawing()
        .into_iter()
        .map(|found| (found.at, 1))
        .collect();
    match of_points(sketch, elements, system, 0, &real) {
        CoreOutcome::Solved { places, .. } if !places.is_empty() => {
            CoreOutcome::Found { places, why }
        }
        _ => CoreOutcome::Open(why),
    }
}

fn of_points(
    sketch: &Sketch,
    elements: &[usize],
    system: &System,
    complex: usize,
    real: &[(Vec<f64>, usize)],
) -> CoreOutcome {
    let placed = |(unknowns, multiplicity): &(Vec<f64>, usize)| Placed {
        shapes: system.shapes_at(unknowns),
        multiplicity: *multiplicity,
    };
    let mut places: Vec<Placed> = real.iter().map(placed).collect();
    // Points of rigid bodies are on their side by their equations, lines of these are not.
    let sided = system::sided_triangles(sketch, elements);
    for (three, sides) in &sided {
        let [a, b, c] = three.map(|e| elements.iter().position(|&o| o == e));
        let (Some(a), Some(b), Some(c)) = (a, b, c) else {
            continue;
        };
        places.retain(|p| {
            let found = drawn_side([&p.shapes[a], &p.shapes[b]], &p.shapes[c]);
            found * sides >= 0.0
        });
    }
    places.sort_by(|a, b| {
        let [a, b] = [a, b].map(|p| off_drawing(sketch, elements, &p.shapes));
        a.total_cmp(&b)
    });
    let free = senses::free(sketch).into_iter().filter_map(|class| {
        let local = |e: usize| elements.iter().position(|&o| o == e);
        class.into_iter().map(local).collect::<Option<Vec<usize>>>()
    });
    let free: Vec<Vec<usize>> = free.collect();
    if !free.is_empty() {
        let mut figures: Vec<Placed> = Vec::new();
        for placed in places {
            let same = |f: &Placed| senses::same_figure(&f.shapes, &placed.shapes, &free);
            if !figures.iter().any(same) {
                figures.push(placed);
            }
        }
        places = figures;
    }
    let all_meant = sided.is_empty() && !system.has_lengths() && free.is_empty();
    CoreOutcome::Solved {
        complex: all_meant.then_some(complex),
        places,
    }
}

/// How far elements are from where they are drawn, once they are turned and shifted onto that as well as can be: the sum of squares, of lines those
/// of directions.
fn off_drawing(sketch: &Sketch, elements: &[usize], shapes: &[Shape]) -> f64 {
    let drawn: Vec<Shape> = elements
        .iter()
        .map(|&e| Shape::drawn(&sketch.elements()[e]))
        .collect();
    let mut shapes = shapes.to_vec();
    laid_on(&mut shapes, &drawn);
    let square = |[a, b]: [[f64; 2]; 2]| (a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2);
    let off = |pair: (&Shape, &Shape)| match pair {
        (Shape::Point(p), Shape::Point(q)) => square([*p, *q]),
        (Shape::Line { direction: a, .. }, Shape::Line { direction: b, .. }) => square([*a, *b]),
        _ => 0.0,
    };
    shapes.iter().zip(&drawn).map(off).sum()
}

/// Triconnected leaves whose edges are all constraints, or between elements that a constraint ties as well: of a pair at which the
/// graph splits, that goes to one of the sides.
pub(super) fn leaves(sketch: &Sketch, tree: &STree) -> Vec<Vec<usize>> {
    let by_ends = sketch.by_ends();
    let given = |node: &Node| match node {
        Node::Leaf {
            kind: LeafKind::Triconnected,
            vertices,
            edges,
        } => edges
            .iter()
            .all(|(ends, _)| by_ends.contains_key(ends))
            .then(|| vertices.clone()),
        _ => None,
    };
    tree.nodes.iter().filter_map(given).collect()
}

/// What is left when elements of two constraints, and of no relation, are taken off one after the other.
pub(super) fn peeled(sketch: &Sketch) -> Vec<Vec<usize>> {
    let graph = sketch.graph();
    let mut near = vec![Vec::new(); graph.vertices()];
    for &[u, v] in graph.edges() {
        near[u].push(v);
        near[v].push(u);
    }
    let mut degree: Vec<usize> = near.iter().map(Vec::len).collect();
    for e in sketch.relations().iter().flat_map(Relation::elements) {
        degree[e] = usize::MAX;
    }
    let mut left = vec![true; graph.vertices()];
    let mut waiting: Vec<usize> = (0..left.len()).filter(|&v| degree[v] == 2).collect();
    while let Some(v) = waiting.pop() {
        left[v] = false;
        for &w in near[v].iter().filter(|&&w| left[w]) {
            degree[w] -= 1;
            if degree[w] == 2 {
                waiting.push(w);
            }
        }
    }
    vec![(0..left.len()).filter(|&v| left[v]).collect()]
}
