//! The derivative of the cycle equations: joint screws stacked cycle by cycle.

use super::cycle::WalkedCycle;
use super::displacement::JointState;
use super::equations::Equations;
use super::geometry::{Geometry, Uncertainty};
use kutzbach_math::matrix::{MatrixError, Real, SparseMatrix};
use kutzbach_model::mechanism::{FreedomPart, Mechanism};

/// A part of a mechanism whose equations stand alone: some joints, the cycles through them, the couplings between them.
#[derive(Clone, Debug, Default)]
pub struct Part {
    /// Joints in the order of their columns, each once.
    pub joints: Vec<usize>,
    /// Independent cycles.
    pub cycles: Vec<Vec<(usize, bool)>>,
    /// Couplings between these joints.
    pub couplings: Vec<usize>,
}

/// The linearised equations of a part.
///
/// Rows: six per cycle (three angular, three linear about the cycle's centre, in units of the cycle's length), then one
/// per coupling. Columns: the variables of the joints in order; a translation counts in units of [`length`](Self::length).
/// Row operations do not change the kernel, so every cycle may have its own centre and length.
#[derive(Clone, Debug)]
pub struct CycleJacobian<R> {
    /// The matrix, its columns not normalised.
    pub matrix: SparseMatrix<R>,
    /// (joint, index of the variable in the joint) of every column.
    pub variables: Vec<(usize, usize)>,
    /// The residual of every row.
    pub residual: Vec<R>,
    /// The part's length (m): RMS of its cycles' lengths.
    pub length: f64,
    /// The walks the rows come from.
    pub walks: Vec<WalkedCycle<R>>,
    /// What the digits of couplings leave open of their rows, all together.
    pub coupling_digits: f64,
    /// What couplings have beyond first order (`CouplingRow::higher`), row by row.
    pub coupling_higher: Vec<Vec<(usize, Vec<R>)>>,
}

impl<R: Real> CycleJacobian<R> {
    /// Radians or metres per unit of a column.
    pub fn unit(&self, mechanism: &Mechanism, column: usize) -> f64 {
        let (joint, variable) = self.variables[column];
        variable_unit(
            mechanism.joints()[joint].kind.freedoms()[variable],
            self.length,
        )
    }
}

/// Radians, or metres, per unit of a variable where translations count in units of a length (m).
pub fn variable_unit(part: FreedomPart, length: f64) -> f64 {
    match part {
        FreedomPart::Translation => length,
        FreedomPart::Rotation | FreedomPart::Screw => 1.0,
    }
}

/// Builds the linearised equations of a part at given joint states. Joints that a cycle passes outside the part have no
/// columns: they stand still.
///
/// # Errors
/// [`MatrixError::Length`] where geometry or states belong to another mechanism; [`MatrixError::NotFinite`] where
/// coordinates leave the range of numbers.
pub fn jacobian<R: Real>(
    mechanism: &Mechanism,
    geometry: &Geometry<R>,
    states: &[JointState<R>],
    part: &Part,
) -> Result<CycleJacobian<R>, MatrixError> {
    Equations::at(mechanism, geometry, states, part)?.linearised(geometry, part)
}

/// The value of every equation of a part at given joint states, as in [`CycleJacobian::residual`]: without their derivative, for half of
/// the work.
///
/// # Errors
/// As [`jacobian`], but for screws.
pub fn residual<R: Real>(
    mechanism: &Mechanism,
    geometry: &Geometry<R>,
    states: &[JointState<R>],
    part: &Part,
) -> Result<Vec<R>, MatrixError> {
    Ok(Equations::at(mechanism, geometry, states, part)?.residual)
}

/// [`jacobian`] of a geometry that may differ from any mechanism's, as where a joint is relaxed to see what that would do.
pub fn linearised<R: Real>(
    geometry: &Geometry<R>,
    states: &[JointState<R>],
    part: &Part,
) -> Result<CycleJacobian<R>, MatrixError> {
    Equations::evaluated(geometry, states, part)?.linearised(geometry, part)
}

