#!/usr/bin/env bash
# truerig 0.1.1: polynomial, switched-off and locking equalities of an MJCF file all become the same <mimic>, and the report says PASS.
#
# truerig names closed-chain couplings among what it preserves, "with a fidelity report of everything it changed". An MJCF joint
# equality is a polynomial of degree four in joint2; <mimic> is of degree one. The higher coefficients are dropped: a
# knee that turns by 0.1 + 2 q + 3 q^2 is written as 0.1 + 2 q. An equality with active="false", which MuJoCo does not
# enforce, comes out as a <mimic> that binds. One without joint2, which locks the joint, becomes a <mimic> of a joint that does
# not exist. The report has no error, no warning and no note.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check truerig==0.1.1 mujoco==3.11.0 numpy==2.4.6
cat > "$folder/leg.xml" <<'MJCF'
<mujoco model="leg">
  <worldbody>
    <body name="base">
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <body name="thigh">
        <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
        <joint name="hip" axis="0 0 1" range="-90 90"/>
        <body name="shank" pos="1 0 0">
          <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
          <joint name="knee" axis="0 0 1" range="-90 90"/>
        </body>
      </body>
    </body>
  </worldbody>
  <equality><joint joint1="knee" EQUALITY/></equality>
</mujoco>
MJCF
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import json
import subprocess
import sys
import xml.etree.ElementTree as tree
import mujoco

text = open(sys.argv[1] + "/leg.xml").read()
right = True
for number, (name, equality, active) in enumerate((
    ("linear", 'joint2="hip" polycoef="0.1 2 0 0 0"', 1),
    ("quadratic", 'joint2="hip" polycoef="0.1 2 3 0 0"', 1),
    ("switched off", 'joint2="hip" polycoef="0.1 2 0 0 0" active="false"', 0),
    ("locked", 'polycoef="0.1 2 0 0 0"', 1),
)):
    path, to = f"{sys.argv[1]}/leg_{number}.xml", f"{sys.argv[1]}/leg_{number}.urdf"
    open(path, "w").write(text.replace("EQUALITY", equality))
    model = mujoco.MjModel.from_xml_path(path)
    run = [sys.argv[1] + "/venv/bin/truerig", "convert", "--report", "json", path, to]
    report = json.loads(subprocess.run(run, capture_output=True, text=True, check=True).stdout)
    mimic = dict(tree.parse(to).find("joint[@name='knee']/mimic").attrib)
    print(f"{name}: polynomial {model.eq_data[0][:5]}, active {model.eq_active0[0]}")
    print(f"  written as {mimic}; verdict {report['verdict']}, {report['counts']}")
    right &= int(model.eq_active0[0]) == active and report["verdict"] == "pass"
    right &= (float(mimic["multiplier"]), float(mimic["offset"])) == (2.0, 0.1)
    right &= (mimic["joint"] == "hip") == (name != "locked")
print("version:", importlib.metadata.version("truerig"))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
