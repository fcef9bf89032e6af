//! Which sets of points are rigid, whatever the dimensions.
//!
//! Distances between points allow the velocities in the kernel of the rigidity matrix. At random positions over a prime
//! field its rank is the generic one, save with a chance of about 10⁻¹⁵ (see [`kutzbach_math::matrix::modular`]); a
//! set of points is rigid if the distances among its own points leave only the six velocities of a body.
//!
//! Two different rigid sets share at most two points, unless they are rigid together: so those through a triangle are found
//! by growing it.

use kutzbach_math::matrix::{Field61, SplitMix64};

/// Where the random positions start; fixed, so that the answer is always the same.
const SEED: u64 = 0x6b75_747a_6261_6368;

/// Positions of points at which every rank is the generic one.
struct Positions(Vec<[Field61; 3]>);

impl Positions {
    fn new(points: usize) -> Self {
        let mut random = SplitMix64::new(SEED);
        Self(
            (0..points)
                .map(|_| [0; 3].map(|_| Field61::random(&mut random)))
                .collect(),
        )
    }
}

/// The largest sets of three points or more that are rigid by the distances among themselves and are not all points,
/// each ascending, in ascending order. Points without a distance belong to none.
///
/// For n points about n eliminations of a matrix with 3n columns: milliseconds for twenty points, seconds for a hundred.
#[must_use]
pub fn rigid_sets(points: usize, distances: &[[usize; 2]]) -> Vec<Vec<usize>> {
    let positions = Positions::new(points);
    let mut used: Vec<usize> = distances.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    let mut found: Vec<Vec<usize>> = Vec::new();
    for &left_out in &used {
        let rest: Vec<usize> = used.iter().copied().filter(|&p| p != left_out).collect();
        let mut waiting = vec![rest];
        while let Some(set) = waiting.pop() {
            for part in moving_as_one(&set, distances, &positions) {
                if part.len() == set.len() {
                    found.push(part);
                } else if part.len() >= 3 {
                    // It moves as one by the distances of all of the set; whether its own suffice is asked next.
                    waiting.push(part);
                }
            }
        }
    }
    found.sort_unstable();
    found.dedup();
    let all = found.clone();
    found.retain(|set| {
        !all.iter()
            .any(|other| set.len() < other.len() && within(set, other))
    });
    found
}

/// Whether all of an ascending list is in another.
fn within(set: &[usize], other: &[usize]) -> bool {
    set.iter().all(|p| other.binary_search(p).is_ok())
}

/// The largest subsets of three points or more whose points keep all distances from one another while the distances among
/// a set of points are kept.
fn moving_as_one(
    set: &[usize],
    distances: &[[usize; 2]],
    positions: &Positions,
) -> Vec<Vec<usize>> {
    let velocities = velocities(set, distances, positions);
    let n = set.len();
    let mut kept = vec![vec![true; n]; n];
    for i in 0..n {
        for j in 0..i {
            let keeps = velocities.iter().all(|v| {
                let [p, q] = [set[i], set[j]].map(|s| positions.0[s]);
                let rate = (0..3).fold(Field61::ZERO, |sum, k| {
                    sum + (p[k] - q[k]) * (v[3 * i + k] - v[3 * j + k])
                });
                rate == Field61::ZERO
            });
            kept[i][j] = keeps;
            kept[j][i] = keeps;
        }
    }
    let mut found: Vec<Vec<usize>> = Vec::new();
    for a in 0..n {
        for b in a + 1..n {
            for c in b + 1..n {
                let triangle = kept[a][b] && kept[a][c] && kept[b][c];
                let known = || found.iter().any(|set| within(&[a, b, c], set));
                if triangle && !known() {
                    found.push(
                        (0..n)
                            .filter(|&p| kept[p][a] && kept[p][b] && kept[p][c])
                            .collect(),
                    );
                }
            }
        }
    }
    let named = |part: Vec<usize>| part.into_iter().map(|i| set[i]).collect();
    found.into_iter().map(named).collect()
}

/// A basis of the velocities that keep the distances among a set of points, three components a point.
fn velocities(set: &[usize], distances: &[[usize; 2]], positions: &Positions) -> Vec<Vec<Field61>> {
    let columns = 3 * set.len();
    let mut rows = Vec::new();
    for [a, b] in distances {
        let (Ok(i), Ok(j)) = (set.binary_search(a), set.binary_search(b)) else {
            continue;
        };
        let mut row = vec![Field61::ZERO; columns];
        for k in 0..3 {
            let difference = positions.0[*a][k] - positions.0[*b][k];
            row[3 * i + k] = difference;
            row[3 * j + k] = Field61::ZERO - difference;
        }
        rows.push(row);
    }
    kernel(rows, columns)
}

/// A basis of the kernel by elimination to reduced echelon form.
fn kernel(mut rows: Vec<Vec<Field61>>, columns: usize) -> Vec<Vec<Field61>> {
    let mut pivots: Vec<usize> = Vec::new();
    for column in 0..columns {
        let done = pivots.len();
        let found = (done..rows.len()).find(|&r| rows[r][column] != Field61::ZERO);
        let Some(found) = found else { continue };
        rows.swap(done, found);
        let Some(inverse) = rows[done][column].inverse() else {
            continue;
        };
        rows[done].iter_mut().for_each(|x| *x = *x * inverse);
        let pivot = rows[done].clone();
        for (index, row) in rows.iter_mut().enumerate() {
            let factor = row[column];
            if index != done && factor != Field61::ZERO {
                for (x, y) in row.iter_mut().zip(&pivot) {
                    *x = *x - factor * *y;
                }
            }
        }
        pivots.push(column);
    }
    let free = (0..columns).filter(|c| !pivots.contains(c));
    free.map(|column| {
        let mut vector = vec![Field61::ZERO; columns];
        vector[column] = Field61::ONE;
        for (row, &pivot) in rows.iter().zip(&pivots) {
            vector[pivot] = Field61::ZERO - row[column];
        }
        vector
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn complete(points: &[usize]) -> Vec<[usize; 2]> {
        let mut pairs = Vec::new();
        for (i, &a) in points.iter().enumerate() {
            pairs.extend(points[i + 1..].iter().map(|&b| [a.min(b), a.max(b)]));
        }
        pairs
    }

    #[test]
    fn a_triangle_of_bars_is_rigid_and_a_square_is_not() {
        let mut distances = complete(&[0, 1, 2]);
        distances.push([2, 3]);
        assert_eq!(rigid_sets(4, &distances), [vec![0, 1, 2]]);
        assert!(rigid_sets(4, &[[0, 1], [1, 2], [2, 3], [0, 3]]).is_empty());
    }

    /// ```text
    ///        a                Two bananas a-b: each five points, nine of ten distances, rigid by itself;
    ///     (( | ))             together they turn about a-b, though the count says rigid.
    ///        b
    /// ```
    #[test]
    fn two_bananas_are_two_bodies_though_the_count_says_one() {
        let banana = |others: [usize; 3]| {
            let all = [0, 1, others[0], others[1], others[2]];
            complete(&all)
                .into_iter()
                .filter(|&pair| pair != [0, 1])
                .collect::<Vec<_>>()
        };
        let mut distances = banana([2, 3, 4]);
        distances.extend(banana([5, 6, 7]));
        // One bar more fixes a point that would else be left out.
        assert_eq!(distances.len(), 3 * 8 - 6);
        assert_eq!(
            rigid_sets(8, &distances),
            [vec![0, 1, 2, 3, 4], vec![0, 1, 5, 6, 7]]
        );
    }
}
