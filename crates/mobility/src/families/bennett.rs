//! Bennett linkages: one with a twist spoiled, and chains of many.
//!
//! Any skew quadrilateral with equal opposite sides is one, with each hinge across the two sides that meet in it (Bennett
//! 1903: the skew isogram). One that is its own image under a half turn about z has such sides, so that rational corners
//! make a rational linkage.

use super::drawn::{Hinge, Triple, cross, dot, hinged, integers, minus, over, plus, times};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Mechanism, MechanismError};

/// A hinge axis.
#[derive(Clone)]
struct Axis {
    at: Triple,
    along: Triple,
}

impl Axis {
    /// Its image under the half turn about another axis.
    fn turned_about(&self, axis: &Axis) -> Self {
        let square = dot(&axis.along, &axis.along);
        let turned = |v: &Triple| {
            let share = over(&(&Number::integer(2) * &dot(v, &axis.along)), &square);
            minus(&times(&share, &axis.along), v)
        };
        Self {
            at: plus(&axis.at, &turned(&minus(&self.at, &axis.at))),
            along: turned(&self.along),
        }
    }
}

/// The four hinges of a Bennett linkage of sides √5 m, 3 m, √5 m, 3 m.
fn isogram() -> [Axis; 4] {
    let corners =
        [(1, 0, 0), (1, 1, 2), (-1, 0, 0), (-1, -1, 2)].map(|(x, y, z)| integers(x, y, z));
    std::array::from_fn(|i| {
        let (here, next, before) = (&corners[i], &corners[(i + 1) % 4], &corners[(i + 3) % 4]);
        Axis {
            at: here.clone(),
            along: cross(&minus(next, here), &minus(before, here)),
        }
    })
}

/// A Bennett linkage with one hinge axis turned about a side by `atan(epsilon)`, about `epsilon` rad, so that the twist of
/// that side is off by as much (and the axis no normal of the other side any more).
///
/// It moves for `epsilon` = 0, and not at all for any other, since its four axes are independent then, though closer to
/// dependent the smaller `epsilon` is: the lines that depend on the three other axes are one family of rulings of a
/// hyperboloid, of which no two meet, so that turning the fourth about one of its points leaves the family at once.
///
/// # Errors
/// None in practice.
pub fn spoiled_bennett(epsilon: &Number) -> Result<Mechanism, MechanismError> {
    let [mut a, b, c, d] = isogram();
    // The side from a to d is 3 m long.
    let across = cross(&minus(&d.at, &a.at), &a.along);
    a.along = plus(
        &a.along,
        &times(&over(epsilon, &Number::integer(3)), &across),
    );
    let hinge = |name: &str, first: &str, second: &str, axis: Axis| {
        Hinge::new(name, first, second, axis.at, axis.along)
    };
    let hinges = [
        hinge("a", "side_da", "side_ab", a),
        hinge("b", "side_ab", "side_bc", b),
        hinge("d", "side_da", "side_cd", d),
        hinge("c", "side_bc", "side_cd", c),
    ];
    hinged("spoiled_bennett", &hinges)
}

/// A chain of `loops` Bennett linkages. Neighbours share a hinge and the two links on it, of which each is a side of both
/// loops: a loop is the image of the one before under a half turn about that hinge, so that opposite angles stay equal.
///
/// ```text
///      b       c'
///    /   \   /   \        2 loops + 2 links
///   a     c       a'      3 loops + 1 hinges
///    \   /   \   /
///      d       b'
/// ```
///
/// One finite freedom whatever the number of loops (Baker and Hu 1986); Kutzbach counts `1 − 3 loops`.
///
/// # Errors
/// None in practice; 0 loops count as 1.
pub fn bennett_chain(loops: usize) -> Result<Mechanism, MechanismError> {
    let hinge = |name: String, first: &str, second: &str, axis: &Axis| {
        Hinge::new(&name, first, second, axis.at.clone(), axis.along.clone())
    };
    let [mut near, mut right, mut far, mut left] = isogram();
    // The two links on the hinge where a loop begins, and the two on the one where it ends.
    let mut begin = ["left_0".to_owned(), "right_0".to_owned()];
    let mut hinges = vec![hinge("hinge_0".to_owned(), &begin[0], &begin[1], &near)];
    for number in 1..=loops.max(1) {
        let end = [format!("left_{number}"), format!("right_{number}")];
        hinges.push(hinge(
            format!("left_hinge_{number}"),
            &begin[0],
            &end[0],
            &left,
        ));
        hinges.push(hinge(
            format!("right_hinge_{number}"),
            &begin[1],
            &end[1],
            &right,
        ));
        hinges.push(hinge(format!("hinge_{number}"), &end[0], &end[1], &far));
        let pivot = far.clone();
        // A half turn about the hinge maps each link's side to its own prolongation.
        (near, far) = (far, near.turned_about(&pivot));
        left = left.turned_about(&pivot);
        right = right.turned_about(&pivot);
        begin = end;
    }
    // The last image is not drawn.
    let _ = near;
    hinged(&format!("bennett_chain_{}", loops.max(1)), &hinges)
}

