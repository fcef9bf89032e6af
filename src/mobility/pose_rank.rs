//! The instantaneous freedom of a part at a pose: a rank, with its margin, in as many digits as it takes.
//!
//! Three readings of the same numbers:
//!
//! 1. *Within the stated precision.* Entries are uncertain by what the file's decimals leave open; singular values below
//!    that are zeros that were rounded. This is the answer wherever a clear gap separates them from the rest.
//! 2. *As written.* The numbers taken literally, uncertain by rounding only. It differs from the first for a mechanism
//!    whose special geometry was rounded, and then both are reported.
//! 3. Where double precision leaves the first or the second open, the geometry is evaluated again from the file's own
//!    digits with 106, 212 and more bits: true zeros fall with the arithmetic, small values stay.

use crate::closure::{
    Arithmetic, CycleJacobian, Geometry, JointState, Part, entry_accuracy, jacobian, refine,
};
use crate::matrix::{Big, MatrixError, RankDecision, SparseMatrix, decide};
use crate::mechanism::{Configuration, Mechanism};
use std::collections::BTreeSet;

/// The bits tried in turn after double precision.
pub const LADDER: [u32; 4] = [106, 212, 424, 848];

/// A stated precision that makes the Jacobian uncertain by more than this separates nothing: a kept singular value would
/// have to be ten times as large. The numbers are then taken literally, which the report says.
const COARSEST_STATED: f64 = 0.05;

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
    /// Whether the stated precision was too coarse to be used, so that the numbers were taken literally.
    pub taken_literally: bool,
    /// Relative uncertainty of the Jacobian by the file's stated precision; zero where the numbers are exact.
    pub stated: f64,
    /// Bits of the arithmetic that decided.
    pub bits: u32,
    /// Why the answer is not plain, in one sentence.
    pub note: Option<String>,
    /// The Jacobian in double precision, columns of unit length, for everything that needs vectors.
    pub matrix: SparseMatrix<f64>,
    /// Norms by which the columns were divided.
    pub column_scales: Vec<f64>,
    /// The linearised equations the matrix was made from.
    pub jacobian: CycleJacobian<f64>,
}

impl PartRank {
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

    /// The decision with its rank set to the one the answer uses, for null vectors.
    #[must_use]
    pub fn settled(&self) -> Option<RankDecision> {
        let freedom = self.instantaneous?;
        // Margins of the double-precision matrix: its null vectors are computed in double precision.
        Some(RankDecision {
            accuracy: self.decision.accuracy.max(f64::EPSILON),
            ..self.decision.assuming(self.matrix.columns() - freedom)
        })
    }
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
}

/// Decides the rank of one part.
///
/// # Errors
/// [`MatrixError`] where numbers overflow.
pub fn rank_part(pose: &Pose<'_>, part: &Part) -> Result<PartRank, MatrixError> {
    let double = jacobian(pose.mechanism, pose.geometry, pose.states, part)?;
    let (stated, rounding) = entry_accuracy(pose.mechanism, &double);
    // Numbers so coarse that they would leave every rank open were chosen, not rounded.
    let coarse = stated > COARSEST_STATED;
    let stated = if coarse { 0.0 } else { stated };
    let mut matrix = double.matrix.clone();
    let column_scales = matrix.scale_columns();
    let columns = matrix.columns();
    let mut bits = 53;
    let mut nominal = decide(&matrix, stated + rounding)?;
    let mut written = if stated > rounding {
        decide(&matrix, rounding)?
    } else {
        nominal.clone()
    };
    // A rank of the numbers as written is worth more digits only where stated precision does not already answer.
    let mut rung = 0;
    while nominal.rank.is_none() && written.rank.is_none() && rung < LADDER.len() {
        bits = LADDER[rung];
        rung += 1;
        let (matrix, accuracy) = matrix_in_bits(pose, part, bits)?;
        written = decide(&matrix, accuracy)?;
        nominal = if stated > accuracy {
            decide(&matrix, stated + accuracy)?
        } else {
            written.clone()
        };
    }
    let freedom = |rank: usize| columns - rank;
    let candidates = (freedom(nominal.candidates.1), freedom(nominal.candidates.0));
    let literal = written.rank.map(freedom);
    let (instantaneous, decision, note) = match (nominal.rank.map(freedom), literal) {
        (Some(answer), Some(literal)) if literal != answer => {
            let note = format!(
                "taken literally, the numbers leave {literal} instead of {answer}: the smallest singular values, up to \
                 {:.1e} of the largest, are below what the stated precision leaves open ({:.1e})",
                nominal.dropped, nominal.tolerance
            );
            (Some(answer), nominal, Some(note))
        }
        (Some(answer), _) => (Some(answer), nominal, None),
        (None, Some(literal)) => {
            let note = format!(
                "the numbers taken literally leave {literal}; within their stated precision anything from {} to {} is \
                 possible (smallest singular value {:.1e} of the largest, uncertainty {:.1e}): more digits would decide",
                candidates.0, candidates.1, written.kept, nominal.tolerance
            );
            (Some(literal), written, Some(note))
        }
        (None, None) => {
            let note = format!(
                "undecided between {} and {}: singular values {:.1e} and {:.1e} of the largest are not separated from \
                 the uncertainty {:.1e}, with {} bits",
                candidates.0,
                candidates.1,
                nominal.kept,
                nominal.dropped,
                nominal.tolerance,
                nominal.bits
            );
            (None, nominal, Some(note))
        }
    };
    Ok(PartRank {
        as_written: literal,
        instantaneous,
        candidates,
        taken_literally: coarse,
        stated,
        bits,
        note,
        matrix,
        column_scales,
        jacobian: double,
        decision,
    })
}

/// The part's Jacobian with unit columns from geometry evaluated in more bits, at states polished in those bits.
fn matrix_in_bits(
    pose: &Pose<'_>,
    part: &Part,
    bits: u32,
) -> Result<(SparseMatrix<Big>, f64), MatrixError> {
    let geometry = Geometry::new(pose.mechanism, pose.configuration, &Arithmetic::bits(bits));
    let mut states = geometry.states.clone();
    if !pose.as_drawn {
        for (index, state) in states.iter_mut().enumerate() {
            *state = geometry.displacements[index].adopt(&pose.states[index]);
        }
    }
    let residual = refine(pose.mechanism, &geometry, &mut states, part, pose.held)?;
    let there = jacobian(pose.mechanism, &geometry, &states, part)?;
    let (_, rounding) = entry_accuracy(pose.mechanism, &there);
    let mut matrix = there.matrix;
    matrix.scale_columns();
    // A pose that misses closing by `residual` has screws off by as much.
    Ok((matrix, rounding + residual))
}
