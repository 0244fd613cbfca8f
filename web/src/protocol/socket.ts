// SPDX-License-Identifier: BSD-3-Clause
// Client of the Foxglove WebSocket protocol, version 1: connects, reconnects, and detects a silent server within a second.
// Independent of flights.

export interface Channel {
  id: number;
  topic: string;
  schemaName: string;
  schema: string;
}
export interface ServiceInfo {
  id: number;
  name: string;
  request: { schemaName: string; schema: string };
}
export interface Handlers {
  session(id: string): void; // a new or the same flight
  channels(list: Channel[]): void;
  services(list: ServiceInfo[]): void;
  data(channel: number, time_ns: bigint, view: DataView, offset: number): void;
  time(time_ns: bigint): void;
  parameters(list: { name: string; value?: unknown }[]): void;
  status(level: number, message: string): void;
  link(state: LinkState): void;
}
export interface LinkState {
  up: boolean;
  since_ms: number; // of performance.now(), when this began
  why: string; // it is down
}

const alive_ms = 200; // between two requests that measure the age of the data
const lost_ms = 750; // without a message: connection lost
const again_ms = 500; // between two attempts
const watch_ms = 100;
const op_data = 1,
  op_time = 2,
  op_call = 2,
  op_answer = 3;
const encoding = new TextEncoder().encode("json");

interface Call {
  done: (answer: unknown) => void;
  failed: (why: Error) => void;
}

export class Socket {
  private ws: WebSocket | null = null;
  private heard_ms = 0;
  private watched_ms = 0;
  private quiet = 0; // ms without a message while this page was active: a sleeping page reads its messages later
  private asked = new Map<string, number>(); // requests without an answer, and their send times
  private next_asked = 1;
  private asked_ms = 0;
  private known_ms = 0; // send time of the newest request with an answer
  private opened_ms = 0;
  private up = false;
  private calls = new Map<number, Call>();
  private next_call = 1;
  private readonly wanted = new Set<number>();
  private subscribed = new Set<number>();

  constructor(
    private readonly url: string,
    private readonly on: Handlers,
  ) {
    this.open();
    setInterval(() => this.watch(), watch_ms);
    document.addEventListener("visibilitychange", () => {
      this.known_ms = performance.now(); // no requests while the page is hidden
      this.heard();
    });
  }

  private open(): void {
    this.heard();
    this.opened_ms = this.heard_ms;
    const ws = new WebSocket(this.url, ["foxglove.websocket.v1"]);
    ws.binaryType = "arraybuffer";
    ws.onmessage = (event) => {
      if (ws !== this.ws) return;
      this.heard();
      if (typeof event.data === "string") this.text(event.data);
      else this.binary(event.data as ArrayBuffer);
    };
    ws.onclose = (event) => {
      if (ws === this.ws) this.lose(event.reason);
    };
    this.ws = ws;
  }

  private heard(): void {
    this.heard_ms = performance.now();
    this.quiet = 0;
  }

  private lose(reason: string): void {
    const ws = this.ws;
    this.ws = null;
    ws?.close();
    this.subscribed = new Set();
    for (const call of this.calls.values())
      call.failed(new Error("The connection was lost before the answer."));
    this.calls.clear();
    if (!this.up) return;
    this.up = false;
    this.on.link({ up: false, since_ms: this.heard_ms, why: reason });
  }

  private watch(): void {
    const now = performance.now();
    this.quiet += Math.min(now - this.watched_ms, 2 * watch_ms);
    this.watched_ms = now;
    if (this.ws === null) {
      if (now - this.opened_ms > again_ms) this.open();
      return;
    }
    if (document.hidden) return; // a hidden page may sleep
    const asks = this.up && this.sign_of_life.length > 0; // otherwise the server may be silent for a while
    if (this.quiet > lost_ms && (asks || this.quiet > 5 * lost_ms))
      return this.lose("no answer from the flight");
    if (!asks || now - this.asked_ms < alive_ms) return;
    this.asked_ms = now;
    const id = "alive " + this.next_asked++;
    this.asked.set(id, now);
    this.send({ op: "getParameters", parameterNames: this.sign_of_life, id });
  }
  /** Largest possible age of the last data. An answer passes every queue after the samples that were sent before it. */
  age_ms(): number {
    return performance.now() - this.known_ms;
  }
  /** The same minus the shortest round trip: the delay in queues. */
  late_ms(): number {
    return this.age_ms() - (Number.isFinite(this.least_ms) ? this.least_ms : 0);
  }
  private least_ms = Infinity;
  private answered(id: string): void {
    const sent = this.asked.get(id);
    if (sent === undefined) return;
    this.least_ms = Math.min(this.least_ms, performance.now() - sent);
    for (const [other, ms] of this.asked) if (ms <= sent) this.asked.delete(other);
    this.known_ms = Math.max(this.known_ms, sent);
  }
  /** One parameter, so that the answer is short. */
  sign_of_life: string[] = []; // empty: not known yet; no request, since an empty list requests all parameters

