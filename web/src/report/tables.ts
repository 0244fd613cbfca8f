// SPDX-License-Identifier: BSD-3-Clause
// The tables of a report. Data of a log becomes text.
import { el } from "../dom";
import { clock, fixed, none } from "../units";
import type { Estimate, Log, PackedSeries, ReportData } from "./model";
import { verdict_of } from "./verdict";

type Cell = string | HTMLElement;

/** `words`: number of text columns; the rest are numbers. */
export function table(heads: Cell[], rows: Cell[][], words = 1, kind = ""): HTMLElement {
  const cell = (tag: "td" | "th", c: Cell, i: number, scope?: string) =>
    el(tag, { class: i >= words ? "number" : "", scope }, c);
  return el(
    "div",
    { class: "tablebox " + kind },
    el(
      "table",
      {},
      el("thead", {}, el("tr", {}, ...heads.map((c, i) => cell("th", c, i, "col")))),
      el(
        "tbody",
        {},
        ...rows.map((row) =>
          el("tr", {}, ...row.map((c, i) => (i === 0 ? cell("th", c, i, "row") : cell("td", c, i)))),
        ),
      ),
    ),
  );
}
export function section(title: string, ...children: (Node | string | null)[]): HTMLElement {
  const id = title.toLowerCase().replace(/[^a-z]+/g, "_");
  return el(
    "section",
    { id, "aria-labelledby": id + "_title" },
    el("h2", { id: id + "_title" }, title),
    ...children,
  );
}
export function sentence(words: string): HTMLElement {
  return el("p", { class: "faint" }, words);
}

const ends: [string, string][] = [
  ["_radps", "rad/s"],
  ["_degps", "°/s"],
  ["_mps2", "m/s²"],
  ["_mps", "m/s"],
  ["_deg", "°"],
  ["_ratio", ""],
  ["_frac", ""],
  ["_hz", "Hz"],
  ["_m", "m"],
  ["_s", "s"],
];
/** "roll_deg" is the roll in degrees. */
export function split_unit(key: string): [name: string, unit: string] {
  const end = ends.find(([e]) => key.endsWith(e) && key !== e);
  return [(end ? key.slice(0, -end[0].length) : key).replace(/_/g, " "), end ? end[1] : ""];
}
function figure(value: unknown, unit: string): string {
  if (typeof value === "number")
    return Number.isInteger(value) ? value + (unit ? " " + unit : "") : fixed(value, 3, unit);
  return value === null || value === undefined
    ? none
    : typeof value === "string"
      ? value
      : JSON.stringify(value);
}
function title_of(key: string): string {
  const words = key
    .replace(/_/g, " ")
    .replace(/(\berror )?\brmse\b/, "RMS error")
    .replace(/\bgnss\b/, "GNSS");
  return words.charAt(0).toUpperCase() + words.slice(1);
}

type Group = Record<string, unknown>;
const is_group = (v: unknown): v is Group => typeof v === "object" && v !== null && !Array.isArray(v);
/** The columns of the flight tests of ROSplane 2.0. */
const paper = ["north_m", "east_m", "altitude_m", "course_deg", "roll_deg", "pitch_deg", "airspeed_mps"];

