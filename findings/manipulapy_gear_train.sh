#!/usr/bin/env bash
# ManipulaPy 1.4.2: the third wheel of a gear train stands at one angle in link_fk and at another in link_fk_batch; neither is right.
#
# In a URDF a gear train is written as each wheel with a <mimic> of the one before. For a driver at 0.2, a second wheel at -2 times the
# driver and a third at -3 times the second plus 0.1, the third is at 1.3. link_fk looks the leader up among the values that were set and
# takes 0 where it is not there: 0.1. link_fk_batch, which does the same for many configurations at once, takes the first joint of the
# robot for a leader that is a follower itself: -0.5. No warning. A mimic of the driver is right in both.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check --no-deps ManipulaPy==1.4.2 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import math
import sys
import warnings
import numpy
from ManipulaPy.urdf import URDF

warnings.simplefilter("error", UserWarning)
mimics = ("", '<mimic joint="wheel0" multiplier="-2"/>', '<mimic joint="wheel1" multiplier="-3" offset="0.1"/>')
wheels = "".join(
    f'<link name="disc{at}"/><joint name="wheel{at}" type="continuous"><parent link="base"/><child link="disc{at}"/>'
    f'<origin xyz="{at} 0 0"/><axis xyz="0 0 1"/>{mimic}</joint>' for at, mimic in enumerate(mimics))
robot = URDF.from_xml_string(f'<robot name="train"><link name="base"/>{wheels}</robot>')


def angles(poses):
    named = {link if isinstance(link, str) else link.name: numpy.asarray(pose).reshape(4, 4) for link, pose in poses.items()}
    return [round(math.atan2(named[f"disc{at}"][1, 0], named[f"disc{at}"][0, 0]), 9) for at in range(3)]


robot.update_cfg({"wheel0": 0.2})
single, batch = angles(robot.link_fk()), angles(robot.link_fk_batch(numpy.array([[0.2]])))
print("degrees of freedom:", robot.num_dofs)
print("wheels by link_fk", single, "by link_fk_batch", batch, "by the file", [0.2, -0.4, 1.3])
print("ManipulaPy", importlib.metadata.version("ManipulaPy"))
sys.exit(not (robot.num_dofs == 1 and single == [0.2, -0.4, 0.1] and batch == [0.2, -0.4, -0.5]))
PYTHON
MANIPULAPY_QUIET=1 "$folder/venv/bin/python" "$folder/try.py"
