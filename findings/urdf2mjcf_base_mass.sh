#!/usr/bin/env bash
# urdf2mjcf 0.2.39 and urdf-to-mjcf 0.1.1: the mass of the root link is not converted; a link without geometry goes to z = -inf.
#
# Both write a free joint on the root link, so its mass counts: it is the trunk of a legged robot. The <inertial> of all other
# links is taken over, that of the root is not, and MuJoCo makes up one from the geometry at the density of water: a trunk of 5 kg
# with a box of 0.2 m weighs 8 kg. The root is also lifted until the lowest geometry stands on the ground, so a description
# without geometry, which URDF allows, gets pos="0 0 -inf", and no mass. MuJoCo does not load it. Exit code 0, and no word.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
python3 -m venv "$folder/other"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check urdf2mjcf==0.2.39 mujoco==4.0.0 numpy==2.4.6
"$folder/other/bin/pip" install --quiet --disable-pip-version-check urdf-to-mjcf==0.1.1 mujoco==4.0.0 numpy==2.4.6
cat > "$folder/solid.urdf" <<'URDF'
<robot name="walker">
  <link name="trunk">
    <inertial>
      <origin xyz="0 0 0"/>
      <mass value="5"/>
      <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>
    </inertial>
    <collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision>
  </link>
  <link name="leg">
    <inertial>
      <origin xyz="0 0 0"/>
      <mass value="3"/>
      <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>
    </inertial>
  </link>
  <joint name="hip" type="continuous">
    <parent link="trunk"/>
    <child link="leg"/>
    <axis xyz="0 1 0"/>
  </joint>
</robot>
URDF
grep -v collision "$folder/solid.urdf" > "$folder/bare.urdf"
for file in solid bare; do
  "$folder/venv/bin/urdf2mjcf" "$folder/$file.urdf" --output "$folder/first/$file.xml" 2> "$folder/log"
  "$folder/other/bin/urdf-to-mjcf" "$folder/$file.urdf" -o "$folder/second/$file.xml" --skip-mesh-postprocess 2> "$folder/log"
done
cat > "$folder/try.py" <<'PYTHON'
import sys
import xml.etree.ElementTree
import mujoco

expected = True
for folder in ("first", "second"):
    model = mujoco.MjModel.from_xml_path(f"{sys.argv[1]}/{folder}/solid.xml")
    masses = {name: float(model.body(name).mass[0]) for name in ("trunk", "leg")}
    bare = f"{sys.argv[1]}/{folder}/bare.xml"
    place = xml.etree.ElementTree.parse(bare).find("worldbody/body").get("pos")
    try:
        mujoco.MjModel.from_xml_path(bare)
        refused = ""
    except ValueError as error:
        refused = str(error).replace("\n", " ")
    print(f"{folder}: masses {masses}; without geometry at {place}: {refused}")
    expected &= abs(masses["trunk"] - 8) < 1e-6 and masses["leg"] == 3 and place.endswith("-inf") and bool(refused)
sys.exit(not expected)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
