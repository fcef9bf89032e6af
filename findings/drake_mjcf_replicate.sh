#!/usr/bin/env bash
# drake 1.51.1: bodies that an MJCF file writes inside <replicate> are not there, and unlike <frame> this is not said.
#
# <replicate> makes copies of what it holds, each turned and moved on: the usual way to write the legs of a hexapod or the rods of
# a platform. Drake's reader warns of every tag and attribute that it does not support; a <frame> is announced as "currently unsupported and
# will be ignored". A <replicate> in the same place is passed over in silence, and the model, three arms on a base in MuJoCo, is a base alone.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check drake==1.51.1 mujoco==4.0.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import logging
import sys
import mujoco
from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import MultibodyPlant

text = """
<mujoco model="platform">
  <worldbody>
    <body name="base">
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <HOLDER>
        <body name="arm" pos="1 0 0">
          <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
          <joint name="hinge" axis="0 1 0"/>
        </body>
      </HOLDER>
    </body>
  </worldbody>
</mujoco>
"""


class Heard(logging.Handler):
    def __init__(self):
        super().__init__()
        self.said = []

    def emit(self, record):
        self.said.append(record.getMessage().split("warning: ")[-1])


logger = logging.getLogger("drake")
logger.propagate = False
seen = {}
for holder in ('replicate count="3" euler="0 0 120"', 'frame pos="0 0 1"'):
    name = holder.split()[0]
    file = text.replace("</HOLDER>", f"</{name}>").replace("HOLDER", holder)
    model = mujoco.MjModel.from_xml_string(file)
    heard = Heard()
    logger.handlers = [heard]
    plant = MultibodyPlant(0.0)
    Parser(plant).AddModelsFromString(file, "xml")
    plant.Finalize()
    seen[name] = model.nbody, model.njnt, plant.num_bodies(), len([m for m in heard.said if name in m])
    print(f"<{name}>: MuJoCo has {model.nbody} bodies with the world and {model.njnt} joints, Drake {plant.num_bodies()} bodies;",
          "Drake says", heard.said)
for package in ("drake", "mujoco"):
    print(package, importlib.metadata.version(package))
sys.exit(seen != {"replicate": (5, 3, 2, 0), "frame": (3, 1, 2, 1)})
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
