//! Flat faces with holes.

use super::inside::{Ratio, place_in_loops};
use crate::decide::{Answer, Certainty, Decider, zero_vector};
use crate::entity::{Direction, Plane, Point};
use crate::error::{GeometryError, Spot};
use crate::planar::{Place, calculate_normal};
use crate::scalar::Scalar;
use crate::triple::{cross, dot, minus};
use std::cmp::Ordering;

/// A part of a plane between loops of straight edges, which belong to it.
///
/// The first loop is the outer one, and its corners follow each other counterclockwise seen against the normal; the others are
/// holes, and go round the other way. A loop may touch itself or another at a corner. That no two edges cross is not
/// looked for; where they do, what is gone around twice is outside.
#[derive(Clone, Debug)]
pub struct Face<S> {
    plane: Plane<S>,
    loops: Vec<Vec<Point<S>>>,
    certainty: Certainty,
}

/// An error at a corner of a loop.
fn wrong(
    ring: usize,
    corner: Option<usize>,
    needed: &'static str,
    found: &'static str,
) -> GeometryError {
    GeometryError::NoFace {
        spot: Spot {
            face: None,
            ring: Some(ring),
            corner,
        },
        needed,
        found,
    }
}

impl<S: Scalar> Face<S> {
    /// The face between loops, given by their corners in order: the outer loop, then holes. The outer loop says which side
    /// the normal is on.
    ///
    /// # Errors
    /// Each names the loop and, where it is one, the corner: a loop of fewer than three corners; an edge without length, or
    /// that may have none within its digits; a loop without area; a corner off the plane; a hole that goes round like the
    /// outer loop, or reaches outside of it.
    pub fn new(loops: Vec<Vec<Point<S>>>) -> Result<Self, GeometryError> {
        let mut decider = Decider::default();
        for (ring, corners) in loops.iter().enumerate() {
            has_edges(ring, corners)?;
        }
        let Some((outer, holes)) = loops.split_first() else {
            return Err(wrong(0, None, "an outer loop", "none"));
        };
        let normal = normal_of(0, outer, &mut decider)?;
        let Some(base) = outer.first() else {
            return Err(wrong(0, None, "an outer loop", "none"));
        };
        let plane = Plane::new(base.clone(), normal);
        is_flat(&plane, &loops, &mut decider)?;
        for (ring, hole) in holes.iter().enumerate() {
            is_hole(ring + 1, hole, outer, &plane, &mut decider)?;
        }
        let certainty = decider.certainty();
        Ok(Self {
            plane,
            loops,
            certainty,
        })
    }

    /// The same face elsewhere: nothing that was checked changes by a motion.
    pub(crate) fn moved(&self, plane: Plane<S>, place: impl Fn(&Point<S>) -> Point<S>) -> Self {
        Self {
            plane,
            loops: self
                .loops
                .iter()
                .map(|ring| ring.iter().map(&place).collect())
                .collect(),
            certainty: self.certainty,
        }
    }

    /// Its plane, above which is outside.
    #[must_use]
    pub fn plane(&self) -> &Plane<S> {
        &self.plane
    }

    /// The corners of its loops in order: the outer loop first.
    #[must_use]
    pub fn loops(&self) -> &[Vec<Point<S>>] {
        &self.loops
    }

    /// How certain it is that it is flat and that its holes are inside.
    #[must_use]
    pub fn certainty(&self) -> Certainty {
        self.certainty
    }

    /// The corners of all loops.
    pub fn corners(&self) -> impl Iterator<Item = &Point<S>> {
        self.loops.iter().flatten()
    }

    /// The ends of all edges, each from one corner to the next of its loop.
    pub fn edges(&self) -> impl Iterator<Item = (&Point<S>, &Point<S>)> {
        self.loops
            .iter()
            .flat_map(|ring| ring.iter().zip(ring.iter().cycle().skip(1)))
    }

    /// Where a point of its plane is.
    pub(crate) fn place(&self, at: &Ratio<S>, decider: &mut Decider) -> Place {
        let loops: Vec<&[Point<S>]> = self.loops.iter().map(Vec::as_slice).collect();
        place_in_loops(at, &loops, self.plane.normal().components(), decider)
    }

    /// Whether the face takes up less than half of a turn at a corner of one of its loops: a corner of the outer loop of
    /// a convex face does, one of a hole in it does not. On a straight border neither this nor [`Face::concave_corner`] holds.
    ///
    /// # Errors
    /// Where there is no such corner.
    pub fn convex_corner(&self, ring: usize, corner: usize) -> Result<Answer, GeometryError> {
        Ok(Answer::positive(self.bend_at(ring, corner)?.sign()))
    }

