//! The numbers of one joint as doubles that can be changed, and a geometry that follows them.

use super::displacement::JointDisplacement;
use super::geometry::Geometry;
use kutzbach_math::number::Number;
use kutzbach_math::space::{Rigid, Vector, three};
use kutzbach_model::mechanism::Joint;
use std::f64::consts::TAU;

/// Place of a joint's lead among its numbers; behind it stands the distance.
const LEAD: usize = 18;

/// The [numbers of a joint](Joint::numbers) in their order. What a joint does not have is zero.
#[derive(Clone, Debug, PartialEq)]
pub struct JointNumbers(pub [f64; Joint::NUMBERS]);

impl JointNumbers {
    /// The numbers as the file has them.
    #[must_use]
    pub fn of(joint: &Joint) -> Self {
        let mut values = [0.0; Joint::NUMBERS];
        for (value, number) in values.iter_mut().zip(joint.numbers()) {
            *value = number.map_or(0.0, Number::value);
        }
        Self(values)
    }

    fn vector(&self, first: usize) -> Vector<f64> {
        three(|i| self.0[first + i])
    }

    /// `link_from_joint` of one side.
    fn frame(&self, first: usize) -> Rigid<f64> {
        let mut pose = Rigid::translation(self.vector(first));
        for axis in [2, 1, 0] {
            let angle = self.0[first + 3 + axis];
            if angle == 0.0 {
                continue;
            }
            let mut direction = [0.0; 3];
            direction[axis] = 1.0;
            let (sine, cosine) = angle.sin_cos();
            pose = pose.compose(&Rigid::rotation(&direction, &cosine, &sine));
        }
        pose
    }
}

impl Geometry<f64> {
    /// Gives a joint other numbers. Its state in [`Geometry::states`] and the poses of links stay as they were; a distance that the
    /// file does not state stays what was measured.
    pub fn set_joint(&mut self, joint: usize, like: &Joint, numbers: &JointNumbers) {
        self.sides[joint] = [numbers.frame(0), numbers.frame(6)];
        let distance = match like.distance {
            Some(_) => numbers.0[LEAD + 1],
            None => *self.displacements[joint].distance(),
        };
        self.displacements[joint] = JointDisplacement::new(
            like.kind,
            &numbers.vector(12),
            &numbers.vector(15),
            &(numbers.0[LEAD] / TAU),
            &distance,
        );
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::geometry::Arithmetic;
    use super::super::samples::{Place, Written, ring};
    use super::*;
    use kutzbach_model::mechanism::JointKind;

    #[test]
    fn the_files_own_numbers_give_the_files_own_geometry() {
        let places: Vec<Place> = vec![
            (JointKind::Revolute, [0.0, 0.0, 0.0], [0.0, 0.5, 1.0]),
            (JointKind::Spherical, [1.0, 0.5, 0.0], [1.0, 0.0, 0.0]),
            (JointKind::Screw, [2.0, -1.0, 0.0], [0.0, 1.0, 1.0]),
            (JointKind::Universal, [1.0, -2.0, 0.0], [0.5, 1.0, 0.0]),
        ];
        let mechanism = ring(&places, [0.0; 3], Written::Decimals(6));
        let known = Geometry::new(&mechanism, None, &Arithmetic::double());
        let mut set = known.clone();
        for (index, joint) in mechanism.joints().iter().enumerate() {
            set.set_joint(index, joint, &JointNumbers::of(joint));
            for (a, b) in known.sides[index].iter().zip(&set.sides[index]) {
                for i in 0..3 {
                    assert!((a.translation[i] - b.translation[i]).abs() < 1e-15);
                    for k in 0..3 {
                        assert!((a.rotation[i][k] - b.rotation[i][k]).abs() < 1e-15);
                    }
                }
            }
            let (a, b) = (&known.displacements[index], &set.displacements[index]);
            assert_eq!(a.axis(), b.axis());
            assert!((a.distance() - b.distance()).abs() < 1e-15);
        }
    }
}
