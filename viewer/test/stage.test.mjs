// The moving picture: what is drawn is where the data says, and it moves as the controls say.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { hold, openBrowser, pageData, poseGap, withPage } from "./browser.mjs";

let browser;
before(async () => (browser = await openBrowser()));
after(() => browser.close());

/** Colours of the canvas by their number of pixels, as drawn now. */
const colours = (page) =>
  page.evaluate(() => {
    window.kutzbach.links();
    const canvas = document.querySelector("#stage canvas");
    const gl = canvas.getContext("webgl2");
    const [width, height] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
    const pixels = new Uint8Array(4 * width * height);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    const counts = new Map();
    let sum = 0;
    for (let i = 0; i < pixels.length; i += 4) {
      const key = (pixels[i] << 16) | (pixels[i + 1] << 8) | pixels[i + 2];
      counts.set(key, (counts.get(key) ?? 0) + 1);
      sum = (sum * 31 + key + i) % 2147483647;
    }
    return { kinds: counts.size, most: Math.max(...counts.values()) / (width * height), sum };
  });

test("the picture is not blank and changes with the motion", async () => {
  await withPage(browser, "four_bar", {}, async (page) => {
    await hold(page);
    const { arclengths } = pageData("four_bar").motions[0];
    await page.evaluate((s) => window.kutzbach.scrub(s), arclengths[0]);
    const first = await colours(page);
    assert.ok(first.kinds > 50, `${first.kinds} colours`);
    assert.ok(first.most < 0.98, `${first.most} of one colour`);
    await page.evaluate((s) => window.kutzbach.scrub(s), arclengths[Math.floor(arclengths.length / 3)]);
    const second = await colours(page);
    assert.notEqual(second.sum, first.sum);
  });
});

for (const name of ["four_bar", "two_branches", "slider", "far", "large"]) {
  test(`links are drawn where the data puts them: ${name}`, async () => {
    const data = pageData(name);
    await withPage(browser, name, {}, async (page) => {
      await hold(page);
      for (let branch = 0; branch < data.branches.length; branch += 1) {
        if (data.branches[branch].motions.length === 0) continue;
        await page.evaluate((b) => window.kutzbach.switchBranch(b), branch);
        const { motion: index } = await page.evaluate(() => window.kutzbach.state());
        const motion = data.motions[index];
        assert.equal(motion.branch, branch);
        for (let sample = 0; sample < motion.samples; sample += 7) {
          const { drawn, state } = await page.evaluate((s) => {
            window.kutzbach.scrub(s);
            return { drawn: window.kutzbach.links(), state: window.kutzbach.state() };
          }, motion.arclengths[sample]);
          const gap = poseGap(drawn, motion.poseOf(sample));
          // Single precision twice, in the data and in the matrices; of frames far away the rotation has a long lever.
          const lever = Math.max(...data.links.map(({ origin }) => Math.hypot(...(origin ?? [0]))));
          const rounding = 1e-6 * (data.extent + lever) + 4e-16 * Math.hypot(...data.centre);
          assert.ok(gap.place < rounding, `sample ${sample}: ${gap.place} m`);
          assert.ok(gap.turn < 2e-6, `sample ${sample}: ${gap.turn}`);
          assert.equal(state.samplePosition, sample);
          const columns = state.values.length;
          assert.deepEqual(state.values, motion.values.slice(sample * columns, (sample + 1) * columns));
        }
      }
    });
  });
}

