//! Sketches: points and directed lines of the plane as drawn, and what is to hold between them.

use crate::graph::{Graph, GraphError};
use crate::relation::Relation;
use kutzbach_math::number::Number;
use std::collections::HashMap;
use thiserror::Error;

/// A point or line where it is drawn. Any length unit, the same throughout.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Element {
    /// A point at x, y.
    Point([f64; 2]),
    /// A directed line.
    Line {
        /// A point that it goes through.
        through: [f64; 2],
        /// Where it goes; any length but zero.
        direction: [f64; 2],
    },
}

impl Element {
    pub(crate) const fn is_line(&self) -> bool {
        matches!(self, Self::Line { .. })
    }
}

/// What holds between two elements; which it is, their kinds say.
///
/// - Two points: their distance, above zero.
/// - A point and a line: how far the point lies to the left of the line, below zero to the right, zero on it.
/// - Two lines: the angle by which the first is turned to the left to point as the second does, in radians.
#[derive(Clone, Debug)]
pub struct Constraint {
    /// The elements, by index.
    pub ends: [usize; 2],
    /// The value.
    pub value: Number,
}

/// Why something is no sketch. Indices are those of the input.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum SketchError {
    /// Not a simple graph.
    #[error(transparent)]
    Graph(GraphError),
    /// An element that is not drawn anywhere: not finite, or a line without a direction.
    #[error("element {0} has no finite place, or no direction")]
    Place(usize),
    /// Two points at distance zero are one point.
    #[error("constraint {0} puts two points at distance zero: they are one point")]
    ZeroLength(usize),
    /// A distance of two points below zero.
    #[error("constraint {0} is a distance below zero")]
    Negative(usize),
    /// A relation of elements that it is not made for, of one twice, or of a value that there is not.
    #[error("relation {0} is not between different elements of the kinds that it needs")]
    Relation(usize),
    /// The same two elements, the same value.
    #[error("constraints {first} and {second} say the same")]
    Doubled {
        /// The constraint that stands first.
        first: usize,
        /// The other one.
        second: usize,
    },
    /// The same two elements, different values.
    #[error("constraints {first} and {second} contradict each other")]
    Contradictory {
        /// The constraint that stands first.
        first: usize,
        /// The other one.
        second: usize,
    },
}

/// Elements and constraints: at least two elements, at most one constraint for any two; and relations of more elements.
#[derive(Clone, Debug)]
pub struct Sketch {
    elements: Vec<Element>,
    constraints: Vec<Constraint>,
    relations: Vec<Relation>,
    /// How many unknown values the relations have.
    unknown_values: usize,
    graph: Graph,
    /// Three elements, ascending, with a kept order and how they lie to each other.
    rigid: HashMap<[usize; 3], Triangle>,
    /// Whether values are known to rounding only.
    rounded: bool,
    /// Whether solutions are one that differ in the senses of lines alone.
    figures: bool,
}

/// Three elements and how they lie to each other.
type Triangle = ([usize; 3], [Element; 3]);

impl Sketch {
    /// The sketch.
    ///
    /// # Errors
    /// At the first element or constraint that is not what its documentation says.
    pub fn new(elements: Vec<Element>, constraints: Vec<Constraint>) -> Result<Self, SketchError> {
        for (i, element) in elements.iter().enumerate() {
            let (numbers, degenerate) = match *element {
                Element::Point(p) => ([p, p], false),
                Element::Line { through, direction } => {
                    ([through, direction], direction == [0.0; 2])
                }
            };
            if degenerate || numbers.iter().flatten().any(|x| !x.is_finite()) {
                return Err(SketchError::Place(i));
            }
        }
        let ends = constraints.iter().map(|c| c.ends);
        let graph = Graph::new(elements.len(), ends).map_err(|why| match why {
            GraphError::Doubled { first, second } => {
                doubled(&elements, &constraints, first, second)
            }
            other => SketchError::Graph(other),
        })?;
        for (i, constraint) in constraints.iter().enumerate() {
            if constraint.ends.iter().any(|&e| elements[e].is_line()) {
                continue;
            }
            match constraint.value.signum() {
                0 => return Err(SketchError::ZeroLength(i)),
                1 => {}
                _ => return Err(SketchError::Negative(i)),
            }
        }
        Ok(Self {
            elements,
            constraints,
            relations: Vec::new(),
            unknown_values: 0,
            graph,
            rigid: HashMap::new(),
            rounded: false,
            figures: false,
        })
    }

    /// The same sketch with these relations of elements, and so many unknown values.
    ///
    /// # Errors
    /// [`SketchError::Relation`] at the first one that is not what its documentation says.
    pub fn with_relations(
        mut self,
        relations: Vec<Relation>,
        unknown_values: usize,
    ) -> Result<Self, SketchError> {
        let line = |e: &usize| self.elements[*e].is_line();
        let fits = |relation: &Relation| {
            let all = relation.elements();
            let inside = all.iter().all(|&e| e < self.elements.len());
            let twice = (1..all.len()).any(|i| all[..i].contains(&all[i]));
            inside
                && !twice
                && match relation {
                    Relation::Middle { .. } => !all.iter().any(line),
                    Relation::Mirrored { pair, axis, .. } => {
                        line(axis) && line(&pair[0]) == line(&pair[1])
                    }
                    Relation::Measured { ends, terms, .. } => {
                        !ends.iter().all(line) && terms.iter().all(|t| t.0 < unknown_values)
                    }
                }
        };
        if let Some(wrong) = relations.iter().position(|r| !fits(r)) {
            return Err(SketchError::Relation(wrong));
        }
        self.relations = relations;
        self.unknown_values = unknown_values;
        Ok(self)
    }

