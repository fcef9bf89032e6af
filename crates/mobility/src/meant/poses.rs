//! Poses along a motion that loops make which do not quite close: of a part whose numbers are rounded.
//!
//! With the rank `r` that the equations would have if the part moved with `f` freedoms, the least `n − r` singular values are
//! those that rounding made. A pose stands on the motion where the equations hold in the `r` directions that the other values
//! belong to. What is left of them in the other directions, the left kernel, no step of the joints can mend: it is what the
//! dimensions have to.

use faer::Mat;
use kutzbach_closure::{Geometry, JointState, Metric, Part, Section, linearised, rounding_of};
use kutzbach_math::matrix::MatrixError;
use kutzbach_model::mechanism::Mechanism;

/// Newton steps onto the motion.
const STEPS: usize = 12;

/// A kept singular value has to be so many times the greatest that counts as rounding: below, the motion comes so near a
/// singular pose that which is which is not clear.
const APART: f64 = 4.0;

/// A way onto the motion that is shorter than this (in the metric) has arrived.
const ARRIVED: f64 = 1e-14;

/// What rounding of the residual leaves of a step is no longer than this.
const FARTHEST_ROUNDED: f64 = 1e-9;

/// A part at fixed dimensions, in the metric of its home pose.
pub(super) struct Loops<'a> {
    pub mechanism: &'a Mechanism,
    pub part: &'a Part,
    pub metric: &'a Metric,
    /// How many freedoms it is to have.
    pub freedom: usize,
}

/// The equations at a pose on the motion.
pub(super) struct OnMotion {
    /// Orthonormal tangents.
    pub tangents: Vec<Vec<f64>>,
    /// The left kernel, one vector for each row that joints cannot mend.
    pub left: Vec<Vec<f64>>,
    /// What is left of the equations along each of them.
    pub misfit: Vec<f64>,
    /// The largest equation.
    pub open: f64,
}

impl Loops<'_> {
    fn section<'b>(&'b self, geometry: &'b Geometry<f64>) -> Section<'b, f64> {
        Section {
            mechanism: self.mechanism,
            geometry,
            part: self.part,
            metric: self.metric,
        }
    }

    /// Moves a pose by a step in the metric.
    pub fn advance(&self, geometry: &Geometry<f64>, states: &mut [JointState<f64>], step: &[f64]) {
        self.section(geometry).advance_by(states, step);
    }

    /// Brings a pose onto the motion. `None` where the rank is not clear on the way, or the way does not end.
    ///
    /// # Errors
    /// [`MatrixError`] where numbers overflow.
    pub fn settle(
        &self,
        geometry: &Geometry<f64>,
        states: &mut [JointState<f64>],
        farthest: f64,
    ) -> Result<Option<OnMotion>, MatrixError> {
        let mut way = 0.0;
        for round in 0..STEPS {
            let here = linearised(geometry, states, self.part)?;
            let (rows, columns) = (here.matrix.rows(), here.matrix.columns());
            let Some(rank) = columns.checked_sub(self.freedom).filter(|r| *r <= rows) else {
                return Ok(None);
            };
            let mut dense = Mat::<f64>::zeros(rows, columns);
            for (row, column, entry) in here.matrix.triplets() {
                let unit = here.unit(self.mechanism, column);
                dense[(row, column)] += entry / (unit * self.metric.weights[column]);
            }
            let Ok(svd) = dense.svd() else {
                return Ok(None);
            };
            let (u, s, v) = (svd.U(), svd.S().column_vector(), svd.V());
            let next = if rank < s.nrows() { s[rank] } else { 0.0 };
            if rank > 0 && !(s[rank - 1] > APART * next && s[rank - 1] > 0.0) {
                return Ok(None);
            }
            let along = |j: usize| -> f64 { (0..rows).map(|i| u[(i, j)] * here.residual[i]).sum() };
            let mut step = vec![0.0; columns];
            for j in 0..rank {
                let length = -along(j) / s[j];
                for (i, x) in step.iter_mut().enumerate() {
                    *x += length * v[(i, j)];
                }
            }
            let length = step.iter().map(|x| x * x).sum::<f64>().sqrt();
            // Rounding of the residual, which is larger far from the origin, as far as the equations enlarge it.
            let least = if rank > 0 { s[rank - 1] / s[0] } else { 1.0 };
            let rounding = rounding_of(&here.walks, f64::EPSILON);
            let rounded = (rounding / least).clamp(1e3 * ARRIVED, FARTHEST_ROUNDED);
            if length <= ARRIVED || round + 1 == STEPS && length <= rounded {
                return Ok(Some(OnMotion {
                    tangents: (rank..columns)
                        .map(|j| (0..columns).map(|i| v[(i, j)]).collect())
                        .collect(),
                    left: (rank..rows)
                        .map(|j| (0..rows).map(|i| u[(i, j)]).collect())
                        .collect(),
                    misfit: (rank..rows).map(along).collect(),
                    open: here.residual.iter().fold(0.0, |most, r| r.abs().max(most)),
                }));
            }
            way += length;
            if !(way <= farthest) {
                return Ok(None);
            }
            self.advance(geometry, states, &step);
        }
        Ok(None)
    }
}
