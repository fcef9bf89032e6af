#!/usr/bin/env bash
# spatialmath-python 1.1.18: the distance of two skew lines is right only at right angles; the point where two lines meet is a matrix.
#
# Line3 holds a line in Plücker coordinates. distance() divides by the square of the length of the product of both directions, where the
# length belongs: two axes 3 apart that cross at 30 degrees are 6 apart, and with a direction of length 2 crossing axes are 1.5 apart.
# closest_to_line of the same class says 3. Of parallel lines, which the documentation names, distance() ends in a NameError, and
# closest_to_line gives nan. For lines in general position commonperp refuses the line it has made ("invalid Plucker coordinates").
# intersects, which is to be a point, returns three rows of three: every coordinate of the point times 0, 0 and 1.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check spatialmath-python==1.1.18 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import warnings
import numpy
from spatialmath import Line3

warnings.simplefilter("ignore", RuntimeWarning)


def ask(question):
    try:
        return question()
    except Exception as error:
        return f"{type(error).__name__}: {error}"


first = Line3.PointDir([0, 0, 0], [1, 0, 0])
tilt = math.radians(30)
right = True
for name, direction, distance, nearest in (
    ("at 90 degrees", [0, 1, 0], 3, 3),
    ("at 30 degrees", [math.cos(tilt), math.sin(tilt), 0], 6, 3),
    ("at 90 degrees, direction of length 2", [0, 2, 0], 1.5, 3),
    ("parallel", [1, 0, 0], "NameError", math.nan),
):
    second = Line3.PointDir([0, 0, 3], direction)
    seen = ask(lambda: float(first.distance(second)))
    near = float(first.closest_to_line(second)[1])
    print(f"two axes 3 apart, {name}: distance {seen}, closest_to_line {near}")
    right &= seen.startswith(distance) if isinstance(distance, str) else math.isclose(seen, distance)
    right &= math.isclose(near, nearest) or math.isnan(near) and math.isnan(nearest)
low, high = Line3.PointDir([1, 2, 0], [1, 0, 0]), Line3.PointDir([3, 0, 4], [1, 1, 1])
said = ask(lambda: low.commonperp(high))
print("common perpendicular of two lines in general position:", said)
meeting = Line3.PointDir([1, 2, 3], [1, 0, 0]).intersects(Line3.PointDir([1, 2, 3], [0, 1, 0]))
print("two lines through (1, 2, 3) meet at", numpy.asarray(meeting).tolist())
print("spatialmath-python", importlib.metadata.version("spatialmath-python"))
right &= "invalid Plucker coordinates" in str(said) and numpy.allclose(meeting, [[0, 0, 1], [0, 0, 2], [0, 0, 3]])
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" -W ignore "$folder/try.py"
