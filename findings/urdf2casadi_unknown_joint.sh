#!/usr/bin/env bash
# urdf2casadi 1.0.0: a planar or floating joint of a URDF is passed over together with its <origin>, and the tip moves nearer.
#
# A reader of serial chains that has no word for a joint may refuse it or hold it fixed, in the pose drawn. urdf2casadi does
# neither: in get_forward_kinematics the joint is no variable and the transform from parent to child is left out as well, so that
# all links behind it are displaced, by 1 m in this chain of three joints 1 m apart. No error and no warning. A chain with a
# "fixed" joint in that place is right, also a "continuous" one. Pinocchio has the tip at 3 m in every case. (Later versions ask
# for a casadi that Python 3.11 cannot install.)
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check urdf2casadi==1.0.0 casadi==3.8.2 pin==4.1.0 numpy==2.4.6
cat > "$folder/chain.urdf" <<'URDF'
<robot name="chain">
  <link name="base"/><link name="a"/><link name="b"/><link name="tip"/>
  <joint name="first" type="revolute">
    <parent link="base"/><child link="a"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
  <joint name="second" type="TYPE"><parent link="a"/><child link="b"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/></joint>
  <joint name="third" type="fixed"><parent link="b"/><child link="tip"/><origin xyz="1 0 0"/></joint>
</robot>
URDF
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
import warnings
import numpy
import pinocchio
from urdf2casadi import urdfparser

text = open(sys.argv[1] + "/chain.urdf").read()
right = True
with warnings.catch_warnings(record=True) as said:
    warnings.simplefilter("always", UserWarning)
    for name, expected in (("fixed", 3), ("continuous", 3), ("planar", 2), ("floating", 2)):
        path = f"{sys.argv[1]}/{name}.urdf"
        open(path, "w").write(text.replace("TYPE", name))
        parser = urdfparser.URDFparser()
        parser.from_file(path)
        chain = parser.get_forward_kinematics("base", "tip")
        joints = chain["joint_names"]
        seen = float(numpy.array(chain["T_fk"]([0.0] * len(joints)))[0, 3])
        model = pinocchio.buildModelFromUrdf(path)
        data = model.createData()
        pinocchio.framesForwardKinematics(model, data, pinocchio.neutral(model))
        theirs = float(data.oMf[model.getFrameId("tip")].translation[0])
        print(f"second joint {name}: variables {joints}, tip at {seen:g} m, in Pinocchio at {theirs:g} m")
        right &= abs(seen - expected) < 1e-9 and abs(theirs - 3) < 1e-9
print("warnings:", [str(line.message) for line in said if issubclass(line.category, UserWarning)])
for package in ("urdf2casadi", "pin"):
    print(package, importlib.metadata.version(package))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
