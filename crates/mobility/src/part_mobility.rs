//! The finite mobility of one part by engines that look at regular poses: rank, closed forms, subgroups, chart. The order of all
//! engines is in `engines.rs`.
//!
//! Of rounded numbers, a chart is believed only where the part can be followed farther away as well.
//!
//! A verdict is never given on a thin margin: what an engine cannot tell, it leaves open and says why.

use super::chart::{
    ChartOutcome, ChartTest, Kernel, LADDER_UNKNOWNS, chart_test, far_chart, literal_leftover,
};
use super::claim::{Answer, Bounds, Claim, PartBranch, Says};
use super::closed_form::closed_form;
use super::depth::Depth;
use super::judge::PartFinding;
use super::options::AnalysisError;
use super::pose_rank::{PartRank, Pose, Reading};
use super::question::{Means, Question};
use super::subgroup::{hidden_offset, subgroup_finding};
use super::superfluous::without_spares;
use super::tracing::{WALKED_UNKNOWNS, poses_of_regular_part, walk};
use super::tree_bound::most_by_joints;
use super::vocabulary::{CertificateLevel, EngineName, MobilityClass, PoseKind, Scope};
use kutzbach_closure::{Part, Section, rounding_of};
use kutzbach_math::matrix::{MatrixError, RankDecision, Real};

/// The class of a regular part that subgroups within the precision of its numbers do not explain: paradoxical where such subgroups were
/// looked for in exact numbers, or in those that were taken literally; in rounded ones they may be there and not show. Open where
/// they could not be looked for everywhere, and where they explain what is left without couplings that only repeat it. A superfluous link
/// fits by its dimensions alone: without it groups may explain the rest, and not that the whole moves.
fn unexplained(
    question: &Question<'_>,
    chart: &ChartTest,
) -> Result<Option<MobilityClass>, MatrixError> {
    let Question {
        pose,
        structure,
        part,
        rank,
        ..
    } = *question;
    let of = |part: &Part, rank: &PartRank| {
        let Pose {
            mechanism,
            geometry,
            states,
            ..
        } = pose;
        subgroup_finding(mechanism, geometry, states, structure, part, rank)
    };
    if let Some(rest) = without_spares(pose.mechanism, part, rank)
        && !rest.without_link
        && of(&rest.part, &rest.rank)?.class.is_some()
    {
        return Ok(None);
    }
    // A pose that was moved is known less well than its numbers, which are rounded all the same.
    if rank.open_by_digits() <= rounding_of(&rank.jacobian.walks, f64::EPSILON) {
        return Ok(question.looked.get().then_some(MobilityClass::Paradoxical));
    }
    if !chart.literal {
        return Ok(None);
    }
    let decision = RankDecision {
        accuracy: rank.accuracy,
        ..rank.decision.clone()
    };
    let literal = PartRank {
        reading: Reading::Exact,
        decision,
        note: None,
        ..rank.clone()
    };
    let found = of(part, &literal)?;
    let unexplained = found.looked.then_some(MobilityClass::Paradoxical);
    Ok(found.class.or(unexplained))
}

type Asked = Result<(), AnalysisError>;

