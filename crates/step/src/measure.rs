//! How far a face goes along and about its axis, and what a surface is in another frame.

use crate::shape::{EdgeCurve, Face, FaceEdge, Surface};
use kutzbach_math::group::Pose;
use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};

/// What is missing to a whole turn and still one (rad): the digits of points a thousandth of the size apart.
const WHOLE: f64 = 1e-3;

impl Surface {
    /// This surface where `pose` moves it.
    pub fn moved(&self, pose: &Pose) -> Self {
        match self {
            Self::Plane { point, normal } => Self::Plane {
                point: pose.transform_point(point),
                normal: pose.transform_direction(normal),
            },
            Self::Cylinder {
                point,
                direction,
                radius,
            } => Self::Cylinder {
                point: pose.transform_point(point),
                direction: pose.transform_direction(direction),
                radius: *radius,
            },
            Self::Cone {
                apex,
                direction,
                half_angle,
            } => Self::Cone {
                apex: pose.transform_point(apex),
                direction: pose.transform_direction(direction),
                half_angle: *half_angle,
            },
            Self::Sphere { centre, radius } => Self::Sphere {
                centre: pose.transform_point(centre),
                radius: *radius,
            },
            Self::Other(keyword) => Self::Other(keyword.clone()),
        }
    }

    /// A point of the axis and its direction, of cylinders and cones.
    pub(crate) fn axis(&self) -> Option<(Vector3<f64>, Vector3<f64>)> {
        match self {
            Self::Cylinder {
                point, direction, ..
            } => Some((*point, *direction)),
            Self::Cone {
                apex, direction, ..
            } => Some((*apex, *direction)),
            _ => None,
        }
    }
}

impl FaceEdge {
    /// This edge where `pose` moves it.
    fn moved(&self, pose: &Pose) -> Self {
        let curve = match self.curve {
            EdgeCurve::Circle {
                centre,
                axis,
                radius,
            } => EdgeCurve::Circle {
                centre: pose.transform_point(&centre),
                axis: pose.transform_direction(&axis),
                radius,
            },
            other => other,
        };
        Self {
            curve,
            at: pose.transform_point(&self.at),
            along: pose.transform_direction(&self.along),
            ..*self
        }
    }
}

impl Face {
    /// This face where `pose` moves it.
    pub fn moved(&self, pose: &Pose) -> Self {
        let moved = |polygon: &Vec<Vector3<f64>>| {
            let points = polygon.iter().map(|p| pose.transform_point(p));
            points.collect::<Vec<_>>()
        };
        Self {
            surface: self.surface.moved(pose),
            outline: self.outline.iter().map(moved).collect(),
            halves: self.halves.clone(),
            edges: self.edges.iter().map(|edge| edge.moved(pose)).collect(),
            ..*self
        }
    }
}

/// From where to where a face goes along the axis of its surface, and the angle about it that it covers.
///
/// A cone that is bounded at one end only goes to its apex.
pub(crate) fn extents(surface: &Surface, outline: &[Vec<Vector3<f64>>]) -> ((f64, f64), f64) {
    let Some((point, direction)) = surface.axis() else {
        return ((0.0, 0.0), 0.0);
    };
    let heights = outline
        .iter()
        .flatten()
        .map(|p| (p - point).dot(&direction));
    let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), h| {
        (low.min(h), high.max(h))
    });
    if !(low <= high) {
        return ((0.0, 0.0), 0.0);
    }
    let steps: Vec<Vec<Step>> = outline
        .iter()
        .map(|polygon| steps(point, direction, polygon))
        .collect();
    let rings = steps.iter().filter(|steps| goes_around(steps)).count();
    let low = match surface {
        Surface::Cone { .. } if rings == 1 => low.min(0.0),
        _ => low,
    };
    ((low, high), covered(&steps))
}

/// A step of a polygon about an axis (rad).
struct Step {
    from: f64,
    to: f64,
    /// From −π to π.
    turn: f64,
}

/// The steps of a closed polygon about an axis. On the axis, as at the apex of a cone, there is no angle: steps from and to it are left out.
fn steps(point: Vector3<f64>, direction: Vector3<f64>, polygon: &[Vector3<f64>]) -> Vec<Step> {
    let helper = Vector3::ith((direction.iamax() + 1) % 3, 1.0);
    let x = (helper - direction * direction.dot(&helper)).normalize();
    let y = direction.cross(&x);
    let flat = |p: &Vector3<f64>| ((p - point).dot(&x), (p - point).dot(&y));
    let following = polygon.iter().cycle().skip(1);
    let pairs = polygon.iter().zip(following);
    pairs
        .map(|(from, to)| (flat(from), flat(to)))
        .filter(|(a, b)| *a != (0.0, 0.0) && *b != (0.0, 0.0))
        .map(|(a, b)| Step {
            from: a.1.atan2(a.0),
            to: b.1.atan2(b.0),
            turn: (a.0 * b.1 - a.1 * b.0).atan2(a.0 * b.0 + a.1 * b.1),
        })
        .collect()
}

