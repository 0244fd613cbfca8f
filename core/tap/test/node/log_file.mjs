// SPDX-License-Identifier: BSD-3-Clause
// Opens a log like Foxglove: indexed reader, checksums verified, schemas parsed as ROS 2 message text,
// messages decoded as CDR.
import { open } from "node:fs/promises";
import { createHash } from "node:crypto";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { decompress } from "fzstd";

const decompressHandlers = { zstd: (bytes, size) => decompress(bytes, new Uint8Array(Number(size))) };

/** @returns every message of every channel in order of time: {topic, sequence, log_ns, publish_ns, value} */
export async function* messages(file) {
  const handle = await open(file);
  try {
    const reader = await McapIndexedReader.Initialize({ readable: await readable_of(handle), decompressHandlers });
    check(reader);
    const decoders = new Map();
    for (const [id, channel] of reader.channelsById) decoders.set(id, decoder(channel, reader.schemasById.get(channel.schemaId)));
    const counts = new Map();
    for await (const m of reader.readMessages({ validateCrcs: true })) {
      const { topic, decode } = decoders.get(m.channelId);
      counts.set(m.channelId, (counts.get(m.channelId) ?? 0n) + 1n);
      yield { topic, sequence: m.sequence, log_ns: m.logTime, publish_ns: m.publishTime, value: decode(m.data) };
    }
    for (const [id, n] of reader.statistics.channelMessageCounts) {
      if (counts.get(id) !== n) throw new Error(`channel ${id}: the statistics say ${n} messages, the index leads to ${counts.get(id)}`);
    }
    let extras = 0;
    for await (const _ of reader.readAttachments({ validateCrcs: true })) ++extras;
    for await (const _ of reader.readMetadata()) ++extras;
    const { attachmentCount, metadataCount } = reader.statistics;
    if (extras !== attachmentCount + metadataCount) throw new Error("an attachment or metadata is missing");
  } finally {
    await handle.close();
  }
}

async function readable_of(handle) {
  const size = BigInt((await handle.stat()).size);
  return {
    size: async () => size,
    read: async (offset, length) => {
      const buffer = new Uint8Array(Number(length));
      const { bytesRead } = await handle.read(buffer, 0, Number(length), Number(offset));
      if (bytesRead !== Number(length)) throw new Error(`short read at ${offset}`);
      return buffer;
    },
  };
}

function check(reader) {
  if (reader.header.profile !== "ros2") throw new Error(`profile '${reader.header.profile}'`);
  if (!reader.dataSectionCrc) throw new Error("no checksum of the data");
  if (reader.footer.summaryCrc === 0) throw new Error("no checksum of the summary");
  const groups = reader.summaryOffsetsByOpcode ?? new Map();
  if (groups.size === 0) throw new Error("no summary offsets");
}

function decoder(channel, schema) {
  if (channel.messageEncoding !== "cdr" || schema?.encoding !== "ros2msg") throw new Error(`${channel.topic}: not cdr with ros2msg`);
  if (!/^RIHS01_[0-9a-f]{64}$/.test(channel.metadata.get("topic_type_hash"))) throw new Error(`${channel.topic}: no type hash`);
  if (!channel.metadata.get("offered_qos_profiles")?.startsWith("- history: 1\n")) throw new Error(`${channel.topic}: no QoS profile`);
  const reader = new MessageReader(parse(new TextDecoder().decode(schema.data), { ros2: true }));
  const decode = (data) => {
    const value = reader.readMessage(data);
    if (reader.lastReadByteLength() !== data.byteLength) {
      throw new Error(`${channel.topic}: decoded ${reader.lastReadByteLength()} of ${data.byteLength} bytes`);
    }
    return value;
  };
  return { topic: channel.topic, decode };
}

/** topic -> {name, definitions}, of the channels that the summary lists. */
export async function schemas(file) {
  const handle = await open(file);
  try {
    const reader = await McapIndexedReader.Initialize({ readable: await readable_of(handle), decompressHandlers });
    const found = new Map();
    for (const { topic, schemaId } of reader.channelsById.values()) {
      const schema = reader.schemasById.get(schemaId);
      found.set(topic, { name: schema.name, definitions: parse(new TextDecoder().decode(schema.data), { ros2: true }) });
    }
    return found;
  } finally {
    await handle.close();
  }
}

/** The number of messages that a reader without index finds, and the SHA-256 of the file. */
export async function scan(file) {
  const handle = await open(file);
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  const sha = createHash("sha256");
  let count = 0;
  for await (const piece of handle.createReadStream()) {
    sha.update(piece);
    reader.append(piece);
    for (let record; (record = reader.nextRecord()); ) count += record.type === "Message";
  }
  if (!reader.done()) throw new Error("the file does not end with a footer");
  return { messages: count, sha256: sha.digest("hex") };
}
