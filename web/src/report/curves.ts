// SPDX-License-Identifier: BSD-3-Clause
// The charts of a report: commanded and actual values, errors of the estimate, innovations.
import { value_at } from "../flight/step";
import { names_of } from "../names";
import type { Recording } from "../recorded";
import type { Series } from "../source";
import { degrees, fixed } from "../units";
import { type Curve, LineChart, type Phase } from "./chart";
import { type PackedSeries, unpack_columns } from "./model";

/** Colours of the logs; a single log uses two colours. */
export const log_colours = ["log1", "log2", "log3", "log4", "log5", "log6"];
const bound_dash = [4, 4],
  asked_dash = [8, 4];

function scaled(s: Series, scale: number): Series {
  return scale === 1 ? s : { t: s.t, v: s.v.map((v) => v * scale) };
}
/** The first of several logs are drawn below the others and wider, so that equal curves stay visible. */
export function width_of(log: number, logs: number): number {
  return 1.4 + 1.1 * (logs - 1 - log);
}
function whole_turn(deg: number): number {
  return ((deg % 360) + 360) % 360;
}

interface Channel {
  title: string;
  unit: string;
  least: number;
  scale: number;
  turn: number;
  asked: (n: ReturnType<typeof names_of>) => string;
  asked_field: string;
  field: string;
  valid: string;
}
const channels: Channel[] = [
  {
    title: "Height above the origin",
    unit: "m",
    least: 5,
    scale: 1,
    turn: 0,
    asked: (n) => n.command,
    asked_field: "height_m",
    field: "height_m",
    valid: "height_valid",
  },
  {
    title: "Airspeed",
    unit: "m/s",
    least: 3,
    scale: 1,
    turn: 0,
    asked: (n) => n.command,
    asked_field: "airspeed_mps",
    field: "airspeed_mps",
    valid: "airspeed_valid",
  },
  {
    title: "Course over ground",
    unit: "°",
    least: 10,
    scale: degrees,
    turn: 360,
    asked: (n) => n.command,
    asked_field: "course_rad",
    field: "course_rad",
    valid: "velocity_valid",
  },
  {
    title: "Roll",
    unit: "°",
    least: 10,
    scale: degrees,
    turn: 0,
    asked: (n) => n.attitude,
    asked_field: "roll_rad",
    field: "roll_rad",
    valid: "attitude_valid",
  },
  {
    title: "Pitch",
    unit: "°",
    least: 10,
    scale: degrees,
    turn: 0,
    asked: (n) => n.attitude,
    asked_field: "pitch_rad",
    field: "pitch_rad",
    valid: "attitude_valid",
  },
];

/** The estimate where it is valid. */
function flown(source: Recording, topic: string, c: Channel): Series {
  const all = source.whole(topic, c.field),
    valid = source.whole(topic, c.valid);
  const known = valid.t.length === all.t.length;
  return {
    t: all.t,
    v: all.v.map((v, i) => (known && !valid.v[i] ? NaN : c.turn > 0 ? whole_turn(v * c.scale) : v * c.scale)),
  };
}

/** A chart per channel. */
export function channel_charts(sources: Recording[], phases: Phase[]): LineChart[] {
  const one = sources.length === 1;
  return channels.map((c) => {
    const curves: Curve[] = [];
    sources.forEach((source, i) => {
      const n = names_of(source),
        who = one ? "" : source.log.name + ", ",
        colour = log_colours[i] as string;
      const got = flown(source, n.state, c),
        asked = source.whole(c.asked(n), c.asked_field);
      // at the times of the actual values, so that the legend shows both at one time
      const begin = asked.t[0] ?? Infinity;
      const set = { t: got.t, v: got.t.map((t) => (t < begin ? NaN : value_at(asked, t))) };
      if (c.turn > 0) set.v = set.v.map((v) => whole_turn(v * c.scale));
      else set.v = set.v.map((v) => v * c.scale);
      if (asked.t.length > 0)
        curves.push({
          name: who + "commanded",
          series: set,
          colour: one ? "line2" : colour,
          dash: asked_dash,
          width: 1.4,
        });
      if (got.t.length > 0)
        curves.push({
          name: who + "actual",
          series: got,
          colour: one ? "line1" : colour,
          width: width_of(i, sources.length),
        });
    });
    return new LineChart({ title: c.title, unit: c.unit, least: c.least }, curves, one ? phases : [], c.turn);
  });
}

