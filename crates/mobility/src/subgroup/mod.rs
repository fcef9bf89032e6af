//! Finite mobility by displacement subgroups: exact, and true at every pose where the same ranks hold.
//!
//! # The problem
//! A rank at one pose bounds the freedom from above. It equals the finite freedom where the map that the closure equations
//! set to the identity has *constant rank* near the pose: then its solutions form a manifold with tangent space ker J.
//! Whether it has cannot be seen from the rank at the pose, but it can often be seen from groups. Near the pose a joint is
//! a product of exponentials of its screws, so whatever a chain of joints does lies in the connected subgroup whose algebra
//! those screws generate (Hervé 1978), and a map onto a subgroup, or a product of two subgroups, has constant rank.
//!
//! # What is used, and why it is true
//! 1. *Loop spaces* (`loop_spaces`). The product around cycle l lies in a subgroup K_l of dimension m_l, so 6 − m_l of its
//!    equations hold identically, and the others are a map into Π K_l. If rank J = Σ m_l that map is a submersion at the
//!    pose, its fibre a manifold of dimension (unknowns − Σ m_l). Couplings are further equations and add one each. A basis
//!    of cycles is enough: in the loop group modulo the basis cycles only finitely many classes of commuting loops are
//!    left, so that its trivial representation is isolated (Weil 1964) and near the pose all loops close with the basis.
//! 2. *Bounds* (`bounds`). Let D(i, j) be a subgroup that holds the relative displacement of links i and j, to begin with that of their joint, or
//!    SE(3). That from i to j is that from i to k times that from k to j, so that D(i, j) may be replaced by D(i, j) ∩ ⟨D(i, k) ∘ D(k, j)⟩ for
//!    every third link k, until nothing changes. Links with E between them are one. A joint that is a product of two subgroups has a body
//!    between them; one that is a subgroup may be divided, its translations on either side of its rotation.
//! 3. *Independent chains* (`network`). If the groups that the chains of a cycle generate are independent, their product is an immersion at
//!    the identity, so that only the identities close the cycle: each chain stands still between its ends. A coupling of which all joints but one
//!    stand still holds the last.
//! 4. *Parallelograms* (`parallelogram`). A planar loop of four hinges with equal and parallel opposite sides has a motion in which its coupler
//!    is translated along a circle. Where its rank is three its configurations are a curve, so that motion is the curve, and the bound of opposite
//!    links is the plane's translations rather than all planar motions (Hervé and Sparacino 1991).
//! 5. *Counting* (`counting`). With what the bounds leave of the joints the part has the same configurations, and rule 1 applies again. What
//!    holds between two links may be added as a member of cycles (`chords`): two chains that sweep subgroups A and B between the same links ask for
//!    dim A + dim B − dim A∩B equations (Rico and Ravani 2003), less than dim ⟨A, B⟩ where the product is no group.
//!
//! In all of these the tangent space is ker J. So where they apply, the pose is regular and the finite freedom is the
//! instantaneous one; what the engine finds is *that*, and *why*. Both numbers are found independently and must agree.
//!
//! # What the answer satisfies
//! Ranks are decided with the margin of [`kutzbach_math::group::Margin`] on geometry as accurate as the part's rank was decided
//! with. Where a margin is thin, a larger group takes the place of what is not clear, which may mean no decision. Where a file is rounded, its subgroups are those within the stated
//! precision, and the text says so.
//!
//! # Cost
//! Rule 1: two or three decompositions of matrices of six rows for every cycle, 25 µs. The others: all triples of up to 16 bodies, otherwise those
//! that share a cycle; few groups differ, each two of them are composed and intersected once, and most compositions are told by a look
//! at their axes.

mod axes;
mod basis;
mod bodies;
mod bounds;
mod chords;
mod counting;
mod groups;
mod loop_spaces;
mod network;
mod offsets;
mod parallelogram;
mod placing;
mod words;

