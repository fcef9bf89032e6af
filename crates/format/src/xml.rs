//! From text to a tree of elements: the parser's errors in our words.

use super::error::{Fault, Outcome, floor_boundary};
use super::guard;
use super::words::quoted;
use roxmltree::{Document, Error, ParsingOptions, TextPos};
use std::ops::Range;

/// Bytes of text for a node, which bounds the memory of a parsed text: elements that a mechanism has take some forty with the blanks
/// between them, so that whatever may be read has fewer nodes.
const BYTES_PER_NODE: u64 = 16;

/// The name of the root element, before anything is parsed; empty where the text does not start like XML.
pub(super) fn root_name(text: &str) -> &str {
    let mut rest = text.trim_start_matches('\u{feff}');
    loop {
        rest = rest.trim_start();
        let end = match rest {
            _ if rest.starts_with("<!--") => "-->",
            _ if rest.starts_with("<?") => "?>",
            _ => break,
        };
        let Some((_, after)) = rest.split_once(end) else {
            return "";
        };
        rest = after;
    }
    let name = rest.strip_prefix('<').unwrap_or_default();
    let ends = |c: char| c.is_whitespace() || matches!(c, '/' | '>');
    name.split(ends).next().unwrap_or_default()
}

/// Parses a text that is safe to parse.
pub(super) fn parse(text: &str) -> Outcome<Document<'_>> {
    if let Some(fault) = guard::size_fault(text.len() as u64) {
        return Err(fault);
    }
    if text.trim_start_matches('\u{feff}').trim().is_empty() {
        return Err(
            Fault::new(0..0, "the file is empty; needed a <robot> element")
                .help("a mechanism file starts with <robot name=\"...\">"),
        );
    }
    let unclosed = guard::check_structure(text)?;
    let options = ParsingOptions {
        allow_dtd: false,
        nodes_limit: u32::try_from(guard::most_bytes() / BYTES_PER_NODE).unwrap_or(u32::MAX),
        ..ParsingOptions::default()
    };
    Document::parse_with_options(text, options).map_err(|error| fault(text, &error, unclosed))
}

