#!/usr/bin/env bash
# robotblockset 1.3.1: the model that gen_kinmodel_mjcf writes from an MJCF file moves a body by the pos of its hinge, and turns euler the other way round.
#
# The program writes a Python function with the forward kinematics. A hinge's pos is where the body is hung up; the written function puts the body's
# origin there and leaves it, so that it stands elsewhere at rest and its turning does not move it. Of euler="30 40 50" it takes the
# turns about fixed axes where lower-case letters of eulerseq, the default, mean moving ones; zaxis, xyaxes and <default> count for nothing, which makes of a
# slide given by its class a hinge about z. Numbers have six decimals. With pos, euler and classes out of the way it agrees with MuJoCo.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check robotblockset==1.3.1 yourdfpy==0.0.60 mujoco==4.0.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import contextlib
import importlib.metadata
import importlib.util
import io
import sys
import mujoco
import numpy
from robotblockset.gen_models import gen_kinmodel_mjcf

folder = sys.argv[1]
geom = '<geom size="0.1"/>'
model = """<mujoco>
  <default><default class="rail"><joint type="slide" axis="1 0 0"/></default></default>
  <worldbody>
    <body name="arm" pos="0 0 1" FRAME>GEOM
      <joint name="turn" JOINT/>
      <body name="tip" pos="1 0 0">GEOM</body>
    </body>
  </worldbody>
</mujoco>""".replace("GEOM", geom)
cases = {
    "plain": ("", 'axis="0 1 0"'),
    "axisangle": ('axisangle="1 2 3 50"', 'axis="0 1 0"'),
    "hinge with a pos": ("", 'axis="0 1 0" pos="0.5 0 0"'),
    "euler": ('euler="30 40 50"', 'axis="0 1 0"'),
    "zaxis": ('zaxis="1 0 0"', 'axis="0 1 0"'),
    "slide by its class": ("", 'class="rail"'),
}
agree = {"plain", "axisangle"}
right = True
for number, (name, (frame, joint)) in enumerate(cases.items()):
    path = f"{folder}/model.xml"
    with open(path, "w") as file:
        file.write(model.replace("FRAME", frame).replace("JOINT", joint))
    with contextlib.redirect_stdout(io.StringIO()):
        gen_kinmodel_mjcf("robot", path, final_link="tip", filename=f"{folder}/written{number}.py")
    spec = importlib.util.spec_from_file_location(f"written{number}", f"{folder}/written{number}.py")
    written = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(written)
    compiled = mujoco.MjModel.from_xml_path(path)
    data = mujoco.MjData(compiled)
    for value in (0.0, 0.7):
        data.qpos[0] = value
        mujoco.mj_forward(compiled, data)
        here = written.kinmodel_robot(numpy.array([value]), out="pR")[0]
        there = data.body("tip").xpos
        print(f"{name}, at {value}: tip at", *(f"{each:.4f}" for each in here), "- in MuJoCo", *(f"{each:.4f}" for each in there))
        apart = float(numpy.abs(numpy.asarray(here, dtype=float) - there).max())
        # At 0 a class makes no difference yet.
        right &= apart < 1e-5 if name in agree or (name, value) == ("slide by its class", 0.0) else apart > 0.05
for package in ("robotblockset", "mujoco"):
    print(package, importlib.metadata.version(package))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" -W ignore "$folder/try.py" "$folder"
