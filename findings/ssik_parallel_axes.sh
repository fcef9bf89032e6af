#!/usr/bin/env bash
# ssik 8.2.0: with the last three axes parallel, certified solutions are centimetres off; with the first two parallel there are none.
#
# Each solution carries fk_residual, the distance of its forward kinematics from the target, and the README has every retained
# candidate checked by it. Of an arm whose last three axes are parallel (given by DH parameters), all poses made with its own fk
# return solutions with residuals below 1e-12, and fk of the same object puts every one of them up to 6 cm elsewhere. An arm with its
# first two axes parallel and a spherical wrist gets an empty list at every pose, also those that fk has just reached. A Puma-like arm
# is solved at every pose.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check ssik==8.2.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import math
import sys
import numpy
import ssik

right = math.pi / 2


def examine(name, twist, a, d):
    arm = ssik.Manipulator.from_dh(twist, a, d)
    numbers = numpy.random.default_rng(2)
    found, back, stated, gaps = 0, 0, [], []
    for _ in range(6):
        q = numbers.uniform(-3, 3, 6)
        pose = arm.fk(q)
        solutions = arm.solve(pose, respect_limits=False)
        found += len(solutions)
        back += any(numpy.abs((each.q - q + math.pi) % (2 * math.pi) - math.pi).max() < 1e-6 for each in solutions)
        stated += [each.fk_residual for each in solutions]
        gaps += [numpy.abs(arm.fk(each.q) - pose).max() for each in solutions]
    print(f"{name} ({arm.solver_name}): {found} solutions for 6 poses, {back} poses with the angles they were made of")
    if found:
        print(f"  stated residual at most {max(stated):.1e}, fk off by {min(gaps):.1e} to {max(gaps):.1e}")
    return found, back, max(stated, default=0), min(gaps, default=0)


wrist = ([0.3, 0.4, 0.1, 0, 0, 0], [0.3, 0.1, 0.2, 0.4, 0, 0.1])
usual = examine("second and third parallel, wrist", [right, 0, right, -right, right, 0], *wrist)
first = examine("first two parallel, wrist", [0, right, right, -right, right, 0], *wrist)
last = examine("last three parallel", [right, right, right, 0, 0, 0], [0.1, 0.2, 0.3, 0.3, 0.3, 0], [0.3, 0.1, 0.12, 0.1, 0.1, 0.2])
sound = usual[1] == 6 and usual[2] < 1e-9
sys.exit(not (sound and first[0] == 0 and last[0] >= 6 and last[1] == 0 and last[2] < 1e-9 and last[3] > 1e-3))
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
