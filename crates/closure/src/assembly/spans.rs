//! How far apart the points are that the joints of a cycle keep, and whether they can meet.
//!
//! Hinges, universals, balls and rods keep a point of both links, a point on a line or a plane one of the first. These points are the
//! corners of a closed polygon, and no side of it is longer than all the others together. A side within one link has its length. One that
//! leads through other joints is bounded from below only, by where the first point may be as the links behind see it:
//!
//! - behind slides, on a line or plane along their directions;
//! - behind a cylinder or a screw, on a pipe about the axis;
//! - behind a planar joint, as high above the plane as before.
//!
//! So there is a proof only where at most one side is of that kind. Where all axes are parallel, all this is asked across
//! them as well: every point may then be anywhere on the line through it along the axes, and cylinders keep such lines like hinges.

use super::proof::Corner;
use kutzbach_math::space::{Rigid, Vector, dot, length, perpendicular, scale, subtract, unit};
use kutzbach_model::mechanism::JointKind;

/// Directions whose sines are below this are parallel, to rounding: what two lines that are not quite so have in common is farther away
/// by one over it.
const PARALLEL: f64 = 1e-13;

/// Points p + Σ tᵢ dᵢ, the directions orthonormal.
#[derive(Clone)]
struct Flat {
    point: Vector<f64>,
    directions: Vec<Vector<f64>>,
}

/// Where a point may be, as a link sees it.
#[derive(Clone)]
enum Place {
    /// On a point, a line, a plane.
    Flat(Flat),
    /// At distances between these two from a line.
    Pipe {
        line: Flat,
        least: f64,
        most: f64,
    },
    /// At heights along a direction, from a point, between these two.
    Layer {
        point: Vector<f64>,
        normal: Vector<f64>,
        least: f64,
        most: f64,
    },
    Anywhere,
}

/// A side of the polygon: between the points that two joints keep.
pub(super) struct Side {
    /// The joints; the same twice for a rod.
    pub(super) between: [usize; 2],
    /// The least length of the side.
    least: f64,
    /// Whether it has no other.
    rigid: bool,
}

/// The longest side, and what all others span together.
pub(super) struct Span {
    /// The joints that keep its ends; the same twice for a rod.
    pub(super) between: [usize; 2],
    /// Its least length (m).
    pub(super) apart: f64,
    /// What the others span at most (m).
    pub(super) reach: f64,
}

/// The side that exceeds the others most, or comes nearest to it; `None` where none has bounds.
pub(super) fn widest(corners: &[Corner]) -> Option<Span> {
    let across = common_direction(corners).is_some();
    let ways = [false, true];
    let spans = ways.into_iter().filter(|&way| !way || across);
    spans
        .filter_map(|way| widest_of(&sides(corners, way)?))
        .max_by(|a, b| (a.apart - a.reach).total_cmp(&(b.apart - b.reach)))
}

fn widest_of(sides: &[Side]) -> Option<Span> {
    let mut loose = sides.iter().filter(|side| !side.rigid);
    let candidates: Vec<&Side> = match (loose.next(), loose.next()) {
        (None, _) => sides.iter().collect(),
        (Some(one), None) => vec![one],
        _ => return None,
    };
    let longest = candidates
        .into_iter()
        .max_by(|a, b| a.least.total_cmp(&b.least))?;
    let all: f64 = sides.iter().filter(|s| s.rigid).map(|s| s.least).sum();
    Some(Span {
        between: longest.between,
        apart: longest.least,
        reach: if longest.rigid {
            all - longest.least
        } else {
            all
        },
    })
}

/// The direction, in the frame behind the last corner, of all axes of the cycle, where they are parallel and slides do not change that.
fn common_direction(corners: &[Corner]) -> Option<Vector<f64>> {
    let turning = |corner: &&Corner| corner.axes.is_some();
    let first = corners.iter().position(|corner| turning(&corner))?;
    let mut along = corners[first].axes?[1];
    for offset in 1..=corners.len() {
        let corner = &corners[(first + offset) % corners.len()];
        along = corner.step.rotate_back(&along);
        match (corner.kind, corner.axes) {
            (JointKind::Universal, _) => return None,
            (_, Some([before, behind])) => {
                if length(&across(&along, &before)) > PARALLEL {
                    return None;
                }
                along = behind;
            }
            (JointKind::Prismatic | JointKind::PlanarTranslation, None) => {}
            _ => return None,
        }
    }
    // From behind the first corner that turns to behind the last one.
    for corner in &corners[first + 1..] {
        along = corner
            .axes
            .map_or_else(|| corner.step.rotate_back(&along), |axes| axes[1]);
    }
    Some(along)
}

