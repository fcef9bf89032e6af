//! The finite mobility of one part: engines in order of cost, until their bounds meet.
//!
//! | engine | says | costs |
//! |---|---|---|
//! | rank | finite ≤ δ; = δ where no equation is redundant (implicit function theorem); = 0 where δ = 0 | done already |
//! | subgroup | exact, at every pose, where displacement subgroups explain the motion | a few brackets a cycle |
//! | chart | regular: finite = δ; singular: finite ≤ δ − 1 | some dozen closures |
//! | second order | finite = 0 at a singular pose with a definite form | power series |
//! | germ and its zeros | the branches through a singular pose, each confirmed by closing all equations on it | power series |
//!
//! Exact algebra is asked afterwards: `crates/mobility/src/exact/`.
//!
//! Of rounded numbers, a chart is believed only where the part can be followed farther away as well.
//!
//! A verdict is never given on a thin margin: what an engine cannot tell, it leaves open and says why.

use super::chart::{
    ChartOutcome, ChartTest, Kernel, LADDER_UNKNOWNS, chart_test, far_chart, literal_leftover,
};
use super::depth::Depth;
use super::more_digits::MoreDigits;
use super::pose_rank::{PartRank, Pose};
use super::singular::{SingularFinding, singular_finding};
use super::subgroup::{hidden_offset, subgroup_finding};
use super::tracing::{KERNEL_LIMIT, PartPose, WALKED_UNKNOWNS, poses_of_regular_part, walk};
use super::tree_bound::most_by_joints;
use super::vocabulary::{CertificateLevel, MobilityClass, PoseKind, SingularKind};
use kutzbach_closure::Structure;
use kutzbach_closure::{Part, Section};
use kutzbach_math::matrix::{MatrixError, RankDecision, Real};

/// What one engine contributed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Evidence {
    /// Its name.
    pub engine: &'static str,
    /// What it looked at: the pose, a neighbourhood of it, all poses.
    pub scope: &'static str,
    /// The bounds it gives on the finite mobility of the part.
    pub bounds: (usize, Option<usize>),
    /// Figures: margins, orders, radii, seeds.
    pub text: String,
}

/// A branch of one part.
#[derive(Clone, Debug)]
pub struct PartBranch {
    /// Dimension.
    pub dimension: usize,
    /// Ways of leaving the pose, for dimension 1.
    pub half_branches: Option<usize>,
    /// Generic poses on it.
    pub poses: Vec<PartPose>,
}

/// The finite mobility of one part.
#[derive(Clone, Debug)]
pub struct PartFinding {
    /// At least so many finite freedoms.
    pub lower: usize,
    /// At most so many.
    pub upper: usize,
    /// Regular or singular.
    pub pose: Option<PoseKind>,
    /// In which way singular.
    pub kind: Option<SingularKind>,
    /// Hervé's class.
    pub class: Option<MobilityClass>,
    /// How strong the certificate is.
    pub level: CertificateLevel,
    /// What it proves.
    pub certificate: String,
    /// Dimension over the complex numbers, where it was found.
    pub complex_dimension: Option<usize>,
    /// The branches; `None` while not decided.
    pub branches: Option<Vec<PartBranch>>,
    /// Instantaneous freedom at the pose, where the part stays there.
    pub at_rest: usize,
    /// What stays open, and what would decide it.
    pub open: Option<String>,
    /// What the engines found, in the order they were asked.
    pub evidence: Vec<Evidence>,
    /// How far the numbers, taken literally, miss a mobile mechanism (m), where they do.
    pub nominal: Option<f64>,
    /// No component of the complex solution set through the pose has more dimensions: proven, where exact algebra was asked.
    pub complex_upper: Option<usize>,
    /// Where engines contradict one another: which, and on what.
    pub contradiction: Option<String>,
}