/// The parser's error in our words, with its place.
fn fault(text: &str, error: &Error, unclosed: Option<Range<usize>>) -> Fault {
    let at = |position: TextPos| {
        let start = offset_of(text, position);
        let length = text[start..].chars().next().map_or(0, char::len_utf8);
        start..start + length
    };
    let end = text.len()..text.len();
    let position = at(error.pos());
    match error {
        Error::UnexpectedCloseTag(open, close, _) => {
            Fault::new(position, format!("needed </{open}>, found </{close}>"))
                .help("every element is closed by </name>, or by /> if nothing is inside")
        }
        Error::UnclosedRootNode | Error::UnexpectedEndOfStream => match unclosed {
            Some(tag) => {
                let name = text.get(tag.start + 1..tag.end).unwrap_or_default();
                Fault::new(tag, format!("element <{name}> is never closed"))
                    .help(format!("add </{name}>, or end the tag with />"))
            }
            None => Fault::new(end, "the file ends in the middle of something")
                .help("is a closing tag, a quote or the end of a comment missing?"),
        },
        Error::NoRootNode => Fault::new(end, "there is no element; needed <robot name=\"...\">"),
        Error::UnknownNamespace(prefix, _) => {
            let fault = Fault::new(
                position,
                format!("the prefix {} is not declared", quoted(prefix)),
            );
            if prefix == "xacro" {
                fault.help("write <robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\" ...>")
            } else {
                fault.help(format!("write <robot xmlns:{prefix}=\"...\" ...>"))
            }
        }
        Error::DuplicatedAttribute(name, _) => Fault::new(
            position,
            format!("attribute {} stands twice in one element", quoted(name)),
        )
        .help("remove one of the two"),
        Error::DuplicatedNamespace(name, _) => Fault::new(
            position,
            format!(
                "the prefix {} is declared twice in one element",
                quoted(name)
            ),
        ),
        Error::UnknownEntityReference(name, _) => {
            Fault::new(position, format!("the entity `&{name};` is not known"))
                .help("known are &lt; &gt; &amp; &quot; &apos; and characters by number, &#176;")
        }
        Error::MalformedEntityReference(_) => {
            Fault::new(position, "found `&` that starts no entity")
                .help("write &amp; for the character &")
        }
        Error::InvalidAttributeValue(_) | Error::InvalidChar(b'"' | b'\'', b'<', _) => {
            Fault::new(position, "found `<` inside an attribute's value")
                .help("is a quote missing? the character < is written &lt;")
        }
        Error::UnexpectedDeclaration(_) => Fault::new(
            position,
            "the declaration <?xml ...?> stands only at the very start of a file",
        )
        .help("remove what stands before it"),
        Error::NodesLimitReached
        | Error::AttributesLimitReached
        | Error::NamespacesLimitReached => Fault::new(
            0..0,
            "the file has more elements than fit the memory for reading it",
        )
        .help("`--memory` allows more"),
        Error::DtdDetected => Fault::new(position, "a document type definition is not accepted"),
        Error::InvalidComment(_) => Fault::new(position, "found `--` inside a comment")
            .help("a comment ends at the first --, and that must be -->"),
        Error::NonXmlChar(character, _) => Fault::new(
            position,
            format!(
                "found the control character U+{:04X}, which a file must not contain",
                u32::from(*character)
            ),
        ),
        Error::InvalidChar(needed, found, _) => Fault::new(
            position,
            format!("needed `{}`, found {}", char::from(*needed), byte(*found)),
        ),
        Error::InvalidChar2(needed, found, _) => {
            Fault::new(position, format!("needed {needed}, found {}", byte(*found)))
        }
        Error::InvalidString(needed, _) => Fault::new(position, format!("needed `{needed}`")),
        Error::InvalidName(_) => Fault::new(position, "needed the name of an element or attribute")
            .help("names start with a letter; the character < in a text is written &lt;"),
        Error::InvalidCharacterData(_) => {
            Fault::new(position, "found `]]>` in a text").help("write ]]&gt;")
        }
        Error::UnknownToken(_) => Fault::new(
            position,
            "needed an element, a comment or the end of the file",
        )
        .help("all elements stand inside the one <robot> element"),
        Error::InvalidXmlPrefixUri(_)
        | Error::UnexpectedXmlUri(_)
        | Error::UnexpectedXmlnsUri(_)
        | Error::InvalidElementNamePrefix(_) => Fault::new(
            position,
            "the prefixes `xml` and `xmlns` and their addresses are reserved",
        ),
        // What remains occurs inside document type definitions only, which are refused before.
        other => Fault::new(
            position,
            format!("the file is not well-formed XML: {other}"),
        ),
    }
}

/// A byte that a parser stumbled over; bytes of longer characters are not shown as if they were letters.
fn byte(byte: u8) -> String {
    if byte.is_ascii_graphic() {
        format!("`{}`", char::from(byte))
    } else if byte == b' ' || byte.is_ascii_control() {
        "white space".to_owned()
    } else {
        "a character that is not ASCII".to_owned()
    }
}

/// Byte offset of the parser's line and column, both from 1, columns in characters.
fn offset_of(text: &str, position: TextPos) -> usize {
    let mut start = 0;
    for _ in 1..position.row {
        match text[start..].find('\n') {
            Some(end) => start += end + 1,
            None => break,
        }
    }
    let column = (position.col as usize).saturating_sub(1);
    let line = &text[start..];
    let within = line.char_indices().nth(column).map_or(line.len(), |c| c.0);
    floor_boundary(text, start + within)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn the_place_of_a_parser_error_is_a_byte_range() {
        let fault = parse("<robot>\n <é a='1' a='2'/>\n</robot>").unwrap_err();
        assert_eq!(fault.range, 19..20);
        let fault = parse("<robot>\n<link>\n</robot>").unwrap_err();
        assert!(fault.message.contains("needed </link>, found </robot>"));
    }

    #[test]
    fn an_unclosed_element_is_named_where_it_starts() {
        for text in ["<robot>\n <link>", "<robot>\n <link> text"] {
            let fault = parse(text).unwrap_err();
            assert_eq!(fault.range, 9..14);
            assert!(fault.message.contains("<link> is never closed"));
        }
    }

    #[test]
    fn empty_files_are_told_so() {
        for text in ["", " \n", "\u{feff}"] {
            assert!(parse(text).unwrap_err().message.contains("empty"));
        }
        assert!(parse("<!-- only a comment -->").is_err());
    }
}
