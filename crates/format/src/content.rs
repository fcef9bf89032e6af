//! Which format a text or a file is, by what it says: names of files say little.
//!
//! What is not read is named, with what to do instead.

use super::error::Fault;
use super::xml::root_name;
use super::{cad, gepetto, step, words::cut};

/// A format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Content {
    /// URDF, its extensions, and xacro; and whatever is no other format, for a message about `<robot>`.
    Robot,
    /// MuJoCo's.
    Mjcf,
    /// Gazebo's.
    Sdf,
    /// OndselSolver's.
    Asmt,
    /// A document of FreeCAD.
    FreeCad,
    /// A STEP file (ISO 10303-21).
    Step,
    /// YAML of Gepetto's, which says how the loops of a robot close.
    Gepetto,
    /// One that is known and not read.
    Other(Other),
}

/// A format that is not read, and what to do instead.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Other {
    name: &'static str,
    instead: &'static str,
}

impl Other {
    /// The message, at the start of the file.
    pub(super) fn fault(self) -> Fault {
        Fault::new(0..0, format!("this is {}, which is not read", self.name)).help(self.instead)
    }
}

const USD: Other = Other {
    name: "USD",
    instead: "export the articulation as MJCF or URDF; joints outside the articulation are its loops, and belong into <equality> or <loop>",
};
const SHAPES: Other = Other {
    name: "a file of shapes",
    instead: "shapes have no joints: read the URDF, MJCF or SDF that names this file",
};
const OPENSIM: Other = Other {
    name: "an OpenSim model",
    instead: "convert it to MJCF, for instance with `osim2mjcf` or `myoconverter`",
};
const COLLADA: Other = Other {
    name: "COLLADA",
    instead: "read the URDF, MJCF or SDF that names this file",
};
const YAML: Other = Other {
    name: "YAML or a list of settings",
    instead: "read the robot's URDF; YAML with `closed_loop: [[frame, frame], ...]` beside it is read too",
};
const JSON: Other = Other {
    name: "JSON",
    instead: "read the mechanism file that this was made from",
};
const MODELICA: Other = Other {
    name: "Modelica",
    instead: "write links and joints as URDF; see the chapter on the format",
};
const LOG: Other = Other {
    name: "an MCAP log",
    instead: "logs are looked at with Rerun or Foxglove; read the mechanism file that this was made from",
};

/// A zip file that is no document of FreeCAD.
pub(super) const ARCHIVE: Other = Other {
    name: "a zip file without a FreeCAD document",
    instead: "unpack it, and read the mechanism file inside; a package of USD is exported as MJCF or URDF",
};

/// Whether bytes are a zip file.
pub(super) fn is_zip(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"PK\x05\x06")
}

/// The format of bytes that are no text; `None` where they may be text, or a document of FreeCAD.
pub(super) fn of_bytes(bytes: &[u8]) -> Option<Other> {
    let starts: [(&[u8], Other); 4] = [
        (b"PXR-USDC", USD),
        (b"glTF", SHAPES),
        (b"Kaydara FBX", SHAPES),
        (b"\x89MCAP0", LOG),
    ];
    let found = starts.iter().find(|(start, _)| bytes.starts_with(start));
    found.map(|(_, other)| *other)
}

/// The format of a text.
pub(super) fn of(text: &str) -> Content {
    if step::is_step(text.as_bytes()) {
        return Content::Step;
    }
    match root_name(text) {
        "mujoco" | "mujocoinclude" => return Content::Mjcf,
        "sdf" => return Content::Sdf,
        "COLLADA" => return Content::Other(COLLADA),
        "OpenSimDocument" => return Content::Other(OPENSIM),
        "Document" if cad::is_document(text) => return Content::FreeCad,
        "" => {}
        _ => return Content::Robot,
    }
    if cad::is_asmt(text) {
        return Content::Asmt;
    }
    let start = text.trim_start_matches('\u{feff}').trim_start();
    let first = start.lines().next().unwrap_or_default().trim_end();
    let word = cut(first);
    let other = match first {
        _ if gepetto::is_description(text) => return Content::Gepetto,
        _ if first.starts_with("#usda") => USD,
        _ if first.starts_with("solid ") || first.starts_with("#VRML") => SHAPES,
        _ if first.starts_with("within ") || word.starts_with("model ") => MODELICA,
        _ if first.starts_with('{') || first.starts_with('[') => JSON,
        _ if first.starts_with("---") || is_setting(first) => YAML,
        _ => return Content::Robot,
    };
    Content::Other(other)
}

/// Whether a line is `name: value` or `name:`.
fn is_setting(line: &str) -> bool {
    let Some((name, value)) = line.split_once(':') else {
        return false;
    };
    let plain = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | '.');
    !name.is_empty() && name.chars().all(plain) && (value.is_empty() || value.starts_with(' '))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_is_known_by_what_it_says() {
        for (text, expected) in [
            ("<robot name='a'/>", Content::Robot),
            (
                "\u{feff}<?xml version='1.0'?>\n<!-- a --><mujoco/>",
                Content::Mjcf,
            ),
            ("<sdf version='1.9'/>", Content::Sdf),
            ("OndselSolver\nAssembly\n\tName\n\t\ta\n", Content::Asmt),
            ("#usda 1.0\n(\n)", Content::Other(USD)),
            ("ISO-10303-21;\nHEADER;", Content::Step),
            ("\u{feff} \nISO-10303-21;", Content::Step),
            ("closed_loop: [[a, b]]\n", Content::Gepetto),
            ("# robot\nclosed_loop:\n- [a, b]\n", Content::Gepetto),
            ("joints: [a, b]\n", Content::Other(YAML)),
            ("{\"links\": []}", Content::Other(JSON)),
            ("model FourBar\nend FourBar;", Content::Other(MODELICA)),
            ("solid part\nfacet normal 0 0 1", Content::Other(SHAPES)),
            ("<COLLADA xmlns='a'/>", Content::Other(COLLADA)),
            ("", Content::Robot),
            ("just words", Content::Robot),
        ] {
            assert_eq!(of(text), expected, "{text}");
        }
        assert_eq!(of_bytes(b"PXR-USDC\0\0"), Some(USD));
        assert_eq!(of_bytes(b"<robot/>"), None);
    }
}
