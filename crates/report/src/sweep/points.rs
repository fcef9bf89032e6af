//! Points that fill a unit cube: a Sobol sequence, and pseudo-random ones. Each is found from its number alone, so that
//! shards need not know one another.

use kutzbach_math::matrix::SplitMix64;

/// Most coordinates that the Sobol sequence is tabulated for.
pub const SOBOL_DIMENSIONS: usize = 8;

/// Coordinates are whole multiples of one part in so many: values of measures are then short decimals.
pub const PARTS: u64 = 1_000_000;

/// Bits of a coordinate of a Sobol point.
const BITS: usize = 32;

/// The first numbers of the pseudo-random sequence depend on it, and on nothing else.
const SEED: u64 = 57;

/// What SplitMix64 adds to its state at every step.
const STEP: u64 = 0x9e37_79b9_7f4a_7c15;

/// Degree and coefficients of a primitive polynomial, and the first direction numbers, for the second coordinate and the next ones:
/// Joe and Kuo 2008, *Constructing Sobol sequences with better two-dimensional projections*, SIAM J. Sci. Comput. 30, 2635–2654, the
/// first rows of their table `new-joe-kuo-6`.
const DIRECTIONS: [(usize, u32, &[u32]); SOBOL_DIMENSIONS - 1] = [
    (1, 0, &[1]),
    (2, 1, &[1, 3]),
    (3, 1, &[1, 3, 1]),
    (3, 2, &[1, 1, 1]),
    (4, 1, &[1, 1, 3, 3]),
    (4, 4, &[1, 3, 5, 13]),
    (5, 2, &[1, 1, 5, 5, 17]),
];

/// A Sobol sequence, its direction numbers made once.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sobol {
    /// For each coordinate the number that each bit of a Gray code contributes.
    directions: Vec<[u32; BITS]>,
}

impl Sobol {
    /// The sequence in so many dimensions; `None` where there are more than [`SOBOL_DIMENSIONS`].
    #[must_use]
    pub fn new(dimensions: usize) -> Option<Self> {
        if dimensions > SOBOL_DIMENSIONS {
            return None;
        }
        // The first coordinate is the binary van der Corput sequence.
        let first = std::array::from_fn(|bit| 1_u32 << (BITS - 1 - bit));
        let others = DIRECTIONS
            .iter()
            .map(|(degree, coefficients, start)| directions(*degree, *coefficients, start));
        let directions = std::iter::once(first)
            .chain(others)
            .take(dimensions)
            .collect();
        Some(Self { directions })
    }

    /// A point of the sequence, counted from 0, in parts of 2³²; the 2³²nd is the first again.
    #[must_use]
    pub fn point(&self, index: u64) -> Vec<u32> {
        let gray = index ^ (index >> 1);
        let coordinate = |directions: &[u32; BITS]| {
            directions
                .iter()
                .enumerate()
                .filter(|(bit, _)| (gray >> bit) & 1 == 1)
                .fold(0_u32, |sum, (_, direction)| sum ^ direction)
        };
        self.directions.iter().map(coordinate).collect()
    }

    /// A point of the sequence in parts of `PARTS`, rounded down.
    #[must_use]
    pub fn parts(&self, index: u64) -> Vec<u64> {
        let point = self.point(index);
        point
            .into_iter()
            .map(|x| (u64::from(x) * PARTS) >> BITS)
            .collect()
    }
}

/// All direction numbers of a coordinate, by the recurrence of its polynomial.
fn directions(degree: usize, coefficients: u32, start: &[u32]) -> [u32; BITS] {
    let mut all = [0_u32; BITS];
    for bit in 0..BITS {
        all[bit] = match start.get(bit) {
            Some(number) => number << (BITS - 1 - bit),
            None => {
                let before = all[bit - degree];
                let mut sum = before ^ (before >> degree);
                for k in 1..degree {
                    if (coefficients >> (degree - 1 - k)) & 1 == 1 {
                        sum ^= all[bit - k];
                    }
                }
                sum
            }
        };
    }
    all
}

/// A pseudo-random point, counted from 0, in parts of `PARTS`: one long sequence of numbers, cut into points.
#[must_use]
pub fn random_parts(index: u64, dimensions: usize) -> Vec<u64> {
    let before = index.wrapping_mul(dimensions as u64);
    let mut random = SplitMix64::new(SEED.wrapping_add(STEP.wrapping_mul(before)));
    let mut part = || {
        let scaled = u128::from(random.next_u64()) * u128::from(PARTS);
        (scaled >> 64) as u64
    };
    (0..dimensions).map(|_| part()).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// The first points as the authors of the direction numbers list them.
    #[test]
    fn the_first_points_are_the_published_ones() {
        let sobol = Sobol::new(3).unwrap();
        let points: Vec<Vec<f64>> = (0..8)
            .map(|n| {
                let point = sobol.point(n);
                point
                    .into_iter()
                    .map(|x| f64::from(x) / 2_f64.powi(32))
                    .collect()
            })
            .collect();
        assert_eq!(
            points,
            [
                [0.0, 0.0, 0.0],
                [0.5, 0.5, 0.5],
                [0.75, 0.25, 0.25],
                [0.25, 0.75, 0.75],
                [0.375, 0.375, 0.625],
                [0.875, 0.875, 0.125],
                [0.625, 0.125, 0.875],
                [0.125, 0.625, 0.375],
            ]
        );
        assert_eq!(sobol.parts(4), [375_000, 375_000, 625_000]);
        assert!(Sobol::new(9).is_none());
    }

    /// Of the first 2ⁿ points every coordinate has one in each of 2ⁿ equal intervals.
    #[test]
    fn every_coordinate_is_spread_evenly() {
        let sobol = Sobol::new(SOBOL_DIMENSIONS).unwrap();
        for dimension in 0..SOBOL_DIMENSIONS {
            let seen: BTreeSet<u32> = (0..256).map(|n| sobol.point(n)[dimension] >> 24).collect();
            assert_eq!(seen.len(), 256, "{dimension}");
        }
    }

    #[test]
    fn random_points_are_one_sequence() {
        let flat: Vec<u64> = (0..6).flat_map(|n| random_parts(n, 2)).collect();
        let whole: Vec<u64> = (0..12).flat_map(|n| random_parts(n, 1)).collect();
        assert_eq!(flat, whole);
        assert!(flat.iter().all(|part| *part < PARTS));
        let mean = (0..10_000).map(|n| random_parts(n, 1)[0]).sum::<u64>() / 10_000;
        assert!(mean.abs_diff(PARTS / 2) < PARTS / 50, "{mean}");
    }
}
