//! Runs one engine in isolation, at a given precision or order: its result and its margin.
//!
//! The verdict asks engines in turn and gives each the digits it needs. Here nothing is chosen for the caller, so that what
//! digits and orders buy can be measured. No decision rests on any of this.

use super::chart::{Kernel, LADDER_UNKNOWNS, chart_in_bits, clearness};
use super::exact::{ExactAllowance, ExactBudget, ask_exact};
use super::germ::{Germ, complex_dimension, prestress_certificate};
use super::germ_zeros::{GermZeroOptions, germ_zeros};
use super::idle_directions::idle_directions;
use super::judge::PartFinding;
use super::more_digits::MoreDigits;
use super::pose_rank::{PartRank, Pose, TALL, height_at, known_to};
use super::singular::most_starts;
use super::{ChartOutcome, subgroup_finding};
use kutzbach_closure::Structure;
use kutzbach_closure::{Part, jacobian};
use kutzbach_math::matrix::{MatrixError, RankDecision, decide};

/// What one engine says of the finite freedom of one part.
#[derive(Clone, Debug, PartialEq)]
pub struct OneEngine {
    /// At least so many freedoms.
    pub lower: usize,
    /// At most so many; `None` where it says nothing.
    pub upper: Option<usize>,
    /// The instantaneous freedom, where it says that.
    pub instantaneous: Option<usize>,
    /// By what factor the figures that it rests on stand clear of what counts as zero; `None` where there is no such figure.
    pub margin: Option<f64>,
    /// Whether it was asked; otherwise the rank has decided before.
    pub asked: bool,
    /// In a few words.
    pub text: String,
}

impl OneEngine {
    fn silent(text: impl Into<String>) -> Self {
        Self {
            lower: 0,
            upper: None,
            instantaneous: None,
            margin: None,
            asked: true,
            text: text.into(),
        }
    }
}

/// How clearly a rank is decided: the smallest singular value kept, over what counts as zero or the largest one dropped.
fn rank_margin(decision: &RankDecision) -> Option<f64> {
    let margin = decision.kept / decision.tolerance.max(decision.dropped);
    (decision.rank.is_some() && margin.is_finite() && margin > 0.0).then_some(margin)
}

/// The rank of a part's equations in arithmetic of so many bits (53, or any number above): the instantaneous freedom, and
/// with it a bound from above on the finite one, which is met where the equations are independent or leave nothing.
///
/// The numbers are uncertain by their stated precision, unless that is too coarse to tell anything.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub fn rank_alone(
    pose: &Pose<'_>,
    more: &mut MoreDigits,
    part: &Part,
    bits: u32,
) -> Result<OneEngine, MatrixError> {
    let double = jacobian(pose.mechanism, pose.geometry, pose.states, part)?;
    let (stated, rounding, coarse) = known_to(&double);
    let stated = if coarse { 0.0 } else { stated };
    let (rows, columns) = (double.matrix.rows(), double.matrix.columns());
    let decision = if bits <= 53 {
        let mut matrix = double.matrix;
        matrix.scale_columns();
        decide(&matrix, stated + rounding)?
    } else {
        let finer = more.matrix(pose, part, !pose.as_drawn, bits)?;
        decide(&finer.matrix, stated + finer.rounding + finer.residual)?
    };
    let instantaneous = decision.rank.map(|rank| columns - rank);
    let met = |freedom: usize| freedom == 0 || columns as i64 - rows as i64 == freedom as i64;
    Ok(OneEngine {
        lower: instantaneous.filter(|f| met(*f)).unwrap_or(0),
        upper: Some(columns - decision.candidates.0),
        instantaneous,
        margin: rank_margin(&decision),
        asked: true,
        text: format!(
            "{rows} equations, {columns} unknowns; kept {:.1e}, dropped {:.1e}, zero below {:.1e}",
            decision.kept, decision.dropped, decision.tolerance
        ),
    })
}

/// What the rank of a part has decided already, so that no further engine is asked.
fn settled(rank: &PartRank) -> Option<OneEngine> {
    let freedom = rank.instantaneous?;
    let surplus = rank.unknowns() as i64 - rank.equations() as i64;
    (freedom == 0 || surplus == freedom as i64).then(|| OneEngine {
        lower: freedom,
        upper: Some(freedom),
        instantaneous: Some(freedom),
        margin: None,
        asked: false,
        text: "not asked: the rank has decided".to_owned(),
    })
}

