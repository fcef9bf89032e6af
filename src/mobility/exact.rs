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
//! configuration's values likewise, which the precision of the geometry does not cover. Nor is it asked where the pose was
//! assembled: what is known of that pose is a rounded point near it.
//!
//! # Cost
//! The budget is counted in matrix entries, not in time: the same file gives the same report on every machine. It is asked
//! last, and only of parts that stay open or have a numeric certificate.

use super::part_mobility::{Evidence, PartFinding};
use super::pose_rank::{PartRank, Pose};
use super::vocabulary::{CertificateLevel, MobilityClass, PoseKind, SingularKind};
use crate::algebra::{
    Budget, Formulation, Limits, ModularSystem, MonomialOrder, Polynomial, PolynomialSystem,
    Rational, Stop, SystemOptions, groebner_basis, local_dimension_is_at_most,
    local_dimension_modulo, polynomial_system,
};
use crate::closure::Part;
use crate::mechanism::{JointId, Precision};
use crate::number::Number;

/// Matrix entries that are eliminated in about a second (release build, one core of a machine of 2024).
const WORK_PER_SECOND: f64 = 5e6;

/// How long exact algebra may take for one part where nothing is said.
const SECONDS: f64 = 0.2;

/// A matrix larger than this is not made: some hundred megabytes.
const MOST_ENTRIES: u64 = 20_000_000;

/// The parts of a mechanism share so many times the budget of one.
const PARTS: u64 = 5;

/// Mechanisms with more joints are not asked about: their equations take longer to write than others to solve.
const MOST_JOINTS: usize = 200;

/// Parts with more joints or joint variables are not asked about.
const MOST_PART_JOINTS: usize = 60;
const MOST_PART_UNKNOWNS: usize = 80;

/// Systems of more unknowns are asked for their tangent space only.
const MOST_VARIABLES: usize = 60;

/// How much work exact algebra may do, for each part of a mechanism.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ExactBudget {
    work: u64,
}

impl Default for ExactBudget {
    /// About 0.2 s.
    fn default() -> Self {
        Self::seconds(SECONDS)
    }
}

impl ExactBudget {
    /// Exact algebra is not asked.
    #[must_use]
    pub fn none() -> Self {
        Self { work: 0 }
    }

    /// About as much work as takes so many seconds, the same on every machine. No time, or none that is a number, is
    /// [`Self::none`].
    #[must_use]
    pub fn seconds(seconds: f64) -> Self {
        // Saturating; not a number becomes zero.
        Self {
            work: (seconds * WORK_PER_SECOND) as u64,
        }
    }

    /// Work, in matrix entries.
    #[must_use]
    pub fn work(self) -> u64 {
        self.work
    }
}

/// What the parts of one mechanism may still spend.
#[derive(Debug)]
pub(super) struct ExactAllowance {
    each: u64,
    left: u64,
}

impl ExactAllowance {
    pub(super) fn new(budget: ExactBudget) -> Self {
        Self {
            each: budget.work,
            left: budget.work.saturating_mul(PARTS),
        }
    }
}

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
    let undecided = found.open.is_some() || found.level == CertificateLevel::Numeric;
    if !undecided || allowance.each == 0 || part.joints.is_empty() {
        return;
    }
    let work = allowance.each.min(allowance.left);
    let budget = Budget::new(Limits {
        work: Some(work),
        entries: Some(MOST_ENTRIES),
        ..Limits::default()
    });
    let answer = exact_finding(pose, part, rank, found, &budget);
    allowance.left -= budget.work().min(work);
    match answer {
        Ok(exact) => {
            let bounds = (exact.proven.unwrap_or(0), Some(exact.upper));
            found.evidence.push(evidence(bounds, exact.text.clone()));
            combine(found, rank, exact);
        }
        Err(why) => found.evidence.push(evidence((0, None), why)),
    }
}

fn evidence(bounds: (usize, Option<usize>), text: String) -> Evidence {
    Evidence {
        engine: "exact",
        scope: "this pose, complex",
        bounds,
        text,
    }
}

