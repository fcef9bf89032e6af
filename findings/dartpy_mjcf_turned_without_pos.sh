#!/usr/bin/env bash
# dartpy 6.20.0: the orientation of a body in an MJCF file is read only where the file gives the body a pos as well.
#
# In MJCF pos and the orientation (quat, euler, axisangle, xyaxes or zaxis) of a body are independent, and a pos of 0 0 0 may be left
# out. DART reads <body euler="0 0 90"> as a body that is not turned, and <body pos="0 0 0" euler="0 0 90"> as one that is, whatever
# the form of the orientation. A wrist whose axes meet in one point is written without pos as a rule: all its links
# come out parallel, and a spherical wrist has three axes in one line. Nothing is said.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check dartpy==6.20.0 mujoco==4.0.0 numpy==2.4.6
cat > "$folder/wrist.xml" <<'MJCF'
<mujoco model="wrist">
  <worldbody>
    <body name="hand" PLACE>
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <joint name="hinge" axis="0 0 1"/>
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

text = open(sys.argv[1] + "/wrist.xml").read()
right = True
for number, orientation in enumerate(('euler="90 0 0"', 'quat="1 1 0 0"', 'axisangle="1 0 0 90"', 'xyaxes="1 0 0 0 0 1"', 'zaxis="0 -1 0"')):
    for pos, expected in (("", 0), ('pos="0 0 0"', 90)):
        path = f"{sys.argv[1]}/wrist_{number}_{expected}.xml"
        open(path, "w").write(text.replace("PLACE", f"{pos} {orientation}"))
        model = mujoco.MjModel.from_xml_path(path)
        data = mujoco.MjData(model)
        mujoco.mj_kinematics(model, data)
        skeleton = dartpy.utils.MjcfParser.readWorld(path).getSkeleton(0)
        frames = data.xmat[1].reshape(3, 3), numpy.array(skeleton.getBodyNode("hand").getWorldTransform().rotation())
        seen = [math.degrees(math.acos(max(-1.0, min(1.0, matrix[2, 2])))) for matrix in frames]
        print(f"{orientation} {pos}: the hinge is {seen[0]:.1f} degrees off the vertical in MuJoCo, {seen[1]:.1f} in DART")
        right &= numpy.allclose(seen, [90, expected], atol=1e-4)
for package in ("dartpy", "mujoco"):
    print(package, importlib.metadata.version(package))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
