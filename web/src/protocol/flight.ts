// SPDX-License-Identifier: BSD-3-Clause
// A connected flight: source of the figures, and all requests to the flight.
import { type Channel, type LinkState, type ServiceInfo, Socket } from "./socket";
import { type Field, type Message, decode, number_at, parse_schema } from "./schema";
import type { Place } from "../flight/tiles";
import type { Series, Source, Topic } from "../source";

export interface Param {
  name: string;
  kind: string;
  unit: string;
  doc: string;
  value: unknown;
  text: string;
  begun: unknown;
  initial: unknown;
  min: number | null;
  max: number | null;
  choices: string[];
  live: boolean;
  overlaid: boolean;
}
export interface Port {
  name: string;
  type: string;
  topic?: string;
  source?: string;
  request?: boolean;
  imported?: boolean;
}
export interface Component {
  name: string;
  use: string;
  role: string;
  doc: string;
  run: string;
  swapped: string;
  active: boolean;
  stopped: boolean;
  steps: number;
  step_us: number;
  step_max_us: number;
  budget_us: number;
  params: Param[];
  inputs: Port[];
  outputs: Port[];
}
export interface View {
  mission: string;
  file: string;
  io: string;
  phase: string;
  phases: string[];
  now_ns: number;
  epoch_ns: number;
  armed: boolean;
  over: boolean;
  paused: boolean;
  speed: number;
  seed: string;
  origin: Place | null;
  tiles: string;
  attribution: string;
  no_save: string;
  components: Component[];
}
export interface Answer {
  accepted: boolean;
  reason: string;
}

/** Components that publish a topic: for a role all its components. */
export function publishers(flight: Flight, topic: string): Component[] {
  return topic === ""
    ? []
    : (flight.view?.components ?? []).filter((c) => c.outputs.some((p) => p.topic === topic));
}

const series_gap_s = 0.02,
  series_length = 12_000; // four minutes at 50 per second
const view_every_ms = 1000,
  too_old_ms = 1000,
  new_ms = 400,
  pace_ms = 100;

interface Heard {
  topic: Topic;
  id: number;
  schema: string;
  raw: { view: DataView; offset: number } | null;
  message: Message | undefined;
  t: number; // of the newest
  count: number;
  wall_ms: number;
  series: Map<string, { t: number[]; v: number[] }>;
  listeners: Set<(message: Message, t: number) => void>;
}

export class Flight implements Source {
  now = NaN;
  view: View | null = null;
  link: LinkState = { up: false, since_ms: performance.now(), why: "" };
  /** Status messages of the flight on requests without an answer. */
  on_status: (level: number, words: string) => void = () => {};
  on_view: (view: View) => void = () => {};
  on_link: () => void = () => {};
  /** Called when the list of topics arrives or changes. */
  readonly heard_of_channels: (() => void)[] = [];
  /** Parameters that are records: geofence, places, runway, plan. */
  records: unknown[] = [];
  private readonly socket: Socket;
  private heard = new Map<string, Heard>();
  private by_id = new Map<number, Heard>();
  private services = new Map<string, ServiceInfo>();
  private session = "";
  private epoch: bigint | null = null;
  private asked_view = false;
  private view_waiters: (() => void)[] = [];

  constructor(url: string) {
    this.socket = new Socket(url, {
      session: (id) => {
        // another flight on this port: the displayed data is not from it
        if (this.session !== "" && this.session !== id) location.reload();
        this.session = id;
      },
      channels: (list) => this.take_channels(list),
      services: (list) => {
        this.services = new Map(list.map((s) => [s.name, s]));
        void this.refresh().then(() => this.socket.watch_parameters());
      },
      data: (id, time, view, offset) => this.take(id, time, view, offset),
      time: (time) => {
        if (this.epoch !== null) this.now = Number(time - this.epoch) * 1e-9;
      },
      parameters: () => void this.refresh(),
      status: (level, words) => this.on_status(level, words),
      link: (state) => {
        this.link = state;
        this.on_link();
      },
    });
    setInterval(() => this.pace(), pace_ms);
    setInterval(() => {
      if (this.link.up && !document.hidden && !this.held) void this.refresh();
    }, view_every_ms);
  }

