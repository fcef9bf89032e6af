//! Sets of joints to relax, all at once, after which no constraint is redundant and the mobility is what it was.
//!
//! Let the rows of N span the left kernel of the closure Jacobian, one for each of r redundant constraints. A joint that gains
//! the screws T adds the columns T to the Jacobian; the kernel stays, and r falls by the rank of N·T, where these columns are
//! independent there. A set of changes works if the columns of all of them together are independent and r in number. Then
//! the Jacobian has full rank: the pose is regular and the finite mobility is the instantaneous one. Where it was less before,
//! at a singular pose, no set can leave it as it was.

use super::advice::coupled_joints;
use super::change_search::{Candidate, least_sets};
use super::pose_rank::PartRank;
use super::redundancy::SelfStresses;
use super::relaxation::{Relaxed, contacts, mobility_stays, relaxations, standing_there};
use super::row_space::RowSpace;
use kutzbach_closure::{Geometry, JointState, Part, Vector};
use kutzbach_math::matrix::{CLEARANCE, MatrixError, ROUNDINGS};
use kutzbach_model::mechanism::{JointKind, Mechanism};
use nalgebra::DMatrix;

/// A joint of another kind than it has.
#[derive(Clone, Debug, PartialEq)]
pub struct JointChange {
    /// Index of the joint.
    pub joint: usize,
    /// The kind it would become.
    pub to: JointKind,
    /// The axis where it is another than the joint's, in the predecessor's joint frame, as a file writes `axis`.
    pub axis: Option<Vector<f64>>,
    /// The second axis of a kind that has one, in the successor's joint frame, as a file writes `axis2`.
    pub second_axis: Option<Vector<f64>>,
}

/// Sets of changes for one part of a mechanism, any one of which leaves it without a redundant constraint.
#[derive(Clone, Debug, PartialEq)]
pub struct ChangeSets {
    /// Redundant constraints that each set removes.
    pub redundant: usize,
    /// At least one, all of the same size; in the order of the part's joints. Each has been applied and its rank decided.
    pub sets: Vec<Vec<JointChange>>,
    /// Whether it has been shown that no smaller set of such changes does as much.
    pub least: bool,
    /// Whether these are all sets of this size.
    pub complete: bool,
}

/// Why there is no set of changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoChangeSet {
    /// No constraint is redundant.
    NothingRedundant,
    /// It was not asked for, or the mobility or a rank is not decided.
    Undecided,
    /// The instantaneous mobility exceeds the finite one: without a redundant constraint the two are equal.
    Singular,
    /// A part has too many redundant constraints and equations.
    TooLarge,
    /// The kinds that joints may become do not reach every redundant constraint.
    OutOfReach,
}

/// Parts whose redundant constraints, squared, times the equations exceed this are not looked at: their left kernel is dense, and that
/// many multiplications, some hundred times over, take a second.
const MOST_WORK: usize = 30_000_000;

/// What is left of a unit load below this is no help to speak of.
const WEAK: f64 = 1e-6;

/// Sets that are applied and ranked, where a rank takes microseconds, and where it takes milliseconds.
const VERIFIED: usize = 256;
const VERIFIED_OF_LARGE_PARTS: usize = 4;
const LARGE: usize = 40;

