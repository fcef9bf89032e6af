//! Mechanisms of one part at their closed pose, with all that the engines are given, for the tests of these.

use super::chart::Kernel;
use super::more_digits::MoreDigits;
use super::pose_rank::{PartRank, Pose, Trial, rank_part};
use super::tracing::KERNEL_LIMIT;
use kutzbach_closure::Structure;
use kutzbach_closure::samples::{Place, Written, planar, ring};
use kutzbach_closure::{
    Arithmetic, Assembly, Geometry, JointState, Part, Section, assemble, entry_accuracy, jacobian,
};
use kutzbach_format::read_file;
use kutzbach_math::matrix::Real;
use kutzbach_model::mechanism::{JointKind, Mechanism};
use std::collections::BTreeSet;

/// A mechanism at its closed pose.
pub struct Posed {
    pub mechanism: Mechanism,
    pub geometry: Geometry<f64>,
    pub structure: Structure,
    pub assembly: Assembly,
    held: BTreeSet<usize>,
}

impl Posed {
    pub fn new(mechanism: Mechanism) -> Self {
        Self::closed(mechanism).unwrap()
    }

    /// `None` where the loops do not close.
    pub fn closed(mechanism: Mechanism) -> Option<Self> {
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
        let structure = Structure::new(&mechanism);
        let held = BTreeSet::new();
        let assembly = assemble(&mechanism, &geometry, &structure.parts, &held).ok()?;
        assembly.closed.then_some(Self {
            mechanism,
            geometry,
            structure,
            assembly,
            held,
        })
    }

    /// One of the known mechanisms.
    pub fn known(name: &str) -> Self {
        let path = format!("{}/../../tests/zoo/{name}.urdf", env!("CARGO_MANIFEST_DIR"));
        Self::new(read_file(path, &[]).unwrap().mechanism)
    }

    pub fn pose(&self) -> Pose<'_> {
        Pose {
            mechanism: &self.mechanism,
            configuration: None,
            held: &self.held,
            geometry: &self.geometry,
            states: &self.assembly.states,
            as_drawn: self.assembly.steps == 0,
            trial: Trial::default(),
        }
    }

    /// The first part: that of the samples here is the only one.
    pub fn part(&self) -> &Part {
        &self.structure.parts[0]
    }

    pub fn rank(&self) -> PartRank {
        rank_part(&self.pose(), self.part()).unwrap()
    }

    pub fn kernel(&self, rank: &PartRank) -> Kernel {
        Kernel::of(&self.pose(), rank, KERNEL_LIMIT)
            .unwrap()
            .unwrap()
    }

    pub fn section<'a>(&'a self, kernel: &'a Kernel) -> Section<'a, f64> {
        Section {
            mechanism: &self.mechanism,
            geometry: &self.geometry,
            part: self.part(),
            metric: &kernel.metric,
        }
    }

    /// The whole mechanism's states, with those of the part put in.
    pub fn with(&self, part: &[JointState<f64>]) -> Vec<JointState<f64>> {
        let mut states = self.assembly.states.clone();
        for (&joint, state) in self.part().joints.iter().zip(part) {
            states[joint] = state.clone();
        }
        states
    }

    /// The largest equation left open, in units of what rounding and stated precision explain.
    pub fn openness(&self, states: &[JointState<f64>]) -> f64 {
        let there = jacobian(&self.mechanism, &self.geometry, states, self.part()).unwrap();
        let (stated, rounding) = entry_accuracy(&there);
        let left = there.residual.iter().fold(0.0f64, |m, r| m.max(r.abs()));
        left / (4.0 * rounding + stated)
    }

    /// By how much rates (rad, m) open the cycles at these states: relative to the rates, in part lengths.
    pub fn opening(&self, states: &[JointState<f64>], rates: &[f64]) -> f64 {
        let there = jacobian(&self.mechanism, &self.geometry, states, self.part()).unwrap();
        let rates: Vec<f64> = rates
            .iter()
            .enumerate()
            .map(|(column, rate)| rate / there.unit(&self.mechanism, column))
            .collect();
        let mut opening = vec![0.0; there.matrix.rows()];
        for (row, column, value) in there.matrix.triplets() {
            opening[row] += value * rates[column];
        }
        0.0.norm(&opening) / 0.0.norm(&rates)
    }
}

/// More digits for one test.
pub fn fresh() -> MoreDigits {
    MoreDigits::new()
}

/// A Bennett linkage of sides √5, 3, √5, 3, turned so that no coordinate ends; see `crate::families` for why it is one.
pub fn bennett(written: Written) -> Mechanism {
    ring(&bennett_places(), [0.0; 3], written)
}

pub fn bennett_places() -> Vec<Place> {
    let corners = [
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 2.0],
        [-1.0, 0.0, 0.0],
        [-1.0, -1.0, 2.0],
    ];
    let axes = [
        [4.0, -4.0, 2.0],
        [0.0, -4.0, 2.0],
        [-4.0, 4.0, 2.0],
        [0.0, 4.0, 2.0],
    ];
    let (s, c) = 0.7f64.sin_cos();
    let turn = |v: [f64; 3]| [c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]];
    corners
        .into_iter()
        .zip(axes)
        .map(|(at, along)| (JointKind::Revolute, turn(at), turn(along)))
        .collect()
}

/// Three hinges in a line: they turn to first order only.
pub fn shaky_triangle() -> Mechanism {
    ring(
        &planar(&[[0.0, 0.0], [1.0, 0.0], [3.0, 0.0]]),
        [0.0; 3],
        Written::Exactly,
    )
}

/// A four-bar stretched to the length of its ground: no other pose closes, though two rates are free at this one.
pub fn stretched() -> Mechanism {
    ring(
        &planar(&[[0.0, 0.0], [1.0, 0.0], [2.5, 0.0], [4.0, 0.0]]),
        [0.0; 3],
        Written::Exactly,
    )
}

/// Five hinges in a plane: two freedoms.
pub fn five_bar() -> Mechanism {
    ring(
        &planar(&[[0.0, 0.0], [-0.5, 2.0], [1.5, 3.5], [4.0, 2.5], [3.0, 0.0]]),
        [0.0; 3],
        Written::Exactly,
    )
}

/// R C C C at general places: one freedom, no equation to spare.
pub fn cylinders() -> Mechanism {
    let places: Vec<Place> = vec![
        (JointKind::Revolute, [0.0; 3], [0.0, 0.25, 1.0]),
        (JointKind::Cylindrical, [1.0, 0.25, 0.0], [0.5, 0.0, 1.0]),
        (JointKind::Cylindrical, [1.0, 1.5, 0.5], [0.0, 1.0, 0.5]),
        (JointKind::Cylindrical, [0.25, 1.0, -0.5], [1.0, -0.5, 0.25]),
    ];
    ring(&places, [0.0; 3], Written::Exactly)
}
