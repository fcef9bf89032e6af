#!/usr/bin/env bash
# pin 4.1.0: the travel of a slide in an MJCF file is divided by 57.3.
#
# In MuJoCo a joint's range is in degrees or radians, as compiler angle says, for
# hinges and balls; a slide's is a length whatever the compiler says. Pinocchio's MJCF reader converts the range of every
# joint from degrees where the file states its angles in degrees, which is MJCF's default: a slide of 0 to 0.5 m comes out with
# 0 to 0.0087 m. With angle="radian" both readers agree, so the fault shows in some files only.
# A planner or an inverse kinematics solver on that model finds next to no travel and does not say why.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pin==4.1.0 mujoco==4.0.0 numpy==2.4.6
cat > "$folder/lift.xml" <<'MJCF'
<mujoco model="lift">
  <compiler angle="ANGLE"/>
  <worldbody>
    <body name="platform">
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <joint name="lift" type="slide" axis="0 0 1" range="0 0.5"/>
    </body>
  </worldbody>
</mujoco>
MJCF
cat > "$folder/try.py" <<'PYTHON'
import sys
import mujoco
import pinocchio

text = open(sys.argv[1] + "/lift.xml").read()
seen = {}
for angle in ("degree", "radian"):
    path = f"{sys.argv[1]}/lift_{angle}.xml"
    open(path, "w").write(text.replace("ANGLE", angle))
    seen[angle] = (
        float(mujoco.MjModel.from_xml_path(path).joint("lift").range[1]),
        float(pinocchio.buildModelFromMJCF(path).upperPositionLimit[0]),
    )
    print(f'angle="{angle}": upper limit in MuJoCo {seen[angle][0]:.4f} m, in Pinocchio {seen[angle][1]:.4f} m')
same = abs(seen["radian"][0] - 0.5) < 1e-12 and abs(seen["radian"][1] - 0.5) < 1e-12
print("versions:", mujoco.__version__, pinocchio.__version__)
sys.exit(not (same and abs(seen["degree"][0] - 0.5) < 1e-12 and abs(seen["degree"][1] - 0.0087266) < 1e-6))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
