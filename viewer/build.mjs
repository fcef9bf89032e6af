// Bundles the script and the style sheet of the page into crates/report/viewer/. The same sources give the same bytes.
import { build } from "esbuild";
import { readFile, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const common = { absWorkingDir: here, bundle: true, minify: true, legalComments: "none", logLevel: "warning" };

// The notice that the licence of the library asks for, once, at the top.
const three = JSON.parse(await readFile(join(here, "node_modules/three/package.json"), "utf8"));
const licence = await readFile(join(here, "node_modules/three/LICENSE"), "utf8");
const notice = `/*! three.js ${three.version}\n${licence.trim()}\n*/`;
if (/<\/|<!--/.test(notice)) throw new Error("the notice would end the script element");

await build({
  ...common,
  entryPoints: ["src/main.ts"],
  outfile: "../crates/report/viewer/viewer.js",
  format: "iife",
  target: "es2022",
  charset: "utf8",
  banner: { js: notice },
});
await build({ ...common, entryPoints: ["src/page.css"], outfile: "../crates/report/viewer/page.css", charset: "utf8", target: ["chrome109", "firefox115", "safari16"] });

// A page holds the script between tags: nothing in it may look like their end.
const out = join(here, "../crates/report/viewer");
const path = join(out, "viewer.js");
const script = await readFile(path, "utf8");
const safe = script.replaceAll(/<\/(?=script)/gi, "<\\/").replaceAll("<!--", "<\\!--");
await writeFile(path, safe);
for (const file of ["viewer.js", "page.css"]) {
  const { length } = await readFile(join(out, file));
  console.log(`${file} ${(length / 1024).toFixed(1)} KiB`);
}
