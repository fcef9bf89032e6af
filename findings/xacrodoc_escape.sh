#!/usr/bin/env bash
# xacrodoc 2.0.1: text that xacro is told to leave alone is evaluated, and package:// of a texture is left as it is, where that of a mesh is resolved.
#
# In xacro $${1 + 1} is the text ${1 + 1}, for a program that reads the URDF and has formulas of its own. XacroDoc expands the result of xacro again until
# nothing changes any more: the text is 2, and $${gain}, whose property is gone by then, is an error. Of package:// URIs, which are turned into
# file:// ones unless one says resolve_packages=False, those are found that stand in a <mesh> or in an attribute of <material>. URDF has the texture in
# <texture filename> inside <material>: it is neither resolved, nor counted as an asset, nor copied with the others.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m pip install --quiet --disable-pip-version-check --root-user-action ignore --target "$folder/packages" \
  xacrodoc==2.0.1 xacro==2.1.1
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import re
import sys
import xacro
from xacrodoc import XacroDoc, packages

ROBOT = """<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="gain" value="5"/>
  <link name="base">
    <visual>
      <geometry><mesh filename="package://arm/base.stl"/></geometry>
      <material name="wood"><texture filename="package://arm/wood.png"/></material>
    </visual>
  </link>
  <gazebo><formula>TEXT</formula></gazebo>
</robot>"""


def formula(document):
    return re.search("<formula>(.*)</formula>", document.toxml()).group(1)


packages.update_package_cache({"arm": sys.argv[1]})
plain = xacro.parse(ROBOT.replace("TEXT", "$${1 + 1}"))
xacro.process_doc(plain)
document = XacroDoc.from_string(ROBOT.replace("TEXT", "$${1 + 1}"))
print("$${1 + 1} by xacro:", formula(plain), "- by xacrodoc:", formula(document.dom))
try:
    gone = formula(XacroDoc.from_string(ROBOT.replace("TEXT", "$${gain}")).dom)
except Exception as error:
    gone = type(error).__name__
    print("$${gain} by xacrodoc:", gone, str(error).splitlines()[0])
files = [name.replace(sys.argv[1], "FOLDER") for name in re.findall('filename="([^"]*)"', document.dom.toxml())]
print("files:", files, "- counted:", document.count_assets())
for name in ("xacrodoc", "xacro"):
    print(name, importlib.metadata.version(name))
sys.exit(not (
    formula(plain) == "${1 + 1}" and formula(document.dom) == "2" and gone == "XacroException"
    and files == ["file://FOLDER/base.stl", "package://arm/wood.png"] and document.count_assets() == 1))
PYTHON
PYTHONPATH="$folder/packages" python3 "$folder/try.py" "$folder"
