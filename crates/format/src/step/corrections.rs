//! What a person knows of the contacts of an assembly, beyond its shapes.

use crate::words::{alternatives, did_you_mean, quoted};
use kutzbach_model::mechanism::JointKind;
use kutzbach_step::Assembly;
use std::collections::BTreeMap;

/// Corrections of what the contacts of a STEP file are taken as.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Corrections {
    /// The part that is held, by its name; chosen by names and sizes where this is `None`.
    pub ground: Option<String>,
    /// The largest distance (m) between faces that touch; as in [`kutzbach_step::ContactOptions`] where this is `None`.
    pub clearance: Option<f64>,
    /// What single pairs of parts are; pairs that are not named are what their contacts say.
    pub pairs: Vec<PairCorrection>,
}

/// What a pair of parts is.
#[derive(Clone, Debug, PartialEq)]
pub struct PairCorrection {
    /// The names of the two parts, in any order.
    pub parts: [String; 2],
    /// What they are to each other.
    pub rule: PairRule,
    /// Metres per turn, right-handed positive, where the rule is a screw.
    pub lead: Option<f64>,
}

/// What a pair of parts is to be taken as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PairRule {
    /// Nothing: the two do not hold each other, whatever touches.
    Ignore,
    /// A joint of this kind, whose displacements are a subgroup.
    Joint(JointKind),
}

impl PairRule {
    /// The words that a correction may use: `ignore`, `press fit` (fixed), `thread` (a screw joint), and kinds of joints.
    pub const WORDS: [&'static str; 14] = [
        "fixed",
        "press fit",
        "ignore",
        "thread",
        "revolute",
        "prismatic",
        "screw",
        "cylindrical",
        "planar_translation",
        "planar",
        "spherical",
        "translational",
        "translating_screw",
        "schoenflies",
    ];

    /// The rule that a word means; `None` for other words.
    #[must_use]
    pub fn from_word(word: &str) -> Option<Self> {
        match word {
            "ignore" => Some(Self::Ignore),
            "press fit" => Some(Self::Joint(JointKind::Fixed)),
            "thread" => Some(Self::Joint(JointKind::Screw)),
            _ => JointKind::from_word(word)
                .filter(|kind| kind.is_subgroup())
                .map(Self::Joint),
        }
    }

    /// The word nearest to one that is no rule, as a hint.
    #[must_use]
    pub fn hint(word: &str) -> String {
        did_you_mean(word, Self::WORDS, ("`", "`"))
            .unwrap_or_else(|| format!("it is {}", alternatives(&Self::WORDS)))
    }

    /// Its word.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Ignore => "ignore",
            Self::Joint(kind) => kind.word(),
        }
    }
}

/// What is wrong with corrections, and how to mend it.
pub(super) type Wrong = (String, Option<String>);

/// Corrections whose names are parts of one assembly.
pub(super) struct Resolved {
    /// The part that is held, by its place.
    pub ground: Option<usize>,
    /// Rules and leads (m per turn) by the places of both parts, the smaller one first.
    pub pairs: BTreeMap<(usize, usize), (PairRule, Option<f64>)>,
}

impl Corrections {
    /// Finds the parts that the corrections name.
    ///
    /// # Errors
    /// A name that no part has, with the nearest one; a pair of one part, or named twice; a lead where none is needed, or none
    /// where it is; a clearance that is none.
    pub(super) fn resolved(&self, assembly: &Assembly) -> Result<Resolved, Wrong> {
        if let Some(clearance) = self.clearance.filter(|c| !(*c >= 0.0 && c.is_finite())) {
            return Err((
                format!("needed a clearance in metres, 0 or more, found {clearance}"),
                None,
            ));
        }
        let places: BTreeMap<&str, usize> = assembly
            .parts
            .iter()
            .enumerate()
            .map(|(place, part)| (part.name.as_str(), place))
            .collect();
        let find = |name: &str| {
            places.get(name).copied().ok_or_else(|| {
                let known = places.keys().copied();
                let message = format!(
                    "the corrections name a part {}, and there is none",
                    quoted(name)
                );
                let help = did_you_mean(name, known, ("`", "`"))
                    .unwrap_or_else(|| "`kutzbach contacts FILE` lists the parts".to_owned());
                (message, Some(help))
            })
        };
        let ground = self.ground.as_deref().map(find).transpose()?;
        let mut pairs = BTreeMap::new();
        for pair in &self.pairs {
            let [first, second] = &pair.parts;
            let (one, two) = (find(first)?, find(second)?);
            let named = || format!("{} and {}", quoted(first), quoted(second));
            if one == two {
                let message = format!("a pair needs two parts, found {} twice", quoted(first));
                return Err((message, None));
            }
            check_lead(pair, &named())?;
            let key = (one.min(two), one.max(two));
            if pairs.insert(key, (pair.rule, pair.lead)).is_some() {
                let message = format!("the pair of {} is corrected twice", named());
                return Err((message, Some("keep one of the two".to_owned())));
            }
        }
        Ok(Resolved { ground, pairs })
    }
}

fn check_lead(pair: &PairCorrection, named: &str) -> Result<(), Wrong> {
    let needed = matches!(pair.rule, PairRule::Joint(kind) if kind.uses_lead());
    match pair.lead {
        Some(lead) if needed && lead != 0.0 && lead.is_finite() => Ok(()),
        None if !needed => Ok(()),
        Some(_) if !needed => Err((
            format!("`{}` between {named} has no lead", pair.rule.word()),
            Some("a lead goes with `thread`".to_owned()),
        )),
        _ => Err((
            format!("the thread between {named} needs its lead, which is not 0"),
            Some("\"lead\": metres per turn, right-handed positive".to_owned()),
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_word_is_a_rule() {
        for word in PairRule::WORDS {
            assert!(PairRule::from_word(word).is_some(), "{word}");
        }
        assert_eq!(
            PairRule::from_word("press fit"),
            Some(PairRule::Joint(JointKind::Fixed))
        );
        // Their displacements are no subgroup, so contacts do not make them.
        assert_eq!(PairRule::from_word("universal"), None);
        assert_eq!(PairRule::hint("revolut"), "did you mean `revolute`?");
    }
}
