//! Collections that list every rigid set as large as it can be.
//!
//! An incidence tree is as good as its choice of bodies. A body that three others hold together, such as the triangle
//! between three tetrahedra in a ring, is listed nowhere in a file and yet is the best place to start from. A *standard*
//! collection lists all *proper-maximal* rigid sets: those that are in no larger rigid set but that of all points.

use super::{Body, Collection, rigid_sets};

/// Where a body of a standard collection comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The body of this index in the collection as given.
    Given(usize),
    /// Distances of others hold it together; the bodies of these indices in the collection as given are inside it.
    Implied(Vec<usize>),
}

/// A standard collection, and how it came about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Standard {
    /// Given bodies first, in their order, implied ones after them.
    pub collection: Collection,
    /// Where each body comes from.
    pub origins: Vec<Origin>,
    /// Indices of given bodies that a larger rigid set swallowed.
    pub swallowed: Vec<usize>,
}

impl Standard {
    /// Whether the collection as given was standard already.
    #[must_use]
    pub fn was_standard(&self) -> bool {
        self.swallowed.is_empty() && self.origins.iter().all(|o| matches!(o, Origin::Given(_)))
    }

    /// Whether rigidity at generic dimensions can be that of the bodies given. It is not where two of the sets share three points,
    /// and so would be one, or where more distances than it takes hold a set together: what closes all the same has special
    /// dimensions, and may move.
    #[must_use]
    pub fn holds(&self, given: &Collection) -> bool {
        let bodies = self.collection.bodies();
        let apart = |i: usize| (0..i).all(|j| self.collection.shared(i, j).len() < 3);
        let implied = self.implied();
        (0..bodies.len()).all(apart)
            && implied
                .iter()
                .all(|&i| !is_overdetermined(given, &bodies[i].points))
    }

    /// Indices of the bodies that the given ones imply.
    #[must_use]
    pub fn implied(&self) -> Vec<usize> {
        let implied = |i: &usize| matches!(self.origins[*i], Origin::Implied(_));
        (0..self.origins.len()).filter(implied).collect()
    }
}

/// The standard collection of the points that two or more of the bodies and bars share. Points of one body alone are left
/// out: nothing hangs on them. A body that keeps fewer than three points, or is all points, is left out as well.
///
/// Cost as of [`rigid_sets`].
#[must_use]
pub fn standard(given: &Collection) -> Standard {
    let mut uses = vec![0usize; given.points().len()];
    for body in given.bodies() {
        body.points.iter().for_each(|&p| uses[p] += 1);
    }
    for bar in given.bars() {
        bar.ends.iter().for_each(|&p| uses[p] += 1);
    }
    let pairs: Vec<[usize; 2]> = given
        .distances()
        .into_iter()
        .filter(|pair| pair.iter().all(|&p| uses[p] > 1))
        .collect();
    let sets = rigid_sets(given.points().len(), &pairs);
    let shared_points: Vec<Vec<usize>> = given
        .bodies()
        .iter()
        .map(|b| b.points.iter().copied().filter(|&p| uses[p] > 1).collect())
        .collect();
    let inside = |set: &[usize]| -> Vec<usize> {
        let within = |body: &Vec<usize>| {
            !body.is_empty() && body.iter().all(|p| set.binary_search(p).is_ok())
        };
        (0..shared_points.len())
            .filter(|&i| within(&shared_points[i]))
            .collect()
    };
    let mut found: Vec<(Origin, Vec<usize>)> = Vec::new();
    for set in sets {
        let origin = match shared_points.iter().position(|body| *body == set) {
            Some(body) => Origin::Given(body),
            None => Origin::Implied(inside(&set)),
        };
        found.push((origin, set));
    }
    found.sort_by_key(|(origin, set)| match origin {
        Origin::Given(body) => (0, *body, Vec::new()),
        Origin::Implied(_) => (1, 0, set.clone()),
    });
    let swallowed = (0..shared_points.len())
        .filter(|&i| shared_points[i].len() >= 3)
        .filter(|&i| !found.iter().any(|(_, set)| *set == shared_points[i]))
        .collect();
    let bodies = found
        .iter()
        .map(|(origin, set)| Body {
            name: match origin {
                Origin::Given(body) => given.bodies()[*body].name.clone(),
                Origin::Implied(_) => {
                    let names: Vec<&str> =
                        set.iter().map(|&p| given.points()[p].as_str()).collect();
                    format!("{{{}}}", names.join(", "))
                }
            },
            points: set.clone(),
        })
        .collect();
    Standard {
        collection: given.with_bodies(bodies),
        origins: found.into_iter().map(|(origin, _)| origin).collect(),
        swallowed,
    }
}

