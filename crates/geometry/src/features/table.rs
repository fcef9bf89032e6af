//! Tuples, filled and struck out step by step.

use super::declare::{Bend, Condition, Declaration, Sort};
use super::part::Part;
use super::plan::{Action, PlanStep};
use crate::decide::Answer;
use crate::error::GeometryError;
use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::fmt;

/// So many tuples a table may have.
const MOST_ROWS: usize = 500_000;

/// A feature that was found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Feature {
    /// The numbers of the faces and edges that fill the roles, in the order of [`Declaration::roles`].
    pub roles: Vec<usize>,
    /// Whether it is one, for all values within the digits.
    pub holds: Answer,
    /// In how many ways the same faces and edges fill the roles.
    pub ways: usize,
}

/// What a step of the plan left.
#[derive(Clone, Debug, PartialEq)]
pub struct StepTold {
    /// The step.
    pub step: PlanStep,
    /// The tuples that it made of those before, before it asked for its conditions.
    pub filled: usize,
    /// The tuples after it.
    pub left: usize,
}

/// The features of a boundary, and how they were found.
#[derive(Clone, Debug, PartialEq)]
pub struct Extraction {
    /// The features. The same faces and edges in other roles are no other feature.
    pub features: Vec<Feature>,
    /// The steps in order.
    pub steps: Vec<StepTold>,
    /// Edges that are neither convex nor concave, since they are not between two faces that pass them in opposite senses.
    pub edges_without_bend: usize,
}

/// Why there are no features.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum FeatureError {
    /// A step that leaves more tuples than are kept.
    TooMany {
        /// The number of the step, counted from 1.
        step: usize,
        /// How many are kept.
        most: usize,
    },
    /// Geometry without an answer.
    Geometry(GeometryError),
}

impl fmt::Display for FeatureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooMany { step, most } => write!(
                f,
                "needed at most {most} tuples after each step, found more after step {step}: begin with what is rare, \
                 such as concave edges, and go on by connectivity"
            ),
            Self::Geometry(error) => write!(f, "{error}"),
        }
    }
}

impl Error for FeatureError {}

impl From<GeometryError> for FeatureError {
    fn from(error: GeometryError) -> Self {
        Self::Geometry(error)
    }
}

impl Declaration {
    /// The features of a part: of a [`Boundary`](crate::Boundary), or of one with round faces ([`RoundPart`](super::RoundPart)).
    ///
    /// # Errors
    /// Where a step leaves too many tuples.
    pub fn extract<P: Part>(&self, part: &P) -> Result<Extraction, FeatureError> {
        let mut finder = Finder {
            declaration: self,
            part,
            bends: BTreeMap::new(),
            without_bend: BTreeSet::new(),
        };
        let mut rows = vec![Tuple {
            roles: vec![None; self.roles.len()],
            holds: Answer::Yes,
        }];
        let mut steps = Vec::new();
        for (number, step) in self.plan().steps.into_iter().enumerate() {
            rows = finder.filled(rows, step.action, number + 1)?;
            let filled = rows.len();
            for condition in &step.conditions {
                rows = finder.asked(rows, *condition)?;
            }
            steps.push(StepTold {
                step,
                filled,
                left: rows.len(),
            });
        }
        Ok(Extraction {
            features: self.features(&rows),
            steps,
            edges_without_bend: finder.without_bend.len(),
        })
    }

    /// Rows with the same faces and edges are one feature.
    fn features(&self, rows: &[Tuple]) -> Vec<Feature> {
        let mut features: Vec<Feature> = Vec::new();
        let mut known: BTreeMap<Vec<(bool, usize)>, usize> = BTreeMap::new();
        for row in rows {
            let Some(roles) = row.roles.iter().copied().collect::<Option<Vec<usize>>>() else {
                continue;
            };
            let sorts = self.roles.iter().map(|role| role.sort == Sort::Edge);
            let mut key: Vec<(bool, usize)> = sorts.zip(roles.iter().copied()).collect();
            key.sort_unstable();
            let next = features.len();
            let number = *known.entry(key).or_insert(next);
            match features.get_mut(number) {
                Some(feature) => {
                    feature.ways += 1;
                    feature.holds = feature.holds.or(row.holds);
                }
                None => features.push(Feature {
                    roles,
                    holds: row.holds,
                    ways: 1,
                }),
            }
        }
        features
    }
}

/// A row of the table.
#[derive(Clone, Debug)]
struct Tuple {
    roles: Vec<Option<usize>>,
    holds: Answer,
}

struct Finder<'a, P> {
    declaration: &'a Declaration,
    part: &'a P,
    /// What is known of edges; none of those without a bend.
    bends: BTreeMap<(usize, bool), Option<Answer>>,
    without_bend: BTreeSet<usize>,
}