/// `loops` Bennett linkages in a row, each standing on the side opposite to the ground of the one before: they share links but
/// no motion, so that every loop adds one freedom.
///
/// # Errors
/// None in practice; 0 loops count as 1.
pub fn bennett_row(loops: usize) -> Result<Mechanism, MechanismError> {
    let mut hinges = Vec::new();
    let mut ground = "ground".to_owned();
    for number in 1..=loops.max(1) {
        let shift = integers(10 * (number as i64 - 1), 0, 0);
        let [a, b, c, d] = isogram().map(|axis| Axis {
            at: plus(&axis.at, &shift),
            ..axis
        });
        let link = |name: &str| format!("{name}_{number}");
        let mut add = |name: &str, first: &str, second: &str, axis: Axis| {
            hinges.push(Hinge::new(&link(name), first, second, axis.at, axis.along));
        };
        add("a", &ground, &link("crank"), a);
        add("b", &link("crank"), &link("coupler"), b);
        add("d", &ground, &link("rocker"), d);
        add("c", &link("coupler"), &link("rocker"), c);
        ground = link("coupler");
    }
    hinged(&format!("bennett_row_{}", loops.max(1)), &hinges)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::drawn::tests::{gaps, side_squared};
    use super::*;
    use crate::families::negative_power_of_ten;
    use crate::kutzbach_count;

    /// Bennett's condition: opposite sides have the same length and the same twist, and lengths are as the sines of twists.
    #[test]
    fn the_isogram_meets_the_condition() {
        let axes = isogram();
        // Squares of the length and of the twist's sine.
        let side = |i: usize| {
            let (a, b) = (&axes[i], &axes[(i + 1) % 4]);
            let length = minus(&b.at, &a.at);
            for axis in [a, b] {
                assert!(dot(&length, &axis.along).is_zero(), "a side is no normal");
            }
            let normal = cross(&a.along, &b.along);
            let sine = over(
                &dot(&normal, &normal),
                &(&dot(&a.along, &a.along) * &dot(&b.along, &b.along)),
            );
            (dot(&length, &length), sine)
        };
        let equal = |a: &Number, b: &Number| (a - b).is_zero();
        let sides: [_; 4] = std::array::from_fn(side);
        for i in 0..2 {
            assert!(equal(&sides[i].0, &sides[i + 2].0) && equal(&sides[i].1, &sides[i + 2].1));
        }
        assert!(equal(
            &(&sides[0].0 * &sides[1].1),
            &(&sides[1].0 * &sides[0].1)
        ));
    }

    #[test]
    fn a_spoiled_twist_spoils_no_length() {
        for epsilon in [negative_power_of_ten(1), negative_power_of_ten(14)] {
            let linkage = spoiled_bennett(&epsilon).unwrap();
            assert!(gaps(&linkage)[0].iter().all(Number::is_zero));
            for (a, b, square) in [("a", "b", 5), ("b", "c", 9), ("d", "c", 5), ("a", "d", 9)] {
                let side = side_squared(&linkage, a, b);
                assert!((&side - &Number::integer(square)).is_zero());
            }
            // The axis was turned about the side from a to d, so that it stays a normal of that side.
            let axis = |name: &str| {
                let joint = linkage.joint(linkage.joint_named(name).unwrap());
                joint.axis.0.clone()
            };
            assert!(dot(&axis("a"), &integers(2, 1, -2)).is_zero());
        }
    }

    #[test]
    fn chains_have_the_links_that_are_told() {
        for loops in [1, 2, 5] {
            let chain = bennett_chain(loops).unwrap();
            assert_eq!(chain.links().len(), 2 * loops + 2);
            assert_eq!(chain.joints().len(), 3 * loops + 1);
            assert_eq!(kutzbach_count(&chain), 1 - 3 * loops as i64);
            assert_eq!(gaps(&chain).len(), loops);
            assert!(gaps(&chain).iter().flatten().all(Number::is_zero));
        }
    }

    #[test]
    fn rows_have_the_links_that_are_told() {
        for loops in [1, 4] {
            let row = bennett_row(loops).unwrap();
            assert_eq!(row.links().len(), 3 * loops + 1);
            assert_eq!(row.joints().len(), 4 * loops);
            assert_eq!(kutzbach_count(&row), -2 * loops as i64);
            assert!(gaps(&row).iter().flatten().all(Number::is_zero));
        }
    }
}
