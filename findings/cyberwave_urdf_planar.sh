#!/usr/bin/env bash
# cyberwave-robot-format 0.1.8: a planar joint of a URDF becomes one slide along its normal, and a joint without <axis> turns about z.
#
# URDF's planar joint has two slides in the plane and a turn about the plane's normal, which is its axis. Written as MJCF it is a single
# slide along that axis: the three directions it had are locked and the one that was locked is free. The same package writes it as a
# planar joint where it writes URDF. A joint without <axis> has the axis x in URDF; here it gets z, MJCF's default, also in a
# URDF that was read and written again, where <axis xyz="0 0 1"/> now stands. Nothing is said.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check cyberwave-robot-format==0.1.8 mujoco==4.0.0 numpy==2.4.6
cat > "$folder/table.urdf" <<'URDF'
<robot name="table">
  <link name="base">MASS</link><link name="table">MASS</link><link name="wheel">MASS</link>
  <joint name="move" type="planar">
    <parent link="base"/><child link="table"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
  </joint>
  <joint name="turn" type="continuous"><parent link="table"/><child link="wheel"/></joint>
</robot>
URDF
sed -i 's|MASS|<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>|g' "$folder/table.urdf"
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
import xml.etree.ElementTree as tree
import mujoco
from cyberwave_robot_format import MJCFExporter, URDFExporter, URDFParser

folder = sys.argv[1]
kinds = ("free", "ball", "slide", "hinge")


def joints(path):
    model = mujoco.MjModel.from_xml_path(path)
    return [(model.joint(i).name, kinds[model.jnt_type[i]], model.jnt_axis[i].tolist()) for i in range(model.njnt)]


robot = URDFParser().parse(folder + "/table.urdf")
MJCFExporter().export(robot, folder + "/table.xml")
URDFExporter().export(robot, folder + "/again.urdf")
again = [(joint.get("type"), joint.find("axis").get("xyz").split()) for joint in tree.parse(folder + "/again.urdf").findall("joint")]
one, two = joints(folder + "/table.urdf"), joints(folder + "/table.xml")
print("MuJoCo's own reader of URDF:", one)
print("written as MJCF:", two)
print("written as URDF:", again)
for package in ("cyberwave-robot-format", "mujoco"):
    print(package, importlib.metadata.version(package))
right = [kind for _, kind, _ in one] == ["slide", "slide", "hinge", "hinge"] and one[3][2] == [1.0, 0.0, 0.0]
right &= two == [("move", "slide", [0.0, 0.0, 1.0]), ("turn", "hinge", [0.0, 0.0, 1.0])]
right &= again[0][0] == "planar" and [float(x) for x in again[1][1]] == [0.0, 0.0, 1.0]
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder" 2>&1