    /// The same sketch where three elements each, all tied to each other, lie as they are given here and are never turned over: those
    /// of a rigid body.
    #[must_use]
    pub fn with_rigid(mut self, triangles: Vec<([usize; 3], [Element; 3])>) -> Self {
        for (elements, places) in triangles {
            let mut sorted = elements;
            sorted.sort_unstable();
            self.rigid.insert(sorted, (elements, places));
        }
        self
    }

    /// The same sketch where solutions are one that differ in the sense of lines alone which nothing measures: no distance to a side of them.
    #[must_use]
    pub const fn of_figures(mut self) -> Self {
        self.figures = true;
        self
    }

    pub(crate) const fn senses_count(&self) -> bool {
        !self.figures
    }

    /// The same sketch with another value of a constraint.
    ///
    /// # Panics
    /// Where there is no such constraint.
    #[must_use]
    pub fn with_value(&self, constraint: usize, value: Number) -> Self {
        let mut other = self.clone();
        other.constraints[constraint].value = value;
        other
    }

    /// The same sketch with values that are known to rounding only: whether circles touch is then not decided by them.
    pub(crate) fn known_to_rounding(mut self) -> Self {
        self.rounded = true;
        self
    }

    pub(crate) const fn is_known_to_rounding(&self) -> bool {
        self.rounded
    }

    /// How three elements lie to each other in a body that has them, in the order asked for.
    pub(crate) fn rigid(&self, elements: [usize; 3]) -> Option<[Element; 3]> {
        let mut sorted = elements;
        sorted.sort_unstable();
        let (order, places) = self.rigid.get(&sorted)?;
        let place = |e: usize| order.iter().position(|&o| o == e).map(|k| places[k]);
        let [a, b, c] = elements.map(place);
        Some([a?, b?, c?])
    }

    /// The triangles of rigid bodies, and how they lie in these.
    pub(crate) fn rigid_triangles(&self) -> Vec<Triangle> {
        let mut all: Vec<Triangle> = self.rigid.values().copied().collect();
        all.sort_unstable_by_key(|(elements, _)| *elements);
        all
    }

    /// The elements.
    #[must_use]
    pub fn elements(&self) -> &[Element] {
        &self.elements
    }

    /// The constraints.
    #[must_use]
    pub fn constraints(&self) -> &[Constraint] {
        &self.constraints
    }

    /// What holds beside the constraints.
    #[must_use]
    pub fn relations(&self) -> &[Relation] {
        &self.relations
    }

    /// How many unknown values the relations have.
    #[must_use]
    pub const fn unknown_values(&self) -> usize {
        self.unknown_values
    }

    /// Elements as vertices, constraints as edges.
    #[must_use]
    pub const fn graph(&self) -> &Graph {
        &self.graph
    }

    /// The constraint between two elements, if there is one, by both orders of its ends.
    pub(crate) fn by_ends(&self) -> HashMap<[usize; 2], usize> {
        let both = |(i, c): (usize, &Constraint)| {
            let [u, v] = c.ends;
            [([u, v], i), ([v, u], i)]
        };
        self.constraints.iter().enumerate().flat_map(both).collect()
    }
}

/// Two constraints of the same elements. An angle counts from the first to the second.
fn doubled(
    elements: &[Element],
    constraints: &[Constraint],
    first: usize,
    second: usize,
) -> SketchError {
    let [one, other] = [first, second].map(|i| &constraints[i]);
    let angle = one.ends.iter().all(|&e| elements[e].is_line());
    let value = match angle && one.ends != other.ends {
        true => -&other.value,
        false => other.value.clone(),
    };
    if one.value == value {
        SketchError::Doubled { first, second }
    } else {
        SketchError::Contradictory { first, second }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn told(constraints: &[(usize, usize, &str)]) -> Option<SketchError> {
        let line = |x| Element::Line {
            through: [0.0, 1.0],
            direction: [x, 2.0],
        };
        let point = |x| Element::Point([x, 0.0]);
        let constraints = constraints.iter().map(|&(u, v, value)| Constraint {
            ends: [u, v],
            value: Number::decimal(value).unwrap(),
        });
        let elements = vec![point(0.0), point(1.0), line(0.0), line(1.0)];
        Sketch::new(elements, constraints.collect()).err()
    }

    #[test]
    fn every_mistake_has_its_own_message() {
        let (first, second) = (0, 1);
        let doubled = Some(SketchError::Doubled { first, second });
        let contradictory = Some(SketchError::Contradictory { first, second });
        assert_eq!(told(&[(0, 1, "1"), (0, 2, "0"), (0, 3, "-2")]), None);
        assert_eq!(told(&[(0, 1, "0")]), Some(SketchError::ZeroLength(0)));
        assert_eq!(told(&[(0, 1, "-1")]), Some(SketchError::Negative(0)));
        assert_eq!(told(&[(0, 1, "1"), (1, 0, "1.0")]), doubled);
        assert_eq!(told(&[(0, 1, "1"), (1, 0, "2")]), contradictory);
        assert_eq!(told(&[(0, 2, "1"), (2, 0, "1")]), doubled);
        assert_eq!(told(&[(2, 3, "1"), (3, 2, "-1")]), doubled);
        assert_eq!(told(&[(2, 3, "1"), (3, 2, "1")]), contradictory);
        let (edge, vertex) = (0, 4);
        assert_eq!(
            told(&[(0, 4, "1")]),
            Some(SketchError::Graph(GraphError::NoVertex { edge, vertex }))
        );
        let flat = Element::Line {
            through: [0.0; 2],
            direction: [0.0; 2],
        };
        let error = Sketch::new(vec![Element::Point([0.0; 2]), flat], Vec::new()).err();
        assert_eq!(error, Some(SketchError::Place(1)));
    }
}
