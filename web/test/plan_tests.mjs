// SPDX-License-Identifier: BSD-3-Clause
// Edits of a plan and plan files; a part of words_test.mjs.
import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";

export const point = (north, east, up = 70, id = 0) => ({
  north,
  east,
  up,
  course: null,
  airspeed: 0,
  id,
  geodetic: null,
});
export const plan_of = (waypoints, end = "circuit", radius = 50) => ({
  end,
  radius,
  airspeed: 17,
  waypoints,
});

export const plan_tests = ({ as_group, edits_between }, { read_plan_file, write_plan_file }, web, near) => ({
  "the fewest edits: unchanged waypoints keep their ids"() {
    const now = plan_of([
      point(0, 0, 70, 1),
      point(100, 0, 70, 2),
      point(200, 0, 70, 3),
      point(300, 0, 70, 4),
    ]);
    const w = now.waypoints;
    const edits = (waypoints, more = {}) =>
      edits_between(now, { ...now, ...more, waypoints }).map(({ edit, waypoint }) => [
        edit.kind ?? edit.setting,
        edit.waypoint_id ?? 0,
        waypoint,
      ]);
    assert.deepEqual(edits(w), []);
    assert.deepEqual(edits([w[0], { ...w[1], north: 110 }, w[2], w[3]]), [["replace", 2, 1]]);
    assert.deepEqual(edits([w[0], w[2], w[3]]), [["remove", 2, -1]]);
    assert.deepEqual(edits([w[0], point(50, 50), w[1], w[2], w[3]]), [["insert", 2, 1]]);
    assert.deepEqual(edits([...w, point(50, 50)]), [["append", 0, 4]]);
    assert.deepEqual(edits([w[3], w[0], w[1], w[2]]), [
      ["remove", 4, -1],
      ["insert", 1, 0],
    ]);
    assert.deepEqual(edits([w[1], w[2], w[3], w[0]]), [
      ["remove", 1, -1],
      ["append", 0, 3],
    ]);
    assert.deepEqual(edits([point(1, 1), point(9, 9)]), [
      ["clear", 0, -1],
      ["append", 0, 0],
      ["append", 0, 1],
    ]);
    assert.deepEqual(edits(w, { radius: 80, end: "orbit", airspeed: 20 }), [
      ["end", 0, -1],
      ["turn_radius", 0, -1],
      ["airspeed", 0, -1],
    ]);
    const group = as_group(edits_between(now, { ...now, waypoints: [w[3], w[0]] }), 77);
    assert.ok(
      group.length > 1 && group.every(({ edit }) => edit.group === 77 && edit.group_size === group.length),
    );
    const one = as_group(edits_between(now, { ...now, waypoints: w.slice(1) }), 77);
    assert.equal(one[0].edit.group, undefined);
    const down = edits_between(now, { ...now, waypoints: [...w, { ...point(1, 2, 30), course: 0.5 }] })[0]
      .edit.waypoint;
    assert.deepEqual(down, {
      frame: "local",
      position_m: { north: 1, east: 2, down: -30 },
      has_course: true,
      course_rad: 0.5,
      airspeed_mps: 0,
    });
  },
  "every shipped plan file is read, written and read again"() {
    const configs = join(web, "../configs/plans"),
      origin = { latitude: 40.2463724, longitude: -111.6474138, altitude: 1387 };
    const now = plan_of([]);
    for (const name of readdirSync(configs)) {
      const text = readFileSync(join(configs, name), "utf8");
      const plan = read_plan_file(text, now, origin);
      assert.equal(plan.waypoints.length, (text.match(/^ *- *\{/gm) ?? []).length, name);
      const again = read_plan_file(write_plan_file(plan, 'it\'s: a "plan"'), now, origin);
      plan.waypoints.forEach((w, i) => near(again.waypoints[i].north, w.north, 1e-2));
    }
    const first = read_plan_file(readFileSync(join(configs, "hourglass.yaml"), "utf8"), now, null);
    assert.deepEqual(
      [first.end, first.airspeed, first.radius, first.waypoints[0].north, first.waypoints[1].east],
      ["circuit", 17, 50, 400, -50],
    );
    // one minute of latitude at 45 degrees is 1852.2 m, of longitude 1314.2 m (WGS-84)
    const at = read_plan_file(
      "waypoints: [{lat: 45.016666667, lon: 7.016666667, alt_msl: 100 m, course: 90 deg, airspeed: 10 kt}]",
      now,
      { latitude: 45, longitude: 7, altitude: 0 },
    ).waypoints[0];
    near(at.north, 1852.2, 0.5);
    near(at.east, 1314.2, 0.5);
    near(at.course, Math.PI / 2, 1e-12);
    near(at.airspeed, 5.1444, 1e-4);
  },
  "data that only the file holds is saved as loaded: latitudes of unmoved waypoints, the runway"() {
    const origin = { latitude: 40.2463724, longitude: -111.6474138, altitude: 1387 },
      now = { end: "circuit", radius: 50, airspeed: 17, waypoints: [] };
    const text =
      "name: x\nairspeed: 17 m/s\nrunway: {lat: 40.2463, lon: -111.6474, alt_msl: 1387 m, heading: 135 deg, length: 300 m}\nwaypoints:\n" +
      "  - {lat: 40.2913724, lon: -111.7074138, alt_msl: 1457 m}\n  - {north: 10 m, east: 20 m, up: 70 m}\n  - {lat: 40.2143724, lon: -111.6054138, alt_msl: 1.389 km, course: 30 deg}\n";
    const file = read_plan_file(text, now, origin);
    // by GeographicLib 2.1, LocalCartesian: 70 m above the origin's height
    near(file.waypoints[0].north, 4999.6612, 1e-3);
    near(file.waypoints[0].east, -5102.9506, 1e-3);
    near(file.waypoints[0].up, 65.9979, 1e-3);
    const flown = {
      ...file,
      waypoints: file.waypoints.map((w) => ({ ...w, geodetic: null, north: w.north + 1e-3 })),
    }; // as the planner publishes it
    const again = read_plan_file(write_plan_file(flown, "x", file), now, origin);
    assert.deepEqual(
      again.waypoints.map((w) => w.geodetic),
      file.waypoints.map((w) => w.geodetic),
    );
    assert.deepEqual(again.runway, {
      lat: 40.2463,
      lon: -111.6474,
      alt_msl: "1387 m",
      heading: "135 deg",
      length: "300 m",
    });
    near(again.waypoints[2].course, Math.PI / 6, 1e-9);
    flown.waypoints[0].north += 1;
    const moved = read_plan_file(write_plan_file(flown, "x", file), now, origin);
    assert.deepEqual(
      moved.waypoints.map((w) => w.geodetic !== null),
      [false, false, true],
      "moved waypoint",
    );
    assert.doesNotMatch(write_plan_file(flown, "x"), /runway|lat:/);
  },
  "all faults of a plan file are reported"() {
    const fault_of = (text) => {
      try {
        read_plan_file(text, plan_of([]), null);
      } catch (fault) {
        return fault;
      }
      return null;
    };
    const faults = (text) =>
      fault_of(text).faults.map(({ code, place, found, valid }) => [code, place, found, valid]);
    const text =
      "end: never\nturn_radius: 5 rad\nwaypoints: [{north: x, east: 1 m}, 7, {lat: 40, lon: y, alt_msl: 3 m}]\nspeed: 3";
    const expected = [
      ["key_unknown", "", "speed", "name, end, airspeed, turn_radius, waypoints, runway"],
      ["value_invalid", "end", "never", "circuit, orbit"],
      ["quantity_invalid", "turn_radius", "5 rad", "length. Valid units: m, km, ft"],
      ["quantity_invalid", "waypoint 0: north", "x", "length. Valid units: m, km, ft"],
      ["key_missing", "waypoint 0", "up", ""],
      ["map_expected", "waypoint 1", "", ""],
      ["degrees_expected", "waypoint 2: lon", "y", ""],
      ["origin_missing", "waypoint 2", "", ""],
    ];
    assert.deepEqual(faults(text), expected);
    const lines = fault_of(text).message.split("\n");
    assert.equal(lines.length, expected.length);
    expected.forEach(([, place, found], i) =>
      assert.ok(lines[i].startsWith(place) && lines[i].includes(found)),
    );
    assert.match(fault_of("waypoints: [{north: 1").message, /line|expected|end of the stream/);
    assert.match(fault_of("3").message, /not a plan/);
    assert.deepEqual(faults("name: x"), [["list_expected", "waypoints", "", ""]]);
  },
});
