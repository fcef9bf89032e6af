#!/usr/bin/env bash
# dartpy 6.20.0: a hinge of an MJCF file that may turn by 90 degrees may turn by 90 radians in DART.
#
# MJCF's angles are in degrees unless the compiler says otherwise; DART's positions are in radians. Its MJCF reader converts euler and
# axisangle of the same file, but hands the numbers of range over as they are: -90..90 degrees becomes -90..90 rad, fourteen turns
# each way, which is no limit at all. With angle="radian" the limits are right. Nothing is said.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check dartpy==6.20.0 mujoco==4.0.0 numpy==2.4.6
cat > "$folder/arm.xml" <<'MJCF'
<mujoco model="arm">
  <compiler angle="ANGLE"/>
  <worldbody>
    <body name="arm" pos="1 0 0" FRAME>
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <joint name="hinge" axis="0 0 1" range="RANGE"/>
    </body>
  </worldbody>
</mujoco>
MJCF
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import dartpy
import mujoco
import numpy

text = open(sys.argv[1] + "/arm.xml").read()
quarter = math.pi / 2
right = True
for number, (angle, turn, limits, upper) in enumerate((
    ("radian", "0 0 1.5707963267948966", "-1.5707963267948966 1.5707963267948966", quarter),
    ("degree", "0 0 90", "-90 90", 90),
)):
    path = f"{sys.argv[1]}/arm_{number}.xml"
    open(path, "w").write(text.replace("ANGLE", angle).replace("FRAME", f'euler="{turn}"').replace("RANGE", limits))
    model = mujoco.MjModel.from_xml_path(path)
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    skeleton = dartpy.utils.MjcfParser.readWorld(path).getSkeleton(0)
    frames = data.xmat[1].reshape(3, 3), numpy.array(skeleton.getBodyNode("arm").getWorldTransform().rotation())
    yaw = [math.atan2(matrix[1, 0], matrix[0, 0]) for matrix in frames]
    most = float(model.jnt_range[0][1]), float(numpy.ravel(skeleton.getPositionUpperLimits())[0])
    print(f'angle="{angle}": upper limit {most[0]:.4f} in MuJoCo, {most[1]:.4f} in DART;',
          f"turned by {yaw[0]:.4f} in MuJoCo, {yaw[1]:.4f} in DART")
    right &= numpy.allclose([*most, *yaw], [quarter, upper, quarter, quarter])
for package in ("dartpy", "mujoco"):
    print(package, importlib.metadata.version(package))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
