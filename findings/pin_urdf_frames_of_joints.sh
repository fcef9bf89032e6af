#!/usr/bin/env bash
# pin 4.1.0: a frame by the name of a URDF joint moves with the joint's child and is where the child's own frame is.
#
# Gepetto's descriptions of parallel robots (YAML beside a URDF) close loops between frames that are called by the names of links or of joints, fixed ones
# included. In pinocchio a joint of the URDF gives a frame of its own name. It is the frame of the link that the joint moves, not that of its parent, at
# every pose: so the two names mean one place.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pin==4.1.0 numpy==2.4.6
cat > "$folder/arm.urdf" <<'URDF'
<robot name="arm">
  <link name="base"/><link name="upper"/><link name="tip"/>
  <joint name="shoulder" type="continuous">
    <parent link="base"/><child link="upper"/><origin xyz="1 2 3" rpy="0.1 0.2 0.3"/><axis xyz="0 0 1"/>
  </joint>
  <joint name="end" type="fixed"><parent link="upper"/><child link="tip"/><origin xyz="0.5 0 0" rpy="0 0 1"/></joint>
</robot>
URDF
cat > "$folder/try.py" <<'PYTHON'
import sys
import numpy
import pinocchio

model = pinocchio.buildModelFromUrdf(sys.argv[1] + "/arm.urdf")
data = model.createData()
right = True
for value in [0.0, 0.7, -2.0]:
    # A joint without limits has a cosine and a sine as its configuration.
    q = numpy.array([numpy.cos(value), numpy.sin(value)])
    pinocchio.framesForwardKinematics(model, data, q)
    for joint, link in [("shoulder", "upper"), ("end", "tip")]:
        of_joint, of_link = (data.oMf[model.getFrameId(name)].homogeneous for name in (joint, link))
        apart = numpy.abs(of_joint - of_link).max()
        print(f"q = {value}: frames {joint} and {link} differ by {apart:.1e}")
        right &= bool(apart < 1e-12)
print("versions:", pinocchio.__version__)
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