impl PartFinding {
    pub(super) fn open(lower: usize, upper: usize, why: String) -> Self {
        Self {
            lower,
            upper,
            pose: None,
            kind: None,
            class: None,
            level: CertificateLevel::Numeric,
            certificate:
                "the rank of the closure equations at this pose bounds the freedom from above"
                    .to_owned(),
            complex_dimension: None,
            branches: None,
            at_rest: upper,
            open: Some(why),
            evidence: Vec::new(),
            nominal: None,
            complex_upper: None,
            contradiction: None,
        }
    }

    fn regular(
        freedom: usize,
        class: Option<MobilityClass>,
        level: CertificateLevel,
        certificate: String,
    ) -> Self {
        Self {
            lower: freedom,
            upper: freedom,
            pose: Some(PoseKind::Regular),
            kind: None,
            class,
            level,
            certificate,
            complex_dimension: Some(freedom),
            branches: None,
            at_rest: freedom,
            open: None,
            evidence: Vec::new(),
            nominal: None,
            complex_upper: None,
            contradiction: None,
        }
    }

    fn with(mut self, evidence: Vec<Evidence>) -> Self {
        self.evidence = evidence;
        self
    }
}

/// The class of a regular part that subgroups within the precision of its numbers do not explain: paradoxical where such subgroups were
/// looked for in exact numbers, or in those that were taken literally; in rounded ones they may be there and not show.
fn unexplained(
    pose: &Pose<'_>,
    structure: &Structure,
    part: &Part,
    rank: &PartRank,
    chart: &ChartTest,
) -> Result<Option<MobilityClass>, MatrixError> {
    if rank.stated <= rank.accuracy {
        return Ok(Some(MobilityClass::Paradoxical));
    }
    if !chart.literal {
        return Ok(None);
    }
    let decision = RankDecision {
        accuracy: rank.accuracy,
        ..rank.decision.clone()
    };
    let literal = PartRank {
        stated: 0.0,
        decision,
        note: None,
        ..rank.clone()
    };
    let found = subgroup_finding(
        pose.mechanism,
        pose.geometry,
        pose.states,
        structure,
        part,
        &literal,
    )?;
    Ok(Some(found.class.unwrap_or(MobilityClass::Paradoxical)))
}

