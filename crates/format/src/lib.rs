//! Mechanism files: URDF with loops, read and written back.
//!
//! A file is one XML element `<robot>` of links and joints, as in URDF; the loops and couplings of URDF+ (Chignoli,
//! Slotine, Wensing and Kim 2024, arXiv 2411.19753); and what neither has but a mechanism needs: every kind of joint of
//! [`JointKind`](kutzbach_model::mechanism::JointKind), exact numbers as expressions over named ones, poses, a scene, an expectation.
//!
//! What a reading must satisfy:
//!
//! - *Nothing is lost in silence.* What bears on motion and is not known, or is nearly a known word, is an error, and so is
//!   whatever looks like a joint and is not read. What cannot change the motion (pictures, controllers, other tools'
//!   elements) is skipped and counted in [`Reading::skipped`].
//! - *Every error has a place*: file, line, column and byte range, what was needed and what was found, and how to mend it.
//!   Faults in different elements are told together.
//! - *No text harms the reader*: size, nesting, attributes and nodes are bounded before they are parsed, document type
//!   definitions are refused, numbers bound themselves. Any bytes give a mechanism or an error.
//! - *Numbers stay as they are written.* Decimals keep their digits and expressions their exact value, so [`write()`] and
//!   [`read`] are inverse in meaning. A decimal that is π/2 or 0 within its own digits is read as that
//!   ([`Recognised`](kutzbach_model::mechanism::Recognised)), and written as it was.
//!
//! Reading is linear in the text, apart from look-ups of names. Errors cost one more walk over the text for lines and columns.
//!
//! ```
//! # mod kutzbach { pub use kutzbach_format as format; }
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

mod actuation;
mod assumed;
mod axis_limits;
mod beside;
mod cad;
mod closures;
mod content;
mod definitions;
mod detachable;
mod drake;
mod element;
mod error;
mod frames;
#[cfg(feature = "urdf-rs")]
mod from_urdf_rs;
mod gazebo;
mod gazebo_links;
mod gepetto;
mod guard;
mod hints;
mod joint;
mod kept;
mod limits;
mod link;
mod loop_joint;
mod memory;
mod mentions;
mod mimic;
mod mjcf;
mod mujoco;
mod names;
mod number_text;
mod property_names;
mod quaternion;
mod reader;
mod relax;
mod restated;
mod sdf;
mod skeleton;
mod sketch;
mod step;
mod template;
mod unread;
mod values;
mod words;
mod world;
mod writer;
mod xacro;
mod xml;

pub use error::FormatError;
#[cfg(feature = "urdf-rs")]
pub use from_urdf_rs::urdf_text;
pub use kept::Kept;
pub use memory::{MEMORY, largest_file, within_memory};
pub use property_names::property_names;
pub use sketch::{is_sketch, read_sketch, read_sketch_file};
pub use step::{
    ContactRow, ContactSeen, ContactTable, Corrections, PairCorrection, PairRule, Reason,
    contact_table,
};
pub use template::Template;
pub use writer::{Numbers, WriteOptions, escaped, write, write_with};

use content::Content;
use error::{Fault, located};
use kutzbach_model::mechanism::Mechanism;
use reader::Added;
use roxmltree::Document;
use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};
use xacro::Source;

/// A mechanism and what its file says beyond it.
#[derive(Clone, Debug)]
pub struct Reading {
    /// The mechanism.
    pub mechanism: Mechanism,
    /// What is read differently from how it may have been meant, in file order.
    pub warnings: Vec<Warning>,
    /// What is not read because it says nothing about motion, in file order.
    pub skipped: Vec<Skipped>,
    /// The smallest dialect that the file belongs to: `urdf`, `urdf+` or `kutzbach-urdf`; `xacro` for one that was expanded;
    /// `mjcf`, `sdf`, `asmt`, `freecad`, `step`; `gepetto` for a URDF with loops in YAML beside it.
    pub format: &'static str,
    /// What is kept of the rest for writing it back.
    pub kept: Kept,
    /// Line and column of `<expect>`, counted from 1.
    pub expect_at: Option<(usize, usize)>,
}

/// Something that is read differently from how it may have been meant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// Line, counted from 1.
    pub line: usize,
    /// Column in characters, counted from 1.
    pub column: usize,
    /// What it is about.
    pub kind: WarningKind,
    /// What is done, and why.
    pub message: String,
    /// How often the file gives cause for it; the place is that of the first time.
    pub count: usize,
}

