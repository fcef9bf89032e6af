//! `<attach model body prefix>`: a body of another file in its place, written out before anything is read; a frame with `frame`, and without either all
//! that stands in the world of that file.
//!
//! What is attached stands in a `<frame>` with the settings and the default classes of its file; the prefix begins all names that it brings. Tendons,
//! equalities and actuators of that file come along where everything that they name is brought, or is the world, and [keys](super::attached_keys) with what
//! they say of it. So much is what MuJoCo 4.0.0 makes of such files, but for keys of what the attached file itself attaches, of whose names it forgets the
//! outer prefix. What else the file says stays behind, and is told.

use super::classes::{ATTACHED, MAIN};
use super::include::{Piece, Whole, expanded};
use super::replicate::{REFERENCES, Sort, stretch};
use crate::element::{Attribute, Element};
use crate::error::{Fault, FormatError, Outcome};
use crate::words::{did_you_mean, quoted};
use crate::writer::escaped;
use crate::{guard, xml};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// What `<compiler>` says where a file leaves it out.
const SETTINGS: &str =
    r#"<compiler angle="degree" eulerseq="xyz" autolimits="true" inertiafromgeom="auto"/>"#;

/// Sections of which something comes along; what names others after them.
const SECTIONS: [&str; 3] = ["tendon", "equality", "actuator"];

/// Sections that are taken in other ways.
const TAKEN: [&str; 6] = [
    "compiler",
    "default",
    ATTACHED,
    "worldbody",
    "keyframe",
    "asset",
];

/// MuJoCo's name of a model that has none.
const NAMELESS: &str = "MuJoCo Model";

/// A text with what it attaches written out.
///
/// # Errors
/// Models that cannot be read, bodies and frames that they do not have, and attachments without a model.
pub(super) fn attached(mut whole: Whole, depth: usize) -> Result<Whole, FormatError> {
    if !whole.text.contains("<attach") {
        return Ok(whole);
    }
    let asked = match asked(&whole) {
        Ok(asked) => asked,
        Err(fault) => return Err(whole.located(vec![fault])),
    };
    if asked.attachments.is_empty() {
        return Ok(whole);
    }
    let mut models: BTreeMap<String, Whole> = BTreeMap::new();
    for one in &asked.attachments {
        if !models.contains_key(&one.file) {
            let found = whole.model(one.range.start, &one.file);
            let (path, text) = match found {
                Ok(found) => found,
                Err(message) => {
                    let fault = Fault::new(one.range.clone(), message);
                    return Err(whole.located(vec![fault]));
                }
            };
            let name = path.display().to_string();
            let mut model = expanded(&text, &name, Some(path.as_path()), depth + 1)?;
            whole.adopt(&mut model);
            models.insert(one.file.clone(), model);
        }
    }
    match written_out(&whole, &asked, &models) {
        Ok((text, pieces)) => Ok(whole.rewritten(text, pieces)),
        Err(fault) => Err(whole.located(vec![fault])),
    }
}

/// An `<attach>`.
struct Attachment {
    range: Range<usize>,
    file: String,
    wanted: Wanted,
    prefix: String,
}

/// What is attached of a model.
enum Wanted {
    /// Everything in its world.
    World,
    /// The element with a name.
    Named(&'static str, String),
}

impl Wanted {
    fn of(attach: Element<'_>) -> Outcome<Self> {
        let named = |sort: &'static str| {
            let name = attach.attribute(sort)?;
            Some(Self::Named(sort, name.value.to_owned()))
        };
        match (named("body"), named("frame")) {
            (Some(_), Some(_)) => {
                Err(attach.fault("<attach> takes a `body` or a `frame`, not both"))
            }
            (body, frame) => Ok(body.or(frame).unwrap_or(Self::World)),
        }
    }
}

/// All of a text, and where its root element ends.
struct Asked {
    attachments: Vec<Attachment>,
    end: usize,
}