/// Whether a part's numbers are exact by D13, those of its couplings and of the configuration included.
fn numbers_are_exact(pose: &Pose<'_>, part: &Part) -> bool {
    let mechanism = pose.mechanism;
    let joint_numbers = |&joint: &usize| {
        let joint = &mechanism.joints()[joint];
        [&joint.predecessor.frame, &joint.successor.frame]
            .into_iter()
            .flat_map(|frame| frame.position.iter().chain(&frame.roll_pitch_yaw))
            .chain(&joint.axis.0)
            .chain(&joint.axis2.0)
            .chain(&joint.lead)
            .chain(&joint.distance)
            .all(|number: &Number| number.stated().is_none())
    };
    let geometry = mechanism.precision().is_exact() || part.joints.iter().all(joint_numbers);
    let chosen = |number: &Number| {
        let stated = number.stated();
        stated.is_none_or(|s| s.decimals <= Precision::EXACT_DECIMALS)
    };
    let couplings = part.couplings.iter().all(|&coupling| {
        let coupling = &mechanism.couplings()[coupling];
        chosen(&coupling.offset) && coupling.terms.iter().all(|term| chosen(&term.factor))
    });
    let positions = pose.configuration.iter().flat_map(|c| &c.positions);
    geometry && couplings && positions.flat_map(|(_, values)| values).all(chosen)
}

/// What can be proved, or why nothing can.
fn exact_finding(
    pose: &Pose<'_>,
    part: &Part,
    rank: &PartRank,
    found: &PartFinding,
    budget: &Budget,
) -> Result<ExactFinding, String> {
    let mechanism = pose.mechanism;
    if rank.stated > 0.0 || rank.taken_literally || !numbers_are_exact(pose, part) {
        return Err("not asked: the numbers are rounded".to_owned());
    }
    let drawn = |&joint: &usize| pose.states[joint].values == pose.geometry.states[joint].values;
    if !part.joints.iter().all(drawn) {
        return Err(
            "not asked: the pose was assembled, and is known approximately only".to_owned(),
        );
    }
    if mechanism.joints().len() > MOST_JOINTS
        || part.joints.len() > MOST_PART_JOINTS
        || rank.unknowns() > MOST_PART_UNKNOWNS
    {
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
        ..SystemOptions::default()
    };
    let system = polynomial_system(mechanism, &options)
        .map_err(|error| format!("no polynomial equations: {error}"))?;
    let modular = system
        .home_modulo(0)
        .ok_or("the pose drawn is not known to be an exact solution")?;
    Question {
        system: &system,
        modular: &modular,
        rank,
        found,
        budget,
    }
    .answer()
}

fn stopped(stop: Stop) -> String {
    format!("nothing within its budget: {stop}")
}

/// A part as a polynomial system, with the drawn pose at the origin modulo a prime.
struct Question<'a> {
    system: &'a PolynomialSystem,
    modular: &'a ModularSystem,
    rank: &'a PartRank,
    found: &'a PartFinding,
    budget: &'a Budget,
}

