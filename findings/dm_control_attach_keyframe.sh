#!/usr/bin/env bash
# dm_control 1.0.50: after attach the keyframe of the arm moves the base, and the arm stands still.
#
# A <key> gives all of qpos, in the order of the joints. mjcf's attach copies the keys of the arm beside those of the base and changes none of
# them: the arm's "home" still has one number, which is now that of the first joint of the whole, the base's. Nothing is said, by
# MuJoCo 4 neither, which takes what a short qpos lacks from the pose drawn. MjSpec.attach completes the keys: those of the base get the arm at
# rest, those of the arm get the base at rest.
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
from dm_control import mjcf

mass = '<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>'
base = f"""
<mujoco model="base">
  <worldbody><body name="base">{mass}<joint name="turn"/><site name="flange" pos="1 0 0"/></body></worldbody>
  <keyframe><key name="home" qpos="0.2"/></keyframe>
</mujoco>
"""
arm = f"""
<mujoco model="arm">
  <worldbody><body name="arm">{mass}<joint name="lift"/></body></worldbody>
  <keyframe><key name="home" qpos="0.5"/></keyframe>
</mujoco>
"""
parent = mjcf.from_xml_string(base)
parent.find("site", "flange").attach(mjcf.from_xml_string(arm))
text = parent.to_xml_string()
keys = [line.strip() for line in text.splitlines() if "<key " in line]


def poses(model):
    names = [model.joint(i).name for i in range(model.njnt)]
    return {model.key(i).name: dict(zip(names, model.key_qpos[i].tolist())) for i in range(model.nkey)}


spec = mujoco.MjSpec.from_string(base)
spec.attach(mujoco.MjSpec.from_string(arm), site=spec.site("flange"), prefix="arm/")
together, own = poses(mujoco.MjModel.from_xml_string(text)), poses(spec.compile())
print("keys after attach:", keys)
print("read by MuJoCo:", together)
print("keys after MjSpec.attach:", own)
for package in ("dm_control", "mujoco"):
    print(package, importlib.metadata.version(package))
right = together == {"home": {"turn": 0.2, "arm/lift": 0.0}, "arm/home": {"turn": 0.5, "arm/lift": 0.0}}
sys.exit(not (right and len(keys) == 2 and own == {"home": {"turn": 0.2, "arm/lift": 0.0}, "arm/home": {"turn": 0.0, "arm/lift": 0.5}}))
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
