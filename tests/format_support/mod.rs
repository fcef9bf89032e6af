//! What the tests of the file format share: comparing mechanisms and finding files.

use kutzbach::format::{FormatError, read};
use kutzbach::mechanism::{
    Coupling, Direction, Frame, Geometry, Joint, Link, Mechanism, Placement, Shape,
};
use kutzbach::number::Number;
use std::path::{Path, PathBuf};

/// What is different between two mechanisms, stated precision included; `None` if nothing is.
pub fn difference(a: &Mechanism, b: &Mechanism) -> Option<String> {
    if a.name() != b.name() {
        return Some(format!("names {:?} and {:?}", a.name(), b.name()));
    }
    if a.ground() != b.ground() || a.placement_order() != b.placement_order() {
        return Some("ground or order of placement".to_owned());
    }
    if a.links().len() != b.links().len() || a.joints().len() != b.joints().len() {
        return Some("number of links or joints".to_owned());
    }
    for (x, y) in a.links().iter().zip(b.links()) {
        if !same_link(x, y) {
            return Some(format!("link {x:?}\nand {y:?}"));
        }
    }
    for (x, y) in a.joints().iter().zip(b.joints()) {
        if !same_joint(x, y) {
            return Some(format!("joint {x:?}\nand {y:?}"));
        }
    }
    // A mimic is written inside its follower, so the order among couplings may change.
    let sorted = |mechanism: &Mechanism| {
        let mut couplings: Vec<Coupling> = mechanism.couplings().to_vec();
        couplings.sort_by(|x, y| x.name.cmp(&y.name));
        couplings
    };
    if sorted(a) != sorted(b) {
        return Some(format!(
            "couplings {:?}\nand {:?}",
            a.couplings(),
            b.couplings()
        ));
    }
    if a.configurations() != b.configurations() || a.actuated() != b.actuated() {
        return Some("configurations or actuated joints".to_owned());
    }
    if a.scene() != b.scene() || a.expectation() != b.expectation() {
        return Some("scene or expectation".to_owned());
    }
    // What a reader worked out is written as it is, without the literals behind it.
    let is_derived = |joint: &Joint| {
        let mut numbers = joint.numbers().into_iter().flatten();
        numbers.any(|number| !number.inputs().is_empty())
    };
    if a.precision() != b.precision() && !a.joints().iter().any(is_derived) {
        return Some(format!(
            "precision {:?} and {:?}",
            a.precision(),
            b.precision()
        ));
    }
    None
}

fn same_link(a: &Link, b: &Link) -> bool {
    let placements = match (&a.placement, &b.placement) {
        (
            Placement::Floating {
                name,
                parent,
                origin,
            },
            Placement::Floating {
                name: name_b,
                parent: parent_b,
                origin: origin_b,
            },
        ) => name == name_b && parent == parent_b && same_frame(origin, origin_b),
        (x, y) => x == y,
    };
    a.name == b.name
        && placements
        && a.inertial == b.inertial
        && same_shapes(&a.collisions, &b.collisions)
        && same_shapes(&a.visuals, &b.visuals)
}

fn same_shapes(a: &[Shape], b: &[Shape]) -> bool {
    a.len() == b.len()
        && a.iter().zip(b).all(|(x, y)| {
            let sizes = match (&x.geometry, &y.geometry) {
                (Geometry::Box(s), Geometry::Box(t)) => same_numbers(s, t),
                (s, t) => s == t,
            };
            x.name == y.name && same_frame(&x.origin, &y.origin) && sizes
        })
}

fn same_joint(a: &Joint, b: &Joint) -> bool {
    let Direction(axis_a) = &a.axis;
    let Direction(axis_b) = &b.axis;
    let Direction(axis2_a) = &a.axis2;
    let Direction(axis2_b) = &b.axis2;
    a.name == b.name
        && a.kind == b.kind
        && a.predecessor.link == b.predecessor.link
        && a.successor.link == b.successor.link
        && same_frame(&a.predecessor.frame, &b.predecessor.frame)
        && same_frame(&a.successor.frame, &b.successor.frame)
        && same_numbers(axis_a, axis_b)
        && same_numbers(axis2_a, axis2_b)
        && same_optional(&a.lead, &b.lead)
        && same_optional(&a.distance, &b.distance)
        && a.limit == b.limit
        && a.dynamics == b.dynamics
        && a.independent == b.independent
        && a.closes_loop == b.closes_loop
}

fn same_frame(a: &Frame, b: &Frame) -> bool {
    same_numbers(&a.position, &b.position) && same_numbers(&a.roll_pitch_yaw, &b.roll_pitch_yaw)
}

fn same_optional(a: &Option<Number>, b: &Option<Number>) -> bool {
    match (a, b) {
        (None, None) => true,
        (Some(a), Some(b)) => same_numbers(std::slice::from_ref(a), std::slice::from_ref(b)),
        _ => false,
    }
}

/// Equal values with equal stated precision.
fn same_numbers(a: &[Number], b: &[Number]) -> bool {
    a.len() == b.len()
        && a.iter()
            .zip(b)
            .all(|(x, y)| x == y && x.stated() == y.stated())
}

/// The mechanism files of this repository.
pub fn own_files() -> Vec<PathBuf> {
    files_below(&Path::new(env!("CARGO_MANIFEST_DIR")).join("mechanisms"))
}

/// All `.urdf` files below a folder, sorted.
pub fn files_below(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let Ok(entries) = std::fs::read_dir(folder) else {
        return files;
    };
    for entry in entries.flatten() {
        let path = entry.path();
        if path.is_dir() {
            files.extend(files_below(&path));
        } else if path
            .extension()
            .is_some_and(|extension| extension == "urdf")
        {
            files.push(path);
        }
    }
    files.sort();
    files
}

/// Puts lines into a robot with links `a`, `b`, `c`; the lines start at line 3.
pub fn robot(lines: &str) -> String {
    format!(
        "<robot name=\"r\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\">\n<link name=\"a\"/><link name=\"b\"/><link name=\"c\"/>\n{lines}\n</robot>\n"
    )
}

/// A chain a - b - c with something inside the first joint, which starts at line 3, column 30.
pub fn chain(kind: &str, inside: &str) -> String {
    robot(&format!(
        "<joint name=\"j\" type=\"{kind}\">\n<parent link=\"a\"/><child link=\"b\"/>\n{inside}\n</joint>\n<joint name=\"k\" type=\"fixed\"><parent link=\"b\"/><child link=\"c\"/></joint>"
    ))
}

pub fn fault(text: &str) -> FormatError {
    match read(text, "bad.urdf", &[]) {
        Ok(_) => panic!("this was read:\n{text}"),
        Err(error) => {
            check_place(text, &error);
            error
        }
    }
}

/// A place lies inside the text, and line and column agree with the byte range.
pub fn check_place(text: &str, error: &FormatError) {
    assert!(
        error.span.start <= error.span.end && error.span.end <= text.len(),
        "{error:?}"
    );
    let before = &text[..error.span.start];
    let line_start = before.rfind('\n').map_or(0, |at| at + 1);
    let line = before.matches('\n').count() + 1;
    // A byte order mark, at the start of the file, is no column.
    let mark = usize::from(line == 1 && before.starts_with('\u{feff}'));
    let column = before[line_start..].chars().count() + 1 - mark;
    assert_eq!((error.line, error.column), (line, column), "{error:?}");
    error
        .others
        .iter()
        .for_each(|other| check_place(text, other));
}
