//! Following a zero towards the origin, and what its residuals say on the way.

use super::correct::{Landing, Within, contract, land};
use super::deflate::land_firmly;
use super::small::{dot, length, plus, project, singular, unit};
use super::system::{Level, System, Work};

/// A zero followed through all radii, outermost first.
#[derive(Clone, Debug)]
pub(super) struct Track {
    /// Unit direction at each radius.
    pub(super) z: Vec<Vec<f64>>,
    /// `None`: the equations vanish along it as far as noise allows. Otherwise the order with which they vanish, more
    /// than the truncation degree.
    pub(super) order: Option<f64>,
}

/// dz/d(ln r) of the curve of zeros through radius·z that climbs fastest: the radial direction projected onto the kernel
/// of the Jacobian, rescaled to climb at unit rate.
fn slope(level: &Level<'_>, z: &[f64], rank: usize, work: &mut Work) -> Option<Vec<f64>> {
    level.evaluate(z, work);
    let (_, vectors) = singular(&work.jacobian, z.len());
    let climb = project(z, &vectors[rank..]);
    let size = dot(&climb, &climb);
    // A curve that climbs at less than 6 degrees here is about to turn back: no germ of the origin at this radius.
    (size > 1e-2).then(|| plus(&climb.iter().map(|x| x / size).collect::<Vec<_>>(), -1.0, z))
}

/// Follows a zero from one radius to another; `rank` is the rank of the Jacobian along the way where the zero set is a
/// reduced manifold of dimension δ − rank, otherwise `None`.
///
/// With a rank: classical Runge–Kutta on the tangent, then Gauss–Newton that must contract at once, so that a neighbour
/// at a small distance is not mistaken for the branch; the step is halved otherwise. Without one the corrector converges
/// linearly and cannot tell neighbours apart; small steps with a secant predictor are all there is.
pub(super) fn follow(
    system: &System,
    start: &[f64],
    from: f64,
    to: f64,
    rank: Option<usize>,
    work: &mut Work,
) -> Option<Landing> {
    if (to / from).ln().abs() < 1e-12 {
        let level = Level::new(system, to);
        return Some(land(&level, start, &Within::Sphere, 20, work));
    }
    match rank {
        Some(rank) => follow_regular(system, start, from, to, rank, work),
        None => follow_multiple(system, start, from, to, work),
    }
}

fn follow_regular(
    system: &System,
    start: &[f64],
    from: f64,
    to: f64,
    rank: usize,
    work: &mut Work,
) -> Option<Landing> {
    let (mut at, end) = (0.0, (to / from).ln());
    let mut stride = end;
    let mut z = start.to_vec();
    let mut landing = None;
    for _ in 0..200 {
        if (end - at).abs() < 1e-12 {
            return landing;
        }
        if (end - at).abs() < stride.abs() {
            stride = end - at;
        }
        let level = |t: f64| Level::new(system, from * t.exp());
        let predicted = (|| {
            let middle = level(at + 0.5 * stride);
            let k1 = slope(&level(at), &z, rank, work)?;
            let k2 = slope(&middle, &unit(plus(&z, 0.5 * stride, &k1)), rank, work)?;
            let k3 = slope(&middle, &unit(plus(&z, 0.5 * stride, &k2)), rank, work)?;
            let last = level(at + stride);
            let k4 = slope(&last, &unit(plus(&z, stride, &k3)), rank, work)?;
            let mut next = z.clone();
            for (k, weight) in [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)] {
                next = plus(&next, weight * stride / 6.0, &k);
            }
            let landed = contract(&last, &unit(next), rank, 0.02, work)?;
            (landed.above_truncation <= 1.0).then_some(landed)
        })();
        match predicted {
            Some(landed) => {
                z.clone_from(&landed.z);
                at += stride;
                stride *= 2.0;
                landing = Some(landed);
            }
            // Steps of less than a thousandth of the radius mean that no branch is followed.
            None if stride.abs() < 1e-3 => return None,
            None => stride *= 0.5,
        }
    }
    None
}

fn follow_multiple(
    system: &System,
    start: &[f64],
    from: f64,
    to: f64,
    work: &mut Work,
) -> Option<Landing> {
    const STEPS: usize = 3;
    let ratio = (to / from).powf(1.0 / STEPS as f64);
    let mut before: Option<(f64, Vec<f64>)> = None;
    let mut here = (from, start.to_vec());
    let mut landing = None;
    for _ in 0..STEPS {
        let radius = here.0 * ratio;
        let guess = match &before {
            None => here.1.clone(),
            Some((r, z)) => {
                let rate = (radius - here.0) / (here.0 - r);
                unit(plus(&here.1, rate, &plus(&here.1, -1.0, z)))
            }
        };
        let level = Level::new(system, radius);
        let landed = land_firmly(&level, &guess, work);
        if landed.above_truncation > 1.0 || length(&plus(&landed.z, -1.0, &here.1)) > 0.5 {
            return None;
        }
        before = Some(std::mem::replace(&mut here, (radius, landed.z.clone())));
        landing = Some(landed);
    }
    landing
}

/// Follows a zero at the outermost radius through all the others. `None` where it does not lead to the origin, or where
/// the equations turn out to have a definite order there that the truncation could not have cut off.
pub(super) fn inwards(
    system: &System,
    radii: &[f64],
    start: &Landing,
    rank: Option<usize>,
    work: &mut Work,
) -> Option<Track> {
    let mut z = vec![start.z.clone()];
    let mut residuals = vec![(
        start.above_noise,
        residual(system, radii[0], &start.z, work),
    )];
    for step in radii.windows(2) {
        let from = z.last()?.clone();
        let landed = follow(system, &from, step[0], step[1], rank, work)?;
        residuals.push((
            landed.above_noise,
            residual(system, step[1], &landed.z, work),
        ));
        z.push(landed.z);
    }
    let order = vanishing_order(radii, &residuals, system.degree())?;
    Some(Track { z, order })
}

fn residual(system: &System, radius: f64, z: &[f64], work: &mut Work) -> f64 {
    let level = Level::new(system, radius);
    level.evaluate(z, work);
    level.absolute(&work.values)
}

/// `Some(None)` where all residuals are noise, `Some(Some(order))` where they fall faster than any kept degree,
/// `None` where they have an order that the kept degrees decide.
pub(super) fn vanishing_order(
    radii: &[f64],
    residuals: &[(f64, f64)],
    degree: usize,
) -> Option<Option<f64>> {
    if residuals.iter().all(|(above_noise, _)| *above_noise <= 1.0) {
        return Some(None);
    }
    let points: Vec<(f64, f64)> = radii
        .iter()
        .zip(residuals)
        .filter(|(_, (above_noise, size))| *above_noise > 1.0 && *size > 0.0)
        .map(|(r, (_, size))| (r.ln(), size.ln()))
        .collect();
    if points.len() < 2 {
        // Above the noise at a single radius, the outermost: less than what can be fitted.
        return Some(None);
    }
    let order = fitted_slope(&points);
    // Residuals of kept terms have order at most `degree`, those of the terms cut off at least one more.
    (order >= degree as f64 + 0.5).then_some(Some(order))
}

/// Slope of the least-squares line.
pub(super) fn fitted_slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let (x, y) = points
        .iter()
        .fold((0.0, 0.0), |(x, y), p| (x + p.0 / n, y + p.1 / n));
    let covariance: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    let variance: f64 = points.iter().map(|p| (p.0 - x) * (p.0 - x)).sum();
    covariance / variance
}
