#!/usr/bin/env bash
# armkin 0.7.0: an arm whose elbow is asked up has it down, and a stretched arm cannot reach the places where it stands.
#
# inverse(l1, l2, x, y, elbow_up=True) gives the two angles of a planar arm. With elbow_up, also where it is left out, the second angle is positive: for a
# target on the right of the base, with y up as in forward, the elbow is below the line from base to target, and False puts it above.
# Every place that forward gives is one that the arm reaches. Of 360 places of an arm with its elbow straight well over a hundred are
# "target out of reach", by a rounding in the last digit; bent by a degree all are found.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m pip install --quiet --disable-pip-version-check --root-user-action ignore --target "$folder/packages" armkin==0.7.0
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import armkin

elbows = {}
for up in (True, False):
    first, second = armkin.inverse(1.0, 1.0, 1.0, 0.0, elbow_up=up)
    elbows[up] = math.sin(first)
    tip = armkin.forward(1.0, 1.0, first, second)
    print(f"elbow_up={up}: angles {math.degrees(first):.1f} and {math.degrees(second):.1f} degrees, elbow at y = {elbows[up]:.4f}, tip at {tip[0]:.4f} {tip[1]:.4f}")


def refused(bend):
    count = 0
    for degrees in range(360):
        x, y = armkin.forward(1.0, 0.7, math.radians(degrees), math.radians(bend))
        try:
            armkin.inverse(1.0, 0.7, x, y)
        except ValueError as error:
            assert str(error) == "target out of reach"
            count += 1
    return count


straight, bent = refused(0), refused(1)
print("places of the straight arm that are refused:", straight, "of 360 - bent by a degree:", bent)
print("armkin", importlib.metadata.version("armkin"))
sys.exit(not (elbows[True] < -0.8 and elbows[False] > 0.8 and straight > 50 and bent == 0))
PYTHON
PYTHONPATH="$folder/packages" python3 "$folder/try.py"
