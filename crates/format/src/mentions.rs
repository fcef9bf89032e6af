//! Elements that are not read and name two joints, or two links, of the file: they may couple or join them, and then the answer is
//! about another mechanism than the one meant.
//!
//! Simulators' plugins, `<ros2_control>` and MuJoCo's elements do so in many words. Two names in different places of one element are
//! told; a list of joints, as every controller has one, is not.

use super::WarningKind;
use super::element::Element;
use super::names::Named;
use super::reader::Reader;
use super::words::{cut, quoted};
use std::collections::BTreeSet;

/// Parts of the names of elements that name several joints or links without joining them.
const HARMLESS: [&str; 9] = [
    "gripper",
    "transmission",
    "sensor",
    "collision",
    "contact",
    "camera",
    "force_element",
    "linear_bushing_rpy",
    "spring",
];

/// Parts of names of places that say what something is for: the wheels of a drive, the frames of a measurement.
const PURPOSES: [&str; 7] = ["left", "right", "wheel", "front", "rear", "frame", "steer"];

/// Elements that add up the joints that they list.
const SUMS: [&str; 2] = ["fixed", "gearbox"];

/// What an element names: the place in it, and the name.
type Mention<'a> = (String, &'a str);

impl<'a> Reader<'a> {
    /// Warns of everything that was set aside and names two joints or two links.
    pub(super) fn note_mentions(&mut self) {
        let mut told = BTreeSet::new();
        for element in std::mem::take(&mut self.set_aside) {
            let mut open = vec![element];
            while let Some(next) = open.pop() {
                if self.taken.contains(&next.start()) {
                    continue;
                }
                let name = next.name().to_lowercase();
                if HARMLESS.iter().any(|part| name.contains(part)) {
                    continue;
                }
                let Some((what, [a, b])) = self.named_by(next) else {
                    open.extend(next.elements());
                    continue;
                };
                let said = [a, b]
                    .iter()
                    .any(|joint| self.followers.contains_key(joint));
                if said || !told.insert((next.written_name(), a, b)) {
                    continue;
                }
                let message = format!(
                    "<{}> names the {what} {} and {}, and is not read: if it couples or joins them, the answer is not about that; <mimic>, <coupling> or <loop> say so",
                    cut(next.written_name()),
                    quoted(a),
                    quoted(b)
                );
                self.warn_of(next.start(), WarningKind::MayJoin, message);
            }
        }
    }

    /// Two joints or two links that an element names in different places.
    fn named_by(&self, element: Element<'a>) -> Option<(&'static str, [&'a str; 2])> {
        let mentions = mentions(element);
        let list = !SUMS.contains(&element.name());
        for (kind, what) in [(Named::Joint, "joints"), (Named::Link, "links")] {
            let known: Vec<&Mention<'a>> = mentions
                .iter()
                .filter(|(_, name)| self.directory.has(kind, name))
                .collect();
            let two = known.iter().enumerate().find_map(|(i, (place, name))| {
                let other = |m: &&&Mention<'a>| m.1 != *name && !(list && m.0 == *place);
                known[..i].iter().find(other).map(|first| [first.1, *name])
            });
            if let Some(names) = two {
                return Some((what, names));
            }
        }
        None
    }
}

/// What an element and its parts say, with the place of each.
fn mentions(element: Element<'_>) -> Vec<Mention<'_>> {
    let mut found = Vec::new();
    for (name, _) in element.other_attributes(&[]) {
        if let Some(attribute) = element.attribute(name) {
            found.push((name.to_owned(), last_part(attribute.value)));
        }
    }
    for part in element.elements() {
        let place = match part.attribute("name") {
            Some(name) if part.name() == "param" => format!("param {}", name.value),
            _ => part.name().to_owned(),
        };
        if let Some(value) = part.value() {
            found.push((place.clone(), last_part(value.value.trim())));
        }
        for (name, _) in part.other_attributes(&[]) {
            if let Some(attribute) = part.attribute(name) {
                found.push((format!("{place} {name}"), last_part(attribute.value)));
            }
        }
    }
    found.retain(|(place, _)| {
        let place = place.to_lowercase();
        !PURPOSES.iter().any(|purpose| place.contains(purpose))
    });
    found
}

/// A name without the model that it is of.
fn last_part(name: &str) -> &str {
    name.rsplit("::").next().unwrap_or(name)
}
