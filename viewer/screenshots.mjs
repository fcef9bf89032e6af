// Pictures of pages for the book: node screenshots.mjs PAGES OUT, where PAGES holds the pages named below. What each says first is
// written to pages.json beside them, so that a test can tell when they are old.
import { writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import puppeteer from "puppeteer-core";

const [pages, out] = process.argv.slice(2).map((path) => resolve(path));
const light = [{ name: "prefers-color-scheme", value: "light" }];
const dark = [{ name: "prefers-color-scheme", value: "dark" }];

/** Which page, on which screen, how far along its motion. */
const SHOTS = [
  { name: "page_desktop", page: "bennett", width: 1280, height: 1000, features: light, at: 0.12 },
  { name: "page_dark", page: "stewart", width: 1280, height: 1000, features: dark, at: 0.4 },
  { name: "page_phone", page: "scissor_lift", width: 390, height: 844, phone: true, features: light, at: 0.3 },
  { name: "page_crossing", page: "parallelogram_flat", width: 1280, height: 1000, features: light, home: true },
  { name: "page_print", page: "slider_crank", width: 794, height: 1123, print: true, features: light, at: 0.1 },
];

const said = {};
const browser = await puppeteer.launch({
  executablePath: process.env.KUTZBACH_CHROMIUM ?? "chromium",
  headless: true,
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
for (const { name, page: file, width, height, phone = false, print = false, home = false, features, at } of SHOTS) {
  const page = await browser.newPage();
  await page.emulateMediaFeatures([...features, { name: "prefers-reduced-motion", value: "reduce" }]);
  await page.setViewport({ width, height, deviceScaleFactor: phone ? 2 : 1, isMobile: phone, hasTouch: phone });
  await page.goto(pathToFileURL(join(pages, `${file}.html`)).href);
  await page.evaluate(() => window.kutzbach.ready);
  await page.evaluate(
    (share, toHome) => {
      const data = JSON.parse(document.getElementById("page-data").textContent);
      const motion = data.motions[window.kutzbach.state().motion ?? 0];
      if (motion === undefined) return;
      const bytes = Uint8Array.from(atob(motion.arclengths), (c) => c.charCodeAt(0));
      const arclengths = new Float32Array(bytes.buffer);
      const crossing = motion.events.find((event) => event.home);
      const sample = toHome && crossing ? crossing.sample : Math.round(share * (motion.samples - 1));
      window.kutzbach.scrub(arclengths[sample]);
    },
    at ?? 0,
    home,
  );
  said[name] = { page: file, sentence: await page.$eval("#verdict p", (p) => p.textContent.trim()) };
  if (print) {
    await page.evaluate(() => window.dispatchEvent(new Event("beforeprint")));
    await page.emulateMediaType("print");
  }
  // The picture gets its full sharpness when nothing has changed for a while.
  await new Promise((done) => setTimeout(done, 1200));
  await page.screenshot({ path: join(out, `${name}.png`) });
  await page.close();
}
await browser.close();
writeFileSync(join(out, "pages.json"), `${JSON.stringify(said, null, 2)}\n`);
