//! The pieces of a solution set: assembly modes, operation modes, and their dimensions.
//!
//! A mechanism may move in several ways that it cannot change between without being taken apart, or only through a singular
//! pose: each is a component of the solution set. The pieces found must together be the whole solution set, none contained in
//! another; for each it is said whether it is irreducible over the rationals, proven or probably, and whether it has real
//! points.
//!
//! How:
//! - an equation of the Groebner basis that factors splits the set (`split.rs`);
//! - over independent variables the rest is a system with finitely many points whose coefficients are functions of these
//!   variables. Components on which they are not independent lie where leading coefficients vanish, and are split off;
//! - the points over rational values of the independent variables tell the rest (`fibre.rs`): if they are all conjugate, the
//!   piece is irreducible. If not, the polynomial of a form that separates the points is factored over the variables;
//! - real points are counted exactly over rational values (`real.rs`).
//!
//! Every step is exact. The cost is that of the Groebner bases, most of which are of systems that were split and so are
//! small; a decomposition that does not end within its budget gives the pieces it has.

mod fibre;
mod ideal;
mod piece;
mod real;
mod split;

pub use real::RealPoints;
pub use split::Irreducible;

use super::engine::{Budget, Stop, radical_of_basis_contains};
use super::polynomial::{Polynomial, Rational};
use piece::{Piece, Ring};
use real::real_points;
use split::{Step, Whole, step};
use std::cmp::Reverse;

/// An algebraic number among the variables: the root of its equation in an interval.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AlgebraicNumber {
    /// Its variable.
    pub variable: usize,
    /// Lower bound.
    pub low: Rational,
    /// Upper bound. No other root of the equation lies between the bounds.
    pub high: Rational,
}

/// What is known of the variables.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hints {
    /// Variables that are cosine and sine of one angle: the equations say that their squares add up to one.
    pub angles: Vec<(usize, usize)>,
    /// Variables that stand for algebraic numbers. Only points where they are the right roots count as real.
    pub numbers: Vec<AlgebraicNumber>,
    /// Real points, one coordinate per variable, near which to look for real points first; they need not be exact. The
    /// answer never rests on them.
    pub points: Vec<Vec<f64>>,
}

/// A piece of the solution set.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Component {
    /// Its equations: a reduced degrevlex basis in all variables. It need not be the ideal of all polynomials that vanish.
    pub equations: Vec<Polynomial>,
    /// Complex dimension; all its components have it, unless nothing is known of the piece.
    pub dimension: usize,
    /// Degree, multiplicities of the equations counted; `None` where it was not found.
    pub degree: Option<usize>,
    /// As many independent variables as the dimension says.
    pub free: Vec<usize>,
    /// Whether it falls apart further over the rationals.
    pub irreducible: Irreducible,
    /// Whether it has real points.
    pub real: RealPoints,
}

impl Component {
    /// Whether a point lies on the piece, given a way to tell whether a polynomial vanishes at the point exactly.
    #[must_use]
    pub fn contains_point(&self, vanishes: &dyn Fn(&Polynomial) -> bool) -> bool {
        self.equations.iter().all(vanishes)
    }
}

/// Why a decomposition is not known to be the finest one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Incomplete {
    /// The budget ended: pieces are left that were not examined, or not compared with the others.
    Stopped(Stop),
    /// Some piece could not be proven irreducible, nor split.
    NotSplit,
}

/// The pieces of a solution set.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Decomposition {
    /// Together they are the whole solution set; none is contained in another one unless the budget ended. The largest
    /// dimension first. No piece: the equations contradict one another.
    pub pieces: Vec<Component>,
    /// Whether every piece is proven to be an irreducible component over the rationals.
    pub complete: bool,
    /// Why not.
    pub why: Option<Incomplete>,
}

/// Decomposes the zeros of some equations in a ring of `variables` variables.
///
/// When the budget ends on the way, the pieces found so far are the answer, and it says so.
///
/// # Errors
/// [`Stop`] where the budget does not even suffice for a first basis.
pub fn components(
    equations: &[Polynomial],
    variables: usize,
    hints: &Hints,
    budget: &Budget,
) -> Result<Decomposition, Stop> {
    components_of(&[equations.to_vec()], variables, hints, budget)
}

