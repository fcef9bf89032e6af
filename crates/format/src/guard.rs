//! Checks before any parsing: size limits, and that the text is not built to exhaust a parser.
//!
//! One walk over the text, linear in its size. It knows just enough XML (comments, CDATA, processing instructions, quotes)
//! to count nesting and attributes. Where the text is malformed the walk stops without judging: the parser proper says what
//! is wrong there, and it never gets past that point either.

use super::error::{Fault, Outcome};
use super::memory;
use super::words::counted;
use std::ops::Range;

/// Larger files are refused before they are read: as many bytes as fit the memory, see [`within_memory`](crate::within_memory).
pub(super) fn most_bytes() -> u64 {
    memory::largest_file(memory::limit())
}

/// A mechanism file nests five levels deep, SDFormat ten; models inside models and foreign elements rarely twenty.
pub(super) const MOST_LEVELS: usize = 64;

/// In MJCF bodies stand inside bodies: a chain of so many, which nothing here follows by recursion.
pub(super) const MOST_BODIES_DEEP: usize = 4096;

/// The parser compares the attributes of an element pairwise; this bounds the work per element.
pub(super) const MOST_ATTRIBUTES: usize = 64;

/// Bytes as text, a message with the place of the first byte that is none otherwise.
pub(super) fn text_of(bytes: &[u8]) -> Result<&str, (&str, Fault)> {
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        let fault = Fault::new(0..0, "the file is UTF-16; needed UTF-8")
            .help("save it as UTF-8, or convert it with `iconv -f UTF-16 -t UTF-8`");
        return Err(("", fault));
    }
    std::str::from_utf8(bytes).map_err(|error| {
        let valid = bytes.get(..error.valid_up_to()).unwrap_or_default();
        let valid = std::str::from_utf8(valid).unwrap_or_default();
        let byte = bytes.get(valid.len()).copied().unwrap_or_default();
        let fault = Fault::new(
            valid.len()..valid.len() + 1,
            format!("needed UTF-8 text, found byte 0x{byte:02x}, which is none"),
        )
        .help("save the file as UTF-8");
        (valid, fault)
    })
}

/// The fault of a file of this size, if it is too large.
pub(super) fn size_fault(bytes: u64) -> Option<Fault> {
    let most = most_bytes();
    (bytes > most).then(|| {
        let limit = memory::limit() as f64 / 1e9;
        let needed = bytes.saturating_mul(memory::PER_BYTE).div_ceil(1_000_000_000);
        Fault::new(
            0..0,
            format!("the file has more than {most} bytes, the most that is read within {limit} GB of memory"),
        )
        .help(format!(
            "`--memory {needed}` allows as much as this takes; meshes belong in files of their own"
        ))
    })
}

/// Checks nesting and attribute counts and refuses document type definitions.
///
/// Returns the range of the innermost start tag that is never closed, for a better message than "unexpected end".
pub(super) fn check_structure(text: &str) -> Outcome<Option<Range<usize>>> {
    let bytes = text.as_bytes();
    let mut open: Vec<Range<usize>> = Vec::new();
    let mut at = 0;
    while let Some(start) = find_byte(bytes, at, b'<') {
        let rest = &bytes[start..];
        let end = if rest.starts_with(b"<!--") {
            find_text(text, start + 4, "-->")
        } else if rest.starts_with(b"<![CDATA[") {
            find_text(text, start + 9, "]]>")
        } else if rest.starts_with(b"<!DOCTYPE") {
            return Err(Fault::new(
                start..start + 9,
                "a document type definition is not accepted; it can define entities that expand without end",
            )
            .help("remove <!DOCTYPE ...>; numbers are named with <xacro:property>"));
        } else if rest.starts_with(b"<?") {
            find_text(text, start + 2, "?>")
        } else if rest.starts_with(b"</") {
            open.pop();
            find_byte(bytes, start, b'>').map(|end| end + 1)
        } else {
            let Some(tag) = scan_start_tag(bytes, start) else {
                break;
            };
            if tag.attributes > MOST_ATTRIBUTES {
                return Err(Fault::new(
                    start..tag.name_end,
                    format!(
                        "an element has {}; at most {MOST_ATTRIBUTES} are accepted",
                        counted(tag.attributes, "attribute")
                    ),
                ));
            }
            if !tag.empty {
                open.push(start..tag.name_end);
                let root = open.first().and_then(|root| text.get(root.clone()));
                let most = match root {
                    Some("<mujoco" | "<mujocoinclude") => MOST_BODIES_DEEP,
                    _ => MOST_LEVELS,
                };
                if open.len() > most {
                    return Err(Fault::new(
                        start..tag.name_end,
                        format!("elements are nested more than {most} levels deep"),
                    )
                    .help("is a closing tag missing? mechanism files nest some ten levels deep, bodies of MJCF aside"));
                }
            }
            Some(tag.end)
        };
        match end {
            Some(end) => at = end,
            None => break,
        }
    }
    Ok(open.pop())
}

