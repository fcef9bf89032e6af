// What is around the picture: tables, plots, links between words and picture, keys, and pages of every width.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { hold, openBrowser, pageData, withPage } from "./browser.mjs";

let browser;
before(async () => (browser = await openBrowser()));
after(() => browser.close());

const column = (page, selector, index) =>
  page.$$eval(
    `${selector} tbody tr`,
    (rows, i) => rows.map((row) => row.cells[i].getAttribute("data-value") ?? row.cells[i].textContent.trim()),
    index,
  );

test("tables are sorted both ways and back", async () => {
  await withPage(browser, "large", {}, async (page) => {
    const tables = await page.$$eval("table.sortable", (all) => all.map((_, i) => i));
    assert.ok(tables.length > 0);
    const headings = await page.$$eval("#joints table.sortable th[data-sort]", (all) =>
      all.map((th) => ({ index: th.cellIndex, kind: th.getAttribute("data-sort") })),
    );
    for (const { index, kind } of headings) {
      const first = await column(page, "#joints table.sortable", index);
      const press = () => page.click(`#joints table.sortable th:nth-child(${index + 1}) button.sort`);
      await press();
      const up = await column(page, "#joints table.sortable", index);
      assert.deepEqual([...up].sort(), [...first].sort());
      if (kind === "number") {
        const numbers = up.map((text) => Number.parseFloat(text.replace("\u2212", "-"))).filter(Number.isFinite);
        numbers.forEach((x, i) => assert.ok(i === 0 || numbers[i - 1] <= x));
      } else {
        // J2 before J10.
        const collator = new Intl.Collator("en", { numeric: true });
        up.forEach((text, i) => assert.ok(i === 0 || collator.compare(up[i - 1], text) <= 0, `${up[i - 1]} ${text}`));
      }
      await press();
      const down = await column(page, "#joints table.sortable", index);
      assert.deepEqual([...down].sort(), [...first].sort());
      await press();
      assert.deepEqual(await column(page, "#joints table.sortable", index), first);
    }
  });
});

test("words light the picture", async () => {
  await withPage(browser, "four_bar", {}, async (page) => {
    await hold(page);
    const picture = () =>
      page.evaluate(() => {
        window.kutzbach.links();
        return document.querySelector("#stage canvas").toDataURL();
      });
    const plain = await picture();
    await page.evaluate(() => document.querySelector("#joints tr[data-joint='1']").scrollIntoView({ block: "center" }));
    await page.hover("#joints tr[data-joint='1']");
    await page.waitForSelector("#joints tr[data-joint='1'].lit");
    assert.ok((await page.$$("#graph [data-joint='1'].lit")).length > 0);
    assert.equal((await page.$$("[data-joint='0'].lit")).length, 0);
    assert.notEqual(await picture(), plain);
    await page.hover("h1");
    await page.waitForFunction(() => document.querySelector(".lit") === null);
  });
});

test("a loop lights itself and its joints", async () => {
  const data = pageData("four_bar");
  await withPage(browser, "four_bar", {}, async (page) => {
    // By focus: under the pointer there may be one of its joints, which then lights alone.
    await page.focus("[data-cycle='0']");
    await page.waitForSelector("[data-cycle='0'].lit");
    for (const joint of data.cycles[0].joints) assert.ok((await page.$$(`#joints [data-joint='${joint}'].lit`)).length > 0);
  });
});

test("rows light by keyboard, one stop of the tab key for each table", async () => {
  await withPage(browser, "four_bar", {}, async (page) => {
    assert.equal((await page.$$("#joints table [tabindex='0']")).length, 1);
    await page.focus("#joints tbody tr:nth-child(1)");
    await page.waitForSelector("#joints tbody tr:nth-child(1).lit");
    await page.keyboard.press("ArrowDown");
    await page.waitForSelector("#joints tbody tr:nth-child(2).lit");
  });
});

test("the picture lights words and tells what it is", async () => {
  const data = pageData("four_bar");
  await withPage(browser, "four_bar", {}, async (page) => {
    await hold(page);
    const box = await (await page.$("#stage canvas")).boundingBox();
    const met = new Set();
    for (let y = 12; y < box.height && met.size < 3; y += 9) {
      for (let x = 12; x < box.width; x += 16) {
        await page.mouse.move(box.x + x, box.y + y);
        const seen = await page.evaluate(() => {
          const lit = [...document.querySelectorAll("section .lit")];
          const tip = document.querySelector(".tooltip");
          return lit.length === 0
            ? null
            : {
                joint: lit[0].closest("[data-joint]")?.getAttribute("data-joint") ?? null,
                link: lit[0].closest("[data-link]")?.getAttribute("data-link") ?? null,
                tip: tip.hidden ? null : tip.textContent,
              };
        });
        if (seen === null) continue;
        const name = seen.joint === null ? data.links[seen.link].name : data.joints[seen.joint].name;
        assert.ok(seen.tip?.startsWith(name), `${seen.tip} for ${name}`);
        if (seen.joint !== null) assert.ok(seen.tip.includes(data.joints[seen.joint].kind));
        met.add(seen.joint === null ? "link" : "joint");
      }
      if (met.size === 2) break;
    }
    assert.deepEqual([...met].sort(), ["joint", "link"]);
  });
});

