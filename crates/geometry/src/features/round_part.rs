//! Parts with round faces, in doubles: as a CAD kernel writes them, whose numbers agree within the accuracy of its file.
//!
//! What agrees within the accuracy of the part does so: *yes*. What is apart by more than ten times as much is not: *no*. Between, it is *within
//! digits*.

use super::declare::{Bend, Orientation, Sort, Type};
use super::part::Part;
use crate::decide::Answer;
use crate::error::GeometryError;
use nalgebra::Vector3;

/// What is apart by so many times the accuracy differs.
const APART: f64 = 10.0;

/// A surface or a curve. Lengths in metres; directions are unit vectors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// A plane, with its normal out of the material.
    Plane {
        /// A point of it.
        point: Vector3<f64>,
        /// Its normal.
        normal: Vector3<f64>,
    },
    /// A circular cylinder.
    Cylinder {
        /// A point of its axis.
        point: Vector3<f64>,
        /// The direction of its axis.
        direction: Vector3<f64>,
        /// Its radius.
        radius: f64,
    },
    /// A circular cone.
    Cone {
        /// Its apex.
        apex: Vector3<f64>,
        /// The direction of its axis, from the apex to where it is wide.
        direction: Vector3<f64>,
        /// The angle (rad) between its axis and its lines.
        half_angle: f64,
    },
    /// A sphere.
    Sphere {
        /// Its centre.
        centre: Vector3<f64>,
        /// Its radius.
        radius: f64,
    },
    /// A straight line.
    Line {
        /// Its direction.
        direction: Vector3<f64>,
    },
    /// A circle.
    Circle {
        /// Its centre.
        centre: Vector3<f64>,
        /// The direction of its axis.
        axis: Vector3<f64>,
        /// Its radius.
        radius: f64,
    },
    /// Another surface or curve, of which nothing is known.
    Other,
}

/// A face of a [`RoundPart`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoundFace {
    /// Its surface.
    pub shape: Shape,
    /// Whether the material is inside the curvature, as of a pin; without meaning for a plane.
    pub convex: bool,
    /// Whether it goes all around its axis.
    pub whole: bool,
    /// How many loops bound it.
    pub loops: usize,
}

/// An edge of a [`RoundPart`].
#[derive(Clone, Debug, PartialEq)]
pub struct RoundEdge {
    /// Its curve.
    pub shape: Shape,
    /// A point of it (m).
    pub at: Vector3<f64>,
    /// The faces that pass it, each with the unit direction in which it does so at that point: seen from outside, the face is to the left.
    pub uses: Vec<(usize, Vector3<f64>)>,
}

/// Faces and edges, known within an accuracy.
#[derive(Clone, Debug, PartialEq)]
pub struct RoundPart {
    faces: Vec<RoundFace>,
    edges: Vec<RoundEdge>,
    /// The edges of every face.
    around: Vec<Vec<usize>>,
    /// Within what lengths (m) agree.
    length: f64,
    /// Within what angles (rad) agree.
    angle: f64,
}

/// What parallel and perpendicular are asked of.
#[derive(Clone, Copy)]
enum Direction {
    /// The normal of what is flat.
    Normal(Vector3<f64>),
    /// The direction of what is straight.
    Along(Vector3<f64>),
}

/// What distances are asked of.
#[derive(Clone, Copy)]
enum Middle {
    Axis(Vector3<f64>, Vector3<f64>),
    Centre(Vector3<f64>),
}

/// Whether a size is zero.
fn zero(size: f64, within: f64) -> Answer {
    if size.abs() <= within {
        Answer::Yes
    } else if size.abs() > APART * within {
        Answer::No
    } else {
        Answer::WithinDigits
    }
}

/// Whether a size is above zero.
fn positive(size: f64, within: f64) -> Answer {
    match zero(size, within) {
        Answer::No if size > 0.0 => Answer::Yes,
        Answer::WithinDigits if size > 0.0 => Answer::WithinDigits,
        _ => Answer::No,
    }
}

fn sure(holds: bool) -> Answer {
    match holds {
        true => Answer::Yes,
        false => Answer::No,
    }
}

impl Shape {
    fn direction(&self) -> Option<Direction> {
        match *self {
            Self::Plane { normal, .. } => Some(Direction::Normal(normal)),
            Self::Circle { axis, .. } => Some(Direction::Normal(axis)),
            Self::Cylinder { direction, .. }
            | Self::Cone { direction, .. }
            | Self::Line { direction } => Some(Direction::Along(direction)),
            Self::Sphere { .. } | Self::Other => None,
        }
    }

