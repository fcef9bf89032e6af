//! Rigid parts of a collection that is not standard: sets of points that a larger body would have, of which the bodies given are pieces.
//!
//! Resolved first and by themselves, they leave fewer unknowns to what remains: a tree over pieces has their hinges in it as well.
//!
//! Source: Sitharam, Peters, Zhou (2010), example 4 and section 4.5.

use super::standard::{Origin, standard};
use super::{Bar, Body, Collection};

/// A rigid set of points that several bodies hold together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RigidPart {
    /// Its name: that of its points.
    pub name: String,
    /// Its points, ascending.
    pub points: Vec<usize>,
    /// The bodies given that are inside it, ascending; together they have all of its points.
    pub bodies: Vec<usize>,
}

/// The largest rigid parts of two bodies or more, in the order of their points; they share two points at most with one another. None where
/// rigidity at generic dimensions is not that of the bodies given ([`Standard::holds`](super::Standard::holds)), and none whose
/// points the bodies inside it do not have.
///
/// Cost as of [`rigid_sets`](super::rigid_sets).
#[must_use]
pub fn rigid_parts(given: &Collection) -> Vec<RigidPart> {
    let whole = standard(given);
    if !whole.holds(given) {
        return Vec::new();
    }
    let sets = whole.collection.bodies().iter().zip(&whole.origins);
    let parts = sets.filter_map(|(body, origin)| {
        let Origin::Implied(inside) = origin else {
            return None;
        };
        let has = |p: &usize| inside.iter().any(|&b| given.bodies()[b].points.contains(p));
        (inside.len() > 1 && body.points.iter().all(has)).then(|| RigidPart {
            name: body.name.clone(),
            points: body.points.clone(),
            bodies: inside.clone(),
        })
    });
    parts.collect()
}

impl RigidPart {
    /// The bodies inside it, and as bars the distances that others keep between its points.
    #[must_use]
    pub fn alone(&self, given: &Collection) -> Collection {
        let bodies: Vec<Body> = self
            .bodies
            .iter()
            .map(|&b| given.bodies()[b].clone())
            .collect();
        let inside = |p: &usize| self.points.binary_search(p).is_ok();
        let one_has = |[p, q]: &[usize; 2]| {
            let both = |b: &Body| b.points.contains(p) && b.points.contains(q);
            bodies.iter().any(both)
        };
        let distances = given.distances().into_iter();
        let bars = distances.filter(|ends| ends.iter().all(inside) && !one_has(ends));
        let bars = bars.map(|ends| Bar {
            name: ends.map(|p| given.points()[p].as_str()).join(" – "),
            ends,
        });
        let bars = bars.collect();
        Collection {
            points: given.points.clone(),
            bodies,
            bars,
        }
    }
}

impl Collection {
    /// The collection with each of these parts as one body, which comes after the bodies that are in none.
    #[must_use]
    pub fn joined(&self, parts: &[RigidPart]) -> Self {
        let left = (0..self.bodies.len()).filter(|b| !parts.iter().any(|p| p.bodies.contains(b)));
        let bodies = left.map(|b| self.bodies[b].clone());
        let joined = parts.iter().map(|part| Body {
            name: part.name.clone(),
            points: part.points.clone(),
        });
        self.with_bodies(bodies.chain(joined).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples;
    use super::*;
    use crate::collection::with_triangles;
    use crate::tree::optimal_incidence_tree;

    fn weight(collection: &Collection) -> Option<usize> {
        let all = with_triangles(collection);
        optimal_incidence_tree(&all, &[], |_| true).map(|tree| tree.weight)
    }

    /// Example 4 of the paper: weights 1 and 3 one after the other, 4 at once.
    #[test]
    fn a_split_body_is_a_part_of_weight_one() {
        let given = samples::tetra_in_parts();
        let parts = rigid_parts(&given);
        assert_eq!(parts.len(), 1);
        assert_eq!(parts[0].bodies, [1, 2]);
        let alone = parts[0].alone(&given);
        assert_eq!((alone.bodies().len(), alone.bars().len()), (2, 1));
        let weights = [&alone, &given.joined(&parts), &given].map(weight);
        assert_eq!(weights, [Some(1), Some(3), Some(4)]);
        assert!(rigid_parts(&given.joined(&parts)).is_empty());
    }

    #[test]
    fn whole_bodies_have_no_parts() {
        for given in [
            samples::tetra_as_drawn(),
            samples::pent_as_drawn(),
            samples::quad_as_drawn(),
        ] {
            assert!(rigid_parts(&given).is_empty());
        }
    }
}