/// The same for the union of the zeros of several sets of equations.
///
/// # Errors
/// As [`components`].
pub(crate) fn components_of(
    sets: &[Vec<Polynomial>],
    variables: usize,
    hints: &Hints,
    budget: &Budget,
) -> Result<Decomposition, Stop> {
    let mut waiting: Vec<Piece> = Vec::new();
    for equations in sets.iter().rev() {
        waiting.extend(Piece::new(equations, &Ring::whole(variables), budget)?);
    }
    let mut found: Vec<Whole> = Vec::new();
    let mut stopped = None;
    while let Some(piece) = waiting.pop() {
        match step(&piece, budget) {
            Ok(Step::Pieces(pieces)) => waiting.extend(pieces),
            Ok(Step::Done(whole)) => found.push(whole),
            Err(stop) => {
                stopped = Some(stop);
                found.push(Whole::unexamined(piece));
                found.extend(waiting.drain(..).map(Whole::unexamined));
            }
        }
    }
    let mut found: Vec<Placed> = found.into_iter().map(Placed::new).collect();
    found.sort_by_cached_key(Placed::sort_key);
    if stopped.is_none() {
        match contained(&found, budget) {
            Ok(contained) => {
                let mut contained = contained.into_iter();
                found.retain(|_| contained.next() == Some(false));
            }
            Err(stop) => stopped = Some(stop),
        }
    }
    let mut pieces = Vec::new();
    for placed in found {
        let real = match stopped {
            Some(_) => RealPoints::Unknown,
            None => real_points(&placed.whole, &placed.equations, hints, budget).unwrap_or_else(
                |stop| {
                    stopped = Some(stop);
                    RealPoints::Unknown
                },
            ),
        };
        pieces.push(placed.component(real));
    }
    let proven = pieces.iter().all(|p| p.irreducible == Irreducible::Yes);
    let why = match (stopped, proven) {
        (Some(stop), _) => Some(Incomplete::Stopped(stop)),
        (None, false) => Some(Incomplete::NotSplit),
        (None, true) => None,
    };
    Ok(Decomposition {
        pieces,
        complete: why.is_none(),
        why,
    })
}

/// A piece with its equations in all variables.
struct Placed {
    whole: Whole,
    equations: Vec<Polynomial>,
}

type Terms = Vec<(Vec<u32>, Rational)>;

impl Placed {
    fn new(whole: Whole) -> Self {
        Self {
            equations: whole.piece.original_equations(),
            whole,
        }
    }

    /// Large pieces first; ties by the equations, so that the order does not depend on the way the pieces were found.
    fn sort_key(&self) -> (Reverse<usize>, Vec<Terms>) {
        let terms = |p: &Polynomial| p.terms().map(|(m, c)| (m.to_vec(), c.clone())).collect();
        let equations = self.equations.iter().map(terms).collect();
        (Reverse(self.whole.free.len()), equations)
    }

    /// Whether all equations of another piece vanish on this one.
    fn lies_in(&self, other: &Self, budget: &Budget) -> Result<bool, Stop> {
        budget.check()?;
        let (piece, dimension) = (&self.whole.piece, self.whole.free.len());
        if self.whole.prime && other.whole.prime && dimension == other.whole.free.len() {
            // Of two irreducible sets of the same dimension none contains the other; and reduced bases are unique.
            return Ok(self.equations == other.equations);
        }
        for equation in &other.equations {
            let inside = piece.in_ring(equation);
            if !radical_of_basis_contains(&piece.equations, piece.variables(), &inside, budget)? {
                return Ok(false);
            }
        }
        Ok(true)
    }

    fn component(self, real: RealPoints) -> Component {
        let alive = &self.whole.piece.ring.alive;
        Component {
            dimension: self.whole.free.len(),
            degree: self.whole.piece.degree(),
            free: self.whole.free.iter().map(|&v| alive[v]).collect(),
            irreducible: self.whole.irreducible,
            equations: self.equations,
            real,
        }
    }
}

/// Which pieces lie in others. A larger piece is never contained in a smaller one, and of two equal ones the first stays.
fn contained(found: &[Placed], budget: &Budget) -> Result<Vec<bool>, Stop> {
    let mut contained = Vec::new();
    for (i, piece) in found.iter().enumerate() {
        let mut inside = false;
        for (larger, gone) in found[..i].iter().zip(&contained) {
            if !gone && piece.lies_in(larger, budget)? {
                inside = true;
                break;
            }
        }
        contained.push(inside);
    }
    Ok(contained)
}

#[cfg(test)]
mod tests;
