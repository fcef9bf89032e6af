#!/usr/bin/env bash
# threepp 2026.10.11: a robot that was just moved gives the pose of its last link in its parent for the pose of its end effector.
#
# set_joint_value moves the joints, and joint_values has the new values. get_end_effector_transform then multiplies nothing: it is the
# matrix of the last link alone, as if the links before it were not there, until update_matrix_world has been called. An arm of
# three links of 1 m, stretched, reaches 1 m before that call and 3 m after it. compute_end_effector_transform
# of the same values is right at once. A <mimic> is a joint of its own: it stays where it is when its leader moves, and the
# loader's list of diagnostics is empty.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check threepp==2026.10.11 numpy==2.4.6
cat > "$folder/arm.urdf" <<'URDF'
<robot name="arm">
  <link name="base"/>
  <link name="upper"/>
  <link name="lower"/>
  <link name="hand"/>
  <joint name="leader" type="revolute">
    <parent link="base"/>
    <child link="upper"/>
    <origin xyz="1 0 0"/>
    <axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/>
  </joint>
  <joint name="follower" type="revolute">
    <parent link="upper"/>
    <child link="lower"/>
    <origin xyz="1 0 0"/>
    <axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/>
    <mimic joint="leader"/>
  </joint>
  <joint name="tool" type="fixed">
    <parent link="lower"/>
    <child link="hand"/>
    <origin xyz="1 0 0"/>
  </joint>
</robot>
URDF
cat > "$folder/try.py" <<'PYTHON'
import math
import sys
import numpy
import threepp

loader = threepp.URDFLoader()
robot = loader.load(sys.argv[1] + "/arm.urdf")
names = [joint.name for joint in robot.get_articulated_joint_info()]
print("joints", names, "of which can be set", robot.num_dof, "end effector", robot.end_effector_link)


def position(matrix):
    return numpy.asarray(matrix.to_numpy(), dtype=float)[:3, 3].round(6) + 0.0


robot.set_joint_value(0, 0.0)
before = position(robot.get_end_effector_transform())
computed = position(robot.compute_end_effector_transform([0.0] * robot.num_dof))
robot.update_matrix_world(True)
after = position(robot.get_end_effector_transform())
print("stretched: before", before, "computed", computed, "after update_matrix_world", after)
robot.set_joint_value(0, math.pi / 2)
values = [round(value, 6) for value in robot.joint_values()]
robot.update_matrix_world(True)
turned = position(robot.get_end_effector_transform())
print("leader at 90 degrees: values", values, "hand at", turned, "where (0, 1, 0) is meant; diagnostics", loader.diagnostics)
sys.exit(not (before[0] == 1 and computed[0] == after[0] == 3 and values[1] == 0 and turned.tolist() == [1, 2, 0]))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
