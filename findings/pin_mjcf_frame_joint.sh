#!/usr/bin/env bash
# pin 4.1.0: a joint that an MJCF file writes inside a <frame> is gone, and its body is welded to its parent.
#
# In MuJoCo <frame> only moves coordinates, and what it holds belongs to the parent body: a joint
# in it is an ordinary joint whose place and axis are turned with the frame. Pinocchio's reader passes over <frame> inside a body
# with all that it holds, without an error or a warning. A body whose only joint stands there becomes fixed, so the model has
# one freedom less and loads well. <replicate> inside a body is passed over in the same way: three fingers, and none is left.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pin==4.1.0 mujoco==4.0.0 numpy==2.4.6
cat > "$folder/arm.xml" <<'MJCF'
<mujoco model="arm">
  <worldbody>
    <body name="arm">
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      OPEN<joint name="shoulder" axis="0 0 1"/>CLOSE
      <body name="hand" pos="1 0 0">
        <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
        <joint name="wrist" axis="0 0 1"/>
        FINGERS
      </body>
    </body>
  </worldbody>
</mujoco>
MJCF
cat > "$folder/try.py" <<'PYTHON'
import sys
import mujoco
import pinocchio

fingers = """<replicate count="3" euler="0 0 120"><body name="finger" pos="0.1 0 0">
  <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/><joint name="knuckle" axis="0 1 0"/></body></replicate>"""
text = open(sys.argv[1] + "/arm.xml").read()
right = True
for name, open_tag, close_tag, more, counts in (
    ("plain", "", "", "", (2, 2)),
    ("joint in a frame", '<frame euler="0 90 0">', "</frame>", "", (2, 1)),
    ("three fingers by replicate", "", "", fingers, (5, 2)),
):
    path = f"{sys.argv[1]}/{name.replace(' ', '_')}.xml"
    open(path, "w").write(text.replace("OPEN", open_tag).replace("CLOSE", close_tag).replace("FINGERS", more))
    other = pinocchio.buildModelFromMJCF(path)
    seen = (mujoco.MjModel.from_xml_path(path).nv, other.nv)
    print(f"{name}: {seen[0]} freedoms in MuJoCo, {seen[1]} in Pinocchio, which has {list(other.names)}")
    right &= seen == counts
print("versions:", mujoco.__version__, pinocchio.__version__)
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
