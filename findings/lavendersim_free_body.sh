#!/usr/bin/env bash
# lavendersim 0.2.0: a body in empty space slows down by 9 % a second, a spinning one by 12 %, and no body tumbles: gyroscopic torque is left out.
#
# A simulator of rigid bodies and joints for robot learning. Without gravity, ground and joints a body must keep its velocity and its angular momentum.
# The velocity falls as exp(-0.09 t), the angular velocity as exp(-0.13 t). Neither can be set or is mentioned; a pendulum without friction comes to
# rest by them. A box that spins about a line between two of its axes must wobble: the angular momentum stays where it is and the angular velocity
# goes round it. Here the angular velocity keeps its direction, to 0.01 degrees, and the angular momentum is turned by 57 degrees, by no torque.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check lavendersim==0.2.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import lavendersim
import numpy

SIZE = (0.2, 0.4, 0.8)
MASS = 2.0
SPIN = numpy.array([0.0, 2.0, 2.0])
INERTIA = MASS / 12 * numpy.array([SIZE[1] ** 2 + SIZE[2] ** 2, SIZE[0] ** 2 + SIZE[2] ** 2, SIZE[0] ** 2 + SIZE[1] ** 2])


def rotation(x, y, z, w):
    return numpy.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ])


def between(a, b):
    return math.degrees(math.acos(min(1.0, float(a @ b / numpy.linalg.norm(a) / numpy.linalg.norm(b)))))


scene = lavendersim.Scene(ground=False, self_collision=False, gravity=0.0)
scene.box("free", size=SIZE, mass=MASS, position=(0, 0, 0), collision=False, linear_velocity=(1, 0, 0), angular_velocity=tuple(SPIN))
simulation = lavendersim.CodeSceneEnv(scene, horizon=None)
simulation.reset()
momentum = INERTIA * SPIN
turned = wandered = 0.0
while simulation.time < 10:
    simulation.step()
    state = simulation.body_state()[0].astype(float)
    turn, spin = rotation(*state[3:7]), state[10:13]
    wandered = max(wandered, between(spin, SPIN))
    turned = max(turned, between(turn @ (INERTIA * (turn.T @ spin)), momentum))
speed, spin = float(state[7]), float(numpy.linalg.norm(state[10:13]) / numpy.linalg.norm(SPIN))
rates = [-math.log(value) / simulation.time for value in (speed, spin)]
print("lavendersim", importlib.metadata.version("lavendersim"))
print(f"after {simulation.time:.2f} s the velocity is {speed:.3f} and the angular velocity {spin:.3f} of what they were: rates {rates[0]:.3f} and {rates[1]:.3f} 1/s")
print(f"direction of the angular velocity: changed by {wandered:.2f} degrees at most; of the angular momentum: by {turned:.0f} degrees")
sys.exit(not (abs(rates[0] - 0.09) < 0.002 and abs(rates[1] - 0.13) < 0.003 and wandered < 0.1 and abs(turned - 57) < 3))
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
