//! Bodies that share points, without any geometry.
//!
//! A ball makes two bodies share a point, a hinge two points of its axis; a bar between two balls keeps a distance and is no
//! body. What can be said from that alone holds for nearly all dimensions: which sets of points are rigid
//! ([`rigid_sets`]), whether a collection lists all of them ([`standard`]), and how many freedoms two bodies leave each
//! other ([`overlap_weight`]).
//!
//! Source: M. Sitharam, J. Peters, Y. Zhou, "Optimized parametrization of systems of incidences between rigid bodies",
//! J. Symbolic Computation (2010), sections 3 and 4; M. Sitharam, Y. Zhou, J. Peters, "Reconciling conflicting
//! combinatorial preprocessors for geometric constraint systems" (2010), section 2.

mod parts;
mod rigid;
#[cfg(test)]
pub(crate) mod samples;
mod standard;

pub use parts::{RigidPart, rigid_parts};
pub use rigid::rigid_sets;
pub use standard::{Origin, Standard, standard, with_triangles};

use thiserror::Error;

/// A rigid body as the set of its shared points.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Body {
    /// Its name.
    pub name: String,
    /// Indices of its points, ascending.
    pub points: Vec<usize>,
}

/// A distance that is kept between two points.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bar {
    /// Its name.
    pub name: String,
    /// Indices of its two points.
    pub ends: [usize; 2],
}

/// Bodies that share points, and bars between points.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Collection {
    points: Vec<String>,
    bodies: Vec<Body>,
    bars: Vec<Bar>,
}

/// Why there is no such collection.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum CollectionError {
    /// A body or bar with a point that is not there.
    #[error("`{name}` has point number {point}, and there are {points} points")]
    NoSuchPoint {
        /// The body or bar.
        name: String,
        /// The index.
        point: usize,
        /// Number of points.
        points: usize,
    },
    /// A bar from a point to itself.
    #[error("the bar `{name}` joins a point to itself")]
    Loop {
        /// The bar.
        name: String,
    },
    /// A body of fewer than three points: its turning about them would be seen nowhere.
    #[error("the body `{name}` has {points} points; a body needs three, and one of two is a bar")]
    TooSmall {
        /// The body.
        name: String,
        /// Number of its points.
        points: usize,
    },
    /// Two bodies, or a body and a bar, of one name.
    #[error("two bodies or bars are called `{name}`")]
    SameName {
        /// The name.
        name: String,
    },
}

/// Freedoms that a body keeps relative to another one with which it shares so many points: six, three about a point, one
/// about an axis, none from three points on (which are not on one line).
#[must_use]
pub fn overlap_weight(shared: usize) -> usize {
    match shared {
        0 => 6,
        1 => 3,
        2 => 1,
        _ => 0,
    }
}

impl Collection {
    /// A collection from the names of its points, its bodies and its bars.
    ///
    /// # Errors
    /// [`CollectionError`] for indices out of range, bodies of fewer than three points, bars from a point to itself, and
    /// names that occur twice.
    ///
    /// ```
    /// # use kutzbach_assembly as kutzbach;
    /// use kutzbach::collection::{Body, Collection};
    /// let points = ["hinge 1", "hinge 2", "left", "right"].map(str::to_owned).to_vec();
    /// let body = |name: &str, points: &[usize]| Body { name: name.to_owned(), points: points.to_vec() };
    /// let leaves = vec![body("left leaf", &[0, 1, 2]), body("right leaf", &[0, 1, 3])];
    /// assert_eq!(Collection::new(points, leaves, Vec::new())?.weight(0, 1), 1);
    /// # Ok::<(), kutzbach_assembly::collection::CollectionError>(())
    /// ```
    pub fn new(
        points: Vec<String>,
        bodies: Vec<Body>,
        bars: Vec<Bar>,
    ) -> Result<Self, CollectionError> {
        let mut names = std::collections::BTreeSet::new();
        let mut bodies = bodies;
        for body in &mut bodies {
            body.points.sort_unstable();
            body.points.dedup();
        }
        let sets = bodies.iter().map(|b| (&b.name, b.points.as_slice()));
        let ends = bars.iter().map(|b| (&b.name, b.ends.as_slice()));
        for (name, indices) in sets.chain(ends) {
            if let Some(&point) = indices.iter().find(|&&p| p >= points.len()) {
                return Err(CollectionError::NoSuchPoint {
                    name: name.clone(),
                    point,
                    points: points.len(),
                });
            }
            if !names.insert(name.clone()) {
                return Err(CollectionError::SameName { name: name.clone() });
            }
        }
        if let Some(body) = bodies.iter().find(|b| b.points.len() < 3) {
            return Err(CollectionError::TooSmall {
                name: body.name.clone(),
                points: body.points.len(),
            });
        }
        if let Some(bar) = bars.iter().find(|b| b.ends[0] == b.ends[1]) {
            return Err(CollectionError::Loop {
                name: bar.name.clone(),
            });
        }
        Ok(Self {
            points,
            bodies,
            bars,
        })
    }

