//! Writes what reports found into the `expected.json` of each folder.

use super::known::{EXPECTED, folder};
use crate::cli::failure::Failure;
use crate::cli::files::cannot_read;
use crate::cli::output;
use kutzbach::report::Report;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Fields of an entry that is new.
const NEW: [&str; 5] = ["finite", "instantaneous", "kutzbach", "redundant", "pose"];

/// Updates the entries of these files. A field that a report leaves open stays as it is.
///
/// # Errors
/// Where a file cannot be read or written.
pub fn write(found: &[(&Path, Box<Report>)]) -> Result<(), Failure> {
    let mut folders: BTreeMap<PathBuf, Vec<(&str, &Report)>> = BTreeMap::new();
    for (file, report) in found {
        if let Some(stem) = file.file_stem().and_then(|stem| stem.to_str()) {
            folders
                .entry(folder(file))
                .or_default()
                .push((stem, report));
        }
    }
    for (folder, reports) in folders {
        let path = folder.join(EXPECTED);
        let known = match path.exists() {
            true => std::fs::read_to_string(&path).map_err(|error| cannot_read(&path, &error))?,
            false => String::new(),
        };
        // It has been read before, so that it is an object.
        let mut entries: Map<String, Value> = serde_json::from_str(&known).unwrap_or_default();
        for (stem, report) in reports {
            let entry = entries.entry(stem).or_insert_with(|| {
                let new = NEW.map(|field| (field.to_owned(), Value::Null));
                Value::Object(new.into_iter().collect())
            });
            if let Value::Object(fields) = entry {
                update(fields, report);
            }
        }
        std::fs::write(&path, output::json(&entries)?).map_err(|error| Failure::Plain {
            message: format!("{} cannot be written: {error}", path.display()),
            help: None,
        })?;
    }
    Ok(())
}

/// Gives the fields that an entry has the values found.
fn update(fields: &mut Map<String, Value>, report: &Report) {
    let branches = report.branches.as_ref();
    let found = [
        ("finite", json!(report.mobility.finite)),
        ("instantaneous", json!(report.home.instantaneous)),
        ("redundant", json!(report.home.redundant)),
        ("kutzbach", json!(report.kutzbach)),
        ("pose", json!(report.home.pose.map(|pose| pose.word()))),
        ("kind", json!(report.home.kind.map(|kind| kind.word()))),
        ("branches", json!(branches.map(Vec::len))),
        (
            "branch_dimensions",
            json!(branches.map(|all| all.iter().map(|b| b.dimension).collect::<Vec<_>>())),
        ),
    ];
    for (field, value) in found {
        if let Some(known) = fields.get_mut(field).filter(|_| !value.is_null()) {
            *known = value;
        }
    }
}
