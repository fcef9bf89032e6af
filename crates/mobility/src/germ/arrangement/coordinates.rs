//! Zeros that are coordinate spaces of one basis, counted by the products that vanish on them.
//!
//! 1. The spaces found have a common basis, each being spanned by some of its vectors.
//! 2. All forms vanish on all of them. In that basis they are therefore combinations of the products x_a x_b of coordinates that no
//!    space has both of; if there are as many independent forms as such products, the forms generate the same ideal.
//! 3. The zeros of these products are the coordinate spaces of the maximal sets of coordinates no two of which are a product:
//!    the maximal cliques of a graph. They have to be the spaces found.
//!
//! An ideal of squarefree monomials is radical, so that the zeros are simple.

use super::{CLEAR, Space, ZERO, known, projector, spectrum};
use nalgebra::{DMatrix, DVector};
use std::collections::BTreeSet;

/// Most intersections of spaces, and most cliques.
const MOST_FLATS: usize = 256;

/// A vector of a common basis, with the spaces that have it.
struct Axis {
    vector: DVector<f64>,
    of: BTreeSet<usize>,
}

/// Whether the spaces, on which the forms vanish, are proved to be all their zeros, as coordinate spaces of one basis.
pub(super) fn are_all(forms: &[DMatrix<f64>], spaces: &[Space]) -> bool {
    proved(forms, spaces).unwrap_or(false)
}

/// `None` where a margin is thin, or the spaces have no common basis.
fn proved(forms: &[DMatrix<f64>], spaces: &[Space]) -> Option<bool> {
    let size = spaces.first()?.nrows();
    let axes = common_basis(spaces)?;
    if axes.len() != size {
        return None;
    }
    let vectors: Vec<DVector<f64>> = axes.iter().map(|axis| axis.vector.clone()).collect();
    let basis = DMatrix::from_columns(&vectors);
    if basis.singular_values().min() < CLEAR {
        return None;
    }
    let excluded = |a: usize, b: usize| axes[a].of.is_disjoint(&axes[b].of);
    let products = (0..size)
        .flat_map(|a| (0..a).map(move |b| (a, b)))
        .filter(|&(a, b)| excluded(a, b))
        .count();
    if products != forms.len() {
        return Some(false);
    }
    let together = |set: &[usize]| {
        (0..spaces.len()).any(|space| set.iter().all(|&a| axes[a].of.contains(&space)))
    };
    Some(
        maximal_cliques(size, &|a, b| !excluded(a, b))?
            .iter()
            .all(|clique| together(clique)),
    )
}

/// A basis such that each space is spanned by those of its vectors that it has: of the least intersections first, completed from
/// there upwards. More vectors than dimensions where there is none.
fn common_basis(spaces: &[Space]) -> Option<Vec<Axis>> {
    let mut flats: Vec<Space> = spaces.to_vec();
    let mut next = 0;
    while next < flats.len() {
        for other in spaces {
            let both = projector(&flats[next]) + projector(other);
            let away = DMatrix::identity(both.nrows(), both.nrows()) * 2.0 - both;
            let Some(common) = kernel_of_semidefinite(&away)? else {
                continue;
            };
            if !known(&flats, &common)? {
                flats.push(common);
            }
        }
        if flats.len() > MOST_FLATS {
            return None;
        }
        next += 1;
    }
    flats.sort_by_key(|flat| flat.ncols());
    let mut axes: Vec<Axis> = Vec::new();
    for flat in &flats {
        let inside = |axis: &&Axis| {
            let v = &axis.vector;
            (flat * (flat.transpose() * v) - v).norm() < ZERO.sqrt()
        };
        let own: Vec<DVector<f64>> = axes
            .iter()
            .filter(inside)
            .map(|axis| axis.vector.clone())
            .collect();
        let mut of = BTreeSet::new();
        for (index, space) in spaces.iter().enumerate() {
            if (projector(space) * flat - flat).norm() < ZERO.sqrt() {
                of.insert(index);
            }
        }
        for vector in complement(flat, &own) {
            let of = of.clone();
            axes.push(Axis { vector, of });
        }
    }
    Some(axes)
}

/// The kernel of a positive semidefinite matrix, `Some(None)` where there is none; `None` where its rank is in doubt.
fn kernel_of_semidefinite(matrix: &DMatrix<f64>) -> Option<Option<Space>> {
    let (vectors, values) = spectrum(matrix);
    let zeros = values.iter().filter(|value| **value < ZERO).count();
    // The square of an angle.
    let clear = values.iter().filter(|v| **v > CLEAR * CLEAR).count();
    (zeros + clear == values.len())
        .then(|| (zeros > 0).then(|| vectors.columns(0, zeros).into_owned()))
}

/// Orthonormal vectors of a space that complete some of its vectors to span it.
fn complement(space: &Space, own: &[DVector<f64>]) -> Vec<DVector<f64>> {
    let mut spanned: Vec<DVector<f64>> = Vec::new();
    let rest = |spanned: &[DVector<f64>], vector: &DVector<f64>| {
        let mut rest = vector.clone();
        for _ in 0..2 {
            for other in spanned {
                rest -= other * other.dot(&rest);
            }
        }
        rest
    };
    for vector in own {
        let left = rest(&spanned, vector);
        if left.norm() > CLEAR {
            spanned.push(left.normalize());
        }
    }
    let before = spanned.len();
    while spanned.len() < space.ncols() {
        let longest = space
            .column_iter()
            .map(|column| rest(&spanned, &column.into_owned()))
            .max_by(|a, b| a.norm().total_cmp(&b.norm()));
        match longest {
            Some(vector) if vector.norm() > CLEAR => spanned.push(vector.normalize()),
            _ => break,
        }
    }
    spanned.split_off(before)
}

/// The maximal sets of vertices that are pairwise adjacent (Bron and Kerbosch 1973); `None` of more than can be.
fn maximal_cliques(
    size: usize,
    adjacent: &dyn Fn(usize, usize) -> bool,
) -> Option<Vec<Vec<usize>>> {
    let mut found = Vec::new();
    let mut waiting = vec![(Vec::new(), (0..size).collect::<Vec<_>>(), Vec::new())];
    while let Some((clique, mut candidates, mut done)) = waiting.pop() {
        if candidates.is_empty() && done.is_empty() {
            found.push(clique);
            if found.len() > MOST_FLATS {
                return None;
            }
            continue;
        }
        while let Some(vertex) = candidates.pop() {
            let near = |set: &[usize]| -> Vec<usize> {
                set.iter()
                    .copied()
                    .filter(|&v| adjacent(v, vertex))
                    .collect()
            };
            let mut larger = clique.clone();
            larger.push(vertex);
            waiting.push((larger, near(&candidates), near(&done)));
            done.push(vertex);
        }
    }
    Some(found)
}
