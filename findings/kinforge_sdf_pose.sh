#!/usr/bin/env bash
# kinforge 1.1.1: of one description it writes two robots; in the SDF all links lie on top of one another, on hinges that stand beside them.
#
# An <origin> of a URDF joint places the joint and its child in the parent. The <pose> of an SDF joint is given in the child, and places
# no link: links have a <pose> of their own. kinforge writes the same six numbers into both, and no <pose> for links. Read by Drake, an arm of two
# bars, 1 and 2 long, reaches 3 in the URDF; in the SDF its three links start at one place, and a quarter turn of the first joint swings
# the arm about a point 0.5 away. Both files are valid. A cylinder is moved by half its length in the
# SDF and not in the URDF, and the names in the SDF have the instance's name before them twice.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check kinforge==1.1.1 drake==1.51.1 numpy==2.4.6
cat > "$folder/arm.json" <<'JSON'
{
  "version": "0.1",
  "model": {
    "bodies": [
      {"name": "stand", "mass": 1.0},
      {"name": "upper", "mass": 1.0, "visual": {"type": "cylinder", "radius": 0.1, "length": 1.0}},
      {"name": "lower", "mass": 1.0}, {"name": "hand", "mass": 1.0}
    ],
    "joints": [
      {"name": "shoulder", "type": "revolute", "parent": "stand", "child": "upper", "axis": [0, 0, 1], "origin": {"xyz": [0.5, 0, 0]}},
      {"name": "elbow", "type": "revolute", "parent": "upper", "child": "lower", "axis": [0, 0, 1], "origin": {"xyz": [1, 0, 0]}},
      {"name": "wrist", "type": "fixed", "parent": "lower", "child": "hand", "origin": {"xyz": [2, 0, 0]}}
    ]
  },
  "assemblies": [
    {"name": "arm", "root": "stand", "bodies": ["stand", "upper", "lower", "hand"], "joints": ["shoulder", "elbow", "wrist"]}
  ],
  "instances": [{"name": "arm", "assembly": "arm"}]
}
JSON
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import logging
import math
import subprocess
import sys
import xml.etree.ElementTree as tree
import numpy
from pydrake.all import MultibodyPlant, Parser

logging.getLogger("drake").setLevel(logging.ERROR)
folder = sys.argv[1]
seen = {}
for kind, prefix in (("urdf", "arm/"), ("sdf", "arm/arm/")):
    path = f"{folder}/arm.{kind}"
    subprocess.run([f"{folder}/venv/bin/kinforge", "build", f"{folder}/arm.json", "--out", path], check=True, stdout=subprocess.DEVNULL)
    moved = tree.parse(path).getroot().find(".//visual/pose") is not None
    plant = MultibodyPlant(0.0)
    Parser(plant).AddModels(path)
    plant.WeldFrames(plant.world_frame(), plant.GetFrameByName(prefix + "stand"))
    plant.Finalize()
    context = plant.CreateDefaultContext()

    def places():
        return [plant.EvalBodyPoseInWorld(context, plant.GetBodyByName(prefix + name)).translation() for name in ("upper", "lower", "hand")]

    at_rest = places()
    plant.GetJointByName(prefix + "shoulder").set_angle(context, math.pi / 2)
    turned = places()
    print(f"{kind}: upper, lower and hand at rest at", *(numpy.round(place, 6).tolist() for place in at_rest))
    print(f"{kind}: after a quarter turn of the shoulder at", *(numpy.round(place, 6).tolist() for place in turned))
    print(f"{kind}: the cylinder is moved in its link: {moved}")
    seen[kind] = numpy.array(at_rest + turned), moved
urdf = numpy.array([(0.5, 0, 0), (1.5, 0, 0), (3.5, 0, 0), (0.5, 0, 0), (0.5, 1, 0), (0.5, 3, 0)])
sdf = numpy.array([(0, 0, 0)] * 3 + [(0.5, -0.5, 0)] * 3)
for package in ("kinforge", "drake"):
    print(package, importlib.metadata.version(package))
sys.exit(not (numpy.allclose(seen["urdf"][0], urdf) and numpy.allclose(seen["sdf"][0], sdf) and (seen["urdf"][1], seen["sdf"][1]) == (False, True)))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
