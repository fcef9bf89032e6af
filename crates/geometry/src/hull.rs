//! The convex hull of points in space, point after point.

use crate::boundary::{Boundary, BoundaryBuilder, Face};
use crate::decide::{Certainty, Decider, Outcome};
use crate::entity::{Direction, Found, Point, Segment};
use crate::error::GeometryError;
use crate::planar::planar_hull;
use crate::scalar::Scalar;
use crate::triple::{cross, dot, minus};
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

/// The convex hull of points: the boundary of a solid without vertices on edges or in faces, each of its faces as large as it
/// is flat. Of points in a plane it is a face, of points on a line a segment, of equal points a point, of none nothing.
///
/// Each point is looked at from each face that there is so far, so that the time grows with the square of their
/// number. In measured numbers a point that is not certainly outside counts as inside, and faces that may be one are
/// merged where the merged one may be flat.
///
/// # Errors
/// Beyond the range of numbers, and where uncertain digits leave no closed boundary.
pub fn space_hull<S: Scalar>(points: &[Point<S>]) -> Result<Outcome<Found<S>>, GeometryError> {
    let mut decider = Decider::default();
    let Some(origin) = points.first() else {
        return Ok(decider.outcome(Found::Nothing));
    };
    let offset = |point: &Point<S>| minus(&point.0, &origin.0);
    let second = first_off(points, &mut decider, |p, own| own.vanishes(&offset(p)));
    let Some((b, along)) = second.and_then(|b| Some((b, offset(points.get(b)?)))) else {
        return Ok(decider.outcome(Found::Point(origin.clone())));
    };
    let third = first_off(points, &mut decider, |p, own| {
        own.vanishes(&cross(&along, &offset(p)))
    });
    let Some((c, normal)) = third.and_then(|c| Some((c, cross(&along, &offset(points.get(c)?)))))
    else {
        let found = on_a_line(points, &along, &mut decider)?;
        return Ok(decider.outcome(found));
    };
    let fourth = first_off(points, &mut decider, |p, own| {
        own.is_zero(&dot(&normal, &offset(p)))
    });
    let Some((d, height)) = fourth.and_then(|d| Some((d, dot(&normal, &offset(points.get(d)?)))))
    else {
        let found = in_a_plane(points, normal, &mut decider)?;
        return Ok(decider.outcome(found));
    };
    let mut hull = Growing::new(points);
    let below = decider.order(&height) == Ordering::Less;
    let (b, c) = if below { (b, c) } else { (c, b) };
    for corners in [[0, b, c], [0, d, b], [b, d, c], [c, d, 0]] {
        hull.add(corners)?;
    }
    for next in 1..points.len() {
        if ![b, c, d].contains(&next) {
            hull.include(next, &mut decider)?;
        }
    }
    let solid = hull.finish(&mut decider)?;
    decider.weaken(solid.certainty());
    Ok(decider.outcome(Found::Boundary(solid)))
}

/// The first point for which a question is certainly denied. Doubts matter only where there is none.
fn first_off<S: Scalar>(
    points: &[Point<S>],
    decider: &mut Decider,
    counts: impl Fn(&Point<S>, &mut Decider) -> bool,
) -> Option<usize> {
    let mut own = Decider::default();
    let found = points.iter().position(|point| !counts(point, &mut own));
    if found.is_none() {
        decider.weaken(own.certainty());
    }
    found
}

fn on_a_line<S: Scalar>(
    points: &[Point<S>],
    along: &[S; 3],
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let mut ends: Option<[&Point<S>; 2]> = None;
    for point in points {
        let [mut low, mut high] = ends.unwrap_or([point, point]);
        if decider.order(&dot(&minus(&point.0, &low.0), along)) == Ordering::Less {
            low = point;
        }
        if decider.order(&dot(&minus(&point.0, &high.0), along)) == Ordering::Greater {
            high = point;
        }
        ends = Some([low, high]);
    }
    match ends {
        Some([low, high]) => Ok(Found::Segment(Segment::new(low.clone(), high.clone())?)),
        None => Ok(Found::Nothing),
    }
}

fn in_a_plane<S: Scalar>(
    points: &[Point<S>],
    normal: [S; 3],
    decider: &mut Decider,
) -> Result<Found<S>, GeometryError> {
    let corners = decider.take(planar_hull(points, &Direction::new(normal)?));
    let face = Face::new(vec![corners])?;
    decider.weaken(face.certainty());
    Ok(Found::Face(face))
}

/// A triangle of the hull, counterclockwise seen from outside.
struct Facet<S> {
    corners: [usize; 3],
    normal: [S; 3],
}

impl<S> Facet<S> {
    /// Its edges in their sense.
    fn edges(&self) -> [[usize; 2]; 3] {
        let [a, b, c] = self.corners;
        [[a, b], [b, c], [c, a]]
    }
}

/// The hull of the points so far, of triangles.
struct Growing<'a, S> {
    points: &'a [Point<S>],
    /// By number; those that a later point is outside of are gone.
    facets: BTreeMap<usize, Facet<S>>,
    /// The facet that passes an edge in this sense.
    passes: BTreeMap<[usize; 2], usize>,
    next: usize,
}

fn unclear() -> GeometryError {
    GeometryError::Degenerate {
        needed: "points of which the digits tell one closed hull",
        found: "points too near to each other for their uncertainty",
    }
}

impl<'a, S: Scalar> Growing<'a, S> {
    fn new(points: &'a [Point<S>]) -> Self {
        Self {
            points,
            facets: BTreeMap::new(),
            passes: BTreeMap::new(),
            next: 0,
        }
    }

