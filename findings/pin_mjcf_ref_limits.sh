#!/usr/bin/env bash
# pin 4.1.0: a joint of an MJCF file with ref="45" and range="0 90" gets limits of -45 to 45 degrees around a variable of 0 to 90.
#
# In MJCF ref is the value of the joint's variable in the pose drawn, and range bounds that variable: both are in one scale.
# Pinocchio reads ref into the reference
# configuration "qpos0" and moves links by q - ref, so that its q is MuJoCo's q. Its limits are moved by -ref nevertheless, and no
# longer belong to q: the drawn pose, in the middle of the range, lies on the upper limit, half of the range is forbidden,
# and 45 degrees beyond the lower stop are allowed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pin==4.1.0 mujoco==4.0.0 numpy==2.4.6
cat > "$folder/knee.xml" <<'MJCF'
<mujoco model="knee">
  <worldbody>
    <body name="shank">
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <joint name="knee" axis="0 0 1" ref="45" range="0 90"/>
    </body>
  </worldbody>
</mujoco>
MJCF
cat > "$folder/try.py" <<'PYTHON'
import math
import sys
import mujoco
import numpy
import pinocchio

path = sys.argv[1] + "/knee.xml"
model = mujoco.MjModel.from_xml_path(path)
data = mujoco.MjData(model)
other = pinocchio.buildModelFromMJCF(path)
state = other.createData()
apart = 0.0
for degrees in (0, 45, 90):
    q = numpy.array([math.radians(degrees)])
    data.qpos[:] = q
    mujoco.mj_kinematics(model, data)
    pinocchio.forwardKinematics(other, state, q)
    apart = max(apart, abs(data.xmat[1].reshape(3, 3) - state.oMi[1].rotation).max())
drawn = [entry.data() for entry in other.referenceConfigurations if entry.key() == "qpos0"][0]
limits = [round(math.degrees(x), 6) for x in (*other.lowerPositionLimit, *other.upperPositionLimit)]
print("poses at q = 0, 45 and 90 degrees differ by at most", apart)
print("MuJoCo: drawn at", numpy.degrees(model.qpos0), "limits", numpy.degrees(model.jnt_range[0]))
print("Pinocchio: drawn at", numpy.degrees(drawn), "limits", limits)
print("versions:", mujoco.__version__, pinocchio.__version__)
expected = numpy.allclose(numpy.degrees(model.jnt_range[0]), [0, 90]) and numpy.allclose(numpy.degrees(drawn), 45)
sys.exit(not (apart < 1e-12 and expected and limits == [-45.0, 45.0]))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
