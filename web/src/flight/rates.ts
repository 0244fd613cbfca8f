// SPDX-License-Identifier: BSD-3-Clause
// Message rates in flight time, since a simulation may run faster than the clock.
export class Rates {
  private rates = new Map<string, number>();
  private counts = new Map<string, number>();
  private at_s = 0;
  private counted = 0;

  /** Starts counting. The first interval gives no rate, since the subscription starts in it. */
  begin(): void {
    this.counted = 0;
    this.rates.clear();
  }
  count(now_s: number, counts: [string, number][]): void {
    const seconds = now_s - this.at_s;
    for (const [key, count] of counts) {
      const before = this.counts.get(key);
      if (this.counted >= 2 && seconds > 0 && before !== undefined)
        this.rates.set(key, (count - before) / seconds);
      else this.rates.delete(key);
      this.counts.set(key, count);
    }
    this.at_s = now_s;
    ++this.counted;
  }
  /** undefined: not measured yet. */
  of(key: string): number | undefined {
    return this.rates.get(key);
  }
}
