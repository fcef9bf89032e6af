//! Where equations that contradict one another a little hold best.

use super::chart::REACH;
use super::krawczyk::inverted;
use super::tensor::Tensor;

/// Half the side, in parts of a chart, of the box on which values and slopes are read off.
const NEAR: f64 = 1.0 / 1024.0;

/// Steps at most. From an enclosure a few are enough.
const STEPS: usize = 40;

/// A step shorter than this is the last.
const SHORT: f64 = 1e-14;

/// A place of a chart where the sum of squares is least, from one nearby by Gauss and Newton, each equation in units of its `sizes`;
/// and the largest value that an equation has there, in these units. `None` where the way leads out of the chart.
pub(super) fn closest(tensors: &[Tensor], sizes: &[f64], from: &[f64]) -> Option<(Vec<f64>, f64)> {
    let mut at = from.to_vec();
    for _ in 0..STEPS {
        let (values, slopes) = linear(tensors, sizes, &at);
        let count = at.len();
        let product = |i: usize, j: usize| slopes.iter().map(|row| row[i] * row[j]).sum::<f64>();
        let normal = (0..count).map(|i| (0..count).map(|j| product(i, j)).collect());
        let inverse = inverted(normal.collect())?;
        let right: Vec<f64> = (0..count)
            .map(|i| slopes.iter().zip(&values).map(|(row, f)| row[i] * f).sum())
            .collect();
        let mut longest = 0.0_f64;
        for (x, row) in at.iter_mut().zip(&inverse) {
            let step: f64 = row.iter().zip(&right).map(|(a, b)| a * b).sum();
            *x -= step;
            longest = longest.max(step.abs());
        }
        // Beyond the chart another one describes the place better, and has it too.
        if !at.iter().all(|x| x.abs() <= 1.5 * REACH) {
            return None;
        }
        if longest < SHORT {
            break;
        }
    }
    let (values, _) = linear(tensors, sizes, &at);
    let worst = values.iter().fold(0.0, |m: f64, f| m.max(f.abs()));
    Some((at, worst))
}

/// Values and derivatives at a place.
fn linear(tensors: &[Tensor], sizes: &[f64], at: &[f64]) -> (Vec<f64>, Vec<Vec<f64>>) {
    let mut values = Vec::new();
    let mut slopes = Vec::new();
    for (tensor, size) in tensors.iter().zip(sizes) {
        let mut near = tensor.clone();
        for (variable, x) in at.iter().enumerate() {
            let part = (x + REACH) / (2.0 * REACH);
            near.restrict(variable, part - NEAR, part + NEAR);
        }
        let slope = |variable: usize| {
            let (low, high) = near.slope(variable);
            0.5 * (low + high) / (4.0 * NEAR * REACH) / size
        };
        values.push(near.middle().0 / size);
        slopes.push((0..at.len()).map(slope).collect());
    }
    (values, slopes)
}
