//! Singular values and vectors of a few vectors of any length.
//!
//! The matrices of a branch have few rows or columns (six coordinates of a twist, the freedoms of one link's joints) and
//! any number of the others. Rotating pairs of the few until all are orthogonal (Hestenes 1958) is linear in the length,
//! needs no transposed copy, and finds each value with an error of a few roundings of its own vectors' lengths, however
//! much larger others are (Demmel & Veselić 1992, section 4).

/// Some vectors turned into orthogonal ones.
#[derive(Clone, Debug)]
pub(super) struct OneSided {
    /// Singular values, largest first: as many as there are vectors.
    pub values: Vec<f64>,
    /// The orthogonal vectors, each as long as its value.
    pub vectors: Vec<Vec<f64>>,
    /// Orthonormal combinations of the vectors given: `vectors[i] = Σ combinations[i][j] given[j]`.
    pub combinations: Vec<Vec<f64>>,
}

/// Sweeps after which the rotations are given up; with vectors of six coordinates five or six are usual.
const MOST_SWEEPS: usize = 60;

impl OneSided {
    /// Decomposes vectors of equal length; `None` where numbers are not finite or the rotations do not settle.
    pub fn of(mut vectors: Vec<Vec<f64>>) -> Option<Self> {
        let count = vectors.len();
        let length = vectors.first().map_or(0, Vec::len);
        let mut combinations: Vec<Vec<f64>> = (0..count)
            .map(|i| (0..count).map(|j| f64::from(u8::from(i == j))).collect())
            .collect();
        // A computed cosine is off by up to (length + 3) roundings.
        let tolerance = 2.0 * (length + 3) as f64 * f64::EPSILON;
        // Below u² of the largest a vector is what rounding left of a dependent one, and would shrink for ever.
        let largest = vectors.iter().map(|v| dot(v, v)).fold(0.0, f64::max);
        let negligible = f64::EPSILON.powi(4) * largest;
        for _ in 0..MOST_SWEEPS {
            let mut settled = true;
            for i in 0..count {
                for j in i + 1..count {
                    let (aa, bb) = (dot(&vectors[i], &vectors[i]), dot(&vectors[j], &vectors[j]));
                    let ab = dot(&vectors[i], &vectors[j]);
                    if !(aa + bb).is_finite() {
                        return None;
                    }
                    if aa.min(bb) <= negligible || ab.abs() <= tolerance * aa.sqrt() * bb.sqrt() {
                        continue;
                    }
                    settled = false;
                    let zeta = (bb - aa) / (2.0 * ab);
                    let tangent = zeta.signum() / (zeta.abs() + 1.0f64.hypot(zeta));
                    let cosine = 1.0 / 1.0f64.hypot(tangent);
                    for pair in [&mut vectors, &mut combinations] {
                        let (head, tail) = pair.split_at_mut(j);
                        rotate(&mut head[i], &mut tail[0], cosine, cosine * tangent);
                    }
                }
            }
            if settled {
                return Some(Self::sorted(vectors, combinations));
            }
        }
        None
    }

    fn sorted(vectors: Vec<Vec<f64>>, combinations: Vec<Vec<f64>>) -> Self {
        let mut found: Vec<(f64, Vec<f64>, Vec<f64>)> = vectors
            .into_iter()
            .zip(combinations)
            .map(|(vector, combination)| (norm(&vector), vector, combination))
            .collect();
        found.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut result = Self {
            values: Vec::new(),
            vectors: Vec::new(),
            combinations: Vec::new(),
        };
        for (value, vector, combination) in found {
            result.values.push(value);
            result.vectors.push(vector);
            result.combinations.push(combination);
        }
        result
    }
}

/// Σ aᵢ bᵢ.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Euclidean length; for numbers whose squares are in range.
pub(super) fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

fn rotate(a: &mut [f64], b: &mut [f64], cosine: f64, sine: f64) {
    for (x, y) in a.iter_mut().zip(b) {
        (*x, *y) = (cosine * *x - sine * *y, sine * *x + cosine * *y);
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn known_values() {
        // The columns of [3 0; 4 5]: singular values √45 and √5.
        let found = OneSided::of(vec![vec![3.0, 4.0], vec![0.0, 5.0]]).unwrap();
        assert!((found.values[0] - 45f64.sqrt()).abs() < 1e-14);
        assert!((found.values[1] - 5f64.sqrt()).abs() < 1e-14);
    }

    #[test]
    fn degenerate_shapes() {
        assert!(OneSided::of(vec![]).unwrap().values.is_empty());
        assert_eq!(OneSided::of(vec![vec![]; 6]).unwrap().values, [0.0; 6]);
        assert_eq!(
            OneSided::of(vec![vec![0.0; 3]; 2]).unwrap().values,
            [0.0; 2]
        );
        assert!(OneSided::of(vec![vec![f64::NAN], vec![1.0]]).is_none());
    }

    proptest! {
        /// Many vectors in a space of two dimensions, at the edge of what rounding leaves.
        #[test]
        fn dependent_vectors_settle(entries in proptest::collection::vec(-1.0..1.0_f64, 24)) {
            let given: Vec<Vec<f64>> = entries.chunks(2).map(<[f64]>::to_vec).collect();
            let found = OneSided::of(given).unwrap();
            prop_assert!(found.values[2] < 1e-14);
        }

        /// Small whole numbers are where decompositions go wrong: many dependent and equal rows.
        #[test]
        fn combinations_are_orthonormal_and_give_the_vectors(
            entries in proptest::collection::vec(-1..=1_i32, 42), length in 1..=7_usize,
        ) {
            let given: Vec<Vec<f64>> = (0..6)
                .map(|i| (0..length).map(|j| f64::from(entries[7 * i + j])).collect())
                .collect();
            let found = OneSided::of(given.clone()).unwrap();
            prop_assert!(found.values.is_sorted_by(|a, b| a >= b));
            for i in 0..6 {
                for j in 0..6 {
                    let expected = f64::from(u8::from(i == j));
                    let product = dot(&found.combinations[i], &found.combinations[j]);
                    prop_assert!((product - expected).abs() < 1e-13);
                    let product = dot(&found.vectors[i], &found.vectors[j]);
                    prop_assert!((product - expected * found.values[i].powi(2)).abs() < 1e-12);
                }
                for (k, x) in found.vectors[i].iter().enumerate() {
                    let sum: f64 = (0..6).map(|j| found.combinations[i][j] * given[j][k]).sum();
                    prop_assert!((sum - x).abs() < 1e-13);
                }
            }
        }
    }
}
