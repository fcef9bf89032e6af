#!/usr/bin/env bash
# xacro 2.1.1, xurdfpy 0.6.6: a property that is set again changes those that were computed from it before, if they were not used yet.
#
# xacro keeps the text of a property and evaluates it at its first use; then it keeps the value. With a = 1, b = ${2*a}, a = 5, the value of b is
# 10; where b was used once before a was set again, b is 2, there and afterwards. So a use of a property that has no effect on
# its own, a <xacro:if> for instance, changes what is written later. xurdfpy evaluates where the property stands: 2 both
# times. A property may refer to one that comes later in xacro; in xurdfpy that is an error.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check xurdfpy==0.6.6 xacro==2.1.1
cat > "$folder/bar.xacro" <<'XACRO'
<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="bar">
  PROPERTIES
  <link name="base"/><link name="bar"/>
  <joint name="weld" type="fixed">
    <parent link="base"/><child link="bar"/><origin xyz="${b} 0 0" rpy="0 0 0"/>
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


def line(name, value):
    return f'<xacro:property name="{name}" value="{value}"/>'


use = '<xacro:if value="${b == 0}"><link name="never"/></xacro:if>'
right = True
for name, properties, theirs, seen in (
    ("set once", line("a", 1) + line("b", "${2*a}"), "2", "2"),
    ("set again", line("a", 1) + line("b", "${2*a}") + line("a", 5), "10", "2"),
    ("used, set again", line("a", 1) + line("b", "${2*a}") + use + line("a", 5), "2", "2"),
    ("referred to before it is set", line("b", "${2*a}") + line("a", 5), "10", "error"),
):
    open(path, "w").write(text.replace("PROPERTIES", properties))
    one = place(xacro.process_file(path).toxml())
    try:
        two = place(xurdfpy.parse_xacro_file(path))
    except Exception:
        two = "error"
    print(f"{name}: b is {one} in xacro, {two} in xurdfpy")
    right &= (one, two) == (theirs, seen)
for package in ("xacro", "xurdfpy"):
    print(package, importlib.metadata.version(package))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
