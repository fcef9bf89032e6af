#!/usr/bin/env bash
# spatialmath-python 1.1.18: the pole of a screw lies on its axis only if it turns by one radian.
#
# Twist3.pole is "a point on the twist axis". A quarter turn about the vertical through (3, 4, 0) gives a twist with the pole (4.7, 6.3, 0):
# the point comes out multiplied by the angle, 1.57. The line of the same twist, from line(), does pass through (3, 4, 0), and the pitch
# is right. A unit twist made from axis and point has the right pole, so that the error shows first with twists of poses that were measured.
# The pitch of a slide is nan, with a warning.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check spatialmath-python==1.1.18 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import numpy
from spatialmath import Twist3

screw = Twist3.UnitRevolute([0, 0, 1], [3, 4, 0], pitch=0.2)
right = True
for angle in (0.5, 1.0, math.pi / 2):
    twist = screw.exp(angle).twist()
    on_line = bool(twist.line().contains([3, 4, 0]))
    print(f"{angle:.4f} rad about z through (3, 4, 0): pole {numpy.round(twist.pole, 4)}, line through (3, 4, 0): {on_line}, pitch {twist.pitch:.4f}")
    right &= on_line and numpy.allclose(twist.pole, [3 * angle, 4 * angle, 0]) and math.isclose(twist.pitch, 0.2)
slide = Twist3.UnitPrismatic([0, 0, 1])
print("pitch of a slide:", slide.pitch)
print("spatialmath-python", importlib.metadata.version("spatialmath-python"))
sys.exit(not (right and math.isnan(slide.pitch)))
PYTHON
"$folder/venv/bin/python" -W ignore "$folder/try.py"