test("plots follow the motion and show their values", async () => {
  const data = pageData("four_bar");
  const [motion] = data.motions;
  await withPage(browser, "four_bar", {}, async (page) => {
    await hold(page);
    const plot = ".motion-plots[data-motion='0'] svg.plot[data-follows='arclength']";
    await page.$eval(plot, (svg) => svg.scrollIntoView({ block: "center" }));
    await page.evaluate((s) => window.kutzbach.scrub(s), motion.arclengths[40]);
    await page.waitForFunction(
      ({ plot, s }) => {
        const svg = document.querySelector(plot);
        const [low, high, , left, right] = svg.getAttribute("data-x").split(" ").map(Number);
        const wanted = left + ((right - left) * (s - low)) / (high - low);
        return Math.abs(Number(svg.querySelector(".cursor").getAttribute("x1")) - wanted) < 0.1;
      },
      {},
      { plot, s: motion.arclengths[40] },
    );
    // Over a corner of a line, its value shows.
    const corner = await page.$eval(`${plot} polyline.series`, (line) => {
      const svg = line.ownerSVGElement;
      const point = line.points[Math.floor(line.points.length / 4)];
      const [low, high, , bottom, top] = svg.getAttribute("data-y").split(" ").map(Number);
      const place = new DOMPoint(point.x, point.y).matrixTransform(svg.getScreenCTM());
      const value = low + ((high - low) * (point.y - bottom)) / (top - bottom);
      return { x: place.x, y: place.y, value, name: line.getAttribute("data-name"), unit: line.getAttribute("data-unit") };
    });
    await page.mouse.move(corner.x, corner.y);
    const tip = await page.$eval(".tooltip", (node) => (node.hidden ? [] : [...node.children].map((line) => line.textContent)));
    assert.equal(tip[0], corner.name);
    const shown = Number.parseFloat(tip[1].replace("\u2212", "-"));
    assert.ok(Math.abs(shown - corner.value) <= 6e-4 * Math.abs(corner.value) + 1e-9, `${tip[1]} for ${corner.value}`);
    assert.ok(tip[1].endsWith(corner.unit));
    // A press in the plot goes there.
    const before = await page.evaluate(() => window.kutzbach.state().arclength);
    await page.mouse.click(corner.x + 60, corner.y);
    const after = await page.evaluate(() => window.kutzbach.state().arclength);
    assert.ok(after !== before);
  });
});

test("only the plots of the motion shown are shown", async () => {
  await withPage(browser, "two_branches", {}, async (page) => {
    const visible = () =>
      page.$$eval(".motion-plots[data-motion]", (all) => all.filter((one) => !one.hidden).map((one) => Number(one.dataset.motion)));
    assert.deepEqual(await visible(), [await page.evaluate(() => window.kutzbach.state().motion)]);
    await page.evaluate(() => window.kutzbach.switchBranch(1));
    assert.deepEqual(await visible(), [await page.evaluate(() => window.kutzbach.state().motion)]);
  });
});

test("a branch that is not followed says why", async () => {
  const data = pageData("two_branches");
  const index = data.branches.findIndex((branch) => branch.motions.length === 0 && branch.still !== null);
  if (index < 0) return;
  await withPage(browser, "two_branches", {}, async (page) => {
    await page.evaluate((i) => window.kutzbach.switchBranch(i), index);
    assert.ok((await page.$eval(".hint", (node) => node.textContent)).includes(data.branches[index].still));
    await page.evaluate(() => window.kutzbach.switchBranch(0));
    assert.equal((await page.evaluate(() => window.kutzbach.state())).branch, 0);
  });
});

