// SPDX-License-Identifier: BSD-3-Clause
// Requests to a simulation: clock, wind, faults, and requests of components.
import { el, fill, mark, say } from "../dom";
import type { Answer, Component, Flight } from "../protocol/flight";
import type { Field } from "../protocol/schema";
import { clock } from "../units";
import type { Page } from "./page";
import { ParamRow } from "./params";

const groups: [string, RegExp][] = [
  ["Wind and gusts", /^(wind|turbulence|gust|thermal|shear)/],
  ["Faults", /(fault|_works$|^motor$|^rc_link$|icing)/],
];

/** Groups of parameters by name; the first match counts. */
const parts: [string, RegExp][] = [
  ["Wind", /^wind/],
  ["Gusts", /^gust/],
  ["Turbulence and thermals", /^(turbulence|thermal|shear)/],
  ["Motor", /^(motor|engine)/],
  ["Battery", /^battery/],
  ["GNSS", /^gnss/],
  ["Airspeed", /^pitot/],
  ["Radio", /^rc/],
  ["Inertial unit", /^(imu|gyro|accel)/],
  ["Magnetometer", /^mag/],
  ["Barometer", /^baro/],
  ["Surfaces", /^(aileron|elevator|rudder|fault_speed)/],
  ["Icing", /^icing/],
  ["Other", /./],
];

export class Simulation implements Page {
  readonly name = "Simulation";
  readonly element: HTMLElement;
  private readonly box = el("div", { class: "sim" });
  private readonly said = el("p", { role: "alert", hidden: true });
  private readonly pause = el("button", { class: "main", onclick: () => void this.toggle() }, "Pause");
  private readonly ticks = el("input", {
    type: "number",
    min: "1",
    value: "40",
    "aria-label": "Ticks to step",
  });
  private readonly step = el("button", { onclick: () => void this.do_step() }, "Step");
  private readonly speed = el("div", { class: "chips", role: "group", "aria-label": "Speed" });
  private readonly time = el("b", { class: "big" });
  private readonly anew = el(
    "button",
    {
      class: "chip",
      title: "End this flight and start its mission again from the current files: click twice",
      onclick: () => void this.begin_anew(),
    },
    "New flight",
  );
  private readonly seed = el("input", {
    type: "text",
    inputMode: "numeric",
    size: 6,
    "aria-label": "Seed of the new flight",
  });
  private asked_anew = 0; // timer of the first click
  private readonly rows: ParamRow[] = [];
  private made_for = "";

  constructor(private readonly flight: Flight) {
    this.element = this.box;
  }

  private tell(answer: Answer, good: string): void {
    this.said.hidden = false;
    this.said.className = answer.accepted ? "taken" : "refusal";
    say(this.said, answer.accepted ? good : "Rejected: " + answer.reason);
  }
  private async toggle(): Promise<void> {
    const paused = this.flight.view?.paused === true;
    const answer = await this.flight.ask(paused ? "/fulmar/resume" : "/fulmar/pause", {});
    await this.flight.refresh();
    this.tell(answer, paused ? "Resumed." : "Paused. Parameters and requests can still be set.");
  }
  private async do_step(): Promise<void> {
    const ticks = this.ticks.value.trim();
    const answer = await this.flight.ask("/fulmar/step", { ticks });
    await this.flight.refresh();
    this.tell(answer, `Stepped ${ticks} ticks.`);
  }
  private async set_speed(speed: string): Promise<void> {
    this.tell(
      await this.flight.ask("/fulmar/speed", { speed }),
      `Speed: ${speed === "real" ? "real time" : speed + " times real time"}.`,
    );
  }

  /** Takes two clicks. The page reloads when the new flight starts. */
  private async begin_anew(): Promise<void> {
    const sure = this.asked_anew !== 0;
    clearTimeout(this.asked_anew);
    this.ask_anew(!sure);
    if (sure)
      this.tell(
        await this.flight.ask("/fulmar/restart", { seed: this.seed.value.trim() }),
        "A new flight starts.",
      );
  }
  private ask_anew(on: boolean): void {
    this.asked_anew = on ? window.setTimeout(() => this.ask_anew(false), 3000) : 0;
    mark(this.anew, "asked", on);
    say(this.anew, on ? "end this flight?" : "New flight");
  }

