// SPDX-License-Identifier: BSD-3-Clause
// A plan file, as plugins/path/README.md has it: read, with all faults reported at once, and written.
import { dump, load } from "js-yaml";
import type { Plan, Waypoint } from "./route";
import { LocalPlane } from "./tiles";
import { plain } from "../units";

const to_rad = Math.PI / 180;
const units: Record<string, Record<string, number>> = {
  length: { m: 1, km: 1000, ft: 0.3048 },
  speed: { "m/s": 1, "km/h": 1 / 3.6, kt: 1852 / 3600 },
  angle: { rad: 1, deg: to_rad },
};
const keys = ["name", "end", "airspeed", "turn_radius", "waypoints", "runway"];
const same_m = 0.05;
const waypoint_keys = ["north", "east", "up", "lat", "lon", "alt_msl", "course", "airspeed"];

/** Data that only the file holds: geodetic waypoints and the runway. */
export interface PlanFile {
  waypoints: Waypoint[];
  runway: unknown;
}

export interface Origin {
  latitude: number;
  longitude: number;
  altitude: number; // degrees, m above mean sea level
}

/** One fault of a plan file. */
export interface PlanFault {
  code:
    | "key_unknown"
    | "quantity_invalid"
    | "value_invalid"
    | "map_expected"
    | "list_expected"
    | "key_missing"
    | "degrees_expected"
    | "origin_missing";
  place: string; // "waypoint 0: north", "" of the file
  found: string; // in the file
  valid: string; // "m, km, ft"
}

const sentences: Record<PlanFault["code"], (f: PlanFault) => string> = {
  key_unknown: (f) => `unknown key '${f.found}'. Valid: ${f.valid}`,
  quantity_invalid: (f) => `'${f.found}' is not a valid ${f.valid}`,
  value_invalid: (f) => `'${f.found}' is not valid. Valid: ${f.valid}`,
  map_expected: () => "must be a map, such as {north: 400 m, east: -250 m, up: 70 m}",
  list_expected: () => "must be a list",
  key_missing: (f) => `'${f.found}' is missing`,
  degrees_expected: (f) => `'${f.found}' is not a latitude or longitude in degrees`,
  origin_missing: () => "is geodetic, but the flight has no origin yet",
};

/** All faults of a plan file, one per line. */
export class PlanFileError extends Error {
  constructor(readonly faults: PlanFault[]) {
    super(faults.map((f) => (f.place ? f.place + ": " : "") + sentences[f.code](f)).join("\n"));
  }
}

class Faults {
  readonly list: PlanFault[] = [];
  add(code: PlanFault["code"], place: string, found: unknown = "", valid = ""): void {
    this.list.push({ code, place, found: String(found), valid });
  }
  number(value: unknown, kind: string, where: string): number {
    const table = units[kind] ?? {};
    if (typeof value === "number" && Number.isFinite(value)) return value;
    const match = /^\s*([-+]?[0-9.]+(?:e[-+]?\d+)?)\s*(\S*)\s*$/i.exec(
      typeof value === "string" ? value : "",
    );
    const factor = match && match[2] ? table[match[2]] : match ? 1 : undefined;
    const result = match && factor !== undefined ? Number(match[1]) * factor : NaN;
    if (Number.isFinite(result)) return result;
    this.add("quantity_invalid", where, value, `${kind}. Valid units: ${Object.keys(table).join(", ")}`);
    return 0;
  }
  known(object: Record<string, unknown>, valid: string[], where: string): void {
    for (const key of Object.keys(object))
      if (!valid.includes(key)) this.add("key_unknown", where, key, valid.join(", "));
  }
}

/** Metres from the origin, as in the planner. */
function local(at: Origin, origin: Origin): { north: number; east: number; up: number } {
  const plane = new LocalPlane({
    lat_deg: origin.latitude,
    lon_deg: origin.longitude,
    alt_msl_m: origin.altitude,
  });
  const p = plane.to_plane(at.latitude * to_rad, at.longitude * to_rad, at.altitude);
  return { north: p.n, east: p.e, up: p.up };
}

