#!/usr/bin/env bash
# dual-quaternions 0.4.0: the screw of a turn by more than half a turn is another motion: the other way round, about another line.
#
# from_screw makes a dual quaternion from axis, moment, angle and travel; screw() gives them back, and pow() goes through them. Up to
# half a turn that is exact. A turn by 4 rad about z through (1, 2, 0) comes back as one by -2.28 about -z, which is +2.28 about z, where
# -2.28 would be the same pose, and about a line through (-0.86, 2.06, 0). Poses put together again differ by 1.5. pow(1), which should
# change nothing, does too. Products of a few poses are enough to get there, since a dual quaternion and its negative are one pose.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check dual-quaternions==0.4.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
import numpy
from dual_quaternions import DualQuaternion

axis, point = numpy.array([0.0, 0.0, 1.0]), numpy.array([1.0, 2.0, 0.0])


def matrix(motion):
    return motion.homogeneous_matrix()


def off(angle):
    """How far poses are off after screw() and from_screw(), and after pow(1); the point of the axis that screw() gives."""
    motion = DualQuaternion.from_screw(axis, numpy.cross(point, axis), angle, 0.3)
    direction, moment, turned, along = motion.screw()
    again = DualQuaternion.from_screw(direction, moment, turned, along)
    through = numpy.cross(direction, moment)
    print(f"{angle} rad about z through {point}: {turned:.4f} about {direction + 0.0} through {numpy.round(through, 3)};",
          f"off by {abs(matrix(again) - matrix(motion)).max():.1e}, pow(1) by {abs(matrix(motion.pow(1.0)) - matrix(motion)).max():.1e}")
    return abs(matrix(again) - matrix(motion)).max(), abs(matrix(motion.pow(1.0)) - matrix(motion)).max(), through


right = True
for angle in (1.0, 3.0):
    right &= max(off(angle)[:2]) < 1e-12
for angle in (4.0, 5.0):
    right &= min(off(angle)[:2]) > 0.5
through = off(4.0)[2]
right &= numpy.allclose(through, [-0.86, 2.064, 0], atol=2e-3)
half = matrix(DualQuaternion.from_screw(axis, numpy.cross(point, axis), 2.0, 0.15))
twice = matrix(DualQuaternion.from_screw(axis, numpy.cross(point, axis), 4.0, 0.3))
right &= numpy.allclose(half @ half, twice)
two = DualQuaternion.from_homogeneous_matrix(half) * DualQuaternion.from_homogeneous_matrix(half)
print(f"two poses of 2 rad multiplied: pow(1) off by {abs(matrix(two.pow(1.0)) - matrix(two)).max():.1e}")
right &= abs(matrix(two.pow(1.0)) - matrix(two)).max() > 0.5
print("dual-quaternions", importlib.metadata.version("dual-quaternions"))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
