// The parts that need no browser.
import assert from "node:assert/strict";
import { test } from "node:test";
import { source } from "./sources.mjs";

const { decodeFloats } = await source("base64.ts");
const { naturalOrder } = await source("natural_order.ts");
const { fourDigits, decimals, readNumber } = await source("number_text.ts");
const { readAxis, valueAt, pixelAt } = await source("plot_axis.ts");
const { Track, seamOfPoses, seamOfValues } = await source("track.ts");
const { nearestSample } = await source("nearest_sample.ts");
const { hit } = await source("stage/picking.ts");
const { rotationOf, quaternionOf } = await source("stage/rotation.ts");
const { roundLength } = await source("stage/floor.ts");
const { nearestVertex } = await source("plots.ts");
const { neededPoints } = await source("stage/paths.ts");
const { rgb, hex, onPage } = await source("colours.ts");
const { numericOrder } = await source("tables.ts");
const { isFound, familiesOf } = await source("gallery.ts");

test("base64 gives back little-endian floats", () => {
  const numbers = [0, -1.5, Math.fround(Math.PI), 2 ** 100, -0];
  const bytes = Buffer.alloc(20);
  numbers.forEach((x, i) => bytes.writeFloatLE(x, 4 * i));
  assert.deepEqual([...decodeFloats(bytes.toString("base64"))], numbers);
});

test("natural order counts digits as numbers", () => {
  const sorted = ["J10", "j2", "J1", "a", "", "J02", "J1b", "Z"].sort(naturalOrder);
  assert.deepEqual(sorted, ["", "a", "J1", "J1b", "j2", "J02", "J10", "Z"]);
  assert.ok(naturalOrder("x99999999999999999998", "x99999999999999999999") < 0);
});

test("natural order is an order", () => {
  const texts = ["a1", "A1", "a01", "a", "1", "01", "10", "b2c3", "b2c10", "é"];
  for (const a of texts) {
    assert.equal(naturalOrder(a, a), 0);
    for (const b of texts) {
      assert.equal(Math.sign(naturalOrder(a, b)), -Math.sign(naturalOrder(b, a)) + 0, `${a} ${b}`);
      for (const c of texts) {
        if (naturalOrder(a, b) < 0 && naturalOrder(b, c) < 0) assert.ok(naturalOrder(a, c) < 0, `${a} ${b} ${c}`);
      }
    }
  }
});

test("numbers as text and back", () => {
  assert.equal(fourDigits(-1234.567), "\u22121235");
  assert.equal(fourDigits(0), "0");
  assert.equal(fourDigits(1.25e-7), "1.250 × 10⁻⁷");
  assert.equal(decimals(-0.0001, 2), "0.00");
  assert.equal(readNumber("\u22122.5 rad"), -2.5);
  assert.equal(readNumber("1e-3"), 1e-3);
  assert.ok(Number.isNaN(readNumber("–")));
});

test("cells without a number come last in both directions", () => {
  for (const sign of [1, -1]) {
    assert.deepEqual([NaN, 3, 1, NaN, 2].sort((a, b) => numericOrder(a, b, sign)).slice(3), [NaN, NaN]);
  }
});

test("axes are inverted, also logarithmic ones", () => {
  for (const text of ["-2 6 linear 50 430", "1e-12 1 log 200 20"]) {
    const axis = readAxis(text);
    for (const pixel of [50, 111, 200]) assert.ok(Math.abs(pixelAt(axis, valueAt(axis, pixel)) - pixel) < 1e-9);
    assert.equal(valueAt(axis, axis.from), axis.least);
  }
  for (const bad of [null, "", "1 2 linear 3", "0 1 log 0 1", "a b linear 1 2"]) assert.equal(readAxis(bad), null);
});

