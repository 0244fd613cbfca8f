// SPDX-License-Identifier: BSD-3-Clause
// node words_test.mjs NODE_MODULES [ROUTE_POINTS]: what the page computes, without a browser: types, messages, the route, edits, plan files, steps.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { pilot_tests } from "./pilot_tests.mjs";
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
  buildSync({ entryPoints: [join(web, "src", file)], outfile, bundle: true, format: "esm", nodePaths: [modules], logLevel: "error" });
  return import(pathToFileURL(outfile));
}
const near = (a, b, room, what = "") => assert.ok(Math.abs(a - b) <= room, `${what} ${a} is not ${b} within ${room}`);

const { decode, number_paths, parse_schema } = await load("protocol/schema.ts");
const { Route, dubins, wrap } = await load("flight/route.ts");
const { as_group, edits_between } = await load("flight/plan_edits.ts");
const { read_plan_file, write_plan_file } = await load("flight/plan_file.ts");
const { last_step, value_at } = await load("flight/step.ts");
const { piece_ahead } = await load("flight/piece.ts");
const { draw_wiring } = await load("flight/wiring.ts");
const { bearing, clock, digits, fixed, shown_unit, with_unit } = await load("units.ts");

const { verdict_of } = await load("report/verdict.ts");

const point = (north, east, up = 70, id = 0) => ({ north, east, up, course: null, airspeed: 0, id, geodetic: null });
const plan_of = (waypoints, end = "circuit", radius = 50) => ({ end, radius, airspeed: 17, waypoints });

