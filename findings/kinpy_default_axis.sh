#!/usr/bin/env bash
# kinpy 0.6.1: a URDF joint without <axis> turns about z; the length of <axis> multiplies the travel of a slide.
#
# URDF's default axis is (1, 0, 0), and an axis is a direction. kinpy keeps "no axis" as such while it reads and then takes z,
# which is MJCF's default. <axis xyz="0 2 0"/> of a prismatic joint makes 0.25 m into 0.5 m; of a hinge it does nothing. Nothing
# is said in either case. Pinocchio reads both as the specification says.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check kinpy==0.6.1 pin==4.1.0 numpy==2.4.6
cat > "$folder/arm.urdf" <<'URDF'
<robot name="arm">
  <link name="base"/>
  <link name="arm"/>
  <link name="rod"/>
  <joint name="hinge" type="continuous">
    <parent link="base"/>
    <child link="arm"/>
  </joint>
  <joint name="slide" type="prismatic">
    <parent link="arm"/>
    <child link="rod"/>
    <axis xyz="0 2 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
</robot>
URDF
cat > "$folder/try.py" <<'PYTHON'
import sys
import kinpy
import numpy
import pinocchio

path = sys.argv[1] + "/arm.urdf"
model = pinocchio.buildModelFromUrdf(path)
data = model.createData()
chain = kinpy.build_chain_from_urdf(open(path).read())


def place(turn, travel):
    q = numpy.array([numpy.cos(turn), numpy.sin(turn), travel])
    pinocchio.framesForwardKinematics(model, data, q)
    expected = data.oMf[model.getFrameId("rod")].homogeneous
    return expected, chain.forward_kinematics({"hinge": turn, "slide": travel})["rod"].matrix()


turned, seen = place(0.5, 0)
axis = [seen[2, 1] - seen[1, 2], seen[0, 2] - seen[2, 0], seen[1, 0] - seen[0, 1]]
right = [turned[2, 1] - turned[1, 2], turned[0, 2] - turned[2, 0], turned[1, 0] - turned[0, 1]]
print("hinge at 0.5 rad: Pinocchio turns about", numpy.sign(right), "kinpy about", numpy.sign(axis))
moved, travelled = (pose[1, 3] for pose in place(0, 0.25))
print("slide at 0.25 m: Pinocchio", moved, "kinpy", travelled)
sys.exit(not (axis[2] > 0.9 and abs(axis[0]) < 1e-9 and right[0] > 0.9 and moved == 0.25 and travelled == 0.5))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
