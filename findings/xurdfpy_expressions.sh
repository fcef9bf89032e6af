#!/usr/bin/env bash
# xurdfpy 0.6.6: expressions of Xacro files have other values than in Python's xacro: -2**2 is 4, -7 % 3 is -1, round(2.5) is 3.
#
# An expression in a Xacro file is a Python expression. xurdfpy, a reader in Rust with bindings, computes it by itself: the sign binds closer
# than the power, the remainder has the sign of the first number, halves are rounded away from 0. ${-x**2 + 1} in a
# curve or a table of weights changes sign without a word. An escaped $${a}, which xacro writes as ${a}, becomes "a}". What it does not know
# (//, acos, asin, tan, log, exp) raises an error.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check xurdfpy==0.6.6 xacro==2.1.1
cat > "$folder/bar.xacro" <<'XACRO'
<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="bar">
  <xacro:property name="x" value="3"/>
  <link name="base"/><link name="bar"/>
  <joint name="weld" type="fixed">
    <parent link="base"/><child link="bar"/><origin xyz="EXPRESSION 0 0" rpy="0 0 0"/>
  </joint>
</robot>
XACRO
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import re
import sys
import xacro
import xurdfpy

text = open(sys.argv[1] + "/bar.xacro").read()
path = sys.argv[1] + "/one.xacro"


def place(file):
    return re.search(r'xyz="(.*?) 0 0"', file).group(1)


right = True
for expression, theirs, seen in (
    ("${2**3**2}", "512", "512"),
    ("${-2**2}", "-4", "4"),
    ("${-x**2 + 1}", "-8", "10"),
    ("${-7 % 3}", "2", "-1"),
    ("${7 % -3}", "-2", "1"),
    ("${round(2.5)}", "2", "3"),
    ("${not True}", "False", "0"),
    ("$${x}", "${x}", "x}"),
    ("${7//2}", "3", "error"),
    ("${acos(0.5)}", "1.0471975511965979", "error"),
):
    open(path, "w").write(text.replace("EXPRESSION", expression))
    one = place(xacro.process_file(path).toxml())
    try:
        two = place(xurdfpy.parse_xacro_file(path))
    except Exception:
        two = "error"
    print(f"{expression}: xacro {one}, xurdfpy {two}")
    right &= (one, two) == (theirs, seen)
for package in ("xurdfpy", "xacro"):
    print(package, importlib.metadata.version(package))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
