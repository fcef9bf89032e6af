#!/usr/bin/env bash
# bvh 0.3: of a BVH file that does not end with a line feed the last frame is missing, and nframes counts it.
#
# A motion of three frames, written line by line with line feeds between the lines, has two frames in Bvh.frames. nframes gives the number that stands
# in the file, three, so that a loop over nframes ends in an IndexError and one over frames leaves a pose out. With a line feed at the end all
# are there. bvhio has three for both files.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check bvh==0.3 bvhio==1.5.4 numpy==2.4.6
cat > "$folder/try.py" <<'PYTHON'
import importlib.metadata
import sys
import bvh
import bvhio

folder = sys.argv[1]
TEXT = """HIERARCHY
ROOT Base
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Arm
  {
    OFFSET 1 0 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 1 0 0
    }
  }
}
MOTION
Frames: 3
Frame Time: 0.5
0 0 0 0 0 0 10 0 0
0 0 0 0 0 0 20 0 0
0 0 0 0 0 0 30 0 0"""
found = {}
for name, text in (("line feed", TEXT + "\n"), ("no line feed", TEXT)):
    motion = bvh.Bvh(text)
    seen = motion.nframes, len(motion.frames)
    path = f"{folder}/one.bvh"
    with open(path, "w") as file:
        file.write(text)
    other = bvhio.readAsBvh(path).FrameCount
    found[name] = seen, other
    print(f"{name}: bvh counts {seen[0]} frames and has {seen[1]}; bvhio has {other}")
for package in ("bvh", "bvhio"):
    print(package, importlib.metadata.version(package))
sys.exit(found != {"line feed": ((3, 3), 3), "no line feed": ((3, 2), 3)})
PYTHON
"$folder/venv/bin/python" "$folder/try.py" "$folder"
