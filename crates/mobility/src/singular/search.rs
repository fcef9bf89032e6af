//! The search for real zeros of a germ, and what it found in words.

use crate::germ::{ComplexDimension, Germ, is_irreducible_hypersurface, signature};
use crate::germ_zeros::{GermZeroOptions, GermZeros, germ_zeros};

/// How often a search in the plane is made again on smaller spheres, where what shows inside differs.
const SMALLER: usize = 3;

/// More starts than this are not made on a germ of many variables, and fewer where each is dear: all of them together may
/// evaluate about as many terms of series, which takes a second or so.
const STARTS: usize = 600;
const TERMS: usize = 1_000_000;

/// How many starts a search on a germ may make.
pub(in super::super) fn most_starts(germ: &Germ) -> usize {
    let variables = germ.freedom();
    let terms: usize = germ
        .equations()
        .iter()
        .map(|equation| equation.coefficients().len())
        .sum();
    (TERMS / (variables * terms).max(1)).min(STARTS)
}

/// The zeros of a germ on spheres no larger than `outermost`, and on smaller ones where what shows inside differs from what shows
/// outside: what shows inside is the germ. No later search in exact numbers is made on larger spheres than an earlier one.
pub(super) fn zeros_within(
    germ: &Germ,
    order: usize,
    exact: bool,
    outermost: &mut f64,
    allowance: &mut u64,
) -> GermZeros {
    let search = |outermost: f64, allowance: &mut u64| {
        let mut zeros = germ_zeros(
            germ.freedom(),
            germ.equations(),
            germ.noise(order),
            &GermZeroOptions {
                most_starts: most_starts(germ),
                outermost,
                work: *allowance,
                ..GermZeroOptions::default()
            },
        );
        *allowance = allowance.saturating_sub(zeros.work);
        join_pieces(germ, &mut zeros);
        zeros
    };
    let mut zeros = search(*outermost, allowance);
    let mut again = if germ.freedom() == 2 { SMALLER } else { 0 };
    let mut shrunk = false;
    while zeros.varies || (zeros.thin.is_none() && !agrees_with(germ, &zeros)) {
        shrunk = true;
        *outermost = zeros.radii.last().copied().unwrap_or(*outermost);
        if again == 0 || *allowance == 0 {
            return zeros;
        }
        again -= 1;
        zeros = search(*outermost, allowance);
    }
    // What rounded numbers leave open outweighs the equations on small spheres: the longer the series, the larger those that tell.
    if exact || shrunk {
        *outermost = zeros.radii.first().copied().unwrap_or(*outermost);
    }
    zeros
}

/// Whether what was found are the zeros of a quadratic form of full rank, where the germ is one up to a change of coordinates
/// (Morse's lemma); true of any other germ. Indefinite in two variables it is a pair of lines, in more a cone that is irreducible,
/// since only forms of rank two at most are products.
pub(super) fn agrees_with(germ: &Germ, zeros: &GermZeros) -> bool {
    let Some((plus, minus)) = quadric(germ) else {
        return true;
    };
    let count = match (plus, minus) {
        (0, _) | (_, 0) => 0,
        (1, 1) => 2,
        _ => 1,
    };
    zeros.branches.len() == count
        && zeros
            .branches
            .iter()
            .all(|branch| branch.dimension + 1 == germ.freedom())
}

/// The pieces of an irreducible hypersurface as one branch: they are joined through small parts of it that walking may miss, or touch in
/// the pose only.
fn join_pieces(germ: &Germ, zeros: &mut GermZeros) {
    let whole = zeros
        .branches
        .iter()
        .all(|branch| branch.dimension + 1 == germ.freedom());
    if !whole || germ.freedom() < 3 || zeros.branches.len() < 2 || !irreducible(germ) {
        return;
    }
    let mut pieces = std::mem::take(&mut zeros.branches).into_iter();
    let Some(mut one) = pieces.next() else { return };
    for piece in pieces {
        one.points.extend(piece.points);
        one.tangents.extend(piece.tangents);
        one.half_branches.extend(piece.half_branches);
        one.hits += piece.hits;
    }
    zeros.branches.push(one);
}

/// Whether a germ is one equation that is no product.
pub(super) fn irreducible(germ: &Germ) -> bool {
    match germ.equations() {
        [equation] => {
            quadric(germ).is_some() || is_irreducible_hypersurface(equation, germ.noise_by_degree())
        }
        _ => false,
    }
}

/// The signature of the quadratic form of a germ of one equation, where it has full rank.
fn quadric(germ: &Germ) -> Option<(usize, usize)> {
    match germ.equations() {
        [equation] => signature(equation, germ.noise(2)),
        _ => None,
    }
}

/// What a search on the germ came to.
pub(super) fn germ_text(
    germ: &Germ,
    order: usize,
    degree: usize,
    zeros: &GermZeros,
    complex: Option<&ComplexDimension>,
) -> String {
    let equations = match germ.equations().len() {
        1 => "1 equation".to_owned(),
        many => format!("{many} equations"),
    };
    let branches = zeros
        .branches
        .iter()
        .map(|b| format!("a branch of dimension {}", b.dimension))
        .collect::<Vec<_>>();
    let found = if branches.is_empty() {
        "none but the pose itself".to_owned()
    } else {
        branches.join(", ")
    };
    let spheres = zeros
        .radii
        .iter()
        .fold(None::<(f64, f64)>, |range, r| match range {
            None => Some((*r, *r)),
            Some((low, high)) => Some((low.min(*r), high.max(*r))),
        })
        .map_or(String::new(), |(low, high)| {
            format!(
                " on {} spheres of radius {high:.1e} to {low:.1e}",
                zeros.radii.len()
            )
        });
    let complex = complex.map_or(String::new(), |c| {
        format!(
            "; complex dimension {}, Hilbert function {:?}",
            c.dimension, c.hilbert
        )
    });
    format!(
        "{equations} of order {order} in {} variables to degree {degree}, margin {:.1e}; real zeros{spheres}: {found}; {} starts, \
         seed {}{complex}",
        germ.freedom(),
        germ.margin(),
        zeros.starts,
        zeros.seed,
    )
}
