//! Branches by a search for real zeros of the power series, in series of growing degree.

use super::doubts::{cut_in_pieces, merged, two_in_one};
use super::isolated;
use super::kinds::kind_of;
use super::resolution::Resolution;
use super::search::{agrees_with, germ_text, zeros_within};
use crate::claim::{Answer, Bounds, Claim, Says};
use crate::germ::{
    ComplexDimension, Germ, PrestressCertificate, complex_dimension, isolated_by_leading_terms,
    prestress_across, prestress_certificate,
};
use crate::germ_zeros::GermZeros;
use crate::judge::PartFinding;
use crate::lifting::{Lifted, Start, lift_all};
use crate::pose_rank::{PartRank, height_at, is_computed};
use crate::vocabulary::{EngineName, Scope};
use kutzbach_math::matrix::MatrixError;

/// Degrees to which the series are computed: the first, and the last tried. A germ in the plane is cheap enough for more.
const FIRST_DEGREE: usize = 4;
const LAST_DEGREE: usize = 8;
const LAST_DEGREE_IN_THE_PLANE: usize = 12;

/// Work that all searches on the germ of one part may take together: some seconds.
const SEARCHED: u64 = 1_500_000_000;

/// After so many searches that found less than there may be, longer series are not tried.
const UNPROVED: usize = 2;

/// Fills a finding where searches in series of some degree settle it, otherwise gives the reason why the last one does not.
///
/// `doubtful`: the rank with what the coefficients are in doubt by.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub(super) fn by_search(
    found: &mut PartFinding,
    start: &Start<'_>,
    doubtful: &PartRank,
) -> Result<Option<String>, MatrixError> {
    let freedom = start.kernel.basis.nullity - start.idle.len();
    let mut why = "its power series are too many to follow".to_owned();
    let mut next = FIRST_DEGREE;
    let mut last = match freedom {
        2 => LAST_DEGREE_IN_THE_PLANE,
        _ => LAST_DEGREE,
    };
    let mut searches = Searches {
        found,
        start,
        rounded: doubtful.open_by_digits() > start.rank.accuracy,
        before: None,
        outermost: f64::INFINITY,
        allowance: SEARCHED,
        unproved: 0,
    };
    while next <= last {
        let degree = next;
        next += 2;
        let mechanism = start.pose.mechanism;
        let Some(germ) = Germ::of_part_across(mechanism, doubtful, degree, start.idle)? else {
            break;
        };
        let Some(order) = germ.order() else {
            why = format!("what the equations leave over is of higher order than {degree}");
            continue;
        };
        // Twice the order shows the next terms too, by which branches of a common tangent cone differ; a step more confirms what
        // is multiple, another serves where one search comes to nothing.
        last = last.max((2 * order + 4).min(LAST_DEGREE_IN_THE_PLANE));
        if degree < 2 * order {
            next = 2 * order;
            why = format!(
                "what the equations leave over begins at order {order}, and to tell it apart takes degree {next}"
            );
            continue;
        }
        match searches.at(&germ, order)? {
            Outcome::Settled => return Ok(None),
            Outcome::Open(reason) => why = reason,
        }
        if searches.allowance == 0 || searches.unproved == UNPROVED {
            break;
        }
    }
    Ok(Some(why))
}

/// What a search comes to.
enum Outcome {
    Settled,
    /// Not settled, because.
    Open(String),
}

/// The searches at one pose.
struct Searches<'a> {
    found: &'a mut PartFinding,
    start: &'a Start<'a>,
    rounded: bool,
    /// What the last search found.
    before: Option<Vec<Shape>>,
    /// No sphere is larger.
    outermost: f64,
    /// Work left.
    allowance: u64,
    /// Searches that found less than there may be.
    unproved: usize,
}

