//! What a careful owner should know of a pose beside its mobility: what the limits say of it, which joints rest there and move elsewhere, and
//! whether a singular pose is near.

use super::limit_facts::{LimitFact, limit_facts};
use super::near_singular::{NearSingular, dead_centres, near_singular, pose_of_branch};
use super::vocabulary::PoseKind;
use super::{Analysis, Branch};
use kutzbach_model::mechanism::Mechanism;

/// Facts of the pose that was analysed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PoseFacts {
    /// What the limits of the joints say of it.
    pub limits: Vec<LimitFact>,
    /// Joints of one freedom that rest there while they move on the branch: extreme positions, by joint index.
    pub resting: Vec<usize>,
    /// Parts that are nearly singular there.
    pub near: Vec<NearSingular>,
}

impl PoseFacts {
    /// The facts of an analysis at [`Depth::Everything`](super::Depth::Everything) of this mechanism: the one meant, where there is one
    /// ([`Analysis::of`]). Nothing is said of a pose that does not close, and nothing of extreme positions at a singular pose or where the
    /// branches are not one.
    ///
    /// # Examples
    /// ```
    /// # use kutzbach_mobility as mobility;
    /// use mobility::{AnalysisOptions, PoseFacts, analyse};
    ///
    /// // A slider-crank in its dead centre: the slider rests.
    /// let text = r#"<robot name="press"><link name="frame"/><link name="crank"/><link name="rod"/><link name="ram"/>
    ///   <joint name="main" type="continuous"><parent link="frame"/><child link="crank"/><axis xyz="0 0 1"/></joint>
    ///   <joint name="pin" type="continuous"><parent link="crank"/><child link="rod"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/></joint>
    ///   <joint name="guide" type="prismatic"><parent link="frame"/><child link="ram"/><origin xyz="4 0 0"/><axis xyz="1 0 0"/>
    ///     <limit lower="-5" upper="5"/></joint>
    ///   <loop name="end" type="continuous"><predecessor link="rod"><origin xyz="3 0 0"/></predecessor><successor link="ram"/>
    ///     <axis xyz="0 0 1"/></loop></robot>"#;
    /// let mechanism = kutzbach_format::read(text, "press.urdf", &[]).unwrap().mechanism;
    /// let analysis = analyse(&mechanism, &AnalysisOptions::default()).unwrap();
    /// let facts = PoseFacts::of(&mechanism, &analysis);
    /// let resting: Vec<&str> = facts.resting.iter().map(|&joint| mechanism.joints()[joint].name.as_str()).collect();
    /// assert_eq!(resting, ["guide"]);
    /// assert!(facts.limits.is_empty() && facts.near.is_empty());
    /// ```
    #[must_use]
    pub fn of(mechanism: &Mechanism, analysis: &Analysis) -> Self {
        if !analysis.assembly.closed {
            return Self::default();
        }
        let states = &analysis.assembly.states;
        let (geometry, structure) = (&analysis.geometry, &analysis.structure);
        // Where the equations cannot be evaluated nearby there is nothing to say.
        let near = near_singular(mechanism, geometry, structure, states, &analysis.parts);
        Self {
            limits: limit_facts(mechanism, states),
            resting: resting(mechanism, analysis).unwrap_or_default(),
            near: near.unwrap_or_default(),
        }
    }
}

/// The joints that rest at a regular pose of one branch; `None` where that is not asked.
fn resting(mechanism: &Mechanism, analysis: &Analysis) -> Option<Vec<usize>> {
    let [branch] = analysis.branches.as_deref()? else {
        return None;
    };
    let branch: &Branch = branch;
    if analysis.mobility.pose != Some(PoseKind::Regular) {
        return None;
    }
    let (structure, states) = (&analysis.structure, &analysis.assembly.states);
    let here = pose_of_branch(mechanism, structure, states, &analysis.parts, branch)?;
    Some(dead_centres(
        mechanism,
        &analysis.geometry,
        structure,
        branch,
        &here,
    ))
}
