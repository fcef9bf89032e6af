#!/usr/bin/env bash
# brax 0.14.2: equalities and springref of an MJCF file are passed over in silence; a closed loop moves as two open chains.
#
# Brax reads MJCF through MuJoCo and refuses what its own pipelines cannot do (tendons, ref, condim 4) with a NotImplementedError. An
# <equality> is in neither group: connect, weld and joint are read, kept in no pipeline, and nothing is said. Two hinges that are
# coupled by 0.3 + 2 q, started off that line, stay where they are in the generalized, spring and positional pipelines, where MuJoCo brings
# them onto it. A spring with springref="30" rests at 0 in the generalized pipeline, and does nothing in the other two.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check brax==0.14.2 mujoco==4.0.0 mujoco-mjx==3.17.0 jax==0.10.2 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
import jax
import mujoco
import numpy
from brax.generalized import pipeline as generalized
from brax.io import mjcf
from brax.positional import pipeline as positional
from brax.spring import pipeline as spring

text = """
<mujoco model="pair">
  <option gravity="0 0 0" timestep="0.002"/>
  <worldbody>
    <body name="a">
      <geom size="0.1" contype="0" conaffinity="0"/>
      <joint name="first" axis="0 0 1" armature="1" damping="2" SPRING/>
    </body>
    <body name="b" pos="1 0 0">
      <geom size="0.1" contype="0" conaffinity="0"/>
      <joint name="second" axis="0 0 1" armature="1" damping="2"/>
    </body>
  </worldbody>
  <equality>EQUALITY</equality>
</mujoco>
"""


def ends(file):
    start = numpy.array([0.5, 0.0])
    model = mujoco.MjModel.from_xml_string(file)
    data = mujoco.MjData(model)
    data.qpos[:] = start
    for _ in range(1500):
        mujoco.mj_step(model, data)
    system = mjcf.loads(file)
    seen = [data.qpos.round(3)]
    for pipeline in (generalized, spring, positional):
        state = jax.jit(pipeline.init)(system, jax.numpy.array(start), jax.numpy.zeros(2))
        step = jax.jit(pipeline.step)
        for _ in range(1500):
            state = step(system, state, jax.numpy.zeros(0))
        seen.append(numpy.array(state.q).round(3) + 0.0)
    return numpy.array(seen)


names = ("MuJoCo", "generalized", "spring", "positional")
found = {}
for name, equality, more in (
    ("joint equality", '<joint joint1="second" joint2="first" polycoef="0.3 2 0 0 0"/>', ""),
    ("weld", '<weld body1="a" body2="b"/>', ""),
    ("springref of 30 degrees", "", 'springref="30" stiffness="10"'),
):
    found[name] = ends(text.replace("EQUALITY", equality).replace("SPRING", more))
    print(f"{name}, from 0.5 and 0:", {key: value.tolist() for key, value in zip(names, found[name])})
for package in ("brax", "mujoco", "jax"):
    print(package, importlib.metadata.version(package))
pair, weld, sprung = found.values()
right = abs(0.3 + 2 * pair[0][0] - pair[0][1]) < 1e-2 and abs(weld[0]).max() < 1e-2 and abs(sprung[0][0] - 0.524) < 1e-2
right &= numpy.allclose(pair[1:], [0.5, 0.0], atol=1e-3) and numpy.allclose(weld[1:], [0.5, 0.0], atol=1e-3)
right &= abs(sprung[1][0]) < 0.1 and numpy.allclose(sprung[2:], [0.5, 0.0], atol=1e-3)
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" 2> "$folder/said" || { cat "$folder/said"; exit 1; }
if grep -iE "equalit|springref|support" "$folder/said"; then exit 1; fi