/// What a warning is about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum WarningKind {
    /// Something was taken for granted that the file does not say.
    Guessed,
    /// Something is not read that names two joints or links: the answer may be about another mechanism than the one meant.
    MayJoin,
    /// Something that has no meaning where it stands, and is ignored.
    Meaningless {
        /// The element or attribute.
        what: String,
        /// What it has no meaning for.
        of: String,
    },
    /// An element with a name that it had once.
    OldName {
        /// The name.
        old: String,
        /// Today's.
        new: String,
    },
    /// What other readers do not heed, or read in another way.
    ReadersDiffer {
        /// The element or attribute.
        what: String,
    },
    /// A limit that is none: of a joint that turns without end, or with the lower one above the upper one.
    NoLimit,
    /// A joint that closes a loop by giving a link a second place.
    ClosesLoop {
        /// The joint.
        joint: String,
        /// The link.
        link: String,
        /// The joint that places the link.
        other: String,
    },
    /// Something of another program that is read as an element of this format.
    ReadAs {
        /// The joint that it is about.
        joint: String,
        /// The element.
        element: String,
    },
    /// A joint that says what is said elsewhere: in the tree and inside `<gazebo>`, or that the root is held.
    SaidTwice {
        /// The joint.
        joint: String,
    },
    /// Two joints between the same two links, in different places of the file.
    SameLinks {
        /// The joint.
        joint: String,
        /// The one before it.
        other: String,
    },
    /// A joint that has the name of another one and is called otherwise here.
    Renamed {
        /// Its name in the file.
        joint: String,
        /// Its name here.
        called: String,
    },
    /// Joints inside `<gazebo>` are read, without which the file is another mechanism.
    InGazebo {
        /// How many.
        joints: usize,
    },
    /// An element that looks like a call of a macro and is none, or calls one that nobody defines: it is not read.
    NotCalled {
        /// The element.
        element: String,
    },
    /// What XML does not allow is read all the same.
    NotXml,
    /// What the file itself has to say.
    Said,
}

impl WarningKind {
    /// Whether the warning belongs before everything else.
    #[must_use]
    pub fn is_told_first(&self) -> bool {
        matches!(self, Self::Guessed | Self::MayJoin)
    }
}

/// A kind of element or attribute that is not read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Skipped {
    /// Line, counted from 1.
    pub line: usize,
    /// Column in characters, counted from 1.
    pub column: usize,
    /// The element, such as `<gazebo>`, with a reason where it is not the usual one.
    pub what: String,
    /// How many there are; the place is that of the first one.
    pub count: usize,
    /// Whether any URDF may have it, as a `<material>`. What is not is an error where a reading is to be strict.
    pub standard: bool,
}

/// Reads a text.
///
/// `file` names the text in errors. Each of `settings` is a name and a number or expression (`pi/4`) that replaces the
/// value of `<xacro:property>` and the default of `<xacro:arg>` of that name; of two settings with one name the later holds.
///
/// # Errors
/// Up to twenty faults of the text, the first one foremost; a setting whose name the text does not define.
pub fn read(text: &str, file: &str, settings: &[(String, String)]) -> Result<Reading, FormatError> {
    let options = ReadOptions {
        settings: settings.to_vec(),
        ..ReadOptions::default()
    };
    read_with(text, file, &options)
}

/// How to read a text beyond what it says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReadOptions {
    /// Names and numbers or expressions that replace their values, as for [`read`].
    pub settings: Vec<(String, String)>,
    /// Names of properties and arguments that stay symbolic: numbers computed from them remember how
    /// ([`Number::parameter`](kutzbach_math::number::Number::parameter)).
    pub symbolic: Vec<String>,
    /// Whether what would be skipped is an error, unless any URDF may have it ([`Skipped::standard`]).
    pub strict: bool,
    /// Take decimals as they are written; otherwise `1.5707963267948966` is read as π/2, and so on
    /// ([`Mechanism::with_constants`]).
    pub literal: bool,
    /// How well the decimals of the geometry are known (m, rad), whatever their digits say; 0 means exactly.
    pub precision: Option<f64>,
    /// Names of ROS packages and the folders that they are in, for `$(find name)` and `package://name` in the files that
    /// xacro includes. Packages that are not named here are looked for in the environment and around the file.
    pub packages: Vec<(String, PathBuf)>,
    /// Whether the environment of the process is left alone: then neither `ROS_PACKAGE_PATH` and `AMENT_PREFIX_PATH` are looked
    /// into for packages, nor is any variable set for `$(env NAME)` and `$(optenv NAME default)`, so that a text means the same
    /// everywhere.
    pub without_environment: bool,
    /// What is known of the contacts of a STEP file beyond its shapes.
    pub contacts: Corrections,
    /// How much memory reading may fill (bytes), as for [`within_memory`]; that of the reading under way where it is not said.
    pub memory: Option<u64>,
}

