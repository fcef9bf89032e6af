//! What each joint does at the pose: which of its freedoms move in some motion, which in none.
//!
//! A variable is locked at the pose when its component vanishes in every vector of ker J (a coloop of the column matroid).

use super::pose_rank::PartRank;
use crate::closure::Part;
use crate::matrix::{MatrixError, coloops, null_vectors};
use crate::mechanism::{FreedomPart, Joint, JointKind, Mechanism};

/// Above this nullity random null vectors stand for a basis. A variable that moves is missed with probability zero.
const NULL_VECTORS: usize = 24;

/// The role of one joint at the pose.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct JointRole {
    /// Whether no freedom of the joint moves; `None` where the margin does not tell. Meaningless without freedoms.
    pub locked: Option<bool>,
    /// Names of freedoms that do not move while others of the joint do, such as `slider.rot`.
    pub locked_parts: Vec<String>,
}

/// Roles of the joints of a part, in the part's order.
///
/// # Errors
/// [`MatrixError`] where the null vectors cannot be computed.
pub fn roles_of_part(
    mechanism: &Mechanism,
    part: &Part,
    rank: &PartRank,
) -> Result<Vec<JointRole>, MatrixError> {
    let Some(decision) = rank.settled() else {
        return Ok(vec![JointRole::default(); part.joints.len()]);
    };
    let null = null_vectors(&rank.matrix, &decision, NULL_VECTORS, 1)?;
    let found = coloops(&null, &decision);
    let mut zero = vec![false; rank.matrix.columns()];
    let mut doubtful = zero.clone();
    for column in found.zero {
        zero[column] = true;
    }
    for column in found.undecided {
        doubtful[column] = true;
    }
    let mut first = 0;
    let mut roles = Vec::with_capacity(part.joints.len());
    for &joint in &part.joints {
        let joint = &mechanism.joints()[joint];
        let columns = first..first + joint.freedom();
        first += joint.freedom();
        roles.push(role(joint, &zero[columns.clone()], &doubtful[columns]));
    }
    Ok(roles)
}

fn role(joint: &Joint, zero: &[bool], doubtful: &[bool]) -> JointRole {
    if zero.is_empty() {
        return JointRole::default();
    }
    if zero.iter().all(|z| *z) {
        return JointRole {
            locked: Some(true),
            locked_parts: Vec::new(),
        };
    }
    let moves = zero.iter().zip(doubtful).any(|(z, d)| !z && !d);
    let locked_parts = freedom_groups(joint.kind)
        .into_iter()
        .filter(|(_, variables)| variables.iter().all(|v| zero[*v]))
        .map(|(suffix, _)| format!("{}.{suffix}", joint.name))
        .collect();
    JointRole {
        locked: moves.then_some(false),
        locked_parts,
    }
}

/// The parts of a joint that can be locked on their own, by name and variables: all rotations together and all
/// translations together, since which of two directions in a plane is called the first means nothing; the two axes of a
/// universal joint and of a line on a plane are lines of the mechanism and count one by one.
#[must_use]
pub fn freedom_groups(kind: JointKind) -> Vec<(String, Vec<usize>)> {
    let parts = kind.freedoms();
    let of = |wanted: FreedomPart| -> Vec<usize> {
        (0..parts.len()).filter(|v| parts[*v] == wanted).collect()
    };
    let mut groups = Vec::new();
    for part in [
        FreedomPart::Rotation,
        FreedomPart::Translation,
        FreedomPart::Screw,
    ] {
        let variables = of(part);
        let one_by_one = matches!(kind, JointKind::Universal | JointKind::LineOnPlane)
            && part == FreedomPart::Rotation;
        if one_by_one {
            for (index, variable) in variables.into_iter().enumerate() {
                groups.push((format!("{}{}", part.suffix(), index + 1), vec![variable]));
            }
        } else if !variables.is_empty() {
            groups.push((part.suffix().to_owned(), variables));
        }
    }
    groups
}
