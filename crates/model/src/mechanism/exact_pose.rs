//! Poses with exact entries.

use super::frame::Frame;
use kutzbach_math::number::{Number, NumberError};
use kutzbach_math::space::Rigid;

/// `a_from_b` with exact entries: `p_a = rotation p_b + translation` (m).
#[derive(Clone, Debug, PartialEq)]
pub struct ExactPose {
    /// Rows of the rotation matrix.
    pub rotation: [[Number; 3]; 3],
    /// In metres.
    pub translation: [Number; 3],
}

fn dot(a: &[Number; 3], b: &[Number; 3]) -> Number {
    // Most entries of frames are zero: no tree is made of them.
    let mut sum = Number::zero();
    for (x, y) in a.iter().zip(b) {
        if !is_plain_zero(x) && !is_plain_zero(y) {
            sum = &sum + &(x * y);
        }
    }
    sum
}

fn is_plain_zero(x: &Number) -> bool {
    x.rational().is_some_and(|x| x.is_zero())
}

impl ExactPose {
    /// The pose in doubles, each entry rounded (m).
    #[must_use]
    pub fn to_doubles(&self) -> Rigid<f64> {
        Rigid {
            rotation: [0, 1, 2].map(|i| [0, 1, 2].map(|j| self.rotation[i][j].value())),
            translation: [0, 1, 2].map(|i| self.translation[i].value()),
        }
    }

    /// The pose that changes nothing.
    #[must_use]
    pub fn identity() -> Self {
        let entry = |i: usize, j: usize| {
            if i == j {
                Number::one()
            } else {
                Number::zero()
            }
        };
        Self {
            rotation: [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j))),
            translation: [0, 1, 2].map(|_| Number::zero()),
        }
    }

    /// The pose of a frame: `R = Rz(yaw) Ry(pitch) Rx(roll)`.
    #[must_use]
    pub fn of(frame: &Frame) -> Self {
        let mut pose = Self {
            translation: frame.position.clone(),
            ..Self::identity()
        };
        for axis in [2, 1, 0] {
            let angle = &frame.roll_pitch_yaw[axis];
            if !is_plain_zero(angle) {
                let direction = [0, 1, 2].map(|i| {
                    if i == axis {
                        Number::one()
                    } else {
                        Number::zero()
                    }
                });
                pose = pose.then(&Self::turn(&direction, angle));
            }
        }
        pose
    }

    /// The rotation about a unit vector by an angle (rad).
    #[must_use]
    pub fn turn(unit: &[Number; 3], angle: &Number) -> Self {
        let (c, s) = angle.cos_sin();
        let rest = &Number::one() - &c;
        let entry = |i: usize, j: usize| {
            let outer = &(&unit[i] * &unit[j]) * &rest;
            let skew = match (3 + j - i) % 3 {
                0 => return &c + &outer,
                1 => -(&(&s * &unit[3 - i - j])),
                _ => &s * &unit[3 - i - j],
            };
            &outer + &skew
        };
        Self {
            rotation: [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j))),
            ..Self::identity()
        }
    }

    /// A vector turned.
    #[must_use]
    pub fn rotate(&self, v: &[Number; 3]) -> [Number; 3] {
        [0, 1, 2].map(|i| dot(&self.rotation[i], v))
    }

    /// A point moved (m).
    #[must_use]
    pub fn apply(&self, p: &[Number; 3]) -> [Number; 3] {
        let turned = self.rotate(p);
        [0, 1, 2].map(|i| &turned[i] + &self.translation[i])
    }

    /// `a_from_c = a_from_b.then(b_from_c)`.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        let column = |j: usize| [0, 1, 2].map(|i| next.rotation[i][j].clone());
        let columns = [0, 1, 2].map(column);
        Self {
            rotation: [0, 1, 2].map(|i| [0, 1, 2].map(|j| dot(&self.rotation[i], &columns[j]))),
            translation: self.apply(&next.translation),
        }
    }

    /// `b_from_a` of `a_from_b`.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let rotation = [0, 1, 2].map(|i| [0, 1, 2].map(|j| self.rotation[j][i].clone()));
        let back = Self {
            rotation,
            ..Self::identity()
        };
        let moved = back.rotate(&self.translation);
        Self {
            translation: moved.map(|x| -&x),
            ..back
        }
    }

    /// The frame of this pose. Where the pitch is a right angle the roll is taken as zero.
    ///
    /// # Errors
    /// Where an angle of the rotation cannot be written.
    pub fn frame(&self) -> Result<Frame, NumberError> {
        let r = &self.rotation;
        let flat = &(&r[0][0] * &r[0][0]) + &(&r[1][0] * &r[1][0]);
        let sine = -&r[2][0];
        let roll_pitch_yaw = if flat.is_zero() {
            [
                Number::zero(),
                Number::atan2(&sine, &Number::zero())?,
                Number::atan2(&-&r[0][1], &r[1][1])?,
            ]
        } else {
            [
                Number::atan2(&r[2][1], &r[2][2])?,
                Number::atan2(&sine, &flat.sqrt()?)?,
                Number::atan2(&r[1][0], &r[0][0])?,
            ]
        };
        Ok(Frame {
            position: self.translation.clone(),
            roll_pitch_yaw,
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn number(text: &str) -> Number {
        Number::expression(text, &mut |_| Ok(None)).unwrap()
    }

    #[test]
    fn frames_and_poses_are_the_same_thing() {
        for rpy in [
            ["0", "0", "0"],
            ["pi/6", "-pi/4", "2*pi/3"],
            ["0", "pi/2", "pi/3"],
            ["0", "-pi/2", "pi"],
        ] {
            let frame = Frame {
                position: ["1", "-2/3", "sqrt(2)"].map(number),
                roll_pitch_yaw: rpy.map(number),
            };
            let pose = ExactPose::of(&frame);
            assert_eq!(ExactPose::of(&pose.frame().unwrap()), pose, "{rpy:?}");
            assert_eq!(pose.then(&pose.inverse()), ExactPose::identity(), "{rpy:?}");
        }
    }

    #[test]
    fn turns_are_right_handed() {
        let z = [Number::zero(), Number::zero(), Number::one()];
        let x = [Number::one(), Number::zero(), Number::zero()];
        let y = [Number::zero(), Number::one(), Number::zero()];
        let quarter = ExactPose::turn(&z, &number("pi/2"));
        assert_eq!(quarter.rotate(&x), y);
        let about_x = ExactPose::turn(&x, &number("pi/2"));
        assert_eq!(about_x.rotate(&y), z);
    }
}
