#!/usr/bin/env bash
# rerun-sdk 0.41.0: a URDF hinge about 1 2 3 gets a quaternion that is not of length 1; shown as a rotation it turns three times as far.
#
# An axis of a URDF is a direction, and axes such as 1 1 0 are written in many files. UrdfJoint.compute_transform, which is made for logging
# the poses of joints, multiplies the axis as it stands by the sine of half the angle: for 0.5 rad about 1 2 3 the quaternion has the
# length 1.34, and normalised it is a turn by 1.53 rad. A slide along 0 0 2 moves by twice its value.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check rerun-sdk==0.41.0 numpy==2.4.6
cat > "$folder/arm.urdf" <<'URDF'
<robot name="arm">
  <link name="base"/><link name="straight"/><link name="skew"/><link name="slide"/>
  <joint name="straight" type="revolute">
    <parent link="base"/><child link="straight"/><axis xyz="0 0 1"/><limit lower="-0.6" upper="0.6" effort="1" velocity="1"/>
  </joint>
  <joint name="skew" type="revolute">
    <parent link="base"/><child link="skew"/><axis xyz="1 2 3"/><limit lower="-0.6" upper="0.6" effort="1" velocity="1"/>
  </joint>
  <joint name="slide" type="prismatic">
    <parent link="base"/><child link="slide"/><axis xyz="0 0 2"/><limit lower="-0.6" upper="0.6" effort="1" velocity="1"/>
  </joint>
</robot>
URDF
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
import warnings
import numpy
import rerun
import rerun.urdf

rerun.init("arm")
warnings.simplefilter("error")
tree = rerun.urdf.UrdfTree.from_file_path(sys.argv[1] + "/arm.urdf")


def plain(component):
    return numpy.array(component.as_arrow_array().to_pylist(), dtype=float).ravel()


seen = {}
for joint in tree.joints():
    move = joint.compute_transform(0.5)
    quaternion = plain(move.quaternion)  # x, y, z, w
    length = float(numpy.linalg.norm(quaternion))
    turn = float(2 * numpy.arctan2(numpy.linalg.norm(quaternion[:3]), quaternion[3]))
    seen[joint.name] = length, turn, float(plain(move.translation)[2])
    print(f"{joint.name} at 0.5: length of the quaternion {length:.4f}, turn {turn:.4f} rad, moved along z by {seen[joint.name][2]:.4f}")
print("rerun-sdk", importlib.metadata.version("rerun-sdk"))
expected = {"straight": (1, 0.5, 0), "skew": (1.3405, 1.5252, 0), "slide": (1, 0, 1)}
sys.exit(not all(numpy.allclose(seen[name], values, atol=2e-3) for name, values in expected.items()))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
