//! XML that is not quite XML, as the parser of ROS (TinyXML-2) reads it.
//!
//! TinyXML-2 knows no namespaces, ends a comment at the first `-->` whatever stands before it, and does not mind where a
//! declaration stands. Files that rely on that are common. They are parsed from a copy of the same length, in which a
//! colon after an undeclared prefix is a point and comments and stray declarations are blank, so that every place in the
//! copy is the same place in the file.

use super::words::quoted;
use std::collections::HashSet;
use std::ops::Range;

/// A text that a strict parser may read where it refused the original one, and what was changed, with places; `None` where
/// there is nothing to change.
pub(super) fn relaxed(text: &str) -> Option<(String, Vec<(usize, String)>)> {
    let marks = markup(text);
    let declared = declared_prefixes(text, &marks);
    let mut bytes = text.as_bytes().to_vec();
    let mut notes = Vec::new();
    for mark in marks {
        let piece = &text[mark.clone()];
        if let Some(content) = piece.strip_prefix("<!--") {
            let content = content.strip_suffix("-->").unwrap_or(content);
            // A comment that ends in a dash would make three before the end.
            if content.contains("--") || content.ends_with('-') {
                blank(&mut bytes, mark.start + 4..mark.start + 4 + content.len());
                notes.push((
                    mark.start,
                    "a comment with `--` inside is read to the first `-->`".to_owned(),
                ));
            }
        } else if piece.starts_with("<?") {
            let at_start = text[..mark.start].trim_start_matches('\u{feff}').is_empty();
            if declares(piece) && !(at_start && piece.starts_with("<?xml")) {
                blank(&mut bytes, mark.clone());
                notes.push((
                    mark.start,
                    "a declaration <?xml ...?> that is not at the very start is skipped".to_owned(),
                ));
            }
        } else {
            for (colon, prefix) in colons(text, mark) {
                // What is xacro's bears on everything; it must be declared.
                if prefix != "xacro"
                    && prefix != "xml"
                    && prefix != "xmlns"
                    && !declared.contains(prefix)
                {
                    bytes[colon] = b'.';
                    notes.push((
                        colon - prefix.len(),
                        format!("the prefix {} is not declared", quoted(prefix)),
                    ));
                }
            }
        }
    }
    if notes.is_empty() {
        return None;
    }
    // Whole characters were replaced by whole characters.
    String::from_utf8(bytes).ok().map(|text| (text, notes))
}

fn declares(instruction: &str) -> bool {
    let name = instruction.get(2..).unwrap_or_default().trim_start();
    name.starts_with("xml") && !name.starts_with("xml-")
}

fn blank(bytes: &mut [u8], range: Range<usize>) {
    for byte in bytes.get_mut(range).unwrap_or_default() {
        if !byte.is_ascii_whitespace() {
            *byte = b' ';
        }
    }
}

/// Comments, instructions and tags, in order; character data and its sections are left out.
fn markup(text: &str) -> Vec<Range<usize>> {
    let mut marks = Vec::new();
    let mut at = 0;
    while let Some(start) = text[at..].find('<').map(|found| at + found) {
        let rest = &text[start..];
        let (end, wanted) = if rest.starts_with("<!--") {
            (
                rest.get(4..).and_then(|r| r.find("-->")).map(|e| e + 7),
                true,
            )
        } else if rest.starts_with("<![CDATA[") {
            (rest.find("]]>").map(|e| e + 3), false)
        } else if rest.starts_with("<?") {
            (rest.find("?>").map(|e| e + 2), true)
        } else {
            (tag_length(rest.as_bytes()), true)
        };
        let Some(end) = end else { break };
        if wanted {
            marks.push(start..start + end);
        }
        at = start + end;
    }
    marks
}

/// Length of a tag, quotes respected.
fn tag_length(tag: &[u8]) -> Option<usize> {
    let mut quote = None;
    for (at, byte) in tag.iter().enumerate() {
        match (quote, byte) {
            (None, b'>') => return Some(at + 1),
            (None, b'"' | b'\'') => quote = Some(*byte),
            (Some(open), _) if open == *byte => quote = None,
            _ => {}
        }
    }
    None
}

/// The colons in names of a tag, with the words before them.
fn colons(text: &str, tag: Range<usize>) -> Vec<(usize, &str)> {
    let mut colons = Vec::new();
    let (mut quote, mut word) = (None, tag.start);
    for (at, byte) in text.bytes().enumerate().take(tag.end).skip(tag.start) {
        match (quote, byte) {
            (Some(open), _) => {
                if open == byte {
                    quote = None;
                }
                word = at + 1;
            }
            (None, b'"' | b'\'') => quote = Some(byte),
            (None, b':') if at > word => {
                colons.push((at, &text[word..at]));
                word = at + 1;
            }
            (None, b'<' | b'/' | b'=' | b'>') => word = at + 1,
            (None, _) if byte.is_ascii_whitespace() => word = at + 1,
            _ => {}
        }
    }
    colons
}

fn declared_prefixes<'a>(text: &'a str, marks: &[Range<usize>]) -> HashSet<&'a str> {
    let mut declared = HashSet::new();
    for mark in marks {
        for (colon, prefix) in colons(text, mark.clone()) {
            if prefix == "xmlns" {
                let rest = &text[colon + 1..];
                let ends = |c: char| c == '=' || c.is_whitespace();
                declared.insert(rest.split(ends).next().unwrap_or_default());
            }
        }
    }
    declared
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::relaxed;

    #[test]
    fn what_xml_forbids_is_replaced_in_place() {
        let text = " <?xml version='1.0'?><!-- é--b --><r><a:b c:d=\"e:f\"/></a:b></r>";
        let (changed, notes) = relaxed(text).unwrap();
        assert_eq!(changed.len(), text.len());
        assert!(changed.contains("<a.b c.d=\"e:f\"/></a.b>"), "{changed}");
        assert!(!changed.contains("<?") && !changed.contains("é"));
        assert_eq!(notes.len(), 5);
    }

    #[test]
    fn declared_prefixes_and_those_of_xacro_stay() {
        assert!(
            relaxed("<?xml version='1.0'?><!-- - --><r xmlns:a='u'><a:b/><xacro:c/></r>").is_none()
        );
        assert!(relaxed("<r").is_none() && relaxed("").is_none() && relaxed("<!--").is_none());
    }
}
