#!/usr/bin/env bash
# pin 4.1.0: upper-case letters of eulerseq in an MJCF file turn about moving axes, where MuJoCo turns about fixed ones.
#
# In MuJoCo lower-case letters of compiler eulerseq are axes that turn with the frame (intrinsic), upper-case
# ones axes that stay in the parent frame (extrinsic). Pinocchio reads XYZ as xyz, without a word. The rpy of
# URDF is XYZ in MuJoCo's words, so files that came from URDF use it. With euler="30 40 50" the frame is turned by 45 degrees
# against MuJoCo's. One nonzero angle shows no difference.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pin==4.1.0 mujoco==4.0.0 numpy==2.4.6
cat > "$folder/arm.xml" <<'MJCF'
<mujoco model="arm">
  <compiler eulerseq="SEQUENCE"/>
  <worldbody>
    <body name="arm" euler="30 40 50">
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <joint name="hinge" axis="0 0 1"/>
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

text = open(sys.argv[1] + "/arm.xml").read()
apart = {}
frames = {}
for number, sequence in enumerate(("xyz", "zyx", "XYZ")):
    path = f"{sys.argv[1]}/arm_{number}.xml"
    open(path, "w").write(text.replace("SEQUENCE", sequence))
    model = mujoco.MjModel.from_xml_path(path)
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    other = pinocchio.buildModelFromMJCF(path)
    state = other.createData()
    pinocchio.forwardKinematics(other, state, numpy.zeros(1))
    frames[sequence] = state.oMi[1].rotation.copy()
    cosine = (numpy.trace(data.xmat[1].reshape(3, 3).T @ frames[sequence]) - 1) / 2
    apart[sequence] = math.degrees(math.acos(min(1.0, cosine)))
    print(f'eulerseq="{sequence}": Pinocchio\'s frame is {apart[sequence]:.2f} degrees off MuJoCo\'s')
print("versions:", mujoco.__version__, pinocchio.__version__)
same = apart["xyz"] < 1e-4 and apart["zyx"] < 1e-4 and numpy.allclose(frames["xyz"], frames["XYZ"])
sys.exit(not (same and abs(apart["XYZ"] - 44.90) < 0.01))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
