//! `kutzbach features FILE --declared F`: the features of parts that a text declares.

use super::failure::Failure;
use super::features_step::{StepPart, parts as parts_of_step};
use super::files::cannot_read;
use super::geometry::{in_file, read, word, world};
use super::{DONE, output};
use clap::Args;
use kutzbach::number::Number;
use kutzbach::report::picture::solids::{FlatFace, Mark, MarkedEdge, Part, document};
use kutzbach::report::text::visible;
use kutzbach_geometry::features::{
    Declaration, Extraction, Feature, FeatureError, Role, Sort, read_declarations,
};
use kutzbach_geometry::{Boundary, Entity, Legible, Measured, Reading};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// What the data are, for who reads them.
const SCHEMA: &str = "kutzbach-features-1";

/// Find features (steps, slots, your own) that a text declares in the boundaries of parts
#[derive(Debug, Args)]
pub struct Arguments {
    /// Text with the solids and surfaces, as for `kutzbach geometry` (`-` for standard input), or a STEP file, whose faces may be round
    file: PathBuf,
    /// Declaration of features, such as `mechanisms/features/step.features`; may be repeated
    #[arg(long, value_name = "FILE", required = true)]
    declared: Vec<PathBuf>,
    /// Look in this solid or surface only; may be repeated
    #[arg(long, value_name = "NAME")]
    part: Vec<String>,
    /// Take decimals as known to half a unit of their last place; if not given, they are exact. Those of a STEP file are known within its accuracy
    #[arg(long)]
    tolerant: bool,
    /// Write data for a program
    #[arg(long)]
    json: bool,
    /// Draw the parts with the faces and edges that were found marked, as an SVG; not of a STEP file
    #[arg(long, conflicts_with = "json")]
    svg: bool,
    #[command(flatten)]
    destination: output::Destination,
}

/// Runs the command.
///
/// # Errors
/// Where a text says no entities or declares no feature, or the output cannot be written.
pub fn run(arguments: &Arguments) -> Result<u8, Failure> {
    let text = match (step(&arguments.file)?, arguments.tolerant) {
        (Some(bytes), _) => found_in_step(arguments, &bytes)?,
        (None, false) => found::<Number>(arguments)?,
        (None, true) => found::<Measured>(arguments)?,
    };
    arguments.destination.put(&text)?;
    Ok(DONE)
}

/// A part and what was found of a feature in it.
struct InPart {
    part: String,
    declaration: Declaration,
    extraction: Extraction,
    /// The names of what fills the roles of each feature.
    named: Vec<Vec<String>>,
    /// How many faces have no known surface or no edges.
    unknown: usize,
}

/// The bytes of a file that is a STEP file by its first word.
fn step(file: &Path) -> Result<Option<Vec<u8>>, Failure> {
    if file == Path::new("-") {
        return Ok(None);
    }
    let bytes = std::fs::read(file).map_err(|error| cannot_read(file, &error))?;
    let begin = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes);
    let is_step = begin.trim_ascii_start().starts_with(b"ISO-10303-21");
    Ok(is_step.then_some(bytes))
}

fn declarations(arguments: &Arguments) -> Result<Vec<Declaration>, Failure> {
    let mut declarations = Vec::new();
    for file in &arguments.declared {
        let (name, text) = read(file)?;
        declarations.extend(read_declarations(&text).map_err(|error| in_file(&name, error))?);
    }
    Ok(declarations)
}

/// The failure of a search in a part.
fn in_part(declaration: &Declaration, part: &str, error: &FeatureError) -> Failure {
    Failure::Plain {
        message: format!("{} in {part}: {error}", declaration.name),
        help: None,
    }
}

/// What was found in all parts, as a text or as data.
fn written(arguments: &Arguments, all: &[InPart], form: &str) -> Result<String, Failure> {
    match arguments.json {
        false => Ok(all.iter().map(text).collect()),
        true => output::json(&json!({
            "schema": SCHEMA,
            "file": arguments.file.display().to_string(),
            "form": form,
            "found": all.iter().map(data).collect::<Vec<Value>>(),
        })),
    }
}

