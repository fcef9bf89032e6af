#!/usr/bin/env bash
# rapier3d 0.36.1 (Python): the axis of a joint, read back from it, has the joint's position added to it.
#
# local_axis1 and local_axis2 of a joint are the directions of its axis in its two bodies. What comes back is the point at the tip of the unit vector drawn
# at the anchor. A hinge about z at 1 0 0 returns 1 0 1, one at 0 0 -1 returns no direction at all, and only a joint at the origin of its body
# returns its axis. It is so for joints of the builders and for those that come out of a URDF; the motion itself is about the right axis.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check rapier3d==0.36.1 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import rapier3d
from rapier3d.loaders import urdf

right = True


def look(name, axis, expected):
    global right
    seen = axis if isinstance(axis, tuple) else axis.to_tuple()
    print(f"{name}: axis", *(f"{value:.4f}" for value in seen))
    right &= math.dist(seen, expected) < 1e-5


for anchor in ((0, 0, 0), (1, 0, 0), (0, 0, -1)):
    joint = rapier3d.RevoluteJoint.builder((0, 0, 1)).local_anchor1(anchor).build()
    for kind, asked in (("RevoluteJoint", joint), ("GenericJoint", joint.data)):
        look(f"a hinge about z, built at {anchor}, as a {kind}", asked.local_axis1, (anchor[0], anchor[1], anchor[2] + 1))

links = "".join(f'<link name="{name}"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>'
                for name in ("base", "arm"))
robot, _ = urdf.UrdfRobot.from_str(
    f'<robot name="robot">{links}<joint name="turn" type="continuous"><parent link="base"/><child link="arm"/>'
    '<origin xyz="0 5 0"/><axis xyz="0 0 1"/></joint></robot>')
world = rapier3d.PhysicsWorld()
handles = robot.insert_using_impulse_joints(world.rigid_bodies, world.colliders, world.impulse_joints)
joint = world.impulse_joints[handles.joints[0].joint].data
look("a hinge about z of a URDF, at 0 5 0, in its parent", joint.local_axis1, (0, 5, 1))
look("the same in its child, where it is at the origin", joint.local_axis2, (0, 0, 1))
arm = world.rigid_bodies[handles.links[1].body]
arm.angvel = (0, 0, 1)
for _ in range(30):
    world.step()
tilt = arm.position.transform_vector((0, 0, 1)).to_tuple()
print("after half a second the arm's z points along", *(f"{value:.4f}" for value in tilt))
right &= math.dist(tilt, (0, 0, 1)) < 1e-3
print("rapier3d", importlib.metadata.version("rapier3d"))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