impl Question<'_> {
    fn answer(&self) -> Result<ExactFinding, String> {
        let variables = self.modular.variables.len();
        let equations = self.modular.equations.len();
        let tangent = tangent_dimension(self.modular, self.budget).map_err(stopped)?;
        let surplus = self.rank.unknowns() as i64 - self.rank.equations() as i64;
        let whole = self.system.is_exact();
        let count = variables as i64 - equations as i64;
        let mut text = format!(
            "{equations} equations in {variables} unknowns{}; modulo the prime {}: tangent space of dimension {tangent}",
            if whole { "" } else { ", some left out" },
            self.modular.prime
        );
        let mut answer = ExactFinding {
            tangent,
            upper: tangent,
            proven: None,
            complex_dimension: None,
            certificate: String::new(),
            text: String::new(),
        };
        if tangent == 0 {
            answer.prove(
                0,
                "no velocity at all satisfies the closure equations at this pose: already modulo one prime their rank is full, \
                 and the true rank is not smaller",
            );
        } else if surplus == tangent as i64 || (whole && count == tangent as i64) {
            answer.prove(
                tangent,
                "the closure equations at this pose are independent, already modulo one prime, so its motions form a manifold \
                 of exactly this dimension (implicit function theorem)",
            );
        } else if variables > MOST_VARIABLES {
            text.push_str("; too many unknowns for more");
        } else if let Err(stop) = self.local(&mut answer, &mut text, count.max(surplus)) {
            text.push_str(&format!("; no more within its budget: {stop}"));
        }
        text.push_str(&format!("; work {}", self.budget.work()));
        answer.text = text;
        Ok(answer)
    }

    /// The dimension of the solution set at the pose: bounded from above modulo a prime; from below by counting (`least`),
    /// or over the rationals.
    fn local(&self, answer: &mut ExactFinding, text: &mut String, least: i64) -> Result<(), Stop> {
        let whole = self.system.is_exact();
        let least = usize::try_from(least).unwrap_or(0);
        // That a bound is not exceeded is known before the dimension is. Where the tangent space is no larger, the dimension
        // itself is worth knowing: it could be less than the others think.
        let expected = self.found.lower.max(least);
        answer.upper = if expected < answer.tangent && self.is_at_most(expected)? {
            expected
        } else {
            self.dimension(self.modular)?
        };
        text.push_str(&format!(
            ", solutions of dimension at most {}",
            answer.upper
        ));
        if answer.upper == 0 {
            answer.prove(
                0,
                "this pose is an isolated solution of the closure equations, over the complex numbers too: their local \
                 dimension is 0 modulo one prime, and the true one is not larger",
            );
            return Ok(());
        }
        if !whole {
            return Ok(());
        }
        if least == answer.upper {
            answer.complex_dimension = Some(least);
            text.push_str(", and no less by the number of equations");
        }
        if answer.upper == answer.tangent
            && let Some(point) = self.rational_point()
        {
            let tt = std::time::Instant::now();
            let over_rationals = self.over_rationals(&point);
            eprintln!("W rational {} {:?} {:?}", self.budget.work(), tt.elapsed(), over_rationals);
            let over_rationals = over_rationals?;
            if over_rationals == Some(answer.upper) {
                answer.prove(
                    answer.upper,
                    "at this pose the solutions of the closure equations have as many dimensions as their tangent space, by a \
                     Groebner basis over the rational numbers, so that they form a manifold of exactly this dimension",
                );
            }
            if let Some(dimension) = over_rationals {
                text.push_str(&format!("; over the rationals {dimension}"));
            }
        }
        if answer.complex_dimension.is_none()
            && answer.upper > self.found.lower
            && let Some(second) = self.system.home_modulo(1)
        {
            let again = self.dimension(&second)?;
            text.push_str(&format!(", modulo {} at most {again}", second.prime));
            // Were the true dimension smaller than the first bound, the second would be too, but for rare primes.
            answer.complex_dimension = (again == answer.upper).then_some(again);
            answer.upper = answer.upper.min(again);
        }
        Ok(())
    }

    /// Whether the local dimension is shown to be at most this.
    fn is_at_most(&self, bound: usize) -> Result<bool, Stop> {
        let system = self.modular;
        local_dimension_is_at_most(
            bound,
            &system.equations,
            system.variables.len(),
            system.prime,
            self.budget,
        )
    }

    /// The local dimension modulo the prime.
    fn dimension(&self, system: &ModularSystem) -> Result<usize, Stop> {
        let ring = local_dimension_modulo(
            &system.equations,
            system.variables.len(),
            system.prime,
            self.budget,
        )?;
        // The drawn pose is a solution; `None` cannot be.
        Ok(ring.map_or(0, |ring| ring.dimension))
    }

    /// The pose drawn, where all numbers are rational.
    fn rational_point(&self) -> Option<Vec<Rational>> {
        if self.modular.variables.len() != self.system.variables.len() {
            return None;
        }
        self.system.home.exact()?.iter().map(rational).collect()
    }

    /// A lower bound of the local dimension over the rationals, nothing left to primes; `None` where it could not be proved.
    /// Found like the one modulo a prime: homogenised with a variable whose higher powers are larger (Lazard 1983).
    fn over_rationals(&self, point: &[Rational]) -> Result<Option<usize>, Stop> {
        let budget = self.budget;
        let variables = point.len();
        let shifts: Vec<Polynomial> = point
            .iter()
            .enumerate()
            .map(|(i, value)| {
                &Polynomial::variable(i, variables)
                    + &Polynomial::constant(value.clone(), variables)
            })
            .collect();
        let forms: Vec<Polynomial> = self
            .system
            .equations
            .iter()
            .map(|equation| homogenised(&equation.polynomial.substitute(&shifts)))
            .collect();
        let order = MonomialOrder::Elimination(1);
        let mut basis = groebner_basis(&forms, variables + 1, &order, budget)?;
        // The basis may rest on primes; what is needed of it is proved here. Its zeros solve all equations:
        for form in &forms {
            if !basis.normal_form_within(form, budget)?.is_zero() {
                return Ok(None);
            }
        }
        // and it is a basis of what it generates, so that its leading monomials tell the dimension of these zeros.
        let polynomials = basis.polynomials().to_vec();
        if !basis.prove(&polynomials, budget)? {
            return Ok(None);
        }
        let one = Rational::new(1.into(), 1.into());
        let leads: Vec<Polynomial> = basis
            .leading_monomials()
            .map(|lead| Polynomial::from_terms(vec![(lead[1..].to_vec(), one.clone())], variables))
            .collect();
        // Of monomials: nothing to compute.
        let leads = groebner_basis(&leads, variables, &MonomialOrder::Degrevlex, budget)?;
        Ok(leads.dimension())
    }
}

