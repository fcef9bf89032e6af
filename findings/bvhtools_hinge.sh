#!/usr/bin/env bash
# bvhtools 1.6.0: a joint of a BVH file with one angle does not turn, a root that is drawn elsewhere stands at 0, and the height of a skeleton is its width.
#
# A joint of a BVH file has as many channels as it needs: an elbow or a crank has one. getFKAtFrame turns a joint only where it has all three rotations; a
# hinge stays as it is drawn in every frame, and nothing is said (position channels that it passes over are named in a warning). The OFFSET of the root is
# left out. getSkeletonDim("width") gives the height and "height" the width, so that getFKAtFrameNormalized(frame, "height")
# divides by the width: a standing pole of 4 and 1 wide comes out 4 high, where it should be 1.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m pip install --quiet --disable-pip-version-check --root-user-action ignore --target "$folder/packages" \
  --no-deps bvhtools==1.6.0 numpy==2.4.6 scipy==1.17.1
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
import numpy
from bvhTools.bvhIO import readBvh

FILE = """HIERARCHY
ROOT Base
{{
  OFFSET 0 {height} 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Post
  {{
    OFFSET 0 3 0
    CHANNELS {channels}
    End Site
    {{
      OFFSET 1 1 0
    }}
  }}
}}
MOTION
Frames: 1
Frame Time: 0.5
0 0 0 0 0 0 {frame}
"""


def read(height, channels, frame):
    path = sys.argv[1] + "/post.bvh"
    with open(path, "w") as file:
        file.write(FILE.format(height=height, channels=channels, frame=frame))
    return readBvh(path)


def place(skeleton, joint):
    return [round(float(value), 6) + 0.0 for value in skeleton.getFKAtFrame(0)[joint][1]]


hinge = place(read(0, "1 Zrotation", "90"), "Post_EndSite")
ball = place(read(0, "3 Zrotation Xrotation Yrotation", "90 0 0"), "Post_EndSite")
raised = place(read(5, "1 Zrotation", "0"), "Base")
straight = read(0, "1 Zrotation", "0")
sizes = {name: float(straight.getSkeletonDim(name)) for name in ("width", "height", "depth")}
top = float(straight.getFKAtFrameNormalized(0, "height")["Post_EndSite"][1][1])
print("Zrotation 90: end of a joint with one channel at", hinge, "- with three", ball)
print("root with OFFSET 0 5 0 and channels at 0: at", raised)
print("from (0, 0, 0) to (1, 4, 0):", sizes, "- normalised by its height it is", top, "high")
print("bvhtools", importlib.metadata.version("bvhtools"))
sys.exit(not (
    numpy.allclose(hinge, [1, 4, 0]) and numpy.allclose(ball, [-1, 4, 0]) and numpy.allclose(raised, [0, 0, 0])
    and sizes == {"width": 4, "height": 1, "depth": 0} and top == 4))
PYTHON
PYTHONPATH="$folder/packages" python3 "$folder/try.py" "$folder"
