// SPDX-License-Identifier: BSD-3-Clause
// Data that `fulmar report` adds to the page: tools/fulmar_report/report.cpp, judged.cpp and topics.cpp.

/** Numbers over time, or messages, as tools/fulmar_report/columns.hpp packs them. */
export interface PackedTopic {
  topic: string;
  type: string;
  schema: string;
  count: number;
  rows: number;
  fields: string[]; // fields of the columns; empty: complete messages
  data: string;
  t?: string;
}
export interface PackedSeries {
  words: string;
  unit: string;
  n: number;
  mean: number;
  rms: number;
  largest: number;
  rows: number;
  columns: number;
  data: string;
  claimed?: number;
  within_1?: number;
  within_2?: number;
}
export interface Estimate {
  topic: string;
  reference: string;
  truth: boolean;
  pairs: number;
  rows: PackedSeries[];
  nees?: { mean: number; inside: number };
}
export interface Told {
  t: number;
  kind: string;
  component: string;
  severity: string;
  words: string;
}
/** Flight controller: tools/fulmar_report/hardware.cpp. */
export interface Hardware {
  firmware: string | null;
  calibration: Record<string, string> | null;
  parameters_changed: number;
  link: Record<string, number>;
  battery: Record<string, number> | null;
  radio_age_max_s: number | null;
  who_flew_s: Record<string, number> | null;
}
export interface Log {
  name: string;
  mission: string;
  begin_s: number;
  end_s: number;
  bytes: number;
  messages: number;
  fault: string;
  metadata: Record<string, Record<string, string>>;
  figures: Record<string, unknown>; // those of `fulmar run --json`
  verdict: { words: string; severity: string }; // no words: the log ends before the flight
  phases: { name: string; from_s: number; to_s: number; because: string }[];
  told: { rows: Told[]; all: number };
  estimates: Estimate[];
  innovations: PackedSeries[];
  hardware: Hardware | null; // null in simulation
  ticks: { n: number; mean_ms: number; p99_ms: number; max_ms: number } | null;
  steps: Record<string, { mean: number; p50: number; p99: number; max: number }> | null;
  ground?: unknown[]; // records of geofence, landing places, runway, origin
  topics: PackedTopic[];
}
export interface ReportData {
  logs: Log[];
  parameters: { name: string; values: unknown[] }[]; // that differ, a value per log; null: none
}

async function bytes_of(base64: string): Promise<DataView> {
  const text = atob(base64),
    bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const inflated = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new DataView(await new Response(inflated).arrayBuffer());
}

/** Messages in sequence, each after its length. */
export async function unpack_messages(data: string): Promise<{ view: DataView; places: number[] }> {
  const view = await bytes_of(data),
    places: number[] = [];
  for (let at = 0; at + 4 <= view.byteLength; at += 4 + view.getUint32(at, true)) places.push(at + 4);
  return { view, places };
}

/** Seconds of flight, and `columns` lists of values. */
export async function unpack_columns(
  data: string,
  rows: number,
  columns: number,
): Promise<{ t: number[]; values: Float32Array[] }> {
  const view = await bytes_of(data);
  const word = (column: number, row: number) => {
    let all = 0;
    for (let plane = 3; plane >= 0; --plane)
      all = (all << 8) | view.getUint8((4 * column + plane) * rows + row);
    return all;
  };
  const t: number[] = [];
  for (let row = 0, now = 0; row < rows; ++row) t.push((now = (now + word(0, row)) | 0) / 1e4);
  const values = Array.from({ length: columns }, (_, k) => {
    const bits = new Int32Array(rows);
    for (let row = 0, now = 0; row < rows; ++row) bits[row] = now ^= word(k + 1, row);
    return new Float32Array(bits.buffer);
  });
  return { t, values };
}
