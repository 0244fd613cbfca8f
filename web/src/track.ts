// SPDX-License-Identifier: BSD-3-Clause
// Where the aircraft has been, five points a second, an hour of it.
import type { Track } from "./views/map";
import { type Names, state_of } from "./names";
import type { Source } from "./source";

const gap_s = 0.2, most = 18_000;

export class TrackRecorder implements Track {
  n: number[] = [];
  e: number[] = [];
  private last = -Infinity;
  constructor(private readonly source: Source, private readonly names: () => Names) {}
  update(): void {
    const now = this.source.now;
    if (!(now - this.last >= gap_s)) return;
    const state = state_of(this.source.latest(this.names().state));
    if (!state?.valid.position) return;
    this.last = now;
    this.n.push(state.n);
    this.e.push(state.e);
    if (this.n.length < 1.1 * most) return;
    this.n.splice(0, this.n.length - most);
    this.e.splice(0, this.e.length - most);
  }
}
