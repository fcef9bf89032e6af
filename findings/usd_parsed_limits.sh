#!/usr/bin/env bash
# usd-core 26.11: a limit on one side counts for a slide and not for a hinge or a ball, in UsdPhysics' own reading of joints.
#
# In UsdPhysics a bound that is left out is none, in that direction: -inf or inf of hinges and slides, -1 of cone angles.
# LoadUsdPhysicsFromRange, which gives simulators the joints as records, keeps the numbers and says in "enabled" whether there is a
# limit. Of a prismatic joint either bound is enough; a revolute joint needs both. A hinge with an upper limit of 60 degrees is "not limited",
# with 60 beside it; so is a ball with one of its two cone angles. The positions of joints it gives in scaled units: localPos1 of 1 in a body of
# scale 2 is 2.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check usd-core==26.11
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
from pxr import Usd, UsdPhysics

text = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "robot"
{
    def Xform "base" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI"]
    )
    {
    }
    def Xform "arm" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI"]
    )
    {
        double3 xformOp:scale = (2, 2, 2)
        uniform token[] xformOpOrder = ["xformOp:scale"]
    }
    def PhysicsKINDJoint "joint"
    {
        rel physics:body0 = </robot/base>
        rel physics:body1 = </robot/arm>
        point3f physics:localPos1 = (1, 0, 0)
        LIMITS
    }
}
"""


def parse(kind, **limits):
    stage = Usd.Stage.CreateInMemory()
    lines = "\n        ".join(f"float physics:{name} = {value}" for name, value in limits.items())
    stage.GetRootLayer().ImportFromString(text.replace("KIND", kind).replace("LIMITS", lines))
    for _, (_, records) in UsdPhysics.LoadUsdPhysicsFromRange(stage, ["/"]).items():
        for record in records:
            if hasattr(record, "localPose1Position"):
                return record.limit.enabled, record.limit.lower, record.limit.upper, record.localPose1Position[0]


endless = float("inf")
right = True
for kind, limits, expected in (
    ("Revolute", {"lowerLimit": -30, "upperLimit": 60}, (True, -30, 60, 2)),
    ("Revolute", {"upperLimit": 60}, (False, -endless, 60, 2)),
    ("Revolute", {"lowerLimit": -30}, (False, -30, endless, 2)),
    ("Prismatic", {"upperLimit": 60}, (True, -endless, 60, 2)),
    ("Prismatic", {"lowerLimit": -30}, (True, -30, endless, 2)),
    ("Spherical", {"coneAngle0Limit": 30, "coneAngle1Limit": 40}, (True, 30, 40, 2)),
    ("Spherical", {"coneAngle0Limit": 30}, (False, 30, -1, 2)),
):
    seen = parse(kind, **limits)
    print(f"{kind} {limits}: enabled {seen[0]}, {seen[1]} to {seen[2]}; position in the arm {seen[3]}")
    right &= seen == expected
print("usd-core", importlib.metadata.version("usd-core"))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" -W ignore "$folder/try.py"
