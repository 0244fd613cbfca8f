// SPDX-License-Identifier: BSD-3-Clause
// node viewer_test.mjs FULMAR MISSION LAYOUTS: flies the mission with its own log settings and uses the log like a viewer:
// identifies types by their names, builds the tree of frames, places all drawn objects in it, and checks every topic and field
// of the shipped layouts.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { messages, schemas } from "./log_file.mjs";

const [fulmar, mission, layouts] = process.argv.slice(2);
const fixed = "map";
/** Schema names that a 3-D panel draws, a map shows, or a log panel lists. */
const drawn = new Set(["visualization_msgs/msg/MarkerArray", "nav_msgs/msg/Path", "geometry_msgs/msg/PoseStamped"]);
const seconds = (stamp) => stamp.sec + 1e-9 * stamp.nanosec;
const length = ({ x, y, z }) => Math.hypot(x, y, z);
const minus = (a, b) => ({ x: a.x - b.x, y: a.y - b.y, z: a.z - b.z });

/** Distance of a point from a polyline. */
function off(point, line) {
  let best = Infinity;
  for (let i = 1; i < line.length; ++i) {
    const a = line[i - 1], ab = minus(line[i], a), ap = minus(point, a);
    const square = ab.x ** 2 + ab.y ** 2 + ab.z ** 2;
    const s = square > 0 ? Math.min(1, Math.max(0, (ap.x * ab.x + ap.y * ab.y + ap.z * ab.z) / square)) : 0;
    best = Math.min(best, length(minus(ap, { x: s * ab.x, y: s * ab.y, z: s * ab.z })));
  }
  return best;
}

/** The frames that lead from the fixed one, by every transform of the log. */
function reached(transforms) {
  const parents = new Map(transforms.map((t) => [t.child_frame_id, t.header.frame_id]));
  return (frame) => {
    for (let steps = 0; frame !== undefined && steps < 100; ++steps, frame = parents.get(frame)) if (frame === fixed) return true;
    return false;
  };
}

/** Whether a path of fields ends in a number, a flag or a text. */
function resolves(definitions, path) {
  let fields = definitions[0].definitions;
  for (const name of path) {
    const field = fields.find((f) => f.name === name && !f.isConstant);
    if (field === undefined) return false;
    if (!field.isComplex) return name === path.at(-1);
    fields = definitions.find((d) => d.name === field.type).definitions;
  }
  return false;
}

