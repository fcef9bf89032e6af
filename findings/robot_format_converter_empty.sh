#!/usr/bin/env bash
# robot-format-converter 1.0.0: "Successfully converted" stands over MJCF files without a body and over URDF files with all frames unturned.
#
# Its list of formats has URDF, SDF, MJCF and USD, each for reading and writing. Of a URDF with two links and a joint the MJCF is
# <worldbody/> with nothing in it. The SDF has joints without type, axis and pose. URDF to URDF keeps the xyz of an <origin> and writes rpy as
# 0 0 0, so that a hinge that was turned by rpy points elsewhere; <mimic> is dropped. The exit code is 0 and the links and joints
# are counted each time.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check robot-format-converter==1.0.0
cat > "$folder/arm.urdf" <<'URDF'
<robot name="arm">
  <link name="base"/><link name="arm"/><link name="hand"/>
  <joint name="shoulder" type="continuous">
    <parent link="base"/><child link="arm"/><origin xyz="0 0 1" rpy="1.5707963267948966 0 0"/><axis xyz="0 0 1"/>
  </joint>
  <joint name="wrist" type="continuous">
    <parent link="arm"/><child link="hand"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/><mimic joint="shoulder" multiplier="-1"/>
  </joint>
</robot>
URDF
cd "$folder"
for target in xml sdf; do
  venv/bin/robot-convert convert arm.urdf "arm.$target" > "$target.said" 2>> log
  grep -q "Successfully converted" "$target.said"
  grep -q "Links: 3, Joints: 2" "$target.said"
done
venv/bin/robot-convert convert --source urdf --target urdf arm.urdf again.urdf >> log 2>&1
cat > try.py <<'PYTHON'
import importlib.metadata
import sys
import xml.etree.ElementTree as tree

mjcf, sdf, urdf = (tree.parse(name).getroot() for name in ("arm.xml", "arm.sdf", "again.urdf"))
bodies = len(mjcf.findall(".//body"))
parts = sorted({child.tag for joint in sdf.findall(".//joint") for child in joint} | set(sdf.find(".//joint").attrib))
turned = [joint.find("origin").attrib for joint in urdf.findall("joint")]
coupled = len(urdf.findall(".//mimic"))
print("bodies of the MJCF:", bodies, "- what a joint of the SDF has:", parts)
print("origins in the URDF written again:", turned, "- couplings:", coupled)
print("version:", importlib.metadata.version("robot-format-converter"))
same = [float(x) for x in turned[0]["rpy"].split()] == [0, 0, 0] and [float(x) for x in turned[0]["xyz"].split()] == [0, 0, 1]
sys.exit(not (bodies == 0 and parts == ["child", "name", "parent"] and same and coupled == 0))
PYTHON
venv/bin/python try.py
cat xml.said