  private send(message: unknown): void {
    if (this.ws?.readyState === WebSocket.OPEN) this.ws.send(JSON.stringify(message));
  }

  private text(text: string): void {
    const message = JSON.parse(text);
    switch (message.op) {
      case "serverInfo":
        this.up = true;
        this.known_ms = performance.now();
        this.least_ms = Infinity;
        this.asked.clear();
        this.on.session(String(message.sessionId));
        this.on.link({ up: true, since_ms: performance.now(), why: "" });
        break;
      case "advertise":
        this.on.channels(message.channels);
        this.resubscribe();
        break;
      case "advertiseServices":
        this.on.services(message.services);
        break;
      case "parameterValues":
        if (String(message.id ?? "").startsWith("alive ")) this.answered(message.id);
        else this.on.parameters(message.parameters);
        break;
      case "status":
        this.on.status(message.level, String(message.message));
        break;
      case "serviceCallFailure":
        this.settle(message.callId)?.failed(new Error(String(message.message)));
    }
  }

  private settle(id: number): Call | undefined {
    const call = this.calls.get(id);
    this.calls.delete(id);
    return call;
  }

  private binary(bytes: ArrayBuffer): void {
    const view = new DataView(bytes);
    const op = view.getUint8(0);
    if (op === op_data) this.on.data(view.getUint32(1, true), view.getBigUint64(5, true), view, 13);
    if (op === op_time) this.on.time(view.getBigUint64(1, true));
    if (op !== op_answer) return;
    const call = this.settle(view.getUint32(5, true));
    const text = new TextDecoder().decode(new Uint8Array(bytes, 13 + view.getUint32(9, true)));
    try {
      call?.done(JSON.parse(text));
    } catch (fault) {
      call?.failed(fault as Error);
    }
  }

  /** Subscribes to the channel or ends it; the subscription has the channel's id. */
  want(channel: number, on: boolean): void {
    if (on) this.wanted.add(channel);
    else this.wanted.delete(channel);
    this.resubscribe();
  }

  /** Samples of these channels only, until a call with null, so that the queues become empty. */
  hold(kept: Set<number> | null): void {
    this.kept = kept;
    this.resubscribe();
  }
  private kept: Set<number> | null = null;

  private resubscribe(): void {
    if (!this.up) return;
    const kept = this.kept,
      now = kept ? [...this.wanted].filter((id) => kept.has(id)) : [...this.wanted];
    const more = now.filter((id) => !this.subscribed.has(id));
    const less = [...this.subscribed].filter((id) => !now.includes(id));
    if (more.length > 0)
      this.send({ op: "subscribe", subscriptions: more.map((id) => ({ id, channelId: id })) });
    if (less.length > 0) this.send({ op: "unsubscribe", subscriptionIds: less });
    this.subscribed = new Set(now);
  }

  watch_parameters(): void {
    this.send({ op: "subscribeParameterUpdates", parameterNames: [] });
  }

  set_parameters(list: { name: string; value: unknown }[]): void {
    this.send({ op: "setParameters", parameters: list });
  }

  /** Calls a service with JSON. Returns its answer. */
  call(service: number, request: unknown): Promise<unknown> {
    const ws = this.ws;
    if (!this.up || ws?.readyState !== WebSocket.OPEN)
      return Promise.reject(new Error("There is no connection to the flight."));
    const id = this.next_call++;
    const body = new TextEncoder().encode(JSON.stringify(request));
    const bytes = new Uint8Array(13 + encoding.length + body.length);
    const view = new DataView(bytes.buffer);
    view.setUint8(0, op_call);
    view.setUint32(1, service, true);
    view.setUint32(5, id, true);
    view.setUint32(9, encoding.length, true);
    bytes.set(encoding, 13);
    bytes.set(body, 13 + encoding.length);
    return new Promise((done, failed) => {
      this.calls.set(id, { done, failed });
      ws.send(bytes);
    });
  }
}
