#!/usr/bin/env bash
# urdf-validator 1.6.0: the motor that lifts a load through a <mimic> is told to carry nothing, and the follower to have a motor.
#
# A joint with <mimic> is moved by its leader, so that the load on it falls on the leader, times the multiplier. The tool compares
# the torque that gravity asks with the effort of each joint by itself: a jib of 2 kg at 1 m, which turns three times as far as its
# wheel, asks 58.86 N m of the wheel's motor. It reports 0, "torque negligible" and PASS for a motor of 20 N m, and exit code 0.
# It also puts the jib at 0 where an offset has it elsewhere at pose zero: offset="1" leaves 10.60 N m of the 19.62.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check urdf-validator==1.6.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import json
import math
import subprocess
import sys

folder = sys.argv[1]
inertia = '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'


def link(name, mass, x):
    return f'<link name="{name}"><inertial><origin xyz="{x} 0 0"/><mass value="{mass}"/>{inertia}</inertial></link>'


def joint(name, child, effort, more=""):
    limit = f'<axis xyz="0 1 0"/><limit lower="-3" upper="3" effort="{effort}" velocity="1"/>'
    return f'<joint name="{name}" type="revolute"><parent link="base"/><child link="{child}"/>{limit}{more}</joint>'


def examine(name, mimic):
    path = f"{folder}/{name}.urdf"
    links = link("base", 9, 0) + link("wheel", 1, 0) + link("jib", 2, 1)
    joints = joint("leader", "wheel", 20) + joint("follower", "jib", 100, mimic)
    open(path, "w").write(f'<robot name="{name}">{links}{joints}</robot>')
    run = subprocess.run([folder + "/venv/bin/urdf_validate", path], capture_output=True, text=True)
    rows = json.load(open(f"{folder}/{name}_validation.json"))["statics"]["joints"]
    asked = [round(row["required_torque_gravity"], 6) for row in rows]
    print(f"{mimic}: asked of leader and follower {asked} N m, exit code {run.returncode}")
    return asked, run.returncode


geared = examine("geared", '<mimic joint="leader" multiplier="3"/>')
lifted = examine("lifted", '<mimic joint="leader" offset="1"/>')
print("right: leader", 3 * 2 * 9.81, "and", round(2 * 9.81 * math.cos(1), 2))
sys.exit(not (geared == ([0, 19.62], 0) and lifted == ([0, 19.62], 0)))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
