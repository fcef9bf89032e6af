//! Which two half-branches make one curve through the origin.
//!
//! An irreducible real curve germ has exactly two half-branches: it is y(t) = t^m·z(t) with z analytic, t > 0 giving one
//! and t < 0 the other (Milnor 1968, §3). In terms of the radius t is ±r^{1/m} to leading order, so the directions of
//! both half-branches, the second one with the sign (−1)^m, are values of one analytic function at positive and negative t.
//! m = 1 is a smooth curve, m = 2 a cusp. Candidates are judged by how well one polynomial fits both sides.

use super::small::{distance, dot, least_squares, plus, unit};

/// Two half-branches of one curve.
#[derive(Clone, Debug)]
pub(super) struct Pair {
    pub(super) halves: [usize; 2],
    /// The exponent m.
    pub(super) ramification: usize,
    /// Limit direction of the first half as the radius goes to 0; the other's is (−1)^m of it.
    pub(super) tangent: Vec<f64>,
    /// Whether another partner would do almost as well.
    pub(super) ambiguous: bool,
}

/// Largest misfit of a true pair, in units of the radius. Fits of true pairs are good to the number of nodes: the worst
/// measured are cusps with m = 2, at 1e-4.
const LARGEST_MISFIT: f64 = 5e-3;

/// Between the innermost points of both sides an analytic function changes about as much as along either of them, times the ratio of
/// the ways in t; this many times that much is allowed.
const STEADY: f64 = 4.0;

struct Fit {
    misfit: f64,
    tangent: Vec<f64>,
}

/// Fits one polynomial to both sides: `h`, `g` directions at `radii`, outermost first.
fn fit(h: &[Vec<f64>], g: &[Vec<f64>], radii: &[f64], m: usize) -> Fit {
    let sign = if m % 2 == 1 { -1.0 } else { 1.0 };
    let mut nodes: Vec<(f64, Vec<f64>)> = Vec::new();
    for ((a, b), r) in h.iter().zip(g).zip(radii) {
        let t = (r / radii[0]).powf(1.0 / m as f64);
        nodes.push((t, a.clone()));
        nodes.push((-t, b.iter().map(|x| sign * x).collect()));
    }
    // Four equations more than unknowns: those are the test.
    let size = nodes.len() - 4;
    let chebyshev = |t: f64| {
        let mut row = vec![1.0, t];
        while row.len() < size {
            let k = row.len();
            row.push(2.0 * t * row[k - 1] - row[k - 2]);
        }
        row.truncate(size);
        row
    };
    let rows: Vec<Vec<f64>> = nodes.iter().map(|(t, _)| chebyshev(*t)).collect();
    let at_origin = chebyshev(0.0);
    let mut misfits = vec![0.0; nodes.len()];
    let mut tangent = Vec::new();
    for coordinate in 0..h[0].len() {
        let values: Vec<f64> = nodes.iter().map(|(_, z)| z[coordinate]).collect();
        let x = least_squares(&mut rows.clone(), &mut values.clone(), size);
        tangent.push(dot(&at_origin, &x));
        for ((misfit, row), value) in misfits.iter_mut().zip(&rows).zip(&values) {
            *misfit += (dot(row, &x) - value).powi(2);
        }
    }
    Fit {
        misfit: misfits.iter().fold(0.0, |m, v| f64::max(m, v.sqrt())),
        tangent: unit(tangent),
    }
}

/// Whether directions `h` and `g` change as slowly across the origin as they do along the radii. Where these span little, a polynomial
/// with its bend between the two sides would fit any two half-branches.
fn steady(h: &[Vec<f64>], g: &[Vec<f64>], radii: &[f64], m: usize, accuracy: f64) -> bool {
    let sign = if m % 2 == 1 { -1.0 } else { 1.0 };
    let last = radii.len() - 1;
    let innermost = (radii[last] / radii[0]).powf(1.0 / m as f64);
    let along = distance(&h[0], &h[last]).max(distance(&g[0], &g[last]));
    let mirrored: Vec<f64> = g[last].iter().map(|x| sign * x).collect();
    let across = distance(&h[last], &mirrored);
    across <= STEADY * (2.0 * innermost / (1.0 - innermost) * along + accuracy)
}

/// Pairs half-branches given as directions at `radii`, outermost first; those without a partner are left over.
/// `accuracies`: how well the directions of each are known.
pub(super) fn pair(
    tracks: &[&[Vec<f64>]],
    accuracies: &[f64],
    radii: &[f64],
    largest_ramification: usize,
) -> (Vec<Pair>, Vec<usize>) {
    let mut choices = Vec::new();
    // The outermost radius is left out: it serves the search, where the fit wants to be well inside convergence.
    let inner = &radii[1..];
    for i in 0..tracks.len() {
        for j in i + 1..tracks.len() {
            let accuracy = accuracies[i].max(accuracies[j]);
            let best = (1..=largest_ramification)
                .filter(|m| steady(&tracks[i][1..], &tracks[j][1..], inner, *m, accuracy))
                .map(|m| (m, fit(&tracks[i][1..], &tracks[j][1..], inner, m)))
                // A larger m is more flexible: it has to be better to be believed.
                .map(|(m, fit)| {
                    // Below the accuracy of the points all misfits are alike.
                    let misfit = fit.misfit.max(accuracy);
                    (misfit * f64::powi(2.0, m as i32), m, fit)
                })
                .min_by(|a, b| a.0.total_cmp(&b.0));
            if let Some((score, m, fit)) = best {
                choices.push((score, i, j, m, fit));
            }
        }
    }
    choices.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut partner = vec![None; tracks.len()];
    let mut pairs = Vec::new();
    for (score, i, j, m, fit) in &choices {
        if fit.misfit > LARGEST_MISFIT || partner[*i].is_some() || partner[*j].is_some() {
            continue;
        }
        let rival = choices
            .iter()
            .filter(|(_, a, b, ..)| {
                (a, b) != (i, j)
                    && [a, b].iter().any(|k| *k == i || *k == j)
                    && partner[*a].is_none()
                    && partner[*b].is_none()
            })
            .map(|choice| choice.0)
            .fold(f64::INFINITY, f64::min);
        partner[*i] = Some(*j);
        partner[*j] = Some(*i);
        pairs.push(Pair {
            halves: [*i, *j],
            ramification: *m,
            tangent: fit.tangent.clone(),
            ambiguous: rival < 5.0 * score,
        });
    }
    let left = (0..tracks.len()).filter(|i| partner[*i].is_none());
    (pairs, left.collect())
}

/// Where the smooth continuation of a half-branch through the origin would be at the innermost radius: the polynomial
/// through its own directions, at negative radius.
pub(super) fn continuation(track: &[Vec<f64>], radii: &[f64]) -> Vec<f64> {
    let last = radii.len() - 1;
    // Lagrange interpolation through the inner half.
    let nodes: Vec<usize> = (last / 2..=last).collect();
    let at = -radii[last];
    let mut sum = vec![0.0; track[0].len()];
    for &i in &nodes {
        let weight: f64 = nodes
            .iter()
            .filter(|j| **j != i)
            .map(|j| (at - radii[*j]) / (radii[i] - radii[*j]))
            .product();
        sum = plus(&sum, weight, &track[i]);
    }
    unit(sum.iter().map(|x| -x).collect())
}
