#!/usr/bin/env bash
# bvhtoolbox 0.1.3: converting centimetres to metres folds a skeleton up: every joint is scaled once more for each joint above it.
#
# bvh2csv writes the places of all joints of a BVH file, with a "scale factor for root position and offset values". The factor is applied to the place
# of a joint in the world, and the place of the next joint is built on that: three bars of 10 cm in a row, at 0.01, end at 0.101 m, not at 0.3 m.
# At 1 the places are right. How often a frame has a time is rounded as well: three frames of 0.1 s are 0.30000000000000004 s, which gives
# four times for three poses, and the conversion ends in a ValueError; three frames of 0.5 s are converted.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m pip install --quiet --disable-pip-version-check --root-user-action ignore --target "$folder/packages" \
  --no-deps bvhtoolbox==0.1.3 transforms3d==0.4.2 numpy==2.4.6 setuptools==75.8.0 packaging==24.2
cat > "$folder/try.py" <<'PYTHON'
import csv
import importlib.metadata
import sys
import warnings

warnings.filterwarnings("ignore")
from bvhtoolbox import BvhTree
from bvhtoolbox.convert.bvh2csv import write_joint_positions

CHANNELS = "Zrotation Xrotation Yrotation"
FILE = """HIERARCHY
ROOT Base
{{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition {channels}
  JOINT Crank
  {{
    OFFSET 10 0 0
    CHANNELS 3 {channels}
    JOINT Coupler
    {{
      OFFSET 10 0 0
      CHANNELS 3 {channels}
      End Site
      {{
        OFFSET 10 0 0
      }}
    }}
  }}
}}
MOTION
Frames: {count}
Frame Time: {time}
{frames}
"""


def places(scale, count, time):
    frames = "\n".join(["0 0 0" + " 0" * 9] * count)
    path = sys.argv[1] + "/places.csv"
    tree = BvhTree(FILE.format(channels=CHANNELS, count=count, time=time, frames=frames))
    write_joint_positions(tree, path, scale=scale, end_sites=True)
    last = [float(value) for value in list(csv.reader(open(path)))[-1]]
    return last[1::3]


one, small = places(1.0, 3, 0.5), places(0.01, 3, 0.5)
print("x of base, crank, coupler, end at scale 1:", one, "- at 0.01:", small)
try:
    frames = places(1.0, 3, 0.1)
except ValueError as error:
    frames = "ValueError"
    print("three frames of 0.1 s:", str(error)[:80])
print("bvhtoolbox", importlib.metadata.version("bvhtoolbox"))
near = all(abs(is_ - wrong) < 1e-5 for is_, wrong in zip(small, [0, 0.1, 0.101, 0.10101]))
sys.exit(not (one == [0, 10, 20, 30] and near and frames == "ValueError"))
PYTHON
PYTHONPATH="$folder/packages" python3 "$folder/try.py" "$folder"
