// SPDX-License-Identifier: BSD-3-Clause
// node sample_test.mjs TAP_SAMPLE_LOG: writes a log and compares its content in third-party readers with that of Fulmar's reader.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { messages, scan } from "./log_file.mjs";

const labels = { mode: ["idle", "hold", "2d_fix"], kind: ["line", "orbit"] };  // the enums of the sample, as our JSON shows them

function plain(value, key) {
  if (typeof value === "bigint") return Number(value);
  if (ArrayBuffer.isView(value) || Array.isArray(value)) return Array.from(value, (v) => plain(v));
  if (typeof value === "object") return Object.fromEntries(Object.entries(value).map(([k, v]) => [k, plain(v, k)]));
  return key in labels ? labels[key][value] : value;
}

const folder = mkdtempSync(join(tmpdir(), "fulmar-node-"));
try {
  const file = join(folder, "sample.mcap");
  const expected = JSON.parse(execFileSync(process.argv[2], [file], { maxBuffer: 1 << 28 }));
  const found = {};
  let count = 0;
  for await (const m of messages(file)) {
    const times = { log_ns: String(m.log_ns), publish_ns: String(m.publish_ns) };
    (found[m.topic] ??= []).push({ ...times, sequence: m.sequence, value: plain(m.value) });
    ++count;
  }
  assert.equal(count, 5550);
  assert.deepEqual(Object.keys(found).sort(), ["/empty", "/mixed", "/mixed_too", "/tail"]);
  for (const topic of Object.keys(expected)) assert.deepEqual(found[topic], expected[topic], topic);
  assert.equal((await scan(file)).messages, count);
  console.log(`${count} messages of ${Object.keys(found).length} channels read alike`);
} finally {
  rmSync(folder, { recursive: true });
}
