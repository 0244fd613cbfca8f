// SPDX-License-Identifier: BSD-3-Clause
// node live_test.mjs TAP_LIVE_SERVER: a third-party client lists the channels of a mock flight, decodes its 400 Hz, sets a parameter, calls
// services and publishes.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import { createInterface } from "node:readline";
import protocol from "@foxglove/ws-protocol";
import { parse } from "@foxglove/rosmsg";
import { MessageReader, MessageWriter } from "@foxglove/rosmsg2-serialization";
import WebSocket from "ws";

const { FoxgloveClient } = protocol;
const epoch = 1_767_225_600_000_000_000n;
const patience = AbortSignal.timeout(60_000);
const server = spawn(process.argv[2], ["secret"], { stdio: ["pipe", "pipe", "inherit"] });
const lines = createInterface({ input: server.stdout })[Symbol.asyncIterator]();

/** The first event of that name for which `wanted` holds. */
function next(client, name, wanted = () => true) {
  return new Promise((resolve, reject) => {
    const stop = () => reject(new Error(`no ${name}`));
    patience.addEventListener("abort", stop, { once: true });
    const listener = (event) => {
      if (!wanted(event)) return;
      client.off(name, listener);
      patience.removeEventListener("abort", stop);
      resolve(event);
    };
    client.on(name, listener);
  });
}

function connect(port, subprotocol) {
  const ws = new WebSocket(`ws://127.0.0.1:${port}/?token=secret`, [subprotocol]);
  const client = new FoxgloveClient({ ws });
  client.on("error", (error) => { throw error; });
  const first = ["serverInfo", "advertise", "advertiseServices"].map((name) => next(client, name));
  return Promise.all(first).then(([info, channels, services]) => {
    assert.equal(ws.protocol, subprotocol);
    return { client, info, channels, services };
  });
}

async function data({ client, channels }) {
  assert.deepEqual(channels.map((c) => c.topic), ["/plan/mixed", "/slc/leg", "/plan/add_leg", "/fulmar/ticks"]);
  const readers = new Map(channels.map((c) => [c.topic, new MessageReader(parse(c.schema, { ros2: true }))]));
  const topics = new Map();
  const found = new Map([["/plan/mixed", []], ["/slc/leg", []]]);
  const done = new Promise((resolve) => {
    client.on("message", ({ subscriptionId, timestamp, data: bytes }) => {
      const list = found.get(topics.get(subscriptionId));
      list.push({ timestamp, value: readers.get(topics.get(subscriptionId)).readMessage(bytes) });
      if ([...found.values()].every((l) => l.length >= 800)) resolve();
    });
  });
  for (const c of channels) if (found.has(c.topic)) topics.set(client.subscribe(c.id), c.topic);
  const time = next(client, "time");
  await done;
  for (const id of topics.keys()) client.unsubscribe(id);
  let tick = found.get("/plan/mixed")[0].value.speed_mps / 0.5;
  for (const { timestamp, value } of found.get("/plan/mixed")) {  // every tick, none missing
    assert.equal(timestamp, epoch + BigInt(tick) * 2_500_000n);
    assert.equal(value.speed_mps, tick * 0.5);
    assert.equal(value.legs.length, tick % 4);
    assert.equal(value.name, "ab");
    assert.deepEqual(Array.from(value.gains_ratio), [1, 2, -2]);
    ++tick;
  }
  tick = Math.round(found.get("/slc/leg")[0].value.course_rad / 0.001);
  for (const { timestamp, value } of found.get("/slc/leg")) {
    assert.equal(timestamp, epoch + BigInt(tick) * 2_500_000n);
    assert.equal(value.course_rad, tick * 0.001);
    ++tick;
  }
  assert.ok((await time).timestamp >= epoch);
}

async function parameters({ client }) {
  const changed = next(client, "parameterValues", (v) => v.id === undefined);
  client.subscribeParameterUpdates(["slc.roll_kp"]);
  const answered = next(client, "parameterValues", (v) => v.id === "set");
  client.setParameters([{ name: "slc.roll_kp", value: 0.75 }], "set");
  const roll_kp = { name: "slc.roll_kp", value: 0.75, type: "float64" };
  assert.deepEqual((await answered).parameters, [roll_kp]);
  assert.deepEqual((await changed).parameters, [roll_kp]);
  const refused = next(client, "status");
  client.setParameters([{ name: "slc.roll_kp", value: 9 }]);
  const { level, message } = await refused;
  assert.equal(level, 2);
  assert.ok(message.startsWith("slc.roll_kp"));
  const all = next(client, "parameterValues", (v) => v.id === "all");
  client.getParameters([], "all");
  assert.equal((await all).parameters.find((p) => p.name === "slc.roll_kp").value, 0.75);
}

