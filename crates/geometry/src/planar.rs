//! Points in a plane: which side, in what order, their hull and what it encloses.

use crate::boundary::{Ratio, place_in_loops};
use crate::decide::{Decider, Outcome};
use crate::entity::{Direction, Entity, Point, no_pair};
use crate::error::GeometryError;
use crate::scalar::Scalar;
use crate::triple::{cross, dot, minus, plus, square};
use std::cmp::Ordering;

/// Where something is beside a plane, whose normal points up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Above, without touching it.
    Above,
    /// In the plane.
    In,
    /// Below, without touching it.
    Below,
    /// On both sides.
    Crossing,
    /// A segment with one end in the plane, a face with a part of its border there and the rest on one side.
    Touching,
}

/// Where a point is beside a polygon.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Inside.
    Inside,
    /// On an edge or at a corner.
    OnBorder,
    /// Outside, or not in the polygon's plane.
    Outside,
}

/// Coordinates in a plane, of any scale along each axis: orders, hulls and sides are the same in all of them.
type Flat<S> = [S; 2];

fn flat<S: Scalar>(offset: &[S; 3], axes: &[[S; 3]; 2]) -> Flat<S> {
    [dot(offset, &axes[0]), dot(offset, &axes[1])]
}

/// Positive where the second follows the first counterclockwise.
fn turn<S: Scalar>(a: &Flat<S>, b: &Flat<S>) -> S {
    a[0].times(&b[1]).minus(&a[1].times(&b[0]))
}

fn between<S: Scalar>(a: &Flat<S>, b: &Flat<S>) -> Flat<S> {
    [b[0].minus(&a[0]), b[1].minus(&a[1])]
}

/// On which side of a plane a point, a line, a segment or a face is.
///
/// # Errors
/// For other pairs.
pub fn classify<S: Scalar>(
    a: &Entity<S>,
    plane: &Entity<S>,
) -> Result<Outcome<Side>, GeometryError> {
    let Entity::Plane(p) = plane else {
        return Err(no_pair("classify", a, plane));
    };
    let mut decider = Decider::default();
    let side = |order: Ordering| match order {
        Ordering::Less => Side::Below,
        Ordering::Equal => Side::In,
        Ordering::Greater => Side::Above,
    };
    let found = match a {
        Entity::Point(point) => side(decider.order(&p.height(&point.0))),
        Entity::Line(line) => {
            let rise = dot(line.direction().components(), p.normal().components());
            match decider.is_zero(&rise) {
                true => side(decider.order(&p.height(&line.point().0))),
                false => Side::Crossing,
            }
        }
        Entity::Segment(segment) => {
            let from = decider.order(&p.height(&segment.from().0));
            let to = decider.order(&p.height(&segment.to().0));
            match (from, to) {
                (x, y) if x == y => side(x),
                (Ordering::Equal, _) | (_, Ordering::Equal) => Side::Touching,
                _ => Side::Crossing,
            }
        }
        Entity::Face(face) => of_heights(
            face.corners().map(|corner| p.height(&corner.0)),
            &mut decider,
        ),
        _ => return Err(no_pair("classify", a, plane)),
    };
    Ok(decider.outcome(found))
}

/// The side of something flat with straight edges, from the heights of its corners.
fn of_heights<S: Scalar>(heights: impl Iterator<Item = S>, decider: &mut Decider) -> Side {
    let (mut above, mut below, mut level) = (false, false, false);
    for height in heights {
        match decider.order(&height) {
            Ordering::Greater => above = true,
            Ordering::Less => below = true,
            Ordering::Equal => level = true,
        }
    }
    match (above, below, level) {
        (true, true, _) => Side::Crossing,
        (true, false, true) | (false, true, true) => Side::Touching,
        (true, false, false) => Side::Above,
        (false, true, false) => Side::Below,
        (false, false, _) => Side::In,
    }
}

/// Where a point is beside a polygon, given by its corners in order and the normal of its plane. It need not be convex;
/// where its edges cross each other, what they go around twice is outside.
///
/// # Errors
/// For fewer than three corners.
pub fn classify_in_polygon<S: Scalar>(
    point: &Point<S>,
    corners: &[Point<S>],
    normal: &Direction<S>,
) -> Result<Outcome<Place>, GeometryError> {
    let [first, _, _, ..] = corners else {
        return Err(GeometryError::Degenerate {
            needed: "three corners or more for a polygon",
            found: "fewer",
        });
    };
    let mut decider = Decider::default();
    let height = dot(&minus(&point.0, &first.0), normal.components());
    if !decider.is_zero(&height) {
        return Ok(decider.outcome(Place::Outside));
    }
    let at = Ratio::of(&point.0);
    let place = place_in_loops(&at, &[corners], normal.components(), &mut decider);
    Ok(decider.outcome(place))
}

/// A point on its way into an order: which one, where it is seen, and the square of its distance.
struct Seen<S> {
    index: usize,
    at: Flat<S>,
    square: S,
}

