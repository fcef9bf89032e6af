#!/usr/bin/env bash
# pin 4.1.0: a floating body that an MJCF file draws turned stands elsewhere than the same q puts it in MuJoCo.
#
# A free joint's variables are the position and orientation of the body in the world, whatever the body's own pos and euler:
# the drawn pose is only the initial value. Pinocchio's reader keeps a placement between
# world and free joint that is p - R p for a body drawn at p and turned by R. It is zero for a body that is not turned, so that most
# robots come out right. A body at (1, 0, 0.5) turned by a quarter turn is set off by (1, -1, 0) at every q, though q itself,
# from the keyframe "qpos0", has the body's position.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pin==4.1.0 mujoco==4.0.0 numpy==2.4.6
cat > "$folder/walker.xml" <<'MJCF'
<mujoco model="walker">
  <worldbody>
    <body name="trunk" pos="1 0 0.5" euler="0 0 TURN">
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <freejoint name="floating"/>
    </body>
  </worldbody>
</mujoco>
MJCF
cat > "$folder/try.py" <<'PYTHON'
import sys
import mujoco
import numpy
import pinocchio

text = open(sys.argv[1] + "/walker.xml").read()
right = True
for turn, off in ((0, (0, 0, 0)), (90, (1, -1, 0))):
    path = f"{sys.argv[1]}/walker_{turn}.xml"
    open(path, "w").write(text.replace("TURN", str(turn)))
    model = mujoco.MjModel.from_xml_path(path)
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    other = pinocchio.buildModelFromMJCF(path)
    state = other.createData()
    q = [entry.data() for entry in other.referenceConfigurations if entry.key() == "qpos0"][0]
    pinocchio.framesForwardKinematics(other, state, q)
    place = state.oMf[other.getFrameId("trunk")].translation
    print(f"turned by {turn}: q = {q.round(4)}")
    print(f"  trunk in MuJoCo {data.xpos[1]}, in Pinocchio {place.round(6)}")
    right &= numpy.allclose(place - data.xpos[1], off) and numpy.allclose(q[:3], data.xpos[1])
print("versions:", mujoco.__version__, pinocchio.__version__)
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
