//! The size and weight of a mechanism, in which distances, forces and velocities are measured.

use crate::simulate::World;
use nalgebra::Matrix3;

/// Inertia of a link.
#[derive(Clone, Debug)]
pub(super) struct LinkInertia {
    /// kg.
    pub mass: f64,
    /// Centre of mass in the link frame (m).
    pub centre: [f64; 3],
    /// A root of the moments of inertia about the centre, along the link's axes: `root rootᵀ` (kg m²).
    pub root: Matrix3<f64>,
}

impl World {
    /// Natural units of this world: its length (m), and the torque that is its typical mass times its length squared per
    /// s² (N m); the same number is its natural energy (J).
    #[must_use]
    pub fn scale(&self) -> (f64, f64) {
        (self.units.length, self.units.moment())
    }

    /// Inertia of every link; `None` for the ground.
    pub(super) fn link_inertias(&self) -> Vec<Option<LinkInertia>> {
        self.built
            .masses
            .iter()
            .take(self.names.len())
            .map(|mass| {
                let mass = mass.as_ref()?;
                Some(LinkInertia {
                    mass: mass.mass,
                    centre: mass.centre,
                    root: mass.inertia.cholesky()?.l(),
                })
            })
            .collect()
    }
}
