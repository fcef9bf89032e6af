//! Mechanism files: URDF with loops, read strictly and written back.
//!
//! A file is one XML element `<robot>` of links and joints, as in URDF; the loops and couplings of URDF+ (Chignoli,
//! Slotine, Wensing and Kim 2024, arXiv 2411.19753); and what neither has but a mechanism needs: every kind of joint of
//! [`JointKind`](crate::mechanism::JointKind), exact numbers as expressions over named ones, poses, a scene, an expectation.
//!
//! What a reading must satisfy:
//!
//! - *Nothing is lost in silence.* An element, attribute or word that is not known is an error. What is known and says
//!   nothing about motion (pictures, controllers, other tools' elements) is skipped and listed in [`Reading::skipped`].
//! - *Every error has a place*: file, line, column and byte range, what was needed and what was found, and how to mend it.
//!   Faults in different elements are told together.
//! - *No text harms the reader*: size, nesting, attributes and nodes are bounded before they are parsed, document type
//!   definitions are refused, numbers bound themselves. Any bytes give a mechanism or an error.
//! - *Numbers stay as they are written.* Decimals keep their digits and expressions their exact value, so [`write()`] and
//!   [`read`] are inverse in meaning.
//!
//! Reading is linear in the text, apart from look-ups of names. Errors cost one more walk over the text for lines and columns.
//!
//! ```
//! let text = r#"
//! <robot name="slider">
//!   <link name="rail"/> <link name="block"/>
//!   <joint name="slide" type="prismatic">
//!     <parent link="rail"/> <child link="block"/> <axis xyz="0 0 1"/>
//!   </joint>
//! </robot>"#;
//! let reading = kutzbach::format::read(text, "slider.urdf", &[])?;
//! assert_eq!(reading.mechanism.freedom(), 1);
//! assert_eq!(reading.format, "urdf");
//!
//! let error = kutzbach::format::read(&text.replace("prismatic", "prismtic"), "slider.urdf", &[]).unwrap_err();
//! assert_eq!(error.to_string(), "slider.urdf:4:29: there is no joint type `prismtic`");
//! assert_eq!(error.help.as_deref(), Some("did you mean `prismatic`?"));
//! # Ok::<(), kutzbach::format::FormatError>(())
//! ```

mod beside;
mod definitions;
mod element;
mod error;
mod guard;
mod joint;
mod link;
mod names;
mod number_text;
mod reader;
mod values;
mod words;
mod writer;
mod xml;

pub use error::FormatError;
pub use writer::write;

use crate::mechanism::Mechanism;
use error::{Fault, located};
use std::fs::File;
use std::io::Read as _;
use std::path::Path;

/// A mechanism and what its file says beyond it.
#[derive(Clone, Debug)]
pub struct Reading {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// What is read differently from how it may have been meant, in file order.
    pub warnings: Vec<Warning>,
    /// What is not read because it says nothing about motion, in file order.
    pub skipped: Vec<Skipped>,
    /// The smallest dialect that the file belongs to: `urdf`, `urdf+` or `kutzbach-urdf`.
    pub format: &'static str,
}

/// Something that is read differently from how it may have been meant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// Line, counted from 1.
    pub line: usize,
    /// Column in characters, counted from 1.
    pub column: usize,
    /// What is done, and why.
    pub message: String,
}

/// An element or attribute that is not read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Skipped {
    /// Line, counted from 1.
    pub line: usize,
    /// Column in characters, counted from 1.
    pub column: usize,
    /// The element, such as `<gazebo>`, with a reason where it is not the usual one.
    pub what: String,
}

/// Reads a text.
///
/// `file` names the text in errors. Each of `settings` is a name and a number or expression (`pi/4`) that replaces the
/// value of `<xacro:property>` and the default of `<xacro:arg>` of that name; of two settings with one name the later holds.
///
/// # Errors
/// Up to twenty faults of the text, the first one foremost; a setting whose name the text does not define.
pub fn read(text: &str, file: &str, settings: &[(String, String)]) -> Result<Reading, FormatError> {
    reader::read(text, settings, &[]).map_err(|faults| located(file, text, faults))
}

