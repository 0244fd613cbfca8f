// SPDX-License-Identifier: BSD-3-Clause
// Fence, places, runway of a flight that was recorded, and where its position was last known.
import { type Places, places_of } from "../flight/places";
import type { Names } from "../names";
import type { Recording } from "../recorded";
import { lost_position } from "../track";
import type { Lost } from "../views/marks";
import { origin_of } from "../views/places";

const kept = new WeakMap<Recording, Places>();
/** By the origin of the flight's end, which is known then if it ever was. */
export function recorded_places(source: Recording, names: Names): Places {
  let places = kept.get(source);
  if (places) return places;
  const now = source.now;
  source.now = source.log.end_s;
  kept.set(source, (places = places_of(source.log.ground ?? [], origin_of(source.latest(names.state)))));
  source.now = now;
  return places;
}

export function recorded_lost(source: Recording, names: Names): Lost | null {
  const of = (path: string) => source.series(names.state, path);
  const message = source.latest(names.state);
  if (!message || message.position_valid === true) return null;
  const valid = of("position_valid"), last = valid.v.lastIndexOf(1);
  if (last < 0) return null;
  return lost_position(message, { n: of("position_m.north").v[last] as number, e: of("position_m.east").v[last] as number, t: valid.t[last] as number }, source.now);
}
