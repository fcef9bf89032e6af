//! Features of small parts, whose numbers are known.

use super::{Action, Declaration, Extraction, read_declarations};
use crate::{Answer, Boundary, BoundaryBuilder, Measured, Point, Scalar};
use kutzbach_math::number::Number;

/// The thesis' own example, as printed but for the numbers of its lines.
const STEP: &str = include_str!("../../../../mechanisms/features/step.features");
const SLOT: &str = include_str!("../../../../mechanisms/features/slot.features");
const RIB: &str = include_str!("../../../../mechanisms/features/rib.features");
const POCKET: &str = include_str!("../../../../mechanisms/features/pocket.features");
const HOLE: &str = include_str!("../../../../mechanisms/features/square_hole.features");
const BLOCK: &str = include_str!("../../../../mechanisms/features/block.features");

/// A prism over a polygon in the plane of x and z, counterclockwise seen against y, from y = 0 to y = depth.
fn prism<S: Scalar>(outline: &[(i32, i32)], depth: i32) -> Boundary<S> {
    let mut builder = BoundaryBuilder::new();
    let count = outline.len();
    for y in [0, depth] {
        for (x, z) in outline {
            builder.vertex(Point([*x, y, *z].map(S::whole)));
        }
    }
    // Seen from −y, x to the right and z up, the outline goes round counterclockwise.
    builder.face(vec![(0..count).collect()]);
    builder.face(vec![(count..2 * count).rev().collect()]);
    for at in 0..count {
        let next = (at + 1) % count;
        builder.face(vec![vec![next, at, at + count, next + count]]);
    }
    builder.build_solid().unwrap()
}

/// A staircase with so many inner corners.
fn stairs(steps: i32) -> Vec<(i32, i32)> {
    let mut outline = vec![(0, 0), (steps + 1, 0)];
    for step in 0..=steps {
        let x = steps + 1 - step;
        outline.push((x, step + 1));
        outline.push((x - 1, step + 1));
    }
    outline
}

/// A plate with a groove along it.
const GROOVED: [(i32, i32); 8] = [
    (0, 0),
    (6, 0),
    (6, 3),
    (4, 3),
    (4, 1),
    (2, 1),
    (2, 3),
    (0, 3),
];

/// A plate with a rib along it.
const RIBBED: [(i32, i32); 8] = [
    (0, 0),
    (6, 0),
    (6, 1),
    (4, 1),
    (4, 3),
    (2, 3),
    (2, 1),
    (0, 1),
];

fn declared(text: &str) -> Declaration {
    read_declarations(text).unwrap().remove(0)
}

fn found<S: Scalar>(text: &str, outline: &[(i32, i32)]) -> Extraction {
    declared(text).extract(&prism::<S>(outline, 5)).unwrap()
}

#[test]
fn the_step_of_the_thesis_is_found_as_often_as_it_is_there() {
    for steps in 0..8 {
        let outline = stairs(steps);
        let count = usize::try_from(steps).unwrap();
        let exact = found::<Number>(STEP, &outline);
        assert_eq!(exact.features.len(), count, "{steps}");
        assert!(
            exact
                .features
                .iter()
                .all(|f| f.holds == Answer::Yes && f.ways == 2)
        );
        assert_eq!(found::<Measured>(STEP, &outline).features, exact.features);
    }
    assert_eq!(found::<Number>(STEP, &GROOVED).features.len(), 2);
    assert_eq!(found::<Number>(STEP, &RIBBED).features.len(), 2);
    // An inner corner that is no right angle is no step.
    let slanted = [(0, 0), (4, 0), (4, 1), (3, 1), (2, 3), (0, 3)];
    assert!(found::<Number>(STEP, &slanted).features.is_empty());
}

#[test]
fn slots_and_ribs_are_told_apart_by_their_walls() {
    for (outline, slots, ribs) in [
        (GROOVED.as_slice(), 1, 0),
        (RIBBED.as_slice(), 0, 1),
        (stairs(3).as_slice(), 0, 0),
    ] {
        assert_eq!(found::<Number>(SLOT, outline).features.len(), slots);
        assert_eq!(found::<Number>(RIB, outline).features.len(), ribs);
    }
}

/// A block of 6 by 6 by 2 with a hole of 2 by 2 in its middle, through it or down to half of its height.
fn hollowed(through: bool) -> Boundary<Number> {
    let mut builder = BoundaryBuilder::new();
    let inner_bottom = if through { 0 } else { 1 };
    for ([low, high], bottom) in [([0, 6], 0), ([2, 4], inner_bottom)] {
        for z in [bottom, 2] {
            for (x, y) in [(low, low), (high, low), (high, high), (low, high)] {
                builder.vertex(Point([x, y, z].map(Scalar::whole)));
            }
        }
    }
    let below = vec![0, 3, 2, 1];
    let middle = vec![8, 9, 10, 11];
    match through {
        true => {
            builder.face(vec![below, middle]);
        }
        false => {
            builder.face(vec![below]);
            builder.face(vec![middle]);
        }
    }
    builder.face(vec![vec![4, 5, 6, 7], vec![12, 15, 14, 13]]);
    for at in 0..4 {
        let next = (at + 1) % 4;
        builder.face(vec![vec![at, next, next + 4, at + 4]]);
        builder.face(vec![vec![at + 12, next + 12, next + 8, at + 8]]);
    }
    builder.build_solid().unwrap()
}

