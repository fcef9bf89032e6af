#!/usr/bin/env bash
# pygeosolve 0.7.0: two lines cannot be made parallel; an angle of 0 is divided by, and lines that are parallel are turned away.
#
# constrain_angle_between_lines takes an angle in degrees. The error of an angle is measured in parts of the angle, so that 0, the
# parallel lines of every sketch, gives infinity or NaN at every trial. A line that is drawn at 20 degrees and also one that is drawn
# parallel, with its right length, are left at the last random trial of the optimiser, up to tens of degrees off; that the
# solution failed is a flag and a warning. With 30, 90 or 180 degrees the same sketch is solved.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pygeosolve==0.7.0 scipy==1.17.1 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import math
import sys
import warnings
from pygeosolve import Problem


def solve(angle, drawn):
    sketch = Problem()
    start = math.radians(drawn)
    sketch.add_line("base", (0, 0), (1, 0))
    sketch.add_line("bar", (0, 1), (2 * math.cos(start), 1 + 2 * math.sin(start)))
    sketch.constrain_position("base")
    sketch.constrain_line_length("bar", 2.0)
    sketch.constrain_angle_between_lines("base", "bar", angle)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = sketch.solve(niter=5, seed=1)
    turned = sketch["base"].angle_to(sketch["bar"])
    print(f"wanted {angle}, drawn at {drawn}: success {bool(found.success)}, at {turned:.2f}, length {sketch['bar'].length():.3f}")
    off = abs((turned - angle + 180) % 360 - 180)
    return bool(found.success), off


usual = [solve(angle, 20) for angle in (30, 90)] + [solve(180, 170)]
parallel = [solve(0, 20), solve(0, 0)]
solved = all(success and off < 1e-2 for success, off in usual)
sys.exit(not (solved and not any(success or off < 1 for success, off in parallel)))
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
