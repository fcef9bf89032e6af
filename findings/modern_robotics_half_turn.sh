#!/usr/bin/env bash
# modern-robotics 1.1.1: a half turn has the logarithm of no turn, and inverse kinematics reports success half a turn away from what was asked.
#
# MatrixLog3 divides R - R^T by the sine of the angle, and knows half turns by a trace of exactly -1. Where rounding leaves the trace an ulp above
# (as it does about 1 1 3, 3 1 1 or 3 5 3), R is still symmetric and the answer is 0 0 0 for an angle of pi. MatrixLog6 follows, the screw trajectory
# to such a pose stands still at its start, and IKinSpace and IKinBody, asked for it from a guess half a turn away, stop at the guess with success
# True at any tolerance: the error they measure is 0. About 1 2 3 and from other guesses all is well.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check modern-robotics==1.1.1 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import modern_robotics
import numpy

# A spherical wrist: turns about z, y and z, in one point.
screws = numpy.array([[0, 0, 1, 0, 0, 0], [0, 1, 0, 0, 0, 0], [0, 0, 1, 0, 0, 0]], dtype=float).T
home = numpy.eye(4)


def apart(one, other):
    """The angle between two rotations in degrees, from the length of their difference."""
    return math.degrees(2 * math.asin(min(1, numpy.linalg.norm(one - other) / math.sqrt(8))))


right = True
for axis, lost in (((1, 2, 3), False), ((1, 1, 3), True), ((3, 1, 1), True), ((3, 5, 3), True)):
    direction = numpy.array(axis, dtype=float)
    pose = numpy.eye(4)
    pose[:3, :3] = 2 * numpy.outer(direction, direction) / (direction @ direction) - numpy.eye(3)
    turn = numpy.linalg.norm(modern_robotics.so3ToVec(modern_robotics.MatrixLog3(pose[:3, :3])))
    print(f"half turn about {axis}: angle of the logarithm {turn:.4f}")
    right &= bool(abs(turn - (0 if lost else math.pi)) < 1e-6)
    for solve in (modern_robotics.IKinSpace, modern_robotics.IKinBody):
        # The space and the body frame coincide at home, so the screws are the same in both.
        angles, success = solve(screws, home, pose, [0.0, 0.0, 0.0], 1e-6, 1e-6)
        error = apart(modern_robotics.FKinSpace(home, screws, angles)[:3, :3], pose[:3, :3])
        print(f"  {solve.__name__} from 0 0 0: success {success}, {error:.3f} degrees from the pose")
        right &= bool(success) and abs(error - (180 if lost else 0)) < 1e-2
    end = modern_robotics.ScrewTrajectory(home, pose, 1, 3, 3)[-1]
    error = apart(end[:3, :3], pose[:3, :3])
    print(f"  ScrewTrajectory ends {error:.3f} degrees from the pose")
    right &= abs(error - (180 if lost else 0)) < 1e-2
print("modern-robotics", importlib.metadata.version("modern-robotics"))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
