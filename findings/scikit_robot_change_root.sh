#!/usr/bin/env bash
# scikit-robot 0.4.7, change-urdf-root: a joint without <axis> turns the other way afterwards; a joint without <origin> stops the tool.
#
# Making another link the root reverses the joints between the two. The tool does that well: frames, masses and shapes are moved, the
# axis changes sign, so that values and limits keep their meaning. A joint that relies on URDF's default axis (1 0 0) has no element whose
# sign could change, and is written as it was: limits of -0.5 to 2 now allow 2 where it could go by 0.5. A joint without
# <origin>, which URDF takes for 0, ends in "'NoneType' object has no attribute 'get'" and exit code 1.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check scikit-robot==0.4.7 pin==4.1.0 numpy==2.4.6
cat > "$folder/arm.urdf" <<'URDF'
<robot name="arm">
  <link name="base"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="arm"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="hand"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="shoulder" type="revolute">
    <parent link="base"/><child link="arm"/>ORIGIN AXIS<limit lower="-0.5" upper="2" effort="1" velocity="1"/>
  </joint>
  <joint name="wrist" type="fixed"><parent link="arm"/><child link="hand"/><origin xyz="0 1 0"/></joint>
</robot>
URDF
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import subprocess
import sys
import numpy
import pinocchio

folder = sys.argv[1]
text = open(folder + "/arm.urdf").read()


def turn(path):
    """The angle by which the hand turns against the base, about x, when the shoulder is at 0.4."""
    model = pinocchio.buildModelFromUrdf(path)
    data = model.createData()
    frames = []
    for value in (0.0, 0.4):
        pinocchio.framesForwardKinematics(model, data, numpy.array([value]))
        base, hand = (data.oMf[model.getFrameId(name)].rotation for name in ("base", "hand"))
        frames.append(base.T @ hand)
    return float(pinocchio.log3(frames[1] @ frames[0].T)[0])


def ask(name, origin, axis):
    first, second = f"{folder}/{name}.urdf", f"{folder}/{name}_again.urdf"
    open(first, "w").write(text.replace("ORIGIN", origin).replace("AXIS", axis))
    run = subprocess.run([folder + "/venv/bin/change-urdf-root", first, "hand", second], capture_output=True, text=True)
    if run.returncode:
        return run.returncode, (run.stdout + run.stderr).strip().split("\n")[-1]
    return round(turn(first), 6), round(turn(second), 6)


origin, axis = '<origin xyz="0 0 1"/>', '<axis xyz="1 0 0"/>'
seen = [ask("both", origin, axis), ask("no_axis", origin, ""), ask("no_origin", "", axis)]
for name, found in zip(("axis written", "axis left out: turn before and after", "origin left out"), seen):
    print(f"{name}: {found}")
for package in ("scikit-robot", "pin"):
    print(package, importlib.metadata.version(package))
sys.exit(not (seen[0] == (0.4, 0.4) and seen[1] == (0.4, -0.4) and seen[2][0] == 1 and "NoneType" in seen[2][1]))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
