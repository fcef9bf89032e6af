//! Boundaries: what is connected, what is refused, which edges are convex, and what is inside.

use super::{BOX, EXACT, TOLERANT, Three, With, box_corners};
use crate::{
    Answer, Boundary, BoundaryBuilder, Certainty, Entity, GeometryError, Place, Scalar,
    classify_in_solid, concave, contained, convex,
};

/// Of every face its loops, as numbers of corners.
type Faces<'a> = &'a [&'a [&'a [usize]]];

/// An L of height 2: a square of 4 without its upper right quarter; the concave edge is that at (2, 2).
const ELL: [Three; 12] = [
    [0, 0, 0],
    [4, 0, 0],
    [4, 2, 0],
    [2, 2, 0],
    [2, 4, 0],
    [0, 4, 0],
    [0, 0, 2],
    [4, 0, 2],
    [4, 2, 2],
    [2, 2, 2],
    [2, 4, 2],
    [0, 4, 2],
];

const ELL_FACES: [&[&[usize]]; 8] = [
    &[&[5, 4, 3, 2, 1, 0]],
    &[&[6, 7, 8, 9, 10, 11]],
    &[&[0, 1, 7, 6]],
    &[&[1, 2, 8, 7]],
    &[&[2, 3, 9, 8]],
    &[&[3, 4, 10, 9]],
    &[&[4, 5, 11, 10]],
    &[&[5, 0, 6, 11]],
];

impl<S: Scalar> With<S> {
    fn a_box(&self, from: Three, to: Three) -> Boundary<S> {
        let faces: Vec<Vec<&[usize]>> = BOX.iter().map(|f| vec![&f[..]]).collect();
        let faces: Vec<&[&[usize]]> = faces.iter().map(Vec::as_slice).collect();
        self.solid(&box_corners(from, to), &faces)
    }

    fn connects(&self) {
        let cube = self.a_box([0, 0, 0], [2, 2, 2]);
        assert!(cube.is_solid());
        assert_eq!(cube.certainty(), Certainty::Proven);
        assert_eq!((cube.vertices().len(), cube.edges().len()), (8, 12));
        assert_eq!((cube.faces().len(), cube.shells().len()), (6, 1));
        assert!(cube.shells()[0].closed);
        assert_eq!(cube.loops_of_face(1), [vec![4, 5, 6, 7]]);
        assert_eq!(cube.edges_of_face(0).len(), 4);
        assert_eq!(cube.edges_of_vertex(0).len(), 3);
        assert_eq!(cube.vertices_beside(0), [1, 3, 4]);
        assert_eq!(cube.faces_of_vertex(0), [0, 2, 5]);
        assert_eq!(cube.faces_beside(0), [2, 3, 4, 5]);
        assert_eq!(cube.shell_of_face(5), Some(0));
        let edge = cube.edge_between(1, 0).expect("valid by construction");
        assert_eq!(cube.faces_of_edge(edge), [0, 2]);
        assert_eq!(cube.edges_between(0, 2), [edge]);
        assert_eq!(cube.edges_between(0, 1), Vec::<usize>::new());
        assert_eq!(cube.edge_between(0, 6), None);
        assert!(cube.segment(edge).is_ok() && cube.segment(12).is_err());
        // What does not exist is connected to nothing.
        assert!(cube.edges_of_vertex(8).is_empty() && cube.loops_of_face(6).is_empty());
        assert!(cube.faces_of_edge(12).is_empty() && cube.shell_of_face(6).is_none());
    }

