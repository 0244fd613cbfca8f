// SPDX-License-Identifier: BSD-3-Clause
// node build.mjs NODE_MODULES OUT: the page, small, into the folder OUT; each file also compressed.
import { mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

const here = dirname(fileURLToPath(import.meta.url));
const [modules = join(here, "node_modules"), out = join(here, "dist")] = process.argv.slice(2);
const { buildSync } = createRequire(join(modules, "x.js"))("esbuild");

rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
buildSync({
  entryPoints: { page: join(here, "src/main.ts") },
  outdir: out,
  bundle: true,
  minify: true,
  splitting: true,
  format: "esm",
  target: ["chrome100", "firefox100", "safari15.4"],
  chunkNames: "[name]",
  legalComments: "none",
  nodePaths: [modules],
});
buildSync({ entryPoints: { page: join(here, "src/style.css") }, outdir: out, bundle: true, minify: true, nodePaths: [modules] });
writeFileSync(join(out, "index.html"), readFileSync(join(here, "src/index.html")));
const licences = ["three", "uplot", "js-yaml"].map((name) => `${name}\n\n${readFileSync(join(modules, name, "LICENSE"), "utf8")}`);
writeFileSync(join(out, "LICENSES.txt"), licences.join("\n\n"));
let total = 0;
for (const name of readdirSync(out).filter((n) => /\.(html|js|css)$/.test(n))) {
  const bytes = gzipSync(readFileSync(join(out, name)), { level: 9 });
  writeFileSync(join(out, name + ".gz"), bytes);
  total += bytes.length;
}
console.log(`the page: ${Math.round(total / 1000)} kB compressed`);
