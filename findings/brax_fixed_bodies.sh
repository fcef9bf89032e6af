#!/usr/bin/env bash
# brax 0.14.2: a body without a joint is merged into its parent as text: files are refused, or the order of their coordinates changes.
#
# A body of an MJCF file without a joint is welded to its parent. Brax moves what such a body holds into the parent's element and only then
# asks MuJoCo. Where both have an <inertial>, MuJoCo refuses the file ("found 2 times"); where the welded body is moved and holds a body
# that has an euler, so too ("multiple orientation specifiers"): the errors are about a text that nobody wrote. A file that passes may have other
# coordinates: children of a welded base come after the bodies that follow it, so that q[0] is the second arm's, not the first's.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check brax==0.14.2 mujoco==4.0.0 mujoco-mjx==3.17.0 jax==0.10.2 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
import mujoco
from brax.io import mjcf

files = {
    "masses": """
<mujoco><worldbody>
  <body name="arm"><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/><joint name="first"/>
    <body name="hand" pos="1 0 0"><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/></body>
  </body>
</worldbody></mujoco>""",
    "orientations": """
<mujoco><worldbody>
  <body name="base" pos="0 0 1"><geom size="0.1"/>
    <body name="arm" pos="1 0 0" euler="0 0 90"><geom size="0.1"/><joint name="first"/></body>
  </body>
</worldbody></mujoco>""",
    "order": """
<mujoco><worldbody>
  <body name="base" pos="0 0 1"><geom size="0.1"/>
    <body name="left" pos="1 0 0"><geom size="0.1"/><joint name="first"/></body>
  </body>
  <body name="right" pos="3 0 0"><geom size="0.1"/><joint name="second"/></body>
</worldbody></mujoco>""",
}
seen = {}
for name, file in files.items():
    model = mujoco.MjModel.from_xml_string(file)
    joints = [model.body(model.jnt_bodyid[i]).name for i in range(model.njnt)]
    try:
        seen[name] = mjcf.loads(file).link_names
    except ValueError as error:
        seen[name] = str(error).split("\n")[0]
    print(f"{name}: bodies that move, in the order of q: MuJoCo {joints}, Brax {seen[name]}")
for package in ("brax", "mujoco"):
    print(package, importlib.metadata.version(package))
right = "'inertial' found 2 times" in seen["masses"] and "multiple orientation" in seen["orientations"]
sys.exit(not (right and joints == ["left", "right"] and seen["order"] == ["right", "left"]))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" 2> "$folder/said" || { cat "$folder/said"; exit 1; }
