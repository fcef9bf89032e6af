//! From products to parts at their places.

use crate::digits::uncertainty;
use crate::error::{Problem, StepError};
use crate::faces::{Found, of_representation};
use crate::kinematics::{Occurred, Shown, has_pairs, mechanisms};
use crate::merge::merged;
use crate::part21::{Exchange, Instance, Record};
use crate::products::{Products, loose_representations};
use crate::representations::{Owners, expect_representation};
use crate::shape::{Assembly, Face, Note, NoteKind, Part};
use crate::units::Units;
use kutzbach_math::group::Pose;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// The most parts that an assembly may have, each counted as often as it occurs.
const MOST_PARTS: usize = 50_000;

/// The most assemblies within each other.
const DEEPEST: usize = 256;

/// The most occurrences that are visited, those of assemblies among them.
const MOST_OCCURRENCES: usize = 200_000;

/// Of files that an assembly refers to so many are named, and so many letters of each.
const MOST_NAMED: usize = 4;
const LONGEST_NAME: usize = 60;

/// Three components that are off by as much each are off by this many times as much together.
const WORST: f64 = 1.732_050_807_568_877_2;

/// What a product looks like, read once.
#[derive(Clone)]
struct Shape {
    faces: Arc<Vec<Face>>,
    notes: Vec<Note>,
    /// Unit of length (m) and accuracy (m); `None` where nothing shows the product.
    units: Option<(f64, f64)>,
}

/// The assembly that a file says.
///
/// # Errors
/// As for [`Products::new`] and [`of_representation`]; occurrences that are nowhere; more parts than can be read.
pub(crate) fn assembly<'e>(file: &'e Exchange<'e>) -> Result<Assembly, StepError> {
    let products = Products::new(file)?;
    let mut builder = Builder {
        assembly: Assembly {
            length_unit: 0.0,
            accuracy: 0.0,
            printed: 0.0,
            tilt: WORST * uncertainty(file, "DIRECTION"),
            schemas: file.schemas().to_vec(),
            parts: Vec::new(),
            pairs: Vec::new(),
            base: None,
            notes: Vec::new(),
        },
        owners: products.owners(),
        products: &products,
        shapes: BTreeMap::new(),
        names: BTreeSet::new(),
        counts: BTreeMap::new(),
        digits: WORST * uncertainty(file, "CARTESIAN_POINT"),
        has_pairs: has_pairs(file),
        occurred: Vec::new(),
        shown: Shown::new(),
    };
    for root in products.roots() {
        builder.walk(root)?;
    }
    if builder.assembly.parts.is_empty() {
        builder.without_products(file)?;
    }
    let elsewhere = elsewhere(file);
    if builder.assembly.parts.is_empty() {
        let found = match &elsewhere {
            Some(note) => format!("{}: export the assembly as one file", note.text),
            None => "none: export the assembly with its shape (boundary representation)".to_owned(),
        };
        let needed = "solids or shells with faces";
        let (line, entity) = elsewhere.map_or((1, None), |note| (note.line, Some(note.entity)));
        return Err(StepError::at(
            line,
            entity,
            Problem::Geometry { needed, found },
        ));
    }
    builder.assembly.notes.extend(elsewhere);
    builder.assembly.accuracy += levered(&builder.assembly);
    builder.assembly.printed = builder.digits * builder.assembly.length_unit;
    let said = mechanisms(file, &builder.occurred, &builder.shown)?;
    builder.assembly.pairs = said.pairs;
    builder.assembly.base = said.base;
    builder.assembly.notes.extend(said.notes);
    Ok(builder.assembly)
}

/// The files in which a file says that shapes stand, in the order in which it names them; `None` where it names none.
fn elsewhere(file: &Exchange<'_>) -> Option<Note> {
    let mut names: Vec<String> = Vec::new();
    let mut first = None;
    for record in file.of_type("DOCUMENT_FILE") {
        let name = record.text_at(0);
        let lower = name.to_lowercase();
        let is_step = [".stp", ".step", ".p21"]
            .iter()
            .any(|end| lower.ends_with(end));
        let kind = record.entity_at(3).ok();
        let kind = kind.and_then(|kind| Some(kind.leaf("DOCUMENT_TYPE")?.text_at(0)));
        let is_shape = is_step || kind.is_some_and(|kind| kind == "geometry");
        if is_shape && !names.contains(&name) {
            names.push(name);
            first.get_or_insert((record.instance().line(), record.number()));
        }
    }
    let (line, entity) = first?;
    let count = names.len();
    let shown: Vec<String> = names
        .iter()
        .take(MOST_NAMED)
        .map(|name| format!("`{}`", name.chars().take(LONGEST_NAME).collect::<String>()))
        .collect();
    let more = match count.saturating_sub(shown.len()) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    let text = format!(
        "shapes that stand in {count} other {}, {}{more}, which are not read",
        if count == 1 { "file" } else { "files" },
        shown.join(", ")
    );
    Some(Note {
        line,
        entity,
        kind: NoteKind::MayTouch,
        text,
    })
}

