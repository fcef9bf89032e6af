#!/usr/bin/env bash
# pyondsel 0.0.3 (OndselSolver, which solves FreeCAD's assemblies): screws, gears and racks are written, and end in "To be implemented."
#
# Its description lists 26 kinds of joints, "so the full OndselSolver constraint set is reachable from Python", with a table of the
# parameters of screw (pitch), gear (two radii) and rack_pinion (pitch_radius). A model with one of them is accepted, checked for these
# parameters and written as ASMT; the solver then ends in a SolveError, "OndselSolver failed: To be implemented.", driven or at rest. The same holds
# for angle, at_point, in_line, in_plane and compound. A file of ASMT with a gear is therefore no sign that it was ever solved.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pyondsel==0.0.3
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
from pyondsel.errors import SolveError
from pyondsel.model.asmt_model import AsmtModel
from pyondsel.model.joint import Joint
from pyondsel.model.marker import Marker
from pyondsel.model.motion import Motion
from pyondsel.model.part import Part
from pyondsel.model.simulation import Simulation


def solve(kind, driven, **parameters):
    """A driven wheel on a pivot, and a second part that is joined to the ground by the kind that is tried."""
    model = AsmtModel(name="Rig")
    for name in ("pivot", "other"):
        model.add_ground_marker(Marker(name))
    for name in ("wheel", "part"):
        model.add_part(Part(name)).add_marker(Marker("hub"))
    model.add_joint(Joint("turn", "revolute", model.ground_path("pivot"), model.part_path("wheel", "hub")))
    model.add_joint(Joint("tried", kind, model.ground_path("other"), model.part_path("part", "hub"), **parameters))
    if driven:
        model.add_motion(Motion("drive", joint="turn", expression="0.5*time", kind="rotational"))
    model.simulation = Simulation(t_start=0.0, t_end=1.0, frames=3)
    try:
        model.solve()
        return "solved"
    except SolveError as error:
        return str(error)


implemented = ("fixed", "revolute", "cylindrical", "translational", "spherical", "universal", "planar", "point_in_line",
               "point_in_plane", "line_in_plane", "no_rotation", "parallel_axes")
others = {
    "screw": {"pitch": 0.5}, "gear": {"radius_i": 1.0, "radius_j": 2.0}, "rack_pinion": {"pitch_radius": 1.0},
    "angle": {"angle": 0.5}, "in_plane": {"offset": 0.0}, "compound": {"distance_ij": 1.0}, "in_line": {}, "at_point": {},
}
right = True
for kind in implemented:
    seen = [solve(kind, driven) for driven in (False, True)]
    print(f"{kind}: {seen}")
    right &= seen == ["solved", "solved"]
for kind, parameters in others.items():
    seen = [solve(kind, driven, **parameters) for driven in (False, True)]
    print(f"{kind}: {seen}")
    right &= all("To be implemented" in text for text in seen)
try:
    solve("screw", False)
    checked = False
except ValueError as error:
    checked = True
    print("screw without its parameter:", error)
print("pyondsel", importlib.metadata.version("pyondsel"))
sys.exit(not (right and checked))
PYTHON
"$folder/venv/bin/python" "$folder/try.py"
