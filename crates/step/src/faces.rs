//! Faces of the solids and shells of a representation.

use crate::curves::{Followed, edge, vertex};
use crate::error::{Problem, StepError};
use crate::measure::extents;
use crate::part21::{Instance, Record};
use crate::placement::point;
use crate::shape::{Face, FaceEdge, Note, NoteKind, Side, Surface};
use crate::surfaces::surface;
use crate::units::Units;
use kutzbach_math::group::Pose;
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// The most shells or faces that are each other's reverse, one after the other.
const LONGEST: usize = 8;

/// What was found while reading.
#[derive(Debug, Default)]
pub(crate) struct Found {
    /// Faces in the frame of the part.
    pub faces: Vec<Face>,
    /// Solids among what they bound.
    pub solids: usize,
    /// What was not read: how often, and the first of each kind.
    skipped: BTreeMap<(String, &'static str), (usize, u64, usize)>,
}

impl Found {
    fn skip(&mut self, instance: Instance<'_>, what: String, meaning: &'static str) {
        let place = (instance.line(), instance.number(), 0);
        let entry = self.skipped.entry((what, meaning)).or_insert(place);
        entry.2 += 1;
    }

    /// What was not read, as notes: one for every kind.
    pub fn notes(&self) -> Vec<Note> {
        let note = |((what, meaning), (line, entity, count)): (
            &(String, &'static str),
            &(usize, u64, usize),
        )| Note {
            line: *line,
            entity: *entity,
            kind: NoteKind::MayTouch,
            text: format!("{count} × {what}: {meaning}"),
        };
        self.skipped.iter().map(note).collect()
    }
}

/// A frame in which coordinates are written.
struct Frame<'f> {
    units: &'f Units,
    /// The frame of the part from this one.
    pose: &'f Pose,
}

/// Adds the faces of a representation that stands at `pose` in the frame of its part.
///
/// # Errors
/// References to nothing, entities of the wrong kind, geometry that is none.
pub(crate) fn of_representation(
    record: Record<'_>,
    pose: &Pose,
    found: &mut Found,
) -> Result<(), StepError> {
    let mut units = None;
    for item in record.entities_at(1)? {
        let shells = match item_shells(item)? {
            Content::Shells(shells) => shells,
            Content::Nothing => continue,
            Content::Unknown => {
                found.skip(item, item.keywords(), "not read as faces");
                continue;
            }
        };
        // A representation that holds no shape may be without units.
        let units = match units {
            Some(units) => units,
            None => *units.insert(Units::of_representation(record)?),
        };
        let frame = Frame {
            units: &units,
            pose,
        };
        found.solids += usize::from(item.is("MANIFOLD_SOLID_BREP") || is_solid(item));
        for shell in shells {
            add_shell(shell, &frame, found)?;
        }
    }
    Ok(())
}

/// What an item of a representation holds.
enum Content<'e> {
    Shells(Vec<Instance<'e>>),
    /// Nothing that could touch anything.
    Nothing,
    Unknown,
}

fn is_solid(item: Instance<'_>) -> bool {
    item.is("BREP_WITH_VOIDS") || item.is("FACETED_BREP")
}

fn item_shells(item: Instance<'_>) -> Result<Content<'_>, StepError> {
    let silent = [
        "AXIS2_PLACEMENT_3D",
        "AXIS1_PLACEMENT",
        "CARTESIAN_POINT",
        "DIRECTION",
        "MAPPED_ITEM",
        "PLACEMENT",
        // Curves and points bound nothing.
        "GEOMETRIC_CURVE_SET",
        "CARTESIAN_TRANSFORMATION_OPERATOR_3D",
    ];
    if silent.iter().any(|word| item.is(word)) {
        return Ok(Content::Nothing);
    }
    if let Some(model) = item.leaf("SHELL_BASED_SURFACE_MODEL") {
        return Ok(Content::Shells(
            model.entities_at(model.len().saturating_sub(1))?,
        ));
    }
    let mut shells = Vec::new();
    let voids = item.leaf("BREP_WITH_VOIDS");
    let outer = item
        .leaf("MANIFOLD_SOLID_BREP")
        .or_else(|| item.leaf("FACETED_BREP"));
    match (outer, voids) {
        // Of several types at once, the outer shell stands with the supertype.
        (Some(outer), _) if outer.len() > 0 => shells.push(outer.entity_at(outer.len() - 1)?),
        (_, Some(voids)) => shells.push(voids.entity_at(voids.len().saturating_sub(2))?),
        _ => return Ok(Content::Unknown),
    }
    if let Some(voids) = voids {
        shells.extend(voids.entities_at(voids.len().saturating_sub(1))?);
    }
    Ok(Content::Shells(shells))
}

/// Adds the faces of a shell. Their normals point out of the material, but for a shell that says that it is reversed.
fn add_shell(shell: Instance<'_>, frame: &Frame<'_>, found: &mut Found) -> Result<(), StepError> {
    let (mut shell, mut reversed) = (shell, false);
    for _ in 0..LONGEST {
        let oriented = shell
            .leaf("ORIENTED_CLOSED_SHELL")
            .or_else(|| shell.leaf("ORIENTED_OPEN_SHELL"));
        let Some(oriented) = oriented else {
            break;
        };
        reversed ^= !oriented.truth_at(oriented.len().saturating_sub(1))?;
        shell = oriented.entity_at(oriented.len().saturating_sub(2))?;
    }
    let record = shell
        .leaf("CLOSED_SHELL")
        .or_else(|| shell.leaf("OPEN_SHELL"))
        .or_else(|| shell.leaf("CONNECTED_FACE_SET"))
        .ok_or_else(|| shell.wrong_kind("CLOSED_SHELL or OPEN_SHELL"))?;
    for face in record.entities_at(record.len().saturating_sub(1))? {
        add_face(face, reversed, frame, found)?;
    }
    Ok(())
}

fn add_face(
    face: Instance<'_>,
    reversed: bool,
    frame: &Frame<'_>,
    found: &mut Found,
) -> Result<(), StepError> {
    let (mut face, mut reversed) = (face, reversed);
    for _ in 0..LONGEST {
        let Some(oriented) = face.leaf("ORIENTED_FACE") else {
            break;
        };
        reversed ^= !oriented.truth_at(oriented.len().saturating_sub(1))?;
        face = oriented.entity_at(oriented.len().saturating_sub(2))?;
    }
    let record = face
        .leaf("ADVANCED_FACE")
        .or_else(|| face.leaf("FACE_SURFACE"))
        .ok_or_else(|| face.wrong_kind("ADVANCED_FACE or FACE_SURFACE"))?;
    let (surface, agrees) = surface(record.entity_at(2)?, frame.units)?;
    let mut bounds = bounds(record, frame.units, found)?;
    if reversed {
        bounds.turn();
    }
    let Bounds { outline, edges } = bounds;
    let outward = record.truth_at(3)? ^ reversed ^ !agrees;
    if let Surface::Other(keyword) = &surface {
        let meaning = "faces on such surfaces make no contact";
        found.skip(face, keyword.clone(), meaning);
    }
    let (surface, material) = match surface {
        Surface::Plane { point, normal } => {
            let normal = if outward { normal } else { -normal };
            (Surface::Plane { point, normal }, Side::Inside)
        }
        curved if outward => (curved, Side::Inside),
        curved => (curved, Side::Outside),
    };
    let (extent, turned) = extents(&surface, &outline);
    let face = Face {
        entity: face.number(),
        halves: Vec::new(),
        edges,
        surface,
        material,
        outline,
        extent,
        turned,
    };
    found.faces.push(face.moved(frame.pose));
    Ok(())
}

/// What bounds a face: polygons, and the edges along them.
#[derive(Default)]
struct Bounds {
    outline: Vec<Vec<Vector3<f64>>>,
    edges: Vec<FaceEdge>,
}

impl Bounds {
    /// Lets the edges be passed the other way round.
    fn turn(&mut self) {
        for edge in &mut self.edges {
            edge.along = -edge.along;
        }
    }
}

/// The bounds of a face.
fn bounds(face: Record<'_>, units: &Units, found: &mut Found) -> Result<Bounds, StepError> {
    let mut all = Bounds::default();
    for bound in face.entities_at(1)? {
        let record = bound
            .leaf("FACE_OUTER_BOUND")
            .filter(|leaf| leaf.len() > 1)
            .or_else(|| bound.leaf("FACE_BOUND"))
            .ok_or_else(|| bound.wrong_kind("FACE_BOUND or FACE_OUTER_BOUND"))?;
        let place = record.len().saturating_sub(2);
        let mut own = Bounds::default();
        polygon(record.entity_at(place)?, units, found, &mut own)?;
        if matches!(record.truth_at(place + 1), Ok(false)) {
            own.turn();
        }
        all.outline.extend(own.outline);
        all.edges.extend(own.edges);
    }
    Ok(all)
}

/// Adds a loop as a polygon; of one corner only where it is a vertex.
fn polygon(
    bound: Instance<'_>,
    units: &Units,
    found: &mut Found,
    own: &mut Bounds,
) -> Result<(), StepError> {
    let points = if let Some(single) = bound.leaf("VERTEX_LOOP") {
        vec![vertex(single.entity_at(1)?, units)?]
    } else if let Some(corners) = bound.leaf("POLY_LOOP") {
        let corners = corners.entities_at(corners.len().saturating_sub(1))?;
        let points = corners.into_iter().map(|p| point(p, units));
        points.collect::<Result<Vec<_>, _>>()?
    } else {
        let edges = bound.expect("EDGE_LOOP", "EDGE_LOOP, VERTEX_LOOP or POLY_LOOP")?;
        let mut points = Vec::new();
        for oriented in edges.entities_at(edges.len().saturating_sub(1))? {
            let (along, edge) = oriented_edge(oriented, units, found)?;
            points.extend(along);
            own.edges.push(edge);
        }
        points
    };
    own.outline.push(points);
    Ok(())
}

/// The points of an ORIENTED_EDGE without the last, which is the first of the next, and the edge in its direction.
fn oriented_edge(
    oriented: Instance<'_>,
    units: &Units,
    found: &mut Found,
) -> Result<(Vec<Vector3<f64>>, FaceEdge), StepError> {
    let (mut element, mut forward) = (oriented, true);
    for _ in 0..LONGEST {
        let Some(record) = element.leaf("ORIENTED_EDGE") else {
            break;
        };
        forward ^= !record.truth_at(record.len().saturating_sub(1))?;
        element = record.entity_at(record.len().saturating_sub(2))?;
    }
    if element.is("ORIENTED_EDGE") {
        return Err(element.error(Problem::Cycle { what: "edges" }));
    }
    let record = element.expect("EDGE_CURVE", "EDGE_CURVE")?;
    let Followed {
        mut points,
        curve,
        unknown,
    } = edge(record, units)?;
    if let Some(keyword) = unknown {
        let meaning = "edges on such curves are taken as straight";
        found.skip(element, keyword, meaning);
    }
    if !forward {
        points.reverse();
    }
    let (at, along) = middle(&points);
    points.pop();
    let edge = FaceEdge {
        entity: element.number(),
        curve,
        at,
        along,
    };
    Ok((points, edge))
}

/// A point in the middle of a way, and the unit direction of the way there; zero where it has none.
fn middle(points: &[Vector3<f64>]) -> (Vector3<f64>, Vector3<f64>) {
    let place = points.len() / 2;
    let get = |place: usize| points.get(place).copied().unwrap_or_else(Vector3::zeros);
    let (before, after) = (
        place.saturating_sub(1),
        (place + 1).min(points.len().saturating_sub(1)),
    );
    let along = (get(after) - get(before)).try_normalize(f64::MIN_POSITIVE);
    // Of two points neither is in the middle.
    let at = match points.len() {
        2 => (get(0) + get(1)) / 2.0,
        _ => get(place),
    };
    (at, along.unwrap_or_else(Vector3::zeros))
}
