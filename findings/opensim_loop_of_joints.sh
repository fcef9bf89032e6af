#!/usr/bin/env bash
# opensim 4.6: a loop that is closed by a joint is never assembled; closed by a constraint it is.
#
# OpenSim takes joints that close loops: it splits a body in two and welds the halves. Its assembly runs only for a model that has
# elements in its constraint set. A four-bar whose fourth pin is a PinJoint comes out of initSystem with its angles as drawn and one pin
# open by 3; assemble() leaves it so, and setting the crank opens it further. No exception, and not a word in the log at any level. With a
# PointConstraint in the place of the fourth pin the same bars are closed to 1e-9. Both have the multipliers that the dynamics need.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check opensim==4.6 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import opensim

opensim.Logger.setLevelString("Debug")


def four_bar(by_joint):
    """Bars of 1, 3 and 2 between pins 3 apart, drawn open."""
    model = opensim.Model()
    ground = last = model.getGround()
    at, none = opensim.Vec3(0), opensim.Vec3(0)
    for number, length in enumerate((1, 3, 2)):
        bar = opensim.Body(f"bar{number}", 1, none, opensim.Inertia(1, 1, 1, 0, 0, 0))
        model.addBody(bar)
        pin = opensim.PinJoint(f"pin{number}", last, at, none, bar, none, none)
        pin.updCoordinate().setName(f"angle{number}")
        pin.updCoordinate().setDefaultValue(0.3 if number else 0.0)
        model.addJoint(pin)
        last, at = bar, opensim.Vec3(length, 0, 0)
    if by_joint:
        model.addJoint(opensim.PinJoint("pin3", last, at, none, ground, opensim.Vec3(3, 0, 0), none))
    else:
        model.addConstraint(opensim.PointConstraint(ground, opensim.Vec3(3, 0, 0), last, at))
    model.finalizeConnections()
    return model, model.initSystem()


def gap(model, state):
    """The widest gap at any pin, the constraint among them."""
    model.realizePosition(state)
    ends = [(joint.getParentFrame().getPositionInGround(state).to_numpy(), joint.getChildFrame().getPositionInGround(state).to_numpy())
            for joint in model.getJointSet()]
    tip = model.getBodySet().get("bar2").findStationLocationInGround(state, opensim.Vec3(2, 0, 0)).to_numpy()
    return max(math.dist(*pair) for pair in [*ends, (tip, (3, 0, 0))])


right = True
for by_joint, expected in ((True, (3.0, 3.0, 3.7479)), (False, (0.0, 0.0, 0.0))):
    model, state = four_bar(by_joint)
    gaps = [gap(model, state)]
    model.assemble(state)
    gaps.append(gap(model, state))
    model.getCoordinateSet().get("angle0").setValue(state, 1.0)
    gaps.append(gap(model, state))
    print("fourth pin by a", "joint:" if by_joint else "constraint:", state.getNMultipliers(), "multipliers; open by",
          *(f"{value:.4f}" for value in gaps), "(initSystem, assemble, crank set to 1)")
    right &= all(abs(seen - wanted) < 1e-3 for seen, wanted in zip(gaps, expected)) and state.getNMultipliers() > 0
print("opensim", importlib.metadata.version("opensim"))
sys.exit(not right)
PYTHON
cd "$folder" && "$folder/venv/bin/python" "$folder/try.py"
