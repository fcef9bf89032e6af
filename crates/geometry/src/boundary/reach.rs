//! Squares of distances to segments and faces.

use super::cut::{of_line, of_segment};
use super::{Face, Ratio};
use crate::decide::{Answer, Decider, Outcome};
use crate::entity::{Found, Line, Plane, Point, Segment};
use crate::error::GeometryError;
use crate::planar::Place;
use crate::scalar::Scalar;
use crate::triple::{cross, dot, minus, quotient, scaled, square};
use std::cmp::Ordering;

/// The least of some squares, and what their cases were chosen by; those that are certainly greater do not matter.
#[derive(Debug)]
struct Least<S> {
    candidates: Vec<Outcome<S>>,
}

impl<S: Scalar> Least<S> {
    fn new() -> Self {
        Self {
            candidates: Vec::new(),
        }
    }

    /// One more, chosen by itself.
    fn ask(
        &mut self,
        square: impl FnOnce(&mut Decider) -> Result<S, GeometryError>,
    ) -> Result<(), GeometryError> {
        let mut own = Decider::default();
        let value = square(&mut own)?;
        self.candidates.push(own.outcome(value));
        Ok(())
    }

    fn take(self, decider: &mut Decider) -> Result<S, GeometryError> {
        let values = self.candidates.iter().map(|c| c.value.clone());
        let least = values.reduce(|a, b| a.least(&b));
        let least = least.ok_or(GeometryError::Degenerate {
            needed: "something to have a distance from",
            found: "nothing",
        })?;
        for candidate in self.candidates {
            if !Answer::positive(candidate.value.minus(&least).sign()).is_yes() {
                decider.weaken(candidate.certainty);
            }
        }
        Ok(least)
    }
}

fn point_to_line<S: Scalar>(
    point: &[S; 3],
    base: &[S; 3],
    direction: &[S; 3],
) -> Result<S, GeometryError> {
    let across = cross(&minus(point, base), direction);
    quotient(&square(&across), &square(direction))
}

/// From the nearer end where the foot is outside.
fn point_to_edge<S: Scalar>(
    point: &[S; 3],
    from: &[S; 3],
    to: &[S; 3],
    decider: &mut Decider,
) -> Result<S, GeometryError> {
    let direction = minus(to, from);
    let (after, before) = (minus(point, from), minus(to, point));
    if decider.order(&dot(&after, &direction)) == Ordering::Less {
        return Ok(square(&after));
    }
    if decider.order(&dot(&before, &direction)) == Ordering::Less {
        return Ok(square(&before));
    }
    point_to_line(point, from, &direction)
}

/// The square of the distance of two lines that are not parallel, where the foot on the second is between its ends, and
/// the one on the first as well if it has ends too.
fn across<S: Scalar>(
    first: (&[S; 3], &[S; 3]),
    first_ends: bool,
    second: (&[S; 3], &[S; 3]),
    decider: &mut Decider,
) -> Result<Option<S>, GeometryError> {
    let common = cross(first.1, second.1);
    if decider.vanishes(&common) {
        return Ok(None);
    }
    let offset = minus(second.0, first.0);
    let size = square(&common);
    let mut is_between = |direction: &[S; 3]| {
        let way = dot(&cross(&offset, direction), &common);
        decider.order(&way) != Ordering::Less && decider.order(&size.minus(&way)) != Ordering::Less
    };
    if !is_between(first.1) || first_ends && !is_between(second.1) {
        return Ok(None);
    }
    let way = dot(&offset, &common);
    Ok(Some(quotient(&way.squared(), &size)?))
}

/// The square of the distance of two segments.
pub(crate) fn between_segments<S: Scalar>(
    a: (&[S; 3], &[S; 3]),
    b: (&[S; 3], &[S; 3]),
    decider: &mut Decider,
) -> Result<S, GeometryError> {
    let mut least = Least::new();
    for (point, other) in [(a.0, b), (a.1, b), (b.0, a), (b.1, a)] {
        least.ask(|own| point_to_edge(point, other.0, other.1, own))?;
    }
    let (d, e) = (minus(a.1, a.0), minus(b.1, b.0));
    let mut own = Decider::default();
    match across((a.0, &d), true, (b.0, &e), &mut own)? {
        Some(value) => least.candidates.push(own.outcome(value)),
        // Where no foot is between ends an end is nearest; that none is may be in doubt.
        None => decider.weaken(own.certainty()),
    }
    least.take(decider)
}

