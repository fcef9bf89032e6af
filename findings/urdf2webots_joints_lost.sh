#!/usr/bin/env bash
# urdf2webots 2025.0.0: joints between links without mass and shape are gone, and a <mimic> becomes a joint with a motor of its own.
#
# In URDF <inertial>, <visual> and <collision> are optional, and descriptions that carry the kinematics alone leave them out. The
# converter counts such a file right ("There are 3 links, 2 joints") and writes a robot without a single joint. With masses the two
# joints are there; the follower of a <mimic> is then a slider with a motor and a sensor, free of its leader, and the PROTO holds
# no trace of the coupling. Neither is mentioned, while a planar joint is said not to be supported.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check urdf2webots==2025.0.0 numpy==2.4.6
cat > "$folder/rack.urdf" <<'URDF'
<robot name="rack">
  <link name="base">BODY</link><link name="pinion">BODY</link><link name="rack">BODY</link>
  <joint name="turn" type="revolute">
    <parent link="base"/><child link="pinion"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
  <joint name="slide" type="prismatic">
    <parent link="base"/><child link="rack"/><axis xyz="1 0 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/><mimic joint="turn" multiplier="0.05"/>
  </joint>
</robot>
URDF
cat > "$folder/try.py" <<'PYTHON'
import contextlib
import importlib.metadata
import io
import re
import sys
from urdf2webots.importer import convertUrdfFile

text = open(sys.argv[1] + "/rack.urdf").read()
body = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
seen = {}
for name, inside in (("with masses", body), ("kinematics alone", "")):
    path = f"{sys.argv[1]}/{name.replace(' ', '_')}.urdf"
    to = path.replace(".urdf", ".proto")
    open(path, "w").write(text.replace("BODY", inside))
    said = io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
        convertUrdfFile(input=path, output=to)
    proto = open(to).read()
    counted = re.search(r"There are .* joints", said.getvalue()).group()
    told = "mimic" in said.getvalue().lower() or "mimic" in proto.lower() or "coupl" in proto.lower()
    seen[name] = len(re.findall(r"\w+Joint \{", proto)), len(re.findall(r"\w+Motor \{", proto)), told
    print(f"{name}: says \"{counted}\", writes {seen[name][0]} joints and {seen[name][1]} motors; the coupling is mentioned: {told}")
print("version:", importlib.metadata.version("urdf2webots"))
sys.exit(seen != {"with masses": (2, 2, False), "kinematics alone": (0, 0, False)})
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
