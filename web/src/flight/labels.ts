// SPDX-License-Identifier: BSD-3-Clause
// Side of a waypoint for its height label: away from its legs. x to the right, y down.
export interface Spot {
  x: number;
  y: number;
}
/** In order of preference. */
const sides: Spot[] = [
  { x: 1, y: 0 },
  { x: -1, y: 0 },
  { x: 0, y: -1 },
  { x: 0, y: 1 },
];

/** The side whose direction is farthest from those of all neighbours; a neighbour at the same place has none. */
export function label_side(at: Spot, neighbours: Spot[]): Spot {
  const ways = neighbours
    .map((p) => ({ x: p.x - at.x, y: p.y - at.y, far: Math.hypot(p.x - at.x, p.y - at.y) }))
    .filter((w) => w.far > 0);
  const towards = (side: Spot) => Math.max(-1, ...ways.map((w) => (side.x * w.x + side.y * w.y) / w.far));
  return sides.reduce((best, side) => (towards(side) < towards(best) - 1e-9 ? side : best));
}