test("a track passes its samples and keeps parabolas", () => {
  // Any parabola is followed exactly between the inner samples, however unevenly they lie.
  const times = Float32Array.from([0, 0.5, 0.75, 2, 3, 3.25]);
  const at = (t) => 2 - 3 * t + 0.5 * t * t;
  const track = new Track(times, Float32Array.from(times, at), 1, null);
  const out = new Float64Array(1);
  for (const t of times) {
    track.at(t, out);
    assert.equal(out[0], Math.fround(at(t)));
  }
  for (let t = 0; t < 3.25; t += 0.01) {
    track.at(t, out);
    assert.ok(Math.abs(out[0] - at(t)) < 1e-5, `at ${t}: ${out[0]} ${at(t)}`);
  }
});

test("a closed track is as smooth over its seam as elsewhere", () => {
  const count = 24;
  const times = Float32Array.from({ length: count + 1 }, (_, i) => (2 * Math.PI * i) / count);
  const rows = Float32Array.from([...times].flatMap((t) => [t + 0.3 * Math.sin(t), 5]));
  const track = new Track(times, rows, 2, seamOfValues(rows, 2));
  const out = new Float64Array(2);
  let worst = 0;
  for (let t = 0; t <= 2 * Math.PI; t += 0.003) {
    track.at(t, out);
    worst = Math.max(worst, Math.abs(out[0] - t - 0.3 * Math.sin(t)));
  }
  assert.ok(worst < 2e-4, String(worst));
  assert.ok(Math.abs(track.slope(0, 0) - track.slope(count, 0)) < 1e-5);
});

test("a quaternion that comes back with the other sign closes smoothly", () => {
  const count = 36;
  const times = Float32Array.from({ length: count + 1 }, (_, i) => i / count);
  const pose = (t) => [0, 0, 0, Math.cos(Math.PI * t), 0, 0, Math.sin(Math.PI * t)];
  const rows = Float32Array.from([...times].flatMap(pose));
  const track = new Track(times, rows, 7, seamOfPoses(rows, 7));
  const out = new Float64Array(7);
  for (let t = 0; t <= 1; t += 0.001) {
    track.at(t, out);
    assert.ok(pose(t).every((x, c) => Math.abs(x - out[c]) < 1e-4));
  }
});

test("samples that fall together do no harm", () => {
  const track = new Track(Float32Array.from([0, 1, 1, 2]), Float32Array.from([0, 1, 1, 2]), 1, null);
  const out = new Float64Array(1);
  for (let t = -0.5; t <= 2.5; t += 0.125) {
    track.at(t, out);
    assert.ok(Number.isFinite(out[0]) && out[0] >= 0 && out[0] <= 2);
  }
});

test("the nearest sample knows both signs of a quaternion", () => {
  const poses = Float32Array.from([0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 3, 0, 0, 1, 0, 0, 0]);
  assert.equal(nearestSample({ poses }, Float64Array.from([0.1, 0, 0, 0, -1, 0, 0]), 1), 1);
});

test("rotations go to quaternions and back", () => {
  for (const q of [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0.6, 0.8], [0.5, -0.5, 0.5, -0.5], [0.1, 0.7, -0.7, 0.1]]) {
    const norm = Math.hypot(...q);
    const unit = q.map((x) => x / norm);
    const matrix = new Float64Array(9);
    rotationOf(unit, 0, matrix);
    const back = quaternionOf(matrix);
    const dot = unit.reduce((sum, x, i) => sum + x * back[i], 0);
    assert.ok(Math.abs(Math.abs(dot) - 1) < 1e-12);
  }
});

