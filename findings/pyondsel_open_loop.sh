#!/usr/bin/env bash
# pyondsel 0.0.3 (OndselSolver, which solves FreeCAD's assemblies): loops that cannot close are returned as solved, left open.
#
# Its documentation has SolveError for when the "solver could not solve". Equations that are found redundant are left out, and whether
# they hold is not asked again. A bar of 1.2 between two pins that are 1.0 apart comes back hung 0.2 beside the first pin; two
# bars of 1 between pins 3 apart come back as drawn, with a gap; a four-bar whose one ground axis is tilted by 0.1 rad comes
# back with a crank that turns about another axis than its bearing. No error, and nothing in the result tells
# it from a loop that does close. Two bars of 2 between the same pins are closed to 1e-6.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pyondsel==0.0.3 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import numpy
from pyondsel.asmt_solver import rotation_matrix
from pyondsel.model.asmt_model import AsmtModel
from pyondsel.model.joint import Joint
from pyondsel.model.marker import Marker
from pyondsel.model.part import Part
from pyondsel.model.simulation import Simulation


def turned(angle):
    return ((math.cos(angle), -math.sin(angle), 0), (math.sin(angle), math.cos(angle), 0), (0, 0, 1))


def tilted(angle):
    return ((1, 0, 0), (0, math.cos(angle), -math.sin(angle)), (0, math.sin(angle), math.cos(angle)))


def solve(kind, base, bars, tilt=0.0):
    """Bars end to end between two pins of the ground: the gap at every joint and the angle between its axes, as returned."""
    model = AsmtModel(name="Rig")
    pins = {"left": ((0.0, 0.0, 0.0), turned(0)), "right": ((base, 0.0, 0.0), tilted(tilt))}
    for name, (place, frame) in pins.items():
        model.add_ground_marker(Marker(name, position=place, rotation=frame))
    place, ends = numpy.zeros(2), [("ground", "left")]
    for number, (length, angle) in enumerate(bars):
        part = model.add_part(Part(f"bar{number}", position=(float(place[0]), float(place[1]), 0.0), rotation=turned(angle)))
        part.add_marker(Marker("start"))
        part.add_marker(Marker("end", position=(length, 0.0, 0.0)))
        ends += [(number, "start"), (number, "end")]
        place = place + length * numpy.array([math.cos(angle), math.sin(angle)])
    ends.append(("ground", "right"))
    pairs = list(zip(ends[::2], ends[1::2]))

    def path(owner, name):
        return model.ground_path(name) if owner == "ground" else model.part_path(f"bar{owner}", name)

    for number, (one, other) in enumerate(pairs):
        model.add_joint(Joint(f"joint{number}", kind, path(*one), path(*other)))
    model.simulation = Simulation(t_start=0.0, t_end=1.0, frames=2)
    parts = model.solve().parts

    def seen(owner, name):
        if owner == "ground":
            return numpy.array(pins[name][0]), numpy.array(pins[name][1])[:, 2]
        part = parts[f"/Rig/bar{owner}"]
        frame = numpy.array(rotation_matrix(part.bryant_angles[-1]))
        return numpy.array(part.positions[-1]) + frame @ [bars[owner][0] if name == "end" else 0, 0, 0], frame[:, 2]

    gaps = [numpy.linalg.norm(seen(*one)[0] - seen(*other)[0]) for one, other in pairs]
    axes = [numpy.linalg.norm(numpy.cross(seen(*one)[1], seen(*other)[1])) for one, other in pairs]
    return max(gaps), math.asin(min(1.0, max(axes)))


height = (math.cos(1.2), math.sin(1.2)), (3 + 1.5 * math.cos(1.3), 1.5 * math.sin(1.3))
coupler = (math.dist(*height), math.atan2(height[1][1] - height[0][1], height[1][0] - height[0][0]))
four_bar = [(1.0, 1.2), coupler, (1.5, 1.3 + math.pi)]
seen = {
    "two bars of 2, pins 3 apart (closes)": solve("revolute", 3.0, [(2.0, 0.5), (2.0, -0.4)]),
    "bar of 1.2, pins 1 apart": solve("spherical", 1.0, [(1.2, 0.0)]),
    "two bars of 1, pins 3 apart": solve("revolute", 3.0, [(1.0, 0.5), (1.0, -0.4)]),
    "four-bar, axes parallel (closes)": solve("revolute", 3.0, four_bar),
    "four-bar, one axis tilted by 0.1": solve("revolute", 3.0, four_bar, tilt=0.1),
}
for name, (gap, angle) in seen.items():
    print(f"{name}: solved; largest gap at a joint {gap:.4f}, largest angle between the axes of a joint {angle:.4f}")
print("version:", importlib.metadata.version("pyondsel"))
closes, bar, dyad, parallel, skew = seen.values()
sys.exit(not (max(*closes, *parallel) < 1e-5 and abs(bar[0] - 0.2) < 1e-6 and dyad[0] > 1 and skew[1] > 0.09))
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
