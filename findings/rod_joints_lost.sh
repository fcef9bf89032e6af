#!/usr/bin/env bash
# rod 0.5.0: converting SDF to URDF drops ball, universal and screw joints and mimics; the URDF falls into parts.
#
# URDF has no such joints (a <mimic> it has), so a converter must refuse or say what is missing. rod's exporter writes the links and
# leaves the joints out, without an exception and without a message: the file has two root links and is no tree. Of two coupled
# hinges (<mimic> inside <axis>, SDFormat 1.11) the coupling is gone and the URDF has two freedoms for one.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check rod==0.5.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import logging
import sys
import xml.etree.ElementTree as tree
import rod
from rod.urdf.exporter import UrdfExporter

said = []
handler = logging.Handler()
handler.emit = lambda record: said.append(record.getMessage())
logging.getLogger().addHandler(handler)

inertial = ("<inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz>"
            "<ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial>")
inside = "<parent>a</parent><child>b</child>"
axis = "<axis><xyz>0 1 0</xyz>MORE<limit><lower>-1</lower><upper>2</upper></limit></axis>"
plain = axis.replace("MORE", "")
mimic = axis.replace("MORE", '<mimic joint="j"><multiplier>2</multiplier><offset>0.1</offset><reference>0</reference></mimic>')
cases = {
    "revolute": (f'<joint name="j" type="revolute">{inside}{plain}</joint>', 1, 1),
    "ball": (f'<joint name="j" type="ball">{inside}</joint>', 0, 2),
    "universal": (f'<joint name="j" type="universal">{inside}{plain}{plain.replace("axis>", "axis2>")}</joint>', 0, 2),
    "screw": (f'<joint name="j" type="screw">{inside}<screw_thread_pitch>0.01</screw_thread_pitch>{plain}</joint>', 0, 2),
    "mimic": (f'<joint name="j" type="revolute">{inside}{plain}</joint><link name="c">{inertial}</link>'
              f'<joint name="k" type="revolute"><parent>a</parent><child>c</child>{mimic}</joint>', 2, 1),
}
right = True
for name, (joints, many, parts) in cases.items():
    text = f'<sdf version="1.11"><model name="m"><link name="a">{inertial}</link><link name="b">{inertial}</link>{joints}</model></sdf>'
    robot = tree.fromstring(UrdfExporter(pretty=True).to_urdf_string(rod.Sdf.load(text, is_urdf=False)))
    kept = [joint.get("type") for joint in robot.findall("joint")]
    roots = len(robot.findall("link")) - len(kept)
    mimics = len(robot.findall("joint/mimic"))
    print(f"{name}: joints in the URDF {kept}, mimics {mimics}, root links {roots}")
    right &= (len(kept), roots, mimics) == (many, parts, 0)
print("messages:", said)
print("version:", importlib.metadata.version("rod"))
sys.exit(not (right and not said))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
