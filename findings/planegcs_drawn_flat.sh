#!/usr/bin/env bash
# @salusoft89/planegcs 1.3.0 (npm; FreeCAD's sketch solver): bars drawn in one line are in conflict with one another, though they fit.
#
# Two bars of 1 between pins 1.5 apart make a triangle. Drawn with the middle pin anywhere off the line of the pins they are solved, with 0
# degrees of freedom. Drawn with all pins in one line, a natural first sketch, both lengths are returned as conflicting, 1 degree of freedom is
# reported and nothing moves: at that pose the two equations have rank 1, and the solver takes the rank there for that of the sketch.
# Three bars of 1, 1.5 and 1 on a base of 3 (a four-bar) are refused in the same way, with 2 degrees of freedom. Where the bars are stuck in
# that line, between pins 2 apart, one length is called redundant, as if the middle pin could do without it.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
npm init --yes > /dev/null
npm install --silent --no-audit --no-fund @salusoft89/planegcs@1.3.0
cat > "$folder/try.mjs" <<'JAVASCRIPT'
import { readFileSync } from 'node:fs';
import { make_gcs_wrapper } from '@salusoft89/planegcs';

const solver = await make_gcs_wrapper();
let right = true;

/** Pins at the given places, the first and the last fixed, and bars between neighbours. */
function look(name, pins, bars, expected) {
  solver.clear_data();
  const points = pins.map(([x, y], at) => ({ id: `pin${at}`, type: 'point', x, y, fixed: at === 0 || at === pins.length - 1 }));
  const lengths = bars.map((distance, at) =>
    ({ id: `bar${at}`, type: 'p2p_distance', p1_id: `pin${at}`, p2_id: `pin${at + 1}`, distance }));
  solver.push_primitives_and_params([...points, ...lengths]);
  const status = solver.solve();
  solver.apply_solution();
  const places = solver.sketch_index.get_primitives().filter(({ type }) => type === 'point');
  const gaps = bars.map((length, at) =>
    Math.abs(Math.hypot(places[at + 1].x - places[at].x, places[at + 1].y - places[at].y) - length));
  const seen = [status === 0, solver.gcs.dof(), solver.get_gcs_conflicting_constraints().length,
    solver.get_gcs_redundant_constraints().length, Math.max(...gaps) < 1e-6];
  console.log(`${name}: solved ${seen[0]}, degrees of freedom ${seen[1]}, conflicting ${seen[2]}, redundant ${seen[3]}, lengths hold ${seen[4]}`);
  right &&= JSON.stringify(seen) === JSON.stringify(expected);
}

look('triangle, drawn 0.1 off the line', [[0, 0], [1, 0.1], [1.5, 0]], [1, 1], [true, 0, 0, 0, true]);
look('triangle, drawn in one line', [[0, 0], [1, 0], [1.5, 0]], [1, 1], [false, 1, 2, 0, false]);
look('four-bar, drawn off the line', [[0, 0], [1, 0.1], [2, 0.1], [3, 0]], [1, 1.5, 1], [true, 1, 0, 0, true]);
look('four-bar, drawn in one line', [[0, 0], [1, 0], [2, 0], [3, 0]], [1, 1.5, 1], [false, 2, 3, 0, false]);
look('bars stuck in one line', [[0, 0], [1, 0], [2, 0]], [1, 1], [true, 1, 0, 1, true]);
console.log('version:', JSON.parse(readFileSync('node_modules/@salusoft89/planegcs/package.json', 'utf8')).version);
process.exit(right ? 0 : 1);
JAVASCRIPT
node "$folder/try.mjs" | grep -v '^$' | grep -v '^Sketcher'