/// Displacement subgroups, with what the rank says.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub fn subgroups_alone(
    pose: &Pose<'_>,
    structure: &Structure,
    part: &Part,
    rank: &PartRank,
) -> Result<OneEngine, MatrixError> {
    if let Some(answer) = settled(rank) {
        return Ok(answer);
    }
    let found = subgroup_finding(
        pose.mechanism,
        pose.geometry,
        pose.states,
        structure,
        part,
        rank,
    )?;
    Ok(OneEngine {
        lower: found.finite.unwrap_or(found.lower),
        upper: found.finite.or(found.upper),
        instantaneous: None,
        margin: None,
        asked: true,
        text: found.text,
    })
}

/// The chart test in arithmetic of so many bits, of the kernel that the rank leaves.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub fn chart_alone(
    pose: &Pose<'_>,
    more: &mut MoreDigits,
    part: &Part,
    rank: &PartRank,
    kernel: Option<&Kernel>,
    bits: u32,
) -> Result<OneEngine, MatrixError> {
    if let Some(answer) = settled(rank) {
        return Ok(answer);
    }
    let (Some(freedom), Some(kernel)) = (rank.instantaneous, kernel.filter(|k| k.basis.complete))
    else {
        return Ok(OneEngine::silent(
            "not asked: too many directions, or none decided",
        ));
    };
    if bits > 53 && rank.unknowns() > LADDER_UNKNOWNS {
        return Ok(OneEngine::silent(
            "not asked: too many unknowns for so many digits",
        ));
    }
    let test = chart_in_bits(pose, more, part, rank, kernel, bits)?;
    let (lower, upper, word) = match test.outcome {
        ChartOutcome::Regular => (freedom, freedom, "regular".to_owned()),
        ChartOutcome::Singular { order } => (
            0,
            freedom - 1,
            format!("singular, leftover of order {order:.1}"),
        ),
        ChartOutcome::Thin => (0, freedom, "the margin is too thin".to_owned()),
    };
    Ok(OneEngine {
        lower,
        upper: Some(upper),
        instantaneous: None,
        margin: clearness(&test, rank.open_by_digits()),
        asked: true,
        text: format!(
            "{word}; left over {:.1e} at a distance of {:.1e}, noise {:.1e}",
            test.leftover, test.radius, test.noise
        ),
    })
}

/// The germ of the configuration space, cut off after an order, and its real zeros, which no pose confirms here.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub fn germ_alone(
    pose: &Pose<'_>,
    part: &Part,
    rank: &PartRank,
    kernel: Option<&Kernel>,
    order: usize,
) -> Result<OneEngine, MatrixError> {
    if let Some(answer) = settled(rank) {
        return Ok(answer);
    }
    let (Some(freedom), Some(kernel)) = (rank.instantaneous, kernel.filter(|k| k.basis.complete))
    else {
        return Ok(OneEngine::silent(
            "not asked: too many directions, or none decided",
        ));
    };
    let by_kind = height_at(pose, part) > TALL;
    let idle = idle_directions(pose.mechanism, part, kernel, by_kind);
    let Some(germ) = Germ::of_part_across(pose.mechanism, rank, order, &idle)? else {
        return Ok(OneEngine::silent("its power series are too many to follow"));
    };
    let answer = |upper: usize, margin: Option<f64>, text: String| OneEngine {
        lower: idle.len(),
        upper: Some(upper),
        instantaneous: None,
        margin,
        asked: true,
        text,
    };
    let Some(first) = germ.order() else {
        return Ok(answer(
            freedom,
            None,
            format!("no equation is left to order {order}: if it stops, then at a higher one"),
        ));
    };
    let margin = Some(germ.margin()).filter(|m| m.is_finite());
    if prestress_certificate(&germ).is_some() {
        let text = "a self-stress blocks every motion at second order".to_owned();
        return Ok(answer(idle.len(), margin, text));
    }
    let zeros = germ_zeros(
        germ.freedom(),
        germ.equations(),
        germ.noise(first),
        &GermZeroOptions {
            most_starts: most_starts(&germ),
            ..GermZeroOptions::default()
        },
    );
    let complex = complex_dimension(germ.equations(), germ.freedom(), germ.noise_by_degree())
        .map(|c| c.dimension + idle.len());
    if zeros.thin.is_some() {
        let upper = complex.unwrap_or(freedom - 1).min(freedom - 1);
        let text = format!("equations of order {first}; their zeros are not told apart");
        return Ok(answer(upper, margin, text));
    }
    let dimensions: Vec<usize> = zeros.branches.iter().map(|b| b.dimension).collect();
    let top = dimensions.iter().copied().max().unwrap_or(0);
    let text = match dimensions.as_slice() {
        [] => format!("equations of order {first} without another zero"),
        [_] => format!("equations of order {first}, one piece of dimension {top}"),
        several => format!(
            "equations of order {first}, {} pieces of dimension {top} at most",
            several.len()
        ),
    };
    Ok(answer(top + idle.len(), margin, text))
}