test("between samples links stay close to the curve", async () => {
  const data = pageData("four_bar");
  const [motion] = data.motions;
  await withPage(browser, "four_bar", {}, async (page) => {
    await hold(page);
    // Half way, the cubic through four evenly spaced samples leaves the chord by a sixteenth of the bend; a quarter
    // leaves room for samples that are not evenly spaced.
    for (let sample = 1; sample + 2 < motion.samples; sample += 9) {
      const middle = (motion.arclengths[sample] + motion.arclengths[sample + 1]) / 2;
      const drawn = await page.evaluate((s) => (window.kutzbach.scrub(s), window.kutzbach.links()), middle);
      const rows = [-1, 0, 1, 2].map((i) => motion.poseOf(sample + i));
      drawn.forEach((pose, link) => {
        for (let i = 0; i < 3; i += 1) {
          const [a, b, c, d] = rows.map((row) => row[link][i]);
          const straight = (b + c) / 2;
          const bend = Math.abs(a - b - c + d);
          assert.ok(Math.abs(pose[i] - straight) <= 0.25 * bend + 1e-6 * data.extent, `sample ${sample} link ${link}`);
        }
        const norm = Math.hypot(...pose.slice(3));
        assert.ok(Math.abs(norm - 1) < 1e-6);
      });
    }
  });
});

test("switching the branch at a crossing does not jump", async () => {
  const data = pageData("two_branches");
  await withPage(browser, "two_branches", {}, async (page) => {
    await hold(page);
    const { motion: index, branch } = await page.evaluate(() => window.kutzbach.state());
    const crossing = data.motions[index].events.find((event) => event.home && /bifurcation|tangential/.test(event.kind));
    const before = await page.evaluate((s) => (window.kutzbach.scrub(s), window.kutzbach.links()), crossing.arclength);
    await page.waitForFunction(() => document.querySelector("#controls .hint .way") !== null);
    await page.click("#controls .hint .way");
    const after = await page.evaluate(() => ({ links: window.kutzbach.links(), state: window.kutzbach.state() }));
    assert.notEqual(after.state.branch, branch);
    assert.ok(poseGap(before, after.links).place < 1e-5 * data.extent);
    // Moving on, the branches part.
    const [here, there] = [data.motions[index], data.motions[after.state.motion]];
    const on = (motion) => Math.min(motion.samples - 1, Math.floor(motion.samples / 4));
    assert.ok(poseGap(here.poseOf(on(here)), there.poseOf(on(there))).place > 0.01 * data.extent);
  });
});

test("another driven joint takes over the role and the read-out", async () => {
  const data = pageData("four_bar");
  await withPage(browser, "four_bar", {}, async (page) => {
    await hold(page);
    const jointOf = (column) => data.joints.findIndex((j) => column >= j.first && column < j.first + j.variables.length);
    const [usual, other] = data.motions[0].drives;
    const before = await page.evaluate(() => window.kutzbach.colours());
    assert.equal(before.joints[jointOf(usual)], data.palette.driven);
    await page.evaluate((column) => window.kutzbach.drive(column), other);
    const after = await page.evaluate(() => window.kutzbach.colours());
    assert.equal(after.joints[jointOf(other)], data.palette.driven);
    assert.equal(after.joints[jointOf(usual)], data.palette.moving_joint);
    assert.deepEqual(after.links, before.links);
    const readout = await page.$eval(".readout .name", (node) => node.textContent);
    assert.equal(readout, data.joints[jointOf(other)].name);
  });
});

test("dead centres are marked for the driven variable only", async () => {
  const data = pageData("four_bar");
  await withPage(browser, "four_bar", {}, async (page) => {
    for (const column of data.motions[0].drives) {
      await page.evaluate((c) => window.kutzbach.drive(c), column);
      const shown = await page.$$eval(".ticks .tick", (ticks) => ticks.length);
      const { events } = data.motions[0];
      assert.equal(shown, events.filter((event) => event.kind !== "dead_centre" || event.column === column).length);
    }
  });
});

