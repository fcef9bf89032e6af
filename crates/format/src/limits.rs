//! Joint limits that may not be meant as they are written.
//!
//! - A range of nearly a full turn, such as −3.14 … 3.14, is what exporters write for *none*; where loops have to close, a crank that goes
//!   round is stopped by it.
//! - A hinge's limit that is a whole number beyond a full turn was meant in degrees.
//! - A slide's range far beyond all other lengths was meant in millimetres.

use super::WarningKind;
use super::names::Named;
use super::reader::Reader;
use super::words::listed;
use kutzbach_model::mechanism::{FreedomPart, Joint, Mechanism};
use std::f64::consts::TAU;

/// Ranges this near to a full turn, as a part of it, are taken for one: 3.14, 3.1416 and 3.12 are, 3.0 is a limit.
const NEAR: f64 = 0.01;

/// A slide that goes this far (m), and this many times as far as any joint is from the one before, is none that anybody builds: a mechanism
/// is as large as its slides are long, and millimetres for metres are a thousand times as much.
const FAR: f64 = 20.0;

/// Files with limits of such a kind.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Odd {
    NearlyATurn,
    Degrees,
    Millimetres,
}

impl Odd {
    /// What is odd about a joint's range; `longest` is the longest distance that the file states.
    fn of(joint: &Joint, longest: f64) -> Option<Self> {
        let (lower, upper) = joint.bounds()?;
        let range = upper - lower;
        let whole = |x: f64| x.fract() == 0.0 && x.abs() <= 360.0;
        match joint.kind.freedoms() {
            [FreedomPart::Rotation] if (range - TAU).abs() <= NEAR * TAU => Some(Self::NearlyATurn),
            [FreedomPart::Rotation] if lower.abs().max(upper.abs()) > TAU => {
                (whole(lower) && whole(upper)).then_some(Self::Degrees)
            }
            [FreedomPart::Translation] if range.is_finite() => {
                (range >= FAR && range > FAR * longest).then_some(Self::Millimetres)
            }
            _ => None,
        }
    }
}

impl Reader<'_> {
    /// Tells of limits that may not be meant.
    pub(super) fn warn_of_limits(&mut self, mechanism: &Mechanism) {
        let joints = mechanism.joints();
        let sides = joints.iter().flat_map(|j| [&j.predecessor, &j.successor]);
        let lengths = sides.flat_map(|side| &side.frame.position);
        let longest = lengths.fold(0.0f64, |most, x| most.max(x.value().abs()));
        let closes = joints.iter().any(|joint| joint.closes_loop);
        let told = |odd: Odd| odd != Odd::NearlyATurn || closes;
        for odd in [Odd::NearlyATurn, Odd::Degrees, Odd::Millimetres] {
            let such = |joint: &&Joint| Odd::of(joint, longest) == Some(odd);
            let such: Vec<&Joint> = joints.iter().filter(such).filter(|_| told(odd)).collect();
            let Some(first) = such.first() else { continue };
            let names: Vec<&str> = such.iter().map(|joint| joint.name.as_str()).collect();
            let names = listed(&names);
            let (lower, upper) = first.bounds().unwrap_or_default();
            let message = match odd {
                Odd::NearlyATurn => format!(
                    "the limits of {names} are nearly a full turn ({lower} … {upper} rad) and are taken as limits; where none is meant, leave `lower` and `upper` out"
                ),
                Odd::Degrees => format!(
                    "the limits of {names} look like degrees and are read as {lower} … {upper} rad; for degrees write ${{{upper}*pi/180}}"
                ),
                Odd::Millimetres => format!(
                    "the limits of {names} look like millimetres and are read as {lower} … {upper} m; write metres"
                ),
            };
            let place = self.directory.place(Named::Joint, &first.name);
            let at = place.map_or(0, |place| place.start);
            self.warn_of(at, WarningKind::Guessed, message);
        }
    }
}