/// The square of the distance of a line and a segment.
pub(crate) fn line_to_segment<S: Scalar>(
    line: &Line<S>,
    from: &[S; 3],
    to: &[S; 3],
    decider: &mut Decider,
) -> Result<S, GeometryError> {
    let (base, direction) = (&line.point().0, line.direction().components());
    let mut least = Least::new();
    for end in [from, to] {
        least.ask(|_| point_to_line(end, base, direction))?;
    }
    let along = minus(to, from);
    let mut own = Decider::default();
    match across((base, direction), false, (from, &along), &mut own)? {
        Some(value) => least.candidates.push(own.outcome(value)),
        None => decider.weaken(own.certainty()),
    }
    least.take(decider)
}

/// The square of the distance of a plane and points on straight edges: zero where they are not all on one side.
pub(crate) fn plane_to_points<'a, S: Scalar + 'a>(
    plane: &Plane<S>,
    points: impl Iterator<Item = &'a Point<S>>,
    decider: &mut Decider,
) -> Result<S, GeometryError> {
    let size = square(plane.normal().components());
    let mut side: Option<Ordering> = None;
    let mut least: Option<S> = None;
    for point in points {
        let height = plane.height(&point.0);
        let own = decider.order(&height);
        if own == Ordering::Equal || side.is_some_and(|side| side != own) {
            return Ok(S::whole(0));
        }
        side = Some(own);
        let height = height.magnitude();
        least = Some(least.map_or(height.clone(), |so_far| so_far.least(&height)));
    }
    let height = least.unwrap_or(S::whole(0));
    quotient(&height.squared(), &size)
}

/// The square of the distance of a plane and a face.
pub(crate) fn plane_to_face<S: Scalar>(
    plane: &Plane<S>,
    face: &Face<S>,
    decider: &mut Decider,
) -> Result<S, GeometryError> {
    plane_to_points(plane, face.corners(), decider)
}

/// The square of the distance of a point and a face.
pub(crate) fn point_to_face<S: Scalar>(
    point: &[S; 3],
    face: &Face<S>,
    decider: &mut Decider,
) -> Result<S, GeometryError> {
    let normal = face.plane().normal().components();
    let height = face.plane().height(point);
    let size = square(normal);
    let foot = Ratio {
        numerators: minus(&scaled(point, &size), &scaled(normal, &height)),
        divisor: size.clone(),
    };
    if face.place(&foot, decider) != Place::Outside {
        return quotient(&height.squared(), &size);
    }
    let mut least = Least::new();
    for (from, to) in face.edges() {
        least.ask(|own| point_to_edge(point, &from.0, &to.0, own))?;
    }
    least.take(decider)
}

/// The square of the distance of a line and a face: off the face its border is nearest.
pub(crate) fn line_to_face<S: Scalar>(
    line: &Line<S>,
    face: &Face<S>,
    decider: &mut Decider,
) -> Result<S, GeometryError> {
    if !matches!(of_line(line, face, decider)?, Found::Nothing) {
        return Ok(S::whole(0));
    }
    let mut least = Least::new();
    for (from, to) in face.edges() {
        least.ask(|own| line_to_segment(line, &from.0, &to.0, own))?;
    }
    least.take(decider)
}

/// The square of the distance of a segment and a face: off the face its border or an end of the segment is nearest.
pub(crate) fn segment_to_face<S: Scalar>(
    segment: &Segment<S>,
    face: &Face<S>,
    decider: &mut Decider,
) -> Result<S, GeometryError> {
    if !matches!(of_segment(segment, face, decider)?, Found::Nothing) {
        return Ok(S::whole(0));
    }
    let own = (&segment.from().0, &segment.to().0);
    let mut least = Least::new();
    for end in [own.0, own.1] {
        least.ask(|own| point_to_face(end, face, own))?;
    }
    for (from, to) in face.edges() {
        least.ask(|choice| between_segments(own, (&from.0, &to.0), choice))?;
    }
    least.take(decider)
}

/// The square of the distance of two faces: where they are apart, the border of one of both is nearest.
pub(crate) fn between_faces<S: Scalar>(
    a: &Face<S>,
    b: &Face<S>,
    decider: &mut Decider,
) -> Result<S, GeometryError> {
    let mut least = Least::new();
    for (face, other) in [(a, b), (b, a)] {
        for (from, to) in face.edges() {
            let edge = Segment::new(from.clone(), to.clone())?;
            least.ask(|own| segment_to_face(&edge, other, own))?;
        }
    }
    least.take(decider)
}
