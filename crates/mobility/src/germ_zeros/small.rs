//! Dense kernels for a handful of columns: singular values, least squares, orthogonal complements.
//!
//! Matrices here have at most about eight columns and thirty rows, stored as a list of rows. The routines are called
//! thousands of times per germ, so they stay free of set-up cost; none of them forms AᵀA.

/// Scalar product.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Euclidean length.
pub(super) fn length(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// Distance of two points.
pub(super) fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(x, y)| (x - y) * (x - y))
        .sum::<f64>()
        .sqrt()
}

/// The vector over its length; unchanged where it is zero.
pub(super) fn unit(mut a: Vec<f64>) -> Vec<f64> {
    let size = length(&a);
    if size > 0.0 {
        a.iter_mut().for_each(|x| *x /= size);
    }
    a
}

/// a + factor·b.
pub(super) fn plus(a: &[f64], factor: f64, b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(x, y)| x + factor * y).collect()
}

/// Orthogonal projection onto the span of orthonormal vectors.
pub(super) fn project(vector: &[f64], basis: &[Vec<f64>]) -> Vec<f64> {
    let mut image = vec![0.0; vector.len()];
    for direction in basis {
        image = plus(&image, dot(vector, direction), direction);
    }
    image
}

/// Orthonormal basis of the span, by Gram and Schmidt applied twice; vectors that add less than 1e-8 of their length
/// are left out.
pub(super) fn orthonormal(vectors: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for vector in vectors {
        let size = length(vector);
        let once = plus(vector, -1.0, &project(vector, &basis));
        let twice = plus(&once, -1.0, &project(&once, &basis));
        if length(&twice) > 1e-8 * size {
            basis.push(unit(twice));
        }
    }
    basis
}

/// Smallest cosine between a vector of one space and the other space (both orthonormal, equal dimension): 1 where they
/// agree, 0 where a direction of one is orthogonal to the other.
pub(super) fn agreement(a: &[Vec<f64>], b: &[Vec<f64>]) -> f64 {
    let products: Vec<Vec<f64>> = a
        .iter()
        .map(|x| b.iter().map(|y| dot(x, y)).collect())
        .collect();
    let (values, _) = singular(&products, b.len());
    values.last().copied().unwrap_or(1.0)
}

/// Rotates a family of vectors until they are pairwise orthogonal in the given weighting (Hestenes 1958): what one-sided
/// Jacobi does to columns. `companions` undergo the same rotations.
pub(super) fn rotate_to_orthogonal(
    vectors: &mut [Vec<f64>],
    companions: &mut [Vec<f64>],
    weights: Option<&[f64]>,
) {
    let product = |a: &[f64], b: &[f64]| match weights {
        None => dot(a, b),
        Some(w) => a.iter().zip(b).zip(w).map(|((x, y), w)| x * y * w).sum(),
    };
    // No product of unit vectors is closer to zero than the rounding of its sum.
    let length = vectors.first().map_or(0, Vec::len);
    let rounding = f64::EPSILON * (length.max(1) as f64).sqrt();
    // Convergence is quadratic; a dozen sweeps are never reached for these sizes.
    for _ in 0..30 {
        let mut turned = false;
        for i in 0..vectors.len() {
            for j in i + 1..vectors.len() {
                let (aa, bb, ab) = (
                    product(&vectors[i], &vectors[i]),
                    product(&vectors[j], &vectors[j]),
                    product(&vectors[i], &vectors[j]),
                );
                // Vectors of length zero are orthogonal to everything.
                if ab.abs() <= rounding * (aa * bb).sqrt() || ab == 0.0 {
                    continue;
                }
                turned = true;
                let zeta = (bb - aa) / (2.0 * ab);
                let tangent = zeta.signum() / (zeta.abs() + zeta.hypot(1.0));
                let cosine = 1.0 / tangent.hypot(1.0);
                let sine = cosine * tangent;
                turn(vectors, i, j, cosine, sine);
                if !companions.is_empty() {
                    turn(companions, i, j, cosine, sine);
                }
            }
        }
        if !turned {
            return;
        }
    }
}

