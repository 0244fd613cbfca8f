// SPDX-License-Identifier: BSD-3-Clause
// node export_test.mjs LOG FOLDER: every value of every message, as third-party readers decode it, is in the CSV files of
// `fulmar log export LOG --to csv --out FOLDER`, and no other value is.
import assert from "node:assert/strict";
import { createReadStream } from "node:fs";
import { join } from "node:path";
import { createInterface } from "node:readline";
import { messages } from "./log_file.mjs";

function* leaves(value, name) {
  if (Array.isArray(value) || ArrayBuffer.isView(value)) {
    for (let i = 0; i < value.length; ++i) yield* leaves(value[i], `${name}[${i}]`);
  } else if (typeof value === "object") {
    for (const [key, inner] of Object.entries(value)) yield* leaves(inner, name === "" ? key : `${name}.${key}`);
  } else {
    yield [name, value];
  }
}

/** One line of CSV; texts here hold no line breaks. */
function cells(line) {
  const list = [];
  for (const m of line.matchAll(/("(?:[^"]|"")*"|[^,]*)(?:,|$)/g)) {
    if (list.length > 0 && m.index === line.length && !line.endsWith(",")) break;
    list.push(m[1].startsWith('"') ? m[1].slice(1, -1).replaceAll('""', '"') : m[1]);
  }
  return list;
}

const [log, folder] = process.argv.slice(2);
const tables = new Map();
let values = 0;
for await (const m of messages(log)) {
  if (!tables.has(m.topic)) {
    const file = join(folder, m.topic.slice(1).replaceAll("/", ".") + ".csv");
    const lines = createInterface({ input: createReadStream(file) })[Symbol.asyncIterator]();
    tables.set(m.topic, { lines, header: cells((await lines.next()).value) });
  }
  const { lines, header } = tables.get(m.topic);
  const row = cells((await lines.next()).value);
  const found = new Map(header.map((name, i) => [name, row[i]]));
  assert.equal(row.length, header.length, m.topic);
  for (const [name, value] of leaves(m.value, "")) {
    const text = found.get(name);
    if (typeof value === "number") assert.ok(Object.is(Number(text), value) || Math.fround(Number(text)) === value, `${m.topic} ${name}: ${text}, not ${value}`);
    else if (typeof value === "boolean") assert.equal(text, value ? "1" : "0", `${m.topic} ${name}`);
    else assert.equal(text, String(value), `${m.topic} ${name}`);
    found.delete(name);
    ++values;
  }
  for (const [name, text] of found) {
    const beside = name === "time_s" || name === "valid_s" || name.endsWith(".label");
    assert.ok(beside || text === "nan" || text === "", `${m.topic} ${name}: ${text} is in no message`);
  }
}
for (const [topic, { lines }] of tables) assert.ok((await lines.next()).done, `${topic}: there are rows without a message`);
console.log(`${values} values of ${tables.size} channels are exported as they are`);
