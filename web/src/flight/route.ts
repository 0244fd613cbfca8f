// SPDX-License-Identifier: BSD-3-Clause
// The route of a plan, equal to sdk/include/fulmar/flight/path/route.hpp and dubins.hpp: the page draws the path that will
// be flown. Sources: Beard & McLain (2012), sections 11.1 and 11.2; Shkel & Lumelsky (2001).

export interface Waypoint {
  north: number;
  east: number;
  up: number;
  course: number | null; // rad
  airspeed: number; // 0: the plan's
  id: number; // 0: not yet in the planner
  geodetic: { latitude: number; longitude: number; altitude: number } | null;
}
export interface Plan {
  end: "circuit" | "orbit";
  radius: number;
  airspeed: number;
  waypoints: Waypoint[];
}
export interface Point {
  n: number;
  e: number;
}
interface Pose extends Point {
  chi: number;
}
interface Corner {
  in_chi: number;
  out_chi: number;
  in_m: number;
  out_m: number;
  tangent: number;
  wanted: boolean;
}
interface Passage {
  entry: Pose;
  middle: Pose;
  exit: Pose;
  turn: number;
}

const same_place_m = 1,
  fillet_max = 2.62;

export function wrap(angle: number): number {
  return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
}
function positive(angle: number): number {
  const a = angle - 2 * Math.PI * Math.floor(angle / (2 * Math.PI));
  return a > 2 * Math.PI - 1e-9 ? 0 : a;
}
function advance(from: Pose, curvature: number, length: number): Pose {
  const half = (curvature * length) / 2;
  const chord = Math.abs(half) < 1e-6 ? length : (length * Math.sin(half)) / half;
  const chi = from.chi + half;
  return { n: from.n + chord * Math.cos(chi), e: from.e + chord * Math.sin(chi), chi: from.chi + 2 * half };
}

// rsr, rsl, lsr, lsl, rlr, lrl; the first of equally long words
const words = [
  [1, 0, 1],
  [1, 0, -1],
  [-1, 0, 1],
  [-1, 0, -1],
  [1, -1, 1],
  [-1, 1, -1],
] as const;

function word_parts(
  word: readonly [number, number, number],
  alpha: number,
  beta: number,
  d: number,
): number[] | null {
  const [first, middle, last] = word;
  const n = d - last * Math.sin(beta) + first * Math.sin(alpha);
  const e = last * Math.cos(beta) - first * Math.cos(alpha);
  const l = Math.hypot(n, e);
  let course = l > 1e-9 ? Math.atan2(e, n) : alpha;
  if (middle !== 0) {
    if (l > 4) return null;
    const gamma = Math.acos(l / 4),
      long = Math.PI + 2 * gamma;
    course += first * (gamma + Math.PI / 2);
    return [positive(first * (course - alpha)), long, positive(first * (beta - course) + long)];
  }
  let straight = l;
  if (first !== last) {
    if (l * l < 4) return null;
    straight = Math.sqrt(l * l - 4);
    course += first * Math.atan2(2, straight);
  }
  return [positive(first * (course - alpha)), straight, positive(last * (beta - course))];
}

/** Curvature and length of each piece of the shortest Dubins path. */
export function dubins(from: Pose, to: Pose, radius: number): { curvature: number; length: number }[] {
  const theta = Math.atan2(to.e - from.e, to.n - from.n);
  const d = Math.hypot(to.e - from.e, to.n - from.n) / radius;
  let best: { curvature: number; length: number }[] = [];
  let shortest = Infinity;
  for (const word of words) {
    const parts = word_parts(word, from.chi - theta, to.chi - theta, d);
    const length = parts ? parts.reduce((a, b) => a + b, 0) : Infinity;
    if (!parts || length >= shortest - 1e-9) continue;
    shortest = length;
    best = parts.map((part, i) => ({ curvature: (word[i] as number) / radius, length: part * radius }));
  }
  return best;
}

/** A polyline along a leg: arcs in steps of at most 6 degrees. */
function draw(points: Point[], at: Pose, curvature: number, length: number): Pose {
  const steps = Math.max(1, Math.ceil((Math.abs(curvature) * length) / 0.1));
  for (let i = 1; i <= steps; ++i) points.push(advance(at, curvature, (length * i) / steps));
  return advance(at, curvature, length);
}

export class Route {
  constructor(private readonly plan: Plan) {}

  private get size(): number {
    return this.plan.waypoints.length;
  }
  private get closed(): boolean {
    return this.plan.end === "circuit";
  }
  private get radius(): number {
    return Math.max(this.plan.radius, 1);
  }
  private w(i: number): Waypoint {
    return this.plan.waypoints[i] as Waypoint;
  }
  private before(i: number): number {
    return i > 0 ? i - 1 : this.closed ? this.size - 1 : 0;
  }
  private after(i: number): number {
    return i + 1 < this.size ? i + 1 : this.closed ? 0 : i;
  }
  private same(i: number, j: number): boolean {
    return Math.hypot(this.w(i).north - this.w(j).north, this.w(i).east - this.w(j).east) < same_place_m;
  }
  private is_entry(i: number): boolean {
    return !this.closed && i + 1 === this.size;
  }
  private first_of(i: number): number {
    for (let k = 0; k < this.size; ++k) {
      const j = this.before(i);
      if (j === i || !this.same(i, j)) break;
      i = j;
    }
    return i;
  }
  private last_of(i: number): number {
    for (let k = 0; k < this.size; ++k) {
      const j = this.after(i);
      if (j === i || this.is_entry(j) || !this.same(i, j)) break;
      i = j;
    }
    return i;
  }
  private is_point(): boolean {
    for (let i = 1; i < this.size; ++i) if (!this.same(i - 1, i)) return false;
    return true;
  }

