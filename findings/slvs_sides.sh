#!/usr/bin/env bash
# slvs 3.3 (SolveSpace's solver): a point drawn above a line, at a distance of 1, is put 1 below it.
#
# Solvers of sketches start from the drawing and are expected to stay on the side that was drawn. SolveSpace's point-line distance in a
# plane is signed, with plus to the right of the line's direction, though its name and a distance of two points, where a negative
# value fails, say otherwise: a point drawn at (1, 0.5) over the x axis ends at (1, -1) for a distance of 1, and at (1, 1) for -1.
# The angle between two lines is the opposite case, it has no sign: 30, -30, 330 and 390 are one constraint, and the drawing decides on
# which side. Whoever translates a sketch between solvers has to set the sign from the drawing for the one, and to check the
# result for the other.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check slvs==3.3
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import slvs

FIXED, FREE = 1, 2


def sketch(start, constrain):
    """A line along x that is given, a point that is free, and what is asked of it."""
    slvs.clear_sketch()
    plane = slvs.add_base_2d(FIXED)
    left, right = slvs.add_point_2d(FIXED, 0.0, 0.0, plane), slvs.add_point_2d(FIXED, 2.0, 0.0, plane)
    line = slvs.add_line_2d(FIXED, left, right, plane)
    point = slvs.add_point_2d(FREE, *start, plane)
    constrain(plane, left, line, point)
    answer = slvs.solve_sketch(FREE, True)[0]
    return answer["result"], tuple(slvs.get_param_value(point["param"][i]) for i in range(2))


def at_distance(value):
    return lambda plane, left, line, point: slvs.distance(FREE, point, line, value, plane)


def at_angle(value):
    def constrain(plane, left, line, point):
        slvs.angle(FREE, line, slvs.add_line_2d(FREE, left, point, plane), value, plane)
        slvs.distance(FREE, left, point, 1.0, plane)
    return constrain


right = True
for value in (1.0, -1.0):
    for height in (0.5, -0.5):
        result, (x, y) = sketch((1.0, height), at_distance(value))
        print(f"distance {value:g} from the line, drawn at y = {height:g}: result {result}, y = {y:.4f}")
        right &= result == 0 and abs(y + value) < 1e-6
for value in (30.0, -30.0, 330.0, 390.0):
    for height in (0.2, -0.2):
        result, (x, y) = sketch((1.0, height), at_angle(value))
        seen = math.degrees(math.atan2(y, x))
        print(f"angle {value:g}, drawn at {math.degrees(math.atan2(height, 1)):.1f}: result {result}, at {seen:.2f} degrees")
        right &= result == 0 and abs(seen - math.copysign(30, height)) < 1e-3
print("version:", importlib.metadata.version("slvs"))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
