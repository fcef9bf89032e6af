//! Couplings as equations between joint variables in an arithmetic.

use super::displacement::JointState;
use super::geometry::Arithmetic;
use kutzbach_math::matrix::Real;
use kutzbach_model::mechanism::Coupling;

/// What a joint of one freedom gives to a coupling: a polynomial in its variable (rad, m).
#[derive(Clone, Debug, PartialEq)]
pub struct CouplingShare<R> {
    /// Its index in the mechanism.
    pub joint: usize,
    /// Factors of the variable, its square, and so on; at least one.
    pub coefficients: Vec<R>,
}

/// The equation `Σ share = offset`.
#[derive(Clone, Debug, PartialEq)]
pub struct CouplingEquation<R> {
    /// Left side; no joint appears twice.
    pub shares: Vec<CouplingShare<R>>,
    /// Right side (rad, m).
    pub offset: R,
}

impl<R: Real> CouplingShare<R> {
    /// The share at a value of the variable, then its Taylor coefficients about that value: slope, half the second derivative, and so on,
    /// as many as there are [`coefficients`](Self::coefficients).
    #[must_use]
    pub fn taylor(&self, at: &R) -> Vec<R> {
        let mut own = Vec::with_capacity(self.coefficients.len() + 1);
        own.push(at.zero_like());
        own.extend(self.coefficients.iter().cloned());
        // Synthetic division by (variable − at), again and again, leaves them as remainders.
        for first in 0..own.len() {
            for power in (first..own.len() - 1).rev() {
                own[power] = own[power].clone() + own[power + 1].clone() * at.clone();
            }
        }
        own
    }
}

impl<R: Real> CouplingEquation<R> {
    /// A mechanism's coupling in an arithmetic.
    pub fn of(coupling: &Coupling, arithmetic: &Arithmetic<R>) -> Self {
        let share = coupling.terms.iter().map(|term| CouplingShare {
            joint: term.joint.0,
            coefficients: term.factors().map(|x| arithmetic.number(x)).collect(),
        });
        Self {
            shares: share.collect(),
            offset: arithmetic.number(&coupling.offset),
        }
    }

    /// The joints that it speaks of.
    pub fn joints(&self) -> impl Iterator<Item = usize> {
        self.shares.iter().map(|share| share.joint)
    }

    /// Whether no variable has a power above the first.
    #[must_use]
    pub fn is_linear(&self) -> bool {
        self.shares
            .iter()
            .all(|share| share.coefficients.len() == 1)
    }

    /// By how much the left side exceeds the right one where joints have these states, and every share's [`CouplingShare::taylor`] there
    /// without its value.
    #[must_use]
    pub fn at(&self, states: &[JointState<R>]) -> (R, Vec<Vec<R>>) {
        let mut value = -self.offset.clone();
        let mut slopes = Vec::with_capacity(self.shares.len());
        for share in &self.shares {
            let here = states[share.joint].values.first().cloned();
            let mut taylor = share.taylor(&here.unwrap_or_else(|| self.offset.zero_like()));
            value = value + taylor.remove(0);
            slopes.push(taylor);
        }
        (value, slopes)
    }

    /// The length of all factors together, for joints' variables in these units (radians or metres), so that a gear of ratio 1000 weighs as
    /// much as one of ratio 1; one where there are none. It is the same at every pose.
    pub fn norm(&self, unit: impl Fn(usize) -> f64) -> R {
        let one = self.offset.constant(1.0);
        let factors = self.shares.iter().flat_map(|share| {
            let unit = one.constant(unit(share.joint));
            let powers = share.coefficients.iter();
            powers.scan(one.clone(), move |power, factor| {
                *power = power.clone() * unit.clone();
                Some(factor.clone() * power.clone())
            })
        });
        let norm = one.norm(&factors.collect::<Vec<R>>());
        if norm.is_zero() { one } else { norm }
    }

    /// The joints with the slopes of their shares where they have these states.
    #[must_use]
    pub fn slopes(&self, states: &[JointState<R>]) -> Vec<(usize, R)> {
        let (_, taylor) = self.at(states);
        let slopes = taylor.into_iter().map(|mut own| own.swap_remove(0));
        self.joints().zip(slopes).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_is_developed_about_any_value() {
        let share = CouplingShare {
            joint: 0,
            coefficients: vec![-1.0, 0.5, 0.0, 2.0],
        };
        let value = |x: f64| -x + 0.5 * x * x + 2.0 * x.powi(4);
        let at = 0.75;
        let taylor = share.taylor(&at);
        assert_eq!(taylor.len(), 5);
        for step in [-0.5, 0.0, 0.125, 1.0] {
            let sum = taylor.iter().rev().fold(0.0, |sum, c| sum * step + c);
            assert!((sum - value(at + step)).abs() < 1e-14, "{step}: {sum}");
        }
        let linear = CouplingShare {
            joint: 0,
            coefficients: vec![3.0],
        };
        assert_eq!(linear.taylor(&2.0), [6.0, 3.0]);
    }
}
