//! What a file says for all values of its measures: a mechanism in which only the values of expressions are open.
//!
//! A reader decides much by what it reads, so that another value could make another mechanism. In the files that have a skeleton it cannot:
//! their elements are plain joints, loops and what does not bear on these, and all their expressions stand in frames and axes of joints, where
//! a number is taken over as it is, or refused. What would be refused has no mechanism here, and is left to the reader and its words.

use super::definitions::Definitions;
use super::element::{Element, Owner};
use super::values::LARGEST;
use super::{ReadOptions, number_text, reader};
use kutzbach_math::number::{Number, View};
use kutzbach_model::mechanism::Mechanism;
use roxmltree::{Document, NodeId};
use std::cell::Cell;
use std::collections::BTreeMap;

/// Elements of whose numbers nothing else depends.
const PLAIN: [&str; 8] = [
    "link",
    "joint",
    "loop",
    "ground",
    "configuration",
    "scene",
    "expect",
    "material",
];

/// Where in [`Joint::numbers`](kutzbach_model::mechanism::Joint::numbers) the components of directions stand.
const DIRECTIONS: std::ops::Range<usize> = 12..18;

/// A number of a joint that an expression gives.
#[derive(Debug)]
struct Slot {
    joint: usize,
    /// In [`Joint::numbers`](kutzbach_model::mechanism::Joint::numbers).
    place: usize,
    /// Index of the expression.
    text: usize,
}

/// A mechanism in which only the values of expressions are open.
#[derive(Debug)]
pub(super) struct Skeleton {
    /// As it is read, with parameters in place of expressions, named by their texts.
    mechanism: Mechanism,
    /// The expressions, each once.
    texts: Vec<String>,
    slots: Vec<Slot>,
    /// The elements that name numbers.
    definitions: Vec<NodeId>,
}

impl Skeleton {
    /// That of a parsed text; `None` where other values could make more than other numbers of it, or it is at fault as it stands.
    pub(super) fn of(document: &Document<'_>, text: &str, options: &ReadOptions) -> Option<Self> {
        let root = Element::root(document, text);
        let is_plain = |child: Element<'_>| match child.owner(root.namespace()) {
            Owner::Format => PLAIN.contains(&child.name()),
            Owner::Xacro => true,
            Owner::Foreign => false,
        };
        if !options.symbolic.is_empty() || !root.elements().all(is_plain) {
            return None;
        }
        let read = Cell::new(0);
        let mechanism = reader::read_open(document, text, options, &read).ok()?;
        let mut skeleton = Self {
            texts: Vec::new(),
            slots: Vec::new(),
            definitions: root
                .elements()
                .filter(|child| child.owner(root.namespace()) == Owner::Xacro)
                .map(|child| child.number())
                .collect(),
            mechanism,
        };
        skeleton.find_slots()?;
        // Others stand elsewhere, or were not taken over as they are.
        (skeleton.slots.len() == read.get()).then_some(skeleton)
    }

    fn find_slots(&mut self) -> Option<()> {
        let mut known: BTreeMap<&str, usize> = BTreeMap::new();
        for (joint, own) in self.mechanism.joints().iter().enumerate() {
            for (place, number) in own.numbers().into_iter().enumerate() {
                let Some(View::Parameter(text, _)) = number.map(Number::view) else {
                    continue;
                };
                // Lengths have to be positive, and two axes are held against each other.
                let of_two = DIRECTIONS.contains(&place) && own.kind.uses_second_axis();
                if place >= DIRECTIONS.end || of_two {
                    return None;
                }
                let next = known.len();
                let text = *known.entry(text).or_insert(next);
                self.slots.push(Slot { joint, place, text });
            }
        }
        let mut texts = vec![String::new(); known.len()];
        for (text, index) in known {
            texts[index] = text.to_owned();
        }
        self.texts = texts;
        Some(())
    }

    /// The mechanism with these settings, as it is read before its decimals are understood; `None` where it has to be read. `spare` is one that
    /// was made so before, whose memory is used again.
    pub(super) fn mechanism(
        &self,
        document: &Document<'_>,
        text: &str,
        settings: &[(String, String)],
        spare: Option<Mechanism>,
    ) -> Option<Mechanism> {
        let root = Element::root(document, text);
        let numbers = self.definitions.iter();
        let children: Option<Vec<Element<'_>>> = numbers
            .map(|&number| Element::numbered(document, text, number))
            .collect();
        let mut definitions = Definitions::default();
        definitions.read(root, &children?, settings, &[]).ok()?;
        let mut values = Vec::with_capacity(self.texts.len());
        for text in &self.texts {
            let value = number_text::number(text, &mut definitions).ok()?;
            values.push((value.value().abs() <= LARGEST).then_some(value)?);
        }
        let number = |slot: &Slot| Some((slot.joint, slot.place, values.get(slot.text)?.clone()));
        let changes: Option<Vec<_>> = self.slots.iter().map(number).collect();
        let mechanism = spare.unwrap_or_else(|| self.mechanism.clone());
        let mechanism = mechanism.with_joint_numbers(changes?);
        let mut turned = self
            .slots
            .iter()
            .filter(|slot| DIRECTIONS.contains(&slot.place));
        let joints = mechanism.joints();
        let is_one = |slot: &Slot| {
            joints
                .get(slot.joint)
                .is_some_and(|own| !own.axis.is_zero())
        };
        turned.all(is_one).then_some(mechanism)
    }
}
