//! Branches of dimension two and more: which points lie on the same one.
//!
//! Points are joined by walking: steps along the tangent space, carried along so that a crossing with another sheet is
//! passed straight through, each corrected onto the zero set on the sphere. Pieces that touch only at the origin, like the
//! two nappes of a cone, are joined by slices: a linear space through a point of one piece, of a dimension that leaves a
//! curve, whose two half-branches belong to the same branch.

use super::correct::{Within, contract, land};
use super::local::{Local, rank_threshold, within};
use super::small::{agreement, distance, dot, length, orthonormal, plus, project, singular, unit};
use super::system::{Level, Work};
use kutzbach_math::matrix::SplitMix64;

/// A point of a branch of dimension two or more, at the outer radius.
#[derive(Clone, Debug)]
pub(super) struct Member {
    pub(super) z: Vec<f64>,
    pub(super) tangent: Vec<Vec<f64>>,
    pub(super) reduced: bool,
    /// Smallest singular value of the Jacobian that counts: small near a crossing.
    pub(super) regularity: f64,
    piece: usize,
}

/// Points of all branches of one dimension, grouped into pieces known to belong together.
#[derive(Clone, Debug)]
pub(super) struct Sheets {
    pub(super) dimension: usize,
    pub(super) members: Vec<Member>,
    next_piece: usize,
}

/// Longest step of a walk, in units of the radius.
const STRIDE: f64 = 0.15;

impl Sheets {
    pub(super) fn new(dimension: usize) -> Self {
        Self {
            dimension,
            members: Vec::new(),
            next_piece: 0,
        }
    }

    /// The pieces, in order of discovery.
    pub(super) fn pieces(&self) -> Vec<usize> {
        let mut pieces: Vec<usize> = self.members.iter().map(|m| m.piece).collect();
        pieces.sort_unstable();
        pieces.dedup();
        pieces
    }

    pub(super) fn of_piece(&self, piece: usize) -> impl Iterator<Item = &Member> {
        self.members.iter().filter(move |m| m.piece == piece)
    }

    /// Pieces that can be walked to from the point.
    pub(super) fn reached(
        &self,
        level: &Level<'_>,
        z: &[f64],
        tangent: &[Vec<f64>],
        reduced: bool,
        work: &mut Work,
    ) -> Vec<usize> {
        let mut reached = Vec::new();
        for piece in self.pieces() {
            let mut members: Vec<&Member> = self.of_piece(piece).collect();
            members.sort_by(|a, b| distance(&a.z, z).total_cmp(&distance(&b.z, z)));
            let joined = members
                .iter()
                .take(3)
                .any(|member| walk(level, z, tangent, reduced, member, work));
            if joined {
                reached.push(piece);
            }
        }
        reached
    }

    /// Adds a point; whether it opened a new piece.
    pub(super) fn add(&mut self, z: Vec<f64>, kind: Local, reached: &[usize]) -> bool {
        let piece = match reached.first() {
            Some(first) => {
                self.join(reached);
                *first
            }
            None => {
                self.next_piece += 1;
                self.next_piece - 1
            }
        };
        self.members.push(Member {
            z,
            tangent: kind.tangent,
            reduced: kind.reduced,
            regularity: if kind.reduced { kind.smallest } else { 0.0 },
            piece,
        });
        reached.is_empty()
    }

    /// Makes one piece, the first, of several.
    pub(super) fn join(&mut self, pieces: &[usize]) {
        for member in &mut self.members {
            if pieces.contains(&member.piece) {
                member.piece = pieces[0];
            }
        }
    }
}

