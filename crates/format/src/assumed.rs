//! What a file leaves out or writes so short that it may not be meant: told, since the answer hangs on it.
//!
//! - A joint without `<axis>` moves along or about x, as URDF says; a direction `axis2` that is left out is x too.
//! - `1.57` in `rpy` is 1.57 rad, two decimals being what a designer writes; where loops have to close, π/2 may have been meant. Told of
//!   two and three decimals, which no reading of constants recognises, and only where the file closes a loop.
//! - `90` in `rpy` is 90 rad: a whole number beyond a full turn was meant in degrees.
//! - A `<limit>` without bounds is 0…0 in URDF, by which the joint could not move; one bound left out beside the other is 0.
//! - A joint that is named as if it closed a loop, in a file that closes none: some exporters leave the loop to other tools.

use super::WarningKind;
use super::element::{Attribute, Element};
use super::reader::Reader;
use super::words::listed;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Direction, JointKind, Limit};
use std::f64::consts::{FRAC_PI_4, TAU};

/// What joints are without, and which ones.
#[derive(Default)]
pub(super) struct Assumed<'a> {
    no_axis: Vec<(usize, &'a str)>,
    no_axis2: Vec<(usize, &'a str)>,
    no_bounds: Vec<(usize, &'a str)>,
    no_lower: Vec<(usize, &'a str)>,
    no_upper: Vec<(usize, &'a str)>,
    one_bound: Vec<(usize, &'a str)>,
    /// Angles that look like others: where they stand, what is written, and what it looks like.
    angles: Vec<(usize, String, &'static str)>,
    /// Angles that look like degrees.
    degrees: Vec<(usize, String)>,
}

/// What is wrong with a universal joint whose axes are parallel: the body between them turns idly, and the joint is a hinge.
pub(super) const ONE_AXIS: &str = "its two axes are parallel, so that it turns about one only";

/// Multiples of a quarter of π by number.
const QUARTERS: [&str; 9] = [
    "0", "pi/4", "pi/2", "3*pi/4", "pi", "5*pi/4", "3*pi/2", "7*pi/4", "2*pi",
];

impl<'a> Reader<'a> {
    /// Notes which of its axes a joint leaves out, and refuses two axes of a universal joint that are one.
    pub(super) fn note_axes(
        &mut self,
        (at, name): (usize, &'a str),
        kind: JointKind,
        axes: [Option<&Direction>; 2],
    ) -> Result<(), &'static str> {
        let [axis, axis2] = axes;
        if kind.uses_axis() && axis.is_none() {
            self.assumed.no_axis.push((at, name));
        }
        if kind.uses_second_axis() && axis2.is_none() {
            self.assumed.no_axis2.push((at, name));
        }
        let x = Direction::x();
        let parallel =
            kind == JointKind::Universal && are_parallel(axis.unwrap_or(&x), axis2.unwrap_or(&x));
        match (parallel, axis2) {
            (false, _) => Ok(()),
            (true, Some(_)) => Err(ONE_AXIS),
            (true, None) => Err("without <axis2> its two axes are parallel, both x"),
        }
    }

    /// What a `<limit>` of URDF leaves out: a bound is 0 beside the other one, as URDF says before version 1.2, where that leaves a
    /// range; of two that are left out, 0…0 would lock the joint, and it counts as free. Both are noted.
    pub(super) fn assume_bounds(&mut self, element: Element<'a>, name: &'a str, limit: &mut Limit) {
        let noted = (element.start(), name);
        let stated = ["lower", "upper"].map(|bound| element.has_any(&[bound]));
        let before_1_2 = self.version() < (1, 2);
        match (stated, &limit.lower, &limit.upper) {
            ([false, false], ..) => self.assumed.no_bounds.push(noted),
            ([true, false], Some(lower), None) if before_1_2 && lower.value() < 0.0 => {
                limit.upper = Some(Number::zero());
                self.assumed.no_upper.push(noted);
            }
            ([false, true], None, Some(upper)) if before_1_2 && upper.value() > 0.0 => {
                limit.lower = Some(Number::zero());
                self.assumed.no_lower.push(noted);
            }
            ([true, false] | [false, true], ..) => self.assumed.one_bound.push(noted),
            ([true, true], ..) => {}
        }
    }

    /// Notes what in the attribute `rpy` of a joint looks like a rounded angle.
    pub(super) fn note_angles(&mut self, rpy: Attribute<'a>) {
        for token in rpy.value.split_ascii_whitespace() {
            if let Some((written, meant)) = looks_like(token) {
                let angle = (rpy.range().start, written.to_owned(), meant);
                self.assumed.angles.push(angle);
            } else if looks_like_degrees(token) {
                let degrees = (rpy.range().start, token.to_owned());
                self.assumed.degrees.push(degrees);
            }
        }
    }

    /// Tells what was noted; `literal` says that numbers are meant as they are written.
    pub(super) fn tell_assumed(&mut self, literal: bool) {
        let assumed = std::mem::take(&mut self.assumed);
        let closes = self.other_closures || !self.in_gazebo.is_empty();
        self.tell_of(&assumed.no_axis, |names, has| {
            format!("{names} {has} no <axis>: x is taken, as URDF says")
        });
        self.tell_of(&assumed.no_axis2, |names, has| {
            format!("{names} {has} no <axis2>: x is taken")
        });
        let bounds = match self.version() < (1, 2) {
            true => "which is 0…0 in URDF: by that no joint can move",
            // As urdfdom 6.0.0 and urdf-rs 0.10.0 do.
            false => "which some readers of URDF 1.2 refuse, and others take as none",
        };
        self.tell_of(&assumed.no_bounds, |names, has| {
            format!("{names} {has} a <limit> without `lower` and `upper`, {bounds}, here each counts as free")
        });
        for (joints, left_out) in [(&assumed.no_lower, "lower"), (&assumed.no_upper, "upper")] {
            self.tell_of(joints, |names, has| {
                format!("{names} {has} a <limit> without `{left_out}`: it is 0, as URDF says; some readers take no limit on that side")
            });
        }
        self.tell_of(&assumed.one_bound, |names, has| {
            format!("{names} {has} a <limit> with one bound only: the other side is free, where some readers take 0")
        });
        for (at, written, meant) in assumed.angles.into_iter().filter(|_| closes && !literal) {
            let message = format!(
                "`{written}` in `rpy` looks like ${{{meant}}} and is read as {written} rad; write what is meant, or more digits"
            );
            self.warn_of(at, WarningKind::Guessed, message);
        }
        for (at, written) in assumed.degrees {
            let message = format!(
                "`{written}` in `rpy` looks like degrees and is read as {written} rad; for degrees write ${{{written}*pi/180}}"
            );
            self.warn_of(at, WarningKind::Guessed, message);
        }
        if !closes && !self.closing_frames_told {
            let announced: Vec<(usize, &'a str)> = self
                .directory
                .joint_names()
                .filter(|(name, _)| announces_a_loop(name))
                .map(|(name, place)| (place.start, name))
                .collect();
            // Gepetto's robots state their loops in YAML beside the URDF.
            let of_two_files = |(_, name): &(usize, &str)| in_two_files(name);
            let beside = match announced.iter().any(of_two_files) {
                true => "; YAML beside it that has `closed_loop` is read together with it",
                false => "",
            };
            self.tell_of(&announced, |names, has| {
                format!("{names} {has} the name of what closes a loop, and the file states none: it is read as a tree{beside}")
            });
        }
    }

    fn tell_of(&mut self, joints: &[(usize, &'a str)], told: impl Fn(&str, &str) -> String) {
        let Some(&(at, _)) = joints.first() else {
            return;
        };
        let names: Vec<&str> = joints.iter().map(|(_, name)| *name).collect();
        let has = if names.len() == 1 { "has" } else { "have" };
        self.warn_of(at, WarningKind::Guessed, told(&listed(&names), has));
    }
}

/// The literal without sign and the multiple of a quarter of π that it is a rounding of, to two or three decimals.
fn looks_like(token: &str) -> Option<(&str, &'static str)> {
    let size = token.trim_start_matches(['-', '+']);
    let bare = size.trim_end_matches('0');
    let (_, decimals) = bare.split_once('.')?;
    let half_a_unit = match decimals.len() {
        2 => 0.5e-2,
        3 => 0.5e-3,
        _ => return None,
    };
    let value: f64 = bare.parse().ok()?;
    let quarters = (value / FRAC_PI_4).round();
    let near = (value - quarters * FRAC_PI_4).abs() <= half_a_unit;
    let meant = QUARTERS
        .get(quarters as usize)
        .filter(|_| quarters >= 1.0)?;
    near.then_some((bare, *meant))
}

/// A whole number in plain digits, beyond a full turn in radians.
fn looks_like_degrees(token: &str) -> bool {
    let plain = token.trim_start_matches(['-', '+']);
    let value: u32 = plain.parse().unwrap_or(0);
    f64::from(value) > TAU && value <= 360
}

fn announces_a_loop(name: &str) -> bool {
    let small = name.to_lowercase();
    ["closing_", "loop_", "closed_loop"]
        .iter()
        .any(|start| small.starts_with(start))
        || small.ends_with("_closure")
        || in_two_files(name)
}

/// Whether a joint is called as Gepetto's loader expects of those that close loops, which the URDF has no word for.
fn in_two_files(name: &str) -> bool {
    let name = name.to_lowercase();
    name.starts_with("closedloop") || name.starts_with("fermeture")
}

/// Whether two directions are parallel or opposed, exactly.
pub(super) fn are_parallel(Direction(a): &Direction, Direction(b): &Direction) -> bool {
    let minor = |i: usize, j: usize| -> Number { &(&a[i] * &b[j]) - &(&a[j] * &b[i]) };
    // Values are rounded once, products once more, and their difference: where it is longer than that, exact arithmetic is not asked;
    // nor are doubles of products that are no normal ones.
    let differs = |i: usize, j: usize| {
        let [one, other] = [(i, j), (j, i)].map(|(i, j)| a[i].value() * b[j].value());
        let size = one.abs() + other.abs();
        size > f64::MIN_POSITIVE / f64::EPSILON && (one - other).abs() > 8.0 * f64::EPSILON * size
    };
    let minors = [(0, 1), (1, 2), (2, 0)];
    !minors.into_iter().any(|(i, j)| differs(i, j))
        && minors.into_iter().all(|(i, j)| minor(i, j).is_zero())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roundings_of_quarter_turns_are_recognised() {
        for (token, meant) in [
            ("1.57", "pi/2"),
            ("-1.57", "pi/2"),
            ("1.570000", "pi/2"),
            ("1.571", "pi/2"),
            ("3.14", "pi"),
            ("3.142", "pi"),
            ("0.79", "pi/4"),
            (".785", "pi/4"),
            ("2.36", "3*pi/4"),
            ("6.28", "2*pi"),
        ] {
            assert_eq!(
                looks_like(token).map(|found| found.1),
                Some(meant),
                "{token}"
            );
        }
        for token in [
            "0", "0.00", "1.5708", "1.56", "1.572", "1.6", "3.15", "0.78", "12.57", "${pi/2}",
            "x.57", "1.5",
        ] {
            assert_eq!(looks_like(token), None, "{token}");
        }
    }
}
