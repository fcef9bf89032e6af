#!/usr/bin/env bash
# dm_control 1.0.50: attaching an arm that is written in radians turns the limits of the base from degrees into radians.
#
# mjcf's attach puts one model into another, each with names and defaults of its own. <compiler> is shared: an attribute that the
# one states and the other leaves out is taken over for both. A base that relies on MJCF's degrees, with a range of -90 to 90, has limits of
# 90 radians once an arm with angle="radian" hangs on it; eulerseq="zyx" of the arm turns the base's bodies about other
# axes. Where both state the attribute and differ, attach raises an error; leaving a default out is what makes it silent. MuJoCo's own
# MjSpec.attach converts and keeps each model as it was.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export MUJOCO_GL=disabled
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check dm_control==1.0.50 mujoco==4.0.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
import mujoco
import numpy
from dm_control import mjcf

mass = '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>'
base = f"""
<mujoco model="base">
  SETTINGS
  <worldbody>
    <body name="base" euler="0 90 90">{mass}<joint name="turn" axis="0 0 1" range="-90 90"/><site name="flange" pos="1 0 0"/></body>
  </worldbody>
</mujoco>
"""
arm = f"""
<mujoco model="arm">
  <compiler angle="radian" eulerseq="zyx"/>
  <worldbody><body name="arm">{mass}<joint name="lift" axis="0 1 0" range="-1 1"/></body></worldbody>
</mujoco>
"""


def state(model):
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    limit = float(numpy.degrees(model.joint("turn").range[1]))
    return round(limit, 6), data.body("base").xmat.reshape(3, 3)[:, 0].round(3).tolist()


alone = state(mujoco.MjModel.from_xml_string(base.replace("SETTINGS", "")))
parent = mjcf.from_xml_string(base.replace("SETTINGS", ""))
parent.find("site", "flange").attach(mjcf.from_xml_string(arm))
together = state(mujoco.MjModel.from_xml_string(parent.to_xml_string()))
spec = mujoco.MjSpec.from_string(base.replace("SETTINGS", ""))
spec.attach(mujoco.MjSpec.from_string(arm), site=spec.site("flange"), prefix="arm/")
own = state(spec.compile())
stated = mjcf.from_xml_string(base.replace("SETTINGS", '<compiler angle="degree"/>'))
try:
    stated.find("site", "flange").attach(mjcf.from_xml_string(arm))
    said = "nothing"
except ValueError as error:
    said = str(error).split("\n")[0][:100]
print("limit of the base in degrees and its x axis: alone", alone, "with the arm", together, "by MjSpec", own)
print("where the base states degrees, attach says:", said)
for package in ("dm_control", "mujoco"):
    print(package, importlib.metadata.version(package))
right = alone[0] == own[0] == 90 and numpy.allclose(alone[1], own[1]) and abs(together[0] - 90 * 180 / numpy.pi) < 1e-3
sys.exit(not (right and not numpy.allclose(alone[1], together[1], atol=0.1) and "onflict" in said))
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
