//! A mechanism in which only some joints move, and the others are put aside.

use super::frame::Frame;
use super::kind::JointKind;
use super::link::Placement;
use super::model::{JointId, Mechanism};

impl Mechanism {
    /// The mechanism with all but some joints welded together where their frames are: what those joints ask of one another
    /// stays the same as long as they hold together among themselves. Links are drawn elsewhere.
    #[must_use]
    pub fn with_others_put_aside(&self, kept: &[JointId]) -> Self {
        let mut result = self.clone();
        for (index, joint) in result.joints.iter_mut().enumerate() {
            if !kept.contains(&JointId(index)) {
                joint.kind = JointKind::Fixed;
                joint.predecessor.frame = Frame::identity();
                joint.successor.frame = Frame::identity();
                joint.lead = None;
                joint.distance = None;
            }
        }
        for link in &mut result.links {
            if let Placement::Floating { origin, .. } = &mut link.placement {
                *origin = Frame::identity();
            }
        }
        result
    }
}
