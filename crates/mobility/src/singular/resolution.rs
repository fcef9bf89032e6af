//! Smallest resolvable angle between branches.
//!
//! Lines that share a direction are a multiple root of the leading form: yᵐ. An error of η in its coefficients, relative to the
//! form, makes it yᵐ = η xᵐ, whose lines go up to η^{1/m} to either side. So an angle below 2 η^{1/m} may be none, and none may
//! be an angle of that size: η counts the rounding, the decimals that the file states, and how closely the pose is known.
//!
//! Which of the two it is, the numbers can decide. Those of at most h bits hold no offset below 2^−h. Of a double line
//! y² = 0 an offset ε in the coefficient of x² makes lines 2 √ε apart, one in the coefficient of xy turns one line by ε. So there
//! is no angle below 2^−h but none; where that is more than can be overlooked, what looks like none is none.

use crate::germ::Germ;
use kutzbach_math::group::Series;

/// How far apart branches have to be to be told apart, at one pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Resolution {
    /// Error of the leading coefficients relative to them.
    pub noise: f64,
    /// The least angle, apart from none, that the numbers can have been written to hold (rad).
    pub least: f64,
}

impl Resolution {
    /// At the pose of a germ, of a part whose longest number has so many bits, or whose numbers may hold anything.
    pub fn of(germ: &Germ, height: usize, anything: bool) -> Self {
        let leading = |equation: &Series| {
            (2..=germ.degree()).find_map(|degree| {
                let squares = equation.of_degree(degree).iter().map(|c| c * c);
                let size = squares.sum::<f64>().sqrt();
                (size > 0.0).then(|| germ.noise(degree) / size)
            })
        };
        let noise = germ.equations().iter().filter_map(leading);
        Self {
            noise: noise.fold(0.0, f64::max),
            least: match anything {
                true => 0.0,
                false => (-(height as f64)).exp2(),
            },
        }
    }

    /// The largest angle among so many lines that may be none (rad).
    pub fn unresolved(&self, lines: usize) -> f64 {
        2.0 * self.noise.powf(1.0 / lines.max(2) as f64)
    }
}
