// SPDX-License-Identifier: BSD-3-Clause
// node words_test.mjs NODE_MODULES [ROUTE_POINTS]: computations of the page, without a browser: types, messages, the route, edits, plan files, steps.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { pilot_tests } from "./pilot_tests.mjs";
import { plan_tests } from "./plan_tests.mjs";
import { route_tests } from "./route_tests.mjs";
import { tile_tests } from "./tile_tests.mjs";
import { view_tests } from "./view_tests.mjs";

const web = join(dirname(fileURLToPath(import.meta.url)), "..");
const modules = resolve(process.argv[2] ?? join(web, "node_modules"));
if (!existsSync(join(modules, "typescript"))) {
  console.log("skipped: the page's packages are not there: build the target `page`");
  process.exit(77);
}
const folder = mkdtempSync(join(tmpdir(), "fulmar-words-"));
const { buildSync } = createRequire(join(modules, "x.js"))("esbuild");
async function load(file) {
  const outfile = join(folder, file.replace(/\W/g, "_") + ".mjs");
  buildSync({
    entryPoints: [join(web, "src", file)],
    outfile,
    bundle: true,
    format: "esm",
    nodePaths: [modules],
    logLevel: "error",
  });
  return import(pathToFileURL(outfile));
}
const near = (a, b, room, what = "") =>
  assert.ok(Math.abs(a - b) <= room, `${what} ${a} is not ${b} within ${room}`);

const { decode, number_paths, parse_schema } = await load("protocol/schema.ts");
const { draw_wiring } = await load("flight/wiring.ts");
const { bearing, clock, digits, fixed, shown_unit, with_unit } = await load("units.ts");

const { verdict_of } = await load("report/verdict.ts");

