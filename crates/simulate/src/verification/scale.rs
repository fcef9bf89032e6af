//! The size and weight of a mechanism, in which distances, forces and velocities are measured.

use crate::World;
use crate::inertia::Mass;
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

    /// How far apart the inertias of the links lie: the largest mass over the smallest, or radius of gyration times the root
    /// of mass, whichever is more; 1 where nothing moves.
    pub(super) fn inertia_spread(&self) -> f64 {
        let masses = || self.built.masses.iter().take(self.names.len()).flatten();
        let spread = |of: fn(&Mass) -> f64| {
            let (least, most) = masses()
                .map(of)
                .fold((f64::INFINITY, 0.0f64), |(least, most), x| {
                    (least.min(x), most.max(x))
                });
            if most > 0.0 { most / least } else { 1.0 }
        };
        spread(|mass| mass.mass).max(spread(|mass| mass.least_moment().sqrt()))
    }

    /// The moment of inertia of all links together about a point (m, world), in natural units: how heavy the load of a
    /// drive there can be.
    pub(super) fn load_about(&self, point: &[f64; 3]) -> f64 {
        let poses = self.link_poses();
        let about: f64 = self
            .built
            .masses
            .iter()
            .zip(&poses)
            .filter_map(|(mass, pose)| Some((mass.as_ref()?, pose)))
            .map(|(mass, pose)| {
                let centre = pose.apply(&mass.centre);
                let arm: f64 = (0..3).map(|i| (centre[i] - point[i]).powi(2)).sum();
                mass.mass * arm + mass.inertia.trace() / 3.0
            })
            .sum();
        about / self.units.moment()
    }
}
