#!/usr/bin/env bash
# fieldpilot-urdf 1.31.0: the mobility of a closed loop is counted at a pose in which the loop is open; Bennett's linkage is rigid.
#
# loops.mobility gives "closed-loop degrees of freedom", the number of joints less the rank of the closure equations, "at a generic
# sample configuration if omitted, so it reflects the generic mobility rather than a singular pose". The sample is 0.1, 0.2, 0.3 ...
# for the joints in turn; it does not satisfy the closure and is not a pose of the mechanism. A planar four-bar has rank 3 there as
# well, so that the answer, 1, is right. Bennett's linkage has rank 4 where its ends are metres apart and 3 wherever it is
# closed: the function says 0, and 1 when it is handed a pose that closes. It moves with one freedom. (A minute of algebra.)
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check fieldpilot-urdf==1.31.0 sympy==1.14.0 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import numpy
from fieldpilot_urdf import from_xml
from fieldpilot_urdf.dynamics import SymbolicDynamics
from fieldpilot_urdf.loops import lambdify_loop_residual, mobility
from fieldpilot_urdf.models import FrameRef, LoopClosure, Origin

INERTIAL = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'


def loop(bars, closed):
    """Four hinges about z, each bar a length along x and a twist about x; the gap and the mobility at two poses."""
    text = '<robot name="loop">' + "".join(f'<link name="l{i}">{INERTIAL}</link>' for i in range(5))
    for i, (length, twist) in enumerate([(0, 0), *bars[:-1]]):
        text += (f'<joint name="j{i}" type="continuous"><parent link="l{i}"/><child link="l{i + 1}"/>'
                 f'<origin xyz="{length} 0 0" rpy="{twist!r} 0 0"/><axis xyz="0 0 1"/></joint>')
    end = Origin(xyz=(bars[-1][0], 0, 0), rpy=(bars[-1][1], 0, 0))
    closure = LoopClosure(name="closure", kind="fixed", a=FrameRef(link="l0"), b=FrameRef(link="l4", origin=end))
    dynamics = SymbolicDynamics(from_xml(text + "</robot>").model_copy(update={"loops": [closure]}))
    gap = lambdify_loop_residual(dynamics, simplify=False)
    sample = [0.1, 0.2, 0.3, 0.4]
    return abs(gap(closed)).max(), mobility(dynamics, at=closed), abs(gap(sample)).max(), mobility(dynamics)


pi = math.pi
seen = {
    "planar parallelogram": loop([(1, 0), (2, 0), (1, 0), (2, 0)], [1.0, pi - 1.0, 1.0, pi - 1.0]),
    "Bennett's linkage": loop([(1, pi / 6), (2, pi / 2), (1, pi / 6), (2, pi / 2)], [pi / 2, 2 * pi / 3, 3 * pi / 2, 4 * pi / 3]),
}
for name, (gap, there, open_gap, answer) in seen.items():
    print(f"{name}: mobility {answer} where the ends are {open_gap:.2f} apart, {there} at a pose that closes to {gap:.0e}")
print("version:", importlib.metadata.version("fieldpilot-urdf"))
planar, bennett = seen.values()
sys.exit(not (max(planar[0], bennett[0]) < 1e-12 and min(planar[2], bennett[2]) > 0.1
              and (planar[1], planar[3]) == (1, 1) and (bennett[1], bennett[3]) == (1, 0)))
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
