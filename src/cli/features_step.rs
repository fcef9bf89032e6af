//! The parts of a STEP file as faces and edges in which features are looked for.

use kutzbach_geometry::features::{RoundEdge, RoundFace, RoundPart, Shape};
use kutzbach_step::{Assembly, EdgeCurve, Face, FaceEdge, Side, Surface};
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;
use std::sync::Arc;

/// Lengths (m) and angles (rad) that agree within these are the same, whatever finer accuracy a file states.
const FINEST: (f64, f64) = (1e-7, 1e-6);

/// Faces agree in direction within so many times what the digits leave open of one: each of two frames may be off.
const FRAMES: f64 = 4.0;

/// What halves of a round face may lack of a whole turn together (rad), by their digits.
const WHOLE: f64 = 1e-3;

/// A part of the file, once however often it occurs.
pub struct StepPart {
    /// Its name.
    pub name: String,
    /// Its faces and edges.
    pub part: RoundPart,
    /// The entities of its faces, as `#12`.
    pub faces: Vec<String>,
    /// The entities of its edges.
    pub edges: Vec<String>,
    /// How many of its faces are on surfaces of no known type, or have bounds without edges.
    pub unknown: usize,
}

/// The parts of an assembly, those that are one product once.
pub fn parts(assembly: &Assembly) -> Vec<StepPart> {
    let mut seen = BTreeSet::new();
    let products = assembly
        .parts
        .iter()
        .filter(|part| seen.insert(Arc::as_ptr(&part.faces)));
    let (length, angle) = (
        assembly.accuracy.max(FINEST.0),
        (FRAMES * assembly.tilt).max(FINEST.1),
    );
    products
        .map(|part| {
            let faces: &[Face] = &part.faces;
            let (edges, names) = edges(faces, length);
            let unknown =
                |face: &&Face| matches!(face.surface, Surface::Other(_)) || face.edges.is_empty();
            StepPart {
                name: part.name.clone(),
                faces: faces
                    .iter()
                    .map(|face| format!("#{}", face.entity))
                    .collect(),
                edges: names,
                unknown: faces.iter().filter(unknown).count(),
                part: RoundPart::new(faces.iter().map(round).collect(), edges, length, angle),
            }
        })
        .collect()
}

fn round(face: &Face) -> RoundFace {
    let shape = match face.surface {
        Surface::Plane { point, normal } => Shape::Plane { point, normal },
        Surface::Cylinder {
            point,
            direction,
            radius,
        } => Shape::Cylinder {
            point,
            direction,
            radius,
        },
        Surface::Cone {
            apex,
            direction,
            half_angle,
        } => Shape::Cone {
            apex,
            direction,
            half_angle,
        },
        Surface::Sphere { centre, radius } => Shape::Sphere { centre, radius },
        Surface::Other(_) => Shape::Other,
    };
    RoundFace {
        shape,
        convex: face.material == Side::Inside,
        whole: face.turned >= TAU - WHOLE,
        loops: face.outline.len(),
    }
}

/// The edges between different faces, with the names of their entities. Arcs of one circle between the same faces are one edge, as a hole whose wall
/// comes in halves has two.
fn edges(faces: &[Face], length: f64) -> (Vec<RoundEdge>, Vec<String>) {
    let mut uses: BTreeMap<u64, Vec<(usize, &FaceEdge)>> = BTreeMap::new();
    for (number, face) in faces.iter().enumerate() {
        for edge in &face.edges {
            uses.entry(edge.entity).or_default().push((number, edge));
        }
    }
    let mut between: BTreeMap<Vec<usize>, Vec<Shape>> = BTreeMap::new();
    let (mut edges, mut names) = (Vec::new(), Vec::new());
    for (entity, uses) in uses {
        let Some((_, first)) = uses.first() else {
            continue;
        };
        let beside: BTreeSet<usize> = uses.iter().map(|(face, _)| *face).collect();
        // A seam is no edge: the face goes on.
        if beside.len() < 2 {
            continue;
        }
        let shape = match first.curve {
            EdgeCurve::Line => Shape::Line {
                direction: first.along,
            },
            EdgeCurve::Circle {
                centre,
                axis,
                radius,
            } => Shape::Circle {
                centre,
                axis,
                radius,
            },
            EdgeCurve::Other => Shape::Other,
        };
        let known = between.entry(beside.into_iter().collect()).or_default();
        if known.iter().any(|other| one_circle(other, &shape, length)) {
            continue;
        }
        known.push(shape);
        names.push(format!("#{entity}"));
        edges.push(RoundEdge {
            shape,
            at: first.at,
            uses: uses
                .iter()
                .map(|(face, edge)| (*face, edge.along))
                .collect(),
        });
    }
    (edges, names)
}

fn one_circle(a: &Shape, b: &Shape, length: f64) -> bool {
    match (a, b) {
        (
            Shape::Circle {
                centre: p,
                radius: r,
                ..
            },
            Shape::Circle {
                centre: q,
                radius: s,
                ..
            },
        ) => (p - q).norm() <= length && (r - s).abs() <= length,
        _ => false,
    }
}
