//! Singular values by one-sided Jacobi rotations, in any precision.

use super::real::Real;

/// Sweeps after which the rotations are given up; ten are rare, as convergence is quadratic.
const MOST_SWEEPS: usize = 60;

/// Singular values, largest first, of the matrix with the given columns of equal length.
///
/// As many values as columns, so a matrix with more columns than rows gets zeros (up to rounding)
/// at the end. Pairs of columns are rotated until all are orthogonal (Hestenes 1958; convergence
/// and accuracy: Demmel and Veselić 1992, §4): each value is found with an error of a few units
/// of roundoff times the *length of its own column*, not times the largest value, which is why this
/// slow method (O(sweeps · columns² · rows)) is kept for small matrices and many digits. Values below
/// u² times another (u the unit roundoff) are left unresolved: where exponents are unlimited, the
/// remainder of a dependent column would otherwise shrink for ever.
///
/// Returns `None` where entries are not finite or the rotations do not settle.
#[must_use]
pub fn singular_values<R: Real>(like: &R, mut columns: Vec<Vec<R>>) -> Option<Vec<R>> {
    let rows = columns.iter().map(Vec::len).max().unwrap_or(0);
    // A computed cosine is off by up to (rows + 3) u; a bound at that level could rotate for ever.
    let tolerance = 4.0 * (rows + 3) as f64 * like.unit_roundoff();
    for _ in 0..MOST_SWEEPS {
        let mut settled = true;
        // Columns sorted by length converge faster and keep small ones last (de Rijk 1989).
        let mut lengths: Vec<(R, Vec<R>)> = columns
            .into_iter()
            .map(|column| (like.norm(&column), column))
            .collect();
        if lengths.iter().any(|(length, _)| !length.is_finite()) {
            return None;
        }
        lengths.sort_by(|a, b| b.0.partial_cmp(&a.0).unwrap_or(std::cmp::Ordering::Equal));
        columns = lengths.into_iter().map(|(_, column)| column).collect();
        for left in 0..columns.len() {
            for right in left + 1..columns.len() {
                let (head, tail) = columns.split_at_mut(right);
                if rotate(like, &mut head[left], &mut tail[0], tolerance) {
                    settled = false;
                }
            }
        }
        if settled {
            return Some(columns.iter().map(|column| like.norm(column)).collect());
        }
    }
    None
}

/// Makes two columns orthogonal; false if they already are to within `tolerance` as a cosine.
fn rotate<R: Real>(like: &R, a: &mut [R], b: &mut [R], tolerance: f64) -> bool {
    let length_a = like.norm(a);
    let length_b = like.norm(b);
    if length_a.is_zero() || length_b.is_zero() {
        return false;
    }
    let ratio = length_b.clone() / length_a.clone();
    let negligible = like.unit_roundoff() * like.unit_roundoff();
    let size = Real::to_f64(&ratio);
    if size < negligible || size * negligible > 1.0 {
        return false;
    }
    let cosine = like.dot(a, b) / length_a / length_b;
    // Written so that a NaN ends the iteration; the caller tests for it.
    let oblique = Real::to_f64(&cosine.abs()) > tolerance;
    if !oblique {
        return false;
    }
    // The smaller root t of t² + 2ζt − 1 = 0 with ζ = (|b|² − |a|²) / (2 a·b).
    let one = like.one_like();
    let two = like.constant(2.0);
    let zeta = (ratio.clone() - one.clone() / ratio) / (two * cosine);
    let root = (one.clone() + zeta.clone() * zeta.clone()).sqrt();
    let tangent = if zeta < like.zero_like() {
        -(one.clone() / (root - zeta))
    } else {
        one.clone() / (root + zeta)
    };
    let cos = one.clone() / (one + tangent.clone() * tangent.clone()).sqrt();
    let sin = cos.clone() * tangent;
    for (x, y) in a.iter_mut().zip(b.iter_mut()) {
        let turned = cos.clone() * x.clone() - sin.clone() * y.clone();
        *y = sin.clone() * x.clone() + cos.clone() * y.clone();
        *x = turned;
    }
    true
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::big::Big;
    use super::*;

    #[test]
    fn known_values() {
        // [3 0; 4 5] has singular values √45 and √5.
        let values = singular_values(&0.0, vec![vec![3.0, 4.0], vec![0.0, 5.0]]).unwrap();
        assert!((values[0] - 45f64.sqrt()).abs() < 1e-14);
        assert!((values[1] - 5f64.sqrt()).abs() < 1e-14);
    }

    #[test]
    fn degenerate_shapes() {
        assert_eq!(
            singular_values::<f64>(&0.0, vec![]).unwrap(),
            Vec::<f64>::new()
        );
        assert_eq!(
            singular_values(&0.0, vec![vec![], vec![]]).unwrap(),
            [0.0, 0.0]
        );
        assert_eq!(
            singular_values(&0.0, vec![vec![0.0; 3]; 2]).unwrap(),
            [0.0, 0.0]
        );
        let wide = singular_values(&0.0, vec![vec![1.0], vec![1.0], vec![1.0]]).unwrap();
        assert!((wide[0] - 3f64.sqrt()).abs() < 1e-15 && wide[1] < 1e-15);
        assert!(singular_values(&0.0, vec![vec![f64::NAN], vec![1.0]]).is_none());
    }

    #[test]
    fn small_columns_keep_their_digits() {
        // Columns of lengths 1 and ε at 60°: σ₂ = ε sin 60° (1 + O(ε²)).
        let (s, c) = std::f64::consts::FRAC_PI_3.sin_cos();
        for tiny in [1e-8, 1e-15, 1e-25] {
            let columns = vec![vec![1.0, 0.0], vec![c * tiny, s * tiny]];
            let values = singular_values(&0.0, columns).unwrap();
            assert!((values[1] / (s * tiny) - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn many_digits() {
        // [1 1; 1 1+e]: the product of the singular values is the determinant e.
        let one = Big::new(1.0, 106);
        let small = one.constant(1e-20);
        let columns = vec![
            vec![one.clone(), one.clone()],
            vec![one.clone(), one.clone() + small],
        ];
        let values = singular_values(&one, columns).unwrap();
        let product = Real::to_f64(&(values[0].clone() * values[1].clone()));
        assert!((product / 1e-20 - 1.0).abs() < 1e-10, "{product:e}");
    }
}
