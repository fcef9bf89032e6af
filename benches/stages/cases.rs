//! What is measured: small mechanisms as files, and families of growing size.

use kutzbach::closure::{Arithmetic, Assembly, Geometry, assemble};
use kutzbach::families::{miura_sheet, scissor_lift};
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::Structure;
use std::collections::BTreeSet;

/// Mechanisms of one loop.
pub const ONE_LOOP: [&str; 2] = ["bennett", "sarrus"];

/// All cases: file names, or a family with its size.
pub const ALL: [&str; 11] = [
    "bennett",
    "sarrus",
    "stewart",
    "delta",
    "steffen",
    "scissor 100",
    "scissor 1000",
    "scissor 10000",
    "miura 10",
    "miura 20",
    "miura 30",
];

/// The file of a case that is none of a family.
fn file(case: &str) -> Option<&'static str> {
    Some(match case {
        "bennett" => include_str!("../../mechanisms/bennett.urdf"),
        "four bar" => include_str!("../../mechanisms/planar_four_bar.urdf"),
        "sarrus" => include_str!("../../mechanisms/sarrus.urdf"),
        "stewart" => include_str!("../../mechanisms/stewart.urdf"),
        "delta" => include_str!("../../mechanisms/delta.urdf"),
        "steffen" => include_str!("../../tests/zoo/steffen_polyhedron.urdf"),
        "goldberg" => include_str!("../../tests/zoo/goldberg_6r.urdf"),
        "flat kite" => include_str!("../../mechanisms/kite_flat.urdf"),
        "cusp" => include_str!("../../mechanisms/double_watt_cusp.urdf"),
        "flat miura" => include_str!("../../mechanisms/miura_flat.urdf"),
        "oldham" => include_str!("../../mechanisms/oldham.urdf"),
        "double peg" => include_str!("../../tests/thesis/double_peg.urdf"),
        _ => return None,
    })
}

/// Families whose members are asked one after the other.
pub const FAMILIES: [&str; 4] = ["four bar", "bennett", "six legs", "robot"];

/// The file of a family, and the ranges of its measures; all members of these can be assembled.
pub fn family(case: &str) -> Option<(&'static str, &'static [&'static str])> {
    Some(match case {
        "four bar" => (
            include_str!("../families/four_bar.urdf"),
            &["a=0.5..1.5", "b=1.5..3", "c=1.5..3"],
        ),
        "bennett" => (
            include_str!("../../mechanisms/bennett_isogram.urdf"),
            &["p=0.5..3", "q=0.5..3", "h=0.1..1"],
        ),
        "six legs" => (
            include_str!("../families/six_legs.urdf"),
            &["foot=0.2..0.4"],
        ),
        "robot" => (
            include_str!("../families/robot.urdf"),
            &["crank=0.02..0.06", "rod=0.28..0.32"],
        ),
        _ => return None,
    })
}

/// The text of a case as a mechanism file.
pub fn text(case: &str) -> String {
    file(case).map_or_else(
        || kutzbach::format::write(&of_family(case)),
        ToOwned::to_owned,
    )
}

/// A case as a mechanism.
pub fn mechanism(case: &str) -> Mechanism {
    match file(case) {
        Some(text) => {
            kutzbach::format::read(text, case, &[])
                .expect("the file is part of the repository")
                .mechanism
        }
        None => of_family(case),
    }
}

fn of_family(case: &str) -> Mechanism {
    let (family, size) = case.split_once(' ').expect("a family and a size");
    let size = size.parse().expect("a size");
    match family {
        "scissor" => scissor_lift(size),
        "miura" => miura_sheet(size, size),
        other => panic!("there is no family `{other}`"),
    }
    .expect("the family is valid at every size")
}

/// A case with everything known that ranks need.
pub struct Standing {
    pub mechanism: Mechanism,
    pub structure: Structure,
    pub geometry: Geometry<f64>,
    pub assembly: Assembly,
    pub held: BTreeSet<usize>,
}

impl Standing {
    pub fn new(case: &str) -> Self {
        let mechanism = mechanism(case);
        let structure = Structure::new(&mechanism);
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
        let held = BTreeSet::new();
        let assembly = assemble(&mechanism, &geometry, &structure.parts, &held)
            .expect("coordinates are in range");
        assert!(assembly.closed, "{case} does not assemble");
        Self {
            mechanism,
            structure,
            geometry,
            assembly,
            held,
        }
    }
}
