#!/usr/bin/env bash
# robot-model-tools 0.3.0: a continuous joint, or a fixed one before another joint, is not read; a URDF written again is locked and lighter to turn.
#
# rmt reads URDF for its own model and exports it again. A file with a continuous joint ends in "NameError - name 'jname' is not defined",
# raised while the type is being reported as unknown; a fixed joint that carries a further joint ends in "KeyError". Of what is read, the
# exported URDF has limits of 0 to 0 for every joint (the tool says that they are arbitrary), no mimic, six decimals, and other
# moments of inertia: URDF gives them about the centre of mass, the tool subtracts mass times distance squared once more, so that a ball of
# 2 kg with 0.01 about its centre, 0.3 m out on an arm, is written with -0.17.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check robot-model-tools==0.3.0
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import subprocess
import sys
import xml.etree.ElementTree as xml

folder = sys.argv[1]
BALL = """<inertial><origin xyz="0.3 0 0"/><mass value="2"/>
  <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>"""
LIMIT = '<limit lower="-1" upper="0.5" effort="1" velocity="1"/>'


def joint(name, kind, parent, child, rest=""):
    return f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/><axis xyz="0 0 1"/>{rest}</joint>'


def export(*joints):
    path = folder + "/arm.urdf"
    with open(path, "w") as file:
        file.write(f'<robot name="arm"><link name="base"/><link name="bar">{BALL}</link><link name="hand"/>{"".join(joints)}</robot>')
    done = subprocess.run([folder + "/venv/bin/rmt", "exp", "-f", "urdf", path], capture_output=True, text=True)
    return done.stdout, done.stderr.strip().splitlines()[-1]


far = '<origin xyz="0.3333333333333333 0 0"/>'
hinge = joint("hinge", "revolute", "base", "bar", LIMIT)
written, said = export(hinge, joint("slide", "prismatic", "bar", "hand", LIMIT + far + '<mimic joint="hinge" multiplier="-2"/>'))
robot = xml.fromstring(written.strip())
inertia = robot.find("link[@name='bar']/inertial/inertia").attrib
slide = robot.find("joint[@name='slide']")
limits = [(one.get("lower"), one.get("upper")) for one in robot.findall("joint/limit")]
print("written: limits", limits, "- mimic", slide.find("mimic"), "- origin", slide.find("origin").get("xyz"), "-", said)
print("moments of inertia, 0.01 in the file:", [inertia[key] for key in ("ixx", "iyy", "izz")])
turning = export(joint("hinge", "continuous", "base", "bar"), joint("slide", "prismatic", "bar", "hand", LIMIT))
print("continuous joint:", turning[1])
carried = export(joint("weld", "fixed", "base", "bar"), joint("slide", "prismatic", "bar", "hand", LIMIT))
print("joint behind a fixed one:", carried[1])
print("robot-model-tools", importlib.metadata.version("robot-model-tools"))
sys.exit(not (
    limits == [("0", "0")] * 2 and slide.find("mimic") is None and slide.find("origin").get("xyz") == "0.333333 0.0 0.0"
    and [float(inertia[key]) for key in ("ixx", "iyy", "izz")] == [0.01, -0.17, -0.17]
    and "NameError" in turning[1] and "KeyError" in carried[1] and not turning[0].strip() and not carried[0].strip()))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
