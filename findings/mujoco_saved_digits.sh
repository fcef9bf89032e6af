#!/usr/bin/env bash
# mujoco 4.0.0: a saved model has six significant digits; a loop that closed to 1e-13 is open by 4e-3 when it is read again.
#
# MuJoCo computes in double precision and reads every digit of an MJCF file. What MjSpec.to_xml and mj_saveLastXML write is rounded to six
# significant digits, positions, quaternions, limits and ref alike, and neither takes a precision. In a model whose lengths are in
# millimetres 1000 * sqrt(2) becomes 1414.21. A loop that is closed by two sites (equality connect) no longer closes at the pose
# drawn, and limits of -60 and 90 degrees have moved by up to 2e-4 degrees.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check mujoco==4.0.0 numpy==2.4.6
cat > "$folder/loop.xml" <<'MJCF'
<mujoco model="loop">
  <worldbody>
    <site name="base_end" pos="2000 0 0"/>
    <body name="crank">
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <joint name="first" axis="0 0 1" range="-60 90"/>
      <body name="coupler" pos="1000 1000 0">
        <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
        <joint name="second" axis="0 0 1"/>
        <body name="rocker" pos="1414.2135623730951 0 0" euler="0 0 45">
          <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
          <joint name="third" axis="0 0 1"/>
          <site name="rocker_end" pos="-1000 -414.21356237309505 0"/>
        </body>
      </body>
    </body>
  </worldbody>
  <equality><connect site1="base_end" site2="rocker_end"/></equality>
</mujoco>
MJCF
cat > "$folder/try.py" <<'PYTHON'
import math
import sys
import mujoco
import numpy

folder = sys.argv[1]
text = open(folder + "/loop.xml").read()
spec = mujoco.MjSpec.from_string(text)
model = spec.compile()
path = folder + "/saved.xml"
mujoco.mj_saveLastXML(path, mujoco.MjModel.from_xml_string(text))


def gap(read):
    data = mujoco.MjData(read)
    mujoco.mj_forward(read, data)
    return numpy.linalg.norm(data.site("base_end").xpos - data.site("rocker_end").xpos)


written = spec.to_xml()
saved = mujoco.MjModel.from_xml_string(written)
print("mujoco", mujoco.__version__)
print("gap of the loop as written by hand", gap(model), "as saved", gap(saved))
moved = numpy.degrees(saved.jnt_range[0] - model.jnt_range[0])
print("limits, in degrees, moved by", moved)
print([line.strip() for line in written.splitlines() if "rocker" in line])
same = open(path).read().split("<worldbody>")[1] == written.split("<worldbody>")[1]
sys.exit(not (gap(model) < 1e-9 and 1e-4 < gap(saved) < 1e-1 and 1e-5 < abs(moved).max() < 1e-3 and "1414.21 0 0" in written and same))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
