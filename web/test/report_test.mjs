// SPDX-License-Identifier: BSD-3-Clause
// node report_test.mjs FULMAR NODE_MODULES CHROMIUM: reports of short flights, opened as files, checked and printed.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { once } from "node:events";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { absent, browse, shots_folder, until } from "./fixture.mjs";

const [fulmar, modules, chromium] = process.argv.slice(2).map((p) => p && resolve(p));
const skipped = absent(modules, chromium);
if (skipped) {
  console.log("skipped: " + skipped);
  process.exit(77);
}
const folder = mkdtempSync(join(tmpdir(), "fulmar-report-")),
  file = (name) => join(folder, name);
const hostile = "<!--<script><img src=x onerror=document.body.remove()>";
const run_as = (env, words) =>
  execFileSync(fulmar, words, { cwd: folder, stdio: ["ignore", "pipe", "pipe"], env }).toString();
const run = (...words) => run_as(process.env, words);
/** With codes in place of sentences. */
const run_coded = (...words) => run_as({ ...process.env, FULMAR_MESSAGES: "codes" }, words);
let browser,
  page,
  controller,
  host,
  faults = [],
  asked = [];

async function open(name, scheme = "light") {
  await page?.close();
  page = await browser.newPage({ viewport: { width: 1280, height: 720 }, colorScheme: scheme });
  page.on("pageerror", (e) => faults.push(e.message));
  page.on("console", (m) => m.type() === "error" && faults.push(m.text()));
  page.on("request", (r) => r.url().startsWith("http") && asked.push(r.url()));
  await page.goto(pathToFileURL(file(name)).href);
  await until(
    name + " is drawn",
    async () =>
      (await page.locator("#plugins").count()) === 1 &&
      (await page.locator("#map_and_height canvas").count()) > 0,
    40,
  );
}
const text = (selector) => page.locator(selector).first().textContent();
const cells = (row) =>
  page.locator("#figures_of_merit tr", { hasText: row }).first().locator("td").allTextContents();
/** Nothing may be wider than its box, and the page not than its window. */
async function whole(name) {
  for (const [width, height] of [
    [1280, 720],
    [1024, 768],
  ]) {
    await page.setViewportSize({ width, height });
    await page.waitForTimeout(200);
    const cut = await page.evaluate(() => {
      const list = [...document.querySelectorAll("body *")].filter(
        (e) =>
          e.tagName !== "CANVAS" &&
          e.clientWidth > 0 &&
          e.scrollWidth > e.clientWidth + 1 &&
          getComputedStyle(e).overflowX !== "visible",
      );
      return [
        ...list,
        ...(document.documentElement.scrollWidth > innerWidth ? [document.documentElement] : []),
      ].map((e) => e.tagName + "." + e.className);
    });
    assert.deepEqual(cut, [], `${name} ${width}: cut off`);
    await page.screenshot({ path: join(shots_folder(modules), `report_${name}_${width}.png`) });
  }
}
/** The log's data in a report, and a report with other data, as in a log from another source. */
const data_of = (html) =>
  JSON.parse(/<script id="log" type="application\/json">(.*?)<\/script>/s.exec(html)[1]);
const with_data = (html, data) =>
  html.replace(
    /(<script id="log" type="application\/json">).*?(<\/script>)/s,
    (_, a, b) => a + JSON.stringify(data).replace(/</g, "\\u003c") + b,
  );

