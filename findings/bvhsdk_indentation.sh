#!/usr/bin/env bash
# bvhsdk 0.2.1: a BVH file that is indented by four spaces loses its joints, and they grow on the skeleton of the file that was read before.
#
# In BVH braces say which joint hangs on which; files are written with tabs, with two spaces or four, or with none. bvhsdk reads the tree from the
# indentation: tabs, or pairs of spaces. With four spaces the level below the root is not found, and the joint is hung on the last joint that a search
# of that level has ever found, in whatever file. Read alone, the file ends in an IndexError. Read after another one it has a root and no
# joint, without a word, and an arm of the other file, which was right, has two more joints.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check bvhsdk==0.2.1 numpy==2.4.6 matplotlib==3.11.2
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
from bvhsdk import bvh

folder = sys.argv[1]


def written(names, indentation):
    """An arm of three joints, one on the other, each turned by 90 degrees, as a file."""
    shoulder, elbow, hand = names
    lines = [
        (0, "HIERARCHY"), (0, "ROOT " + shoulder), (0, "{"),
        (1, "OFFSET 0 0 0"), (1, "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation"),
        (1, "JOINT " + elbow), (1, "{"), (2, "OFFSET 1 0 0"), (2, "CHANNELS 3 Zrotation Xrotation Yrotation"),
        (2, "JOINT " + hand), (2, "{"), (3, "OFFSET 1 0 0"), (3, "CHANNELS 3 Zrotation Xrotation Yrotation"),
        (3, "End Site"), (3, "{"), (4, "OFFSET 1 0 0"), (3, "}"), (2, "}"), (1, "}"), (0, "}"),
        (0, "MOTION"), (0, "Frames: 1"), (0, "Frame Time: 0.5"), (0, "0 0 0 90 0 0 90 0 0 90 0 0"),
    ]
    path = f"{folder}/{shoulder}.bvh"
    with open(path, "w") as file:
        file.write("".join(indentation * level + text + "\n" for level, text in lines))
    return path


def joints(animation):
    found, waiting = {}, [(None, animation.root)]
    while waiting:
        parent, joint = waiting.pop(0)
        found[joint.name] = parent
        waiting += [(joint.name, child) for child in joint.children]
    return found


print("bvhsdk", importlib.metadata.version("bvhsdk"))
four = written(["b0", "b1", "b2"], "    ")
try:
    alone = joints(bvh.ReadFile(four))
except IndexError as error:
    alone = "IndexError"
    print("four spaces, alone: IndexError:", error)
found = {}
for name, indentation in (("tabs", "\t"), ("two spaces", "  ")):
    first = bvh.ReadFile(written(["a0", "a1", "a2"], indentation))
    before = joints(first)
    second = joints(bvh.ReadFile(four))
    found[name] = before, second, joints(first)
    print(f"{name}: read first {before}; four spaces after it {second}; then the first one has {found[name][2]}")
arm = {"a0": None, "a1": "a0", "a2": "a1"}
root = {"b0": None}
grown = {**arm, "b1": "a1", "b2": "a1"}
sys.exit(not (alone == "IndexError" and all(seen == (arm, root, grown) for seen in found.values())))
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
