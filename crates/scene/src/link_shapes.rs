//! The solids of one link: the file's own, or rods between its joints.

use super::shapes::Primitive;
use super::vectors::{Point, along, difference, norm, pose_of, sum, times};
use kutzbach_closure::Rigid;
use kutzbach_model::mechanism::{Geometry, Link};

/// A solid with its pose in the link.
pub type Solid = (Rigid<f64>, Primitive);

/// The file's visuals, capsules taken apart; `None` where there is none that can be drawn (meshes are files of their own).
pub fn visuals(link: &Link) -> Option<Vec<Solid>> {
    let mut solids = Vec::new();
    for shape in &link.visuals {
        let pose = pose_of(&shape.origin);
        match &shape.geometry {
            Geometry::Box(size) => {
                let size = [0, 1, 2].map(|i| size[i].value());
                solids.push((pose, Primitive::Box { size }));
            }
            Geometry::Cylinder { radius, length } => {
                let (radius, length) = (radius.value(), length.value());
                solids.push((pose, Primitive::Cylinder { radius, length }));
            }
            Geometry::Capsule { radius, length } => {
                let (radius, length) = (radius.value(), length.value());
                for end in [-0.5 * length, 0.5 * length] {
                    let end = pose.compose(&Rigid::translation([0.0, 0.0, end]));
                    solids.push((end, Primitive::Sphere { radius }));
                }
                solids.push((pose, Primitive::Cylinder { radius, length }));
            }
            Geometry::Sphere(radius) => {
                let radius = radius.value();
                solids.push((pose, Primitive::Sphere { radius }));
            }
            Geometry::Mesh { .. } => {}
        }
    }
    let visible = |(_, primitive): &Solid| {
        let size = primitive.size();
        size.iter().all(|x| *x > 0.0 && x.is_finite())
    };
    solids.retain(visible);
    (!solids.is_empty()).then_some(solids)
}

/// Rods that join points: one between two, the sides of a triangle, a star about the centroid of more; a ball where all
/// are one point or there is none.
pub fn joined(points: &[Point], radius: f64) -> Vec<Solid> {
    // Points closer than a rod is thick are one to the eye.
    let mut distinct: Vec<Point> = Vec::new();
    for point in points {
        let near = |other: &Point| norm(difference(*point, *other)) <= 0.5 * radius;
        // Hubs with thousands of joints need no pairwise comparison.
        if !distinct.iter().rev().take(64).any(near) {
            distinct.push(*point);
        }
    }
    let ball =
        |point: Point, radius: f64| (Rigid::translation(point), Primitive::Sphere { radius });
    let mut solids = Vec::new();
    match distinct.as_slice() {
        [] => solids.push(ball([0.0; 3], 1.6 * radius)),
        [point] => solids.push(ball(*point, 2.0 * radius)),
        [a, b] => solids.push(rod(*a, *b, radius)),
        [a, b, c] => {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                solids.push(rod(*from, *to, radius));
            }
        }
        many => {
            let total = many
                .iter()
                .fold([0.0; 3], |total, point| sum(total, *point));
            let centre = times(total, 1.0 / many.len() as f64);
            solids.push(ball(centre, 1.6 * radius));
            for point in many {
                if norm(difference(*point, centre)) > 0.5 * radius {
                    solids.push(rod(centre, *point, radius));
                }
            }
        }
    }
    if solids.len() > 1 || distinct.len() == 2 {
        // Round ends: rods meet without notches.
        solids.extend(distinct.iter().map(|point| ball(*point, radius)));
    }
    solids
}

fn rod(from: Point, to: Point, radius: f64) -> Solid {
    let way = difference(to, from);
    let length = norm(way);
    let middle = sum(from, times(way, 0.5));
    (along(middle, way), Primitive::Cylinder { radius, length })
}
