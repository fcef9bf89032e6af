//! How far a file's numbers may be from the numbers meant.

use super::frame::{Direction, Frame};
use super::joint::Joint;
use super::link::{Link, Placement};
use crate::number::Number;

/// How precisely a file states its geometry.
///
/// A rounded number differs from the number meant by up to half a unit of its last place. Writers round in two manners,
/// to a fixed number of decimals or to a fixed number of significant digits, and both strip trailing zeros. With `D` the
/// most decimals and `S` the most significant digits found in the geometry, a literal `x` with `d` decimals is uncertain by
///
/// ```text
/// u(x) = ½ min(10⁻ᵈ, max(10⁻ᴰ, 10⁻ˢ 10ᵉ)),   10ᵉ⁻¹ ≤ |x| < 10ᵉ
/// ```
///
/// which is right for both manners: the first term wherever no zeros were stripped, the second where they were. Expressions
/// are exact. A file whose numbers all have at most [`Precision::EXACT_DECIMALS`] decimals holds numbers that a designer
/// chose, not rounded ones, and is taken as exact too.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Precision {
    /// Most decimals of any literal in the geometry; `None` where there is no literal.
    pub decimals: Option<i32>,
    /// Most significant digits of any literal in the geometry.
    pub significant: u32,
}

impl Precision {
    /// Up to this many decimals in the whole file, literals are exact.
    pub const EXACT_DECIMALS: i32 = 2;

    /// Whether every number of the geometry is exact.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.decimals.is_none_or(|d| d <= Self::EXACT_DECIMALS)
    }

    /// How far a number of this file may be from the number meant; zero for exact ones.
    #[must_use]
    pub fn uncertainty(&self, number: &Number) -> f64 {
        let (Some(stated), Some(most), false) = (number.stated(), self.decimals, self.is_exact())
        else {
            return 0.0;
        };
        // With s digits of which the last is worth 10⁻ᵈ, the first is worth 10ˢ⁻ᵈ⁻¹: so e = s − d, without a logarithm.
        let written = i64::from(stated.significant);
        let by_digits = if written > 0 {
            power_of_ten(written - i64::from(stated.decimals) - i64::from(self.significant))
        } else {
            0.0
        };
        let by_decimals = power_of_ten(-i64::from(most));
        0.5 * power_of_ten(-i64::from(stated.decimals)).min(by_decimals.max(by_digits))
    }

    /// The precision of a mechanism's links and joints.
    pub(super) fn of(links: &[Link], joints: &[Joint]) -> Self {
        let mut precision = Self::default();
        let mut read = |number: &Number| {
            if let Some(stated) = number.stated() {
                let most = precision.decimals.unwrap_or(stated.decimals);
                precision.decimals = Some(most.max(stated.decimals));
                precision.significant = precision.significant.max(stated.significant);
            }
        };
        let mut read_frame = |frame: &Frame| {
            frame
                .position
                .iter()
                .chain(&frame.roll_pitch_yaw)
                .for_each(&mut read);
        };
        for link in links {
            if let Placement::Floating { origin, .. } = &link.placement {
                read_frame(origin);
            }
        }
        for joint in joints {
            read_frame(&joint.predecessor.frame);
            read_frame(&joint.successor.frame);
        }
        for joint in joints {
            let Direction(axis) = &joint.axis;
            let Direction(axis2) = &joint.axis2;
            axis.iter().chain(axis2).for_each(&mut read);
            joint.lead.iter().chain(&joint.distance).for_each(&mut read);
        }
        precision
    }
}

/// Zero and infinity where the power is out of range.
fn power_of_ten(exponent: i64) -> f64 {
    const BEYOND: i64 = 400;
    10f64.powi(exponent.clamp(-BEYOND, BEYOND) as i32)
}
