//! Kinematic pairs (ISO 10303-105 as part of AP242 and AP214): the joints that a file says by itself.
//!
//! | file | what it knows |
//! |---|---|
//! | [`written`] | the parameters of a pair, in both ways of ISO 10303-21 to write an entity of several types |
//! | [`links`] | which occurrences are the links of a mechanism, and in which frames their pairs stand |
//!
//! What a pair lets through is about its frame: a hinge turns about z, a slide goes along x, a plane is normal to z; a screw moves by its pitch
//! along z in one turn (attributes of the entities in AP242, `low_order_kinematic_pair` and `screw_pair_value`). Two gears turn about the z
//! axes of their frames, the second by minus the ratio times the first (`gear_pair_value`).

mod links;
mod written;

pub(crate) use links::{Occurred, Shown};

use crate::error::StepError;
use crate::part21::{Exchange, Instance};
use crate::placement::placement;
use crate::shape::{KinematicPair, Note, NoteKind, PairMotion};
use kutzbach_math::group::Pose;
use links::{Link, Links};
use std::collections::BTreeMap;
use written::{Written, names_pair, without_range, word};

/// Frames of a pair that are drawn farther apart, in metres or in parts of coordinates beyond a metre, are not those of one joint: files have
/// six digits or more, and a frame is the product of some placements. Both sides of it are safe: within, the file itself says the joint;
/// beyond, the pair is told as not read, and nothing is joined.
const APART: f64 = 1e-5;

/// The shortest lever of a frame, as a share of the coordinates that stand in [`APART`]: parts reach so far from their frames at least.
const LEVER: f64 = 0.1;

/// Directions (rad) that move the end of such a lever by no more than frames may be [`APART`].
const ASKEW: f64 = APART / LEVER;

/// What a file says of mechanisms.
#[derive(Default)]
pub(crate) struct Mechanisms {
    /// The pairs that are understood.
    pub pairs: Vec<KinematicPair>,
    /// The place of the part that a mechanism has as its base.
    pub base: Option<usize>,
    /// Notes about the other pairs.
    pub notes: Vec<Note>,
}

/// Whether a file has pairs.
pub(crate) fn has_pairs(file: &Exchange<'_>) -> bool {
    let mut keywords = file.keywords().iter();
    keywords.any(|keyword| names_pair(keyword))
}

/// Reads the mechanisms of a file.
///
/// `occurred` is where products occur (of a file without pairs it need not be known), `shown` which representation shows which product.
///
/// # Errors
/// References to nothing, entities of the wrong kind, placements that are none.
pub(crate) fn mechanisms<'e>(
    file: &'e Exchange<'e>,
    occurred: &[Occurred],
    shown: &Shown,
) -> Result<Mechanisms, StepError> {
    if !has_pairs(file) {
        return Ok(Mechanisms::default());
    }
    let mut found = Found::default();
    let links = Links::new(file, occurred, shown)?;
    for instance in file.instances() {
        let Some(keyword) = word(instance) else {
            continue;
        };
        match pair(instance, keyword, &links)? {
            Ok(pair) => {
                found.whole_links(&pair, &links);
                found.remarks(instance, keyword, &pair.pair.motion);
                found.pairs.push(pair.pair);
            }
            Err(why) => found.unread(instance, keyword, why),
        }
    }
    Ok(Mechanisms {
        pairs: found.pairs,
        base: base(file, &links)?,
        notes: found.notes,
    })
}

/// The part that is the base of the first mechanism whose base is a part.
fn base<'e>(file: &'e Exchange<'e>, links: &Links<'e>) -> Result<Option<usize>, StepError> {
    for record in file.of_type("KINEMATIC_PROPERTY_MECHANISM_REPRESENTATION") {
        let base = record.entity_at(record.len().saturating_sub(1))?;
        if let Some(link) = links.shown_by(base.number()) {
            return Ok(link.parts.first().copied());
        }
    }
    Ok(None)
}

/// Why a pair is not read.
type Unread = &'static str;

/// A pair with its links.
struct Read {
    pair: KinematicPair,
    links: [u64; 2],
}

/// Reads one pair.
fn pair<'e>(
    instance: Instance<'e>,
    keyword: &'e str,
    links: &Links<'e>,
) -> Result<Result<Read, Unread>, StepError> {
    let Some(written) = Written::new(instance, keyword)? else {
        return Ok(Err("it has no two placements with a joint of two links"));
    };
    let [start, end] = written.links;
    let (one, two) = match (links.find(start), links.find(end)) {
        (Ok(one), Ok(two)) => (one, two),
        (Err(why), _) | (_, Err(why)) => return Ok(Err(why)),
    };
    let (Some(first), Some(second)) = (one.parts.first(), two.parts.first()) else {
        return Ok(Err("one of its links has no part with faces"));
    };
    if first == second {
        return Ok(Err("both of its links are one part"));
    }
    let [item, other] = written.items;
    let frames = (frame(one, item)?, frame(two, other)?);
    let motion = match written.motion(&one.units(item)?)? {
        Ok(motion) => motion,
        Err(why) => return Ok(Err(why)),
    };
    if !stands(&motion, &frames) {
        return Ok(Err(
            "its frames in the two parts do not meet where the parts are drawn",
        ));
    }
    Ok(Ok(Read {
        pair: KinematicPair {
            line: instance.line(),
            entity: instance.number(),
            parts: (*first, *second),
            frames,
            motion,
        },
        links: written.links,
    }))
}

