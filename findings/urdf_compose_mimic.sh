#!/usr/bin/env bash
# urdf-compose 0.4.1: of two grippers put on one robot, the second one's fingers mimic the finger of the first.
#
# Where names of two URDF files collide, urdf-compose renames the links and joints of the later one: finger becomes finger(1), and parent and
# child follow. The joint that a <mimic> names is left as it was. The file it writes is valid, and wrong in motion: both followers hang on one
# leader, and the leader of the second gripper drives nothing. With names that do
# not collide all is well.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check urdf-compose==0.4.1 typing_extensions==4.16.0
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import pathlib
import sys
import xml.etree.ElementTree as tree
import urdf_compose

folder = pathlib.Path(sys.argv[1])
# The reader would run a program of ROS; the files are valid.
urdf_compose.globally_disable_check_urdf()


def gripper(path, prefix):
    def joint(name, child, mimic=""):
        return (f'<joint name="{prefix}{name}" type="revolute"><parent link="INPUT-{prefix}palm"/><child link="{prefix}{child}"/>'
                f'<axis xyz="0 0 1"/><limit lower="0" upper="1" effort="1" velocity="1"/>{mimic}</joint>')

    path.write_text(f'<robot name="gripper"><link name="INPUT-{prefix}palm"/><link name="{prefix}left"/><link name="{prefix}right"/>'
                    + joint("finger", "left") + joint("thumb", "right", f'<mimic joint="{prefix}finger" multiplier="-1"/>') + "</robot>")
    return urdf_compose.ExplicitURDFObj(path)


(folder / "arms.urdf").write_text(
    '<robot name="arms"><link name="base"/><link name="output-one"/><link name="output-two"/>'
    '<joint name="to_one" type="fixed"><parent link="base"/><child link="output-one"/></joint>'
    '<joint name="to_two" type="fixed"><parent link="base"/><child link="output-two"/></joint></robot>')
arms = urdf_compose.ExplicitURDFObj(folder / "arms.urdf")
right = True
for name, second, expected in (
    ("the same gripper twice", "", {"thumb": "finger", "thumb(1)": "finger"}),
    ("grippers with names of their own", "b_", {"thumb": "finger", "b_thumb": "b_finger"}),
):
    pair = [(gripper(folder / "first.urdf", ""), urdf_compose.URDFConn("one")),
            (gripper(folder / "second.urdf", second), urdf_compose.URDFConn("two"))]
    robot = urdf_compose.raise_if_compose_error(urdf_compose.branch(arms, pair))
    urdf_compose.write_and_check_urdf(robot, folder / "robot.urdf")
    joints = tree.parse(folder / "robot.urdf").getroot().findall("joint")
    mimics = {joint.get("name"): joint.find("mimic").get("joint") for joint in joints if joint.find("mimic") is not None}
    print(f"{name}: joints", [joint.get("name") for joint in joints if joint.get("type") == "revolute"], "- followers and leaders", mimics)
    right &= mimics == expected
print("urdf-compose", importlib.metadata.version("urdf-compose"))
sys.exit(not right)
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
