#!/usr/bin/env bash
# isaaclab-robot-doctor 0.1.0: a loop of a USD stage that is closed as its own hint advises is the same error, with the same hint.
#
# In UsdPhysics the joints of an articulation form a tree; one that closes a loop is marked with excludeFromArticulation. The tool reports
# a loop as an ERROR and advises to close it with a joint that has this attribute. It reads the attribute and does not use it here:
# a four-bar with the mark at the last hinge is the ERROR tree.kinematic_loop as without it, and the exit code is 1 both times, so that a
# mechanism with a loop cannot pass. The robot as a tree, with the last hinge switched off, has no such finding.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check isaaclab-robot-doctor==0.1.0 usd-core==26.11 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import json
import subprocess
import sys
from pxr import Gf, Usd, UsdGeom, UsdPhysics

folder = sys.argv[1]
places = {"base": (0, 0, 0), "crank": (0, 0, 0), "coupler": (0, 1, 0), "rocker": (3, 0, 0)}
hinges = {
    "hinge1": ("base", (0, 0, 0), "crank", (0, 0, 0)), "hinge2": ("crank", (0, 1, 0), "coupler", (0, 0, 0)),
    "hinge3": ("coupler", (3, 0, 0), "rocker", (0, 1, 0)), "hinge4": ("base", (3, 0, 0), "rocker", (0, 0, 0)),
}


def check(excluded, enabled):
    """The findings on a four-bar whose last hinge closes the loop, and the exit code."""
    path = folder + "/four_bar.usda"
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    root = UsdGeom.Xform.Define(stage, "/robot").GetPrim()
    stage.SetDefaultPrim(root)
    UsdPhysics.ArticulationRootAPI.Apply(root)
    for name, place in places.items():
        link = UsdGeom.Xform.Define(stage, f"/robot/{name}")
        link.AddTranslateOp().Set(Gf.Vec3d(*place))
        UsdPhysics.RigidBodyAPI.Apply(link.GetPrim())
        mass = UsdPhysics.MassAPI.Apply(link.GetPrim())
        mass.CreateMassAttr(1.0)
        mass.CreateDiagonalInertiaAttr(Gf.Vec3f(0.1))
    for name, (parent, at, child, there) in hinges.items():
        hinge = UsdPhysics.RevoluteJoint.Define(stage, f"/robot/{name}")
        hinge.CreateAxisAttr("Z")
        hinge.CreateBody0Rel().SetTargets([f"/robot/{parent}"])
        hinge.CreateBody1Rel().SetTargets([f"/robot/{child}"])
        hinge.CreateLocalPos0Attr(Gf.Vec3f(*at))
        hinge.CreateLocalPos1Attr(Gf.Vec3f(*there))
        if name == "hinge4":
            hinge.CreateExcludeFromArticulationAttr(excluded)
            hinge.CreateJointEnabledAttr(enabled)
    stage.GetRootLayer().Export(path)
    done = subprocess.run([folder + "/venv/bin/isaaclab-robot-doctor", "check", "--json", path], capture_output=True, text=True)
    found = json.loads(done.stdout)["findings"]
    return [one for one in found if one["id"] == "tree.kinematic_loop"], done.returncode


right = True
for name, excluded, enabled, expected in (
    ("the last hinge closes the loop", False, True, 1),
    ("excluded from the articulation", True, True, 1),
    ("switched off", False, False, 0),
):
    loops, code = check(excluded, enabled)
    print(f"{name}: loops {len(loops)}, exit code {code}", *(f"- {one['severity']}: {one['message']}; hint: {one['hint']}" for one in loops))
    right &= len(loops) == expected and all("excludeFromArticulation" in one["hint"] and one["severity"] == "ERROR" for one in loops)
    right &= code == expected
print("isaaclab-robot-doctor", importlib.metadata.version("isaaclab-robot-doctor"))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
