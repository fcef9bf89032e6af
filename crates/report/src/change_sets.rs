//! Redundant constraints by joint and direction, and sets of joints to relax after which none is redundant: their part of the
//! JSON schema.

use kutzbach_mobility::{Analysis, JointChange, NoChangeSet, ReactionDirection};
use kutzbach_model::mechanism::Mechanism;
use serde::{Deserialize, Serialize};

/// A component of a joint's reaction that statics leaves open.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RedundantDirection {
    /// `force` along the direction, or `moment` about it.
    pub component: Component,
    /// Unit vector in the joint's frame on its predecessor.
    pub direction: [f64; 3],
    /// Whether it is one of the mechanism's independent redundant constraints: released all at once, these remove every
    /// redundancy and add no mobility.
    pub independent: bool,
}

/// A force or a moment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Component {
    /// A force along a direction.
    Force,
    /// A moment about a direction.
    Moment,
}

/// What makes the mechanism exactly constrained, without a change of its finite mobility.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ChangeSets {
    /// Why there are no sets of changes; `null` where there are, or where nothing is redundant.
    pub obstacle: Option<String>,
    /// Parts with redundant constraints: one set of each has to be carried out.
    pub parts: Vec<PartChanges>,
}

/// Sets of changes for one independent part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PartChanges {
    /// Redundant constraints that each set removes.
    pub redundant: usize,
    /// Whether no smaller set of such changes removes as many, which was shown.
    pub least: bool,
    /// Whether the sets are all of their size.
    pub complete: bool,
    /// The sets, each verified.
    pub sets: Vec<Vec<JointReplacement>>,
}

/// A joint that gets another class.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JointReplacement {
    /// The joint.
    pub joint: String,
    /// Its kind now, such as `revolute`.
    pub from: String,
    /// The kind it gets.
    pub to: String,
    /// `axis` of the new joint where it is another, in the predecessor's joint frame.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axis: Option<[f64; 3]>,
    /// `axis2` of the new joint where it has one, in the successor's joint frame.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axis2: Option<[f64; 3]>,
}

/// The indeterminate directions of a joint.
pub(super) fn directions(analysis: &Analysis, joint: usize) -> Vec<RedundantDirection> {
    let found = &analysis.directions[joint];
    let told = |one: &ReactionDirection| RedundantDirection {
        component: match one.moment {
            true => Component::Moment,
            false => Component::Force,
        },
        direction: one.direction.map(|x| x + 0.0),
        independent: found.redundant.contains(one),
    };
    found.indeterminate.iter().map(told).collect()
}

/// The sets of an analysis; `None` where nothing is redundant, or sets were not asked for.
pub(super) fn change_sets(mechanism: &Mechanism, analysis: &Analysis) -> Option<ChangeSets> {
    let parts = match &analysis.change_sets {
        Err(why) => {
            let obstacle = Some(obstacle(*why)?.to_owned());
            let parts = Vec::new();
            return Some(ChangeSets { obstacle, parts });
        }
        Ok(parts) => parts,
    };
    let replacement = |change: &JointChange| {
        let joint = &mechanism.joints()[change.joint];
        JointReplacement {
            joint: joint.name.clone(),
            from: joint.kind.word().to_owned(),
            to: change.to.word().to_owned(),
            axis: change.axis.map(|axis| axis.map(|x| x + 0.0)),
            axis2: change.second_axis.map(|axis| axis.map(|x| x + 0.0)),
        }
    };
    let of_part = |part: &kutzbach_mobility::ChangeSets| PartChanges {
        redundant: part.redundant,
        least: part.least,
        complete: part.complete,
        sets: part
            .sets
            .iter()
            .map(|set| set.iter().map(replacement).collect())
            .collect(),
    };
    Some(ChangeSets {
        obstacle: None,
        parts: parts.iter().map(of_part).collect(),
    })
}

/// In a sentence; `None` where there is nothing to say.
fn obstacle(why: NoChangeSet) -> Option<&'static str> {
    match why {
        NoChangeSet::NothingRedundant | NoChangeSet::Undecided => None,
        NoChangeSet::Singular => Some(
            "at this singular pose no change removes every redundancy without adding mobility: the equations stay dependent",
        ),
        NoChangeSet::TooLarge => Some(
            "sets of changes are not sought in a part of this size: the square of its redundant constraints times its equations exceeds 30 million",
        ),
        NoChangeSet::OutOfReach => {
            Some("no change of joint kinds removes every redundancy without adding mobility")
        }
    }
}