try {
  writeFileSync(
    file("hostile.yaml"),
    `mission: "${hostile}"\nextends: ${resolve("configs/missions/hourglass.yaml")}\n`,
  );
  const result = JSON.parse(
    run("run", "hostile.yaml", "--duration", "60", "--log", "one.mcap", "--report", "--json"),
  );
  run(
    "run",
    resolve("configs/missions/hourglass.yaml"),
    "--duration",
    "40",
    "--set",
    "slc.course_kp=1.9",
    "--log",
    "two.mcap",
  );
  assert.throws(() => run_coded("report", "one.mcap"), /report\.report_exists\(one\.html\)/);
  assert.throws(
    () => run_coded("report", "one.mcap", folder + "/one.mcap", "-o", "x.html"),
    /report\.log_duplicate\([^)]*one\.mcap\)/,
  );
  assert.match(
    run("report", "one.mcap", "two.mcap", "--names", "one,two", "-o", "both.html"),
    /^both\.html: .* MB/,
  );
  assert.ok(statSync(file("one.html")).size < 1.3e6, `${statSync(file("one.html")).size} bytes for a minute`);
  browser = await browse(modules, chromium);

  // one log, with the figures of the run
  await open("one.html");
  assert.equal(await text("#mission"), hostile);
  const paper = ["north_m", "east_m", "altitude_m", "course_deg", "roll_deg", "pitch_deg", "airspeed_mps"];
  for (const [row, group] of [
    ["Tracking RMS error", result.tracking_rmse],
    ["Estimation RMS error", result.estimation_rmse],
  ])
    (await cells(row)).forEach((cell, i) =>
      assert.equal(parseFloat(cell), Number(group[paper[i]].toFixed(3)), `${row}, ${paper[i]}: ${cell}`),
    );
  for (const cell of [
    ...(await cells("Tracking RMS error")),
    ...(await page.locator("#errors_of_the_estimate td").allTextContents()),
  ])
    assert.match(cell, /^(–|-?[\d.]+(e[+-]\d+)?(°|°\/s| (m|m\/s|m\/s²|%)))$/, "number without unit");
  assert.match(await text("#times"), /slc\d+(\.\d+)? µs/);
  assert.match(await text("#phases"), /takeoffvehicle\.status\.armed.*0\.00 s/);
  assert.match(await text("#verdict"), /^VerdictFlown \(duration reached\)$/);
  assert.equal(result.verdict, "flown");

  // a value in a chart is that of the export
  run("log", "export", "one.mcap", "--to", "csv", "--topic", "/nav/state", "--out", "csv");
  const [head, ...rows] = readFileSync(file("csv/nav.state.csv"), "utf8")
    .trim()
    .split("\n")
    .map((line) => line.split(","));
  const chart = page.locator(".chart", { hasText: "Height above the origin" });
  await chart.scrollIntoViewIfNeeded();
  const box = await chart.locator(".u-over").boundingBox();
  await page.mouse.move(box.x + 0.6 * box.width, box.y + 0.5 * box.height);
  const legend = await until("a value under the mouse", async () =>
    /time:?\s*([\d.]+) s.*actual:?\s*([\d.]+) m/s.exec(await chart.locator(".u-legend").innerText()),
  );
  const [at, height] = [Number(legend[1]), Number(legend[2])];
  assert.ok(at > 20 && at < 50, `${at} s`);
  const sample = rows.find((row) => Math.abs(Number(row[head.indexOf("time_s")]) - at) < 6e-3);
  assert.ok(
    Math.abs(Number(sample[head.indexOf("height_m")]) - height) < 6e-4,
    `${height} m at ${at} s, not ${sample[head.indexOf("height_m")]}`,
  );
  await page.getByLabel("Shown from, s").fill("30");
  await page.getByLabel("Shown to, s").fill("31");
  await page.getByLabel("Shown to, s").press("Enter");
  await page.mouse.move(box.x + 0.6 * box.width, box.y + 0.4 * box.height);
  await until("the selected time", async () =>
    /time:?\s*30\.[67]\d s/.test(await chart.locator(".u-legend").innerText()),
  );
  await whole("one");

  // paper: white, nothing cut, and afterwards the same screen
  await page.keyboard.press("Escape");
  await page.locator("#tabs button").nth(1).click();
  const printed = await page.evaluate(() => {
    dispatchEvent(new Event("beforeprint"));
    const wide = (180 / 25.4) * 96 + 1,
      seen = (e) => e.getBoundingClientRect();
    const out = {
      charts: document.querySelectorAll(".chart canvas").length,
      wide: [...document.querySelectorAll(".chart canvas, #map_and_height canvas, table")].filter(
        (e) => seen(e).width > wide,
      ).length,
      high: [...document.querySelectorAll(".chart")].filter(
        (e) => seen(e).height > 500 || getComputedStyle(e).breakInside !== "avoid",
      ).length,
      keys: [...document.querySelectorAll("#tabs, .timebar, .mapkeys")].filter((e) => e.offsetHeight > 0)
        .length,
    };
    dispatchEvent(new Event("afterprint"));
    return { ...out, after: document.documentElement.className };
  });
  assert.ok(printed.charts > 20, `${printed.charts} charts`);
  assert.deepEqual({ ...printed, charts: 0 }, { charts: 0, wide: 0, high: 0, keys: 0, after: "" });
  assert.ok((await page.pdf({ format: "A4", path: join(shots_folder(modules), "report.pdf") })).length > 1e5);

  // the flight at a moment, by keys
  await page.locator("#view").focus();
  await page.keyboard.press("2");
  const moment = () => page.getByLabel("Moment of the flight");
  assert.equal(Number(await moment().getAttribute("min")).toFixed(1), "-5.0");
  await moment().fill("-2");
  await until("before the take-off", async () => (await text("header")).includes("phase hold"));
  await moment().fill("50");
  await until(
    "in the air",
    async () => (await text("header")).includes("0:50.0") && (await text("header")).includes("phase cruise"),
  );
  await until("the estimator's state", async () => /state✓ valid/.test(await text(".side .pairs")));
  await until("the events", async () => (await text(".events")).includes("phase cruise"));
  await whole("flight");
  await page.click("text=Play");
  await until("time runs", async () => Number(await moment().inputValue()) > 50.3);

  // two logs, in the dark
  await open("both.html", "dark");
  assert.match(await text("#parameters_that_differ"), /slc\.course_kp2\.11\.9/);
  assert.deepEqual(await page.locator("#flights thead th").allTextContents(), ["", "one", "two"]);
  assert.equal(await page.locator("#figures_of_merit tr", { hasText: "Tracking RMS error, " }).count(), 2);
  assert.match(await text(".chart .u-legend"), /one, actual.*two, actual/s);
  await page.keyboard.press("2");
  await page.getByLabel("Log").selectOption({ label: "two" });
  await until("the second flight", async () => Number(await moment().getAttribute("max")) < 41);
  await page.keyboard.press("1");
  await whole("both");

  // no truth, no plan, a second long: the recorded flight of docs/vehicles.md
  mkdirSync(file("recording"));
  writeFileSync(
    file("recording/imu.csv"),
    "t_ms,gx,gy,gz,ax,ay,az\n" + Array.from({ length: 101 }, (_, i) => `${10 * i},0.1,0,0,0,0,1\n`).join(""),
  );
  writeFileSync(
    file("log.yaml"),
    "name: mine\nimu:\n  from: {file: imu.csv, time: t_ms, unit: ms}\n  rate: {columns: [gx, gy, gz], unit: degps}\n  specific_force: {columns: [ax, ay, az], unit: g, axes: flu}\n",
  );
  writeFileSync(
    file("mine.yaml"),
    `mission: mine\nextends: ${resolve("configs/missions/sensor_log.yaml")}\ncomponents: {recorded: {params: {log: log.yaml, folder: recording}}}\n`,
  );
  run("run", "mine.yaml", "--log", "mine.mcap", "--report");
  await open("mine.html");
  assert.match(await text("#errors_of_the_estimate"), /no truth and no fixes/);
  assert.match(await text("#commanded_and_actual"), /No recorded data/);
  await whole("no_truth");

  // hardware has no truth: the host at a flight controller's port, whose pilot arms, and disarms 12 s later
  const peer = join(dirname(fulmar), "fcu_peer");
  if (existsSync(peer)) {
    controller = spawn(peer, ["--link", file("controller"), "--arm-at", "1"], { stdio: "ignore" });
    await until("a controller", () => existsSync(file("controller")));
    host = spawn(
      fulmar,
      [
        "run",
        resolve("configs/missions/hourglass.yaml"),
        "--io",
        "fcu",
        "--set",
        `fcu.port=${file("controller")}`,
        "--live",
        "off",
        "--log",
        "hard.mcap",
        "--duration",
        "12",
      ],
      { cwd: folder, stdio: "ignore" },
    );
    const landed = once(host, "exit");
    await new Promise((go) => setTimeout(go, 15_000));
    controller.kill("SIGUSR1");
    await landed;
    controller.kill("SIGKILL");
    run("report", "hard.mcap", "--rate", "1000"); // all samples
    await open("hard.html");
    assert.match(await text("#errors_of_the_estimate"), /fixes/);
    run("log", "export", "hard.mcap", "--to", "csv", "--topic", "/nav/state", "--out", "hard");
    const [names, ...table] = readFileSync(file("hard/nav.state.csv"), "utf8")
      .trim()
      .split("\n")
      .map((line) => line.split(","));
    const shown = await page
      .locator(".chart", { hasText: "Height above the origin" })
      .getAttribute("aria-label");
    const [low, high] = /actual: (-?[\d.]+) m to (-?[\d.]+) m/.exec(shown).slice(1).map(Number);
    const valid = table
      .filter(
        (row) => row[names.indexOf("height_valid")] === "1" || row[names.indexOf("height_valid")] === "true",
      )
      .map((row) => Number(row[names.indexOf("height_m")]));
    assert.ok(high > 3, `in the air, ${high} m`);
    // in three digits
    assert.ok(
      Math.abs(Math.max(...valid) - high) < 0.006 * high && Math.abs(Math.min(...valid) - low) < 0.006,
      `${low} .. ${high} m, not ${Math.min(...valid)} .. ${Math.max(...valid)}`,
    );
    await page.keyboard.press("2");
    await moment().fill("9");
    await until("in the air", async () => (await text("header")).includes("0:09.0"));
    await whole("hardware_flight");
    await page.keyboard.press("1");
    await whole("hardware");
  } else {
    console.log("not flown on a controller: build the target `fcu_peer`");
  }

  // geofence and places of a mission; a truncated log is shown to its end, and reported
  writeFileSync(
    file("turns.yaml"),
    `mission: turns\nextends: ${resolve("configs/missions/return_home.yaml")}\n`,
  );
  run("run", "turns.yaml", "--duration", "25", "--log", "turns.mcap");
  run("report", "turns.mcap", "-o", "turns.html");
  await open("turns.html");
  await whole("turns");
  // geofence, places and runway of the mission, on the map of the summary and of the moment
  const places = (selector) =>
    page
      .locator(selector)
      .first()
      .evaluate((e) => [e.dataset.fence, e.dataset.places, e.dataset.runway]);
  assert.deepEqual(await places("#map_and_height canvas.map"), ["4", "3", "300"]);
  await page.keyboard.press("2");
  await until("the map of the moment", async () => (await places(".report canvas.map")).join() === "4,3,300");
  await moment().fill("4");
  await until(
    "the safety row",
    async () => (await page.locator('.report .flag[data-flag="fence"]').count()) === 1,
  );
  await whole("turns_moment");
  const bytes = readFileSync(file("one.mcap"));
  writeFileSync(file("cut.mcap"), bytes.subarray(0, bytes.length / 2));
  assert.match(run("report", "cut.mcap"), /cut\.mcap ends early: byte \d+/);
  await open("cut.html");
  assert.match(await text("#flights"), /log completeno: byte \d+/);
  assert.match(await text("#verdict"), /without a verdict: byte \d+/);

  // all data of a log is text
  const html = readFileSync(file("one.html"), "utf8"),
    data = data_of(html),
    [log] = data.logs;
  Object.assign(log, {
    name: hostile,
    fault: hostile,
    verdict: { words: hostile, severity: hostile },
    phases: [{ name: hostile, because: hostile, from_s: 0, to_s: 5 }],
    steps: { [hostile]: { mean: 1, p50: 1, p99: 1, max: 1 } },
  });
  log.told = {
    rows: [{ t: 1, kind: hostile, component: hostile, severity: "warning", words: hostile }],
    all: 1,
  };
  log.metadata.plugins[`${hostile}.file`] = log.metadata.overrides = { [hostile]: hostile };
  log.metadata.plugins[`${hostile}.file`] = hostile;
  log.figures[hostile] = { [hostile]: hostile };
  log.estimates[0].topic = log.estimates[0].rows[0].words = log.innovations[0].words = hostile;
  writeFileSync(file("bad.html"), with_data(html, data));
  await open("bad.html");
  assert.equal(await page.locator("img").count(), 0);
  for (const id of [
    "verdict",
    "flights",
    "figures_of_merit",
    "errors_of_the_estimate",
    "innovations",
    "phases",
    "guards_and_changes",
    "times",
    "plugins",
  ])
    assert.ok((await text("#" + id)).includes(hostile), id);

  assert.deepEqual(faults, []);
  assert.deepEqual(asked, []);
  console.log("reports are self-contained files: read, printed, at any time of the flight");
} finally {
  await browser?.close();
  for (const child of [host, controller]) child?.kill("SIGKILL");
  rmSync(folder, { recursive: true, force: true });
}