/// What the rank says: the instantaneous freedom, unless it leaves that or the finite freedom open.
pub(super) fn by_rank(
    question: &Question<'_>,
    _: &mut Means<'_>,
    found: &mut PartFinding,
) -> Asked {
    let Question {
        pose, part, rank, ..
    } = *question;
    let surplus = question.surplus();
    // A special mechanism written with too few digits is, taken literally, a generic one: that more equations than unknowns
    // then hold it fast may be due to the digits left out.
    let held_by_rounding =
        rank.is_taken_literally() && rank.instantaneous == Some(0) && surplus < 0;
    let upper = if held_by_rounding {
        most_by_joints(pose.mechanism, part)
    } else {
        rank.candidates.1
    };
    let text = format!(
        "{} equations in {} unknowns; smallest singular value kept {:.2e}, largest dropped {:.2e}, tolerance {:.2e}; {} bits",
        rank.equations(),
        rank.unknowns(),
        rank.decision.kept,
        rank.decision.dropped,
        rank.decision.tolerance,
        rank.bits
    );
    let mut claim = Claim::of(EngineName::Rank, Scope::Pose, Bounds::at_most(upper), text);
    let known = rank.instantaneous.filter(|_| !held_by_rounding);
    // The rank was decided one way, but the precision stated may allow another: then the numbers have to be better.
    let other = rank.candidates.0 != rank.candidates.1
        && rank
            .as_written
            .is_none_or(|w| Some(w) == rank.instantaneous);
    let note = |clear: bool| {
        rank.note
            .as_ref()
            .filter(|_| clear)
            .map(ToString::to_string)
    };
    match known {
        None => {
            let clear = (rank.open_by_digits() == 0.0 || rank.doubt.is_some()) && !held_by_rounding;
            claim.says = Says::Open(note(clear).unwrap_or_else(|| {
                "the numbers as they are stated leave the rank at this pose open; more digits would decide it".to_owned()
            }));
        }
        Some(freedom) if other => {
            claim.finite = Bounds::at_most(freedom.max(rank.candidates.1));
            claim.says = Says::Open(note(rank.doubt.is_some()).unwrap_or_else(|| {
                "within the precision of its numbers the mechanism could have another rank at this pose; more digits would decide"
                    .to_owned()
            }));
        }
        Some(0) => {
            let text = "no velocity at all satisfies the closure equations at this pose, so no motion starts from it";
            claim.instantaneous = Bounds::exactly(0);
            claim = claim.regular(
                0,
                Answer {
                    branches: Some(Vec::new()),
                    ..Answer::numeric(text)
                },
            );
        }
        Some(freedom) => claim.instantaneous = Bounds::exactly(freedom),
    }
    if matches!(claim.says, Says::Bounds) {
        question.freedom.set(known);
    }
    found.take(claim);
    Ok(())
}

/// What the places of the axes say.
pub(super) fn by_closed_form(
    question: &Question<'_>,
    _: &mut Means<'_>,
    found: &mut PartFinding,
) -> Asked {
    let Question {
        pose, part, rank, ..
    } = *question;
    if let Some(claim) = closed_form(pose, part, rank) {
        found.take(claim);
    }
    Ok(())
}

/// What subgroups say.
pub(super) fn by_subgroups(
    question: &Question<'_>,
    means: &mut Means<'_>,
    found: &mut PartFinding,
) -> Asked {
    let Question {
        pose, part, rank, ..
    } = *question;
    let Some(freedom) = question.freedom.get() else {
        return Ok(());
    };
    let mut subgroups = subgroup_finding(
        pose.mechanism,
        pose.geometry,
        pose.states,
        question.structure,
        part,
        rank,
    )?;
    if !question.is_independent()
        && (subgroups.finite.is_some() || subgroups.lower > 0)
        && let Some(offset) = hidden_offset(pose, means.more, part, rank)?
    {
        subgroups = subgroups.withdrawn(offset, Some(freedom));
    }
    let steps: String = subgroups.steps.iter().map(|s| format!("; {s}")).collect();
    let mut claim = Claim::of(
        EngineName::Subgroup,
        Scope::EveryPose,
        Bounds {
            lower: subgroups.lower,
            upper: subgroups.upper,
        },
        format!("{}{steps}", subgroups.text),
    );
    if subgroups.finite == Some(freedom) {
        let answer = Answer {
            class: subgroups.class,
            level: CertificateLevel::Subgroup,
            ..Answer::numeric(subgroups.text)
        };
        claim = claim.regular(freedom, one_branch(question, means, freedom, answer)?);
    }
    question.class.set(subgroups.class);
    question.looked.set(subgroups.looked);
    found.take(claim);
    Ok(())
}

