#!/usr/bin/env bash
# pymunk 7.3.1: limits, gears and ratchets count the angle of the second body against the first, motors and rotary springs the other way.
#
# The five constraints take (a, b, ...) and speak of the relative angle of the bodies. With a held still and all numbers positive, a RotaryLimitJoint of
# 0.2 to 0.5, a GearJoint with phase 0.3 and a RatchetJoint leave b at a positive angle; a DampedRotarySpring with rest angle 0.3 takes it to
# -0.3, and a SimpleMotor with rate 1 turns it by -1 rad in a second. The motor of a crank and the limits of the same crank, written with the same
# numbers and the same order of bodies, work against one another. With a ratio, the phase of a gear is that of b times the ratio.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pymunk==7.3.1
cat > "$folder/try.py" <<'PYTHON'
import math
import sys
import pymunk


def angle(constraint, seconds=5, torque=0.0):
    """The angle that b, free to turn, comes to from 0 when a is held at 0."""
    space = pymunk.Space()
    space.damping = 0.1
    ground = space.static_body
    a, b = pymunk.Body(1, 1), pymunk.Body(1, 1)
    b.position = 3, 0
    space.add(a, b, pymunk.PivotJoint(ground, a, (0, 0)), pymunk.PivotJoint(ground, b, (3, 0)), pymunk.RotaryLimitJoint(ground, a, 0, 0))
    space.add(constraint(a, b))
    for _ in range(200 * seconds):
        b.torque = torque
        space.step(0.005)
    return b.angle


right = True
for name, seen, low, high in (
    ("RotaryLimitJoint(a, b, 0.2, 0.5)", angle(lambda a, b: pymunk.RotaryLimitJoint(a, b, 0.2, 0.5)), 0.19, 0.51),
    ("GearJoint(a, b, 0.3, 1)", angle(lambda a, b: pymunk.GearJoint(a, b, 0.3, 1)), 0.299, 0.301),
    ("GearJoint(a, b, 0.3, 2)", angle(lambda a, b: pymunk.GearJoint(a, b, 0.3, 2)), 0.149, 0.151),
    ("RatchetJoint(a, b, 0, pi / 2), pushed forwards", angle(lambda a, b: pymunk.RatchetJoint(a, b, 0, math.pi / 2), 2, 1.0), 0.3, 9.0),
    ("RatchetJoint(a, b, 0, pi / 2), pushed backwards", angle(lambda a, b: pymunk.RatchetJoint(a, b, 0, math.pi / 2), 2, -1.0), -0.01, 0.01),
    ("DampedRotarySpring(a, b, 0.3, 50, 5)", angle(lambda a, b: pymunk.DampedRotarySpring(a, b, 0.3, 50, 5)), -0.301, -0.299),
    ("SimpleMotor(a, b, 1), after a second", angle(lambda a, b: pymunk.SimpleMotor(a, b, 1), 1), -1.01, -0.98),
):
    print(f"{name}: b at {seen:.3f} rad")
    right &= low < seen < high
print("pymunk", pymunk.version)
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
