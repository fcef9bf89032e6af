//! The instantaneous freedom of a part at a pose: a rank, with its margin, in as many digits as it takes.
//!
//! Three readings of the same numbers:
//!
//! 1. *Within the stated precision.* Entries are uncertain by what the file's decimals leave open; singular values below
//!    that are zeros that were rounded. This is the answer wherever a clear gap separates them from the rest.
//! 2. *As written.* The numbers taken literally, uncertain by rounding only. It differs from the first for a mechanism
//!    whose special geometry was rounded, and then both are reported.
//! 3. Where double precision decides neither, the geometry is evaluated again from the file's own digits with 106, 212
//!    and more bits: true zeros fall with the arithmetic, small values stay. So it is where exact numbers have many digits
//!    and double precision sees a zero, which they may have been chosen to miss: with three times as many bits as they have.
//!
//! # Poses that were assembled
//! A pose drawn closed is exact. One that was found by iteration closes to some residual ρ only, and how far that is from
//! a closed pose depends on the rank itself: with a smallest kept singular value σ, all relative to the largest, the
//! Newton step is at most ρ/σ, screws turn by no more than twice that (a screw's derivative is a bracket with another),
//! and σ is certain to be no rounding of zero if it exceeds that by far: σ² ≫ ρ. Where it does not, the pose may be close
//! to a singular one, from which an iteration stays away by √ρ. So the rank of an assembled pose must come out the same
//! with an accuracy of √ρ; otherwise more digits decide, in which ρ is smaller.
//!
//! A pose that is drawn closed within the stated precision, but not beyond, is moved by closing it exactly. What it was
//! meant to be is then as open as the way it moved.

use super::hidden::null_vectors_in_doubles;
use super::more_digits::MoreDigits;
mod note;
mod readings;

use kutzbach_closure::{CycleJacobian, Geometry, JointState, Part, entry_accuracy, jacobian};
use kutzbach_math::matrix::{MatrixError, NullVectors, RankDecision, SparseMatrix};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Configuration, CouplingTerm, JointId, Mechanism};
pub use note::RankNote;
use readings::Readings;
use std::cell::Cell;
use std::collections::BTreeSet;
use std::sync::OnceLock;

/// The bits tried in turn after double precision.
pub const LADDER: [u32; 4] = [106, 212, 424, 848];

/// A stated precision that makes the Jacobian uncertain by more than this separates nothing: a kept singular value would
/// have to be ten times as large. Unless even so the rank is clear, the numbers are taken literally, which the report says.
const COARSEST_STATED: f64 = 0.05;

/// The stated precision bounds a Jacobian's uncertainty to first order. At 5 %, the coarsest that is used, the second order
/// is a twentieth of that; half as much again leaves room for it and for the estimate in the bound itself.
pub(super) const BEYOND_FIRST_ORDER: f64 = 1.5;

/// Numbers of more bits than this (8 decimals) can hold offsets that double precision takes for rounding.
pub(super) const TALL: usize = 27;

/// Whether a number of a part was computed from decimals: then any offset may be meant by it, or none by its last digits. Where these are
/// rounded, what knows the literals behind it says by these how far it may be off.
pub(super) fn is_computed(mechanism: &Mechanism, part: &Part) -> bool {
    let computed = |x: &Number| x.stated().is_none() && x.coarsest_input().is_some();
    let exact = mechanism.is_exact(&part.joints);
    numbers(mechanism, part).any(|x| computed(x) && (exact || x.inputs().is_empty()))
}

/// All numbers of a part's geometry.
pub(super) fn numbers<'a>(
    mechanism: &'a Mechanism,
    part: &'a Part,
) -> impl Iterator<Item = &'a Number> {
    let joints = part.joints.iter().flat_map(|&joint| {
        let joint = &mechanism.joints()[joint];
        let sides = [&joint.predecessor.frame, &joint.successor.frame];
        sides
            .into_iter()
            .flat_map(|frame| frame.position.iter().chain(&frame.roll_pitch_yaw))
            .chain(&joint.axis.0)
            .chain(&joint.axis2.0)
            .chain(&joint.lead)
            .chain(&joint.distance)
    });
    let couplings = part.couplings.iter().flat_map(|&coupling| {
        let coupling = &mechanism.couplings()[coupling];
        let factors = coupling.terms.iter().flat_map(CouplingTerm::factors);
        factors.chain([&coupling.offset])
    });
    joints.chain(couplings)
}

/// Doubles below this share of the largest are likely to be rounding: 2^−40.
const ROUNDED: f64 = 9.1e-13;

