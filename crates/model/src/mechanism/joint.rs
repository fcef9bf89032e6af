//! A joint: two links, a frame on each, and the kind of displacement between the frames.

use super::frame::{Direction, Frame};
use super::kind::JointKind;
use super::model::LinkId;
use kutzbach_math::number::Number;

/// One side of a joint: the link and the joint's frame in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Side {
    /// The link.
    pub link: LinkId,
    /// The joint frame relative to the link frame (`link_from_joint`).
    pub frame: Frame,
}

/// Range and rates of a joint of one freedom, as in URDF; metres and radians.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Limit {
    /// Smallest value of the joint variable.
    pub lower: Option<Number>,
    /// Largest value of the joint variable.
    pub upper: Option<Number>,
    /// Largest force or torque (N, N m).
    pub effort: Option<Number>,
    /// Largest rate (m/s, rad/s).
    pub velocity: Option<Number>,
}

/// Passive forces in a joint, as in URDF.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Dynamics {
    /// Viscous damping (N s/m, N m s/rad).
    pub damping: Option<Number>,
    /// Dry friction (N, N m).
    pub friction: Option<Number>,
}

/// A joint of the mechanism; tree joints and loops alike.
///
/// The displacement `predecessor_frame -> successor_frame` belongs to the set of the joint's kind; all joint variables are
/// zero when the two frames coincide.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Unique among joints and couplings.
    pub name: String,
    /// What the joint allows.
    pub kind: JointKind,
    /// The side whose frame carries [`axis`](Self::axis); a tree joint's parent.
    pub predecessor: Side,
    /// The side whose frame carries [`axis2`](Self::axis2); a tree joint's child.
    pub successor: Side,
    /// Axis, direction or plane normal, in the predecessor's joint frame.
    pub axis: Direction,
    /// Second axis, line or plane normal, in the successor's joint frame.
    pub axis2: Direction,
    /// Metres per turn, right-handed positive; for the two screw kinds.
    pub lead: Option<Number>,
    /// Metres between the two frame origins for [`JointKind::Distance`]; `None` means as at home.
    pub distance: Option<Number>,
    /// Range of motion.
    pub limit: Option<Limit>,
    /// Friction and damping.
    pub dynamics: Option<Dynamics>,
    /// URDF+'s mark of an independent coordinate; says nothing about mobility, kept for writing back.
    pub independent: Option<bool>,
    /// Whether the joint closes a loop of the file's tree (`<loop>`, or a second joint with the same child).
    pub closes_loop: bool,
}

impl Joint {
    /// Number of freedoms.
    #[must_use]
    pub fn freedom(&self) -> usize {
        self.kind.freedom()
    }

    /// The least and the largest value of the variable of a joint of one freedom (rad, m), infinite where the file states
    /// none. `None` for a joint without limits or of other freedoms. The lower one is not above the upper one: building a
    /// mechanism sees to that.
    #[must_use]
    pub fn bounds(&self) -> Option<(f64, f64)> {
        let limit = self.limit.as_ref().filter(|_| self.freedom() == 1)?;
        let lower = limit
            .lower
            .as_ref()
            .map_or(f64::NEG_INFINITY, Number::value);
        let upper = limit.upper.as_ref().map_or(f64::INFINITY, Number::value);
        (lower.is_finite() || upper.is_finite()).then_some((lower, upper))
    }

    /// The name of one freedom, such as `slider.rot`; numbered (`ball.rot2`) where several do the same.
    #[must_use]
    pub fn freedom_name(&self, index: usize) -> String {
        let parts = self.kind.freedoms();
        let Some(part) = parts.get(index) else {
            return self.name.clone();
        };
        if parts.len() == 1 {
            return self.name.clone();
        }
        let same = parts.iter().filter(|p| *p == part).count();
        let rank = parts[..=index].iter().filter(|p| *p == part).count();
        if same == 1 {
            format!("{}.{}", self.name, part.suffix())
        } else {
            format!("{}.{}{}", self.name, part.suffix(), rank)
        }
    }
}
