// SPDX-License-Identifier: BSD-3-Clause
// node pilot_test.mjs FULMAR NODE_MODULES CHROMIUM: failures of a flight on the page: alerts, safety row, map, commands, age.
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { promisify } from "node:util";
import { absent, browse, fly, free_port, shots_folder, until as within } from "./fixture.mjs";

const [fulmar, modules, chromium] = process.argv.slice(2).map((p) => p && resolve(p));
const skipped = absent(modules, chromium);
if (skipped) {
  console.log("skipped: " + skipped);
  process.exit(77);
}
const run = promisify(execFile);
const port = await free_port(),
  shots = shots_folder(modules);
const ask = async (...words) => (await run(fulmar, [...words, "--at", `127.0.0.1:${port}`])).stdout.trim();
const set = (...words) => ask("param", "set", ...words);
// Without `done`: on the ground return_home ends after 30 s.
const folder = mkdtempSync(join(tmpdir(), "fulmar-pilot-")),
  mission = join(folder, "pilot.yaml");
writeFileSync(
  mission,
  `mission: pilot\nextends: ${resolve("configs/missions/return_home.yaml")}\ndone: "time > 1 h"\n`,
);
const phone = [390, 844],
  sizes = [[1280, 720], [1024, 768], [820, 1180], phone];
let page;
const faults = [];
const until = (what, holds, patience = 60) => within(what, holds, patience); // where others compute, a flight is slower
const tab = (name) => page.click(`#tabs button[data-page="${name}"]`);
const data = (selector, name) =>
  page
    .locator(selector)
    .first()
    .getAttribute("data-" + name);
const is = (what, selector, name, value, patience) =>
  until(
    what,
    async () => (await page.locator(selector).count()) > 0 && (await data(selector, name)) === value,
    patience,
  );
const alert = (key) => `.alert[data-alert="${key}"]`;
const map = ".fly canvas.map";

/** No cell of a table, no field and no alert is cut or beyond the window. */
async function whole(name, at = sizes) {
  for (const [width, height] of at) {
    await page.setViewportSize({ width, height });
    const cut = () =>
      page.evaluate(() =>
        [
          ...document.querySelectorAll(
            "td, th, input, .alert, .alert *, .flag, .command, .command *, .figures > div",
          ),
        ]
          .filter(
            (e) =>
              e.getClientRects().length > 0 &&
              (e.getBoundingClientRect().right > innerWidth + 1 ||
                (e.matches("input, .alert, .command, .figures > div") &&
                  (e.scrollWidth > e.clientWidth + 1 ||
                    (!e.matches("input") && e.scrollHeight > e.clientHeight + 2)))),
          )
          .map((e) => `${e.tagName}.${e.className} ${(e.value ?? e.textContent ?? "").slice(0, 30)}`),
      );
    await until("drawn for this window", async () => (await cut()).length === 0, 3).catch(() => {});
    assert.deepEqual(await cut(), [], `${name} ${width}`);
    await page.screenshot({ path: join(shots, `pilot_${name}_${width}.png`) });
  }
  await page.setViewportSize({ width: 1280, height: 720 });
}
/** Seen at a glance: wholly inside the window, above its middle, red with large letters. A list that is drawn again at that moment has no box. */
async function at_a_glance(key) {
  let seen;
  const sees = async () => {
    seen = await page.locator(alert(key)).evaluate((e) => {
      const box = e.getBoundingClientRect(),
        words = e.querySelector(".what");
      return {
        top: box.top,
        bottom: box.bottom,
        level: e.className,
        size: words ? parseFloat(getComputedStyle(words).fontSize) : 0,
        parts: [".does", ".pilot"].map((p) => e.querySelector(p)?.textContent.length ?? 0),
      };
    });
    return (
      seen.top >= 0 &&
      seen.bottom > 0 &&
      seen.bottom < 360 &&
      seen.size >= 18 &&
      seen.level.includes("critical") &&
      seen.parts.every((n) => n > 10)
    );
  };
  await until("at a glance", sees, 5).catch((e) => assert.fail(`${e.message} ${JSON.stringify(seen)}`));
}