const tests = {
  ...tile_tests(await load("flight/tiles.ts"), near),
  ...view_tests(await load("flight/labels.ts"), await load("flight/rates.ts")),
  ...pilot_tests(await load("flight/alerts.ts"), await load("flight/places.ts"), await load("track.ts"), near),
  "a log without a verdict is bad where it was cut, and only there"() {
    const log = (verdict, fault = "") => verdict_of({ verdict: { words: "", severity: "", ...verdict }, fault, end_s: 61 });
    assert.deepEqual(log({ words: "crashed: nose", severity: "error" }), { words: "Crashed: nose", bad: true });
    assert.equal(log({ words: "flown (done)", severity: "info" }).bad, false);
    const cut = log({}, "byte 5 is no record");
    assert.ok(cut.bad && cut.words.includes("byte 5"));
    assert.ok(!log({}).bad && !/killed/.test(log({}).words), log({}).words);
  },
  "messages are read as XCDR1 has them: alignment, lists, texts, enumerations"() {
    const schema = ["uint8 OFF=0", "uint8 ON=3", "uint8 state", "float64 height_m  # m", "string name", "bool good", "pkg/P[<=4] points", "int64 at_ns",
      "float64[2] pair_rad", "=".repeat(80), "MSG: pkg/P", "float64 north", "uint16 kind"].join("\n");
    const fields = parse_schema("pkg/msg/M", schema);
    assert.deepEqual(fields.map((f) => f.name), ["state", "height_m", "name", "good", "points", "at_ns", "pair_rad"]);
    const bytes = new DataView(new ArrayBuffer(200));
    let at = 7 + 4; // the message begins behind a head of 7 bytes, and counts its alignment from behind its own 4
    const pad = (n) => (at += (n - ((at - 11) % n)) % n);
    const put = (size, write) => (pad(size), write(at), (at += size));
    const f64 = (v) => put(8, (i) => bytes.setFloat64(i, v, true)), u32 = (v) => put(4, (i) => bytes.setUint32(i, v, true));
    const u8 = (v) => put(1, (i) => bytes.setUint8(i, v));
    bytes.setUint8(8, 1);
    u8(3); f64(-1.25); u32(3); u8(0xc3); u8(0xa4); u8(0); u8(1); u32(2);
    for (const [n, k] of [[1.5, 7], [2.5, 65535]]) f64(n), put(2, (i) => bytes.setUint16(i, k, true));
    put(8, (i) => bytes.setBigInt64(i, -5n, true));
    f64(0.5); f64(-0.5);
    assert.deepEqual(decode(fields, bytes, 7), {
      state: "on", height_m: -1.25, name: "ä", good: true, points: [{ north: 1.5, kind: 7 }, { north: 2.5, kind: 65535 }], at_ns: -5, pair_rad: [0.5, -0.5],
    });
    assert.throws(() => decode(fields, new DataView(bytes.buffer, 0, 40), 7), RangeError);
    assert.deepEqual(number_paths(fields), [{ path: "height_m", unit: "m" }, { path: "good", unit: "" }, { path: "at_ns", unit: "ns" }]);
  },
  "labels lose their field's name where all of them have it"() {
    const [code, plain] = parse_schema("p/M", "uint8 CODE_A_B=0\nuint8 CODE_C=1\nuint8 code\nuint8 RIGHT=0\nuint8 LEFT=1\nuint8 turn\n");
    assert.deepEqual(code.labels, ["a_b", "c"]);
    assert.deepEqual(plain.labels, ["right", "left"]);
  },
  "a right angle is rounded by a quarter of the circle (Beard & McLain, 11.1)"() {
    const plan = plan_of([point(0, 0), point(400, 0), point(400, 400), point(0, 400)]);
    const { entry, middle, exit, turn } = new Route(plan).passage(1);
    near(turn, Math.PI / 2, 1e-12);
    for (const [got, want] of [[entry.n, 350], [entry.e, 0], [exit.n, 400], [exit.e, 50], [middle.n, 350 + 50 * Math.SQRT1_2], [middle.e, 50 - 50 * Math.SQRT1_2]]) near(got, want, 1e-9);
    const length = new Route(plan).legs().flatMap(({ points }) => points.slice(1).map((p, i) => Math.hypot(p.n - points[i].n, p.e - points[i].e))).reduce((a, b) => a + b, 0);
    near(length, 4 * 300 + 2 * Math.PI * 50, 0.5);
  },
  "what is too tight for a fillet is passed through, every leg begins where the one before ends, no piece turns tighter than the radius"() {
    const plan = plan_of([point(0, 0), point(400, 0), { ...point(430, 30), course: -2 }, point(-100, 300), point(-100, 300.5), point(-80, -200)]);
    const legs = new Route(plan).legs();
    assert.equal(legs.length, 6);
    legs.forEach(({ points }, i) => {
      const before = legs[(i + 5) % 6].points;
      near(points[0].n, before[before.length - 1].n, 1e-6);
      near(points[0].e, before[before.length - 1].e, 1e-6);
      for (let k = 2; k < points.length; ++k) {
        const [a, b, c] = points.slice(k - 2, k + 1), l1 = Math.hypot(b.n - a.n, b.e - a.e), l2 = Math.hypot(c.n - b.n, c.e - b.e);
        if (l1 < 1e-6 || l2 < 1e-6) continue;
        const turn = Math.abs(wrap(Math.atan2(c.e - b.e, c.n - b.n) - Math.atan2(b.e - a.e, b.n - a.n)));
        assert.ok(turn <= (l1 + l2) / 2 / 50 + 0.02, `leg ${i} turns by ${turn} within ${l1} and ${l2} m`);
      }
    });
    const through = new Route(plan).passage(2).middle;
    assert.deepEqual([through.n, through.e, through.chi], [430, 30, -2]);
  },
  "Dubins paths end where they are to, and have the lengths of closed forms"() {
    let seed = 1;
    const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
    for (let k = 0; k < 300; ++k) {
      const pose = () => ({ n: 600 * random() - 300, e: 600 * random() - 300, chi: 6.28 * random() - 3.14 });
      const from = pose(), to = pose();
      let { n, e, chi } = from;
      for (const { curvature, length } of dubins(from, to, 40)) {
        if (curvature === 0) [n, e] = [n + length * Math.cos(chi), e + length * Math.sin(chi)];
        else {
          const after = chi + curvature * length;
          [n, e, chi] = [n + (Math.sin(after) - Math.sin(chi)) / curvature, e - (Math.cos(after) - Math.cos(chi)) / curvature, after];
        }
      }
      near(n, to.n, 1e-6); near(e, to.e, 1e-6); near(wrap(chi - to.chi), 0, 1e-8);
    }
    const length = (from, to) => dubins(from, to, 10).reduce((sum, p) => sum + p.length, 0);
    near(length({ n: 0, e: 0, chi: 0 }, { n: 100, e: 0, chi: 0 }), 100, 1e-9);
    near(length({ n: 0, e: 0, chi: 0 }, { n: 0, e: 20, chi: Math.PI }), 10 * Math.PI, 1e-9); // half a circle to the right
    near(length({ n: 0, e: 0, chi: 0 }, { n: 0, e: 0, chi: Math.PI }), 10 * (7 * Math.PI) / 3, 1e-6); // three arcs: pi/3, 5 pi/3, pi/3
  },
  "a plan that ends in an orbit reaches its circle along a tangent"() {
    const route = new Route(plan_of([point(0, 0), point(500, 0)], "orbit"));
    const { n, e, chi } = route.passage(1).middle;
    near(Math.hypot(n - 500, e), 50, 1e-9);
    near((n - 500) * Math.cos(chi) + e * Math.sin(chi), 0, 1e-9); // square to the radius
    near(Math.atan2(e, n), chi, 1e-9); // straight from the first waypoint
    const legs = route.legs();
    assert.deepEqual(legs.map((l) => l.to), [1, 1]);
    for (const p of legs[1].points) near(Math.hypot(p.n - 500, p.e), 50, 1e-9);
    assert.equal(new Route(plan_of([point(5, 5)])).legs()[0].points.length, 73);
    assert.deepEqual(new Route(plan_of([])).legs(), []);
  },
  "the route that is drawn is the one that is flown: fillets, courses, tight corners, points in one place, orbits"() {
    if (!process.argv[3]) return console.log("       not compared: route_points is not named");
    let seed = 7;
    const random = (most) => Math.floor((((seed = (seed * 16807) % 2147483647) - 1) / 2147483646) * most);
    const plans = Array.from({ length: 80 }, (_, k) => plan_of(Array.from({ length: 2 + random(7) }, (_, i) => {
      // far apart, or some too close for their fillets, or in one place
      const spread = k % 3 === 0 ? 2000 : k % 3 === 1 ? 500 : 120;
      return { ...point(random(spread) - spread / 2, random(spread) - spread / 2), course: random(4) === 0 ? random(628) / 100 - 3.14 : null, id: i + 1 };
    }), k % 2 === 0 ? "circuit" : "orbit", 20 + random(60)));
    plans.push(plan_of([point(0, 0), point(300, 0), point(300.4, 0), point(300, 300)]), plan_of([point(0, 0), point(400, 0), point(0, 10)]));
    const input = plans.map((p) => `${p.end} ${p.radius} ${p.waypoints.length}\n` + p.waypoints.map((w) => `${w.north} ${w.east} ${w.course ?? "-"}\n`).join("")).join("");
    const flown = execFileSync(process.argv[3], { input, maxBuffer: 1 << 28 }).toString().trim().split("\n");
    let at = 0, fillets = 0;
    const beside = (p, a, b) => {
      const l = Math.hypot(b.n - a.n, b.e - a.e), s = l > 0 ? Math.min(1, Math.max(0, ((p.n - a.n) * (b.n - a.n) + (p.e - a.e) * (b.e - a.e)) / l / l)) : 0;
      return Math.hypot(p.n - a.n - s * (b.n - a.n), p.e - a.e - s * (b.e - a.e));
    };
    const length = (points) => points.slice(1).reduce((sum, p, i) => sum + Math.hypot(p.n - points[i].n, p.e - points[i].e), 0);
    for (const plan of plans) {
      const drawn = new Route(plan);
      for (const { to, points } of drawn.legs()) {
        const head = flown[at++].split(" ");
        if (head[0] === "orbit") {
          for (const p of points) near(Math.hypot(p.n - Number(head[1]), p.e - Number(head[2])), Number(head[3]), 1e-6);
          continue;
        }
        assert.deepEqual(head, ["leg", String(to)]);
        if (drawn.passage(to).turn !== 0) ++fillets;
        const way = [];
        for (; /^[-\d]/.test(flown[at]); ++at) way.push({ n: Number(flown[at].split(" ")[0]), e: Number(flown[at].split(" ")[1]) });
        if (way.length === 0) { // from one point to another in the same place
          near(length(points), 0, 1e-6);
          continue;
        }
        for (const [p, q] of [[points[0], way[0]], [points[points.length - 1], way[way.length - 1]]]) near(Math.hypot(p.n - q.n, p.e - q.e), 0, 1e-5, JSON.stringify(plan));
        near(length(points), length(way), 2e-3 * length(way) + 1e-6, JSON.stringify(plan)); // chords of 6 degrees against those of a metre
        for (const p of points) near(Math.min(...way.slice(1).map((q, i) => beside(p, way[i], q))), 0, 0.01, JSON.stringify(plan));
      }
      assert.equal(flown[at++], "end");
    }
    assert.equal(at, flown.length);
    assert.ok(fillets > 40, `${fillets} fillets`);
  },
  "the piece that is followed goes on from beside the aircraft"() {
    const path = (more) => ({ kind: "line", turn: "right", origin_m: { north: 10, east: 20 }, direction_ratio: { north: 0, east: 0.6, down: -0.8 }, radius_m: 50, remaining_m: 30, ...more });
    const far = 1e9, at = { n: 13, e: 60 };
    assert.deepEqual(piece_ahead(path({}), at), [{ n: 10, e: 60 }, { n: 10, e: 90 }]);
    assert.deepEqual(piece_ahead(path({ remaining_m: far }), at)[1], { n: 10, e: 460 });
    assert.deepEqual(piece_ahead(path({ direction_ratio: { north: 0, east: 0, down: 1 } }), at), []);
    assert.deepEqual(piece_ahead(undefined, at), []);
    for (const [turn, east] of [["right", 70], ["left", -30]]) {  // north of the centre, a quarter on
      const arc = piece_ahead(path({ kind: "orbit", turn, remaining_m: 25 * Math.PI }), { n: 100, e: 20 });
      near(arc[0].n, 60, 1e-9); near(arc[0].e, 20, 1e-9);
      near(arc[arc.length - 1].n, 10, 1e-9); near(arc[arc.length - 1].e, east, 1e-9);
    }
    const round = piece_ahead(path({ kind: "orbit", remaining_m: far }), { n: 100, e: 20 });
    near(round[round.length - 1].n, round[0].n, 1e-9);
    // behind 30 m of line a wide fillet: a quarter to the left of a circle of 80 m, begun west of its centre
    const next = { kind: "orbit", turn: "left", origin_m: { north: 10, east: 170 }, radius_m: 80, start_rad: -Math.PI / 2, length_m: 40 * Math.PI, is_curve: false };
    const both = piece_ahead(path({ has_next: true, next }), at), end = both[both.length - 1];
    assert.deepEqual(both.slice(0, 2), [{ n: 10, e: 60 }, { n: 10, e: 90 }]);
    near(both[2].n, 10, 1e-9); near(both[2].e, 90, 1e-9);
    near(end.n, -70, 1e-9); near(end.e, 170, 1e-9);
    const line = { kind: "line", origin_m: { north: 10, east: 90 }, direction_ratio: { north: 1, east: 0 }, length_m: 25, is_curve: false };
    assert.deepEqual(piece_ahead(path({ has_next: true, next: line }), at).slice(2), [{ n: 10, e: 90 }, { n: 35, e: 90 }]);
    for (const none of [{ has_next: false, next }, { has_next: true, next: { ...next, is_curve: true } }, { has_next: true, next, remaining_m: far }])
      assert.equal(piece_ahead(path(none), at).length, 2);
  },
  "wires are drawn in layers, between the boxes, each line by itself: twenty components on one screen"() {
    const part = (name, role, inputs, outputs) => ({ name, role, inputs: inputs.map((source, i) => ({ name: `in${i}`, source })), outputs: outputs.map((o) => ({ name: o, type: "p/" + o })) });
    const sensors = ["imu", "gnss", "mag", "baro", "pitot"], v = (names) => names.map((n) => "vehicle." + n);
    const parts = [
      part("score", "", ["nav.state", "vehicle.truth", "manage.path", "outer.attitude", "inner.actuators", "guide.command"], ["figures"]),
      part("plan", "", ["nav.state", "ghost.plan"], ["plan", "notices"]), part("manage", "", ["nav.state", "plan.plan"], ["path", "progress"]),
      part("sim", "vehicle", ["inner.actuators"], [...sensors, "rc", "VehicleStatus", "truth"]),
      part("ekf", "nav", [...v(sensors), "vehicle.VehicleStatus"], ["state", "health"]), part("truth", "nav", ["vehicle.truth"], ["state"]),
      ...["follow", "carrot", "lookahead"].map((n) => part(n, "guide", ["nav.state", "manage.path"], ["command"])),
      ...["slc", "tecs", "mine"].map((n) => part(n, "outer", ["nav.state", "guide.command"], ["attitude"])),
      part("attitude", "inner", ["nav.state", "outer.attitude"], ["actuators"]), part("autotune", "inner", ["nav.state", "outer.attitude", "joystick.rc"], ["actuators"]),
      part("joystick", "", [], ["rc"]), part("safety", "", ["nav.state", "nav.health", "vehicle.VehicleStatus", "vehicle.rc"], ["state"]),
      part("home", "", ["nav.state", "safety.state"], ["plan", "path"]), part("landing", "", ["nav.state", "home.path"], ["path", "progress"]),
      part("scene", "", ["nav.state", "plan.plan", "vehicle.gnss"], ["tf"]), part("reference_receiver", "", [], ["gnss"]),
    ];
    assert.equal(parts.length, 20);
    const { width, height, boxes, wires } = draw_wiring(parts, (p) => Math.max(16, p.role.length));
    assert.ok(width <= 1240 && height <= 520, `${width} x ${height}`);
    const box = (name) => boxes.find((b) => b.name === name), layer = (name) => box(name).layer;
    assert.deepEqual(["sim", "ekf", "plan", "manage", "follow", "slc", "attitude", "score"].map(layer), [0, 1, 2, 3, 4, 5, 6, 7]);
    assert.deepEqual(["truth", "carrot", "mine", "autotune", "joystick"].map(layer), [1, 4, 5, 6, 5]); // who fills a role beside the others, who reads nothing before its reader
    boxes.forEach((a, i) => boxes.slice(i + 1).forEach((b) => assert.ok(a.x + a.width < b.x || b.x + b.width < a.x || a.y + a.height < b.y || b.y + b.height < a.y, a.name + " on " + b.name)));
    const readers = parts.flatMap((p) => p.inputs.map((i) => i.source)).filter((s) => s !== "ghost.plan");
    const writers = (source) => {
      const [owner, port] = source.split(".");
      return parts.filter((p) => (p.name === owner || p.role === owner) && p.outputs.some((o) => o.name === port)).length;
    };
    assert.equal(wires.length, readers.reduce((sum, s) => sum + writers(s), 0));
    const pieces = [];
    for (const w of wires) {
      const a = box(w.from), b = box(w.to), [first, last] = [w.points[0], w.points[w.points.length - 1]];
      assert.ok(first[0] === a.x + a.width && first[1] > a.y && first[1] < a.y + a.height, w.source);
      assert.ok(last[0] === b.x && last[1] > b.y && last[1] < b.y + b.height, w.source + " " + w.to);
      w.points.slice(1).forEach(([x2, y2], i) => {
        const [x1, y1] = w.points[i];
        assert.ok(x1 === x2 || y1 === y2, "neither level nor upright");
        const [l, r, t, u] = [Math.min(x1, x2), Math.max(x1, x2), Math.min(y1, y2), Math.max(y1, y2)];
        assert.ok(l >= 0 && r <= width && t >= 0 && u <= height);
        for (const c of boxes) assert.ok(r <= c.x || l >= c.x + c.width || u <= c.y || t >= c.y + c.height, `${w.source} runs through ${c.name}`);
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
    assert.deepEqual(loop.boxes.map((b) => b.layer), [0, 1]);
  },
  "the fewest edits: what stays keeps its id"() {
    const now = plan_of([point(0, 0, 70, 1), point(100, 0, 70, 2), point(200, 0, 70, 3), point(300, 0, 70, 4)]);
    const w = now.waypoints;
    const edits = (waypoints, more = {}) => edits_between(now, { ...now, ...more, waypoints }).map(({ edit, waypoint }) => [edit.kind ?? edit.setting, edit.waypoint_id ?? 0, waypoint]);
    assert.deepEqual(edits(w), []);
    assert.deepEqual(edits([w[0], { ...w[1], north: 110 }, w[2], w[3]]), [["replace", 2, 1]]);
    assert.deepEqual(edits([w[0], w[2], w[3]]), [["remove", 2, -1]]);
    assert.deepEqual(edits([w[0], point(50, 50), w[1], w[2], w[3]]), [["insert", 2, 1]]);
    assert.deepEqual(edits([...w, point(50, 50)]), [["append", 0, 4]]);
    assert.deepEqual(edits([w[3], w[0], w[1], w[2]]), [["remove", 4, -1], ["insert", 1, 0]]);
    assert.deepEqual(edits([w[1], w[2], w[3], w[0]]), [["remove", 1, -1], ["append", 0, 3]]);
    assert.deepEqual(edits([point(1, 1), point(9, 9)]), [["clear", 0, -1], ["append", 0, 0], ["append", 0, 1]]);
    assert.deepEqual(edits(w, { radius: 80, end: "orbit", airspeed: 20 }), [["end", 0, -1], ["turn_radius", 0, -1], ["airspeed", 0, -1]]);
    const group = as_group(edits_between(now, { ...now, waypoints: [w[3], w[0]] }), 77);
    assert.ok(group.length > 1 && group.every(({ edit }) => edit.group === 77 && edit.group_size === group.length));
    const one = as_group(edits_between(now, { ...now, waypoints: w.slice(1) }), 77);
    assert.equal(one[0].edit.group, undefined);
    const down = edits_between(now, { ...now, waypoints: [...w, { ...point(1, 2, 30), course: 0.5 }] })[0].edit.waypoint;
    assert.deepEqual(down, { frame: "local", position_m: { north: 1, east: 2, down: -30 }, has_course: true, course_rad: 0.5, airspeed_mps: 0 });
  },
  "every plan file that is shipped is read, and what is written is read again"() {
    const configs = join(web, "../configs/plans"), origin = { latitude: 40.2463724, longitude: -111.6474138, altitude: 1387 };
    const now = plan_of([]);
    for (const name of readdirSync(configs)) {
      const text = readFileSync(join(configs, name), "utf8");
      if (!text.includes("waypoints:")) continue; // zones of a fence
      const plan = read_plan_file(text, now, origin);
      assert.equal(plan.waypoints.length, (text.match(/^ *- *\{/gm) ?? []).length, name);
      const again = read_plan_file(write_plan_file(plan, "it's: a \"plan\""), now, origin);
      plan.waypoints.forEach((w, i) => near(again.waypoints[i].north, w.north, 1e-2));
    }
    const first = read_plan_file(readFileSync(join(configs, "hourglass.yaml"), "utf8"), now, null);
    assert.deepEqual([first.end, first.airspeed, first.radius, first.waypoints[0].north, first.waypoints[1].east], ["circuit", 17, 50, 400, -50]);
    // one minute of latitude at 45 degrees is 1852.2 m, of longitude 1314.2 m (WGS-84)
    const at = read_plan_file("waypoints: [{lat: 45.016666667, lon: 7.016666667, alt_msl: 100 m, course: 90 deg, airspeed: 10 kt}]", now, { latitude: 45, longitude: 7, altitude: 0 }).waypoints[0];
    near(at.north, 1852.2, 0.5); near(at.east, 1314.2, 0.5); near(at.course, Math.PI / 2, 1e-12); near(at.airspeed, 5.1444, 1e-4);
  },
  "what a flight does not tell again is saved as it was loaded: latitudes where a waypoint stays, the runway"() {
    const origin = { latitude: 40.2463724, longitude: -111.6474138, altitude: 1387 }, now = { end: "circuit", radius: 50, airspeed: 17, waypoints: [] };
    const text = "name: x\nairspeed: 17 m/s\nrunway: {lat: 40.2463, lon: -111.6474, alt_msl: 1387 m, heading: 135 deg, length: 300 m}\nwaypoints:\n" +
      "  - {lat: 40.2913724, lon: -111.7074138, alt_msl: 1457 m}\n  - {north: 10 m, east: 20 m, up: 70 m}\n  - {lat: 40.2143724, lon: -111.6054138, alt_msl: 1.389 km, course: 30 deg}\n";
    const file = read_plan_file(text, now, origin);
    // by GeographicLib 2.1, LocalCartesian: 70 m above the origin's height
    near(file.waypoints[0].north, 4999.6612, 1e-3);
    near(file.waypoints[0].east, -5102.9506, 1e-3);
    near(file.waypoints[0].up, 65.9979, 1e-3);
    const flown = { ...file, waypoints: file.waypoints.map((w) => ({ ...w, geodetic: null, north: w.north + 1e-3 })) }; // as the planner tells it
    const again = read_plan_file(write_plan_file(flown, "x", file), now, origin);
    assert.deepEqual(again.waypoints.map((w) => w.geodetic), file.waypoints.map((w) => w.geodetic));
    assert.deepEqual(again.runway, { lat: 40.2463, lon: -111.6474, alt_msl: "1387 m", heading: "135 deg", length: "300 m" });
    near(again.waypoints[2].course, Math.PI / 6, 1e-9);
    flown.waypoints[0].north += 1;
    const moved = read_plan_file(write_plan_file(flown, "x", file), now, origin);
    assert.deepEqual(moved.waypoints.map((w) => w.geodetic !== null), [false, false, true], "one that was moved is where it was moved to");
    assert.doesNotMatch(write_plan_file(flown, "x"), /runway|lat:/);
  },
  "a bad plan file is told, every fault of it"() {
    const faults = (text, origin = null) => {
      try {
        read_plan_file(text, plan_of([]), origin);
      } catch (fault) {
        return fault.message;
      }
      return "";
    };
    assert.equal(faults("end: never\nturn_radius: 5 rad\nwaypoints: [{north: x, east: 1 m}, 7, {lat: 40, lon: 7, alt_msl: 3 m}]\nspeed: 3"), [
      "there is no 'speed'. Valid: name, end, airspeed, turn_radius, waypoints, runway",
      "end: 'never' is none. Valid: circuit, orbit",
      "turn_radius: '5 rad' is no length. Valid units: m, km, ft",
      "waypoint 0: north: 'x' is no length. Valid units: m, km, ft",
      "waypoint 0: 'up' is missing",
      "waypoint 1: has to be a map, {north: 400 m, east: -250 m, up: 70 m}",
      "waypoint 2: is geodetic, and the flight does not know its origin yet"].join("\n"));
    assert.match(faults("waypoints: [{north: 1"), /line|expected|end of the stream/);
    assert.match(faults("3"), /no plan/);
    assert.match(faults("name: x"), /'waypoints' has to be a list/);
  },
  "the figures of a second-order step are those of its closed form"() {
    const zeta = 0.4, omega = 5, wd = omega * Math.sqrt(1 - zeta * zeta), asked = { t: [], v: [] }, got = { t: [], v: [] };
    const y = (t) => 1 - Math.exp(-zeta * omega * t) * (Math.cos(wd * t) + (zeta / Math.sqrt(1 - zeta * zeta)) * Math.sin(wd * t));
    for (let i = 0; i <= 1500; ++i) {
      const t = i / 100;
      asked.t.push(t); asked.v.push(t <= 5 ? 0.1 : 0.5);
      got.t.push(t); got.v.push(t <= 5 ? 0.1 : 0.1 + 0.4 * y(t - 5));
    }
    const step = last_step(asked, got, 0, 0.05);
    near(step.at, 5, 0.011); near(step.from, 0.1, 1e-9); near(step.to, 0.5, 1e-9);
    near(step.overshoot, Math.exp((-zeta * Math.PI) / Math.sqrt(1 - zeta * zeta)), 0.002); // 25.4 %
    const crossing = (level) => { let t = 0; while (y(t) < level) t += 1e-4; return t; };
    near(step.rise_s, crossing(0.9) - crossing(0.1), 0.021);
    let left = 0;
    for (let t = 0; t < 10; t += 1e-4) if (Math.abs(y(t) - 1) > 0.05) left = t;
    near(step.settling_s, left, 0.021);
    const down = last_step({ t: asked.t, v: asked.v.map((v) => -v) }, { t: got.t, v: got.v.map((v) => -v) }, 0, 0.05);
    near(down.overshoot, step.overshoot, 1e-9);
  },
  "a ramp, a small change, a step before the window, and one that is too young are no steps; an angle steps across south"() {
    const t = Array.from({ length: 1000 }, (_, i) => i / 100), series = (f) => ({ t, v: t.map(f) });
    const flat = series(() => 0);
    assert.equal(last_step(series((x) => 0.1 * x), flat, 0, 0.05), null);
    assert.equal(last_step(series((x) => (x > 5 ? 0.04 : 0)), flat, 0, 0.05), null);
    assert.equal(last_step(series((x) => (x > 5 ? 1 : 0)), flat, 6, 0.05), null);
    assert.equal(last_step(series((x) => (x > 9.8 ? 1 : 0)), flat, 0, 0.05), null);
    assert.equal(last_step({ t: [], v: [] }, flat, 0, 0.05), null);
    const south = last_step(series((x) => (x > 5 ? -3.1 : 3.1)), series((x) => (x > 6 ? -3.1 : 3.1)), 0, 0.05, 0.4, 2 * Math.PI);
    near(Math.abs(south.to - south.from), 2 * Math.PI - 6.2, 1e-9);
    near(south.settling_s, 1, 0.02);
    assert.deepEqual([value_at(flat, -1), value_at(series((x) => x), 5.004), value_at({ t: [], v: [] }, 1)], [0, 5, NaN]);
  },
  "numbers for people"() {
    assert.deepEqual([digits(0.01234), digits(12.34), digits(1234.5), digits(0), digits(NaN), digits(1e-6)], ["0.0123", "12.3", "1235", "0", "–", "1.00e-6"]);
    assert.deepEqual([fixed(-0.01, 1, "m"), fixed(2.25, 1, "°"), fixed(undefined, 1, "m"), with_unit(70, "m"), with_unit(12, "°/s")], ["0.0 m", "2.3°", "–", "70 m", "12°/s"]);
    assert.deepEqual([bearing(0), bearing(-Math.PI / 2), bearing(2 * Math.PI - 1e-9), bearing(NaN)], ["000°", "270°", "000°", "–"]);
    assert.deepEqual([clock(-5), clock(61.25), clock(NaN)], ["−0:05.0", "1:01.3", "–"]);
    near(shown_unit("rad/s").scale, 180 / Math.PI, 1e-12);
    assert.equal(shown_unit("rad/rad").scale, 1);
  },
  "types agree"() {
    // where the packages are, wherever that is
    const config = { extends: join(web, "tsconfig.json"), include: [join(web, "src")],
      compilerOptions: { paths: { "*": [join(modules, "@types/*"), join(modules, "*")] }, typeRoots: [join(modules, "@types")] } };
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
