// SPDX-License-Identifier: BSD-3-Clause
// Geofence, landing places and runway of a recorded flight, and its last valid position.
import { type Places, places_of } from "../flight/places";
import type { Place } from "../flight/tiles";
import type { Names } from "../names";
import type { Recording } from "../recorded";
import { lost_position } from "../track";
import type { Lost } from "../views/marks";

const kept = new WeakMap<Recording, Places>();
/** Origin of the mission; an origin set by the first fix is not recorded. */
function recorded_origin(records: unknown[]): Place | null {
  const of = records.find(
    (r) =>
      (r as Record<string, unknown>)?.given === true &&
      typeof (r as Record<string, unknown>).lat_deg === "number",
  );
  return (of as Place | undefined) ?? null;
}
export function recorded_places(source: Recording): Places {
  let places = kept.get(source);
  if (places) return places;
  const records = source.log.ground ?? [];
  kept.set(source, (places = places_of(records, recorded_origin(records))));
  return places;
}

export function recorded_lost(source: Recording, names: Names): Lost | null {
  const of = (path: string) => source.series(names.state, path);
  const message = source.latest(names.state);
  if (!message || message.position_valid === true) return null;
  const valid = of("position_valid"),
    last = valid.v.lastIndexOf(1);
  if (last < 0) return null;
  return lost_position(
    message,
    {
      n: of("position_m.north").v[last] as number,
      e: of("position_m.east").v[last] as number,
      t: valid.t[last] as number,
    },
    source.now,
  );
}
