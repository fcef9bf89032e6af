#!/usr/bin/env bash
# three 0.187.0 (npm), ColladaLoader: COLLADA joints without limits are locked, compound joints lose freedoms, neighbours jump back.
#
# In COLLADA 1.5 a <joint> holds one or more <prismatic> and <revolute> primitives, and the <limits> of a primitive are optional. The
# loader takes 0 and 0 for limits that are left out, and a joint with min >= max for static: a wheel that turns freely cannot be
# set. Of a joint with a <prismatic> and a <revolute> (a cylindrical joint) the last one remains. Where two joints move one node,
# as in a cross joint, setting the second one puts the first back to the pose drawn, while getJointValue still gives the value
# that it had. The loader's "kinematics" object is the only reader of these elements in common use.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm init --yes > /dev/null
npm install --silent --no-audit --no-fund three@0.187.0 jsdom@29.1.1
cat > "$folder/cross.dae" <<'COLLADA'
<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2008/03/COLLADASchema" version="1.5.0">
  <asset>
    <created>2026-01-01T00:00:00Z</created><modified>2026-01-01T00:00:00Z</modified>
    <unit name="meter" meter="1"/><up_axis>Y_UP</up_axis>
  </asset>
  <library_visual_scenes>
    <visual_scene id="scene" name="scene">
      <node id="cross" name="cross" sid="cross">
        <rotate sid="first_axis0">0 0 1 0</rotate><rotate sid="second_axis0">0 1 0 0</rotate>
        <node id="tip" name="tip"><translate>1 0 0</translate></node>
      </node>
    </visual_scene>
  </library_visual_scenes>
  <library_joints>
    <joint id="first" name="first">FIRST</joint>
    <joint id="second" name="second">
      <revolute sid="axis0"><axis>0 1 0</axis><limits><min>-90</min><max>90</max></limits></revolute>
    </joint>
  </library_joints>
  <library_kinematics_models>
    <kinematics_model id="model">
      <technique_common>
        <instance_joint sid="first" url="#first"/><instance_joint sid="second" url="#second"/>
        <link sid="base"><attachment_full joint="model/first"><link sid="ring">
          <attachment_full joint="model/second"><link sid="end"/></attachment_full>
        </link></attachment_full></link>
      </technique_common>
    </kinematics_model>
  </library_kinematics_models>
  <library_kinematics_scenes>
    <kinematics_scene id="kinematics"><instance_kinematics_model sid="inst" url="#model"/></kinematics_scene>
  </library_kinematics_scenes>
  <scene>
    <instance_visual_scene url="#scene"/>
    <instance_kinematics_scene url="#kinematics">
      <bind_joint_axis target="cross/first_axis0"><axis><param>scene_inst_first_axis0</param></axis></bind_joint_axis>
      <bind_joint_axis target="cross/second_axis0"><axis><param>scene_inst_second_axis0</param></axis></bind_joint_axis>
    </instance_kinematics_scene>
  </scene>
</COLLADA>
COLLADA
cat > "$folder/try.mjs" <<'JAVASCRIPT'
import { readFileSync } from 'node:fs';
import { JSDOM } from 'jsdom';

const { window } = new JSDOM('');
for (const name of ['DOMParser', 'Document', 'Element', 'XMLSerializer']) globalThis[name] = window[name];
const { REVISION } = await import('three');
const { ColladaLoader } = await import('three/examples/jsm/loaders/ColladaLoader.js');
const text = readFileSync('cross.dae', 'utf8');
const limits = '<limits><min>-90</min><max>90</max></limits>';
const turn = (inside) => `<revolute sid="axis0"><axis>0 0 1</axis>${inside}</revolute>`;
const slide = `<prismatic sid="axis1"><axis>0 0 1</axis><limits><min>-1</min><max>1</max></limits></prismatic>`;
const load = (first) => new ColladaLoader().parse(text.replace('FIRST', first), './');

function tip({ scene }) {
  scene.updateMatrixWorld(true);
  return scene.getObjectByName('tip').matrixWorld.elements.slice(12, 15).map((x) => Number(x.toFixed(4)));
}

function near(one, other) {
  return one.every((x, i) => Math.abs(x - other[i]) < 1e-3);
}

const free = load(turn(''));
free.kinematics.setJointValue('first', 40);
console.log('without limits, set to 40 degrees:', tip(free), 'static:', free.kinematics.joints.first.static);
const compound = load(slide + turn(limits)).kinematics.joints.first;
console.log('prismatic and revolute in one joint: read as', compound.type);
const cross = load(turn(limits));
cross.kinematics.setJointValue('first', 40);
const before = tip(cross);
cross.kinematics.setJointValue('second', 30);
const value = cross.kinematics.getJointValue('first');
console.log('first at 40 degrees:', before, '- then second at 30:', tip(cross), `- first is said to be at ${value}`);
console.log('version:', REVISION);
const after = [Math.cos(Math.PI / 6), 0, -0.5];
process.exit(near(tip(free), [1, 0, 0]) && free.kinematics.joints.first.static && compound.type === 'revolute'
  && near(before, [0.766, 0.6428, 0]) && near(tip(cross), after) && value === 40 ? 0 : 1);
JAVASCRIPT
node "$folder/try.mjs"
