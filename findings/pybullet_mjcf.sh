#!/usr/bin/env bash
# pybullet 3.2.7: loadMJCF leaves out a joint without a type, takes x for the default axis, and reads no orientation but quat.
#
# In MJCF a joint is a hinge about z unless it says otherwise, a range limits it (autolimits), an axis is a direction, and a body is turned by
# quat, euler, axisangle, xyaxes or zaxis. loadMJCF prints "expected 'type' attribute for joint" and returns a robot without
# any joint. With a type, an axis that is left out is x; a slide along 0 0 2 moves twice as far as its value; euler and zaxis are
# passed over without a word. So is a range, unless limited="true" is beside it; then its degrees are taken for radians. PyBullet's limits of
# a joint that has none are 1 and 0.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pybullet==3.2.7 mujoco==4.0.0
cat > "$folder/arm.xml" <<'MJCF'
<mujoco model="arm">
  <worldbody>
    <body name="base">
      <geom type="sphere" size="0.1"/>
      <body name="arm" TURN>
        <geom type="sphere" size="0.1"/>
        <joint name="joint" MOVE/>
        <body name="hand" pos="1 2 0"><geom type="sphere" size="0.1"/></body>
      </body>
    </body>
  </worldbody>
</mujoco>
MJCF
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
import mujoco
import pybullet

folder = sys.argv[1]
text = open(folder + "/arm.xml").read()
pybullet.connect(pybullet.DIRECT)


def close(one, two):
    return all(abs(a - b) < 1e-3 for a, b in zip(one, two))


def mine(path, value):
    model = mujoco.MjModel.from_xml_path(path)
    data = mujoco.MjData(model)
    data.qpos[0] = value
    mujoco.mj_kinematics(model, data)
    limits = model.jnt_range[0] if model.jnt_limited[0] else (1, 0)
    return [round(float(x), 3) for x in (*data.body("hand").xpos, *limits)]


def theirs(path, value):
    pybullet.resetSimulation()
    (robot,) = pybullet.loadMJCF(path)
    limits = place = None
    for joint in range(pybullet.getNumJoints(robot)):
        info = pybullet.getJointInfo(robot, joint)
        if info[1] == b"joint":
            pybullet.resetJointState(robot, joint, value)
            limits = info[8:10]
        if info[12] == b"hand":
            hand = joint
    if limits is None:
        return []
    place = pybullet.getLinkState(robot, hand, computeForwardKinematics=1)[4]
    return [round(float(x), 3) for x in (*place, *limits)]


right = True
lines = []
for number, (name, turn, move, value, expected) in enumerate((
    ("type, axis and quat stated", 'quat="0.6 0 0 0.8"', 'type="hinge" axis="0 0 1"', 0.5, None),
    ("no type", "", 'axis="0 0 1"', 0.5, []),
    ("no axis", "", 'type="hinge"', 1.5707963, [1, 0, 2, 1, 0]),
    ("axis of length 2", "", 'type="slide" axis="0 0 2"', 0.5, [1, 2, 1, 1, 0]),
    ("euler", 'euler="0 0 90"', 'type="hinge" axis="0 0 1"', 0, [1, 2, 0, 1, 0]),
    ("zaxis", 'zaxis="0 1 0"', 'type="hinge" axis="0 0 1"', 0, [1, 2, 0, 1, 0]),
    ("range and limited", "", 'type="hinge" axis="0 0 1" range="-60 60" limited="true"', 0, [1, 2, 0, -60, 60]),
    ("range alone", "", 'type="hinge" axis="0 0 1" range="-60 60"', 0, [1, 2, 0, 1, 0]),
)):
    path = f"{folder}/arm_{number}.xml"
    open(path, "w").write(text.replace("TURN", turn).replace("MOVE", move))
    one, two = mine(path, value), theirs(path, value)
    lines.append(f"{name}: place of the hand and limits in MuJoCo {one}, in PyBullet {two}")
    right &= len(two) == 5 and close(one, two) if expected is None else len(two) == len(expected) and close(two, expected)
    right &= expected is None or not two or not close(one, two)
for package in ("pybullet", "mujoco"):
    lines.append(f"{package} {importlib.metadata.version(package)}")
open(folder + "/seen", "w").write("\n".join(lines) + "\n")
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder" > "$folder/said" 2>&1 || { tail -12 "$folder/said"; cat "$folder/seen"; exit 1; }
cat "$folder/seen"
grep -q "expected 'type' attribute for joint" "$folder/said"
