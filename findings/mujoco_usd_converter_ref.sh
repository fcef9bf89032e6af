#!/usr/bin/env bash
# mujoco-usd-converter 0.8.0: limits of a joint with ref are written as if 0 were the pose drawn; Newton reads them that way.
#
# In MJCF ref is the value of the joint in the pose drawn: ref="30" range="0 90" may go back by 30 degrees and on by 60. In USD a
# joint's angle is measured between its two frames, here 0 in the pose drawn. The converter writes frames that coincide, limits of 0
# and 90, and mjc:ref = 30 beside them, which only a reader that knows MuJoCo's attributes can make use of. Newton 1.8.0 takes
# 0 to 90 around the pose drawn for its model: the arm cannot go back at all and goes 30 degrees too far on. Newton's reader of
# the MJCF file has -30 to 60.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export WARP_CACHE_PATH="$folder/kernels"
python3 -m venv "$folder/venv"
python3 -m venv "$folder/reader"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check mujoco-usd-converter==0.8.0 mujoco==3.16.0 numpy==2.4.6
"$folder/reader/bin/pip" install --quiet --disable-pip-version-check \
  newton==1.8.0 newton-usd-schemas==0.6.0 usd-core==26.8 warp-lang==1.19.0 mujoco==3.17.0 numpy==2.4.6
cat > "$folder/arm.xml" <<'MJCF'
<mujoco model="arm">
  <worldbody>
    <body name="arm">
      <joint name="elbow" ref="30" range="0 90"/>
      <geom size="0.1"/>
    </body>
  </worldbody>
</mujoco>
MJCF
"$folder/venv/bin/mujoco_usd_converter" "$folder/arm.xml" "$folder/usd" > "$folder/log" 2>&1 || {
  cat "$folder/log"
  exit 1
}
cat > "$folder/try.py" <<'PYTHON'
import glob
import sys
import newton
import numpy
import warp
from pxr import Usd, UsdPhysics

warp.config.quiet = True
folder = sys.argv[1]
usd = glob.glob(folder + "/usd/*.usda")[0]
stage = Usd.Stage.Open(usd)
joint = next(prim for prim in stage.Traverse() if prim.IsA(UsdPhysics.RevoluteJoint))
revolute = UsdPhysics.RevoluteJoint(joint)
written = [revolute.GetLowerLimitAttr().Get(), revolute.GetUpperLimitAttr().Get()]
frames = [revolute.GetLocalRot0Attr().Get(), revolute.GetLocalRot1Attr().Get()]
print("USD: limits", written, "frames", frames, "mjc:ref", joint.GetAttribute("mjc:ref").Get())


def limits(add, path):
    builder = newton.ModelBuilder()
    getattr(builder, add)(path)
    model = builder.finalize()
    both = (model.joint_limit_lower.numpy()[0], model.joint_limit_upper.numpy()[0])
    print("Newton,", add, "drawn at", model.joint_q.numpy()[0], "limits", numpy.degrees(both))
    return numpy.degrees(both)


right = limits("add_mjcf", folder + "/arm.xml")
wrong = limits("add_usd", usd)
same = written == [0, 90] and frames[0] == frames[1]
sys.exit(not (same and numpy.allclose(right, [-30, 60], atol=1e-3) and numpy.allclose(wrong, [0, 90], atol=1e-3)))
PYTHON
"$folder/reader/bin/python" "$folder/try.py" "$folder"
