#!/usr/bin/env bash
# @jscad/dxf-deserializer 2.3.30 (npm): an arc of less than 22.5 degrees is a point at NaN, a bulge above 1 a short arc, a turned ellipse swings round the origin.
#
# It reads DXF for JSCAD; the only angles that its notes give up are those of circles and ellipses. Arcs are drawn in sixteenths of a turn, rounded down, so that
# a short one, a fillet or the end of a slot, has no step, and one point with the coordinates NaN is all there is of it. A bulge is the tangent of a quarter
# of the arc's angle; above 1 the arc is more than a half turn: 2 on a chord of 2 is 2 deep. It is drawn as the rest of the same circle, 0.5 deep.
# An ellipse is turned after it was put in its place: one with its long axis along y at (10, 0) stands at (0, 10), and one whose long axis points below
# the x axis is not turned at all. The older POLYLINE loses its bulges and its last side.
# ("Conversion to geom2 if POLYLINE is closed", say the notes.)
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --prefix . --silent --no-audit --no-fund @jscad/dxf-deserializer@2.3.30 @jscad/modeling@2.13.0
cat > try.js <<'JAVASCRIPT'
const {deserialize} = require("@jscad/dxf-deserializer");
const {measureBoundingBox} = require("@jscad/modeling").measurements;

let right = true;

/** The first entity of a DXF file: its box in x and y (lower corner, upper corner) beside the true one. */
function look(name, entity, seen, truth) {
  const codes = `0 SECTION 2 ENTITIES ${entity} 0 ENDSEC 0 EOF`;
  const [geometry] = deserialize({output: "geometries"}, codes.split(" ").join("\n") + "\n");
  const [low, high] = measureBoundingBox(geometry);
  const box = [low[0], low[1], high[0], high[1]].map((value) => Math.round(value * 100) / 100);
  const points = geometry.points ? `, ${geometry.points.length} points${geometry.isClosed ? ", closed" : ""}` : "";
  console.log(`${name}: box ${box.join(" ")}${points} - true ${truth.join(" ")}`);
  right &&= JSON.stringify(box) === JSON.stringify(seen);
  return geometry;
}

const nothing = look("arc of 20 degrees", "0 ARC 8 0 10 0 20 0 40 5 50 350 51 10", [NaN, NaN, NaN, NaN], [4.92, -0.87, 5, 0.87]);
look("arc of 90 degrees", "0 ARC 8 0 10 0 20 0 40 5 50 0 51 90", [0, 0, 5, 5], [0, 0, 5, 5]);
for (const [bulge, seen, truth] of [[0.5, [0, -0.5, 2, 0], [0, -0.5, 2, 0]], [2, [0, -0.5, 2, 0], [-0.25, -2, 2.25, 0]]]) {
  look(`bulge ${bulge}`, `0 LWPOLYLINE 8 0 90 2 70 0 10 0 20 0 42 ${bulge} 10 2 20 0`, seen, truth);
}
const ellipse = (x, axis) => `0 ELLIPSE 8 0 10 ${x} 20 0 30 0 ${axis} 31 0 40 0.5 41 0 42 6.283185307179586`;
look("ellipse at (10, 0), axis along x", ellipse(10, "11 4 21 0"), [6, -2, 14, 2], [6, -2, 14, 2]);
look("ellipse at (10, 0), axis along y", ellipse(10, "11 0 21 4"), [-2, 6, 2, 14], [8, -4, 12, 4]);
look("ellipse at (10, 0), axis along -y", ellipse(10, "11 0 21 -4"), [6, -2, 14, 2], [8, -4, 12, 4]);
const vertex = (x, y, bulge) => `0 VERTEX 8 0 10 ${x} 20 ${y} 42 ${bulge}`;
const old = look("POLYLINE with a half circle, closed", `0 POLYLINE 8 0 66 1 70 1 ${vertex(0, 0, 1)} ${vertex(2, 0, 0)} ${vertex(2, 1, 0)} 0 SEQEND`,
  [0, 0, 2, 1], [0, -1, 2, 1]);
const light = look("LWPOLYLINE with a half circle, closed", "0 LWPOLYLINE 8 0 90 3 70 1 10 0 20 0 42 1 10 2 20 0 42 0 10 2 20 1 42 0",
  [0, -1, 2, 1], [0, -1, 2, 1]);
console.log("@jscad/dxf-deserializer", require("@jscad/dxf-deserializer/package.json").version);
process.exit(right && nothing.points.length === 1 && !old.isClosed && light.isClosed ? 0 : 1);
JAVASCRIPT
node try.js
