#!/usr/bin/env bash
# math3d 0.2.2 (npm): an elbow turned by its localRotation leaves the hand where it was, until the shoulder is touched; a rotation is NaN degrees from itself.
#
# "A class to contain the position and the rotation of an object and create an object hierarchy", as in Unity, where children follow their parent.
# Here they follow a parent whose world pose is set. One that is moved by what joints are moved by, its localRotation or localPosition, moves alone,
# and so does a parent that is itself a child and is moved by translate(): the hand stays, and is no longer where its place in the elbow says. Setting the
# rotation of the shoulder to what it is puts the hand right, so that the pose depends on the order of calls. rotate() does move the hand.
# angleTo of a rotation and itself is the acos of a number that rounding may lift above 1: NaN for 114 of 360 whole degrees.
# Euler angles of a pitch of 90 degrees are 90, 0, 0, whatever the heading was (Unity keeps the heading): they give another rotation.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --prefix . --silent --no-audit --no-fund math3d@0.2.2
cat > try.js <<'JAVASCRIPT'
const {Transform, Quaternion, Vector3} = require("math3d");

const place = (transform) => [transform.position.x, transform.position.y].map((value) => Math.round(value * 1e6) / 1e6);
const same = (one, other) => JSON.stringify(one) === JSON.stringify(other);

/** A stretched arm along x: shoulder at 0, elbow at 1, hand at 2, and the places of the hand after the elbow is moved. */
function hand(turn) {
  const [shoulder, elbow, tip] = [0, 1, 2].map((x) => new Transform(new Vector3(x, 0, 0)));
  elbow.parent = shoulder;
  tip.parent = elbow;
  turn(elbow);
  const before = place(tip);
  const inElbow = elbow.transformPosition(tip.localPosition);
  shoulder.rotation = shoulder.rotation;
  return {before, byElbow: place({position: inElbow}), touched: place(tip)};
}

const quarter = Quaternion.Euler(0, 0, 90);
const rotated = hand((elbow) => elbow.rotate(0, 0, 90));
const local = hand((elbow) => { elbow.localRotation = quarter; });
const slid = hand((elbow) => elbow.translate(new Vector3(0, 1, 0)));
const world = hand((elbow) => { elbow.rotation = quarter; });
console.log("hand of an arm of 1 and 1 whose elbow was turned by 90 degrees, or moved:");
for (const [name, found] of Object.entries({localRotation: local, "translate by 0,1": slid, rotation: world, rotate: rotated})) {
  console.log(`  by ${name}: ${found.before}, by the elbow's matrix ${found.byElbow}, with the shoulder touched ${found.touched}`);
}
const root = new Transform();
const child = new Transform(new Vector3(1, 0, 0));
child.parent = root;
root.localPosition = new Vector3(0, 5, 0);
console.log("a root moved to 0,5 by its localPosition: child at", place(child).join());

const angles = Array.from({length: 360}, (_, angle) => Quaternion.Euler(angle, 20, 30)).map((turn) => turn.angleTo(turn));
const unknown = angles.filter((angle) => Number.isNaN(angle)).length;
console.log("angles of a rotation to itself that are NaN:", unknown, "of 360");

const steep = Quaternion.Euler(90, 30, 0);
const {x, y, z} = steep.eulerAngles;
const apart = steep.inverse().mul(Quaternion.Euler(x, y, z)).angleAxis.angle;
console.log("Euler(90, 30, 0) read again:", [x, y, z].join(), "-", Math.round(Math.min(apart, 360 - apart)), "degrees off");
console.log("math3d", require("math3d/package.json").version);
const stays = {before: [2, 0], byElbow: [1, 1], touched: [1, 1]};
process.exit(
  same(local, stays) && same(world, {...stays, before: [1, 1]}) && same(slid, {before: [2, 0], byElbow: [2, 1], touched: [2, 1]})
  && same(rotated, {...stays, before: [1, 1]})
  && same(place(child), [1, 0]) && unknown > 50 && same([x, y, z], [90, 0, 0]) && Math.abs(Math.min(apart, 360 - apart) - 30) < 1e-6 ? 0 : 1);
JAVASCRIPT
node try.js
