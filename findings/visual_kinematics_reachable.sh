#!/usr/bin/env bash
# visual-kinematics 0.2.1: a planar arm "reaches" a target one metre above its plane; is_reachable_inverse is true wherever the search stands still.
#
# The numerical inverse ends in two cases with the same answer: the error is small, or the error no longer changes. The second is how a search ends that
# is as near as it can come to a pose that the arm cannot have. An arm of three joints in the plane z = 0, asked for a pose at z = 1, returns
# angles with is_reachable_inverse = True and its tip 1 m below the target, without a message. Only a search that keeps moving, as for a target far
# outside the reach, is answered with False. A target that the arm can reach is reached.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check visual-kinematics==0.2.1 numpy==2.4.6 scipy==1.17.1 matplotlib==3.11.2
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import matplotlib
matplotlib.use("Agg")
import numpy
from visual_kinematics.Frame import Frame
from visual_kinematics.RobotSerial import RobotSerial

# Denavit and Hartenberg: d, a, alpha, theta of three parallel axes, bars of 1, 1 and 0.5.
bars = numpy.array([[0, 1, 0, 0], [0, 1, 0, 0], [0, 0.5, 0, 0]], dtype=float)


def ask(height):
    robot = RobotSerial(bars)
    turn = 0.9
    rotation = numpy.array([[math.cos(turn), -math.sin(turn), 0], [math.sin(turn), math.cos(turn), 0], [0, 0, 1]])
    target = Frame.from_r_3_3(rotation, numpy.array([[1.2], [1.1], [height]]))
    robot.forward(numpy.array([0.4, 0.5, 0.6]))
    robot.inverse(target)
    return bool(robot.is_reachable_inverse), float(numpy.linalg.norm(robot.end_frame.t_3_1 - target.t_3_1))


right = True
for height in (0.0, 0.3, 1.0):
    reachable, off = ask(height)
    print(f"target at height {height}: reachable {reachable}, tip {off:.4f} from it")
    right &= reachable and abs(off - height) < 1e-3
print("visual-kinematics", importlib.metadata.version("visual-kinematics"))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" -W ignore "$folder/try.py"
