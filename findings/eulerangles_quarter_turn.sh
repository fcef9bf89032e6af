#!/usr/bin/env bash
# eulerangles 1.0.2: a quarter turn about z, written as angles and read again, is no turn at all: yaw 90 comes back as 0.
#
# Where the middle of three angles makes the two outer axes fall together, one of the outer ones is set to 0. matrix2euler looks for that case at an entry
# of the matrix that is a product of two cosines or sines, and takes a yaw of 90 or -90 degrees at any pitch for it: for zyx the entry is cos(pitch) * cos(yaw).
# The angles that come back are those of another rotation, here by 10 to 140 degrees. All twelve orders do so, each at a quarter turn or a half
# turn of an outer angle, with moving axes as with fixed ones; one degree beside it the angles are right. convert_eulers and euler2euler are built on it.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m pip install --quiet --disable-pip-version-check --root-user-action ignore --target "$folder/packages" --no-deps eulerangles==1.0.2 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import numpy
from eulerangles import euler2matrix, matrix2euler

CONVENTION = {"intrinsic": True, "right_handed_rotation": True}


def off(axes, angles):
    """The angles that come back, and the angle in degrees between the two rotations."""
    rotation = euler2matrix(numpy.array(angles, dtype=float), axes=axes, **CONVENTION)
    read = matrix2euler(rotation, axes=axes, **CONVENTION)
    again = euler2matrix(read, axes=axes, **CONVENTION)
    return read, math.degrees(2 * math.asin(min(1, numpy.linalg.norm(again - rotation) / math.sqrt(8))))


right = True
for angles, expected in (((90, 0, 0), 90), ((89, 0, 0), 0), ((90, 20, 30), None), ((-90, 20, 30), None), ((91, 20, 30), 0)):
    read, apart = off("zyx", angles)
    print("yaw, pitch, roll", angles, "read as", numpy.round(read, 4) + 0.0, f": {apart:.2f} degrees off")
    right &= apart > 50 if expected is None else abs(apart - expected) < 1e-4
worst = {}
for axes in ("xyz", "xzy", "yxz", "yzx", "zxy", "zyx", "xyx", "xzx", "yxy", "yzy", "zxz", "zyz"):
    cases = {
        angles: off(axes, angles)[1]
        for outer in (0, 90, -90, 180) for other in (0, 30) for angles in ((outer, 20, other), (other, 20, outer))}
    worst[axes] = max(cases.values())
    beside = max(off(axes, (first + 1, 20, last + 1))[1] for first, _, last in cases)
    right &= worst[axes] > 10 and beside < 1e-4
print("middle angle 20: off by up to", {axes: round(value, 1) for axes, value in worst.items()})
print("eulerangles", importlib.metadata.version("eulerangles"))
sys.exit(not right)
PYTHON
PYTHONPATH="$folder/packages" python3 "$folder/try.py"
