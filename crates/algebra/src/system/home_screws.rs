//! The screws of joints at the drawn pose, in double precision: what they generate tells what a chain could do alone.

use super::PolynomialSystem;
use super::displacement::{Displacement, Factor, relative, values_at};
use super::field::Field;
use super::space::{
    Doubles, Pose, Vector, add, apply, cross, matrix, multiply, pose, rotation,
    rotation_of_quaternion, scale, vector,
};
use super::variables::Names;
use kutzbach_model::mechanism::{JointId, Mechanism};

impl PolynomialSystem {
    /// The screws (ω; v) of a joint's steps at the drawn pose, in the world: since then it has displaced its successor by
    /// a product of exponentials along them, a screw's turn and travel taken one by one. `None` where that pose is not
    /// known, or where the joint's values there cannot be told.
    pub(crate) fn screws_at_home(
        &self,
        mechanism: &Mechanism,
        joint: JointId,
    ) -> Option<Vec<[f64; 6]>> {
        let construction = &self.construction;
        let drawn = construction.drawn.as_ref()?;
        let (field, model) = (&construction.field, &construction.models[joint.0]);
        let doubles = Doubles(field);
        let ends = construction.ends[joint.0].map(|link| pose(&doubles, &drawn[link]));
        // Its variables by themselves: it need not have any in the system.
        let of_joint = mechanism.joint(joint);
        let own = Displacement::new(field, &mut Names::default(), of_joint, joint, model);
        let values = values_at(
            &doubles,
            field,
            model,
            &relative(&doubles, model, &ends[0], &ends[1]),
        )?;
        let frame = ends[0].then(&doubles, &pose(&doubles, &model.sides[0]));
        Some(screws(field, &own, frame, &values))
    }
}

/// The screws (ω; v) of a joint's steps in the world, given its frame and the values of its variables.
fn screws(
    field: &Field,
    displacement: &Displacement,
    frame: Pose<f64>,
    values: &[f64],
) -> Vec<[f64; 6]> {
    let doubles = Doubles(field);
    let value = |variable: usize| values.get(variable).copied().unwrap_or_default();
    let mut place = frame;
    let mut screws = Vec::new();
    let revolute = |place: &Pose<f64>, direction: &Vector<f64>| {
        let along = apply(&doubles, &place.rotation, direction);
        let moment = cross(&doubles, &place.translation, &along);
        [
            along[0], along[1], along[2], moment[0], moment[1], moment[2],
        ]
    };
    for factor in &displacement.factors {
        match factor {
            Factor::Constant(constant) => {
                place.rotation = multiply(&doubles, &place.rotation, &matrix(&doubles, constant));
            }
            Factor::Turn { axis, cosine, sine } => {
                screws.push(revolute(&place, &vector(&doubles, &axis.direction)));
                let turn = rotation(
                    &doubles,
                    &axis.direction,
                    &axis.inverse_square,
                    &value(*cosine),
                    &value(*sine),
                    field,
                );
                place.rotation = multiply(&doubles, &place.rotation, &turn);
            }
            Factor::Slide { along, way } => {
                let along = apply(&doubles, &place.rotation, &vector(&doubles, along));
                screws.push([0.0, 0.0, 0.0, along[0], along[1], along[2]]);
                let moved = scale(&doubles, &along, &value(*way));
                place.translation = add(&doubles, &place.translation, &moved);
            }
            Factor::Ball(q) => {
                for i in 0..3 {
                    let unit = [0, 1, 2].map(|j| f64::from(u8::from(i == j)));
                    screws.push(revolute(&place, &unit));
                }
                let turn = rotation_of_quaternion(&doubles, &q.map(value));
                place.rotation = multiply(&doubles, &place.rotation, &turn);
            }
        }
    }
    screws
}