#[test]
fn pockets_and_holes_are_told_apart_by_what_is_below() {
    // Of a pocket each pair of walls that face each other is a slot over the floor, and over each wall between them.
    for (through, pockets, holes, slots) in [(false, 1, 0, 6), (true, 0, 1, 4)] {
        let part = hollowed(through);
        let found = |text: &str| declared(text).extract(&part).unwrap().features;
        assert_eq!(found(POCKET).len(), pockets);
        assert_eq!(found(HOLE).len(), holes);
        assert_eq!(found(SLOT).len(), slots);
        assert!(found(POCKET).iter().all(|feature| feature.ways == 8));
        assert!(found(HOLE).iter().all(|feature| feature.ways == 16));
    }
}

#[test]
fn a_block_is_one_whatever_its_roles() {
    let box_outline = [(0, 0), (3, 0), (3, 2), (0, 2)];
    let found_in_box = found::<Number>(BLOCK, &box_outline);
    assert_eq!(found_in_box.features.len(), 1);
    assert!(found::<Number>(BLOCK, &stairs(1)).features.is_empty());
    let slanted = [(0, 0), (3, 0), (4, 2), (0, 2)];
    assert!(found::<Number>(BLOCK, &slanted).features.is_empty());
}

#[test]
fn the_order_is_that_of_the_author() {
    let declaration = declared(STEP);
    let plan = declaration.plan();
    let actions: Vec<Action> = plan.steps.iter().map(|step| step.action).collect();
    let join = Action::Join {
        first: 0,
        second: 1,
        edge: 2,
    };
    assert_eq!(actions, [Action::Seed(2), join, Action::Verify]);
    let found = found::<Number>(STEP, &stairs(2));
    // 24 edges, two of them concave; two orders of the faces at each.
    let rows: Vec<(usize, usize)> = found.steps.iter().map(|s| (s.filled, s.left)).collect();
    assert_eq!(rows, [(24, 2), (4, 4), (4, 4)]);
    assert!(declaration.step_text(&plan.steps[0]).contains("E1 concave"));
}

#[test]
fn large_parts_take_as_many_tuples_as_they_have_candidates() {
    let found = found::<Number>(STEP, &stairs(1_000));
    assert_eq!(found.features.len(), 1_000);
    let most = found.steps.iter().map(|step| step.filled).max();
    // Every edge once, and no pair of faces that share none.
    assert_eq!(most, Some(3 * 2_004));
}

#[test]
fn a_declaration_without_steps_of_its_author_ends_too() {
    let (definition, _) = STEP.split_once("BEGIN").unwrap();
    let declaration = declared(definition);
    let found = declaration
        .extract(&prism::<Number>(&stairs(4), 5))
        .unwrap();
    assert_eq!(found.features.len(), 4);
}

#[test]
fn what_is_no_declaration_is_refused_with_its_place() {
    let start = "DEFINITION\nNAME A ;\nENTITIES:\n F, G : FACE ; E : EDGE ;\n";
    for (rest, line, said) in [
        ("EDGE TYPE: F : STRAIGHT ;", 5, "a role that is an edge"),
        ("EDGE TYPE: E : ROUND ;", 5, "STRAIGHT or CIRCULAR"),
        (
            "CONNECTIVITY: F: (G, E, BENT) ;",
            5,
            "`CONVEX` or `CONCAVE`",
        ),
        (
            "CONNECTIVITY: F: (H, E) ;",
            5,
            "a role of ENTITIES, found `H`",
        ),
        ("ORIENTATION: F, E : FACING ;", 5, "a role that is a face"),
        (
            "END DEFINITION\nBEGIN\nfind [F] based on colour ;",
            7,
            "found `colour`",
        ),
        (
            "END DEFINITION\nBEGIN\nverify [F] orientation ;\nEND",
            7,
            "nothing declared",
        ),
        ("END DEFINITION\nBEGIN\n", 6, "found the end"),
        ("SHAPE: F ;", 5, "`FACE` or `EDGE`"),
    ] {
        let error = read_declarations(&format!("{start}{rest}")).unwrap_err();
        assert!(error.message.contains(said), "{rest}: {error}");
        assert_eq!(error.line, line, "{rest}: {error}");
    }
}