/// What a corner is for the points of the polygon.
enum Passage {
    /// A point kept, and where it may be: as the link before sees it, and as the one behind does.
    Kept(Flat, Flat, f64),
    /// A displacement along these directions.
    Slides(Vec<Vector<f64>>),
    /// About an axis, and along it.
    About(Vector<f64>),
    /// About a normal, and across it.
    On(Vector<f64>),
    /// Anything else.
    Any,
}

fn passage(corner: &Corner, along: Option<Vector<f64>>) -> Passage {
    let origin = |directions: Vec<Vector<f64>>| Flat {
        point: [0.0; 3],
        directions,
    };
    let here = || along.into_iter().collect::<Vec<_>>();
    let axis = corner.axis;
    let plane = || {
        let (one, other) = perpendicular(&corner.second);
        vec![one, other]
    };
    let kept = |there: Vec<Vector<f64>>| match corner.forward {
        true => Passage::Kept(origin(Vec::new()), origin(there), 0.0),
        false => Passage::Kept(origin(there), origin(Vec::new()), 0.0),
    };
    match corner.kind {
        JointKind::Revolute => Passage::Kept(origin(here()), origin(here()), 0.0),
        JointKind::Cylindrical | JointKind::Screw if along.is_some() => {
            Passage::Kept(origin(here()), origin(here()), 0.0)
        }
        JointKind::Universal | JointKind::Spherical => kept(Vec::new()),
        JointKind::Distance => Passage::Kept(origin(Vec::new()), origin(Vec::new()), corner.rod),
        JointKind::PointOnLine => kept(vec![corner.second]),
        JointKind::PointOnPlane => kept(plane()),
        JointKind::Prismatic => Passage::Slides(vec![axis]),
        JointKind::PlanarTranslation => {
            let (one, other) = perpendicular(&axis);
            Passage::Slides(vec![one, other])
        }
        JointKind::Cylindrical | JointKind::Screw => Passage::About(axis),
        JointKind::Planar => Passage::On(axis),
        _ => Passage::Any,
    }
}

/// The sides of the polygon; `None` where no point is kept. Across the axes: of their traces on a plane across them.
fn sides(corners: &[Corner], across_axes: bool) -> Option<Vec<Side>> {
    let mut along = match across_axes {
        true => Some(common_direction(corners)?),
        false => None,
    };
    let is_kept = |corner: &Corner| matches!(passage(corner, along), Passage::Kept(..));
    let first = corners.iter().position(is_kept)?;
    for corner in &corners[..=first] {
        along = passed(corner, along);
    }
    let mut sides = Vec::new();
    let start = &corners[first];
    let Passage::Kept(_, behind, rod) = passage(start, along) else {
        return None;
    };
    // A point has one place; across the axes, one line along them.
    let is_point = |flat: &Flat| flat.directions.len() <= usize::from(across_axes);
    let mut last = start.joint;
    let mut rigid = is_point(&behind);
    let mut place = Place::Flat(behind);
    if rod > 0.0 {
        sides.push(Side {
            between: [last, last],
            least: rod,
            rigid: true,
        });
    }
    for offset in 1..=corners.len() {
        let corner = &corners[(first + offset) % corners.len()];
        place = place.seen_from(&corner.step);
        let direction = along.map(|n| corner.step.rotate_back(&n));
        along = passed(corner, along);
        match passage(corner, direction) {
            Passage::Kept(before, behind, rod) => {
                rigid &= is_point(&before);
                sides.push(Side {
                    between: [last, corner.joint],
                    least: place.distance(&before),
                    rigid,
                });
                if rod > 0.0 && offset < corners.len() {
                    sides.push(Side {
                        between: [corner.joint, corner.joint],
                        least: rod,
                        rigid: true,
                    });
                }
                rigid = is_point(&behind);
                last = corner.joint;
                place = Place::Flat(behind);
            }
            other => {
                rigid = false;
                place = place.behind(&other);
            }
        }
    }
    Some(sides)
}

/// The common direction in the frame behind a corner.
fn passed(corner: &Corner, along: Option<Vector<f64>>) -> Option<Vector<f64>> {
    let along = corner.step.rotate_back(&along?);
    Some(corner.axes.map_or(along, |axes| axes[1]))
}

/// What is left of a vector across a unit vector.
fn across(v: &Vector<f64>, direction: &Vector<f64>) -> Vector<f64> {
    subtract(v, &scale(direction, &dot(v, direction)))
}

