#!/usr/bin/env bash
# dartpy 6.20.0: a screw of an SDF file is of the other hand and of another steepness than in Drake.
#
# libsdformat takes <thread_pitch> for radians per metre, left-handed, and since 1.10 SDFormat has <screw_thread_pitch>, in metres
# per turn and right-handed, because of that. Drake does as libsdformat. DART reads the number as metres per turn, right-handed. A
# spindle with thread_pitch 20 * pi advances by 0.1 m per turn in the one direction in Drake, by 62.8 m per turn in the other in
# DART. No unit is named in the file, so nothing looks wrong until it moves.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check dartpy==6.20.0 drake==1.51.1 numpy==2.4.6
cat > "$folder/vice.sdf" <<'SDF'
<sdf version="1.6">
  <model name="vice">
    <link name="body"><inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial></link>
    <link name="spindle"><inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial></link>
    <joint name="hold" type="fixed"><parent>world</parent><child>body</child></joint>
    <joint name="screw" type="screw">
      <parent>body</parent><child>spindle</child>
      <thread_pitch>62.83185307179586</thread_pitch>
      <axis><xyz>0 0 1</xyz></axis>
    </joint>
  </model>
</sdf>
SDF
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import dartpy
from pydrake.all import MultibodyPlant, Parser

path = sys.argv[1] + "/vice.sdf"
plant = MultibodyPlant(0.0)
Parser(plant).AddModels(path)
plant.Finalize()
context = plant.CreateDefaultContext()
plant.SetPositions(context, [2 * math.pi])
drake = plant.EvalBodyPoseInWorld(context, plant.GetBodyByName("spindle")).translation()[2]
skeleton = dartpy.utils.SdfParser.readSkeleton(path)
skeleton.setPositions([2 * math.pi])
dart = float(skeleton.getBodyNode("spindle").getWorldTransform().translation().ravel()[2])
print(f"one turn of the spindle: {drake:.4f} m in Drake, {dart:.4f} m in DART")
for package in ("dartpy", "drake"):
    print(package, importlib.metadata.version(package))
sys.exit(not (abs(drake + 0.1) < 1e-9 and abs(dart - 20 * math.pi) < 1e-9))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
