//! The equations for the dimensions at some poses, by difference quotients.

use super::super::dimensions::turns;
use super::{Sample, Search};
use faer::Mat;
use kutzbach_closure::{JointNumbers, WalkedCycle};
use kutzbach_math::matrix::MatrixError;

/// Difference quotients of the fourth order are taken over this (rad, part lengths): what they leave out, and rounding, are both below
/// 1e-12 of the derivative.
const QUOTIENT: f64 = 3e-4;

/// Places and weights of these quotients.
const STENCIL: [(f64, f64); 4] = [
    (1.0, 8.0 / 12.0),
    (-1.0, -8.0 / 12.0),
    (2.0, -1.0 / 12.0),
    (-2.0, 1.0 / 12.0),
];

impl Search<'_> {
    /// The equations for the dimensions: their derivative, and what is left of them.
    pub(super) fn equations(
        &mut self,
        samples: &mut [Sample],
        z: &[f64],
    ) -> Result<(Mat<f64>, Vec<f64>), MatrixError> {
        let misfit = self.left(samples);
        let of_loops: usize = samples.iter().map(|s| s.here.misfit.len()).sum();
        let mut matrix = Mat::<f64>::zeros(misfit.len(), z.len());
        let dimensions = self.dimensions;
        let cycles = self.loops.part.cycles.clone();
        for (column, dimension) in dimensions.all.iter().enumerate() {
            let numbers = dimensions.numbers(dimension.joint, z);
            let step = match turns(dimension.place) {
                true => QUOTIENT,
                false => QUOTIENT * self.length,
            };
            let concerned: Vec<usize> = (0..cycles.len())
                .filter(|&c| cycles[c].iter().any(|(joint, _)| *joint == dimension.joint))
                .collect();
            let mut row = 0;
            let mut ends: Vec<Vec<[f64; 6]>> = Vec::new();
            for (place, weight) in STENCIL {
                let mut moved = numbers.clone();
                moved.0[dimension.place] += place * step;
                let mut values = Vec::new();
                for sample in samples.iter_mut() {
                    let kept = sample.states[dimension.joint].clone();
                    let displacement = self.geometry.displacements[dimension.joint].clone();
                    let sides = self.geometry.sides[dimension.joint].clone();
                    dimensions.set(
                        &mut self.geometry,
                        dimension.joint,
                        &moved,
                        [&mut sample.states[dimension.joint]],
                    );
                    for &cycle in &concerned {
                        let walk =
                            WalkedCycle::walk(&self.geometry, &sample.states, &cycles[cycle]);
                        values.push(walk.residual());
                    }
                    sample.states[dimension.joint] = kept;
                    self.geometry.displacements[dimension.joint] = displacement;
                    self.geometry.sides[dimension.joint] = sides;
                }
                ends.push(values);
                for (row, value) in self.related_rows(dimension.joint, &moved) {
                    matrix[(of_loops + row, column)] += weight * value / step * dimension.unit;
                }
            }
            let mut next = 0;
            for sample in samples.iter() {
                let here: Vec<(usize, [f64; 6])> = concerned
                    .iter()
                    .map(|&cycle| {
                        let slope = |i: usize| {
                            let all = STENCIL.iter().zip(&ends);
                            let sum: f64 =
                                all.map(|((_, weight), end)| weight * end[next][i]).sum();
                            sum / step * dimension.unit
                        };
                        let slopes = std::array::from_fn(slope);
                        next += 1;
                        (cycle, slopes)
                    })
                    .collect();
                for left in &sample.here.left {
                    matrix[(row, column)] = here
                        .iter()
                        .map(|(cycle, slope)| {
                            (0..6).map(|i| left[6 * cycle + i] * slope[i]).sum::<f64>()
                        })
                        .sum();
                    row += 1;
                }
            }
        }
        Ok((matrix, misfit))
    }

    /// The relations' rows that a joint changes, with other numbers of it.
    fn related_rows(&mut self, joint: usize, numbers: &JointNumbers) -> Vec<(usize, f64)> {
        if self.relations.is_empty() {
            return Vec::new();
        }
        let displacement = self.geometry.displacements[joint].clone();
        let sides = self.geometry.sides[joint].clone();
        self.dimensions.set(&mut self.geometry, joint, numbers, []);
        let rows = self.relations.rows_of(joint, &self.geometry, self.length);
        self.geometry.displacements[joint] = displacement;
        self.geometry.sides[joint] = sides;
        rows
    }
}