const folder = mkdtempSync(join(tmpdir(), "fulmar-viewer-"));
try {
  const file = join(folder, "flight.mcap");
  execFileSync(fulmar, ["run", mission, "--log", file, "--json"]);
  const types = await schemas(file), found = {};
  for await (const m of messages(file)) (found[m.topic] ??= []).push(m);
  const type_of = (topic) => types.get(topic)?.name;
  const values = (topic) => (found[topic] ?? []).map((m) => m.value);
  const of_type = (name) => [...types.keys()].filter((t) => type_of(t) === name && found[t]);

  // frames
  const [tf_topic] = of_type("tf2_msgs/msg/TFMessage");
  assert.ok(tf_topic, "no transforms");
  const transforms = values(tf_topic).flatMap((m) => m.transforms);
  const in_tree = reached(transforms);
  assert.ok(in_tree("base_link"), "frame of the aircraft");
  const places = transforms.filter((t) => t.child_frame_id === "base_link");
  for (let i = 1; i < places.length; ++i) {
    const dt = seconds(places[i].header.stamp) - seconds(places[i - 1].header.stamp);
    assert.ok(dt > 0.05 && dt < 0.15, `transforms are ${dt} s apart`);
  }
  for (const m of found[tf_topic]) // a viewer looks up frames at the time of its cursor, which is that of the log
    assert.ok(Math.abs(seconds(m.value.transforms[0].header.stamp) - Number(m.log_ns) * 1e-9) < 0.02, "stamps of the log");
  for (const { transform: { rotation: q } } of places) assert.ok(Math.abs(Math.hypot(q.x, q.y, q.z, q.w) - 1) < 1e-9);

  // 3-D: each drawn object has a frame of the tree
  const scene = [...types.keys()].filter((t) => drawn.has(type_of(t)) && found[t]);
  assert.deepEqual([...new Set(scene.map(type_of))].sort(), [...drawn].sort());
  for (const topic of scene)
    for (const m of values(topic)) for (const { header } of m.markers ?? [m]) assert.ok(in_tree(header.frame_id), `${topic}: the frame '${header.frame_id}' leads nowhere`);
  const [marker_topic] = of_type("visualization_msgs/msg/MarkerArray");
  for (const { markers } of values(marker_topic)) assert.equal(markers[0].action, 3, "earlier markers deleted");
  const markers = values(marker_topic).at(-1).markers;
  const aircraft = markers.find((m) => m.header.frame_id === "base_link" && m.action === 0);
  assert.ok(aircraft.frame_locked && aircraft.points.length >= 3 && aircraft.points.length % 3 === 0 && aircraft.color.a > 0, "no aircraft");
  const waypoints = values("/plan/plan").at(-1).waypoints.map((w) => w.position_m);
  const balls = markers.filter((m) => m.type === 7).flatMap((m) => m.points);
  assert.deepEqual(balls, waypoints.map((p) => ({ x: p.east, y: p.north, z: -p.down })));
  assert.equal(markers.filter((m) => m.type === 9).map((m) => m.text).join(), waypoints.map((_, i) => i).join());

  // the aircraft follows the path: from the second minute on, half of the flight is within some metres of it
  const [path_topic] = of_type("nav_msgs/msg/Path");
  const path = values(path_topic).at(-1).poses.map((p) => p.pose.position);
  const [pose_topic] = of_type("geometry_msgs/msg/PoseStamped");
  const cruise = values(pose_topic).filter((m) => seconds(m.header.stamp) > seconds(places[0].header.stamp) + 60);
  const distances = cruise.map((m) => off(m.pose.position, path)).sort((a, b) => a - b);
  assert.ok(distances.length > 100 && distances[distances.length >> 1] < 5, `the aircraft flies ${distances[distances.length >> 1]} m off the path`);
  assert.ok(distances.at(-1) < 40, `the aircraft was ${distances.at(-1)} m off the path`);

  // the map: on the ellipsoid where the transform is in the plane that touches it
  const [fix_topic] = of_type("sensor_msgs/msg/NavSatFix");
  const fixes = values(fix_topic).filter((m) => m.status.status >= 0);
  assert.ok(fixes.length > 0.9 * places.length, "places on the map");
  const state = values("/nav/state").at(-1), rad = Math.PI / 180, lat0 = state.origin_latitude_deg * rad;
  const w2 = 1 - 0.00669437999014 * Math.sin(lat0) ** 2, N = 6378137 / Math.sqrt(w2), M = (N * (1 - 0.00669437999014)) / w2;
  const at = new Map(places.map((t) => [seconds(t.header.stamp), t.transform.translation]));
  let compared = 0;
  for (const f of fixes) {
    const place = at.get(seconds(f.header.stamp));
    if (place === undefined) continue;
    const north = (f.latitude * rad - lat0) * (M + f.altitude), east = (f.longitude - state.origin_longitude_deg) * rad * (N + f.altitude) * Math.cos(f.latitude * rad);
    assert.ok(Math.hypot(north - place.y, east - place.x) < 0.5, `map and scene differ by ${north - place.y}, ${east - place.x} m`);
    assert.ok(Math.abs(f.altitude - state.origin_altitude_m - place.z) < 1);
    ++compared;
  }
  assert.ok(compared > 0.9 * places.length);

  // events for the log panel
  const lines = values("/rosout"), events = values("/fulmar/event");
  assert.equal(type_of("/rosout"), "rcl_interfaces/msg/Log");
  assert.deepEqual(lines.map((l) => l.msg), events.map((e) => e.words));
  assert.deepEqual(lines.map((l) => l.level), events.map((e) => 20 + 10 * e.severity));
  assert.ok(lines.some((l) => l.function === "phase"));

  // on change, and once a minute: a viewer that opens later waits at most that long
  const last_s = seconds(places.at(-1).header.stamp);
  for (const topic of [path_topic, marker_topic]) {
    const times = [...values(topic).map((m) => seconds((m.markers?.[0] ?? m).header.stamp)), last_s];
    for (let i = 1; i < times.length; ++i) assert.ok(times[i] - times[i - 1] < 60.2, `${topic}: ${times[i] - times[i - 1]} s of silence`);
    assert.ok(times.length - 1 <= 4 + (last_s - times[0]) / 60, `${topic}: told ${times.length - 1} times`);
  }

  // layouts
  const panels = JSON.parse(readFileSync(join(layouts, "fulmar.json"))).configById;
  const has = (message_path) => {
    const [topic, ...fields] = message_path.split(".");
    assert.ok(found[topic], `layout: no ${topic}`);
    assert.ok(resolves(types.get(topic).definitions, fields), `layout: no ${message_path}`);
  };
  let looked_up = 0;
  for (const [id, panel] of Object.entries(panels)) {
    const kind = id.split("!")[0];
    for (const { value } of panel.paths ?? []) has(value), ++looked_up;
    if (kind === "3D") {
      assert.equal(panel.followTf, fixed);
      for (const topic of Object.keys(panel.topics)) assert.ok(drawn.has(type_of(topic)), `layout: ${topic} cannot be drawn`), ++looked_up;
    }
    if (kind === "map") assert.equal(type_of(panel.followTopic), "sensor_msgs/msg/NavSatFix"), ++looked_up;
    if (kind === "RosOut") assert.equal(type_of(panel.topicToRender), "rcl_interfaces/msg/Log"), ++looked_up;
  }
  const places_of = (tree) => (typeof tree === "string" ? [tree] : [...places_of(tree.first), ...places_of(tree.second)]);
  assert.deepEqual(places_of(JSON.parse(readFileSync(join(layouts, "fulmar.json"))).layout).sort(), Object.keys(panels).sort());
  const curves = [...readFileSync(join(layouts, "plotjuggler.xml"), "utf8").matchAll(/(?:name|curve_x|curve_y)="(\/[^"]*)"/g)].map((m) => m[1]);
  for (const curve of curves) {
    const topic = [...types.keys()].find((t) => curve.startsWith(t + "/"));
    assert.ok(topic && found[topic], `layout: no topic of ${curve}`);
    assert.ok(resolves(types.get(topic).definitions, curve.slice(topic.length + 1).split("/")), `layout: no ${curve}`);
  }
  assert.ok(looked_up >= 15 && curves.length >= 12);

  const minutes = (last_s - seconds(places[0].header.stamp)) / 60, size = statSync(file).size / 1e6 / minutes;
  assert.ok(size < 4, `${size} MB per flight minute`);
  console.log(`${mission}: ${places.length} transforms, ${fixes.length} places on the map, a path of ${path.length} poses, ${markers.length} markers, ` +
    `${lines.length} log lines, ${looked_up + curves.length} topics and fields of layouts; off the path by ${distances[distances.length >> 1].toFixed(1)} m; ${size.toFixed(2)} MB per flight minute`);
} finally {
  rmSync(folder, { recursive: true });
}
