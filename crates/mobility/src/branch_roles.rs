//! What every joint does along a branch.
//!
//! A freedom is locked along a branch when no tangent at any generic pose of it moves it. That a joint moves is seen at
//! one pose; that it rests has to be seen at all of them, since at a single pose it may pause.

use super::branch::BranchPose;
use super::link_twists::LinkTwists;
use super::relative_motion::link_twists;
use super::roles::{JointRole, role};
use kutzbach_closure::Geometry;
use kutzbach_closure::Structure;
use kutzbach_model::mechanism::Mechanism;

/// Roles of all joints along a branch, by joint index; the default role where no pose can be used.
///
/// A joint's role stays open (`None`) where a component of the tangents is too large to be called rest and too small to be
/// called motion.
#[must_use]
pub fn branch_roles(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    structure: &Structure,
    poses: &[BranchPose],
) -> Vec<JointRole> {
    let seen = link_twists(mechanism, geometry, structure, poses);
    roles_seen(mechanism, &seen)
}

pub(super) fn roles_seen(mechanism: &Mechanism, seen: &[LinkTwists]) -> Vec<JointRole> {
    let joints = mechanism.joints().iter().enumerate();
    joints
        .map(|(index, joint)| {
            if seen.is_empty() {
                return JointRole::default();
            }
            let mut zero = vec![true; joint.freedom()];
            let mut doubtful = vec![true; joint.freedom()];
            for there in seen {
                let tangents = &there.tangents;
                let limits = tangents.limits_of(index);
                for (own, variable) in tangents.variables(index).enumerate() {
                    let moves = limits.moves(tangents.magnitude(variable));
                    zero[own] &= moves == Some(false);
                    doubtful[own] &= moves != Some(true);
                }
            }
            for (doubtful, zero) in doubtful.iter_mut().zip(&zero) {
                *doubtful &= !zero;
            }
            role(joint, &zero, &doubtful)
        })
        .collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::branch_samples::Sample;
    use super::*;

    fn roles(sample: &Sample) -> Vec<JointRole> {
        branch_roles(
            &sample.mechanism,
            &sample.geometry,
            &sample.structure,
            &sample.poses,
        )
    }

    #[test]
    fn what_moves_at_one_pose_is_not_locked() {
        let mut sample = Sample::sleeve();
        let none: [&str; 0] = [];
        assert_eq!(roles(&sample)[0].locked_parts, none);
        // The sleeve turns at the second pose only; then at none.
        sample.poses[0].tangents = vec![vec![1.0, 0.0, -1.0, 0.0].into()];
        assert_eq!(roles(&sample)[0].locked_parts, none);
        sample.poses.truncate(1);
        for (role, name) in roles(&sample).iter().zip(["r_a.rot", "r_b.rot"]) {
            assert_eq!(role.locked, Some(false));
            assert_eq!(role.locked_parts, [name]);
        }
        sample.poses[0].tangents.clear();
        assert!(
            roles(&sample)[..2]
                .iter()
                .all(|role| role.locked == Some(true))
        );
        sample.poses.clear();
        assert!(
            roles(&sample)
                .iter()
                .all(|role| *role == JointRole::default())
        );
    }

    #[test]
    fn a_joint_that_moves_next_to_nothing_stays_open() {
        // A hundred errors are neither rounding for certain nor motion.
        let mut sample = Sample::sleeve();
        for pose in &mut sample.poses {
            pose.tangents = vec![vec![1.0, 0.0, -1.0, 0.0].into()];
        }
        let seen = link_twists(
            &sample.mechanism,
            &sample.geometry,
            &sample.structure,
            &sample.poses,
        );
        let little = 100.0 * seen[0].tangents.limits_of(0).error;
        assert!(little < 1e-3);
        for pose in &mut sample.poses {
            pose.tangents = vec![vec![1.0, little, -1.0, -little].into()];
        }
        assert_eq!(roles(&sample)[0].locked, Some(false));
        assert!(roles(&sample)[0].locked_parts.is_empty());
        for pose in &mut sample.poses {
            pose.tangents = vec![vec![little, little, -little, -little].into()];
        }
        assert_eq!(
            roles(&sample)[0].locked,
            Some(false),
            "the size of a tangent means nothing"
        );
        for pose in &mut sample.poses {
            pose.tangents = vec![vec![0.0, 1.0, 0.0, -1.0].into()];
        }
        assert_eq!(roles(&sample)[0].locked_parts, ["r_a.trans"]);
    }

    #[test]
    fn fixed_joints_have_no_role() {
        let found = roles(&Sample::rod());
        assert_eq!(found[2], JointRole::default());
        assert_eq!(found[0].locked, Some(false));
    }
}
