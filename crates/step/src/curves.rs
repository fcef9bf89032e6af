//! Edges as points in their order.

use crate::error::{Problem, StepError};
use crate::part21::{Instance, Record};
use crate::placement::{direction, placement, point};
use crate::shape::EdgeCurve;
use crate::spline::SplineCurve;
use crate::units::Units;
use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};

/// Curved edges are taken in steps of this angle (rad) at most.
pub(crate) const STEP: f64 = PI / 12.0;

/// Steps along an edge that is a B-spline.
const SPLINE_STEPS: usize = 32;

/// The most curves that stand for each other, one after the other.
const LONGEST: usize = 8;

/// Below this many metres two ends of an edge are one, besides the accuracy of the file.
const NOWHERE: f64 = 1e-9;

/// A curve that can be followed.
pub(crate) enum Curve {
    /// A straight line: a point and the vector of one unit of its parameter.
    Line(Vector3<f64>, Vector3<f64>),
    /// An ellipse or circle: its centre and two half axes.
    Ellipse(Vector3<f64>, Vector3<f64>, Vector3<f64>),
    /// A B-spline.
    Spline(SplineCurve),
    /// Straight pieces.
    Corners(Vec<Vector3<f64>>),
    /// Another curve, by its keyword.
    Other(String),
}

impl Curve {
    /// Reads a curve, behind those that stand for it (SURFACE_CURVE, SEAM_CURVE, TRIMMED_CURVE).
    ///
    /// # Errors
    /// References to nothing, parameters of the wrong kind, curves that stand for themselves.
    pub fn read(instance: Instance<'_>, units: &Units) -> Result<Self, StepError> {
        let mut instance = instance;
        for _ in 0..LONGEST {
            let stands_for = [
                "SURFACE_CURVE",
                "SEAM_CURVE",
                "INTERSECTION_CURVE",
                "TRIMMED_CURVE",
            ];
            let behind = stands_for.iter().find_map(|word| instance.leaf(word));
            match behind {
                Some(record) => instance = record.entity_at(1)?,
                None => return Self::itself(instance, units),
            }
        }
        Err(instance.error(Problem::Cycle { what: "curves" }))
    }

    fn itself(instance: Instance<'_>, units: &Units) -> Result<Self, StepError> {
        if let Some(line) = instance.leaf("LINE") {
            let vector = line.entity_at(2)?.expect("VECTOR", "VECTOR")?;
            let length = units.metres(vector.number_at(2)?);
            let along = direction(vector.entity_at(1)?)?;
            return Ok(Self::Line(
                point(line.entity_at(1)?, units)?,
                along * length,
            ));
        }
        for (keyword, second) in [("CIRCLE", 2), ("ELLIPSE", 3)] {
            if let Some(record) = instance.leaf(keyword) {
                let frame = placement(record.entity_at(1)?, units)?;
                let half = |place| Ok::<f64, StepError>(units.metres(record.number_at(place)?));
                let (x, y) = (half(2)?, half(second)?);
                if !(x > 0.0 && y > 0.0) {
                    return Err(record.wrong(2, "a positive length"));
                }
                let axis = |i| frame.rotation.column(i).into_owned();
                return Ok(Self::Ellipse(frame.translation, axis(0) * x, axis(1) * y));
            }
        }
        if let Some(line) = instance.leaf("POLYLINE") {
            let points = line.entities_at(1)?;
            let corners: Result<Vec<_>, _> = points.into_iter().map(|p| point(p, units)).collect();
            return Ok(Self::Corners(corners?));
        }
        if let Some(spline) = SplineCurve::read(instance, units)? {
            return Ok(Self::Spline(spline));
        }
        Ok(Self::Other(instance.keywords()))
    }

    /// Points from one end to another, both included. `forward` says whether the parameter grows on the way. Where both ends are
    /// one, the way goes all around a closed curve.
    pub fn between(
        &self,
        ends: (Vector3<f64>, Vector3<f64>),
        forward: bool,
        accuracy: f64,
    ) -> Vec<Vector3<f64>> {
        let closed = (ends.1 - ends.0).norm() <= NOWHERE.max(accuracy);
        let mut points = match self {
            Self::Ellipse(centre, x, y) => arc(*centre, *x, *y, ends, forward, closed),
            Self::Spline(spline) => {
                let (first, last) = spline.domain();
                let at = |i: usize| first + (last - first) * i as f64 / SPLINE_STEPS as f64;
                let all = (0..=SPLINE_STEPS).map(|i| spline.at(at(i))).collect();
                piece(all, ends, forward, closed)
            }
            Self::Corners(corners) => piece(corners.clone(), ends, forward, closed),
            Self::Line(..) | Self::Other(_) => vec![ends.0, ends.1],
        };
        // Ends are where the vertices are.
        if let Some(first) = points.first_mut() {
            *first = ends.0;
        }
        if let Some(last) = points.last_mut() {
            *last = ends.1;
        }
        points
    }
}