const steps = {
  async "on the ground: missing conditions for the take-off, and no command"() {
    await page.goto(`http://127.0.0.1:${port}/`);
    await is("ready", ".prearm", "ready", "true");
    assert.equal(await page.locator(".command:disabled").count(), 3);
    await ask("speed", "5");
    await set("sim.gnss_works", "false");
    await is("not ready", ".prearm", "ready", "false");
    assert.equal(await page.locator(".alert").count(), 0, "no alert");
    await set("sim.gnss_works", "true");
    await is("ready again", ".prearm", "ready", "true");
  },
  async "a flight with a late view receives no request for missing data"() {
    const other = await browser.newPage(),
      refused = [];
    await other.routeWebSocket(/./, (ws) => {
      const server = ws.connectToServer();
      server.onMessage((m) => {
        if (typeof m === "string" && JSON.parse(m).op === "status") refused.push(m);
        if (typeof m !== "string" && m[0] === 3)
          setTimeout(() => ws.send(m), 2500); // the answer of a service
        else ws.send(m);
      });
    });
    await other.goto(`http://127.0.0.1:${port}/`);
    await until("the view", async () => (await other.locator("#phase").textContent()) !== "–");
    assert.deepEqual(refused, []);
    assert.equal(await other.locator("#toast").isVisible(), false);
    await other.close();
  },
  async "maps show geofence, runway and places"() {
    for (const canvas of [map, ".plan canvas.map"]) {
      await tab(canvas === map ? "Fly" : "Plan");
      await is("fence", canvas, "fence", "4");
      assert.deepEqual([await data(canvas, "places"), await data(canvas, "runway")], ["3", "300"]);
    }
    await whole("plan", [[820, 1180], phone]);
    await tab("Fly");
    await whole("fly", [[820, 1180], phone]);
  },
  async "Wires: no rate in the first seconds of a subscription"() {
    await tab("Wires");
    const first = await page.locator(".twotables").textContent();
    assert.doesNotMatch(first, /never|\b0 Hz/);
    await whole("wires", [phone]);
  },
  async "Tune: changes of other clients are listed, also after a reload, and can be saved"() {
    await set("slc.course_kp", "1.9");
    await page.goto(`http://127.0.0.1:${port}/#tune`);
    await page.reload();
    await until(
      "the change",
      async () =>
        (await page.locator(".changed_list li").allTextContents()).join() ===
        "slc.course_kp: 2.1 → 1.9 rad/rad",
    );
    assert.equal(await page.locator("button", { hasText: "Save slc" }).count(), 1);
    await page.click("text=Restore all");
    await until("as it was", async () => (await ask("param", "get", "slc.course_kp")).startsWith("2.1"));
  },
  async "commands: hold, return and land are executed and cancelled"() {
    await tab("Fly");
    await ask("call", "sim.arm", "{armed: true}");
    await until("in the air", async () => (await page.locator("#phase").textContent()) === "cruise");
    const press = async (key, phase) => {
      await page.click(`.command[data-command="${key}"]`);
      await until(phase, async () => (await page.locator("#phase").textContent()) === phase);
    };
    await press("hold", "wait");
    await is("it shows", '.command[data-command="hold"]', "on", "true");
    await is("the answer", '.flag[data-flag="answer"]', "good", "false");
    await press("hold", "cruise");
    await press("return", "home");
    await press("return", "cruise");
    const between = await page.evaluate(async () => {
      const button = document.querySelector('.command[data-command="land"]');
      button.click();
      await new Promise((go) => setTimeout(go, 300));
      const { on } = button.dataset;
      button.click();
      return on;
    });
    assert.equal(between, "false", "to land takes two");
    await until("it is asked for", async () => (await ask("param", "get", "watch.asked")) === "land");
    await until("flown", async () =>
      ["home", "approach"].includes(await page.locator("#phase").textContent()),
    );
    await page.click('.command[data-command="land"]');
    await until("taken back", async () => (await ask("param", "get", "watch.asked")) === "none");
    await ask("phase", "cruise"); // an approach is left only by a request
  },
  async "GNSS lost: an alert, the row, and the aircraft near its estimate; it stays until acknowledged"() {
    await set("sim.gnss_works", "false");
    await is("the alert", alert("gnss_lost"), "now", "true");
    await at_a_glance("gnss_lost");
    await is("the row", '.flag[data-flag="gnss_lost"]', "good", "false");
    await is("not vanished", map, "aircraft", "lost");
    const [n, e, radius] = (await data(map, "lost")).split(",").map(Number);
    assert.ok(Number.isFinite(n) && Number.isFinite(e) && radius > 3 && radius < 300, `${n} ${e} ${radius}`);
    await whole("gnss");
    await set("sim.gnss_works", "true");
    await is("over, and still there", alert("gnss_lost"), "now", "false");
    await page.click(`${alert("gnss_lost")} button`);
    await until("acknowledged", async () => (await page.locator(".alert").count()) === 0);
    await is("on the map", map, "aircraft", "known");
  },
  async "a blocked browser shows the age of its data, then the newest"() {
    const largest = await page.evaluate(async () => {
      const field = document.getElementById("age");
      let most = 0;
      new MutationObserver(
        () => field.classList.contains("old") && (most = Math.max(most, Number(field.dataset.ms))),
      ).observe(field, { attributes: true, attributeFilter: ["class", "data-ms"] });
      const end = performance.now() + 1600;
      while (performance.now() < end);
      for (let i = 0; i < 100 && most === 0; ++i) await new Promise((go) => setTimeout(go, 20));
      return most;
    });
    assert.ok(largest > 1000, `${largest} ms`);
    await until("the newest", async () => Number(await data("#age", "ms")) < 1000);
  },
  async "a failed motor is an alert; acknowledged, it is one line until its end"() {
    await set("sim.engine_fault", "off");
    await is("the alert", alert("engine_failed"), "now", "true");
    await ask("speed", "real"); // it is on its way down
    await at_a_glance("engine_failed");
    await until(
      "no command that is not flown",
      async () => (await page.locator(".command:disabled").count()) === 3,
    );
    await page.screenshot({ path: join(shots, "pilot_motor.png") });
    await page.click(`${alert("engine_failed")} button`);
    await until(
      "one line",
      async () =>
        (await page.locator(alert("engine_failed")).count()) === 0 &&
        page.locator(".alert_lasting").isVisible(),
    );
  },
  async "a crash is an alert, alone"() {
    await set("sim.pilot_flies", "true", "sim.stick_pitch", "-1");
    await is("the alert", alert("crashed"), "now", "true");
    await at_a_glance("crashed");
    await is("the row", '.flag[data-flag="contact"]', "good", "false");
    assert.equal(await data(map, "crashed"), "true");
    const lasting = () =>
      page.locator(".alert.critical:not(.over)").evaluateAll((list) => list.map((e) => e.dataset.alert));
    assert.deepEqual(await lasting(), ["crashed"]);
    await whole("crash", [[1280, 720]]);
  },
};

const browser = await browse(modules, chromium);
const flight = await fly(fulmar, port, mission, "--arm", "off");
let failed = 0;
try {
  flight.child.stdout.resume();
  page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
  page.setDefaultTimeout(60_000);
  page.on("pageerror", (e) => faults.push(e.message));
  for (const [name, step] of Object.entries(steps)) {
    const begun = Date.now();
    try {
      await step();
      console.log(`ok     ${((Date.now() - begun) / 1000).toFixed(1)} s  ${name}`);
    } catch (fault) {
      ++failed;
      console.log(`FAILED ${name}\n${fault.stack}`);
      await page.screenshot({ path: join(shots, "pilot_failed.png") }).catch(() => {});
      break; // the next ones go on from here
    }
  }
  assert.deepEqual(faults, [], "faults of the page");
} finally {
  await browser.close();
  await flight.end();
  rmSync(folder, { recursive: true, force: true });
}
process.exit(failed === 0 ? 0 : 1);