impl<R: Real> Equations<R> {
    /// With their derivative; of the geometry and the part that they were evaluated for.
    ///
    /// # Errors
    /// [`MatrixError::NotFinite`] where a screw leaves the range of numbers.
    pub fn linearised(
        self,
        geometry: &Geometry<R>,
        part: &Part,
    ) -> Result<CycleJacobian<R>, MatrixError> {
        let one = &geometry.one;
        let freedoms = |joint: usize| geometry.displacements[joint].kind().freedoms();
        let mut first_columns = Vec::with_capacity(part.joints.len());
        let mut variables = Vec::new();
        for &joint in &part.joints {
            first_columns.push((joint, variables.len()));
            variables.extend((0..freedoms(joint).len()).map(|variable| (joint, variable)));
        }
        first_columns.sort_unstable();
        let first_column = |joint: usize| {
            let at = first_columns.binary_search_by_key(&joint, |own| own.0);
            Some(first_columns.get(at.ok()?)?.1)
        };
        let entries: usize = self.walks.iter().map(|w| 6 * w.screw_count()).sum();
        let mut triplets = Vec::with_capacity(entries);
        for (index, walk) in self.walks.iter().enumerate() {
            let mut columns = Vec::with_capacity(walk.screw_count());
            for joint in &walk.joints {
                let Some(first) = first_column(joint.joint) else {
                    continue;
                };
                for (variable, screw) in joint.screws.iter().enumerate() {
                    let part = freedoms(joint.joint)[variable];
                    let mut column = walk.column(joint, screw);
                    if part == FreedomPart::Translation {
                        let unit = one.constant(variable_unit(part, self.length));
                        column = column.map(|entry| entry * unit.clone());
                    }
                    columns.push((first + variable, column.into_iter()));
                }
            }
            // Row by row and in order, as the matrix keeps them, they need no sorting there.
            columns.sort_by_key(|(column, _)| *column);
            for row in 0..6 {
                for (column, entries) in &mut columns {
                    triplets.extend(
                        entries
                            .next()
                            .map(|entry| (6 * index + row, *column, entry)),
                    );
                }
            }
        }
        let of_cycles = 6 * self.walks.len();
        let digits = part.couplings.iter().map(|&c| geometry.coupling_digits[c]);
        let digits: Vec<f64> = digits.collect();
        let mut coupling_higher = Vec::with_capacity(self.coupling_rows.len());
        for (index, row) in (of_cycles..).zip(self.coupling_rows) {
            coupling_higher.push(row.higher);
            for (joint, weight) in row.weights {
                if let Some(first) = first_column(joint) {
                    triplets.push((index, first, weight));
                }
            }
        }
        let block_starts = (0..of_cycles)
            .step_by(6)
            .chain(of_cycles..self.residual.len())
            .collect();
        let shape = (self.residual.len(), variables.len());
        let matrix = SparseMatrix::from_triplets(shape.0, shape.1, one.zero_like(), triplets)?
            .with_row_blocks(block_starts)?;
        matrix.largest_entry()?;
        Ok(CycleJacobian {
            matrix,
            variables,
            residual: self.residual,
            length: self.length,
            walks: self.walks,
            coupling_digits: 0.0.norm(&digits),
            coupling_higher,
        })
    }
}

/// How far the entries of a part's Jacobian may be from those of the mechanism meant, relative to unit columns, in the
/// spectral norm: (by the file's stated precision, by rounding in the arithmetic).
///
/// A cycle's entries depend on the frames passed before them. To first order, an uncertainty `u` of a position moves
/// every screw of the cycle by up to `u` (relative: `u / L`); one of a direction or an angle turns every screw by as much
/// and moves it by up to that angle times the cycle's extent. Errors of different numbers are independent and uniform in
/// ±u: their root sum of squares is 1.7 standard deviations of the total, and twice that is used. A cycle of `n` columns
/// is then off by at most `√n` times as much. Rounding in the arithmetic is bounded the same way, with `u` = unit roundoff
/// times the largest coordinate met, summed, since it is not random.
pub fn entry_accuracy<R: Real>(jacobian: &CycleJacobian<R>) -> (f64, f64) {
    let walks = jacobian.walks.iter();
    let stated = walks
        .map(|walk| stated_by(walk, &walk.uncertainty))
        .fold(0.0, f64::max);
    // Digits of ratios are seen to first order as they are.
    let stated = stated.max(2.0 * jacobian.coupling_digits);
    let roundoff = jacobian.matrix.zero().unit_roundoff();
    (stated, rounding_of(&jacobian.walks, roundoff))
}

