// SPDX-License-Identifier: BSD-3-Clause
// node read_log.mjs FILE: decodes every message of a log; prints {topics: {topic: {messages, first, last}}, messages, sha256}.
// Exits non-zero on any fault.
import { messages, scan } from "./log_file.mjs";

const file = process.argv[2];
if (file === undefined) {
  console.error("usage: node read_log.mjs FILE");
  process.exit(2);
}
const topics = {};
let count = 0;
for await (const m of messages(file)) {
  const topic = (topics[m.topic] ??= { messages: 0, first: m });
  ++topic.messages;
  topic.last = m;
  ++count;
}
const scanned = await scan(file);
if (scanned.messages !== count) throw new Error(`the index leads to ${count} messages, a scan finds ${scanned.messages}`);
const plain = (_, v) => (typeof v === "bigint" ? v.toString() : ArrayBuffer.isView(v) ? Array.from(v) : v);
console.log(JSON.stringify({ topics, messages: count, sha256: scanned.sha256 }, plain, 1));
