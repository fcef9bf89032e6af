#!/usr/bin/env bash
# UnityQuaternionPy 0.1.2: what looks straight down is read as looking straight up, from 82 degrees on; to look straight ahead raises.
#
# The class follows UnityEngine.Quaternion, call by call. In Unity, Euler(90, 0, 0) tilts the view down and its eulerAngles are (90, 0, 0). Here they are
# (270, 0, 0), straight up: where the middle angle x nears 90 degrees its sign is lost. Nearer than a sine of 0.99, that is from 82 degrees on,
# x is set to the end of its range, so that 83 degrees down is 90 degrees up; below, angles come back. LookRotation((0, 0, 1)), which is the
# identity in Unity, is a division by zero, and so are FromToRotation of a direction to itself and ToAngleAxis of no turn.
# Angle of a rotation and its negative, the same rotation, is 360 degrees, where Unity has 0.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m pip install --quiet --disable-pip-version-check --root-user-action ignore --target "$folder/packages" UnityQuaternionPy==0.1.2
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
from UnityQuaternion import Quaternion

FORWARD = (0, 0, 1)


def near(one, other):
    return all(abs(a - b) < 1e-6 for a, b in zip(one, other))


right = True
for tilt, expected in ((80, 80), (83, 270), (90, 270), (-80, 280), (-83, 90), (-90, 90)):
    quaternion = Quaternion.Euler(tilt, 0, 0)
    view, angles = quaternion * FORWARD, quaternion.eulerAngles
    again = Quaternion.Euler(*angles) * FORWARD
    print(f"x = {tilt}: view to y = {view[1]:.4f}, angles ({', '.join(f'{angle:.4f}' for angle in angles)}), of which the view is to y = {again[1]:.4f}")
    right &= near(angles, (expected, 0, 0)) and (view[1] < 0) == (tilt > 0) and ((again[1] < 0) == (tilt > 0)) == (abs(tilt) == 80)
raised = []
for name, call in (
    ("LookRotation((0, 0, 1))", lambda: Quaternion.LookRotation(FORWARD)),
    ("FromToRotation((0, 0, 1), (0, 0, 1))", lambda: Quaternion.FromToRotation(FORWARD, FORWARD)),
    ("ToAngleAxis of the identity", lambda: Quaternion.identity().ToAngleAxis()),
):
    try:
        print(name, "is", call())
    except ZeroDivisionError as error:
        raised.append(name)
        print(name, "raises ZeroDivisionError:", error)
same = Quaternion.Angle(Quaternion(0, 0, 0, 1), Quaternion(0, 0, 0, -1))
print("Angle between q and -q:", same)
print("UnityQuaternionPy", importlib.metadata.version("UnityQuaternionPy"))
sys.exit(not (right and len(raised) == 3 and abs(same - 360) < 1e-9))
PYTHON
PYTHONPATH="$folder/packages" python3 "$folder/try.py"
