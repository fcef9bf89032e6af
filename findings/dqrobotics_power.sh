#!/usr/bin/env bash
# dqrobotics 26.4.0a7: the square of a pose is not the pose times itself, and its power -1 is not its inverse.
#
# pow(x, a) is said to return x raised to the power of a. For pure turns and pure shifts it does. For a screw about an axis that is not at
# the origin (0.7 rad about z through (1, 2, 0), 0.3 along it) pow(x, 2) is off from x * x by 0.47 and pow(x, -1) from the inverse by 0.52;
# half the motion, made twice, is not the motion. log and exp undo each other, but log takes half the translation itself for the dual
# part, so that multiplying it by a scales angle and translation each by itself, and the point between two poses is not on the screw.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check dqrobotics==26.4.0a7 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
from dqrobotics import DQ, E_, exp, k_, log, pow


def screw(angle, travel, through):
    """A turn about z through a point, and a travel along it."""
    point = DQ([0, *through])
    shift = 1 + 0.5 * E_ * point
    turn = DQ([math.cos(angle / 2), 0, 0, math.sin(angle / 2)])
    return (1 + 0.5 * E_ * (travel * k_)) * (shift * turn * shift.conj())


def off(one, other):
    return float(abs((one - other).vec8()).max())


right = True
for name, motion, half, exact in (
    ("turn about the origin", screw(0.7, 0, (0, 0, 0)), screw(0.35, 0, (0, 0, 0)), True),
    ("shift", 1 + 0.5 * E_ * DQ([0, 1, 2, 3]), 1 + 0.25 * E_ * DQ([0, 1, 2, 3]), True),
    ("screw about (1, 2, 0)", screw(0.7, 0.3, (1, 2, 0)), screw(0.35, 0.15, (1, 2, 0)), False),
):
    assert off(half * half, motion) < 1e-12 and off(motion * motion.conj(), DQ([1])) < 1e-12
    gaps = [off(pow(motion, 2), motion * motion), off(pow(motion, -1), motion.conj()), off(pow(motion, 0.5), half)]
    print(f"{name}: square, inverse and half off by {gaps[0]:.3f}, {gaps[1]:.3f} and {gaps[2]:.3f};",
          f"power 1 by {off(pow(motion, 1), motion):.1e}, exp of log by {off(exp(log(motion)), motion):.1e}")
    right &= off(pow(motion, 1), motion) < 1e-12 and off(exp(log(motion)), motion) < 1e-12
    right &= max(gaps) < 1e-12 if exact else gaps[0] > 0.4 and gaps[1] > 0.4 and gaps[2] > 0.05
print("dqrobotics", importlib.metadata.version("dqrobotics"))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
