//! Mechanisms for tests.

use kutzbach_model::mechanism::Mechanism;
use std::path::Path;

/// One of our own mechanism files.
pub(crate) fn own(name: &str) -> Mechanism {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../mechanisms");
    read(&folder.join(name).with_extension("urdf"), &[])
}

pub(crate) fn read(path: &Path, settings: &[(String, String)]) -> Mechanism {
    match kutzbach_format::read_file(path, settings) {
        Ok(reading) => reading.mechanism,
        Err(error) => panic!("{error}"),
    }
}
