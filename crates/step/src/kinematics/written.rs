//! What is written of a pair.
//!
//! An entity of several types is written as one record with the parameters of all its types, supertypes first, or as one record for each type
//! (ISO 10303-21, internal and external mapping). AP242 gives a pair of few freedoms six derived flags between its joint and its own parameters,
//! and a name as an item before all; AP214 has neither. So the first three references in a row are its two placements and its joint.

use super::PairMotion;
use crate::error::StepError;
use crate::part21::{Instance, Item, Record};
use crate::units::Units;

/// Words that end like pairs and are others.
const OTHERS: [&str; 3] = [
    "DIMENSION_PAIR",
    "PLANE_ANGLE_AND_LENGTH_PAIR",
    "PLANE_ANGLE_AND_RATIO_PAIR",
];

/// Types that stand beside the one which says what a pair lets through.
const SUPERTYPES: [&str; 5] = [
    "KINEMATIC_PAIR",
    "HIGH_ORDER_KINEMATIC_PAIR",
    "ACTUATED_KINEMATIC_PAIR",
    "PLANAR_CURVE_PAIR",
    "SURFACE_PAIR",
];

/// Any pair of few freedoms, with its flags.
const LOW_ORDER: &str = "LOW_ORDER_KINEMATIC_PAIR";

/// Pairs of few freedoms: translations along and rotations about x, y, z.
const FREE: [(&str, [u8; 3], [u8; 3]); 9] = [
    ("REVOLUTE_PAIR", [0, 0, 0], [0, 0, 1]),
    ("PRISMATIC_PAIR", [1, 0, 0], [0, 0, 0]),
    ("CYLINDRICAL_PAIR", [0, 0, 1], [0, 0, 1]),
    ("SPHERICAL_PAIR", [0, 0, 0], [1, 1, 1]),
    ("PLANAR_PAIR", [1, 1, 0], [0, 0, 1]),
    ("UNIVERSAL_PAIR", [0, 0, 0], [1, 0, 1]),
    ("SPHERICAL_PAIR_WITH_PIN", [0, 0, 0], [0, 1, 1]),
    ("FULLY_CONSTRAINED_PAIR", [0, 0, 0], [0, 0, 0]),
    ("UNCONSTRAINED_PAIR", [1, 1, 1], [1, 1, 1]),
];

/// A keyword without what says that a pair has limits.
pub(super) fn without_range(keyword: &str) -> &str {
    keyword.strip_suffix("_WITH_RANGE").unwrap_or(keyword)
}

/// Whether a keyword is that of a pair.
pub(super) fn names_pair(keyword: &str) -> bool {
    let word = without_range(keyword);
    (word.ends_with("_PAIR") || word == "SPHERICAL_PAIR_WITH_PIN") && !OTHERS.contains(&word)
}

/// The keyword that says what a pair lets through; `None` where an entity is no pair.
pub(super) fn word(instance: Instance<'_>) -> Option<&str> {
    let keywords = instance.leaves().map(|leaf| leaf.keyword());
    let pairs = keywords.filter(|keyword| names_pair(keyword));
    pairs.map(without_range).min_by_key(|word| match *word {
        "UNIVERSAL_PAIR" => 1,
        LOW_ORDER => 2,
        word if SUPERTYPES.contains(&word) => 3,
        _ => 0,
    })
}

