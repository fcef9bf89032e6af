//! Elements and attributes with strictness built in: what is not asked for by name is an error, not a loss.

use super::error::{Fault, Outcome};
use super::words::{alternatives, cut, did_you_mean, quoted};
use roxmltree::{Node, NodeId};
use std::ops::Range;

/// Whose an element is, by its namespace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Owner {
    /// The format's own: no namespace, or the one that the root element has.
    Format,
    /// `xacro:`.
    Xacro,
    /// Another tool's.
    Foreign,
}

/// The elements that xacro itself has; any other one is the call of a macro.
pub(super) const XACRO: [&str; 10] = [
    "property",
    "arg",
    "macro",
    "include",
    "if",
    "unless",
    "insert_block",
    "call",
    "element",
    "attribute",
];

/// An element and the text that it was parsed from.
#[derive(Clone, Copy)]
pub(super) struct Element<'a> {
    node: Node<'a, 'a>,
    text: &'a str,
}

impl<'a> Element<'a> {
    /// The root of a document, with the text as it was written.
    pub(super) fn root(document: &'a roxmltree::Document<'a>, text: &'a str) -> Self {
        Self {
            node: document.root_element(),
            text,
        }
    }

    /// The element of a document that was there under this number.
    pub(super) fn numbered(
        document: &'a roxmltree::Document<'a>,
        text: &'a str,
        number: NodeId,
    ) -> Option<Self> {
        let node = document.get_node(number)?;
        Some(Self { node, text })
    }

    /// Its number in the document.
    pub(super) fn number(&self) -> NodeId {
        self.node.id()
    }

