#!/usr/bin/env bash
# robotics-numpy 0.1.0: roll, pitch and yaw read from a rotation with a pitch of 90 degrees are those of another rotation.
#
# Where two of the three axes fall together only the sum or the difference of two angles is given, and a reader sets one of them to 0. r2rpy takes the
# right combination for a pitch of -90 degrees and the wrong one for +90: written back, the angles it returns are up to 180 degrees off. r2eul
# does so for a middle angle of 180 degrees. Everywhere else both give back the rotation.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check robotics-numpy==0.1.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import numpy
from robotics_numpy.transforms.rotations import eul2r, r2eul, r2rpy, rpy2r


def apart(one, other):
    """The angle between two rotations in degrees."""
    return math.degrees(2 * math.asin(min(1, numpy.linalg.norm(one - other) / math.sqrt(8))))


right = True
quarter = math.pi / 2
for name, angles, there, back, expected in (
    ("rpy", (0.3, 1.5, 0.5), rpy2r, r2rpy, 0),
    ("rpy", (0.3, -quarter, 0.5), rpy2r, r2rpy, 0),
    ("rpy", (0.3, quarter, 0.5), rpy2r, r2rpy, None),
    ("rpy", (0.0, quarter, quarter), rpy2r, r2rpy, 180),
    ("euler", (0.3, 1.5, 0.5), eul2r, r2eul, 0),
    ("euler", (0.3, 0.0, 0.5), eul2r, r2eul, 0),
    ("euler", (0.3, math.pi, 0.5), eul2r, r2eul, None),
):
    rotation = there(*angles)
    read = back(rotation)
    off = apart(there(*read), rotation)
    print(name, *(f"{angle:.3f}" for angle in angles), "read as", *(f"{angle:.3f}" for angle in read), f": {off:.2f} degrees off")
    right &= off > 1 if expected is None else abs(off - expected) < 1e-3
print("robotics-numpy", importlib.metadata.version("robotics-numpy"))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