    fn refuses_faces(&self) {
        let refused = |vertices: &[Three], faces: &[&[&[usize]]]| {
            let builder = self.builder(vertices, faces);
            let error = builder.build_solid().expect_err("refused");
            assert!(matches!(error, GeometryError::NoFace { .. }), "{error}");
            error.to_string()
        };
        let square = [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]];
        let rows: [(&[Three], Faces<'_>, &str); 6] = [
            (&square, &[&[&[0, 1, 7]]], "face 0, loop 0, corner 2"),
            (&square, &[&[&[0, 1]]], "three corners"),
            (&square, &[&[&[0, 1, 1, 2]]], "corner 1 (counted from 0)"),
            (
                &[[0, 0, 0], [1, 0, 0], [2, 0, 0]],
                &[&[&[0, 1, 2]]],
                "an area",
            ),
            (
                &[[0, 0, 0], [4, 0, 0], [4, 4, 1], [0, 4, 0]],
                &[&[&[0, 1, 2, 3]]],
                "in the plane of the outer loop",
            ),
            (&square, &[&[&[0, 1, 2, 3]]], "close the gap"),
        ];
        for (vertices, faces, part) in rows {
            let said = refused(vertices, faces);
            assert!(said.contains(part), "needed {part}, found {said}");
        }
        // Two faces that pass an edge in the same sense.
        let roof = [[0, 0, 0], [4, 0, 0], [4, 4, 1], [0, -4, 1]];
        let said = refused(&roof, &[&[&[0, 1, 2]], &[&[0, 1, 3]]]);
        assert!(said.contains("face 0, loop 0, corner 0"), "{said}");
        assert!(said.contains("in the same sense"), "{said}");
        // The box inside out.
        let faces: Vec<Vec<usize>> = BOX
            .iter()
            .map(|f| f.iter().rev().copied().collect())
            .collect();
        let faces: Vec<[&[usize]; 1]> = faces.iter().map(|f| [f.as_slice()]).collect();
        let faces: Vec<&[&[usize]]> = faces.iter().map(|f| &f[..]).collect();
        let said = refused(&box_corners([0, 0, 0], [1, 1, 1]), &faces);
        assert!(said.contains("inside out"), "{said}");
        // Holes that go round like the outer loop, or are outside of it.
        let corners = [
            [0, 0, 0],
            [9, 0, 0],
            [9, 9, 0],
            [0, 9, 0],
            [1, 1, 0],
            [2, 1, 0],
            [2, 2, 0],
            [11, 1, 0],
            [11, 2, 0],
            [12, 1, 0],
        ];
        let said = refused(&corners, &[&[&[0, 1, 2, 3], &[4, 5, 6]]]);
        assert!(said.contains("face 0, loop 1 (counted"), "{said}");
        let said = refused(&corners, &[&[&[0, 1, 2, 3], &[7, 8, 9]]]);
        assert!(said.contains("loop 1, corner 0"), "{said}");
        assert!(self.builder(&corners, &[]).build_solid().is_err());
    }

    fn bends(&self) {
        let ell = self.solid(&ELL, &ELL_FACES);
        let inner = ell.edge_between(3, 9).expect("valid by construction");
        for edge in 0..ell.edges().len() {
            let is_inner = edge == inner;
            let (hollow, outward) = match is_inner {
                true => (Answer::Yes, Answer::No),
                false => (Answer::No, Answer::Yes),
            };
            assert_eq!(ell.convex(edge), Ok(outward), "{edge}");
            assert_eq!(ell.concave(edge), Ok(hollow), "{edge}");
        }
        assert_eq!(ell.convex_vertex(0), Ok(Answer::Yes));
        assert_eq!(ell.convex_vertex(3), Ok(Answer::No));
        assert_eq!(ell.concave_vertex(3), Ok(Answer::No));
        assert!(ell.convex(99).is_err() && ell.convex_vertex(99).is_err());
        let face = |number: usize| -> Entity<S> { ell.faces()[number].clone().into() };
        assert_eq!(convex(&face(4), &face(5)), Ok(Answer::No));
        assert_eq!(concave(&face(4), &face(5)), Ok(Answer::Yes));
        assert_eq!(convex(&face(0), &face(2)), Ok(Answer::Yes));
        assert!(convex(&face(0), &face(1)).is_err());
        assert!(convex(&face(0), &self.point([0, 0, 0])).is_err());
        let top = &ell.faces()[1];
        assert_eq!(top.convex_corner(0, 0), Ok(Answer::Yes));
        assert_eq!(top.concave_corner(0, 3), Ok(Answer::Yes));
        assert_eq!(top.convex_corner(0, 3), Ok(Answer::No));
        assert!(top.convex_corner(0, 6).is_err() && top.convex_corner(1, 0).is_err());
        // One face continues the other, or is folded back on it.
        let sheet = |corner: Three| {
            let vertices = [[0, 0, 0], [0, 4, 0], [-4, 0, 0], corner];
            let builder = self.builder(&vertices, &[&[&[0, 1, 2]], &[&[1, 0, 3]]]);
            builder.build().expect("valid by construction")
        };
        for corner in [[4, 0, 0], [-4, 1, 0]] {
            let sheet = sheet(corner);
            let edge = sheet.edge_between(0, 1).expect("valid by construction");
            assert_eq!(sheet.convex(edge), Ok(Answer::No));
            assert_eq!(sheet.concave(edge), Ok(Answer::No));
            assert!(!sheet.shells()[0].closed && !sheet.is_solid());
            // An edge with one face has no bend.
            let border = sheet.edge_between(0, 2).expect("valid by construction");
            assert!(sheet.convex(border).is_err());
            assert!(classify_in_solid(&self.at([0, 0, 0]), &sheet).is_err());
        }
    }

