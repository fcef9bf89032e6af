#!/usr/bin/env bash
# urdfeus 1.2.6: a URDF taken to EusLisp and back has the offset of a <mimic> twice, and inertias without their rpy.
#
# urdf2eus writes a follower where its joint is 0 and then moves it by the offset, as EusLisp needs it. eus2urdf (backend "static", which
# needs no EusLisp) reads the moved place as the joint's <origin> and writes the offset of the <mimic> beside it: a wheel at 0.3 rad
# when its driver is at 0 comes back at 0.6, a rack at 0.05 m at 0.1. The <origin> of an <inertial> keeps its xyz; its rpy is dropped and
# the tensor is written as it stood, so that the principal axes of a bar turned by 90 degrees lie across it. Nothing is reported.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check urdfeus==1.2.6 scikit-robot==0.4.7
cat > "$folder/press.urdf" <<'URDF'
<robot name="press">
  <link name="base"/>
  <link name="disc">
    <inertial>
      <origin xyz="0.1 0 0" rpy="0 0 1.5707963267948966"/><mass value="1"/>
      <inertia ixx="1" iyy="2" izz="2.5" ixy="0" ixz="0" iyz="0"/>
    </inertial>
  </link>
  <link name="wheel_disc"/>
  <link name="rack_bar"/>
  <joint name="driver" type="revolute">
    <parent link="base"/><child link="disc"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
  <joint name="wheel" type="revolute">
    <parent link="base"/><child link="wheel_disc"/><origin xyz="0.5 0 0"/><axis xyz="0 0 1"/>
    <mimic joint="driver" multiplier="-2" offset="0.3"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/>
  </joint>
  <joint name="rack" type="prismatic">
    <parent link="base"/><child link="rack_bar"/><origin xyz="0 1 0"/><axis xyz="1 0 0"/>
    <mimic joint="driver" multiplier="0.1" offset="0.05"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
</robot>
URDF
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import subprocess
import sys
import xml.etree.ElementTree as xml

folder = sys.argv[1]
run = folder + "/venv/bin/"
said = []
for command in ([run + "urdf2eus", folder + "/press.urdf", folder + "/press.l"],
                [run + "eus2urdf", "--backend", "static", folder + "/press.l", folder + "/back"]):
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    said.append(done.stdout + done.stderr)
robot = xml.parse(folder + "/back/urdf/press.urdf").getroot()


def numbers(text):
    return [float(value) for value in text.split()]


wheel, rack = (robot.find(f"joint[@name='{name}']") for name in ("wheel", "rack"))
turned = numbers(wheel.find("origin").get("rpy"))[2], float(wheel.find("mimic").get("offset"))
moved = numbers(rack.find("origin").get("xyz"))[0], float(rack.find("mimic").get("offset"))
inertial = robot.find("link[@name='disc']/inertial")
rpy, tensor = numbers(inertial.find("origin").get("rpy")), inertial.find("inertia").attrib
print(f"wheel at driver 0: origin turned by {turned[0]} and offset {turned[1]}; in the file 0 and 0.3")
print(f"rack at driver 0: origin moved by {moved[0]} and offset {moved[1]}; in the file 0 and 0.05")
print("inertial: rpy", rpy, "ixx", tensor["ixx"], "iyy", tensor["iyy"], "; in the file rpy 0 0 1.5708, ixx 1, iyy 2")
print("warnings:", [line for text in said for line in text.splitlines() if "warn" in line.lower()])
print("urdfeus", importlib.metadata.version("urdfeus"))
sys.exit(not (
    math.isclose(turned[0], 0.3, abs_tol=1e-5) and turned[1] == 0.3 and math.isclose(moved[0], 0.05, abs_tol=1e-5) and moved[1] == 0.05
    and rpy == [0, 0, 0] and float(tensor["ixx"]) == 1 and float(tensor["iyy"]) == 2))
PYTHON
cd "$folder" && "$folder/venv/bin/python" "$folder/try.py" "$folder"
