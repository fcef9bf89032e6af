#!/usr/bin/env bash
# pin 4.1.0: whether a <mimic> of a URDF is read or refused depends on the names of the links.
#
# URDF lets any joint follow any other. With mimic=True Pinocchio couples the joints, provided that the leader is already in its model.
# It adds the children of a link in the order of their names, whatever the order in the file: a right finger that follows the left one is read,
# a left finger that follows the right one is refused with "The parent joint of the mimic joint is not in the kinematic tree". So is a
# follower nearer to the base than its leader, under any name. Without mimic=True, the default, all <mimic> elements are passed over and
# the model has two freedoms for one.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pin==4.1.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import sys
import pinocchio

text = """
<robot name="gripper">
  <link name="base"/><link name="left"/><link name="right"/>
  <joint name="left" type="prismatic">
    <parent link="base"/><child link="left"/><axis xyz="0 1 0"/><limit lower="0" upper="1" effort="1" velocity="1"/>LEFT
  </joint>
  <joint name="right" type="prismatic">
    <parent link="PARENT"/><child link="right"/><axis xyz="0 -1 0"/><limit lower="0" upper="1" effort="1" velocity="1"/>RIGHT
  </joint>
</robot>
"""


def freedoms(left, right, parent="base", **options):
    file = text.replace("LEFT", left).replace("RIGHT", right).replace("PARENT", parent)
    try:
        return pinocchio.buildModelFromXML(file, **options).nv
    except ValueError as error:
        return str(error)


of_left, of_right = '<mimic joint="left"/>', '<mimic joint="right"/>'
seen = {
    "right follows left": freedoms("", of_left, mimic=True),
    "left follows right": freedoms(of_right, "", mimic=True),
    "in a row, the second follows": freedoms("", of_left, "left", mimic=True),
    "in a row, the first follows": freedoms(of_right, "", "left", mimic=True),
    "left follows right, by default": freedoms(of_right, ""),
}
for name, found in seen.items():
    print(f"{name}: {found}")
print("pin", pinocchio.__version__)
refused = [isinstance(found, str) and "mimic joint is not in the kinematic tree" in found for found in seen.values()]
sys.exit(not (refused == [False, True, False, True, False] and [f for f in seen.values() if not isinstance(f, str)] == [1, 1, 2]))
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
