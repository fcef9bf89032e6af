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

/// The text of a case as a mechanism file.
pub fn text(case: &str) -> String {
    match case {
        "bennett" => include_str!("../../mechanisms/bennett.urdf").to_owned(),
        "four bar" => include_str!("../../mechanisms/planar_four_bar.urdf").to_owned(),
        "sarrus" => include_str!("../../mechanisms/sarrus.urdf").to_owned(),
        "stewart" => include_str!("../../mechanisms/stewart.urdf").to_owned(),
        "delta" => include_str!("../../mechanisms/delta.urdf").to_owned(),
        "steffen" => include_str!("../../tests/zoo/steffen_polyhedron.urdf").to_owned(),
        family => kutzbach::format::write(&of_family(family)),
    }
}

/// A case as a mechanism.
pub fn mechanism(case: &str) -> Mechanism {
    if case.contains(' ') && case != "four bar" {
        of_family(case)
    } else {
        kutzbach::format::read(&text(case), case, &[])
            .expect("the file is part of the repository")
            .mechanism
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
