//! Which part is the ground.

use super::fasteners::{is_fastener, words_of};
use kutzbach_step::{Assembly, Part};
use nalgebra::Vector3;

/// Words of parts that stand still, from the one that says it most clearly. A word counts that begins or ends with one of them:
/// `baseplate`, `mainframe`.
const WORDS: [&str; 6] = ["ground", "base", "frame", "bed", "housing", "case"];

/// Why a part was chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Why {
    /// A person said so.
    Said,
    /// The mechanism of the file has it as its base.
    Base,
    /// Its name does.
    Name,
    /// It has the largest box around it.
    Size,
}

/// The part that is held, by its place: the one that was said, else the base of the file's mechanism, else one whose name says so, else the one with the largest box along the
/// axes of the assembly, which is mostly the heaviest; of equal ones the first. `None` where there are no parts.
pub(super) fn choose(assembly: &Assembly, said: Option<usize>) -> Option<(usize, Why)> {
    if let Some(place) = said {
        return Some((place, Why::Said));
    }
    if let Some(place) = assembly.base {
        return Some((place, Why::Base));
    }
    let words: Vec<Vec<String>> = assembly
        .parts
        .iter()
        .map(|part| match is_fastener(&part.name) {
            true => Vec::new(),
            false => words_of(&part.name),
        })
        .collect();
    let says = |own: &[String], wanted: &str| {
        let mut own = own.iter();
        own.any(|word| word.starts_with(wanted) || word.ends_with(wanted))
    };
    for wanted in WORDS {
        if let Some(place) = words.iter().position(|own| says(own, wanted)) {
            return Some((place, Why::Name));
        }
    }
    let mut largest: Option<(usize, f64)> = None;
    for (place, part) in assembly.parts.iter().enumerate() {
        let size = volume(part);
        if largest.is_none_or(|(_, most)| size > most) {
            largest = Some((place, size));
        }
    }
    largest.map(|(place, _)| (place, Why::Size))
}

/// The volume of the box around a part (m³), of flat ones with a thickness of a micrometre.
fn volume(part: &Part) -> f64 {
    let outlines = part.faces.iter().flat_map(|face| &face.outline).flatten();
    let mut points = outlines.map(|point| part.pose.transform_point(point));
    let Some(first) = points.next() else {
        return 0.0;
    };
    let bounds = |(low, high): (Vector3<f64>, Vector3<f64>), point: Vector3<f64>| {
        (low.inf(&point), high.sup(&point))
    };
    let (low, high) = points.fold((first, first), bounds);
    (high - low).iter().map(|edge| edge.max(1e-6)).product()
}