/// The share of one cycle's numbers in [`entry_accuracy`], if they are known to within this together.
pub fn stated_by<R: Real>(walk: &WalkedCycle<R>, uncertainty: &Uncertainty) -> f64 {
    stated_over(walk, uncertainty, walk.screw_count())
}

/// The same over so many columns.
fn stated_over<R: Real>(walk: &WalkedCycle<R>, uncertainty: &Uncertainty, columns: usize) -> f64 {
    let Uncertainty { lengths, angles } = uncertainty;
    let places = lengths / walk.length;
    let tilts = angles * (walk.extent / walk.length).hypot(1.0);
    2.0 * (columns as f64).sqrt() * places.hypot(tilts)
}

/// The share of the arithmetic in [`entry_accuracy`].
pub fn rounding_of<R: Real>(walks: &[WalkedCycle<R>], roundoff: f64) -> f64 {
    let of_walks = walks
        .iter()
        .map(|walk| rounding_over(walk, roundoff, walk.screw_count()));
    // Couplings: their factors are exact or rounded like any number; one rounding each.
    of_walks.fold(4.0 * roundoff, f64::max)
}

/// The share of the arithmetic in one cycle, over so many columns.
fn rounding_over<R: Real>(walk: &WalkedCycle<R>, roundoff: f64, columns: usize) -> f64 {
    let spread = (2.0 * columns as f64).sqrt();
    // Each joint composes three displacements; a dozen roundings of coordinates up to the reach, in units of length.
    let steps = 12.0 * walk.joints.len() as f64;
    spread * steps * roundoff * (1.0 + walk.reach / walk.length)
}

