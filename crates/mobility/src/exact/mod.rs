//! Exact algebra about one part at the pose drawn, where it decides within a budget.
//!
//! # The problem
//! All other engines compute with rounded arithmetic and a margin. Where the numbers of a part are exact and algebraic, its
//! closure is a system of polynomials of which the drawn pose is an exact solution, and some statements about it can be
//! proved.
//!
//! # What is proved, and by what
//! 1. *Upper bounds.* Modulo a prime that divides no denominator, neither the dimension of the tangent space nor that of
//!    the complex solution set at the pose is smaller than the true one. For tangents: no rank modulo a prime exceeds the
//!    true rank. For solutions: fibre dimension is upper semicontinuous along a section (Chevalley; EGA IV 13.1.3). One prime
//!    is enough. Real motions are among the complex ones, and a system that leaves something out (a screw taken as a sleeve) has
//!    more solutions, not fewer, so that its bound holds too.
//! 2. *Equality.* The bound 0 needs nothing else. Where the tangent space has as many dimensions as independent equations
//!    leave, the real solutions are a manifold of that dimension (implicit function theorem). Elsewhere the dimension must not
//!    be smaller over the rationals than modulo the prime; that follows from a Groebner basis in whose computation no number
//!    was replaced by its remainder, which is asked for where all numbers are rational. If it equals that of the tangent space,
//!    the pose is a smooth point, of real solutions as well.
//! 3. *The complex dimension* is known where bound and count of equations meet: no component through a solution of m equations
//!    in n unknowns has fewer than n − m dimensions (Krull). It may exceed the real one: x² + y² = 0.
//!
//! A global dimension found modulo primes would be quicker at times, but proves no upper bound at the pose: it is of all
//! components, and over the rationals it is known only with the whole basis. It is not used.
//!
//! # What it is not asked
//! Rounded numbers. A file of decimals with a stated precision means a mechanism nearby, not its fractions: taken literally,
//! a Bennett loop of six decimals is rigid, exactly and beyond doubt, and that is not the question. So it is only asked
//! about numbers that are exact by D13: expressions, or all decimals of a file that has two at most; couplings and a
//! configuration's values likewise, which the precision of the geometry does not cover.
//!
//! Where the pose was assembled, a rounded point near it is known. What is asked then is the whole solution set (`closing.rs`): where
//! it is finite every pose is isolated, whichever it is, and no pose has more freedoms than the set has dimensions.
//!
//! # Cost
//! The budget is counted in matrix entries, not in time: the same file gives the same report on every machine. It is asked
//! last, and only of parts that stay open or have a numeric certificate.

mod agreement;
mod budget;
mod closing;
mod question;

pub use budget::{ExactAllowance, ExactBudget};
pub(crate) use closing::{Whole, solved};

use super::claim::{Bounds, Claim};
use super::judge::PartFinding;
use super::pose_rank::{PartRank, Pose};
use super::vocabulary::{CertificateLevel, EngineName, Scope};
use agreement::claim;
use kutzbach_algebra::{Budget, Formulation, Stop, SystemOptions, polynomial_system};
use kutzbach_closure::Part;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Configuration, CouplingTerm, JointId, Mechanism, Precision};
use question::{Most, Question};

/// Mechanisms with more joints are not asked about: their equations take longer to write than others to solve.
const MOST_JOINTS: usize = 200;

/// Parts with more joints or joint variables are not asked about.
const MOST_PART_JOINTS: usize = 60;
const MOST_PART_UNKNOWNS: usize = 80;

/// What exact algebra proves about a part at its pose.
#[derive(Clone, Debug, PartialEq, Eq)]
struct ExactFinding {
    /// Dimension of the tangent space of the equations, an upper bound.
    tangent: usize,
    /// No component of the complex solution set through the pose has more dimensions. Proven.
    upper: usize,
    /// Finite mobility, where it is proven.
    proven: Option<usize>,
    /// Dimension of the complex solution set at the pose; proven where the count of equations or a basis over the
    /// rationals gives it as the lower bound, elsewhere two primes agree on it. `None` where the system leaves something out,
    /// or the dimension was only bounded.
    complex_dimension: Option<usize>,
    /// What the finite mobility rests on, in a sentence.
    certificate: String,
    /// Figures.
    text: String,
}

/// Asks exact algebra about a part and puts the answer together with what the other engines found.
pub(super) fn ask_exact(
    pose: &Pose<'_>,
    part: &Part,
    rank: &PartRank,
    found: &mut PartFinding,
    allowance: &mut ExactAllowance,
) {
    let undecided = found.open().is_some() || found.level() == CertificateLevel::Numeric;
    if !undecided || allowance.each == 0 || part.joints.is_empty() {
        return;
    }
    let drawn = |&joint: &usize| pose.states[joint].values == pose.geometry.states[joint].values;
    let at_home = part.joints.iter().all(drawn).then(|| {
        let budget = allowance.of_a_part();
        let most = Most {
            work: allowance.each.min(allowance.left),
            memory: allowance.memory,
        };
        let answer = exact_finding(pose, part, rank, found, &budget, most);
        allowance.take(&budget);
        answer
    });
    let answer = match at_home {
        Some(Ok(Some(exact))) => Ok(exact),
        Some(Err(why)) => Err(why),
        // Assembled, or drawn closed within rounding only.
        Some(Ok(None)) | None => closing::everywhere(pose, part, rank, found, allowance),
    };
    match answer {
        Ok(exact) => {
            let claim = claim(found, rank, exact);
            found.take(claim);
        }
        Err(why) => found.take(Claim::of(
            EngineName::Exact,
            Scope::PoseComplex,
            Bounds::ANY,
            why,
        )),
    }
}