/// The sets of one part, its joints in a given order. Geometry and states are as they were afterwards.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub(super) fn change_sets(
    mechanism: &Mechanism,
    geometry: &mut Geometry<f64>,
    states: &mut [JointState<f64>],
    (part, rank): (&Part, &PartRank),
    joints: &[usize],
) -> Result<Result<ChangeSets, NoChangeSet>, MatrixError> {
    let independent = rank.settled().and_then(|decision| decision.rank);
    let redundant = independent.map_or(0, |independent| rank.equations() - independent);
    if redundant.saturating_pow(2).saturating_mul(rank.equations()) > MOST_WORK {
        return Ok(Err(NoChangeSet::TooLarge));
    }
    let Some(stresses) = SelfStresses::all(part, rank)? else {
        return Ok(Err(NoChangeSet::Undecided));
    };
    let redundant = stresses.count();
    if redundant == 0 {
        return Ok(Err(NoChangeSet::NothingRedundant));
    }
    let coupled = coupled_joints(mechanism, part);
    let joints: Vec<usize> = joints
        .iter()
        .copied()
        .filter(|j| !coupled.contains(j))
        .collect();
    let threshold = stresses.threshold().max(WEAK);
    let length = rank.jacobian.length;
    let search = |contacts: bool| {
        let ways: Vec<Way> = joints
            .iter()
            .flat_map(|&joint| ways(mechanism, geometry, states, joint, contacts))
            .filter_map(|way| way.loaded(rank, &stresses, threshold, length))
            .collect();
        let candidates: Vec<Candidate> = ways.iter().map(Way::candidate).collect();
        let found = least_sets(&candidates, redundant, threshold)?;
        Some((ways, found))
    };
    let Some((ways, found)) = search(false).or_else(|| search(true)) else {
        return Ok(Err(NoChangeSet::OutOfReach));
    };
    let verified = match rank.unknowns() > LARGE {
        true => VERIFIED_OF_LARGE_PARTS,
        false => VERIFIED,
    };
    let mut sets = Vec::new();
    let mut complete = found.complete && found.sets.len() <= verified;
    let mut check = Check::new(&ways, rank, threshold);
    for set in found.sets.iter().take(verified) {
        let changes = set.iter().map(|&way| ways[way].change.clone()).collect();
        if check.holds(set, geometry, states, part)? {
            sets.push(changes);
        } else {
            complete = false;
        }
    }
    if sets.is_empty() {
        return Ok(Err(NoChangeSet::Undecided));
    }
    Ok(Ok(ChangeSets {
        redundant,
        sets,
        least: found.least,
        complete,
    }))
}

/// Shows of sets that they work, by applying each set, or each of its ways and seeing that they are far from dependent.
struct Check<'a> {
    ways: &'a [Way],
    rank: &'a PartRank,
    threshold: f64,
    /// Whether a way, applied alone, raises the rank by what it gains; `None` where it was not applied.
    alone: Vec<Option<bool>>,
}

impl<'a> Check<'a> {
    fn new(ways: &'a [Way], rank: &'a PartRank, threshold: f64) -> Self {
        Self {
            ways,
            rank,
            threshold,
            alone: vec![None; ways.len()],
        }
    }

    /// Whether with all ways of a set in place no constraint is redundant and the mobility is what it was.
    fn holds(
        &mut self,
        set: &[usize],
        geometry: &mut Geometry<f64>,
        states: &mut [JointState<f64>],
        part: &Part,
    ) -> Result<bool, MatrixError> {
        if self.are_far_from_dependent(set) {
            for &way in set {
                if self.alone[way].is_none() {
                    self.alone[way] = Some(self.applied(&[way], geometry, states, part)?);
                }
            }
            if set.iter().all(|&way| self.alone[way] == Some(true)) {
                return Ok(true);
            }
        }
        self.applied(set, geometry, states, part)
    }

    /// Applies some ways and decides the rank.
    fn applied(
        &self,
        set: &[usize],
        geometry: &mut Geometry<f64>,
        states: &mut [JointState<f64>],
        part: &Part,
    ) -> Result<bool, MatrixError> {
        let ways = set.iter().map(|&way| &self.ways[way]);
        let gained = ways.clone().map(|way| way.gained).sum();
        let mut relaxed: Vec<(usize, Relaxed)> = ways
            .map(|way| (way.change.joint, way.relaxed.clone()))
            .collect();
        mobility_stays(&mut relaxed, geometry, states, part, self.rank, gained)
    }

