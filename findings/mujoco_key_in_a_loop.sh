#!/usr/bin/env bash
# mujoco 4.0.0: a key whose values have three digits leaves the loops open by their rounding.
#
# mj_resetDataKeyframe takes qpos as it is written. The pose of a four-bar written with three decimals is a pose that does not close: the point of
# `connect` is open by 1.8 mm in bars of metres. Nothing says so, and no joint value is changed before time passes.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check mujoco==4.0.0 numpy==2.4.6
cat > "$folder/crank_rocker.xml" <<'MJCF'
<mujoco><compiler angle="radian"/><default><joint axis="0 0 1"/><geom type="sphere" size="0.1" contype="0" conaffinity="0"/></default>
  <worldbody>
    <body name="crank"><geom/><joint name="a"/><body name="coupler" pos="0 2 0"><geom/><joint name="b"/><site name="one" pos="4 2 0"/></body></body>
    <body name="rocker" pos="5 0 0"><geom/><joint name="c"/><site name="other" pos="-1 4 0"/></body>
  </worldbody>
  <equality><connect body1="coupler" body2="rocker" anchor="4 2 0"/></equality>
  <keyframe><key name="other" qpos="0 -1.688 1.891"/></keyframe>
</mujoco>
MJCF
cat > "$folder/try.py" <<'PYTHON'
import sys
import mujoco
import numpy

model = mujoco.MjModel.from_xml_path(sys.argv[1] + "/crank_rocker.xml")
data = mujoco.MjData(model)
gaps = []
for key in [None, 0]:
    mujoco.mj_resetData(model, data) if key is None else mujoco.mj_resetDataKeyframe(model, data, key)
    mujoco.mj_forward(model, data)
    gaps.append(float(numpy.linalg.norm(data.site("one").xpos - data.site("other").xpos)))
    print("as drawn:" if key is None else "at the key:", f"open by {gaps[-1]:.1e} m at", [float(value) for value in data.qpos])
print("versions:", mujoco.__version__)
sys.exit(not (gaps[0] < 1e-12 and 1e-4 < gaps[1] < 1e-2 and list(data.qpos) == [0, -1.688, 1.891]))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
