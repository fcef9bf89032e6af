#!/usr/bin/env bash
# nvidia-srl-usd-to-urdf 1.0.3: a USD stage in centimetres becomes a URDF that is a hundred times too large.
#
# Lengths of a USD stage are in units of metersPerUnit, which is 0.01 where the stage does not say; URDF knows metres only. The
# converter writes the numbers as they are, the origins of joints and the travel of slides, whether the stage says 1, 0.01 or nothing:
# an arm of 100 cm is 100 m long. Angles are converted from degrees. Nothing is said of units.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check \
  nvidia-srl-usd-to-urdf==1.0.3 nvidia-srl-usd==2.0.0 usd-core==25.11 numpy==1.26.4
cat > "$folder/crane.usda" <<'USD'
#usda 1.0
(
    defaultPrim = "crane"
    UNIT
    upAxis = "Z"
)
def Xform "crane" (
    prepend apiSchemas = ["PhysicsArticulationRootAPI"]
)
{
    def Xform "mast" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI"]
    )
    {
    }
    def Xform "boom" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI"]
    )
    {
        double3 xformOp:translate = (100, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def PhysicsPrismaticJoint "lift"
    {
        rel physics:body0 = </crane/mast>
        rel physics:body1 = </crane/boom>
        uniform token physics:axis = "Z"
        point3f physics:localPos0 = (100, 0, 0)
        float physics:lowerLimit = 0
        float physics:upperLimit = 50
    }
}
USD
cat > "$folder/try.py" <<'PYTHON'
import sys
import xml.etree.ElementTree
from nvidia.srl.from_usd.to_urdf import UsdToUrdf
from pxr import Usd, UsdGeom

folder = sys.argv[1]
text = open(folder + "/crane.usda").read()
expected = True
for unit in ("metersPerUnit = 1", "metersPerUnit = 0.01", ""):
    path = f"{folder}/now{len(unit)}"
    open(path + ".usda", "w").write(text.replace("UNIT", unit))
    metres = UsdGeom.GetStageMetersPerUnit(Usd.Stage.Open(path + ".usda"))
    UsdToUrdf.init_from_file(path + ".usda").save_to_file(path + ".urdf")
    joint = xml.etree.ElementTree.parse(path + ".urdf").find("joint")
    origin = [float(x) for x in joint.find("origin").get("xyz").split()]
    travel = float(joint.find("limit").get("upper"))
    print(f"a unit of {metres} m: in URDF origin {origin} m, travel {travel} m; right {100 * metres} m and {50 * metres} m")
    expected &= origin == [100, 0, 0] and travel == 50 and metres == (1 if unit.endswith("1") and "0.01" not in unit else 0.01)
sys.exit(not expected)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder" 2> "$folder/log" || {
  tail -5 "$folder/log"
  exit 1
}
