//! Files in a log.

use std::borrow::Cow;
use std::path::Path;

/// A file; its times are zero, since a log knows of no clock.
pub fn attachment<'a>(name: &str, media_type: &str, data: &'a [u8]) -> mcap::Attachment<'a> {
    mcap::Attachment {
        log_time: 0,
        create_time: 0,
        name: name.to_owned(),
        media_type: media_type.to_owned(),
        data: Cow::Borrowed(data),
    }
}

/// What is in a file, by the ending of its name.
pub fn media_type(name: &str) -> &'static str {
    let ending = Path::new(name).extension();
    match ending.and_then(|ending| ending.to_str()) {
        Some("urdf" | "xml") => "application/xml",
        Some("json") => "application/json",
        _ => "application/octet-stream",
    }
}