fn asked(whole: &Whole) -> Outcome<Asked> {
    let document = xml::parse(&whole.text)?;
    let root = Element::root(&document, &whole.text);
    let models = inside(root, "asset").filter(|part| part.name() == "model");
    let models = models.filter_map(|model| {
        let file = model.attribute("file")?;
        Some(match model.attribute("name") {
            Some(name) => Ok((name.value.to_owned(), file.value)),
            None => own_name(whole, file).map(|name| (name, file.value)),
        })
    });
    let models: Vec<(String, &str)> = models.collect::<Outcome<_>>()?;
    let mut attachments = Vec::new();
    let worlds = root.elements().filter(|part| part.name() == "worldbody");
    let mut open: Vec<Element<'_>> = worlds.collect();
    while let Some(element) = open.pop() {
        if element.name() != "attach" {
            open.extend(element.elements());
            continue;
        }
        let Some(model) = element.attribute("model") else {
            return Err(element
                .fault("<attach> without a `model`, which copies something of the file itself, is not read")
                .help("save the model as MuJoCo compiled it: mj_saveLastXML"));
        };
        let file = models.iter().find(|(name, _)| *name == model.value);
        let Some((_, file)) = file else {
            let known = models.iter().map(|(name, _)| &name[..]);
            return Err(model
                .fault(format!("there is no model {}", quoted(model.value)))
                .maybe_help(did_you_mean(model.value, known, ("`", "`"))));
        };
        attachments.push(Attachment {
            range: stretch(element),
            file: (*file).to_owned(),
            wanted: Wanted::of(element)?,
            prefix: element.required("prefix")?.value.to_owned(),
        });
    }
    attachments.sort_by_key(|one| one.range.start);
    let last = root.elements().last();
    Ok(Asked {
        attachments,
        end: last.map_or(0, |part| stretch(part).end),
    })
}

/// What a file calls its model, which is the model's name where the file that attaches it gives none.
fn own_name(whole: &Whole, file: Attribute<'_>) -> Outcome<String> {
    let found = whole.model(file.range().start, file.value);
    let (_, text) = found.map_err(|message| file.fault(message))?;
    let document = xml::parse(&text)
        .map_err(|fault| file.fault(format!("{}: {}", quoted(file.value), fault.message)))?;
    let own = Element::root(&document, &text).attribute("model");
    Ok(own.map_or(NAMELESS, |own| own.value).to_owned())
}

/// The elements in all sections of a name.
fn inside<'a>(root: Element<'a>, name: &'static str) -> impl Iterator<Item = Element<'a>> {
    let sections = root.elements().filter(move |part| part.name() == name);
    sections.flat_map(|section| section.elements())
}

fn written_out(
    whole: &Whole,
    asked: &Asked,
    models: &BTreeMap<String, Whole>,
) -> Outcome<(String, Vec<Piece>)> {
    let mut writing = Writing::default();
    let mut sections = Writing::default();
    let mut at = 0;
    for one in &asked.attachments {
        let Some(model) = models.get(&one.file) else {
            continue;
        };
        writing.copy(whole, at..one.range.start, None);
        let main = whole.place(one.range.start).0;
        let document = xml::parse(&model.text)?;
        let brought = Brought {
            model,
            root: Element::root(&document, &model.text),
            prefix: escaped(&one.prefix).replace('\'', "&apos;"),
            mark: one.range.start.to_string(),
            main,
        };
        let (parts, class) = brought.wanted(one)?;
        brought.frame(&parts, class, &mut writing);
        brought.sections(&parts, &mut sections);
        at = one.range.end;
        let size = writing.text.len() + sections.text.len() + whole.text.len();
        if let Some(fault) = guard::size_fault(size as u64) {
            return Err(Fault {
                range: one.range.clone(),
                ..fault
            });
        }
    }
    writing.copy(whole, at..asked.end, None);
    writing.append(sections);
    writing.copy(whole, asked.end..whole.text.len(), None);
    Ok((writing.text, writing.pieces))
}

/// What one attachment brings of a model.
pub(super) struct Brought<'m> {
    pub(super) model: &'m Whole,
    pub(super) root: Element<'m>,
    pub(super) prefix: String,
    /// What the attachment is known by: no other one of the text has it.
    pub(super) mark: String,
    /// Where the main file asks for it.
    pub(super) main: usize,
}

impl<'m> Brought<'m> {
    pub(super) fn sections_named(&self, name: &'static str) -> impl Iterator<Item = Element<'m>> {
        self.root.elements().filter(move |part| part.name() == name)
    }

    pub(super) fn worlds(&self) -> impl Iterator<Item = Element<'m>> {
        self.sections_named("worldbody")
    }

