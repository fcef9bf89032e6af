//! Boundaries from vertices and loops of their numbers.

use super::solid::check_outward;
use super::{Boundary, Edge, EdgeUse, Face, Shell};
use crate::decide::Decider;
use crate::entity::Point;
use crate::error::{GeometryError, Spot};
use crate::scalar::Scalar;
use std::collections::BTreeMap;

/// Collects vertices and faces for a [`Boundary`].
#[derive(Clone, Debug)]
pub struct BoundaryBuilder<S> {
    vertices: Vec<Point<S>>,
    faces: Vec<Vec<Vec<usize>>>,
}

impl<S> Default for BoundaryBuilder<S> {
    fn default() -> Self {
        Self {
            vertices: Vec::new(),
            faces: Vec::new(),
        }
    }
}

impl<S: Scalar> BoundaryBuilder<S> {
    /// Without vertices and faces.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a vertex and gives its number.
    pub fn vertex(&mut self, at: Point<S>) -> usize {
        self.vertices.push(at);
        self.vertices.len() - 1
    }

    /// Adds a face and gives its number: the outer loop, counterclockwise seen from outside, then holes, clockwise, each as
    /// the numbers of its vertices. The first is not given again at the end.
    pub fn face(&mut self, loops: Vec<Vec<usize>>) -> usize {
        self.faces.push(loops);
        self.faces.len() - 1
    }

    /// The boundary of these faces, which may be open, and need be no manifold.
    ///
    /// # Errors
    /// Where a number is beyond the vertices, and what [`Face::new`] refuses, with the face, the loop and the corner.
    pub fn build(self) -> Result<Boundary<S>, GeometryError> {
        let mut decider = Decider::default();
        let mut faces = Vec::with_capacity(self.faces.len());
        for (number, loops) in self.faces.iter().enumerate() {
            let face = corners(&self.vertices, loops).and_then(Face::new);
            let face = face.map_err(|error| error.in_face(number))?;
            decider.weaken(face.certainty());
            faces.push(face);
        }
        let (edges, of_face) = edges_of(&self.faces);
        let mut at_vertex = vec![Vec::new(); self.vertices.len()];
        for (number, edge) in edges.iter().enumerate() {
            for end in edge.ends {
                if let Some(list) = at_vertex.get_mut(end) {
                    list.push(number);
                }
            }
        }
        let shells = shells_of(&edges, &of_face);
        Ok(Boundary {
            vertices: self.vertices,
            edges,
            faces,
            loops: self.faces,
            at_vertex,
            of_face,
            shells,
            solid: false,
            certainty: decider.certainty(),
        })
    }

    /// The boundary of a solid: all shells are closed, and all normals point outwards, out of the material; around a
    /// cavity they point into it. Edges that more than two faces pass are allowed.
    ///
    /// # Errors
    /// What [`BoundaryBuilder::build`] refuses; no face at all; an edge that is not passed as often in one sense as in the
    /// other, with a face and a loop that pass it; a shell that is turned inside out, with one of its faces; a shell of
    /// which it cannot be told whether it is inside of another.
    pub fn build_solid(self) -> Result<Boundary<S>, GeometryError> {
        let mut boundary = self.build()?;
        if boundary.faces.is_empty() {
            return Err(GeometryError::Degenerate {
                needed: "a face or more for a solid",
                found: "none",
            });
        }
        for edge in &boundary.edges {
            check_closed(edge)?;
        }
        let mut decider = Decider::default();
        decider.weaken(boundary.certainty);
        check_outward(&boundary, &mut decider)?;
        boundary.certainty = decider.certainty();
        boundary.solid = true;
        Ok(boundary)
    }
}

/// The points of loops of numbers.
fn corners<S: Scalar>(
    vertices: &[Point<S>],
    loops: &[Vec<usize>],
) -> Result<Vec<Vec<Point<S>>>, GeometryError> {
    let mut found = Vec::with_capacity(loops.len());
    for (ring, numbers) in loops.iter().enumerate() {
        let mut points = Vec::with_capacity(numbers.len());
        for (corner, number) in numbers.iter().enumerate() {
            let point = vertices.get(*number).ok_or(GeometryError::NoFace {
                spot: Spot {
                    face: None,
                    ring: Some(ring),
                    corner: Some(corner),
                },
                needed: "the number of a vertex",
                found: "one beyond the last: add the vertex first",
            })?;
            points.push(point.clone());
        }
        found.push(points);
    }
    Ok(found)
}

/// The edges that loops pass, and for each face those that it passes.
fn edges_of(faces: &[Vec<Vec<usize>>]) -> (Vec<Edge>, Vec<Vec<usize>>) {
    let mut edges: Vec<Edge> = Vec::new();
    let mut known: BTreeMap<[usize; 2], usize> = BTreeMap::new();
    let mut of_face = Vec::with_capacity(faces.len());
    for (face, loops) in faces.iter().enumerate() {
        let mut own = Vec::new();
        for (ring, numbers) in loops.iter().enumerate() {
            let next = numbers.iter().cycle().skip(1);
            for (corner, (from, to)) in numbers.iter().zip(next).enumerate() {
                let key = [*from.min(to), *from.max(to)];
                let number = *known.entry(key).or_insert_with(|| {
                    edges.push(Edge {
                        ends: [*from, *to],
                        uses: Vec::new(),
                    });
                    edges.len() - 1
                });
                if let Some(edge) = edges.get_mut(number) {
                    let forward = edge.ends == [*from, *to];
                    edge.uses.push(EdgeUse {
                        face,
                        ring,
                        corner,
                        forward,
                    });
                }
                own.push(number);
            }
        }
        of_face.push(own);
    }
    (edges, of_face)
}

/// What hangs together by edges.
fn shells_of(edges: &[Edge], of_face: &[Vec<usize>]) -> Vec<Shell> {
    let mut seen = vec![false; of_face.len()];
    let mut shells = Vec::new();
    for start in 0..of_face.len() {
        if seen.get(start).copied().unwrap_or(true) {
            continue;
        }
        let mut faces = Vec::new();
        let mut closed = true;
        let mut open = vec![start];
        while let Some(face) = open.pop() {
            match seen.get_mut(face) {
                Some(mark) if !*mark => *mark = true,
                _ => continue,
            }
            faces.push(face);
            let own = of_face.get(face).map_or(&[][..], Vec::as_slice);
            for edge in own.iter().filter_map(|number| edges.get(*number)) {
                closed &= edge.is_closed();
                open.extend(edge.uses.iter().map(|u| u.face));
            }
        }
        faces.sort_unstable();
        shells.push(Shell { faces, closed });
    }
    shells
}

/// An edge of a solid is passed as often in one sense as in the other.
fn check_closed(edge: &Edge) -> Result<(), GeometryError> {
    let Some(first) = edge.uses.first() else {
        return Ok(());
    };
    if edge.is_closed() {
        return Ok(());
    }
    Err(GeometryError::NoFace {
        spot: Spot {
            face: Some(first.face),
            ring: Some(first.ring),
            corner: Some(first.corner),
        },
        needed: "the edge from there passed as often in one sense as in the other, by two faces or more",
        found: match edge.uses.as_slice() {
            [_] => "no other face that passes it: close the gap",
            [_, _] => "one that passes it in the same sense: reverse the loops of one of both",
            _ => "more passes in one sense: reverse a face, or add the one that is missing",
        },
    })
}
