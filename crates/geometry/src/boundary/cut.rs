//! What lines, segments and planes have in common with a face.

use super::Face;
use super::inside::Ratio;
use crate::decide::{Decider, Outcome};
use crate::entity::{Entity, Found, Line, Plane, Point, Segment, no_pair};
use crate::error::GeometryError;
use crate::planar::{Place, sorted};
use crate::scalar::Scalar;
use crate::triple::{cross, dot, minus, scaled, square};
use std::cmp::Ordering;
use std::iter::once;

/// A place on the line of a cut where the face may begin or end.
struct Mark<S> {
    /// How far along the line, times `over`.
    way: S,
    /// Certainly above zero.
    over: S,
    at: Ratio<S>,
    on_border: bool,
}

impl<S: Scalar> Mark<S> {
    fn of(point: &[S; 3], way: S, on_border: bool) -> Self {
        Self {
            way,
            over: S::whole(1),
            at: Ratio::of(point),
            on_border,
        }
    }
}

/// A corner beside the line of a cut.
struct Corner<'a, S> {
    point: &'a [S; 3],
    /// On one side above zero, on the other below.
    across: S,
    side: Ordering,
    way: S,
}

/// Where the edge between two corners on different sides crosses the line.
fn between<S: Scalar>(a: &Corner<'_, S>, b: &Corner<'_, S>) -> Mark<S> {
    let (low, high) = match a.side {
        Ordering::Less => (a, b),
        _ => (b, a),
    };
    let part = |x: &S, y: &S| x.times(&high.across).minus(&y.times(&low.across));
    let over = high.across.minus(&low.across);
    Mark {
        way: part(&low.way, &high.way),
        over: over.clone(),
        at: Ratio {
            numerators: [0, 1, 2].map(|i| part(&low.point[i], &high.point[i])),
            divisor: over,
        },
        on_border: true,
    }
}

fn compare<S: Scalar>(a: &Mark<S>, b: &Mark<S>, decider: &mut Decider) -> Ordering {
    let difference = a.way.times(&b.over).minus(&b.way.times(&a.over));
    decider.order(&difference)
}

/// Where the border of a face meets the line.
fn marks_of<S: Scalar>(
    face: &Face<S>,
    across: impl Fn(&[S; 3]) -> S,
    way: impl Fn(&[S; 3]) -> S,
    decider: &mut Decider,
) -> Vec<Mark<S>> {
    let mut marks = Vec::new();
    for ring in face.loops() {
        let mut corners = Vec::with_capacity(ring.len());
        for corner in ring {
            let off = across(&corner.0);
            corners.push(Corner {
                point: &corner.0,
                side: decider.order(&off),
                across: off,
                way: way(&corner.0),
            });
        }
        for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            if a.side == Ordering::Equal {
                marks.push(Mark::of(a.point, a.way.clone(), true));
            } else if b.side == a.side.reverse() {
                marks.push(between(a, b));
            }
        }
    }
    marks
}

/// The parts of a line that belong to a face, in the order in which the line comes to them. The line lies in the plane of
/// the face, where `across` is zero; `way` tells how far along it a point of it is.
fn cut<S: Scalar>(
    face: &Face<S>,
    across: impl Fn(&[S; 3]) -> S,
    way: impl Fn(&[S; 3]) -> S,
    ends: Option<[Mark<S>; 2]>,
    decider: &mut Decider,
) -> Result<Vec<Found<S>>, GeometryError> {
    let mut marks = marks_of(face, across, way, decider);
    if let Some([first, last]) = ends {
        marks.retain(|mark| {
            compare(mark, &first, decider) != Ordering::Less
                && compare(mark, &last, decider) != Ordering::Greater
        });
        marks.push(first);
        marks.push(last);
    }
    let mut marks = sorted(marks, |a, b| compare(a, b, decider));
    marks.dedup_by(|later, kept| {
        let same = compare(later, kept, decider) == Ordering::Equal;
        kept.on_border |= same && later.on_border;
        same
    });
    // Between two marks next to each other the line meets no border, unless it follows an edge: one point tells for all.
    let mut goes_on = Vec::with_capacity(marks.len());
    for (a, b) in marks.iter().zip(marks.iter().skip(1)) {
        let middle = Ratio::middle(&a.at, &b.at);
        goes_on.push(face.place(&middle, decider) != Place::Outside);
    }
    let mut found = Vec::new();
    let mut start: Option<&Mark<S>> = None;
    for (mark, after) in marks.iter().zip(goes_on.into_iter().chain(once(false))) {
        match (start, after) {
            (None, true) => start = Some(mark),
            (Some(from), false) => {
                found.push(part(from, mark, decider)?);
                start = None;
            }
            (None, false) => {
                if mark.on_border || face.place(&mark.at, decider) != Place::Outside {
                    found.push(Found::Point(mark.at.point()?));
                }
            }
            (Some(_), true) => {}
        }
    }
    Ok(found)
}

fn part<S: Scalar>(
    from: &Mark<S>,
    to: &Mark<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let (from, to) = (from.at.point()?, to.at.point()?);
    Ok(match decider.vanishes(&minus(&to.0, &from.0)) {
        true => Found::Point(from),
        false => Found::Segment(Segment::new(from, to)?),
    })
}

/// The parts of a line in the plane of a face that belong to the face.
pub(crate) fn clip_line<S: Scalar>(
    line: &Line<S>,
    face: &Face<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let direction = line.direction().components();
    clip(face, &line.point().0, direction, None, decider)
}

/// The parts of a segment in the plane of a face that belong to the face.
pub(crate) fn clip_segment<S: Scalar>(
    segment: &Segment<S>,
    face: &Face<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let direction = segment.direction().components();
    let ends = [
        Mark::of(&segment.from().0, S::whole(0), false),
        Mark::of(&segment.to().0, square(direction), false),
    ];
    clip(face, &segment.from().0, direction, Some(ends), decider)
}

