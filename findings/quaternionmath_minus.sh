#!/usr/bin/env bash
# quaternionmath 1.0.1: p - q is q - p, q - 2 is 2 - q, and q * 2 raises where 2 * q does not.
#
# The class is described as having addition, subtraction, multiplication and division of quaternions with each other and with numbers. Sums, products and
# quotients of quaternions are right. A difference has the wrong sign whichever side the number stands on, so that p - q + q is not p,
# and the derivative of an attitude by differences, (q(t + h) - q(t)) / h, turns the other way. A quaternion times a number on its right, whose
# docstring names int and float, ends in an AttributeError; divided by the same number it is right.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m pip install --quiet --disable-pip-version-check --root-user-action ignore --target "$folder/packages" quaternionmath==1.0.1
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
from quaternionmath import Quaternion


def parts(quaternion):
    return (quaternion.a, quaternion.b, quaternion.c, quaternion.d)


def turned(angle):
    """The turn about z by an angle."""
    return Quaternion(math.cos(angle / 2), 0.0, 0.0, math.sin(angle / 2))


p, q = Quaternion(5.0, 3.0, 2.0, 7.0), Quaternion(1.0, 1.0, 1.0, 1.0)
difference, less, more, back = parts(p - q), parts(p - 2), parts(2 - p), parts(p - q + q)
print("p =", parts(p), "q =", parts(q))
print("p - q =", difference, "- p - 2 =", less, "- 2 - p =", more, "- p - q + q =", back)
step = 1e-6
speed = 2 * (turned(step) - turned(0.0)).d / step
print(f"a turn about z at 1 rad/s: by differences {speed:.4f} rad/s")
try:
    product = parts(q * 2)
except AttributeError as error:
    product = str(error)
print("2 * q =", parts(2 * q), "- q / 2 =", parts(q / 2), "- q * 2:", product)
print("quaternionmath", importlib.metadata.version("quaternionmath"))
sys.exit(not (
    difference == (-4, -2, -1, -6) and less == (-3, -3, -2, -7) and more == (3, 3, 2, 7) and back == (-3, -1, 0, -5)
    and abs(speed + 1) < 1e-6 and parts(p + q) == (6, 4, 3, 8) and parts(2 * q) == (2, 2, 2, 2) and parts(q / 2) == (0.5, 0.5, 0.5, 0.5)
    and product == "'int' object has no attribute 'a'"))
PYTHON
PYTHONPATH="$folder/packages" python3 "$folder/try.py"
