#!/usr/bin/env bash
# fourbarhinge 0.1.2: the second branch of a four-bar, asked for as documented, is a linkage that does not close.
#
# solve_configuration's docstring: the branch "can take only values 1 or 2". The angle of the output is computed as that of the diagonal
# plus branch times the angle at the output's pin. For 1 that is one of the two closures of the loop; the other one would be -1. With 2 the
# angle is doubled: a crank-rocker of 1, 3 and 2 on a base of 3 comes back with a coupler whose end is up to 1.4 away from the output's pin,
# as a configuration like any other. get_closure_error, which has to be called, shows it; -1 gives the second closure.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check fourbarhinge==0.1.2 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import inspect
import math
import sys
from fourbarhinge import Bar, BarId, FourBarGeometry, FourBarKinematics, Point

lengths = {BarId.GROUND: 3.0, BarId.INPUT: 1.0, BarId.COUPLER: 3.0, BarId.OUTPUT: 2.0}
linkage = FourBarKinematics(
    FourBarGeometry(position_ground=Point(x=0, y=0), bar={name: Bar(length=length) for name, length in lengths.items()}), 0.0)
print("docstring names 1 or 2:", "1 or 2" in inspect.getdoc(FourBarKinematics.solve_configuration))
worst = {}
for branch in (1, 2, -1):
    errors = []
    for step in range(36):
        linkage.solve_configuration(math.radians(10 * step), branch=branch)
        errors.append(linkage.get_closure_error())
    worst[branch] = max(errors)
    print(f"branch {branch}: the loop is open by up to {worst[branch]:.3f}")
print("fourbarhinge", importlib.metadata.version("fourbarhinge"))
sys.exit(not (worst[1] < 1e-9 and worst[-1] < 1e-9 and worst[2] > 0.5))
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