fn arc(
    centre: Vector3<f64>,
    x: Vector3<f64>,
    y: Vector3<f64>,
    ends: (Vector3<f64>, Vector3<f64>),
    forward: bool,
    closed: bool,
) -> Vec<Vector3<f64>> {
    let angle = |p: Vector3<f64>| {
        let from = p - centre;
        (from.dot(&y) / y.norm_squared()).atan2(from.dot(&x) / x.norm_squared())
    };
    let first = angle(ends.0);
    let turn = if closed {
        TAU
    } else if forward {
        (angle(ends.1) - first).rem_euclid(TAU)
    } else {
        (first - angle(ends.1)).rem_euclid(TAU)
    };
    let signed = if forward { turn } else { -turn };
    let steps = (turn / STEP).ceil().max(1.0) as usize;
    let at = |i: usize| first + signed * i as f64 / steps as f64;
    (0..=steps)
        .map(|i| centre + x * at(i).cos() + y * at(i).sin())
        .collect()
}

/// The piece of a sampled curve between the samples nearest to both ends, with the ends in place of them.
fn piece(
    mut all: Vec<Vector3<f64>>,
    ends: (Vector3<f64>, Vector3<f64>),
    forward: bool,
    closed: bool,
) -> Vec<Vector3<f64>> {
    if !forward {
        all.reverse();
    }
    let nearest = |end: Vector3<f64>| {
        let by_distance = |(_, a): &(usize, &Vector3<f64>), (_, b): &(usize, &Vector3<f64>)| {
            (*a - end).norm().total_cmp(&(*b - end).norm())
        };
        let found = all.iter().enumerate().min_by(by_distance);
        found.map_or(0, |(place, _)| place)
    };
    let (mut from, mut to) = (nearest(ends.0), nearest(ends.1));
    let last = all.len().saturating_sub(1);
    let joined = match (all.first(), all.get(last)) {
        (Some(a), Some(b)) => (a - b).norm() <= NOWHERE.max(1e-6 * (ends.0 - ends.1).norm()),
        _ => return vec![ends.0, ends.1],
    };
    if closed {
        (from, to) = (0, last);
    } else if joined && to == 0 {
        to = last;
    } else if joined && from == last {
        from = 0;
    }
    let mut points = vec![ends.0];
    let inner = all.iter().enumerate();
    let between = |place: usize| {
        if from <= to {
            place > from && place < to
        } else {
            // Across the seam of a closed curve.
            joined && (place > from || place < to)
        }
    };
    let (late, early): (Vec<_>, Vec<_>) = inner
        .filter(|(place, _)| between(*place))
        .partition(|(place, _)| *place > from);
    points.extend(late.into_iter().chain(early).map(|(_, p)| *p));
    points.push(ends.1);
    points
}

/// A VERTEX_POINT (m).
///
/// # Errors
/// Where it is something else, or its point is none.
pub(crate) fn vertex(instance: Instance<'_>, units: &Units) -> Result<Vector3<f64>, StepError> {
    let record = instance.expect("VERTEX_POINT", "VERTEX_POINT")?;
    point(record.entity_at(1)?, units)
}

/// An edge from its first vertex to its second.
pub(crate) struct Followed {
    /// Its points.
    pub points: Vec<Vector3<f64>>,
    /// What it runs along.
    pub curve: EdgeCurve,
    /// The keyword of a curve that was not followed.
    pub unknown: Option<String>,
}

/// Half axes of an ellipse that differ by less than this share are those of a circle.
const ROUND: f64 = 1e-9;

impl Curve {
    /// What kind of curve it is for who asks about edges.
    fn kind(&self) -> EdgeCurve {
        match self {
            Self::Line(..) => EdgeCurve::Line,
            Self::Ellipse(centre, x, y) if (x.norm() - y.norm()).abs() <= ROUND * x.norm() => {
                EdgeCurve::Circle {
                    centre: *centre,
                    axis: x.cross(y).normalize(),
                    radius: x.norm(),
                }
            }
            _ => EdgeCurve::Other,
        }
    }
}

/// Follows an EDGE_CURVE.
///
/// # Errors
/// As for [`vertex`] and [`Curve::read`].
pub(crate) fn edge(record: Record<'_>, units: &Units) -> Result<Followed, StepError> {
    let ends = (
        vertex(record.entity_at(1)?, units)?,
        vertex(record.entity_at(2)?, units)?,
    );
    let curve = Curve::read(record.entity_at(3)?, units)?;
    let points = curve.between(ends, record.truth_at(4)?, units.accuracy);
    Ok(Followed {
        points,
        curve: curve.kind(),
        unknown: match curve {
            Curve::Other(keyword) => Some(keyword),
            _ => None,
        },
    })
}