    /// The elements that an attachment is for, and the class that those around them give what is inside them.
    fn wanted(&self, one: &Attachment) -> Outcome<(Vec<Element<'m>>, Option<&'m str>)> {
        let (sort, name) = match &one.wanted {
            Wanted::World => {
                let all = self.worlds().flat_map(|world| world.elements());
                return Ok((all.collect(), None));
            }
            Wanted::Named(sort, name) => (*sort, name),
        };
        let Some((element, class)) = self.named(sort, name) else {
            let message = format!(
                "there is no {sort} {} in {}",
                quoted(name),
                quoted(&one.file)
            );
            return Err(Fault::new(one.range.clone(), message));
        };
        Ok((vec![element], class))
    }

    /// A body or a frame, and the class that those around it give what is inside it. What the model itself attaches has settings of its own, and is
    /// brought with the body that it is attached to only.
    fn named(&self, sort: &str, name: &str) -> Option<(Element<'m>, Option<&'m str>)> {
        let mut open: Vec<(Element<'m>, Option<&'m str>)> =
            self.worlds().map(|part| (part, None)).collect();
        while let Some((element, class)) = open.pop() {
            let own = element.attribute("name").map(|own| own.value);
            if element.name() == sort && own == Some(name) {
                return Some((element, class));
            }
            if element.attribute(ATTACHED).is_some() {
                continue;
            }
            let own = element.attribute("childclass").map(|own| own.value);
            open.extend(element.elements().map(|part| (part, own.or(class))));
        }
        None
    }

