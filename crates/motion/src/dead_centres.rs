//! Where joints turn back: the extremes of each joint variable along a curve.
//!
//! At a dead centre of a joint its rate changes sign while the mechanism moves on, so that driving this joint would stop
//! there. The rate is a component of the tangent; its root between two nodes is found by the ITP method's older relative,
//! the Illinois rule (Dowell & Jarratt 1971), on tangents computed at corrected poses.

use super::curve::Curve;

/// A component of the unit tangent below this is no rate: rounding of a tangent where the margin is ordinary leaves 1e-14
/// to 1e-12.
const RESTS: f64 = 1e-11;

/// An unknown whose rate never exceeds this (relative to the unit tangent) does not take part in the motion.
pub(super) const LOCKED: f64 = 1e-8;

/// An extreme of an unknown.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct DeadCentre {
    pub unknown: usize,
    pub arclength: f64,
    /// Its value there (rad, m).
    pub value: f64,
    /// Whether it is a greatest value.
    pub greatest: bool,
}

/// All dead centres of the unknowns whose values are numbers of their own, in the order of arclength.
pub(super) fn dead_centres(curve: &mut Curve) -> Vec<DeadCentre> {
    let mut found = Vec::new();
    for unknown in 0..curve.solver.system.unknowns() {
        if !curve.solver.system.is_scalar(unknown) {
            continue;
        }
        let rates: Vec<f64> = curve.nodes.iter().map(|n| n.tangent[unknown]).collect();
        if rates.iter().all(|r| r.abs() < LOCKED) {
            continue;
        }
        let moving: Vec<usize> = (0..rates.len())
            .filter(|&i| rates[i].abs() > RESTS)
            .collect();
        for pair in moving.windows(2) {
            let (a, b) = (pair[0], pair[1]);
            if (rates[a] < 0.0) == (rates[b] < 0.0) {
                continue;
            }
            let place = if b == a + 1 {
                root(curve, a, unknown, rates[a], rates[b])
            } else {
                Some((a, 1.0))
            };
            if let Some((segment, u)) = place {
                push(curve, &mut found, unknown, segment, u, rates[a] > 0.0);
            }
        }
        // On a closed curve the last node is the first once more.
        if curve.closed
            && let (Some(&first), Some(&last)) = (moving.first(), moving.last())
            && (first > 0 || last + 1 < rates.len())
            && (rates[first] < 0.0) != (rates[last] < 0.0)
        {
            push(curve, &mut found, unknown, 0, 0.0, rates[last] > 0.0);
        }
    }
    found.sort_by(|a, b| {
        (a.arclength, a.unknown)
            .partial_cmp(&(b.arclength, b.unknown))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    found
}

fn push(
    curve: &mut Curve,
    found: &mut Vec<DeadCentre>,
    unknown: usize,
    segment: usize,
    u: f64,
    greatest: bool,
) {
    let pose = curve.pose_between(segment, u);
    let (arclength, value) = match pose {
        Some(pose) => (pose.arclength, pose.pose.values[unknown]),
        None => {
            let node = &curve.nodes[segment + usize::from(u > 0.5)];
            (node.arc, node.pose.values[unknown])
        }
    };
    found.push(DeadCentre {
        unknown,
        arclength,
        value,
        greatest,
    });
}

/// Where the rate of an unknown vanishes between two nodes.
fn root(curve: &mut Curve, segment: usize, unknown: usize, a: f64, b: f64) -> Option<(usize, f64)> {
    let (mut low, mut high) = ((0.0, a), (1.0, b));
    let mut side = 0;
    let mut best = 0.5;
    for _ in 0..60 {
        let u = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
        let rate = curve.tangent_between(segment, u)?[unknown];
        best = u;
        if rate == 0.0 || high.0 - low.0 < 1e-15 || rate.abs() < 1e-15 {
            break;
        }
        if (rate < 0.0) == (low.1 < 0.0) {
            low = (u, rate);
            if side == -1 {
                high.1 *= 0.5;
            }
            side = -1;
        } else {
            high = (u, rate);
            if side == 1 {
                low.1 *= 0.5;
            }
            side = 1;
        }
    }
    Some((segment, best))
}