  /** 1 is right. */
  private final_turn(): number {
    const last = this.size - 1;
    if (last <= 0) return 1;
    const q = this.first_of(last - 1),
      p = this.before(q);
    const n = this.w(last).north - this.w(q).north,
      e = this.w(last).east - this.w(q).east,
      d = Math.hypot(n, e);
    const chi =
      p !== q
        ? Math.atan2(this.w(q).east - this.w(p).east, this.w(q).north - this.w(p).north)
        : Math.atan2(e, n);
    const to = d > 1e-9 ? Math.atan2(e, n) : chi;
    const offset = d > this.radius ? Math.asin(this.radius / d) : Math.PI / 2;
    return Math.abs(wrap(to - offset - chi)) <= Math.abs(wrap(to + offset - chi)) + 1e-9 ? 1 : -1;
  }
  private entry(): Pose {
    const last = this.size - 1,
      q = this.size > 1 ? this.first_of(last - 1) : 0;
    const n = this.w(last).north - this.w(q).north,
      e = this.w(last).east - this.w(q).east,
      d = Math.hypot(n, e);
    const side = this.final_turn();
    const chi = Math.atan2(e, n) - side * Math.asin(d > this.radius ? this.radius / d : 0);
    const azimuth = chi - (side * Math.PI) / 2;
    return {
      n: this.w(last).north + this.radius * Math.cos(azimuth),
      e: this.w(last).east + this.radius * Math.sin(azimuth),
      chi,
    };
  }
  private place(i: number): Pose {
    if (this.is_entry(i)) return this.entry();
    const w = this.w(this.first_of(i));
    return { n: w.north, e: w.east, chi: 0 };
  }
  private corner(i: number): Corner {
    const first = this.first_of(i),
      last = this.last_of(i);
    const here = this.place(i),
      from = this.place(this.before(first)),
      to = this.place(this.after(last));
    const c: Corner = {
      in_m: Math.hypot(here.n - from.n, here.e - from.e),
      out_m: Math.hypot(to.n - here.n, to.e - here.e),
      in_chi: Math.atan2(here.e - from.e, here.n - from.n),
      out_chi: Math.atan2(to.e - here.e, to.n - here.n),
      tangent: 0,
      wanted: false,
    };
    if (this.before(first) === first) c.in_chi = c.out_chi;
    if (this.after(last) === last) c.out_chi = c.in_chi;
    const turn = Math.abs(wrap(c.out_chi - c.in_chi));
    c.wanted =
      first === last &&
      this.before(i) !== i &&
      this.after(i) !== i &&
      this.w(i).course === null &&
      turn <= fillet_max;
    if (c.wanted) {
      c.tangent = this.radius * Math.tan(turn / 2);
      c.wanted = c.tangent <= Math.min(c.in_m, c.out_m);
    }
    return c;
  }
  private has_fillet(i: number, c: Corner): boolean {
    const fits = (j: number, leg: number) => {
      if (this.is_entry(j)) return true;
      const other = this.corner(j);
      return !other.wanted || c.tangent + other.tangent <= leg + 1e-9;
    };
    return c.wanted && fits(this.before(i), c.in_m) && fits(this.after(i), c.out_m);
  }
  passage(i: number): Passage {
    let middle = this.place(i);
    if (!this.is_entry(i)) {
      const c = this.corner(i);
      if (this.has_fillet(i, c)) {
        const turn = wrap(c.out_chi - c.in_chi);
        const entry = advance({ ...middle, chi: c.in_chi }, 0, -c.tangent);
        const exit = advance({ ...middle, chi: c.out_chi }, 0, c.tangent);
        middle = advance(entry, Math.sign(turn) / this.radius, (this.radius * Math.abs(turn)) / 2);
        return { entry, middle, exit, turn };
      }
      const w = this.w(i),
        alone = this.first_of(i) === this.last_of(i);
      middle.chi = w.course ?? (alone && c.out_m > c.in_m ? c.out_chi : c.in_chi);
    }
    return { entry: middle, middle, exit: middle, turn: 0 };
  }

  private half(points: Point[], at: Pose, p: Passage): Pose {
    if (p.turn === 0) return at;
    return draw(points, at, Math.sign(p.turn) / this.radius, (this.radius * Math.abs(p.turn)) / 2);
  }
  /** From the middle of the corner before to the middle of waypoint `i`, as points. */
  leg(i: number): Point[] {
    const from = this.passage(this.before(i)),
      to = this.passage(i);
    const points: Point[] = [from.middle];
    let at: Pose = this.half(points, from.middle, from);
    at = from.exit;
    if (from.turn !== 0 && to.turn !== 0) {
      points.push(to.entry);
    } else {
      for (const part of dubins(at, to.entry, this.radius))
        at = draw(points, at, part.curvature, part.length);
    }
    this.half(points, to.entry, to);
    points.push(to.middle);
    return points;
  }
  private circle(w: Waypoint): Point[] {
    const points: Point[] = [];
    for (let k = 0; k <= 72; ++k) {
      const a = (k * Math.PI) / 36;
      points.push({ n: w.north + this.radius * Math.cos(a), e: w.east + this.radius * Math.sin(a) });
    }
    return points;
  }
  /** Every leg, by the waypoint at its end; the final orbit last. */
  legs(): { to: number; points: Point[] }[] {
    const last = this.size - 1;
    if (this.size === 0) return [];
    if (this.is_point()) return [{ to: last, points: this.circle(this.w(last)) }];
    const legs: { to: number; points: Point[] }[] = [];
    for (let i = this.closed ? 0 : 1; i < this.size; ++i) legs.push({ to: i, points: this.leg(i) });
    if (!this.closed) legs.push({ to: last, points: this.circle(this.w(last)) });
    return legs;
  }
}
