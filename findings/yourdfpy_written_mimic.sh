#!/usr/bin/env bash
# yourdfpy 0.0.60: a URDF that is loaded and saved has lost its couplings: <mimic> is read and obeyed, but not written.
#
# "Loading, manipulating, saving" is what the library is for, and its writer keeps all digits of poses, axes and limits. A follower with
# <mimic> is moved by update_cfg as it should be. In the file that write_xml_file makes it is a joint of its own: a
# mechanism of one degree of freedom has two. <safety_controller> and <calibration> go the same way, without a warning, and
# URDF.validate finds nothing wrong. urchin, of which the interface is much the same, writes all three.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check yourdfpy==0.0.60 urchin==0.0.30 numpy==2.4.6
cat > "$folder/gears.urdf" <<'URDF'
<robot name="gears">
  <link name="base"/><link name="wheel"/><link name="pinion"/>
  <joint name="wheel" type="revolute">
    <parent link="base"/><child link="wheel"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
    <safety_controller k_velocity="1" soft_lower_limit="-0.5" soft_upper_limit="0.5"/>
    <calibration rising="0.3"/>
  </joint>
  <joint name="pinion" type="continuous">
    <parent link="base"/><child link="pinion"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
    <mimic joint="wheel" multiplier="-3" offset="0.1"/>
  </joint>
</robot>
URDF
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import xml.etree.ElementTree as tree
import urchin
import yourdfpy

first, second, third = (f"{sys.argv[1]}/{name}.urdf" for name in ("gears", "yourdfpy", "urchin"))
kinds = ("mimic", "safety_controller", "calibration")


def angle(robot):
    robot.update_cfg({"wheel": 0.5})
    pose = robot.get_transform("pinion")
    return robot.num_dofs, math.atan2(pose[1, 0], pose[0, 0])


def tags(path):
    return [kind for kind in kinds if tree.parse(path).getroot().find(f".//{kind}") is not None]


robot = yourdfpy.URDF.load(first)
before = angle(robot)
valid = robot.validate()
robot.write_xml_file(second)
after = angle(yourdfpy.URDF.load(second))
urchin.URDF.load(first).save(third)
print("degrees of freedom and angle of the pinion, as read", before, "as saved and read again", after)
print("saved by yourdfpy:", tags(second), "by urchin:", tags(third), "- valid:", valid)
for package in ("yourdfpy", "urchin"):
    print(package, importlib.metadata.version(package))
right = before[0] == 1 and abs(before[1] + 1.4) < 1e-9 and after == (2, 0.0) and valid
sys.exit(not (right and tags(second) == [] and tags(third) == list(kinds)))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder" 2> "$folder/said" || { cat "$folder/said"; exit 1; }
if grep -iE "mimic|safety|calibration" "$folder/said"; then exit 1; fi