impl ExactFinding {
    fn prove(&mut self, freedom: usize, certificate: &str) {
        self.upper = freedom;
        self.proven = Some(freedom);
        self.complex_dimension = Some(freedom);
        certificate.clone_into(&mut self.certificate);
    }
}

/// Dimension of the tangent space at the origin modulo the prime: unknowns less the rank of the linear terms.
fn tangent_dimension(system: &ModularSystem, budget: &Budget) -> Result<usize, Stop> {
    let (columns, p) = (system.variables.len(), system.prime);
    budget.spend((columns * system.equations.len()) as u64)?;
    let mut rows: Vec<Vec<u64>> = system
        .equations
        .iter()
        .map(|equation| {
            let mut row = vec![0; columns];
            for (exponents, coefficient) in equation {
                if exponents.iter().sum::<u32>() == 1
                    && let Some(column) = exponents.iter().position(|e| *e == 1)
                {
                    row[column] = *coefficient;
                }
            }
            row
        })
        .collect();
    let times = |a: u64, b: u64| (u128::from(a) * u128::from(b) % u128::from(p)) as u64;
    let mut rank = 0;
    for column in 0..columns {
        let Some(pivot) = (rank..rows.len()).find(|&row| rows[row][column] != 0) else {
            continue;
        };
        rows.swap(rank, pivot);
        let (above, below) = rows.split_at_mut(rank + 1);
        let pivot = &above[rank];
        for row in below.iter_mut().filter(|row| row[column] != 0) {
            // No inverse: row times the pivot less pivot row times the entry.
            let (a, b) = (pivot[column], p - row[column]);
            for (x, y) in row.iter_mut().zip(pivot) {
                *x = (times(*x, a) + times(*y, b)) % p;
            }
        }
        rank += 1;
    }
    Ok(columns - rank)
}

fn rational(number: &Number) -> Option<Rational> {
    let value = number.rational()?;
    let integer = |text: String| text.parse().ok();
    Some(Rational::new(
        integer(value.numerator().to_string())?,
        integer(value.denominator().to_string())?,
    ))
}

