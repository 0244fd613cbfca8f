// SPDX-License-Identifier: BSD-3-Clause
// The active path segment from the aircraft to its end, and the next one: also on the way to a plan, and with fillets as the wind
// requires, which the plan does not show. Messages `Path`: Beard & McLain (2012), chapter 10.
import { type Message, number_at } from "../protocol/schema";
import { type Point, wrap } from "./route";

const unknown_m = 1e8,
  shown_m = 400; // of an endless segment

const known = (length: number) => (length < unknown_m ? Math.max(0, length) : NaN);

/** Along a circle, from an azimuth on. */
function arc(center: Point, radius: number, side: number, begin: number, length: number): Point[] {
  if (!(radius > 0)) return [];
  const angle = Math.min(2 * Math.PI, Number.isNaN(length) ? 2 * Math.PI : length / radius);
  const steps = Math.max(2, Math.ceil(angle / 0.1));
  return Array.from({ length: steps + 1 }, (_, i) => {
    const a = wrap(begin + (side * angle * i) / steps);
    return { n: center.n + radius * Math.cos(a), e: center.e + radius * Math.sin(a) };
  });
}

export function piece_ahead(path: Message | undefined, at: Point): Point[] {
  if (!path) return [];
  const x = (field: string) => number_at(path, field) ?? NaN;
  /** A piece, of the path or `next.`: the begin of a line or the centre of a circle, and where along it from. */
  const piece = (prefix: string, of: Message, length: number, begin: Point | number): Point[] => {
    const origin = { n: x(prefix + "origin_m.north"), e: x(prefix + "origin_m.east") };
    if (of.kind !== "line")
      return arc(
        origin,
        x(prefix + "radius_m"),
        of.turn === "left" ? -1 : 1,
        typeof begin === "number" ? begin : Math.atan2(begin.e - origin.e, begin.n - origin.n),
        length,
      );
    const n = x(prefix + "direction_ratio.north"),
      e = x(prefix + "direction_ratio.east"),
      level = Math.hypot(n, e);
    if (!(level > 1e-6)) return [];
    const along =
      typeof begin === "number" ? 0 : ((begin.n - origin.n) * n + (begin.e - origin.e) * e) / level;
    const point = (s: number) => ({ n: origin.n + (s * n) / level, e: origin.e + (s * e) / level });
    return [point(along), point(along + (Number.isNaN(length) ? shown_m : length))];
  };
  const left = known(x("remaining_m")),
    now = piece("", path, left, at),
    next = path.next as Message | undefined;
  if (path.has_next !== true || !next || next.is_curve === true || Number.isNaN(left) || now.length === 0)
    return now;
  return [...now, ...piece("next.", next, known(x("next.length_m")), x("next.start_rad"))];
}
