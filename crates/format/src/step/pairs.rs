//! What every pair of parts is taken as: by its contacts, by a name, or by what a person says.

use super::corrections::{PairRule, Resolved, Wrong};
use super::declared::{Declared, Said};
use super::fasteners::{
    has_plane_across, has_shaft_along, has_shaft_and_head, is_fastener, shafts,
};
use super::geometry::{Geometry, Taken, for_kind, needed_by, of_subgroup};
use crate::words::quoted;
use kutzbach_model::mechanism::JointKind;
use kutzbach_step::{Assembly, Contact, Joint, JointError, PairOfParts, joint_of};
use std::collections::{BTreeMap, BTreeSet};

/// Why a pair is taken as what it is taken as.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reason {
    /// Its contacts leave the displacements of this joint.
    Contacts,
    /// One of its parts is a fastener, which is tight on the other.
    Fastener,
    /// A person says so.
    Correction,
    /// A kinematic pair of the file says so; or others say the joints of both parts, and none is between them.
    Declared,
    /// Its contacts are no joint, and why: nothing is taken of it.
    Unclear(String),
}

/// A pair of parts and what it is taken as.
#[derive(Clone, Debug)]
pub(super) struct Judged {
    /// The places of the parts, the smaller one first.
    pub parts: (usize, usize),
    pub contacts: Vec<Contact>,
    /// What the contacts say.
    pub found: Result<Joint, JointError>,
    /// The joint; `None` where the two do not hold each other.
    pub taken: Option<Taken>,
    pub reason: Reason,
    /// Which of the parts is the fastener, where the reason is one.
    pub fastener: Option<usize>,
}

/// Judges the pairs that touch and those that a person or the file names, in ascending order of their parts.
///
/// # Errors
/// A joint that a person names and for which the contacts have no axis or centre.
pub(super) fn judged(
    assembly: &Assembly,
    touching: Vec<PairOfParts>,
    corrections: &Resolved,
    accuracy: f64,
) -> Result<Vec<Judged>, Wrong> {
    let mut contacts: BTreeMap<(usize, usize), Vec<Contact>> = touching
        .into_iter()
        .map(|pair| ((pair.first, pair.second), pair.contacts))
        .collect();
    let declared = Declared::of(assembly);
    for pair in corrections.pairs.keys().chain(declared.pairs.keys()) {
        contacts.entry(*pair).or_default();
    }
    let threaded = threaded(corrections);
    let fastens = |place: &usize| {
        let part = assembly.parts.get(*place);
        part.is_some_and(|part| is_fastener(&part.name)) && !threaded.contains(place)
    };
    let mut pairs = Vec::with_capacity(contacts.len());
    for (parts, contacts) in contacts {
        let found = joint_of(&contacts, accuracy);
        let fastener = [parts.0, parts.1].into_iter().find(fastens);
        let fastener = fastener.filter(|_| has_shaft_and_head(&contacts));
        let mut pair = Judged {
            parts,
            contacts,
            found,
            taken: None,
            reason: Reason::Correction,
            fastener: None,
        };
        match corrections.pairs.get(&parts) {
            Some((rule, lead)) => pair.taken = corrected(assembly, &pair, *rule, *lead)?,
            None if pair.said(&declared) => {}
            None => pair.by_itself(fastener),
        }
        pairs.push(pair);
    }
    for (place, nut) in nuts(&pairs, fastens) {
        if let Some(pair) = pairs.get_mut(place) {
            pair.by_itself(Some(nut));
        }
    }
    Ok(pairs)
}

/// Nuts and washers that are tight on a tight bolt: the places of their pairs with it, and their own among the parts. `fastens` says whether the
/// part at a place is a fastener.
fn nuts(pairs: &[Judged], fastens: impl Fn(&usize) -> bool) -> Vec<(usize, usize)> {
    let mut tight: BTreeSet<usize> = BTreeSet::new();
    let mut beside: BTreeMap<usize, Vec<(usize, &[Contact])>> = BTreeMap::new();
    for pair in pairs {
        let (a, b) = pair.parts;
        for (own, other) in [(a, b), (b, a)] {
            if !fastens(&own) {
                continue;
            }
            if pair.reason == Reason::Fastener {
                tight.insert(own);
            }
            let others = beside.entry(own).or_default();
            others.push((other, pair.contacts.as_slice()));
        }
    }
    let of = |place: usize| beside.get(&place).into_iter().flatten();
    // Held between the two is what both touch.
    let holds = |nut: usize, bolt: usize, shaft: &Contact| {
        let mut seats = of(nut)
            .filter(|(other, contacts)| *other != bolt && has_plane_across(contacts, &shaft.axis));
        let passes = |held: usize| {
            let mut others = of(bolt);
            others.any(|(other, contacts)| *other == held && has_shaft_along(contacts, &shaft.axis))
        };
        seats.any(|(held, _)| passes(*held))
    };
    let mut found = Vec::new();
    for (place, pair) in pairs.iter().enumerate() {
        let (a, b) = pair.parts;
        if pair.reason != Reason::Contacts || !fastens(&a) || !fastens(&b) {
            continue;
        }
        let (bolt, nut) = match (tight.contains(&a), tight.contains(&b)) {
            (true, false) => (a, b),
            (false, true) => (b, a),
            _ => continue,
        };
        if shafts(&pair.contacts).any(|shaft| holds(nut, bolt, shaft)) {
            found.push((place, nut));
        }
    }
    found
}

