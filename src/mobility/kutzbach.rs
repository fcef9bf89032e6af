//! Kutzbach's count: constraints subtracted from freedoms as if each were independent.

use crate::mechanism::Mechanism;

/// `6 (links − 1) − Σ (6 − freedom) − couplings`, the spatial formula for every mechanism (Kutzbach 1929).
///
/// Right where all constraints are independent, wrong by the number of dependent ones.
#[must_use]
pub fn kutzbach_count(mechanism: &Mechanism) -> i64 {
    let moving = mechanism.links().len() as i64 - 1;
    let constraints: i64 = mechanism
        .joints()
        .iter()
        .map(|joint| 6 - joint.freedom() as i64)
        .sum();
    6 * moving - constraints - mechanism.couplings().len() as i64
}
