//! The contacts of an assembly and what they are taken as, for a person to look at and to correct.

use super::Found;
use super::corrections::PairRule;
use super::pairs::{Judged, Reason};
use crate::Warning;
use kutzbach_math::group::Margin;
use kutzbach_step::{Assembly, Contact, Surface};

/// The pairs of parts of a STEP file that touch, or that a person has named.
#[derive(Clone, Debug)]
pub struct ContactTable {
    /// The name of the part that is held.
    pub ground: String,
    /// The largest distance (m) between faces that touch.
    pub clearance: f64,
    /// The pairs, in the order of their parts in the file.
    pub rows: Vec<ContactRow>,
    /// What is told of the assembly before anything else.
    pub warnings: Vec<Warning>,
}

/// A pair of parts.
#[derive(Clone, Debug)]
pub struct ContactRow {
    /// Their names.
    pub parts: [String; 2],
    /// Their contacts.
    pub contacts: Vec<ContactSeen>,
    /// What they are taken as; `None` where the contacts are no joint.
    pub rule: Option<PairRule>,
    /// Metres per turn, where that is a screw.
    pub lead: Option<f64>,
    /// Why.
    pub reason: Reason,
    /// How clearly the contacts leave their joint; `None` where they leave none.
    pub margin: Option<Margin>,
}

/// A contact of two parts.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactSeen {
    /// `cylindrical`, `planar`, `spherical` or `conical`.
    pub kind: &'static str,
    /// The radius (m) of the face of the first part, where it has one.
    pub radius: Option<f64>,
    /// The room between the faces (m); negative where the parts lie in each other.
    pub clearance: f64,
    /// How large the contact is (m), as in [`kutzbach_step::Contact::size`].
    pub size: f64,
}

/// The table of an assembly.
pub(super) fn of(found: &Found, warnings: Vec<Warning>) -> ContactTable {
    let assembly = &found.assembly;
    ContactTable {
        ground: name(assembly, found.ground),
        clearance: found.clearance,
        rows: found.pairs.iter().map(|pair| row(assembly, pair)).collect(),
        warnings,
    }
}

fn row(assembly: &Assembly, pair: &Judged) -> ContactRow {
    let rule = match (&pair.taken, &pair.reason) {
        (_, Reason::Unclear(_)) => None,
        (Some(taken), _) => Some(PairRule::Joint(taken.kind)),
        (None, _) => Some(PairRule::Ignore),
    };
    let seen = |contact: &Contact| ContactSeen {
        kind: contact.kind.name(),
        radius: radius(assembly, contact),
        clearance: contact.clearance,
        size: contact.size,
    };
    ContactRow {
        parts: [pair.parts.0, pair.parts.1].map(|place| name(assembly, place)),
        contacts: pair.contacts.iter().map(seen).collect(),
        rule,
        lead: pair.taken.and_then(|taken| taken.lead),
        reason: pair.reason.clone(),
        margin: pair.found.as_ref().ok().map(|joint| joint.margin),
    }
}

/// The radius of the first part's face of a contact.
fn radius(assembly: &Assembly, contact: &Contact) -> Option<f64> {
    let part = assembly.parts.get(contact.first)?;
    let mut faces = part.faces.iter();
    let face = faces.find(|face| face.entity == contact.faces.0)?;
    match face.surface {
        Surface::Cylinder { radius, .. } | Surface::Sphere { radius, .. } => Some(radius),
        _ => None,
    }
}

fn name(assembly: &Assembly, place: usize) -> String {
    let part = assembly.parts.get(place);
    part.map_or_else(String::new, |part| part.name.clone())
}
