#!/usr/bin/env bash
# eaik 1.2.2: for an arm with a spherical wrist and no other special axes, exact solutions are marked as approximations, among wrong ones.
#
# IK returns angles Q and for each a flag is_LS, true for a least squares solution, where there is no exact one. The
# family 6R-SPHERICAL_NO_PARALLEL_NO_INTERSECTING is among those that have a known decomposition. For poses made with the arm's own
# forward kinematics 16 or 32 solutions come back, every one of them with is_LS true. Some are exact to 1e-9, most put the tool
# up to half a metre elsewhere, and only running fwdKin on each tells which. A program that drops what is_LS marks has no solution
# at any pose. With the second and third axis parallel, flags and poses agree.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check eaik==1.2.2 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import math
import sys
import numpy
from eaik.IK_DH import DhRobot

right = math.pi / 2


def examine(second):
    twist = numpy.array([right, second, right, -right, right, 0])
    arm = DhRobot(twist, numpy.array([0.1, 0.4, 0.1, 0, 0, 0]), numpy.array([0.3, 0.1, 0.2, 0.4, 0, 0.1]))
    numbers = numpy.random.default_rng(2)
    exact = {True: 0, False: 0}
    wrong = {True: 0, False: 0}
    without = 0
    for _ in range(20):
        q = numbers.uniform(-3, 3, 6)
        pose = arm.fwdKin(q)
        found = arm.IK(pose)
        gaps = [numpy.abs(arm.fwdKin(numpy.array(each)) - pose).max() for each in found.Q]
        without += min(gaps) > 1e-9
        for gap, flag in zip(gaps, found.is_LS):
            (exact if gap < 1e-9 else wrong)[bool(flag)] += 1
    print(arm.getKinematicFamily(), arm.hasKnownDecomposition())
    print(f"  exact, not marked {exact[False]}; exact, marked {exact[True]}; wrong, marked {wrong[True]}; wrong, not marked {wrong[False]}")
    return exact, wrong, without, arm.hasKnownDecomposition()


exact, wrong, without, known = examine(1.0)
usual, _, _, _ = examine(0.0)
sys.exit(not (known and without == 0 and exact[False] == wrong[False] == 0 and exact[True] >= 40 < wrong[True] and usual[False] > 0))
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