/// Bits of the longest number that a part's geometry holds (see [`Number::height`]), or those
/// between its largest and its smallest number, if they are more than [`TALL`]: what is written as 1 m beside 1e16 m is meant. Whole
/// numbers count for that, and those that have a height; others that no decimal is in down to 2^−40 of the largest, since what is smaller is
/// likely to be the rounding of a double.
pub(super) fn height(mechanism: &Mechanism, part: &Part) -> usize {
    let mut longest = 0;
    // Sizes of numbers that are meant, and of those that are unless they are very small.
    let (mut meant, mut others) = (Vec::new(), Vec::new());
    for number in numbers(mechanism, part) {
        let bits = number.height();
        longest = longest.max(bits);
        let stated = number.stated().is_some();
        let whole = || !stated && number.rational().is_some_and(|x| x.is_int());
        let size = number.value().abs();
        if size > 0.0 && (bits > 0 || whole()) {
            meant.push(size);
        } else if size > 0.0 && number.coarsest_input().is_none() {
            others.push(size);
        }
    }
    let largest = |sizes: &[f64]| sizes.iter().copied().fold(0.0, f64::max);
    let most = largest(&meant).max(largest(&others));
    let likely = others.iter().filter(|size| **size >= ROUNDED * most);
    let least = meant
        .iter()
        .chain(likely)
        .copied()
        .fold(f64::INFINITY, f64::min);
    let spread = if most > least {
        (most.log2() - least.log2()).ceil() as usize
    } else {
        0
    };
    // Doubles hold less beside one another without loss.
    if spread > TALL {
        longest.max(spread)
    } else {
        longest
    }
}

/// [`height`], the values that a configuration gives the part's joints included: of joints that only begin at theirs, where the part
/// stands there. From elsewhere assembly has moved it, and what it began at says nothing about its numbers or its pose.
pub(super) fn height_at(pose: &Pose<'_>, part: &Part) -> usize {
    let own = height(pose.mechanism, part);
    let Some(configuration) = pose.configuration else {
        return own;
    };
    let drawn = |&joint: &usize| pose.states[joint].values == pose.geometry.states[joint].values;
    let stands = part.joints.iter().all(drawn);
    let counts = |joint: &JointId| {
        part.joints.contains(&joint.0) && (stands || !configuration.free.contains(joint))
    };
    let positions = configuration.positions.iter();
    positions
        .filter(|(joint, _)| counts(joint))
        .flat_map(|(_, values)| values.iter().map(Number::height))
        .fold(own, usize::max)
}

/// The rank of a part at a pose.
#[derive(Clone, Debug)]
pub struct PartRank {
    /// The decision that the answer rests on, about the Jacobian with unit columns.
    pub decision: RankDecision,
    /// Freedom when the numbers are taken literally, where that differs or is the only reading decided.
    pub as_written: Option<usize>,
    /// The instantaneous freedom, or `None` where even the last rung leaves it open.
    pub instantaneous: Option<usize>,
    /// Smallest and largest instantaneous freedom that remain possible within the stated precision.
    pub candidates: (usize, usize),
    /// How the numbers were read.
    pub reading: Reading,
    /// Relative uncertainty of the Jacobian in double precision, whatever its cause: that of everything computed from it.
    pub accuracy: f64,
    /// What speaks against the rank though its margins are clear; then [`Self::note`] says it.
    pub doubt: Option<Doubt>,
    /// Bits of the arithmetic that decided.
    pub bits: u32,
    /// Why the answer is not plain.
    pub note: Option<RankNote>,
    /// The Jacobian in double precision, columns of unit length, for everything that needs vectors.
    pub matrix: SparseMatrix<f64>,
    /// Norms by which the columns were divided.
    pub column_scales: Vec<f64>,
    /// The linearised equations the matrix was made from.
    pub jacobian: CycleJacobian<f64>,
    /// The kernel, once somebody asked for it.
    pub(crate) kernel: KnownKernel,
}

/// An orthonormal kernel basis with the nullity that it was computed at, found once.
#[derive(Clone, Debug, Default)]
pub(crate) struct KnownKernel(OnceLock<(usize, NullVectors<f64>)>);

impl PartRank {
    /// What the digits of its numbers leave open of the Jacobian (relative): see [`Reading::open`].
    #[must_use]
    pub fn open_by_digits(&self) -> f64 {
        self.reading.open()
    }

    /// Whether digits are stated and the numbers were nevertheless taken as written.
    #[must_use]
    pub fn is_taken_literally(&self) -> bool {
        self.reading == Reading::Literal
    }

    /// Number of unknowns.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        self.matrix.columns()
    }

    /// Number of equations.
    #[must_use]
    pub fn equations(&self) -> usize {
        self.matrix.rows()
    }

    /// Null vectors in double precision at the rank settled: a basis where it has at most `limit` vectors, else `limit` random ones by a
    /// seed. `None` where the rank is not settled, or doubles do not separate it. A basis, which no seed changes, is computed once.
    ///
    /// # Errors
    /// [`MatrixError`] where numbers overflow.
    pub(crate) fn null_vectors(
        &self,
        limit: usize,
        seed: u64,
    ) -> Result<Option<NullVectors<f64>>, MatrixError> {
        let Some(decision) = self.settled() else {
            return Ok(None);
        };
        let nullity = decision.nullity();
        if let Some((of, known)) = self.kernel.0.get()
            && nullity == Some(*of)
            && known.nullity <= limit
        {
            return Ok(Some(known.clone()));
        }
        let found = null_vectors_in_doubles(&self.matrix, &decision, limit, seed)?;
        if let (Some(found), Some(nullity)) = (&found, nullity)
            && found.complete
        {
            // Another thread may have been faster; it found the same.
            let _ = self.kernel.0.set((nullity, found.clone()));
        }
        Ok(found)
    }

    /// The decision with its rank set to the one the answer uses, for null vectors.
    #[must_use]
    pub fn settled(&self) -> Option<RankDecision> {
        let freedom = self.instantaneous?;
        // Margins of the double-precision matrix: its null vectors are computed in double precision.
        Some(RankDecision {
            accuracy: self.decision.accuracy.max(self.accuracy),
            ..self.decision.assuming(self.matrix.columns() - freedom)
        })
    }
}