struct StartTag {
    name_end: usize,
    end: usize,
    empty: bool,
    attributes: usize,
}

/// Walks over `<name a="b" ...>`; `None` where it is malformed.
fn scan_start_tag(bytes: &[u8], start: usize) -> Option<StartTag> {
    let mut at = start + 1;
    let ends_name = |b: &u8| b.is_ascii_whitespace() || matches!(b, b'/' | b'>' | b'<');
    let name_end = at + bytes.get(at..)?.iter().position(ends_name)?;
    let mut attributes = 0;
    at = name_end;
    loop {
        match *bytes.get(at)? {
            quote @ (b'"' | b'\'') => at = find_byte(bytes, at + 1, quote)?,
            b'=' => attributes += 1,
            b'<' => return None,
            b'>' => {
                return Some(StartTag {
                    name_end,
                    end: at + 1,
                    empty: bytes[at - 1] == b'/',
                    attributes,
                });
            }
            _ => {}
        }
        at += 1;
    }
}

fn find_byte(bytes: &[u8], from: usize, wanted: u8) -> Option<usize> {
    let position = bytes.get(from..)?.iter().position(|b| *b == wanted)?;
    Some(from + position)
}

/// The offset behind the next occurrence.
fn find_text(text: &str, from: usize, wanted: &str) -> Option<usize> {
    let position = text.get(from..)?.find(wanted)?;
    Some(from + position + wanted.len())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn depth_is_counted_outside_comments_quotes_and_cdata() {
        let quiet = format!(
            "<!--{0}--><?p {0}?><a b=\"{1}\"><![CDATA[{0}]]></a>",
            "<a>".repeat(100),
            ">".repeat(100)
        );
        assert!(check_structure(&quiet).unwrap().is_none());
        let fits = format!("{}{}", "<a>".repeat(64), "</a>".repeat(64));
        assert!(check_structure(&fits).unwrap().is_none());
        let deep = check_structure(&"<a>".repeat(65)).unwrap_err();
        assert_eq!(deep.range, 192..194);
        let flat = "<a/>".repeat(1000);
        assert!(check_structure(&flat).unwrap().is_none());
    }

    #[test]
    fn an_unclosed_tag_is_found() {
        assert_eq!(check_structure("<a><b><c/>").unwrap(), Some(3..5));
        assert_eq!(check_structure("<a><b").unwrap(), Some(0..2));
    }

    #[test]
    fn a_document_type_is_refused_only_as_markup() {
        assert!(check_structure("<!-- <!DOCTYPE a> --><a/>").is_ok());
        let fault = check_structure(" <!DOCTYPE a []><a/>").unwrap_err();
        assert_eq!(fault.range, 1..10);
    }

    #[test]
    fn many_attributes_are_refused() {
        let text = format!("<a {}/>", "b='=' ".repeat(65));
        assert!(check_structure(&text).is_err());
        let text = format!("<a {}/>", "b='==' ".repeat(64));
        assert!(check_structure(&text).is_ok());
    }

    #[test]
    fn bytes_that_are_no_text_are_named() {
        let (valid, fault) = text_of(b"ab\xffc").unwrap_err();
        assert_eq!((valid, fault.range), ("ab", 2..3));
        assert!(fault.message.contains("0xff"));
        assert!(
            text_of(&[0xff, 0xfe, b'<', 0])
                .unwrap_err()
                .1
                .message
                .contains("UTF-16")
        );
    }
}
