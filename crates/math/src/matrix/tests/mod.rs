//! Tests that run through several files of the module.

mod large;
mod small;

use super::{Ring, SparseMatrix, SplitMix64};

/// A matrix from its rows.
fn from_rows(rows: &[Vec<f64>], columns: usize) -> SparseMatrix<f64> {
    let entries = rows
        .iter()
        .enumerate()
        .flat_map(|(i, row)| row.iter().enumerate().map(move |(j, &x)| (i, j, x)));
    SparseMatrix::from_triplets(rows.len(), columns, 0.0, entries).unwrap()
}

/// A dense matrix of uniform random entries, as rows.
fn random_rows(random: &mut SplitMix64, rows: usize, columns: usize) -> Vec<Vec<f64>> {
    (0..rows)
        .map(|_| (0..columns).map(|_| random.symmetric()).collect())
        .collect()
}

/// The product of two matrices given as rows.
fn product(a: &[Vec<f64>], b: &[Vec<f64>], columns: usize) -> Vec<Vec<f64>> {
    a.iter()
        .map(|row| {
            (0..columns)
                .map(|j| row.iter().zip(b).map(|(x, other)| x * other[j]).sum())
                .collect()
        })
        .collect()
}

/// Where joints sit in loops: (loop, joint, sign).
struct Loops {
    loops: usize,
    joints: usize,
    members: Vec<(usize, usize, i64)>,
}

impl Loops {
    /// ```text
    ///  joint 0   joint 3   joint 6
    ///     +----1----+----4----+----7----+
    ///     | loop 0  | loop 1  | loop 2  |
    ///     +----2----+----5----+----8----+   two joints of each loop are its own
    /// ```
    fn chain(loops: usize) -> Self {
        let members = (0..loops).flat_map(|l| {
            [
                (l, 3 * l, -1),
                (l, 3 * l + 1, 1),
                (l, 3 * l + 2, -1),
                (l, 3 * l + 3, 1),
            ]
        });
        Self {
            loops,
            joints: 3 * loops + 1,
            members: members.collect(),
        }
    }

    /// A square lattice of `side` × `side` links; a joint on each edge, a loop in each square.
    fn lattice(side: usize) -> Self {
        let across = |row: usize, column: usize| row * (side - 1) + column;
        let down = |row: usize, column: usize| side * (side - 1) + row * side + column;
        let mut members = Vec::new();
        for row in 0..side - 1 {
            for column in 0..side - 1 {
                let own = row * (side - 1) + column;
                members.push((own, across(row, column), 1));
                members.push((own, down(row, column + 1), 1));
                members.push((own, across(row + 1, column), -1));
                members.push((own, down(row, column), -1));
            }
        }
        Self {
            loops: (side - 1) * (side - 1),
            joints: 2 * side * (side - 1),
            members,
        }
    }

    /// The same with `freedom` columns in place of each joint.
    fn with_freedom(&self, freedom: usize) -> Self {
        let copies = |&(l, joint, sign): &(usize, usize, i64)| {
            (0..freedom).map(move |copy| (l, freedom * joint + copy, sign))
        };
        Self {
            loops: self.loops,
            joints: freedom * self.joints,
            members: self.members.iter().flat_map(copies).collect(),
        }
    }

    /// The Jacobian with a given screw per joint, six rows per loop.
    fn jacobian<T: Ring>(&self, zero: T, screw: &[[T; 6]]) -> SparseMatrix<T> {
        self.jacobian_by(zero, |_, joint| screw[joint].clone())
    }

    /// The Jacobian with a screw per joint in the frame of each loop.
    fn jacobian_by<T: Ring>(
        &self,
        zero: T,
        screw: impl Fn(usize, usize) -> [T; 6],
    ) -> SparseMatrix<T> {
        let mut triplets = Vec::new();
        for &(l, joint, sign) in &self.members {
            for (i, x) in screw(l, joint).into_iter().enumerate() {
                triplets.push((6 * l + i, joint, if sign < 0 { -x } else { x }));
            }
        }
        SparseMatrix::from_triplets(6 * self.loops, self.joints, zero, triplets)
            .unwrap()
            .with_row_blocks_of(6)
    }
}

/// Parallel axes in the middles of the edges of a square lattice: every loop is a parallelogram.
fn regular_lattice_screws(side: usize) -> Vec<[i64; 6]> {
    let planar = |x: usize, y: usize| [0, 0, 1, y as i64, -(x as i64), 0];
    let across = (0..side).flat_map(|row| (0..side - 1).map(move |c| planar(2 * c + 1, 2 * row)));
    let down = (0..side - 1).flat_map(|row| (0..side).map(move |c| planar(2 * c, 2 * row + 1)));
    across.chain(down).collect()
}

/// Kinds of geometry, with small integer coordinates that every arithmetic holds exactly.
#[derive(Clone, Copy, Debug)]
enum Geometry {
    /// Parallel axes at random points: every loop is planar.
    Planar,
    /// Axes through the origin: every loop is spherical.
    Spherical,
    /// Axes anywhere.
    Spatial,
}

/// Integer screws (u; p × u) of revolute joints.
fn integer_screws(joints: usize, geometry: Geometry, seed: u64) -> Vec<[i64; 6]> {
    let mut random = SplitMix64::new(seed);
    let mut integer = || (random.next_u64() % 19) as i64 - 9;
    (0..joints)
        .map(|_| {
            let p = [integer(), integer(), integer()];
            let u = [integer(), integer(), 10 + integer()];
            match geometry {
                Geometry::Planar => [0, 0, 1, p[1], -p[0], 0],
                Geometry::Spherical => [u[0], u[1], u[2], 0, 0, 0],
                Geometry::Spatial => [
                    u[0],
                    u[1],
                    u[2],
                    p[1] * u[2] - p[2] * u[1],
                    p[2] * u[0] - p[0] * u[2],
                    p[0] * u[1] - p[1] * u[0],
                ],
            }
        })
        .collect()
}
