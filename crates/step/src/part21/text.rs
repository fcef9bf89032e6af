//! Strings of ISO 10303-21 as people read them.

/// Decodes what stands between the quotes of a string: `''`, `\\`, `\S\c`, `\P?\`, `\X\hh`, `\X2\hhhh…\X0\`,
/// `\X4\hhhhhhhh…\X0\`. Other bytes are UTF-8 where the whole is, and ISO 8859-1 elsewhere. Line breaks, which writers put into
/// long strings, are dropped. An escape that is none stays as it is written: strings are names, and no name is refused.
pub(super) fn decoded(raw: &[u8]) -> String {
    let characters: Vec<char> = match std::str::from_utf8(raw) {
        Ok(text) => text.chars().collect(),
        Err(_) => raw.iter().copied().map(char::from).collect(),
    };
    let mut rest = characters.as_slice();
    let mut out = String::with_capacity(raw.len());
    while let Some((&first, behind)) = rest.split_first() {
        rest = match first {
            '\'' => {
                out.push('\'');
                behind.strip_prefix(&['\'']).unwrap_or(behind)
            }
            '\r' | '\n' => behind,
            '\\' => escape(behind, &mut out).unwrap_or_else(|| {
                out.push('\\');
                behind
            }),
            _ => {
                out.push(first);
                behind
            }
        };
    }
    out
}

/// Decodes the escape whose backslash has been read: what is left behind it, or `None` where it is none.
fn escape<'c>(rest: &'c [char], out: &mut String) -> Option<&'c [char]> {
    match rest {
        ['\\', behind @ ..] => {
            out.push('\\');
            Some(behind)
        }
        ['S', '\\', shifted, behind @ ..] => {
            // The upper half of a code page; pages other than ISO 8859-1 are not told apart.
            out.push(char::from_u32(u32::from(*shifted) + 128)?);
            Some(behind)
        }
        ['P', 'A'..='I', '\\', behind @ ..] => Some(behind),
        ['N' | 'F', '\\', behind @ ..] => Some(behind),
        ['X', '\\', behind @ ..] => {
            let (code, behind) = hexadecimal(behind, 2)?;
            out.push(char::from_u32(code)?);
            Some(behind)
        }
        ['X', '2', '\\', behind @ ..] => wide(behind, 4, out),
        ['X', '4', '\\', behind @ ..] => wide(behind, 8, out),
        _ => None,
    }
}

/// Characters of `digits` hexadecimal digits each, up to `\X0\`.
fn wide<'c>(mut rest: &'c [char], digits: usize, out: &mut String) -> Option<&'c [char]> {
    let mut codes = Vec::new();
    loop {
        if let ['\\', 'X', '0', '\\', behind @ ..] = rest {
            push_codes(&codes, digits, out);
            return Some(behind);
        }
        let (code, behind) = hexadecimal(rest, digits)?;
        codes.push(code);
        rest = behind;
    }
}

/// Characters by their codes; of four digits each they may be pairs of UTF-16.
fn push_codes(codes: &[u32], digits: usize, out: &mut String) {
    if digits == 4 {
        let units = codes.iter().map(|&code| code as u16);
        out.extend(char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)));
    } else {
        let character = |code: &u32| char::from_u32(*code).unwrap_or(char::REPLACEMENT_CHARACTER);
        out.extend(codes.iter().map(character));
    }
}

/// A number of so many hexadecimal digits, and what stands behind it.
fn hexadecimal(rest: &[char], digits: usize) -> Option<(u32, &[char])> {
    let (number, behind) = rest.split_at_checked(digits)?;
    let code = number
        .iter()
        .try_fold(0_u32, |code, c| Some(code * 16 + c.to_digit(16)?))?;
    Some((code, behind))
}

#[cfg(test)]
mod tests {
    use super::decoded;

    #[test]
    fn escapes_are_characters() {
        for (raw, text) in [
            ("it''s", "it's"),
            (r"a\\b", r"a\b"),
            (r"\X2\00DC\X0\ber", "Über"),
            (r"\X2\D83DDE00\X0\", "😀"),
            (r"\X4\0001F600\X0\", "😀"),
            (r"\X\E4", "ä"),
            (r"\S\d", "ä"),
            (r"\PA\x", "x"),
            ("a\r\nb", "ab"),
            // No escapes: as written.
            (r"C:\parts", r"C:\parts"),
            (r"\X2\00DC", r"\X2\00DC"),
            (r"\X4\FFFFFFFF\X0\", "\u{fffd}"),
        ] {
            assert_eq!(decoded(raw.as_bytes()), text, "{raw}");
        }
        assert_eq!(decoded(b"\xe4"), "ä");
    }
}
