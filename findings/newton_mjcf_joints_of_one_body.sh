#!/usr/bin/env bash
# newton 1.8.0: several joints in one body of an MJCF file are put in another order, on another axis and at another place.
#
# MuJoCo applies the joints of a body in the order in which they are written, each with its own pos and axis. Newton makes one joint
# of them with slides first, then hinges, at the first one's pos. A hinge followed by a slide (an arm that turns and
# extends) becomes a slide that is followed by a hinge: the coordinates change places, and the slide does not turn with the arm. A second
# hinge with another pos turns about the first one's. Two hinges that are not at right angles change each other's axes: the first one
# alone, about z, lifts the tip. Hinges at right angles in one place agree to 1e-6, which is why usual models do not show it.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export WARP_CACHE_PATH="$folder/kernels"
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check newton==1.8.0 warp-lang==1.19.0 mujoco==4.0.0 numpy==2.4.6
cat > "$folder/arm.xml" <<'MJCF'
<mujoco model="arm">
  <worldbody>
    <body name="tip" pos="1 0 0">
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      JOINTS
    </body>
  </worldbody>
</mujoco>
MJCF
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
import mujoco
import newton
import numpy
import warp

warp.config.quiet = True
text = open(sys.argv[1] + "/arm.xml").read()


def place(path, q):
    model = mujoco.MjModel.from_xml_path(path)
    data = mujoco.MjData(model)
    data.qpos[:] = q
    mujoco.mj_kinematics(model, data)
    builder = newton.ModelBuilder()
    builder.add_mjcf(path)
    other = builder.finalize(device="cpu")
    state = other.state()
    speeds = warp.zeros(other.joint_dof_count, dtype=float, device="cpu")
    newton.eval_fk(other, warp.array(numpy.array(q), dtype=float, device="cpu"), speeds, state)
    return data.xpos[1].copy(), state.body_q.numpy()[0][:3].copy()


cases = {
    "two hinges across, in one place": (
        '<joint axis="0 0 1" pos="-1 0 0"/><joint axis="0 1 0" pos="-1 0 0"/>', (0.5, 0.4), None),
    "hinge, then slide": ('<joint axis="0 0 1" pos="-1 0 0"/><joint type="slide" axis="1 0 0"/>', (0.5, 0), (1.5, 0, 0)),
    "second hinge elsewhere": (
        '<joint axis="0 0 1" pos="-1 0 0"/><joint axis="0 1 0"/>', (0, 0.5), (numpy.cos(0.5), 0, -numpy.sin(0.5))),
    "two hinges at 45 degrees": (
        '<joint axis="0 0 1" pos="-1 0 0"/><joint axis="0 1 1" pos="-1 0 0"/>', (0.4, 0), (0.922, 0.356, 0.154)),
}
right = True
for number, (name, (joints, q, expected)) in enumerate(cases.items()):
    path = f"{sys.argv[1]}/arm_{number}.xml"
    open(path, "w").write(text.replace("JOINTS", joints))
    theirs, seen = place(path, q)
    print(f"{name}, at {q}: tip in MuJoCo {theirs.round(4)}, in Newton {seen.round(4)}")
    right &= numpy.allclose(seen, theirs if expected is None else expected, atol=1e-3)
    right &= expected is None or not numpy.allclose(seen, theirs, atol=0.05)
for package in ("newton", "warp-lang", "mujoco"):
    print(package, importlib.metadata.version(package))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder" | grep -v "^Module"
