//! Poses along the motion through a pose: what stands for all of it.

use super::{Sample, Search};
use kutzbach_closure::JointState;
use kutzbach_math::matrix::MatrixError;

/// How far, and in how many steps, poses are looked for from home in each direction, in the metric of the home pose (a step is
/// about a sixth of a radian): at first, and then to see whether a solution closes elsewhere too. What does not closes at as many
/// poses as it was asked to, and then those poses are asked for as well.
pub(super) const SAMPLINGS: [Sampling; 4] = [
    Sampling {
        step: 0.25,
        of_one: 6,
        of_many: 2,
    },
    Sampling {
        step: 0.31,
        of_one: 10,
        of_many: 3,
    },
    Sampling {
        step: 0.23,
        of_one: 18,
        of_many: 4,
    },
    Sampling {
        step: 0.29,
        of_one: 20,
        of_many: 5,
    },
];

/// Poses along a motion.
pub(super) struct Sampling {
    step: f64,
    /// Steps of one freedom, and of several in each direction.
    of_one: usize,
    of_many: usize,
}

impl Search<'_> {
    /// Poses on the motion through the one given.
    pub(super) fn along_the_motion(
        &self,
        home: &[JointState<f64>],
        sampling: &Sampling,
    ) -> Result<Option<Vec<Sample>>, MatrixError> {
        let mut states = home.to_vec();
        let Some(here) = self.loops.settle(&self.geometry, &mut states, 1.0)? else {
            return Ok(None);
        };
        let freedom = here.tangents.len();
        let steps = if freedom == 1 {
            sampling.of_one
        } else {
            sampling.of_many
        };
        let mut samples = vec![Sample { states, here }];
        for direction in directions(freedom) {
            let first = &samples[0];
            let mut states = first.states.clone();
            let columns = first.here.tangents[0].len();
            let mut along = vec![0.0; columns];
            for (tangent, share) in first.here.tangents.iter().zip(&direction) {
                along
                    .iter_mut()
                    .zip(tangent)
                    .for_each(|(a, t)| *a += share * t);
            }
            for _ in 0..steps {
                let step: Vec<f64> = along.iter().map(|a| sampling.step * a).collect();
                self.loops.advance(&self.geometry, &mut states, &step);
                let Some(here) = self
                    .loops
                    .settle(&self.geometry, &mut states, sampling.step)?
                else {
                    break;
                };
                along = projected(&here.tangents, &along);
                samples.push(Sample {
                    states: states.clone(),
                    here,
                });
            }
        }
        Ok(Some(samples))
    }
}

/// Directions in which poses are looked for: both ways of one freedom; of several each alone, and their sums with signs.
fn directions(freedom: usize) -> Vec<Vec<f64>> {
    if freedom == 1 {
        return vec![vec![1.0], vec![-1.0]];
    }
    let share = 1.0 / (freedom as f64).sqrt();
    let alone = (0..freedom).map(|i| (0..freedom).map(|j| f64::from(i == j)).collect());
    let sums = (0..freedom + 2).map(|i| {
        (0..freedom)
            .map(|j| {
                // Signs of a fixed pattern without symmetry.
                let odd = (i * i + 3 * i * j + j * j * j + (i >> 1)) % 3 == 0;
                if odd { -share } else { share }
            })
            .collect()
    });
    alone.chain(sums).collect()
}

fn projected(tangents: &[Vec<f64>], along: &[f64]) -> Vec<f64> {
    let mut next = vec![0.0; along.len()];
    for tangent in tangents {
        let share: f64 = tangent.iter().zip(along).map(|(t, a)| t * a).sum();
        next.iter_mut()
            .zip(tangent)
            .for_each(|(n, t)| *n += share * t);
    }
    let length = next.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length > 0.0 {
        next.iter_mut().for_each(|x| *x /= length);
    }
    next
}