/// What the implicit function theorem says of independent equations.
pub(super) fn by_independence(
    question: &Question<'_>,
    means: &mut Means<'_>,
    found: &mut PartFinding,
) -> Asked {
    let Some(freedom) = question.freedom.get() else {
        return Ok(());
    };
    let answer = Answer {
        class: Some(question.class.get().unwrap_or(MobilityClass::Trivial)),
        ..Answer::numeric(
            "the closure equations at this pose are independent, so its motions form a manifold of exactly this dimension \
             (implicit function theorem)",
        )
    };
    let answer = one_branch(question, means, freedom, answer)?;
    let text = format!(
        "{} independent equations in {} unknowns",
        question.rank.equations(),
        question.rank.unknowns()
    );
    let claim = Claim::of(EngineName::Rank, Scope::Pose, Bounds::ANY, text);
    found.take(claim.regular(freedom, answer));
    Ok(())
}

/// What the chart test says.
pub(super) fn by_chart(
    question: &Question<'_>,
    means: &mut Means<'_>,
    found: &mut PartFinding,
) -> Asked {
    let Question {
        pose, part, rank, ..
    } = *question;
    let Some(freedom) = question.freedom.get() else {
        return Ok(());
    };
    // Fewer equations than unknowns leave a motion over the complex numbers, but not always a real one (x² + y² = 0).
    let Some(kernel) = question.of_kernel()?.filter(|k| k.basis.complete) else {
        let why = format!(
            "{freedom} instantaneous freedoms in one block are too many to follow; driving or fixing some joints would decide"
        );
        found.amend(|claim| claim.says = Says::Open(why));
        return Ok(());
    };
    let more = &mut *means.more;
    let mut chart = chart_test(pose, more, part, rank, kernel)?;
    // More digits would show a leftover near the pose; neither rounded numbers nor large parts have them. One of high order shows
    // farther away only.
    let only_far = rank.open_by_digits() > 0.5 * chart.noise && !chart.literal
        || rank.unknowns() > LADDER_UNKNOWNS;
    if only_far {
        confirm_on_the_way(pose, part, rank, kernel, &mut chart)?;
    } else if chart.outcome == ChartOutcome::Regular
        && (rank.open_by_digits() == 0.0 || chart.literal)
    {
        chart = far_chart(pose, more, part, rank, kernel, chart)?;
    }
    let mut claim = chart_claim(&chart, freedom);
    match chart.outcome {
        ChartOutcome::Regular => {
            let text = format!(
                "the loops close at finite distances from this pose in all directions of its {freedom} instantaneous \
                 freedom{}: what is left over is {:.1e} where {:.1e} is noise{}",
                if freedom == 1 { "" } else { "s" },
                chart.leftover,
                chart.noise,
                if only_far && chart.followed > 0.0 {
                    ", and the motion goes on as far as it was followed"
                } else {
                    ""
                }
            );
            let class = match question.class.get() {
                None => unexplained(question, &chart)?,
                explained => explained,
            };
            let answer = Answer {
                class,
                ..Answer::numeric(text)
            };
            claim = claim.regular(freedom, one_branch(question, means, freedom, answer)?);
        }
        ChartOutcome::Singular { .. } => claim.pose = Some(PoseKind::Singular),
        ChartOutcome::Thin => {
            claim.says = Says::Open(format!(
                "whether this pose is regular is open, since the margin is too thin: at a distance of {:.1e} the misfit is {:.1e}, \
                 and the noise may be {:.1e}; {}",
                chart.radius,
                chart.leftover,
                chart.noise,
                if rank.open_by_digits() > 0.0 {
                    "more digits in the file would decide"
                } else {
                    "a pose farther from other branches would decide"
                }
            ));
        }
    }
    found.take(claim);
    let _ = question.chart.set(chart);
    Ok(())
}

/// The answer of a regular pose, with its one branch.
fn one_branch(
    question: &Question<'_>,
    means: &mut Means<'_>,
    freedom: usize,
    mut answer: Answer,
) -> Result<Answer, MatrixError> {
    let Question {
        pose, part, rank, ..
    } = *question;
    if rank.settled().is_none() {
        return Ok(answer);
    }
    let followed = question.depth >= Depth::Motions;
    let rounded = rank.open_by_digits() > 0.0 && question.surplus() < freedom as i64;
    let kernel = match followed || rounded {
        true => question.of_kernel()?,
        false => None,
    };
    answer.branches = Some(vec![PartBranch {
        dimension: freedom,
        half_branches: (freedom == 1).then_some(2),
        poses: match kernel {
            Some(kernel) if followed => poses_of_regular_part(pose, part, rank, kernel)?,
            _ => Vec::new(),
        },
    }]);
    if rounded && let Some(kernel) = kernel.filter(|kernel| kernel.basis.complete) {
        answer.nominal = literal_leftover(pose, means.more, part, rank, kernel)?
            .map(|left| left * rank.jacobian.length);
    }
    Ok(answer)
}

