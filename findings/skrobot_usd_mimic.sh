#!/usr/bin/env bash
# scikit-robot 0.4.7, convert-urdf-to-usd: a <mimic> becomes a joint of its own whose motor holds it at 0, without a warning.
#
# Every joint gets a drive, at 0 or where --home puts it, within its gravity load. A follower with a <mimic> is written like any other: no
# coupling is in the stage, and its drive holds it at 0 with full stiffness. With --home driver=0.4 the driver is held at 0.4 (22.9
# degrees) and the follower, at -2 times the driver plus 0.1, not at -0.7 but at 0. Even at home 0 it should stand at 0.1. The one line that is
# printed names the file. A planar joint, which becomes a weld, is announced in a RuntimeWarning.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check scikit-robot==0.4.7 usd-core==26.11
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import subprocess
import sys
from pxr import Usd, UsdPhysics

folder = sys.argv[1]
MASS = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
LIMIT = '<limit lower="-3" upper="3" effort="1" velocity="1"/>'


def convert(second, rest, *options):
    """The drives of a stage made of a driver and a second joint, in degrees, whether it names a mimic, and what was printed."""
    path = folder + "/pair"
    links = "".join(f'<link name="{name}">{MASS}</link>' for name in ("base", "disc", "wheel"))
    joints = "".join(
        f'<joint name="{name}" type="{kind}"><parent link="base"/><child link="{child}"/><axis xyz="0 0 1"/>{more}</joint>'
        for name, kind, child, more in (("driver", "revolute", "disc", LIMIT), ("follower", second, "wheel", rest)))
    with open(path + ".urdf", "w") as file:
        file.write(f'<robot name="pair">{links}{joints}</robot>')
    done = subprocess.run([folder + "/venv/bin/convert-urdf-to-usd", path + ".urdf", "-o", path + ".usda", *options],
                          capture_output=True, text=True, check=True)
    stage = Usd.Stage.Open(path + ".usda")
    drives = {prim.GetName(): (round(drive.GetTargetPositionAttr().Get(), 4), drive.GetStiffnessAttr().Get())
              for prim in stage.Traverse() if (drive := UsdPhysics.DriveAPI(prim, "angular")).GetTargetPositionAttr()}
    return drives, "mimic" in open(path + ".usda").read().lower(), done.stdout + done.stderr


mimic = '<mimic joint="driver" multiplier="-2" offset="0.1"/>' + LIMIT
right = True
for name, options, expected in (("home 0", (), 0.0), ("home of the driver 0.4", ("--home", "driver=0.4"), math.degrees(0.4))):
    drives, named, said = convert("revolute", mimic, *options)
    by_file = math.degrees(-2 * math.radians(drives["driver"][0]) + 0.1)
    print(f"{name}: drives at {drives['driver'][0]} and {drives['follower'][0]} degrees, by the file the follower is at {by_file:.2f};",
          f"stiffness {drives['follower'][1]}; a mimic in the stage: {named}; warned: {'Warning' in said}")
    right &= math.isclose(drives["driver"][0], expected, abs_tol=1e-3) and drives["follower"][0] == 0 and drives["follower"][1] > 1
    right &= not named and "warning" not in said.lower()
said = convert("planar", "")[2]
print("planar joint:", next(line for line in said.splitlines() if "Warning" in line).split("Warning: ")[1])
print("scikit-robot", importlib.metadata.version("scikit-robot"))
sys.exit(not (right and "unsupported URDF type" in said))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