  private take_channels(list: Channel[]): void {
    for (const c of list) {
      const known = this.heard.get(c.topic);
      if (known) {
        this.by_id.delete(known.id);
        known.id = c.id;
        this.by_id.set(c.id, known);
        continue;
      }
      const topic = { name: c.topic, type: c.schemaName, fields: parse_schema(c.schemaName, c.schema) };
      const heard: Heard = {
        topic,
        id: c.id,
        schema: c.schema,
        raw: null,
        message: undefined,
        t: NaN,
        count: 0,
        wall_ms: 0,
        series: new Map(),
        listeners: new Set(),
      };
      this.heard.set(c.topic, heard);
      this.by_id.set(c.id, heard);
    }
    for (const heard of this.heard_of_channels) heard();
  }

  private take(id: number, time: bigint, view: DataView, offset: number): void {
    const heard = this.by_id.get(id);
    if (!heard) return;
    heard.raw = { view, offset };
    heard.message = undefined;
    heard.t = this.epoch === null ? NaN : Number(time - this.epoch) * 1e-9;
    heard.wall_ms = performance.now();
    ++heard.count;
    if (heard.t > this.now || Number.isNaN(this.now)) this.now = heard.t;
    for (const [path, s] of this.held ? [] : heard.series) {
      if (s.t.length > 0 && heard.t - (s.t[s.t.length - 1] as number) < series_gap_s - 1e-6) continue;
      const value = number_at(this.read(heard), path);
      if (value === undefined || Number.isNaN(heard.t)) continue;
      s.t.push(heard.t);
      s.v.push(value);
      if (s.t.length > series_length * 1.2) {
        s.t.splice(0, s.t.length - series_length);
        s.v.splice(0, s.v.length - series_length);
      }
    }
    if (heard.listeners.size === 0) return;
    const message = this.read(heard);
    if (message) for (const listener of heard.listeners) listener(message, heard.t);
  }

  private read(heard: Heard): Message | undefined {
    if (heard.message || !heard.raw) return heard.message;
    try {
      heard.message = decode(heard.topic.fields, heard.raw.view, heard.raw.offset);
    } catch {
      heard.raw = null; // the message does not match its schema
    }
    return heard.message;
  }

  /** A slow browser or connection receives no samples until it has read the sent ones, then the newest. */
  private pace(): void {
    const age = this.socket.late_ms(),
      hold = !document.hidden && this.link.up && (this.held ? age > new_ms : age > too_old_ms);
    if (hold === this.held) return;
    this.held = hold;
    this.socket.hold(
      hold ? new Set([...this.heard.values()].filter((h) => h.listeners.size > 0).map((h) => h.id)) : null,
    );
  }
  private held = false;
  /** Largest possible age of the last data, in transport and in this browser. */
  age_ms(): number {
    return this.socket.age_ms();
  }

  late_ms(): number {
    return this.socket.late_ms();
  }

  // ---- figures

  topics(): Topic[] {
    return [...this.heard.values()].map((h) => h.topic);
  }
  private want(topic: string): Heard | undefined {
    const heard = this.heard.get(topic);
    if (heard && this.epoch !== null) this.socket.want(heard.id, true); // the time of a sample needs the epoch
    return heard;
  }
  latest(topic: string): Message | undefined {
    const heard = this.want(topic);
    return heard ? this.read(heard) : undefined;
  }
  age(topic: string): number {
    const heard = this.heard.get(topic);
    return heard && heard.count > 0 ? Math.max(0, this.now - heard.t) : Infinity;
  }
  series(topic: string, path: string): Series {
    const heard = this.want(topic);
    if (!heard) return { t: [], v: [] };
    let series = heard.series.get(path);
    if (!series) heard.series.set(path, (series = { t: [], v: [] }));
    return series;
  }
  listen(topic: string, listener: (message: Message, t: number) => void): () => void {
    const heard = this.want(topic);
    heard?.listeners.add(listener);
    return () => heard?.listeners.delete(listener);
  }
  /** Messages so far. */
  count(topic: string): number {
    return this.heard.get(topic)?.count ?? 0;
  }
  /** Samples of every topic, or only of the displayed ones. */
  want_all(on: boolean): void {
    for (const h of this.heard.values())
      this.socket.want(h.id, on || h.series.size > 0 || h.listeners.size > 0);
  }
  fields_of_request(service: string): Field[] {
    const info = this.services.get(service);
    return info ? parse_schema(info.request.schemaName, info.request.schema) : [];
  }

