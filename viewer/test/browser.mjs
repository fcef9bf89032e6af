// Opens pages in a headless browser and watches that nothing unexpected happens in them.
import assert from "node:assert/strict";
import { accessSync, constants, mkdtempSync, readFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { delimiter, join } from "node:path";
import { pathToFileURL } from "node:url";
import puppeteer from "puppeteer-core";
import { writeFixtures } from "./fixture/write.mjs";

function executable() {
  const given = process.env.KUTZBACH_CHROMIUM;
  if (given) return given;
  for (const name of ["chromium", "chromium-browser", "google-chrome"]) {
    for (const folder of (process.env.PATH ?? "").split(delimiter)) {
      try {
        accessSync(join(folder, name), constants.X_OK);
        return join(folder, name);
      } catch {
        // Not here.
      }
    }
  }
  throw new Error("no chromium on PATH: set KUTZBACH_CHROMIUM");
}

/** Where the pages are: those of the program where given, else fixtures written now. */
let directory = process.env.KUTZBACH_PAGES;
if (!directory) {
  directory = mkdtempSync(join(tmpdir(), "kutzbach-pages-"));
  await writeFixtures(directory);
}

export const pagePath = (name) => join(directory, `${name}.html`);

/** A vector turned by a unit quaternion w, x, y, z. */
function turned([w, x, y, z], [a, b, c]) {
  return [
    (1 - 2 * (y * y + z * z)) * a + 2 * (x * y - w * z) * b + 2 * (x * z + w * y) * c,
    2 * (x * y + w * z) * a + (1 - 2 * (x * x + z * z)) * b + 2 * (y * z - w * x) * c,
    2 * (x * z - w * y) * a + 2 * (y * z + w * x) * b + (1 - 2 * (x * x + y * y)) * c,
  ];
}

/** The data written into a page, with its numbers decoded. */
export function pageData(name) {
  const text = readFileSync(pagePath(name), "utf8");
  const data = JSON.parse(/<script type="application\/json" id="page-data">(.*?)<\/script>/s.exec(text)[1]);
  const floats = (base64) => {
    const bytes = Buffer.from(base64, "base64");
    return Array.from({ length: bytes.length / 4 }, (_, i) => bytes.readFloatLE(4 * i));
  };
  for (const motion of data.motions) {
    for (const key of ["arclengths", "values", "poses"]) motion[key] = floats(motion[key]);
    const width = 7 * data.links.length;
    motion.poseOf = (sample) =>
      data.links.map(({ origin }, link) => {
        const drawn = motion.poses.slice(sample * width + 7 * link, sample * width + 7 * link + 7);
        const own = turned(drawn.slice(3), origin ?? [0, 0, 0]);
        return drawn.map((x, i) => (i < 3 ? x + data.centre[i] - own[i] : x));
      });
  }
  return data;
}

const SOFTWARE = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"];

export async function openBrowser({ webgl = true } = {}) {
  return puppeteer.launch({
    executablePath: executable(),
    headless: true,
    args: ["--no-sandbox", ...(webgl ? SOFTWARE : ["--disable-gpu", "--disable-3d-apis"])],
  });
}

/**
 * Opens a page, waits for its first picture, lets `act` look at it, and fails on any warning or error in the console, on
 * any exception and on any request but for the page itself.
 */
export async function withPage(browser, name, options, act) {
  const { width = 1280, height = 900, phone = false, features = [] } = options;
  const page = await browser.newPage();
  const troubles = [];
  page.on("console", (message) => {
    if (["error", "warn", "warning", "assert"].includes(message.type())) troubles.push(message.text());
  });
  page.on("pageerror", (error) => troubles.push(String(error)));
  const url = pathToFileURL(pagePath(name)).href;
  page.on("request", (request) => {
    const wanted = request.url();
    if (wanted !== url && !wanted.startsWith(`${url}#`) && !wanted.startsWith("data:")) troubles.push(`request: ${wanted}`);
  });
  try {
    await page.emulateMediaFeatures(features);
    await page.setViewport({ width, height, deviceScaleFactor: phone ? 2 : 1, isMobile: phone, hasTouch: phone });
    await page.goto(url);
    await page.evaluate(() => window.kutzbach.ready);
    const result = await act(page);
    assert.deepEqual(troubles, []);
    return result;
  } finally {
    await page.close();
  }
}

/** Holds the motion where it is, also when the page would begin to play. */
export async function hold(page) {
  await page.waitForFunction(() => window.kutzbach.state().playing, { timeout: 5000 }).catch(() => {});
  await page.evaluate(() => window.kutzbach.pause());
}

/** Greatest difference between poses: positions in metres and quaternions. */
export function poseGap(a, b) {
  let [place, turn] = [0, 0];
  a.forEach((pose, link) =>
    pose.forEach((x, i) => {
      const gap = Math.abs(x - b[link][i]);
      if (i < 3) place = Math.max(place, gap);
      else turn = Math.max(turn, gap);
    }),
  );
  return { place, turn };
}