    /// The name of the class of the whole file.
    fn class(&self) -> &'m str {
        let mut defaults = self.root.elements().filter(|part| part.name() == "default");
        let named = defaults.find_map(|section| section.attribute("class"));
        named.map_or(MAIN, |class| class.value)
    }

    /// Writes elements in a frame.
    fn frame(&self, parts: &[Element<'m>], class: Option<&str>, writing: &mut Writing) {
        let class = escaped(class.unwrap_or_else(|| self.class())).into_owned();
        let open = format!(
            "<frame {ATTACHED}=\"{}\" childclass=\"{}{class}\">{SETTINGS}",
            self.mark, self.prefix
        );
        let at = parts.first().map_or(self.root.start(), Element::start);
        writing.insert(self.model, &open, at, Some(self.main));
        for settings in self.sections_named("compiler") {
            writing.copy(self.model, stretch(settings), Some(self.main));
        }
        for part in parts {
            self.write(*part, Vec::new(), writing);
        }
        writing.insert(self.model, "</frame>", at, Some(self.main));
    }

    /// Writes the classes of the file, and what of its sections belongs to the elements.
    fn sections(&self, parts: &[Element<'m>], writing: &mut Writing) {
        let (at, main) = (self.root.start(), Some(self.main));
        let class = format!("{}{}", self.prefix, escaped(self.class()));
        let open = format!("<{ATTACHED} class=\"{class}\">");
        writing.insert(self.model, &open, at, main);
        for part in inside(self.root, "default") {
            self.write(part, Vec::new(), writing);
        }
        writing.insert(self.model, &format!("</{ATTACHED}>"), at, main);
        for classes in self.sections_named(ATTACHED) {
            self.write(classes, Vec::new(), writing);
        }
        let mut known = names_in(parts);
        for name in SECTIONS {
            writing.insert(self.model, &format!("<{name}>"), at, main);
            for part in inside(self.root, name) {
                let references = references_of(part);
                let is_brought =
                    |(sort, name): &&(Sort, Attribute<'_>)| known.contains(&(*sort, name.value));
                let all = references.iter().all(|own| is_brought(&own));
                let mut brought = references.iter().filter(is_brought);
                let any = brought.any(|(sort, name)| !is_world(*sort, name));
                if !all {
                    if name == "equality" && any {
                        // It holds something that is not brought, and nothing then; as what is not active it is told.
                        let text = format!("<{} active=\"false\"/>", part.name());
                        writing.insert(self.model, &text, part.start(), main);
                    }
                    continue;
                }
                let mut more = Vec::new();
                if part.attribute("class").is_none() {
                    more.push((part.range().end, format!(" class=\"{class}\"")));
                }
                if let Some(own) = part.attribute("name").filter(|_| name == "tendon") {
                    known.insert((Sort::Tendon, own.value));
                }
                self.write(part, more, writing);
            }
            writing.insert(self.model, &format!("</{name}>"), at, main);
        }
        self.keys(parts, writing);
        let left = self.root.elements();
        for part in
            left.filter(|part| !SECTIONS.contains(&part.name()) && !TAKEN.contains(&part.name()))
        {
            // Empty, it says nothing, and is told as what is not read.
            writing.insert(
                self.model,
                &format!("<{}/>", part.name()),
                part.start(),
                main,
            );
        }
    }

    /// Writes an element with its names longer, and with more text at some places.
    pub(super) fn write(
        &self,
        element: Element<'m>,
        more: Vec<(usize, String)>,
        writing: &mut Writing,
    ) {
        let mut marks = more;
        let mut open = vec![element];
        while let Some(part) = open.pop() {
            let own = ["name", "class", "childclass", "site"].into_iter();
            let own = own.filter_map(|name| part.attribute(name));
            let others = own_references(part).filter(|(sort, name)| !is_world(*sort, name));
            let names = own.chain(others.map(|(_, name)| name));
            marks.extend(names.map(|name| (name.range().start, self.prefix.clone())));
            let mark = part.attribute(ATTACHED);
            marks.extend(mark.map(|own| (own.range().start, format!("{}/", self.mark))));
            open.extend(part.elements());
        }
        marks.sort_by_key(|(at, _)| *at);
        let all = stretch(element);
        let mut at = all.start;
        for (place, text) in &marks {
            writing.copy(self.model, at..*place, Some(self.main));
            writing.insert(self.model, text, *place, Some(self.main));
            at = *place;
        }
        writing.copy(self.model, at..all.end, Some(self.main));
    }
}

fn is_world(sort: Sort, name: &Attribute<'_>) -> bool {
    sort == Sort::Body && name.value == super::WORLD
}

/// What an element itself names.
fn own_references(element: Element<'_>) -> impl Iterator<Item = (Sort, Attribute<'_>)> {
    let all = REFERENCES.into_iter();
    all.filter_map(move |(name, sort)| Some((sort, element.attribute(name)?)))
}

/// What an element and those inside it name.
fn references_of(part: Element<'_>) -> Vec<(Sort, Attribute<'_>)> {
    let all = std::iter::once(part).chain(part.elements());
    all.flat_map(own_references).collect()
}

/// What elements bring that others may name; and the world, which all have.
fn names_in<'a>(parts: &[Element<'a>]) -> BTreeSet<(Sort, &'a str)> {
    let mut found = BTreeSet::from([(Sort::Body, super::WORLD)]);
    let mut open = parts.to_vec();
    while let Some(element) = open.pop() {
        let sort = match element.name() {
            "body" => Some(Sort::Body),
            "joint" | "freejoint" => Some(Sort::Joint),
            "site" => Some(Sort::Site),
            _ => None,
        };
        let name = element.attribute("name");
        found.extend(sort.zip(name.map(|name| name.value)));
        open.extend(element.elements());
    }
    found
}

/// The text that is made, and where its parts are from.
#[derive(Default)]
pub(super) struct Writing {
    text: String,
    pieces: Vec<Piece>,
}

impl Writing {
    /// Copies a stretch of a text; of another file's, what the main file asks for at a place.
    fn copy(&mut self, from: &Whole, range: Range<usize>, main: Option<usize>) {
        let mut at = range.start;
        while at < range.end {
            let next = from.next_piece(at).unwrap_or(range.end);
            let end = next.min(range.end);
            let text = from.text.get(at..end).unwrap_or_default();
            self.insert(from, text, at, main);
            at = end;
        }
    }

    /// Writes something that belongs to a place of a text.
    pub(super) fn insert(&mut self, from: &Whole, text: &str, at: usize, main: Option<usize>) {
        if !text.is_empty() {
            let piece = from.piece_of(at, self.text.len());
            self.pieces.extend(piece.map(|piece| match main {
                Some(main) => piece.asked_for_at(main),
                None => piece,
            }));
            self.text.push_str(text);
        }
    }

    fn append(&mut self, other: Self) {
        let start = self.text.len();
        let pieces = other.pieces.into_iter();
        self.pieces.extend(pieces.map(|piece| piece.moved(start)));
        self.text.push_str(&other.text);
    }
}
