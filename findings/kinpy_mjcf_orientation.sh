#!/usr/bin/env bash
# kinpy 0.6.1: of an MJCF file only quat turns a body, <default> is not applied, and the second body of the world is gone.
#
# kinpy names MJCF among its formats and parses the whole of it: euler, axisangle, xyaxes and zaxis and default classes are read
# without an objection. Its chain is made from quat, and from what stands in the joint itself. So a body with euler="90 0 0" is not
# turned, a joint with axis 1 0 0 from <default> turns about z, and of two bodies in the world the chain has the first only. MuJoCo
# puts the end of the arm 1.4 m from where kinpy has it. A joint that leaves type out, a hinge by default, raises KeyError.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check kinpy==0.6.1 mujoco==4.0.0 numpy==2.4.6
cat > "$folder/arm.xml" <<'MJCF'
<mujoco model="arm">
  <default>
    <joint type="hinge" axis="1 0 0"/>
    <geom type="sphere" size="0.1"/>
  </default>
  <worldbody>
    <body name="arm" EULER>
      <joint name="swing" TYPE AXIS/>
      <geom type="sphere" size="0.1"/>
      <body name="tip" pos="0 1 0">
        <geom type="sphere" size="0.1"/>
      </body>
    </body>
    <body name="other">
      <joint name="spin" type="hinge" axis="0 0 1"/>
      <geom type="sphere" size="0.1"/>
    </body>
  </worldbody>
</mujoco>
MJCF
cat > "$folder/try.py" <<'PYTHON'
import sys
import kinpy
import mujoco
import numpy

text = open(sys.argv[1] + "/arm.xml").read()


def compare(euler, kind, axis):
    file = text.replace("EULER", euler).replace("TYPE", kind).replace("AXIS", axis)
    model = mujoco.MjModel.from_xml_string(file)
    data = mujoco.MjData(model)
    data.joint("swing").qpos = 0.5
    mujoco.mj_kinematics(model, data)
    chain = kinpy.build_chain_from_mjcf(file)
    tip = chain.forward_kinematics({"swing": 0.5})["tip"].pos
    names = chain.get_joint_parameter_names()
    print(f"{euler:20} {axis:16} MuJoCo {data.body('tip').xpos.round(3)}  kinpy {tip.round(3)} of joints {names}")
    return numpy.linalg.norm(tip - data.body("tip").xpos), names


hinge = 'type="hinge"'
agree, names = compare("", hinge, 'axis="1 0 0"')
turned, _ = compare('euler="90 0 0"', hinge, 'axis="1 0 0"')
quaternion, _ = compare('quat="1 1 0 0"', hinge, 'axis="1 0 0"')
default, _ = compare("", hinge, "")
try:
    compare("", "", 'axis="1 0 0"')
    refused = False
except KeyError as error:
    print("without type: KeyError", error)
    refused = True
sys.exit(not (max(agree, quaternion) < 1e-9 < 1 < turned and default > 0.6 and names == ["swing"] and refused))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
