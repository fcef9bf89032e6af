#!/usr/bin/env bash
# bashar 2.0.0: a camera that a URDF fixes to the base of an arm moves the arm's tip, by as much as the camera is away from the base.
#
# bashar refuses a URDF whose moving joints branch. Fixed joints may branch, as they do in any robot with a camera or a mounting plate. Its chain
# is the list of all joints from the base on, one level of the tree after another, and every origin in the list is multiplied into the
# transform, those beside the chain too. With a camera on a mast of 2 m at the base, the tip of an arm comes out 2 m too high in every pose
# (its axes are displaced as well), and with the camera at the shoulder's link, turned by 90 degrees, the arm bends out of its plane.
# The profile is reported as compiled and verified.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check bashar==2.0.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import contextlib
import importlib.metadata
import io
import math
import sys
from bashar.api import BasharSystem, compile_profile

folder = sys.argv[1]
camera = {
    "no camera": "",
    "camera at the base": '<link name="camera"/><joint name="mast" type="fixed"><parent link="base"/><child link="camera"/>'
                          '<origin xyz="0 0 2"/></joint>',
    "camera at the upper link": '<link name="camera"/><joint name="mast" type="fixed"><parent link="upper"/><child link="camera"/>'
                                f'<origin rpy="{math.pi / 2} 0 0"/></joint>',
}
robot = """<robot name="arm">
  <link name="base"/><link name="upper"/><link name="lower"/><link name="tip"/>CAMERA
  <joint name="shoulder" type="continuous">
    <parent link="base"/><child link="upper"/><origin xyz="0 0 1"/><axis xyz="0 1 0"/>
  </joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/><origin xyz="1 0 0"/><axis xyz="0 1 0"/></joint>
  <joint name="end" type="fixed"><parent link="lower"/><child link="tip"/><origin xyz="1 0 0"/></joint>
</robot>"""
shoulder, elbow = 0.5, 0.3
true = [math.cos(shoulder) + math.cos(shoulder + elbow), 0, 1 - math.sin(shoulder) - math.sin(shoulder + elbow)]
right = True
for name, expected in (("no camera", true), ("camera at the base", [true[0], true[1], true[2] + 2]), ("camera at the upper link", None)):
    with open(f"{folder}/arm.urdf", "w") as file:
        file.write(robot.replace("CAMERA", camera[name]))
    with contextlib.redirect_stdout(io.StringIO()):
        compiled = compile_profile(f"{folder}/arm.urdf", "arm", folder)
        system = BasharSystem(f"{folder}/arm.json")
    system.update_state([shoulder, elbow])
    tip = system.get_tip_position()
    print(f"{name}: compiled {compiled}; tip at", *(f"{value:.4f}" for value in tip))
    right &= compiled and (max(abs(a - b) for a, b in zip(tip, expected)) < 1e-9 if expected else abs(tip[1]) > 0.1)
print("by hand, for all three:", *(f"{value:.4f}" for value in true))
print("bashar", importlib.metadata.version("bashar"))
sys.exit(not right)
PYTHON
cd "$folder" && "$folder/venv/bin/python" "$folder/try.py" "$folder"
