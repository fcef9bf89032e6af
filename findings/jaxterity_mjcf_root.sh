#!/usr/bin/env bash
# jaxterity 1.2.0: a pendulum of an MJCF file is rigid: joints of bodies that stand in the world are not read, nor is where these bodies are.
#
# from_mjcf lets MuJoCo compile the file and walks its bodies; one whose parent is the world becomes the root, and the walk goes on to the next before
# the joints. Pendulums, carts and floating bases lose their freedom, without the MjcfWarning that the documentation promises for a free
# joint. Further in, a hinge with a pos turns about the origin of its body, a slide without a range is limited to 0 to 0 (and its own export then
# refused by MuJoCo), and equalities are gone. What is left reads and simulates well.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check jaxterity==1.2.0 mujoco==3.10.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
import warnings
import mujoco
from jaxterity.robot import from_mjcf

path = sys.argv[1] + "/model.xml"
bar = '<geom type="capsule" size="0.05" fromto="0 0 0 1 0 0"/>'
cases = {
    "pendulum": f'<body name="bob" pos="0 0 2"><joint name="turn" axis="0 1 0"/>{bar}</body>',
    "cart and pole": f'<body name="cart"><joint name="ride" type="slide" axis="1 0 0"/>{bar}'
                     f'<body name="pole"><joint name="turn" axis="0 1 0" pos="0.5 0 0"/>{bar}</body></body>',
    "floating body with an arm": f'<body name="base"><freejoint/>{bar}<body name="arm"><joint name="turn" axis="0 1 0"/>{bar}</body></body>',
    "coupled hinges": f'<body name="base">{bar}<body name="a"><joint name="one"/>{bar}</body><body name="b"><joint name="two"/>{bar}</body></body>',
    "ram": f'<body name="base">{bar}<body name="rod"><joint name="push" type="slide" axis="1 0 0"/>{bar}</body></body>',
}
coupling = '<equality><joint joint1="one" joint2="two"/></equality>'
expected = {
    "pendulum": ([], 1, 0),
    "cart and pole": (["turn"], 2, 1),
    "floating body with an arm": (["turn"], 7, 1),
    "coupled hinges": (["one", "two"], 2, 2),
    "ram": (["push"], 1, None),
}
right = True
for name, body in cases.items():
    text = f"<mujoco><worldbody>{body}</worldbody>{coupling if name == 'coupled hinges' else ''}</mujoco>"
    with open(path, "w") as file:
        file.write(text)
    model = mujoco.MjModel.from_xml_path(path)
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        robot = from_mjcf(path)
    said = [str(warning.message) for warning in said if "MJCF" in str(warning.message)]
    try:
        again = mujoco.MjModel.from_xml_string(robot.to_mjcf())
        freedoms = again.nv
        rest = f"equalities {model.neq} and {again.neq}, hinges at {[list(map(float, each)) for each in again.jnt_pos]}, root at {again.body_pos[1].tolist()}"
        right &= again.neq == 0 and not again.jnt_pos.any() and not again.body_pos[1].any()
    except ValueError as error:
        freedoms, rest = None, "the exported file: " + str(error).splitlines()[0]
    joints = [joint.name for joint in robot.joints]
    print(f"{name}: joints read {joints}, freedoms in MuJoCo {model.nv}, of the export {freedoms}; warnings {said}; {rest}")
    right &= (joints, model.nv, freedoms) == expected[name] and not said
for package in ("jaxterity", "mujoco"):
    print(package, importlib.metadata.version(package))
sys.exit(not right)
PYTHON
JAX_PLATFORMS=cpu "$folder/venv/bin/python" -W ignore "$folder/try.py" "$folder"
