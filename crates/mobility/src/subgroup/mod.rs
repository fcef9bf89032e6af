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
//! A *chain* is a smooth map φ from its joint variables (f of them) into SE(3), φ = identity at the pose, with the span W
//! of its screws as image of its derivative, and values in a subgroup with algebra K ⊇ W.
//!
//! 1. *Loop spaces* (`loop_spaces`). The product around cycle l lies in a subgroup of dimension m_l, so 6 − m_l of its
//!    equations hold identically, and the others are a map into Π K_l. If rank J = Σ m_l that map is a submersion at the
//!    pose, its fibre a manifold of dimension (unknowns − Σ m_l). Couplings are further equations and add one each. A basis
//!    of cycles is enough: in the loop group modulo the basis cycles only finitely many classes of commuting loops are
//!    left, so that its trivial representation is isolated (Weil 1964) and near the pose all loops close with the basis.
//! 2. *One loop* (`one_loop`). Cut a loop at two places. If W = K = a for one chain and W = K = b for the other, both
//!    chains are submersions onto subgroups A and B, and A × B → SE(3), (a, b) ↦ a b has constant rank, because
//!    translations by A on the left and B on the right carry any point to any other. So the loop's configurations are a
//!    manifold of dimension (f_A − dim A) + (f_B − dim B) + dim A∩B (Rico and Ravani 2003). Cut at more places, if the
//!    algebras of the chains are independent (their dimensions add up to the rank), the product of the subgroups is an
//!    immersion at the identity, so that only the identities close the loop: the chains move within themselves, and nothing
//!    else does. A joint that is a subgroup may be cut, its translations on either side of its rotation.
//! 3. *Networks* (`network`). The links are nodes, the joints edges. Chains through links of two joints are chains again. Two
//!    chains between the same two links form a loop; if rule 1 or 2 applies to it, its configurations are a manifold Q of
//!    dimension f₁ + f₂ − dim(W₁ + W₂), and the relative displacement of the two links is a smooth map on Q with derivative
//!    onto W₁ ∩ W₂ and values in K₁ ∩ K₂: one chain again, that replaces both. A chain with W = K is a product of its
//!    subgroup and of (f − dim W) variables that do nothing else (a submersion is locally a projection); those are counted
//!    and forgotten. A chain without freedom makes two links one. A chain of all of SE(3) with W = K lets its links do what
//!    they like: given their displacement, its six variables follow, so it is removed. A link on a single chain follows it.
//!    In each case the configurations before are a product of those after with a known number of free variables.
//! 4. What is left where nothing more can be replaced is a smaller network of chains, to which rule 1 applies as before.
//! 5. *Any network* (`counting`). Let D(i, j) be a subgroup that holds the relative displacement of links i and j. It may be replaced by
//!    D(i, j) ∩ ⟨D(i, k) ∘ D(k, j)⟩ for every third link k, until nothing changes (`bounds`): then loops that share joints act on one another,
//!    which links in series and in parallel do not show. Independent groups around a cycle (rule 2) are E; a coupling of which all
//!    joints but one stand still holds the last. With what this leaves of the joints, cycles are counted again as in rule 1.
//!
//! A planar loop of four hinges with equal and parallel opposite sides (`parallelogram`) has a motion in which its coupler
//! is translated along a circle. Where rule 1 makes the loop's configurations a curve, that motion is the curve, so the
//! loop is a chain with values in the plane's translations rather than in all planar motions (Hervé and Sparacino 1991).
//!
//! *Couplings* are linear functions on the configurations that the loops leave; where these are a manifold by the rules above and the
//! rank falls by one for each coupling, the functions are independent there, and what they leave is a manifold again.
//!
//! In all of these the tangent space is ker J. So where they apply, the pose is regular and the finite freedom is the
//! instantaneous one; what the engine finds is *that*, and *why*. Both numbers are found independently and must agree.
//!
//! # What the answer satisfies
//! Ranks are decided with the margin of [`kutzbach_math::group::Margin`] on geometry as accurate as the part's rank was decided
//! with. A thin margin anywhere means no decision. Where a file is rounded, its subgroups are those within the stated
//! precision, and the text says so.
//!
//! # Cost
//! Rule 1: two or three decompositions of matrices of six rows for every cycle, 25 µs. Rule 2: at most one for every pair
//! of cuts, of which loops have up to [`MOST_CUTS`](one_loop::MOST_CUTS); most chains are ruled out by a look at their
//! axes. Rule 3: one such loop for every pair of chains between the same links, on parts of up to [`MOST_JOINTS`] joints. Rule 5:
//! all triples of up to 16 bodies, otherwise those that share a cycle; few groups differ, and each two of them are composed and
//! intersected once.

mod axes;
mod basis;
mod bodies;
mod bounds;
mod chain;
mod counting;
mod groups;
mod loop_spaces;
mod network;
mod offsets;
mod one_loop;
mod parallelogram;
mod placing;
mod remainder;
mod words;