fn clip<S: Scalar>(
    face: &Face<S>,
    base: &[S; 3],
    direction: &[S; 3],
    ends: Option<[Mark<S>; 2]>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let left = cross(face.plane().normal().components(), direction);
    let across = |point: &[S; 3]| dot(&minus(point, base), &left);
    let way = |point: &[S; 3]| dot(&minus(point, base), direction);
    Ok(Found::of(cut(face, across, way, ends, decider)?))
}

fn at<S: Scalar>(
    place: &Ratio<S>,
    face: &Face<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    Ok(match face.place(place, decider) {
        Place::Outside => Found::Nothing,
        Place::Inside | Place::OnBorder => Found::Point(place.point()?),
    })
}

/// Where a line with this rise goes through a plane, from a point at this height.
pub(super) fn pierced<S: Scalar>(
    point: &[S; 3],
    direction: &[S; 3],
    height: &S,
    rise: &S,
) -> Ratio<S> {
    Ratio {
        numerators: minus(&scaled(point, rise), &scaled(direction, height)),
        divisor: rise.clone(),
    }
}

/// What a line and a face have in common.
pub(crate) fn of_line<S: Scalar>(
    line: &Line<S>,
    face: &Face<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let direction = line.direction().components();
    let rise = dot(direction, face.plane().normal().components());
    let height = face.plane().height(&line.point().0);
    if decider.is_zero(&rise) {
        return match decider.is_zero(&height) {
            true => clip_line(line, face, decider),
            false => Ok(Found::Nothing),
        };
    }
    let place = pierced(&line.point().0, direction, &height, &rise);
    at(&place, face, decider)
}

/// What a segment and a face have in common.
pub(crate) fn of_segment<S: Scalar>(
    segment: &Segment<S>,
    face: &Face<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let (from, to) = (&segment.from().0, &segment.to().0);
    let (low, high) = (face.plane().height(from), face.plane().height(to));
    match (decider.order(&low), decider.order(&high)) {
        (Ordering::Equal, Ordering::Equal) => clip_segment(segment, face, decider),
        (Ordering::Equal, _) => at(&Ratio::of(from), face, decider),
        (_, Ordering::Equal) => at(&Ratio::of(to), face, decider),
        (x, y) if x == y => Ok(Found::Nothing),
        _ => {
            let place = Ratio {
                numerators: minus(&scaled(to, &low), &scaled(from, &high)),
                divisor: low.minus(&high),
            };
            at(&place, face, decider)
        }
    }
}

/// What a plane and a face have in common: segments and points, or the face itself.
pub(crate) fn of_plane<S: Scalar>(
    plane: &Plane<S>,
    face: &Face<S>,
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let base = face.plane().point();
    let edge = cross(
        face.plane().normal().components(),
        plane.normal().components(),
    );
    if decider.vanishes(&edge) {
        return Ok(match decider.is_zero(&plane.height(&base.0)) {
            true => Found::Face(face.clone()),
            false => Found::Nothing,
        });
    }
    let across = |point: &[S; 3]| plane.height(point);
    let way = |point: &[S; 3]| dot(&minus(point, &base.0), &edge);
    Ok(Found::of(cut(face, across, way, None, decider)?))
}

/// Where a line or a segment is beside a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FacePlace {
    /// Without a common point.
    Apart,
    /// With points of the border in common only, or with nothing but an end.
    Touching,
    /// It goes through a point inside.
    Piercing,
    /// It runs through the inside.
    Within,
}

/// Where a line or a segment is beside a face.
///
/// # Errors
/// For other entities than a line or a segment and a face, and beyond the range of numbers.
pub fn classify_by_face<S: Scalar>(
    a: &Entity<S>,
    face: &Entity<S>,
) -> Result<Outcome<FacePlace>, GeometryError> {
    let mut decider = Decider::default();
    let (found, own, ends) = match (a, face) {
        (Entity::Line(line), Entity::Face(f)) => (of_line(line, f, &mut decider)?, f, None),
        (Entity::Segment(segment), Entity::Face(f)) => {
            let ends = Some([segment.from(), segment.to()]);
            (of_segment(segment, f, &mut decider)?, f, ends)
        }
        _ => return Err(no_pair("classify_by_face", a, face)),
    };
    let mut place = FacePlace::Apart;
    for part in found.parts() {
        let next = match part {
            Found::Point(point) => of_point(point, own, ends, &mut decider),
            Found::Segment(s) => {
                let middle = Ratio::middle(&Ratio::of(&s.from().0), &Ratio::of(&s.to().0));
                match own.place(&middle, &mut decider) {
                    Place::Inside => FacePlace::Within,
                    _ => FacePlace::Touching,
                }
            }
            _ => FacePlace::Apart,
        };
        // Of several parts one that runs inside tells more than those that touch.
        if next == FacePlace::Within || place == FacePlace::Apart {
            place = next;
        }
    }
    Ok(decider.outcome(place))
}

/// What a single common point says.
fn of_point<S: Scalar>(
    point: &Point<S>,
    face: &Face<S>,
    ends: Option<[&Point<S>; 2]>,
    decider: &mut Decider,
) -> FacePlace {
    let is_end = |decider: &mut Decider| {
        ends.is_some_and(|ends| {
            ends.iter()
                .any(|end| decider.vanishes(&minus(&point.0, &end.0)))
        })
    };
    match face.place(&Ratio::of(&point.0), decider) {
        Place::Inside if !is_end(decider) => FacePlace::Piercing,
        _ => FacePlace::Touching,
    }
}
