//! One step of the decomposition: a piece falls into smaller ones, or it is done.

use super::fibre::{self, Fibre};
use super::ideal::{compare, local_degree, with_front};
use super::piece::Piece;
use crate::engine::{Budget, Stop, radical_of_basis_contains};
use crate::factor::factor;
use crate::polynomial::{Polynomial, Rational};

/// Polynomials of a higher degree are not factored: they come late in a decomposition, seldom fall apart, and cost much.
const HIGHEST_DEGREE: u32 = 24;

/// What became of a piece.
pub(super) enum Step {
    /// Other pieces with the same zeros together.
    Pieces(Vec<Piece>),
    /// It cannot be split further by what is known here.
    Done(Whole),
}

/// Whether a piece is irreducible over the rationals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Irreducible {
    /// It is: proven.
    Yes,
    /// Probably it consists of so many components of the same dimension, which could not be separated. The number is that of
    /// the conjugacy classes of points over two rational values of the free variables; by Hilbert's irreducibility theorem
    /// nearly all values give the true number.
    Probably(usize),
    /// Not known.
    Unknown,
}

/// A piece that stays whole.
pub(super) struct Whole {
    pub(super) piece: Piece,
    /// Independent variables of the ring of the piece.
    pub(super) free: Vec<usize>,
    pub(super) irreducible: Irreducible,
    /// Whether its equations are known to generate a prime ideal: a polynomial that vanishes on it is then in the ideal.
    pub(super) prime: bool,
}

impl Whole {
    /// A piece about which nothing was found out.
    pub(super) fn unexamined(piece: Piece) -> Self {
        let free = piece.free();
        Self {
            piece,
            free,
            irreducible: Irreducible::Unknown,
            prime: false,
        }
    }
}

/// One step.
pub(super) fn step(piece: &Piece, budget: &Budget) -> Result<Step, Stop> {
    if let Some(pieces) = split_by_factors(piece, &piece.equations, budget)? {
        return Ok(Step::Pieces(pieces));
    }
    let free = piece.free();
    if free.is_empty() {
        return points(piece, budget);
    }
    let bound: Vec<usize> = (0..piece.variables())
        .filter(|v| !free.contains(v))
        .collect();
    if bound.is_empty() {
        return Ok(Step::Done(Whole {
            irreducible: Irreducible::Yes,
            prime: true,
            ..Whole::unexamined(piece.clone())
        }));
    }
    let over_free = with_front(&piece.equations, piece.variables(), &bound, budget)?;
    if let Some(pieces) = split_by_factors(piece, &over_free, budget)? {
        return Ok(Step::Pieces(pieces));
    }
    let exceptions = leading_coefficients(&over_free, &free, &bound, budget)?;
    if let Some(pieces) = split_off_exceptions(piece, &exceptions, budget)? {
        return Ok(Step::Pieces(pieces));
    }
    let sheets = sheets(&over_free, &free, piece.variables());
    examine(piece, free, &exceptions, sheets, budget)
}

/// Zeros of finitely many points, one piece for every class of conjugate points.
fn points(piece: &Piece, budget: &Budget) -> Result<Step, Stop> {
    let mut whole = Whole::unexamined(piece.clone());
    let Some(points) = piece.points(budget)? else {
        return Ok(Step::Done(whole));
    };
    let found = points.representation();
    if let [(_, multiplicity)] = found.factors.as_slice() {
        if found.complete {
            whole.irreducible = Irreducible::Yes;
            whole.prime = *multiplicity == 1;
        }
        return Ok(Step::Done(whole));
    }
    let form = linear(&found.form, piece.variables());
    let mut pieces = Vec::new();
    for (factor, _) in &found.factors {
        pieces.extend(piece.with(&factor.of(&form), budget)?);
    }
    Ok(Step::Pieces(pieces))
}

pub(super) fn linear(form: &[i64], variables: usize) -> Polynomial {
    let mut sum = Polynomial::zero(variables);
    for (i, &c) in form.iter().enumerate() {
        let x = Polynomial::variable(i, variables);
        sum = &sum + &x.scaled(&Rational::from_integer(c.into()));
    }
    sum
}

