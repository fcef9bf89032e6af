//! A look at axes that spares decompositions: do some screws clearly generate all of se(3)?

use kutzbach_math::group::{Gauge, Twist};
use nalgebra::Vector6;

/// How many times its error a number must exceed to be told from zero without a decomposition.
pub const SAFE: f64 = 100.0;

/// What is known of the screws added so far, in a gauge.
///
/// Two turns about directions that differ generate rotations about all directions, and the only subalgebras with all of
/// them are those of the rotations about a point and se(3) itself (Hervé 1978). So unless there are no translations and all
/// axes meet without pitch, they generate se(3). Numbers within [`SAFE`] times their accuracy decide nothing.
pub struct Axes<'g> {
    gauge: &'g Gauge,
    visible: f64,
    first: Option<Vector6<f64>>,
    parallel: bool,
    slides: bool,
    skew: bool,
}

impl<'g> Axes<'g> {
    /// No screws yet.
    pub fn new(gauge: &'g Gauge) -> Self {
        Self {
            gauge,
            visible: SAFE * gauge.tolerance().max(1e-12),
            first: None,
            parallel: true,
            slides: false,
            skew: false,
        }
    }

    /// Adds a screw of unit direction.
    pub fn add(&mut self, twist: &Twist) {
        let own = self.gauge.measure(twist);
        let (turn, moment) = (own.fixed_rows::<3>(0), own.fixed_rows::<3>(3));
        let size = own.norm();
        if turn.norm() < 0.5 {
            self.slides = true;
            return;
        }
        self.skew |= turn.dot(&moment).abs() > self.visible * size * size;
        let Some(other) = self.first else {
            self.first = Some(own);
            return;
        };
        let (turn2, moment2) = (other.fixed_rows::<3>(0), other.fixed_rows::<3>(3));
        self.parallel &= turn.cross(&turn2).norm() <= self.visible;
        let meeting = turn.dot(&moment2) + turn2.dot(&moment);
        self.skew |= meeting.abs() > self.visible * size * other.norm();
    }

    /// Whether the screws clearly generate se(3). False says nothing.
    pub fn generate_everything(&self) -> bool {
        !self.parallel && (self.slides || self.skew)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use kutzbach_math::group::Subalgebra;
    use kutzbach_math::matrix::SplitMix64;
    use nalgebra::Vector3;

    #[test]
    fn what_clearly_generates_everything_does() {
        // Axes through a point, parallel ones and any others, with and without pitch and slides: never a claim that the
        // algebra itself does not bear out, and a claim wherever nothing special was drawn.
        let mut random = SplitMix64::new(7);
        let gauge = Gauge::new(Vector3::zeros(), 1.0, 1e-9).unwrap();
        let mut claims = [0; 8];
        for round in 0..400 {
            let (meeting, level, sliding) = (round & 1 > 0, round & 2 > 0, round & 4 > 0);
            let mut draw =
                || Vector3::new(random.symmetric(), random.symmetric(), random.symmetric());
            let point = draw();
            let direction = draw().normalize();
            let mut twists: Vec<Twist> = (0..3)
                .map(|_| {
                    let own = draw().normalize();
                    let at = draw();
                    Twist::revolute(
                        if level { direction } else { own },
                        if meeting { point } else { at },
                    )
                })
                .collect();
            if sliding {
                twists.push(Twist::prismatic(draw().normalize()));
            }
            let mut axes = Axes::new(&gauge);
            twists.iter().for_each(|twist| axes.add(twist));
            let claim = axes.generate_everything();
            let algebra = Subalgebra::generated_by(&twists, &gauge).unwrap();
            assert!(!claim || algebra.dimension() == 6, "{round}");
            claims[round & 7] += usize::from(claim);
        }
        // Through a point, without slides, or parallel: never. Otherwise always.
        assert_eq!(claims, [50, 0, 0, 0, 50, 50, 0, 0]);
    }
}
