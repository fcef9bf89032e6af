#!/usr/bin/env bash
# urdf-validator 1.6.0: gravity torques are taken about axes in the parent's frame; a hinge whose <origin> has an rpy gets a wrong one.
#
# In URDF the axis is given in the joint's frame, which rpy turns against the parent. The tool reports the torque that gravity asks of each
# joint and passes or fails the motor by it. An arm of 2 kg at 1 m on a horizontal hinge that is written as axis 0 0 1 behind
# rpy="-pi/2 0 0" asks for 0 N m, "torque negligible", and PASS with exit code 0, for a motor of 5 N m. The same hinge written as axis 0 1 0
# without rpy asks for 19.62 and fails. Exports from CAD often have their axes along z behind an rpy.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check urdf-validator==1.6.0 pin==4.1.0 numpy==2.4.6
cat > "$folder/arm.urdf" <<'URDF'
<robot name="arm">
  <link name="base">
    <inertial>
      <origin xyz="0 0 0"/>
      <mass value="9"/>
      <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>
    </inertial>
  </link>
  <link name="arm">
    <inertial>
      <origin xyz="1 0 0"/>
      <mass value="2"/>
      <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>
    </inertial>
  </link>
  <joint name="hinge" type="revolute">
    <parent link="base"/>
    <child link="arm"/>
    <origin xyz="0 0 0" rpy="RPY"/>
    <axis xyz="AXIS"/>
    <limit lower="-1" upper="1" effort="5" velocity="1"/>
  </joint>
</robot>
URDF
cat > "$folder/try.py" <<'PYTHON'
import json
import subprocess
import sys
import pinocchio

folder = sys.argv[1]
text = open(folder + "/arm.urdf").read()


def examine(name, rpy, axis):
    path = f"{folder}/{name}.urdf"
    open(path, "w").write(text.replace("RPY", rpy).replace("AXIS", axis))
    run = subprocess.run([folder + "/venv/bin/urdf_validate", path], capture_output=True, text=True)
    report = json.load(open(f"{folder}/{name}_validation.json"))
    asked = report["statics"]["joints"][0]["required_torque_gravity"]
    model = pinocchio.buildModelFromUrdf(path)
    right = abs(pinocchio.computeGeneralizedGravity(model, model.createData(), pinocchio.neutral(model))[0])
    print(f"rpy {rpy}, axis {axis}: asked {asked:.2f} N m, exit code {run.returncode}; Pinocchio {right:.2f} N m")
    return asked, run.returncode, right


plain = examine("plain", "0 0 0", "0 1 0")
turned = examine("turned", "-1.5707963267948966 0 0", "0 0 1")
same = abs(plain[2] - 19.62) < 1e-6 and abs(turned[2] - 19.62) < 1e-6
sys.exit(not (same and abs(plain[0] - 19.62) < 1e-6 and plain[1] == 2 and turned[0] < 1e-6 and turned[1] == 0))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