/// How far (m) the directions of places may move the points of parts: twice, by a place and by the frame of the part that it refers to.
fn levered(assembly: &Assembly) -> f64 {
    if assembly.tilt == 0.0 {
        return 0.0;
    }
    let mut seen = BTreeSet::new();
    let parts = assembly.parts.iter();
    let faces = parts
        .filter(|part| seen.insert(Arc::as_ptr(&part.faces)))
        .flat_map(|part| part.faces.iter());
    let points = faces.flat_map(|face| face.outline.iter().flatten());
    2.0 * assembly.tilt * points.map(|point| point.norm()).fold(0.0, f64::max)
}

struct Builder<'p, 'e> {
    products: &'p Products<'e>,
    owners: Owners,
    assembly: Assembly,
    shapes: BTreeMap<u64, Shape>,
    names: BTreeSet<String>,
    /// How many parts of each name there are.
    counts: BTreeMap<String, usize>,
    /// How far points may be off by their digits, in the unit of the file.
    digits: f64,
    /// Whether the file has kinematic pairs, so that occurrences are kept.
    has_pairs: bool,
    /// Where products occur.
    occurred: Vec<Occurred>,
    /// Which representation shows which product.
    shown: Shown,
}

/// An occurrence on the way.
struct Visit<'e> {
    product: u64,
    pose: Pose,
    path: Vec<String>,
    /// The numbers of the occurrences that lead to it.
    chain: Vec<u64>,
    /// The occurrence above whose place is not known.
    unplaced: Option<Instance<'e>>,
}

