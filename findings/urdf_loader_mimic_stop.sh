#!/usr/bin/env bash
# urdf-loader 0.13.1 (npm): a <mimic> joint runs on when its leader is at its stop, and starts off its offset.
#
# URDF: value = multiplier * other_joint_value + offset, which the loader's documentation repeats. The loader hands the value that was
# asked for to the followers and clamps the leader afterwards: a leader with an upper limit of 1, set to 2, stands at 1, and its
# follower (multiplier 2, offset 0.3) at 4.3 and not 2.3. Before the first call the follower is at 0 and not at its offset, and it
# can be set by itself. So a picture of a gripper or a gear train shows poses that the mechanism does not have.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm init --yes > /dev/null
npm install --silent --no-audit --no-fund urdf-loader@0.13.1 three@0.187.0 jsdom@29.1.1
cat > "$folder/gears.urdf" <<'URDF'
<robot name="gears">
  <link name="base"/><link name="a"/><link name="b"/>
  <joint name="leader" type="revolute">
    <parent link="base"/><child link="a"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
  <joint name="follower" type="continuous">
    <parent link="base"/><child link="b"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
    <mimic joint="leader" multiplier="2" offset="0.3"/>
  </joint>
</robot>
URDF
cat > "$folder/try.mjs" <<'JAVASCRIPT'
import { readFileSync } from 'node:fs';
import { JSDOM } from 'jsdom';

const { window } = new JSDOM('');
for (const name of ['DOMParser', 'Document', 'Element', 'XMLSerializer']) globalThis[name] = window[name];
const { default: URDFLoader } = await import('urdf-loader');
const { joints } = new URDFLoader().parse(readFileSync('gears.urdf', 'utf8'));
const { leader, follower } = joints;
let right = true;

function look(name, expected) {
  const off = follower.angle - (2 * leader.angle + 0.3);
  console.log(`${name}: leader ${leader.angle}, follower ${follower.angle}, off the coupling by ${off.toFixed(6)}`);
  right &&= Math.abs(off - expected) < 1e-9;
}

look('as loaded', -0.3);
leader.setJointValue(0.5);
look('leader set to 0.5', 0);
leader.setJointValue(2);
look('leader set to 2', 2);
follower.setJointValue(0.7);
look('follower set to 0.7', -1.6);
console.log('version:', JSON.parse(readFileSync('node_modules/urdf-loader/package.json', 'utf8')).version);
process.exit(right ? 0 : 1);
JAVASCRIPT
node "$folder/try.mjs"
