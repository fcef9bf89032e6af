//! The eight mechanisms.

use kutzbach::families::{miura_sheet, scissor_lift};
use kutzbach::mechanism::Mechanism;
use std::error::Error;

/// What is measured may fail only where the repository is broken: any error ends the program.
pub type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// Where a mechanism comes from.
#[derive(Clone, Copy, Debug)]
pub enum Origin {
    /// The text of a file in `mechanisms/`.
    File(&'static str),
    /// `families::scissor_lift` of so many stages.
    Scissor(usize),
    /// `families::miura_sheet` of so many columns and rows of facets.
    Miura(usize, usize),
}

/// A mechanism of the page.
#[derive(Clone, Copy, Debug)]
pub struct Subject {
    /// In file names and markers.
    pub name: &'static str,
    /// In the text.
    pub title: &'static str,
    /// Where it comes from.
    pub origin: Origin,
}

/// Those of the page, in its order.
pub const SUBJECTS: [Subject; 8] = [
    Subject {
        name: "four_bar",
        title: "Planar four-bar",
        origin: Origin::File(include_str!("../../mechanisms/planar_four_bar.urdf")),
    },
    Subject {
        name: "bennett",
        title: "Bennett's linkage",
        origin: Origin::File(include_str!("../../mechanisms/bennett.urdf")),
    },
    Subject {
        name: "bricard",
        title: "Bricard's orthogonal linkage",
        origin: Origin::File(include_str!("../../mechanisms/bricard_orthogonal.urdf")),
    },
    Subject {
        name: "delta",
        title: "Delta robot",
        origin: Origin::File(include_str!("../../mechanisms/delta.urdf")),
    },
    Subject {
        name: "stewart",
        title: "Stewart platform",
        origin: Origin::File(include_str!("../../mechanisms/stewart.urdf")),
    },
    Subject {
        name: "scissor",
        title: "Scissor lift of 100 stages",
        origin: Origin::Scissor(100),
    },
    Subject {
        name: "miura",
        title: "Miura sheet",
        origin: Origin::Miura(6, 6),
    },
    Subject {
        name: "gripper",
        title: "Gripper that holds a block",
        origin: Origin::File(include_str!("../../mechanisms/gripper_holding_block.urdf")),
    },
];

impl Subject {
    /// The mechanism.
    pub fn mechanism(&self) -> Result<Mechanism> {
        Ok(match self.origin {
            Origin::File(text) => kutzbach::format::read(text, self.name, &[])?.mechanism,
            Origin::Scissor(stages) => scissor_lift(stages)?,
            Origin::Miura(columns, rows) => miura_sheet(columns, rows)?,
        })
    }
}
