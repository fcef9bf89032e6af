//! Whether material fills less or more than half of a turn about an edge.

use super::{Boundary, EdgeUse, Face};
use crate::decide::{Answer, zero_vector};
use crate::entity::{Entity, Point, no_pair};
use crate::error::GeometryError;
use crate::scalar::Scalar;
use crate::triple::{cross, dot, minus};

/// Positive where two faces meet at a convex edge, negative where at a concave one, zero where one continues the other or is
/// folded back on it. The first face passes the edge from the first point to the second.
fn bend<S: Scalar>(first: &Face<S>, second: &Face<S>, from: &Point<S>, to: &Point<S>) -> S {
    let m = first.plane().normal().components();
    let n = second.plane().normal().components();
    dot(&minus(&to.0, &from.0), &cross(m, n))
}

fn answer<S: Scalar>(bend: &S, wants_convex: bool) -> Answer {
    match wants_convex {
        true => Answer::positive(bend.sign()),
        false => Answer::positive(bend.negated().sign()),
    }
}

fn same<S: Scalar>(a: &Point<S>, b: &Point<S>) -> Answer {
    zero_vector(&minus(&a.0, &b.0))
}

/// Whether two faces that share edges in opposite senses meet at convex ones only: material, which is below both, fills less
/// than half of a turn about each. Where one face continues the other, and where it is folded back on it, neither this
/// nor [`concave`] holds.
///
/// # Errors
/// For other pairs, and where the faces share no edge in opposite senses.
pub fn convex<S: Scalar>(a: &Entity<S>, b: &Entity<S>) -> Result<Answer, GeometryError> {
    between(a, b, true)
}

/// Whether two faces that share edges in opposite senses meet at concave ones only: material, which is below both, fills
/// more than half of a turn about each.
///
/// # Errors
/// For other pairs, and where the faces share no edge in opposite senses.
pub fn concave<S: Scalar>(a: &Entity<S>, b: &Entity<S>) -> Result<Answer, GeometryError> {
    between(a, b, false)
}

fn between<S: Scalar>(
    a: &Entity<S>,
    b: &Entity<S>,
    wants_convex: bool,
) -> Result<Answer, GeometryError> {
    let (Entity::Face(first), Entity::Face(second)) = (a, b) else {
        let function = if wants_convex { "convex" } else { "concave" };
        return Err(no_pair(function, a, b));
    };
    let mut all: Option<Answer> = None;
    for (from, to) in first.edges() {
        for (other_from, other_to) in second.edges() {
            let start = same(from, other_to);
            if start.is_no() {
                continue;
            }
            let shared = start.and(same(to, other_from));
            if shared.is_no() {
                continue;
            }
            let own = answer(&bend(first, second, from, to), wants_convex).and(shared);
            all = Some(all.map_or(own, |so_far| so_far.and(own)));
        }
    }
    all.ok_or(GeometryError::Degenerate {
        needed: "two faces that share an edge, which each passes in another sense",
        found: "faces without one",
    })
}

impl<S: Scalar> Boundary<S> {
    /// Whether an edge between two faces is convex: material fills less than half of a turn about it.
    ///
    /// # Errors
    /// Where there is no such edge, and where it is not passed twice, in opposite senses.
    pub fn convex(&self, edge: usize) -> Result<Answer, GeometryError> {
        Ok(answer(&self.bend(edge)?, true))
    }

    /// Whether an edge between two faces is concave: material fills more than half of a turn about it.
    ///
    /// # Errors
    /// Where there is no such edge, and where it is not passed twice, in opposite senses.
    pub fn concave(&self, edge: usize) -> Result<Answer, GeometryError> {
        Ok(answer(&self.bend(edge)?, false))
    }

    /// Whether all edges at a vertex are convex.
    ///
    /// # Errors
    /// Where there is no such vertex, or no edge at it, and where one of them is not passed twice, in opposite senses.
    pub fn convex_vertex(&self, vertex: usize) -> Result<Answer, GeometryError> {
        self.all_at(vertex, true)
    }

    /// Whether all edges at a vertex are concave.
    ///
    /// # Errors
    /// Where there is no such vertex, or no edge at it, and where one of them is not passed twice, in opposite senses.
    pub fn concave_vertex(&self, vertex: usize) -> Result<Answer, GeometryError> {
        self.all_at(vertex, false)
    }

    fn all_at(&self, vertex: usize, wants_convex: bool) -> Result<Answer, GeometryError> {
        let edges = self.edges_of_vertex(vertex);
        if edges.is_empty() {
            return Err(GeometryError::Degenerate {
                needed: "the number of a vertex with edges",
                found: "one without any, or beyond the last",
            });
        }
        let mut all = Answer::Yes;
        for edge in edges {
            all = all.and(answer(&self.bend(*edge)?, wants_convex));
        }
        Ok(all)
    }

    fn bend(&self, edge: usize) -> Result<S, GeometryError> {
        let wrong = |found: &'static str| GeometryError::Degenerate {
            needed: "an edge that two faces pass in opposite senses",
            found,
        };
        let edge = self
            .edges
            .get(edge)
            .ok_or(wrong("a number beyond the last edge"))?;
        let (a, b) = match edge.uses.as_slice() {
            [a, b] if a.forward != b.forward => (a, b),
            [_, _] => return Err(wrong("one that both pass in the same sense")),
            [_] => return Err(wrong("one that a single face passes")),
            _ => return Err(wrong("one that is passed more than twice")),
        };
        let (first, second) = match a.forward {
            true => (a, b),
            false => (b, a),
        };
        let face = |pass: &EdgeUse| self.faces.get(pass.face);
        let [from, to] = edge.ends.map(|end| self.vertices.get(end));
        match (face(first), face(second), from, to) {
            (Some(f), Some(g), Some(from), Some(to)) => Ok(bend(f, g, from, to)),
            _ => Err(wrong("one without its faces")),
        }
    }
}
