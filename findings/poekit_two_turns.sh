#!/usr/bin/env bash
# poekit 0.1.0: two turns that cannot reach a point are answered with angles, and two that can, about parallel axes, with "no solution".
#
# paden_kahan_2 is to find the turns about two axes that take one point to another; it "returns zeros matrix when no solution". For axes
# that meet, the square of a height is made positive by abs(), so that circles which do not meet give two pairs of angles as well: from
# (0.8, 0.6, 0), turned about x and then z, a point at height 0.8 is out of reach, and the answer misses it by 0.42. For parallel axes,
# the elbow of a planar arm, the zeros come back for every point that was made by two turns; for skew axes the angles are wrong for every
# one. paden_kahan_3 gives two angles of 0 for a distance out of reach, which is an answer like any other.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check poekit==0.1.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import numpy
from poekit import PadenKahan

random = numpy.random.default_rng(3)


def axis(direction, through):
    direction = numpy.asarray(direction, float) / numpy.linalg.norm(direction)
    return numpy.concatenate([-numpy.cross(direction, through), direction])


def turn(screw, angle, point):
    """Rodrigues' formula about the axis, which passes through the cross product of its direction and its moment."""
    direction, foot = screw[3:], numpy.cross(screw[3:], screw[:3])
    arm = point - foot
    return foot + arm * math.cos(angle) + numpy.cross(direction, arm) * math.sin(angle) + direction * (direction @ arm) * (1 - math.cos(angle))


def off(one, two, start, goal):
    """How far from the goal the answers lead, the nearer one first; None for the matrix of zeros."""
    angles = numpy.asarray(PadenKahan.paden_kahan_2(one, two, start, goal))
    if not angles.any():
        return None
    return sorted(float(numpy.linalg.norm(turn(one, first, turn(two, second, start)) - goal)) for first, second in angles)


seen = {}
for kind in ("meeting", "skew", "parallel"):
    right = wrong = none = 0
    for _ in range(100):
        first, second, place, other, start = random.normal(size=(5, 3))
        one = axis(first, place)
        two = axis(first if kind == "parallel" else second, place if kind == "meeting" else other)
        goal = turn(one, random.uniform(-2, 2), turn(two, random.uniform(-2, 2), start))
        errors = off(one, two, start, goal)
        none += errors is None
        right += errors is not None and errors[0] < 1e-6
        wrong += errors is not None and errors[0] >= 1e-6
    seen[kind] = right, wrong, none
    print(f"{kind} axes, 100 points that two turns reach: right {right}, wrong {wrong}, no solution {none}")
z, x = axis((0, 0, 1), (0, 0, 0)), axis((1, 0, 0), (0, 0, 0))
out_of_reach = off(z, x, numpy.array([0.8, 0.6, 0.0]), numpy.array([0.0, 0.6, 0.8]))
print("(0.8, 0.6, 0) to (0, 0.6, 0.8) by turns about x and then z, which is impossible above a height of 0.6: off by", out_of_reach)
far = numpy.asarray(PadenKahan.paden_kahan_3(z, numpy.array([1.0, 0.0, 0.0]), numpy.array([5.0, 0.0, 0.0]), 1.0)).ravel().tolist()
print("(1, 0, 0) to a distance of 1 from (5, 0, 0) by a turn about z, which is impossible: angles", far)
print("poekit", importlib.metadata.version("poekit"))
sys.exit(not (seen == {"meeting": (100, 0, 0), "skew": (0, 100, 0), "parallel": (0, 0, 100)} and out_of_reach is not None and out_of_reach[0] > 0.1 and far == [0, 0]))
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
