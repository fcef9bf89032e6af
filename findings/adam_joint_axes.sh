#!/usr/bin/env bash
# adam-robotics 0.5.0: a slide raises in the NumPy interface, a diagonal hinge deforms what hangs on it, a left-out <axis> raises.
#
# One interface for NumPy, CasADi, JAX and PyTorch, from one URDF. A chain with a prismatic joint loads, and
# adam.numpy's forward_kinematics ends in a ValueError about array dimensions, at any value of the joint; adam.casadi gives the right
# pose for the same file. The axis of a hinge is used at the length that the file writes: <axis xyz="1 2 3"/> at 0.5 rad
# gives a "rotation" of determinant 3.73 in both interfaces, without a word. A joint without <axis>, which is axis x in URDF, raises
# TypeError.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check "adam-robotics[casadi]==0.5.0" casadi==3.8.2 numpy==2.4.6
cat > "$folder/arm.urdf" <<'URDF'
<robot name="arm">
  <link name="base">
    <inertial><origin xyz="0 0 0"/><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <link name="arm">
    <inertial><origin xyz="0 0 0"/><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <joint name="joint" type="TYPE">
    <parent link="base"/>
    <child link="arm"/>
    <origin xyz="1 0 0"/>
    AXIS
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
</robot>
URDF
cat > "$folder/try.py" <<'PYTHON'
import sys
import adam.casadi
import adam.numpy
import numpy

text = open(sys.argv[1] + "/arm.urdf").read()


def place(kind, axis, package):
    path = f"{sys.argv[1]}/now.urdf"
    open(path, "w").write(text.replace("TYPE", kind).replace("AXIS", axis))
    try:
        model = package.KinDynComputations(path, ["joint"])
        if package is adam.numpy:
            pose = model.forward_kinematics("arm", numpy.eye(4), numpy.array([0.5]))
        else:
            pose = numpy.array(model.forward_kinematics_fun("arm")(numpy.eye(4), numpy.array([0.5])))
    except (ValueError, TypeError) as error:
        print(f"{package.__name__} {kind} {axis}: {type(error).__name__}: {error}")
        return type(error).__name__
    print(f"{package.__name__} {kind} {axis}: at {pose[:3, 3]}, determinant {numpy.linalg.det(pose[:3, :3]):.3f}")
    return pose


straight, skew = '<axis xyz="0 0 1"/>', '<axis xyz="1 2 3"/>'
sound = numpy.linalg.det(place("revolute", straight, adam.numpy)[:3, :3])
slide = place("prismatic", straight, adam.numpy)
other = place("prismatic", straight, adam.casadi)
skewed = [numpy.linalg.det(place("revolute", skew, package)[:3, :3]) for package in (adam.numpy, adam.casadi)]
bare = [place("revolute", "", package) for package in (adam.numpy, adam.casadi)]
right = abs(sound - 1) < 1e-9 and numpy.allclose(other[:3, 3], [1, 0, 0.5])
sys.exit(not (right and isinstance(slide, str) and slide == "ValueError" and min(skewed) > 3.7 and bare == ["TypeError"] * 2))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