    /// Whether the Jacobian with the columns of all ways has full row rank, by a bound.
    ///
    /// Let the columns of J be of unit length, s its smallest singular value that is not zero, and N an orthonormal basis of its left
    /// kernel. Let the added columns T be of unit length too, θ their Frobenius norm, and t the smallest singular value of N·T. A
    /// unit vector u + n, n in the kernel, is taken to a length whose square is at least s²|u|² + (t|n| − θ|u|)² where the bracket is
    /// positive, and at least s²|u|² elsewhere. The quadratic form of |u| and |n| has the least eigenvalue det/trace or more, so that
    /// the smallest singular value of [J T] is at least *s t / √(s² + t² + θ²)*; elsewhere |u|² ≥ t² / (t² + θ²), and the bound is
    /// the same. As t is taken 1 / ‖(N·T)⁻¹‖_F less what the rows may be off by; the largest singular value is √columns at most.
    fn are_far_from_dependent(&self, set: &[usize]) -> bool {
        let ways = set.iter().map(|&way| &self.ways[way]);
        let rows: Vec<(&Vec<f64>, f64)> = ways
            .flat_map(|way| way.rows.iter().zip(way.lengths.iter().copied()))
            .collect();
        let count = rows.len();
        if rows
            .iter()
            .any(|(row, length)| row.len() != count || !(*length > 0.0))
        {
            return false;
        }
        let loads = DMatrix::from_fn(count, count, |i, j| rows[i].0[j] / rows[i].1);
        let Some(inverse) = loads.try_inverse() else {
            return false;
        };
        let shortest = rows
            .iter()
            .map(|(_, length)| *length)
            .fold(f64::INFINITY, f64::min);
        let t = 1.0 / inverse.norm() - self.threshold / shortest * count as f64;
        let decision = &self.rank.decision;
        let s = decision.kept * decision.largest;
        let columns = (self.rank.unknowns() + count) as f64;
        let rounding = ROUNDINGS * f64::EPSILON * columns.max(self.rank.equations() as f64);
        let accuracy = decision.accuracy.max(self.rank.accuracy).max(rounding);
        let least = s * t / (s * s + t * t + count as f64).sqrt();
        t > 0.0 && least > CLEARANCE * accuracy * columns.sqrt()
    }
}

/// A way to change a joint.
struct Way {
    change: JointChange,
    relaxed: Relaxed,
    /// Rows that it frees: N·T for a basis of the columns T that it adds, where N are the self-stresses.
    rows: Vec<Vec<f64>>,
    /// Lengths of those columns, in the rows' order.
    lengths: Vec<f64>,
    gained: usize,
}

/// All ways to change a joint, with contacts or without.
fn ways(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &[JointState<f64>],
    joint: usize,
    with_contacts: bool,
) -> Vec<Way> {
    let kind = mechanism.joints()[joint].kind;
    let (displacement, state) = (&geometry.displacements[joint], &states[joint]);
    let mut targets: Vec<(JointKind, Vector<f64>, Vector<f64>)> = Vec::new();
    for relaxation in relaxations(kind, displacement, state) {
        for second_axis in relaxation.second_axes() {
            targets.push((relaxation.to, relaxation.axis, second_axis));
        }
    }
    if with_contacts {
        targets.extend(contacts(kind, displacement, state));
    }
    let of = |(to, axis, second_axis): (JointKind, Vector<f64>, Vector<f64>)| {
        let relaxed = standing_there(displacement, state, (to, &axis, &second_axis));
        let second = *relaxed.displacement.second_axis();
        let change = JointChange {
            joint,
            to,
            axis: (to.uses_axis() && axis != *displacement.axis()).then_some(axis),
            second_axis: to.uses_second_axis().then_some(second),
        };
        Way {
            change,
            relaxed,
            rows: Vec::new(),
            lengths: Vec::new(),
            gained: to.freedom() - kind.freedom(),
        }
    };
    targets.into_iter().map(of).collect()
}

impl Way {
    /// With the rows that it frees; `None` if it would add mobility by itself.
    fn loaded(
        mut self,
        rank: &PartRank,
        stresses: &SelfStresses,
        threshold: f64,
        length: f64,
    ) -> Option<Self> {
        // Translations count in units of the part's length, as in its Jacobian.
        let mut screws = self.relaxed.screws();
        for screw in &mut screws {
            if screw.angular == [0.0; 3] {
                screw.linear = screw.linear.map(|x| x * length);
            }
        }
        // What the joint can do already is not loaded.
        let mut space = RowSpace::new(threshold);
        let loads = stresses.loads_of(rank, self.change.joint, &screws);
        let lengths = stresses.column_lengths(rank, self.change.joint, &screws);
        for (row, length) in loads.into_iter().zip(lengths) {
            if space.add(&row) {
                self.rows.push(row);
                self.lengths.push(length);
            }
        }
        (self.rows.len() == self.gained).then_some(self)
    }

    fn candidate(&self) -> Candidate {
        Candidate {
            joint: self.change.joint,
            rows: self.rows.clone(),
        }
    }
}
