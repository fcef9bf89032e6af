//! Configurations by recursion: rigid parts by their own trees first, then the tree of what is left, once for every choice of how the parts
//! are put together.
//!
//! A part that is put together is a body whose coordinates are known to some 1e-14 of its size. What is left is searched for all
//! coordinates within that, as rounded numbers are: an answer is given only where every solution is proven to be one, and to be alone, for
//! all of them. Nothing else is claimed; then the tree over the pieces is asked.
//!
//! Source: Sitharam, Peters, Zhou (2010), example 4 and section 4.5.

use super::by_tree::MOST_UNKNOWNS;
use crate::collection::{Collection, RigidPart, rigid_parts, with_triangles};
use crate::placed::{Exact3, Placed, PlacedBody};
use crate::real::real_solutions_within;
use crate::reduced::ReducedSystem;
use crate::tree::optimal_incidence_tree;
use kutzbach_algebra::Budget;
use kutzbach_math::number::Number;
use kutzbach_math::space::{length, subtract};

/// A rigid part that was put together first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// Names of the bodies it is made of.
    pub bodies: Vec<String>,
    /// Weight of its incidence tree.
    pub weight: usize,
    /// In how many ways it is put together.
    pub ways: usize,
}

/// A way in which all points are placed to each other.
pub(super) struct Place {
    /// The points (m).
    pub(super) points: Vec<Option<[f64; 3]>>,
    /// How far each may be off (m).
    off: f64,
}

/// All ways, proven to be all and each one.
pub(super) struct Found {
    /// The ways.
    pub(super) places: Vec<Place>,
    /// The parts that were put together before.
    pub(super) parts: Vec<Part>,
    /// The system that was solved last, one of them where there were several.
    pub(super) system: ReducedSystem,
    /// Boxes that were looked at in all.
    pub(super) boxes: usize,
}

/// Choices of how the parts are put together, of which each is one more search.
const MOST_CHOICES: usize = 64;

/// What the coefficients of closures may be off by, in shares of what the coordinates are: they are products of four coordinates at most
/// and sums of no more than some ten such, of both signs.
const OF_COEFFICIENTS: f64 = 100.0;

/// What doubles make of a coordinate, in parts of the farthest one: some hundred operations of half a unit in the last place each.
const OF_DOUBLES: f64 = 100.0 * f64::EPSILON;

/// All configurations of a collection with exact coordinates whose tree leaves so many unknowns, by its parts; `None` where it has none that
/// leave fewer at once, or where something stayed unproven.
pub(super) fn answer(placed: &Placed, unknowns: usize, budget: &Budget) -> Option<Found> {
    let given = &placed.collection;
    let parts = rigid_parts(given);
    if parts.is_empty() || weight(&given.joined(&parts))? >= unknowns {
        return None;
    }
    let mut alone: Vec<Found> = Vec::new();
    for part in &parts {
        let pieces = alone_placed(placed, part)?;
        let by_itself = weight(&pieces.collection)?;
        let found = answer(&pieces, by_itself, budget).or_else(|| solved(&pieces, 0.0, budget))?;
        alone.push(found);
    }
    let choices = alone.iter().map(|f| f.places.len()).product();
    if choices > MOST_CHOICES {
        return None;
    }
    let mut all = Found {
        places: Vec::new(),
        parts: told(given, &parts, &mut alone),
        boxes: alone.iter().map(|found| found.boxes).sum(),
        system: alone.last()?.system.clone(),
    };
    for mut choice in 0..choices {
        let mut chosen: Vec<&Place> = Vec::new();
        for found in &alone {
            chosen.push(&found.places[choice % found.places.len()]);
            choice /= found.places.len();
        }
        let off = chosen.iter().fold(0.0, |m: f64, place| m.max(place.off));
        let found = solved(&joined(placed, &parts, &chosen)?, off, budget)?;
        all.places.extend(found.places);
        all.boxes += found.boxes;
        all.system = found.system;
    }
    Some(all)
}

/// Unknowns that the best tree leaves at once.
fn weight(collection: &Collection) -> Option<usize> {
    let all = with_triangles(collection);
    let bodies = collection.bodies();
    let needed: Vec<usize> = (0..bodies.len())
        .filter(|&b| bodies[b].points.len() > 3)
        .collect();
    Some(optimal_incidence_tree(&all, &needed, |_| true)?.weight)
}

