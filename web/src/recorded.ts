// SPDX-License-Identifier: BSD-3-Clause
// A flight that was recorded, at any moment of it: the same as a flight that is connected, to those who look. What
// it is made of: tools/fulmar_report/report.hpp.
import { type Message, decode, number_at, parse_schema } from "./protocol/schema";
import type { Series, Source, Topic } from "./source";

export interface Log {
  name: string; mission: string; epoch_ns: string; begin_s: number; end_s: number; fault: string;
  metadata: Record<string, Record<string, string>>;
  topics: { topic: string; type: string; schema: string; count: number; t: number[]; data: string }[];
}

interface Recorded {
  topic: Topic;
  t: number[];
  view: DataView;
  places: number[]; // of each message
  messages: (Message | undefined)[];
  series: Map<string, { t: number[]; v: number[] }>;
}

async function bytes_of(base64: string): Promise<DataView> {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const inflated = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new DataView(await new Response(inflated).arrayBuffer());
}

export class Recording implements Source {
  now: number;
  private readonly all = new Map<string, Recorded>();

  private constructor(readonly log: Log) {
    this.now = log.begin_s;
  }
  static async of(log: Log): Promise<Recording> {
    const recording = new Recording(log);
    await recording.unpack();
    return recording;
  }
  private async unpack(): Promise<void> {
    for (const { topic: name, type, schema, t, data } of this.log.topics) {
      const view = await bytes_of(data), places: number[] = [];
      for (let at = 0; at + 4 <= view.byteLength; at += 4 + view.getUint32(at, true)) places.push(at + 4);
      this.all.set(name, {
        topic: { name, type, fields: parse_schema(type, schema) }, t: t.slice(0, places.length), view, places,
        messages: [], series: new Map(),
      });
    }
  }

  topics(): Topic[] {
    return [...this.all.values()].map((r) => r.topic);
  }
  private read(r: Recorded, i: number): Message | undefined {
    try {
      return (r.messages[i] ??= decode(r.topic.fields, r.view, r.places[i] ?? Infinity));
    } catch {
      return undefined;
    }
  }
  /** How many messages there are until now. */
  private until(t: number[]): number {
    let low = 0, high = t.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if ((t[middle] as number) <= this.now) low = middle + 1;
      else high = middle;
    }
    return low;
  }
  latest(topic: string): Message | undefined {
    const r = this.all.get(topic), n = r ? this.until(r.t) : 0;
    return r && n > 0 ? this.read(r, n - 1) : undefined;
  }
  age(topic: string): number {
    const r = this.all.get(topic), n = r ? this.until(r.t) : 0;
    return r && n > 0 ? this.now - (r.t[n - 1] as number) : Infinity;
  }
  series(topic: string, path: string): Series {
    const r = this.all.get(topic);
    if (!r) return { t: [], v: [] };
    let whole = r.series.get(path);
    if (!whole) {
      whole = { t: [], v: [] };
      for (let i = 0; i < r.t.length; ++i) {
        const value = number_at(this.read(r, i), path);
        if (value === undefined) continue;
        whole.t.push(r.t[i] as number);
        whole.v.push(value);
      }
      r.series.set(path, whole);
    }
    const n = this.until(whole.t);
    return { t: whole.t.slice(0, n), v: whole.v.slice(0, n) };
  }
  /** All of them, at once: those of the whole flight. */
  listen(topic: string, heard: (message: Message, t: number) => void): () => void {
    const r = this.all.get(topic);
    r?.t.forEach((t, i) => {
      const message = this.read(r, i);
      if (message) heard(message, t);
    });
    return () => {};
  }
}
