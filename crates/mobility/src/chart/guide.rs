//! Poses closed in double precision, from which closing in more digits starts.

use kutzbach_closure::{Closing, JointState, Section};
use kutzbach_math::matrix::{MatrixError, Real};
use std::collections::BTreeMap;

/// Steps of closing in double precision, at most.
const STEPS: usize = 40;

/// In more digits each step wins three at least, of the 255 there are at most.
const FINE_STEPS: usize = 100;

/// Closes a part in double precision away from a pose, and remembers where that led: whoever then asks with more digits
/// needs the same poses again.
pub(super) struct Guide<'a> {
    section: Section<'a, f64>,
    base: &'a [JointState<f64>],
    held: &'a [Vec<f64>],
    /// By way and radius: the way from the pose to the closed one.
    led: BTreeMap<(usize, u64), Vec<f64>>,
}

impl<'a> Guide<'a> {
    /// `held`: directions along which closing does not move.
    pub fn new(
        section: Section<'a, f64>,
        base: &'a [JointState<f64>],
        held: &'a [Vec<f64>],
    ) -> Self {
        Self {
            section,
            base,
            held,
            led: BTreeMap::new(),
        }
    }

    /// Closes in double precision from where the `index`-th way leads by a radius. `states` are any of the mechanism; those
    /// of the part are replaced.
    pub fn closed(
        &mut self,
        states: &mut [JointState<f64>],
        (index, way): (usize, &[f64]),
        radius: f64,
    ) -> Result<Closing, MatrixError> {
        self.put(states, &scaled(way, radius));
        let closing = self
            .section
            .close_within_rounding(states, self.held, STEPS)?;
        let led = self.section.way_between(self.base, states);
        self.led.insert((index, radius.to_bits()), led);
        Ok(closing)
    }

    /// Closes in the arithmetic of `fine` from where double precision leads: that takes most of the steps, which then cost
    /// little.
    pub fn finished<R: Real>(
        &mut self,
        fine: &Section<'_, R>,
        base: &[JointState<R>],
        (states, near): (&mut [JointState<R>], &mut [JointState<f64>]),
        (index, way): (usize, &[f64]),
        radius: f64,
    ) -> Result<Closing, MatrixError> {
        let led = match self.led.get(&(index, radius.to_bits())) {
            Some(led) => led.clone(),
            None => {
                self.closed(near, (index, way), radius)?;
                self.section.way_between(self.base, near)
            }
        };
        self.put(near, &led);
        for &joint in &fine.part.joints {
            states[joint] = base[joint].clone();
        }
        fine.advance_by(states, &led);
        fine.close_guided(states, (&self.section, near), self.held, FINE_STEPS)
    }

    /// Puts the part's joints where a way from the pose leads.
    fn put(&self, states: &mut [JointState<f64>], by: &[f64]) {
        for &joint in &self.section.part.joints {
            states[joint] = self.base[joint].clone();
        }
        self.section.advance_by(states, by);
    }
}

fn scaled(way: &[f64], radius: f64) -> Vec<f64> {
    way.iter().map(|x| x * radius).collect()
}
