#!/usr/bin/env bash
# pin 4.1.0: the Jacobian of a constraint whose data are new is that of other points, without an error; pin 3.7.0 gave the right one.
#
# getConstraintJacobian(model, data, constraint, constraint.createData()) is what examples for Pinocchio 3 do. There the function works
# out where the constraint's frames are. In 4.1.0 it takes them from the constraint's data, where both are at the origin of the world
# until constraint.calc(model, data, constraint_data) was called, a method that 3.7.0 does not have. So every point constraint of a model holds the
# same point, the origin. An arm of two hinges whose tip is held cannot move, and keeps one velocity here.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat > "$folder/try.py" <<'PYTHON'
import sys
import numpy
import pinocchio

URDF = """<robot name="arm">
  <link name="base"/><link name="upper"/><link name="lower"/>
  <joint name="a" type="continuous"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/></joint>
  <joint name="b" type="continuous"><parent link="upper"/><child link="lower"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/></joint>
</robot>"""
model = pinocchio.buildModelFromXML(URDF)
data = model.createData()
pinocchio.computeJointJacobians(model, data, pinocchio.neutral(model))


def freedom(prepare):
    tip = pinocchio.SE3(numpy.eye(3), numpy.array([0.0, 1.0, 0.0]))
    place = pinocchio.SE3(numpy.eye(3), numpy.array([1.0, 1.0, 0.0]))
    held = pinocchio.RigidConstraintModel(
        pinocchio.ContactType.CONTACT_3D, model, model.getJointId("b"), tip, 0, place, pinocchio.ReferenceFrame.LOCAL
    )
    there = held.createData()
    prepare(held, there)
    rows = pinocchio.getConstraintJacobian(model, data, held, there)
    return int(model.nv - numpy.linalg.matrix_rank(rows))


fresh = freedom(lambda held, there: None)
has = hasattr(pinocchio.RigidConstraintModel, "calc")
prepared = freedom(lambda held, there: held.calc(model, data, there)) if has else None
print(f"pin {pinocchio.__version__}: freedom with new data {fresh}, after calc {prepared}")
expected = {"3.7.0": (0, None), "4.1.0": (1, 0)}
sys.exit((fresh, prepared) != expected[pinocchio.__version__])
PYTHON
# 3.7.0 asks for no version of what it is linked against: these are of its time.
for packages in "pin==4.1.0" "pin==3.7.0 cmeel-urdfdom==4.0.1 cmeel-console-bridge==1.0.2.3 cmeel-tinyxml2==10.0.0"; do
    rm -rf "$folder/venv"
    python3 -m venv "$folder/venv"
    # shellcheck disable=SC2086
    "$folder/venv/bin/pip" install --quiet --disable-pip-version-check $packages numpy==2.3.5
    "$folder/venv/bin/python" "$folder/try.py"
done
