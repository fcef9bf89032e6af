#!/usr/bin/env bash
# robot-ik 0.4.0: a pendulum of a URDF is held by the same torque in every position, a vertical slide by nothing, and a weld is a hinge.
#
# quick_urdf makes a dynamics model of a URDF: DH parameters, where a row turns about z before it is tilted, whereas a URDF's axis is tilted
# first. A bar of 2 kg at 1 m on the horizontal axis 0 1 0 is turned about the vertical: 19.62 N m at 0, at half a radian and when it hangs,
# where it should be -19.62 * cos(q). Types of joints are not kept. The slide that lifts 2 kg needs 0 N and not 19.62 N, and a fixed joint
# becomes a row with a coordinate of its own. Two arms on one base become one chain: the second stands on the end of the first.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check robot-ik==0.4.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import numpy
from robot_ik.urdf import quick_urdf, urdf_to_dynamics_model

WEIGHT = 2 * 9.81
MASS = """<inertial><origin xyz="{} 0 0"/><mass value="2"/>
  <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>"""


def load(joints, **links):
    path = sys.argv[1] + "/arm.urdf"
    lines = [f'<link name="{name}">{"" if at is None else MASS.format(at)}</link>' for name, at in links.items()]
    lines += [
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/><origin xyz="{place}"/><axis xyz="{axis}"/>'
        '<limit lower="-4" upper="4" effort="99" velocity="1"/></joint>' for name, kind, parent, child, place, axis in joints]
    with open(path, "w") as file:
        file.write(f'<robot name="arm">{"".join(lines)}</robot>')
    return quick_urdf(path), urdf_to_dynamics_model(path)


pendulum, _ = load([("hinge", "revolute", "base", "bar", "0 0 0", "0 1 0")], base=None, bar=1)
right = True
for angle in (0.0, 0.5, math.pi / 2):
    seen = float(pendulum.gravity_torque(numpy.array([angle]))[0])
    print(f"pendulum at {angle:.4f}: torque {seen:.2f}, by the file {-WEIGHT * math.cos(angle):.2f}")
    right &= math.isclose(seen, WEIGHT, rel_tol=1e-6)
slide, _ = load([("lift", "prismatic", "base", "cage", "0 0 0", "0 0 1")], base=None, cage=0)
force = float(slide.gravity_torque(numpy.array([0.5]))[0])
print(f"vertical slide: force {force:.2f}, by the file {WEIGHT:.2f}")
_, welded = load(
    [("weld", "fixed", "base", "post", "0 0 1", "0 0 1"), ("hinge", "revolute", "post", "bar", "0 0 0", "0 0 1")], base=None, post=None, bar=1)
print("one hinge behind a fixed joint: rows", len(welded.dh_a))
two, model = load(
    [("left", "revolute", "base", "bar", "1 0 0", "0 0 1"), ("right", "revolute", "base", "rod", "0 1 0", "0 0 1")], base=None, bar=0, rod=0)
ends = [numpy.round(pose[:3, 3], 6).tolist() for pose in two.forward_kinematics_all(numpy.zeros(2))]
print("two arms on one base, at (1, 0, 0) and (0, 1, 0): frames at", ends)
print("robot-ik", importlib.metadata.version("robot-ik"))
sys.exit(not (right and abs(force) < 1e-9 and len(welded.dh_a) == 2 and ends[-1] == [2, 0, 0]))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