/// The parameters of a pair.
pub(super) struct Written<'e> {
    keyword: &'e str,
    instance: Instance<'e>,
    /// Its placements in both links.
    pub items: [Instance<'e>; 2],
    /// The numbers of its links.
    pub links: [u64; 2],
    /// The record with its own parameters, and the place of the first of them.
    own: (Record<'e>, usize),
}

impl<'e> Written<'e> {
    /// Reads the parameters of a pair; `None` where it does not have them.
    ///
    /// # Errors
    /// References to nothing, a joint that is none.
    pub fn new(instance: Instance<'e>, keyword: &'e str) -> Result<Option<Self>, StepError> {
        let Some(own) = instance
            .leaves()
            .find(|leaf| without_range(leaf.keyword()) == keyword)
        else {
            return Ok(None);
        };
        let apart = instance
            .leaf("ITEM_DEFINED_TRANSFORMATION")
            .zip(instance.leaf("KINEMATIC_PAIR"));
        let (items, joint, own) = match apart {
            Some((placed, pair)) => {
                let items = [placed.entity_at(2)?, placed.entity_at(3)?];
                (
                    items,
                    pair.entity_at(pair.len().saturating_sub(1))?,
                    (own, 0),
                )
            }
            None => {
                let refers = |place: usize| own.item(place).and_then(Item::reference).is_some();
                let first = (0..own.len()).find(|i| (0..3).all(|next| refers(i + next)));
                let Some(first) = first else {
                    return Ok(None);
                };
                let items = [own.entity_at(first)?, own.entity_at(first + 1)?];
                (items, own.entity_at(first + 2)?, (own, first + 3))
            }
        };
        let joint = joint.expect("KINEMATIC_JOINT", "KINEMATIC_JOINT")?;
        let (start, end) = match joint.len() {
            0 | 1 => {
                let edge = joint.instance().expect("EDGE", "EDGE")?;
                (edge.entity_at(0)?, edge.entity_at(1)?)
            }
            count => (joint.entity_at(count - 2)?, joint.entity_at(count - 1)?),
        };
        Ok(Some(Self {
            keyword,
            instance,
            items,
            links: [start.number(), end.number()],
            own,
        }))
    }

    /// What the pair lets through, or why that is not read.
    ///
    /// # Errors
    /// Parameters of the wrong kind.
    pub fn motion(&self, units: &Units) -> Result<Result<PairMotion, &'static str>, StepError> {
        let (own, first) = self.own;
        if let Some((_, along, about)) = FREE.iter().find(|(word, ..)| *word == self.keyword) {
            // Behind the six flags, which AP214 does not have.
            let place = if own.len() > first + 6 {
                first + 6
            } else {
                first
            };
            let skew = own.item(place).and_then(Item::number);
            if self.keyword == "UNIVERSAL_PAIR" && skew.is_some_and(|angle| angle != 0.0) {
                return Ok(Err("the skew angle of its axes is not read"));
            }
            return Ok(Ok(PairMotion::Free {
                translations: along.map(|flag| flag == 1),
                rotations: about.map(|flag| flag == 1),
            }));
        }
        Ok(match self.keyword {
            LOW_ORDER => Ok(self.flags()?),
            "SCREW_PAIR" => {
                let lead = units.metres(own.number_at(first)?);
                match lead != 0.0 && lead.is_finite() {
                    true => Ok(PairMotion::Screw { lead }),
                    false => Err("its pitch is zero"),
                }
            }
            "GEAR_PAIR" => {
                let ratio = own.number_at(first + 4)?;
                match ratio != 0.0 && ratio.is_finite() {
                    true => Ok(PairMotion::Gears { ratio }),
                    false => Err("its ratio is zero"),
                }
            }
            "RACK_AND_PINION_PAIR" => {
                Err("which way the rack goes for a turn of the pinion is not in the file")
            }
            _ => Err("pairs of this kind are not read"),
        })
    }

    /// The six flags of a pair of few freedoms.
    fn flags(&self) -> Result<PairMotion, StepError> {
        let (own, first) = match self.instance.leaf(LOW_ORDER) {
            Some(leaf) if leaf.len() == 6 => (leaf, 0),
            _ => self.own,
        };
        let mut flags = [false; 6];
        for (place, flag) in flags.iter_mut().enumerate() {
            *flag = own.truth_at(first + place)?;
        }
        let [x, y, z, a, b, c] = flags;
        Ok(PairMotion::Free {
            translations: [x, y, z],
            rotations: [a, b, c],
        })
    }
}
