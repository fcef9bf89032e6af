#!/usr/bin/env bash
# scikit-robot 0.4.7, mujoco 4.0.0, pytransform3d 3.17.0: a URDF limit that gives one bound only is read in four ways.
#
# In URDF lower and upper are optional and 0 where left out: upper="1" is 0 to 1. Pinocchio reads it so. scikit-robot takes -pi/2 and
# pi/2 for what is missing, of slides as well, whose travel of -0.5 to 0 m becomes -0.5 to 1.57 m. MuJoCo stores 0 and 1 and does not
# enforce them (limited is false), although it does with lower="0" written out. pytransform3d takes infinity. None says a word.
# A hinge that must not open backwards does so in three readers of four.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check \
  scikit-robot==0.4.7 pytransform3d==3.17.0 mujoco==4.0.0 pin==4.1.0 lxml==6.1.3 numpy==2.4.6
cat > "$folder/door.urdf" <<'URDF'
<robot name="door">
  <link name="frame"/>
  <link name="door">
    <inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <link name="bolt">
    <inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <joint name="hinge" type="revolute">
    <parent link="frame"/>
    <child link="door"/>
    <axis xyz="0 0 1"/>
    <limit LOWER upper="1" effort="1" velocity="1"/>
  </joint>
  <joint name="slide" type="prismatic">
    <parent link="door"/>
    <child link="bolt"/>
    <axis xyz="1 0 0"/>
    <limit lower="-0.5" UPPER effort="1" velocity="1"/>
  </joint>
</robot>
URDF
cat > "$folder/try.py" <<'PYTHON'
import math
import sys
import mujoco
import numpy
import pinocchio
from pytransform3d.urdf import UrdfTransformManager
from skrobot.models.urdf import RobotModelFromURDF

text = open(sys.argv[1] + "/door.urdf").read()


def read(lower, upper):
    path = f"{sys.argv[1]}/now{len(lower)}.urdf"
    file = text.replace("LOWER", lower).replace("UPPER", upper)
    open(path, "w").write(file)
    found = {}
    model = pinocchio.buildModelFromUrdf(path)
    found["pin"] = list(zip(model.lowerPositionLimit, model.upperPositionLimit))
    found["skrobot"] = [(joint.min_angle, joint.max_angle) for joint in RobotModelFromURDF(urdf_file=path).joint_list]
    model = mujoco.MjModel.from_xml_path(path)
    free = (-math.inf, math.inf)
    found["mujoco"] = [tuple(span) if on else free for on, span in zip(model.jnt_limited, model.jnt_range)]
    tree = UrdfTransformManager()
    tree.load_urdf(file)
    found["pytransform3d"] = [tree.get_joint_limits(name) for name in ("hinge", "slide")]
    for name, spans in found.items():
        print(f"  {name:14}", [tuple(round(float(x), 6) for x in span) for span in spans])
    return {name: numpy.array(spans, dtype=float) for name, spans in found.items()}


print("both bounds written:")
both = read('lower="0"', 'upper="0"')
print("one bound written:")
one = read("", "")
meant = numpy.array([(0, 1), (-0.5, 0)])
right = math.pi / 2
expected = {
    "pin": meant,
    "skrobot": [(-right, 1), (-0.5, right)],
    "mujoco": [(-math.inf, math.inf)] * 2,
    "pytransform3d": [(-math.inf, 1), (-0.5, math.inf)],
}
sound = all(numpy.allclose(spans, meant) for spans in both.values())
sys.exit(not (sound and all(numpy.allclose(one[name], spans) for name, spans in expected.items())))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
