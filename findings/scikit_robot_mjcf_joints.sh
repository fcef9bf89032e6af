#!/usr/bin/env bash
# scikit-robot 0.4.7, convert-urdf-to-mjcf: planar and floating joints of a URDF become a hinge about x without limits.
#
# URDF's planar joint has two slides and a turn, its floating joint six freedoms. MuJoCo's own reader of URDF makes three joints and a free
# joint of them. The converter of scikit-robot writes one hinge for either, about the axis 1 0 0 where none is given, which is none of the
# three freedoms of a table that moves in the plane of z. Mimics of the same file, followers of followers too, are converted rightly.
# There is no warning, and the exit code is 0.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check scikit-robot==0.4.7 mujoco==4.0.0 numpy==2.4.6
cat > "$folder/table.urdf" <<'URDF'
<robot name="table">
  <link name="base">MASS</link><link name="table">MASS</link><link name="wheel">MASS</link><link name="second">MASS</link>
  <joint name="move" type="KIND">
    <parent link="base"/><child link="table"/><origin xyz="1 0 0"/>AXIS
  </joint>
  <joint name="turn" type="continuous"><parent link="table"/><child link="wheel"/><axis xyz="0 1 0"/></joint>
  <joint name="follow" type="continuous">
    <parent link="table"/><child link="second"/><axis xyz="0 1 0"/><mimic joint="turn" multiplier="-2" offset="0.5"/>
  </joint>
</robot>
URDF
sed -i 's|MASS|<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>|g' "$folder/table.urdf"
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import subprocess
import sys
import mujoco

folder = sys.argv[1]
text = open(folder + "/table.urdf").read()
kinds = ("free", "ball", "slide", "hinge")


def joints(path):
    model = mujoco.MjModel.from_xml_path(path)
    table = model.body("table").id
    moves = [(kinds[model.jnt_type[i]], model.jnt_axis[i].tolist(), bool(model.jnt_limited[i])) for i in range(model.njnt)
             if model.jnt_bodyid[i] == table]
    return moves, model.eq_data[:, :2].tolist()


right = True
for kind, axis, own in (("planar", '<axis xyz="0 0 1"/>', 3), ("planar", "", 3), ("floating", "", 1)):
    first, second = folder + "/one.urdf", folder + "/one.xml"
    open(first, "w").write(text.replace("KIND", kind).replace("AXIS", axis))
    command = [folder + "/venv/bin/convert-urdf-to-mjcf", "--no-actuators", "--no-ground", "-o", second, first]
    run = subprocess.run(command, capture_output=True, text=True)
    direct, converted = joints(first)[0], joints(second)
    print(f"{kind} {axis}: MuJoCo's reader {[k for k, _, _ in direct]}, converted {converted[0]}, couplings {converted[1]}")
    about = [0.0, 0.0, 1.0] if axis else [1.0, 0.0, 0.0]
    right &= run.returncode == 0 and len(direct) == own and converted == ([("hinge", about, False)], [[0.5, -2.0]])
    right &= "warn" not in (run.stdout + run.stderr).lower()
for package in ("scikit-robot", "mujoco"):
    print(package, importlib.metadata.version(package))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