test("it plays by itself, in time, and stops at the end when asked to", async () => {
  await withPage(browser, "slider", {}, async (page) => {
    await page.waitForFunction(() => window.kutzbach.state().playing, { timeout: 5000 });
    const from = await page.evaluate(() => window.kutzbach.state().arclength);
    await page.waitForFunction((s) => Math.abs(window.kutzbach.state().arclength - s) > 0.01, {}, from);
    await page.select(".options label.selection:nth-of-type(2) select", "once");
    await page.click('.segments input[aria-label="Speed 4"]');
    await page.waitForFunction(() => !window.kutzbach.state().playing, { timeout: 15000 });
    const { motions } = pageData("slider");
    const end = await page.evaluate(() => window.kutzbach.state().arclength);
    assert.equal(end, motions[0].arclengths[motions[0].samples - 1]);
  });
});

test("reduced motion does not play by itself", async () => {
  const features = [{ name: "prefers-reduced-motion", value: "reduce" }];
  await withPage(browser, "four_bar", { features }, async (page) => {
    await new Promise((resolve) => setTimeout(resolve, 600));
    const { playing } = await page.evaluate(() => window.kutzbach.state());
    assert.equal(playing, false);
    await page.click("#controls .play");
    assert.equal((await page.evaluate(() => window.kutzbach.state())).playing, true);
  });
});

test("what does not move says so and can be turned", async () => {
  const data = pageData("still");
  await withPage(browser, "still", {}, async (page) => {
    const text = await page.$eval("#controls .hint", (node) => node.textContent);
    assert.ok(text.includes(data.still));
    const before = await colours(page);
    const box = await (await page.$("#stage canvas")).boundingBox();
    await page.mouse.move(box.x + 40, box.y + 40);
    await page.mouse.down();
    await page.mouse.move(box.x + 160, box.y + 60, { steps: 4 });
    await page.mouse.up();
    await page.waitForFunction(() => window.kutzbach.framesPerSecond() >= 0);
    const after = await colours(page);
    assert.notEqual(after.sum, before.sum);
    const links = await page.evaluate(() => window.kutzbach.links());
    const home = data.home.map((pose) => pose.map((x, i) => (i < 3 ? x + data.centre[i] : x)));
    assert.ok(poseGap(links, home).place < 1e-6 * data.extent);
  });
});

test("dark pages have a dark stage", async () => {
  const features = [{ name: "prefers-color-scheme", value: "dark" }];
  await withPage(browser, "four_bar", { features }, async (page) => {
    const corner = () =>
      page.evaluate(() => {
        window.kutzbach.links();
        const gl = document.querySelector("#stage canvas").getContext("webgl2");
        const pixel = new Uint8Array(4);
        gl.readPixels(1, gl.drawingBufferHeight - 2, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
        return pixel[0] + pixel[1] + pixel[2];
      });
    assert.ok((await corner()) < 200);
    await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: "light" }]);
    // The page hears of the change, and draws, in its own time.
    let bright = 0;
    for (let look = 0; look < 50 && bright <= 600; look += 1) {
      await new Promise((resolve) => setTimeout(resolve, 100));
      bright = await corner();
    }
    assert.ok(bright > 600, `${bright}`);
  });
});

test("without WebGL the sketch stays and all else works", async () => {
  const plain = await openBrowser({ webgl: false });
  try {
    await withPage(plain, "four_bar", {}, async (page) => {
      const seen = await page.evaluate(() => ({
        canvas: document.querySelector("#stage canvas") !== null,
        sketch: document.querySelector("#stage svg.sketch").getBoundingClientRect().height,
        note: document.querySelector("#controls .note")?.textContent ?? "",
        webgl: window.kutzbach.state().webgl,
      }));
      assert.equal(seen.canvas, false);
      assert.equal(seen.webgl, false);
      assert.ok(seen.sketch > 50);
      assert.match(seen.note, /3D/);
      await hold(page);
      const { arclengths } = pageData("four_bar").motions[0];
      await page.evaluate((s) => window.kutzbach.scrub(s), arclengths[5]);
      const links = await page.evaluate(() => window.kutzbach.links());
      assert.ok(poseGap(links, pageData("four_bar").motions[0].poseOf(5)).place < 1e-6 * pageData("four_bar").extent);
    });
  } finally {
    await plain.close();
  }
});
