// SPDX-License-Identifier: BSD-3-Clause
// Where the aircraft has been, five points a second, an hour of it; and where it may be when its position is lost.
import type { Lost, Track } from "./views/map";
import { type Names, state_of } from "./names";
import { type Message, number_at } from "./protocol/schema";
import type { Source } from "./source";

const gap_s = 0.2,
  most = 18_000;
const ring = 2.45; // of 95 % of a round normal distribution, in deviations
const unknown_m = 1e6; // a deviation of that is none

/** Where it was last, and a circle in which it is now by 95 %, as far as the estimate says. */
export function lost_position(
  message: Message | undefined,
  last: { n: number; e: number; t: number } | null,
  now: number,
): Lost | null {
  const s = state_of(message);
  if (!s || s.valid.position || !last) return null;
  const std = Math.max(
    number_at(message, "position_std_m.north") ?? Infinity,
    number_at(message, "position_std_m.east") ?? Infinity,
  );
  const estimated = Number.isFinite(s.n) && Number.isFinite(s.e) && std > 0 && std < unknown_m;
  return {
    last,
    age_s: Math.max(0, now - last.t),
    at: estimated ? { n: s.n, e: s.e } : last,
    radius: estimated ? ring * std : null,
    yaw: s.yaw,
  };
}

export class TrackRecorder implements Track {
  n: number[] = [];
  e: number[] = [];
  private last = -Infinity;
  private fix: { n: number; e: number; t: number } | null = null;
  constructor(
    private readonly source: Source,
    private readonly names: () => Names,
  ) {}
  update(): void {
    const now = this.source.now;
    if (!(now - this.last >= gap_s)) return;
    const state = state_of(this.source.latest(this.names().state));
    if (!state?.valid.position) return;
    this.last = now;
    this.fix = { n: state.n, e: state.e, t: now };
    this.n.push(state.n);
    this.e.push(state.e);
    if (this.n.length < 1.1 * most) return;
    this.n.splice(0, this.n.length - most);
    this.e.splice(0, this.e.length - most);
  }
  lost(): Lost | null {
    return lost_position(this.source.latest(this.names().state), this.fix, this.source.now);
  }
}