/// Splits by the first of some equations that factors.
fn split_by_factors(
    piece: &Piece,
    equations: &[Polynomial],
    budget: &Budget,
) -> Result<Option<Vec<Piece>>, Stop> {
    for equation in equations {
        if equation.degree() > HIGHEST_DEGREE || is_solved_for_a_variable(equation) {
            continue;
        }
        let found = factor(equation, budget)?.factors;
        match found.as_slice() {
            [] | [(_, 1)] => {}
            [(base, _)] => return Ok(Some(piece.with(base, budget)?.into_iter().collect())),
            several => {
                let factors: Vec<Polynomial> = several.iter().map(|(f, _)| f.clone()).collect();
                return split(piece, &factors, budget).map(Some);
            }
        }
    }
    Ok(None)
}

/// `c·x + ...` with a constant c and no other x is irreducible.
fn is_solved_for_a_variable(equation: &Polynomial) -> bool {
    (0..equation.variables()).any(|v| {
        equation.degree_in(v) == 1
            && equation
                .terms()
                .all(|(m, _)| m[v] == 0 || m.iter().sum::<u32>() == 1)
    })
}

/// Splits by polynomials whose product vanishes on the piece.
///
/// The components are those on f = 0, for the first f, and those of what is left when f = 0 is taken out. Parts of the first
/// piece that lie in components of the second are taken out at the very end.
fn split(piece: &Piece, factors: &[Polynomial], budget: &Budget) -> Result<Vec<Piece>, Stop> {
    let mut pieces = Vec::new();
    let mut rest = Some(piece.clone());
    for (index, f) in factors.iter().enumerate() {
        let Some(remaining) = rest else { break };
        let f = f.substitute(&embedding_between(piece, &remaining));
        if f.is_zero() {
            pieces.push(remaining);
            return Ok(pieces);
        }
        if f.as_constant().is_some() {
            rest = Some(remaining);
            continue;
        }
        pieces.extend(remaining.with(&f, budget)?);
        // Nothing is left when the last factor is taken out, too.
        rest = if index + 1 < factors.len() {
            remaining.without(&f, budget)?
        } else {
            None
        };
    }
    pieces.extend(rest);
    Ok(pieces)
}

/// The variables of the first ring as polynomials of the second, which is a later one.
fn embedding_between(first: &Piece, second: &Piece) -> Vec<Polynomial> {
    first
        .ring
        .alive
        .iter()
        .map(|&original| second.ring.embedding[original].clone())
        .collect()
}

/// The irreducible factors of the leading coefficients of a basis, seen as polynomials in the bound variables whose
/// coefficients are polynomials in the free ones.
fn leading_coefficients(
    over_free: &[Polynomial],
    free: &[usize],
    bound: &[usize],
    budget: &Budget,
) -> Result<Vec<Polynomial>, Stop> {
    let mut factors: Vec<Polynomial> = Vec::new();
    for equation in over_free {
        let coefficient = leading_coefficient(equation, free, bound);
        for (f, _) in factor(&coefficient, budget)?.factors {
            if !factors.contains(&f) {
                factors.push(f);
            }
        }
    }
    Ok(factors)
}

/// The largest monomial in the bound variables: degrevlex among them.
fn leading_monomial(equation: &Polynomial, bound: &[usize]) -> Vec<u32> {
    let part = |m: &[u32]| -> Vec<u32> { bound.iter().map(|&v| m[v]).collect() };
    equation
        .terms()
        .map(|(m, _)| part(m))
        .max_by(|a, b| compare(a, b))
        .unwrap_or_default()
}

fn leading_coefficient(equation: &Polynomial, free: &[usize], bound: &[usize]) -> Polynomial {
    let leading = leading_monomial(equation, bound);
    let variables = equation.variables();
    let terms = equation
        .terms()
        .filter(|(m, _)| bound.iter().zip(&leading).all(|(&v, &e)| m[v] == e))
        .map(|(m, c)| {
            let mut exponents = vec![0; variables];
            for &v in free {
                exponents[v] = m[v];
            }
            (exponents, c.clone())
        })
        .collect();
    Polynomial::from_terms(terms, variables)
}

