// SPDX-License-Identifier: BSD-3-Clause
// Response to the last set-point step: rise time from 10 to 90 %, overshoot, settling within 5 %, relative to the commanded
// step.
import type { Series } from "../source";

export interface StepResponse {
  at: number; // s
  from: number;
  to: number;
  rise_s: number | null;
  overshoot: number | null; // share of the step
  settling_s: number | null; // null: not yet
}

const held_s = 0.5;

/** The value held at time `t`; before all samples the first one. */
export function value_at(s: Series, t: number): number {
  let low = 0,
    high = s.t.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((s.t[middle] as number) <= t) low = middle + 1;
    else high = middle;
  }
  return s.v[Math.max(0, low - 1)] ?? NaN;
}

/**
 * `least`: smallest step. A step ends within `within_s` and then stays within a tenth of its size.
 * `turn`: period of an angle (2 pi), 0 for other quantities.
 */
export function last_step(
  asked: Series,
  got: Series,
  since: number,
  least: number,
  within_s = 0.4,
  turn = 0,
): StepResponse | null {
  const off = (x: number) => (turn > 0 ? x - turn * Math.round(x / turn) : x);
  const n = asked.t.length;
  if (n < 2) return null;
  const to = asked.v[n - 1] as number;
  let first = n - 1; // first sample equal to the last one
  let size = 0;
  for (let i = n - 1; i >= 0 && (asked.t[i] as number) >= since; --i) {
    const away = off((asked.v[i] as number) - to);
    if (Math.abs(away) < Math.max(least, Math.abs(size)) * 0.1) {
      first = i;
      continue;
    }
    if ((asked.t[first] as number) - (asked.t[i] as number) > within_s) break;
    if (Math.abs(away) > Math.abs(size)) size = away;
  }
  // a value that keeps changing is not a step
  if (Math.abs(size) < least || (asked.t[n - 1] as number) - (asked.t[first] as number) < held_s) return null;
  // start of the step: the newest sample at the full distance
  let begin = first;
  while (begin > 0 && Math.abs(off((asked.v[begin] as number) - to)) < Math.abs(size) * 0.95) --begin;
  const at = asked.t[begin] as number,
    from = to + size;
  const share = (v: number) => 1 - off(v - to) / size; // 0 before the step, 1 at its end
  let t10: number | null = null,
    t90: number | null = null,
    most = 0,
    left: number | null = null,
    seen = 0;
  for (let i = 0; i < got.t.length; ++i) {
    const t = got.t[i] as number;
    if (t < at) continue;
    const y = share(got.v[i] as number);
    seen = t;
    if (t10 === null && y >= 0.1) t10 = t;
    if (t90 === null && y >= 0.9) t90 = t;
    most = Math.max(most, y);
    if (Math.abs(y - 1) > 0.05) left = t;
  }
  const settled = left === null ? at : left;
  return {
    at,
    from,
    to,
    rise_s: t10 !== null && t90 !== null ? t90 - t10 : null,
    overshoot: t90 !== null ? Math.max(0, most - 1) : null,
    settling_s: t90 !== null && seen - settled > 0.2 * (seen - at) ? settled - at : null,
  };
}
