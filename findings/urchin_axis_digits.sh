#!/usr/bin/env bash
# urchin 0.0.30: how many digits of a joint's axis are saved depends on how numpy prints arrays just then.
#
# Origins and limits are written with all their digits. The axis is written as numpy's printed form of it: eight decimals by default, so
# that an axis along (1, 2, 3) comes back off by 4e-9, where all the rest comes back exactly. After numpy.set_printoptions(precision=3),
# which a notebook sets for its own display, the saved axis is off by 4e-4, and with suppress=True an axis that leans by 0.00002
# is straight. Nothing is said; urchin normalises on reading, so that the axis still has the length 1.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check urchin==0.0.30 numpy==2.4.6
cat > "$folder/arm.urdf" <<'URDF'
<robot name="arm">
  <link name="base"/><link name="arm"/><link name="hand"/>
  <joint name="shoulder" type="continuous">
    <parent link="base"/><child link="arm"/><origin xyz="0.12345678901234 0 0"/><axis xyz="1 2 3"/>
  </joint>
  <joint name="wrist" type="continuous">
    <parent link="arm"/><child link="hand"/><origin xyz="1 0 0"/><axis xyz="0.00002 0 1"/>
  </joint>
</robot>
URDF
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
import numpy
import urchin

first, second = sys.argv[1] + "/arm.urdf", sys.argv[1] + "/saved.urdf"
given = urchin.URDF.load(first)
off = []
for options in ({}, {"precision": 3}, {"precision": 3, "suppress": True}):
    with numpy.printoptions(**options):
        given.save(second)
    read = urchin.URDF.load(second)
    shoulder, wrist = (abs(given.joint_map[name].axis - read.joint_map[name].axis).max() for name in ("shoulder", "wrist"))
    origin = abs(given.joint_map["shoulder"].origin - read.joint_map["shoulder"].origin).max()
    written = [line.strip() for line in open(second) if "<axis" in line]
    print(options, written, "axes off by", shoulder, wrist, "origin by", origin)
    off.append((shoulder, wrist, origin))
for package in ("urchin", "numpy"):
    print(package, importlib.metadata.version(package))
(plain, _, one), (short, _, two), (_, straight, three) = off
right = 1e-9 < plain < 1e-8 and 1e-4 < short < 1e-3 and abs(straight - 2e-5) < 1e-9 and max(one, two, three) == 0.0
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