impl ReadOptions {
    /// Reads within the memory that is allowed.
    fn within<T>(&self, read: impl FnOnce() -> T) -> T {
        within_memory(self.memory.unwrap_or_else(memory::limit), read)
    }

    /// A fault where a measure is named and the format has none.
    fn without_measures(&self, format: &str) -> Option<Fault> {
        let set = self.settings.iter().map(|(name, _)| name);
        let name = set.chain(&self.symbolic).next()?;
        let message = format!("{format} has no measure {}", words::quoted(name));
        Some(Fault::new(0..0, message).help("leave `--set` and `--symbolic` out"))
    }
}

/// Reads a text, with some of its properties left symbolic, or strictly.
///
/// # Errors
/// As [`read`]; also a symbolic name that the text does not define, with the names that it does; where the reading is to be
/// strict, what would be skipped.
pub fn read_with(text: &str, file: &str, options: &ReadOptions) -> Result<Reading, FormatError> {
    options.within(|| read_text(text, file, None, options))
}

/// Reads a text, which was read from the file `base` if that is known, after expanding what it says in xacro.
fn read_text(
    text: &str,
    file: &str,
    base: Option<&Path>,
    options: &ReadOptions,
) -> Result<Reading, FormatError> {
    let content = content::of(text);
    if content != Content::Step && options.contacts != Corrections::default() {
        let fault = Fault::new(0..0, "only STEP files have contacts to correct");
        let fault = fault.help("leave `--contacts` out, or read the STEP file");
        return Err(located(file, text, vec![fault]));
    }
    let reading = match content {
        Content::Robot => read_robot(text, file, base, options, &Added::default())?,
        Content::Gepetto => gepetto::read(text, file, base, options)?,
        content => read_foreign(content, text, file, base, options)?,
    };
    Ok(understood(reading, options))
}

/// Reads a text that needs no expansion, of which `document` was parsed if it is there, with warnings of what it calls and nobody
/// defines.
fn read_plain(
    text: &str,
    file: &str,
    options: &ReadOptions,
    warnings: Vec<Warning>,
    document: Option<&Document<'_>>,
    added: &Added,
) -> Result<Reading, FormatError> {
    let read = match document {
        Some(document) => reader::read_parsed(document, text, Vec::new(), options, None, added),
        None => reader::read(text, options, None, added),
    };
    let mut reading = read.map_err(|faults| located(file, text, faults))?;
    reading.warnings.extend(warnings);
    reading
        .warnings
        .sort_by_key(|warning| (warning.line, warning.column));
    Ok(reading)
}

/// A reading with its decimals understood as the options say.
fn understood(reading: Reading, options: &ReadOptions) -> Reading {
    Reading {
        mechanism: with_decimals_understood(reading.mechanism, options),
        ..reading
    }
}

fn with_decimals_understood(mut mechanism: Mechanism, options: &ReadOptions) -> Mechanism {
    if !options.literal {
        mechanism = mechanism.with_constants_known_to(options.precision);
    }
    if let Some(uncertainty) = options.precision {
        mechanism = mechanism.with_precision(uncertainty);
    }
    mechanism
}

/// Reads the text of a robot, after expanding what it says in xacro, with what another file adds to it.
fn read_robot(
    text: &str,
    file: &str,
    base: Option<&Path>,
    options: &ReadOptions,
    added: &Added,
) -> Result<Reading, FormatError> {
    match xacro::expand(text, file, base, options)? {
        Source::Plain(warnings, document) => {
            read_plain(text, file, options, warnings, document.as_deref(), added)
        }
        Source::Expanded(expanded) => {
            // The expansion has used the settings up.
            let left = ReadOptions {
                settings: Vec::new(),
                symbolic: Vec::new(),
                ..options.clone()
            };
            reader::read(&expanded.text, &left, Some(&expanded.numbers), added)
                .map(|reading| expanded.placed(reading))
                .map_err(|faults| expanded.map.located(faults))
        }
    }
}

/// Reads a text of another program's format.
fn read_foreign(
    content: Content,
    text: &str,
    file: &str,
    base: Option<&Path>,
    options: &ReadOptions,
) -> Result<Reading, FormatError> {
    let read = match content {
        Content::Sdf => sdf::read(text, options),
        Content::Asmt => cad::read_asmt(text, options),
        Content::FreeCad => cad::read_freecad(text, options),
        Content::Mjcf => {
            let whole = mjcf::whole(text, file, base)?;
            return mjcf::read(&whole, options).map_err(|faults| whole.located(faults));
        }
        Content::Step => return step::read(text.as_bytes(), file, options),
        Content::Robot | Content::Gepetto => reader::read(text, options, None, &Added::default()),
        Content::Other(what) => Err(vec![what.fault()]),
    };
    read.map_err(|faults| located(file, text, faults))
}