/// Asks the engines about one part. Below [`Depth::Motions`] the branch of a regular pose comes without poses on it.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub fn part_mobility(
    pose: &Pose<'_>,
    more: &mut MoreDigits,
    structure: &Structure,
    part: &Part,
    rank: &PartRank,
    depth: Depth,
) -> Result<PartFinding, MatrixError> {
    let surplus = rank.unknowns() as i64 - rank.equations() as i64;
    // A special mechanism written with too few digits is, taken literally, a generic one: that more equations than unknowns
    // then hold it fast may be due to the digits left out.
    let held_by_rounding = rank.taken_literally && rank.instantaneous == Some(0) && surplus < 0;
    let upper = if held_by_rounding {
        most_by_joints(pose.mechanism, part)
    } else {
        rank.candidates.1
    };
    let rank_evidence = Evidence {
        engine: "rank",
        scope: "this pose",
        bounds: (0, Some(upper)),
        text: format!(
            "{} equations in {} unknowns; smallest singular value kept {:.2e}, largest dropped {:.2e}, tolerance {:.2e}; \
             {} bits",
            rank.equations(),
            rank.unknowns(),
            rank.decision.kept,
            rank.decision.dropped,
            rank.decision.tolerance,
            rank.bits
        ),
    };
    let Some(freedom) = rank.instantaneous.filter(|_| !held_by_rounding) else {
        let why = match &rank.note {
            Some(note) if (rank.stated == 0.0 || rank.doubt.is_some()) && !held_by_rounding => {
                note.clone()
            }
            _ => "the numbers as they are stated leave the rank at this pose open; more digits would decide it".to_owned(),
        };
        return Ok(PartFinding::open(0, upper, why).with(vec![rank_evidence]));
    };
    // The rank was decided one way, but the precision stated allows another: the numbers have to be better.
    if rank.candidates.0 != rank.candidates.1
        && rank
            .as_written
            .is_none_or(|w| Some(w) == rank.instantaneous)
    {
        let why = match &rank.note {
            Some(note) if rank.doubt.is_some() => note.clone(),
            _ => "within the precision of its numbers the mechanism could have another rank at this pose; more digits would decide"
                .to_owned(),
        };
        let upper = freedom.max(rank.candidates.1);
        return Ok(PartFinding::open(0, upper, why).with(vec![rank_evidence]));
    }
    let mut evidence = vec![rank_evidence];
    if freedom == 0 {
        let text = "no velocity at all satisfies the closure equations at this pose, so no motion starts from it";
        let mut found = PartFinding::regular(0, None, CertificateLevel::Numeric, text.to_owned());
        found.branches = Some(Vec::new());
        return Ok(found.with(evidence));
    }
    let kernel_here = || Kernel::of(pose, rank, KERNEL_LIMIT);
    let one_branch = |found: &mut PartFinding,
                      more: &mut MoreDigits,
                      known: Option<&Kernel>|
     -> Result<(), MatrixError> {
        if rank.settled().is_none() {
            return Ok(());
        }
        let followed = depth >= Depth::Motions;
        let rounded = rank.stated > 0.0 && surplus < freedom as i64;
        let own = match known {
            None if followed || rounded => kernel_here()?,
            _ => None,
        };
        let kernel = known.or(own.as_ref());
        found.branches = Some(vec![PartBranch {
            dimension: freedom,
            half_branches: (freedom == 1).then_some(2),
            poses: match kernel {
                Some(kernel) if followed => poses_of_regular_part(pose, part, rank, kernel)?,
                _ => Vec::new(),
            },
        }]);
        if rounded && let Some(kernel) = kernel.filter(|kernel| kernel.basis.complete) {
            found.nominal = literal_leftover(pose, more, part, rank, kernel)?
                .map(|left| left * rank.jacobian.length);
        }
        Ok(())
    };
    let mut subgroups = subgroup_finding(
        pose.mechanism,
        pose.geometry,
        pose.states,
        structure,
        part,
        rank,
    )?;
    if surplus != freedom as i64
        && subgroups.finite.is_some()
        && let Some(offset) = hidden_offset(pose, more, part, rank)?
    {
        subgroups = subgroups.withdrawn(offset, Some(freedom));
    }
    evidence.push(Evidence {
        engine: "subgroup",
        scope: "every pose",
        bounds: (subgroups.lower, subgroups.upper),
        text: format!(
            "{}{}",
            subgroups.text,
            subgroups
                .steps
                .iter()
                .map(|s| format!("; {s}"))
                .collect::<String>()
        ),
    });
    if subgroups.finite == Some(freedom) {
        let mut found = PartFinding::regular(
            freedom,
            subgroups.class,
            CertificateLevel::Subgroup,
            subgroups.text.clone(),
        );
        one_branch(&mut found, more, None)?;
        return Ok(found.with(evidence));
    }
    if surplus == freedom as i64 {
        let text = "the closure equations at this pose are independent, so its motions form a manifold of exactly this \
                    dimension (implicit function theorem)";
        let mut found = PartFinding::regular(
            freedom,
            Some(subgroups.class.unwrap_or(MobilityClass::Trivial)),
            CertificateLevel::Numeric,
            text.to_owned(),
        );
        one_branch(&mut found, more, None)?;
        return Ok(found.with(evidence));
    }
    // Fewer equations than unknowns leave a motion over the complex numbers, but not always a real one (x² + y² = 0).
    let lower = subgroups.lower;
    let kernel = kernel_here()?;
    let Some(kernel) = kernel.as_ref().filter(|k| k.basis.complete) else {
        let why = format!(
            "{freedom} instantaneous freedoms in one block are too many to follow; driving or fixing some joints would decide"
        );
        return Ok(PartFinding::open(lower, freedom, why).with(evidence));
    };
    let mut chart = chart_test(pose, more, part, rank, kernel)?;
    // More digits would show a leftover near the pose; neither rounded numbers nor large parts have them. One of high order shows
    // farther away only.
    let only_far =
        rank.stated > 0.5 * chart.noise && !chart.literal || rank.unknowns() > LADDER_UNKNOWNS;
    if only_far {
        confirm_on_the_way(pose, part, rank, kernel, &mut chart)?;
    } else if chart.outcome == ChartOutcome::Regular && (rank.stated == 0.0 || chart.literal) {
        chart = far_chart(pose, more, part, rank, kernel, chart)?;
    }
    evidence.push(chart_evidence(&chart, freedom));
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
            let class = match subgroups.class {
                None => unexplained(pose, structure, part, rank, &chart)?,
                explained => explained,
            };
            let mut found = PartFinding::regular(freedom, class, CertificateLevel::Numeric, text);
            one_branch(&mut found, more, Some(kernel))?;
            Ok(found.with(evidence))
        }
        ChartOutcome::Singular { .. } => {
            let SingularFinding {
                mut found,
                more_evidence,
            } = singular_finding(pose, part, rank, kernel, &chart, lower)?;
            evidence.extend(more_evidence);
            found.class = None;
            Ok(found.with(evidence))
        }
        ChartOutcome::Thin => {
            let why = format!(
                "whether this pose is regular is open, since the margin is too thin: at a distance of {:.1e} the misfit is {:.1e}, \
                 and the noise may be {:.1e}; {}",
                chart.radius,
                chart.leftover,
                chart.noise,
                if rank.stated > 0.0 {
                    "more digits in the file would decide"
                } else {
                    "a pose farther from other branches would decide"
                }
            );
            Ok(PartFinding::open(lower, freedom, why).with(evidence))
        }
    }
}