/// Points sorted by their angle about a centre, counterclockwise seen against the normal, from the direction of the first
/// one that is not the centre. Of points in one direction the nearer comes first; points at the centre come before all.
#[must_use]
pub fn sort_angular<S: Scalar>(
    points: &[Point<S>],
    centre: &Point<S>,
    normal: &Direction<S>,
) -> Outcome<Vec<Point<S>>> {
    let mut decider = Decider::default();
    let n = normal.components();
    let mut at_centre = Vec::new();
    let mut others = Vec::new();
    let mut axes: Option<[[S; 3]; 2]> = None;
    for (index, point) in points.iter().enumerate() {
        let offset = minus(&point.0, &centre.0);
        let left = cross(n, &offset);
        if decider.vanishes(&left) {
            at_centre.push(point.clone());
            continue;
        }
        // The first is where angles begin, with no doubt about its digits.
        let at = match &axes {
            Some(axes) => flat(&offset, axes),
            None => [S::whole(1), S::whole(0)],
        };
        axes.get_or_insert_with(|| [cross(&left, n), left]);
        others.push(Seen {
            index,
            at,
            square: square(&offset),
        });
    }
    let order = sorted(others, |a, b| by_angle(a, b, &mut decider));
    let rest = order
        .into_iter()
        .filter_map(|seen| points.get(seen.index).cloned());
    at_centre.extend(rest);
    decider.outcome(at_centre)
}

fn by_angle<S: Scalar>(a: &Seen<S>, b: &Seen<S>, decider: &mut Decider) -> Ordering {
    let mut second_half = |seen: &Seen<S>| match decider.order(&seen.at[1]) {
        Ordering::Greater => false,
        Ordering::Less => true,
        Ordering::Equal => decider.order(&seen.at[0]) == Ordering::Less,
    };
    second_half(a)
        .cmp(&second_half(b))
        .then_with(|| decider.order(&turn(&b.at, &a.at)))
        .then_with(|| decider.order(&a.square.minus(&b.square)))
}

/// Stable, by binary insertion. The standard sort may refuse an order that is none, which an order within digits can be.
pub(crate) fn sorted<T>(items: Vec<T>, mut order: impl FnMut(&T, &T) -> Ordering) -> Vec<T> {
    let mut done: Vec<T> = Vec::with_capacity(items.len());
    for item in items {
        let (mut low, mut high) = (0, done.len());
        while low < high {
            let middle = low + (high - low) / 2;
            match done.get(middle) {
                Some(other) if order(other, &item) != Ordering::Greater => low = middle + 1,
                _ => high = middle,
            }
        }
        done.insert(low, item);
    }
    done
}

/// The corners of the convex hull of points, as seen along the normal: counterclockwise seen against it, without points on
/// edges and without doubles. Two for points on one line, one where all are one point as seen, none for none.
#[must_use]
pub fn planar_hull<S: Scalar>(
    points: &[Point<S>],
    normal: &Direction<S>,
) -> Outcome<Vec<Point<S>>> {
    let mut decider = Decider::default();
    let axes = normal.across();
    let seen: Vec<(usize, Flat<S>)> = points
        .iter()
        .enumerate()
        .map(|(index, point)| (index, flat(&point.0, &axes)))
        .collect();
    let mut order = sorted(seen, |a, b| {
        let across = between(&b.1, &a.1);
        decider
            .order(&across[0])
            .then_with(|| decider.order(&across[1]))
    });
    order.dedup_by(|a, b| {
        let [x, y] = between(&a.1, &b.1);
        decider.is_zero(&x) && decider.is_zero(&y)
    });
    // There and back along the sorted points (Andrew 1979), always turning left.
    let mut corners = chain(order.iter(), &mut decider);
    let back = chain(order.iter().rev(), &mut decider);
    if order.len() > 1 {
        corners.pop();
        corners.extend(back);
        corners.pop();
    }
    let hull = corners
        .into_iter()
        .filter_map(|(index, _)| points.get(*index).cloned())
        .collect();
    decider.outcome(hull)
}

fn chain<'a, S: Scalar + 'a>(
    order: impl Iterator<Item = &'a (usize, Flat<S>)>,
    decider: &mut Decider,
) -> Vec<&'a (usize, Flat<S>)> {
    let mut corners: Vec<&'a (usize, Flat<S>)> = Vec::new();
    for next in order {
        while let [.., a, b] = corners.as_slice() {
            let bend = turn(&between(&a.1, &b.1), &between(&a.1, &next.1));
            if decider.order(&bend) == Ordering::Greater {
                break;
            }
            corners.pop();
        }
        corners.push(next);
    }
    corners
}

/// The normal of a polygon, of twice its area in length, so that its corners follow each other counterclockwise seen
/// against it (Newell's sum); `None` where the area is zero, as of fewer than three corners.
///
/// # Errors
/// Where the area is certainly not zero and no direction can be made of it, beyond the range of numbers.
pub fn calculate_normal<S: Scalar>(
    corners: &[Point<S>],
) -> Result<Outcome<Option<Direction<S>>>, GeometryError> {
    let mut decider = Decider::default();
    let zero = || S::whole(0);
    let mut normal = [zero(), zero(), zero()];
    if let Some(first) = corners.first() {
        for (a, b) in corners.iter().skip(1).zip(corners.iter().skip(2)) {
            let part = cross(&minus(&a.0, &first.0), &minus(&b.0, &first.0));
            normal = plus(&normal, &part);
        }
    }
    Ok(match decider.vanishes(&normal) {
        true => decider.outcome(None),
        false => decider.outcome(Some(Direction::new(normal)?)),
    })
}