use super::pose_rank::PartRank;
use super::restricted::{LeftOut, without};
use super::vocabulary::MobilityClass;
use counting::Counted;
use kutzbach_closure::Structure;
use kutzbach_closure::{Geometry, JointState, Part};
use kutzbach_math::group::{GroupError, Margin};
use kutzbach_math::matrix::MatrixError;
use kutzbach_model::mechanism::Mechanism;
use loop_spaces::{LoopSpaces, loop_spaces};
use network::{Network, Outcome};
pub(crate) use offsets::hidden_offset;

/// Parts of more joints are not reduced chain by chain.
pub const MOST_JOINTS: usize = 400;

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
    let found = if part.couplings.is_empty() {
        finding.looked = true;
        reduced(mechanism, structure, part, &placed)
            .map(|outcome| finding.adopt(outcome, freedom, reading))
    } else {
        let uncoupled = uncoupled(mechanism, geometry, states, structure, part, rank)?;
        finding.adopt_coupled(uncoupled, part.couplings.len(), freedom);
        Ok(())
    };
    let counted = match found {
        Ok(()) if finding.finite.is_some() => return Ok(finding),
        Ok(()) => counting::count(mechanism, part, &placed, freedom),
        Err(error) => Err(error),
    };
    match counted {
        Ok(counted) => finding.adopt_count(mechanism, &counted, freedom, reading),
        Err(error) => return open(finding, &words::failure(&error)),
    }
    Ok(finding)
}

/// The finding without couplings, where each of them takes one freedom.
fn uncoupled(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    structure: &Structure,
    part: &Part,
    rank: &PartRank,
) -> Result<Option<SubgroupFinding>, MatrixError> {
    let couplings = part.couplings.len();
    let out = LeftOut {
        couplings: (0..couplings).collect(),
        ..LeftOut::default()
    };
    let wanted = rank.instantaneous.map(|freedom| freedom + couplings);
    let Some((part, rank)) =
        without(part, rank, &out).filter(|(_, left)| left.instantaneous == wanted)
    else {
        return Ok(None);
    };
    subgroup_finding(mechanism, geometry, states, structure, &part, &rank).map(Some)
}

/// The part reduced by its chains in series and in parallel.
fn reduced(
    mechanism: &Mechanism,
    structure: &Structure,
    part: &Part,
    placed: &placing::Placed,
) -> Result<Outcome, GroupError> {
    if part.joints.len() > MOST_JOINTS {
        return Ok(Outcome {
            freedom: None,
            settled: 0,
            text: words::stuck(0, 0),
            steps: Vec::new(),
            margin: Margin::CERTAIN,
        });
    }
    let mut network = Network::new(mechanism, structure, part, placed)?;
    network.reduce()?;
    network.conclude()
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

    /// Takes over what was found without couplings, of which each takes one freedom.
    fn adopt_coupled(&mut self, found: Option<Self>, couplings: usize, freedom: usize) {
        let Some(found) = found else {
            self.text = "couplings repeat what loops or others ask for, and what they leave to chains forms no subgroups"
                .to_owned();
            return;
        };
        self.looked = found.looked;
        self.text = found.text;
        if found.finite.is_some() {
            self.decide(freedom, found.class.unwrap_or(MobilityClass::Trivial));
            self.margin = self.margin.min(found.margin);
            self.steps = found.steps;
            self.text = words::coupled(&self.text, couplings);
        }
    }

    /// Takes over what bounds between all links leave, where that is what the rank leaves.
    fn adopt_count(
        &mut self,
        mechanism: &Mechanism,
        counted: &Counted,
        freedom: usize,
        reading: &str,
    ) {
        // Less than the rank leaves is no bound: over the reals fewer equations than unknowns may have an isolated solution.
        if counted.least < freedom {
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
        self.text = format!("{reading}{}", words::counted(mechanism, counted));
        self.steps = words::confined(mechanism, counted);
    }

    fn adopt(&mut self, outcome: Outcome, freedom: usize, reading: &str) {
        self.steps = outcome.steps;
        self.margin = self.margin.min(outcome.margin.gap());
        match outcome.freedom {
            Some(found) if found == freedom => {
                self.decide(freedom, MobilityClass::Exceptional);
                self.text = format!("{reading}{}", outcome.text);
            }
            Some(found) => self.text = words::contradiction(found, freedom),
            None => {
                self.lower = outcome.settled.min(freedom);
                self.text = outcome.text;
            }
        }
    }
}

/// Whether the rank is that of the mechanism meant, or of the numbers taken literally by choice. See [`PartRank::note`]:
/// what is decided only literally though the stated precision is fine enough to matter is not plain, nor is a part held
/// fast by more equations than unknowns in numbers too coarse to repeat any.
fn is_plain(rank: &PartRank) -> bool {
    let held = rank.instantaneous == Some(0) && rank.equations() > rank.unknowns();
    match &rank.note {
        None => true,
        Some(_) if rank.taken_literally => !held,
        Some(_) => rank.as_written != rank.instantaneous,
    }
}

/// The greatest freedom that the rank leaves possible.
fn greatest(rank: &PartRank) -> usize {
    if rank.taken_literally && rank.instantaneous == Some(0) {
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