    fn at(&self, point: usize) -> Result<&'a [S; 3], GeometryError> {
        self.points.get(point).map(|p| &p.0).ok_or(unclear())
    }

    fn add(&mut self, corners: [usize; 3]) -> Result<(), GeometryError> {
        let [a, b, c] = corners;
        let base = self.at(a)?;
        let normal = cross(&minus(self.at(b)?, base), &minus(self.at(c)?, base));
        let facet = Facet { corners, normal };
        for edge in facet.edges() {
            if self.passes.insert(edge, self.next).is_some() {
                return Err(unclear());
            }
        }
        self.facets.insert(self.next, facet);
        self.next += 1;
        Ok(())
    }

    fn height(&self, facet: &Facet<S>, point: usize) -> Result<S, GeometryError> {
        let base = self.at(facet.corners[0])?;
        Ok(dot(&facet.normal, &minus(self.at(point)?, base)))
    }

    /// Puts a point into the hull: what it sees from outside is replaced by triangles between it and the horizon. A facet in
    /// the plane of which it is counts as not seen; the facets that are added continue it.
    fn include(&mut self, point: usize, decider: &mut Decider) -> Result<(), GeometryError> {
        let mut seen = BTreeSet::new();
        for (number, facet) in &self.facets {
            if decider.order(&self.height(facet, point)?) == Ordering::Greater {
                seen.insert(*number);
            }
        }
        let gone: Vec<Facet<S>> = seen
            .iter()
            .filter_map(|number| self.facets.remove(number))
            .collect();
        let mut horizon = Vec::new();
        for [from, to] in gone.iter().flat_map(Facet::edges) {
            let beyond = self.passes.get(&[to, from]);
            if beyond.is_some_and(|other| !seen.contains(other)) {
                horizon.push([from, to]);
            }
        }
        for edge in gone.iter().flat_map(Facet::edges) {
            self.passes.remove(&edge);
        }
        for [from, to] in horizon {
            self.add([from, to, point])?;
        }
        Ok(())
    }

    /// The boundary, with triangles of one plane merged.
    fn finish(&self, decider: &mut Decider) -> Result<Boundary<S>, GeometryError> {
        let merged = self.groups(decider)?;
        let found = self.build(&merged);
        if found.is_ok() || decider.certainty() == Certainty::Proven {
            return found;
        }
        // Of triangles that may be flat together the whole need not be.
        let single = self.facets.keys().map(|number| (*number, *number));
        self.build(&single.collect())
    }

    /// The group of each triangle, named by its first one.
    fn groups(&self, decider: &mut Decider) -> Result<BTreeMap<usize, usize>, GeometryError> {
        let mut group: BTreeMap<usize, usize> = BTreeMap::new();
        for (first, facet) in &self.facets {
            if group.contains_key(first) {
                continue;
            }
            let mut open = vec![*first];
            while let Some(number) = open.pop() {
                if group.contains_key(&number) {
                    continue;
                }
                let Some(own) = self.facets.get(&number) else {
                    continue;
                };
                let mut level = true;
                for corner in own.corners {
                    level = level
                        && (facet.corners.contains(&corner)
                            || decider.is_zero(&self.height(facet, corner)?));
                }
                if !level {
                    continue;
                }
                group.insert(number, *first);
                let beside = own.edges().map(|[from, to]| [to, from]);
                open.extend(beside.iter().filter_map(|edge| self.passes.get(edge)));
            }
        }
        Ok(group)
    }

    /// The boundary with a face for each group.
    fn build(&self, group: &BTreeMap<usize, usize>) -> Result<Boundary<S>, GeometryError> {
        // The edges between groups, each in its sense by where it begins.
        let mut borders: BTreeMap<usize, BTreeMap<usize, usize>> = BTreeMap::new();
        let mut groups_at: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
        for (number, facet) in &self.facets {
            let own = group.get(number).ok_or(unclear())?;
            for [from, to] in facet.edges() {
                groups_at.entry(from).or_default().insert(*own);
                let beside = self.passes.get(&[to, from]).and_then(|f| group.get(f));
                if beside == Some(own) {
                    continue;
                }
                let border = borders.entry(*own).or_default();
                if border.insert(from, to).is_some() {
                    return Err(unclear());
                }
            }
        }
        let mut builder = BoundaryBuilder::new();
        let mut numbers: BTreeMap<usize, usize> = BTreeMap::new();
        for (point, groups) in &groups_at {
            // With two faces a point is on the edge between them, with one inside of it.
            if groups.len() > 2 {
                let place = Point(self.at(*point)?.clone());
                numbers.insert(*point, builder.vertex(place));
            }
        }
        for border in borders.values() {
            let ring = around(border)?;
            let corners = ring.iter().filter_map(|point| numbers.get(point).copied());
            builder.face(vec![corners.collect()]);
        }
        builder.build_solid()
    }
}

/// The points of a border in order; an error where it is more than one loop.
fn around(border: &BTreeMap<usize, usize>) -> Result<Vec<usize>, GeometryError> {
    let mut ring = Vec::with_capacity(border.len());
    let Some(start) = border.keys().next() else {
        return Err(unclear());
    };
    let mut at = *start;
    for _ in 0..border.len() {
        ring.push(at);
        at = *border.get(&at).ok_or(unclear())?;
        if at == *start {
            break;
        }
    }
    match at == *start && ring.len() == border.len() {
        true => Ok(ring),
        false => Err(unclear()),
    }
}
