//! Calls of macros in a file that defines and includes none.
//!
//! Directly in the robot a part of it is missing, and the file that defines the macro was not included: that is an error. In
//! published models such calls are also left over from an expansion by other means, in the looks of links and in files that
//! call themselves plain URDF. Nobody knows what these stood for: they are skipped, with a warning.

use super::detect::is_xacro;
use super::element::Element;
use super::{Told, Trouble};
use crate::element::XACRO;
use crate::error::{Fault, FormatError, lines_and_columns, located};
use crate::words::{cut, did_you_mean, quoted};
use crate::{Warning, WarningKind};
use roxmltree::{Document, Node};
use std::path::Path;

/// Macros that are told as skipped.
const MOST_TOLD: usize = 100;

/// Whether a file says by its name that it is plain URDF.
pub(super) fn is_plain(file: &str) -> bool {
    let extension = Path::new(file).extension();
    extension.is_some_and(|own| own.eq_ignore_ascii_case("urdf"))
}

/// Whether anything in an element defines or includes macros.
pub(super) fn can_call(element: &Element) -> bool {
    element.is_xacro && matches!(element.local_name(), "macro" | "include")
        || element.elements().any(|inner| can_call(inner))
}

/// What is told about a call that is skipped.
pub(super) fn told(written: &str) -> Told {
    let message = format!(
        "<{}> calls a macro that the file neither defines nor includes: what it stood for is not read",
        cut(written)
    );
    let element = cut(written).into_owned();
    (WarningKind::NotCalled { element }, message)
}

/// The trouble about a call of a macro that is not among those known.
pub(super) fn unknown(name: &str, known: &[String]) -> Box<Trouble> {
    let near = did_you_mean(name, known.iter().map(String::as_str), ("`", "`"));
    Trouble::new(format!("unknown macro {}", quoted(name)))
        .help("nothing defines it: is the <xacro:include> of its file missing?")
        .maybe_help(near)
}

/// Warnings about the calls that are skipped in a file that needs no expansion, each macro told once.
///
/// # Errors
/// Calls of macros that cannot be skipped.
pub(super) fn calls(
    document: &Document<'_>,
    text: &str,
    file: &str,
) -> Result<Vec<Warning>, FormatError> {
    let root = document.root_element();
    let is_call = |node: &Node<'_, '_>| {
        node.is_element() && is_xacro(node, &root) && !XACRO.contains(&node.tag_name().name())
    };
    let in_link = |node: &Node<'_, '_>| node.ancestors().any(|outer| outer.has_tag_name("link"));
    let is_plain = is_plain(file);
    let mut faults = Vec::new();
    let mut skipped: Vec<(usize, Told, usize)> = Vec::new();
    for node in root.descendants().filter(is_call) {
        let start = node.range().start;
        let tag = text.get(start + 1..).unwrap_or_default();
        let ends = |c: char| c.is_whitespace() || matches!(c, '/' | '>');
        let written = &tag[..tag.find(ends).unwrap_or(tag.len())];
        if !is_plain && !in_link(&node) {
            let trouble = unknown(node.tag_name().name(), &[]);
            let range = start..start + 1 + written.len();
            faults.push(Fault::new(range, trouble.message).maybe_help(trouble.help));
            continue;
        }
        let told = told(written);
        let known = skipped.iter().position(|(_, own, _)| *own == told);
        match known {
            Some(index) => skipped[index].2 += 1,
            None if skipped.len() < MOST_TOLD => skipped.push((start, told, 1)),
            None => {}
        }
    }
    if !faults.is_empty() {
        return Err(located(file, text, faults));
    }
    let starts: Vec<usize> = skipped.iter().map(|(start, ..)| *start).collect();
    let places = lines_and_columns(text, &starts);
    let told = places.into_iter().zip(skipped);
    Ok(told
        .map(|((line, column), (_, (kind, message), count))| Warning {
            line,
            column,
            kind,
            message,
            count,
        })
        .collect())
}
