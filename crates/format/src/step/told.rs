//! What is told of an assembly before anything else.

use super::fasteners::has_shaft_and_head;
use super::ground::Why;
use super::pairs::{Judged, Reason};
use super::standing::{COARSEST, FINEST};
use crate::words::{listed, quoted};
use crate::{Warning, WarningKind};
use kutzbach_model::mechanism::JointKind;
use kutzbach_step::{Assembly, ContactKind, Note, NoteKind};
use std::collections::BTreeMap;

/// How a person corrects what is told.
const CORRECT: &str =
    "`kutzbach contacts FILE --json` writes what `--contacts` reads back corrected";

/// The warnings so far, each text once.
#[derive(Default)]
pub(super) struct Told {
    warnings: Vec<Warning>,
}

impl Told {
    /// Everything, in the order of lines.
    pub(super) fn finished(mut self) -> Vec<Warning> {
        self.warnings.sort_by_key(|warning| warning.line);
        self.warnings
    }

    fn add(&mut self, line: usize, kind: WarningKind, message: String) {
        let same = |w: &&mut Warning| w.message == message && w.kind == kind;
        match self.warnings.iter_mut().find(same) {
            Some(warning) => warning.count += 1,
            None => self.warnings.push(Warning {
                line,
                column: 1,
                kind,
                message,
                count: 1,
            }),
        }
    }

    /// What the reader of the file left out, or took in one of several ways.
    pub(super) fn notes(&mut self, notes: &[Note]) {
        for note in notes {
            let kind = match note.kind {
                NoteKind::MayTouch | NoteKind::MayJoin => WarningKind::MayJoin,
                NoteKind::Taken => WarningKind::Guessed,
            };
            self.add(note.line.max(1), kind, note.text.clone());
        }
    }

    /// Which part is the ground, where no one said so.
    pub(super) fn ground(&mut self, assembly: &Assembly, ground: usize, why: Why) {
        let why = match why {
            Why::Said => return,
            Why::Base => "the base of the file's mechanism",
            Why::Name => "as its name says",
            Why::Size => "the largest part, since no name says which one is",
        };
        let message = format!(
            "{} is the ground, {why} (\"ground\" in the file of `--contacts` names another)",
            quoted(name(assembly, ground))
        );
        self.add(1, WarningKind::Guessed, message);
    }

