// SPDX-License-Identifier: BSD-3-Clause
// Components, ports and connections as a drawing and in figures: rates, ages, step times, guards. Components can be swapped here if
// the host allows it.
import { el, fill, mark, say } from "../dom";
import { Rates } from "../flight/rates";
import type { Component, Flight, Port, View } from "../protocol/flight";
import { digits, fixed, none } from "../units";
import type { Page } from "./page";
import { type Figures, Wiring } from "./wiring";

const count_ms = 1000,
  draw_ms = 200,
  steps_over_s = 4,
  listened_ms = 3000;
const short = (type: string) => type.slice(type.lastIndexOf("/") + 1) || "probe";
const rate_of = (hz: number | undefined) =>
  hz === undefined ? none : digits(Math.round(hz * 10) / 10) + " Hz";
const age_of = (s: number, listened = true) =>
  !listened ? none : Number.isFinite(s) ? (s < 10 ? fixed(s * 1000, 0, "ms") : fixed(s, 0, "s")) : "never";

interface Row {
  row: HTMLElement;
  state: HTMLElement;
  rate: HTMLElement;
  mean: HTMLElement;
  most: HTMLElement;
}

export class Wires implements Page {
  readonly name = "Wires";
  readonly element: HTMLElement;
  private readonly body = el("tbody");
  private readonly details = el("div");
  private readonly wiring = new Wiring((name) => this.choose(name));
  private readonly said = el("p", { role: "alert", hidden: true });
  private readonly reset = el("button", { onclick: () => void this.reset_guards() }, "Reset guards");
  private rows = new Map<string, Row>();
  private ports: { topic: string; rate: HTMLElement; age: HTMLElement }[] = [];
  private listed = "";
  private chosen = "";
  private counted_ms = 0;
  private readonly rates = new Rates();

  constructor(private readonly flight: Flight) {
    const head = [
      "component",
      "role",
      "plugin",
      "state",
      "runs as",
      "steps per second",
      "step, mean",
      "step, longest",
      "budget",
    ];
    this.element = el(
      "div",
      { class: "wires" },
      el("section", {}, this.wiring.element),
      el("section", {}, this.details, this.said),
      el(
        "section",
        {},
        el("div", { class: "row" }, el("h2", {}, "Components, in the order of the mission"), this.reset),
        el(
          "table",
          { class: "listed" },
          el("thead", {}, el("tr", {}, ...head.map((h, i) => el("th", { class: i > 4 ? "right" : "" }, h)))),
          this.body,
        ),
      ),
    );
  }

  show(): void {
    this.counted_ms = this.since_ms = 0;
    this.rates.begin();
    this.steps = new Map();
    this.steps_s = -1e9;
    this.flight.want_all(true);
  }
  hide(): void {
    this.flight.want_all(false);
  }

  private async reset_guards(): Promise<void> {
    this.tell(
      await this.flight.ask("/fulmar/reset_guards", {}),
      "Guards reset: a stopped component can become active again.",
    );
  }
  private tell(answer: { accepted: boolean; reason: string }, good: string): void {
    this.said.hidden = false;
    this.said.className = answer.accepted ? "taken" : "refusal";
    say(this.said, answer.accepted ? good : "Rejected: " + answer.reason);
  }

  private list(view: View): void {
    this.rows = new Map();
    fill(
      this.body,
      ...view.components.map((c) => {
        const cell = () => el("td", { class: "number" });
        const r: Row = { row: el("tr"), state: el("td"), rate: cell(), mean: cell(), most: cell() };
        this.rows.set(c.name, r);
        const name = el("button", { class: "link", onclick: () => this.choose(c.name) }, c.name);
        r.row.append(
          el("th", { scope: "row" }, name),
          el("td", {}, c.role || none),
          el("td", {}, c.use),
          r.state,
          el("td", {}, c.run),
          r.rate,
          r.mean,
          r.most,
          el("td", { class: "number" }, c.budget_us > 0 ? fixed(c.budget_us, 0, "µs") : "none"),
        );
        return r.row;
      }),
    );
    this.wiring.draw(view);
    this.choose(
      view.components.some((c) => c.name === this.chosen) ? this.chosen : (view.components[0]?.name ?? ""),
    );
  }

  private choose(name: string): void {
    this.chosen = name;
    const c = this.flight.component(name);
    if (!c) return;
    for (const [other, r] of this.rows) mark(r.row, "chosen", other === name);
    this.ports = [];
    fill(
      this.details,
      el("h2", {}, `${c.name}: ${c.doc}`),
      c.swapped ? el("p", { class: "faint" }, c.swapped) : "",
      this.swap_form(c),
      el("div", { class: "twotables" }, this.inputs(c), this.outputs(c)),
    );
    this.show_rates();
    if (this.flight.view) this.wiring.update(this.flight.view, name, this.figures);
  }
  private port_row(port: Port, words: string, topic: string): HTMLElement {
    const rate = el("td", { class: "number" }),
      age = el("td", { class: "number" });
    this.ports.push({ topic, rate, age });
    return el(
      "tr",
      {},
      el("th", { scope: "row" }, port.name),
      el("td", {}, short(port.type)),
      el("td", {}, words),
      rate,
      age,
    );
  }
  private inputs(c: Component): HTMLElement {
    const rows = c.inputs.map((p) => {
      const topic = p.topic ?? (p.source ? this.topic_of(p.source) : "");
      const words = p.request
        ? "requests, on " + p.topic
        : p.imported
          ? "imported, from " + p.topic
          : p.source
            ? "← " + p.source
            : "not connected";
      return this.port_row(p, words, topic);
    });
    return this.table("Inputs", rows);
  }
  private outputs(c: Component): HTMLElement {
    const readers = (port: string) => {
      const names: string[] = [];
      const owners = [c.name, ...c.role.split(", ")].map((owner) => `${owner}.${port}`);
      for (const other of this.flight.view?.components ?? [])
        for (const p of other.inputs)
          if (p.source && owners.includes(p.source)) names.push(`${other.name}.${p.name}`);
      return names.length > 0 ? "→ " + names.join(", ") : "not connected";
    };
    return this.table(
      "Outputs",
      c.outputs.map((p) =>
        this.port_row(p, p.type ? readers(p.name) : "log and live view only", p.topic ?? ""),
      ),
    );
  }
  private table(name: string, rows: HTMLElement[]): HTMLElement {
    return el(
      "table",
      {},
      el(
        "thead",
        {},
        el(
          "tr",
          {},
          ...[name, "message", "connection", "rate", "age"].map((h, i) =>
            el("th", { class: i > 2 ? "right" : "" }, h),
          ),
        ),
      ),
      el("tbody", {}, ...rows),
    );
  }
  /** "nav.state" -> "/nav/state": topic of a role or of a component. */
  private topic_of(source: string): string {
    const [owner = "", port = ""] = source.split(/\.(.*)/);
    for (const c of this.flight.view?.components ?? [])
      if (c.name === owner || c.role.split(", ").includes(owner))
        for (const p of c.outputs) if (p.name === port && p.topic) return p.topic;
    return "";
  }

