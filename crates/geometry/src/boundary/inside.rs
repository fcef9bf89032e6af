//! Where a point of a plane is beside loops in it.

use crate::decide::{Certainty, Decider, Outcome, Sign};
use crate::entity::Point;
use crate::error::GeometryError;
use crate::planar::Place;
use crate::scalar::Scalar;
use crate::triple::{pivot, quotient};
use std::cmp::Ordering;

/// A point as numerators over one divisor that is certainly not zero: on which side of it something is can be told without
/// the rounding of quotients.
#[derive(Clone, Debug)]
pub(crate) struct Ratio<S> {
    /// The numerators of the coordinates.
    pub(crate) numerators: [S; 3],
    /// The divisor of all of them.
    pub(crate) divisor: S,
}

impl<S: Scalar> Ratio<S> {
    /// A point over 1.
    pub(crate) fn of(point: &[S; 3]) -> Self {
        Self {
            numerators: point.clone(),
            divisor: S::whole(1),
        }
    }

    /// The point between two.
    pub(crate) fn middle(a: &Self, b: &Self) -> Self {
        let part = |i: usize| {
            let first = a.numerators[i].times(&b.divisor);
            first.plus(&b.numerators[i].times(&a.divisor))
        };
        Self {
            numerators: [part(0), part(1), part(2)],
            divisor: a.divisor.times(&b.divisor).times(&S::whole(2)),
        }
    }

    /// The point itself.
    pub(crate) fn point(&self) -> Result<Point<S>, GeometryError> {
        let part = |i: usize| quotient(&self.numerators[i], &self.divisor);
        Ok(Point([part(0)?, part(1)?, part(2)?]))
    }

    /// A coordinate of the way to another point, times the divisor.
    fn way_to(&self, other: &[S; 3], axis: usize) -> S {
        other[axis]
            .times(&self.divisor)
            .minus(&self.numerators[axis])
    }
}

/// Coordinates of corners beside the point, as seen along an axis.
type Seen<S> = [S; 2];

/// Where a point in the plane of loops is: inside where a ray from it crosses them an odd number of times.
///
/// The plane is seen along that axis which its normal follows most: so coordinates stay what they are. The divisor of the
/// point may be negative, which turns everything by half a turn and changes no answer.
pub(crate) fn place_in_loops<S: Scalar>(
    at: &Ratio<S>,
    loops: &[&[Point<S>]],
    normal: &[S; 3],
    decider: &mut Decider,
) -> Place {
    let axis = pivot(normal);
    let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut seen: Vec<Vec<Seen<S>>> = loops
        .iter()
        .map(|ring| {
            ring.iter()
                .map(|corner| [at.way_to(&corner.0, i), at.way_to(&corner.0, j)])
                .collect()
        })
        .collect();
    let mut best: Option<Outcome<Place>> = None;
    // A corner at the height of the point within its digits leaves the ray that passes it in doubt, not the one away from it.
    for _ in 0..4 {
        let mut own = Decider::default();
        let place = crossings(&seen, &mut own);
        let outcome = own.outcome(place);
        let certainty = outcome.certainty;
        if best.as_ref().is_none_or(|b| certainty < b.certainty) {
            best = Some(outcome);
        }
        if certainty == Certainty::Proven {
            break;
        }
        for corner in seen.iter_mut().flatten() {
            let [x, y] = corner.clone();
            *corner = [y, x.negated()];
        }
    }
    match best {
        Some(outcome) => decider.take(outcome),
        None => Place::Outside,
    }
}

/// Whether both are certainly on the same side of zero.
fn same_side<S: Scalar>(a: &S, b: &S) -> bool {
    matches!(
        (a.sign(), b.sign()),
        (Sign::Positive, Sign::Positive) | (Sign::Negative, Sign::Negative)
    )
}

fn crossings<S: Scalar>(loops: &[Vec<Seen<S>>], decider: &mut Decider) -> Place {
    let mut inside = false;
    for seen in loops {
        for (a, b) in seen.iter().zip(seen.iter().cycle().skip(1)) {
            let left = a[0].sign() == Sign::Negative && b[0].sign() == Sign::Negative;
            if left || same_side(&a[1], &b[1]) {
                // The ray to the right does not meet it, and the point is not on it.
                continue;
            }
            // Of what is certainly on the right the heights alone decide.
            let right = same_side(&a[0], &b[0]);
            let side = match right {
                true => Ordering::Equal,
                false => decider.order(&a[0].times(&b[1]).minus(&a[1].times(&b[0]))),
            };
            if side == Ordering::Equal && !right {
                let product = a[0].times(&b[0]).plus(&a[1].times(&b[1]));
                if decider.order(&product) != Ordering::Greater {
                    return Place::OnBorder;
                }
            }
            let below = decider.order(&a[1]) != Ordering::Greater;
            let above = decider.order(&b[1]) == Ordering::Greater;
            // It crosses the height of the point; on its right where it passes counterclockwise on its way up.
            if below == above && (right || (side == Ordering::Greater) == above) {
                inside = !inside;
            }
        }
    }
    match inside {
        true => Place::Inside,
        false => Place::Outside,
    }
}
