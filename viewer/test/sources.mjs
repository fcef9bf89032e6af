// Makes single source files importable in node: types are taken out, imports kept together.
import { build } from "esbuild";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const root = join(dirname(fileURLToPath(import.meta.url)), "..");

/** `more`: further exports, for what the file takes from libraries. */
export async function source(path, more = "") {
  const { outputFiles } = await build({
    absWorkingDir: root,
    stdin: { contents: `export * from "./src/${path}";\n${more}`, resolveDir: root },
    bundle: true,
    format: "esm",
    write: false,
    logLevel: "silent",
  });
  return import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString("base64")}`);
}
