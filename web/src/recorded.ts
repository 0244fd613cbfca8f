// SPDX-License-Identifier: BSD-3-Clause
// A recorded flight at any time: the same interface to the views as a connected one.
import { type Message, decode, number_at, parse_schema } from "./protocol/schema";
import { type Log, type PackedTopic, unpack_columns, unpack_messages } from "./report/model";
import type { Series, Source, Topic } from "./source";

interface Recorded {
  topic: Topic;
  t: number[];
  message(i: number): Message | undefined;
  column(path: string): ArrayLike<number> | undefined; // one value per row
  series: Map<string, { t: number[]; v: number[] }>;
}

/** {a: {b: 1}} of "a.b"; flags are flags. */
function put(message: Message, path: string, value: number): void {
  const parts = path.split("."),
    last = parts.pop() as string;
  let at = message;
  for (const part of parts) at = (at[part] ??= {}) as Message;
  at[last] = last.endsWith("_valid") ? value !== 0 : value;
}

async function recorded(packed: PackedTopic): Promise<Recorded> {
  const topic = { name: packed.topic, type: packed.type, fields: parse_schema(packed.type, packed.schema) };
  if (packed.fields.length > 0) {
    const { t, values } = await unpack_columns(packed.data, packed.rows, packed.fields.length);
    return {
      topic,
      t,
      series: new Map(),
      column: (path) => values[packed.fields.indexOf(path)],
      message: (i) => {
        const message: Message = {};
        packed.fields.forEach((field, k) => put(message, field, values[k]?.[i] ?? NaN));
        return message;
      },
    };
  }
  const { view, places } = await unpack_messages(packed.data),
    { t } = await unpack_columns(packed.t ?? "", packed.rows, 0);
  const read: (Message | undefined)[] = [];
  return {
    topic,
    t: t.slice(0, places.length),
    series: new Map(),
    column: () => undefined,
    message: (i) => {
      try {
        return (read[i] ??= decode(topic.fields, view, places[i] ?? Infinity));
      } catch {
        return undefined;
      }
    },
  };
}

export class Recording implements Source {
  now: number;
  private readonly all = new Map<string, Recorded>();

  private constructor(readonly log: Log) {
    this.now = log.begin_s;
  }
  static async of(log: Log): Promise<Recording> {
    const recording = new Recording(log);
    for (const packed of log.topics) recording.all.set(packed.topic, await recorded(packed));
    return recording;
  }

  topics(): Topic[] {
    return [...this.all.values()].map((r) => r.topic);
  }
  /** Number of messages until now. */
  private until(t: number[]): number {
    let low = 0,
      high = t.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if ((t[middle] as number) <= this.now) low = middle + 1;
      else high = middle;
    }
    return low;
  }
  latest(topic: string): Message | undefined {
    const r = this.all.get(topic),
      n = r ? this.until(r.t) : 0;
    return r && n > 0 ? r.message(n - 1) : undefined;
  }
  age(topic: string): number {
    const r = this.all.get(topic),
      n = r ? this.until(r.t) : 0;
    return r && n > 0 ? this.now - (r.t[n - 1] as number) : Infinity;
  }
  /** Values of the complete flight. */
  whole(topic: string, path: string): Series {
    const r = this.all.get(topic);
    if (!r) return { t: [], v: [] };
    let all = r.series.get(path);
    if (!all) {
      all = { t: [], v: [] };
      const column = r.column(path);
      for (let i = 0; i < r.t.length; ++i) {
        const value = column ? column[i] : number_at(r.message(i), path);
        if (value === undefined) continue;
        all.t.push(r.t[i] as number);
        all.v.push(value);
      }
      r.series.set(path, all);
    }
    return all;
  }
  series(topic: string, path: string): Series {
    const all = this.whole(topic, path),
      n = this.until(all.t);
    return { t: all.t.slice(0, n), v: all.v.slice(0, n) };
  }
  /** Calls `heard` at once for every message of the flight. */
  listen(topic: string, heard: (message: Message, t: number) => void): () => void {
    const r = this.all.get(topic);
    r?.t.forEach((t, i) => {
      const message = r.message(i);
      if (message) heard(message, t);
    });
    return () => {};
  }
}