impl Flat {
    /// With further directions, of length one.
    fn along(&self, more: &[Vector<f64>]) -> Self {
        let mut flat = self.clone();
        for direction in more {
            let rest = flat.across(direction);
            if length(&rest) > PARALLEL {
                // Once more, since what is nearly parallel loses digits.
                let rest = flat.across(&unit(&rest));
                flat.directions.push(unit(&rest));
            }
        }
        flat
    }

    /// What is left of a vector across all directions.
    fn across(&self, v: &Vector<f64>) -> Vector<f64> {
        self.directions.iter().fold(*v, |v, d| across(&v, d))
    }

    fn distance(&self, other: &Self) -> f64 {
        let both = self.along(&other.directions);
        length(&both.across(&subtract(&other.point, &self.point)))
    }

    fn is_parallel_to(&self, direction: &Vector<f64>) -> bool {
        length(&self.across(direction)) <= PARALLEL
    }

    fn is_across(&self, normal: &Vector<f64>) -> bool {
        self.directions
            .iter()
            .all(|d| dot(d, normal).abs() <= PARALLEL)
    }

    /// In another frame, which `step` leads to.
    fn seen_from(&self, step: &Rigid<f64>) -> Self {
        let back = step.inverse();
        Self {
            point: back.apply(&self.point),
            directions: self.directions.iter().map(|d| back.rotate(d)).collect(),
        }
    }
}

impl Place {
    fn seen_from(self, step: &Rigid<f64>) -> Self {
        match self {
            Self::Flat(flat) => Self::Flat(flat.seen_from(step)),
            Self::Pipe { line, least, most } => Self::Pipe {
                line: line.seen_from(step),
                least,
                most,
            },
            Self::Layer {
                point,
                normal,
                least,
                most,
            } => Self::Layer {
                point: step.inverse().apply(&point),
                normal: step.rotate_back(&normal),
                least,
                most,
            },
            Self::Anywhere => Self::Anywhere,
        }
    }

    /// Behind a corner that keeps no point, whose frames' origin is where its axes are.
    fn behind(self, passage: &Passage) -> Self {
        let origin = |directions: &[Vector<f64>]| Flat {
            point: [0.0; 3],
            directions: directions.to_vec(),
        };
        match (self, passage) {
            (Self::Flat(flat), Passage::Slides(directions)) => Self::Flat(flat.along(directions)),
            (Self::Pipe { line, least, most }, Passage::Slides(directions))
                if directions.iter().all(|d| line.is_parallel_to(d)) =>
            {
                Self::Pipe { line, least, most }
            }
            (
                Self::Layer {
                    point,
                    normal,
                    least,
                    most,
                },
                Passage::Slides(directions),
            ) if directions.iter().all(|d| dot(d, &normal).abs() <= PARALLEL) => Self::Layer {
                point,
                normal,
                least,
                most,
            },
            (Self::Flat(flat), Passage::About(axis)) => {
                let line = origin(&[*axis]);
                let least = flat.distance(&line);
                let constant = flat.directions.iter().all(|d| line.is_parallel_to(d));
                let most = if constant { least } else { f64::INFINITY };
                Self::Pipe { line, least, most }
            }
            (Self::Pipe { line, least, most }, Passage::About(axis)) => {
                let own = origin(&[*axis]);
                let gap = line.distance(&own);
                let parallel = line.is_parallel_to(axis);
                let inside = if parallel { least - gap } else { 0.0 };
                Self::Pipe {
                    line: own,
                    least: (gap - most).max(inside).max(0.0),
                    most: if parallel { gap + most } else { f64::INFINITY },
                }
            }
            (Self::Flat(flat), Passage::On(normal)) if flat.is_across(normal) => {
                let height = dot(&flat.point, normal);
                Self::Layer {
                    point: [0.0; 3],
                    normal: *normal,
                    least: height,
                    most: height,
                }
            }
            (
                Self::Layer {
                    point,
                    normal,
                    least,
                    most,
                },
                Passage::On(own),
            ) if origin(&[*own]).is_parallel_to(&normal) => {
                let base = dot(&point, own);
                let sense = dot(&normal, own);
                let (one, other) = (base + sense * least, base + sense * most);
                Self::Layer {
                    point: [0.0; 3],
                    normal: *own,
                    least: one.min(other),
                    most: one.max(other),
                }
            }
            _ => Self::Anywhere,
        }
    }