const tests = {
  ...tile_tests(await load("flight/tiles.ts"), near),
  ...view_tests(
    await load("flight/labels.ts"),
    await load("flight/rates.ts"),
    await load("flight/step.ts"),
    near,
  ),
  ...route_tests(await load("flight/route.ts"), await load("flight/piece.ts"), process.argv[3], near),
  ...plan_tests(await load("flight/plan_edits.ts"), await load("flight/plan_file.ts"), web, near),
  ...pilot_tests(
    await load("flight/alerts.ts"),
    await load("flight/places.ts"),
    await load("track.ts"),
    near,
  ),
  "a log without a verdict is a fault only if it is truncated"() {
    const log = (verdict, fault = "") =>
      verdict_of({ verdict: { words: "", severity: "", ...verdict }, fault, end_s: 61 });
    assert.deepEqual(log({ words: "crashed: nose", severity: "error" }), {
      words: "Crashed: nose",
      bad: true,
    });
    assert.equal(log({ words: "flown (done)", severity: "info" }).bad, false);
    const cut = log({}, "byte 5 is no record");
    assert.ok(cut.bad && cut.words.includes("byte 5"));
    assert.ok(!log({}).bad && !/killed/.test(log({}).words), log({}).words);
  },
  "messages are decoded from XCDR1: alignment, lists, texts, enumerations"() {
    const schema = [
      "uint8 OFF=0",
      "uint8 ON=3",
      "uint8 state",
      "float64 height_m  # m",
      "string name",
      "bool good",
      "pkg/P[<=4] points",
      "int64 at_ns",
      "float64[2] pair_rad",
      "=".repeat(80),
      "MSG: pkg/P",
      "float64 north",
      "uint16 kind",
    ].join("\n");
    const fields = parse_schema("pkg/msg/M", schema);
    assert.deepEqual(
      fields.map((f) => f.name),
      ["state", "height_m", "name", "good", "points", "at_ns", "pair_rad"],
    );
    const bytes = new DataView(new ArrayBuffer(200));
    let at = 7 + 4; // the message begins behind a head of 7 bytes, and counts its alignment from behind its own 4
    const pad = (n) => (at += (n - ((at - 11) % n)) % n);
    const put = (size, write) => (pad(size), write(at), (at += size));
    const f64 = (v) => put(8, (i) => bytes.setFloat64(i, v, true)),
      u32 = (v) => put(4, (i) => bytes.setUint32(i, v, true));
    const u8 = (v) => put(1, (i) => bytes.setUint8(i, v));
    bytes.setUint8(8, 1);
    u8(3);
    f64(-1.25);
    u32(3);
    u8(0xc3);
    u8(0xa4);
    u8(0);
    u8(1);
    u32(2);
    for (const [n, k] of [
      [1.5, 7],
      [2.5, 65535],
    ])
      (f64(n), put(2, (i) => bytes.setUint16(i, k, true)));
    put(8, (i) => bytes.setBigInt64(i, -5n, true));
    f64(0.5);
    f64(-0.5);
    assert.deepEqual(decode(fields, bytes, 7), {
      state: "on",
      height_m: -1.25,
      name: "ä",
      good: true,
      points: [
        { north: 1.5, kind: 7 },
        { north: 2.5, kind: 65535 },
      ],
      at_ns: -5,
      pair_rad: [0.5, -0.5],
    });
    assert.throws(() => decode(fields, new DataView(bytes.buffer, 0, 40), 7), RangeError);
    assert.deepEqual(number_paths(fields), [
      { path: "height_m", unit: "m" },
      { path: "good", unit: "" },
      { path: "at_ns", unit: "ns" },
    ]);
  },
  "labels lose the name of their field if all of them have it"() {
    const [code, plain] = parse_schema(
      "p/M",
      "uint8 CODE_A_B=0\nuint8 CODE_C=1\nuint8 code\nuint8 RIGHT=0\nuint8 LEFT=1\nuint8 turn\n",
    );
    assert.deepEqual(code.labels, ["a_b", "c"]);
    assert.deepEqual(plain.labels, ["right", "left"]);
  },
  "connections are drawn in layers, between the boxes, without overlap: twenty components on one screen"() {
    const part = (name, role, inputs, outputs) => ({
      name,
      role,
      inputs: inputs.map((source, i) => ({ name: `in${i}`, source })),
      outputs: outputs.map((o) => ({ name: o, type: "p/" + o })),
    });
    const sensors = ["imu", "gnss", "mag", "baro", "pitot"],
      v = (names) => names.map((n) => "vehicle." + n);
    const parts = [
      part(
        "score",
        "",
        ["nav.state", "vehicle.truth", "manage.path", "outer.attitude", "inner.actuators", "guide.command"],
        ["figures"],
      ),
      part("plan", "", ["nav.state", "ghost.plan"], ["plan", "notices"]),
      part("manage", "", ["nav.state", "plan.plan"], ["path", "progress"]),
      part("sim", "vehicle", ["inner.actuators"], [...sensors, "rc", "VehicleStatus", "truth"]),
      part("ekf", "nav", [...v(sensors), "vehicle.VehicleStatus"], ["state", "health"]),
      part("truth", "nav", ["vehicle.truth"], ["state"]),
      ...["follow", "carrot", "lookahead"].map((n) =>
        part(n, "guide", ["nav.state", "manage.path"], ["command"]),
      ),
      ...["slc", "tecs", "mine"].map((n) => part(n, "outer", ["nav.state", "guide.command"], ["attitude"])),
      part("attitude", "inner", ["nav.state", "outer.attitude"], ["actuators"]),
      part("autotune", "inner", ["nav.state", "outer.attitude", "joystick.rc"], ["actuators"]),
      part("joystick", "", [], ["rc"]),
      part("safety", "", ["nav.state", "nav.health", "vehicle.VehicleStatus", "vehicle.rc"], ["state"]),
      part("home", "", ["nav.state", "safety.state"], ["plan", "path"]),
      part("landing", "", ["nav.state", "home.path"], ["path", "progress"]),
      part("scene", "", ["nav.state", "plan.plan", "vehicle.gnss"], ["tf"]),
      part("reference_receiver", "", [], ["gnss"]),
    ];
    assert.equal(parts.length, 20);
    const { width, height, boxes, wires } = draw_wiring(parts, (p) => Math.max(16, p.role.length));
    assert.ok(width <= 1240 && height <= 520, `${width} x ${height}`);
    const box = (name) => boxes.find((b) => b.name === name),
      layer = (name) => box(name).layer;
    assert.deepEqual(
      ["sim", "ekf", "plan", "manage", "follow", "slc", "attitude", "score"].map(layer),
      [0, 1, 2, 3, 4, 5, 6, 7],
    );
    assert.deepEqual(["truth", "carrot", "mine", "autotune", "joystick"].map(layer), [1, 4, 5, 6, 5]); // who fills a role beside the others, who reads nothing before its reader
    boxes.forEach((a, i) =>
      boxes
        .slice(i + 1)
        .forEach((b) =>
          assert.ok(
            a.x + a.width < b.x || b.x + b.width < a.x || a.y + a.height < b.y || b.y + b.height < a.y,
            a.name + " on " + b.name,
          ),
        ),
    );
    const readers = parts.flatMap((p) => p.inputs.map((i) => i.source)).filter((s) => s !== "ghost.plan");
    const writers = (source) => {
      const [owner, port] = source.split(".");
      return parts.filter(
        (p) => (p.name === owner || p.role === owner) && p.outputs.some((o) => o.name === port),
      ).length;
    };
    assert.equal(
      wires.length,
      readers.reduce((sum, s) => sum + writers(s), 0),
    );
    const pieces = [];
    for (const w of wires) {
      const a = box(w.from),
        b = box(w.to),
        [first, last] = [w.points[0], w.points[w.points.length - 1]];
      assert.ok(first[0] === a.x + a.width && first[1] > a.y && first[1] < a.y + a.height, w.source);
      assert.ok(last[0] === b.x && last[1] > b.y && last[1] < b.y + b.height, w.source + " " + w.to);
      w.points.slice(1).forEach(([x2, y2], i) => {
        const [x1, y1] = w.points[i];
        assert.ok(x1 === x2 || y1 === y2, "neither level nor upright");
        const [l, r, t, u] = [Math.min(x1, x2), Math.max(x1, x2), Math.min(y1, y2), Math.max(y1, y2)];
        assert.ok(l >= 0 && r <= width && t >= 0 && u <= height);
        for (const c of boxes)
          assert.ok(
            r <= c.x || l >= c.x + c.width || u <= c.y || t >= c.y + c.height,
            `${w.source} runs through ${c.name}`,
          );
        pieces.push({ source: w.source, l, r, t, u });
      });
    }
    // lines of two ports may cross, but never lie on each other
    for (const p of pieces)
      for (const q of pieces) {
        if (p.source === q.source) continue;
        const level = p.t === p.u && q.t === q.u && p.t === q.t && Math.min(p.r, q.r) > Math.max(p.l, q.l);
        const upright = p.l === p.r && q.l === q.r && p.l === q.l && Math.min(p.u, q.u) > Math.max(p.t, q.t);
        assert.ok(!level && !upright, `${p.source} on ${q.source}`);
      }
    assert.deepEqual(draw_wiring([], () => 0).wires, []);
    const loop = draw_wiring([part("a", "", ["b.x"], ["x"]), part("b", "", ["a.x"], ["x"])], () => 0); // in a circle, without a vehicle
    assert.deepEqual(
      loop.boxes.map((b) => b.layer),
      [0, 1],
    );
  },
  "displayed numbers"() {
    assert.deepEqual(
      [digits(0.01234), digits(12.34), digits(1234.5), digits(0), digits(NaN), digits(1e-6)],
      ["0.0123", "12.3", "1235", "0", "–", "1.00e-6"],
    );
    assert.deepEqual(
      [
        fixed(-0.01, 1, "m"),
        fixed(2.25, 1, "°"),
        fixed(undefined, 1, "m"),
        with_unit(70, "m"),
        with_unit(12, "°/s"),
      ],
      ["0.0 m", "2.3°", "–", "70 m", "12°/s"],
    );
    assert.deepEqual(
      [bearing(0), bearing(-Math.PI / 2), bearing(2 * Math.PI - 1e-9), bearing(NaN)],
      ["000°", "270°", "000°", "–"],
    );
    assert.deepEqual([clock(-5), clock(61.25), clock(NaN)], ["−0:05.0", "1:01.3", "–"]);
    near(shown_unit("rad/s").scale, 180 / Math.PI, 1e-12);
    assert.equal(shown_unit("rad/rad").scale, 1);
  },
  "types agree"() {
    // in the folder of the packages
    const config = {
      extends: join(web, "tsconfig.json"),
      include: [join(web, "src")],
      compilerOptions: {
        paths: { "*": [join(modules, "@types/*"), join(modules, "*")] },
        typeRoots: [join(modules, "@types")],
      },
    };
    writeFileSync(join(folder, "tsconfig.json"), JSON.stringify(config));
    execFileSync(process.execPath, [join(modules, "typescript/bin/tsc"), "-p", folder], { stdio: "inherit" });
  },
};

let failed = 0;
for (const [name, test] of Object.entries(tests)) {
  try {
    await test();
    console.log("ok     " + name);
  } catch (fault) {
    ++failed;
    console.log(`FAILED ${name}\n${fault.stack}`);
  }
}
rmSync(folder, { recursive: true, force: true });
process.exit(failed === 0 ? 0 : 1);
