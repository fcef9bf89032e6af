#!/usr/bin/env bash
# dxf-parser 1.1.2 (npm), dxf-parser 0.1.0 (PyPI): a hole drawn from behind is on the other side; an arc of 20 degrees has a length of -340.
#
# A DXF entity whose extrusion is 0 0 -1, as CAD writes it for parts that were mirrored or drawn on a back face, has its x the other way round. The parser
# hands the extrusion on for arcs, polylines and inserts, and drops it for circles and ellipses: a hole at x = -5 comes back at 5, with nothing that could tell it
# from one that is there. dxf 5.3.1 (npm) puts it at -5. angleLength of an arc is its end less its start: negative for all that pass
# 0 degrees, 350 to 10 for example. The Python package of the same name, "compatible with the output structure", does so too. Besides, its polylines with
# VERTEX entities, those of R12, have no vertices, and an insert with an extrusion ends in a KeyError.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check dxf-parser==0.1.0
cd "$folder"
npm init --yes > /dev/null
npm install --silent --no-audit --no-fund dxf-parser@1.1.2 dxf@5.3.1
cat > write.py <<'PYTHON'
BEHIND = ((210, 0.0), (220, 0.0), (230, -1.0))
CIRCLE = ((0, "CIRCLE"), (8, "0"), (10, 5.0), (20, 0.0), (30, 0.0), (40, 1.0))
ARC = ((0, "ARC"), (8, "0"), (10, 0.0), (20, 0.0), (30, 0.0), (40, 1.0), (50, 350.0), (51, 10.0))
POLYLINE = ((0, "POLYLINE"), (8, "0"), (66, 1), (70, 0), (10, 0.0), (20, 0.0), (30, 0.0), (0, "VERTEX"), (8, "0"), (10, 1.0), (20, 2.0), (30, 0.0),
            (0, "VERTEX"), (8, "0"), (10, 3.0), (20, 4.0), (30, 0.0), (0, "SEQEND"), (8, "0"))
INSERT = ((0, "INSERT"), (8, "0"), (2, "part"), (10, 5.0), (20, 0.0), (30, 0.0))
for name, groups in (("drawing", CIRCLE + CIRCLE + BEHIND + ARC + POLYLINE), ("insert", INSERT + BEHIND)):
    with open(name + ".dxf", "w") as file:
        for code, value in ((0, "SECTION"), (2, "ENTITIES")) + groups + ((0, "ENDSEC"), (0, "EOF")):
            file.write(f"{code}\n{value}\n")
PYTHON
"$folder/venv/bin/python" write.py
cat > try.mjs <<'JAVASCRIPT'
import { readFileSync } from 'node:fs';
import DxfParser from 'dxf-parser';
import { Helper } from 'dxf';

const text = readFileSync('drawing.dxf', 'utf8');
const parser = new (DxfParser.default ?? DxfParser)();
const insert = parser.parseSync(readFileSync('insert.dxf', 'utf8')).entities[0].extrusionDirection.z;
const middles = new Helper(text).toPolylines().polylines.slice(0, 2).map(({ vertices }) => {
  const across = vertices.map(([x]) => x);
  return Math.round((Math.min(...across) + Math.max(...across)) / 2);
});
console.log(JSON.stringify({ entities: parser.parseSync(text).entities, insert, middles }));
JAVASCRIPT
node try.mjs > parsed.json
cat > try.py <<'PYTHON'
import importlib.metadata
import json
import math
import sys
import dxf_parser

npm = json.load(open("parsed.json"))
port = dxf_parser.parse(open("drawing.dxf").read())["entities"]
try:
    insert = dxf_parser.parse(open("insert.dxf").read())["entities"]
except KeyError as error:
    insert = f"KeyError {error}"
print("dxf-parser of PyPI", importlib.metadata.version("dxf-parser"))
found = {}
for name, (front, back, arc, polyline) in (("npm", npm["entities"]), ("PyPI", port)):
    same = {key: value for key, value in front.items() if key != "handle"} == {key: value for key, value in back.items() if key != "handle"}
    found[name] = same, back["center"]["x"], round(math.degrees(arc["angleLength"]), 6), [(vertex["x"], vertex["y"]) for vertex in polyline["vertices"]]
    print(f"{name}: circles in front and behind alike {found[name][0]}, at x = {found[name][1]}; arc of {found[name][2]} degrees; vertices {found[name][3]}")
print("an insert from behind:", npm["insert"], "in npm;", insert, "in PyPI; the two circles in dxf at x =", npm["middles"])
sys.exit(not (found == {"npm": (True, 5, -340, [(1, 2), (3, 4)]), "PyPI": (True, 5, -340, [])}
              and npm["insert"] == -1 and insert == "KeyError 210" and npm["middles"] == [5, -5]))
PYTHON
"$folder/venv/bin/python" try.py
