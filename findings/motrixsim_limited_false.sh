#!/usr/bin/env bash
# motrixsim 0.10.1: a limit that an MJCF file switches off with limited="false" stops the joint.
#
# In MJCF a range alone limits a joint (autolimits), limited="false" takes the limit away and leaves the numbers for later. MotrixSim reads
# range and not limited: a hinge that is free in MuJoCo, started at 2 rad, is driven back to its range of 30 degrees, as far as with
# limited="true". Nothing is said, though its reader names the attributes that it does not support in other places.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check motrixsim==0.10.1 mujoco==4.0.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
import motrixsim
import mujoco
import numpy

text = """
<mujoco model="arm">
  <option gravity="0 0 0"/>
  <worldbody>
    <body name="arm">
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <joint name="hinge" damping="2" LIMIT/>
    </body>
  </worldbody>
</mujoco>
"""


def rest(limit):
    file = text.replace("LIMIT", limit)
    model = mujoco.MjModel.from_xml_string(file)
    data = mujoco.MjData(model)
    data.qpos[:] = 2
    other = motrixsim.load_mjcf_str(file)
    state = motrixsim.SceneData(other)
    state.set_dof_pos(numpy.array([2.0], dtype=numpy.float32), other)
    for _ in range(3000):
        mujoco.mj_step(model, data)
        motrixsim.step(other, state)
    return float(data.qpos[0]), float(numpy.array(state.dof_pos)[0])


ends = {}
for limit in ("", 'range="-30 30"', 'range="-30 30" limited="true"', 'range="-30 30" limited="false"'):
    ends[limit] = rest(limit)
    print(f"[{limit}] started at 2 rad, ends at {ends[limit][0]:.3f} in MuJoCo, {ends[limit][1]:.3f} in MotrixSim")
for package in ("motrixsim", "mujoco"):
    print(package, importlib.metadata.version(package))
free, on, off = ends[""], ends['range="-30 30"'], ends['range="-30 30" limited="false"']
sys.exit(not (min(free) > 1.99 and max(on) < 0.6 and off[0] > 1.99 and off[1] < 0.6))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" > "$folder/said" 2>&1 || { cat "$folder/said"; exit 1; }
cat "$folder/said"
if grep -i "warn" "$folder/said"; then exit 1; fi
