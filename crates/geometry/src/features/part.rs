//! What a feature is looked for in: faces and edges, and what can be asked of them.

use super::declare::{Bend, Orientation, Sort, Type};
use crate::boundary::{Boundary, Face};
use crate::decide::{Answer, zero_vector};
use crate::entity::Direction;
use crate::error::GeometryError;
use crate::scalar::Scalar;
use crate::triple::{cross, dot};

/// The faces and edges of a part, each sort by numbers from 0. A number beyond the last has no property and no neighbour.
pub trait Part {
    /// How many faces there are.
    fn face_count(&self) -> usize;

    /// How many edges there are.
    fn edge_count(&self) -> usize;

    /// The edges of a face.
    fn edges_around(&self, face: usize) -> Vec<usize>;

    /// The faces that meet at an edge, each once.
    fn faces_beside(&self, edge: usize) -> Vec<usize>;

    /// Whether a face or an edge ([`Type::sort`]) is of a type.
    fn has_type(&self, number: usize, kind: Type) -> Answer;

    /// Whether an edge bends so; `None` of an edge that is neither convex nor concave.
    fn bends(&self, edge: usize, bend: Bend) -> Option<Answer>;

    /// Whether a face is curved so. Flat faces are not.
    fn is_curved(&self, face: usize, bend: Bend) -> Answer;

    /// How two faces or edges lie to each other.
    ///
    /// # Errors
    /// Where an edge has no direction.
    fn oriented(
        &self,
        first: (Sort, usize),
        second: (Sort, usize),
        orientation: Orientation,
    ) -> Result<Answer, GeometryError>;

    /// Whether two axes or centres are as far from a third. What has neither is not.
    fn equidistant(
        &self,
        first: (Sort, usize),
        second: (Sort, usize),
        from: (Sort, usize),
    ) -> Answer;
}

impl<S: Scalar> Part for Boundary<S> {
    fn face_count(&self) -> usize {
        self.faces().len()
    }

    fn edge_count(&self) -> usize {
        self.edges().len()
    }

    fn edges_around(&self, face: usize) -> Vec<usize> {
        self.edges_of_face(face).to_vec()
    }

    fn faces_beside(&self, edge: usize) -> Vec<usize> {
        self.faces_of_edge(edge)
    }

    fn has_type(&self, number: usize, kind: Type) -> Answer {
        let holes = || self.faces().get(number).map(|face| face.loops().len() > 1);
        let holds = match kind {
            Type::Straight | Type::Planar => true,
            Type::Simple => holes() == Some(false),
            Type::Pierced => holes() == Some(true),
            Type::Circular | Type::Cylindrical | Type::Conical | Type::Spherical | Type::Whole => {
                false
            }
        };
        match holds {
            true => Answer::Yes,
            false => Answer::No,
        }
    }

    fn bends(&self, edge: usize, bend: Bend) -> Option<Answer> {
        let answer = match bend {
            Bend::Convex => self.convex(edge),
            Bend::Concave => self.concave(edge),
        };
        answer.ok()
    }

    fn is_curved(&self, _: usize, _: Bend) -> Answer {
        Answer::No
    }

    fn oriented(
        &self,
        (first, a): (Sort, usize),
        (second, b): (Sort, usize),
        orientation: Orientation,
    ) -> Result<Answer, GeometryError> {
        if (first, second) == (Sort::Face, Sort::Face) {
            let faces = self.faces();
            return Ok(match (faces.get(a), faces.get(b)) {
                (Some(a), Some(b)) => faces_oriented(a, b, orientation),
                _ => Answer::No,
            });
        }
        let (Some(along), Some(across)) = (direction(self, a, first)?, direction(self, b, second)?)
        else {
            return Ok(Answer::No);
        };
        let one_line = zero_vector(&cross(along.components(), across.components()));
        let right_angle = Answer::zero(dot(along.components(), across.components()).sign());
        // Of a face it is the normal that is looked at.
        let as_lines = first == second;
        Ok(match (orientation, as_lines) {
            (Orientation::Parallel, true) | (Orientation::Perpendicular, false) => one_line,
            (Orientation::Perpendicular, true) | (Orientation::Parallel, false) => right_angle,
            _ => Answer::No,
        })
    }

    fn equidistant(&self, _: (Sort, usize), _: (Sort, usize), _: (Sort, usize)) -> Answer {
        Answer::No
    }
}

/// The direction of an edge or the normal of a face.
fn direction<S: Scalar>(
    boundary: &Boundary<S>,
    number: usize,
    sort: Sort,
) -> Result<Option<Direction<S>>, GeometryError> {
    Ok(match sort {
        Sort::Edge => Some(boundary.segment(number)?.direction().clone()),
        Sort::Face => {
            let face = boundary.faces().get(number);
            face.map(|face| face.plane().normal().clone())
        }
    })
}

fn faces_oriented<S: Scalar>(a: &Face<S>, b: &Face<S>, orientation: Orientation) -> Answer {
    let (m, n) = (
        a.plane().normal().components(),
        b.plane().normal().components(),
    );
    let cosine = dot(m, n);
    if orientation == Orientation::Perpendicular {
        return Answer::zero(cosine.sign());
    }
    let parallel = zero_vector(&cross(m, n));
    if parallel.is_no() || orientation == Orientation::Parallel {
        return parallel;
    }
    let height = a.plane().height(&b.plane().point().0);
    let opposed = parallel.and(Answer::positive(cosine.negated().sign()));
    match orientation {
        Orientation::Coplanar => parallel
            .and(Answer::positive(cosine.sign()))
            .and(Answer::zero(height.sign())),
        Orientation::Facing => opposed.and(Answer::positive(height.sign())),
        Orientation::Away => opposed.and(Answer::positive(height.negated().sign())),
        Orientation::Parallel | Orientation::Perpendicular => parallel,
        // Flat faces have no axes.
        Orientation::Coaxial | Orientation::EqualRadius | Orientation::Larger => Answer::No,
    }
}
