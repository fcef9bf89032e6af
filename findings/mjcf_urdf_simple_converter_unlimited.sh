#!/usr/bin/env bash
# mjcf_urdf_simple_converter 0.7.3: a hinge without limits is locked, and a drawn pose of 30 degrees is called 0.
#
# In MJCF a hinge without range turns freely, which URDF calls continuous. The converter writes it as revolute with
# <limit lower="0.0" upper="0.0">, the numbers that MuJoCo keeps for a limit that is not in force: Pinocchio, which reads
# the output, allows no motion at all. A joint with ref="30" is at 30 degrees in the pose drawn; in URDF that pose is always 0.
# The converter copies the range 0..90 as it is, so that the arm reaches to 90 degrees beyond the drawn pose and not 60, and
# no longer back. Neither is mentioned by the program.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check \
  mjcf_urdf_simple_converter==0.7.3 mujoco==3.11.0 pin==4.1.0 numpy==2.4.6
cat > "$folder/arm.xml" <<'MJCF'
<mujoco model="arm">
  <worldbody>
    <body name="upper">
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <joint name="free" axis="0 0 1"/>
      <body name="lower" pos="1 0 0">
        <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
        <joint name="bent" axis="0 0 1" ref="30" range="0 90"/>
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
import pinocchio
from mjcf_urdf_simple_converter import convert

path, to = sys.argv[1] + "/arm.xml", sys.argv[1] + "/arm.urdf"
convert(path, to)
model = mujoco.MjModel.from_xml_path(path)
data = mujoco.MjData(model)
other = pinocchio.buildModelFromUrdf(to)
state = other.createData()
# How far the lower arm can turn from the pose drawn, which is qpos0 in MuJoCo and 0 in URDF.
turns = numpy.degrees(model.jnt_range[1] - model.qpos0[1])
limits = numpy.degrees([other.lowerPositionLimit, other.upperPositionLimit]).T
print("MuJoCo: 'free' limited:", bool(model.jnt_limited[0]), "- 'bent' from the pose drawn:", turns.round(6))
print("URDF in Pinocchio: 'free'", limits[0].round(6), "- 'bent' from the pose drawn:", limits[1].round(6))
for package in ("mjcf_urdf_simple_converter", "mujoco", "pin"):
    print(package, importlib.metadata.version(package))
sys.exit(not (not model.jnt_limited[0] and numpy.allclose(turns, [-30, 60])
              and numpy.allclose(limits, [[0, 0], [0, 90]])))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