impl<'e> Builder<'_, 'e> {
    /// Adds the parts of a product that is nobody's component.
    fn walk(&mut self, root: u64) -> Result<(), StepError> {
        let products = self.products;
        let mut open: Vec<Visit<'e>> = vec![Visit {
            product: root,
            pose: Pose::identity(),
            path: Vec::new(),
            chain: Vec::new(),
            unplaced: None,
        }];
        let mut visited = 0;
        while let Some(visit) = open.pop() {
            let Some(product) = products.all.get(&visit.product) else {
                continue;
            };
            visited += 1;
            let too_much = [
                (visited > MOST_OCCURRENCES, "occurrences", MOST_OCCURRENCES),
                (
                    visit.path.len() > DEEPEST,
                    "assemblies within each other",
                    DEEPEST,
                ),
                (self.assembly.parts.len() >= MOST_PARTS, "parts", MOST_PARTS),
            ];
            if let Some((_, what, limit)) = too_much.into_iter().find(|(over, ..)| *over) {
                let limit = limit as u64;
                return Err(product.definition.error(Problem::TooMuch { what, limit }));
            }
            let part = self.add(&visit)?;
            if self.has_pairs {
                self.occurred.push(Occurred {
                    chain: visit.chain.clone(),
                    product: visit.product,
                    pose: visit.pose,
                    part,
                });
            }
            for occurrence in product.occurrences.iter().rev() {
                let mut path = visit.path.clone();
                path.push(occurrence.name.clone());
                let mut chain = Vec::new();
                if self.has_pairs {
                    chain.clone_from(&visit.chain);
                    chain.push(occurrence.usage.number());
                }
                let nowhere = occurrence.pose.is_none().then_some(occurrence.usage);
                open.push(Visit {
                    product: occurrence.child,
                    pose: visit.pose * occurrence.pose.unwrap_or_default(),
                    path,
                    chain,
                    unplaced: visit.unplaced.or(nowhere),
                });
            }
        }
        Ok(())
    }

    /// Adds a product at one place, where it has faces of its own; the place among the parts.
    fn add(&mut self, visit: &Visit<'e>) -> Result<Option<usize>, StepError> {
        let products = self.products;
        let Some(product) = products.all.get(&visit.product) else {
            return Ok(None);
        };
        let shape = match self.shapes.get(&visit.product) {
            Some(shape) => shape.clone(),
            None => {
                let spread = products.relations.spread(
                    &product.representations,
                    Some(visit.product),
                    &self.owners,
                )?;
                for (record, pose) in &spread {
                    let own = (visit.product, *pose);
                    self.shown.entry(record.number()).or_insert(own);
                }
                let shape =
                    self.shape(product.definition, &spread, product.occurrences.is_empty())?;
                self.assembly.notes.extend(shape.notes.iter().cloned());
                self.shapes.insert(visit.product, shape.clone());
                shape
            }
        };
        if shape.faces.is_empty() {
            return Ok(None);
        }
        if let Some(usage) = visit.unplaced {
            return Err(usage.geometry(
                "the place of an occurrence (CONTEXT_DEPENDENT_SHAPE_REPRESENTATION, or a MAPPED_ITEM of the assembly)",
                "none: export the assembly with its placements",
            ));
        }
        let place = self.assembly.parts.len();
        self.push(product.name.clone(), visit.path.clone(), visit.pose, &shape);
        Ok(Some(place))
    }

    fn push(&mut self, product: String, path: Vec<String>, pose: Pose, shape: &Shape) {
        if let Some((unit, accuracy)) = shape.units {
            if self.assembly.length_unit == 0.0 {
                self.assembly.length_unit = unit;
            }
            self.assembly.accuracy = self.assembly.accuracy.max(accuracy);
        }
        let name = self.unique(&product);
        self.assembly.parts.push(Part {
            name,
            product,
            path,
            pose,
            faces: Arc::clone(&shape.faces),
        });
    }

    /// A name that no part has yet: the given one, or with a number behind it.
    fn unique(&mut self, name: &str) -> String {
        let count = self.counts.entry(name.to_owned()).or_insert(0);
        loop {
            *count += 1;
            let candidate = match *count {
                1 => name.to_owned(),
                n => format!("{name} ({n})"),
            };
            if self.names.insert(candidate.clone()) {
                return candidate;
            }
        }
    }

    /// The faces of some representations. `alone` says that nothing else shows the product.
    fn shape(
        &self,
        owner: Instance<'_>,
        spread: &[(Record<'_>, Pose)],
        alone: bool,
    ) -> Result<Shape, StepError> {
        let mut found = Found::default();
        let mut units: Option<(f64, f64)> = None;
        for (record, pose) in spread {
            let before = found.faces.len();
            of_representation(*record, pose, &mut found)?;
            if found.faces.len() > before {
                let own = Units::of_representation(*record)?;
                let (unit, accuracy) = units.unwrap_or((own.length, 0.0));
                let digits = self.digits * own.length;
                units = Some((unit, accuracy.max(own.accuracy).max(digits)));
            }
        }
        let mut notes = found.notes();
        let mut note = |kind: NoteKind, text: String| {
            notes.push(Note {
                line: owner.line(),
                entity: owner.number(),
                kind,
                text,
            });
        };
        if found.solids > 1 {
            let text = format!(
                "{} solids of one product, taken as one rigid part",
                found.solids
            );
            note(NoteKind::Taken, text);
        }
        if alone && found.faces.is_empty() {
            note(
                NoteKind::MayTouch,
                "a product without faces: it is not among the parts".to_owned(),
            );
        }
        let accuracy = units.map_or(0.0, |(_, accuracy)| accuracy);
        Ok(Shape {
            faces: Arc::new(merged(found.faces, accuracy)),
            notes,
            units,
        })
    }

    /// Adds every representation as a part, for files that have no products.
    fn without_products(&mut self, file: &'e Exchange<'e>) -> Result<(), StepError> {
        let mut seen = BTreeSet::new();
        for instance in loose_representations(file)? {
            // What one representation shows of another is not shown again.
            if !seen.insert(instance.number()) {
                continue;
            }
            let relations = &self.products.relations;
            let spread = relations.spread(&[instance], None, &self.owners)?;
            seen.extend(spread.iter().map(|(record, _)| record.number()));
            let shape = self.shape(instance, &spread, true)?;
            self.assembly.notes.extend(shape.notes.iter().cloned());
            if shape.faces.is_empty() {
                continue;
            }
            let name = expect_representation(instance)?.text_at(0);
            let name = if name.trim().is_empty() {
                format!("#{}", instance.number())
            } else {
                name
            };
            self.push(name, Vec::new(), Pose::identity(), &shape);
        }
        Ok(())
    }
}
