#!/usr/bin/env bash
# klampt 0.10.1.post1: a URDF hinge about a diagonal axis such as 1 1 0 turns about x; axis 3 4 0 makes five radians of one.
#
# In URDF the axis is a direction; its length has no meaning. Klamp't takes an axis with a component that is exactly 1 for the
# coordinate axis of that component: 0 1 1 turns about y, 1 1 1 and 1 2 3 turn about x. Axes without a 1 turn about the
# right line, by the angle times the length of the axis: 3 4 0 set to 0.5 rad stands at 2.5. Frames remain proper rotations, getAxis
# returns what the file says, and nothing is said, so only the pose shows it. Axes of length one are right.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check klampt==0.10.1.post1 numpy==2.4.6
cat > "$folder/arm.urdf" <<'URDF'
<robot name="arm">
  <link name="base"/>
  <link name="arm">
    <inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <joint name="hinge" type="revolute">
    <parent link="base"/>
    <child link="arm"/>
    <axis xyz="AXIS"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
</robot>
URDF
cat > "$folder/try.py" <<'PYTHON'
import sys
import klampt
import numpy
from klampt.math import so3

text = open(sys.argv[1] + "/arm.urdf").read()


def turned(axis):
    path = f"{sys.argv[1]}/{axis.replace(' ', '_')}.urdf"
    open(path, "w").write(text.replace("AXIS", axis))
    world = klampt.WorldModel()
    world.readFile(path)
    robot = world.robot(0)
    link = robot.link("arm")
    q = robot.getConfig()
    q[link.getIndex()] = 0.5
    robot.setConfig(q)
    vector = numpy.array(so3.moment(link.getTransform()[0]))
    print(f"axis {axis}, set to 0.5 rad: turned by {numpy.linalg.norm(vector):.6f} about {vector / numpy.linalg.norm(vector)}")
    return vector


expected = {
    "0.6 0.8 0": [0.3, 0.4, 0],
    "1 1 0": [0.5, 0, 0],
    "0 1 1": [0, 0.5, 0],
    "1 2 3": [0.5, 0, 0],
    "3 4 0": [1.5, 2, 0],
}
sys.exit(not all(numpy.allclose(turned(axis), vector, atol=1e-6) for axis, vector in expected.items()))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
