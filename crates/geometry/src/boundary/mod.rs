//! Boundaries: vertices, edges, loops, faces and shells, and what is connected to what.
//!
//! A boundary is made by a [`BoundaryBuilder`] from vertices and from faces, each given as loops of vertex numbers. Everything
//! in it is known by its number, counted from 0 in the order in which it was given; edges in the order in which loops come to
//! them. An edge may be used by any number of faces: boundaries need be no manifolds.

mod alike;
mod bend;
mod build;
mod cut;
mod face;
mod inside;
mod reach;
mod solid;

pub use bend::{concave, convex};
pub use build::BoundaryBuilder;
pub use cut::{FacePlace, classify_by_face};
pub use face::Face;
pub use solid::{classify_in_face, classify_in_solid};

pub(crate) use alike::{in_face, same_points};
pub(crate) use cut::{clip_line, clip_segment, of_line, of_plane, of_segment};
pub(crate) use inside::{Ratio, place_in_loops};
pub(crate) use reach::{
    between_faces, between_segments, line_to_face, line_to_segment, plane_to_face, plane_to_points,
    point_to_face, segment_to_face,
};

use crate::decide::Certainty;
use crate::entity::{Point, Segment};
use crate::error::GeometryError;
use crate::scalar::Scalar;

/// One of the times that a loop passes an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EdgeUse {
    /// The face.
    pub face: usize,
    /// Its loop.
    pub ring: usize,
    /// The corner of the loop from which the edge goes to the next one.
    pub corner: usize,
    /// Whether the loop passes it from its first end to its second.
    pub forward: bool,
}

/// A straight edge between two vertices.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edge {
    /// The numbers of its vertices.
    pub ends: [usize; 2],
    /// Where loops pass it.
    pub uses: Vec<EdgeUse>,
}

impl Edge {
    /// Whether loops pass it as often in one sense as in the other, so that nothing is open there.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        let forward = self.uses.iter().filter(|u| u.forward).count();
        2 * forward == self.uses.len()
    }
}

/// Faces that hang together by edges.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shell {
    /// The numbers of its faces, ascending.
    pub faces: Vec<usize>,
    /// Whether each of its edges is passed as often in one sense as in the other: it bounds something.
    pub closed: bool,
}

/// Vertices, edges, loops, faces and shells, and how they are connected.
#[derive(Clone, Debug)]
pub struct Boundary<S> {
    vertices: Vec<Point<S>>,
    edges: Vec<Edge>,
    faces: Vec<Face<S>>,
    /// The vertex numbers of the loops of each face.
    loops: Vec<Vec<Vec<usize>>>,
    /// The edges at each vertex.
    at_vertex: Vec<Vec<usize>>,
    /// The edges of each face, in the order of its loops.
    of_face: Vec<Vec<usize>>,
    shells: Vec<Shell>,
    solid: bool,
    certainty: Certainty,
}

fn sorted(mut numbers: Vec<usize>) -> Vec<usize> {
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}

impl<S: Scalar> Boundary<S> {
    /// The vertices.
    #[must_use]
    pub fn vertices(&self) -> &[Point<S>] {
        &self.vertices
    }

    /// The edges.
    #[must_use]
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// The faces.
    #[must_use]
    pub fn faces(&self) -> &[Face<S>] {
        &self.faces
    }

    /// The shells: what hangs together by edges.
    #[must_use]
    pub fn shells(&self) -> &[Shell] {
        &self.shells
    }

    /// Whether it bounds a solid: it was made by [`BoundaryBuilder::build_solid`].
    #[must_use]
    pub fn is_solid(&self) -> bool {
        self.solid
    }

    /// How certain it is that its faces are flat and, of a solid, that their normals point outwards.
    #[must_use]
    pub fn certainty(&self) -> Certainty {
        self.certainty
    }

    /// The vertex numbers of the loops of a face, the outer one first; none where there is no such face.
    #[must_use]
    pub fn loops_of_face(&self, face: usize) -> &[Vec<usize>] {
        self.loops.get(face).map_or(&[], Vec::as_slice)
    }

    /// The edges of a face, in the order of its loops; one that it passes twice comes twice.
    #[must_use]
    pub fn edges_of_face(&self, face: usize) -> &[usize] {
        self.of_face.get(face).map_or(&[], Vec::as_slice)
    }

