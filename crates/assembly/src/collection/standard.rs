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

    #[test]
    fn standard_collections_stay_as_they_are() {
        let once = standard(&samples::tetra_as_drawn()).collection;
        let twice = standard(&once);
        assert!(twice.was_standard());
        assert_eq!(twice.collection, once);
    }
}