/// The plain URDF that a xacro file stands for, as ROS would expand it, with numbers as doubles. The text of a file
/// that needs no expansion is returned as it is.
///
/// # Errors
/// What cannot be expanded, and where; a file that cannot be read.
pub fn expanded_file(path: impl AsRef<Path>, options: &ReadOptions) -> Result<String, FormatError> {
    let path = path.as_ref();
    let file = path.display().to_string();
    let bytes = bytes_of(path).map_err(|fault| located(&file, "", vec![fault]))?;
    bytes_with(&bytes, &file, |text, file| {
        Ok(match xacro::expand(text, file, Some(path), options)? {
            Source::Plain(..) => text.to_owned(),
            Source::Expanded(expanded) => expanded.plain,
        })
    })
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
    let options = ReadOptions {
        settings: settings.to_vec(),
        ..ReadOptions::default()
    };
    read_bytes_of(bytes, file, None, &options)
}

fn bytes_with<T>(
    bytes: &[u8],
    file: &str,
    read: impl FnOnce(&str, &str) -> Result<T, FormatError>,
) -> Result<T, FormatError> {
    if let Some(fault) = guard::size_fault(bytes.len() as u64) {
        return Err(located(file, "", vec![fault]));
    }
    if content::is_zip(bytes) {
        let document = cad::document(bytes)
            .and_then(|found| found.ok_or_else(|| content::ARCHIVE.fault()))
            .map_err(|fault| located(file, "", vec![fault]))?;
        return read(&document, &format!("{file}/Document.xml"));
    }
    if let Some(other) = content::of_bytes(bytes) {
        return Err(located(file, "", vec![other.fault()]));
    }
    match guard::text_of(bytes) {
        Ok(text) => read(text, file),
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
/// As [`read_bytes`]; a file that cannot be read, or is too large for the memory ([`within_memory`]), is an error at its start.
pub fn read_file(
    path: impl AsRef<Path>,
    settings: &[(String, String)],
) -> Result<Reading, FormatError> {
    let options = ReadOptions {
        settings: settings.to_vec(),
        ..ReadOptions::default()
    };
    read_file_with(path, &options)
}

/// Reads a file, with some of its properties left symbolic, or strictly.
///
/// # Errors
/// As [`read_file`] and [`read_with`].
pub fn read_file_with(
    path: impl AsRef<Path>,
    options: &ReadOptions,
) -> Result<Reading, FormatError> {
    let path = path.as_ref();
    let bytes = options.within(|| file_bytes(path))?;
    read_bytes_of(&bytes, &path.display().to_string(), Some(path), options)
}

/// The bytes of a file, to be read several times with [`read_bytes_of`].
///
/// # Errors
/// A file that cannot be read, or is too large for the memory ([`within_memory`]).
pub fn file_bytes(path: impl AsRef<Path>) -> Result<Vec<u8>, FormatError> {
    let path = path.as_ref();
    let file = path.display().to_string();
    bytes_of(path).map_err(|fault| located(&file, "", vec![fault]))
}

/// Reads the bytes of a file that errors call `file`; what it includes is looked for beside `base`, its path, where that is known.
///
/// # Errors
/// As [`read_bytes`] and [`read_with`].
pub fn read_bytes_of(
    bytes: &[u8],
    file: &str,
    base: Option<&Path>,
    options: &ReadOptions,
) -> Result<Reading, FormatError> {
    options.within(|| read_bytes_within(bytes, file, base, options))
}

fn read_bytes_within(
    bytes: &[u8],
    file: &str,
    base: Option<&Path>,
    options: &ReadOptions,
) -> Result<Reading, FormatError> {
    // Names in STEP files may be in any encoding.
    if step::is_step(bytes) {
        if let Some(fault) = guard::size_fault(bytes.len() as u64) {
            return Err(located(file, "", vec![fault]));
        }
        return step::read(bytes, file, options).map(|reading| understood(reading, options));
    }
    bytes_with(bytes, file, |text, file| {
        read_text(text, file, base, options)
    })
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
        .take(guard::most_bytes().saturating_add(1))
        .read_to_end(&mut bytes)
        .map_err(failed)?;
    match guard::size_fault(bytes.len() as u64) {
        Some(fault) => Err(fault),
        None => Ok(bytes),
    }
}
