#!/usr/bin/env bash
# urdf-usd-converter 0.3.4: stages of robots with a floating joint or a mimic of a mimic convert well, and newton 1.8.0 refuses them.
#
# Both belong to the Newton project, and the one writes what the other is to simulate. URDF's floating joint is left out of the stage,
# which means the same in UsdPhysics; but Newton's add_usd then ends in a ValueError that names the fixed joint of the root, "both
# bodies unresolved". A follower of a follower is written as NewtonMimicAPI of NewtonMimicAPI; add_usd raises "already a
# mimic joint". The converter ends with exit code 0 in both cases and warns of neither. A mimic by itself is read.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export WARP_CACHE_PATH="$folder/kernels"
python3 -m venv "$folder/venv"
python3 -m venv "$folder/reader"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check urdf-usd-converter==0.3.4 numpy==2.4.6
"$folder/reader/bin/pip" install --quiet --disable-pip-version-check \
  newton==1.8.0 newton-usd-schemas==0.6.0 usd-core==26.8 warp-lang==1.19.0 mujoco==3.17.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import glob
import subprocess
import sys
import newton
import warp

warp.config.quiet = True
folder = sys.argv[1]
inertia = '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
inertial = f'<inertial><origin xyz="0 0 0"/><mass value="1"/>{inertia}</inertial>'
turn = '<axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/>'


def convert(name, joints):
    links = ["base"] + [child for _, _, child, _ in joints]
    text = "".join(f'<link name="{link}">{inertial}</link>' for link in links)
    for number, (kind, parent, child, more) in enumerate(joints):
        text += f'<joint name="joint{number}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>{more}</joint>'
    open(f"{folder}/{name}.urdf", "w").write(f'<robot name="{name}">{text}</robot>')
    command = [folder + "/venv/bin/urdf_usd_converter", f"{folder}/{name}.urdf", f"{folder}/{name}"]
    run = subprocess.run(command, capture_output=True, text=True)
    told = [line for line in (run.stdout + run.stderr).splitlines() if "arning" in line or "rror" in line]
    try:
        newton.ModelBuilder().add_usd(glob.glob(f"{folder}/{name}/*.usda")[0])
        error = ""
    except ValueError as problem:
        error = str(problem)
    print(f"{name}: exit code {run.returncode}, warnings {told}; Newton: {error or 'read'}")
    return run.returncode, told, error


mimic = turn + '<mimic joint="joint{}"/>'
first = ("revolute", "base", "one", turn)
second = ("revolute", "base", "two", mimic.format(0))
third = ("revolute", "base", "three", mimic.format(1))
sound = convert("gears", [first, second])
chain = convert("train", [first, second, third])
loose = convert("satellite", [("floating", "base", "body", ""), ("revolute", "body", "arm", turn)])
quiet = all(code == 0 and not told for code, told, _ in (sound, chain, loose))
sys.exit(not (quiet and not sound[2] and "mimic joint" in chain[2] and "unresolved" in loose[2]))
PYTHON
"$folder/reader/bin/python" "$folder/try.py" "$folder"
