#!/usr/bin/env bash
# bvhio 1.5.4, bvh-converter 1.0.2, three 0.187.0 (npm): a slide of a BVH file stands at its channels, at its offset, or at the sum of both.
#
# A joint of a BVH file has an OFFSET in its parent and may have position channels of its own: a slide, a wrist that was tracked, or the root.
# For a joint with the offset 1 0 0 and channels at 3 2 0, bvhio takes the channels for the whole place (3 2 0), BVHLoader of three.js adds
# them to the offset (4 2 0), and bvh-converter, which reads the six numbers, does not use them (1 0 0). A root with an offset of 5 and a channel
# at 1 stands at 6 in three.js and at 1 in the others. None says anything. Where only the root has position channels, and no offset, all agree.
# Exporters that write six channels for every joint (bvhsdk is one) repeat the offset in them: right in two, and twice as long in three.js.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check bvhio==1.5.4 bvh-converter==1.0.2 numpy==2.4.6
cd "$folder"
npm init --yes > /dev/null
npm install --silent --no-audit --no-fund three@0.187.0
write() {
  cat > "$1.bvh" <<BVH
HIERARCHY
ROOT Base
{
  OFFSET $2
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Slide
  {
    OFFSET 1 0 0
    CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
    End Site
    {
      OFFSET 1 0 0
    }
  }
}
MOTION
Frames: 1
Frame Time: 0.5
$3 0 0 0 $4 0 0 0
BVH
}
write slide "0 0 0" "0 0 0" "3 2 0"
write root "5 0 0" "1 0 0" "1 0 0"
cat > try.mjs <<'JAVASCRIPT'
import { readFileSync } from 'node:fs';
import { BVHLoader } from 'three/examples/jsm/loaders/BVHLoader.js';

const places = {};
for (const name of ['slide', 'root']) {
  const { skeleton, clip } = new BVHLoader().parse(readFileSync(`${name}.bvh`, 'utf8'));
  for (const bone of skeleton.bones) {
    const track = clip.tracks.find((one) => one.name === `${bone.name}.position`);
    if (track) bone.position.fromArray(track.values);
  }
  skeleton.bones[0].updateMatrixWorld(true);
  places[name] = skeleton.bones.slice(0, 2).map((bone) => [12, 13, 14].map((at) => bone.matrixWorld.elements[at]));
}
console.log(JSON.stringify(places));
JAVASCRIPT
node try.mjs > three.json
cat > try.py <<'PYTHON'
import csv
import importlib.metadata
import json
import subprocess
import sys
import bvhio

found = {"three": json.load(open("three.json"))}
for name in ("slide", "root"):
    top = bvhio.readAsHierarchy(f"{name}.bvh")
    top.loadPose(0)
    found.setdefault("bvhio", {})[name] = [[round(float(value), 5) for value in joint.PositionWorld] for joint, _, _ in top.layout()][:2]
    subprocess.run([sys.argv[1] + "/bvh-converter", f"{name}.bvh"], capture_output=True, text=True, check=True)
    row = [float(value) for value in list(csv.reader(open(f"{name}_worldpos.csv")))[1]]
    found.setdefault("bvh-converter", {})[name] = [row[1:4], row[4:7]]
for package in ("bvhio", "bvh-converter"):
    print(package, importlib.metadata.version(package))
for program, places in sorted(found.items()):
    print(f"{program}: slide at {places['slide'][1]}; root at {places['root'][0]}, its joint at {places['root'][1]}")
expected = {
    "bvhio": {"slide": [[0, 0, 0], [3, 2, 0]], "root": [[1, 0, 0], [2, 0, 0]]},
    "bvh-converter": {"slide": [[0, 0, 0], [1, 0, 0]], "root": [[1, 0, 0], [2, 0, 0]]},
    "three": {"slide": [[0, 0, 0], [4, 2, 0]], "root": [[6, 0, 0], [8, 0, 0]]},
}
sys.exit(found != expected)
PYTHON
"$folder/venv/bin/python" try.py "$folder/venv/bin"
