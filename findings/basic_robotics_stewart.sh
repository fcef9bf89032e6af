#!/usr/bin/env bash
# basic-robotics 1.0.2: a Stewart platform asked for leg lengths that no pose has stands at rest, and the answer is valid.
#
# SP.FK returns the pose of the top plate and a flag, described as validity. For legs of 0.5 m between joints on circles of
# 0.9 and 0.3 m (too short: in any pose the squares of the six lengths add up to 6 * 0.36 at least) it returns the rest pose, whose
# legs are 1.12 m, and True. Legs of 3 m, twice the MaxExtension of the actuators, are valid as well. Lengths that IK gave
# for a pose come back as that pose. Whoever checks the flag, as it is there for, takes the rest pose for the measured one.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check basic-robotics==1.0.2 numpy==2.4.6 numba==0.68.1 scipy==1.17.1
cat > "$folder/platform.json" <<'JSON'
{
  "Name": "platform",
  "Type": "SP",
  "BottomPlate": {"Thickness": 0.1, "JointRadius": 0.9, "JointSpacing": 9, "Mass": 6},
  "TopPlate": {"Thickness": 0.16, "JointRadius": 0.3, "JointSpacing": 25, "Mass": 1},
  "Actuators": {
    "MinExtension": 0.75, "MaxExtension": 1.5, "MotorMass": 0.5, "ShaftMass": 0.9,
    "ForceLimit": 800, "MotorCOGD": 0.2, "ShaftCOGD": 0.2
  },
  "Drawing": {"TopRadius": 1, "BottomRadius": 1, "ShaftRadius": 0.1, "MotorRadius": 0.2},
  "Settings": {
    "MaxAngleDev": 55, "GenerateActuators": 0, "IgnoreRestHeight": 1,
    "UseSpin": 0, "AssignMasses": 1, "InferActuatorCOG": 1
  },
  "Params": {"RestHeight": 1.2, "Spin": 30}
}
JSON
cat > "$folder/try.py" <<'PYTHON'
import sys
import warnings
import numpy
from basic_robotics.general import tm
from basic_robotics.kinematics import loadSP

warnings.simplefilter("ignore")


def fresh():
    return loadSP("platform.json", sys.argv[1] + "/")


def numbers(pose):
    return numpy.array(pose.gTAA(), dtype=float).ravel()


def legs(pose):
    return numpy.array(fresh().IK(top_plate_pos=pose, protect=True)[0], dtype=float).ravel()


rest = numbers(fresh().getTopT())
meant = tm([0.02, 0.03, rest[2] + 0.05, 0.05, -0.04, 0.03])
pose, valid = fresh().FK(legs(meant))
sound = valid and abs(numbers(pose) - numbers(meant)).max() < 1e-3
print("lengths of a pose: valid", valid, "off by", abs(numbers(pose) - numbers(meant)).max().round(6))
found = []
for length in (0.5, 3.0):
    pose, valid = fresh().FK(numpy.full(6, length))
    found.append((bool(valid), abs(numbers(pose) - rest).max(), legs(pose)))
    print(f"legs of {length} m: valid {valid}, pose {numbers(pose).round(4)}, whose legs are {legs(pose).round(4)}")
short, long = found
wrong = short[0] and short[1] < 1e-6 and short[2].min() > 1
sys.exit(not (sound and wrong and long[0] and abs(long[2] - 3).max() < 1e-3))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