/** First the figures with the columns of the paper, one row each; then the others, one table each. */
export function figure_tables(logs: Log[]): HTMLElement[] {
  const keys = [...new Set(logs.flatMap((log) => Object.keys(log.figures)))];
  if (keys.length === 0)
    return [sentence("The mission has no figures of merit (summary:), or their data was not recorded.")];
  const of = (log: Log, key: string) => log.figures[key];
  const tracks = (key: string) =>
    logs.some((log) => {
      const g = of(log, key);
      return is_group(g) && paper.filter((f) => f in g).length >= 6;
    });
  const out: HTMLElement[] = [],
    one = logs.length === 1;
  const tracking = keys
    .filter(tracks)
    .sort((a, b) => Number(b.startsWith("tracking")) - Number(a.startsWith("tracking")));
  if (tracking.length > 0)
    out.push(
      table(
        [one ? "" : "log", ...paper.map((f) => split_unit(f)[0])],
        tracking.flatMap((key) =>
          logs.map((log) => {
            const g = of(log, key);
            return [
              title_of(key) + (one ? "" : ", " + log.name),
              ...paper.map((f) => figure(is_group(g) ? g[f] : null, split_unit(f)[1])),
            ];
          }),
        ),
      ),
    );
  const single = keys.filter((key) => !logs.some((log) => is_group(of(log, key))));
  if (single.length > 0)
    out.push(
      table(
        ["", ...logs.map((log) => (one ? "" : log.name))],
        single.map((key) => [
          title_of(split_unit(key)[0]),
          ...logs.map((log) => figure(of(log, key), split_unit(key)[1])),
        ]),
      ),
    );
  for (const key of keys.filter((k) => !single.includes(k))) {
    const fields = [
      ...new Set(
        logs.flatMap((log) => {
          const g = of(log, key);
          return is_group(g) ? Object.keys(g) : [];
        }),
      ),
    ].filter((f) => !tracking.includes(key) || !paper.includes(f));
    if (fields.length === 0) continue;
    out.push(
      table(
        [title_of(key), ...logs.map((log) => (one ? "" : log.name))],
        fields.map((f) => [
          split_unit(f)[0],
          ...logs.map((log) => {
            const g = of(log, key);
            return figure(is_group(g) ? g[f] : null, split_unit(f)[1]);
          }),
        ]),
      ),
    );
  }
  return [el("div", { class: "tables" }, ...out)];
}

/** Verdict of the flight: the first line of a report. */
export function verdict_line(log: Log): HTMLElement {
  const { words, bad } = verdict_of(log);
  return el("p", { class: bad ? "verdict bad" : "verdict" }, words);
}

export function flight_table(logs: Log[]): HTMLElement {
  const said = (log: Log, key: string) => log.metadata.fulmar?.[key] ?? none;
  const rows: [string, (log: Log) => string][] = [
    ["mission", (log) => log.mission || none],
    [
      "vehicle",
      (log) => ({ sim: "simulation", fcu: "flight controller" })[said(log, "io")] ?? said(log, "io"),
    ],
    ["flight time, min:s", (log) => `${clock(log.begin_s)} to ${clock(log.end_s)}`],
    ["log", (log) => `${(log.bytes / 1e6).toFixed(1)} MB, ${log.messages} messages`],
    ["seed", (log) => said(log, "seed")],
    ["Fulmar", (log) => said(log, "version")],
    ["compiler", (log) => said(log, "toolchain")],
    [
      "command-line overrides",
      (log) =>
        Object.entries(log.metadata.overrides ?? {})
          .map(([k, v]) => `${k} ${v}`)
          .join("; ") || "none",
    ],
    ["log complete", (log) => (log.fault ? "no: " + log.fault : "yes")],
  ];
  return table(
    ["", ...logs.map((log) => log.name)],
    rows.map(([name, of]) => [name, ...logs.map(of)]),
    99,
    "facts",
  );
}

export function estimate_table(estimate: Estimate): HTMLElement {
  const unit = (s: PackedSeries) => s.unit.replace(/^deg/, "°").replace("m/s2", "m/s²");
  const percent = (x: number | undefined) => (x === undefined ? none : fixed(100 * x, 1, "%"));
  return table(
    ["", "mean", "RMS", "largest", "reported σ", "within 1 σ", "within 2 σ"],
    estimate.rows.map((s) => [
      s.words,
      ...[s.mean, s.rms, s.largest, s.claimed ?? NaN].map((v) => fixed(v, 3, unit(s))),
      percent(s.within_1),
      percent(s.within_2),
    ]),
  );
}
export function innovation_table(log: Log): HTMLElement {
  return table(
    ["", "measurements", "mean", "RMS", "within 1 σ", "within 2 σ"],
    log.innovations.map((s) => [
      s.words,
      String(s.n),
      fixed(s.mean, 3, "σ"),
      fixed(s.rms, 3, "σ"),
      fixed(100 * (s.within_1 ?? NaN), 1, "%"),
      fixed(100 * (s.within_2 ?? NaN), 1, "%"),
    ]),
  );
}

