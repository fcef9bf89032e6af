#!/usr/bin/env bash
# mujoco 4.0.0: a keyframe with one number for a model of nine is accepted, and the rest is the pose drawn; one number too many is an error.
#
# A <key> holds the whole state, and a qpos of another length reads like a key that belongs to another version of the model. Too long
# it is refused ("invalid qpos size"). Too short it is completed, from ref and from the drawn place of free bodies, wherever it
# breaks off: after the second coordinate of a position x and y come from the key, z from the file. Nothing is said. A key whose
# model has gained a joint at the end is therefore still right, and one whose model has gained a joint at the front moves the wrong joints.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check mujoco==4.0.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import sys
import mujoco
import numpy

mass = '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>'
text = f"""
<mujoco model="pair">
  <compiler angle="radian"/>
  <worldbody>
    <body name="a">{mass}<joint name="first" ref="0.3"/></body>
    <body name="b">{mass}<joint name="second" ref="0.6"/></body>
    <body name="c" pos="1 2 3">{mass}<freejoint name="free"/></body>
  </worldbody>
  <keyframe><key name="home" qpos="QPOS"/></keyframe>
</mujoco>
"""
seen = []
for qpos in ("0.5", "0.5 0.4", "0.5 0.4 7 8", "0.5 0.4 7 8 9 1 0 0 0", "0.5 0.4 7 8 9 1 0 0 0 5"):
    try:
        seen.append(mujoco.MjModel.from_xml_string(text.replace("QPOS", qpos)).key_qpos[0].tolist())
    except ValueError as error:
        seen.append(str(error).split("\n")[0])
    print(f"qpos={qpos!r}: {seen[-1]}")
print("mujoco", mujoco.__version__)
expected = [[0.5, 0.6, 1, 2, 3, 1, 0, 0, 0], [0.5, 0.4, 1, 2, 3, 1, 0, 0, 0], [0.5, 0.4, 7, 8, 3, 1, 0, 0, 0], [0.5, 0.4, 7, 8, 9, 1, 0, 0, 0]]
sys.exit(not (numpy.allclose(seen[:4], expected) and "invalid qpos size" in seen[4]))
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