async function call({ client, services }, name, encoding, bytes) {
  const service = services.find((s) => s.name === name);
  const callId = Math.floor(Math.random() * 1e9);
  const answer = next(client, "serviceCallResponse", (r) => r.callId === callId);
  client.sendServiceCallRequest({ serviceId: service.id, callId, encoding, data: bytes(service) });
  const { data: reply, encoding: replied } = await answer;
  assert.equal(replied, encoding);
  if (encoding === "json") return JSON.parse(new TextDecoder().decode(reply));
  return new MessageReader(parse(service.response.schema, { ros2: true })).readMessage(reply);
}

async function calls(connection) {
  const json = (value) => () => new TextEncoder().encode(JSON.stringify(value));
  const cdr = (value) => (service) => new MessageWriter(parse(service.request.schema, { ros2: true })).writeMessage(value);
  assert.deepEqual(await call(connection, "/plan/add_leg", "json", json({ course_rad: 0.5 })), { accepted: true, reason: "" });
  const leg = { kind: 1, has_course: true, course_rad: 0.5, position_m: { north: 1, east: 2, down: 3 } };
  assert.deepEqual(await call(connection, "/plan/add_leg", "cdr", cdr(leg)), { accepted: true, reason: "" });
  const swap = { component: "slc", file: "law.so" };
  for (const encode of [json, cdr]) {
    const answer = await call(connection, "/fulmar/swap", encode === json ? "json" : "cdr", encode(swap));
    assert.deepEqual(answer, { accepted: false, reason: "mock.vehicle_armed" });
  }
  const view = await call(connection, "/fulmar/view", "json", json({}));
  assert.equal(view.components[0].params[0].value, 0.75);
  assert.deepEqual(JSON.parse((await call(connection, "/fulmar/view", "cdr", () => new Uint8Array())).json).phases, ["hold", "cruise"]);
}

async function publish({ client, channels }) {
  const { schemaName, schema } = channels.find((c) => c.topic === "/plan/mixed");
  const told = next(client, "status");
  client.on("status", ({ message }) => assert.ok(message.includes("/plan/mixed")));
  const id = client.advertise({ topic: "/plan/edits", encoding: "cdr", schemaName, schema, schemaEncoding: "ros2msg" });
  const leg = { kind: 1, has_course: true, course_rad: 0.5, position_m: { north: 1, east: 2, down: 3 } };
  const mixed = { gains_ratio: [1, 2, 3], samples_volt: [], tags: ["a", "b"], legs: [leg], stamp_ns: 5n, mode: 1 };
  client.sendMessage(id, new MessageWriter(parse(schema, { ros2: true })).writeMessage(mixed));
  client.unadvertise(id);
  client.advertise({ topic: "/plan/mixed", encoding: "cdr", schemaName });
  await told;
}

try {
  const port = (await lines.next()).value;
  for (const subprotocol of ["foxglove.sdk.v1", FoxgloveClient.SUPPORTED_SUBPROTOCOL]) {
    const connection = await connect(port, subprotocol);
    assert.ok(connection.info.capabilities.includes("services"));
    await data(connection);
    await parameters(connection);
    await calls(connection);
    await publish(connection);
    connection.client.close();
  }
  const refused = new WebSocket(`ws://127.0.0.1:${port}/`, ["foxglove.sdk.v1"]);
  const [error] = await once(refused, "error");
  assert.match(error.message, /401/);
  server.stdin.end();
  const stats = JSON.parse((await lines.next()).value);
  assert.deepEqual({ dropped: stats.dropped, lost: stats.lost, refused: stats.refused, published: stats.published }, { dropped: 0, lost: 0, refused: 3, published: 2 });
  console.log(`${stats.sent} messages decoded, parameters set, services called`);
} finally {
  server.kill();
}