/// What is left open of whether a cycle of fixed joints closes (rad, cycle lengths): by its numbers as they are stated, and by rounding. It has no
/// entries, so that [`entry_accuracy`] says nothing of it, and nothing in it can make up for what its numbers leave. Zero where something moves.
pub fn accuracy_of_fixed<R: Real>(walk: &WalkedCycle<R>, roundoff: f64) -> (f64, f64) {
    match walk.screw_count() {
        0 => (
            stated_over(walk, &walk.uncertainty, 1),
            rounding_over(walk, roundoff, 1),
        ),
        _ => (0.0, 0.0),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::geometry::Arithmetic;
    use super::super::samples::{
        CRANK_ROCKER, Place, Written, four_bar, planar, ring, sarrus_places,
    };
    use super::*;
    use kutzbach_math::matrix::decide;
    use kutzbach_math::number::Number;
    use kutzbach_model::mechanism::{JointKind, MechanismBuilder};

    fn whole(mechanism: &Mechanism) -> Part {
        let joints: Vec<usize> = (0..mechanism.joints().len()).collect();
        Part {
            cycles: vec![joints.iter().map(|j| (*j, true)).collect()],
            couplings: (0..mechanism.couplings().len()).collect(),
            joints,
        }
    }

    /// A loop of joints of many kinds, none of which stands at zero.
    fn mixed() -> Mechanism {
        let places: Vec<Place> = vec![
            (JointKind::Revolute, [0.0, 0.0, 0.0], [0.0, 0.5, 1.0]),
            (JointKind::Spherical, [1.0, 0.5, 0.0], [1.0, 0.0, 0.0]),
            (JointKind::Cylindrical, [2.0, 0.0, 0.5], [1.0, 0.25, 0.0]),
            (JointKind::Screw, [2.0, -1.0, 0.0], [0.0, 1.0, 1.0]),
            (JointKind::Universal, [1.0, -2.0, 0.0], [0.5, 1.0, 0.0]),
        ];
        ring(&places, [0.0; 3], Written::Exactly)
    }

    #[test]
    fn columns_are_the_derivative_of_the_residual() {
        // In many digits a difference quotient has the derivative's digits; the loop stays closed to first order only, so
        // the twist of the closure is compared, not the matrix's own residual away from it.
        let mechanism = mixed();
        let part = whole(&mechanism);
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::bits(212));
        let here = jacobian(&mechanism, &geometry, &geometry.states, &part).unwrap();
        assert!(
            here.residual.iter().all(|r| r.to_f64().abs() < 1e-60),
            "closed as drawn"
        );
        let step = geometry.one.constant(1e-25);
        for (column, &(joint, variable)) in here.variables.iter().enumerate() {
            let mut states = geometry.states.clone();
            let mut increments =
                vec![geometry.one.constant(0.0); geometry.displacements[joint].freedom()];
            increments[variable] =
                step.clone() * geometry.one.constant(here.unit(&mechanism, column));
            geometry.displacements[joint].advance(&mut states[joint], &increments);
            // The centre and length of the walk are those of the closed pose to double precision.
            let there = jacobian(&mechanism, &geometry, &states, &part).unwrap();
            for row in 0..6 {
                let entry = here
                    .matrix
                    .row(row)
                    .iter()
                    .find(|(c, _)| *c == column)
                    .map_or(0.0, |(_, entry)| entry.to_f64());
                let quotient = (there.residual[row].clone() / step.clone()).to_f64();
                assert!(
                    (entry - quotient).abs() < 1e-12,
                    "{row} {column}: {entry} {quotient}"
                );
            }
        }
    }

    #[test]
    fn the_matrix_knows_no_unit() {
        let at = |unit: f64| {
            let places: Vec<Place> = sarrus_places()
                .into_iter()
                .map(|(kind, at, along)| (kind, at.map(|x| x * unit), along))
                .chain([(JointKind::Prismatic, [0.5 * unit; 3], [1.0, 0.25, 0.0])])
                .collect();
            let mechanism = ring(&places, [0.0; 3], Written::Exactly);
            let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
            jacobian(&mechanism, &geometry, &geometry.states, &whole(&mechanism)).unwrap()
        };
        let reference = at(1.0);
        for unit in [1e-9, 1e-6, 1e6, 1e99] {
            let scaled = at(unit);
            assert!(
                (scaled.length / unit / reference.length - 1.0).abs() < 1e-12,
                "{unit:e}"
            );
            for (a, b) in reference.matrix.triplets().zip(scaled.matrix.triplets()) {
                assert_eq!((a.0, a.1), (b.0, b.1));
                assert!((a.2 - b.2).abs() < 1e-9, "{unit:e}");
            }
        }
    }

    fn geared(ratio: f64) -> Mechanism {
        let mut builder = MechanismBuilder::new("geared");
        builder.link("ground");
        super::super::samples::add_ring(
            &mut builder,
            "r",
            "ground",
            &planar(&CRANK_ROCKER),
            [0.0; 3],
            Written::Exactly,
        );
        let number = |x: f64| Number::from_f64(x).unwrap();
        builder.mimic("r_b", "r_a", number(ratio), number(0.5));
        builder.build().unwrap()
    }

    #[test]
    fn couplings_are_rows_of_unit_length() {
        for ratio in [2.0, 1e3, 1e-200, 0.0, 1e99] {
            let mechanism = geared(ratio);
            let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
            let found =
                jacobian(&mechanism, &geometry, &geometry.states, &whole(&mechanism)).unwrap();
            assert_eq!(found.matrix.rows(), 7);
            let row: Vec<f64> = found.matrix.row(6).iter().map(|(_, x)| *x).collect();
            assert!((0.0.norm(&row) - 1.0).abs() < 1e-15, "{ratio:e}");
            // All angles are zero, so what is missing is the offset, in the row's own unit.
            let expected = -0.5 / 1f64.hypot(ratio);
            assert!((found.residual[6] / expected - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn parts_of_another_mechanism_are_refused() {
        let geometry = Geometry::new(&four_bar(), None, &Arithmetic::double());
        let part = whole(&four_bar());
        assert!(jacobian(&mixed(), &geometry, &geometry.states, &part).is_err());
        assert!(jacobian(&four_bar(), &geometry, &geometry.states[1..], &part).is_err());
    }

    #[test]
    fn joints_outside_the_part_stand_still() {
        let mechanism = four_bar();
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
        let mut part = whole(&mechanism);
        part.joints = vec![3, 1];
        let found = jacobian(&mechanism, &geometry, &geometry.states, &part).unwrap();
        assert_eq!(found.variables, [(3, 0), (1, 0)]);
        assert_eq!(found.matrix.columns(), 2);
    }

    #[test]
    fn what_is_too_small_for_a_mechanism_is_no_length() {
        let places: Vec<Place> = planar(&CRANK_ROCKER)
            .into_iter()
            .map(|(kind, at, along)| (kind, at.map(|x| x * 1e-310), along))
            .collect();
        let mechanism = ring(&places[..3], [0.0; 3], Written::Exactly);
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
        let found = jacobian(&mechanism, &geometry, &geometry.states, &whole(&mechanism)).unwrap();
        assert!((found.length - 1.0).abs() < 1e-12);
    }

    #[test]
    fn accuracy_follows_digits_reach_and_arithmetic() {
        let of = |written, shift: f64| {
            let places: Vec<Place> = planar(&[[0.0, 0.0], [0.125, 2.0], [4.0, 5.0], [4.0, 0.0]])
                .into_iter()
                .map(|(kind, [x, y, z], along)| (kind, [x + shift, y, z], along))
                .collect();
            let mechanism = ring(&places, [0.0; 3], written);
            let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
            let found =
                jacobian(&mechanism, &geometry, &geometry.states, &whole(&mechanism)).unwrap();
            entry_accuracy(&found)
        };
        let (none, rounding) = of(Written::Exactly, 0.0);
        assert_eq!(none, 0.0);
        assert!(rounding > 1e-16 && rounding < 1e-12);
        let (six, _) = of(Written::Decimals(6), 0.0);
        let (nine, _) = of(Written::Decimals(9), 0.0);
        assert!((six / nine / 1e3 - 1.0).abs() < 1e-6);
        assert!(six > 1e-6 && six < 1e-4);
        let (_, far) = of(Written::Exactly, 1e4);
        assert!(
            far > 1e3 * rounding,
            "far from its own frames a loop loses digits"
        );
    }

    #[test]
    fn perturbations_within_the_stated_digits_stay_within_the_accuracy() {
        // Every number moved to a random place within half a unit of its last digit: what singular values change by is
        // what `entry_accuracy` allows for, and not a tiny fraction of it.
        use kutzbach_math::matrix::SplitMix64;
        let mut random = SplitMix64::new(3);
        let matrix = |off: &mut dyn FnMut() -> f64| {
            let places: Vec<Place> = sarrus_places()
                .into_iter()
                .map(|(kind, at, along)| (kind, at.map(|x| x + off()), along.map(|x| x + off())))
                .collect();
            let mechanism = ring(&places, [0.0; 3], Written::Exactly);
            let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
            let mut matrix = jacobian(&mechanism, &geometry, &geometry.states, &whole(&mechanism))
                .unwrap()
                .matrix;
            matrix.scale_columns();
            matrix
        };
        let rounded = ring(&sarrus_places(), [0.0; 3], Written::Decimals(5));
        let geometry = Geometry::new(&rounded, None, &Arithmetic::double());
        let found = jacobian(&rounded, &geometry, &geometry.states, &whole(&rounded)).unwrap();
        let (stated, _) = entry_accuracy(&found);
        let mut worst = 0.0f64;
        for _ in 0..100 {
            let decision = decide(&matrix(&mut || 0.5e-5 * random.symmetric()), stated).unwrap();
            worst = worst.max(decision.dropped);
            assert_eq!(decision.rank, Some(5), "{decision:?}");
        }
        assert!(
            worst < stated && worst > stated / 100.0,
            "{worst:e} {stated:e}"
        );
    }
}
