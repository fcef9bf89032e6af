//! Generic poses near a regular one: every part follows its own motions a finite way.

use kutzbach::closure::{
    Arithmetic, CycleJacobian, Geometry, Part, assemble, entry_accuracy, follow, jacobian,
};
use kutzbach::matrix::{SplitMix64, decide, null_basis};
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{BranchPose, Structure};
use std::collections::BTreeSet;

/// A mechanism with what the facts of a branch are computed from.
pub struct Posed {
    pub geometry: Geometry<f64>,
    pub structure: Structure,
    pub poses: Vec<BranchPose>,
}

/// Ways, in radians or part lengths of the fastest variable, and the shorter ones tried where a way leads nowhere.
const WAYS: [f64; 3] = [0.17, -0.29, 0.23];
const SHORTER: [f64; 5] = [1.0, 0.5, 0.25, 0.1, 0.03];

impl Posed {
    /// Three poses away from home.
    pub fn of(mechanism: &Mechanism) -> Self {
        let structure = Structure::new(mechanism);
        let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
        let assembly = assemble(mechanism, &geometry, &structure.parts, &BTreeSet::new()).unwrap();
        assert!(assembly.closed, "{} is open", mechanism.name());
        let count = mechanism.joints().iter().map(|joint| joint.freedom()).sum();
        let poses = WAYS
            .iter()
            .enumerate()
            .map(|(index, way)| {
                let mut pose = BranchPose {
                    states: assembly.states.clone(),
                    tangents: Vec::new(),
                };
                for part in &structure.parts {
                    follow_part(
                        mechanism,
                        &geometry,
                        part,
                        *way,
                        index as u64,
                        count,
                        &mut pose,
                    );
                }
                // Joints in no loop: one tangent for each freedom, and a way along it.
                for &joint in &structure.free_joints {
                    let first = first_variable(mechanism, joint);
                    let freedom = mechanism.joints()[joint].freedom();
                    for variable in first..first + freedom {
                        let mut alone = vec![0.0; count];
                        alone[variable] = 2.0;
                        pose.tangents.push(alone.into());
                    }
                    let values = vec![*way; freedom];
                    geometry.displacements[joint].advance(&mut pose.states[joint], &values);
                }
                pose
            })
            .collect();
        Self {
            geometry,
            structure,
            poses,
        }
    }
}

fn first_variable(mechanism: &Mechanism, joint: usize) -> usize {
    let before = &mechanism.joints()[..joint];
    before.iter().map(|joint| joint.freedom()).sum()
}

/// Null vectors of a part at a pose, in radians and metres by the part's own columns.
fn tangents(mechanism: &Mechanism, here: &CycleJacobian<f64>) -> Vec<Vec<f64>> {
    let (stated, rounding) = entry_accuracy(here);
    let mut matrix = here.matrix.clone();
    let scales = matrix.scale_columns();
    let decision = decide(&matrix, stated + rounding).unwrap();
    assert!(
        decision.rank.is_some(),
        "{}: {decision:?}",
        mechanism.name()
    );
    let null = null_basis(&matrix, &decision).unwrap();
    let lift = |vector: Vec<f64>| -> Vec<f64> {
        let scaled = vector.iter().zip(&scales).enumerate();
        scaled
            .map(|(column, (x, scale))| {
                let scale = if *scale > 0.0 { *scale } else { 1.0 };
                x / scale * here.unit(mechanism, column)
            })
            .collect()
    };
    null.vectors.into_iter().map(lift).collect()
}

fn follow_part(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    part: &Part,
    way: f64,
    seed: u64,
    count: usize,
    pose: &mut BranchPose,
) {
    let here = jacobian(mechanism, geometry, &pose.states, part).unwrap();
    let basis = tangents(mechanism, &here);
    let mut random = SplitMix64::new(11 + seed);
    let mut direction = vec![0.0; here.variables.len()];
    for vector in &basis {
        let weight = random.symmetric();
        for (column, (d, x)) in direction.iter_mut().zip(vector).enumerate() {
            *d += weight * x / here.unit(mechanism, column);
        }
    }
    let largest = direction.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    let (states, vectors) = SHORTER
        .iter()
        .find_map(|shorter| {
            let scale = if largest > 0.0 {
                way * shorter / largest
            } else {
                0.0
            };
            let step: Vec<f64> = direction.iter().map(|x| x * scale).collect();
            let mut states = pose.states.clone();
            follow(mechanism, geometry, &mut states, part, &step, |there| {
                let moved = jacobian(mechanism, geometry, there, part)?;
                Ok((there.to_vec(), tangents(mechanism, &moved)))
            })
            .unwrap()
            .filter(|(_, vectors)| vectors.len() == basis.len())
        })
        .expect("no regular pose nearby");
    pose.states = states;
    for vector in vectors {
        let mut whole = vec![0.0; count];
        let mut column = 0;
        for &joint in &part.joints {
            let first = first_variable(mechanism, joint);
            for own in 0..mechanism.joints()[joint].freedom() {
                whole[first + own] = vector[column];
                column += 1;
            }
        }
        pose.tangents.push(whole.into());
    }
}
