//! Sixteen digits that a program printed do not say that the numbers are known so well.
//!
//! A converter reads coordinates that were rounded somewhere (nine digits of a drawing, angles of twelve), turns them into
//! other frames, and prints doubles. Singular values that are zero in the mechanism meant come out at 1e-9 or 1e-11, far above
//! the rounding of doubles: as written, they are real. What gives them away is that they stand alone: decades below all
//! others, and no larger than a rounding of the coordinates would leave them. Then there is nothing in the file that tells
//! which, and both ranks stay possible.
//!
//! What rounding by `u` leaves of a zero is bounded by the Jacobian's uncertainty if all literals are known to within `u`
//! ([`stated_by`]): linear in `u`. Rounding coarser than [`COARSEST`] is not thought of, nor values above [`LARGEST`]: six hidden
//! decimals (of text, or of a `float`) leave 1e-7 and are taken as they are written, since mechanisms that truly miss a special
//! one by that much have to be told apart from it. The gap is that of every rank decision, a factor of a thousand. So a
//! mechanism within [`LARGEST`] of a singular pose, drawn by a program to the last digit, is called undecided, with both answers:
//! `--precision 0` says that its digits are meant.

use kutzbach_closure::{CycleJacobian, Uncertainty, stated_by};
use kutzbach_math::matrix::{
    DENSE_COLUMNS, MatrixError, RankDecision, SparseMatrix, decide, relative_singular_values,
};
use kutzbach_model::mechanism::{JointId, Mechanism};

/// Half a unit of the sixth decimal (m, rad).
const COARSEST: f64 = 5e-7;

/// Values above this share of the largest are believed: what hid rounding has left in published files is far below (4e-12,
/// 2e-11), and mechanisms that miss a special one by 1e-7, drawn to the last digit, have to be told apart from it. Chosen
/// between the two, with a decade to spare on that side: coarser rounding that a program has hidden is not noticed.
pub(super) const LARGEST: f64 = 1e-8;

/// As for every rank: smallest ratio of the last value kept to the first one dropped.
const SMALLEST_GAP: f64 = 1e3;

/// The other reading of a rank: the one of coordinates that were rounded before they were printed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct OtherRank {
    /// The rank if the smallest singular values are rounding.
    pub rank: usize,
    /// The coordinates have to be rounded at this, a power of ten (m, rad), or more coarsely.
    pub rounded_at: f64,
    /// The largest singular value that would be rounding, relative to the largest of all.
    pub largest: f64,
    /// How many times smaller than the next value it is.
    pub gap: f64,
}

/// The rank that rounded coordinates would have, if the one as written rests on values that look like rounding.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub(super) fn if_rounded(
    mechanism: &Mechanism,
    jacobian: &CycleJacobian<f64>,
    matrix: &SparseMatrix<f64>,
    written: &RankDecision,
) -> Result<Option<OtherRank>, MatrixError> {
    let mut joints = jacobian.walks.iter().flat_map(|walk| &walk.joints);
    let of_doubles = joints.any(|j| mechanism.precision_of(JointId(j.joint)).is_of_doubles());
    let Some(rank) = written.rank.filter(|rank| *rank > 1 && of_doubles) else {
        return Ok(None);
    };
    let by_one = uncertainty_by_one(mechanism, jacobian);
    let most = (by_one * COARSEST).min(LARGEST);
    if !(most.is_finite() && written.kept <= most) {
        return Ok(None);
    }
    let other = if matrix.columns() <= DENSE_COLUMNS {
        let values = relative_singular_values(matrix)?.unwrap_or_default();
        (1..rank.min(values.len()))
            .find(|&k| values[k] <= most && values[k - 1] >= SMALLEST_GAP * values[k])
            .map(|k| (k, values[k], values[k - 1] / values[k]))
    } else {
        by_bounds(matrix, rank, most)?
    };
    Ok(other.map(|(rank, largest, gap)| OtherRank {
        rank,
        largest,
        gap,
        rounded_at: power_of_ten_above(2.0 * largest / by_one),
    }))
}

