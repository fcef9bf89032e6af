//! Attributes of the file that are not read.
//!
//! libsdformat passes over an attribute that it does not know with a message. Here one that is nearly a word that is read is an error: a `<pose relativeto>`
//! would stand in another frame than its writer meant.

use super::Sdf;
use crate::element::Element;
use crate::error::Outcome;
use crate::unread::unknown_attribute;

/// Elements that are looked into. What stands in others is read as a whole, or told as a whole.
const HOLDERS: [&str; 11] = [
    "world",
    "model",
    "link",
    "joint",
    "frame",
    "axis",
    "axis2",
    "limit",
    "inertial",
    "visual",
    "collision",
];

/// The attributes of an element that are read; `None` of one that is told as a whole, or whose attributes nobody writes.
fn attributes_of(name: &str) -> Option<&'static [&'static str]> {
    Some(match name {
        "sdf" => &["version"],
        "world" | "link" | "visual" | "collision" => &["name"],
        "model" => &["name", "canonical_link", "placement_frame"],
        "joint" => &["name", "type"],
        "frame" => &["name", "attached_to"],
        "pose" => &["relative_to", "frame", "degrees", "rotation_format"],
        "xyz" => &["expressed_in"],
        "mimic" => &["joint", "axis"],
        "inertial" => &["auto"],
        "screw_thread_pitch" => &["value"],
        "parent" | "child" => &["link"],
        "limit" | "dynamics" | "lower" | "upper" | "thread_pitch" => &[],
        _ => return None,
    })
}

impl<'a> Sdf<'a> {
    /// Tells the attributes that are not read.
    ///
    /// # Errors
    /// Those that are nearly words which are read.
    pub(super) fn tell_unread_words(&mut self, root: Element<'a>) -> Outcome<()> {
        let mut open = vec![root];
        while let Some(element) = open.pop() {
            if let Some(known) = attributes_of(element.name()) {
                for (name, range) in element.other_attributes(known) {
                    let start = range.start;
                    let what = unknown_attribute(element, name, range, known)?;
                    self.unread.text(start, what);
                }
            }
            if element.name() == "sdf" || HOLDERS.contains(&element.name()) {
                open.extend(element.elements());
            }
        }
        Ok(())
    }
}