impl<P: Part> Finder<'_, P> {
    /// The rows with the roles of an action filled in every possible way.
    fn filled(
        &self,
        rows: Vec<Tuple>,
        action: Action,
        step: usize,
    ) -> Result<Vec<Tuple>, FeatureError> {
        if action == Action::Verify {
            return Ok(rows);
        }
        let mut next = Vec::new();
        for row in rows {
            match action {
                Action::Seed(role) => self.seed(&row, role, &mut next),
                Action::Join {
                    first,
                    second,
                    edge,
                } => self.join(&row, [first, second, edge], &mut next),
                Action::Verify => {}
            }
            if next.len() > MOST_ROWS {
                return Err(FeatureError::TooMany {
                    step,
                    most: MOST_ROWS,
                });
            }
        }
        Ok(next)
    }

    fn seed(&self, row: &Tuple, role: usize, next: &mut Vec<Tuple>) {
        if held(row, role).is_some() {
            next.push(row.clone());
            return;
        }
        let count = match self.sort(role) {
            Some(Sort::Face) => self.part.face_count(),
            Some(Sort::Edge) => self.part.edge_count(),
            None => 0,
        };
        next.extend((0..count).filter_map(|number| self.with(row, &[(role, number)])));
    }

    fn join(&self, row: &Tuple, [first, second, edge]: [usize; 3], next: &mut Vec<Tuple>) {
        let edges = match (held(row, edge), held(row, first), held(row, second)) {
            (Some(edge), _, _) => vec![edge],
            (None, Some(face), _) | (None, None, Some(face)) => {
                let edges: BTreeSet<usize> = self.part.edges_around(face).into_iter().collect();
                edges.into_iter().collect()
            }
            (None, None, None) => (0..self.part.edge_count()).collect(),
        };
        for number in edges {
            let faces = self.part.faces_beside(number);
            for a in &faces {
                for b in faces.iter().filter(|b| *b != a) {
                    next.extend(self.with(row, &[(first, *a), (second, *b), (edge, number)]));
                }
            }
        }
    }

    fn sort(&self, role: usize) -> Option<Sort> {
        self.declaration.roles.get(role).map(|role| role.sort)
    }

    /// The row with roles filled; none where they are filled otherwise, or another role has the same face or edge.
    fn with(&self, row: &Tuple, fills: &[(usize, usize)]) -> Option<Tuple> {
        let mut own = row.clone();
        for (role, number) in fills {
            if let Some(known) = held(&own, *role) {
                if known != *number {
                    return None;
                }
                continue;
            }
            let sort = self.sort(*role);
            let taken = (0..own.roles.len())
                .any(|other| self.sort(other) == sort && held(&own, other) == Some(*number));
            if taken {
                return None;
            }
            *own.roles.get_mut(*role)? = Some(*number);
        }
        Some(own)
    }

    /// The rows that a condition leaves.
    fn asked(
        &mut self,
        rows: Vec<Tuple>,
        condition: Condition,
    ) -> Result<Vec<Tuple>, FeatureError> {
        let mut left = Vec::with_capacity(rows.len());
        for mut row in rows {
            let answer = self.holds(&row, condition)?;
            row.holds = row.holds.and(answer);
            if !row.holds.is_no() {
                left.push(row);
            }
        }
        Ok(left)
    }

    fn holds(&mut self, row: &Tuple, condition: Condition) -> Result<Answer, FeatureError> {
        Ok(match condition {
            Condition::Type(role, kind) => match held(row, role) {
                Some(number) => self.part.has_type(number, kind),
                None => Answer::No,
            },
            Condition::Connected {
                first,
                second,
                edge,
            } => match (held(row, first), held(row, second), held(row, edge)) {
                (Some(a), Some(b), Some(edge)) => {
                    let faces = self.part.faces_beside(edge);
                    match a != b && faces.contains(&a) && faces.contains(&b) {
                        true => Answer::Yes,
                        false => Answer::No,
                    }
                }
                _ => Answer::No,
            },
            Condition::Bend(role, bend) => match (held(row, role), self.sort(role)) {
                (Some(edge), Some(Sort::Edge)) => self.bend(edge, bend),
                (Some(face), Some(Sort::Face)) => self.part.is_curved(face, bend),
                _ => Answer::No,
            },
            Condition::Oriented(first, second, orientation) => {
                match (self.filler(row, first), self.filler(row, second)) {
                    (Some(first), Some(second)) => {
                        self.part.oriented(first, second, orientation)?
                    }
                    _ => Answer::No,
                }
            }
            Condition::Equidistant {
                first,
                second,
                from,
            } => {
                let [first, second, from] = [first, second, from].map(|r| self.filler(row, r));
                match (first, second, from) {
                    (Some(a), Some(b), Some(from)) => self.part.equidistant(a, b, from),
                    _ => Answer::No,
                }
            }
        })
    }

    /// What fills a role, with its sort.
    fn filler(&self, row: &Tuple, role: usize) -> Option<(Sort, usize)> {
        Some((self.sort(role)?, held(row, role)?))
    }

    /// Whether an edge bends so; an edge that does not bend at all does not.
    fn bend(&mut self, edge: usize, bend: Bend) -> Answer {
        let part = self.part;
        let key = (edge, bend == Bend::Convex);
        let known = *self
            .bends
            .entry(key)
            .or_insert_with(|| part.bends(edge, bend));
        known.unwrap_or_else(|| {
            self.without_bend.insert(edge);
            Answer::No
        })
    }
}

/// What fills a role.
fn held(row: &Tuple, role: usize) -> Option<usize> {
    row.roles.get(role).copied().flatten()
}
