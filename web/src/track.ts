// SPDX-License-Identifier: BSD-3-Clause
// Track of the aircraft, five points per second, for an hour; and the region of the aircraft while its position is invalid.
import type { Lost, Track } from "./views/map";
import { type Names, state_of } from "./names";
import { type Message, number_at } from "./protocol/schema";
import type { Source } from "./source";

const gap_s = 0.2,
  most = 18_000;
const ring = 2.45; // of 95 % of a round normal distribution, in standard deviations
const unknown_m = 1e6; // a standard deviation of this size means unknown

/** Last valid position, and the 95 % circle of the estimate where there is one. */
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