    /// The name without its prefix.
    pub(super) fn name(&self) -> &'a str {
        let name = self.node.tag_name().name();
        // A prefix that is not declared was made part of the name so that the text could be parsed.
        if !name.contains('.') {
            return name;
        }
        match self.written_name().split_once(':') {
            Some((_, local)) => local,
            None => name,
        }
    }

    /// The namespace's address.
    pub(super) fn namespace(&self) -> Option<&'a str> {
        self.node.tag_name().namespace()
    }

    /// Whose element this is, in a file whose root element has that namespace.
    pub(super) fn owner(&self, root_namespace: Option<&str>) -> Owner {
        match self.namespace() {
            None if self.written_name().contains(':') => Owner::Foreign,
            None => Owner::Format,
            Some(address) if Some(address) == root_namespace => Owner::Format,
            // The call of a macro that is not there is left over from an expansion, and nobody knows what it stood for.
            Some(address) if address.contains("xacro") && XACRO.contains(&self.name()) => {
                Owner::Xacro
            }
            Some(_) => Owner::Foreign,
        }
    }

    /// The range of `<name`.
    pub(super) fn range(&self) -> Range<usize> {
        let whole = self.node.range();
        let tag = self.text.get(whole.clone()).unwrap_or_default();
        let ends_name = |c: char| c.is_ascii_whitespace() || c == '/' || c == '>';
        let length = tag.find(ends_name).unwrap_or(tag.len());
        whole.start..whole.start + length
    }

    /// The start of the element in the text.
    pub(super) fn start(&self) -> usize {
        self.node.range().start
    }

    /// The name as written, prefix included.
    pub(super) fn written_name(&self) -> &'a str {
        self.text
            .get(self.range())
            .and_then(|tag| tag.get(1..))
            .unwrap_or_default()
    }

    /// The whole element as written.
    pub(super) fn written(&self) -> &'a str {
        self.text.get(self.node.range()).unwrap_or_default()
    }

    /// The comments right before this element, or before its root element, in file order.
    pub(super) fn comments_before(&self) -> Vec<&'a str> {
        let before = std::iter::successors(self.node.prev_sibling(), Node::prev_sibling);
        let near = before.take_while(|node| {
            let blank = |text: &str| text.trim().is_empty();
            node.is_comment() || node.is_text() && node.text().is_some_and(blank)
        });
        let comments = near.filter(Node::is_comment);
        let mut found: Vec<&str> = comments.filter_map(|node| node.text()).collect();
        found.reverse();
        found
    }

    /// A fault about this element.
    pub(super) fn fault(&self, message: impl Into<String>) -> Fault {
        Fault::new(self.range(), message)
    }

    /// All child elements, whatever stands between them.
    pub(super) fn elements(&self) -> impl Iterator<Item = Element<'a>> + use<'a> {
        let text = self.text;
        self.node
            .children()
            .filter(|node| node.is_element())
            .map(move |node| Element { node, text })
    }

    /// All child elements, after checking that there is no text between them.
    pub(super) fn children(&self) -> Outcome<Vec<Element<'a>>> {
        let mut children = Vec::new();
        for node in self.node.children() {
            if node.is_element() {
                children.push(Element {
                    node,
                    text: self.text,
                });
            } else if let Some(text) = node.text().filter(|_| node.is_text()) {
                let stray = text.trim();
                if !stray.is_empty() {
                    let range = node.range();
                    let written = self.text.get(range.clone()).unwrap_or_default();
                    let start = range.start + (written.len() - written.trim_start().len());
                    return Err(Fault::new(
                        start..range.end.max(start),
                        format!(
                            "needed elements inside <{}>, found the text {}",
                            self.written_name(),
                            quoted(stray)
                        ),
                    )
                    .help("values are written as attributes; notes as <!-- comments -->"));
                }
            }
        }
        Ok(children)
    }

    /// Whether this element, or one anywhere inside it, is written with that prefix.
    pub(super) fn has_any_of(&self, prefix: &str) -> bool {
        let mut open = vec![*self];
        while let Some(next) = open.pop() {
            if next.written_name().starts_with(prefix) {
                return true;
            }
            open.extend(next.elements());
        }
        false
    }

    /// Whether another element has the same attributes, and neither has anything inside.
    pub(super) fn says_the_same(&self, other: &Self) -> bool {
        let said = |element: &Self| -> Vec<(&'a str, &'a str)> {
            let attributes = element.node.attributes();
            attributes.map(|a| (a.name(), a.value())).collect()
        };
        let empty = |element: &Self| !element.node.has_children();
        empty(self) && empty(other) && said(self) == said(other)
    }

    /// The place of the first text between the child elements, which means nothing in URDF.
    pub(super) fn stray_text(&self) -> Option<usize> {
        self.node.children().find_map(|node| {
            let text = node.text().filter(|_| node.is_text())?;
            (!text.trim().is_empty()).then(|| {
                let range = node.range();
                let written = self.text.get(range.clone()).unwrap_or_default();
                range.start + (written.len() - written.trim_start().len())
            })
        })
    }

    /// The text inside an element that holds nothing else, as SDF writes values.
    pub(super) fn value(&self) -> Option<Attribute<'a>> {
        let mut nodes = self.node.children().filter(|node| !node.is_comment());
        let node = nodes.next().filter(|node| node.is_text())?;
        if nodes.next().is_some() {
            return None;
        }
        let range = node.range();
        Some(Attribute {
            value: node.text()?,
            start: range.start,
            written: self.text.get(range).unwrap_or_default(),
        })
    }

    /// The attributes with other names than these, with the ranges of their names.
    pub(super) fn other_attributes<'k>(
        &self,
        known: &'k [&'k str],
    ) -> impl Iterator<Item = (&'a str, Range<usize>)> + use<'a, 'k> {
        self.node.attributes().filter_map(move |attribute| {
            let name = attribute.name();
            let is_known = attribute.namespace().is_none() && known.contains(&name);
            let start = attribute.range().start;
            (!is_known).then(|| (name, start..start + name.len()))
        })
    }

    /// An attribute without prefix.
    pub(super) fn attribute(&self, name: &str) -> Option<Attribute<'a>> {
        self.node
            .attributes()
            .find(|a| a.namespace().is_none() && a.name() == name)
            .map(|a| self.own(&a))
    }

    /// Whether it has one of these attributes.
    pub(super) fn has_any(&self, names: &[&str]) -> bool {
        names.iter().any(|name| self.attribute(name).is_some())
    }

    /// An attribute that must be there.
    pub(super) fn required(&self, name: &str) -> Outcome<Attribute<'a>> {
        self.attribute(name).ok_or_else(|| {
            self.fault(format!(
                "<{}> needs the attribute `{name}`",
                self.written_name()
            ))
            .help(format!("<{} {name}=\"...\">", self.written_name()))
        })
    }

    /// Checks that no attribute but these is there; returns the starts of those with a prefix, which are other tools'.
    pub(super) fn only_attributes(&self, known: &[&str]) -> Outcome<Vec<(usize, &'a str)>> {
        let mut foreign = Vec::new();
        for attribute in self.node.attributes() {
            if attribute.namespace().is_some() {
                foreign.push((attribute.range().start, attribute.name()));
            } else if !known.contains(&attribute.name()) {
                let needed = match known {
                    [] => "it has none".to_owned(),
                    _ => format!("it has {}", alternatives(known)),
                };
                let range = attribute.range();
                let name = attribute.name();
                return Err(Fault::new(
                    range.start..range.start + name.len(),
                    format!(
                        "<{}> has no attribute {}; {needed}",
                        self.written_name(),
                        quoted(name)
                    ),
                )
                .maybe_help(did_you_mean(name, known.iter().copied(), ("`", "`"))));
            }
        }
        Ok(foreign)
    }

    fn own(&self, attribute: &roxmltree::Attribute<'a, 'a>) -> Attribute<'a> {
        // The parser stores lengths up to the value in small integers, which overflow on hostile input: look for the quote.
        let whole = attribute.range();
        let written = self.text.get(whole.clone()).unwrap_or_default();
        let last = written.len().saturating_sub(1);
        let quote = written.get(last..).unwrap_or_default();
        let start = written.find(quote).map_or(0, |at| at + 1).min(last);
        Attribute {
            value: attribute.value(),
            start: whole.start + start,
            written: written.get(start..last).unwrap_or_default(),
        }
    }
}