/// Whether a part's numbers are exact by D13, those of its couplings included, and the values at which a configuration holds its joints.
/// Where a joint only begins says nothing about the mechanism: whether the equations hold there is asked of the equations.
fn numbers_are_exact(
    mechanism: &Mechanism,
    configuration: Option<&Configuration>,
    part: &Part,
) -> bool {
    let joint_numbers = |&joint: &usize| {
        let joint = &mechanism.joints()[joint];
        [&joint.predecessor.frame, &joint.successor.frame]
            .into_iter()
            .flat_map(|frame| frame.position.iter().chain(&frame.roll_pitch_yaw))
            .chain(&joint.axis.0)
            .chain(&joint.axis2.0)
            .chain(&joint.lead)
            .chain(&joint.distance)
            .all(|number: &Number| number.stated().is_none() && number.inputs().is_empty())
    };
    let geometry = mechanism.is_exact(&part.joints) || part.joints.iter().all(joint_numbers);
    let chosen = |number: &Number| {
        let stated = number.stated();
        stated.is_none_or(|s| s.decimals <= Precision::EXACT_DECIMALS)
    };
    let couplings = part.couplings.iter().all(|&coupling| {
        let coupling = &mechanism.couplings()[coupling];
        chosen(&coupling.offset)
            && coupling
                .terms
                .iter()
                .flat_map(CouplingTerm::factors)
                .all(chosen)
    });
    let values = configuration.is_none_or(|c| {
        let counts = |joint: &JointId| part.joints.contains(&joint.0) && !c.free.contains(joint);
        let mut held = c.positions.iter().filter(|(joint, _)| counts(joint));
        held.all(|(_, values)| values.iter().all(chosen))
    });
    geometry && couplings && values
}

/// Whether a part has too many joints to be asked about, or the mechanism.
fn is_too_large(mechanism: &Mechanism, part: &Part) -> bool {
    let unknowns = |&joint: &usize| mechanism.joints()[joint].freedom();
    mechanism.joints().len() > MOST_JOINTS
        || part.joints.len() > MOST_PART_JOINTS
        || part.joints.iter().map(unknowns).sum::<usize>() > MOST_PART_UNKNOWNS
}

/// A product of terms of a closure takes as long as so many matrix entries at least.
const WORK_PER_PRODUCT: u64 = 5;

/// A term around the pose is read, sorted and reduced at the cost of so many matrix entries at least.
const WORK_PER_TERM: u64 = 5;

/// What can be proved, or why nothing can; nothing where the pose drawn is not known to be an exact solution.
fn exact_finding(
    pose: &Pose<'_>,
    part: &Part,
    rank: &PartRank,
    found: &PartFinding,
    budget: &Budget,
    most: Most,
) -> Result<Option<ExactFinding>, String> {
    let mechanism = pose.mechanism;
    let exact = numbers_are_exact(mechanism, pose.configuration, part);
    if rank.open_by_digits() > 0.0 || rank.is_taken_literally() || !exact {
        return Err("not asked: the numbers are rounded".to_owned());
    }
    if is_too_large(mechanism, part) {
        return Err("not asked: too many joints".to_owned());
    }
    // Reading numbers and writing equations is work too, by measurement about so much.
    budget
        .spend(100 * mechanism.joints().len() as u64)
        .map_err(stopped)?;
    let options = SystemOptions {
        formulation: Formulation::Tree,
        configuration: pose.configuration.map(|c| c.name.clone()),
        joints: Some(part.joints.iter().map(|&j| JointId(j)).collect()),
        most_products: Some(most.work / WORK_PER_PRODUCT),
        ..SystemOptions::default()
    };
    let system = polynomial_system(mechanism, &options)
        .map_err(|error| format!("no polynomial equations: {error}"))?;
    let terms = system.terms_at_home();
    if terms.saturating_mul(WORK_PER_TERM) > most.work {
        return Err(format!(
            "not asked: around the pose its equations have {terms} terms, more than its budget reads"
        ));
    }
    budget.spend(terms).map_err(stopped)?;
    if !system.fits_at_home(most.memory) {
        let gigabytes = most.memory as f64 / 1e9;
        return Err(format!(
            "not asked: around the pose its equations have more terms than {gigabytes} GB of memory hold (`--memory`)"
        ));
    }
    let Some(modular) = system.home_modulo(0, most.memory) else {
        return Ok(None);
    };
    let question = Question {
        system: &system,
        modular: &modular,
        rank,
        found,
        budget,
        most,
    };
    question.answer().map(Some)
}

fn stopped(stop: Stop) -> String {
    format!("nothing within its budget: {stop}")
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
