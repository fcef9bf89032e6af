#!/usr/bin/env bash
# opensim 4.6: the crank of a four-bar cannot be set; with a pendulum in the model that is connected to nothing of it, it can.
#
# Coordinate.setValue sets a coordinate and assembles the model anew, so that the others follow. A planar loop of three hinges that is
# closed by a PointConstraint has three equations (of which one, across the plane, always holds) for three angles: presumably the
# optimiser sees nothing left to choose. Whatever is asked of the crank, all angles stay as they were, and nothing is said. A fourth
# angle, of a pendulum beside the mechanism, makes them move, though not to the value asked for: 1 becomes -0.19. With the crank locked
# at 0.5, two angles and three equations are refused (the log: "Not enough degrees of freedom"), the tolerance is given up, the crank
# comes out at 0.42 and the loop is open by 0.06; with the pendulum the crank is at 0.5 and the loop closed.
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

opensim.Logger.setLevelString("Off")


def four_bar(pendulum, crank, locked):
    """Bars of 1, 3 and 2 between pins 3 apart, and a free pendulum if asked for; the model and its assembled state."""
    model = opensim.Model()
    last, at = model.getGround(), opensim.Vec3(0)
    for number, length in enumerate((1, 3, 2)):
        bar = opensim.Body(f"bar{number}", 1, opensim.Vec3(0), opensim.Inertia(1, 1, 1, 0, 0, 0))
        model.addBody(bar)
        pin = opensim.PinJoint(f"pin{number}", last, at, opensim.Vec3(0), bar, opensim.Vec3(0), opensim.Vec3(0))
        pin.updCoordinate().setName(f"angle{number}")
        pin.updCoordinate().setDefaultValue(0.3 if number else crank)
        pin.updCoordinate().setDefaultLocked(locked and not number)
        model.addJoint(pin)
        last, at = bar, opensim.Vec3(length, 0, 0)
    model.addConstraint(opensim.PointConstraint(model.getGround(), opensim.Vec3(3, 0, 0), last, at))
    if pendulum:
        bob = opensim.Body("bob", 1, opensim.Vec3(0), opensim.Inertia(1, 1, 1, 0, 0, 0))
        model.addBody(bob)
        model.addJoint(opensim.PinJoint("hook", model.getGround(), bob))
    model.finalizeConnections()
    return model, model.initSystem()


def look(model, state):
    end = model.getBodySet().get("bar2").findStationLocationInGround(state, opensim.Vec3(2, 0, 0)).to_numpy()
    return model.getCoordinateSet().get("angle0").getValue(state), math.dist(end, (3, 0, 0))


right = True
for pendulum, expected in ((False, -0.783), (True, -0.1889)):
    model, state = four_bar(pendulum, 0.0, False)
    before = look(model, state)
    model.getCoordinateSet().get("angle0").setValue(state, 1.0)
    after = look(model, state)
    print(f"pendulum {pendulum}: crank {before[0]:.4f}; set to 1: {after[0]:.4f}, loop open by {after[1]:.1e}")
    right &= abs(before[0] + 0.783) < 1e-3 and abs(after[0] - expected) < 1e-2 and after[1] < 1e-6
for pendulum, expected, gap in ((False, 0.4157, 0.062), (True, 0.5, 0.0)):
    seen = look(*four_bar(pendulum, 0.5, True))
    print(f"pendulum {pendulum}, crank locked at 0.5: crank {seen[0]:.4f}, loop open by {seen[1]:.4f}")
    right &= abs(seen[0] - expected) < 1e-2 and abs(seen[1] - gap) < 1e-2
print("opensim", importlib.metadata.version("opensim"))
sys.exit(not right)
PYTHON
cd "$folder" && "$folder/venv/bin/python" "$folder/try.py"