/// An attribute's value and where each part of it is written.
#[derive(Clone, Copy)]
pub(super) struct Attribute<'a> {
    /// The value, with entities and line ends resolved.
    pub(super) value: &'a str,
    /// Where it starts in the text.
    start: usize,
    /// The value as written.
    written: &'a str,
}

impl<'a> Attribute<'a> {
    /// The range of the value.
    pub(super) fn range(&self) -> Range<usize> {
        self.start..self.start + self.written.len()
    }

    /// A fault about the value.
    pub(super) fn fault(&self, message: impl Into<String>) -> Fault {
        Fault::new(self.range(), message)
    }

    /// Where a part of the value, in bytes of the value, is written.
    pub(super) fn part(&self, part: Range<usize>) -> Range<usize> {
        let end = self.written_offset(part.end);
        self.start + self.written_offset(part.start).min(end)..self.start + end
    }

    /// Entities (`&amp;`) and two-byte line ends are one character of the value, and always shorter there than written.
    fn written_offset(&self, offset: usize) -> usize {
        if self.written.len() == self.value.len() {
            return offset.min(self.written.len());
        }
        let mut written = self.written.char_indices();
        for (at, _) in self.value.char_indices() {
            if at >= offset {
                break;
            }
            match written.next() {
                Some((_, '&')) => {
                    let _ = written.find(|(_, c)| *c == ';');
                }
                Some((_, '\r')) if written.as_str().starts_with('\n') => {
                    let _ = written.next();
                }
                _ => {}
            }
        }
        self.written.len() - written.as_str().len()
    }
}

/// The only element of that name inside another one; a second one is a fault.
pub(super) fn only<'a>(element: Element<'a>, name: &str) -> Outcome<Option<Element<'a>>> {
    let mut found = element.elements().filter(|part| part.name() == name);
    let first = found.next();
    match found.next() {
        Some(second) => Err(second
            .fault(format!(
                "<{}> has a second <{name}>",
                cut(element.written_name())
            ))
            .help("remove one of the two")),
        None => Ok(first),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_a_value_are_found_behind_entities_and_line_ends() {
        let text = "<a b = 'x&lt;y\r\nzé&#233;w'/>";
        let document = roxmltree::Document::parse(text).unwrap();
        let attribute = Element::root(&document, text).required("b").unwrap();
        assert_eq!(attribute.value, "x<y zééw");
        assert_eq!(&text[attribute.range()], "x&lt;y\r\nzé&#233;w");
        for (value, written) in [
            ("x", "x"),
            ("<", "&lt;"),
            ("y", "y"),
            (" ", "\r\n"),
            ("z", "z"),
            ("w", "w"),
        ] {
            let at = attribute.value.find(value).unwrap();
            assert_eq!(&text[attribute.part(at..at + value.len())], written);
        }
    }

    #[test]
    fn hostile_white_space_does_not_shift_a_value() {
        let text = format!("<a b{}='1'/>", " ".repeat(1000));
        let document = roxmltree::Document::parse(&text).unwrap();
        let attribute = Element::root(&document, &text).required("b").unwrap();
        assert_eq!(&text[attribute.range()], "1");
    }

    #[test]
    fn stray_text_is_an_error_at_its_first_letter() {
        let text = "<a> \n x <b/></a>";
        let document = roxmltree::Document::parse(text).unwrap();
        let fault = Element::root(&document, text)
            .children()
            .map(|_| ())
            .unwrap_err();
        assert_eq!(fault.range.start, 6);
    }

    #[test]
    fn unknown_attributes_name_the_nearest_one() {
        let text = "<a nmae='1' x:y='2' xmlns:x='u'/>";
        let document = roxmltree::Document::parse(text).unwrap();
        let root = Element::root(&document, text);
        let fault = root.only_attributes(&["name"]).unwrap_err();
        assert_eq!(&text[fault.range], "nmae");
        assert_eq!(fault.help.unwrap(), "did you mean `name`?");
        assert_eq!(root.only_attributes(&["nmae"]).unwrap(), [(12, "y")]);
    }
}
