//! `<keyframe>`: named poses.
//!
//! `qpos` of a key has the coordinates of all joints in the order of the file; hinges in radians whatever the compiler says. A configuration holds
//! its joints and lets the others follow. So without equalities it takes every hinge and every slide, and with them the joints that a
//! motor drives: the others follow from these, and their rounded values would contradict the loops.

use super::Mjcf;
use super::pose::numbers;
use crate::element::Element;
use crate::error::Outcome;
use crate::names::unused;
use crate::words::counted;
use kutzbach_math::number::Number;

/// What of a key is no pose.
const BESIDE_POSES: [&str; 5] = ["qvel", "act", "ctrl", "mpos", "mquat"];

/// The numbers of one joint in `qpos`.
pub(super) struct Coordinate {
    pub(super) joint: String,
    /// 1 of hinges and slides, 4 of balls, 7 of what floats.
    pub(super) width: usize,
    /// The value as drawn.
    pub(super) zero: Number,
    /// Whether an equality holds the joint as drawn.
    pub(super) is_held: bool,
}

impl<'a> Mjcf<'a> {
    /// Makes configurations of all keys.
    pub(super) fn keys(&mut self, keyframe: Element<'a>, root: Element<'a>) -> Outcome<()> {
        let equalities = root.elements().filter(|part| part.name() == "equality");
        let mut is_tied = false;
        for part in equalities.flat_map(|section| section.elements()) {
            is_tied |= self.is_active(part)?;
        }
        for key in keyframe.elements() {
            match key.name() {
                "key" => self.key(key, is_tied),
                _ => self.unread.element(key),
            }
        }
        Ok(())
    }

    fn key(&mut self, key: Element<'a>, is_tied: bool) {
        for name in BESIDE_POSES {
            if let Some(says) = key.attribute(name) {
                let what = format!("`{name}` of <key>");
                self.unread.standard_text(says.range().start, what);
            }
        }
        let Some(says) = key.attribute("qpos") else {
            self.unread
                .standard_text(key.start(), "<key> without `qpos`".to_owned());
            return;
        };
        let all: usize = self.coordinates.iter().map(|own| own.width).sum();
        // A pose says nothing of how the mechanism can move, and is no reason to refuse it.
        let values = match numbers(says) {
            Ok(values) if values.len() == all => values,
            Ok(values) => {
                let found = counted(values.len(), "number");
                let what = format!("<key> with {found} in `qpos`, where the joints have {all}");
                self.unread.text(key.start(), what);
                return;
            }
            Err(fault) => {
                let what = format!("<key>: {}", fault.message);
                self.unread.text(key.start(), what);
                return;
            }
        };
        let mut positions = Vec::new();
        let (mut is_against, mut leaves_out) = (false, false);
        let mut rest = values.into_iter();
        for coordinate in &self.coordinates {
            let own: Vec<Number> = rest.by_ref().take(coordinate.width).collect();
            let [value] = &own[..] else {
                leaves_out = true;
                continue;
            };
            let value = match coordinate.zero.is_zero() {
                true => value.clone(),
                false => value - &coordinate.zero,
            };
            if coordinate.is_held {
                is_against |= !value.is_zero();
            } else if !is_tied || self.driven.contains(coordinate.joint.as_str()) {
                positions.push((coordinate.joint.clone(), vec![value]));
            }
        }
        let mut told = |what: &str| self.unread.standard_text(key.start(), what.to_owned());
        if is_against {
            told("<key> that moves a joint which an equality holds");
            return;
        }
        if positions.is_empty() {
            told(match is_tied {
                true => "<key> of a mechanism with equalities and without motors",
                false => "<key> without a value of a hinge or a slide",
            });
            return;
        }
        if leaves_out {
            told("values of balls and floating bodies in <key>");
        }
        let name = self.name_of_key(key);
        self.builder.configuration(&name, positions);
    }

    /// The name of a key, or one that none has.
    fn name_of_key(&mut self, key: Element<'a>) -> String {
        let own = key.attribute("name").map(|own| own.value);
        // Two keys of one name are an error, which the builder tells.
        let name = match own {
            Some(own) => own.to_owned(),
            None => unused("key", |name| self.key_names.contains(name)),
        };
        self.key_names.insert(name.clone());
        name
    }
}