    /// What pairs were taken as against their faces, and what is not taken of them.
    pub(super) fn pairs(&mut self, assembly: &Assembly, pairs: &[Judged]) {
        // Fasteners by what they are and what they are fixed to.
        let mut tight: BTreeMap<(&str, usize), Vec<&str>> = BTreeMap::new();
        let mut nuts: Vec<&str> = Vec::new();
        let mut otherwise: Vec<String> = Vec::new();
        for pair in pairs {
            let (a, b) = pair.parts;
            let both = || {
                format!(
                    "{} and {}",
                    quoted(name(assembly, a)),
                    quoted(name(assembly, b))
                )
            };
            match &pair.reason {
                Reason::Unclear(why) => {
                    let message = format!("{} touch and are not joined: {why}. {CORRECT}", both());
                    self.add(1, WarningKind::MayJoin, message);
                }
                Reason::Fastener => {
                    let own = pair.fastener.unwrap_or(b);
                    if !has_shaft_and_head(&pair.contacts) {
                        nuts.push(name(assembly, own));
                        continue;
                    }
                    let other = if own == a { b } else { a };
                    let product = assembly.parts.get(own).map_or("", |p| p.product.as_str());
                    let names = tight.entry((product, other)).or_default();
                    names.push(name(assembly, own));
                }
                Reason::Contacts if pressed(pair) => {
                    let message = format!(
                        "a round face of {} is larger than its hole: taken as a `{}` joint all the same; \"press fit\" holds them together. {CORRECT}",
                        both(),
                        pair.taken.map_or("", |taken| taken.kind.word())
                    );
                    self.add(1, WarningKind::Guessed, message);
                }
                Reason::Declared if pair.taken.is_none() && !pair.contacts.is_empty() => {
                    otherwise.push(both());
                }
                Reason::Contacts => {
                    if let Some(misfit) = beyond_room(pair, assembly.accuracy) {
                        let message = format!(
                            "round faces of {} are off one another by {:.0} µm more than the room between them: taken as on one axis or centre, and as drawn they would bind. {CORRECT}",
                            both(),
                            1e6 * misfit
                        );
                        self.add(1, WarningKind::Guessed, message);
                    }
                }
                Reason::Correction | Reason::Declared => {}
            }
        }
        if !otherwise.is_empty() {
            let more = match otherwise.len() {
                0..=3 => String::new(),
                many => format!(", and {} pairs more", many - 3),
            };
            otherwise.truncate(3);
            let message = format!(
                "touch and are not joined, since kinematic pairs of the file say the joints of both: {}{more}. {CORRECT}",
                otherwise.join("; ")
            );
            self.add(1, WarningKind::Guessed, message);
        }
        if !nuts.is_empty() {
            let message = format!(
                "taken as tight, by name and seat: {}, fixed to the bolt that passes each, across what both hold. {CORRECT}",
                listed(&nuts)
            );
            self.add(1, WarningKind::Guessed, message);
        }
        for ((_, other), names) in tight {
            let message = format!(
                "taken as tight, by name and head: {}, fixed to {}. {CORRECT}",
                listed(&names),
                quoted(name(assembly, other))
            );
            self.add(1, WarningKind::Guessed, message);
        }
    }

    /// Gears whose hinges were not found.
    pub(super) fn uncoupled(&mut self, assembly: &Assembly, gears: &[usize]) {
        for pair in gears.iter().filter_map(|place| assembly.pairs.get(*place)) {
            let message = format!(
                "GEAR_PAIR: {} and {} do not turn about its axes on one part that bears both: not coupled",
                quoted(name(assembly, pair.parts.0)),
                quoted(name(assembly, pair.parts.1))
            );
            self.add(pair.line.max(1), WarningKind::MayJoin, message);
        }
    }

    /// Parts that nothing connects with the ground.
    pub(super) fn islands(&mut self, assembly: &Assembly, ground: usize, islands: &[Vec<usize>]) {
        for island in islands {
            let names: Vec<&str> = island.iter().map(|place| name(assembly, *place)).collect();
            let message = format!(
                "no contact leads from {} to the ground {}: free to move in every way. A larger \"clearance\" finds more contacts. {CORRECT}",
                listed(&names),
                quoted(name(assembly, ground))
            );
            self.add(1, WarningKind::MayJoin, message);
        }
    }
}

/// Whether a shaft that is thicker than its hole is taken as moving in it.
fn pressed(pair: &Judged) -> bool {
    let moves = pair
        .taken
        .is_some_and(|taken| taken.kind != JointKind::Fixed);
    let thick =
        |kind: ContactKind, clearance: f64| kind == ContactKind::Cylindrical && clearance < -FINEST;
    moves && pair.contacts.iter().any(|c| thick(c.kind, c.clearance))
}

/// By how much (m) round faces of a pair are off one another beyond the room between them; `None` within what the closest fit has as play, and what
/// the file leaves open of two points and of the two frames that they are in.
fn beyond_room(pair: &Judged, accuracy: f64) -> Option<f64> {
    let round = pair
        .contacts
        .iter()
        .filter(|contact| contact.kind != ContactKind::Planar);
    let beyond = round.map(|contact| contact.misfit - contact.clearance.max(0.0));
    let most = beyond.fold(0.0, f64::max);
    (most > COARSEST.max(4.0 * accuracy)).then_some(most)
}

fn name(assembly: &Assembly, place: usize) -> &str {
    assembly
        .parts
        .get(place)
        .map_or("", |part| part.name.as_str())
}