    fn middle(&self) -> Option<Middle> {
        match *self {
            Self::Cylinder {
                point, direction, ..
            } => Some(Middle::Axis(point, direction)),
            Self::Cone {
                apex, direction, ..
            } => Some(Middle::Axis(apex, direction)),
            Self::Circle { centre, axis, .. } => Some(Middle::Axis(centre, axis)),
            Self::Sphere { centre, .. } => Some(Middle::Centre(centre)),
            Self::Plane { .. } | Self::Line { .. } | Self::Other => None,
        }
    }

    fn radius(&self) -> Option<f64> {
        match *self {
            Self::Cylinder { radius, .. }
            | Self::Sphere { radius, .. }
            | Self::Circle { radius, .. } => Some(radius),
            _ => None,
        }
    }
}

impl RoundFace {
    /// The normal out of the material at a point of the face (or near it, for what is round).
    fn normal(&self, at: Vector3<f64>) -> Option<Vector3<f64>> {
        let away = match self.shape {
            Shape::Plane { normal, .. } => return Some(normal),
            Shape::Cylinder {
                point, direction, ..
            } => across(at - point, direction)?,
            Shape::Cone {
                apex,
                direction,
                half_angle,
            } => across(at - apex, direction)? * half_angle.cos() - direction * half_angle.sin(),
            Shape::Sphere { centre, .. } => (at - centre).try_normalize(f64::MIN_POSITIVE)?,
            _ => return None,
        };
        Some(if self.convex { away } else { -away })
    }
}

/// The unit vector of what is at right angles to a direction; `None` of what is along it.
fn across(v: Vector3<f64>, direction: Vector3<f64>) -> Option<Vector3<f64>> {
    (v - direction * direction.dot(&v)).try_normalize(f64::MIN_POSITIVE)
}

impl RoundPart {
    /// A part with these faces and edges, of which lengths agree within `length` (m) and directions within `angle` (rad). Edges may name faces that
    /// there are not; they have no neighbours there.
    #[must_use]
    pub fn new(faces: Vec<RoundFace>, edges: Vec<RoundEdge>, length: f64, angle: f64) -> Self {
        let mut around = vec![Vec::new(); faces.len()];
        for (number, edge) in edges.iter().enumerate() {
            for (face, _) in &edge.uses {
                if let Some(own) = around.get_mut(*face) {
                    own.push(number);
                }
            }
        }
        Self {
            faces,
            edges,
            around,
            length,
            angle,
        }
    }

    fn shape(&self, (sort, number): (Sort, usize)) -> Option<&Shape> {
        match sort {
            Sort::Face => self.faces.get(number).map(|face| &face.shape),
            Sort::Edge => self.edges.get(number).map(|edge| &edge.shape),
        }
    }

    /// The sine between what two faces leave free at an edge: above zero where the first face rises out of the second, so that the edge is
    /// concave.
    fn rise(&self, edge: usize) -> Option<f64> {
        let edge = self.edges.get(edge)?;
        let &[(first, forward), (second, backward)] = edge.uses.as_slice() else {
            return None;
        };
        if first == second || forward.dot(&backward) >= 0.0 {
            return None;
        }
        let normal = |face: usize| self.faces.get(face)?.normal(edge.at);
        // Into the first face, away from the edge.
        let inwards = normal(first)?.cross(&forward);
        Some(inwards.dot(&normal(second)?))
    }

    fn parallel(&self, a: Vector3<f64>, b: Vector3<f64>) -> Answer {
        zero(a.cross(&b).norm(), self.angle)
    }

    fn along(&self, a: &Shape, b: &Shape, orientation: Orientation) -> Answer {
        use Direction::{Along, Normal};
        let (Some(one), Some(two)) = (a.direction(), b.direction()) else {
            return Answer::No;
        };
        let (m, n, alike) = match (one, two) {
            (Normal(m), Normal(n)) | (Along(m), Along(n)) => (m, n, true),
            (Normal(m), Along(n)) | (Along(m), Normal(n)) => (m, n, false),
        };
        match (orientation == Orientation::Parallel) == alike {
            true => self.parallel(m, n),
            false => zero(m.dot(&n), self.angle),
        }
    }

    /// Coplanar, facing or away: of planes.
    fn planes(&self, a: &Shape, b: &Shape, orientation: Orientation) -> Answer {
        let (
            Shape::Plane {
                point: p,
                normal: m,
            },
            Shape::Plane {
                point: q,
                normal: n,
            },
        ) = (a, b)
        else {
            return Answer::No;
        };
        let parallel = self.parallel(*m, *n);
        let height = (q - p).dot(m);
        let same = m.dot(n) > 0.0;
        match orientation {
            Orientation::Coplanar if same => parallel.and(zero(height, self.length)),
            Orientation::Facing if !same => parallel.and(positive(height, self.length)),
            Orientation::Away if !same => parallel.and(positive(-height, self.length)),
            _ => Answer::No,
        }
    }

