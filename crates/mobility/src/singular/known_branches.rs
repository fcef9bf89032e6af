//! Branches of germs whose equations say what they are, with points from which they are brought to the mechanism.

use crate::germ_zeros::{GermBranch, HalfBranch};
use kutzbach_math::matrix::{Real, Ring, SplitMix64};

/// Distances from the pose at which points of branches are brought to the mechanism, and points tried at each.
pub(super) const RADII: [f64; 4] = [0.1, 0.05, 0.02, 0.2];
pub(super) const POINTS: usize = 3;

/// A branch of so many dimensions that is no curve, with points of it.
pub(super) fn sheet(dimension: usize, points: Vec<Vec<f64>>) -> GermBranch {
    GermBranch {
        dimension,
        half_branches: Vec::new(),
        points,
        tangents: Vec::new(),
        ramification: None,
        reduced: true,
        vanishing_order: None,
        hits: 0,
    }
}

/// A smooth curve along a line; the equations vanish along it once where it is `reduced`.
pub(super) fn curve_along(line: &[f64], reduced: bool) -> GermBranch {
    let half_branches: Vec<HalfBranch> = [1.0, -1.0]
        .iter()
        .map(|side| {
            let tangent = scaled(line, *side);
            let path: Vec<Vec<f64>> = RADII.iter().map(|r| scaled(&tangent, *r)).collect();
            HalfBranch {
                point: path[0].clone(),
                tangent,
                path,
            }
        })
        .collect();
    GermBranch {
        tangents: half_branches.iter().map(|h| h.tangent.clone()).collect(),
        ramification: Some(1),
        reduced,
        half_branches,
        ..sheet(1, RADII.iter().map(|r| scaled(line, *r)).collect())
    }
}

/// Points in general position where Σ sizeᵢ xᵢ² = 0, with xᵢ the coordinate along the i-th vector, and the vectors of `null` added; none
/// where the form is definite.
pub(super) fn cone(sizes: &[f64], across: &[Vec<f64>], null: &[Vec<f64>]) -> Vec<Vec<f64>> {
    if sizes.iter().all(|size| *size > 0.0) || sizes.iter().all(|size| *size < 0.0) {
        return Vec::new();
    }
    let mut random = SplitMix64::named("quadratic cone");
    let mut points = Vec::with_capacity(RADII.len() * POINTS);
    for radius in RADII {
        for _ in 0..POINTS {
            // One vector in the space where the form is positive and one where it is negative, of opposite values.
            let mut sides = [vec![0.0; across[0].len()], vec![0.0; across[0].len()]];
            let mut values = [0.0f64; 2];
            for (value, vector) in sizes.iter().zip(across) {
                let side = usize::from(*value < 0.0);
                let share = random.symmetric() / value.abs().sqrt();
                values[side] += value.abs() * share * share;
                share.add_scaled(vector, &mut sides[side]);
            }
            let [plus, minus] = values.map(|value| value.sqrt().max(f64::MIN_POSITIVE));
            let mut point: Vec<f64> = sides[0]
                .iter()
                .zip(&sides[1])
                .map(|(a, b)| a / plus + b / minus)
                .collect();
            let length = 0.0.norm(&point);
            for vector in null {
                (length * random.symmetric()).add_scaled(vector, &mut point);
            }
            points.push(scaled(&point, radius));
        }
    }
    points
}

/// A vector brought to a length, with its sign.
pub(super) fn scaled(vector: &[f64], length: f64) -> Vec<f64> {
    let share = length / 0.0.norm(vector);
    vector.iter().map(|x| share * x).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_of_a_cone_lie_on_it() {
        let across = [
            [1.0, 1.0, 0.0, 0.0],
            [1.0, -1.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 0.0],
        ];
        let sizes = [2.0, -3.0, 0.5];
        let points = cone(
            &sizes,
            &across.map(|v| v.to_vec()),
            &[vec![0.0, 0.0, 0.0, 1.0]],
        );
        assert_eq!(points.len(), RADII.len() * POINTS);
        for (point, radius) in points.iter().zip(RADII.iter().flat_map(|r| [r; POINTS])) {
            assert!((0.0.norm(point) / radius - 1.0).abs() < 1e-12);
            let [x, y, z, w] = point[..] else {
                panic!("four coordinates")
            };
            let value = 2.0 * ((x + y) / 2.0).powi(2) - 3.0 * ((x - y) / 2.0).powi(2) + 0.5 * z * z;
            assert!(value.abs() < 1e-12 * radius * radius, "{value:e}");
            assert!(w != 0.0);
        }
    }

    #[test]
    fn a_definite_form_has_no_cone() {
        assert!(cone(&[1.0, 2.0], &[vec![1.0, 0.0], vec![0.0, 1.0]], &[]).is_empty());
        assert!(cone(&[], &[], &[vec![1.0]]).is_empty());
    }

    #[test]
    fn both_halves_of_a_curve_leave_along_its_line() {
        let branch = curve_along(&[0.0, 2.0], false);
        assert!(!branch.reduced && branch.ramification == Some(1));
        assert_eq!(branch.tangents, [vec![0.0, 1.0], vec![0.0, -1.0]]);
        assert_eq!(branch.half_branches[1].path[0], [0.0, -RADII[0]]);
    }
}
