#!/usr/bin/env bash
# pybullet 3.2.7: loadSDF puts every hinge at the origin of its child link and lets its axis turn with that link.
#
# The <pose> of an SDF joint says where its frame is in the child link, and use_parent_model_frame (SDFormat 1.5 and 1.6) says that
# the axis is given in the model's frame; both are in the specification of the versions that PyBullet reads. loadSDF heeds
# neither and says nothing. A door of 0.8 m with its hinge on the edge turns about its middle; a flap whose link is turned by 40
# degrees in the file turns about an axis 40 degrees off. Drake puts both where the file says.
# Drawn poses are right in both programs, so a picture at rest does not show it.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pybullet==3.2.7 drake==1.51.1 numpy==2.4.6
cat > "$folder/door.sdf" <<'SDF'
<sdf version="1.6">
  <model name="door">
    <link name="frame"><inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial></link>
    <link name="leaf"><pose>0.4 0 0 0 0 YAW</pose><inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial></link>
    <joint name="hinge" type="revolute">
      JOINT_POSE<parent>frame</parent><child>leaf</child>
      <axis><xyz>AXIS</xyz>FRAME<limit><lower>-3</lower><upper>3</upper></limit></axis>
    </joint>
  </model>
</sdf>
SDF
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
import numpy
import pybullet
from pydrake.all import MultibodyPlant, Parser


def drake(path, angle):
    plant = MultibodyPlant(0.0)
    Parser(plant).AddModels(path)
    plant.WeldFrames(plant.world_frame(), plant.GetFrameByName("frame"))
    plant.Finalize()
    context = plant.CreateDefaultContext()
    plant.SetPositions(context, [angle])
    pose = plant.EvalBodyPoseInWorld(context, plant.GetBodyByName("leaf"))
    return pose.translation(), pose.rotation().matrix()


def bullet(path, angle):
    pybullet.connect(pybullet.DIRECT)
    (body,) = pybullet.loadSDF(path)
    pybullet.resetJointState(body, 0, angle)
    base = pybullet.invertTransform(*pybullet.getBasePositionAndOrientation(body))
    leaf = pybullet.getLinkState(body, 0, computeForwardKinematics=1)
    place, turned = pybullet.multiplyTransforms(*base, leaf[4], leaf[5])
    pybullet.disconnect()
    return numpy.array(place), numpy.array(pybullet.getMatrixFromQuaternion(turned)).reshape(3, 3)


def axis(reader, path):
    turned = reader(path, 1.0)[1] @ reader(path, 0.0)[1].T
    return numpy.array([turned[2, 1] - turned[1, 2], turned[0, 2] - turned[2, 0], turned[1, 0] - turned[0, 1]]) / (2 * numpy.sin(1.0))


text = open(sys.argv[1] + "/door.sdf").read()
edge, tilted = sys.argv[1] + "/edge.sdf", sys.argv[1] + "/tilted.sdf"
open(edge, "w").write(text.replace("YAW", "0").replace("JOINT_POSE", "<pose>-0.4 0 0 0 0 0</pose>")
                      .replace("AXIS", "0 0 1").replace("FRAME", ""))
open(tilted, "w").write(text.replace("YAW", "0.698132").replace("JOINT_POSE", "").replace("AXIS", "1 0 0")
                        .replace("FRAME", "<use_parent_model_frame>true</use_parent_model_frame>"))
places = [reader(edge, numpy.pi / 2)[0] for reader in (drake, bullet)]
axes = [axis(reader, tilted) for reader in (drake, bullet)]
print("middle of the door, opened by a quarter turn: Drake", places[0].round(4), "PyBullet", places[1].round(4))
print("axis of the flap: Drake", axes[0].round(4), "PyBullet", axes[1].round(4))
for package in ("pybullet", "drake"):
    print(package, importlib.metadata.version(package))
sys.exit(not (numpy.allclose(places[0], [0, 0.4, 0], atol=1e-5) and numpy.allclose(places[1], [0.4, 0, 0], atol=1e-5)
              and numpy.allclose(axes[0], [1, 0, 0], atol=1e-5)
              and numpy.allclose(axes[1], [numpy.cos(0.698132), numpy.sin(0.698132), 0], atol=1e-5)))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
