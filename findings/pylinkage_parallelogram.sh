#!/usr/bin/env bash
# pylinkage 1.3.0: a parallelogram crosses itself at the flat pose, half of every turn, whatever the step.
#
# Cranks of 1, coupler and base of 2: started as a parallelogram, its rocker should stay parallel to its crank. At 180 degrees all
# bars lie in one line and two branches meet. The library goes on with the crossed one without a word, comes back to the
# parallelogram at 360 degrees, and so on: the rocker is up to 180 degrees off its crank. Steps of 0.5, 1, 7 and 10 degrees
# do the same, also those that never stand at 180 degrees exactly, so smaller steps do not mend it.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pylinkage==1.3.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import math
import sys
from pylinkage import Crank, Ground, Linkage, RRRDyad

crossed = True
for step in (0.5, 1, 7, 10):
    base, other = Ground(0, 0), Ground(2, 0)
    crank = Crank(base, 1, angular_velocity=math.radians(step), initial_angle=math.radians(60))
    start = (math.cos(math.radians(60)) + 2, math.sin(math.radians(60)))
    pin = RRRDyad(crank.output, other, 2, 1, x=start[0], y=start[1])
    first, worst, back = None, 0.0, None
    for pose in Linkage([base, other, crank, pin]).step(iterations=int(360 / step) + 1):
        (x, y), (u, v) = pose[2], pose[3]
        driven = math.degrees(math.atan2(y, x)) % 360
        off = abs((driven - math.degrees(math.atan2(v, u - 2)) + 180) % 360 - 180)
        if off > 1 and first is None:
            first = driven
        worst, back = max(worst, off), off
    print(f"steps of {step} degrees: crossed from {first:.1f} degrees on, at most {worst:.0f} off, {back:.1f} at the end")
    crossed &= first is not None and 180 < first < 195 and worst > 40 and back < 1e-6
sys.exit(not crossed)
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