    /// Whether the face takes up more than half of a turn at a corner of one of its loops.
    ///
    /// # Errors
    /// Where there is no such corner.
    pub fn concave_corner(&self, ring: usize, corner: usize) -> Result<Answer, GeometryError> {
        let bend = self.bend_at(ring, corner)?;
        Ok(Answer::positive(bend.negated().sign()))
    }

    /// Positive where the loop turns to the left at the corner.
    fn bend_at(&self, ring: usize, corner: usize) -> Result<S, GeometryError> {
        let corners = self.loops.get(ring).map_or(&[][..], Vec::as_slice);
        let count = corners.len();
        let at = |offset: usize| corners.get((corner + offset) % count.max(1));
        let three = (corner < count).then(|| (at(count.saturating_sub(1)), at(0), at(1)));
        let Some((Some(a), Some(b), Some(c))) = three else {
            return Err(wrong(ring, Some(corner), "a corner of the face", "none"));
        };
        let turn = cross(&minus(&b.0, &a.0), &minus(&c.0, &b.0));
        Ok(dot(&turn, self.plane.normal().components()))
    }
}

/// Three corners or more, and edges that have a length.
fn has_edges<S: Scalar>(ring: usize, corners: &[Point<S>]) -> Result<(), GeometryError> {
    if corners.len() < 3 {
        let found = "fewer: give every corner once, the first not again at the end";
        return Err(wrong(ring, None, "three corners or more for a loop", found));
    }
    let next = corners.iter().cycle().skip(1);
    for (corner, (a, b)) in corners.iter().zip(next).enumerate() {
        let found = match zero_vector(&minus(&b.0, &a.0)) {
            Answer::No => continue,
            Answer::Yes => "the same point again: leave out one of both",
            Answer::WithinDigits => "a point that may be the same within its digits",
            Answer::Indistinguishable => "a point that no digits tell from it",
        };
        let needed = "another point for the corner after it";
        return Err(wrong(ring, Some(corner), needed, found));
    }
    Ok(())
}

/// The normal of a loop, against which it is seen going round counterclockwise.
fn normal_of<S: Scalar>(
    ring: usize,
    corners: &[Point<S>],
    decider: &mut Decider,
) -> Result<Direction<S>, GeometryError> {
    let normal = calculate_normal(corners)?;
    let certainty = normal.certainty;
    let Some(direction) = normal.value else {
        let found = match certainty {
            Certainty::Proven => {
                "none: its corners are on a line, or it goes back on its own edges"
            }
            Certainty::WithinDigits => "one that may be 0 within its digits",
            Certainty::Indistinguishable => "one that no digits tell from 0",
        };
        return Err(wrong(ring, None, "a loop with an area", found));
    };
    decider.weaken(certainty);
    Ok(direction)
}

/// No corner is certainly off the plane.
fn is_flat<S: Scalar>(
    plane: &Plane<S>,
    loops: &[Vec<Point<S>>],
    decider: &mut Decider,
) -> Result<(), GeometryError> {
    for (ring, corners) in loops.iter().enumerate() {
        for (corner, point) in corners.iter().enumerate() {
            if !decider.is_zero(&plane.height(&point.0)) {
                let found = "one beside it: split the face along a line between two corners";
                let needed = "a corner in the plane of the outer loop";
                return Err(wrong(ring, Some(corner), needed, found));
            }
        }
    }
    Ok(())
}

/// A hole goes round the other way, and nowhere outside of the outer loop.
fn is_hole<S: Scalar>(
    ring: usize,
    hole: &[Point<S>],
    outer: &[Point<S>],
    plane: &Plane<S>,
    decider: &mut Decider,
) -> Result<(), GeometryError> {
    let own = normal_of(ring, hole, decider)?;
    let sense = dot(own.components(), plane.normal().components());
    if decider.order(&sense) == Ordering::Greater {
        let found = "one that goes round like it: give its corners in the reversed order";
        let needed = "a hole that goes round against the outer loop";
        return Err(wrong(ring, None, needed, found));
    }
    for (corner, point) in hole.iter().enumerate() {
        let mut choice = Decider::default();
        let at = Ratio::of(&point.0);
        let place = place_in_loops(&at, &[outer], plane.normal().components(), &mut choice);
        let certainty = choice.certainty();
        if place == Place::Outside && certainty == Certainty::Proven {
            let found = "one outside of it: it may belong to another face";
            let needed = "a corner of a hole inside of the outer loop";
            return Err(wrong(ring, Some(corner), needed, found));
        }
        decider.weaken(certainty);
    }
    Ok(())
}