fn found_in_step(arguments: &Arguments, bytes: &[u8]) -> Result<String, Failure> {
    let file = arguments.file.display();
    if arguments.svg {
        return Err(Failure::Plain {
            message: format!(
                "needed solids with flat faces for a picture, found the STEP file {file}"
            ),
            help: Some("without `--svg` what is found is listed".to_owned()),
        });
    }
    let declarations = declarations(arguments)?;
    let assembly = kutzbach_step::read(bytes).map_err(|error| Failure::Plain {
        message: format!("{file}, {error}"),
        help: None,
    })?;
    let parts = parts_of_step(&assembly);
    let names: Vec<String> = parts.iter().map(|part| part.name.clone()).collect();
    known(&names, &arguments.part)?;
    let mut all = Vec::new();
    let wanted =
        |part: &&StepPart| arguments.part.is_empty() || arguments.part.contains(&part.name);
    for part in parts.iter().filter(wanted) {
        for declaration in &declarations {
            let extraction = declaration
                .extract(&part.part)
                .map_err(|error| in_part(declaration, &part.name, &error))?;
            let names = |feature: &Feature| {
                let roles = declaration.roles.iter().zip(&feature.roles);
                let name = |(role, number): (&Role, &usize)| {
                    let names = match role.sort {
                        Sort::Edge => &part.edges,
                        Sort::Face => &part.faces,
                    };
                    names.get(*number).cloned().unwrap_or_default()
                };
                roles.map(name).collect()
            };
            all.push(InPart {
                part: part.name.clone(),
                named: extraction.features.iter().map(names).collect(),
                declaration: declaration.clone(),
                extraction,
                unknown: part.unknown,
            });
        }
    }
    written(arguments, &all, "tolerant")
}

fn found<S: Legible>(arguments: &Arguments) -> Result<String, Failure> {
    let declarations = declarations(arguments)?;
    let reading: Reading<S> = world(&arguments.file)?;
    let parts = parts(&reading, &arguments.part)?;
    let (mut all, mut pictures) = (Vec::new(), Vec::new());
    for (part, boundary) in &parts {
        for declaration in &declarations {
            let extraction = declaration
                .extract(*boundary)
                .map_err(|error| in_part(declaration, part, &error))?;
            if arguments.svg {
                pictures.push(picture(declaration, &extraction, part, boundary));
            }
            let names = |feature: &Feature| named(declaration, feature, part, &reading);
            all.push(InPart {
                part: (*part).to_owned(),
                named: extraction.features.iter().map(names).collect(),
                declaration: declaration.clone(),
                extraction,
                unknown: 0,
            });
        }
    }
    if arguments.svg {
        return Ok(document(&pictures));
    }
    let form = if arguments.tolerant {
        "tolerant"
    } else {
        "exact"
    };
    written(arguments, &all, form)
}

/// That all parts that are asked for are there.
fn known(known: &[String], wanted: &[String]) -> Result<(), Failure> {
    match wanted.iter().find(|name| !known.contains(name)) {
        Some(missing) => Err(Failure::Plain {
            message: format!("there is no solid or surface `{missing}`"),
            help: Some(format!("the file has {}", known.join(", "))),
        }),
        None => Ok(()),
    }
}

/// The boundaries that are asked about, in the order of the file.
fn parts<'a, S: Legible>(
    reading: &'a Reading<S>,
    wanted: &[String],
) -> Result<Vec<(&'a str, &'a Boundary<S>)>, Failure> {
    let boundaries = &reading.boundaries;
    known(boundaries, wanted)?;
    if boundaries.is_empty() {
        return Err(Failure::Plain {
            message: "the file has no solid and no surface".to_owned(),
            help: Some("write one from `solid NAME` to `end`".to_owned()),
        });
    }
    let asked = boundaries
        .iter()
        .filter(|name| wanted.is_empty() || wanted.contains(name));
    let found = asked.filter_map(|name| {
        let id = reading.world.find(name)?;
        match reading.world.get(id)? {
            Entity::Boundary(boundary) => Some((name.as_str(), boundary)),
            _ => None,
        }
    });
    Ok(found.collect())
}

/// The names of what fills the roles.
fn named<S>(
    declaration: &Declaration,
    feature: &Feature,
    part: &str,
    reading: &Reading<S>,
) -> Vec<String> {
    let faces = reading.faces.get(part).map_or(&[][..], Vec::as_slice);
    let roles = declaration.roles.iter().zip(&feature.roles);
    let name = |(role, number): (&Role, &usize)| match role.sort {
        Sort::Edge => format!("{part}.edge{number}"),
        Sort::Face => faces
            .get(*number)
            .cloned()
            .unwrap_or_else(|| format!("face {number}")),
    };
    roles.map(name).collect()
}

/// What was looked for in which part, and how often it was found.
fn heading(declaration: &Declaration, extraction: &Extraction, part: &str) -> String {
    let count = match extraction.features.len() {
        0 => "none".to_owned(),
        many => many.to_string(),
    };
    format!("{} in {part}: {count}", declaration.name)
}

