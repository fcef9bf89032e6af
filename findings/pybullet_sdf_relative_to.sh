#!/usr/bin/env bash
# pybullet 3.2.7: loadSDF takes every pose for one in the model's frame, in radians, and the mechanism comes out in pieces.
#
# From SDFormat 1.7 on a pose may be relative_to another link or joint, from 1.9 on in degrees or as a quaternion. PyBullet
# accepts a file that says version 1.9 and reads the numbers alone: a hand that is 1 m from its arm stands 1 m from the model's
# origin, degrees="true" turns 30 into 30 radians, and the last three numbers of a quaternion are taken for roll, pitch and yaw. Nothing is
# said. Drake reads the same files as they are meant. Most models that are exported today are of this kind.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pybullet==3.2.7 drake==1.51.1 numpy==2.4.6
cat > "$folder/arm.sdf" <<'SDF'
<sdf version="1.9">
  <model name="arm">
    <link name="arm"><pose>0 0 1 0 0 0</pose><inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial></link>
    <link name="hand">HAND<inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial></link>
    <joint name="wrist" type="revolute">
      <parent>arm</parent><child>hand</child>
      <axis><xyz>0 0 1</xyz><limit><lower>-3</lower><upper>3</upper></limit></axis>
    </joint>
  </model>
</sdf>
SDF
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import numpy
import pybullet
from pydrake.all import MultibodyPlant, Parser


def drake(path):
    plant = MultibodyPlant(0.0)
    Parser(plant).AddModels(path)
    plant.WeldFrames(plant.world_frame(), plant.GetFrameByName("arm"))
    plant.Finalize()
    pose = plant.EvalBodyPoseInWorld(plant.CreateDefaultContext(), plant.GetBodyByName("hand"))
    return pose.translation(), pose.rotation().matrix()


def bullet(path):
    pybullet.connect(pybullet.DIRECT)
    (body,) = pybullet.loadSDF(path)
    base = pybullet.invertTransform(*pybullet.getBasePositionAndOrientation(body))
    hand = pybullet.getLinkState(body, 0, computeForwardKinematics=1)
    place, turned = pybullet.multiplyTransforms(*base, hand[4], hand[5])
    pybullet.disconnect()
    return numpy.array(place), numpy.array(pybullet.getMatrixFromQuaternion(turned)).reshape(3, 3)


text = open(sys.argv[1] + "/arm.sdf").read()
right = True
for number, (hand, expected) in enumerate((
    ("<pose>1 0 1 0 0 0.5</pose>", (1, 0, 0.5, 1, 0, 0.5)),
    ('<pose relative_to="arm">1 0 0 0 0 0.5</pose>', (1, 0, 0.5, 1, -1, 0.5)),
    ('<pose degrees="true">1 0 1 0 0 30</pose>', (1, 0, math.pi / 6, 1, 0, 30 - 10 * math.pi)),
    ('<pose rotation_format="quat_xyzw">1 0 1 0 0 0.6 0.8</pose>', (1, 0, 2 * math.asin(0.6), 1, 0, 0.8)),
)):
    path = f"{sys.argv[1]}/arm_{number}.sdf"
    open(path, "w").write(text.replace("HAND", hand))
    seen = []
    for reader in (drake, bullet):
        place, turned = reader(path)
        seen += [place[0], place[2], math.atan2(turned[1, 0], turned[0, 0])]
    print(hand)
    print("  hand from arm, x, z and yaw: Drake", numpy.round(seen[:3], 4), "PyBullet", numpy.round(seen[3:], 4))
    right &= numpy.allclose(seen, expected, atol=1e-5)
for package in ("pybullet", "drake"):
    print(package, importlib.metadata.version(package))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