export function phase_table(log: Log): HTMLElement {
  if (log.phases.length === 0) return sentence("No phase was entered.");
  return table(
    ["phase", "transition", "from", "to", "duration"],
    log.phases.map((p) => [
      p.name,
      p.because || none,
      fixed(p.from_s, 2, "s"),
      fixed(p.to_s, 2, "s"),
      fixed(p.to_s - p.from_s, 2, "s"),
    ]),
    2,
  );
}
const signs: Record<string, string> = { warning: "⚠ ", error: "✕ ", critical: "✕✕ " };
export function told_table(log: Log): HTMLElement {
  const { rows, all } = log.told;
  if (rows.length === 0) return sentence("No guard action, swap, parameter change or warning.");
  const box = table(
    ["time", "event", "component", "message"],
    rows.map((e) => [fixed(e.t, 2, "s"), (signs[e.severity] ?? "") + e.kind, e.component || none, e.words]),
    99,
  );
  return all > rows.length ? el("div", {}, box, sentence(`The first ${rows.length} of ${all}.`)) : box;
}

export function time_tables(logs: Log[]): HTMLElement[] {
  const out: HTMLElement[] = [],
    ticks = logs.filter((log) => log.ticks);
  const us = (x: number) => fixed(x, 1, "µs"),
    ms = (x: number) => fixed(x, 3, "ms");
  if (ticks.length > 0)
    out.push(
      table(
        ["tick interval", "ticks", "mean", "99 %", "largest"],
        ticks.map((log) => {
          const t = log.ticks as NonNullable<Log["ticks"]>;
          return [
            logs.length === 1 ? "recorded" : log.name,
            String(t.n),
            ms(t.mean_ms),
            ms(t.p99_ms),
            ms(t.max_ms),
          ];
        }),
      ),
    );
  const steps = logs.find((log) => log.steps)?.steps;
  if (steps)
    out.push(
      table(
        ["step time", "mean", "median", "99 %", "largest"],
        Object.entries(steps).map(([name, s]) => [name, us(s.mean), us(s.p50), us(s.p99), us(s.max)]),
      ),
    );
  else
    out.push(
      sentence(
        "Logs contain no step times, so that equal flights have equal logs. fulmar run --report adds them.",
      ),
    );
  return out;
}

const plain = (v: unknown) =>
  typeof v === "number"
    ? String(v)
    : v === null || v === undefined
      ? none
      : typeof v === "string"
        ? v
        : JSON.stringify(v);
export function parameter_table(data: ReportData): HTMLElement {
  if (data.logs.length === 1)
    return sentence(
      "Only one log. The section Flights lists command-line overrides, the section Guards and changes lists changes in flight.",
    );
  if (data.parameters.length === 0) return sentence("All parameters are equal at the start of the flights.");
  return table(
    ["parameter at the start of the flight", ...data.logs.map((log) => log.name)],
    data.parameters.map((p) => [p.name, ...p.values.map(plain)]),
    99,
  );
}

/** File, version and hash per component; differences between the logs have a sign. */
export function plugin_table(logs: Log[]): HTMLElement {
  const components = [
    ...new Set(
      logs.flatMap((log) =>
        Object.keys(log.metadata.plugins ?? {})
          .filter((k) => k.endsWith(".file"))
          .map((k) => k.slice(0, -5)),
      ),
    ),
  ];
  if (components.length === 0) return sentence("The log names no plugins.");
  const of = (log: Log, name: string, key: string) => log.metadata.plugins?.[`${name}.${key}`] ?? "";
  return table(
    ["component", ...logs.map((log) => (logs.length === 1 ? "file, version, SHA-256" : log.name))],
    components.map((name) => {
      const differs = new Set(logs.map((log) => of(log, name, "sha256"))).size > 1;
      return [
        (differs ? "≠ " : "") + name,
        ...logs.map((log) =>
          of(log, name, "file") === ""
            ? none
            : el(
                "span",
                {},
                `${of(log, name, "file")} ${of(log, name, "version")} `,
                el("code", {}, of(log, name, "sha256")),
              ),
        ),
      ];
    }),
    99,
  );
}
