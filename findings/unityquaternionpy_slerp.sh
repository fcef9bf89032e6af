#!/usr/bin/env bash
# UnityQuaternionPy 0.1.2: a quarter of the way along a turn of 90 degrees is 12 degrees, and a turn of -90 degrees is begun the other way.
#
# The class follows UnityEngine.Quaternion, whose Slerp turns at a constant speed and the short way round, and whose RotateTowards turns by a number of degrees.
# Here Slerp bends the ratio by a cosine, as one eases a motion in and out, and then interpolates along the chord: 12.4 degrees of 90 at 0.25, where it is
# 22.5, with the middle and the ends right. RotateTowards takes its step along the chord: 9.3 degrees for 10. Neither looks for the short way: towards
# 270 degrees, which is a turn by -90, a step of 10 degrees goes 3.2 the wrong way, and half of a Slerp is at 135 and not at -45.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m pip install --quiet --disable-pip-version-check --root-user-action ignore --target "$folder/packages" UnityQuaternionPy==0.1.2
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
from UnityQuaternion import Quaternion

START = Quaternion(0, 0, 0, 1)


def turned(quaternion):
    """The angle about y in degrees, between -180 and 180."""
    angle = 2 * math.degrees(math.atan2(quaternion.y, quaternion.w))
    return (angle + 180) % 360 - 180


right = True
for name, end, found, unity, expected in (
    ("Slerp at 0.25", 90, lambda end: Quaternion.Slerp(START, end, 0.25), 22.5, 12.35),
    ("Slerp at 0.5", 90, lambda end: Quaternion.Slerp(START, end, 0.5), 45, 45),
    ("RotateTowards by 10", 90, lambda end: Quaternion.RotateTowards(START, end, 10), 10, 9.286),
    ("Slerp at 0.5", 270, lambda end: Quaternion.Slerp(START, end, 0.5), -45, 135),
    ("RotateTowards by 10", 270, lambda end: Quaternion.RotateTowards(START, end, 10), -10, 3.203),
):
    angle = turned(found(Quaternion.Euler(0, end, 0)))
    print(f"from 0 to {end} degrees, {name}: {angle:.3f}, in Unity {unity}")
    right &= abs(angle - expected) < 2e-3
print("UnityQuaternionPy", importlib.metadata.version("UnityQuaternionPy"))
sys.exit(not right)
PYTHON
PYTHONPATH="$folder/packages" python3 "$folder/try.py"