    /// The distance (m) of two axes or centres, and whether it is one: of axes that are parallel.
    fn apart(&self, a: Middle, b: Middle) -> (f64, Answer) {
        use Middle::{Axis, Centre};
        match (a, b) {
            (Axis(p, d), Axis(q, e)) => ((p - q).cross(&d).norm(), self.parallel(d, e)),
            (Axis(p, d), Centre(q)) | (Centre(q), Axis(p, d)) => {
                ((p - q).cross(&d).norm(), Answer::Yes)
            }
            (Centre(p), Centre(q)) => ((p - q).norm(), Answer::Yes),
        }
    }

    fn coaxial(&self, a: &Shape, b: &Shape) -> Answer {
        match (a.middle(), b.middle()) {
            (Some(a), Some(b)) => {
                let (distance, parallel) = self.apart(a, b);
                parallel.and(zero(distance, self.length))
            }
            _ => Answer::No,
        }
    }

    fn radii(&self, a: &Shape, b: &Shape, orientation: Orientation) -> Answer {
        match (a.radius(), b.radius(), orientation) {
            (Some(r), Some(s), Orientation::Larger) => positive(r - s, self.length),
            (Some(r), Some(s), _) => zero(r - s, self.length),
            _ => Answer::No,
        }
    }
}

impl Part for RoundPart {
    fn face_count(&self) -> usize {
        self.faces.len()
    }

    fn edge_count(&self) -> usize {
        self.edges.len()
    }

    fn edges_around(&self, face: usize) -> Vec<usize> {
        self.around.get(face).cloned().unwrap_or_default()
    }

    fn faces_beside(&self, edge: usize) -> Vec<usize> {
        let uses = self
            .edges
            .get(edge)
            .map_or(&[][..], |edge| edge.uses.as_slice());
        let mut faces: Vec<usize> = uses.iter().map(|(face, _)| *face).collect();
        faces.sort_unstable();
        faces.dedup();
        faces
    }

    fn has_type(&self, number: usize, kind: Type) -> Answer {
        let Some(shape) = self.shape((kind.sort(), number)) else {
            return Answer::No;
        };
        let face = self.faces.get(number);
        let flat = matches!(shape, Shape::Plane { .. });
        sure(match kind {
            Type::Straight => matches!(shape, Shape::Line { .. }),
            Type::Circular => matches!(shape, Shape::Circle { .. }),
            Type::Planar => flat,
            Type::Cylindrical => matches!(shape, Shape::Cylinder { .. }),
            Type::Conical => matches!(shape, Shape::Cone { .. }),
            Type::Spherical => matches!(shape, Shape::Sphere { .. }),
            Type::Whole => face.is_some_and(|face| face.whole),
            Type::Simple => flat && face.is_some_and(|face| face.loops <= 1),
            Type::Pierced => flat && face.is_some_and(|face| face.loops > 1),
        })
    }

    fn bends(&self, edge: usize, bend: Bend) -> Option<Answer> {
        let rise = self.rise(edge)?;
        Some(match bend {
            Bend::Convex => positive(-rise, self.angle),
            Bend::Concave => positive(rise, self.angle),
        })
    }

    fn is_curved(&self, face: usize, bend: Bend) -> Answer {
        let face = self.faces.get(face);
        sure(face.is_some_and(|face| {
            let round = matches!(
                face.shape,
                Shape::Cylinder { .. } | Shape::Cone { .. } | Shape::Sphere { .. }
            );
            round && face.convex == (bend == Bend::Convex)
        }))
    }

    fn oriented(
        &self,
        first: (Sort, usize),
        second: (Sort, usize),
        orientation: Orientation,
    ) -> Result<Answer, GeometryError> {
        let (Some(a), Some(b)) = (self.shape(first), self.shape(second)) else {
            return Ok(Answer::No);
        };
        Ok(match orientation {
            Orientation::Parallel | Orientation::Perpendicular => self.along(a, b, orientation),
            Orientation::Coplanar | Orientation::Facing | Orientation::Away => {
                self.planes(a, b, orientation)
            }
            Orientation::Coaxial => self.coaxial(a, b),
            Orientation::EqualRadius | Orientation::Larger => self.radii(a, b, orientation),
        })
    }

    fn equidistant(
        &self,
        first: (Sort, usize),
        second: (Sort, usize),
        from: (Sort, usize),
    ) -> Answer {
        let middle = |place| self.shape(place).and_then(Shape::middle);
        let (Some(a), Some(b), Some(from)) = (middle(first), middle(second), middle(from)) else {
            return Answer::No;
        };
        let ((one, axis_a), (two, axis_b)) = (self.apart(a, from), self.apart(b, from));
        axis_a.and(axis_b).and(zero(one - two, self.length))
    }
}