/// The parts of which a person has named a thread: they are drives.
fn threaded(corrections: &Resolved) -> Vec<usize> {
    let screws = corrections
        .pairs
        .iter()
        .filter(|(_, (rule, _))| matches!(rule, PairRule::Joint(kind) if kind.uses_lead()));
    screws.flat_map(|((a, b), _)| [*a, *b]).collect()
}

impl Judged {
    /// Takes the pair as what the file says of it; whether it says something.
    fn said(&mut self, declared: &Declared) -> bool {
        let said = declared.pairs.get(&self.parts).copied();
        self.reason = match said {
            Some(Said::Unknown) => {
                let why = "the kinematic pair of the file lets through what is no joint here";
                Reason::Unclear(why.to_owned())
            }
            _ => Reason::Declared,
        };
        self.taken = match said {
            Some(Said::Joint(taken)) => Some(taken),
            _ => None,
        };
        said.is_some() || declared.joins_otherwise(self.parts)
    }

    /// What the pair is where no one says anything of it.
    fn by_itself(&mut self, fastener: Option<usize>) {
        if fastener.is_some() {
            self.fastener = fastener;
            self.reason = Reason::Fastener;
            self.taken = Some(Taken {
                kind: JointKind::Fixed,
                geometry: Geometry::Free,
                lead: None,
            });
            return;
        }
        let taken = match &self.found {
            Ok(joint) if !joint.margin.is_clear() => Err(format!(
                "they leave a `{}` joint, but not clearly ({:.1} tolerances above zero, needed 10; margin {:.0}, needed 1000)",
                kind_word(joint),
                joint.margin.kept,
                joint.margin.gap()
            )),
            Ok(joint) => match of_subgroup(&joint.subgroup) {
                Some((kind, geometry, lead)) => Ok(Taken {
                    kind,
                    geometry,
                    lead,
                }),
                None => Err("they leave every motion".to_owned()),
            },
            Err(error) => Err(error.to_string()),
        };
        match taken {
            Ok(taken) => {
                self.taken = Some(taken);
                self.reason = Reason::Contacts;
            }
            Err(why) => self.reason = Reason::Unclear(why),
        }
    }
}

/// The word of the joint that contacts leave.
fn kind_word(joint: &Joint) -> &'static str {
    of_subgroup(&joint.subgroup).map_or("floating", |(kind, ..)| kind.word())
}

/// What a person says a pair is.
fn corrected(
    assembly: &Assembly,
    pair: &Judged,
    rule: PairRule,
    lead: Option<f64>,
) -> Result<Option<Taken>, Wrong> {
    let PairRule::Joint(kind) = rule else {
        return Ok(None);
    };
    let clear = pair.found.as_ref().ok().filter(|j| j.margin.is_clear());
    let found = clear.map(|joint| &joint.subgroup);
    let Some(geometry) = for_kind(kind, found, &pair.contacts) else {
        let name = |place: usize| {
            let part = assembly.parts.get(place);
            quoted(part.map_or("", |part| part.name.as_str()))
        };
        let message = format!(
            "`{}` between {} and {} needs {} in that pair, found {}",
            kind.word(),
            name(pair.parts.0),
            name(pair.parts.1),
            needed_by(kind),
            match pair.contacts.len() {
                0 => "no contact".to_owned(),
                1 => "one other contact".to_owned(),
                many => format!("{many} other contacts"),
            }
        );
        let help = "a larger \"clearance\" finds more contacts; `fixed` and `ignore` need none";
        return Err((message, Some(help.to_owned())));
    };
    Ok(Some(Taken {
        kind,
        geometry,
        lead,
    }))
}
