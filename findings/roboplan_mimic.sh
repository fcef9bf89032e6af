#!/usr/bin/env bash
# roboplan 0.7.0: a configuration is valid though a <mimic> joint is far beyond its limits; a continuous follower has a cosine of -1.96.
#
# Limits of a follower bound its leader: with -2 times the leader plus 0.3 between -1 and 1 the leader has -0.35 to 0.65. In RoboPlan the
# leader keeps its own -1 to 1, isValidConfiguration is true at 0.9, where the follower stands at -1.5, and randomPositions draws half of
# its configurations there. Continuous joints are held as cosine and sine. getCurrentJointPositionsWithMimics multiplies both by the
# ratio: a follower at -2 times 0.2 rad is given as (-1.96, -0.40), which is no angle; forwardKinematics has it right, at -0.4. A
# continuous leader of a revolute follower, and the reverse, is a ValueError; in URDF both are angles.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check roboplan==0.7.0 roboplan-core==0.7.0 pin==4.1.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import numpy
from roboplan.core import Scene, loadUrdfSceneDescriptionFromXml

LIMIT = '<limit lower="-1" upper="1" effort="1" velocity="1"/>'


def load(leader, follower, offset):
    wheels = "".join(
        f'<joint name="{name}" type="{kind}"><parent link="base"/><child link="{name}_disc"/><axis xyz="0 0 1"/>{mimic}'
        f'{LIMIT if kind == "revolute" else ""}</joint><link name="{name}_disc"/>'
        for name, kind, mimic in (("driver", leader, ""), ("wheel", follower, f'<mimic joint="driver" multiplier="-2" offset="{offset}"/>')))
    return Scene("pair", loadUrdfSceneDescriptionFromXml(f'<robot name="pair"><link name="base"/>{wheels}</robot>'))


def angle(scene, positions):
    pose = scene.forwardKinematics(positions, "wheel_disc")
    return math.atan2(pose[1, 0], pose[0, 0])


limited = load("revolute", "revolute", 0.3)
at = numpy.array([0.9])
bounds = limited.getJointInfo("driver").limits
limited.setRngSeed(1)
drawn = [angle(limited, numpy.asarray(limited.randomPositions())) for _ in range(300)]
beyond = sum(abs(value) > 1 for value in drawn) / len(drawn)
valid = bool(limited.isValidConfiguration(at))
print(f"leader {bounds.min_position} to {bounds.max_position}; at 0.9 the follower is at {angle(limited, at):.2f}, valid: {valid};",
      f"random configurations with the follower beyond its limits: {100 * beyond:.0f} %")
turning = load("continuous", "continuous", 0)
at = numpy.array([math.cos(0.2), math.sin(0.2)])
turning.setJointPositions(at)
given = numpy.asarray(turning.getCurrentJointPositionsWithMimics())[2:]
print("continuous follower:", given, "by forwardKinematics", round(angle(turning, at), 6))
mixed = []
for kinds in (("continuous", "revolute"), ("revolute", "continuous")):
    try:
        load(*kinds, 0)
        mixed.append("loaded")
    except ValueError as error:
        mixed.append("ValueError")
    print("leader and follower", kinds, mixed[-1])
print("roboplan", importlib.metadata.version("roboplan"))
sys.exit(not (
    bounds.min_position == [-1] and bounds.max_position == [1] and valid and 0.4 < beyond < 0.6
    and numpy.allclose(given, [-2 * math.cos(0.2), -2 * math.sin(0.2)]) and math.isclose(angle(turning, at), -0.4)
    and mixed == ["ValueError"] * 2))
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
