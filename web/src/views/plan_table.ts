// SPDX-License-Identifier: BSD-3-Clause
// The plan as a table for editing without a mouse. The reason of a rejection is shown below its row.
import { el, fill, mark } from "../dom";
import type { Plan, Waypoint } from "../flight/route";
import { degrees, plain } from "../units";

interface Hands {
  change(plan: Plan): void;
  choose(waypoint: number): void;
  fly_to(waypoint: number): void;
}
type Column = {
  name: string;
  unit: string;
  get(w: Waypoint): string;
  set(w: Waypoint, value: number | null): void;
};

const moved = (w: Waypoint, part: Partial<Waypoint>) => Object.assign(w, part, { geodetic: null });
const columns: Column[] = [
  { name: "north", unit: "m", get: (w) => plain(w.north), set: (w, v) => moved(w, { north: v ?? 0 }) },
  { name: "east", unit: "m", get: (w) => plain(w.east), set: (w, v) => moved(w, { east: v ?? 0 }) },
  { name: "up", unit: "m", get: (w) => plain(w.up), set: (w, v) => moved(w, { up: v ?? 0 }) },
  {
    name: "course",
    unit: "°",
    get: (w) => (w.course === null ? "" : plain(w.course * degrees)),
    set: (w, v) => (w.course = v === null ? null : v / degrees),
  },
  {
    name: "airspeed",
    unit: "m/s",
    get: (w) => (w.airspeed > 0 ? plain(w.airspeed) : ""),
    set: (w, v) => (w.airspeed = v ?? 0),
  },
];

export class PlanTable {
  private readonly body = el("tbody");
  private readonly settings = el("div", { class: "row settings" });
  readonly element = el(
    "section",
    { class: "grow" },
    this.settings,
    el(
      "div",
      { class: "scroll" },
      el(
        "table",
        { class: "waypoints" },
        el(
          "thead",
          {},
          el(
            "tr",
            {},
            el("th", {}, "#"),
            ...columns.map((c) => el("th", {}, c.name, el("small", {}, c.unit))),
            el("th", {}, ""),
          ),
        ),
        this.body,
      ),
    ),
  );
  private plan: Plan | null = null;
  private shown = "";
  private refused = -1;
  private reason = "";

  constructor(private readonly hands: Hands) {}

  forget(): void {
    this.shown = "";
    this.refused = -1;
  }
  refuse(waypoint: number, reason: string): void {
    this.refused = waypoint;
    this.reason = reason;
    this.shown = "";
  }

  update(plan: Plan | null, chosen: number, item: number): void {
    if (plan !== this.plan && plan) {
      const now = JSON.stringify(plan) + this.refused;
      this.plan = plan;
      if (now !== this.shown) this.write(plan);
      this.shown = now;
    } else if (plan && this.shown === "") {
      this.write(plan);
      this.shown = JSON.stringify(plan) + this.refused;
    }
    for (const row of this.body.querySelectorAll("tr")) {
      mark(row, "chosen", row.dataset.at === String(chosen));
      mark(row, "item", row.dataset.at === String(item));
    }
  }

  private edit(work: (plan: Plan) => void): void {
    if (!this.plan) return;
    const plan = { ...this.plan, waypoints: this.plan.waypoints.map((w) => ({ ...w })) };
    work(plan);
    this.refused = -1;
    this.hands.change(plan);
  }

  private number(
    label: string,
    value: string,
    empty: boolean,
    taken: (value: number | null) => void,
  ): HTMLInputElement {
    const input = el("input", { type: "number", step: "any", value, "aria-label": label });
    input.addEventListener("change", () => {
      const nothing = input.value.trim() === "";
      if (!nothing && Number.isFinite(input.valueAsNumber)) taken(input.valueAsNumber);
      else if (nothing && empty) taken(null);
      else input.value = value;
    });
    return input;
  }

  private write(plan: Plan): void {
    const focus = document.activeElement?.getAttribute("aria-label");
    const end = el(
      "select",
      {
        "aria-label": "End of the plan",
        onchange: () => this.edit((p) => (p.end = end.value === "orbit" ? "orbit" : "circuit")),
      },
      el("option", { value: "circuit" }, "circuit"),
      el("option", { value: "orbit" }, "orbit"),
    );
    end.value = plan.end;
    fill(
      this.settings,
      el("label", {}, "end ", end),
      el(
        "label",
        {},
        "turn radius ",
        this.number("Turn radius, m", plain(plan.radius), false, (v) =>
          this.edit((p) => (p.radius = v ?? p.radius)),
        ),
        " m",
      ),
      el(
        "label",
        {},
        "airspeed ",
        this.number("Airspeed, m/s", plain(plan.airspeed), false, (v) =>
          this.edit((p) => (p.airspeed = v ?? p.airspeed)),
        ),
        " m/s",
      ),
    );
    const rows: HTMLElement[] = [];
    plan.waypoints.forEach((w, i) => {
      rows.push(this.row(w, i, plan.waypoints.length));
      if (i === this.refused)
        rows.push(
          el(
            "tr",
            {},
            el(
              "td",
              { colSpan: columns.length + 2 },
              el("p", { class: "refusal", role: "alert" }, "Rejected: " + this.reason),
            ),
          ),
        );
    });
    fill(this.body, ...rows);
    if (focus)
      [...this.element.querySelectorAll<HTMLElement>("[aria-label]")]
        .find((e) => e.getAttribute("aria-label") === focus)
        ?.focus();
  }

  private row(w: Waypoint, i: number, count: number): HTMLElement {
    const button = (words: string, label: string, onclick: () => void, disabled = false) =>
      el(
        "button",
        { class: "small", "aria-label": `${label}, waypoint ${i}`, title: label, onclick, disabled },
        words,
      );
    const move = (to: number) =>
      this.edit((p) => {
        const [taken] = p.waypoints.splice(i, 1);
        if (taken) p.waypoints.splice(to, 0, taken);
        this.hands.choose(to);
      });
    const row = el(
      "tr",
      { onfocusin: () => this.hands.choose(i), onclick: () => this.hands.choose(i) },
      el("th", { scope: "row" }, String(i)),
      ...columns.map((c) =>
        el(
          "td",
          { "data-label": `${c.name}, ${c.unit}` },
          this.number(
            `${c.name} of waypoint ${i}, ${c.unit}`,
            c.get(w),
            c.name === "course" || c.name === "airspeed",
            (v) => this.edit((p) => c.set(p.waypoints[i] as Waypoint, v)),
          ),
        ),
      ),
      el(
        "td",
        { class: "keys" },
        button("↑", "Earlier", () => move(i - 1), i === 0),
        button("↓", "Later", () => move(i + 1), i + 1 === count),
        button("✈", "Fly there now", () => this.hands.fly_to(i)),
        button("✕", "Remove", () => {
          this.hands.choose(-1);
          this.edit((p) => p.waypoints.splice(i, 1));
        }),
      ),
    );
    row.dataset.at = String(i);
    return row;
  }
}
