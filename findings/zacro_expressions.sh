#!/usr/bin/env bash
# zacro 1.0.13: 2 - 1 - 1 is 2 and 8/2/2 is 8; functions it does not know are written into the URDF as text.
#
# Zacro is "a fast Rust implementation of xacro". Differences and quotients of three terms
# are grouped from the right: 2 - (1 - 1). A length such as ${total - left - right} comes out too long by twice the last term,
# and nothing shows it. Functions that xacro takes from Python's math (atan2, acos, pow, hypot, degrees) are left standing: the
# origin reads xyz="atan2(1,2) 0 0", with exit code 0. sqrt, sin and radians are computed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check zacro==1.0.13 xacro==2.1.1
cat > "$folder/bar.xacro" <<'XACRO'
<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="bar">
  <xacro:property name="total" value="2"/>
  <xacro:property name="side" value="0.5"/>
  <link name="base"/><link name="bar"/>
  <joint name="weld" type="fixed">
    <parent link="base"/><child link="bar"/><origin xyz="${EXPRESSION} 0 0" rpy="0 0 0"/>
  </joint>
</robot>
XACRO
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import re
import subprocess
import sys
import xacro

folder = sys.argv[1]
text = open(folder + "/bar.xacro").read()


def place(file):
    return re.search(r'xyz="(.*?) 0 0"', file).group(1)


right = True
for expression, theirs, seen in (
    ("2-1-1", "0", "2"),
    ("8/2/2", "2.0", "8"),
    ("total - side - side", "1.0", "2"),
    ("total - (side + side)", "1.0", "1"),
    ("sqrt(2)", "1.4142135623730951", "1.4142135623730951"),
    ("atan2(1,2)", "0.4636476090008061", "atan2(1,2)"),
    ("acos(0.5)", "1.0471975511965979", "acos(0.5)"),
    ("pow(2,3)", "8.0", "pow(2,3)"),
):
    path = folder + "/one.xacro"
    open(path, "w").write(text.replace("EXPRESSION", expression))
    one = place(xacro.process_file(path).toxml())
    run = subprocess.run([folder + "/venv/bin/zacro", path], capture_output=True, text=True, check=True)
    two = place(run.stdout)
    print(f"{expression}: xacro {one}, zacro {two}")
    right &= (one, two) == (theirs, seen)
for package in ("zacro", "xacro"):
    print(package, importlib.metadata.version(package))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