/// The bodies given, and of what they imply the triangles: their sides are known, so that they are no riddle of their own, and
/// they are rigid at any dimensions.
#[must_use]
pub fn with_triangles(given: &Collection) -> Collection {
    let whole = standard(given);
    let mut bodies: Vec<Body> = given.bodies().to_vec();
    let origins = whole.collection.bodies().iter().zip(&whole.origins);
    for (body, origin) in origins {
        if matches!(origin, Origin::Implied(_)) && body.points.len() == 3 {
            bodies.push(body.clone());
        }
    }
    given.with_bodies(bodies)
}

/// Whether the bodies and bars given state more distances among some points than a rigid set of so many needs. A body of m
/// points states 3 m − 6 of them; one that several bodies state counts once.
fn is_overdetermined(given: &Collection, points: &[usize]) -> bool {
    let within = |p: &usize| points.contains(p);
    let bodies = given.bodies().iter();
    let parts: Vec<Vec<usize>> = bodies
        .map(|body| body.points.iter().copied().filter(within).collect())
        .filter(|part: &Vec<usize>| part.len() > 1)
        .collect();
    let own = |part: &Vec<usize>| match part.len() {
        2 => 1,
        m => 3 * m - 6,
    };
    let bars = given
        .bars()
        .iter()
        .filter(|bar| bar.ends.iter().all(within));
    let stated = parts.iter().map(own).sum::<usize>() + bars.count();
    let mut twice = 0;
    for (i, p) in points.iter().enumerate() {
        for q in &points[..i] {
            let holders = parts
                .iter()
                .filter(|part| part.contains(p) && part.contains(q));
            twice += holders.count().saturating_sub(1);
        }
    }
    stated > 3 * points.len() - 6 + twice
}

#[cfg(test)]
mod tests {
    use super::super::samples::{self, names};
    use super::*;

    #[test]
    fn the_triangle_between_three_tetrahedra_is_implied() {
        let standard = standard(&samples::tetra_as_drawn());
        assert!(!standard.was_standard() && standard.swallowed.is_empty());
        assert_eq!(standard.implied(), [3, 4, 5, 6]);
        let mut expected = samples::tetra();
        expected.sort();
        let mut found = names(&standard.collection);
        found.sort();
        assert_eq!(found, expected);
    }

    #[test]
    fn pent_and_quad_get_the_bodies_that_their_bars_make() {
        for (drawn, whole) in [
            (samples::pent_as_drawn(), samples::pent()),
            (samples::quad_as_drawn(), samples::quad()),
        ] {
            let mut found = names(&standard(&drawn).collection);
            found.sort();
            let mut expected = whole;
            expected.sort();
            assert_eq!(found, expected);
        }
    }

    /// Example 4 of the paper: a tetrahedron given in two triangles on one edge. The bar that the triangle c4 implies joins
    /// them again.
    #[test]
    fn a_body_given_in_two_parts_is_put_together() {
        let standard = standard(&samples::tetra_in_parts());
        assert_eq!(standard.swallowed, [1, 2]);
        let mut found = names(&standard.collection);
        found.sort();
        let mut expected = samples::tetra();
        expected.sort();
        assert_eq!(found, expected);
    }

    /// A ring of four hinges: with generic dimensions it would be rigid twice over.
    #[test]
    fn what_moves_by_special_dimensions_has_no_standard_collection() {
        let ring = samples::collection(
            &[
                ("a", "A B C D"),
                ("b", "C D E F"),
                ("c", "E F G H"),
                ("d", "G H A B"),
            ],
            &[],
        );
        assert!(!standard(&ring).holds(&ring));
        for given in [
            samples::tetra_as_drawn(),
            samples::tetra_in_parts(),
            samples::pent_as_drawn(),
            samples::quad_as_drawn(),
        ] {
            assert!(standard(&given).holds(&given));
        }
    }

    #[test]
    fn standard_collections_stay_as_they_are() {
        let once = standard(&samples::tetra_as_drawn()).collection;
        let twice = standard(&once);
        assert!(twice.was_standard());
        assert_eq!(twice.collection, once);
    }
}
