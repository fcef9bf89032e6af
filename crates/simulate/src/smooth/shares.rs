//! Bodies of many joints, as several in one place.
//!
//! A body couples all constraints that act on it: eliminating those of a hub with n spokes would cost time in proportion to n³. So a body
//! that more than a few joints act on is made of shares of its mass and moments in one place, welded to one another in a row, each with
//! some of the joints. Their motion is that of the body, and fronts stay small (`factor`).

use super::constraint::{Held, Row, Side};
use super::system::{Body, NUMBERS};
use nalgebra::{Matrix3, Vector3};

/// A body that no more joints act on stays whole: welds cost rows too.
const MOST_JOINTS: usize = 16;

/// Joints of a share.
const OF_A_SHARE: usize = 6;

/// Makes bodies of many joints of shares, which come after all bodies, as their welds come after all joints. The ground, which is the
/// number of bodies, is another number then: joints get it here.
pub(super) fn divide(bodies: &mut Vec<Body>, state: &mut Vec<f64>, joints: &mut Vec<Held>) {
    let whole = bodies.len();
    let mut acting: Vec<Vec<usize>> = vec![Vec::new(); whole];
    for (index, joint) in joints.iter().enumerate() {
        for side in &joint.sides {
            if let Some(of_body) = acting.get_mut(side.body)
                && of_body.last() != Some(&index)
            {
                of_body.push(index);
            }
        }
    }
    let added: usize = acting.iter().map(|joints| shares(joints.len()) - 1).sum();
    let ground = whole + added;
    for side in joints.iter_mut().flat_map(|joint| &mut joint.sides) {
        if side.body == whole {
            side.body = ground;
        }
    }
    for (body, of_body) in acting.iter().enumerate() {
        let count = shares(of_body.len());
        if count == 1 {
            continue;
        }
        let share = Body {
            mass: bodies[body].mass / count as f64,
            moments: bodies[body].moments / count as f64,
        };
        let placed = state[body * NUMBERS..(body + 1) * NUMBERS].to_vec();
        bodies[body] = share.clone();
        let mut before = body;
        for some in of_body.chunks(OF_A_SHARE).skip(1) {
            let own = bodies.len();
            bodies.push(share.clone());
            state.extend_from_slice(&placed);
            for &joint in some {
                for side in &mut joints[joint].sides {
                    if side.body == body {
                        side.body = own;
                    }
                }
            }
            joints.push(weld([before, own]));
            before = own;
        }
    }
}

/// Of how many shares a body is made.
fn shares(joints: usize) -> usize {
    if joints > MOST_JOINTS {
        joints.div_ceil(OF_A_SHARE)
    } else {
        1
    }
}

/// Holds two bodies with their centres and axes together.
fn weld(bodies: [usize; 2]) -> Held {
    let axis = |i: usize| Vector3::from(Matrix3::identity().column(i));
    let place = (0..3).map(|i| Row::Offset {
        side: 0,
        along: axis(i),
    });
    let turn = (0..3).map(|i| Row::Across {
        near: axis(i),
        far: axis((i + 1) % 3),
        cosine: 0.0,
    });
    Held {
        sides: bodies.map(|body| Side {
            body,
            at: Vector3::zeros(),
        }),
        rows: place.chain(turn).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::system::System;
    use super::*;

    /// A hub with so many bodies welded to it, held to the ground.
    fn work(spokes: usize) -> f64 {
        let body = Body {
            mass: 1.0,
            moments: Vector3::repeat(1.0),
        };
        let mut bodies = vec![body; spokes + 1];
        let mut state = vec![0.0; bodies.len() * NUMBERS];
        let mut joints: Vec<Held> = (1..=spokes + 1).map(|other| weld([0, other])).collect();
        divide(&mut bodies, &mut state, &mut joints);
        assert_eq!(state.len(), bodies.len() * NUMBERS);
        let mass: f64 = bodies.iter().map(|body| body.mass).sum();
        assert!((mass - (spokes + 1) as f64).abs() < 1e-9);
        let (relations, dampings) = (Vec::new(), Vec::new());
        System::new(bodies, joints, relations, dampings, (Vector3::zeros(), 1.0)).work()
    }

    #[test]
    fn work_is_in_proportion_to_the_spokes_of_a_hub() {
        assert!(
            work(1000) < 11.0 * work(100),
            "{} {}",
            work(1000),
            work(100)
        );
    }
}
