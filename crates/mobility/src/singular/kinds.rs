//! Kinds of singular poses.

use super::resolution::Resolution;
use crate::germ_zeros::GermBranch;
use crate::lifting::Lifted;
use crate::vocabulary::SingularKind;

/// Branches whose directions differ by less than the first (rad) may share a tangent, from the second on they do not, as far
/// as [`Resolution`] allows to tell. Directions are known to some 1e-5.
const SAME_DIRECTION: [f64; 2] = [1e-4, 3e-3];

/// D7, from the branches through the pose.
pub(super) fn kind_of(
    lifted: &[Lifted],
    zeros: &[GermBranch],
    resolution: &Resolution,
) -> Option<SingularKind> {
    let first = lifted.first()?;
    if lifted
        .iter()
        .any(|l| l.branch.dimension != first.branch.dimension)
    {
        return Some(SingularKind::Kinematotropic);
    }
    if lifted.len() == 1 {
        if first.shaky {
            return Some(SingularKind::PermanentlyShaky);
        }
        let halves = &zeros.first()?.half_branches;
        return match halves.as_slice() {
            [a, b] if angle(&a.tangent, &b.tangent) < 0.1 => Some(SingularKind::Cusp),
            _ => None,
        };
    }
    let line = |branch: &GermBranch| branch.half_branches.first().map(|h| h.tangent.clone());
    let lines: Option<Vec<Vec<f64>>> = zeros.iter().map(line).collect();
    let Some(lines) = lines else {
        return Some(SingularKind::Bifurcation);
    };
    // Which way a branch is run through does not matter.
    let widest = lines
        .iter()
        .map(|line| {
            let angle = angle(line, &lines[0]);
            angle.min(std::f64::consts::PI - angle)
        })
        .fold(0.0, f64::max);
    let unresolved = resolution.unresolved(lines.len());
    if widest < SAME_DIRECTION[0] && resolution.least > unresolved.max(SAME_DIRECTION[0]) {
        Some(SingularKind::Tangential)
    } else if widest > unresolved.max(SAME_DIRECTION[1]) {
        Some(SingularKind::Bifurcation)
    } else {
        None
    }
}

/// The angle between two unit vectors (rad), small ones without loss of digits.
fn angle(a: &[f64], b: &[f64]) -> f64 {
    let half: f64 = a.iter().zip(b).map(|(x, y)| (x - y).powi(2)).sum();
    2.0 * (0.5 * half.sqrt()).min(1.0).asin()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::claim::PartBranch;
    use crate::germ_zeros::HalfBranch;

    /// A lifted branch, and the germ's own with half-branches along these directions.
    fn branch(dimension: usize, shaky: bool, halves: &[[f64; 2]]) -> (Lifted, GermBranch) {
        let half = |tangent: &[f64; 2]| HalfBranch {
            point: tangent.to_vec(),
            tangent: tangent.to_vec(),
            path: vec![tangent.to_vec()],
        };
        let lifted = Lifted {
            branch: PartBranch {
                dimension,
                half_branches: None,
                poses: Vec::new(),
            },
            shaky,
        };
        let germ = GermBranch {
            dimension,
            half_branches: halves.iter().map(half).collect(),
            points: Vec::new(),
            tangents: Vec::new(),
            ramification: None,
            reduced: true,
            vanishing_order: None,
            hits: 1,
        };
        (lifted, germ)
    }

    /// Numbers of few digits at a pose known to rounding.
    const SHARP: Resolution = Resolution {
        noise: 1e-14,
        least: 1.0,
    };

    #[test]
    fn kinds_follow_from_dimensions_and_tangents() {
        let right = [1.0, 0.0];
        let left = [-1.0, 0.0];
        let up = [0.0, 1.0];
        let down = [0.0, -1.0];
        let kind = |branches: Vec<(Lifted, GermBranch)>| {
            let (lifted, zeros): (Vec<_>, Vec<_>) = branches.into_iter().unzip();
            kind_of(&lifted, &zeros, &SHARP)
        };
        let through = |a, b| branch(1, false, &[a, b]);
        assert_eq!(kind(vec![]), None);
        // A smooth branch, whose pose is singular for another reason.
        assert_eq!(kind(vec![through(right, left)]), None);
        assert_eq!(kind(vec![through(right, right)]), Some(SingularKind::Cusp));
        assert_eq!(
            kind(vec![branch(1, true, &[right, left])]),
            Some(SingularKind::PermanentlyShaky)
        );
        let crossing = vec![through(right, left), through(up, down)];
        assert_eq!(kind(crossing), Some(SingularKind::Bifurcation));
        // The same line, whichever way each is run through.
        let touching = vec![through(right, left), through(left, right)];
        assert_eq!(kind(touching), Some(SingularKind::Tangential));
        let mixed = vec![branch(2, false, &[]), through(up, down)];
        assert_eq!(kind(mixed), Some(SingularKind::Kinematotropic));
        // Surfaces have no half-branches to compare.
        let surfaces = vec![branch(2, false, &[]), branch(2, false, &[])];
        assert_eq!(kind(surfaces), Some(SingularKind::Bifurcation));
    }

    #[test]
    fn an_angle_that_cannot_be_resolved_gives_no_kind() {
        let crossing = |angle: f64, resolution: &Resolution| {
            let (sine, cosine) = angle.sin_cos();
            let lines = [[1.0, 0.0], [cosine, sine]];
            let through = lines.map(|line| branch(1, false, &[line, line.map(|x| -x)]));
            let (lifted, zeros): (Vec<_>, Vec<_>) = through.into_iter().unzip();
            kind_of(&lifted, &zeros, resolution)
        };
        for (angle, kind) in [
            (0.0, Some(SingularKind::Tangential)),
            (5e-5, Some(SingularKind::Tangential)),
            (1e-3, None),
            (5e-3, Some(SingularKind::Bifurcation)),
        ] {
            assert_eq!(crossing(angle, &SHARP), kind, "{angle}");
        }
        // Numbers of 34 bits can put two branches so close.
        let tall = Resolution {
            least: 0.5f64.powi(34),
            ..SHARP
        };
        // An error of 1e-5 opens a double line by 6e-3, and numbers of 8 bits can have meant as much.
        let coarse = Resolution {
            noise: 1e-5,
            least: 0.5f64.powi(8),
        };
        for (angle, resolution, kind) in [
            (0.0, &tall, None),
            (5e-5, &tall, None),
            (5e-3, &tall, Some(SingularKind::Bifurcation)),
            (0.0, &coarse, None),
            (5e-3, &coarse, None),
            (1e-2, &coarse, Some(SingularKind::Bifurcation)),
        ] {
            assert_eq!(crossing(angle, resolution), kind, "{angle} {resolution:?}");
        }
        let whole = Resolution {
            noise: 1e-5,
            ..SHARP
        };
        assert_eq!(crossing(0.0, &whole), Some(SingularKind::Tangential));
    }
}
