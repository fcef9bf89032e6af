//! The numbers of a part that may be others than they are written, and a geometry that follows them.

use kutzbach_closure::{Geometry, JointNumbers, JointState, Part};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Joint, JointId, Mechanism, Precision};

/// Files of two decimals hold chosen numbers, unless they do not close: then they are rounded like others.
pub(super) const ROUNDED_DECIMALS: i32 = 2;

/// One number that may change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Dimension {
    /// Joint index.
    pub joint: usize,
    /// Place in [`Joint::numbers`].
    pub place: usize,
    /// How far the number meant may be from the one written (m, rad).
    pub unit: f64,
}

/// Whether the number at a place of [`Joint::numbers`] is an angle or a component of a direction, and no length.
pub(super) fn turns(place: usize) -> bool {
    (3..6).contains(&place) || (9..18).contains(&place)
}

/// The numbers of a part that are uncertain, in units of their uncertainty.
pub(super) struct Dimensions<'a> {
    mechanism: &'a Mechanism,
    /// In the order of joints and places.
    pub all: Vec<Dimension>,
    written: Vec<JointNumbers>,
}

impl<'a> Dimensions<'a> {
    /// Those of a part, each known to the precision of its joint's sub-mechanism.
    pub fn of(mechanism: &'a Mechanism, part: &Part) -> Self {
        Self::by(mechanism, part, |joint, place, number| {
            let precision = rounding(mechanism, joint);
            precision.map_or(0.0, |precision| precision.uncertainty(place, number))
        })
    }

    /// Those of a part, each literal and what was worked out from some known to so much (m, rad).
    pub fn known_to(mechanism: &'a Mechanism, part: &Part, unit: f64) -> Self {
        let is_literal = |number: &Number| number.stated().is_some();
        Self::by(mechanism, part, |_, _, number| {
            match is_literal(number) || !number.inputs().is_empty() {
                true => unit,
                false => 0.0,
            }
        })
    }

    /// The same numbers, in units that mean one distance: so much for lengths (m), and for angles what moves a point at the part's
    /// `length` by it.
    pub fn alike(&self, unit: f64, length: f64) -> Self {
        let all = self.all.iter().map(|dimension| Dimension {
            unit: match turns(dimension.place) {
                true => unit / length,
                false => unit,
            },
            ..*dimension
        });
        Self {
            mechanism: self.mechanism,
            all: all.collect(),
            written: self.written.clone(),
        }
    }

    /// How far changes of so many units move points at most (m), angles counted at a part's length.
    pub fn distance(&self, z: &[f64], length: f64) -> f64 {
        let moved = |(dimension, z): (&Dimension, &f64)| {
            let change = (z * dimension.unit).abs();
            match turns(dimension.place) {
                true => change * length,
                false => change,
            }
        };
        self.all.iter().zip(z).map(moved).fold(0.0, f64::max)
    }

    fn by(
        mechanism: &'a Mechanism,
        part: &Part,
        unit: impl Fn(usize, usize, &Number) -> f64,
    ) -> Self {
        let mut all = Vec::new();
        for &joint in &part.joints {
            for (place, number) in mechanism.joints()[joint].numbers().into_iter().enumerate() {
                let unit = number.map_or(0.0, |number| unit(joint, place, number));
                if unit > 0.0 {
                    all.push(Dimension { joint, place, unit });
                }
            }
        }
        let written = mechanism.joints().iter().map(JointNumbers::of).collect();
        Self {
            mechanism,
            all,
            written,
        }
    }

    /// The units (rad, or shares of a length).
    fn shares(&self, length: f64) -> impl Iterator<Item = f64> {
        self.all.iter().map(move |d| match turns(d.place) {
            true => d.unit,
            false => d.unit / length,
        })
    }

    /// The largest unit (rad, or shares of a length).
    pub fn coarsest(&self, length: f64) -> f64 {
        self.shares(length).fold(0.0, f64::max)
    }

    /// About how far the equations may be from those meant, relative to their own size.
    pub fn noise(&self, length: f64) -> f64 {
        let squares: f64 = self.shares(length).map(|share| share.powi(2)).sum();
        squares.sqrt().max(f64::EPSILON)
    }

    /// The numbers of one joint where the dimensions are changed by `z` of their units.
    pub fn numbers(&self, joint: usize, z: &[f64]) -> JointNumbers {
        let mut numbers = self.written[joint].clone();
        for (dimension, z) in self.all.iter().zip(z) {
            if dimension.joint == joint {
                numbers.0[dimension.place] += z * dimension.unit;
            }
        }
        numbers
    }

    /// Gives one joint its changed numbers; `states` are taken over where it stands.
    pub fn set<'s>(
        &self,
        geometry: &mut Geometry<f64>,
        joint: usize,
        numbers: &JointNumbers,
        states: impl IntoIterator<Item = &'s mut JointState<f64>>,
    ) {
        let before = geometry.displacements[joint].clone();
        geometry.set_joint(joint, self.joint(joint), numbers);
        for state in states {
            *state = geometry.displacements[joint].adopt(&before, state);
        }
    }

    fn joint(&self, joint: usize) -> &Joint {
        &self.mechanism.joints()[joint]
    }

    /// The changed numbers as a file would have them: (joint, place, number).
    pub fn changes(&self, z: &[f64]) -> Vec<(usize, usize, Number)> {
        let mut changes = Vec::new();
        for (dimension, z) in self.all.iter().zip(z) {
            let Dimension { joint, place, unit } = *dimension;
            let value = self.written[joint].0[place] + z * unit;
            if let Ok(number) = Number::decimal(&value.to_string()) {
                changes.push((joint, place, number));
            }
        }
        changes
    }
}

/// The precision at which the numbers of a joint's sub-mechanism are rounded; `None` where they are exact, or printed doubles.
pub(super) fn rounding(mechanism: &Mechanism, joint: usize) -> Option<Precision> {
    let precision = *mechanism.precision_of(JointId(joint));
    if precision.is_of_doubles() {
        return None;
    }
    if !precision.is_exact() {
        return Some(precision);
    }
    let decimals = precision.decimals.filter(|d| *d >= ROUNDED_DECIMALS)?;
    let by_hand = precision.by_hand().is_some();
    (!by_hand).then(|| precision.known_to(0.5 * 10f64.powi(-decimals)))
}
