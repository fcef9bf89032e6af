#!/usr/bin/env bash
# dxf-writer 1.18.4 (npm): a spline that is to go through points has their number and not the points; polygons turn the other way round than text.
#
# drawSpline takes fit points, through which a spline goes, after the control points. The file that is written says in group 74 how many there are,
# and groups 11, 21, 31, which are the points, do not follow: a reader that trusts the number takes what comes next, or refuses the file.
# Angles in DXF run anticlockwise, and so does the rotation of drawText and of drawArc. drawPolygon starts at the top and turns clockwise: of a triangle
# turned by 30 degrees the first corner, at 90 degrees before, is at 60, where a text of the same library that is turned by 30 degrees turns the
# other way.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm install --prefix . --silent --no-audit --no-fund dxf-writer@1.18.4
cat > try.js <<'JAVASCRIPT'
const Drawing = require("dxf-writer");

/** The groups of the first entity of a kind that a drawing writes: pairs of code and value. */
function groups(drawing, kind) {
  const lines = drawing.toDxfString().split("\n").map((line) => line.trim());
  const pairs = Array.from({length: Math.floor(lines.length / 2)}, (_, row) => [Number(lines[2 * row]), lines[2 * row + 1]]);
  const start = pairs.findIndex(([code, value]) => code === 0 && value === kind);
  const length = pairs.slice(start + 1).findIndex(([code]) => code === 0);
  return pairs.slice(start, start + 1 + length);
}

const values = (pairs, wanted) => pairs.filter(([code]) => code === wanted).map(([, value]) => Number(value));

const control = [[0, 0], [1, 2], [3, 2], [4, 0]];
const spline = groups(new Drawing().drawSpline(control, 3, null, null, [[0, 0], [2, 1.5], [4, 0]]), "SPLINE");
console.log("spline: group 74 (fit points)", values(spline, 74), "- groups 11:", values(spline, 11), "21:", values(spline, 21),
  "- control points x:", values(spline, 10).join());

const direction = (rotation) => {
  const pairs = groups(new Drawing().drawPolygon(0, 0, 3, 1, rotation), "LWPOLYLINE");
  return Math.round(Math.atan2(values(pairs, 20)[0], values(pairs, 10)[0]) * 180 / Math.PI);
};
const [straight, turned] = [direction(0), direction(30)];
const text = values(groups(new Drawing().drawText(0, 0, 1, 30, "up"), "TEXT"), 50);
console.log(`first corner of a triangle: at ${straight} degrees, turned by 30 at ${turned}; group 50 of a text turned by 30:`, text);
console.log("dxf-writer", require("dxf-writer/package.json").version);
process.exit(
  values(spline, 74)[0] === 3 && values(spline, 11).length === 0 && values(spline, 10).join() === "0,1,3,4"
  && straight === 90 && turned === 60 && text[0] === 30 ? 0 : 1);
JAVASCRIPT
node try.js
