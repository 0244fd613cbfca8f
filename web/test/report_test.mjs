// SPDX-License-Identifier: BSD-3-Clause
// node report_test.mjs FULMAR NODE_MODULES CHROMIUM: the report of a short flight, opened as a file.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { absent, browse, shots_folder, until } from "./fixture.mjs";

const [fulmar, modules, chromium] = process.argv.slice(2).map((p) => p && resolve(p));
const skipped = absent(modules, chromium);
if (skipped) {
  console.log("skipped: " + skipped);
  process.exit(77);
}
const folder = mkdtempSync(join(tmpdir(), "fulmar-report-"));
const hostile = "<!--<script><img src=x onerror=document.body.remove()>";
let browser;
try {
  writeFileSync(join(folder, "hostile.yaml"), `mission: "${hostile}"\nextends: ${resolve("configs/missions/hourglass.yaml")}\n`);
  const log = join(folder, "one.mcap"), out = join(folder, "one.html");
  execFileSync(fulmar, ["run", join(folder, "hostile.yaml"), "--duration", "60", "--log", log], { stdio: "ignore" });
  execFileSync(fulmar, ["report", log, "-o", out], { stdio: "ignore" });
  assert.throws(() => execFileSync(fulmar, ["report", log, "-o", out], { stdio: "pipe" }), /one\.html is there already: give another name with -o/);
  assert.ok(statSync(out).size < 6e6, `${statSync(out).size} bytes for a minute`);

  browser = await browse(modules, chromium);
  const page = await browser.newPage({ viewport: { width: 1280, height: 720 } }), faults = [], asked = [];
  page.on("pageerror", (e) => faults.push(e.message));
  page.on("console", (m) => m.type() === "error" && faults.push(m.text()));
  page.on("request", (r) => r.url().startsWith("http") && asked.push(r.url()));
  await page.goto(pathToFileURL(out).href);
  const text = (selector) => page.locator(selector).first().textContent();
  await until("the mission", async () => (await page.locator("#mission").count()) === 1 && (await text("#mission")) === hostile);
  await until("the events", async () => (await text(".events")).includes("phase cruise"));
  const at = page.getByLabel("Moment of the flight");
  assert.equal(Number(await at.getAttribute("min")).toFixed(1), "-5.0");
  await at.fill("-2");
  await until("before the take-off", async () => (await text("header")).includes("phase hold"));
  await at.fill("50");
  await until("in the air", async () => (await text("header")).includes("0:50.0") && (await text("header")).includes("phase cruise"));
  await until("the estimator's state", async () => /state✓ valid/.test(await text(".side .pairs >> nth=1")));
  await page.screenshot({ path: join(shots_folder(modules), "report_1280.png") });
  await page.click("text=Play");
  await until("time goes on", async () => Number(await at.inputValue()) > 50.3);
  assert.deepEqual(faults, []);
  assert.deepEqual(asked, []);
  console.log("a report is one file, and shows the flight at any moment");
} finally {
  await browser?.close();
  rmSync(folder, { recursive: true, force: true });
}