/// A rounded part is followed so many steps of a quarter radian.
const FOLLOWED: usize = 10;

/// The least coefficient of the leftover's fourth order that would show on the way. Those of known singular poses are
/// 1e-5 and more.
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
    if rank.unknowns() > WALKED_UNKNOWNS
        || matches!(chart.outcome, ChartOutcome::Singular { .. })
        || chart.leftover > chart.noise
    {
        return Ok(());
    }
    let section = Section {
        mechanism: pose.mechanism,
        geometry: pose.geometry,
        part,
        metric: &kernel.metric,
    };
    let tangents = kernel.basis.vectors.clone();
    let freedom = tangents.len();
    let poses = pose.try_on(part, |states| {
        let stated = rank.stated;
        walk(
            &section,
            states,
            tangents,
            None,
            stated,
            FOLLOWED,
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
    let followed =
        poses.len() == FOLLOWED && poses.iter().all(|p| p.instantaneous == Some(freedom));
    let visible = LEAST_COEFFICIENT * farthest.min(2.0).powi(4) > chart.noise;
    chart.followed = farthest;
    chart.outcome = if followed && visible {
        ChartOutcome::Regular
    } else {
        ChartOutcome::Thin
    };
    Ok(())
}

fn chart_evidence(chart: &ChartTest, freedom: usize) -> Evidence {
    let (bounds, what) = match chart.outcome {
        ChartOutcome::Regular => ((freedom, Some(freedom)), "regular".to_owned()),
        ChartOutcome::Singular { order } => (
            (0, Some(freedom - 1)),
            format!("singular, leftover of order {order:.2}"),
        ),
        ChartOutcome::Thin => ((0, Some(freedom)), "margin too thin".to_owned()),
    };
    Evidence {
        engine: "chart",
        scope: "a neighbourhood",
        bounds,
        text: format!(
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
        ),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
