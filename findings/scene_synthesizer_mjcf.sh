#!/usr/bin/env bash
# scene-synthesizer 1.15.0: euler="90 0 0" of an MJCF file turns a body by 90 radians; a hinge that is called a hinge is a KeyError.
#
# Of the orientations of MJCF, quat and axisangle are read as in MuJoCo; the angles of euler are taken for radians though the file is in degrees
# (ranges of hinges and axisangle are converted), and xyaxes and zaxis are passed over. The range of a slide is converted from degrees too: two metres
# of travel become 0.035. A hinge without limits may turn by 10 rad either way. A joint without a type is a hinge and is read as one; with
# type="hinge" written out the file is refused with KeyError: 'matrix'.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check scene-synthesizer==1.15.0 dm-control==1.0.50 mujoco==4.0.0 trimesh==5.2.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import mujoco
import numpy
import scene_synthesizer

path = sys.argv[1] + "/arm.xml"
text = """<mujoco>
  <worldbody>
    <body name="base">
      <geom type="box" size="0.1 0.1 0.1"/>
      <body name="arm" pos="0 0 1" ORIENTATION>
        <joint name="turn" TYPE axis="0 0 1"/>
        <geom type="box" size="0.1 0.1 0.1"/>
        <body name="ram" pos="0 1 0">
          <joint name="slide" type="slide" axis="1 0 0" range="0 2"/>
          <geom type="box" size="0.1 0.1 0.1"/>
        </body>
      </body>
    </body>
  </worldbody>
</mujoco>"""


def read(orientation, kind=""):
    """How the arm is turned, in scene-synthesizer and in MuJoCo, and the limits of the joints in the former."""
    with open(path, "w") as file:
        file.write(text.replace("ORIENTATION", orientation).replace("TYPE", kind))
    scene = scene_synthesizer.Asset(path).scene("robot")
    model = mujoco.MjModel.from_xml_path(path)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    joints = [edge["metadata"]["joint"] for edge in scene.scene.graph.transforms.edge_data.values() if edge.get("metadata")]
    limits = {joint["name"].split("/")[1]: (float(joint["limit_lower"]), float(joint["limit_upper"])) for joint in joints if "limit_upper" in joint}
    return scene.scene.graph.get("robot/arm")[0][:3, :3], data.body("arm").xmat.reshape(3, 3), limits


def angle(one, other):
    return math.degrees(math.acos(numpy.clip((numpy.trace(one.T @ other) - 1) / 2, -1, 1)))


right = True
for orientation, expected in (
    ('quat="1 1 0 0"', 0),
    ('axisangle="1 0 0 90"', 0),
    ('euler="90 0 0"', abs((math.degrees(90) - 90 + 180) % 360 - 180)),
    ('xyaxes="1 0 0 0 0 1"', 90),
    ('zaxis="0 -1 0"', 90),
):
    here, there, limits = read(orientation)
    apart = angle(here, there)
    print(f"{orientation}: {apart:.2f} degrees from MuJoCo")
    right &= abs(apart - expected) < 1e-4
print("limits:", limits, "- MuJoCo has 0 to 2 for the slide and none for the hinge")
right &= limits["turn"] == (-10, 10) and abs(limits["slide"][1] - math.radians(2)) < 1e-12
try:
    read("", 'type="hinge"')
    print("type=\"hinge\": read")
    right = False
except KeyError as error:
    print("type=\"hinge\": KeyError", error)
for package in ("scene-synthesizer", "mujoco"):
    print(package, importlib.metadata.version(package))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" -W ignore "$folder/try.py" "$folder"
