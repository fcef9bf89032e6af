//! Pieces of one cylinder, cone, sphere or plane as one face: holes come as halves from most kernels.

use crate::shape::{Face, Surface};
use nalgebra::Vector3;
use std::collections::HashMap;
use std::f64::consts::TAU;

/// Directions of pieces of one surface agree within this (rad): they are copies of each other's numbers, or fitted to splines
/// with that accuracy.
const TURN: f64 = 1e-6;

/// Points and radii of pieces of one surface agree within this many of their sizes, besides the accuracy of the file.
const DIGITS: f64 = 1e-6;

/// Cells of the grid in which candidates are looked for are so large (m) at least: holes are seldom nearer to each other.
const LEAST_CELL: f64 = 1e-2;

/// Makes one face of all cylinders, cones and spheres of a part that are pieces of one, one beside the other.
///
/// `accuracy` is how far points of the file may be off (m). Costs in proportion to the faces, as long as few of one size are in one place: plates with
/// tens of thousands of equal holes are drawn.
pub(crate) fn merged(faces: Vec<Face>, accuracy: f64) -> Vec<Face> {
    let grid = Grid::of(&faces, accuracy);
    let mut out: Vec<Face> = Vec::with_capacity(faces.len());
    let mut by_cell: HashMap<Cell, Vec<usize>> = HashMap::new();
    for face in faces {
        let Some(size) = size(&face.surface) else {
            out.push(face);
            continue;
        };
        let width = (DIGITS * size).max(accuracy);
        let near = grid.cells(&face.surface, size, grid.margin);
        let near = near
            .iter()
            .flat_map(|cell| by_cell.get(cell).into_iter().flatten());
        let found = near.copied().find(|place| {
            out.get(*place)
                .is_some_and(|other| one_face(other, &face, width))
        });
        match found.and_then(|place| out.get_mut(place)) {
            Some(other) => join(other, face),
            None => {
                for cell in grid.cells(&face.surface, size, 0.0) {
                    by_cell.entry(cell).or_default().push(out.len());
                }
                out.push(face);
            }
        }
    }
    out
}

/// A step of sizes, beside whose neighbours a piece is looked for too, and a cube of space.
type Cell = (i64, [i64; 3]);

/// Surfaces by their size and place.
struct Grid {
    /// The edge of a cube (m).
    cell: f64,
    /// How far the places of pieces of one surface may be from each other (m).
    margin: f64,
}

impl Grid {
    /// For these faces: their directions may be off, and turn a foot on an axis by as much of its distance.
    fn of(faces: &[Face], accuracy: f64) -> Self {
        let reach = |face: &Face| {
            let (point, size) = (point(&face.surface)?, size(&face.surface)?);
            Some(DIGITS * size + 2.0 * TURN * point.norm())
        };
        let margin = accuracy + faces.iter().filter_map(reach).fold(0.0, f64::max);
        Self {
            cell: LEAST_CELL.max(8.0 * margin),
            margin,
        }
    }

    /// The cells of surfaces of a size within `margin` (m) of a surface: a few, since cells are larger. One without a margin.
    fn cells(&self, surface: &Surface, size: f64, margin: f64) -> Vec<Cell> {
        let Some(place) = place(surface) else {
            return Vec::new();
        };
        let at = |x: f64| (x / self.cell).floor() as i64;
        let range = |i: usize| at(place[i] - margin)..=at(place[i] + margin);
        let steps = i64::from(margin > 0.0);
        let mut cells = Vec::new();
        for step in step(size) - steps..=step(size) + steps {
            for x in range(0) {
                for y in range(1) {
                    cells.extend(range(2).map(|z| (step, [x, y, z])));
                }
            }
        }
        cells
    }
}

/// A point that says where a surface is.
fn point(surface: &Surface) -> Option<Vector3<f64>> {
    match surface {
        Surface::Cylinder { point, .. } => Some(*point),
        Surface::Cone { apex, .. } => Some(*apex),
        Surface::Sphere { centre, .. } => Some(*centre),
        Surface::Plane { .. } | Surface::Other(_) => None,
    }
}

/// The same point for all pieces of a surface: of an axis the one nearest to the origin.
fn place(surface: &Surface) -> Option<Vector3<f64>> {
    let point = point(surface)?;
    Some(match surface {
        Surface::Cylinder { direction, .. } => point - direction * direction.dot(&point),
        _ => point,
    })
}

