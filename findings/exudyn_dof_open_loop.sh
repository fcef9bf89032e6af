#!/usr/bin/env bash
# exudyn 1.13.6: bars that cannot form a loop have one degree of freedom, and so has a rigid triangle, as long as they are drawn in one line.
#
# MainSystem.ComputeSystemDegreeOfFreedom ranks the constraints where the bodies stand in the reference configuration, and does not ask whether
# the constraints hold there. Two bars of 1 that lie in one line between pins 1.5 apart (a triangle, which cannot move) and 3 apart (no
# loop at all) get 1 degree of freedom, as do pins 2 apart, where the bars fit and are stuck. Drawn as it closes, the triangle has 0. No
# gap is reported by Assemble or by the count. The solver of the dynamics fails for the two that do not fit.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check exudyn==1.13.6 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import exudyn
from exudyn.utilities import InertiaCuboid, MarkerBodyRigid, ObjectJointRevoluteZ, RotationMatrixZ


def count(base, lift):
    """Two bars of 1 from the pin at 0 on: drawn with the middle pin lifted by an angle, the last pin at `base`."""
    system = exudyn.SystemContainer().AddSystem()
    ground = system.CreateGround()
    inertia = InertiaCuboid(1000, [1, 0.1, 0.1])
    x, y = math.cos(lift), math.sin(lift)
    first = system.CreateRigidBody(
        inertia=inertia, referencePosition=[x / 2, y / 2, 0], referenceRotationMatrix=RotationMatrixZ(lift))
    second = system.CreateRigidBody(
        inertia=inertia, referencePosition=[1.5 * x, y / 2, 0], referenceRotationMatrix=RotationMatrixZ(-lift))
    ends = ((ground, 0, first, -0.5), (first, 0.5, second, -0.5), (second, 0.5, ground, base))
    for one, at, other, there in ends:
        markers = [system.AddMarker(MarkerBodyRigid(bodyNumber=body, localPosition=[place, 0, 0]))
                   for body, place in ((one, at), (other, there))]
        system.AddObject(ObjectJointRevoluteZ(markerNumbers=markers))
    system.Assemble()
    found = system.ComputeSystemDegreeOfFreedom()
    return int(found["degreeOfFreedom"]), int(found["redundantConstraints"])


cases = (
    ("pins 1.5 apart, bars drawn as they close", 1.5, math.acos(0.75), (0, 3)),
    ("pins 1.5 apart, bars drawn in one line", 1.5, 0.0, (1, 4)),
    ("pins 2 apart, in one line", 2.0, 0.0, (1, 4)),
    ("pins 3 apart, in one line", 3.0, 0.0, (1, 4)),
)
right = True
for name, base, lift, expected in cases:
    seen = count(base, lift)
    print(f"{name}: degrees of freedom {seen[0]}, redundant constraints {seen[1]}")
    right &= seen == expected
print("exudyn", importlib.metadata.version("exudyn"))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" 2> "$folder/said" || { cat "$folder/said"; exit 1; }
