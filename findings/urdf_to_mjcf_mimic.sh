#!/usr/bin/env bash
# urdf-to-mjcf 0.1.1: a <mimic> comes out the wrong way round: the leader follows the follower, at the reciprocal ratio.
#
# URDF: value of the follower = multiplier * leader + offset. MuJoCo's joint equality: joint1 = polynomial of joint2, so joint1 must be
# the follower. The converter, which names mimic tags among its features, writes the leader as joint1 and the
# follower as joint2, with the coefficients of the URDF. A follower with multiplier 2 and offset 0.1 becomes one that turns half as far as
# its leader: at 0.5 rad of the leader it stands at 0.2 and not at 1.1. With multiplier 1 or -1
# and offset 0, as in a gripper, it does not show. MuJoCo's own URDF reader has the two joints as they should be.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check urdf-to-mjcf==0.1.1 mujoco==4.0.0 numpy==2.4.6
cat > "$folder/gears.urdf" <<'URDF'
<robot name="gears">
  <link name="base">
    <inertial><origin xyz="0 0 0"/><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision>
  </link>
  <link name="wheel">
    <inertial><origin xyz="0 0 0"/><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision>
  </link>
  <link name="pinion">
    <inertial><origin xyz="0 0 0"/><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision>
  </link>
  <joint name="leader" type="revolute">
    <parent link="base"/>
    <child link="wheel"/>
    <axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/>
  </joint>
  <joint name="follower" type="revolute">
    <parent link="base"/>
    <child link="pinion"/>
    <origin xyz="1 0 0"/>
    <axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/>
    <mimic joint="leader" multiplier="2" offset="0.1"/>
  </joint>
</robot>
URDF
"$folder/venv/bin/urdf-to-mjcf" "$folder/gears.urdf" -o "$folder/out/gears.xml" --skip-mesh-postprocess 2> "$folder/log" || {
  cat "$folder/log"
  exit 1
}
cat > "$folder/try.py" <<'PYTHON'
import sys
import mujoco

found = {}
for file in ("gears.urdf", "out/gears.xml"):
    model = mujoco.MjModel.from_xml_path(sys.argv[1] + "/" + file)
    first, second = (model.joint(int(id[0])).name for id in (model.eq_obj1id, model.eq_obj2id))
    found[file] = (first, second, *model.eq_data[0][:3].tolist())
    print(f"{file}: {first} = {model.eq_data[0][0]} + {model.eq_data[0][1]} * {second}")
print("MuJoCo", mujoco.__version__)
right = found["gears.urdf"] == ("follower", "leader", 0.1, 2, 0)
sys.exit(not (right and found["out/gears.xml"] == ("leader", "follower", 0.1, 2, 0)))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
