//! Frames and directions as a file writes them: exact numbers.

use kutzbach_math::number::Number;

/// A pose relative to another frame: first rotate by fixed-axis roll, pitch, yaw, then translate (URDF's `origin`).
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Position in metres.
    pub position: [Number; 3],
    /// Roll, pitch and yaw in radians: `R = Rz(yaw) Ry(pitch) Rx(roll)`.
    pub roll_pitch_yaw: [Number; 3],
}

impl Frame {
    /// The frame that coincides with its reference.
    #[must_use]
    pub fn identity() -> Self {
        Self::at([Number::zero(), Number::zero(), Number::zero()])
    }

    /// A frame at a position (metres), parallel to its reference.
    #[must_use]
    pub fn at(position: [Number; 3]) -> Self {
        Self {
            position,
            roll_pitch_yaw: [Number::zero(), Number::zero(), Number::zero()],
        }
    }

    /// A frame at a position given in floating point (metres, taken as exact), parallel to its reference.
    /// Numbers that are not finite become errors when the mechanism is built.
    #[must_use]
    pub fn at_point(position: [f64; 3]) -> Option<Self> {
        Some(Self::at(numbers(position)?))
    }

    /// Whether position and rotation are exactly zero.
    #[must_use]
    pub fn is_identity(&self) -> bool {
        self.position.iter().all(Number::is_zero) && self.roll_pitch_yaw.iter().all(Number::is_zero)
    }
}

/// A direction in a joint frame; any length but zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Direction(pub [Number; 3]);

impl Direction {
    /// The x axis, the default of every joint.
    #[must_use]
    pub fn x() -> Self {
        Self([Number::one(), Number::zero(), Number::zero()])
    }

    /// A direction given in floating point, taken as exact; `None` where a component is not finite.
    #[must_use]
    pub fn of(components: [f64; 3]) -> Option<Self> {
        Some(Self(numbers(components)?))
    }

    /// Whether all three components are zero, which names no direction.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.0.iter().all(Number::is_zero)
    }
}

fn numbers(values: [f64; 3]) -> Option<[Number; 3]> {
    Some([
        Number::from_f64(values[0])?,
        Number::from_f64(values[1])?,
        Number::from_f64(values[2])?,
    ])
}