  // ---- requests

  has(service: string): boolean {
    return this.services.has(service);
  }

  /** Reads the view, as it is at this time or later. */
  async refresh(): Promise<void> {
    const service = this.services.get("/fulmar/view");
    if (!service) return;
    // a pending one may be older than the change of the caller
    if (this.asked_view) return new Promise((done) => this.view_waiters.push(done));
    this.asked_view = true;
    try {
      const view = (await this.socket.call(service.id, {})) as View;
      const first_time = this.epoch === null;
      this.view = view;
      this.epoch = BigInt(view.epoch_ns);
      if (first_time) for (const heard of this.heard_of_channels) heard();
      if (view.paused || Number.isNaN(this.now)) this.now = view.now_ns * 1e-9;
      const first = view.components.find((c) => c.params.length > 0);
      if (first) this.socket.sign_of_life = [first.name + "." + first.params[0]?.name];
      this.on_view(view);
      void this.read_records(view);
    } catch {
      // the connection was lost: the socket reconnects
    } finally {
      this.asked_view = false;
      const waiters = this.view_waiters;
      this.view_waiters = [];
      if (waiters.length > 0) void this.refresh().then(() => waiters.forEach((done) => done()));
    }
  }

  /** Records change in flight only by a swap. */
  private async read_records(view: View): Promise<void> {
    const wanted = view.components.flatMap((c) =>
      c.params
        .filter(
          (p) =>
            p.kind === "record" && p.name !== "airframe" && p.name !== "origin" && p.text !== "not given",
        )
        .map((p) => ({ component: c.name, name: p.name, text: p.text, use: c.use })),
    );
    const key = JSON.stringify(wanted),
      service = this.services.get("/fulmar/record");
    if (key === this.read_for || !service) return;
    this.read_for = key;
    try {
      const answers = await Promise.all(
        wanted.map((w) => this.socket.call(service.id, { component: w.component, name: w.name })),
      );
      this.records = answers.map((a) => (a as { record?: unknown }).record ?? null);
    } catch {
      this.read_for = ""; // with the next view
    }
  }
  private read_for = "";

  /** Sends a request. Returns the answer, also without a connection. */
  async ask(service: string, request: unknown): Promise<Answer> {
    const info = this.services.get(service);
    if (!info) return { accepted: false, reason: "This flight has no service " + service + "." };
    try {
      const answer = (await this.socket.call(info.id, request)) as Answer;
      void this.refresh();
      return answer;
    } catch (fault) {
      return { accepted: false, reason: (fault as Error).message };
    }
  }

  set_parameter(component: string, name: string, text: string): Promise<Answer> {
    return this.ask("/fulmar/set_parameter", { component, name, text });
  }
  /** Frequent changes of many parameters: rejections arrive as status. */
  set_quickly(list: { name: string; value: unknown }[]): void {
    this.socket.set_parameters(list);
  }

  component(name: string): Component | undefined {
    return this.view?.components.find((c) => c.name === name);
  }
  /** The service of the first request of a message type, "PlanEdit"; "" when there is none. */
  request_of_type(type: string): string {
    for (const c of this.view?.components ?? [])
      for (const p of c.inputs)
        if (p.request && p.type.endsWith("/" + type)) return "/" + c.name + "/" + p.name;
    return "";
  }
}
