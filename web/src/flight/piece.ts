// SPDX-License-Identifier: BSD-3-Clause
// The piece of path that is followed now, from where the aircraft is beside it to where it ends: also on the way to
// a plan, which the plan does not show. Messages `Path`: Beard & McLain (2012), chapter 10.
import { type Message, number_at } from "../protocol/schema";
import { type Point, wrap } from "./route";

const unknown_m = 1e8, shown_m = 400; // of a piece that goes on for ever

export function piece_ahead(path: Message | undefined, at: Point): Point[] {
  if (!path) return [];
  const x = (field: string) => number_at(path, field) ?? NaN;
  const origin = { n: x("origin_m.north"), e: x("origin_m.east") }, left = x("remaining_m");
  const length = left < unknown_m ? Math.max(0, left) : NaN;
  if (path.kind === "line") {
    const n = x("direction_ratio.north"), e = x("direction_ratio.east"), level = Math.hypot(n, e);
    if (!(level > 1e-6)) return [];
    const along = ((at.n - origin.n) * n + (at.e - origin.e) * e) / level;
    const point = (s: number) => ({ n: origin.n + (s * n) / level, e: origin.e + (s * e) / level });
    return [point(along), point(along + (Number.isNaN(length) ? shown_m : length))];
  }
  const radius = x("radius_m"), side = path.turn === "left" ? -1 : 1;
  if (!(radius > 0)) return [];
  const begin = Math.atan2(at.e - origin.e, at.n - origin.n);
  const angle = Math.min(2 * Math.PI, Number.isNaN(length) ? 2 * Math.PI : length / radius);
  const steps = Math.max(2, Math.ceil(angle / 0.1));
  return Array.from({ length: steps + 1 }, (_, i) => {
    const a = wrap(begin + (side * angle * i) / steps);
    return { n: origin.n + radius * Math.cos(a), e: origin.e + radius * Math.sin(a) };
  });
}
