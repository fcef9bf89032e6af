//! From an analysis to what links and joints do in the motion shown.

use super::appearance::{Role, Roles};
use kutzbach_mobility::{Analysis, Branch};
use kutzbach_model::mechanism::Mechanism;

impl Roles {
    /// What links and joints do along a branch, one joint driven. Without a branch nothing moves, or nothing is known to:
    /// then joints that cannot give way at the pose count as locked.
    #[must_use]
    pub fn of(
        mechanism: &Mechanism,
        analysis: &Analysis,
        branch: Option<&Branch>,
        driven: Option<usize>,
    ) -> Self {
        let (links, idle, joints) = match branch {
            Some(branch) => (&branch.motions[..], &branch.idle[..], &branch.roles),
            None => (&[][..], &[][..], &analysis.roles),
        };
        let mut roles = Self {
            links: vec![Role::Moving; mechanism.links().len()],
            joints: joints
                .iter()
                .map(|role| match role.locked {
                    Some(true) => Role::Locked,
                    _ => Role::Moving,
                })
                .collect(),
        };
        for motion in links.iter().filter(|motion| motion.freedom == Some(0)) {
            roles.links[motion.link] = Role::Locked;
        }
        // A rod that carries the platform along and spins besides is not idle: all that an idle link does must be its own.
        let freedom = |link: usize| {
            let motion = links.iter().find(|motion| motion.link == link);
            motion.and_then(|motion| motion.freedom)
        };
        for idle in idle {
            for &link in idle.with.iter().chain([&idle.link]) {
                if freedom(link) == Some(idle.freedom) {
                    roles.links[link] = Role::Idle;
                }
            }
        }
        if let Some(joint) = driven {
            roles.joints[joint] = Role::Driven;
        }
        roles
    }
}