use super::pose_rank::PartRank;
use super::restricted::{LeftOut, without};
use super::vocabulary::MobilityClass;
use counting::Counted;
use kutzbach_closure::Structure;
use kutzbach_closure::{Geometry, JointState, Part, rounding_of};
use kutzbach_math::group::Margin;
use kutzbach_math::matrix::MatrixError;
use kutzbach_model::mechanism::Mechanism;
use loop_spaces::{LoopSpaces, loop_spaces};
pub(crate) use offsets::{drawn_hidden_offset, hidden_offset};

/// A subgroup found in numbers coarser than this says nothing.
const COARSEST: f64 = 0.05;

/// What displacement subgroups say about one part at its pose.
#[derive(Clone, Debug, PartialEq)]
pub struct SubgroupFinding {
    /// Dimension of the part's configuration space near the pose, which then is a manifold (the pose is regular); `None`
    /// where subgroups do not decide.
    pub finite: Option<usize>,
    /// Why the part is mobile; `None` where it is not, or where subgroups do not tell. Never
    /// [`MobilityClass::Paradoxical`]: that is what is mobile and not explained here.
    pub class: Option<MobilityClass>,
    /// Whether subgroups were looked for everywhere: what is then not explained is explained by none.
    pub looked: bool,
    /// The reason, in one sentence for a mechanical engineer.
    pub text: String,
    /// Reductions carried out, in order.
    pub steps: Vec<String>,
    /// Freedoms that are certain: those settled by the reductions.
    pub lower: usize,
    /// Greatest freedom possible by the rank at the pose; `None` where that is unknown.
    pub upper: Option<usize>,
    /// The smallest gap between singular values kept and dropped among the decisions that the answer rests on; infinite
    /// where nothing was dropped.
    pub margin: f64,
}

/// Asks for the finite mobility of a part by displacement subgroups at the pose of `states`, where its rank is `rank`.
///
/// # Errors
/// [`MatrixError`] where numbers overflow. That subgroups do not decide is a result, not an error.
pub fn subgroup_finding(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    structure: &Structure,
    part: &Part,
    rank: &PartRank,
) -> Result<SubgroupFinding, MatrixError> {
    let mut finding = SubgroupFinding {
        finite: None,
        class: None,
        looked: false,
        text: String::new(),
        steps: Vec::new(),
        lower: 0,
        upper: Some(greatest(rank)),
        margin: f64::INFINITY,
    };
    let open = |finding: SubgroupFinding, reason: &str| {
        Ok(SubgroupFinding {
            text: reason.to_owned(),
            ..finding
        })
    };
    let Some(decision) = rank.settled().filter(|_| is_plain(rank)) else {
        return open(
            finding,
            "the rank at this pose is open, so that subgroups are not looked for",
        );
    };
    let Some(freedom) = rank.instantaneous else {
        return open(finding, "the rank at this pose is open");
    };
    let accuracy = decision.accuracy;
    finding.margin = decision.gap;
    let independent = rank.unknowns() - freedom;
    let reading = words::reading(rank);
    if independent == rank.equations() {
        finding.decide(freedom, MobilityClass::Trivial);
        finding.text = words::independent(part, independent, reading);
        return Ok(finding);
    }
    if !(accuracy < COARSEST) {
        return open(
            finding,
            "the numbers are too coarse for subgroups to be recognised in them",
        );
    }
    let wanted = independent.checked_sub(part.couplings.len());
    let spaces = wanted.map(|wanted| loop_spaces(part, rank, accuracy, wanted));
    match spaces.transpose().map(Option::flatten) {
        Ok(Some(LoopSpaces { algebras, margin })) => {
            finding.decide(freedom, MobilityClass::Trivial);
            finding.margin = finding.margin.min(margin.gap());
            let frame = placing::cycle_frame(mechanism, geometry, states, part, rank);
            finding.text = words::loop_spaces(mechanism, part, &algebras, frame.as_ref(), reading);
            return Ok(finding);
        }
        Ok(None) => {}
        Err(error) => return open(finding, &words::failure(&error)),
    }
    if freedom == 0 {
        finding.decide(0, MobilityClass::Trivial);
        finding.text = format!(
            "{reading}no velocity at all satisfies the closure equations: the part stands still, whatever its subgroups"
        );
        return Ok(finding);
    }
    let placed = match placing::place(mechanism, geometry, states, part, rank, accuracy) {
        Ok(placed) => placed,
        Err(error) => return open(finding, &words::failure(&error)),
    };
    match counting::count(mechanism, structure, part, &placed, freedom) {
        Ok(counted) => {
            finding.adopt(mechanism, part, &counted, freedom, reading);
            // Axes that coincide within the digits may be two, between which nothing turns without effect.
            let rounding = rounding_of(&rank.jacobian.walks, f64::EPSILON);
            if finding.finite.is_none() && rank.open_by_digits() > rounding {
                finding.lower = 0;
            }
        }
        Err(error) => return open(finding, &words::failure(&error)),
    }
    if finding.finite.is_none() && couplings_repeat(part, rank, freedom) {
        return open(
            finding,
            "couplings repeat what loops or others ask for, and what they leave to chains forms no subgroups",
        );
    }
    finding.looked = true;
    Ok(finding)
}

