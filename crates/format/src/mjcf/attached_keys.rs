//! Keys of files that something is attached from.
//!
//! `qpos` of such a key has the coordinates of its own file, in the order of the joints there. It is written out with the places of those numbers that are for
//! joints of what is attached, and with the mark of the attachment, which the joints have too. MuJoCo 4.0.0 gives all others their values as drawn.

use super::attach::{Brought, Writing};
use super::classes::{ATTACHED, Classes};
use super::keys::{BESIDE_POSES, OF_ALL, TAKEN};
use super::replicate::stretch;
use crate::element::Element;
use crate::error::Outcome;
use crate::writer::escaped;
use std::ops::Range;

/// An element of the tree, and the class that those around it give.
type Open<'a> = (Element<'a>, Option<&'a str>);

impl<'m> Brought<'m> {
    /// Writes the keys of the file, and those that its own attachments brought.
    pub(super) fn keys(&self, parts: &[Element<'m>], writing: &mut Writing) {
        let keyframes = self.sections_named("keyframe");
        let keys: Vec<Element<'m>> = keyframes.flat_map(|section| section.elements()).collect();
        // What is wrong with the classes is told where they are read.
        let Some(widths) = self.coordinates().ok().filter(|_| !keys.is_empty()) else {
            return;
        };
        let taken = taken(&widths, parts);
        let all: usize = widths.iter().map(|(_, width)| width).sum();
        let at = self.root.start();
        writing.insert(self.model, "<keyframe>", at, Some(self.main));
        for key in keys {
            if key.name() != "key" || key.attribute(ATTACHED).is_some() {
                self.write(key, Vec::new(), writing);
                continue;
            }
            let name = key.attribute("name").map_or("", |name| name.value);
            let name = format!("{}{}", self.prefix, escaped(name));
            let mut text = format!(
                "<key {ATTACHED}=\"{}\" {OF_ALL}=\"{all}\" {TAKEN}=\"{taken}\"",
                self.mark
            );
            if !name.is_empty() {
                text += &format!(" name=\"{name}\"");
            }
            for name in ["qpos"].into_iter().chain(BESIDE_POSES) {
                if let Some(says) = key.attribute(name) {
                    text += &format!(" {name}=\"{}\"", escaped(says.value));
                }
            }
            text += "/>";
            writing.insert(self.model, &text, key.start(), Some(self.main));
        }
        writing.insert(self.model, "</keyframe>", at, Some(self.main));
    }

    /// Where each joint of the file is written and how many numbers `qpos` has for it, in its order.
    fn coordinates(&self) -> Outcome<Vec<(usize, usize)>> {
        let mut classes = Classes::default();
        for section in self
            .sections_named("default")
            .chain(self.sections_named(ATTACHED))
        {
            classes.read(section)?;
        }
        let mut found = Vec::new();
        let mut open: Vec<Open<'m>> = self.worlds().map(|world| (world, None)).collect();
        open.reverse();
        while let Some((element, class)) = open.pop() {
            if element.name() == "body" {
                for (joint, class) in joints_of((element, class)) {
                    found.push((joint.start(), width(&classes, joint, class)?));
                }
            }
            let inside = element.elements();
            let inside: Vec<Open<'m>> = inside
                .filter(|part| matches!(part.name(), "body" | "frame"))
                .map(|part| (part, class_in(part, class)))
                .collect();
            open.extend(inside.into_iter().rev());
        }
        Ok(found)
    }
}

fn class_in<'a>(element: Element<'a>, class: Option<&'a str>) -> Option<&'a str> {
    let own = element.attribute("childclass").map(|own| own.value);
    own.or(class)
}

/// The joints of a body, in frames inside it too.
fn joints_of<'a>(body: Open<'a>) -> Vec<Open<'a>> {
    let mut found = Vec::new();
    let mut open = vec![body];
    while let Some((element, class)) = open.pop() {
        match element.name() {
            "joint" | "freejoint" => found.push((element, class)),
            _ => {
                let inside: Vec<Open<'a>> = element
                    .elements()
                    .filter(|part| matches!(part.name(), "joint" | "freejoint" | "frame"))
                    .map(|part| (part, class_in(part, class)))
                    .collect();
                open.extend(inside.into_iter().rev());
            }
        }
    }
    found
}

fn width<'a>(classes: &Classes<'a>, joint: Element<'a>, class: Option<&'a str>) -> Outcome<usize> {
    if joint.name() == "freejoint" {
        return Ok(7);
    }
    let class = classes.of(joint, class)?;
    let word = classes.attribute(joint, class, "type");
    Ok(match word.map_or("hinge", |word| word.value) {
        "free" => 7,
        "ball" => 4,
        _ => 1,
    })
}

/// The places in `qpos` of the numbers of all joints in some elements.
fn taken(widths: &[(usize, usize)], parts: &[Element<'_>]) -> String {
    let within: Vec<Range<usize>> = parts.iter().map(|part| stretch(*part)).collect();
    let mut places = Vec::new();
    let mut next = 0;
    for (at, width) in widths {
        if within.iter().any(|range| range.contains(at)) {
            places.extend((next..next + width).map(|place| place.to_string()));
        }
        next += width;
    }
    places.join(" ")
}
