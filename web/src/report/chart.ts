// SPDX-License-Identifier: BSD-3-Clause
// Curves over flight time, on screen or paper. All charts of a report show the same time span.
import uPlot from "uplot";
import { colours, el } from "../dom";
import type { Series } from "../source";
import { digits, fixed, with_unit } from "../units";

export interface Curve {
  name: string;
  series: Series;
  colour: string; // of the style sheet
  dash?: number[];
  width?: number;
  may_leave?: boolean; // the axis does not grow for it
}
export interface ChartText {
  title: string;
  unit: string;
  least: number; // smallest axis range, in the unit
  around_zero?: boolean;
  note?: string;
}
export interface Phase {
  name: string;
  from_s: number;
  to_s: number;
}

const longest_gap_s = 3,
  height_px = 200;
const sync = uPlot.sync("report");
const all: LineChart[] = [];

/** For angles that wrap: the line is interrupted even where the gap is below one pixel. */
const parted: uPlot.Series.PathBuilder = (u, series, from, to) => {
  const stroke = new Path2D(),
    x = u.data[0],
    y = u.data[series] as (number | null | undefined)[];
  let pen = false;
  for (let i = from; i <= to; ++i) {
    const value = y[i];
    if (value === undefined) continue; // of another curve
    if (value !== null) {
      const at: [number, number] = [u.valToPos(x[i] as number, "x", true), u.valToPos(value, "y", true)];
      if (pen) stroke.lineTo(...at);
      else stroke.moveTo(...at);
    }
    pen = value !== null;
  }
  return { stroke };
};

/** Increasing times, with gaps for missing values, long pauses and wraps of an angle. */
function drawable(s: Series, turn: number): [number[], (number | null)[]] {
  const t: number[] = [],
    v: (number | null)[] = [];
  let usual = longest_gap_s;
  if (s.t.length > 1)
    usual = Math.max(usual, (3 * ((s.t[s.t.length - 1] as number) - (s.t[0] as number))) / s.t.length);
  for (let i = 0; i < s.t.length; ++i) {
    const time = s.t[i] as number,
      value = s.v[i] as number,
      before_t = t[t.length - 1],
      before = v[v.length - 1];
    if (before_t !== undefined && !(time > before_t)) continue;
    const jumps = typeof before === "number" && turn > 0 && Math.abs(value - before) > turn / 2;
    if (before_t !== undefined && (time - before_t > usual || jumps)) {
      t.push((before_t + time) / 2);
      v.push(null);
    }
    t.push(time);
    v.push(Number.isFinite(value) ? value : null);
  }
  return [t, v];
}

export class LineChart {
  private readonly box = el("div", { class: "plotbox" });
  readonly element: HTMLElement;
  private plot: uPlot | null = null;
  private readonly data: uPlot.AlignedData;
  private readonly parts: boolean;

  constructor(
    private readonly text: ChartText,
    private readonly curves: Curve[],
    private readonly phases: Phase[] = [],
    turn = 0,
  ) {
    this.parts = turn > 0;
    this.element = el(
      "figure",
      { class: "chart", role: "img", "aria-label": this.spoken() },
      el(
        "figcaption",
        {},
        el("b", {}, text.title),
        text.note ? el("span", { class: "faint" }, text.note) : null,
      ),
      this.box,
    );
    const tables = curves
      .map((c) => drawable(c.series, turn) as uPlot.AlignedData)
      .filter((table) => table[0].length > 0);
    this.curves = curves.filter((c) => c.series.t.length > 0);
    this.data = tables.length > 0 ? uPlot.join(tables) : [[]];
    if (this.curves.length === 0) this.box.append(el("p", { class: "faint" }, "No recorded data."));
    all.push(this);
  }

  /** Its ranges as text, for screen readers. */
  private spoken(): string {
    const parts = this.curves
      .filter((c) => c.series.t.length > 0)
      .map((c) => {
        let low = Infinity,
          high = -Infinity;
        for (const v of c.series.v)
          if (Number.isFinite(v)) [low, high] = [Math.min(low, v), Math.max(high, v)];
        return `${c.name}: ${with_unit(low, this.text.unit)} to ${with_unit(high, this.text.unit)}`;
      });
    return this.text.title + ". " + parts.join(", ");
  }