/// Whether couplings do not take one freedom each from what the loops leave.
fn couplings_repeat(part: &Part, rank: &PartRank, freedom: usize) -> bool {
    let couplings = part.couplings.len();
    let out = LeftOut {
        couplings: (0..couplings).collect(),
        ..LeftOut::default()
    };
    couplings > 0
        && without(part, rank, &out)
            .is_none_or(|(_, left)| left.instantaneous != Some(freedom + couplings))
}

impl SubgroupFinding {
    /// What is left of a finding by subgroups that were recognised although two screws are apart by `offset` (rad, part lengths), which
    /// doubles do not see.
    pub(crate) fn withdrawn(self, offset: f64, greatest: Option<usize>) -> Self {
        Self {
            finite: None,
            class: None,
            looked: false,
            text: format!(
                "two axes differ by {offset:.1e} (rad, lengths of the part) only, so that subgroups are not looked for"
            ),
            steps: Vec::new(),
            lower: 0,
            upper: greatest,
            margin: self.margin,
        }
    }

    fn decide(&mut self, freedom: usize, class: MobilityClass) {
        self.finite = Some(freedom);
        self.class = (freedom > 0).then_some(class);
        self.lower = freedom;
        self.upper = Some(freedom);
    }

    /// Takes over what bounds between all links leave, where that is what the rank leaves.
    fn adopt(
        &mut self,
        mechanism: &Mechanism,
        part: &Part,
        counted: &Counted,
        freedom: usize,
        reading: &str,
    ) {
        // Less than the rank leaves is no bound: over the reals fewer equations than unknowns may have an isolated solution.
        if counted.least < freedom {
            self.lower = counted.idle.min(freedom);
            self.text = words::unexplained();
            return;
        }
        self.margin = self.margin.min(counted.margin.gap());
        if counted.least > freedom {
            self.text = words::contradiction(counted.least, freedom);
            return;
        }
        let class = match counted.by_cycles_alone {
            true => MobilityClass::Trivial,
            false => MobilityClass::Exceptional,
        };
        self.decide(freedom, class);
        self.text = format!("{reading}{}", words::counted(mechanism, part, counted));
        self.steps = words::steps(mechanism, counted);
    }
}

/// Whether the rank is that of the mechanism meant, or of the numbers taken literally by choice. See [`PartRank::note`]:
/// what is decided only literally though the stated precision is fine enough to matter is not plain, nor is a part held
/// fast by more equations than unknowns in numbers too coarse to repeat any.
fn is_plain(rank: &PartRank) -> bool {
    let held = rank.instantaneous == Some(0) && rank.equations() > rank.unknowns();
    match &rank.note {
        None => true,
        Some(_) if rank.is_taken_literally() => !held,
        Some(_) => rank.as_written != rank.instantaneous,
    }
}

/// The greatest freedom that the rank leaves possible.
fn greatest(rank: &PartRank) -> usize {
    if rank.is_taken_literally() && rank.instantaneous == Some(0) {
        return rank.unknowns();
    }
    rank.instantaneous.unwrap_or(0).max(rank.candidates.1)
}

/// A margin good enough to rest an answer on.
fn clear(margin: Margin) -> bool {
    margin.is_clear()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod random_networks;
#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
