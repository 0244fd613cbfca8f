// SPDX-License-Identifier: BSD-3-Clause
// node page_test.mjs FULMAR NODE_MODULES CHROMIUM: flies in real time, and drives the page as a person would. What it changed is asked
// of the flight by the command line.
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { copyFileSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { promisify } from "node:util";
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
/** The command line's word for it. */
const ask = async (...words) => (await run(fulmar, [...words, ...at])).stdout.trim();
const value_of = async (field) => Number((await ask("echo", field, "--count", "1", "--csv")).split("\n")[1].split(",")[1]);

// Names that would be markup, if a page took them for it.
const folder = mkdtempSync(join(tmpdir(), "fulmar-page-"));
const hostile = "<img src=x onerror=document.body.remove()>";
copyFileSync("configs/airframes/anaconda.yaml", join(folder, "mine.yaml")); // what is saved goes into a file of our own
writeFileSync(join(folder, "hostile.yaml"), `mission: "${hostile}"\nextends: ${resolve("configs/missions/hourglass.yaml")}\nairframe: mine.yaml\n`);

// A place of the mission's map that neither plan nor aircraft covers, by the radii of curvature of WGS 84 there (to 3 mm).
const coloured = { n: 200, e: 200, lat: 40.2463724 + ((200 / 6363474) * 180) / Math.PI, lon: -111.6474138 + ((200 / 4876137) * 180) / Math.PI };

let page, flight, tiles;
const faults = [], foreign = [];
const shots = shots_folder(modules);
const text = (selector) => page.locator(selector).first().textContent();
const tab = (name) => page.click(`#tabs button[data-page="${name}"]`);
const seen = (what, selector, holds, patience) => until(what, async () => holds((await page.locator(selector).allTextContents()).join("\n")), patience);

/** Nothing may be wider than its box, and the page not than its window. */
async function whole(name) {
  const cut = () => page.evaluate(() => {
    const hidden = (e) => getComputedStyle(e).overflowX !== "visible"; // nobody scrolls to the right to read a number
    const list = [...document.querySelectorAll("body *")].filter((e) => e.tagName !== "CANVAS" && e.clientWidth > 0 && e.scrollWidth > e.clientWidth + 1 && hidden(e));
    if (document.documentElement.scrollWidth > innerWidth) list.push(document.documentElement);
    return list.map((e) => `${e.tagName}.${e.className} ${(e.value ?? e.textContent ?? "").slice(0, 40)}`);
  });
  await until("drawn for this window", async () => (await cut()).length === 0).catch(() => {}); // charts follow it by and by
  assert.deepEqual(await cut(), [], name + ": cut off");
}
async function shoot(name) {
  for (const [width, height] of [[1280, 720], [1024, 768]]) {
    await page.setViewportSize({ width, height });
    await page.waitForTimeout(250);
    await whole(`${name} ${width}`);
    await page.screenshot({ path: join(shots, `${name}_${width}.png`) });
  }
  await page.setViewportSize({ width: 1280, height: 720 });
}

const steps = {
  async "the page comes from the flight alone, and soon"() {
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
      // Words alone, and of the view, the answer of a service, a component of another name.
      server.onMessage((m) => {
        if (typeof m === "string") ws.send(m);
        else if (m[0] === 3) ws.send(Buffer.from(m.toString("latin1").replaceAll('"name":"slc"', `"name":"${hostile}"`), "latin1"));
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
    await until("real time", async () => (await ask("list")).includes("speed real") || !(await ask("list")).includes("speed 10"));
  },
  async "Fly: what there is to see"() {
    await tab("Fly");
    await seen("what happened before it was opened, too", ".events", (t) => /−0:05\.0.phase hold/.test(t) && t.includes("0:00.0·phase takeoff") && t.includes("phase cruise"));
    await seen("a height", ".figures", (t) => /ground speed\d+\.\d m\/s/.test(t));
    await seen("who flies", ".side .pairs", (t) => t.includes("outerslc") && t.includes("navekf") && t.includes("GNSS position✓ ok"));
    await until("a picture of the aircraft", () => page.evaluate(() => document.querySelector(".chase canvas")?.width > 300));
    await shoot("fly");
  },
  async "Plan: a waypoint that is dragged is dragged in the flight, and so is the target"() {
    await tab("Plan");
    await seen("the waypoints", ".waypoints tbody th", (t) => t.split("\n").length === 4);
    await shoot("plan");
    const item = await value_of("manage.progress.item");
    const box = await page.locator(".plan canvas.map").boundingBox();
    const [n, e, px] = (await page.locator(".plan canvas.map").getAttribute("data-view")).split(",").map(Number);
    const at_m = await position_of(item);
    const x = box.width / 2 + (at_m.east - e) * px, y = box.height / 2 - (at_m.north - n) * px;
    // away from the aircraft, so that it is farther whatever the aircraft flies meanwhile
    const from = { north: await value_of("nav.state.position_m.north"), east: await value_of("nav.state.position_m.east") };
    const way = Math.hypot(at_m.north - from.north, at_m.east - from.east), far_px = 110;
    const to = [x + (far_px * (at_m.east - from.east)) / way, y - (far_px * (at_m.north - from.north)) / way];
    await page.mouse.move(box.x + x, box.y + y);
    await page.mouse.down();
    await page.mouse.move(box.x + (x + to[0]) / 2, box.y + (y + to[1]) / 2, { steps: 4 });
    await page.mouse.move(box.x + to[0], box.y + to[1], { steps: 4 });
    await page.mouse.up();
    await until("the flight's waypoint has moved", async () => (await position_of(item)).north !== at_m.north);
    await seen("what is drawn flies", ".plan .faint", (t) => t.includes("This is what flies"));
    await until("the aircraft flies to it", async () => {
      const aim = await position_of(item), is = await value_of("manage.progress.distance_m");
      const now = { north: await value_of("nav.state.position_m.north"), east: await value_of("nav.state.position_m.east") };
      return Math.abs(Math.hypot(aim.north - now.north, aim.east - now.east) - is) < 0.3 * (far_px / px);
    });
  },
  async "Plan: what is refused says why, in its row, and what flies stays"() {
    const field = page.getByLabel("up of waypoint 2, m");
    await field.fill("-30");
    await field.press("Enter");
    await seen("the reason", ".waypoints .refusal", (t) => t === "Refused: lower than the planner allows: its parameter 'lowest'");
    assert.equal(await page.locator(".waypoints tbody tr:has(.refusal)").evaluate((row) => row.previousElementSibling.dataset.at), "2");
    await shoot("plan_refused");
    await page.click("text=Back to what flies");
    await until("the old height", async () => (await field.inputValue()) === "70");
  },
  async "Plan: added, moved up, removed"() {
    const box = await page.locator(".plan canvas.map").boundingBox();
    await page.mouse.click(box.x + box.width - 120, box.y + box.height / 2);
    await until("five waypoints in the flight", async () => (await plan()).waypoints.length === 5);
    await seen("and on the page", ".waypoints tbody th", (t) => t.split("\n").length === 5);
    const before = (await plan()).waypoints;
    await page.click('[aria-label="Earlier, waypoint 4"]');
    await until("its place is another", async () => {
      const now = (await plan()).waypoints;
      const same = (i, k) => JSON.stringify(now[i].position_m) === JSON.stringify(before[k].position_m);
      return now.length === 5 && same(3, 4) && same(4, 3) && [0, 1, 2].every((i) => now[i].id === before[i].id);
    });
    await page.click('[aria-label="Remove, waypoint 3"]');
    await until("four again", async () => (await plan()).waypoints.length === 4);
  },
  async "Plan: what is saved is the plan of a flight that is fit to fly, and what is loaded is a draft until it is uploaded"() {
    const [saved] = await Promise.all([page.waitForEvent("download"), page.click("text=Save file")]);
    assert.equal(saved.suggestedFilename(), "plan.yaml");
    const file = join(folder, "plan.yaml");
    await saved.saveAs(file);
    const mission = join(folder, "again.yaml"), before = await plan();
    writeFileSync(mission, `mission: again\nextends: ${resolve("configs/missions/hourglass.yaml")}\ncomponents: {plan: {params: {plan: plan.yaml}}}\n`);
    await run(fulmar, ["check", mission]);
    const words = readFileSync(file, "utf8"), first = /north: (\S+) m/.exec(words)[1];
    near(Number(first), before.waypoints[0].position_m.north, 0.01);
    const load = (text) => page.locator("input[type=file]").setInputFiles({ name: "mine.yaml", mimeType: "application/yaml", buffer: Buffer.from(text) });
    await load(words.replace("up: 70 m", "up: 70 kg"));
    await seen("what is wrong with it", ".plan .refusal", (t) => t === "Refused: mine.yaml: waypoint 0: up: '70 kg' is no length. Valid units: m, km, ft");
    await load(words.replace(`north: ${first} m`, "north: 432.1 m"));
    await seen("a draft", ".plan .faint", (t) => t.includes("the aircraft flies the old plan until this is uploaded"));
    assert.equal((await plan()).waypoints[0].position_m.north, before.waypoints[0].position_m.north);
    await page.click("text=Upload");
    await until("it flies", async () => near((await plan()).waypoints[0].position_m.north, 432.1, 0.01, false));
    assert.equal((await plan()).waypoints[1].id, before.waypoints[1].id, "the others are as they were");
    const runway = "runway: {north: 0 m, east: 0 m, up: 0 m, heading: 135 deg, length: 300 m}", place = "{lat: 40.2499724, lon: -111.6501138, alt_msl: 1457 m";
    await load(words.replace(/\{north: \S+ m, east: \S+ m, up: \S+ m/, place) + runway + "\n");
    await page.click("text=Upload");
    await until("it flies", async () => near((await plan()).waypoints[0].position_m.north, 399.8, 1, false));
    await seen("as it flies", ".plan .faint", (t) => t.includes("This is what flies"));
    const [kept] = await Promise.all([page.waitForEvent("download"), page.click("text=Save file")]);
    await kept.saveAs(file);
    assert.ok(readFileSync(file, "utf8").includes(place) && readFileSync(file, "utf8").includes(runway), readFileSync(file, "utf8"));
    await run(fulmar, ["check", mission]);
  },
  async "Tune: a slider sets the parameter of the flight, and the way back"() {
    await tab("Tune");
    const row = page.locator('[data-param="roll_kp"]');
    const before = await ask("param", "get", "attitude.roll_kp");
    await row.locator("input[type=range]").focus();
    for (let i = 0; i < 5; ++i) await page.keyboard.press("ArrowRight");
    await until("the flight's value", async () => (await ask("param", "get", "attitude.roll_kp")) !== before);
    await page.click("text=Save attitude…");
    await seen("who else has that text", ".side [role=alert]", (t) => t.includes("attitude.roll_kp is the same text for control_slc/Autotune, which does not fly"));
    await row.locator("input[type=text]").fill("900");
    await row.locator("input[type=text]").press("Enter");
    await seen("the range", '[data-param="roll_kp"] .refusal', (t) => t === "Refused: attitude.roll_kp: 900 is outside 0 .. 20 rad/rad" || t.includes("outside 0 .. 20"));
    await shoot("tune");
    await row.locator("button").click();
    await until("as it was", async () => (await ask("param", "get", "attitude.roll_kp")) === before);
  },
  async "Tune: what is saved are the lines that were shown, and no others"() {
    await page.click('button[data-component="slc"]');
    const row = page.locator('[data-param="course_kp"]'), field = row.locator("input[type=text]"), before = await field.inputValue();
    await field.fill("2.25");
    await field.press("Enter");
    await page.click("text=Save slc…");
    await seen("the lines that would change", ".lines", (t) => /^mine\.yaml:\d+\n- .*course_kp.*\n\+ .*course_kp/m.test(t));
    await shoot("save");
    const airframe = () => readFileSync(join(folder, "mine.yaml"), "utf8"), old = airframe();
    writeFileSync(join(folder, "mine.yaml"), old + "# another's\n"); // somebody edits meanwhile
    await page.click("text=Write these lines");
    await seen("why not", ".side [role=alert]", (t) => t.includes("Refused: what would be written is not what was shown any more: look again"));
    assert.equal(airframe(), old + "# another's\n");
    await page.click("text=Save slc…");
    await page.click("text=Write these lines");
    await seen("what was written", ".side [role=alert]", (t) => t.includes("Written: ") && t.includes("mine.yaml"));
    const lines = (text) => text.split("\n").slice(0, -1), now = lines(airframe());
    assert.equal(now.pop(), "# another's");
    assert.equal(now.filter((line, i) => line !== lines(old)[i]).length, 1);
    assert.match(airframe(), /course_kp: 2.25/);
    await shoot("saved");
    await page.click("text=Save slc…");
    await seen("no more to write", ".side [role=alert]", (t) => t.includes("The files say already what flies."));
    await field.fill(before);
    await field.press("Enter");
    await until("as it was", async () => (await ask("param", "get", "slc.course_kp")).startsWith(before));
  },
  async "Wires: rates, step times, and a swap that is refused in the air by the host's sentence"() {
    await tab("Wires");
    await page.click("button.link >> text=slc");
    await seen("a step time", ".wires tbody tr", (t) => /slc.*\d µs/.test(t));
    await seen("the rate of what it publishes", ".twotables", (t) => /→ (?=[a-z., ]*attitude\.attitude)(?=[a-z., ]*score\.attitude)[a-z., ]*(9\d|10\d)(\.\d)? Hz/.test(t));
    await page.getByLabel("Plugin in place of slc").fill("control_tecs/Outer");
    await page.keyboard.press("Enter");
    await seen("the sentence", ".wires .refusal", (t) => /slc cannot be swapped: the aircraft is .*A component is swapped on the ground, disarmed/.test(t));
    await seen("its wires, lit", ".wiring .lit title", (t) => t.split("\n").length === 5 && /nav\.state → slc\.state: 400 Hz, \d+ ms old/.test(t) && t.includes("outer.attitude → attitude.attitude"));
    assert.equal(await page.locator(".wiring .component").count(), JSON.parse(await ask("list", "--json")).components.length);
    await page.locator(".wiring [data-component=slc]").focus();
    await page.keyboard.press("ArrowRight");
    await seen("the next one, by the keyboard", ".wires h2", (t) => t.startsWith("attitude: "));
    await until("it has the focus, and says so", () => page.evaluate(() => document.activeElement.getAttribute("aria-pressed") === "true"));
    await page.keyboard.press("ArrowLeft");
    await page.keyboard.press("ArrowDown");
    await seen("the one below", ".wires h2", (t) => t.startsWith("tecs: "));
    const cut = await page.evaluate(() => [...document.querySelectorAll(".wiring .component")].flatMap((g) => {
      const box = g.querySelector("rect").getBBox();
      return [...g.querySelectorAll("text")].filter((t) => t.getBBox().x + t.getBBox().width > box.x + box.width || t.getBBox().y + t.getBBox().height > box.y + box.height).map((t) => t.textContent);
    }));
    assert.deepEqual(cut, [], "words wider than their box");
    await shoot("wires");
  },
  async "Simulation: paused, time stands; a step moves it by its ticks"() {
    await tab("Simulation");
    await page.click("text=Pause");
    await seen("paused", "#pace", (t) => t === "paused");
    const time = async () => Number(/([-\d.]+) s,/.exec(await ask("list"))[1]);
    const stands = await time();
    await page.waitForTimeout(300);
    assert.equal(await time(), stands);
    const late = await browser.newPage(); // who comes now sees how it stands
    await late.goto(`http://127.0.0.1:${port}/`);
    await until("figures of a flight that stands", async () => /ground speed\d+\.\d m\/s.*waypoint\d of 4/s.test((await late.locator(".figures").textContent()) ?? ""));
    const [minutes, seconds] = (await late.locator("#clock").textContent()).split(":").map(Number);
    near(60 * minutes + seconds, stands, 0.06);
    await late.close();
    await page.getByLabel("Ticks to step").fill("200");
    await page.click("button >> text=Step");
    await seen("done", ".sim .taken", (t) => t.includes("Flew 200 ticks"));
    assert.ok(Math.abs((await time()) - stands - 0.5) < 0.051, "200 ticks of 400 Hz");
    await shoot("simulation");
    await page.click("text=Resume");
    await until("time goes on", async () => (await time()) > stands + 0.7);
  },
  async "By hand: keys move the sticks, until they are given back"() {
    await tab("Fly");
    await page.click("text=Take the sticks");
    await until("the pilot flies", async () => (await ask("param", "get", "sim.pilot_flies")) === "true");
    await until("the sticks have the keys", () => page.locator(".sticks").evaluate((e) => e === document.activeElement));
    await page.keyboard.down("ArrowRight");
    await until("the stick", async () => Number(await ask("param", "get", "sim.stick_roll")) > 0.5);
    await page.keyboard.up("ArrowRight");
    await until("let go, in the middle", async () => Math.abs(Number(await ask("param", "get", "sim.stick_roll"))) < 0.01);
    await page.click("text=Give them back");
    await until("the autopilot flies", async () => (await ask("param", "get", "sim.pilot_flies")) === "false");
  },
  async "New flight: by two clicks, with another seed, on the same page"() {
    await tab("Simulation");
    assert.equal(await page.getByLabel("Seed of the new flight").inputValue(), "7");
    await page.getByLabel("Seed of the new flight").fill("eleven");
    const button = page.locator("button.chip", { hasText: /New flight|end this one/ });
    await button.click();
    await seen("the question", "button.chip.asked", (t) => t === "end this one?");
    await shoot("new_flight");
    await until("asked no more", async () => (await button.textContent()) === "New flight");
    for (let i = 0; i < 2; ++i) await button.click();
    await seen("what is no seed", ".sim [role=alert]", (t) => t.includes("Refused: seed 'eleven': give a whole number from 0"));
    await page.getByLabel("Seed of the new flight").fill("11");
    const before = await value_of("nav.state.height_m");
    assert.ok(before > 20, "in the air");
    const loaded = page.waitForEvent("load");
    for (let i = 0; i < 2; ++i) await button.click();
    await loaded;
    await seen("a flight from its beginning", "#clock", (t) => /^−?0:0\d/.test(t));
    await until("its seed", async () => (await page.getByLabel("Seed of the new flight").inputValue()) === "11");
    assert.ok(await page.locator("#banner").isHidden());
    assert.match(page.url(), /#simulation$/);
  },
  async "a flight that is gone is missed within a second, and found again"() {
    await tab("Fly");
    await until("all of it is here", () => page.evaluate(() => document.querySelector(".chase canvas")?.width > 300));
    const hidden = () => page.locator("#banner").isHidden();
    assert.ok(await hidden());
    // what the bar says when it comes up: how long ago the flight was heard
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
    writeFileSync(mission, `mission: tiles\nextends: ${resolve("configs/missions/hourglass.yaml")}\n` +
      `live: {tiles: "http://127.0.0.1:${tiles.port}/{z}/{x}/{y}.png", attribution: "Tiles of <b>nobody</b>"}\n`);
    const loaded = page.waitForEvent("load"); // of another flight the page is another one
    flight = await fly(fulmar, port, mission);
    await loaded;
    await until("the next flight", hidden);
  },
  async "Map: tiles lie where they belong, from where the mission says, and what does not come is no fault"() {
    await seen("whose they are", ".attribution", (t) => t === "Tiles of <b>nobody</b>");
    await tab("Plan");
    await page.locator(".plan canvas.map").focus();
    await until("tiles", () => tiles.asked.length > 3);
    await page.waitForTimeout(500);
    await shoot("tiles");
    // where four colours meet, the map has that place: to two pixels
    const canvas = ".plan canvas.map", off = 2;
    const box = await page.locator(canvas).boundingBox();
    await until("the colours", async () => {
      const [n, e, px] = (await page.locator(canvas).getAttribute("data-view")).split(",").map(Number); // it moves as news come
      const x = box.width / 2 + (coloured.e - e) * px, y = box.height / 2 - (coloured.n - n) * px;
      const found = await colours_at(browser, page, canvas, [[x - off, y - off], [x + off, y - off], [x - off, y + off], [x + off, y + off]]);
      return found.map(([r, g, b]) => (r > 150 && g < 120 ? "r" : r < 120 && g > 150 ? "g" : b > 150 ? "b" : r > 150 && g > 150 && b < 120 ? "y" : "?")).join("") === "rgby";
    }, 60); // a picture of a page with 3-D takes seconds where others compute
    for (let i = 0; i < 9; ++i) await page.keyboard.press("+"); // farther in than there are tiles
    await until("asked, and not there", () => tiles.asked.some((t) => t.z > 16));
    await page.waitForTimeout(500);
    await shoot("tiles_near");
    const zoomed = (await page.locator(canvas).getAttribute("data-view")).split(",").map(Number);
    const [first] = await colours_at(browser, page, canvas, [[box.width / 2, 8]]);
    assert.ok(Math.max(...first) - Math.min(...first) > 15, `what is coarser stands in: ${first} at ${zoomed}`);
    assert.ok(tiles.asked.every((t) => t.referer === `http://127.0.0.1:${port}/`), "the address of the page, which may hold a token, is not told");
    assert.ok(tiles.asked.length < 300);
    await page.goto("about:blank"); // before what it still asks for is gone
    tiles.close();
    const others = foreign.filter((url) => !url.startsWith(`http://127.0.0.1:${tiles.port}/`));
    foreign.splice(0, foreign.length, ...others);
    const harmless = faults.filter((f) => !f.includes("404"));
    faults.splice(0, faults.length, ...harmless);
  },
};

const near = (a, b, room, strict = true) => {
  const holds = Math.abs(a - b) <= room;
  assert.ok(holds || !strict, `${a} is not ${b}`);
  return holds;
};
const plan = async () => JSON.parse((await ask("echo", "plan.plan", "--count", "1", "--json")).split("\n")[0]).value;
const position_of = async (i) => (await plan()).waypoints[i].position_m;

const browser = await browse(modules, chromium);
let failed = 0;
try {
  flight = await fly(fulmar, port, join(folder, "hostile.yaml"));
  page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
  page.setDefaultTimeout(15_000);
  page.on("pageerror", (e) => faults.push(e.message));
  page.on("console", (m) => m.type() === "error" && !m.text().includes("WebSocket") && faults.push(`${m.text()} ${m.location().url}`));
  page.on("request", (r) => new URL(r.url()).host !== `127.0.0.1:${port}` && !r.url().startsWith("data:") && foreign.push(r.url()));
  for (const [name, step] of Object.entries(steps)) {
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
  assert.deepEqual(foreign, [], "asked of others");
  assert.deepEqual(faults, [], "faults of the page");
} finally {
  await browser.close();
  await flight?.end();
  tiles?.close();
  rmSync(folder, { recursive: true, force: true });
}
process.exit(failed === 0 ? 0 : 1);
