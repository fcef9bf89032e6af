//! The variables of a polynomial system and what they mean.

use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{JointId, LinkId};

/// A variable: its name in equations, and its meaning.
#[derive(Clone, Debug)]
pub struct Variable {
    /// Unique in the system.
    pub name: String,
    /// What it stands for.
    pub meaning: Meaning,
}

/// What a variable stands for.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Meaning {
    /// A translation of a joint, counted in a unit of its own (m) so that no square root is needed.
    Translation {
        /// The joint.
        joint: JointId,
        /// Index of the freedom in the joint's kind, where it is one of them.
        freedom: Option<usize>,
        /// Metres per unit, squared: the squared length of the direction as the file writes it.
        unit_square: Number,
    },
    /// The cosine of a joint's angle.
    Cosine {
        /// The joint.
        joint: JointId,
        /// Index of the freedom in the joint's kind, where it is one of them.
        freedom: Option<usize>,
    },
    /// The sine of a joint's angle, divided by the length of the axis as the file writes it (1 where that is rational).
    Sine {
        /// The joint.
        joint: JointId,
        /// Index of the freedom in the joint's kind, where it is one of them.
        freedom: Option<usize>,
        /// The squared length of the axis: sine = variable · √(this).
        axis_square: Number,
    },
    /// A component of the unit quaternion of a ball, relative to the ball as drawn; the real part is component 0.
    Quaternion {
        /// The joint.
        joint: JointId,
        /// 0 to 3.
        component: usize,
    },
    /// A component of the vector between the two points of a distance joint (m), in the predecessor's joint frame.
    Between {
        /// The joint.
        joint: JointId,
        /// 0 to 2.
        component: usize,
    },
    /// The unwound angle of a joint, in turns from the drawn pose.
    Turns {
        /// The joint.
        joint: JointId,
    },
    /// The way of a slide along a common line, from the drawn pose (m).
    Way {
        /// The joint.
        joint: JointId,
    },
    /// An entry of a link's rotation matrix relative to the ground.
    BodyRotation {
        /// The link.
        link: LinkId,
        /// 0 to 2.
        row: usize,
        /// 0 to 2.
        column: usize,
    },
    /// A coordinate of a link's origin relative to the ground (m).
    BodyTranslation {
        /// The link.
        link: LinkId,
        /// 0 to 2.
        row: usize,
    },
    /// An algebraic number, a root of the equation that has [`Origin::MinimalPolynomial`](super::Origin::MinimalPolynomial).
    Algebraic {
        /// Which root: the real number itself, to any number of digits.
        value: Number,
    },
    /// A parameter of the mechanism, or the cosine or sine of one.
    Parameter {
        /// Its value in the file.
        value: Number,
    },
}

impl Meaning {
    /// The joint whose freedom this is.
    #[must_use]
    pub fn joint(&self) -> Option<JointId> {
        match self {
            Self::Translation { joint, .. }
            | Self::Cosine { joint, .. }
            | Self::Sine { joint, .. }
            | Self::Quaternion { joint, .. }
            | Self::Between { joint, .. }
            | Self::Turns { joint }
            | Self::Way { joint } => Some(*joint),
            _ => None,
        }
    }

    /// Whether this is a number of the mechanism and no unknown.
    #[must_use]
    pub fn is_algebraic_number(&self) -> bool {
        matches!(self, Self::Algebraic { .. })
    }
}

/// Variables in the order in which they are made, with unique names.
#[derive(Clone, Debug, Default)]
pub(super) struct Names {
    pub(super) variables: Vec<Variable>,
}

impl Names {
    pub(super) fn add(&mut self, name: String, meaning: Meaning) -> usize {
        let mut name = name;
        while self.variables.iter().any(|v| v.name == name) {
            name.push('\'');
        }
        self.variables.push(Variable { name, meaning });
        self.variables.len() - 1
    }
}
