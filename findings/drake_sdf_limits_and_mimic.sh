#!/usr/bin/env bash
# drake 1.51.1: limits of universal and screw joints and the <mimic> of an SDF file are dropped without the warning that others get.
#
# Drake's reader of SDF warns of what it passes over: the effort of a universal joint and unknown elements are named. Limits of the same
# joint's axes are not: an axis that may turn by 1 rad either way turns for ever, and so does a screw, where revolute and prismatic joints keep
# theirs. <mimic>, in SDFormat since 1.11, is passed over in silence, whereas <mimic> of a URDF becomes a coupler constraint, or a
# warning where the plant has no solver for it. In SDF Drake has an element of its own, <drake:mimic>, with attributes instead of children.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check drake==1.51.1 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import logging
import sys
from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import MultibodyPlant

said = []
handler = logging.Handler()
handler.emit = lambda record: said.append(record.getMessage().split("warning: ")[-1])
logger = logging.getLogger("drake")
logger.propagate = False
logger.handlers = [handler]


def axis(name, xyz, inside=""):
    limits = "<limit><lower>-1</lower><upper>1</upper><effort>0</effort></limit>"
    return f"<{name}><xyz>{xyz}</xyz>{limits}{inside}</{name}>"


def joint(name, kind, child, inside):
    return f'<joint name="{name}" type="{kind}"><parent>base</parent><child>{child}</child>{inside}</joint>'


def read(joints, kind="sdf"):
    links = "".join(f'<link name="{name}"><inertial><mass>1</mass></inertial></link>' for name in ("base", "one", "two"))
    file = f'<sdf version="1.11" xmlns:drake="http://drake.mit.edu"><model name="m">{links}{joints}</model></sdf>'
    said.clear()
    plant = MultibodyPlant(0.0)
    Parser(plant).AddModelsFromString(file if kind == "sdf" else joints, kind)
    plant.Finalize()
    return plant, list(said)


limits = {}
for kind, inside in (
    ("revolute", axis("axis", "0 0 1")),
    ("prismatic", axis("axis", "0 0 1")),
    ("universal", axis("axis", "0 0 1") + axis("axis2", "1 0 0")),
    ("screw", axis("axis", "0 0 1") + "<screw_thread_pitch>0.01</screw_thread_pitch>"),
):
    plant, heard = read(joint("first", kind, "one", inside))
    limits[kind] = plant.GetJointByName("first").position_upper_limits().tolist()
    print(f"{kind}: upper limits {limits[kind]}, said: {heard}")
    limits[kind].append(any("limit" in text for text in heard))
mimic = '<mimic joint="first"><multiplier>2</multiplier><offset>0</offset><reference>0</reference></mimic>'
own = '<drake:mimic joint="first" multiplier="2" offset="0"/>'
first = joint("first", "revolute", "one", axis("axis", "0 0 1"))
urdf = '<robot name="m"><link name="base"/><link name="one"/><link name="two"/>' + "".join(
    f'<joint name="{name}" type="continuous"><parent link="base"/><child link="{child}"/>{inside}</joint>'
    for name, child, inside in (("first", "one", ""), ("second", "two", '<mimic joint="first" multiplier="2"/>'))) + "</robot>"
couplings = {}
for name, file, kind in (
    ("<mimic> of SDF", first + joint("second", "revolute", "two", axis("axis", "0 0 1", mimic)), "sdf"),
    ("<drake:mimic> of SDF", first + joint("second", "revolute", "two", axis("axis", "0 0 1") + own), "sdf"),
    ("<mimic> of URDF", urdf, "urdf"),
):
    plant, heard = read(file, kind)
    couplings[name] = plant.num_constraints(), len(heard)
    print(f"{name}: constraints {plant.num_constraints()}, said: {heard}")
print("drake", importlib.metadata.version("drake"))
endless = float("inf")
right = limits["revolute"] == limits["prismatic"] == [1, False] and limits["screw"] == [endless, False]
right &= limits["universal"] == [endless, endless, False] and list(couplings.values()) == [(0, 0), (1, 0), (1, 0)]
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
