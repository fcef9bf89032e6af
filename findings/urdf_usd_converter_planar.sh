#!/usr/bin/env bash
# urdf-usd-converter 0.3.4, read by newton 1.8.0: a planar joint slides along its normal and tilts, and does not move in its plane.
#
# Both belong to the Newton project, and the one writes what the other is to simulate. The converter takes URDF's planar joint (two
# slides in the plane, a turn about its normal) for a PhysicsJoint whose other three axes are locked, with low = inf and high = -inf,
# which is what UsdPhysics has for it. Newton makes degrees of freedom of just those three, with limits of 1e10, and locks
# the three that are free: a table normal to z moves along z and turns about x and y. The count, three, is right.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export WARP_CACHE_PATH="$folder/kernels"
python3 -m venv "$folder/venv"
python3 -m venv "$folder/reader"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check urdf-usd-converter==0.3.4 numpy==2.4.6
"$folder/reader/bin/pip" install --quiet --disable-pip-version-check \
  newton==1.8.0 newton-usd-schemas==0.6.0 usd-core==26.8 warp-lang==1.19.0 mujoco==3.17.0 numpy==2.4.6
cat > "$folder/table.urdf" <<'URDF'
<robot name="table">
  <link name="base">
    <inertial>
      <origin xyz="0 0 0"/>
      <mass value="1"/>
      <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>
    </inertial>
  </link>
  <link name="plate">
    <inertial>
      <origin xyz="0 0 0"/>
      <mass value="1"/>
      <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>
    </inertial>
  </link>
  <joint name="glide" type="planar">
    <parent link="base"/>
    <child link="plate"/>
    <axis xyz="0 0 1"/>
  </joint>
</robot>
URDF
"$folder/venv/bin/urdf_usd_converter" "$folder/table.urdf" "$folder/usd" > "$folder/log" 2>&1 || {
  cat "$folder/log"
  exit 1
}
cat > "$folder/try.py" <<'PYTHON'
import glob
import sys
import newton
import warp
from pxr import Usd, UsdPhysics

warp.config.quiet = True
usd = glob.glob(sys.argv[1] + "/usd/*.usda")[0]
stage = Usd.Stage.Open(usd)
joint = next(prim for prim in stage.Traverse() if prim.GetName() == "glide")
locked = []
for axis in ("transX", "transY", "transZ", "rotX", "rotY", "rotZ"):
    limit = UsdPhysics.LimitAPI.Get(joint, axis)
    if joint.HasAPI(UsdPhysics.LimitAPI, axis) and limit.GetLowAttr().Get() > limit.GetHighAttr().Get():
        locked.append(axis)
print("USD:", joint.GetTypeName(), "locked", locked)
builder = newton.ModelBuilder()
builder.add_usd(usd)
model = builder.finalize()
index = [newton.JointType(int(each)).name for each in model.joint_type.numpy()].index("D6")
slides, turns = model.joint_dof_dim.numpy()[index].tolist()
first = int(model.joint_qd_start.numpy()[index])
axes = model.joint_axis.numpy()[first : first + slides + turns].tolist()
print("Newton: slides along", axes[:slides], "turns about", axes[slides:])
print("limits", model.joint_limit_upper.numpy()[first : first + slides + turns])
expected = locked == ["transZ", "rotX", "rotY"]
sys.exit(not (expected and (slides, turns) == (1, 2) and axes == [[0, 0, 1], [1, 0, 0], [0, 1, 0]]))
PYTHON
"$folder/reader/bin/python" "$folder/try.py" "$folder"