    /// Names of the points.
    #[must_use]
    pub fn points(&self) -> &[String] {
        &self.points
    }

    /// The bodies.
    #[must_use]
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// The bars.
    #[must_use]
    pub fn bars(&self) -> &[Bar] {
        &self.bars
    }

    /// The points that two bodies share, ascending.
    #[must_use]
    pub fn shared(&self, one: usize, other: usize) -> Vec<usize> {
        let (one, other) = (&self.bodies[one].points, &self.bodies[other].points);
        let both = one.iter().filter(|p| other.binary_search(p).is_ok());
        both.copied().collect()
    }

    /// Weight of the edge between two bodies in the overlap graph, see [`overlap_weight`].
    #[must_use]
    pub fn weight(&self, one: usize, other: usize) -> usize {
        overlap_weight(self.shared(one, other).len())
    }

    /// Whether some bodies have all points that any body has.
    #[must_use]
    pub fn is_covering(&self, bodies: &[usize]) -> bool {
        let mut covered = vec![false; self.points.len()];
        for &body in bodies {
            self.bodies[body]
                .points
                .iter()
                .for_each(|&p| covered[p] = true);
        }
        let all = self.bodies.iter().flat_map(|b| &b.points);
        all.into_iter().all(|&p| covered[p])
    }

    /// Every pair of points whose distance a body or a bar keeps, each once, ascending.
    #[must_use]
    pub fn distances(&self) -> Vec<[usize; 2]> {
        let mut pairs = std::collections::BTreeSet::new();
        for body in &self.bodies {
            for (i, &a) in body.points.iter().enumerate() {
                pairs.extend(body.points[i + 1..].iter().map(|&b| [a, b]));
            }
        }
        for bar in &self.bars {
            let [a, b] = bar.ends;
            pairs.insert([a.min(b), a.max(b)]);
        }
        pairs.into_iter().collect()
    }

    /// The bodies with others in place of them, unchecked.
    pub(crate) fn with_bodies(&self, bodies: Vec<Body>) -> Self {
        Self {
            points: self.points.clone(),
            bodies,
            bars: self.bars.clone(),
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn body(name: &str, points: &[usize]) -> Body {
        Body {
            name: name.to_owned(),
            points: points.to_vec(),
        }
    }

    fn points(number: usize) -> Vec<String> {
        (0..number).map(|i| format!("p{i}")).collect()
    }

    #[test]
    fn each_defect_has_its_own_message() {
        let bar = |ends| Bar {
            name: "bar".to_owned(),
            ends,
        };
        let cases = [
            (
                vec![body("a", &[0, 1, 9])],
                vec![],
                "`a` has point number 9, and there are 4 points",
            ),
            (
                vec![body("a", &[0, 1, 1])],
                vec![],
                "the body `a` has 2 points; a body needs three, and one of two is a bar",
            ),
            (
                vec![body("a", &[0, 1, 2]), body("a", &[1, 2, 3])],
                vec![],
                "two bodies or bars are called `a`",
            ),
            (
                vec![body("a", &[0, 1, 2])],
                vec![bar([2, 2])],
                "the bar `bar` joins a point to itself",
            ),
        ];
        for (bodies, bars, message) in cases {
            let error = Collection::new(points(4), bodies, bars).unwrap_err();
            assert_eq!(error.to_string(), message);
        }
    }

    #[test]
    fn weights_are_the_freedoms_that_shared_points_leave() {
        let bodies = vec![
            body("a", &[0, 1, 2, 3]),
            body("b", &[2, 3, 4]),
            body("c", &[4, 5, 6]),
        ];
        let collection = Collection::new(points(7), bodies, vec![]).unwrap();
        assert_eq!(collection.weight(0, 1), 1);
        assert_eq!(collection.weight(1, 2), 3);
        assert_eq!(collection.weight(0, 2), 6);
        assert!(collection.is_covering(&[0, 2]) && !collection.is_covering(&[0, 1]));
        assert_eq!(collection.distances().len(), 6 + 2 + 3);
    }
}