/// The Jacobian's uncertainty for every metre or radian by which each literal is unknown.
fn uncertainty_by_one(mechanism: &Mechanism, jacobian: &CycleJacobian<f64>) -> f64 {
    let of_walk = |walk: &kutzbach_closure::WalkedCycle<f64>| {
        let by_one = |joint: usize| {
            let one = mechanism.precision_of(JointId(joint)).known_to(1.0);
            Uncertainty::of(&one, &mechanism.joints()[joint])
        };
        let joints = walk.joints.iter().map(|walked| walked.joint);
        let all: Vec<Uncertainty> = joints.map(by_one).collect();
        stated_by(walk, &Uncertainty::total(&all))
    };
    jacobian.walks.iter().map(of_walk).fold(0.0, f64::max)
}

/// Of many unknowns only the margins of a decision are known: those with coarser and coarser numbers are tried.
fn by_bounds(
    matrix: &SparseMatrix<f64>,
    rank: usize,
    most: f64,
) -> Result<Option<(usize, f64, f64)>, MatrixError> {
    for step in 0..3 {
        let decision = decide(matrix, most * 0.01f64.powi(step))?;
        if let Some(lower) = decision.rank.filter(|lower| *lower < rank) {
            return Ok(Some((lower, decision.dropped, decision.gap)));
        }
    }
    Ok(None)
}