test("keys", async () => {
  await withPage(browser, "two_branches", {}, async (page) => {
    await hold(page);
    const state = () => page.evaluate(() => window.kutzbach.state());
    await page.focus("#stage canvas");
    await page.keyboard.press("Space");
    assert.equal((await state()).playing, true);
    await page.keyboard.press("Space");
    assert.equal((await state()).playing, false);
    await page.keyboard.press("Home");
    const start = await state();
    await page.keyboard.press("ArrowRight");
    assert.ok((await state()).arclength > start.arclength);
    await page.keyboard.press("ArrowLeft");
    await page.keyboard.press("Home");
    assert.equal((await state()).arclength, start.arclength);
    await page.keyboard.press("]");
    assert.equal((await state()).branch, 1);
    await page.keyboard.press("[");
    assert.equal((await state()).branch, 0);
    const picture = () => page.$eval("#stage canvas", (canvas) => (window.kutzbach.links(), canvas.toDataURL()));
    const before = await picture();
    await page.keyboard.press("+");
    await new Promise((resolve) => setTimeout(resolve, 300));
    const nearer = await picture();
    assert.notEqual(nearer, before);
    await page.keyboard.down("Shift");
    await page.keyboard.press("ArrowUp");
    await page.keyboard.up("Shift");
    await new Promise((resolve) => setTimeout(resolve, 300));
    assert.notEqual(await picture(), nearer);
    await page.focus(".scrubber");
    const { arclength } = await state();
    await page.keyboard.press("ArrowRight");
    assert.ok((await state()).arclength > arclength);
    assert.match(await page.$eval(".scrubber", (input) => input.getAttribute("aria-valuetext")), / = .*rad/);
  });
});

test("every control has a name", async () => {
  await withPage(browser, "two_branches", {}, async (page) => {
    const nameless = await page.$$eval("#controls button, #controls input, #controls select, #stage canvas", (all) =>
      all
        .filter((one) => !(one.getAttribute("aria-label") || one.textContent.trim() || one.closest("label")?.textContent.trim()))
        .map((one) => one.outerHTML),
    );
    assert.deepEqual(nameless, []);
  });
});

test("names stay text whatever they contain", async () => {
  const data = pageData("hostile");
  await withPage(browser, "hostile", {}, async (page) => {
    await hold(page);
    await page.evaluate(() => {
      for (const details of document.querySelectorAll("details")) details.open = true;
    });
    const box = await (await page.$("#stage canvas")).boundingBox();
    for (let x = 0.2; x < 0.8; x += 0.02) await page.mouse.move(box.x + x * box.width, box.y + 0.55 * box.height);
    assert.equal(await page.evaluate(() => window.harmed), undefined);
    assert.equal(await page.$$eval("#controls img, .tooltip img, body > img", (all) => all.length), 0);
    const { drive } = await page.evaluate(() => window.kutzbach.state());
    const joint = data.joints.find((j) => drive >= j.first && drive < j.first + j.variables.length);
    assert.ok((await page.$eval(".readout .name", (node) => node.textContent)).startsWith(joint.name));
  });
});

for (const name of ["four_bar", "two_branches", "hostile", "large"]) {
  test(`phones need not scroll sideways: ${name}`, async () => {
    await withPage(browser, name, { width: 390, height: 844, phone: true }, async (page) => {
      const { content, window: view } = await page.evaluate(() => ({
        content: document.documentElement.scrollWidth,
        window: window.innerWidth,
      }));
      assert.ok(content <= view && view === 390, `${content} in ${view}`);
      const small = await page.$$eval(
        "#controls .play, #controls .segments > *, #controls select, #controls .way, #controls summary",
        (all) => all.filter((one) => one.checkVisibility() && one.getBoundingClientRect().height < 40).map((one) => one.textContent),
      );
      assert.deepEqual(small, []);
    });
  });
}

test("a tap tells what is under the finger", async () => {
  await withPage(browser, "four_bar", { width: 390, height: 844, phone: true }, async (page) => {
    await hold(page);
    const box = await (await page.$("#stage canvas")).boundingBox();
    let told = null;
    for (let y = 0.2; y < 0.85 && told === null; y += 0.05) {
      for (let x = 0.1; x < 0.9 && told === null; x += 0.08) {
        await page.touchscreen.tap(box.x + x * box.width, box.y + y * box.height);
        told = await page.evaluate(() => (document.querySelector(".lit") === null ? null : document.querySelector(".tooltip").textContent));
      }
    }
    assert.ok(told);
  });
});

test("what was dark is white on paper", async () => {
  const features = [{ name: "prefers-color-scheme", value: "dark" }];
  await withPage(browser, "four_bar", { features }, async (page) => {
    await page.pdf();
    const corner = await page.evaluate(() => {
      const copy = document.querySelector("#stage canvas.copy");
      return [...copy.getContext("2d").getImageData(1, 1, 1, 1).data];
    });
    assert.deepEqual(corner, [255, 255, 255, 255]);
  });
});

test("paper has the picture, the tables and no controls", async () => {
  await withPage(browser, "four_bar", {}, async (page) => {
    await page.emulateMediaType("print");
    const seen = await page.evaluate(() => ({
      stage: [...document.querySelectorAll("#stage canvas")].filter((canvas) => canvas.checkVisibility()).length,
      table: document.querySelector("#joints table").checkVisibility(),
      controls: [...document.querySelectorAll(".transport, .options, .hint")].some((part) => part.checkVisibility()),
    }));
    assert.deepEqual(seen, { stage: 1, table: true, controls: false });
    const pdf = await page.pdf();
    assert.ok(pdf.length > 10_000);
  });
});
