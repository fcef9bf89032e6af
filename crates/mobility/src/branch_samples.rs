//! Branches that can be written down, for the tests of what is read off their poses.

use super::branch::{BranchPose, Tangent};
use kutzbach_closure::Structure;
use kutzbach_closure::samples::{Place, Written, planar, ring};
use kutzbach_closure::{Arithmetic, Geometry};
use kutzbach_model::mechanism::{JointKind, Mechanism};

/// A mechanism and poses of it.
pub struct Sample {
    pub mechanism: Mechanism,
    pub geometry: Geometry<f64>,
    pub structure: Structure,
    pub poses: Vec<BranchPose>,
}

/// Values of every joint, and tangents.
type Drawn = (Vec<Vec<f64>>, Vec<Vec<f64>>);

/// What holds two joints together.
const FRAME: Place = (JointKind::Fixed, [0.0, 1.0, 0.0], [0.0; 3]);

/// A hinge that they do not let turn.
const LOCKED_HINGE: Place = (JointKind::Revolute, [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);

impl Sample {
    pub fn new(mechanism: Mechanism, poses: Vec<Drawn>) -> Self {
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
        let poses = poses
            .into_iter()
            .map(|(values, tangents)| BranchPose {
                states: geometry
                    .displacements
                    .iter()
                    .zip(values)
                    .map(|(displacement, values)| displacement.at(&values))
                    .collect(),
                tangents: tangents.into_iter().map(Tangent::from).collect(),
            })
            .collect();
        Self {
            structure: Structure::new(&mechanism),
            mechanism,
            geometry,
            poses,
        }
    }

    /// A parallelogram of hinges, two lengths wide and one high, its coupler moving on a circle.
    pub fn parallelogram() -> Self {
        let places = planar(&[[0.0, 0.0], [0.0, 1.0], [2.0, 1.0], [2.0, 0.0]]);
        let poses = [0.4, 0.9, -0.5].map(|angle: f64| {
            let turn = [angle, -angle, angle, -angle];
            let tangent = vec![3.0, -3.0, 3.0, -3.0];
            (turn.map(|x| vec![x]).to_vec(), vec![tangent])
        });
        Self::new(ring(&places, [0.0; 3], Written::Exactly), poses.into())
    }

    /// Two balls at the ends of a rod along x, held by a rigid frame: the rod spins.
    pub fn rod() -> Self {
        Self::rod_on(FRAME)
    }

    /// The same between two links whose hinge the rod locks.
    pub fn rod_between_links() -> Self {
        Self::rod_on(LOCKED_HINGE)
    }

    /// A link that slides and turns on a shaft whose ends are joined.
    pub fn sleeve() -> Self {
        Self::sleeve_on(FRAME)
    }

    /// The same on a shaft whose ends are two links, with a hinge that it locks.
    pub fn sleeve_between_links() -> Self {
        Self::sleeve_on(LOCKED_HINGE)
    }

    fn rod_on(frame: Place) -> Self {
        let poses = [0.3, 0.8].map(|angle: f64| {
            let values = vec![vec![angle, 0.0, 0.0], vec![-angle, 0.0, 0.0]];
            (values, vec![vec![1.0, 0.0, 0.0, -1.0, 0.0, 0.0]])
        });
        let ball = |x| (JointKind::Spherical, [x, 0.0, 0.0], [0.0; 3]);
        Self::at_rest_in(frame, [ball(0.0), ball(1.0)], poses)
    }

    fn sleeve_on(frame: Place) -> Self {
        let poses = [0.3, 0.8].map(|way: f64| {
            let values = vec![vec![way, 2.0 * way], vec![-way, -2.0 * way]];
            let tangents = vec![vec![1.0, 0.0, -1.0, 0.0], vec![1.0, 1.0, -1.0, -1.0]];
            (values, tangents)
        });
        let sleeve = |x| (JointKind::Cylindrical, [x, 0.5, 0.0], [1.0, 0.0, 0.0]);
        Self::at_rest_in(frame, [sleeve(0.0), sleeve(1.0)], poses)
    }

    /// A ring of two joints that move and a third that does not.
    fn at_rest_in(frame: Place, [first, second]: [Place; 2], poses: [Drawn; 2]) -> Self {
        let still = vec![0.0; frame.0.freedom()];
        let poses = poses.map(|(mut values, mut tangents)| {
            values.push(still.clone());
            tangents.iter_mut().for_each(|t| t.extend(&still));
            (values, tangents)
        });
        let mechanism = ring(&[first, second, frame], [0.0; 3], Written::Exactly);
        Self::new(mechanism, poses.into())
    }
}