/// A part with its features: each in a colour of its own, and numbered where there are several.
fn picture<S: Legible>(
    declaration: &Declaration,
    extraction: &Extraction,
    part: &str,
    boundary: &Boundary<S>,
) -> Part {
    let doubles = |numbers: &[S; 3]| numbers.each_ref().map(|number| number.double());
    let flat = |face: &kutzbach_geometry::Face<S>| FlatFace {
        loops: face
            .loops()
            .iter()
            .map(|corners| corners.iter().map(|corner| doubles(&corner.0)).collect())
            .collect(),
        normal: doubles(face.plane().normal().components()),
        marks: Vec::new(),
    };
    let mut faces: Vec<FlatFace> = boundary.faces().iter().map(flat).collect();
    let mut edges = Vec::new();
    for (colour, feature) in extraction.features.iter().enumerate() {
        for (role, number) in declaration.roles.iter().zip(&feature.roles) {
            let label = match extraction.features.len() {
                1 => role.name.clone(),
                _ => format!("{} {}", role.name, colour + 1),
            };
            let mark = Mark { colour, label };
            match role.sort {
                Sort::Face => {
                    if let Some(face) = faces.get_mut(*number) {
                        face.marks.push(mark);
                    }
                }
                Sort::Edge => {
                    let ends = boundary.edges().get(*number).map(|edge| edge.ends);
                    let corner = |vertex: usize| {
                        let point = boundary.vertices().get(vertex);
                        point.map(|point| doubles(&point.0))
                    };
                    let ends = ends.and_then(|[from, to]| Some([corner(from)?, corner(to)?]));
                    edges.extend(ends.map(|ends| MarkedEdge { ends, mark }));
                }
            }
        }
    }
    Part {
        title: heading(declaration, extraction, part),
        solid: boundary.is_solid(),
        faces,
        edges,
    }
}

/// A heading, the features as a table, and the plan.
fn text(found: &InPart) -> String {
    let InPart {
        part,
        declaration,
        extraction,
        named,
        unknown,
    } = found;
    let mut text = format!("{}\n", heading(declaration, extraction, part));
    let roles: Vec<String> = declaration
        .roles
        .iter()
        .map(|role| role.name.clone())
        .collect();
    let widths: Vec<usize> = (0..roles.len())
        .map(|column| {
            let cells = named.iter().chain(std::iter::once(&roles));
            let lengths = cells
                .filter_map(|row| row.get(column))
                .map(|cell| cell.chars().count());
            lengths.max().unwrap_or(0)
        })
        .collect();
    let line = |row: &[String]| {
        let cells = row.iter().zip(&widths);
        let cells: Vec<String> = cells
            .map(|(cell, &width)| format!("{cell:<width$}"))
            .collect();
        format!("  {}", cells.join("  "))
    };
    if !extraction.features.is_empty() {
        text.push_str(line(&roles).trim_end());
        text.push('\n');
    }
    for (feature, names) in extraction.features.iter().zip(named) {
        let doubt = match feature.holds.is_yes() {
            true => String::new(),
            false => format!("  ({})", word(feature.holds)),
        };
        text.push_str(format!("{}{doubt}", line(names)).trim_end());
        text.push('\n');
    }
    text.push_str("  plan, and the tuples that each step leaves:\n");
    for (number, told) in extraction.steps.iter().enumerate() {
        let step = declaration.step_text(&told.step);
        let own = format!("  {}. {step}: {} of {}", number + 1, told.left, told.filled);
        text.push_str(&visible(&own));
        text.push('\n');
    }
    if extraction.edges_without_bend > 0 {
        let edges = extraction.edges_without_bend;
        text.push_str(&format!(
            "  neither convex nor concave, since not between two faces: {edges} edge(s)\n"
        ));
    }
    if *unknown > 0 {
        text.push_str(&format!(
            "  of no type, since on no plane, cylinder, cone or sphere, or without edges: {unknown} face(s)\n"
        ));
    }
    text
}

fn data(found: &InPart) -> Value {
    let declaration = &found.declaration;
    let features = found.extraction.features.iter().zip(&found.named);
    let features = features.map(|(feature, names)| {
        let roles = declaration.roles.iter().zip(names);
        let roles: serde_json::Map<String, Value> = roles
            .map(|(role, name)| (role.name.clone(), json!(name)))
            .collect();
        json!({ "roles": roles, "holds": word(feature.holds), "ways": feature.ways })
    });
    let plan = found.extraction.steps.iter().map(|told| {
        json!({
            "step": declaration.step_text(&told.step),
            "tuples_made": told.filled,
            "tuples_left": told.left,
        })
    });
    json!({
        "part": found.part,
        "feature": declaration.name,
        "features": features.collect::<Vec<Value>>(),
        "plan": plan.collect::<Vec<Value>>(),
        "edges_without_bend": found.extraction.edges_without_bend,
        "faces_without_type": found.unknown,
    })
}
