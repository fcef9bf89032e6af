#!/usr/bin/env bash
# truerig 0.1.1: hinges of an MJCF file move to the origins of their bodies, and the report of what was changed says PASS.
#
# truerig converts between URDF and MJCF "with a fidelity report of everything it changed". MJCF gives a joint a pos of its own in its
# body; URDF has no such place, so a converter must shift the frame of the link. truerig leaves pos out: a door whose hinge is on
# its edge turns about its middle, and a parallel crank mechanism gets other crank lengths. The report has no error, no warning
# and not a line about it. It also says nothing of ref, the value of the joint in the pose drawn.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check truerig==0.1.1 mujoco==3.11.0 numpy==2.4.6
cat > "$folder/door.xml" <<'MJCF'
<mujoco model="door">
  <worldbody>
    <body name="frame">
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <body name="door" pos="0.4 0 0">
        <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
        <joint name="hinge" axis="0 0 1" pos="-0.4 0 0" range="0 90"/>
      </body>
    </body>
  </worldbody>
</mujoco>
MJCF
"$folder/venv/bin/truerig" convert --report json "$folder/door.xml" "$folder/door.urdf" > "$folder/report.json"
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import json
import math
import sys
import xml.etree.ElementTree as tree
import mujoco
import numpy

model = mujoco.MjModel.from_xml_path(sys.argv[1] + "/door.xml")
data = mujoco.MjData(model)
data.qpos[0] = math.pi / 2
mujoco.mj_kinematics(model, data)
origin = tree.parse(sys.argv[1] + "/door.urdf").find("joint[@name='hinge']/origin")
middle = numpy.array([float(x) for x in origin.get("xyz").split()])
text = open(sys.argv[1] + "/report.json").read()
print("door's middle, opened by a quarter turn, in MuJoCo:", data.xpos[2].round(6))
print("the hinge and the link's frame in the URDF, which a turn leaves in place:", middle)
print("report:", text)
report = json.loads(text)
silent = report["verdict"] == "pass" and report["events"] == []
print("version:", importlib.metadata.version("truerig"))
sys.exit(not (numpy.allclose(data.xpos[2], [0, 0.4, 0]) and not numpy.allclose(data.xpos[2], middle)
              and numpy.allclose(middle, [0.4, 0, 0]) and silent))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
