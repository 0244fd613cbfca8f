// SPDX-License-Identifier: BSD-3-Clause
// Fewest edits from the active plan to the wanted one, as one group, which the planner accepts
// completely or rejects. Unchanged waypoints keep their ids, so that the active leg continues.
import type { Plan, Waypoint } from "./route";

/** A request of the type PlanEdit, as JSON: missing fields are 0. */
export type Edit = Record<string, unknown>;
export interface EditOf {
  edit: Edit;
  waypoint: number; // of the wanted plan; -1: of the complete plan
}

function message_of(w: Waypoint): Edit {
  const m: Edit = w.geodetic
    ? {
        frame: "geodetic",
        latitude_deg: w.geodetic.latitude,
        longitude_deg: w.geodetic.longitude,
        altitude_m: w.geodetic.altitude,
      }
    : { frame: "local", position_m: { north: w.north, east: w.east, down: -w.up } };
  if (w.course !== null) Object.assign(m, { has_course: true, course_rad: w.course });
  return { ...m, airspeed_mps: w.airspeed };
}

function equal(a: Waypoint, b: Waypoint): boolean {
  return (
    !b.geodetic &&
    a.north === b.north &&
    a.east === b.east &&
    a.up === b.up &&
    a.course === b.course &&
    a.airspeed === b.airspeed
  );
}

/** The largest set of ids in the same order in both plans: the others are moved. */
function in_order(ids: number[], places: Map<number, number>): Set<number> {
  const list = ids.filter((id) => places.has(id));
  const best: number[] = [],
    from: number[] = [];
  let end = -1;
  list.forEach((id, i) => {
    best[i] = 1;
    from[i] = -1;
    for (let k = 0; k < i; ++k) {
      const before = (places.get(list[k] as number) as number) < (places.get(id) as number);
      if (before && (best[k] as number) + 1 > (best[i] as number))
        [best[i], from[i]] = [(best[k] as number) + 1, k];
    }
    if (end < 0 || (best[i] as number) > (best[end] as number)) end = i;
  });
  const kept = new Set<number>();
  for (let i = end; i >= 0; i = from[i] as number) kept.add(list[i] as number);
  return kept;
}

export function edits_between(now: Plan, wanted: Plan): EditOf[] {
  const edits: EditOf[] = [];
  const whole = (edit: Edit) => edits.push({ edit, waypoint: -1 });
  if (now.end !== wanted.end) whole({ setting: "end", end: wanted.end });
  if (now.radius !== wanted.radius) whole({ setting: "turn_radius", turn_radius_m: wanted.radius });
  if (now.airspeed !== wanted.airspeed) whole({ setting: "airspeed", airspeed_mps: wanted.airspeed });
  const places = new Map(now.waypoints.map((w, i) => [w.id, i]));
  const kept = in_order(
    wanted.waypoints.map((w) => w.id).filter((id) => id !== 0),
    places,
  );
  if (kept.size === 0 && now.waypoints.length > 0) {
    whole({ kind: "clear" });
  } else {
    for (const w of now.waypoints) if (!kept.has(w.id)) whole({ kind: "remove", waypoint_id: w.id });
  }
  wanted.waypoints.forEach((w, i) => {
    const before = kept.has(w.id) ? now.waypoints[places.get(w.id) as number] : undefined;
    if (before && equal(before, w)) return;
    const waypoint = message_of(w);
    if (before) return edits.push({ edit: { kind: "replace", waypoint_id: w.id, waypoint }, waypoint: i });
    const next = wanted.waypoints.slice(i + 1).find((later) => kept.has(later.id));
    const edit = next ? { kind: "insert", waypoint_id: next.id, waypoint } : { kind: "append", waypoint };
    return edits.push({ edit, waypoint: i });
  });
  return edits;
}

/** The same edits with a group number: a second attempt needs a new one. */
export function as_group(edits: EditOf[], group: number): EditOf[] {
  if (edits.length < 2) return edits;
  return edits.map((e) => ({ ...e, edit: { ...e.edit, group, group_size: edits.length } }));
}