fn power_of_ten_above(x: f64) -> f64 {
    // Not computed from a logarithm's power, which would print as 1.0000000000000001e-9.
    (-17..=0)
        .map(|exponent| format!("1e{exponent}").parse().unwrap_or(1.0))
        .find(|power: &f64| *power >= x)
        .unwrap_or(1.0)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::pose_rank::Doubt;
    use crate::{Analysis, AnalysisOptions, Verdict, analyse};
    use kutzbach_closure::samples::Place;
    use kutzbach_closure::samples::{CRANK_ROCKER, Written, add_ring, planar, ring};
    use kutzbach_model::mechanism::MechanismBuilder;

    /// A unit in which no coordinate is short.
    const UNIT: f64 = 0.7310585786300049;

    /// A planar four-bar with one axis out of parallel.
    fn tilted(by: f64) -> Vec<Place> {
        let mut places = planar(&CRANK_ROCKER.map(|point| point.map(|x| x * UNIT)));
        places[1].2 = [UNIT * by, 0.0, UNIT];
        places
    }

    fn four_bar(by: f64, decimals: usize) -> Mechanism {
        ring(&tilted(by), [0.0; 3], Written::Decimals(decimals))
    }

    fn analysed(mechanism: &Mechanism) -> Analysis {
        analyse(mechanism, &AnalysisOptions::default()).unwrap()
    }

    #[test]
    fn values_that_stand_alone_near_rounding_leave_both_ranks_possible() {
        for tilt in [3e-9, 3e-10, 2e-12] {
            let found = analysed(&four_bar(tilt, 17));
            let rank = &found.parts[0];
            assert_eq!(
                (rank.candidates, rank.as_written),
                ((0, 1), Some(0)),
                "{tilt:e}"
            );
            assert_eq!(found.mobility.verdict, Verdict::Undecided, "{tilt:e}");
            let Some(Doubt::Rounded(rounded_at)) = rank.doubt else {
                panic!("{tilt:e}: {:?}", rank.doubt)
            };
            assert!(
                rounded_at < 10.0 * tilt && rounded_at > 0.01 * tilt,
                "{tilt:e}: {rounded_at:e}"
            );
            let note = rank.note.as_ref().unwrap().to_string();
            assert!(
                note.contains(&format!(
                    "0 as written, or 1 if the coordinates are rounded at {rounded_at:e}"
                )),
                "{note}"
            );
            assert_eq!(found.mobility.why, [note]);
            // What the joints do is as open.
            assert!(found.roles.iter().all(|role| role.locked.is_none()));
        }
    }

    #[test]
    fn a_precision_said_by_hand_decides() {
        let mechanism = four_bar(3e-10, 17);
        let rough = analysed(&mechanism.clone().with_precision(1e-8));
        assert_eq!(rough.mobility.finite(), Some(1));
        assert_eq!(rough.home.unwrap().as_written, Some(0));
        for size in [0.0, 1e-13] {
            let fine = analysed(&mechanism.clone().with_precision(size));
            assert_eq!(fine.mobility.verdict, Verdict::Rigid, "{size:e}");
        }
    }

    #[test]
    fn what_is_no_rounding_is_decided_as_written() {
        // Larger than any rounding; exact numbers.
        for mechanism in [
            four_bar(1e-3, 17),
            ring(&tilted(3e-10), [0.0; 3], Written::Exactly),
        ] {
            let found = analysed(&mechanism);
            assert_eq!(
                found.mobility.verdict,
                Verdict::Rigid,
                "{:?}",
                found.parts[0].note
            );
            assert!(found.parts[0].doubt.is_none());
        }
        let plain = analysed(&four_bar(0.0, 17));
        assert_eq!(plain.mobility.finite(), Some(1));
        assert!(plain.parts[0].doubt.is_none());
    }

    #[test]
    fn what_a_program_printed_is_meant_but_for_its_noise() {
        let mechanism = four_bar(1e-7, 12);
        let found = analysed(&mechanism).mobility;
        assert_eq!(found.finite(), Some(1));
        let nominal = found.nominal.unwrap();
        assert!(nominal.noise && nominal.distance.unwrap() < 1e-6);
        assert_eq!(found.as_written.unwrap().verdict, Verdict::Rigid);
        let fine = analysed(&mechanism.with_precision(1e-13)).mobility;
        assert_eq!(fine.verdict, Verdict::Rigid);
    }

    #[test]
    fn mirror_images_never_get_different_answers() {
        // What doubles take for zero in one loop and keep in the other.
        let mut both = 0;
        for tilt in [5e-16, 2e-14, 5e-14, 2e-13, 3e-12] {
            let mut builder = MechanismBuilder::new("legs");
            builder.link("ground");
            let written = Written::Decimals(17);
            add_ring(
                &mut builder,
                "left",
                "ground",
                &tilted(tilt),
                [0.0; 3],
                written,
            );
            add_ring(
                &mut builder,
                "right",
                "ground",
                &tilted(0.0),
                [0.0; 3],
                written,
            );
            let found = analysed(&builder.build().unwrap());
            let [left, right] = [&found.parts[0], &found.parts[1]];
            assert_eq!(left.candidates, right.candidates, "{tilt:e}");
            assert_eq!(left.instantaneous, right.instantaneous, "{tilt:e}");
            let roles: Vec<Option<bool>> = found.roles.iter().map(|role| role.locked).collect();
            assert_eq!(roles[..4], roles[4..], "{tilt:e}");
            if left.instantaneous.is_none() {
                both += 1;
                assert_eq!(found.mobility.verdict, Verdict::Undecided);
                assert!(matches!(left.note, Some(crate::RankNote::Unlike { .. })));
            }
        }
        assert!(both > 1, "some of them differ");
    }

    #[test]
    fn legs_that_differ_are_not_treated_alike() {
        let mut builder = MechanismBuilder::new("legs");
        builder.link("ground");
        let written = Written::Decimals(17);
        add_ring(
            &mut builder,
            "moves",
            "ground",
            &tilted(0.0),
            [0.0; 3],
            written,
        );
        add_ring(
            &mut builder,
            "stands",
            "ground",
            &tilted(0.01),
            [0.0; 3],
            written,
        );
        let found = analysed(&builder.build().unwrap());
        assert_eq!(found.mobility.finite(), Some(1));
        assert_eq!(found.roles[0].locked, Some(false));
        assert_eq!(found.roles[4].locked, Some(true));
    }

    #[test]
    fn powers_of_ten_are_those_of_the_text() {
        assert_eq!(power_of_ten_above(3e-10), 1e-9);
        assert_eq!(power_of_ten_above(1e-9), 1e-9);
        assert_eq!(power_of_ten_above(7.0), 1.0);
    }
}
