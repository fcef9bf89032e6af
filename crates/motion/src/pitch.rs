//! The pitches of a link's motion along a curve, from small displacements.

use super::result::Motion;
use super::vectors::dot;
use kutzbach_closure::Rigid;

/// Steps of a branch at which pitches are looked at before the extremes are refined.
const LOOKED_AT: usize = 200;

/// Parabolas through three pitches around an extreme, at most, each narrower than the one before; no more where its sides are lower
/// by this part only.
const PARABOLAS: usize = 12;
const NARROWER: f64 = 3.0;
const FLAT: f64 = 1e-6;

/// Halvings of a step in which the axis turns by more than 60 degrees: where it is left at the end, the motion turns back.
const HALVINGS: usize = 12;

/// Half the distance of the two poses that a pitch is taken between, in steps looked at: a secant's error goes with its
/// square, its rounding with its inverse.
const SECANT: f64 = 1e-3;

/// A link that turns this much slower than at its fastest rests nearby.
const RESTS: f64 = 1e-3;

/// One that rests and slides still, this much slower than at its fastest or less, has a pitch that goes to infinity. One that stands
/// still altogether, as at a dead centre, slides as little as it turns.
const SLIDES: f64 = 0.03;

impl Motion {
    /// Least and greatest pitch (m/rad) of a link's motion seen from another along the whole curve, links by index; `None` where the
    /// pitch goes to infinity, as where a link slides while it does not turn, or a pose is missing.
    pub fn pitches(&mut self, link: usize, seen_from: usize) -> Option<[f64; 2]> {
        extremes(self, [link, seen_from])
    }
}

fn extremes(motion: &mut Motion, links: [usize; 2]) -> Option<[f64; 2]> {
    let (first, last) = motion.curve.arclengths();
    let step = (last - first) / LOOKED_AT as f64;
    let seen = sharpened(motion, links, steps(motion, links)?)?;
    let greatest = |part: fn(&SmallScrew) -> f64| {
        let parts = seen.iter().map(|(_, screw)| part(screw).abs());
        parts.fold(0.0f64, f64::max)
    };
    let (fastest, farthest) = (greatest(|s| s.angle), greatest(SmallScrew::along));
    let (resting, seen): (Vec<_>, Vec<_>) =
        seen.iter().partition(|(_, s)| s.angle <= RESTS * fastest);
    if resting
        .iter()
        .any(|(_, s)| s.along().abs() > SLIDES * farthest)
    {
        return None;
    }
    let mut refined = |sign: f64| {
        let higher = |a: &SmallScrew, b: &SmallScrew| (sign * a.pitch).total_cmp(&(sign * b.pitch));
        let (best, _) = seen.iter().max_by(|a, b| higher(&a.1, &b.1))?;
        let mut pitch = |at: f64| Some(sign * screw(motion, at, links, step)?.pitch);
        let highest = highest(&mut pitch, *best, step)?;
        Some(sign * highest)
    };
    Some([refined(-1.0)?, refined(1.0)?])
}

/// The screws from each predicted pose to the next, by arclength: near the extremes, whose place they tell.
fn steps(motion: &Motion, links: [usize; 2]) -> Option<Vec<(f64, SmallScrew)>> {
    let (first, last) = motion.curve.arclengths();
    let step = (last - first) / LOOKED_AT as f64;
    let relative = |index: usize| {
        let arclength = (first + step * index as f64).min(last);
        let pose = motion.curve.predicted_at(arclength)?;
        Some(seen_from(&motion.curve.link_poses(&pose), links))
    };
    let poses: Vec<Rigid<f64>> = (0..=LOOKED_AT).map(relative).collect::<Option<_>>()?;
    let between = |(index, two): (usize, &[Rigid<f64>])| {
        let middle = first + step * (index as f64 + 0.5);
        (middle, small_screw(&two[1].compose(&two[0].inverse())))
    };
    Some(poses.windows(2).enumerate().map(between).collect())
}

