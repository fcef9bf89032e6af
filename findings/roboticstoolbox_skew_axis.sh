#!/usr/bin/env bash
# roboticstoolbox-python 1.5.0: a URDF joint whose axis is not along x, y or z gets another axis and another pose at rest.
#
# In URDF the child's frame is the joint's frame at q = 0, whatever the axis. The toolbox reads x, y and z right, with either sign.
# For any other axis it puts a turn of one radian before the joint, about a line across the axis, and then moves along or
# about its z. So at q = 0 the next link is turned already, and the axis (0.6, 0.8, 0) becomes (0.67, -0.50, 0.54), 90 degrees off.
# Robots with inclined axes load without a word and answer wrong from the first pose on; the usual industrial arms have none,
# which is why it does not show.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check \
  roboticstoolbox-python==1.5.0 pin==4.1.0 numpy==2.4.6
cat > "$folder/slide.urdf" <<'URDF'
<robot name="slide">
  <link name="base"/><link name="carriage"/>
  <joint name="slide" type="prismatic">
    <parent link="base"/><child link="carriage"/><axis xyz="AXIS"/>
    <limit lower="-2" upper="2" effort="1" velocity="1"/>
  </joint>
</robot>
URDF
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import warnings
import numpy
import pinocchio

warnings.simplefilter("ignore")
from roboticstoolbox import Robot

text = open(sys.argv[1] + "/slide.urdf").read()
right = True
for number, (axis, turned, off) in enumerate((("0 0 1", 0, 0), ("0 -1 0", 0, 0), ("0.6 0.8 0", 1, 90), ("0 0.6 0.8", 1, 36.87))):
    path = f"{sys.argv[1]}/slide_{number}.urdf"
    open(path, "w").write(text.replace("AXIS", axis))
    model = pinocchio.buildModelFromUrdf(path)
    data = model.createData()
    pinocchio.forwardKinematics(model, data, numpy.array([1.0]))
    robot = Robot.URDF(path)
    rest, moved = robot.fkine([0.0], end="carriage").A, robot.fkine([1.0], end="carriage").A
    angle = math.acos(min(1.0, max(-1.0, (numpy.trace(rest[:3, :3]) - 1) / 2)))
    way = moved[:3, 3] - rest[:3, 3]
    between = math.degrees(math.acos(min(1.0, way @ data.oMi[1].translation)))
    print(f"axis {axis}: at rest turned by {angle:.4f} rad; slides along {way.round(4)}, {between:.1f} degrees off;",
          "in Pinocchio along", data.oMi[1].translation.round(4))
    right &= abs(angle - turned) < 1e-4 and abs(between - off) < 0.1
for package in ("roboticstoolbox-python", "spatialmath-python", "pin"):
    print(package, importlib.metadata.version(package))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
