//! Where a joint of a FreeCAD document refers to: the part that moves, and the object that its frame is written in.
//!
//! A reference is a path of names from an object that holds the assembly down to an element of a shape. What follows a link to another file is
//! named as in that file, whatever this one has of the same name. Source: `UtilsAssembly.py` of FreeCAD 1.0.0, `getMovingPart`, `getObject` and
//! `fixBodyExtraFeatureInSub`.

use super::objects::{Object, Objects};

/// Links to links are followed so far: a document may hold a circle of them.
const MOST_LINKS: usize = 16;

/// What a path of names leads to.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Reference<'a> {
    /// The part that moves; none for the assembly itself.
    pub(super) part: Option<&'a str>,
    /// The array that the part is an element of.
    pub(super) array: Option<&'a str>,
    /// Objects inside the part that the frame is written in, the outermost first.
    pub(super) inner: Vec<&'a str>,
    /// `Vertex`, or empty for other elements.
    pub(super) element: &'static str,
}

/// What the names behind an object are.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Inside {
    /// Objects of this document, each placed in the one before.
    Objects,
    /// Features of a body, whose shapes lie in the body's own frame, or its datums and sketches.
    Features,
    /// Nothing that has a placement.
    Nothing,
    /// Objects of another file.
    ElsewhereNamed,
}

/// Follows one of the two references of a joint.
///
/// # Errors
/// Why it cannot be followed.
pub(super) fn follow<'a>(
    objects: &Objects<'a>,
    joint: &Object<'a>,
    number: &str,
    assembly: &str,
) -> Result<Reference<'a>, &'static str> {
    let mut words = words(joint, number);
    if words.is_empty() {
        return Err("it names no part");
    }
    if let Some(at) = words.iter().position(|word| *word == assembly) {
        words.drain(..=at);
    }
    let element = match words.pop() {
        Some(last) if last.starts_with("Vertex") => "Vertex",
        _ => "",
    };
    let mut found = Reference {
        part: None,
        array: None,
        inner: Vec::new(),
        element,
    };
    let mut rest = words.into_iter();
    while let Some(word) = rest.next() {
        let Some((&name, object)) = objects.get_key_value(word) else {
            return Err("an object that it refers to is not in the document");
        };
        match object.kind {
            "App::DocumentObjectGroup" => {}
            // The origin of the assembly stays where the assembly is.
            "App::Origin" => {
                found.inner.push(name);
                found.inner.extend(known(objects, rest));
                return Ok(found);
            }
            "Assembly::AssemblyLink" if object.says("Rigid") == Some(false) => {
                return Err("one of its parts lies in a flexible assembly inside this one");
            }
            _ if is_array(object) => found.array = Some(name),
            _ => {
                found.part = Some(name);
                found.inner = inside(objects, object, rest)?;
                return Ok(found);
            }
        }
    }
    match found.array {
        Some(_) => Err("it refers to an array, and not to one element of it"),
        None => Ok(found),
    }
}

/// The names of a path, with the element as the last one.
fn words<'a>(joint: &Object<'a>, number: &str) -> Vec<&'a str> {
    if joint.inner(&format!("Reference{number}")).is_some() {
        return linked(joint, &format!("Reference{number}"));
    }
    // As development versions before 1.0 had it: the part, the object and the element, the last two once in one property.
    let mut words = Vec::new();
    let part = joint.value(&format!("Part{number}"));
    words.extend(part.map(|part| part.value));
    let property = format!("Object{number}");
    match joint.value(&property) {
        Some(object) => words.extend(object.value.split('.')),
        None => words.extend(linked(joint, &property)),
    }
    words.dedup();
    if let Some(element) = joint.value(&format!("Element{number}")) {
        words.push(element.value);
    }
    words
}

/// The object that a link names, and the path behind it of its first element.
fn linked<'a>(joint: &Object<'a>, property: &str) -> Vec<&'a str> {
    let Some(link) = joint.inner(property) else {
        return Vec::new();
    };
    let first = link.elements().find_map(|sub| sub.attribute("value"));
    let sub = link.attribute("sub").or(first);
    let name = link.attribute("name").map_or("", |name| name.value);
    let path = sub.map_or("", |sub| sub.value);
    std::iter::once(name).chain(path.split('.')).collect()
}

/// The leading names that are objects of this document.
fn known<'a>(objects: &Objects<'a>, names: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    names
        .take_while(|name| objects.contains_key(name))
        .collect()
}

/// Objects inside a part that a frame is written in.
fn inside<'a>(
    objects: &Objects<'a>,
    part: &Object<'a>,
    names: impl Iterator<Item = &'a str>,
) -> Result<Vec<&'a str>, &'static str> {
    let mut found = Vec::new();
    let mut holder = held(objects, part);
    // A name that begins so is one of an element, kept beside its number.
    for name in names.filter(|name| !name.is_empty() && !name.starts_with(';')) {
        let object = objects.get(name);
        match (holder, object) {
            (Inside::Nothing, _) => break,
            (Inside::ElsewhereNamed, _) => {
                return Err("an object that it refers to lies in another file");
            }
            (Inside::Objects, None) => {
                return Err("an object that it refers to is not in the document");
            }
            (Inside::Features, Some(object)) if is_datum(object.kind) => {
                found.push(name);
                break;
            }
            (Inside::Features, _) => {}
            (Inside::Objects, Some(object)) => {
                found.push(name);
                holder = held(objects, object);
            }
        }
    }
    Ok(found)
}

/// What the names behind an object, or behind what it links to, are.
fn held<'a>(objects: &Objects<'a>, object: &Object<'a>) -> Inside {
    let mut at = object;
    for _ in 0..MOST_LINKS {
        let is_link = matches!(at.kind, "App::Link" | "App::LinkElement");
        let Some(link) = at.inner("LinkedObject").filter(|_| is_link) else {
            return match at.kind {
                "PartDesign::Body" => Inside::Features,
                kind if kind.starts_with("Part::") => Inside::Nothing,
                _ => Inside::Objects,
            };
        };
        let attribute = |name: &str| link.attribute(name).map_or("", |named| named.value);
        if !attribute("file").is_empty() {
            return Inside::ElsewhereNamed;
        }
        let Some(next) = objects.get(attribute("name")) else {
            return Inside::ElsewhereNamed;
        };
        at = next;
    }
    Inside::ElsewhereNamed
}

/// What of a body has a frame of its own.
fn is_datum(kind: &str) -> bool {
    matches!(
        kind,
        "Sketcher::SketchObject"
            | "PartDesign::Point"
            | "PartDesign::Line"
            | "PartDesign::Plane"
            | "PartDesign::CoordinateSystem"
    )
}

/// A link that stands several times: its elements move, each by itself.
fn is_array(object: &Object<'_>) -> bool {
    let count = object.value("ElementCount");
    object.kind == "App::Link" && count.is_some_and(|count| count.value != "0")
}
