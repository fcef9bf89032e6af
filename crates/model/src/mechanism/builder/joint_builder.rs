//! A joint as its maker describes it.

use super::home_frames::HomeFrame;
use crate::mechanism::{Direction, Dynamics, Frame, JointKind, Limit};
use kutzbach_math::number::Number;

/// A joint under construction. Links are named; [`MechanismBuilder::build`](super::MechanismBuilder::build) resolves them.
#[derive(Clone, Debug)]
pub struct JointBuilder {
    pub(super) name: String,
    pub(super) kind: JointKind,
    pub(super) predecessor: String,
    pub(super) successor: String,
    pub(super) predecessor_frame: Frame,
    pub(super) successor_frame: Frame,
    pub(super) axis: Option<Direction>,
    pub(super) axis2: Option<Direction>,
    pub(super) lead: Option<Number>,
    pub(super) distance: Option<Number>,
    pub(super) limit: Option<Limit>,
    pub(super) dynamics: Option<Dynamics>,
    pub(super) independent: Option<bool>,
    pub(super) closes_loop: bool,
    pub(super) at_home: Option<HomeFrame>,
}

impl JointBuilder {
    /// A joint of the file's tree, which also places its child at home.
    #[must_use]
    pub fn tree(name: &str, kind: JointKind, parent: &str, child: &str) -> Self {
        Self::new(name, kind, parent, child, false)
    }

    /// A joint that closes a loop between two links placed otherwise.
    #[must_use]
    pub fn closing(name: &str, kind: JointKind, predecessor: &str, successor: &str) -> Self {
        Self::new(name, kind, predecessor, successor, true)
    }

    fn new(
        name: &str,
        kind: JointKind,
        predecessor: &str,
        successor: &str,
        closes_loop: bool,
    ) -> Self {
        Self {
            name: name.to_owned(),
            kind,
            predecessor: predecessor.to_owned(),
            successor: successor.to_owned(),
            predecessor_frame: Frame::identity(),
            successor_frame: Frame::identity(),
            axis: None,
            axis2: None,
            lead: None,
            distance: None,
            limit: None,
            dynamics: None,
            independent: None,
            closes_loop,
            at_home: None,
        }
    }

    /// The joint frame in the predecessor (a tree joint's origin in its parent).
    #[must_use]
    pub fn origin(mut self, frame: Frame) -> Self {
        self.predecessor_frame = frame;
        self
    }

    /// The joint frame in the successor; a tree joint's is the link frame itself.
    #[must_use]
    pub fn successor_origin(mut self, frame: Frame) -> Self {
        self.successor_frame = frame;
        self
    }

    /// Closes the loop at home by construction: both sides' frames follow from one, `frame` in `link`, and from where the
    /// links are placed. With `parallel_to_root` that frame is turned to be parallel to the root link at home.
    ///
    /// For joints that close loops; whatever frames they have else are replaced.
    #[must_use]
    pub fn at_home(mut self, link: &str, frame: Frame, parallel_to_root: bool) -> Self {
        self.closes_loop = true;
        self.at_home = Some(HomeFrame {
            link: link.to_owned(),
            frame,
            parallel_to_root,
        });
        self
    }

    /// Axis, direction or plane normal in the predecessor's joint frame.
    #[must_use]
    pub fn axis(mut self, axis: Direction) -> Self {
        self.axis = Some(axis);
        self
    }

    /// Second axis, line or plane normal in the successor's joint frame.
    #[must_use]
    pub fn axis2(mut self, axis: Direction) -> Self {
        self.axis2 = Some(axis);
        self
    }

    /// Metres per turn.
    #[must_use]
    pub fn lead(mut self, lead: Number) -> Self {
        self.lead = Some(lead);
        self
    }

    /// Metres between the two origins of a distance joint.
    #[must_use]
    pub fn distance(mut self, distance: Number) -> Self {
        self.distance = Some(distance);
        self
    }

    /// Range and rates.
    #[must_use]
    pub fn limit(mut self, limit: Limit) -> Self {
        self.limit = Some(limit);
        self
    }

    /// Friction and damping.
    #[must_use]
    pub fn dynamics(mut self, dynamics: Dynamics) -> Self {
        self.dynamics = Some(dynamics);
        self
    }

    /// URDF+'s mark of an independent coordinate.
    #[must_use]
    pub fn independent(mut self, independent: bool) -> Self {
        self.independent = Some(independent);
        self
    }
}
