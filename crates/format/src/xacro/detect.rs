//! Whether a file uses more of xacro than named numbers.
//!
//! Named numbers are `<xacro:property name value/>` and `<xacro:arg name default/>` directly in the robot whose values are
//! numbers or expressions, used where numbers are. The reader evaluates these itself: in any order, and with expressions
//! that xacro would take for text (`3/5` without `${}`).

use super::functions::builtin;
use super::token::base;
use super::value::Value;
use crate::definitions::BUILT_IN;
use crate::element::XACRO;
use crate::number_text::is_identifier;
use kutzbach_math::number::Number;
use roxmltree::{Document, Node};
use std::collections::BTreeSet;

/// Words of conditions.
const WORDS: [&str; 9] = [
    "if", "else", "and", "or", "not", "True", "False", "true", "false",
];
/// Signs that no expression of numbers has.
const BEYOND: [char; 8] = ['%', '\'', '"', '[', '<', '>', '=', '!'];

pub(super) fn needs_expansion(document: &Document<'_>) -> bool {
    let root = document.root_element();
    // Without these no macro can be called: what looks like a call is left over from an expansion.
    let calls = root.descendants().any(|node| {
        is_xacro(&node, &root) && matches!(node.tag_name().name(), "macro" | "include")
    });
    let mut definitions = Vec::new();
    for node in root.descendants().filter(Node::is_element) {
        if is_xacro(&node, &root) && (calls || XACRO.contains(&node.tag_name().name())) {
            if !is_plain(&node, &root) {
                return true;
            }
            definitions.push(node);
        } else if node
            .attributes()
            .any(|own| is_name_with_marks(own.name(), own.value()) || computes_beyond(own.value()))
        {
            return true;
        }
    }
    let value_of = |node: &Node<'_, '_>| {
        // The reader says what is missing.
        let value = node.attribute("value").or(node.attribute("default"));
        value.unwrap_or("0").trim().to_owned()
    };
    let mut names = BTreeSet::new();
    let mut twice = false;
    for node in &definitions {
        let name = node.attribute("name").unwrap_or_default();
        twice |= !names.insert((node.tag_name().name(), name));
    }
    let known = |name: &str| {
        ["property", "arg"]
            .iter()
            .any(|sort| names.contains(&(*sort, name)))
    };
    let bare = |value: &str| Number::decimal(value).is_err() && !value.contains('$');
    let values: Vec<String> = definitions.iter().map(value_of).collect();
    if values.iter().any(|value| is_beyond_numbers(value, &known)) {
        return true;
    }
    // Defined again is redefined, in order, unless expressions without `${}` show that the file is none of xacro's.
    twice && !values.iter().any(|value| bare(value))
}

/// Whether an element is one of xacro's, by its prefix or its address.
pub(super) fn is_xacro(node: &Node<'_, '_>, root: &Node<'_, '_>) -> bool {
    let own = node.tag_name().namespace();
    own != root.tag_name().namespace() && own.is_some_and(|address| address.contains("xacro"))
        || written_prefix(node)
}

fn written_prefix(node: &Node<'_, '_>) -> bool {
    let text = node.document().input_text();
    text.get(node.range())
        .is_some_and(|tag| tag.starts_with("<xacro:"))
}

/// A definition that the reader understands, or whose fault it tells.
fn is_plain(node: &Node<'_, '_>, root: &Node<'_, '_>) -> bool {
    let known: &[&str] = match node.tag_name().name() {
        "property" => &["default", "scope", "lazy_eval", "remove"],
        "arg" => &[],
        _ => return false,
    };
    node.parent() == Some(*root)
        && !node.attributes().any(|own| known.contains(&own.name()))
        && !node.children().any(|child| child.is_element())
        || node.tag_name().name() == "arg" && node.parent() == Some(*root)
}

/// Whether an attribute names something and is to be computed.
fn is_name_with_marks(name: &str, value: &str) -> bool {
    matches!(
        name,
        "name" | "link" | "joint" | "type" | "filename" | "reference"
    ) && (value.contains("${") || value.contains("$("))
}

/// Whether a value is text, a list or an expression that is not one of numbers.
fn is_beyond_numbers(value: &str, known: &dyn Fn(&str) -> bool) -> bool {
    if value.is_empty() || Number::decimal(value).is_ok() {
        return value.is_empty();
    }
    if value.contains(['\'', '"', '[', '<', '>', '%', ',', '=']) && !value.contains("atan2") {
        return true;
    }
    let foreign = |word: &str| word.contains("$(") && !word.contains("$(arg ");
    if foreign(value) || value.contains("//") || value.contains("$$") || computes_beyond(value) {
        return true;
    }
    let words: Vec<&str> = value
        .split(|c: char| !(c.is_alphanumeric() || c == '_' || c == '.'))
        .filter(|word| !word.is_empty())
        .collect();
    if words.iter().any(|word| WORDS.contains(word)) {
        return true;
    }
    // One word that names nothing is text; so are several without an operator between them.
    let is_one_word = is_identifier(value) && !known(value) && value != "pi";
    let is_phrase =
        value.contains(char::is_whitespace) && !value.contains(['+', '-', '*', '/', '(', '$']);
    let has_member = value.contains("${")
        && words.iter().any(|word| {
            word.split_once('.')
                .is_some_and(|(object, name)| is_identifier(object) && is_identifier(name))
        });
    is_one_word || is_phrase || has_member || joins_text(value)
}

/// Whether an expression has what xacro knows and numbers here do not: whole quotients and remainders, comparisons, choices, texts, lists,
/// functions such as `int`, digits grouped by `_`, integers in another base.
fn computes_beyond(value: &str) -> bool {
    let inside = value.split("${").skip(1);
    let mut inside = inside.filter_map(|rest| rest.split_once('}').map(|(inside, _)| inside));
    inside.any(|inside| {
        let is_word = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
        let is_foreign = |(at, word): (usize, &str)| {
            let called = inside[at + word.len()..].trim_start().starts_with('(');
            let digits = word.as_bytes();
            let number = digits.first().is_some_and(u8::is_ascii_digit);
            let function = || matches!(builtin(word), Some(Value::Function(_)));
            called && !BUILT_IN.contains(&word) && function()
                || word == "tau"
                || word.starts_with("math.")
                || number && word.contains('_')
                || base(word).is_some()
                || WORDS.contains(&word)
        };
        let mut words = inside
            .split(|c: char| !is_word(c))
            .filter(|word| !word.is_empty());
        let start = inside.as_ptr() as usize;
        inside.contains("//")
            || inside.contains(BEYOND)
            || words.any(|word| is_foreign((word.as_ptr() as usize - start, word)))
    })
}

/// Whether a letter or digit touches `${...}` or `$(...)`: a name put together.
fn joins_text(value: &str) -> bool {
    let is_part = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
    let before = |open: &str| {
        value
            .match_indices(open)
            .any(|(at, _)| is_part(value[..at].chars().next_back()))
    };
    let after = value
        .match_indices('}')
        .any(|(at, _)| is_part(value[at + 1..].chars().next()));
    before("${") || before("$(") || after
}
