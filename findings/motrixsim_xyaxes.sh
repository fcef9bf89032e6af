#!/usr/bin/env bash
# motrixsim 0.10.1: xyaxes whose two axes are not at right angles gives a frame that is no rotation; bodies inside it are smaller.
#
# MJCF makes the second axis of xyaxes orthogonal to the first, so "1 0 0 1 1 0" is no turn at all; that is convenient for axes that are
# measured or rounded. MotrixSim makes a quaternion of the two axes as they stand. Its length is not 1 any more: the frame has a
# determinant of 0.89, is turned by 22 degrees, and a point that was 1 m from the body is 0.96 m away. Axes at right angles may have any length.
# Nothing is said.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check motrixsim==0.10.1 mujoco==4.0.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
import motrixsim
import mujoco
import numpy

text = """
<mujoco model="arm">
  <worldbody>
    <body name="arm" xyaxes="AXES">
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <joint name="hinge"/>
      <body name="hand" pos="1 0 0"><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/></body>
    </body>
  </worldbody>
</mujoco>
"""


def frames(axes):
    file = text.replace("AXES", axes)
    model = mujoco.MjModel.from_xml_string(file)
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    other = motrixsim.load_mjcf_str(file)
    state = motrixsim.SceneData(other)
    motrixsim.forward_kinematic(other, state)
    seen = numpy.array(other.get_link("arm").get_rotation_mat(state)).reshape(3, 3)
    return data.xmat[1].reshape(3, 3), seen, numpy.array(other.get_link("hand").get_position(state))


right = True
for axes, same in (("0 1 0 -1 0 0", True), ("0 2 0 -3 0 0", True), ("1 0 0 1 1 0", False)):
    theirs, seen, hand = frames(axes)
    size, turn = numpy.linalg.det(seen), numpy.degrees(numpy.arctan2(seen[1, 0], seen[0, 0]))
    print(f'xyaxes="{axes}": turned by {numpy.degrees(numpy.arctan2(theirs[1, 0], theirs[0, 0])):.2f} degrees in MuJoCo;',
          f"in MotrixSim by {turn:.2f}, determinant {size:.3f}, hand at a distance of {numpy.linalg.norm(hand):.3f}")
    right &= numpy.allclose(theirs, seen, atol=1e-5) == same
right &= abs(numpy.linalg.det(theirs) - 1) < 1e-9 and abs(theirs - numpy.eye(3)).max() < 1e-9
right &= abs(size - 0.886) < 0.01 and abs(turn + 21.6) < 0.5
for package in ("motrixsim", "mujoco"):
    print(package, importlib.metadata.version(package))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" 2>&1
