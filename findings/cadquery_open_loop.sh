#!/usr/bin/env bash
# cadquery 2.8.0: an assembly whose bars cannot close the loop is "solved", with the gaps shared out among all its joints.
#
# Assembly.solve minimises the squares of what the constraints are off by and returns the assembly. Two bars of 1 on a base of
# 3 cannot meet: each of the three joints comes back open by 1/3, without an exception or a warning. The solver's own record says
# success, since a minimum was found. Two bars of 2 come back closed, with the same words. A program that goes on with the
# assembly (export, clearances, mass) has to measure every joint itself.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check cadquery==2.8.0
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import warnings
import cadquery

warnings.simplefilter("error", UserWarning)


def solve(base, bars):
    """The gaps at the joints of a polygon of a base and bars, and what the solver says of it."""
    rig = cadquery.Assembly()
    sides = {"base": base, **{f"bar{number}": length for number, length in enumerate(bars)}}
    for number, (name, length) in enumerate(sides.items()):
        rig.add(cadquery.Workplane().box(length, 0.1, 0.1), name=name, loc=cadquery.Location((0, number, 0)))
    names = list(sides)
    ends = [("base", -1), *[(name, side) for name in names[1:] for side in (-1, 1)], ("base", 1)]
    joints = list(zip(ends[::2], ends[1::2]))

    def point(name, side):
        return side * sides[name] / 2, 0, 0

    rig.constrain("base", "Fixed")
    for one, other in joints:
        rig.constrain(one[0], cadquery.Vertex.makeVertex(*point(*one)), other[0], cadquery.Vertex.makeVertex(*point(*other)), "Point")
    rig.solve()
    where = {child.name: child.loc for child in rig.children}

    def seen(name, side):
        return cadquery.Vertex.makeVertex(*point(name, side)).moved(where[name]).toTuple()

    return [math.dist(seen(*one), seen(*other)) for one, other in joints], rig._solve_result["success"]


closed, open_loop = solve(3.0, [2.0, 2.0]), solve(3.0, [1.0, 1.0])
print("bars of 2 on a base of 3: success", closed[1], "- gaps", [round(gap, 4) for gap in closed[0]])
print("bars of 1 on a base of 3: success", open_loop[1], "- gaps", [round(gap, 4) for gap in open_loop[0]])
print("version:", importlib.metadata.version("cadquery"))
sys.exit(not (closed[1] and open_loop[1] and max(closed[0]) < 1e-3 and all(abs(gap - 1 / 3) < 1e-3 for gap in open_loop[0])))
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