/// A rounded part is followed so many steps of a quarter radian.
const FOLLOWED: usize = 10;

/// One with more unknowns than are walked along otherwise, so many, since each step takes several factors of the whole part. No answer is
/// wrong for it: a shorter way is called regular only where a leftover would show on it, which on half a radian it does in exact numbers
/// ([`LEAST_COEFFICIENT`] times 1/16 is far above their rounding) and not in rounded ones, which stay open.
const FOLLOWED_IF_LARGE: usize = 2;

/// The least coefficient of the leftover's fourth order that would show on the way. Those of known singular poses are 1e-5 and more, which is
/// measured and not derived: a part whose leftover begins with a smaller one, and that closes all along the way, would be called regular.
const LEAST_COEFFICIENT: f64 = 1e-5;

/// Rounded numbers leave so much room that near the pose a small leftover is lost in it: whether a part moves shows farther
/// away. Regular is what can be followed so far that a leftover would show; a way that ends leaves it open.
fn confirm_on_the_way(
    pose: &Pose<'_>,
    part: &Part,
    rank: &PartRank,
    kernel: &Kernel,
    chart: &mut ChartTest,
) -> Result<(), MatrixError> {
    if matches!(chart.outcome, ChartOutcome::Singular { .. }) || chart.leftover > chart.noise {
        return Ok(());
    }
    let steps = match rank.unknowns() > WALKED_UNKNOWNS {
        true => FOLLOWED_IF_LARGE,
        false => FOLLOWED,
    };
    let section = Section {
        mechanism: pose.mechanism,
        geometry: pose.geometry,
        part,
        metric: &kernel.metric,
    };
    let tangents = kernel.basis.vectors.clone();
    let freedom = tangents.len();
    let poses = pose.try_on(part, |states| {
        let stated = rank.open_by_digits();
        walk(
            &section,
            states,
            tangents,
            None,
            stated,
            steps,
            f64::INFINITY,
        )
    })?;
    let mut farthest: f64 = 0.0;
    for there in &poses {
        let way = pose.try_on(part, |states| {
            for (&joint, state) in part.joints.iter().zip(&there.states) {
                states[joint] = state.clone();
            }
            section.way_between(pose.states, states)
        });
        farthest = farthest.max(0.0.norm(&way));
    }
    let followed = poses.len() == steps && poses.iter().all(|p| p.instantaneous == Some(freedom));
    let visible = LEAST_COEFFICIENT * farthest.min(2.0).powi(4) > chart.noise;
    chart.followed = farthest;
    chart.outcome = if followed && visible {
        ChartOutcome::Regular
    } else {
        ChartOutcome::Thin
    };
    Ok(())
}

fn chart_claim(chart: &ChartTest, freedom: usize) -> Claim {
    let (bounds, what) = match chart.outcome {
        ChartOutcome::Regular => (Bounds::exactly(freedom), "regular".to_owned()),
        ChartOutcome::Singular { order } => (
            Bounds::at_most(freedom - 1),
            format!("singular, leftover of order {order:.2}"),
        ),
        ChartOutcome::Thin => (Bounds::at_most(freedom), "margin too thin".to_owned()),
    };
    let text = format!(
        "{what}; radius {:.2e}, {} directions, left over {:.2e}, noise {:.2e}; {} bits; seed {}{}{}",
        chart.radius,
        chart.directions,
        chart.leftover,
        chart.noise,
        chart.bits,
        super::chart::SEED,
        if chart.followed > 0.0 {
            format!("; followed for {:.2}", chart.followed)
        } else {
            String::new()
        },
        if chart.literal {
            "; numbers taken literally"
        } else {
            ""
        }
    );
    Claim::of(EngineName::Chart, Scope::Neighbourhood, bounds, text)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