fn turn(vectors: &mut [Vec<f64>], i: usize, j: usize, cosine: f64, sine: f64) {
    let (head, tail) = vectors.split_at_mut(j);
    for (a, b) in head[i].iter_mut().zip(tail[0].iter_mut()) {
        (*a, *b) = (cosine * *a - sine * *b, sine * *a + cosine * *b);
    }
}

/// Singular values, largest first, one per column, and the right singular vectors in the same order.
pub(super) fn singular(rows: &[Vec<f64>], columns: usize) -> (Vec<f64>, Vec<Vec<f64>>) {
    let mut work: Vec<Vec<f64>> = (0..columns)
        .map(|j| rows.iter().map(|row| row[j]).collect())
        .collect();
    let mut vectors: Vec<Vec<f64>> = (0..columns)
        .map(|j| (0..columns).map(|i| f64::from(u8::from(i == j))).collect())
        .collect();
    rotate_to_orthogonal(&mut work, &mut vectors, None);
    let mut order: Vec<usize> = (0..columns).collect();
    let sizes: Vec<f64> = work.iter().map(|column| length(column)).collect();
    order.sort_by(|a, b| sizes[*b].total_cmp(&sizes[*a]));
    (
        order.iter().map(|i| sizes[*i]).collect(),
        order.iter().map(|i| vectors[*i].clone()).collect(),
    )
}

/// Minimises |A x − b| by Householder reflections; a column without a pivot gets 0. `rows` and `right` are overwritten.
pub(super) fn least_squares(rows: &mut [Vec<f64>], right: &mut [f64], columns: usize) -> Vec<f64> {
    let height = rows.len();
    let mut diagonal = vec![0.0; columns];
    for k in 0..columns.min(height) {
        let size = rows[k..].iter().map(|r| r[k] * r[k]).sum::<f64>().sqrt();
        if size == 0.0 {
            continue;
        }
        let head = if rows[k][k] > 0.0 { -size } else { size };
        diagonal[k] = head;
        rows[k][k] -= head;
        let norm = rows[k..].iter().map(|r| r[k] * r[k]).sum::<f64>();
        for j in k + 1..columns {
            let factor = 2.0 * rows[k..].iter().map(|r| r[k] * r[j]).sum::<f64>() / norm;
            for row in rows[k..].iter_mut() {
                row[j] -= factor * row[k];
            }
        }
        let factor = 2.0
            * rows[k..]
                .iter()
                .zip(&right[k..])
                .map(|(r, b)| r[k] * b)
                .sum::<f64>()
            / norm;
        for (row, b) in rows[k..].iter().zip(right[k..].iter_mut()) {
            *b -= factor * row[k];
        }
    }
    let mut x = vec![0.0; columns];
    for k in (0..columns.min(height)).rev() {
        if diagonal[k] != 0.0 {
            let known: f64 = (k + 1..columns).map(|j| rows[k][j] * x[j]).sum();
            x[k] = (right[k] - known) / diagonal[k];
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn least_squares_meets_the_normal_equations() {
        let a = [[1.0, 2.0], [3.0, -1.0], [0.5, 4.0]];
        let b = [1.0, -2.0, 3.0];
        let mut rows: Vec<Vec<f64>> = a.iter().map(|r| r.to_vec()).collect();
        let x = least_squares(&mut rows, &mut b.to_vec(), 2);
        for j in 0..2 {
            let gradient: f64 = (0..3).map(|i| a[i][j] * (dot(&a[i], &x) - b[i])).sum();
            assert!(gradient.abs() < 1e-13);
        }
    }

    #[test]
    fn singular_vectors_span_the_kernel() {
        let rows = vec![vec![1.0, 2.0, 3.0], vec![2.0, 4.0, 6.5]];
        let (values, vectors) = singular(&rows, 3);
        assert!(values[1] > 0.1 && values[2] < 1e-14);
        assert!(rows.iter().all(|row| dot(row, &vectors[2]).abs() < 1e-14));
        assert!((length(&vectors[2]) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn agreement_sees_the_worst_direction() {
        let e = |i: usize| (0..3).map(|j| f64::from(u8::from(i == j))).collect();
        let plane: [Vec<f64>; 2] = [e(0), e(1)];
        assert!(agreement(&plane, &[e(0), e(2)]) < 1e-15);
        assert!(agreement(&plane, &[e(1), e(0)]) > 1.0 - 1e-15);
    }
}
