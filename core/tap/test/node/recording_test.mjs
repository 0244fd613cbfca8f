// SPDX-License-Identifier: BSD-3-Clause
// node recording_test.mjs SENSOR_LOG_FILES: writes a bag and a ULog, reads them with third-party readers, and compares
// their content with the samples that the plugin sensor_log published.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { createReadStream, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { McapStreamReader } from "@mcap/core";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import { MessageType, ULog } from "@foxglove/ulog";
import { FileReader } from "@foxglove/ulog/node.js";
import { decompress } from "fzstd";

const xyz = ({ x, y, z }) => [x, y, z];

/** topic -> its messages */
async function bag(file) {
  const decompressHandlers = { zstd: (bytes, size) => decompress(bytes, new Uint8Array(Number(size))) };
  const reader = new McapStreamReader({ decompressHandlers, validateCrcs: true });
  const schemas = new Map(), channels = new Map(), found = {};
  for await (const piece of createReadStream(file)) {
    reader.append(piece);
    for (let record; (record = reader.nextRecord()); ) {
      if (record.type === "Schema") schemas.set(record.id, new MessageReader(parse(new TextDecoder().decode(record.data), { ros2: true })));
      if (record.type === "Channel") channels.set(record.id, record);
      if (record.type !== "Message") continue;
      const { topic, schemaId } = channels.get(record.channelId);
      const decoder = schemas.get(schemaId);
      (found[topic] ??= []).push(decoder.readMessage(record.data));
      assert.equal(decoder.lastReadByteLength(), record.data.byteLength, topic);
    }
  }
  assert.ok(reader.done(), "bag without footer");
  return found;
}

/** Sensors of the bag, as rows of [arrival in ns since 1970, numbers...]. */
function of_bag(found) {
  const rows = (topic, numbers) => found[topic].map((m) => [BigInt(m.header.stamp.sec) * 1000000000n + BigInt(m.header.stamp.nanosec), ...numbers(m)]);
  return {
    imu: rows("/imu/data", (m) => [...xyz(m.angular_velocity), ...xyz(m.linear_acceleration)]),
    mag: rows("/mag", (m) => xyz(m.magnetic_field)),
    baro: rows("/pressure", (m) => [m.fluid_pressure]),
    pitot: rows("/airspeed", (m) => [m.differential_pressure]),
    gnss: rows("/gnss", (m) => [m.lat, m.lon, m.alt, m.vel_n, m.vel_e, m.vel_d, m.horizontal_accuracy, m.num_sat]),
  };
}

async function of_ulog(file) {
  const log = new ULog(new FileReader(file));
  await log.open();
  const rows = { imu: [], mag: [], baro: [], pitot: [], gnss: [] };
  const add = (sensor, m, ...numbers) => rows[sensor].push([m.timestamp * 1000n, ...numbers]);
  for await (const { type, msgId, value: m } of log.readMessages()) {
    if (type !== MessageType.Data) continue;
    const { name, multiId } = log.subscriptions.get(msgId);
    if (name === "sensor_combined") add("imu", m, ...m.gyro_rad, ...m.accelerometer_m_s2);
    if (name === "sensor_mag" && multiId === 1) add("mag", m, m.x * 1e-4, m.y * 1e-4, m.z * 1e-4);  // gauss
    if (name === "vehicle_air_data") add("baro", m, m.baro_pressure_pa);
    if (name === "differential_pressure") add("pitot", m, m.differential_pressure_pa);
    if (name === "sensor_gps")
      add("gnss", m, m.latitude_deg, m.longitude_deg, m.altitude_msl_m, m.vel_n_m_s, m.vel_e_m_s, m.vel_d_m_s, m.eph, m.satellites_used);
  }
  return rows;
}

/** Times count from the first inertial sample. */
function from_the_first(rows) {
  const first = rows.imu[0][0];
  return Object.fromEntries(Object.entries(rows).map(([sensor, all]) => [sensor, all.map(([at, ...numbers]) => [Number(at - first), ...numbers])]));
}

const folder = mkdtempSync(join(tmpdir(), "fulmar-node-"));
try {
  const ours = JSON.parse(execFileSync(process.argv[2], [folder]));
  assert.deepEqual(ours.bag, from_the_first(of_bag(await bag(join(folder, "flight.mcap")))));
  assert.deepEqual(ours.ulog, from_the_first(await of_ulog(join(folder, "flight.ulg"))));
  assert.deepEqual([ours.bag.imu.length, ours.bag.gnss.length, ours.ulog.imu.length, ours.ulog.mag.length], [3, 1, 3, 1]);
  console.log("a bag and a ULog, read alike");
} finally {
  rmSync(folder, { recursive: true });
}