test("solids are hit where they are", () => {
  // A rod of radius 0.1 and length 2 along x, at (0, 0, 5).
  const rod = [0, 0, -0.2, 0, 0, 0.2, 0, 0, 2, 0, 0, 0, 0, 0, 5, 1];
  const down = (x, y) => ({ origin: [x, y, 0], direction: [0, 0, 1] });
  assert.ok(Math.abs(hit(down(0.9, 0), "cylinder", rod, 0) - 4.9) < 1e-12);
  assert.equal(hit(down(1.1, 0), "cylinder", rod, 0), null);
  assert.equal(hit(down(0, 0.15), "cylinder", rod, 0), null);
  assert.notEqual(hit(down(0, 0.15), "cylinder", rod, 0.1), null);
  const ball = [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 5, 1];
  assert.ok(Math.abs(hit(down(0, 0), "sphere", ball, 0) - 4) < 1e-12);
  assert.equal(hit({ origin: [0, 0, 10], direction: [0, 0, 1] }, "sphere", ball, 0), null);
  assert.equal(hit(down(0.8, 0.8), "sphere", ball, 0), null);
  assert.notEqual(hit(down(0.8, 0.8), "box", ball, 0), null);
});

test("grids have round cells", () => {
  assert.deepEqual([0.0123, 0.3, 1.2, 4.1, 88].map(roundLength), [0.01, 0.2, 1, 5, 100]);
  assert.equal(roundLength(0), 1);
});

test("the nearest vertex must be within reach", () => {
  const vertices = [{ x: 0, y: 0, name: "a" }, { x: 10, y: 0, name: "b" }];
  assert.equal(nearestVertex(vertices, 6, 0, 5).name, "b");
  assert.equal(nearestVertex(vertices, 6, 50, 5), null);
});

test("paths leave out what lies on a line, and keep their ends and corners", () => {
  const straight = Float64Array.from({ length: 30 }, (_, i) => (i % 3 === 0 ? i / 30 : 0));
  assert.deepEqual(neededPoints(straight), [0, 9]);
  const corner = Float64Array.from([0, 0, 0, 0.5, 0, 0, 1, 0, 0, 1, 0.5, 0, 1, 1, 0]);
  assert.deepEqual(neededPoints(corner), [0, 2, 4]);
  // There and back again: the turning point is kept.
  assert.deepEqual(neededPoints(Float64Array.from([0, 0, 0, 1, 0, 0, 2, 0, 0, 1, 0, 0])), [0, 2, 3]);
});

test("colours", () => {
  assert.deepEqual(rgb("#fff"), [1, 1, 1]);
  assert.equal(hex(rgb(" #2EA847 ")), "#2ea847");
  assert.equal(hex(rgb("red")), "#808080");
  assert.ok(onPage("#101010", true)[0] > 0.3);
  assert.equal(hex(onPage("#101010", false)), "#101010");
});

test("the picture turns about the axis that stands upright", async () => {
  const { Vector3, pole } = await source("stage/framing.ts", 'export { Vector3 } from "three";');
  const turned = (view, up) => pole(new Vector3(...view).normalize(), new Vector3(...up).normalize()).toArray();
  // Up is given at right angles to the view.
  const view = [0.52, -0.72, 0.46];
  const square = view.reduce((sum, x) => sum + x * x, 0);
  const up = [0, 0, 1].map((x, i) => x - (view[2] / square) * view[i]);
  assert.deepEqual(turned(view, up), [0, 0, 1]);
  assert.deepEqual(turned([0, 0, 1], [0, 1, 0]), [0, 1, 0]);
  const leaning = turned([0, 0, 1], [1, 1, 0]);
  assert.ok(Math.abs(leaning[0] - Math.SQRT1_2) < 1e-12 && leaning[2] === 0);
});

test("a gallery is narrowed by words and families", () => {
  const card = { text: "bennett mobile: 1 degree of freedom", families: ["one loop", "paradoxical"] };
  assert.ok(isFound(card, "", new Set()));
  assert.ok(isFound(card, " Free  benn", new Set(["one loop"])));
  assert.ok(!isFound(card, "benn rigid", new Set()));
  assert.ok(!isFound(card, "benn", new Set(["one loop", "four-bar"])));
});

test("families that narrow nothing are not offered", () => {
  const families = (...all) => ({ families: all });
  const cards = [families("a", "b", "c"), families("a", "b"), families("a", "d", "b"), families("a", "d")];
  assert.deepEqual(familiesOf(cards), [["b", 3], ["d", 2]]);
});
