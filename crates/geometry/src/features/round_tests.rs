//! Pins and holes made by hand, whose bends, axes and radii are known.

use super::{Bend, Orientation, Part, RoundEdge, RoundFace, RoundPart, Shape, Sort, Type};
use crate::Answer;
use nalgebra::Vector3;

fn sure(holds: bool) -> Answer {
    match holds {
        true => Answer::Yes,
        false => Answer::No,
    }
}

/// A pin on a plate, or a blind hole in it: the plate's top, the wall, `beside` (m) off the axis of its circles and as much smaller, its end,
/// and both circles.
fn pin(hole: bool, beside: f64) -> RoundPart {
    let z = Vector3::z();
    let height = if hole { -1.0 } else { 1.0 };
    let plane = |z_at: f64, loops: usize| RoundFace {
        shape: Shape::Plane {
            point: z * z_at,
            normal: z,
        },
        convex: true,
        whole: false,
        loops,
    };
    let wall = RoundFace {
        shape: Shape::Cylinder {
            point: Vector3::x() * beside,
            direction: z,
            radius: 0.5 - beside,
        },
        convex: !hole,
        whole: true,
        loops: 2,
    };
    let circle = |z_at: f64, uses: [(usize, f64); 2]| RoundEdge {
        shape: Shape::Circle {
            centre: z * z_at,
            axis: z,
            radius: 0.5,
        },
        at: Vector3::new(0.5, 0.0, z_at),
        uses: uses.map(|(face, way)| (face, Vector3::y() * way)).to_vec(),
    };
    // The top lies outside its circle and the end inside, whichever is higher.
    RoundPart::new(
        vec![plane(0.0, 2), wall, plane(height, 1)],
        vec![
            circle(0.0, [(0, -1.0), (1, 1.0)]),
            circle(height, [(2, 1.0), (1, -1.0)]),
        ],
        1e-7,
        1e-6,
    )
}

#[test]
fn edges_of_pins_and_holes_bend_to_different_sides() {
    for hole in [false, true] {
        let part = pin(hole, 0.0);
        // A pin stands in a concave circle and ends in a convex one; a blind hole the other way round.
        for (edge, concave) in [(0, !hole), (1, hole)] {
            assert_eq!(part.bends(edge, Bend::Concave), Some(sure(concave)));
            assert_eq!(part.bends(edge, Bend::Convex), Some(sure(!concave)));
        }
        assert_eq!(part.is_curved(1, Bend::Concave), sure(hole));
        assert_eq!(part.is_curved(0, Bend::Convex), Answer::No);
    }
}

#[test]
fn what_is_round_lies_by_its_axis() {
    let part = pin(false, 0.0);
    let (top, wall, end) = ((Sort::Face, 0), (Sort::Face, 1), (Sort::Face, 2));
    let (foot, rim) = ((Sort::Edge, 0), (Sort::Edge, 1));
    let asked = |part: &RoundPart, a, b, how| part.oriented(a, b, how);
    for (a, b, how, answer) in [
        (top, wall, Orientation::Perpendicular, Answer::Yes),
        (top, wall, Orientation::Parallel, Answer::No),
        (top, end, Orientation::Parallel, Answer::Yes),
        (top, end, Orientation::Coplanar, Answer::No),
        (foot, rim, Orientation::Coaxial, Answer::Yes),
        (wall, rim, Orientation::Coaxial, Answer::Yes),
        (wall, rim, Orientation::EqualRadius, Answer::Yes),
        (wall, rim, Orientation::Larger, Answer::No),
        (top, wall, Orientation::Coaxial, Answer::No),
        (top, rim, Orientation::Parallel, Answer::Yes),
    ] {
        assert_eq!(asked(&part, a, b, how), Ok(answer), "{a:?} {b:?} {how}");
    }
    // Two accuracies beside it nothing is sure, twenty beside it all is.
    for (beside, answer) in [(2e-7, Answer::WithinDigits), (2e-6, Answer::No)] {
        let part = pin(false, beside);
        assert_eq!(asked(&part, wall, rim, Orientation::Coaxial), Ok(answer));
        let larger = asked(&part, rim, wall, Orientation::Larger);
        let expected = match answer {
            Answer::No => Answer::Yes,
            doubt => doubt,
        };
        assert_eq!(larger, Ok(expected));
    }
}

#[test]
fn numbers_beyond_the_last_have_no_property() {
    let part = pin(false, 0.0);
    assert_eq!(part.has_type(9, Type::Planar), Answer::No);
    assert_eq!(part.bends(9, Bend::Convex), None);
    assert!(part.faces_beside(9).is_empty() && part.edges_around(9).is_empty());
    let beyond = (Sort::Face, 9);
    let one = (Sort::Face, 1);
    assert_eq!(part.equidistant(one, one, beyond), Answer::No);
    assert_eq!(part.equidistant(one, one, one), Answer::Yes);
}
