#!/usr/bin/env bash
# neura-dual-quaternions 0.0.4: its screw interpolation leaves the screw, cuts the arc of a door, and turns by 270 degrees for 90.
#
# ScLERP is the interpolation along the screw between two poses; that it turns and advances along one axis is what dual quaternions are used for.
# DualQuaternion.sclerp interpolates the positions along a straight line and turns meanwhile. A door on a hinge 1 m away, opened by 90
# degrees, is 0.71 m from its hinge half way. power() of the same class is right, and half the motion made twice is the whole. The two dual quaternions
# of the end pose, q and -q, are one pose; for -q the door turns the other way round, by 270 degrees. And Quaternion.exp_dot, the
# derivative of exp, has one of its twelve entries wrong, the z part by y, so that a solver that uses it is led astray.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check neura-dual-quaternions==0.0.4 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import numpy
from neura_dual_quaternions import DualQuaternion, Quaternion

HINGE = numpy.array([1.0, 0.0, 0.0])


def opened(angle):
    """The pose of a door that is turned about the vertical through the hinge."""
    pose = numpy.eye(4)
    pose[:2, :2] = [[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]]
    pose[:3, 3] = HINGE - pose[:3, :3] @ HINGE
    return pose


def seen(name, motion):
    pose = motion.asTransformation()
    hinge = float(numpy.linalg.norm(pose[:3, 3] - HINGE))
    angle = math.degrees(math.atan2(pose[1, 0], pose[0, 0]))
    print(f"{name}: {hinge:.6f} m from the hinge, turned by {angle:.3f} degrees")
    return hinge, angle


print("neura-dual-quaternions", importlib.metadata.version("neura-dual-quaternions"))
start = DualQuaternion.fromTransformation(opened(0.0))
end = DualQuaternion.fromTransformation(opened(math.pi / 2))
other = DualQuaternion(end.real * -1.0, end.dual * -1.0)
found = [
    seen("sclerp, half way", DualQuaternion.sclerp(start, end, 0.5)),
    seen("sclerp to the same pose as -q, half way", DualQuaternion.sclerp(start, other, 0.5)),
    seen("power 0.5", end.power(0.5)),
]
same = numpy.allclose(end.asTransformation(), other.asTransformation())

at = numpy.array([0.3, -0.5, 0.7])
step = 1e-6
columns = []
for part in numpy.eye(3) * step:
    ahead, behind = (Quaternion.exp(Quaternion(0, *(at + sign * part))).asVector() for sign in (1, -1))
    columns.append(((ahead - behind) / (2 * step)).flatten())
wrong = numpy.argwhere(numpy.abs(Quaternion(0, *at).exp_dot() - numpy.array(columns).T) > 1e-6).tolist()
print("entries of exp_dot that are not the derivative (row, column):", wrong)
expected = [(math.sqrt(0.5), 45), (math.sqrt(0.5), -135), (1, 45)]
sys.exit(not (numpy.allclose(found, expected, atol=1e-6) and same and wrong == [[3, 1]]))
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
