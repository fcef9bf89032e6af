//! The scissor lift.

use super::{along, at};
use kutzbach_model::mechanism::{
    JointBuilder, JointKind, Mechanism, MechanismBuilder, MechanismError,
};

/// Half the width and half the height of a stage in hundredths of a metre: bars of two metres, a 3-4-5 triangle.
const HALF_WIDTH: i64 = 80;
const HALF_HEIGHT: i64 = 60;

/// A scissor lift of `stages` crossed pairs between a ground rail and a top platform, each with a pin and a slider.
///
/// ```text
///   pin o========[]  platform, slider        2 stages + 4 links
///        \\    //                            3 stages + 4 joints
///          \\//                              stages + 1 loops
///          //\\
///        //    \\
///   pin o========[]  ground, slider
/// ```
///
/// One finite freedom whatever the number of stages; Kutzbach counts `1 − 3 (stages + 1)`.
///
/// # Errors
/// None in practice: the mechanism is valid for any number of stages, 0 counted as 1.
pub fn scissor_lift(stages: usize) -> Result<Mechanism, MechanismError> {
    let stages = stages.max(1);
    let (w, h) = (HALF_WIDTH, HALF_HEIGHT);
    let revolute = |name: &str, parent: &str, child: &str| {
        JointBuilder::tree(name, JointKind::Revolute, parent, child).axis(along(0, 0, 1))
    };
    let closing = |name: &str, predecessor: &str, successor: &str| {
        JointBuilder::closing(name, JointKind::Revolute, predecessor, successor)
            .axis(along(0, 0, 1))
    };
    let slider = |name: &str, parent: &str, child: &str| {
        JointBuilder::tree(name, JointKind::Prismatic, parent, child).axis(along(1, 0, 0))
    };
    let rising = |stage: usize| format!("rising_{stage}");
    let falling = |stage: usize| format!("falling_{stage}");
    let mut builder = MechanismBuilder::new(&format!("scissor_lift_{stages}"));
    builder.link("ground").link("lower_slider");
    builder.joint(slider("lower_slide", "ground", "lower_slider").origin(at(2 * w, 0, 0)));
    for stage in 0..stages {
        builder.link(&rising(stage)).link(&falling(stage));
        // The rising bar's frame is at its lower end, the falling bar's at the crossing.
        if stage == 0 {
            builder.joint(revolute("lower_pin", "ground", &rising(0)));
            builder.joint(
                closing("lower_slider_pin", "lower_slider", &falling(0))
                    .successor_origin(at(w, -h, 0)),
            );
        } else {
            let below = stage - 1;
            builder.joint(
                revolute(&format!("left_{stage}"), &falling(below), &rising(stage))
                    .origin(at(-w, h, 0)),
            );
            builder.joint(
                closing(&format!("right_{stage}"), &rising(below), &falling(stage))
                    .origin(at(2 * w, 2 * h, 0))
                    .successor_origin(at(w, -h, 0)),
            );
        }
        builder.joint(
            revolute(&format!("cross_{stage}"), &rising(stage), &falling(stage))
                .origin(at(w, h, 0)),
        );
    }
    let top = stages - 1;
    builder.link("platform").link("upper_slider");
    builder.joint(revolute("upper_pin", &falling(top), "platform").origin(at(-w, h, 0)));
    builder.joint(slider("upper_slide", "platform", "upper_slider").origin(at(2 * w, 0, 0)));
    builder.joint(
        closing("upper_slider_pin", &rising(top), "upper_slider").origin(at(2 * w, 2 * h, 0)),
    );
    builder.build()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::{AnalysisOptions, analyse};

    #[test]
    fn size_and_counts_follow_the_number_of_stages() {
        for stages in [1, 3, 20] {
            let lift = scissor_lift(stages).unwrap();
            assert_eq!(lift.links().len(), 2 * stages + 4);
            assert_eq!(lift.joints().len(), 3 * stages + 4);
            let analysis = analyse(&lift, &AnalysisOptions::default()).unwrap();
            assert_eq!(analysis.kutzbach, 1 - 3 * (stages as i64 + 1));
            assert_eq!(analysis.home.unwrap().instantaneous, Some(1));
        }
    }
}