export function surface_charts(sources: Recording[], phases: Phase[]): LineChart[] {
  const one = sources.length === 1;
  const chart = (title: string, unit: string, least: number, fields: [string, string][], scale: number) => {
    const curves = sources.flatMap((source, i) => {
      const topic = names_of(source).actuators;
      return fields.map(([field, name], k) => ({
        name: one ? name : source.log.name,
        series: scaled(source.whole(topic, field), scale),
        colour: log_colours[one ? k : i] as string,
        width: one ? 1.4 : width_of(i, sources.length),
        dash: k === 0 ? undefined : k === 1 ? asked_dash : bound_dash,
      }));
    });
    return new LineChart({ title, unit, least }, curves, one ? phases : []);
  };
  const surfaces: [string, string][] = [
    ["aileron_rad", "aileron"],
    ["elevator_rad", "elevator"],
    ["rudder_rad", "rudder"],
  ];
  return [
    ...(one
      ? [chart("Surfaces", "°", 5, surfaces, degrees)]
      : surfaces.map(([field, name]) =>
          chart(name.charAt(0).toUpperCase() + name.slice(1), "°", 5, [[field, name]], degrees),
        )),
    chart("Throttle", "%", 20, [["throttle_frac", "throttle"]], 100),
  ];
}

export interface Judged {
  name: string; // of the log, and of the estimate where there are several; "" when it is the only one
  series: PackedSeries;
}
const shown = (unit: string) => unit.replace(/^deg/, "°").replace("m/s2", "m/s²");

/** One quantity, of one or several estimates, with bounds of three standard deviations. */
export async function error_chart(
  title: string,
  judged: Judged[],
  phases: Phase[],
  claims_one = false,
): Promise<LineChart> {
  const one = judged.length === 1,
    curves: Curve[] = [];
  let widest = 0; // of the usual reported standard deviation: at first it may be a multiple
  for (const [i, { name, series }] of judged.entries()) {
    const { t, values } = await unpack_columns(series.data, series.rows, series.columns);
    const who = one ? "" : name + ", ",
      colour = one ? "line1" : (log_colours[i] as string);
    curves.push({
      name: who + (claims_one ? "innovation" : "error"),
      series: { t, v: [...(values[0] ?? [])] },
      colour,
      width: one ? 1.3 : width_of(i, judged.length),
    });
    const claimed = values[1];
    if (!claimed || series.claimed === undefined || i > 0) continue; // bounds of the first estimate only
    const bound = one ? "line2" : colour;
    widest = Math.max(widest, 3 * usual(claimed));
    curves.push({
      name: who + "+3 σ",
      series: { t, v: [...claimed].map((v) => 3 * v) },
      colour: bound,
      dash: bound_dash,
      width: 1.2,
      may_leave: true,
    });
    curves.push({
      name: who + "−3 σ",
      series: { t, v: [...claimed].map((v) => -3 * v) },
      colour: bound,
      dash: bound_dash,
      width: 1.2,
      may_leave: true,
    });
  }
  if (claims_one) {
    const times = curves
      .flatMap((c) => [c.series.t[0] ?? NaN, c.series.t[c.series.t.length - 1] ?? NaN])
      .filter(Number.isFinite);
    const ends = [Math.min(...times), Math.max(...times)];
    const bound = (name: string, v: number): Curve => ({
      name,
      series: dense(ends[0] as number, ends[1] as number, v),
      colour: "line2",
      dash: bound_dash,
      width: 1.2,
    });
    if (times.length > 0) curves.push(bound("+3 σ", 3), bound("−3 σ", -3));
  }
  const unit = claims_one ? "σ" : shown(judged[0]?.series.unit ?? "");
  const note = one && judged[0] ? note_of(judged[0].series, unit) : "";
  return new LineChart(
    { title, unit, least: claims_one ? 8 : Math.max(1e-6, 2.2 * widest), around_zero: true, note },
    curves,
    phases,
  );
}
/** 90th percentile. */
function usual(v: Float32Array): number {
  const sorted = [...v].filter(Number.isFinite).sort((a, b) => a - b);
  return sorted[Math.floor(0.9 * (sorted.length - 1))] ?? 0;
}
/** Points close enough that no gap is drawn. */
function dense(from: number, to: number, v: number): Series {
  const n = Math.max(2, Math.ceil(to - from) + 1),
    t = Array.from({ length: n }, (_, i) => from + ((to - from) * i) / (n - 1));
  return { t, v: t.map(() => v) };
}
function note_of(s: PackedSeries, unit: string): string {
  const claim = s.claimed === undefined ? "" : `, reported σ ${fixed(s.claimed, 3, unit)}`;
  return `RMS ${fixed(s.rms, 3, unit)}${unit === "σ" ? "" : claim}`;
}
