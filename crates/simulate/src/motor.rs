//! Motors: drives, dry friction and damping alike.
//!
//! Each is a joint of its own that locks nothing, so that what holds a joint and what moves it stay apart, and every freedom
//! can be reached in its own axes whichever way its joint is held.

use super::build::Built;
use super::elementary::Handle;
use super::units::Units;
use rapier3d_f64::prelude::{GenericJoint, JointAxesMask, JointAxis, MotorModel};

/// A motor so stiff that only its largest force gives way: the engine's gain is 1/(step × this), far below rounding.
const STIFF: f64 = 1e20;

/// A largest force that nothing in the range of numbers reaches; the engine multiplies it by a step.
const UNLIMITED: f64 = 1e30;

/// How a motor reacts.
#[derive(Clone, Copy, Debug)]
pub(super) enum Gain {
    /// As hard as it takes, up to a largest force (N, N m).
    Stiff { largest: f64 },
    /// By a force for each unit of rate (N s/m, N m s).
    Viscous { damping: f64 },
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Motor {
    /// rad/s, m/s.
    pub velocity: f64,
    pub gain: Gain,
}

/// A joint that locks nothing and has a motor on one axis.
pub(super) fn motor_joint(
    built: &Built,
    units: &Units,
    handle: &Handle,
    motor: Motor,
) -> GenericJoint {
    const AXES: [JointAxis; 6] = [
        JointAxis::LinX,
        JointAxis::LinY,
        JointAxis::LinZ,
        JointAxis::AngX,
        JointAxis::AngY,
        JointAxis::AngZ,
    ];
    let mut joint = GenericJoint::new(JointAxesMask::empty());
    joint.contacts_enabled = true;
    let [a, b] = built.frames(units, handle.bodies, &handle.frames);
    joint.set_local_frame1(a).set_local_frame2(b);
    let axis = AXES[handle.axis.min(5)];
    let velocity = handle.sign * motor.velocity / units.travel(handle.axis);
    match motor.gain {
        Gain::Stiff { largest } => {
            joint.set_motor_model(axis, MotorModel::AccelerationBased);
            joint.set_motor_velocity(axis, velocity, STIFF);
            let largest = (largest / units.effort(handle.axis)).min(UNLIMITED);
            joint.set_motor_max_force(axis, largest);
        }
        Gain::Viscous { damping } => {
            joint.set_motor_model(axis, MotorModel::ForceBased);
            joint.set_motor_velocity(axis, velocity, damping / units.damping(handle.axis));
            joint.set_motor_max_force(axis, UNLIMITED);
        }
    }
    joint
}
