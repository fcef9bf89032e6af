#!/usr/bin/env bash
# idyntree 15.1.0: a URDF with a planar or floating joint is loaded with success, as a model without links.
#
# Both types are in the specification of URDF. iDynTree does not support them, which it prints; loadModelFromFile, whose result says
# whether all went well, is true nevertheless, isValid is true, and the model has no link and no freedom. A program that asks the
# result, as it should, goes on with an empty robot. A file that is not XML is refused with false, so the result does
# work otherwise.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check idyntree==15.1.0 numpy==2.4.6
cat > "$folder/table.urdf" <<'URDF'
<robot name="table">
  <link name="base">
    <inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <link name="table">
    <inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <joint name="move" type="TYPE">
    <parent link="base"/><child link="table"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
</robot>
URDF
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
import idyntree.swig as idyntree

text = open(sys.argv[1] + "/table.urdf").read()
seen = {}
for name in ("revolute", "planar", "floating", "no XML"):
    path = f"{sys.argv[1]}/{name.replace(' ', '_')}.urdf"
    open(path, "w").write("robot" if name == "no XML" else text.replace("TYPE", name))
    loader = idyntree.ModelLoader()
    loaded = loader.loadModelFromFile(path)
    seen[name] = loaded, loader.isValid(), loader.model().getNrOfLinks(), loader.model().getNrOfDOFs()
    print(f"{name}: loaded {seen[name][0]}, valid {seen[name][1]}, links {seen[name][2]}, freedoms {seen[name][3]}", flush=True)
print("version:", importlib.metadata.version("idyntree"))
empty = (True, True, 0, 0)
sys.exit(not (seen["revolute"] == (True, True, 2, 1) and seen["planar"] == empty and seen["floating"] == empty
              and not seen["no XML"][0]))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
