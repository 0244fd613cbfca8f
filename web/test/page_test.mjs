// SPDX-License-Identifier: BSD-3-Clause
// node page_test.mjs FULMAR NODE_MODULES CHROMIUM: flies in real time and uses the page like a user. The command line reads the
// results from the flight.
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { copyFileSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { promisify } from "node:util";
import { edit_steps } from "./edit_steps.mjs";
import { absent, browse, fly, free_port, shots_folder, until } from "./fixture.mjs";
import { colours_at, tile_server } from "./tile_server.mjs";

const [fulmar, modules, chromium] = process.argv.slice(2).map((p) => p && resolve(p));
const skipped = absent(modules, chromium);
if (skipped) {
  console.log("skipped: " + skipped);
  process.exit(77);
}
const run = promisify(execFile);
const port = await free_port();
const at = ["--at", `127.0.0.1:${port}`];
/** Output of a command. */
const ask = async (...words) => (await run(fulmar, [...words, ...at])).stdout.trim();
const value_of = async (field) =>
  Number((await ask("echo", field, "--count", "1", "--csv")).split("\n")[1].split(",")[1]);

// Names that contain markup.
const folder = mkdtempSync(join(tmpdir(), "fulmar-page-"));
const hostile = "<img src=x onerror=document.body.remove()>";
copyFileSync("configs/airframes/anaconda.yaml", join(folder, "mine.yaml")); // what is saved goes into a file of our own
writeFileSync(
  join(folder, "hostile.yaml"),
  `mission: "${hostile}"\nextends: ${resolve("configs/missions/hourglass.yaml")}\nairframe: mine.yaml\n`,
);

// A place of the mission's map that neither plan nor aircraft covers, by the radii of curvature of WGS 84 there (to 3 mm).
const coloured = {
  n: 200,
  e: 200,
  lat: 40.2463724 + ((200 / 6363474) * 180) / Math.PI,
  lon: -111.6474138 + ((200 / 4876137) * 180) / Math.PI,
};

let page, flight, tiles;
const faults = [],
  foreign = [];
const shots = shots_folder(modules);
const text = (selector) => page.locator(selector).first().textContent();
const tab = (name) => page.click(`#tabs button[data-page="${name}"]`);
const seen = (what, selector, holds, patience) =>
  until(what, async () => holds((await page.locator(selector).allTextContents()).join("\n")), patience);

/** No element may be wider than its box, nor the page wider than its window. */
async function whole(name) {
  const cut = () =>
    page.evaluate(() => {
      const hidden = (e) => getComputedStyle(e).overflowX !== "visible"; // no horizontal scrolling for a number
      const list = [...document.querySelectorAll("body *")].filter(
        (e) => e.tagName !== "CANVAS" && e.clientWidth > 0 && e.scrollWidth > e.clientWidth + 1 && hidden(e),
      );
      if (document.documentElement.scrollWidth > innerWidth) list.push(document.documentElement);
      return list.map((e) => `${e.tagName}.${e.className} ${(e.value ?? e.textContent ?? "").slice(0, 40)}`);
    });
  await until("drawn for this window", async () => (await cut()).length === 0).catch(() => {}); // charts follow with a delay
  assert.deepEqual(await cut(), [], name + ": cut off");
}
async function shoot(name) {
  for (const [width, height] of [
    [1280, 720],
    [1024, 768],
  ]) {
    await page.setViewportSize({ width, height });
    await page.waitForTimeout(250);
    await whole(`${name} ${width}`);
    await page.screenshot({ path: join(shots, `${name}_${width}.png`) });
  }
  await page.setViewportSize({ width: 1280, height: 720 });
}

// of a page that is open
const steps = () => ({
  async "the page loads from the flight alone, within 10 s"() {
    const begun = Date.now();
    await page.goto(`http://127.0.0.1:${port}/`);
    await seen("the phase", "#phase", (t) => t !== "–");
    assert.ok(Date.now() - begun < 10_000);
    assert.equal(await text("#mission"), hostile);
    assert.equal(await page.locator("#mission img").count(), 0);
    assert.equal(await page.title(), hostile + " – Fulmar");
  },
  async "names that are markup stay text"() {
    const other = await browser.newPage();
    await other.routeWebSocket(/./, (ws) => {
      const server = ws.connectToServer();
      // Forwards texts, and renames a component in the answer of a service.
      server.onMessage((m) => {
        if (typeof m === "string") ws.send(m);
        else if (m[0] === 3)
          ws.send(
            Buffer.from(m.toString("latin1").replaceAll('"name":"slc"', `"name":"${hostile}"`), "latin1"),
          );
      });
    });
    other.on("pageerror", (e) => faults.push(e.message));
    await other.goto(`http://127.0.0.1:${port}/#wires`);
    for (const key of ["3", "4", "1"]) {
      await other.keyboard.press(key); // Tune, Wires, Fly
      await until("its name", async () => (await other.locator("#view").textContent()).includes(hostile));
      assert.equal(await other.locator("img").count(), 0);
    }
    await other.close();
  },
  async "speed: ten times as fast until it is in the air"() {
    await tab("Simulation");
    await page.click('button[data-speed="10"]');
    await seen("cruise", "#phase", (t) => t === "cruise", 15);
    await page.click('button[data-speed="1"]');
    await until(
      "real time",
      async () => (await ask("list")).includes("speed real") || !(await ask("list")).includes("speed 10"),
    );
  },
  async "Fly: contents"() {
    await tab("Fly");
    await seen(
      "also events from before it was opened",
      ".events",
      (t) =>
        /−0:05\.0.phase hold/.test(t) && t.includes("0:00.0·phase takeoff") && t.includes("phase cruise"),
    );
    await seen("a height", ".figures", (t) => /ground speed\d+\.\d m\/s/.test(t));
    await seen(
      "active components",
      ".side .pairs",
      (t) => t.includes("outerslc") && t.includes("navekf") && t.includes("GNSS position✓ ok"),
    );
    await until("a picture of the aircraft", () =>
      page.evaluate(() => document.querySelector(".chase canvas")?.width > 300),
    );
    await shoot("fly");
  },
  ...edit_steps({ page, fulmar, folder, run, ask, value_of, plan, position_of, near, tab, seen, shoot }),
  async "Simulation: a pause stops the time; a step moves it by its ticks"() {
    await tab("Simulation");
    await page.click("text=Pause");
    await seen("paused", "#pace", (t) => t === "paused");
    const time = async () => Number(/([-\d.]+) s,/.exec(await ask("list"))[1]);
    const stands = await time();
    await page.waitForTimeout(300);
    assert.equal(await time(), stands);
    const late = await browser.newPage(); // a new client sees the present state
    await late.goto(`http://127.0.0.1:${port}/`);
    await until("figures of a paused flight", async () =>
      /ground speed\d+\.\d m\/s.*waypoint\d of 4/s.test((await late.locator(".figures").textContent()) ?? ""),
    );
    const [minutes, seconds] = (await late.locator("#clock").textContent()).split(":").map(Number);
    near(60 * minutes + seconds, stands, 0.06);
    await late.close();
    await page.getByLabel("Ticks to step").fill("200");
    await page.click("button >> text=Step");
    await seen("done", ".sim .taken", (t) => t.includes("Stepped 200 ticks"));
    assert.ok(Math.abs((await time()) - stands - 0.5) < 0.051, "200 ticks of 400 Hz");
    await shoot("simulation");
    await page.click("text=Resume");
    await until("time goes on", async () => (await time()) > stands + 0.7);
  },
  async "Manual flight: keys move the sticks until their release"() {
    await tab("Fly");
    await page.click("text=Take the sticks");
    await until("the pilot flies", async () => (await ask("param", "get", "sim.pilot_flies")) === "true");
    await until("the sticks have the keys", () =>
      page.locator(".sticks").evaluate((e) => e === document.activeElement),
    );
    await page.keyboard.down("ArrowRight");
    await until("the stick", async () => Number(await ask("param", "get", "sim.stick_roll")) > 0.5);
    await page.keyboard.up("ArrowRight");
    await until(
      "let go, in the middle",
      async () => Math.abs(Number(await ask("param", "get", "sim.stick_roll"))) < 0.01,
    );
    await page.click("text=Release the sticks");
    await until(
      "the autopilot flies",
      async () => (await ask("param", "get", "sim.pilot_flies")) === "false",
    );
  },
  async "New flight: two clicks, another seed, same page"() {
    await tab("Simulation");
    const seed = page.getByLabel("Seed of the new flight");
    assert.equal(await seed.inputValue(), "7");
    await seed.fill("eleven");
    const button = page.locator("button.chip", { hasText: /New flight|end this flight/ });
    await button.click();
    await seen("the question", "button.chip.asked", (t) => t === "end this flight?");
    await shoot("new_flight");
    await until("the question ends", async () => (await button.textContent()) === "New flight");
    for (let i = 0; i < 2; ++i) await button.click();
    await seen("an invalid seed", ".sim [role=alert]", (t) => t.includes("Rejected: seed 'eleven'"));
    await seed.fill("11");
    const before = await value_of("nav.state.height_m");
    assert.ok(before > 20, "in the air");
    const loaded = page.waitForEvent("load");
    for (let i = 0; i < 2; ++i) await button.click();
    await loaded;
    await seen("a flight from its beginning", "#clock", (t) => /^−?0:0\d/.test(t));
    await until(
      "its seed",
      async () => (await page.getByLabel("Seed of the new flight").inputValue()) === "11",
    );
    assert.ok(await page.locator("#banner").isHidden());
    assert.match(page.url(), /#simulation$/);
  },
  async "a lost flight is detected within a second, and found again"() {
    await tab("Fly");
    await until("all of it is here", () =>
      page.evaluate(() => document.querySelector(".chase canvas")?.width > 300),
    );
    const hidden = () => page.locator("#banner").isHidden();
    assert.ok(await hidden());
    // first text of the banner: time since the last message
    await page.evaluate(() => {
      const bar = document.getElementById("banner");
      new MutationObserver(() => {
        if (!bar.hidden && !bar.dataset.first) bar.dataset.first = bar.textContent;
      }).observe(bar, { attributes: true, childList: true });
    });
    flight.child.kill("SIGSTOP"); // silent, and no connection is closed
    await until("the banner", async () => !(await hidden()));
    assert.match(await page.locator("#banner").getAttribute("data-first"), /Connection lost, [01] s ago/);
    await shoot("lost");
    flight.child.kill("SIGCONT");
    await until("it is back", hidden);
    await flight.end();
    await seen("the banner again", "#banner", (t) => t.includes("Connection lost"));
    tiles = await tile_server(coloured);
    const mission = join(folder, "tiles.yaml");
    writeFileSync(
      mission,
      `mission: tiles\nextends: ${resolve("configs/missions/hourglass.yaml")}\n` +
        `live: {tiles: "http://127.0.0.1:${tiles.port}/{z}/{x}/{y}.png", attribution: "Tiles of <b>example</b>"}\n`,
    );
    const loaded = page.waitForEvent("load"); // another flight has its own page
    flight = await fly(fulmar, port, mission);
    await loaded;
    await until("the next flight", hidden);
  },
  async "Map: tiles come from the server of the mission and lie at their place; a missing tile is no fault"() {
    await seen("the attribution", ".attribution", (t) => t === "Tiles of <b>example</b>");
    await tab("Plan");
    await page.locator(".plan canvas.map").focus();
    await until("tiles", () => tiles.asked.length > 3);
    await page.waitForTimeout(500);
    await shoot("tiles");
    // where four colours meet, the map has that place: to two pixels
    const canvas = ".plan canvas.map",
      off = 2;
    const box = await page.locator(canvas).boundingBox();
    await until(
      "the colours",
      async () => {
        const [n, e, px] = (await page.locator(canvas).getAttribute("data-view")).split(",").map(Number); // the map moves with new data
        const x = box.width / 2 + (coloured.e - e) * px,
          y = box.height / 2 - (coloured.n - n) * px;
        const found = await colours_at(browser, page, canvas, [
          [x - off, y - off],
          [x + off, y - off],
          [x - off, y + off],
          [x + off, y + off],
        ]);
        return (
          found
            .map(([r, g, b]) =>
              r > 150 && g < 120
                ? "r"
                : r < 120 && g > 150
                  ? "g"
                  : b > 150
                    ? "b"
                    : r > 150 && g > 150 && b < 120
                      ? "y"
                      : "?",
            )
            .join("") === "rgby"
        );
      },
      60,
    ); // a screenshot with 3-D takes seconds on a busy machine
    for (let i = 0; i < 9; ++i) await page.keyboard.press("+"); // beyond the deepest tiles
    await until("requested and missing", () => tiles.asked.some((t) => t.z > 16));
    await page.waitForTimeout(500);
    await shoot("tiles_near");
    const zoomed = (await page.locator(canvas).getAttribute("data-view")).split(",").map(Number);
    const [first] = await colours_at(browser, page, canvas, [[box.width / 2, 8]]);
    assert.ok(
      Math.max(...first) - Math.min(...first) > 15,
      `a coarser tile replaces it: ${first} at ${zoomed}`,
    );
    assert.ok(
      tiles.asked.every((t) => t.referer === `http://127.0.0.1:${port}/`),
      "no token is sent", // the address of the page may contain one
    );
    assert.ok(tiles.asked.length < 300);
    await page.goto("about:blank"); // ends the open requests first
    tiles.close();
    const others = foreign.filter((url) => !url.startsWith(`http://127.0.0.1:${tiles.port}/`));
    foreign.splice(0, foreign.length, ...others);
    const harmless = faults.filter((f) => !f.includes("404"));
    faults.splice(0, faults.length, ...harmless);
  },
});

const near = (a, b, room, strict = true) => {
  const holds = Math.abs(a - b) <= room;
  assert.ok(holds || !strict, `${a} is not ${b}`);
  return holds;
};
const plan = async () =>
  JSON.parse((await ask("echo", "plan.plan", "--count", "1", "--json")).split("\n")[0]).value;
const position_of = async (i) => (await plan()).waypoints[i].position_m;

const browser = await browse(modules, chromium);
let failed = 0;
try {
  flight = await fly(fulmar, port, join(folder, "hostile.yaml"));
  page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
  page.setDefaultTimeout(15_000);
  page.on("pageerror", (e) => faults.push(e.message));
  page.on(
    "console",
    (m) =>
      m.type() === "error" &&
      !m.text().includes("WebSocket") &&
      faults.push(`${m.text()} ${m.location().url}`),
  );
  page.on(
    "request",
    (r) =>
      new URL(r.url()).host !== `127.0.0.1:${port}` && !r.url().startsWith("data:") && foreign.push(r.url()),
  );
  for (const [name, step] of Object.entries(steps())) {
    const begun = Date.now();
    try {
      await step();
      console.log(`ok     ${((Date.now() - begun) / 1000).toFixed(1)} s  ${name}`);
    } catch (fault) {
      ++failed;
      console.log(`FAILED ${name}\n${fault.stack}`);
      await page.screenshot({ path: join(shots, "failed.png") }).catch(() => {});
    }
  }
  assert.deepEqual(foreign, [], "requests to other servers");
  assert.deepEqual(faults, [], "faults of the page");
} finally {
  await browser.close();
  await flight?.end();
  tiles?.close();
  rmSync(folder, { recursive: true, force: true });
}
process.exit(failed === 0 ? 0 : 1);
