#!/usr/bin/env bash
# pin 4.1.0: axisangle="0 0 2 60" in an MJCF file gives a frame that is no rotation; its determinant is 20.
#
# MuJoCo normalises the axis of axisangle, so "0 0 2 60" and "0 0 1 60" are one orientation (its reference says of orientations
# that vectors are normalised automatically). Pinocchio normalises the quaternion of quat="...", but takes the axis of axisangle
# as it is written. The placement of the joint is a matrix that stretches, and all that hangs on it is deformed; nothing is said.
# A diagonal axis such as "0 1 1 60" is the usual way to meet it.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pin==4.1.0 mujoco==4.0.0 numpy==2.4.6
cat > "$folder/arm.xml" <<'MJCF'
<mujoco model="arm">
  <worldbody>
    <body name="arm" ORIENTATION>
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <joint name="hinge" axis="0 0 1"/>
    </body>
  </worldbody>
</mujoco>
MJCF
cat > "$folder/try.py" <<'PYTHON'
import sys
import mujoco
import numpy
import pinocchio

text = open(sys.argv[1] + "/arm.xml").read()
right = True
for number, (orientation, expected) in enumerate((
    ('axisangle="0 0 1 60"', 1), ('axisangle="0 0 2 60"', 20.3125), ('axisangle="0 1 1 60"', 3.5), ('quat="2 0 0 1"', 1),
)):
    path = f"{sys.argv[1]}/arm_{number}.xml"
    open(path, "w").write(text.replace("ORIENTATION", orientation))
    model = mujoco.MjModel.from_xml_path(path)
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    other = pinocchio.buildModelFromMJCF(path)
    pair = [float(numpy.linalg.det(m)) for m in (data.xmat[1].reshape(3, 3), other.jointPlacements[1].rotation)]
    print(f"{orientation}: determinant {pair[0]:.4f} in MuJoCo, {pair[1]:.4f} in Pinocchio")
    right &= abs(pair[0] - 1) < 1e-9 and abs(pair[1] - expected) < 1e-9
print("versions:", mujoco.__version__, pinocchio.__version__)
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
