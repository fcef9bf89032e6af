#!/usr/bin/env bash
# newton 1.8.0: a generic joint of a USD stage without limits is rigid; only an axis that has limits can move.
#
# In UsdPhysics a PhysicsJoint leaves all six degrees of freedom free, and a PhysicsLimitAPI restricts one axis, or locks it where low is
# above high. Newton makes a degree of freedom of each axis that has limits and locks the others: a joint without any has none
# instead of six, a planar joint (transZ, rotX and rotY locked) none instead of three, and one with a travel of -1 to 1 along x has
# one instead of six. Nothing is said.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export WARP_CACHE_PATH="$folder/kernels"
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check \
  newton==1.8.0 newton-usd-schemas==0.6.0 usd-core==26.8 warp-lang==1.19.0 mujoco==3.17.0 numpy==2.4.6
cat > "$folder/plate.usda" <<'USD'
#usda 1.0
(
    defaultPrim = "table"
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "table"
{
    def Xform "plate" (
        prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsMassAPI"]
    )
    {
        float physics:mass = 1
        float3 physics:diagonalInertia = (1, 1, 1)
    }
    def PhysicsJoint "joint" APIS
    {
        rel physics:body1 = </table/plate>
        LIMITS
    }
}
USD
cat > "$folder/try.py" <<'PYTHON'
import sys
import warnings
import newton
import warp
from pxr import Usd, UsdPhysics

warp.config.quiet = True
folder = sys.argv[1]
text = open(folder + "/plate.usda").read()


def freedoms(name, limits):
    apis = ", ".join(f'"PhysicsLimitAPI:{axis}"' for axis in limits)
    apis = f"(\n        prepend apiSchemas = [{apis}]\n    )" if limits else ""
    lines = [f"float limit:{axis}:physics:{end} = {value}" for axis, ends in limits.items() for end, value in zip(("low", "high"), ends)]
    path = f"{folder}/{name}.usda"
    open(path, "w").write(text.replace("APIS", apis).replace("LIMITS", "\n        ".join(lines)))
    stage = Usd.Stage.Open(path)
    locked = 0
    for axis in limits:
        limit = UsdPhysics.LimitAPI.Get(stage.GetPrimAtPath("/table/joint"), axis)
        locked += limit.GetLowAttr().Get() > limit.GetHighAttr().Get()
    builder = newton.ModelBuilder()
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        builder.add_usd(path)
    told = [str(each.message) for each in caught if "joint" in str(each.message).lower()]
    model = builder.finalize()
    print(f"{name}: in USD {6 - locked}, in Newton {model.joint_dof_count}; warnings {told}")
    return 6 - locked, model.joint_dof_count, told


lock, travel = (1, -1), (-1, 1)
free = freedoms("free", {})
planar = freedoms("planar", {"transZ": lock, "rotX": lock, "rotY": lock})
bounded = freedoms("bounded", {"transX": travel})
sys.exit(not (free == (6, 0, []) and planar == (3, 0, []) and bounded == (6, 1, [])))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