/// What tells surfaces apart first: radius, or the angle of a cone. Planes are left as they are: their pieces touch by
/// themselves.
fn size(surface: &Surface) -> Option<f64> {
    match surface {
        Surface::Cylinder { radius, .. } | Surface::Sphere { radius, .. } => Some(*radius),
        Surface::Cone { half_angle, .. } => Some(*half_angle),
        Surface::Plane { .. } | Surface::Other(_) => None,
    }
}

/// Sizes by steps of a hundredth of themselves.
fn step(size: f64) -> i64 {
    (size.ln() * 100.0).floor() as i64
}

fn one_face(a: &Face, b: &Face, width: f64) -> bool {
    let near = |p: Vector3<f64>, q: Vector3<f64>| (p - q).norm() <= width;
    let on_line =
        |p: Vector3<f64>, q: Vector3<f64>, d: Vector3<f64>| (p - q).cross(&d).norm() <= width;
    let along = |d: Vector3<f64>, e: Vector3<f64>| d.cross(&e).norm() <= TURN;
    a.material == b.material
        && match (&a.surface, &b.surface) {
            (
                Surface::Cylinder {
                    point: p,
                    direction: d,
                    radius: r,
                },
                Surface::Cylinder {
                    point: q,
                    direction: e,
                    radius: s,
                },
            ) => {
                along(*d, *e)
                    && (r - s).abs() <= width
                    && on_line(*p, *q, *d)
                    && beside(a.extent, along_other(a, b), width)
            }
            (
                Surface::Cone {
                    apex: p,
                    direction: d,
                    half_angle: h,
                },
                Surface::Cone {
                    apex: q,
                    direction: e,
                    half_angle: k,
                },
            ) => {
                along(*d, *e)
                    && d.dot(e) > 0.0
                    && (h - k).abs() <= TURN
                    && near(*p, *q)
                    && beside(a.extent, b.extent, width)
            }
            (
                Surface::Sphere {
                    centre: p,
                    radius: r,
                },
                Surface::Sphere {
                    centre: q,
                    radius: s,
                },
            ) => near(*p, *q) && (r - s).abs() <= width,
            _ => false,
        }
}

/// Where `b` goes along the axis of `a`.
fn along_other(a: &Face, b: &Face) -> (f64, f64) {
    match (a.surface.axis(), b.surface.axis()) {
        (Some((p, d)), Some((q, e))) => {
            let at = |height: f64| (q + e * height - p).dot(&d);
            let (one, two) = (at(b.extent.0), at(b.extent.1));
            (one.min(two), one.max(two))
        }
        _ => b.extent,
    }
}

/// Halves stand beside each other: two seats of one bore, one behind the other, are two faces.
fn beside(a: (f64, f64), b: (f64, f64), width: f64) -> bool {
    a.0 < b.1 - width && b.0 < a.1 - width
}

fn join(face: &mut Face, piece: Face) {
    let extent = along_other(face, &piece);
    face.extent = (face.extent.0.min(extent.0), face.extent.1.max(extent.1));
    face.turned = (face.turned + piece.turned).min(TAU);
    face.halves.push(piece.entity);
    face.halves.extend(piece.halves);
    face.edges.extend(piece.edges);
    face.outline.extend(piece.outline);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Side;
    use std::f64::consts::PI;

    fn half(x: f64, y: f64, point_at: f64, entity: u64) -> Face {
        Face {
            entity,
            halves: Vec::new(),
            edges: Vec::new(),
            surface: Surface::Cylinder {
                point: Vector3::new(x, y, point_at),
                direction: Vector3::z() * if entity.is_multiple_of(2) { 1.0 } else { -1.0 },
                radius: 0.002,
            },
            material: Side::Outside,
            outline: Vec::new(),
            // From z = 0 to z = 0.01, whichever way the axis points.
            extent: match entity % 2 {
                0 => (-point_at, 0.01 - point_at),
                _ => (point_at - 0.01, point_at),
            },
            turned: PI,
        }
    }

    /// Rows of holes, each of which comes as two halves whose axes are written differently: some are at the border of a cell.
    #[test]
    fn halves_find_each_other_among_thousands_of_equal_holes() {
        let count = 40;
        let mut faces = Vec::new();
        for i in 0..count * count {
            let (x, y) = (f64::from(i % count) * 0.005, f64::from(i / count) * 0.005);
            let number = 2 * i as u64;
            faces.push(half(x, y, 0.0, number));
            faces.push(half(x + 1e-10, y - 1e-10, 7.0, number + 1));
        }
        let found = merged(faces, 1e-9);
        assert_eq!(found.len(), (count * count) as usize);
        for face in &found {
            assert_eq!(face.halves, [face.entity + 1]);
            assert!((face.turned - TAU).abs() < 1e-12, "{face:?}");
        }
    }
}