/// More screws where the axis turns much from one to the next: where a link nearly rests, its pitch has a narrow extreme.
fn sharpened(
    motion: &mut Motion,
    links: [usize; 2],
    seen: Vec<(f64, SmallScrew)>,
) -> Option<Vec<(f64, SmallScrew)>> {
    let turns = |a: &SmallScrew, b: &SmallScrew| {
        2.0 * dot(&a.axis, &b.axis) < (dot(&a.axis, &a.axis) * dot(&b.axis, &b.axis)).sqrt()
    };
    let mut sharpened = Vec::with_capacity(seen.len());
    for next in seen {
        let mut waiting = vec![(next, 0)];
        while let Some((next, halvings)) = waiting.pop() {
            let last: Option<&(f64, SmallScrew)> = sharpened.last();
            let turned = last.filter(|last| halvings < HALVINGS && turns(&last.1, &next.1));
            let Some(&(before, _)) = turned else {
                sharpened.push(next);
                continue;
            };
            let gap = next.0 - before;
            let between = before + 0.5 * gap;
            let mut screw = screw(motion, between, links, gap)?;
            // As fast as it would be over a whole step.
            let (first, last) = motion.curve.arclengths();
            screw.angle *= (last - first) / LOOKED_AT as f64 / (2.0 * SECANT * gap);
            waiting.push((next, halvings + 1));
            waiting.push(((between, screw), halvings + 1));
        }
    }
    Some(sharpened)
}

/// The highest value around a place, by parabolas that become narrower.
fn highest(value: &mut impl FnMut(f64) -> Option<f64>, at: f64, width: f64) -> Option<f64> {
    let (mut at, mut width) = (at, width);
    let mut most = value(at)?;
    for _ in 0..PARABOLAS {
        let (centre, before) = (at, most);
        let sides = [value(centre - width)?, value(centre + width)?];
        let bend = sides[0] - 2.0 * before + sides[1];
        let vertex = 0.5 * width * (sides[0] - sides[1]) / bend;
        let mut tried = vec![(centre - width, sides[0]), (centre + width, sides[1])];
        if bend < 0.0 && vertex.abs() < width {
            tried.push((centre + vertex, value(centre + vertex)?));
        }
        for (place, found) in tried {
            if found > most {
                (at, most) = (place, found);
            }
        }
        if before - sides[0].min(sides[1]) <= FLAT * most.abs() {
            break;
        }
        width /= NARROWER;
    }
    Some(most)
}

/// A small displacement as a screw.
#[derive(Clone, Copy, Debug)]
struct SmallScrew {
    /// Of any length.
    axis: [f64; 3],
    /// rad
    angle: f64,
    /// m/rad
    pitch: f64,
}

/// The screw between two poses on both sides of an arclength, of the first link seen from the second.
fn screw(motion: &mut Motion, arclength: f64, links: [usize; 2], step: f64) -> Option<SmallScrew> {
    let (first, last) = motion.curve.arclengths();
    let half = SECANT * step;
    let middle = arclength.clamp(first + half, last - half);
    let mut relative = |arclength: f64| {
        let found = motion.curve.pose_at_arclength(arclength)?;
        Some(seen_from(&motion.curve.link_poses(&found.pose), links))
    };
    let [before, after] = [relative(middle - half)?, relative(middle + half)?];
    Some(small_screw(&after.compose(&before.inverse())))
}

/// Angle and pitch of a small displacement.
fn small_screw(displacement: &Rigid<f64>) -> SmallScrew {
    let r = &displacement.rotation;
    let axis = [r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]];
    let sine = dot(&axis, &axis).sqrt() / 2.0;
    let angle = sine.atan2((r[0][0] + r[1][1] + r[2][2] - 1.0) / 2.0);
    let along = dot(&axis, &displacement.translation) / (2.0 * sine);
    SmallScrew {
        axis,
        angle,
        pitch: along / angle,
    }
}

impl SmallScrew {
    /// The way along the axis (m).
    fn along(&self) -> f64 {
        self.angle * self.pitch
    }
}

/// The pose of the first link seen from the second.
fn seen_from(poses: &[Rigid<f64>], links: [usize; 2]) -> Rigid<f64> {
    poses[links[1]].inverse().compose(&poses[links[0]])
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn narrow_and_broad_peaks_are_climbed() {
        for (width, peak) in [(1.0, 0.3), (1e-3, 0.01), (0.05, -0.4)] {
            // 1 / (1 + x²), as a pitch is near a pose of least rotation.
            let mut value = |x: f64| Some(1.0 / (1.0 + ((x - peak) / width).powi(2)));
            let found = highest(&mut value, 0.0, 0.5).unwrap();
            assert!((found - 1.0).abs() < 1e-6, "{width} {peak}: {found}");
        }
    }

    #[test]
    fn the_end_of_a_range_may_be_the_highest() {
        // As `screw` does it: beyond the end is the end.
        let found = highest(&mut |x: f64| Some(x.min(0.7)), 0.5, 0.5).unwrap();
        assert!((found - 0.7).abs() < 1e-12, "{found}");
    }
}
