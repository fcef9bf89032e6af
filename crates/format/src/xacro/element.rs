//! Elements apart from the text that they were read from: what macros copy and expansion makes.

use super::Place;
use super::text::Text;
use roxmltree::Node as Parsed;
use std::rc::Rc;

/// An element, read or made.
#[derive(Debug)]
pub(super) struct Element {
    /// As written, with its prefix.
    pub(super) name: Rc<str>,
    pub(super) attributes: Vec<Attribute>,
    pub(super) children: Vec<Node>,
    /// Where `<name` is written.
    pub(super) place: Place,
    /// `<xacro:...>`, by prefix or by address.
    pub(super) is_xacro: bool,
    /// The macro call that made it.
    pub(super) call: Option<u32>,
}

/// An attribute.
#[derive(Clone, Debug)]
pub(super) struct Attribute {
    /// As written, with its prefix.
    pub(super) name: Rc<str>,
    pub(super) value: Text,
    /// Where the value is written.
    pub(super) place: Place,
}

#[derive(Clone, Debug)]
pub(super) enum Node {
    Element(Rc<Element>),
    Text(Text, Place),
}

impl Element {
    pub(super) fn local_name(&self) -> &str {
        self.name
            .split_once(':')
            .map_or(&self.name, |(_, name)| name)
    }

    pub(super) fn attribute(&self, name: &str) -> Option<&Attribute> {
        self.attributes.iter().find(|own| &*own.name == name)
    }

    pub(super) fn elements(&self) -> impl Iterator<Item = &Rc<Element>> {
        self.children.iter().filter_map(|child| match child {
            Node::Element(element) => Some(element),
            Node::Text(..) => None,
        })
    }
}

/// The root of a parsed file, whose nesting is bounded, and the prefixes that it declares.
pub(super) fn root_of(
    document: &roxmltree::Document<'_>,
    file: u32,
) -> (Rc<Element>, Vec<(String, String)>) {
    let root = document.root_element();
    let mut prefixes: Vec<(String, String)> = Vec::new();
    for node in root.descendants().filter(Parsed::is_element) {
        let declares = node == root || tag_of(&node).contains("xmlns");
        for space in node.namespaces().filter(|_| declares) {
            let prefix = space.name().unwrap_or_default();
            // An inner default namespace holds for its element only.
            let counts = node == root || !prefix.is_empty();
            if counts && prefix != "xml" && !prefixes.iter().any(|(own, _)| own == prefix) {
                prefixes.push((prefix.to_owned(), space.uri().to_owned()));
            }
        }
    }
    let own_space = root.tag_name().namespace();
    (Rc::new(element_of(&root, file, own_space)), prefixes)
}

/// The start tag as written, cut at the first `>`.
fn tag_of<'a>(node: &Parsed<'_, 'a>) -> &'a str {
    let text = node.document().input_text();
    let whole = text.get(node.range()).unwrap_or_default();
    whole.split('>').next().unwrap_or_default()
}

fn element_of(node: &Parsed<'_, '_>, file: u32, root_space: Option<&str>) -> Element {
    let text = node.document().input_text();
    let start = node.range().start;
    let tag = tag_of(node);
    let ends_name = |c: char| c.is_ascii_whitespace() || c == '/';
    let length = tag.find(ends_name).unwrap_or(tag.len());
    let name = tag.get(1..length).unwrap_or_default();
    let prefix = name.split_once(':').map(|(prefix, _)| prefix);
    let by_address = || {
        let space = node.tag_name().namespace();
        space != root_space && space.is_some_and(|address| address.contains("xacro"))
    };
    let children = node.children().filter_map(|child| {
        if child.is_element() {
            return Some(Node::Element(Rc::new(element_of(&child, file, root_space))));
        }
        let content = child.text().filter(|_| child.is_text())?;
        let place = Place::new(file, child.range());
        (!content.trim().is_empty()).then(|| Node::Text(Text::plain(content), place))
    });
    Element {
        name: name.into(),
        attributes: node
            .attributes()
            .map(|attribute| attribute_of(text, &attribute, file))
            .collect(),
        children: children.collect(),
        place: Place::new(file, start..start + length),
        is_xacro: prefix == Some("xacro") || prefix.is_some() && by_address(),
        call: None,
    }
}

fn attribute_of(text: &str, attribute: &roxmltree::Attribute<'_, '_>, file: u32) -> Attribute {
    let whole = attribute.range();
    let written = text.get(whole.clone()).unwrap_or_default();
    let name = written.split('=').next().unwrap_or_default().trim();
    // Found by the quote, since the parser's own offsets overflow on hostile white space.
    let last = written.len().saturating_sub(1);
    let quote = written.get(last..).unwrap_or_default();
    let start = written.find(quote).map_or(0, |at| at + 1).min(last);
    Attribute {
        name: name.into(),
        value: Text::plain(attribute.value()),
        place: Place::new(file, whole.start + start..whole.start + last),
    }
}
