#!/usr/bin/env bash
# mujoco 4.0.0, urdf2any 0.3.0, scikit-robot 0.4.7: a URDF joint that is locked by equal limits turns without limit.
#
# lower="0" upper="0" is a common way to lock a joint without renaming its type, and 0.5 and 0.5 holds it in another place. Pinocchio keeps
# both. A range of MJCF must grow, so that MJCF has to say it in another way: no joint, or an equality. Two converters leave the
# range out, the joint that could not move is free, and neither says so. MuJoCo, reading the URDF itself, ignores the limits too, with a warning.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check \
  urdf2any==0.3.0 scikit-robot==0.4.7 mujoco==4.0.0 pin==4.1.0 numpy==2.4.6
cat > "$folder/arm.urdf" <<'URDF'
<robot name="arm">
  <link name="base"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="arm"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="hinge" type="revolute">
    <parent link="base"/><child link="arm"/><origin xyz="0 0 1"/><axis xyz="0 0 1"/>
    <limit lower="VALUE" upper="VALUE" effort="1" velocity="1"/>
  </joint>
</robot>
URDF
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import subprocess
import sys
import mujoco
import pinocchio

folder = sys.argv[1]
text = open(folder + "/arm.urdf").read()


def limits(path):
    try:
        model = mujoco.MjModel.from_xml_path(path)
    except ValueError as error:
        return str(error).split("\n")[0]
    return model.jnt_range[0].tolist() if model.jnt_limited[0] else "free"


def convert(name, path, *command):
    target = f"{folder}/{name}.xml"
    run = subprocess.run([folder + "/venv/bin/" + command[0], *command[1:], "-o", target, path], capture_output=True, text=True)
    said = (run.stdout + run.stderr).lower()
    return limits(target), run.returncode, "warn" in said or "limit" in said


seen = {}
for value in ("0", "0.5"):
    path = f"{folder}/arm_{value}.urdf"
    open(path, "w").write(text.replace("VALUE", value))
    model = pinocchio.buildModelFromUrdf(path)
    seen[value] = {
        "Pinocchio": [float(model.lowerPositionLimit[0]), float(model.upperPositionLimit[0])],
        "MuJoCo": limits(path),
        "urdf2any": convert("any", path, "urdf2any", "--no-actuators"),
        "scikit-robot": convert("scikit", path, "convert-urdf-to-mjcf", "--no-actuators", "--no-ground"),
    }
    print(f"limits {value} and {value}:", seen[value])
for package in ("mujoco", "urdf2any", "scikit-robot", "pin"):
    print(package, importlib.metadata.version(package))
zero, half = seen["0"], seen["0.5"]
right = zero["Pinocchio"] == [0, 0] and half["Pinocchio"] == [0.5, 0.5] and zero["MuJoCo"] == half["MuJoCo"] == "free"
right &= all(found[name] == ("free", 0, False) for found in (zero, half) for name in ("urdf2any", "scikit-robot"))
sys.exit(not right)
PYTHON
cd "$folder"  # MuJoCo writes its warnings to a file where it is run
"$folder/venv/bin/python" "$folder/try.py" "$folder"