/// Number of points, with multiplicities, over generic values of the free variables.
fn sheets(over_free: &[Polynomial], free: &[usize], variables: usize) -> Option<usize> {
    let bound: Vec<usize> = (0..variables).filter(|v| !free.contains(v)).collect();
    let heads: Vec<Vec<u32>> = over_free
        .iter()
        .map(|equation| {
            let mut head = vec![0; variables];
            for (&v, e) in bound.iter().zip(leading_monomial(equation, &bound)) {
                head[v] = e;
            }
            head
        })
        .collect();
    local_degree(&heads, free, variables)
}

/// Separates the components on which the free variables are independent from the others (Gianni, Trager and Zacharias 1988):
/// the former are what is left when the zeros of the leading coefficients are taken out, the latter lie on those zeros.
fn split_off_exceptions(
    piece: &Piece,
    exceptions: &[Polynomial],
    budget: &Budget,
) -> Result<Option<Vec<Piece>>, Stop> {
    let mut main = piece.clone();
    let mut removed = Vec::new();
    for f in exceptions {
        let inside = f.substitute(&embedding_between(piece, &main));
        let Some(rest) = main.without(&inside, budget)? else {
            // The free variables are independent, so something is left; nothing is split off otherwise.
            return Ok(None);
        };
        if !same(&main, &rest) {
            removed.push(f.clone());
            main = rest;
        }
    }
    if removed.is_empty() {
        return Ok(None);
    }
    // Equations of the main part, back in the ring of the piece.
    let main_equations: Vec<Polynomial> = main
        .original_equations()
        .iter()
        .map(|p| piece.in_ring(p))
        .filter(|p| !p.is_zero())
        .collect();
    let mut pieces = vec![main];
    for f in removed {
        let Some(on_exception) = piece.with(&f, budget)? else {
            continue;
        };
        outside(piece, on_exception, &main_equations, budget, &mut pieces)?;
    }
    Ok(Some(pieces))
}

/// Adds what of a piece is not among the zeros of some equations, given in the ring of an earlier piece.
fn outside(
    earlier: &Piece,
    piece: Piece,
    equations: &[Polynomial],
    budget: &Budget,
    pieces: &mut Vec<Piece>,
) -> Result<(), Stop> {
    let mut inside = Some(piece);
    for equation in equations {
        let Some(current) = inside else {
            return Ok(());
        };
        let equation = equation.substitute(&embedding_between(earlier, &current));
        if equation.is_zero()
            || radical_of_basis_contains(
                &current.equations,
                current.variables(),
                &equation,
                budget,
            )?
        {
            inside = Some(current);
            continue;
        }
        pieces.extend(current.without(&equation, budget)?);
        inside = current.with(&equation, budget)?;
    }
    Ok(())
}

fn same(a: &Piece, b: &Piece) -> bool {
    a.ring.alive == b.ring.alive && a.equations == b.equations
}

/// Looks at the points over rational values of the free variables: one class of conjugate points proves the piece
/// irreducible; several, over different values, let it be split by the polynomial they come from.
fn examine(
    piece: &Piece,
    free: Vec<usize>,
    exceptions: &[Polynomial],
    sheets: Option<usize>,
    budget: &Budget,
) -> Result<Step, Stop> {
    let mut best: Option<Fibre> = None;
    let mut looked = 0;
    for number in 0..fibre::MOST_VALUES {
        let values = fibre::integer_values(number, free.len());
        if fibre::is_exceptional(exceptions, &free, &values) {
            continue;
        }
        let Some(fibre) = Fibre::new(piece, &free, &values, budget)? else {
            continue;
        };
        let proven = fibre.is_one_class() && sheets == Some(fibre.points.multiplicity());
        // Over special values points coincide: simple ones tell more.
        let rank = |f: &Fibre| (!f.is_simple(), f.classes());
        if best.as_ref().is_none_or(|b| rank(&fibre) < rank(b)) {
            best = Some(fibre);
        }
        looked += 1;
        if proven || looked == 2 {
            break;
        }
    }
    let mut whole = Whole {
        piece: piece.clone(),
        free,
        irreducible: Irreducible::Unknown,
        prime: false,
    };
    let Some(fibre) = best else {
        return Ok(Step::Done(whole));
    };
    // The leading coefficients are not zero here, so the points are as many as over generic values.
    let complete_fibre = sheets == Some(fibre.points.multiplicity());
    if fibre.is_one_class() && complete_fibre {
        whole.irreducible = Irreducible::Yes;
        whole.prime = true;
        return Ok(Step::Done(whole));
    }
    let (pieces, whole_polynomial) = split_by_projection(&whole, &fibre, budget)?;
    if let Some(pieces) = pieces {
        return Ok(Step::Pieces(pieces));
    }
    // One irreducible polynomial for as many values as there are points over generic values.
    whole.prime = whole_polynomial && fibre.is_simple() && complete_fibre;
    whole.irreducible = if whole.prime {
        Irreducible::Yes
    } else if fibre.representation().complete {
        Irreducible::Probably(fibre.classes())
    } else {
        Irreducible::Unknown
    };
    Ok(Step::Done(whole))
}

