//! Where joints stand at a solution.

use super::PolynomialSystem;
use super::displacement::Factor;
use super::space::{
    Doubles, Pose, add, apply, matrix, multiply, rotation, rotation_of_quaternion, scale, vector,
};
use kutzbach_math::space::Rigid;
use kutzbach_model::mechanism::JointId;

impl PolynomialSystem {
    /// The displacement of a joint, `predecessor_frame -> successor_frame` (m), where the variables have these values; to double
    /// precision. `None` for joints without variables of their own: those that the form leaves out, and those of a common line.
    #[must_use]
    pub fn joint_pose(&self, joint: JointId, values: &[f64]) -> Option<Rigid<f64>> {
        let construction = &self.construction;
        let model = construction.models.get(joint.0)?;
        let displacement = construction.displacements.get(joint.0)?;
        let fixed = model.kind.freedom() == 0;
        if construction.linear[joint.0].is_some() || displacement.factors.is_empty() && !fixed {
            return None;
        }
        let field = &construction.field;
        let doubles = Doubles(field);
        let mut place = Pose::identity(&doubles);
        for factor in &displacement.factors {
            let turn = match factor {
                Factor::Slide { along, way } => {
                    let moved = scale(&doubles, &vector(&doubles, along), values.get(*way)?);
                    let moved = apply(&doubles, &place.rotation, &moved);
                    place.translation = add(&doubles, &place.translation, &moved);
                    continue;
                }
                Factor::Constant(constant) => matrix(&doubles, constant),
                Factor::Turn { axis, cosine, sine } => {
                    let (c, s) = (values.get(*cosine)?, values.get(*sine)?);
                    rotation(&doubles, &axis.direction, &axis.inverse_square, c, s, field)
                }
                Factor::Ball(variables) => {
                    let mut q = [0.0; 4];
                    for (component, variable) in q.iter_mut().zip(variables) {
                        *component = *values.get(*variable)?;
                    }
                    let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
                    rotation_of_quaternion(&doubles, &q.map(|x| x / length))
                }
            };
            place.rotation = multiply(&doubles, &place.rotation, &turn);
        }
        Some(Rigid {
            rotation: place.rotation,
            translation: place.translation,
        })
    }
}
