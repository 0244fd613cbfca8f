// SPDX-License-Identifier: BSD-3-Clause
// Geofence, landing places and runway of a connected flight, for its maps.
import { type Places, places_of } from "../flight/places";
import type { Place } from "../flight/tiles";
import type { Names } from "../names";
import type { Flight } from "../protocol/flight";
import { type Message, number_at } from "../protocol/schema";

/** Origin of the local frame; null while it is unknown. */
export function origin_of(state: Message | undefined): Place | null {
  if (state?.origin_valid !== true) return null;
  const x = (field: string) => number_at(state, field) ?? 0;
  return {
    lat_deg: x("origin_latitude_deg"),
    lon_deg: x("origin_longitude_deg"),
    alt_msl_m: x("origin_altitude_m"),
  };
}

let kept: { records: unknown[]; origin: string; places: Places } | null = null;
export function places_now(flight: Flight, names: Names): Places {
  const origin = flight.view?.origin ?? origin_of(flight.latest(names.state)),
    key = JSON.stringify(origin);
  if (kept?.records !== flight.records || kept.origin !== key)
    kept = { records: flight.records, origin: key, places: places_of(flight.records, origin) };
  return kept.places;
}
