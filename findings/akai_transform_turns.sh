#!/usr/bin/env bash
# akai-transform 1.0.0: turns below 3.6 degrees are no turn, half turns about a diagonal have no axis, and -q turns 359 degrees for 1.
#
# tf3d converts between matrices, quaternions, axis and angle, and Rodrigues parameters. quat2rvec compares the scalar part with 0.9995, which is
# the cosine of half of 3.6 degrees, and answers all below with angle 0 about z: steps of a path, taken one by one, do not turn at all.
# For -q, the same rotation, it gives an angle near 360 degrees. rmat2rvec knows half turns about x, y and z; about any other axis, and within
# 0.005 degrees of it, the axis is 0 0 0, beside an angle of pi, and rmat2mrp makes no rotation of it. log_so3 and quat2log, of other modules of
# the same package, are right where these two are not. The "modified Rodrigues parameters" are 2 sin(a/2) times the axis, not tan(a/4).
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check akai-transform==1.0.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import numpy
from akai_transform import log_quat, se3, tf3d

axis = numpy.array([1.0, 2.0, 3.0]) / math.sqrt(14)
print("akai-transform", importlib.metadata.version("akai-transform"))
small = {}
for degrees in (1.0, 3.6, 3.7):
    quaternion = tf3d.rvec2quat(axis, math.radians(degrees))
    angles = [math.degrees(tf3d.quat2rvec(sign * quaternion)[1]) for sign in (1, -1)]
    logarithm = math.degrees(numpy.linalg.norm(log_quat.quat2log(quaternion)))
    small[degrees] = angles + [logarithm]
    print(f"{degrees} degrees: quat2rvec {angles[0]:.6f}, of -q {angles[1]:.6f}, quat2log {logarithm:.6f}")
half = []
for name, direction in (("x", numpy.array([1.0, 0.0, 0.0])), ("1 2 3", axis)):
    for angle in (math.pi, math.pi - 7e-5):
        matrix = tf3d.rvec2rmat(direction, angle)
        found, turned = tf3d.rmat2rvec(matrix)
        back = tf3d.mrp2rmat(tf3d.rmat2mrp(matrix))
        logarithm = se3.log_so3(matrix[:3, :3])
        half.append((float(numpy.linalg.norm(found)), numpy.allclose(back, matrix, atol=1e-3), numpy.allclose(numpy.abs(logarithm), angle * direction, atol=1e-6)))
        print(f"{math.degrees(angle):.3f} degrees about {name}: rmat2rvec {numpy.round(found, 6)} by {turned:.6f}, there and back as Rodrigues parameters {half[-1][1]}, log_so3 right {half[-1][2]}")
parameter = float(numpy.linalg.norm(tf3d.rvec2mrp(axis, 1.0)))
print(f"Rodrigues parameters of 1 rad have the length {parameter:.6f}; 2 sin(1/2) is {2 * math.sin(0.5):.6f}, tan(1/4) is {math.tan(0.25):.6f}")
sys.exit(not (
    numpy.allclose(small[1.0], [0, 359, 1]) and numpy.allclose(small[3.6], [0, 356.4, 3.6]) and numpy.allclose(small[3.7], [3.7, 356.3, 3.7])
    and half == [(1, True, True), (1, True, True), (0, False, True), (0, False, True)]
    and abs(parameter - 2 * math.sin(0.5)) < 1e-12
))
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
