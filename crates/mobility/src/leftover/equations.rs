//! Closure equations near a pose, about the centre and in the length that the cycles have there.

use kutzbach_closure::{JointState, Section, WalkedCycle};
use kutzbach_math::matrix::Real;

/// The equations of a part near its pose.
pub(super) struct Equations<'a, R> {
    section: Section<'a, R>,
    home: &'a [JointState<R>],
    /// Walks at the pose, whose centres and lengths the equations are told in.
    walks: Vec<WalkedCycle<R>>,
    /// Length of each coupling's row.
    norms: Vec<R>,
}

impl<'a, R: Real> Equations<'a, R> {
    /// About a pose; `length` is that of the part.
    pub fn about(section: Section<'a, R>, home: &'a [JointState<R>], length: f64) -> Self {
        let (geometry, part) = (section.geometry, section.part);
        let walk = |cycle: &Vec<(usize, bool)>| WalkedCycle::walk(geometry, home, cycle);
        let norm = |&coupling: &usize| {
            geometry.couplings[coupling].norm(|joint| geometry.coupled_unit(joint, length))
        };
        Self {
            walks: part.cycles.iter().map(walk).collect(),
            norms: part.couplings.iter().map(norm).collect(),
            section,
            home,
        }
    }

    /// How many unknowns there are.
    pub fn unknowns(&self) -> usize {
        self.section.metric.weights.len()
    }

    /// By what the equations are not met where all joints are advanced by increments (metric) in one step.
    pub fn residual(&self, z: &[R]) -> Vec<R> {
        let mut states = self.home.to_vec();
        self.section.advance(&mut states, z);
        let geometry = self.section.geometry;
        let mut rows = Vec::with_capacity(6 * self.walks.len() + self.norms.len());
        for (cycle, home) in self.section.part.cycles.iter().zip(&self.walks) {
            let closure = WalkedCycle::around(geometry, &states, cycle);
            rows.extend(
                WalkedCycle {
                    closure,
                    ..home.clone()
                }
                .residual(),
            );
        }
        for (&coupling, norm) in self.section.part.couplings.iter().zip(&self.norms) {
            let (value, _) = geometry.couplings[coupling].at(&states);
            rows.push(value / norm.clone());
        }
        rows
    }
}