/// The parts in words, those inside them first.
fn told(given: &Collection, parts: &[RigidPart], alone: &mut [Found]) -> Vec<Part> {
    let mut all = Vec::new();
    for (part, found) in parts.iter().zip(alone) {
        all.append(&mut found.parts);
        let bodies = part.bodies.iter();
        all.push(Part {
            bodies: bodies.map(|&b| given.bodies()[b].name.clone()).collect(),
            weight: found.system.tree.weight,
            ways: found.places.len(),
        });
    }
    all
}

/// The bodies of a part, with the distances that others keep in it.
fn alone_placed(placed: &Placed, part: &RigidPart) -> Option<Placed> {
    let collection = part.alone(&placed.collection);
    let bars = collection.bars().iter();
    Some(Placed {
        bodies: part
            .bodies
            .iter()
            .map(|&b| placed.bodies[b].clone())
            .collect(),
        bar_squares: bars
            .map(|bar| placed.distance_square(bar.ends[0], bar.ends[1]))
            .collect::<Option<_>>()?,
        collection,
        redundant: false,
        lever: 1.0,
    })
}

/// What is left when every part is one body.
fn joined(placed: &Placed, parts: &[RigidPart], chosen: &[&Place]) -> Option<Placed> {
    let left = (0..placed.bodies.len()).filter(|b| !parts.iter().any(|p| p.bodies.contains(b)));
    let mut bodies: Vec<PlacedBody> = left.map(|b| placed.bodies[b].clone()).collect();
    for (part, place) in parts.iter().zip(chosen) {
        let mut points: Vec<(usize, Exact3)> = Vec::new();
        for &point in &part.points {
            let [x, y, z] = place.points[point]?.map(Number::from_f64);
            points.push((point, [x?, y?, z?]));
        }
        bodies.push(PlacedBody {
            links: Vec::new(),
            points,
        });
    }
    Some(Placed {
        collection: placed.collection.joined(parts),
        bodies,
        bar_squares: placed.bar_squares.clone(),
        redundant: false,
        lever: 1.0,
    })
}

/// All ways of putting together bodies whose coordinates are off by so much (m), by the best tree over them.
fn solved(placed: &Placed, off: f64, budget: &Budget) -> Option<Found> {
    let share = off / smallest(placed);
    let system = ReducedSystem::within(placed, share).ok()?;
    if system.freedom() > MOST_UNKNOWNS || system.closures.len() < system.freedom() {
        return None;
    }
    let found = real_solutions_within(&system, OF_COEFFICIENTS * system.share, budget);
    if !found.is_complete() {
        return None;
    }
    // To first order: what the bodies are off adds up along the tree, as far as their points reach.
    let lever = if share > 0.0 {
        system.share / share
    } else {
        1.0
    };
    let along = off * lever * (system.tree.edges.len() + 1) as f64;
    let places = found.roots.iter().map(|root| {
        let points = system.points_at(&root.unknowns);
        let coordinates = points.iter().flatten().flatten();
        let far = coordinates.fold(0.0, |m: f64, x| m.max(x.abs()));
        // All turns add up, and each acts on an arm of no more than twice the farthest coordinate, at twice the half angle.
        let turned = 4.0 * system.freedom() as f64 * root.radius;
        Place {
            off: along + far * (turned + OF_DOUBLES),
            points,
        }
    });
    Some(Found {
        places: places.collect(),
        parts: Vec::new(),
        boxes: found.boxes,
        system,
    })
}

/// The largest distance of two points in the smallest of the bodies (m).
fn smallest(placed: &Placed) -> f64 {
    let extent = |body: &PlacedBody| {
        let at: Vec<[f64; 3]> = body
            .points
            .iter()
            .map(|(_, at)| [0, 1, 2].map(|i| at[i].value()))
            .collect();
        let pairs = at
            .iter()
            .enumerate()
            .flat_map(|(i, a)| at[..i].iter().map(move |b| distance(a, b)));
        pairs.fold(0.0, f64::max)
    };
    placed
        .bodies
        .iter()
        .map(extent)
        .fold(f64::INFINITY, f64::min)
}

fn distance(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    length(&subtract(a, b))
}