function read_waypoint(entry: unknown, i: number, origin: Origin | null, faults: Faults): Waypoint {
  const where = `waypoint ${i}`;
  const w: Waypoint = { north: 0, east: 0, up: 0, course: null, airspeed: 0, id: 0, geodetic: null };
  if (typeof entry !== "object" || entry === null || Array.isArray(entry)) {
    faults.add("map_expected", where);
    return w;
  }
  const map = entry as Record<string, unknown>;
  faults.known(map, waypoint_keys, where);
  const at = (key: string, kind: string) => {
    if (map[key] === undefined) faults.add("key_missing", where, key);
    return map[key] === undefined ? 0 : faults.number(map[key], kind, `${where}: ${key}`);
  };
  if (map.lat !== undefined || map.lon !== undefined) {
    const degrees = (key: string) => {
      const text = String(map[key] ?? "").replace(/\s*deg\s*$/, "");
      const value = Number(text);
      if (text === "" || !Number.isFinite(value))
        faults.add("degrees_expected", `${where}: ${key}`, map[key]);
      return value;
    };
    w.geodetic = { latitude: degrees("lat"), longitude: degrees("lon"), altitude: at("alt_msl", "length") };
    if (origin) Object.assign(w, local(w.geodetic, origin));
    else faults.add("origin_missing", where);
  } else {
    w.north = at("north", "length");
    w.east = at("east", "length");
    w.up = at("up", "length");
  }
  if (map.course !== undefined) w.course = faults.number(map.course, "angle", `${where}: course`);
  if (map.airspeed !== undefined) w.airspeed = faults.number(map.airspeed, "speed", `${where}: airspeed`);
  return w;
}

/** Missing settings are those of `now`. Throws PlanFileError, or the error of the YAML. */
export function read_plan_file(text: string, now: Plan, origin: Origin | null): Plan & { runway?: unknown } {
  const faults = new Faults();
  const file = load(text) as unknown;
  if (typeof file !== "object" || file === null || Array.isArray(file))
    throw new Error("The file is not a plan: it must be a map with 'waypoints'.");
  const map = file as Record<string, unknown>;
  faults.known(map, keys, "");
  const plan: Plan & { runway?: unknown } = {
    end: now.end,
    radius: now.radius,
    airspeed: now.airspeed,
    waypoints: [],
  };
  if (map.end !== undefined) {
    if (map.end === "circuit" || map.end === "orbit") plan.end = map.end;
    else faults.add("value_invalid", "end", map.end, "circuit, orbit");
  }
  if (map.turn_radius !== undefined) plan.radius = faults.number(map.turn_radius, "length", "turn_radius");
  if (map.airspeed !== undefined) plan.airspeed = faults.number(map.airspeed, "speed", "airspeed");
  if (!Array.isArray(map.waypoints)) faults.add("list_expected", "waypoints");
  else plan.waypoints = map.waypoints.map((w, i) => read_waypoint(w, i, origin, faults));
  if (map.runway !== undefined) plan.runway = map.runway;
  if (faults.list.length > 0) throw new PlanFileError(faults.list);
  return plan;
}

/** Geodetic position of the file, if the waypoint has not moved by more than the rounding. */
function geodetic_of(w: Waypoint, file: PlanFile | null): Origin | null {
  const same = (a: number, b: number) => Math.abs(a - b) < same_m;
  return (
    w.geodetic ??
    file?.waypoints.find(
      (f) => f.geodetic && same(f.north, w.north) && same(f.east, w.east) && same(f.up, w.up),
    )?.geodetic ??
    null
  );
}

/** `file`: the loaded file of the plan. */
export function write_plan_file(plan: Plan, name: string, file: PlanFile | null = null): string {
  const lines = [
    `name: ${JSON.stringify(name)}`,
    `end: ${plan.end}`,
    `airspeed: ${plain(plan.airspeed)} m/s`,
    `turn_radius: ${plain(plan.radius)} m`,
  ];
  if (file?.runway !== undefined)
    lines.push(dump({ runway: file.runway }, { flowLevel: 1, lineWidth: -1 }).trimEnd());
  lines.push(plan.waypoints.length > 0 ? "waypoints:" : "waypoints: []");
  for (const w of plan.waypoints) {
    const further =
      (w.course === null ? "" : `, course: ${plain(w.course / to_rad)} deg`) +
      (w.airspeed > 0 ? `, airspeed: ${plain(w.airspeed)} m/s` : "");
    const place = geodetic_of(w, file);
    lines.push(
      place
        ? `  - {lat: ${place.latitude}, lon: ${place.longitude}, alt_msl: ${Number(place.altitude.toFixed(3))} m${further}}`
        : `  - {north: ${plain(w.north)} m, east: ${plain(w.east)} m, up: ${plain(w.up)} m${further}}`,
    );
  }
  return lines.join("\n") + "\n";
}
