// Pages of the program against what its other commands say: `kutzbach trace` for the poses, and roles for what stays.
import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { hold, openBrowser, pageData, withPage } from "./browser.mjs";

const directory = process.env.KUTZBACH_PAGES;
const traces = directory ? readdirSync(directory).filter((name) => name.endsWith(".trace.json")).sort() : [];

let browser;
before(async () => (browser = await openBrowser()));
after(() => browser.close());

/** The angle between two rotations (rad); a quaternion and its negative are the same. */
function angle(a, b) {
  const along = Math.abs(a.reduce((sum, x, i) => sum + x * b[i], 0));
  return 2 * Math.acos(Math.min(1, along));
}

for (const file of traces) {
  const [name, branch] = file.split(".");
  test(`scrubbing ${name} along branch ${branch} shows the poses of the trace`, async () => {
    const trace = JSON.parse(readFileSync(join(directory, file), "utf8"));
    const data = pageData(name);
    const index = data.branches.findIndex((own) => own.name === branch);
    await withPage(browser, name, {}, async (page) => {
      await hold(page);
      await page.evaluate((b) => window.kutzbach.switchBranch(b), index);
      const { motion } = await page.evaluate(() => window.kutzbach.state());
      const shown = data.motions[motion].arclengths;
      const [first, last] = [shown[0], shown[shown.length - 1]];
      let compared = 0;
      for (const sample of trace.samples) {
        // What goes on and on is not shown all the way.
        if (sample.arclength < first || sample.arclength > last) continue;
        const links = await page.evaluate((s) => (window.kutzbach.scrub(s), window.kutzbach.links()), sample.arclength);
        links.forEach((drawn, link) => {
          const { position, quaternion } = sample.links[link];
          const off = Math.hypot(...position.map((x, i) => x - drawn[i]));
          const lever = Math.hypot(...(data.links[link].origin ?? [0]));
          assert.ok(off < 1e-3 * data.extent + 1e-6 * lever, `${data.links[link].name} at ${sample.arclength}: ${off} m off`);
          assert.ok(angle(quaternion, drawn.slice(3)) < 2e-3, `${data.links[link].name} at ${sample.arclength} is turned`);
        });
        compared += 1;
      }
      assert.ok(compared > 5, `${compared} poses compared`);
    });
  });
}

test("a locked joint stays", { skip: !directory }, async () => {
  const data = pageData("locked");
  const { roles, arclengths } = data.motions[0];
  const locked = data.joints.flatMap((joint, i) => (roles.joints[i] === "locked" ? [joint] : []));
  assert.ok(locked.length > 0);
  await withPage(browser, "locked", {}, async (page) => {
    await hold(page);
    const places = [0, 0.2, 0.45, 0.7, 0.9].map((share) => arclengths[Math.round(share * (arclengths.length - 1))]);
    const seen = [];
    for (const s of places) {
      seen.push(await page.evaluate((at) => (window.kutzbach.scrub(at), window.kutzbach.state().values), s));
    }
    const columns = new Set(locked.flatMap(({ first, variables }) => variables.map((_, i) => first + i)));
    for (const column of columns) {
      for (const values of seen) assert.ok(Math.abs(values[column] - seen[0][column]) < 1e-6);
    }
    const moved = seen[0].some((x, column) => !columns.has(column) && Math.abs(x - seen[2][column]) > 0.1);
    assert.ok(moved, "nothing else moves either");
  });
});

// Figures of time are told, not judged: a busy machine is no fault of the page. A picture that stands still is.
test("sixty links and a hundred stages move", { skip: !directory }, async () => {
  for (const name of ["bennett", "large", "hundred_stages"]) {
    await withPage(browser, name, {}, async (page) => {
      const first = await page.evaluate(() => window.kutzbach.firstFrame());
      await page.evaluate(() => window.kutzbach.play());
      await new Promise((resolve) => setTimeout(resolve, 2500));
      const rate = await page.evaluate(() => window.kutzbach.framesPerSecond());
      console.log(`${name}: first picture after ${first.toFixed(0)} ms, ${rate.toFixed(0)} pictures a second`);
      assert.ok(rate > 1);
    });
  }
});