/// How to read a text beyond what it says.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ReadOptions {
    /// Names and numbers or expressions that replace their values, as for [`read`].
    pub settings: Vec<(String, String)>,
    /// Names of properties and arguments that stay symbolic: numbers computed from them remember how
    /// ([`Number::parameter`](crate::number::Number::parameter)).
    pub symbolic: Vec<String>,
}

/// Reads a text, with some of its properties left symbolic.
///
/// # Errors
/// As [`read`]; also a symbolic name that the text does not define, with the names that it does.
pub fn read_with(text: &str, file: &str, options: &ReadOptions) -> Result<Reading, FormatError> {
    reader::read(text, &options.settings, &options.symbolic)
        .map_err(|faults| located(file, text, faults))
}

/// Reads bytes, which must be UTF-8; a byte order mark is allowed. Otherwise as [`read`].
///
/// # Errors
/// As [`read`]; also the place of the first byte that is not UTF-8.
pub fn read_bytes(
    bytes: &[u8],
    file: &str,
    settings: &[(String, String)],
) -> Result<Reading, FormatError> {
    bytes_with(bytes, file, |text| read(text, file, settings))
}

fn bytes_with(
    bytes: &[u8],
    file: &str,
    read: impl FnOnce(&str) -> Result<Reading, FormatError>,
) -> Result<Reading, FormatError> {
    if let Some(fault) = guard::size_fault(bytes.len() as u64) {
        return Err(located(file, "", vec![fault]));
    }
    match guard::text_of(bytes) {
        Ok(text) => read(text),
        Err((valid, fault)) => {
            let span = fault.range.clone();
            let error = located(file, valid, vec![fault]);
            // The faulty byte lies behind the text that is valid.
            Err(FormatError { span, ..error })
        }
    }
}

/// Reads a file. Otherwise as [`read`].
///
/// # Errors
/// As [`read_bytes`]; a file that cannot be read, or has more than 64 MiB, is an error at its start.
pub fn read_file(
    path: impl AsRef<Path>,
    settings: &[(String, String)],
) -> Result<Reading, FormatError> {
    let path = path.as_ref();
    let file = path.display().to_string();
    let bytes = bytes_of(path).map_err(|fault| located(&file, "", vec![fault]))?;
    read_bytes(&bytes, &file, settings)
}

/// Reads a file, with some of its properties left symbolic.
///
/// # Errors
/// As [`read_file`] and [`read_with`].
pub fn read_file_with(
    path: impl AsRef<Path>,
    options: &ReadOptions,
) -> Result<Reading, FormatError> {
    let path = path.as_ref();
    let file = path.display().to_string();
    let bytes = bytes_of(path).map_err(|fault| located(&file, "", vec![fault]))?;
    bytes_with(&bytes, &file, |text| read_with(text, &file, options))
}

/// The bytes of a file; of one that is too large, or endless like a device, no more than the limit.
fn bytes_of(path: &Path) -> Result<Vec<u8>, Fault> {
    let failed = |error: std::io::Error| Fault::new(0..0, format!("cannot be read: {error}"));
    let opened = File::open(path).map_err(failed)?;
    let metadata = opened.metadata().map_err(failed)?;
    if metadata.is_dir() {
        return Err(Fault::new(0..0, "is a directory, not a file"));
    }
    if let Some(fault) = guard::size_fault(metadata.len()) {
        return Err(fault);
    }
    let mut bytes = Vec::new();
    opened
        .take(guard::MOST_BYTES as u64 + 1)
        .read_to_end(&mut bytes)
        .map_err(failed)?;
    match guard::size_fault(bytes.len() as u64) {
        Some(fault) => Err(fault),
        None => Ok(bytes),
    }
}