    /// How far it is from points of a link at least.
    fn distance(&self, to: &Flat) -> f64 {
        match self {
            Self::Flat(flat) => flat.distance(to),
            Self::Pipe { line, least, most } => {
                let gap = line.distance(to);
                let constant = to.directions.iter().all(|d| line.is_parallel_to(d));
                let inside = if constant { least - gap } else { 0.0 };
                (gap - most).max(inside).max(0.0)
            }
            Self::Layer {
                point,
                normal,
                least,
                most,
            } if to.is_across(normal) => {
                let height = dot(&subtract(&to.point, point), normal);
                (least - height).max(height - most).max(0.0)
            }
            Self::Layer { .. } | Self::Anywhere => 0.0,
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::super::samples::{Place as Joint, Written, ring};
    use super::super::super::{Arithmetic, Geometry};
    use super::super::descent::Task;
    use super::super::proof::corners;
    use super::*;
    use crate::Structure;
    use kutzbach_math::matrix::SplitMix64;
    use std::collections::BTreeSet;

    /// The widest span of a ring, walked both ways.
    fn spans(places: &[Joint], gap: [f64; 3]) -> [Option<Span>; 2] {
        let mechanism = ring(places, gap, Written::Exactly);
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
        let part = Structure::new(&mechanism).parts.swap_remove(0);
        let held = BTreeSet::new();
        let task = Task {
            mechanism: &mechanism,
            geometry: &geometry,
            part: &part,
            held: &held,
            tolerance: None,
        };
        let one = part.cycles[0].clone();
        let back = one.iter().rev().map(|(joint, f)| (*joint, !f)).collect();
        [one, back].map(|cycle: Vec<(usize, bool)>| {
            corners(&task, &cycle)
                .ok()
                .and_then(|corners| widest(&corners))
        })
    }

    const KINDS: [JointKind; 10] = [
        JointKind::Revolute,
        JointKind::Revolute,
        JointKind::Prismatic,
        JointKind::Cylindrical,
        JointKind::Universal,
        JointKind::Spherical,
        JointKind::Planar,
        JointKind::PlanarTranslation,
        JointKind::PointOnLine,
        JointKind::PointOnPlane,
    ];

    #[test]
    fn rings_that_are_drawn_closed_have_no_side_too_long() {
        let mut random = SplitMix64::new(7);
        let mut draw = |below: u64| (random.next_u64() % below) as usize;
        let mut bounded = 0;
        for _ in 0..3000 {
            let count = 2 + draw(5);
            // Some rings have all axes along one or two directions, so that parallel ones are among them.
            let directions = 1 + draw(4);
            let axes = [
                [0.0, 0.0, 1.0],
                [1.0, 0.0, 0.0],
                [0.5, 1.0, 0.0],
                [1.0, 2.0, -1.0],
            ];
            let places: Vec<Joint> = (0..count)
                .map(|_| {
                    let at = [0; 3].map(|_| draw(9) as f64 * 0.5 - 2.0);
                    (KINDS[draw(10)], at, axes[draw(directions as u64)])
                })
                .collect();
            for span in spans(&places, [0.0; 3]).into_iter().flatten() {
                bounded += 1;
                assert!(
                    span.apart <= span.reach + 1e-9,
                    "{places:?}: {} {}",
                    span.apart,
                    span.reach
                );
            }
        }
        assert!(bounded > 1000, "{bounded}");
    }

    #[test]
    fn bounds_lead_through_slides_pipes_and_planes() {
        use JointKind::{Cylindrical, Planar, Prismatic, Revolute, Spherical};
        let (x, z) = ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
        // The gap displaces the last joint's side in the ground: the pivot is so far from the slide, the pin from the pipe, the ball from the plane.
        let slider_crank = [
            (Revolute, [0.0; 3], z),
            (Revolute, [1.0, 0.0, 0.5], z),
            (Revolute, [3.0, 0.0, 0.0], z),
            (Prismatic, [3.0, 0.0, 0.0], x),
        ];
        let pipe = [
            (Spherical, [2.0, 0.0, 0.0], z),
            (Spherical, [1.0, 0.0, 0.0], z),
            (Cylindrical, [0.0; 3], z),
        ];
        let plane = [
            (Spherical, [0.0; 3], z),
            (Spherical, [0.0, 0.0, 1.0], z),
            (Planar, [0.0, 0.0, 1.0], z),
        ];
        let cases = [
            (&slider_crank[..], [0.0, 4.0, 0.0], 4.0, 3.0),
            (&pipe[..], [0.0, 4.0, 0.0], 20f64.sqrt() - 1.0, 1.0),
            (&plane[..], [0.0, 0.0, 3.0], 4.0, 1.0),
        ];
        for (places, gap, apart, reach) in cases {
            for span in spans(places, gap) {
                let span = span.unwrap();
                let off = (span.apart - apart).abs().max((span.reach - reach).abs());
                assert!(off < 1e-12, "{places:?}: {} {}", span.apart, span.reach);
            }
        }
    }
}
