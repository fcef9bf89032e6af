#!/usr/bin/env bash
# urdf-loader 0.13.1 (npm): planar and floating joints turn about the parent's origin, not about their own <origin>.
#
# In URDF a joint's motion is applied in the joint's frame, which <origin> places in the parent: pose = origin * motion, as this
# loader does for revolute and prismatic joints. For planar and floating joints it takes motion * origin. A table 1 m from the
# base, turned by 90 degrees on the spot, swings round the base to (0, 1, 0). A planar joint with axis x moves in the plane normal
# to x; here its two slides are x and y whatever the axis, so one of them leaves the plane. Pinocchio turns the table on the spot.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm init --yes > /dev/null
npm install --silent --no-audit --no-fund urdf-loader@0.13.1 three@0.187.0 jsdom@29.1.1
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check pin==4.1.0 numpy==2.4.6
cat > "$folder/table.urdf" <<'URDF'
<robot name="table">
  <link name="base"/><link name="table"/>
  <joint name="move" type="planar">
    <parent link="base"/><child link="table"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
  </joint>
</robot>
URDF
cat > "$folder/try.py" <<'PYTHON'
import sys
import numpy
import pinocchio

model = pinocchio.buildModelFromUrdf(sys.argv[1] + "/table.urdf")
data = model.createData()
pinocchio.forwardKinematics(model, data, numpy.array([0.0, 0.0, 0.0, 1.0]))  # x, y, cos and sin
place = data.oMi[1].translation
print("Pinocchio", pinocchio.__version__, "- table turned by 90 degrees stands at", place)
sys.exit(not numpy.allclose(place, [1, 0, 0]))
PYTHON
cat > "$folder/try.mjs" <<'JAVASCRIPT'
import { readFileSync } from 'node:fs';
import { JSDOM } from 'jsdom';

const { window } = new JSDOM('');
for (const name of ['DOMParser', 'Document', 'Element', 'XMLSerializer']) globalThis[name] = window[name];
const { default: URDFLoader } = await import('urdf-loader');
const text = readFileSync('table.urdf', 'utf8');

function place(file, values) {
  const robot = new URDFLoader().parse(file);
  robot.setJointValue('move', ...values);
  robot.updateMatrixWorld(true);
  return [12, 13, 14].map((i) => Number(robot.links.table.matrixWorld.elements[i].toFixed(6)));
}

const quarter = Math.PI / 2;
const seen = [
  ['planar, turned by 90 degrees', place(text, [0, 0, quarter]), [0, 1, 0]],
  ['floating, turned by 90 degrees', place(text.replace('planar', 'floating'), [0, 0, 0, 0, 0, quarter]), [0, 1, 0]],
  ['continuous, turned by 90 degrees', place(text.replace('planar', 'continuous'), [quarter]), [1, 0, 0]],
  ['planar with axis x, slides of 0.3 and 0.2', place(text.replace('0 0 1"', '1 0 0"'), [0.3, 0.2, 0]), [1.3, 0.2, 0]],
];
let right = true;
for (const [name, is, expected] of seen) {
  console.log(`urdf-loader - ${name}: table stands at`, is);
  right &&= is.every((value, i) => Math.abs(value - expected[i]) < 1e-5);
}
console.log('version:', JSON.parse(readFileSync('node_modules/urdf-loader/package.json', 'utf8')).version);
process.exit(right ? 0 : 1);
JAVASCRIPT
"$folder/venv/bin/python" "$folder/try.py" "$folder"
node "$folder/try.mjs"
