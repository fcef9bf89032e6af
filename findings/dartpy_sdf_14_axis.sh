#!/usr/bin/env bash
# dartpy 6.20.0: axes of SDF files of version 1.4 are read in the wrong frame, though DART names 1.4 among what it supports.
#
# Up to SDFormat 1.4 the <xyz> of an axis is in the model's frame; 1.5 moved it to the joint's frame and added
# use_parent_model_frame for the old meaning. DART refuses versions beyond 1.6 with the words "we only support SDF 1.4, 1.5, and
# 1.6", and reads the axis of all three in the joint's frame. With a link turned by 40 degrees the hinge is 40 degrees off; the
# same hinge in a file of version 1.6 with use_parent_model_frame is right. Drake reads both alike.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check dartpy==6.20.0 drake==1.51.1 numpy==2.4.6
cat > "$folder/flap.sdf" <<'SDF'
<sdf version="VERSION">
  <model name="flap">
    <link name="frame"><inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial></link>
    <link name="leaf"><pose>0 0 0 0 0 0.698132</pose><inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial></link>
    <joint name="hold" type="fixed"><parent>world</parent><child>frame</child></joint>
    <joint name="hinge" type="revolute">
      <parent>frame</parent><child>leaf</child>
      <axis><xyz>1 0 0</xyz>FRAME<limit><lower>-3</lower><upper>3</upper></limit></axis>
    </joint>
  </model>
</sdf>
SDF
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import dartpy
import numpy
from pydrake.all import MultibodyPlant, Parser


def direction(turned):
    vector = numpy.array([turned[2, 1] - turned[1, 2], turned[0, 2] - turned[2, 0], turned[1, 0] - turned[0, 1]])
    return vector / numpy.linalg.norm(vector)


def drake(path):
    plant = MultibodyPlant(0.0)
    Parser(plant).AddModels(path)
    plant.Finalize()
    context = plant.CreateDefaultContext()
    leaf = plant.GetBodyByName("leaf")
    rest = plant.EvalBodyPoseInWorld(context, leaf).rotation().matrix()
    plant.SetPositions(context, [1.0])
    return direction(plant.EvalBodyPoseInWorld(context, leaf).rotation().matrix() @ rest.T)


def dart(path):
    skeleton = dartpy.utils.SdfParser.readSkeleton(path)
    leaf = skeleton.getBodyNode("leaf")
    rest = numpy.array(leaf.getWorldTransform().rotation())
    skeleton.setPositions([1.0])
    return direction(numpy.array(leaf.getWorldTransform().rotation()) @ rest.T)


text = open(sys.argv[1] + "/flap.sdf").read()
off = {}
for version, frame in (("1.4", ""), ("1.6", "<use_parent_model_frame>true</use_parent_model_frame>")):
    path = f"{sys.argv[1]}/flap_{version}.sdf"
    open(path, "w").write(text.replace("VERSION", version).replace("FRAME", frame))
    pair = (drake(path), dart(path))
    off[version] = [math.degrees(math.acos(min(1.0, axis[0]))) for axis in pair]
    print(f"version {version}: the axis is off x by {off[version][0]:.2f} degrees in Drake, {off[version][1]:.2f} in DART")
for package in ("dartpy", "drake"):
    print(package, importlib.metadata.version(package))
sys.exit(not (max(off["1.6"]) < 1e-4 and off["1.4"][0] < 1e-4 and abs(off["1.4"][1] - 40) < 1e-3))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
