// SPDX-License-Identifier: BSD-3-Clause
// State of the estimator, its sensors and the links.
import { el, fill } from "../dom";
import { type Names, state_of } from "../names";
import { type Message, number_at } from "../protocol/schema";
import type { Source } from "../source";
import { fixed } from "../units";

const sensors: [string, string][] = [
  ["gyro", "gyroscopes"],
  ["accel", "accelerometers"],
  ["gnss_position", "GNSS position"],
  ["gnss_height", "GNSS height"],
  ["gnss_velocity", "GNSS velocity"],
  ["mag", "magnetometer"],
  ["baro", "barometer"],
  ["pitot", "airspeed"],
];
type Row = [name: string, words: string, good: boolean | null];

export class HealthPanel {
  private readonly table = el("div", { class: "pairs" });
  readonly element = el("section", {}, el("h2", {}, "Estimator, sensors, links"), this.table);
  private shown = "";
  constructor(private readonly source: Source) {}

  update(names: Names): void {
    const rows = [...this.estimator(names), ...this.sensors(names), ...this.vehicle(names)];
    const now = JSON.stringify(rows);
    if (now === this.shown) return;
    this.shown = now;
    fill(
      this.table,
      ...rows.flatMap(([name, words, good]) => [
        el("span", {}, name),
        el(
          "b",
          { class: good === null ? "faint" : good ? "good" : "bad" },
          (good === null ? "" : good ? "✓ " : "✕ ") + words,
        ),
      ]),
    );
  }

  private estimator(names: Names): Row[] {
    const message = this.source.latest(names.state),
      state = state_of(message);
    if (!state || !message) return [["state", "no estimate", false]];
    const lacks = Object.entries(state.valid)
      .filter(([, valid]) => !valid)
      .map(([name]) => name);
    const std = (path: string) => number_at(message, path) ?? NaN;
    const position = Math.hypot(std("position_std_m.north"), std("position_std_m.east"));
    return [
      ["state", lacks.length === 0 ? "valid" : "invalid: " + lacks.join(", "), lacks.length === 0],
      ["position, 1 σ", position < 1e6 ? fixed(position, 1, "m") : "unknown", position < 1e6 ? null : false],
    ];
  }
  private sensors(names: Names): Row[] {
    const health = this.source.latest(names.health);
    if (!health) return [];
    return sensors
      .filter(([field]) => field in health)
      .map(([field, name]) => {
        const state = String((health[field] as Message).state);
        return [name, state, state === "never" ? null : state === "ok"];
      });
  }
  private vehicle(names: Names): Row[] {
    const rows: Row[] = [];
    const gnss = this.source.latest(names.gnss),
      rc = this.source.latest(names.rc),
      status = this.source.latest(names.status);
    if (gnss)
      rows.push([
        "satellites",
        `${gnss.satellites}, ${String(gnss.fix).replace(/_/g, " ")}`,
        gnss.fix !== "none",
      ]);
    if (rc) rows.push(["radio link", rc.link === true ? "connected" : "not connected", rc.link === true]);
    if (!status) return rows;
    rows.push(["vehicle", String(status.health), status.health === "ok"]);
    const who =
      status.crashed === true
        ? "crashed"
        : status.failsafe === true
          ? "failsafe"
          : status.override === true
            ? "pilot"
            : status.in_control === true
              ? "autopilot"
              : "none";
    rows.push([
      "in control",
      who,
      who === "autopilot" ? true : who === "pilot" || who === "none" ? null : false,
    ]);
    return rows;
  }
}