    fn tells_inside(&self) {
        let ell = self.solid(&ELL, &ELL_FACES);
        let rows = [
            ([1, 1, 1], Place::Inside),
            ([3, 1, 1], Place::Inside),
            ([1, 3, 1], Place::Inside),
            ([3, 3, 1], Place::Outside),
            ([3, 3, 0], Place::Outside),
            ([2, 2, 1], Place::OnBorder),
            ([2, 3, 1], Place::OnBorder),
            ([0, 0, 0], Place::OnBorder),
            ([1, 1, 2], Place::OnBorder),
            ([1, 1, 3], Place::Outside),
            ([-1, 1, 1], Place::Outside),
            ([5, 2, 1], Place::Outside),
        ];
        for (at, expected) in rows {
            let found = classify_in_solid(&self.at(at), &ell).expect("valid by construction");
            assert_eq!(found.certainty, Certainty::Proven, "{at:?}");
            assert_eq!(found.value, expected, "{at:?}");
            let belongs = match expected {
                Place::Outside => Answer::No,
                _ => Answer::Yes,
            };
            let answer = contained(&self.point(at), &ell.clone().into());
            assert_eq!(answer, Ok(belongs), "{at:?}");
        }
        let hollow = self.hollow(true).build_solid();
        let hollow = hollow.expect("valid by construction");
        assert_eq!(hollow.shells().len(), 2);
        for (at, expected) in [
            ([3, 3, 3], Place::Outside),
            ([2, 3, 3], Place::OnBorder),
            ([1, 3, 3], Place::Inside),
            ([7, 3, 3], Place::Outside),
        ] {
            let found = classify_in_solid(&self.at(at), &hollow).expect("valid by construction");
            assert_eq!(found.value, expected, "{at:?}");
        }
        let turned = self.hollow(false).build_solid().expect_err("refused");
        assert!(turned.to_string().contains("cavity"), "{turned}");
        // Two boxes with a common edge: four faces pass it.
        let mut corners = box_corners([0, 0, 0], [2, 2, 2]).to_vec();
        corners.extend(box_corners([2, 2, 0], [4, 4, 2]));
        let second = |v: usize| match v {
            0 => 2,
            4 => 6,
            other => other + 8,
        };
        let mut builder = self.builder(&corners, &[]);
        for face in BOX {
            builder.face(vec![face.to_vec()]);
            builder.face(vec![face.map(second).to_vec()]);
        }
        let both = builder.build_solid().expect("valid by construction");
        let shared = both.edge_between(2, 6).expect("valid by construction");
        assert_eq!(both.faces_of_edge(shared).len(), 4);
        assert_eq!(both.shells().len(), 1);
        assert!(both.convex(shared).is_err());
        for (at, expected) in [
            ([1, 1, 1], Place::Inside),
            ([3, 3, 1], Place::Inside),
            ([1, 3, 1], Place::Outside),
            ([2, 2, 1], Place::OnBorder),
        ] {
            let found = classify_in_solid(&self.at(at), &both).expect("valid by construction");
            assert_eq!(found.value, expected, "{at:?}");
        }
    }

    /// A box in a box: a cavity where its faces are reversed.
    fn hollow(&self, reversed: bool) -> BoundaryBuilder<S> {
        let mut corners = box_corners([0, 0, 0], [6, 6, 6]).to_vec();
        corners.extend(box_corners([2, 2, 2], [4, 4, 4]));
        let mut builder = self.builder(&corners, &[]);
        for face in BOX {
            builder.face(vec![face.to_vec()]);
            let mut inner = face.map(|v| v + 8).to_vec();
            if reversed {
                inner.reverse();
            }
            builder.face(vec![inner]);
        }
        builder
    }
}

in_both_forms!(connects, refuses_faces, bends, tells_inside,);
