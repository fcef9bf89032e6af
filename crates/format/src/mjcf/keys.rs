//! `<keyframe>`: named poses.
//!
//! `qpos` of a key has the coordinates of all joints in the order of the file; hinges in radians whatever the compiler says. Without equalities
//! a configuration holds every hinge and every slide. With them the values, which are rounded, would contradict the loops: they are where
//! assembly begins, balls included.
//!
//! A key of an attached file has the coordinates of that file, of which not all may be there; all other joints stay where they are drawn. So it is in
//! every copy of what a `<replicate>` attaches, but for the first one.

use super::Mjcf;
use super::classes::ATTACHED;
use super::pose::numbers;
use crate::element::{Attribute, Element};
use crate::error::Outcome;
use crate::frames::in_full;
use crate::names::unused;
use crate::words::counted;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::Frame;
use std::rc::Rc;

/// What of a key is no pose.
pub(super) const BESIDE_POSES: [&str; 5] = ["qvel", "act", "ctrl", "mpos", "mquat"];

/// Attributes of a key that was attached: how many coordinates its file has, and the places of those that are here.
pub(super) const OF_ALL: &str = "attached_of";
pub(super) const TAKEN: &str = "attached_taken";

/// The numbers of one joint in `qpos`.
pub(super) struct Coordinate<'a> {
    pub(super) joint: String,
    /// 1 of hinges and slides, 4 of balls, 7 of what floats.
    pub(super) width: usize,
    /// The value as drawn.
    pub(super) zero: Number,
    /// The joint's frame in its body.
    pub(super) frame: Frame,
    /// Whether an equality holds the joint as drawn.
    pub(super) is_held: bool,
    /// What marks the attachments that it came with.
    pub(super) within: Rc<[&'a str]>,
}

/// What `qpos` of a key gives the joints of an attachment, by the numbers that it has in all, and which of them are for joints that are here.
struct Partial<'a> {
    mark: &'a str,
    all: usize,
    taken: Vec<usize>,
}

impl<'a> Partial<'a> {
    fn of(key: Element<'a>) -> Option<Self> {
        let taken = key.attribute(TAKEN)?.value.split_ascii_whitespace();
        Some(Self {
            mark: key.attribute(ATTACHED)?.value,
            all: key.attribute(OF_ALL)?.value.parse().ok()?,
            taken: taken.filter_map(|index| index.parse().ok()).collect(),
        })
    }
}

impl Coordinate<'_> {
    /// A value from the pose drawn on.
    fn since_drawn(&self, value: &Number) -> Number {
        match self.zero.is_zero() {
            true => value.clone(),
            false => value - &self.zero,
        }
    }

    /// The turn of a ball as a rotation vector (rad) in the joint's frame. The quaternion, the real part first, is in the body's frame and of
    /// any length; that of length 0 is no turn, as in MuJoCo.
    fn rotation_vector(&self, quaternion: [&Number; 4]) -> Vec<Number> {
        let [w, x, y, z] = quaternion.map(Number::value);
        // q and −q are one turn; the shorter way round has a real part that is not negative.
        let sign = if w < 0.0 { -1.0 } else { 1.0 };
        let sine = x.hypot(y).hypot(z);
        let angle = 2.0 * sine.atan2(w.abs());
        let scale = if sine > 0.0 { sign * angle / sine } else { 0.0 };
        let vector = self
            .frame
            .to_doubles()
            .rotate_back(&[x * scale, y * scale, z * scale]);
        vector.map(in_full).to_vec()
    }
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
        let partial = Partial::of(key);
        let Some(values) = self.values_of(key, says, partial.as_ref()) else {
            return;
        };
        let mut positions = Vec::new();
        let (mut is_against, mut leaves_out) = (false, false);
        let mut is_posed = false;
        let mut rest = values.into_iter();
        for coordinate in &self.coordinates {
            let is_here = |partial: &Partial<'a>| coordinate.within.contains(&partial.mark);
            let width = match partial.as_ref().is_none_or(is_here) {
                true => coordinate.width,
                false => 0,
            };
            let own: Vec<Number> = rest.by_ref().take(width).collect();
            is_posed |= !own.is_empty();
            let values = match (&own[..], is_tied) {
                ([], _) if coordinate.width == 1 => vec![Number::zero()],
                ([], true) if coordinate.width == 4 => vec![Number::zero(); 3],
                ([], _) => continue,
                ([value], _) => vec![coordinate.since_drawn(value)],
                ([w, x, y, z], true) => coordinate.rotation_vector([w, x, y, z]),
                _ => {
                    leaves_out = true;
                    continue;
                }
            };
            match coordinate.is_held {
                true => is_against |= !values.iter().all(Number::is_zero),
                false => positions.push((coordinate.joint.clone(), values)),
            }
        }
        let mut told = |what: &str| self.unread.standard_text(key.start(), what.to_owned());
        if is_against {
            told("<key> that moves a joint which an equality holds");
            return;
        }
        if positions.is_empty() || !is_posed {
            told("<key> without a value of a hinge or a slide");
            return;
        }
        if leaves_out {
            told(match is_tied {
                true => "values of floating bodies in <key>",
                false => "values of balls and floating bodies in <key>",
            });
        }
        let name = self.name_of_key(key);
        let (held, starts) = match is_tied {
            true => (Vec::new(), positions),
            false => (positions, Vec::new()),
        };
        self.builder.configuration_with_starts(&name, held, starts);
    }

    /// The numbers of a key for joints that are here.
    fn values_of(
        &mut self,
        key: Element<'a>,
        says: Attribute<'a>,
        partial: Option<&Partial<'a>>,
    ) -> Option<Vec<Number>> {
        let all = match partial {
            Some(partial) => partial.all,
            None => self.coordinates.iter().map(|own| own.width).sum(),
        };
        // A pose says nothing of how the mechanism can move, and is no reason to refuse it.
        let what = match numbers(says) {
            Ok(values) if values.len() == all => {
                return Some(match partial {
                    Some(partial) => {
                        let taken = partial.taken.iter();
                        taken.filter_map(|i| values.get(*i).cloned()).collect()
                    }
                    None => values,
                });
            }
            Ok(values) => {
                let found = counted(values.len(), "number");
                format!("<key> with {found} in `qpos`, where the joints have {all}")
            }
            Err(fault) => format!("<key>: {}", fault.message),
        };
        self.unread.text(key.start(), what);
        None
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
