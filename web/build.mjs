// SPDX-License-Identifier: BSD-3-Clause
// node build.mjs NODE_MODULES OUT: the page, small, into the folder OUT; each file also compressed.
import { createHash } from "node:crypto";
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
buildSync({
  entryPoints: { page: join(here, "src/style.css") },
  outdir: out,
  bundle: true,
  minify: true,
  nodePaths: [modules],
});
writeFileSync(join(out, "index.html"), readFileSync(join(here, "src/index.html")));

// The report of a log: one file. Its policy allows the script and the style in it, by their sums, and nothing else.
const report = buildSync({
  entryPoints: [join(here, "src/report.ts")],
  bundle: true,
  minify: true,
  format: "esm",
  target: ["chrome103", "firefox113", "safari16.4"],
  legalComments: "none",
  charset: "ascii",
  nodePaths: [modules],
  write: false,
}).outputFiles[0].text;
const style = readFileSync(join(out, "page.css"), "utf8").trim();
// a text in the script that would end its element
const script = report
  .replace(/<\/(script)/gi, "<\\/$1")
  .replace(/<!--/g, "<\\!--")
  .trim();
const sum = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;
const policy = `default-src 'none'; script-src ${sum(script)}; style-src ${sum(style)}; img-src data:; require-trusted-types-for 'script'; trusted-types 'none'`;
writeFileSync(
  join(out, "report.html"),
  `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Fulmar</title>
<link rel="icon" href="data:,">
<style>${style}</style>
</head>
<body>
<script id="log" type="application/json">LOG_OF_THE_FLIGHT</script>
<script type="module">${script}</script>
</body>
</html>
`,
);
const licences = ["three", "uplot", "js-yaml"].map(
  (name) => `${name}\n\n${readFileSync(join(modules, name, "LICENSE"), "utf8")}`,
);
writeFileSync(join(out, "LICENSES.txt"), licences.join("\n\n"));
let total = 0;
for (const name of readdirSync(out).filter((n) => /\.(html|js|css)$/.test(n) && n !== "report.html")) {
  const bytes = gzipSync(readFileSync(join(out, name)), { level: 9 });
  writeFileSync(join(out, name + ".gz"), bytes);
  total += bytes.length;
}
console.log(`the page: ${Math.round(total / 1000)} kB compressed`);