/// Whether a polygon goes once around the axis: its turns are a whole turn together, or none.
fn goes_around(steps: &[Step]) -> bool {
    steps.iter().map(|step| step.turn).sum::<f64>().abs() > 1.5 * PI
}

/// The angle about an axis that polygons cover. A face on a cylinder covers what its bounds cover: a closed curve around the
/// axis, or the arcs at its ends.
fn covered(polygons: &[Vec<Step>]) -> f64 {
    let mut spans: Vec<(f64, f64)> = Vec::new();
    for step in polygons.iter().flatten() {
        let start = if step.turn >= 0.0 { step.from } else { step.to };
        push_span(&mut spans, start.rem_euclid(TAU), step.turn.abs());
    }
    let total = united(spans);
    if total > TAU - WHOLE { TAU } else { total }
}

/// A span that begins within a turn, cut where the turn ends. Steps of half a turn say nothing about their side.
fn push_span(spans: &mut Vec<(f64, f64)>, start: f64, length: f64) {
    if length >= PI - WHOLE {
        return;
    }
    let end = start + length;
    if end > TAU {
        spans.push((start, TAU));
        spans.push((0.0, end - TAU));
    } else {
        spans.push((start, end));
    }
}

/// The length that spans cover together.
fn united(mut spans: Vec<(f64, f64)>) -> f64 {
    spans.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut total, mut reached) = (0.0, 0.0_f64);
    for (start, end) in spans {
        total += (end - start.max(reached)).max(0.0);
        reached = reached.max(end);
    }
    total
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arc(from: f64, to: f64, height: f64) -> Vec<Vector3<f64>> {
        let at = |i: i32| from + (to - from) * f64::from(i) / 24.0;
        (0..=24)
            .map(|i| Vector3::new(at(i).cos(), at(i).sin(), height))
            .collect()
    }

    #[test]
    fn turns_and_heights_come_from_the_outline() {
        let tube = Surface::Cylinder {
            point: Vector3::new(0.0, 0.0, 1.0),
            direction: Vector3::z(),
            radius: 1.0,
        };
        let mut rings = [arc(0.0, TAU, 0.0), arc(0.0, TAU, 3.0)];
        for ring in &mut rings {
            ring.pop();
        }
        let ((low, high), turned) = extents(&tube, &rings);
        assert_eq!((low, high, turned), (-1.0, 2.0, TAU));

        let mut half = arc(-1.0, PI - 1.0, 0.0);
        let mut back = arc(-1.0, PI - 1.0, 2.0);
        back.reverse();
        half.extend(back);
        let (_, turned) = extents(&tube, &[half]);
        assert!((turned - PI).abs() < 1e-9, "{turned}");
    }

    #[test]
    fn cones_that_end_at_one_circle_go_to_their_apex() {
        let cone = Surface::Cone {
            apex: Vector3::zeros(),
            direction: Vector3::z(),
            half_angle: PI / 4.0,
        };
        let ring = |height: f64, sense: f64| {
            let mut ring = arc(0.0, sense * TAU, height);
            ring.pop();
            ring.iter()
                .map(|p| Vector3::new(p.x * height, p.y * height, height))
                .collect::<Vec<_>>()
        };
        let whole = extents(&cone, &[ring(3.0, 1.0)]);
        assert_eq!(whole, ((0.0, 3.0), TAU));
        // Cut off, or a half from the apex.
        let cut = extents(&cone, &[ring(3.0, 1.0), ring(2.0, -1.0)]);
        assert_eq!(cut, ((2.0, 3.0), TAU));
        let mut half = arc(0.0, PI, 1.0);
        half.push(Vector3::zeros());
        let (extent, turned) = extents(&cone, &[half]);
        assert_eq!(extent, (0.0, 1.0));
        assert!((turned - PI).abs() < 1e-9, "{turned}");
        // A window in its side bounds no end.
        let mut window = arc(0.0, 0.5, 2.0);
        window.extend(arc(0.5, 0.0, 2.5));
        let (extent, _) = extents(&cone, &[ring(3.0, 1.0), window]);
        assert_eq!(extent, (0.0, 3.0));
    }
}