impl Searches<'_> {
    /// Looks for the branches of a germ, whose equations begin at an order.
    fn at(&mut self, germ: &Germ, order: usize) -> Result<Outcome, MatrixError> {
        if self.blocked_by_stress(germ)? {
            return Ok(Outcome::Settled);
        }
        let complex = complex_dimension(germ.equations(), germ.freedom(), germ.noise_by_degree());
        if self.alone_by_leading_terms(germ, order, complex.as_ref())? {
            return Ok(Outcome::Settled);
        }
        let zeros = zeros_within(
            germ,
            order,
            !self.rounded,
            &mut self.outermost,
            &mut self.allowance,
        );
        self.tell(germ, order, &zeros, complex.as_ref());
        let complex_dimension = complex
            .as_ref()
            .map(|c| c.dimension + self.start.idle.len());
        if let Some(reason) = doubted(germ, &zeros, complex.as_ref()) {
            return Ok(self.refused(reason));
        }
        if zeros.branches.is_empty() {
            // A search may miss what is thin or multiple: only a proof leaves nothing.
            if complex_dimension != Some(self.start.idle.len()) {
                self.unproved += 1;
                return Ok(self.refused(NOT_PROVED.to_owned()));
            }
            let certificate = "near this pose the closure equations have no other solution, even over the complex numbers";
            let alone = isolated(self.start, EngineName::Germ, String::new(), certificate)?;
            self.found.amend(|claim| {
                claim.finite = alone.finite;
                claim.says = alone.says;
            });
            return Ok(Outcome::Settled);
        }
        match lift_all(self.start, germ, &zeros.branches)? {
            Ok(lifted) => Ok(self.taken(germ, &zeros, lifted, complex_dimension)),
            Err(reason) => Ok(self.refused(reason)),
        }
    }

    /// Takes the claim of a search. What an earlier one, in shorter series, said of complex solutions is none any more.
    fn claim(&mut self, claim: Claim, complex: Option<&ComplexDimension>) {
        self.found.amend(|last| {
            if last.engine == EngineName::Germ {
                last.complex = Bounds::ANY;
            }
        });
        let idle = self.start.idle.len();
        let complex = complex.map_or(Bounds::ANY, |c| Bounds::exactly(c.dimension + idle));
        self.found.take(Claim { complex, ..claim });
    }

    /// Whether a self-stress blocks every motion.
    fn blocked_by_stress(&mut self, germ: &Germ) -> Result<bool, MatrixError> {
        let Some(stress) = prestress_certificate(germ) else {
            return Ok(false);
        };
        let text = format!(
            "a self-stress makes the second-order form definite: smallest eigenvalue {:.2e}, noise {:.2e}{}",
            stress.smallest_eigenvalue,
            stress.noise,
            taken_out(self.start.idle.len())
        );
        let certificate = "a self-stress blocks every motion at second order (its quadratic form on the velocities is definite)";
        let claim = isolated(self.start, EngineName::SecondOrder, text, certificate)?;
        let complex = complex_dimension(germ.equations(), germ.freedom(), germ.noise_by_degree());
        self.claim(claim, complex.as_ref());
        Ok(true)
    }

    /// Whether the lowest terms vanish at the origin only.
    fn alone_by_leading_terms(
        &mut self,
        germ: &Germ,
        order: usize,
        complex: Option<&ComplexDimension>,
    ) -> Result<bool, MatrixError> {
        if !isolated_by_leading_terms(germ.equations(), germ.noise_by_degree()) {
            return Ok(false);
        }
        let text = format!(
            "the lowest terms of the equations, of order {order}, have no common zero in series to degree {}{}",
            germ.degree(),
            taken_out(self.start.idle.len())
        );
        let certificate = "near this pose the closure equations have no other real solution: the lowest terms of what they leave over \
                           have none";
        let claim = isolated(self.start, EngineName::Germ, text, certificate)?;
        self.claim(claim, complex);
        Ok(true)
    }

    /// Puts down what a search found.
    fn tell(
        &mut self,
        germ: &Germ,
        order: usize,
        zeros: &GermZeros,
        complex: Option<&ComplexDimension>,
    ) {
        let idle = self.start.idle.len();
        let dimensions = zeros.branches.iter().map(|b| b.dimension);
        let upper = dimensions.max().unwrap_or(0) + idle;
        let text = format!(
            "{}{}",
            germ_text(germ, order, germ.degree(), zeros, complex),
            taken_out(idle)
        );
        let finite = Bounds {
            lower: 0,
            upper: zeros.thin.is_none().then_some(upper),
        };
        let claim = Claim::of(EngineName::Germ, Scope::Neighbourhood, finite, text);
        self.claim(claim, complex);
    }

    /// Takes branches that were brought to the mechanism for all there are, unless something is missing.
    fn taken(
        &mut self,
        germ: &Germ,
        zeros: &GermZeros,
        lifted: Vec<Lifted>,
        complex: Option<usize>,
    ) -> Outcome {
        let mut pairs = lifted.iter().zip(&zeros.branches);
        if pairs.any(|(l, b)| !l.shaky && !b.reduced) {
            return self.refused("a branch is a multiple zero of the power series and a simple one farther away, so that it may be several".to_owned());
        }
        let dimensions = lifted.iter().map(|l| l.branch.dimension);
        let top = dimensions.max().unwrap_or(0);
        if complex.is_some_and(|c| c < top) {
            return self.refused(
                "the dimension over the complex numbers contradicts the branches found".to_owned(),
            );
        }
        self.found.amend(|claim| claim.finite.lower = top);
        let stress = match complex == Some(top) {
            true => None,
            false => self.blocked_across(germ, &lifted),
        };
        // Where the complex dimension is larger real branches may have been overlooked, or there are none: y² + z² = 0.
        if let Some(complex) = complex.filter(|complex| *complex > top && stress.is_none()) {
            self.unproved += 1;
            return self.refused(format!(
                "real branches of dimension {top} were found where the complex ones have {complex}"
            ));
        }
        let shapes: Vec<Shape> = lifted.iter().map(Shape::of).collect();
        let again = self.before.as_ref() == Some(&shapes);
        let multiple = lifted.iter().any(|l| l.shaky);
        self.before = Some(shapes);
        // A stress leaves nothing for terms of higher degree to split.
        let reason = match &stress {
            Some(_) => not_yet(true, false, self.rounded),
            None => not_yet(complex.is_some(), multiple, self.rounded),
        };
        if !again && let Some(reason) = reason {
            return self.refused(reason.to_owned());
        }
        let Start { pose, part, .. } = *self.start;
        let resolution = Resolution::of(
            germ,
            height_at(pose, part),
            is_computed(pose.mechanism, part),
        );
        let mut answer = Answer::numeric(format!(
            "the real zeros of the equations' power series give {} the loops close at finite distances from this pose{}",
            if lifted.len() == 1 {
                "one branch, and on it".to_owned()
            } else {
                format!("{} branches, and on each of them", lifted.len())
            },
            match &stress {
                None => "",
                Some(_) => "; across it a self-stress blocks every motion at second order",
            }
        ));
        answer.kind = kind_of(&lifted, &zeros.branches, &resolution);
        answer.branches = Some(lifted.into_iter().map(|l| l.branch).collect());
        self.found.amend(|claim| {
            claim.finite = Bounds::exactly(top);
            claim.says = Says::Decides(Box::new(answer));
            if let Some(stress) = stress {
                claim.text.push_str(&format!(
                    "; across the branch a self-stress makes the second-order form definite: smallest eigenvalue {:.2e}, noise {:.2e}",
                    stress.smallest_eigenvalue, stress.noise
                ));
            }
        });
        Outcome::Settled
    }

    /// A self-stress that blocks every motion across the only branch found, at whose poses as much moves to first order as here.
    fn blocked_across(&self, germ: &Germ, lifted: &[Lifted]) -> Option<PrestressCertificate> {
        let [Lifted { branch, .. }] = lifted else {
            return None;
        };
        let here = self.start.rank.instantaneous?;
        let as_here = branch.poses.iter().all(|p| p.instantaneous == Some(here));
        let along = branch.dimension.checked_sub(self.start.idle.len())?;
        match as_here && !branch.poses.is_empty() {
            true => prestress_across(germ, along),
            false => None,
        }
    }

    /// Marks the last search as one that nothing rests on, but that branches which the loops close along are some.
    fn refused(&mut self, reason: String) -> Outcome {
        self.found.amend(|claim| refuse(claim, &reason));
        Outcome::Open(reason)
    }
}