  draw(): void {
    const width = this.box.clientWidth;
    if (width < 50 || this.curves.length === 0) return;
    const shown = this.plot ? { min: this.plot.scales.x?.min, max: this.plot.scales.x?.max } : null;
    this.plot?.destroy();
    const { unit, least, around_zero } = this.text;
    const axis = {
      stroke: colours.get("text"),
      grid: { stroke: colours.get("grid"), width: 1 },
      ticks: { stroke: colours.get("grid"), width: 1 },
      font: "12px system-ui",
    };
    this.plot = new uPlot(
      {
        width,
        height: height_px,
        pxAlign: 0,
        cursor: { drag: { x: true, y: false }, sync: { key: sync.key, setSeries: false } },
        scales: {
          x: { time: false },
          y: {
            range: (_u, low, high) => {
              if (!Number.isFinite(low) || !Number.isFinite(high)) return [-least, least];
              const size = Math.max(Math.abs(low), Math.abs(high), least / 2) * 1.08;
              if (around_zero) return [-size, size];
              const room = Math.max((high - low) * 0.08, (least - (high - low)) / 2);
              return [low - room, high + room];
            },
          },
        },
        axes: [
          { ...axis, size: 32, values: (_u, list) => list.map((v) => digits(v) + " s") },
          { ...axis, size: 76, values: (_u, list) => list.map((v) => with_unit(v, unit)) },
        ],
        series: [
          { label: "time", value: (_u, v) => fixed(v ?? undefined, 2, "s") },
          ...this.curves.map((c) => ({
            label: c.name,
            stroke: colours.get(c.colour),
            width: c.width ?? 1.6,
            dash: c.dash,
            points: { show: false },
            auto: !c.may_leave,
            ...(this.parts ? { paths: parted } : {}),
            value: (_u: uPlot, v: number | null) => fixed(v ?? undefined, 3, unit),
          })),
        ],
        legend: {
          markers: {
            width: 3,
            dash: (_u, i) => {
              const dash = this.curves[i - 1]?.dash;
              return !dash ? "solid" : (dash[0] as number) > 4 ? "dashed" : "dotted";
            },
          },
        },
        hooks: { drawClear: [(u) => this.bands(u)] },
      },
      this.data,
      this.box,
    );
    if (shown?.min !== undefined && shown.max !== undefined)
      this.plot.setScale("x", { min: shown.min as number, max: shown.max as number });
  }

  /** Bands of the phases, with names where they fit. */
  private bands(u: uPlot): void {
    const g = u.ctx,
      ratio = devicePixelRatio,
      { left, top, width, height } = u.bbox;
    g.save();
    g.beginPath();
    g.rect(left, top, width, height);
    g.clip();
    g.font = 11 * ratio + "px system-ui";
    g.textBaseline = "top";
    this.phases.forEach((phase, i) => {
      const from = u.valToPos(phase.from_s, "x", true),
        to = u.valToPos(phase.to_s, "x", true);
      g.fillStyle = colours.get("grid");
      g.globalAlpha = 0.35;
      if (i % 2 === 1) g.fillRect(from, top, to - from, height);
      g.globalAlpha = 1;
      g.fillStyle = colours.get("faint");
      if (g.measureText(phase.name).width + 8 * ratio < Math.min(to, left + width) - Math.max(from, left))
        g.fillText(phase.name, Math.max(from, left) + 4 * ratio, top + 2 * ratio);
    });
    g.restore();
  }

  resize(): void {
    const width = this.box.clientWidth;
    if (this.plot && width >= 50 && this.plot.width !== width)
      this.plot.setSize({ width, height: height_px });
  }
  show(from_s: number, to_s: number): void {
    this.plot?.setScale("x", { min: from_s, max: to_s });
  }
}

export function draw_charts(): void {
  for (const chart of all) chart.draw();
}
export function resize_charts(): void {
  for (const chart of all) chart.resize();
}
export function show_time(from_s: number, to_s: number): void {
  for (const chart of all) chart.show(from_s, to_s);
}
