// SPDX-License-Identifier: BSD-3-Clause
// node long_test.mjs FULMAR NODE_MODULES CHROMIUM: processor load and memory of the page. Limits: eight plots of 60 s at 50 samples a
// second, in real time, without the 3-D view, take less than 30 % of one core in the browser; over an hour of flight the page's memory
// stays what it is once its histories are full. Part of cmake/long.sh.
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";
import { absent, browse, fly, free_port, until } from "./fixture.mjs";

const [fulmar, modules, chromium] = process.argv.slice(2).map((p) => p && resolve(p));
const skipped = absent(modules, chromium);
if (skipped) {
  console.log("skipped: " + skipped);
  process.exit(77);
}
const most_of_a_core = 0.3,
  plots = 8,
  seconds = 60,
  speed = 60,
  hour_s = 3600,
  ticks_per_s = 100;
const grown_mb = 3; // of some tens: what a collection of garbage leaves differs by that
const run = promisify(execFile);
const src = join(dirname(fileURLToPath(import.meta.url)), "../src");
const folder = mkdtempSync(join(tmpdir(), "fulmar-long-"));

/** Seconds of processor time of this browser's processes so far: drawing, which is a graphics card's where there is one, and all else. */
function processor_s() {
  const all = new Map();
  for (const pid of readdirSync("/proc").filter((n) => /^\d+$/.test(n))) {
    try {
      const fields = readFileSync(`/proc/${pid}/stat`, "latin1")
        .replace(/^.*\) /, "")
        .split(" "); // from the third on
      all.set(pid, {
        parent: fields[1],
        ticks: Number(fields[11]) + Number(fields[12]),
        words: readFileSync(`/proc/${pid}/cmdline`, "latin1"),
      });
    } catch {} // it has ended meanwhile
  }
  const ours = (pid) => all.has(pid) && (all.get(pid).words.includes(mark) || ours(all.get(pid).parent));
  const sum = { drawing: 0, rest: 0 };
  for (const [pid, p] of all)
    if (ours(pid)) sum[p.words.includes("--type=gpu-process") ? "drawing" : "rest"] += p.ticks / ticks_per_s;
  return sum;
}

// The page's own plots, eight of them, in place of its views.
const entry = join(folder, "plots.ts");
writeFileSync(
  entry,
  `import { Flight } from "${src}/protocol/flight";
import { Response } from "${src}/views/response";
const flight = new Flight(location.href.replace(/^http/, "ws"));
document.body.replaceChildren();
document.body.style.cssText = "display: grid; grid-template-columns: repeat(4, 1fr); grid-auto-rows: 340px; overflow: auto";
const list = Array.from({ length: ${plots} }, () => new Response(flight));
document.body.append(...list.map((r) => r.element));
let last = 0;
requestAnimationFrame(function frame(now) {
  requestAnimationFrame(frame);
  if (now - last < 30) return;
  last = now;
  list.forEach((r, i) => {
    const [choice, span] = r.element.querySelectorAll("select");
    if (choice.options.length > 0 && choice.dataset.set !== "1") choice.selectedIndex = i % choice.options.length, choice.dataset.set = "1", span.value = "${seconds}";
    r.update(now);
  });
});`,
);
const { buildSync } = createRequire(join(modules, "x.js"))("esbuild");
const bundle = buildSync({
  entryPoints: [entry],
  bundle: true,
  format: "esm",
  nodePaths: [modules],
  write: false,
}).outputFiles[0].text;

const mission = join(folder, "hour.yaml");
writeFileSync(
  mission,
  `mission: hour\nextends: ${resolve("configs/missions/hourglass.yaml")}\ndone: null\ntimeout: 20000 s\n`,
);

const mark = "--user-agent=fulmar-long-" + process.pid; // by which the browser's processes are known
const browser = await browse(modules, chromium, mark);
let flight,
  failed = 0;
const bar = (words, holds) => {
  console.log(`${holds ? "ok    " : "FAILED"} ${words}`);
  if (!holds) ++failed;
};
try {
  const port = await free_port(),
    at = ["--at", `127.0.0.1:${port}`];
  flight = await fly(fulmar, port, mission, "--no-log");
  await run(fulmar, ["speed", "10", ...at]);
  const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
  await page.route("**/page.js", (route) => route.fulfill({ contentType: "text/javascript", body: bundle }));
  await page.goto(`http://127.0.0.1:${port}/`);
  await until("eight plots", async () => (await page.locator(".uplot").count()) === plots);
  await page.waitForTimeout(1000 * (seconds / 10 + 2)); // 60 s of flight are there
  await run(fulmar, ["speed", "real", ...at]);
  await page.waitForTimeout(3000);
  const points = await page.evaluate(() => document.querySelectorAll(".uplot canvas").length);
  assert.equal(points, plots);
  const before = processor_s(),
    begun = Date.now();
  await page.waitForTimeout(20_000);
  const after = processor_s(),
    share = (what) => (after[what] - before[what]) / ((Date.now() - begun) / 1000);
  bar(
    `${plots} plots of ${seconds} s at 50 samples a second: ${(100 * share("rest")).toFixed(0)} % of one core in the browser, the bar is ${100 * most_of_a_core} %; ` +
      `drawing without a graphics card takes ${(100 * share("drawing")).toFixed(0)} % more`,
    share("rest") < most_of_a_core,
  );
  await page.close();

  const whole = await browser.newPage({ viewport: { width: 1280, height: 720 } });
  const devtools = await whole.context().newCDPSession(whole);
  await whole.goto(`http://127.0.0.1:${port}/#tune`);
  await run(fulmar, ["speed", String(speed), ...at]);
  const minutes = async () =>
    Number(/([-\d.]+) s,/.exec((await run(fulmar, ["list", ...at])).stdout)[1]) / 60;
  /** The least of some: what is on its way comes and goes. */
  const heap_mb = async () => {
    let least = Infinity;
    for (let i = 0; i < 5; ++i) {
      await devtools.send("HeapProfiler.collectGarbage");
      const { usedSize, backingStorageSize = 0 } = await devtools.send("Runtime.getHeapUsage");
      least = Math.min(least, (usedSize + backingStorageSize) / 1e6); // what messages came in as well
      await whole.waitForTimeout(100);
    }
    return least;
  };
  const from = await minutes(),
    heaps = [];
  for (const after of [10, 20, 30, 40, 50, hour_s / 60]) {
    await until(`${after} minutes of flight`, async () => (await minutes()) > from + after, 600);
    heaps.push(await heap_mb());
  }
  console.log(
    "       MB after 10, 20 ... 60 minutes of flight: " + heaps.map((h) => h.toFixed(1)).join(", "),
  );
  const growth = Math.min(...heaps.slice(3)) - Math.min(...heaps.slice(0, 3));
  bar(
    `memory of the page, the second half of an hour of flight against the first: ${growth >= 0 ? "+" : "−"}${Math.abs(growth).toFixed(1)} MB, the bar is +${grown_mb} MB`,
    growth < grown_mb,
  );
} finally {
  await browser.close();
  await flight?.end();
  rmSync(folder, { recursive: true, force: true });
}
process.exit(failed === 0 ? 0 : 1);
