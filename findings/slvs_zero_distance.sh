#!/usr/bin/env bash
# slvs 3.3 (SolveSpace's solver): a point at distance 0 from a fixed one cannot move, and one degree of freedom is reported.
#
# A distance of 0 is a parameter value that a sketch with a varied dimension passes through. It is accepted, solved and drawn right:
# the points coincide. The number of freedoms is that of any other distance, 1, since it is the rank of the equation and not of what
# it holds: two real equations in one. The flag says that all is well. With the constraint for coincident points the same
# sketch has 0. So a count of freedoms from the solver says "one to go" of a sketch that is complete, and a second
# dimension that is added on its advice is redundant or contradicts.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check slvs==3.3
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
import slvs

FIXED, FREE = 1, 2
seen = {}
for name in ("distance of 1", "distance of 0", "coincident"):
    slvs.clear_sketch()
    plane = slvs.add_base_2d(FIXED)
    fixed = slvs.add_point_2d(FIXED, 0.0, 0.0, plane)
    point = slvs.add_point_2d(FREE, 0.4, 0.5, plane)
    if name == "coincident":
        slvs.coincident(FREE, fixed, point, plane)
    else:
        slvs.distance(FREE, fixed, point, float(name[-1]), plane)
    answer = slvs.solve_sketch(FREE, True)[0]
    place = [slvs.get_param_value(point["param"][i]) for i in range(2)]
    seen[name] = answer["result"], answer["dof"], max(abs(x) for x in place)
    print(f"{name}: result {answer['result']}, degrees of freedom {answer['dof']}, point at", [round(x, 6) for x in place])
print("version:", importlib.metadata.version("slvs"))
zero, same = seen["distance of 0"], seen["coincident"]
sys.exit(not (seen["distance of 1"][:2] == (0, 1) and zero[:2] == (0, 1) and zero[2] < 1e-4 and same[:2] == (0, 0) and same[2] < 1e-6))
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
