//! STEP assemblies: parts become links, and faces that touch become joints.
//!
//! `kutzbach_step` reads the file, finds the faces of different parts that touch, and intersects the displacements that the contacts of
//! one pair leave. Here the pairs become a mechanism:
//!
//! | file | what it knows |
//! |---|---|
//! | [`corrections`] | what a person says of pairs, and whether the parts exist |
//! | [`declared`] | what kinematic pairs of the file say |
//! | [`fasteners`] | which parts are tight by name and head |
//! | [`ground`] | which part is held |
//! | [`frame`] | the frame in which the assembly is written |
//! | [`gears`] | hinges that gears couple |
//! | [`geometry`] | the axis, direction or centre that a joint takes from its contacts |
//! | [`pairs`] | what each pair is taken as, and why |
//! | [`standing`] | positions and directions that agree where the geometry does |
//! | [`build`] | spanning tree, joints, and parts that float |
//! | [`told`] | what is told before anything else |
//! | [`table`] | the same for a person to correct |

mod build;
mod corrections;
mod declared;
mod fasteners;
mod frame;
mod gears;
mod geometry;
mod ground;
mod pairs;
mod standing;
mod table;
#[cfg(test)]
mod tests;
mod told;

pub use corrections::{Corrections, PairCorrection, PairRule};
pub use pairs::Reason;
pub use table::{ContactRow, ContactSeen, ContactTable};

use super::error::{Fault, FormatError, at_line, located};
use super::kept::Kept;
use super::{ReadOptions, Reading};
use ground::Why;
use kutzbach_step::{Assembly, ContactOptions, StepError, contacts};
use pairs::Judged;
use standing::Agreement;
use std::path::Path;
use told::Told;

/// Whether bytes are a STEP file: its first word, behind a byte order mark and blanks.
pub(super) fn is_step(bytes: &[u8]) -> bool {
    without_mark(bytes)
        .trim_ascii_start()
        .starts_with(b"ISO-10303-21")
}

/// The bytes behind a byte order mark.
fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

/// Reads a STEP file.
///
/// # Errors
/// The first thing that is wrong with it, at the line of its entity; corrections of parts that it does not have.
pub(super) fn read(
    bytes: &[u8],
    file: &str,
    options: &ReadOptions,
) -> Result<Reading, FormatError> {
    if let Some(fault) = options.without_measures("STEP") {
        return Err(located(file, "", vec![fault]));
    }
    let found = Found::new(bytes, file, &options.contacts)?;
    let stem = Path::new(file).file_stem();
    let name = stem.map_or_else(|| file.to_owned(), |s| s.to_string_lossy().into_owned());
    // Whoever states how well numbers are known speaks of decimals, not of exact ones.
    let may_be_exact = options.precision.is_none() && !options.literal;
    let Assembly {
        accuracy,
        printed,
        tilt,
        ..
    } = found.assembly;
    // Two coordinates differ by what both are off.
    let within = Agreement {
        printed,
        ..Agreement::of(accuracy.max(2.0 * printed), tilt)
    };
    let built = build::build(
        &name,
        &found.assembly,
        found.ground,
        &found.pairs,
        within,
        may_be_exact,
    )
    .map_err(|error| {
        let fault = Fault::new(0..0, error.to_string()).maybe_help(error.help);
        located(file, "", vec![fault])
    })?;
    let mut told = found.told();
    told.islands(&found.assembly, found.ground, &built.islands);
    told.uncoupled(&found.assembly, &built.uncoupled);
    Ok(Reading {
        mechanism: built.mechanism,
        warnings: told.finished(),
        skipped: Vec::new(),
        format: "step",
        kept: Kept::default(),
        expect_at: None,
    })
}

/// The pairs of parts of a STEP file that touch, and what each is taken as.
///
/// `file` names the bytes in errors. Pairs that the corrections name are listed as well.
///
/// # Errors
/// Bytes that are no STEP file; what is wrong with the file, at the line of its entity; corrections of parts that it does not have.
pub fn contact_table(
    bytes: &[u8],
    file: &str,
    corrections: &Corrections,
) -> Result<ContactTable, FormatError> {
    if !is_step(bytes) {
        let fault = Fault::new(
            0..0,
            "needed a STEP file, which begins with `ISO-10303-21`, found another format",
        );
        let fault = fault.help("other formats say their joints: `kutzbach report` reads them");
        return Err(located(file, "", vec![fault]));
    }
    let found = Found::new(bytes, file, corrections)?;
    let warnings = found.told().finished();
    Ok(table::of(&found, warnings))
}

/// An assembly with its pairs of parts judged.
struct Found {
    assembly: Assembly,
    ground: usize,
    why: Why,
    pairs: Vec<Judged>,
    /// The largest distance (m) between faces that touch.
    clearance: f64,
}

impl Found {
    fn new(bytes: &[u8], file: &str, corrections: &Corrections) -> Result<Self, FormatError> {
        let assembly =
            kutzbach_step::read(without_mark(bytes)).map_err(|error| placed(error, bytes, file))?;
        let wrong = |(message, help): corrections::Wrong| {
            let fault = Fault::new(0..0, message).maybe_help(help);
            located(file, "", vec![fault])
        };
        let resolved = corrections.resolved(&assembly).map_err(wrong)?;
        let mut options = ContactOptions::default();
        if let Some(clearance) = corrections.clearance {
            options.clearance = clearance;
        }
        let touching = contacts(&assembly, &options);
        let accuracy = options.accuracy.max(assembly.accuracy);
        let pairs = pairs::judged(&assembly, touching, &resolved, accuracy).map_err(wrong)?;
        let Some((ground, why)) = ground::choose(&assembly, resolved.ground) else {
            let fault = Fault::new(0..0, "needed parts with faces, found none");
            return Err(located(file, "", vec![fault]));
        };
        Ok(Self {
            assembly,
            ground,
            why,
            pairs,
            clearance: options.clearance,
        })
    }

    fn told(&self) -> Told {
        let mut told = Told::default();
        told.notes(&self.assembly.notes);
        told.ground(&self.assembly, self.ground, self.why);
        told.pairs(&self.assembly, &self.pairs);
        told
    }
}

/// An error of the reader, at the line of its entity.
fn placed(error: StepError, bytes: &[u8], file: &str) -> FormatError {
    let message = match error.entity {
        Some(number) => format!("#{number}: {}", error.problem),
        None => error.problem.to_string(),
    };
    at_line(file, bytes, error.line, &message, None)
}