    /// The edges that end at a vertex, ascending.
    #[must_use]
    pub fn edges_of_vertex(&self, vertex: usize) -> &[usize] {
        self.at_vertex.get(vertex).map_or(&[], Vec::as_slice)
    }

    /// The faces that pass an edge, ascending.
    #[must_use]
    pub fn faces_of_edge(&self, edge: usize) -> Vec<usize> {
        let uses = self.edges.get(edge).map_or(&[][..], |e| e.uses.as_slice());
        sorted(uses.iter().map(|u| u.face).collect())
    }

    /// The faces that have a corner at a vertex, ascending.
    #[must_use]
    pub fn faces_of_vertex(&self, vertex: usize) -> Vec<usize> {
        let edges = self.edges_of_vertex(vertex).iter();
        sorted(edges.flat_map(|edge| self.faces_of_edge(*edge)).collect())
    }

    /// The vertices that an edge joins with this one, ascending.
    #[must_use]
    pub fn vertices_beside(&self, vertex: usize) -> Vec<usize> {
        let ends = self
            .edges_of_vertex(vertex)
            .iter()
            .filter_map(|edge| self.edges.get(*edge))
            .flat_map(|edge| edge.ends);
        sorted(ends.filter(|end| *end != vertex).collect())
    }

    /// The faces that share an edge with this one, ascending.
    #[must_use]
    pub fn faces_beside(&self, face: usize) -> Vec<usize> {
        let edges = self.edges_of_face(face).iter();
        let faces = edges.flat_map(|edge| self.faces_of_edge(*edge));
        sorted(faces.filter(|other| *other != face).collect())
    }

    /// The edges that two faces share, ascending; of a face with itself those that it passes twice.
    #[must_use]
    pub fn edges_between(&self, face: usize, other: usize) -> Vec<usize> {
        let own = self.edges_of_face(face);
        let shared = |edge: &usize| match face == other {
            true => own.iter().filter(|e| *e == edge).count() > 1,
            false => self.edges_of_face(other).contains(edge),
        };
        sorted(own.iter().copied().filter(shared).collect())
    }

    /// The edge that joins two vertices.
    #[must_use]
    pub fn edge_between(&self, vertex: usize, other: usize) -> Option<usize> {
        let joins = |edge: &&usize| {
            self.edges
                .get(**edge)
                .is_some_and(|e| e.ends == [vertex, other] || e.ends == [other, vertex])
        };
        self.edges_of_vertex(vertex).iter().find(joins).copied()
    }

    /// The shell that a face belongs to.
    #[must_use]
    pub fn shell_of_face(&self, face: usize) -> Option<usize> {
        let has = |shell: &Shell| shell.faces.binary_search(&face).is_ok();
        self.shells.iter().position(has)
    }

    /// An edge as an entity, from its first end to its second.
    ///
    /// # Errors
    /// Where there is no such edge.
    pub fn segment(&self, edge: usize) -> Result<Segment<S>, GeometryError> {
        let ends = self.edges.get(edge).map(|e| e.ends);
        let point = |vertex: usize| self.vertices.get(vertex).cloned();
        match ends.map(|[from, to]| (point(from), point(to))) {
            Some((Some(from), Some(to))) => Segment::new(from, to),
            _ => Err(GeometryError::Degenerate {
                needed: "the number of an edge",
                found: "one beyond the last",
            }),
        }
    }

    /// The same boundary elsewhere.
    pub(crate) fn moved(
        &self,
        face: impl Fn(&Face<S>) -> Result<Face<S>, GeometryError>,
        point: impl Fn(&Point<S>) -> Point<S>,
    ) -> Result<Self, GeometryError> {
        Ok(Self {
            vertices: self.vertices.iter().map(point).collect(),
            faces: self.faces.iter().map(face).collect::<Result<_, _>>()?,
            edges: self.edges.clone(),
            loops: self.loops.clone(),
            at_vertex: self.at_vertex.clone(),
            of_face: self.of_face.clone(),
            shells: self.shells.clone(),
            solid: self.solid,
            certainty: self.certainty,
        })
    }
}
