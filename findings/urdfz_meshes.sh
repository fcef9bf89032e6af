#!/usr/bin/env bash
# urdfz 0.2.1: in the archive that a URDF and its meshes are packed into, the mesh of one finger is that of the other.
#
# A .urdfz file holds a URDF and all its meshes, so that nothing else is needed. A mesh with a file:// URI is filed under the name of its last folder and
# its own name. Where parts are kept in folders of their own, as exporters of assemblies write them, those two are the same:
# left/meshes/finger.stl and right/meshes/finger.stl become one meshes/finger.stl, the second copied over the first, and both links
# name it. Nothing is said; the shape of the left finger is not in the archive.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m pip install --quiet --disable-pip-version-check --root-user-action ignore --target "$folder/packages" \
  --no-deps urdfz==0.2.1 resolve-robotics-uri-py==0.4.1
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import re
import sys
import zipfile
from pathlib import Path
from urdfz.pack import make_urdfz_file

folder = Path(sys.argv[1])
links = ""
for side in ("left", "right"):
    mesh = folder / side / "meshes" / "finger.stl"
    mesh.parent.mkdir(parents=True)
    mesh.write_text(f"solid {side}\nendsolid {side}\n")
    links += f'<link name="{side}"><visual><geometry><mesh filename="file://{mesh}"/></geometry></visual></link>'
    links += f'<joint name="{side}_weld" type="fixed"><parent link="base"/><child link="{side}"/></joint>'
urdf = folder / "gripper.urdf"
urdf.write_text(f'<robot name="gripper"><link name="base"/>{links}</robot>')
make_urdfz_file(urdf)
with zipfile.ZipFile(folder / "gripper.urdfz") as archive:
    names = sorted(name for name in archive.namelist() if name.endswith(".stl"))
    used = re.findall(r'filename="([^"]*)"', archive.read("gripper.urdf").decode())
    texts = [archive.read(name).decode().split()[1] for name in names]
print("meshes in the archive:", names, "holding", texts)
print("left and right name", used)
print("urdfz", importlib.metadata.version("urdfz"))
sys.exit(not (names == ["meshes/finger.stl"] and texts == ["right"] and used == ["urdfz://meshes/finger.stl"] * 2))
PYTHON
PYTHONPATH="$folder/packages" python3 "$folder/try.py" "$folder"
