//! Pieces of one cylinder, cone, sphere or plane as one face: holes come as halves from most kernels.

use crate::shape::{Face, Surface};
use nalgebra::Vector3;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Directions of pieces of one surface agree within this (rad): they are copies of each other's numbers, or fitted to splines
/// with that accuracy.
const TURN: f64 = 1e-6;

/// Points and radii of pieces of one surface agree within this many of their sizes, besides the accuracy of the file.
const DIGITS: f64 = 1e-6;

/// Makes one face of all cylinders, cones and spheres of a part that are pieces of one, one beside the other.
///
/// `accuracy` is how far points of the file may be off (m).
pub(crate) fn merged(faces: Vec<Face>, accuracy: f64) -> Vec<Face> {
    let mut out: Vec<Face> = Vec::with_capacity(faces.len());
    // Candidates by radius in steps; a piece looks at its own step and both beside it.
    let mut by_step: BTreeMap<i64, Vec<usize>> = BTreeMap::new();
    for face in faces {
        let Some(size) = size(&face.surface) else {
            out.push(face);
            continue;
        };
        let width = (DIGITS * size).max(accuracy);
        let step = step(size);
        let near = (step - 1..=step + 1).flat_map(|s| by_step.get(&s).into_iter().flatten());
        let found = near.copied().find(|place| {
            out.get(*place)
                .is_some_and(|other| one_face(other, &face, width))
        });
        match found.and_then(|place| out.get_mut(place)) {
            Some(other) => join(other, face),
            None => {
                by_step.entry(step).or_default().push(out.len());
                out.push(face);
            }
        }
    }
    out
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
