#!/usr/bin/env bash
# drake 1.51.1: of several joints in one body of an MJCF file, all but the last stand at the origin of the parent, along the parent's axes.
#
# In MJCF the pos and axis of every joint of a body are given in the frame of that body; a planar or universal joint is written as
# several joints in one body. Drake takes only the last joint there. The ones before get their numbers in the frame of the parent: two crossed
# hinges at (1, 0, 0) become one at the parent's origin and one at (1, 0, 0), and of two crossed slides in a body that is turned by 90 degrees
# both run along one line. At q = 0 all is right, and where the body has no pos and no orientation always. There is no
# warning, which this reader gives for elements and attributes that it does not support.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check drake==1.51.1 mujoco==4.0.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
import mujoco
import numpy
from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import MultibodyPlant

text = """
<mujoco model="arm">
  <worldbody>
    <body name="arm" FRAME>
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      JOINTS
    </body>
  </worldbody>
</mujoco>
"""


def place(frame, joints, q):
    file = text.replace("FRAME", frame).replace("JOINTS", joints)
    model = mujoco.MjModel.from_xml_string(file)
    data = mujoco.MjData(model)
    data.qpos[:] = q
    mujoco.mj_kinematics(model, data)
    plant = MultibodyPlant(0.0)
    Parser(plant).AddModelsFromString(file, "xml")
    plant.Finalize()
    context = plant.CreateDefaultContext()
    for i, value in enumerate(q):
        joint = plant.GetJointByName(model.joint(i).name)
        (joint.set_angle if model.jnt_type[i] == 3 else joint.set_translation)(context, value)
    seen = plant.EvalBodyPoseInWorld(context, plant.GetBodyByName("arm")).translation()
    return data.xpos[1].round(9) + 0.0, seen.round(9) + 0.0


crossed = '<joint name="first" axis="0 0 1"/><joint name="second" axis="1 0 0"/>'
slides = '<joint name="first" type="slide" axis="1 0 0"/><joint name="second" type="slide" axis="0 1 0"/>'
quarter = numpy.pi / 2
right = True
for name, frame, joints, q, expected in (
    ("two hinges, the body in place", "", crossed, (quarter, 0.5), None),
    ("two hinges, the body at 1 0 0, at rest", 'pos="1 0 0"', crossed, (0.0, 0.0), None),
    ("the same, the first by a quarter turn", 'pos="1 0 0"', crossed, (quarter, 0.0), (0, 1, 0)),
    ("the same, the second by a quarter turn", 'pos="1 0 0"', crossed, (0.0, quarter), None),
    ("two slides, not turned", "", slides, (1.0, 2.0), None),
    ("two slides, the body turned by a quarter", 'euler="0 0 90"', slides, (1.0, 2.0), (-1, 0, 0)),
):
    theirs, seen = place(frame, joints, q)
    print(f"{name}: the body stands at {theirs} in MuJoCo, at {seen} in Drake")
    right &= numpy.allclose(seen, theirs if expected is None else expected)
    right &= numpy.allclose(seen, theirs) == (expected is None)
for package in ("drake", "mujoco"):
    print(package, importlib.metadata.version(package))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" 2> "$folder/said" || { cat "$folder/said"; exit 1; }
if grep -i "warn" "$folder/said"; then exit 1; fi
