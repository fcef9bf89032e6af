#!/usr/bin/env bash
# rod 0.5.0: converting SDF to URDF leaves out in which frame an axis is given, so that the hinge points elsewhere.
#
# SDFormat's <xyz expressed_in="__model__"> gives the axis in the model's frame (every file of version 1.4 becomes one of these when
# libsdformat brings it up to date). rod knows the attribute and keeps it in its own SDF. Its URDF exporter writes the three
# numbers as they are, in the frame of the joint, without a word. A link turned by 40 degrees gets an axis that is 40 degrees off;
# Drake, which reads both files, puts the hinge along y in the SDF and along (-0.64, 0.77, 0) in the URDF.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check rod==0.5.0 drake==1.51.1 numpy==2.4.6
cat > "$folder/flap.sdf" <<'SDF'
<sdf version="1.9">
  <model name="flap">
    <link name="frame"><inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial></link>
    <link name="leaf"><pose>0 0 0 0 0 0.698132</pose><inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial></link>
    <joint name="hinge" type="revolute">
      <parent>frame</parent><child>leaf</child>
      <axis><xyz expressed_in="__model__">0 1 0</xyz><limit><lower>-1</lower><upper>2</upper></limit></axis>
    </joint>
  </model>
</sdf>
SDF
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import logging
import sys
import numpy
import rod
from pydrake.all import MultibodyPlant, Parser
from rod.urdf.exporter import UrdfExporter

said = []
handler = logging.Handler()
handler.emit = lambda record: said.append(record.getMessage())
logging.getLogger().addHandler(handler)


def axis(path):
    plant = MultibodyPlant(0.0)
    Parser(plant).AddModels(path)
    plant.WeldFrames(plant.world_frame(), plant.GetFrameByName("frame"))
    plant.Finalize()
    context = plant.CreateDefaultContext()
    leaf = plant.GetBodyByName("leaf")
    rest = plant.EvalBodyPoseInWorld(context, leaf).rotation().matrix()
    plant.SetPositions(context, [1.0])
    turned = plant.EvalBodyPoseInWorld(context, leaf).rotation().matrix() @ rest.T
    vector = numpy.array([turned[2, 1] - turned[1, 2], turned[0, 2] - turned[2, 0], turned[1, 0] - turned[0, 1]])
    return vector / numpy.linalg.norm(vector)


path, to = sys.argv[1] + "/flap.sdf", sys.argv[1] + "/flap.urdf"
sdf = rod.Sdf.load(path, is_urdf=False)
kept = sdf.serialize(pretty=True, validate=False) if hasattr(sdf, "serialize") else ""
open(to, "w").write(UrdfExporter(pretty=True).to_urdf_string(sdf))
told = [line for line in said if "axis" in line.lower() or "express" in line.lower()]
axes = axis(path), axis(to)
print("hinge in the SDF:", axes[0].round(4), "- in the URDF:", axes[1].round(4), "- messages about it:", told)
print("rod's own SDF keeps expressed_in:", 'expressed_in="__model__"' in kept)
for package in ("rod", "drake"):
    print(package, importlib.metadata.version(package))
sys.exit(not (numpy.allclose(axes[0], [0, 1, 0], atol=1e-6) and not told
              and numpy.allclose(axes[1], [-numpy.sin(0.698132), numpy.cos(0.698132), 0], atol=1e-6)))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
