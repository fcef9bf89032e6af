#!/usr/bin/env bash
# sapien 3.0.3: a <mimic> of a URDF follows at its ratio, at the reciprocal of its ratio, or not at all, by where the two joints are in the tree.
#
# SAPIEN makes a tendon of a <mimic>. Where the follower hangs on the link that the leader moves, the tendon is right: at multiplier 2 and offset
# 0.25 a leader at 0.6 rad puts the follower at 1.45 rad. Where both hang on the same link, as the fingers of most grippers do, the multiplier
# stands at the wrong joint, and the follower goes to (0.6 - 0.25) / 2 = 0.175 rad; with a multiplier of 1 or -1 and no offset nothing is
# noticed. For any other two joints no tendon is made, nothing is said, and the follower is free.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check sapien==3.0.3 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import sys
import sapien

inertial = '<inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>'
links = "".join(f'<link name="{name}">{inertial}</link>' for name in ("base", "first", "second", "third"))


def joint(name, parent, child, mimic=""):
    return (f'<joint name="{name}" type="revolute"><parent link="{parent}"/><child link="{child}"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>'
            f'<limit lower="-3" upper="3" effort="1e6" velocity="100"/>{mimic}</joint>')


def follower(place, multiplier, offset):
    """The follower's angle when a motor holds its leader at 0.6 rad, without gravity."""
    mimic = f'<mimic joint="leader" multiplier="{multiplier}" offset="{offset}"/>'
    rest = {
        "on the leader's child": joint("follower", "first", "second", mimic) + joint("other", "base", "third"),
        "on the leader's parent": joint("follower", "base", "second", mimic) + joint("other", "base", "third"),
        "on another arm": joint("other", "base", "third") + joint("follower", "third", "second", mimic),
    }[place]
    with open(sys.argv[1] + "/robot.urdf", "w") as file:
        file.write(f'<robot name="robot">{links}{joint("leader", "base", "first")}{rest}</robot>')
    scene = sapien.Scene([sapien.physx.PhysxCpuSystem()])
    scene.set_timestep(1 / 500)
    robot = scene.create_urdf_loader().load(sys.argv[1] + "/robot.urdf")
    for link in robot.links:
        link.disable_gravity = True
    joints = {joint.name: at for at, joint in enumerate(robot.active_joints)}
    motor = robot.active_joints[joints["leader"]]
    motor.set_drive_property(1e6, 1e5)
    motor.set_drive_target(0.6)
    for _ in range(3000):
        scene.step()
    assert abs(robot.qpos[joints["leader"]] - 0.6) < 1e-3
    return float(robot.qpos[joints["follower"]])


right = True
for place, multiplier, offset, expected in (
    ("on the leader's child", 2, 0.25, 1.45),
    ("on the leader's parent", 1, 0, 0.6),
    ("on the leader's parent", 2, 0, 0.3),
    ("on the leader's parent", 2, 0.25, 0.175),
    ("on another arm", 2, 0, 0.0),
):
    seen = follower(place, multiplier, offset)
    print(f"follower {place}, multiplier {multiplier}, offset {offset}: {seen:.3f} rad; the file says {0.6 * multiplier + offset:.2f}")
    right &= abs(seen - expected) < 5e-3
print("sapien", sapien.__version__)
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" -W ignore "$folder/try.py" "$folder"
