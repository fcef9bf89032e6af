#!/usr/bin/env bash
# ikpy 4.2.1: the length of a hinge's axis deforms what hangs on it.
#
# URDF says that an axis "should be normalized", and most readers normalise it. ikpy puts the numbers of <axis xyz="0 0 2"/> into
# Rodrigues' formula as they are: without a word, the pose of the next link is no rotation any more. At half a radian its
# determinant is 2.31, lengths along the axis are stretched by 1.37 and those across it by 1.30, and the angle in the plane is the
# one of (cos, 2 sin). The same angles on an axis of length one give determinant 1.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check ikpy==4.2.1 numpy==2.4.6 scipy==1.17.1
cat > "$folder/arm.urdf" <<'URDF'
<robot name="arm">
  <link name="base"/><link name="tip"/>
  <joint name="hinge" type="revolute">
    <parent link="base"/><child link="tip"/><axis xyz="0 0 LENGTH"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/>
  </joint>
</robot>
URDF
cat > "$folder/try.py" <<'PYTHON'
import sys
import warnings
import numpy
from ikpy.chain import Chain

warnings.simplefilter("ignore")
text = open(sys.argv[1] + "/arm.urdf").read()
seen = {}
for length in ("1", "2"):
    path = f"{sys.argv[1]}/arm_{length}.urdf"
    open(path, "w").write(text.replace("LENGTH", length))
    pose = Chain.from_urdf_file(path, base_elements=["base"]).forward_kinematics([0, 0.5])
    seen[length] = numpy.linalg.det(pose[:3, :3])
    print(f"axis of length {length}: determinant {seen[length]:.4f}")
    print(pose[:3, :3].round(4))
sys.exit(not (abs(seen["1"] - 1) < 1e-9 and abs(seen["2"] - 2.3100) < 1e-3))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
