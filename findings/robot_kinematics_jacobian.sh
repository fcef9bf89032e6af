#!/usr/bin/env bash
# robot-kinematics 1.1.0: by its Jacobian the last joint of an arm moves nothing; its modified DH parameters are the standard ones.
#
# get_joint_transform multiplies the DH matrix of the joint itself too, and the Jacobian takes the axis and place of a joint from there: those of the next
# joint. A stretched arm of two links of 1 m, whose tip moves with 2 and 1 m/s at 1 rad/s of either joint, gets 1 and 0 m/s; the vertical first
# axis of an UR5 is horizontal. The inverse velocity with a damping multiplies by (J J^T + damping) where it should by its inverse:
# with next to no damping it is not what it is with none. ModifiedDHKinematics, for Craig's convention, puts a row's a and alpha behind
# its turn, which is the other convention: a hinge that stands at (1, 0, 0) carries that point round the origin.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m pip install --quiet --disable-pip-version-check --root-user-action ignore --target "$folder/packages" \
  numpy==2.4.6 scipy==1.17.1 matplotlib==3.11.2
python3 -m pip install --quiet --disable-pip-version-check --root-user-action ignore --target "$folder/packages" --no-deps robot-kinematics==1.1.0
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import numpy
from robot_kinematics.forward.dh_kinematics import DHKinematics, ModifiedDHKinematics, create_ur5_kinematics


def arm(kind, rows, name="dh_parameters"):
    return kind({"n_joints": len(rows), "joint_types": ["revolute"] * len(rows), "joint_limits": [(-4, 4)] * len(rows), name: rows})


def differences(robot, joints, joint, step=1e-6):
    """Velocity of the tip at 1 rad/s of a joint, from its poses."""
    ends = [robot.forward_kinematics(numpy.array(joints) + sign * step * numpy.eye(len(joints))[joint]).position for sign in (1, -1)]
    return (ends[0] - ends[1]) / (2 * step)


planar, right = arm(DHKinematics, [{"a": 1.0}, {"a": 1.0}]), True
for joint, is_, true in ((0, 1, 2), (1, 0, 1)):
    said = planar.velocity_kinematics([0.0, 0.0], numpy.eye(2)[joint])[:3]
    seen = differences(planar, [0.0, 0.0], joint)
    print(f"stretched arm, joint {joint + 1} at 1 rad/s: tip at {said[1]:.4f} m/s by the Jacobian, {seen[1]:.4f} m/s by its poses")
    right &= abs(said[1] - is_) < 1e-9 and abs(seen[1] - true) < 1e-6
axis = create_ur5_kinematics().velocity_kinematics([0.0] * 6, numpy.eye(6)[0])[3:]
print("UR5, first joint at 1 rad/s: angular velocity", numpy.round(axis, 6) + 0.0)
bent = [0.3, 0.8]
target = planar.velocity_kinematics(bent, numpy.array([0.1, 0.2]))
plain = planar.inverse_velocity_kinematics(bent, target)
damped = planar.inverse_velocity_kinematics(bent, target, damping=1e-12)
print("inverse velocity with damping 0:", numpy.round(plain, 6), "- with 1e-12:", numpy.round(damped, 6))
hinge = arm(ModifiedDHKinematics, [{"a": 1.0}], "modified_dh_parameters")
place = hinge.forward_kinematics([math.pi / 2]).position
print("modified DH, a = 1, turned by 90 degrees: at", numpy.round(place, 6) + 0.0)
print("robot-kinematics", importlib.metadata.version("robot-kinematics"))
sys.exit(not (
    right and numpy.allclose(axis, [0, -1, 0]) and numpy.allclose(plain, [0.1, 0.2]) and not numpy.allclose(damped, plain, atol=1e-2)
    and numpy.allclose(place, [0, 1, 0])))
PYTHON
PYTHONPATH="$folder/packages" python3 "$folder/try.py"