/// How the numbers of a part were read where its rank was decided.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reading {
    /// They are exact: nothing is open but the rounding of what was computed from them.
    Exact,
    /// Within the digits that they state, which leave open this much of the Jacobian, relative to its unit columns.
    WithinDigits(f64),
    /// As written, though digits are stated: these are so coarse that they decide nothing, or others close no better.
    Literal,
}

impl Reading {
    /// Within digits that leave open so much (relative); exact where that is nothing.
    pub(crate) fn within(open: f64) -> Self {
        match open > 0.0 {
            true => Self::WithinDigits(open),
            false => Self::Exact,
        }
    }

    /// What the digits leave open of the Jacobian (relative): nothing of numbers that are exact or taken as written.
    #[must_use]
    pub fn open(self) -> f64 {
        match self {
            Self::WithinDigits(open) => open,
            Self::Exact | Self::Literal => 0.0,
        }
    }

    /// The same where only a share of what digits leave open counts.
    pub(crate) fn in_share(self, share: f64) -> Self {
        match self {
            Self::WithinDigits(open) => Self::within(share * open),
            other => other,
        }
    }
}

/// What speaks against a rank whose margins are clear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Doubt {
    /// It is another if the coordinates, though printed with the digits of doubles, are rounded: at this power of ten (m, rad)
    /// or more coarsely.
    Rounded(f64),
    /// A copy or mirror image of the part has another.
    Unlike,
}

/// What the ladder needs to evaluate a part again.
pub struct Pose<'a> {
    /// The mechanism.
    pub mechanism: &'a Mechanism,
    /// Its pose in the file.
    pub configuration: Option<&'a Configuration>,
    /// Joints that keep their configured values.
    pub held: &'a BTreeSet<usize>,
    /// Geometry in double precision.
    pub geometry: &'a Geometry<f64>,
    /// Assembled states.
    pub states: &'a [JointState<f64>],
    /// Whether assembly left the file pose untouched.
    pub as_drawn: bool,
    /// For what is tried on the states.
    pub trial: Trial,
}

/// A copy of the states of a pose on which parts are moved, made once for all of them.
#[derive(Default)]
pub struct Trial(Cell<Vec<JointState<f64>>>);

impl Pose<'_> {
    /// Calls `moved` with a copy of the states in which the joints of one part may be moved. They are put back after.
    pub(super) fn try_on<T>(
        &self,
        part: &Part,
        moved: impl FnOnce(&mut [JointState<f64>]) -> T,
    ) -> T {
        let mut states = self.trial.0.take();
        if states.is_empty() {
            states = self.states.to_vec();
        }
        let found = moved(&mut states);
        for &joint in &part.joints {
            states[joint] = self.states[joint].clone();
        }
        self.trial.0.set(states);
        found
    }
}

/// Decides the rank of one part. Parts that double precision leaves open are evaluated anew each time; see [`MoreDigits`]
/// for ranking many.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub fn rank_part(pose: &Pose<'_>, part: &Part) -> Result<PartRank, MatrixError> {
    rank_part_with(pose, &mut MoreDigits::new(), part, None)
}

/// The accuracy of a part's Jacobian: (stated precision, rounding), and whether the first is too coarse to be of use.
pub(super) fn known_to(jacobian: &CycleJacobian<f64>) -> (f64, f64, bool) {
    let (stated, rounding) = entry_accuracy(jacobian);
    (stated, rounding, stated > COARSEST_STATED)
}

/// [`rank_part`], sharing what is evaluated in many digits with other parts. `known` are the part's equations at the pose,
/// where somebody has evaluated them before.
pub(super) fn rank_part_with(
    pose: &Pose<'_>,
    more: &mut MoreDigits,
    part: &Part,
    known: Option<CycleJacobian<f64>>,
) -> Result<PartRank, MatrixError> {
    let double = match known {
        Some(known) => known,
        None => jacobian(pose.mechanism, pose.geometry, pose.states, part)?,
    };
    let mut readings = Readings::in_doubles(pose, part, double)?;
    readings.in_more_digits(more)?;
    readings.if_rounded_otherwise()?;
    readings.by_ratios(more)?;
    Ok(readings.concluded())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
