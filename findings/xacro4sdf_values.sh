#!/usr/bin/env bash
# xacro4sdf 2.1.0: a property made of another stays a formula in the SDF; leg 1 becomes leg_1.0, version 1.10 becomes 1.1, a missing parameter nothing.
#
# "Similar, but different from ros/xacro", for SDF. The text of a property is put in its place and not looked at again: with twice defined as
# ${2*length}, <pose>0 0 ${twice} ...</pose> comes out as 0 0 ${2*length}. What can be read as a number becomes a float before it is
# used: a macro for leg 1 writes the link leg_1.0, which nothing outside the macro finds, 3 becomes 3.0, which is no integer in SDF, and 1.10 is
# another version than 1.1. A parameter that a call leaves out is empty: a <pose> of five numbers. In ros/xacro
# the first is evaluated, whole numbers stay whole, and the last is an error. Here the exit code is 0, and nothing is said.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check xacro4sdf==2.1.0 xacro==2.1.1
cat > "$folder/robot.sdf.xmacro" <<'XML'
<?xml version="1.0"?>
<sdf version="1.7">
  <xacro_define_property name="length" value="0.3"/>
  <xacro_define_property name="twice" value="${2*length}"/>
  <xacro_define_property name="steps" value="3"/>
  <xacro_define_property name="release" value="1.10"/>
  <xacro_define_macro name="leg" params="side x">
    <link name="leg_${side}"><pose>${x} 0 0 0 0 0</pose></link>
  </xacro_define_macro>
  <model name="robot">
    <link name="trunk"><pose>0 0 ${twice} 0 0 0</pose></link>
    <xacro_macro name="leg" side="1" x="${length/2}"/>
    <xacro_macro name="leg" side="2"/>
    <plugin name="gait" filename="gait"><steps>${steps}</steps><release>${release}</release></plugin>
  </model>
</sdf>
XML
cat > "$folder/robot.xacro" <<'XML'
<?xml version="1.0"?>
<robot name="robot" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="length" value="0.3"/>
  <xacro:property name="twice" value="${2*length}"/>
  <xacro:property name="steps" value="3"/>
  <xacro:macro name="leg" params="side"><link name="leg_${side}"/></xacro:macro>
  <trunk z="${twice}" steps="${steps}"/>
  <xacro:leg side="1"/>
</robot>
XML
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import subprocess
import sys
import xml.etree.ElementTree as tree

folder = sys.argv[1]
made = subprocess.run([f"{folder}/venv/bin/xacro4sdf", f"{folder}/robot.sdf.xmacro"], capture_output=True, text=True)
root = tree.parse(f"{folder}/robot.sdf").getroot()
links = {link.get("name"): link.findtext("pose").strip() for link in root.iter("link")}
others = root.findtext(".//steps"), root.findtext(".//release")
print("xacro4sdf", importlib.metadata.version("xacro4sdf"), "exit code", made.returncode, "words:", repr(made.stdout + made.stderr))
print("links and poses:", links)
print("steps and release:", *others)
again = subprocess.run([f"{folder}/venv/bin/xacro", f"{folder}/robot.xacro"], capture_output=True, text=True, check=True)
other = tree.fromstring(again.stdout)
known = other.find("trunk").attrib, other.find("link").get("name")
print("xacro", importlib.metadata.version("xacro"), *known)
sys.exit(not (made.returncode == 0 and made.stdout + made.stderr == "" and others == ("3.0", "1.1")
              and links == {"trunk": "0 0 ${2*length} 0 0 0", "leg_1.0": "0.15 0 0 0 0 0", "leg_2.0": "0 0 0 0 0"}
              and known == ({"z": "0.6", "steps": "3"}, "leg_1")))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