/// Where a placement of a link stands in the assembly.
fn frame<'e>(link: &Link<'e>, item: Instance<'e>) -> Result<Pose, StepError> {
    Ok(link.pose * placement(item, &link.units(item)?)?)
}

/// Whether the two frames of a pair stand to each other as it lets them.
fn stands(motion: &PairMotion, (one, two): &(Pose, Pose)) -> bool {
    let between = one.inverse() * *two;
    let (z, shift) = (between.rotation.column(2).into_owned(), between.translation);
    let size = one.translation.norm().max(two.translation.norm());
    let apart = APART * size.max(1.0);
    let coaxial = z.x.hypot(z.y) <= ASKEW && shift.x.hypot(shift.y) <= apart;
    match motion {
        PairMotion::Gears { .. } => true,
        PairMotion::Screw { .. } => coaxial,
        PairMotion::Free {
            translations,
            rotations,
        } => {
            let held = (0..3_usize).filter(|place| translations.get(*place) == Some(&false));
            let near = held
                .filter_map(|place| shift.get(place))
                .all(|x| x.abs() <= apart);
            let turning: Vec<usize> = (0..3_usize)
                .filter(|place| rotations.get(*place) == Some(&true))
                .collect();
            let kept = |place: usize| {
                let column = between.rotation.column(place);
                let off = (0..3_usize).filter(|row| *row != place);
                off.filter_map(|row| column.get(row))
                    .all(|x| x.abs() <= ASKEW)
            };
            near && match turning.as_slice() {
                [] => (0..3_usize).all(kept),
                [axis] => kept(*axis),
                _ => true,
            }
        }
    }
}

/// What was found while reading.
#[derive(Default)]
struct Found {
    pairs: Vec<KinematicPair>,
    notes: Vec<Note>,
    /// Places of notes by what they say, and how often it was.
    told: BTreeMap<(String, &'static str), (usize, usize)>,
    /// Links whose parts hold each other already.
    whole: Vec<u64>,
}

impl Found {
    fn unread(&mut self, instance: Instance<'_>, keyword: &str, why: Unread) {
        self.note(instance, keyword.to_owned(), why, NoteKind::MayJoin);
    }

    /// Tells what is left out, and what is taken in one of two ways.
    fn remarks(&mut self, instance: Instance<'_>, keyword: &str, motion: &PairMotion) {
        let mut words = instance.leaves().map(|leaf| leaf.keyword());
        if words.any(|word| word != without_range(word)) {
            let why = "the limits of its motion are not read";
            self.note(instance, keyword.to_owned(), why, NoteKind::Taken);
        }
        if instance.is("ACTUATED_KINEMATIC_PAIR") {
            let why = "which of its freedoms are driven is not read";
            self.note(instance, keyword.to_owned(), why, NoteKind::Taken);
        }
        // The schema has the flags of both axes, and no word of which part holds which.
        if let PairMotion::Free { rotations, .. } = motion
            && rotations.iter().filter(|turns| **turns).count() == 2
        {
            let why = "the first of its axes is taken as held by the first link, the second by the second";
            self.note(instance, keyword.to_owned(), why, NoteKind::Taken);
        }
    }

    fn note(&mut self, instance: Instance<'_>, keyword: String, why: Unread, kind: NoteKind) {
        let next = self.notes.len();
        let (place, count) = self.told.entry((keyword.clone(), why)).or_insert((next, 0));
        *count += 1;
        let text = format!("{count} × {keyword}: {why}");
        match self.notes.get_mut(*place) {
            Some(note) => note.text = text,
            None => self.notes.push(Note {
                line: instance.line(),
                entity: instance.number(),
                kind,
                text,
            }),
        }
    }

    /// A link of several parts, as an assembly below, is one body: its parts hold each other.
    fn whole_links(&mut self, read: &Read, links: &Links<'_>) {
        for number in read.links {
            let Ok(link) = links.find(number) else {
                continue;
            };
            let Some((first, others)) = link.parts.split_first() else {
                continue;
            };
            if self.whole.contains(&number) {
                continue;
            }
            self.whole.push(number);
            self.pairs.extend(others.iter().map(|other| KinematicPair {
                line: read.pair.line,
                entity: read.pair.entity,
                parts: (*first, *other),
                frames: (link.pose, link.pose),
                motion: PairMotion::Free {
                    translations: [false; 3],
                    rotations: [false; 3],
                },
            }));
        }
    }
}
