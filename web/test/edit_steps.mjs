// SPDX-License-Identifier: BSD-3-Clause
// Plan, Tune and Wires, driven like a user; a part of page_test.mjs.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { until } from "./fixture.mjs";

export const edit_steps = ({
  page,
  fulmar,
  folder,
  run,
  ask,
  value_of,
  plan,
  position_of,
  near,
  tab,
  seen,
  shoot,
}) => ({
  async "Plan: a dragged waypoint moves in the flight, and so does the target"() {
    await tab("Plan");
    await seen("the waypoints", ".waypoints tbody th", (t) => t.split("\n").length === 4);
    await shoot("plan");
    const item = await value_of("manage.progress.item");
    const box = await page.locator(".plan canvas.map").boundingBox();
    const [n, e, px] = (await page.locator(".plan canvas.map").getAttribute("data-view"))
      .split(",")
      .map(Number);
    const at_m = await position_of(item);
    const x = box.width / 2 + (at_m.east - e) * px,
      y = box.height / 2 - (at_m.north - n) * px;
    // away from the aircraft, so that the distance grows in any case
    const from = {
      north: await value_of("nav.state.position_m.north"),
      east: await value_of("nav.state.position_m.east"),
    };
    const way = Math.hypot(at_m.north - from.north, at_m.east - from.east),
      far_px = 110;
    const to = [x + (far_px * (at_m.east - from.east)) / way, y - (far_px * (at_m.north - from.north)) / way];
    await page.mouse.move(box.x + x, box.y + y);
    await page.mouse.down();
    await page.mouse.move(box.x + (x + to[0]) / 2, box.y + (y + to[1]) / 2, { steps: 4 });
    await page.mouse.move(box.x + to[0], box.y + to[1], { steps: 4 });
    await page.mouse.up();
    await until(
      "the flight's waypoint has moved",
      async () => (await position_of(item)).north !== at_m.north,
    );
    await seen("the plan is active", ".plan .faint", (t) => t.includes("This plan is active"));
    await until("the aircraft flies to it", async () => {
      const aim = await position_of(item),
        is = await value_of("manage.progress.distance_m");
      const now = {
        north: await value_of("nav.state.position_m.north"),
        east: await value_of("nav.state.position_m.east"),
      };
      return Math.abs(Math.hypot(aim.north - now.north, aim.east - now.east) - is) < 0.3 * (far_px / px);
    });
  },
  async "Plan: a rejected edit shows its reason in its row, and the active plan stays"() {
    const field = page.getByLabel("up of waypoint 2, m");
    await field.fill("-30");
    await field.press("Enter");
    await seen(
      "the reason",
      ".waypoints .refusal",
      (t) => t.startsWith("Rejected: ") && t.includes("'lowest'"),
    );
    const refused = page.locator(".waypoints tbody tr:has(.refusal)");
    assert.equal(await refused.evaluate((row) => row.previousElementSibling.dataset.at), "2");
    await shoot("plan_refused");
    await page.click("text=Discard draft");
    await until("the old height", async () => (await field.inputValue()) === "70");
  },
  async "Plan: waypoints are added, moved up, removed"() {
    const box = await page.locator(".plan canvas.map").boundingBox();
    await page.mouse.click(box.x + box.width - 120, box.y + box.height / 2);
    await until("five waypoints in the flight", async () => (await plan()).waypoints.length === 5);
    await seen("and on the page", ".waypoints tbody th", (t) => t.split("\n").length === 5);
    const before = (await plan()).waypoints;
    await page.click('[aria-label="Earlier, waypoint 4"]');
    await until("its place is another", async () => {
      const now = (await plan()).waypoints;
      const same = (i, k) => JSON.stringify(now[i].position_m) === JSON.stringify(before[k].position_m);
      return (
        now.length === 5 && same(3, 4) && same(4, 3) && [0, 1, 2].every((i) => now[i].id === before[i].id)
      );
    });
    await page.click('[aria-label="Remove, waypoint 3"]');
    await until("four again", async () => (await plan()).waypoints.length === 4);
  },
  async "Plan: a saved file is a valid plan, and a loaded file is a draft until the upload"() {
    const [saved] = await Promise.all([page.waitForEvent("download"), page.click("text=Save file")]);
    assert.equal(saved.suggestedFilename(), "plan.yaml");
    const file = join(folder, "plan.yaml");
    await saved.saveAs(file);
    const mission = join(folder, "again.yaml"),
      before = await plan();
    writeFileSync(
      mission,
      `mission: again\nextends: ${resolve("configs/missions/hourglass.yaml")}\ncomponents: {plan: {params: {plan: plan.yaml}}}\n`,
    );
    await run(fulmar, ["check", mission]);
    const words = readFileSync(file, "utf8"),
      first = /north: (\S+) m/.exec(words)[1];
    near(Number(first), before.waypoints[0].position_m.north, 0.01);
    const load = (text) =>
      page
        .locator("input[type=file]")
        .setInputFiles({ name: "mine.yaml", mimeType: "application/yaml", buffer: Buffer.from(text) });
    await load(words.replace("up: 70 m", "up: 70 kg"));
    await seen(
      "what is wrong with it",
      ".plan .refusal",
      (t) => t.startsWith("Rejected: mine.yaml: waypoint 0: up: '70 kg'") && t.endsWith("m, km, ft"),
    );
    await load(words.replace(`north: ${first} m`, "north: 432.1 m"));
    await seen("a draft", ".plan .faint", (t) => t.includes("Draft: "));
    assert.equal((await plan()).waypoints[0].position_m.north, before.waypoints[0].position_m.north);
    await page.click("text=Upload");
    await until("it flies", async () =>
      near((await plan()).waypoints[0].position_m.north, 432.1, 0.01, false),
    );
    assert.equal((await plan()).waypoints[1].id, before.waypoints[1].id, "unchanged waypoint");
    const runway = "runway: {north: 0 m, east: 0 m, up: 0 m, heading: 135 deg, length: 300 m}",
      place = "{lat: 40.2499724, lon: -111.6501138, alt_msl: 1457 m";
    await load(words.replace(/\{north: \S+ m, east: \S+ m, up: \S+ m/, place) + runway + "\n");
    await page.click("text=Upload");
    await until("it flies", async () => near((await plan()).waypoints[0].position_m.north, 399.8, 1, false));
    await seen("as it flies", ".plan .faint", (t) => t.includes("This plan is active"));
    const [kept] = await Promise.all([page.waitForEvent("download"), page.click("text=Save file")]);
    await kept.saveAs(file);
    assert.ok(
      readFileSync(file, "utf8").includes(place) && readFileSync(file, "utf8").includes(runway),
      readFileSync(file, "utf8"),
    );
    await run(fulmar, ["check", mission]);
  },
  async "Tune: a slider sets the parameter of the flight, a button restores it"() {
    await tab("Tune");
    const row = page.locator('[data-param="roll_kp"]');
    const before = await ask("param", "get", "attitude.roll_kp");
    await row.locator("input[type=range]").focus();
    for (let i = 0; i < 5; ++i) await page.keyboard.press("ArrowRight");
    await until("the flight's value", async () => (await ask("param", "get", "attitude.roll_kp")) !== before);
    await page.click("text=Save attitude…");
    await seen(
      "who else has that text",
      ".side [role=alert]",
      (t) => t.includes("attitude.roll_kp ") && t.includes("control_slc/Autotune"),
    );
    await row.locator("input[type=text]").fill("900");
    await row.locator("input[type=text]").press("Enter");
    await seen("the range", '[data-param="roll_kp"] .refusal', (t) => t.includes("0 .. 20"));
    await shoot("tune");
    await row.locator("button").click();
    await until("as it was", async () => (await ask("param", "get", "attitude.roll_kp")) === before);
  },
  async "Tune: only the lines shown are saved"() {
    await page.click('button[data-component="slc"]');
    const row = page.locator('[data-param="course_kp"]'),
      field = row.locator("input[type=text]"),
      before = await field.inputValue();
    await field.fill("2.25");
    await field.press("Enter");
    await page.click("text=Save slc…");
    await seen("the lines that would change", ".lines", (t) =>
      /^mine\.yaml:\d+\n- .*course_kp.*\n\+ .*course_kp/m.test(t),
    );
    await shoot("save");
    const airframe = () => readFileSync(join(folder, "mine.yaml"), "utf8"),
      old = airframe();
    writeFileSync(join(folder, "mine.yaml"), old + "# another's\n"); // another editor writes in between
    await page.click("text=Write these lines");
    await seen("why not", ".side [role=alert].refusal", (t) => t.includes("preview"));
    assert.equal(airframe(), old + "# another's\n");
    await page.click("text=Save slc…");
    await page.click("text=Write these lines");
    await seen(
      "what was written",
      ".side [role=alert]",
      (t) => t.includes("Written: ") && t.includes("mine.yaml"),
    );
    const lines = (text) => text.split("\n").slice(0, -1),
      now = lines(airframe());
    assert.equal(now.pop(), "# another's");
    assert.equal(now.filter((line, i) => line !== lines(old)[i]).length, 1);
    assert.match(airframe(), /course_kp: 2.25/);
    await shoot("saved");
    await page.click("text=Save slc…");
    await seen("no more to write", ".side [role=alert].taken", (t) => t !== "" && !t.includes("Written: "));
    await field.fill(before);
    await field.press("Enter");
    await until("as it was", async () => (await ask("param", "get", "slc.course_kp")).startsWith(before));
  },
  async "Wires: rates, step times, and the host's message for a swap in the air"() {
    await tab("Wires");
    await page.click("button.link >> text=slc");
    await seen("a step time", ".wires tbody tr", (t) => /slc.*\d µs/.test(t));
    await seen("the rate of what it publishes", ".twotables", (t) =>
      /→ (?=[a-z., ]*attitude\.attitude)(?=[a-z., ]*score\.attitude)[a-z., ]*(9\d|10\d)(\.\d)? Hz/.test(t),
    );
    await page.getByLabel("Plugin in place of slc").fill("control_tecs/Outer");
    await page.keyboard.press("Enter");
    await seen("the sentence", ".wires .refusal", (t) =>
      /slc cannot be swapped: the aircraft is .*A component is swapped on the ground, disarmed/.test(t),
    );
    await seen(
      "its wires, lit",
      ".wiring .lit title",
      (t) =>
        t.split("\n").length === 5 &&
        /nav\.state → slc\.state: 400 Hz, \d+ ms old/.test(t) &&
        t.includes("outer.attitude → attitude.attitude"),
    );
    assert.equal(
      await page.locator(".wiring .component").count(),
      JSON.parse(await ask("list", "--json")).components.length,
    );
    await page.locator(".wiring [data-component=slc]").focus();
    await page.keyboard.press("ArrowRight");
    await seen("the next one, by the keyboard", ".wires h2", (t) => t.startsWith("attitude: "));
    await until("it has the focus, and says so", () =>
      page.evaluate(() => document.activeElement.getAttribute("aria-pressed") === "true"),
    );
    await page.keyboard.press("ArrowLeft");
    await page.keyboard.press("ArrowDown");
    await seen("the one below", ".wires h2", (t) => t.startsWith("tecs: "));
    const cut = await page.evaluate(() =>
      [...document.querySelectorAll(".wiring .component")].flatMap((g) => {
        const box = g.querySelector("rect").getBBox();
        return [...g.querySelectorAll("text")]
          .filter(
            (t) =>
              t.getBBox().x + t.getBBox().width > box.x + box.width ||
              t.getBBox().y + t.getBBox().height > box.y + box.height,
          )
          .map((t) => t.textContent);
      }),
    );
    assert.deepEqual(cut, [], "too wide");
    await shoot("wires");
  },
});
