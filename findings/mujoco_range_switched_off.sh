#!/usr/bin/env bash
# mujoco 4.0.0: the range of a joint that is not limited stays in degrees, in the compiled model and in a saved file that says radian.
#
# MJCF's range is in degrees unless the compiler says otherwise; jnt_range of a compiled model, and the file that to_xml writes with
# angle="radian", are in radians. With limited="false", the usual way to switch a limit off for a while, the numbers are left as they were
# written: -30 and 30. Switched on again, in the model (jnt_limited) or in the saved file, the limit is at 30 radians. Switched on in the
# file it came from, it is at 30 degrees. ref, in the same element, is converted either way.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check mujoco==4.0.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import sys
import mujoco
import numpy

text = """
<mujoco model="arm">
  <worldbody>
    <body name="arm">
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <joint name="hinge" ref="10" range="-30 30" limited="false"/>
    </body>
  </worldbody>
</mujoco>
"""


def ask(name, file):
    model = mujoco.MjModel.from_xml_string(file)
    print(f"{name}: limited {model.jnt_limited[0]}, range {model.jnt_range[0]}, drawn at {model.qpos0[0]:.6f}")
    return list(model.jnt_range[0]), model.qpos0[0]


on = 'limited="true"'
spec = mujoco.MjSpec.from_string(text)
spec.compile()
saved = spec.to_xml()
print("mujoco", mujoco.__version__)
print([line.strip() for line in saved.splitlines() if "range" in line or "angle" in line])
seen = [
    ask("as written", text),
    ask("as written, switched on", text.replace('limited="false"', on)),
    ask("saved", saved),
    ask("saved, switched on", saved.replace('limited="false"', on)),
]
degrees = numpy.radians(30)
right = numpy.allclose([limits[1] for limits, _ in seen], [30, degrees, 30, 30])
right &= numpy.allclose([drawn for _, drawn in seen], numpy.radians(10), atol=1e-5)
sys.exit(not (right and 'angle="radian"' in saved))
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