/// Splits by the factors of the polynomial that a separating form satisfies over the free variables; makes a piece reduced
/// where that polynomial, or that of a bound variable, has repeated factors.
///
/// The second part of the answer: whether the polynomial of the separating form is irreducible with as many values as the
/// fibre has points.
fn split_by_projection(
    whole: &Whole,
    fibre: &Fibre,
    budget: &Budget,
) -> Result<(Option<Vec<Piece>>, bool), Stop> {
    let piece = &whole.piece;
    let variables = piece.variables();
    let bound: Vec<usize> = (0..variables).filter(|v| !whole.free.contains(v)).collect();
    let mut form = Polynomial::zero(variables);
    for (&v, &c) in bound.iter().zip(&fibre.representation().form) {
        let x = Polynomial::variable(v, variables);
        form = &form + &x.scaled(&Rational::from_integer(c.into()));
    }
    let mut forms = vec![form];
    if !fibre.is_simple() {
        forms.extend(bound.iter().map(|&v| Polynomial::variable(v, variables)));
    }
    let mut irreducible = false;
    for (index, form) in forms.iter().enumerate() {
        let Some(relation) = relation_over(piece, form, &bound, budget)? else {
            continue;
        };
        let found = factor(&relation, budget)?;
        let back: Vec<Polynomial> = (0..variables)
            .map(|v| Polynomial::variable(v, variables))
            .chain([form.clone()])
            .collect();
        let factors: Vec<Polynomial> = found
            .factors
            .iter()
            .map(|(f, _)| f.substitute(&back))
            .collect();
        if factors.len() > 1 {
            return Ok((Some(split(piece, &factors, budget)?), false));
        }
        if let [(base, power)] = found.factors.as_slice() {
            if *power > 1 {
                let reduced = piece.with(&base.substitute(&back), budget)?;
                return Ok((Some(reduced.into_iter().collect()), false));
            }
            let values = base.degree_in(variables) as usize;
            irreducible |= index == 0 && found.complete && values == fibre.points.count();
        }
    }
    Ok((None, irreducible))
}

/// The polynomial of smallest degree that a form satisfies over the free variables; the form is the last variable of its ring.
fn relation_over(
    piece: &Piece,
    form: &Polynomial,
    bound: &[usize],
    budget: &Budget,
) -> Result<Option<Polynomial>, Stop> {
    let variables = piece.variables();
    let places: Vec<usize> = (0..variables).collect();
    let mut equations: Vec<Polynomial> = piece
        .equations
        .iter()
        .map(|p| p.moved(&places, variables + 1))
        .collect();
    let value = Polynomial::variable(variables, variables + 1);
    equations.push(&value - &form.moved(&places, variables + 1));
    let basis = with_front(&equations, variables + 1, bound, budget)?;
    Ok(basis
        .into_iter()
        .filter(|p| bound.iter().all(|&v| !p.mentions(v)) && p.mentions(variables))
        .min_by_key(|p| (p.degree_in(variables), p.degree())))
}