/// Every term filled up to the degree of the polynomial with powers of an additional first variable.
fn homogenised(polynomial: &Polynomial) -> Polynomial {
    let degree = |m: &[u32]| m.iter().sum::<u32>();
    let most = polynomial
        .terms()
        .map(|(m, _)| degree(m))
        .max()
        .unwrap_or(0);
    let terms = polynomial.terms().map(|(m, coefficient)| {
        let mut exponents = vec![most - degree(m)];
        exponents.extend_from_slice(m);
        (exponents, coefficient.clone())
    });
    Polynomial::from_terms(terms.collect(), polynomial.variables() + 1)
}

/// Puts a proof or a bound together with what the other engines found. What contradicts is said, and nothing is decided then.
fn combine(found: &mut PartFinding, rank: &PartRank, exact: ExactFinding) {
    if let Some(text) = contradiction(found, rank, &exact) {
        found.open = Some(text.clone());
        found.contradiction = Some(text);
        found.lower = exact.proven.unwrap_or(0).min(found.lower);
        found.upper = exact.upper.max(found.upper);
        found.level = CertificateLevel::Numeric;
        found.pose = None;
        found.kind = None;
        found.class = None;
        found.complex_dimension = None;
        found.branches = None;
        return;
    }
    let was_open = found.open.is_some();
    found.upper = found.upper.min(exact.upper);
    found.complex_upper = Some(exact.upper);
    if let Some(freedom) = exact.proven {
        found.lower = freedom;
        found.upper = freedom;
        found.level = CertificateLevel::Exact;
        found.certificate = exact.certificate;
        found.open = None;
        if was_open {
            settle(found, rank, exact.tangent, freedom);
        }
    } else if was_open && found.lower == found.upper {
        found.open = None;
        "other engines leave no fewer freedoms, and no component of the complex solution set through this pose has more \
         dimensions, in exact arithmetic"
            .clone_into(&mut found.certificate);
    }
    let meets = (exact.upper == found.lower).then_some(exact.upper);
    let complex = exact.complex_dimension.or(meets);
    match (found.complex_dimension, complex) {
        // Both bounds hold for the real freedom, whichever is wrong.
        (Some(germ), Some(algebra)) if germ != algebra => {
            found.complex_dimension = None;
            found.contradiction = Some(format!(
                "two engines contradict each other, please report this: the dimension over the complex numbers is {germ} by \
                 the power series at this pose and {algebra} by exact algebra"
            ));
        }
        (before, now) => found.complex_dimension = now.or(before),
    }
}

/// What a part is that only exact algebra decided.
fn settle(found: &mut PartFinding, rank: &PartRank, tangent: usize, freedom: usize) {
    let regular = tangent == freedom;
    let surplus = rank.unknowns() as i64 - rank.equations() as i64;
    found.at_rest = rank.instantaneous.unwrap_or(tangent);
    found.branches = (freedom == 0).then(Vec::new);
    if regular {
        found.pose = Some(PoseKind::Regular);
        found.kind = None;
        found.class = (freedom > 0 && surplus == freedom as i64).then_some(MobilityClass::Trivial);
    } else if freedom == 0 && rank.instantaneous.is_some_and(|velocities| velocities > 0) {
        found.pose = Some(PoseKind::Singular);
        found.kind = Some(SingularKind::Shaky);
    }
}

/// Where a proof and what the other engines found exclude each other.
fn contradiction(found: &PartFinding, rank: &PartRank, exact: &ExactFinding) -> Option<String> {
    let text = match (rank.instantaneous, exact.proven) {
        (Some(velocities), _) if exact.tangent < velocities => format!(
            "numeric rank leaves {velocities} instantaneous freedoms, exact arithmetic at most {}",
            exact.tangent
        ),
        (_, Some(proven)) if proven > found.upper => format!(
            "numeric engines find at most {} finite freedoms, exact algebra proves {proven}",
            found.upper
        ),
        _ if exact.upper < found.lower => format!(
            "numeric engines find {} finite freedoms, exact algebra proves that there are at most {}",
            found.lower, exact.upper
        ),
        _ => return None,
    };
    Some(format!(
        "two engines contradict each other, please report this: {text}"
    ))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