fn refuse(claim: &mut Claim, reason: &str) {
    claim.finite.upper = None;
    claim.text.push_str("; not taken: ");
    claim.text.push_str(reason);
}

/// Why the zeros found may not be those there are, if they may not.
fn doubted(germ: &Germ, zeros: &GermZeros, complex: Option<&ComplexDimension>) -> Option<String> {
    if let Some(thin) = &zeros.thin {
        return Some(thin.clone());
    }
    if !agrees_with(germ, zeros) {
        return Some("a quadratic form of full rank has other zeros than those found".to_owned());
    }
    cut_in_pieces(zeros, complex)
        .or_else(|| merged(germ, zeros))
        .or_else(|| two_in_one(germ, zeros))
        .map(str::to_owned)
}

/// That idle freedoms are taken out, if there are any.
fn taken_out(idle: usize) -> String {
    match idle {
        0 => String::new(),
        1 => ", 1 idle freedom taken out".to_owned(),
        many => format!(", {many} idle freedoms taken out"),
    }
}

/// What two searches in series of different lengths have to agree on.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Shape {
    dimension: usize,
    shaky: bool,
}

impl Shape {
    fn of(lifted: &Lifted) -> Self {
        Self {
            dimension: lifted.branch.dimension,
            shaky: lifted.shaky,
        }
    }
}

/// Why one search does not suffice, if it does not.
fn not_yet(bounded: bool, multiple: bool, rounded: bool) -> Option<&'static str> {
    if !bounded {
        return Some("no dimension over the complex numbers confirms the branches found");
    }
    // Terms of higher degree may split what is multiple up to one degree.
    if multiple {
        return Some("a branch is multiple, and no longer series has confirmed it yet");
    }
    // Rounded numbers may open, or hide, what touches.
    rounded.then_some("the numbers are rounded, and no second search has found the same yet")
}

const NOT_PROVED: &str =
    "no other real solution was found near the pose, and nothing proves that there is none";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_refused_search_bounds_nothing_from_above() {
        let finite = Bounds::between(1, 2);
        let mut claim = Claim::of(EngineName::Germ, Scope::Neighbourhood, finite, "found");
        refuse(&mut claim, "why");
        assert_eq!((claim.finite.lower, claim.finite.upper), (1, None));
        assert_eq!(claim.text, "found; not taken: why");
    }
}