/// Whether the zero set can be walked along from a point to a member.
fn walk(
    level: &Level<'_>,
    from: &[f64],
    tangent: &[Vec<f64>],
    reduced: bool,
    to: &Member,
    work: &mut Work,
) -> bool {
    let mut z = from.to_vec();
    let mut tangent = tangent.to_vec();
    let mut stride = STRIDE;
    for _ in 0..80 {
        if level.system.left() == 0 {
            return false;
        }
        let ahead = plus(&to.z, -1.0, &z);
        let left = length(&ahead);
        // Within a thousandth of the radius and along the same tangent space: the same sheet, or one so close that
        // the walk would not have told.
        if left < 1e-3 {
            return agreement(&tangent, &to.tangent) > 0.9;
        }
        // Along the sheet and along the sphere. The sheet need not contain the way to the origin: taking off z itself would
        // lead out of the sheet, and most where the member is on the far side.
        let along = project(&ahead, &tangent);
        let climb = project(&z, &tangent);
        let steepness = dot(&climb, &climb).max(f64::MIN_POSITIVE);
        let along = plus(&along, -dot(&along, &climb) / steepness, &climb);
        let reach = length(&along);
        if reach < 0.1 * left {
            return false;
        }
        let by = stride.min(reach);
        let start = unit(plus(&z, by / reach, &along));
        if let Some((landed, next)) = advance(level, &start, &tangent, reduced, by, work) {
            z = landed;
            tangent = next;
            stride = (2.0 * stride).min(STRIDE);
        } else if by > 2e-3 {
            stride = 0.5 * by;
        } else {
            // Small steps do not get over a crossing, where the kernel is larger; a leap along the tangent may.
            let leap = [0.02, 0.05, 0.1].into_iter().find_map(|leap| {
                let start = unit(plus(&z, leap / reach, &along));
                advance(level, &start, &tangent, reduced, leap, work)
            });
            let Some((landed, next)) = leap else {
                return false;
            };
            z = landed;
            tangent = next;
            stride = 0.02;
        }
    }
    false
}

/// Corrects a point predicted at a distance `by`; with the tangent space there.
fn advance(
    level: &Level<'_>,
    start: &[f64],
    tangent: &[Vec<f64>],
    reduced: bool,
    by: f64,
    work: &mut Work,
) -> Option<(Vec<f64>, Vec<Vec<f64>>)> {
    // A correction that contracts at once stays on its sheet; at multiple zeros nothing contracts.
    let landed = if reduced {
        contract(level, start, start.len() - tangent.len(), 0.2, work)?
    } else {
        land(level, start, &Within::Sphere, 40, work)
    };
    let near = landed.above_truncation <= 1.0 && distance(&landed.z, start) <= 0.4 * by;
    let next = near.then(|| carried(level, &landed.z, landed.size, tangent, reduced, work))??;
    Some((landed.z, next))
}

/// The tangent space at a neighbouring point: the kernel there where it has the right dimension and nearly the right
/// direction; the old one where the kernel is larger, as it is on a crossing and on a set that is not reduced.
fn carried(
    level: &Level<'_>,
    z: &[f64],
    size: f64,
    old: &[Vec<f64>],
    reduced: bool,
    work: &mut Work,
) -> Option<Vec<Vec<f64>>> {
    level.evaluate(z, work);
    let (values, vectors) = singular(&work.jacobian, z.len());
    let rank = z.len() - old.len();
    let regular = rank == 0 || values[rank - 1] > rank_threshold(level, size);
    if reduced && regular {
        let kernel = vectors[rank..].to_vec();
        let turned = agreement(&kernel, old);
        if turned > 0.9 {
            return Some(kernel);
        }
        // Close to a crossing the kernel turns fast although the sheet does not.
        let near_crossing = rank > 0 && values[rank - 1] < 0.05 * values[0];
        return near_crossing.then(|| old.to_vec());
    }
    // The old space, corrected so that it contains the point's own direction as the cone over the sheet nearly does.
    (within(old, z) > 0.5).then(|| old.to_vec())
}

/// A random linear space through z in which a set of the given dimension leaves a curve; its first vector is z.
pub(super) fn slice_through(z: &[f64], dimension: usize, random: &mut SplitMix64) -> Vec<Vec<f64>> {
    let mut vectors = vec![z.to_vec()];
    while vectors.len() < z.len() + 1 - dimension {
        vectors.push(z.iter().map(|_| random.symmetric()).collect());
    }
    orthonormal(&vectors)
}
