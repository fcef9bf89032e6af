#!/usr/bin/env bash
# yourdfpy 0.0.60, urchin 0.0.30, mujoco 4.0.0: a <mimic> of a joint that is itself a <mimic> is answered in three ways.
#
# URDF names the leader by its joint and does not ask that the leader be free: a gear train is written as each wheel following the one
# before. For a driver at 0.2, a second wheel at -2 times the driver and a third at -3 times the second plus 0.1, the third is at 1.3.
# MuJoCo makes an equality of each <mimic>, and they hold together there. yourdfpy takes the second wheel for 0 when it moves the third, which
# it prints while loading; the third stays at its offset. In urchin the third is not moved at all, not by its offset either, and nothing is said.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check yourdfpy==0.0.60 urchin==0.0.30 mujoco==4.0.0 numpy==2.4.6
cat > "$folder/train.urdf" <<'URDF'
<robot name="train">
  <link name="base"/><link name="first">MASS</link><link name="second">MASS</link><link name="third">MASS</link>
  <joint name="first" type="continuous">
    <parent link="base"/><child link="first"/><axis xyz="0 0 1"/>
  </joint>
  <joint name="second" type="continuous">
    <parent link="base"/><child link="second"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/><mimic joint="first" multiplier="-2"/>
  </joint>
  <joint name="third" type="continuous">
    <parent link="base"/><child link="third"/><origin xyz="2 0 0"/><axis xyz="0 0 1"/>
    <mimic joint="second" multiplier="-3" offset="0.1"/>
  </joint>
</robot>
URDF
sed -i 's|MASS|<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>|g' "$folder/train.urdf"
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import mujoco
import urchin
import yourdfpy

path = sys.argv[1] + "/train.urdf"


def angle(pose):
    return round(math.atan2(pose[1][0], pose[0][0]), 9)


robot = yourdfpy.URDF.load(path)
robot.update_cfg({"first": 0.2})
one = [angle(robot.get_transform(name)) for name in ("first", "second", "third")]
poses = urchin.URDF.load(path).link_fk(cfg={"first": 0.2}, use_names=True)
two = [angle(poses[name]) for name in ("first", "second", "third")]
model = mujoco.MjModel.from_xml_path(path)
data = mujoco.MjData(model)
data.qpos[:] = [0.2, -0.4, 1.3]
mujoco.mj_forward(model, data)
off = abs(data.efc_pos[: model.neq]).max()
print("angles of the three wheels: yourdfpy", one, "urchin", two)
print("MuJoCo: equalities", model.neq, "off at 0.2, -0.4 and 1.3 by at most", off)
for package in ("yourdfpy", "urchin", "mujoco"):
    print(package, importlib.metadata.version(package))
sys.exit(not (one == [0.2, -0.4, 0.1] and two == [0.2, -0.4, 0.0] and model.neq == 2 and off < 1e-12))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder" 2> "$folder/said" || { cat "$folder/said"; exit 1; }
sort -u "$folder/said"
grep -q "not actuated" "$folder/said"