/// Exact algebra within a budget, knowing nothing but the rank.
#[must_use]
pub fn exact_alone(
    pose: &Pose<'_>,
    part: &Part,
    rank: &PartRank,
    budget: ExactBudget,
) -> OneEngine {
    let mut found = PartFinding::new(rank.unknowns());
    let mut allowance = ExactAllowance::new(budget);
    ask_exact(pose, part, rank, &mut found, &mut allowance);
    match found.claims().last() {
        Some(claim) => OneEngine {
            lower: claim.finite.lower,
            upper: claim.finite.upper,
            instantaneous: None,
            margin: None,
            asked: true,
            text: claim.text.clone(),
        },
        None => OneEngine::silent("not asked"),
    }
}

/// The kernel that a decided rank leaves, as the chart test and the germ take it; `None` where the rank is open or nothing
/// moves.
///
/// # Errors
/// [`MatrixError`] where it cannot be computed.
pub fn kernel_of(pose: &Pose<'_>, rank: &PartRank) -> Result<Option<Kernel>, MatrixError> {
    if settled(rank).is_some() {
        return Ok(None);
    }
    Kernel::of(pose, rank, super::tracing::KERNEL_LIMIT)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::part_samples::Posed;
    use super::*;
    use kutzbach_closure::samples::{flat_parallelogram, four_bar};

    #[test]
    fn a_four_bar_is_decided_by_its_chart_and_by_its_subgroups_not_by_its_rank() {
        let posed = Posed::new(four_bar());
        let (pose, part, rank) = (posed.pose(), posed.part(), posed.rank());
        for bits in [53, 106, 212] {
            let alone = rank_alone(&pose, &mut MoreDigits::new(), part, bits).unwrap();
            assert_eq!((alone.lower, alone.upper), (0, Some(1)), "{bits}");
            assert!(alone.margin.unwrap() > 1e6);
            let kernel = kernel_of(&pose, &rank).unwrap();
            let mut more = MoreDigits::new();
            let chart = chart_alone(&pose, &mut more, part, &rank, kernel.as_ref(), bits).unwrap();
            assert_eq!((chart.lower, chart.upper), (1, Some(1)), "{bits}");
            assert!(chart.margin.unwrap() > 1.0);
        }
        let subgroups = subgroups_alone(&pose, &posed.structure, part, &rank).unwrap();
        assert_eq!((subgroups.lower, subgroups.upper), (1, Some(1)));
    }

    #[test]
    fn a_flat_parallelogram_shows_its_two_motions_at_second_order() {
        let posed = Posed::new(flat_parallelogram());
        let (pose, part, rank) = (posed.pose(), posed.part(), posed.rank());
        let kernel = kernel_of(&pose, &rank).unwrap();
        let chart = chart_alone(
            &pose,
            &mut MoreDigits::new(),
            part,
            &rank,
            kernel.as_ref(),
            53,
        )
        .unwrap();
        assert_eq!(chart.upper, Some(1));
        for order in [2, 4] {
            let germ = germ_alone(&pose, part, &rank, kernel.as_ref(), order).unwrap();
            assert_eq!(germ.upper, Some(1), "{}", germ.text);
        }
        let exact = exact_alone(&pose, part, &rank, ExactBudget::default());
        assert!(exact.upper.is_none_or(|upper| upper >= 1));
        let none = exact_alone(&pose, part, &rank, ExactBudget::none());
        assert_eq!(none.upper, None);
    }
}
