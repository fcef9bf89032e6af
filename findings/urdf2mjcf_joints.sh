#!/usr/bin/env bash
# urdf2mjcf 0.2.39: planar and floating joints become rigid, mimics are dropped, and a joint without <axis> turns about z.
#
# A converter may refuse what it has no word for. MJCF has a word for all of these, and MuJoCo's own URDF reader finds them: three
# joints for a planar one, a free joint, an equality for a <mimic>, and axis x where <axis> is left out. urdf2mjcf writes
# bodies without joints for the first two, no <equality>, and hinges without axis, for which MJCF takes z. It ends with
# exit code 0 and no word about any of them.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check urdf2mjcf==0.2.39 mujoco==4.0.0 numpy==2.4.6
cat > "$folder/make.py" <<'PYTHON'
import sys

link = '<link name="{}"><inertial><origin xyz="0 0 0"/><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>'
joint = '<joint name="{}" type="{}"><parent link="base"/><child link="{}"/>{}</joint>'
limit = '<limit lower="-1" upper="1" effort="1" velocity="1"/>'
axis = '<axis xyz="0 0 1"/>'
joints = [
    joint.format("table", "planar", "plate", axis),
    joint.format("flight", "floating", "bird", ""),
    joint.format("bare", "revolute", "door", limit),
    joint.format("leader", "revolute", "wheel", axis + limit),
    joint.format("follower", "revolute", "pinion", axis + limit + '<mimic joint="leader" multiplier="2"/>'),
]
names = ["base", "plate", "bird", "door", "wheel", "pinion"]
with open(sys.argv[1], "w") as file:
    file.write('<robot name="bench">' + "".join(map(link.format, names)) + "".join(joints) + "</robot>")
PYTHON
"$folder/venv/bin/python" "$folder/make.py" "$folder/bench.urdf"
"$folder/venv/bin/urdf2mjcf" "$folder/bench.urdf" --output "$folder/bench.xml" 2> "$folder/log" || {
  cat "$folder/log"
  exit 1
}
cat > "$folder/try.py" <<'PYTHON'
import sys
import mujoco

folder = sys.argv[1]
found = {}
for file in ("bench.urdf", "bench.xml"):
    model = mujoco.MjModel.from_xml_path(f"{folder}/{file}")
    counts = {name: int(model.body(name).jntnum[0]) for name in ("plate", "bird", "door", "pinion")}
    axis = model.jnt_axis[model.body("door").jntadr[0]].round(9).tolist()
    found[file] = (counts, axis, model.neq)
    print(f"{file}: joints {counts}, axis of the door {axis}, equalities {model.neq}")
log = open(folder + "/log").read()
told = [word for word in ("planar", "floating", "mimic", "axis") if word in log]
print("its log:", log.strip().replace("\n", " / "))
right = ({"plate": 3, "bird": 1, "door": 1, "pinion": 1}, [1, 0, 0], 1)
wrong = ({"plate": 0, "bird": 0, "door": 1, "pinion": 1}, [0, 0, 1], 0)
sys.exit(not (found["bench.urdf"] == right and found["bench.xml"] == wrong and not told))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
