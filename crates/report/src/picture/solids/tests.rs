//! What is seen of solids, and in which order it is drawn.

use super::*;

/// A square of side 1 with a corner there, normal to x, y or z; its normal towards the positive end or not.
fn square(corner: Vector, axis: usize, positive: bool, label: &str) -> FlatFace {
    let (mut u, mut v, mut normal) = ([0.0; 3], [0.0; 3], [0.0; 3]);
    u[(axis + 1) % 3] = 1.0;
    v[(axis + 2) % 3] = 1.0;
    normal[axis] = if positive { 1.0 } else { -1.0 };
    let mark = Mark {
        colour: 1,
        label: label.to_owned(),
    };
    FlatFace {
        loops: vec![vec![
            corner,
            sum(corner, u),
            sum(sum(corner, u), v),
            sum(corner, v),
        ]],
        normal,
        marks: if label.is_empty() {
            Vec::new()
        } else {
            vec![mark]
        },
    }
}

fn cube(at: Vector, label: &str) -> Vec<FlatFace> {
    let mut faces = Vec::new();
    for axis in 0..3 {
        let mut far = at;
        far[axis] += 1.0;
        faces.push(square(at, axis, false, ""));
        faces.push(square(far, axis, true, if axis == 2 { label } else { "" }));
    }
    faces
}

fn part(faces: Vec<FlatFace>) -> Part {
    Part {
        title: "a <part>".to_owned(),
        solid: true,
        faces,
        edges: Vec::new(),
    }
}

#[test]
fn a_cube_shows_three_faces_and_what_is_marked() {
    let svg = document(&[part(cube([0.0; 3], "F1"))]);
    assert_eq!(svg.matches("<path").count(), 3, "{svg}");
    assert_eq!(svg.matches("class=\"m1\"").count(), 1);
    assert!(svg.contains(">F1</text>") && svg.contains("a &lt;part&gt;"));
    assert_eq!(svg, document(&[part(cube([0.0; 3], "F1"))]));
}

#[test]
fn what_is_marked_below_is_seen_from_below_and_else_dashed() {
    let mut faces = cube([0.0; 3], "");
    faces[4] = square([0.0; 3], 2, false, "floor");
    let svg = document(&[part(faces.clone())]);
    assert!(svg.contains("class=\"m1\"") && !svg.contains("class=\"behind"));
    // The top has a mark too: both cannot be seen, and the first view is kept.
    faces[5] = square([0.0, 0.0, 1.0], 2, true, "top");
    let svg = document(&[part(faces)]);
    assert_eq!(svg.matches("class=\"behind m1\"").count(), 1);
}

/// The middle of the large floor is nearer than that of the block on it, which covers it all the same.
#[test]
fn what_stands_before_a_plane_is_drawn_after_it() {
    let mut floor = square([0.0; 3], 2, true, "");
    floor.loops = vec![vec![
        [0.0, -9.0, 0.0],
        [9.0, -9.0, 0.0],
        [9.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
    ]];
    let mut faces = cube([0.0; 3], "top");
    faces.push(floor);
    let view = View::new(&part(faces.clone()));
    let seen: Vec<&FlatFace> = faces.iter().filter(|face| view.faces(face)).collect();
    let order = in_order(&seen, &view);
    assert_eq!(order.len(), 4);
    let place = |wanted: &FlatFace| order.iter().position(|face| *face == wanted).unwrap();
    for side in [&faces[1], &faces[2]] {
        assert!(place(&faces[6]) < place(side), "{order:?}");
    }
}

#[test]
fn nothing_is_a_picture_too() {
    assert!(document(&[]).ends_with("</svg>\n"));
    assert!(document(&[part(Vec::new())]).contains("a &lt;part&gt;"));
}
