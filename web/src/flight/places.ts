// SPDX-License-Identifier: BSD-3-Clause
// Geofence, landing places and runway in the local plane, from records of sdk/include/fulmar/flight/path/fence.hpp and
// msg/runway.hpp.
import { LocalPlane, type Place } from "./tiles";

interface Point {
  n: number;
  e: number;
}
export interface Places {
  fence: Point[];
  places: Point[]; // the first is home
  runway: (Point & { heading: number; length: number }) | null; // from the threshold
}
type Fields = Record<string, unknown>;

const given = (x: unknown): x is number => typeof x === "number" && Math.abs(x) < 1e8; // 1e9: not given
const list = (x: unknown): Fields[] =>
  Array.isArray(x) ? x.filter((i) => typeof i === "object" && i !== null) : [];

/** From north and east, or from latitude and longitude, which need an origin. */
function point_of(record: Fields, origin: Place | null): Point | null {
  if (given(record.north_m) && given(record.east_m)) return { n: record.north_m, e: record.east_m };
  if (!origin || !given(record.lat_deg) || !given(record.lon_deg)) return null;
  const { n, e } = new LocalPlane(origin).to_plane(
    (record.lat_deg * Math.PI) / 180,
    (record.lon_deg * Math.PI) / 180,
  );
  return { n, e };
}

function runway_of(record: Fields | undefined, origin: Place | null): Places["runway"] {
  if (!record || !given(record.length_m) || !given(record.heading_rad) || record.length_m <= 0) return null;
  const at = point_of(record, origin);
  return at && { ...at, heading: record.heading_rad, length: record.length_m };
}

/** The first of each kind. A separate runway has priority over that of a plan. */
export function places_of(records: readonly unknown[], origin: Place | null): Places {
  const all = list(records);
  const points = (key: string) => {
    const found = list(all.find((r) => list(r[key]).length > 0)?.[key]);
    return found.map((r) => point_of(r, origin)).filter((p): p is Point => p !== null);
  };
  const strips = [...all.filter((r) => "length_m" in r), ...list(all.map((r) => r.runway))];
  const fence = points("corners");
  return {
    fence: fence.length > 2 ? fence : [],
    places: points("places"),
    runway: strips.map((r) => runway_of(r, origin)).find((r) => r !== null) ?? null,
  };
}
