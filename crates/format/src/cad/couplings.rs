//! Gears, racks and screws: equations between what bears the two parts.
//!
//! A CAD program states them for two frames, wherever their parts are; here they couple the joints that bear the parts, seen from one body
//! that bears both. Where there is no such body, or a part is borne otherwise, the joint is named as not read.
//!
//! With `s` the way of the body of I along its slide `u`, `φ` the turn of the body of J about `w`, and `x`, `z` the axes of frame I:
//! a pinion rolls by `x_J + r·θ = const`, so `−(u·x)·s + r·(w·z)·φ = const`; a screw moves by `2π·z_J − p·θ = const`, so
//! `−2π·(u·z)·s − p·(w·z)·φ = const`; gears turn by `r_I·θ_I + r_J·θ_J = const`, each about its own z axis.

use super::{CadJoint, Kind, Maker, Side};
use crate::error::Outcome;
use crate::frames::in_full;
use kutzbach_math::number::Number;
use kutzbach_math::space::dot;

/// Directions count as parallel up to this sine; drawings are precise to 1e-9 and worse.
const PARALLEL: f64 = 1e-6;

/// What rounding leaves of a variable that is drawn at zero, of the size of the coordinates that it was computed from: some dozen products.
const ROUNDED: f64 = 64.0 * f64::EPSILON;

/// A joint that bears a part: its index, and whether its variable grows with the part's motion along its axis.
#[derive(Clone, Copy)]
struct Bearing {
    mover: usize,
    sign: f64,
    /// The body on its other side.
    carrier: usize,
}

impl Maker<'_> {
    /// Reads a joint that couples others.
    pub(super) fn couple(&mut self, joint: &CadJoint, all: &[CadJoint]) -> Outcome<()> {
        let (slides, factors): ([bool; 2], _) = match &joint.kind {
            Kind::Rack(radius) => ([true, false], [Number::one(), radius.clone()]),
            Kind::Screw(lead) => {
                if super::joints::cylinder_beside(joint, all) {
                    return Ok(());
                }
                let turn = &Number::pi() * &Number::integer(2);
                ([true, false], [turn, -lead.clone()])
            }
            Kind::Gears([one, other]) => ([false, false], [one.clone(), other.clone()]),
            _ => return Ok(()),
        };
        // A rack and a screw may name their two parts in either order: what slides is I.
        let mut sides = joint.sides.clone();
        let of_sides = |sides: &[Side; 2]| sides.each_ref().map(|side| side.part);
        let mut bearings = self.bearings(of_sides(&sides), slides);
        if bearings.is_none() {
            sides.reverse();
            bearings = self.bearings(of_sides(&sides), slides);
        }
        let Some(bearings) = bearings else {
            let why = match slides[0] {
                true => "no single slide and single hinge on one body bear its two parts",
                false => "no single hinges on one body bear its two parts",
            };
            self.not_read(joint, why);
            return Ok(());
        };
        let frames = self.drawn(&sides).frames;
        // Along x for a rack, along z otherwise; each gear about its own axis.
        let first = match joint.kind {
            Kind::Rack(_) => [1.0, 0.0, 0.0],
            _ => [0.0, 0.0, 1.0],
        };
        let second = match slides[0] {
            true => frames[0].rotate(&[0.0, 0.0, 1.0]),
            false => frames[1].rotate(&[0.0, 0.0, 1.0]),
        };
        let ways = [frames[0].rotate(&first), second];
        let mut terms = Vec::new();
        let (mut offset, mut rounding) = (0.0, 0.0);
        for i in 0..2 {
            let Bearing { mover, sign, .. } = bearings[i];
            let mover = &self.movers[mover];
            let along = dot(&mover.axis, &ways[i]);
            if (along.abs() - 1.0).abs() > PARALLEL {
                let name = mover.name.clone();
                self.not_read(joint, &format!("its axis is not that of `{name}`"));
                return Ok(());
            }
            // I is seen to move against what its body does.
            let seen = if slides[i] { -1.0 } else { 1.0 };
            let factor = match along * sign * seen > 0.0 {
                true => factors[i].clone(),
                false => -factors[i].clone(),
            };
            offset += factor.value() * mover.home;
            rounding += ROUNDED * (factor.value() * mover.size).abs();
            terms.push((mover.name.clone(), factor));
        }
        if terms[0].0 == terms[1].0 {
            self.not_read(joint, "both parts are one body");
            return Ok(());
        }
        let name = self.take_name(&joint.name);
        self.places.insert(name.clone(), joint.range.clone());
        let offset = match offset.abs() <= rounding {
            true => Number::zero(),
            false => in_full(offset),
        };
        self.builder.linear_coupling(&name, terms, offset);
        Ok(())
    }

    /// The joints that bear two parts on one body, sliding or turning as asked for: the only such pair.
    fn bearings(&self, parts: [usize; 2], slides: [bool; 2]) -> Option<[Bearing; 2]> {
        let [one, other] = [0, 1].map(|i| self.bearing(parts[i], slides[i]));
        let mut pairs = Vec::new();
        for a in &one {
            for b in &other {
                if a.carrier == b.carrier && a.mover != b.mover {
                    pairs.push([*a, *b]);
                }
            }
        }
        match pairs[..] {
            [pair] => Some(pair),
            _ => None,
        }
    }

    fn bearing(&self, part: usize, slides: bool) -> Vec<Bearing> {
        let own = self.body_of(part);
        let mut found = Vec::new();
        for (mover, joint) in self.movers.iter().enumerate() {
            let [from, to] = joint.parts.map(|part| self.body_of(part));
            if joint.turns == slides || from == to {
                continue;
            }
            let (sign, carrier) = match (from == own, to == own) {
                (false, true) => (1.0, from),
                (true, false) => (-1.0, to),
                _ => continue,
            };
            found.push(Bearing {
                mover,
                sign,
                carrier,
            });
        }
        found
    }
}