  private make(): void {
    const view = this.flight.view;
    if (!view) return;
    if (view.io !== "sim") {
      fill(
        this.box,
        el(
          "section",
          {},
          el("h2", {}, "Simulation"),
          el("p", {}, "This is a real aircraft: pause, speed and faults are not available."),
        ),
      );
      return;
    }
    fill(
      this.speed,
      ...["0.1", "0.5", "real", "2", "5", "10"].map((s) => {
        const chip = el(
          "button",
          { class: "chip", onclick: () => void this.set_speed(s) },
          s === "real" ? "real time" : s + " ×",
        );
        chip.dataset.speed = s === "real" ? "1" : s;
        return chip;
      }),
    );
    this.seed.value = view.seed;
    const vehicle = view.components.find((c) => c.role.split(", ").includes("vehicle") && c.active);
    this.rows.length = this.folds.length = 0;
    const sections = vehicle ? groups.map(([name, which]) => this.section(vehicle, name, which)) : [];
    const requests = view.components.flatMap((c) =>
      c.inputs.filter((p) => p.request && !p.type.endsWith("/PlanEdit")).map((p) => `/${c.name}/${p.name}`),
    );
    fill(
      this.box,
      el(
        "div",
        { class: "column" },
        el(
          "section",
          {},
          el("h2", {}, "Clock"),
          this.time,
          el("div", { class: "row" }, this.pause, this.step, this.ticks, " ticks"),
          this.speed,
          el("div", { class: "row" }, this.anew, el("label", {}, "seed ", this.seed)),
          this.said,
        ),
        ...requests.map((r) => this.request(r)),
      ),
      ...sections,
    );
  }

  private section(c: Component, name: string, which: RegExp): HTMLElement {
    const rows = c.params
      .filter((p) => p.live && which.test(p.name))
      .map((p) => new ParamRow(this.flight, c.name, p));
    this.rows.push(...rows);
    return el(
      "section",
      { class: "params" },
      el("h2", {}, `${name} (${c.name})`),
      el("div", { class: "scroll rows" }, ...this.folded(rows, name === "Faults")),
    );
  }

  private folded(rows: ParamRow[], fault: boolean): HTMLElement[] {
    const folds = parts
      .map(([name, which]) => {
        const mine = rows.filter((r) => parts.find(([, first]) => first.test(r.name))?.[1] === which);
        const summary = el("summary", {}, name);
        return {
          name,
          fault,
          rows: mine,
          summary,
          element: el("details", { class: "fold" }, summary, ...mine.map((r) => r.element)),
        };
      })
      .filter((f) => f.rows.length > 0);
    for (const f of folds) f.element.open = f.name === "Wind";
    this.folds.push(...folds);
    return folds.map((f) => f.element);
  }
  private readonly folds: {
    name: string;
    fault: boolean;
    rows: ParamRow[];
    summary: HTMLElement;
    element: HTMLElement;
  }[] = [];

  /** A form with the fields of the request message. */
  private request(service: string): HTMLElement {
    const said = el("p", { role: "alert", hidden: true });
    const inputs: [Field, HTMLInputElement | HTMLSelectElement][] = [];
    const fields = this.flight
      .fields_of_request(service)
      .filter((f) => f.fields.length === 0 && f.count === 0);
    const labels = fields.map((f) => {
      const input =
        f.labels.length > 0
          ? el("select", {}, ...f.labels.map((l) => el("option", { value: l }, l)))
          : f.type === "bool"
            ? el("input", { type: "checkbox" })
            : el("input", { type: "text", size: 6, value: "0" });
      inputs.push([f, input]);
      const name = f.name.replace(/_(ratio|s|m|mps|rad)$/, "").replace(/_/g, " ");
      return el("label", {}, name + " ", input, f.unit ? " " + f.unit : "");
    });
    const ask = async () => {
      const message: Record<string, unknown> = {};
      for (const [f, input] of inputs)
        message[f.name] =
          f.type === "bool"
            ? (input as HTMLInputElement).checked
            : f.labels.length > 0
              ? input.value
              : Number(input.value);
      const answer = await this.flight.ask(service, message);
      said.hidden = false;
      said.className = answer.accepted ? "taken" : "refusal";
      say(said, answer.accepted ? "Accepted." : "Rejected: " + answer.reason);
    };
    const name = service.slice(1).replace("/", ".");
    const form = el("form", { class: "row" }, ...labels, el("button", { type: "submit" }, "Send"));
    form.addEventListener("submit", (e) => {
      e.preventDefault();
      void ask();
    });
    return el("section", {}, el("h2", {}, `Request ${name}`), form, said);
  }

  update(): void {
    const view = this.flight.view;
    if (!view) return;
    const made_for = view.io + view.components.map((c) => c.name + c.use).join();
    if (made_for !== this.made_for) {
      this.made_for = made_for;
      this.make();
    }
    say(this.time, clock(view.paused ? view.now_ns * 1e-9 : this.flight.now));
    say(this.pause, view.paused ? "Resume" : "Pause");
    this.step.disabled = !view.paused;
    for (const chip of this.speed.querySelectorAll("button"))
      mark(chip, "on", Number(chip.dataset.speed) === view.speed && !view.paused);
    const vehicle = view.components.find((c) => c.name === this.rows[0]?.component);
    for (const row of this.rows) {
      const p = vehicle?.params.find((q) => q.name === row.name);
      if (p) row.show(p);
    }
    for (const f of this.folds) {
      const changed = f.rows.filter((r) => r.changed).map((r) => r.summary.replace(/^\w+\./, ""));
      say(f.summary, f.name + (changed.length > 0 ? " " + (f.fault ? "✕ " : "") + changed.join("; ") : ""));
      mark(f.summary, f.fault ? "bad" : "changed", changed.length > 0);
    }
  }
}