  private swap_form(c: Component): HTMLElement {
    const input = el("input", {
      type: "text",
      size: 44,
      placeholder: "build/my_law.so, or control_tecs/Outer",
      "aria-label": `Plugin in place of ${c.name}`,
    });
    const swap = async () => {
      const answer = await this.flight.ask("/fulmar/swap", { component: c.name, file: input.value.trim() });
      this.tell(answer, `${c.name} swapped.`);
      this.listed = "";
    };
    const form = el(
      "form",
      { class: "row swap" },
      el("label", {}, "replace by ", input),
      el("button", { type: "submit" }, "Swap"),
    );
    form.addEventListener("submit", (e) => {
      e.preventDefault();
      void swap();
    });
    return form;
  }

  update(now_ms: number): void {
    const view = this.flight.view;
    if (!view) return;
    const listed = JSON.stringify(view.components.map((c) => [c.name, c.use]));
    if (listed !== this.listed) {
      this.listed = listed;
      this.list(view);
    }
    for (const c of view.components) {
      const r = this.rows.get(c.name);
      if (!r) continue;
      say(r.state, c.stopped ? "✕ stopped by a guard" : c.active ? "✓ active" : "inactive");
      r.state.className = c.stopped ? "bad" : c.active ? "good" : "faint";
      say(r.mean, c.steps > 0 ? fixed(c.step_us, 1, "µs") : none);
      say(r.most, c.steps > 0 ? fixed(c.step_max_us, 0, "µs") : none);
      mark(r.most, "bad", c.budget_us > 0 && c.step_max_us > c.budget_us);
    }
    mark(
      this.reset,
      "main",
      view.components.some((c) => c.stopped),
    );
    if (now_ms - this.counted_ms > count_ms) this.count(view, now_ms);
    if (now_ms - this.drawn_ms < draw_ms) return;
    this.drawn_ms = now_ms;
    this.wiring.update(view, this.chosen, this.figures);
  }
  private drawn_ms = 0;
  private readonly figures: Figures = {
    steps: (c) =>
      c.steps === 0
        ? none
        : [this.step_rates.get(c.name), fixed(c.step_us, 1, "µs")].filter(Boolean).join(" "),
    wire: (source) => {
      const topic = this.topic_of(source),
        age = topic ? this.flight.age(topic) : Infinity;
      return {
        rate: this.rate(topic),
        age: age_of(age, this.listened),
        silent: this.listened && !Number.isFinite(age),
      };
    },
  };

  /** Whether the subscription is old enough for a rate, or for "never". */
  private get listened(): boolean {
    return this.since_ms > 0 && performance.now() - this.since_ms > listened_ms;
  }
  private since_ms = 0;
  private rate(topic: string): string {
    const hz = this.rates.of(topic);
    return rate_of(hz === 0 && !this.listened ? undefined : hz);
  }

  private count(view: View, now_ms: number): void {
    this.counted_ms = now_ms;
    this.flight.want_all(true); // also topics advertised after the view was opened
    const topics = this.flight.topics();
    if (topics.length > 0)
      this.rates.count(
        this.flight.now,
        topics.map((t) => [t.name, this.flight.count(t.name)]),
      );
    if (topics.length > 0 && this.since_ms === 0) this.since_ms = performance.now();
    // The host updates the step counts at intervals: rate over a longer time.
    const since = view.now_ns * 1e-9 - this.steps_s,
      again = since < 0 || since > steps_over_s;
    for (const c of view.components) {
      const before = this.steps.get(c.name);
      if (before !== undefined && since > 1) {
        this.step_rates.set(c.name, rate_of((c.steps - before) / since));
        say(this.rows.get(c.name)?.rate as HTMLElement, this.step_rates.get(c.name) ?? none);
      }
      if (again || before === undefined) this.steps.set(c.name, c.steps);
    }
    if (again) this.steps_s = view.now_ns * 1e-9;
    this.show_rates();
  }
  private steps = new Map<string, number>();
  private step_rates = new Map<string, string>();
  private steps_s = 0; // flight time of the counts

  private show_rates(): void {
    for (const p of this.ports) {
      say(p.rate, p.topic ? this.rate(p.topic) : none);
      say(p.age, p.topic ? age_of(this.flight.age(p.topic), this.listened) : none);
    }
  }
}
