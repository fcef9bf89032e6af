#!/usr/bin/env bash
# nvidia-srl-usd-to-urdf 1.0.3: spherical joints and joints with free axes become fixed, a joint that is switched off becomes active.
#
# URDF has no ball joint, so the converter can refuse or build it from hinges; a PhysicsJoint without limits holds nothing and is
# URDF's floating. Both come out as type="fixed", without a warning. A hinge with jointEnabled = false, which UsdPhysics
# takes for no joint, is an ordinary joint in the URDF.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check \
  nvidia-srl-usd-to-urdf==1.0.3 nvidia-srl-usd==2.0.0 usd-core==25.11 numpy==1.26.4
cat > "$folder/arm.usda" <<'USD'
#usda 1.0
(
    defaultPrim = "robot"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "robot" (
    prepend apiSchemas = ["PhysicsArticulationRootAPI"]
)
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
        double3 xformOp:translate = (1, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def PhysicsTYPE "joint"
    {
        rel physics:body0 = </robot/base>
        rel physics:body1 = </robot/arm>
        point3f physics:localPos0 = (1, 0, 0)
        MORE
    }
}
USD
cat > "$folder/try.py" <<'PYTHON'
import sys
import xml.etree.ElementTree
from nvidia.srl.from_usd.to_urdf import UsdToUrdf

folder = sys.argv[1]
text = open(folder + "/arm.usda").read()


def convert(kind, more=""):
    path = f"{folder}/{kind}{len(more)}"
    open(path + ".usda", "w").write(text.replace("TYPE", kind).replace("MORE", more))
    UsdToUrdf.init_from_file(path + ".usda").save_to_file(path + ".urdf")
    found = xml.etree.ElementTree.parse(path + ".urdf").find("joint").get("type")
    print(f"Physics{kind} {more}: {found}")
    return found


free = convert("RevoluteJoint")
off = convert("RevoluteJoint", "bool physics:jointEnabled = 0")
ball = convert("SphericalJoint")
loose = convert("Joint")
sys.exit([free, off, ball, loose] != ["continuous", "continuous", "fixed", "fixed"])
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder" > "$folder/log" 2>&1 || {
  tail -5 "$folder/log"
  exit 1
}
grep "^Physics" "$folder/log"
if grep -iE "warn|error" "$folder/log"; then exit 1; fi
