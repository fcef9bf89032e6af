#!/usr/bin/env bash
# cyberwave-robot-format 0.1.8: MJCF read and written as MJCF: degrees become radians, and a body with two joints becomes two of one name.
#
# Reader and writer belong to one package, so that a file that goes through both should be the same mechanism. The numbers of range are kept
# and written into a file with angle="radian": 90 degrees is 90 radians, fourteen turns. Orientations other than quat (euler, axisangle,
# xyaxes, zaxis) are left out. A joint's pos moves its body instead of the axis. A body with two joints is written twice,
# which MuJoCo refuses: "repeated name". No step raises an error.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check cyberwave-robot-format==0.1.8 mujoco==4.0.0 numpy==2.4.6
cat > "$folder/arm.xml" <<'MJCF'
<mujoco model="arm">
  <worldbody>
    <body name="base">
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <body name="arm" FRAME>
        <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
        JOINTS
        <body name="hand" pos="1 0 0"><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/></body>
      </body>
    </body>
  </worldbody>
</mujoco>
MJCF
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
import mujoco
import numpy
from cyberwave_robot_format import MJCFExporter, MJCFParser

folder = sys.argv[1]
text = open(folder + "/arm.xml").read()


def state(path):
    try:
        model = mujoco.MjModel.from_xml_path(path)
    except ValueError as error:
        return str(error).split("\n")[0]
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    return [float(x) for x in (*data.body("hand").xpos.round(6) + 0.0, round(model.jnt_range[0][1], 6))]


cases = (
    ("limits", "", '<joint name="hinge" axis="0 0 1" range="-90 90"/>', [1, 0, 0, 90]),
    ("quat", 'quat="1 0 0 1"', '<joint name="hinge" axis="0 0 1"/>', [0, 1, 0, 0]),
    ("euler", 'euler="0 0 90"', '<joint name="hinge" axis="0 0 1"/>', [1, 0, 0, 0]),
    ("zaxis", 'zaxis="1 0 0"', '<joint name="hinge" axis="0 0 1"/>', [1, 0, 0, 0]),
    ("pos of the joint", "", '<joint name="hinge" axis="0 0 1" pos="-1 0 0"/>', [0, 0, 0, 0]),
    ("two joints", "", '<joint name="hinge" axis="0 0 1"/><joint name="slide" type="slide"/>', "repeated name"),
)
right = True
for number, (name, frame, joints, expected) in enumerate(cases):
    first, second = f"{folder}/arm_{number}.xml", f"{folder}/again_{number}.xml"
    open(first, "w").write(text.replace("FRAME", frame).replace("JOINTS", joints))
    MJCFExporter().export(MJCFParser().parse(first), second)
    before, after = state(first), state(second)
    print(f"{name}: place of the hand and upper limit {before}, written again {after}")
    right &= expected in after if isinstance(expected, str) else numpy.allclose(after, expected)
    right &= (after == before) == (name == "quat")
for package in ("cyberwave-robot-format", "mujoco"):
    print(package, importlib.metadata.version(package))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder" 2> "$folder/said" || { cat "$folder/said"; exit 1; }
grep -c "UNLIMITED" "$folder/said" || true
