// SPDX-License-Identifier: BSD-3-Clause
// Commanded and actual values over the last seconds, and the figures of the last step.
import uPlot from "uplot";
import { colours, el, fill, say } from "../dom";
import { last_step, value_at } from "../flight/step";
import { type Names, names_of } from "../names";
import type { Series, Source } from "../source";
import { digits, fixed, shown_unit, with_unit } from "../units";

interface Pair {
  name: string;
  asked: [string, string];
  got: [string, string];
  unit: string;
  least: number;
  turn: number;
}
function pairs_of(n: Names): Pair[] {
  const angle = { unit: "rad" },
    turn = 2 * Math.PI;
  const all: Pair[] = [
    {
      name: "roll",
      asked: [n.attitude, "roll_rad"],
      got: [n.state, "roll_rad"],
      ...angle,
      least: 0.05,
      turn,
    },
    {
      name: "pitch",
      asked: [n.attitude, "pitch_rad"],
      got: [n.state, "pitch_rad"],
      ...angle,
      least: 0.03,
      turn,
    },
    {
      name: "course",
      asked: [n.command, "course_rad"],
      got: [n.state, "course_rad"],
      ...angle,
      least: 0.1,
      turn,
    },
    {
      name: "height",
      asked: [n.command, "height_m"],
      got: [n.state, "height_m"],
      unit: "m",
      least: 1,
      turn: 0,
    },
    {
      name: "airspeed",
      asked: [n.command, "airspeed_mps"],
      got: [n.state, "airspeed_mps"],
      unit: "m/s",
      least: 0.5,
      turn: 0,
    },
  ];
  return all.filter((p) => p.asked[0] !== "" && p.got[0] !== "");
}

export class Response {
  private readonly choice = el("select", { "aria-label": "Plotted quantity" });
  private readonly span = el(
    "select",
    { "aria-label": "Time span" },
    ...[10, 20, 60, 180].map((s) => el("option", { value: String(s) }, s + " s")),
  );
  private readonly box = el("div", { class: "plot" });
  private readonly figures = el("div", { class: "stepfigures", "aria-live": "off" });
  readonly element = el(
    "section",
    { class: "grow" },
    el("div", { class: "row" }, el("h2", {}, "Commanded and actual"), this.choice, this.span),
    this.box,
    this.figures,
  );
  private plot: uPlot | null = null;
  private plotted = "";
  private last_ms = 0;

  constructor(private readonly source: Source) {
    this.span.value = "20";
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => (this.plotted = ""));
  }

  /** Subscribes, so that the past is available when the view opens. */
  record(): void {
    for (const p of pairs_of(names_of(this.source)))
      [this.source.series(...p.asked), this.source.series(...p.got)];
  }

  update(now_ms: number): void {
    const seconds = Number(this.span.value),
      pixel_ms = (1000 * seconds) / Math.max(1, this.box.clientWidth);
    if (now_ms - this.last_ms < Math.max(80, pixel_ms)) return; // less than a pixel of motion
    this.last_ms = now_ms;
    const pairs = pairs_of(names_of(this.source));
    if (this.choice.childElementCount !== pairs.length)
      fill(this.choice, ...pairs.map((p) => el("option", { value: p.name }, p.name)));
    const pair = pairs.find((p) => p.name === this.choice.value) ?? pairs[0];
    if (!pair) return say(this.figures, "No component of this flight commands an attitude or a course.");
    const asked = this.source.series(...pair.asked),
      got = this.source.series(...pair.got);
    const now = this.source.now;
    this.draw(pair, asked, got, now, seconds);
    this.tell(pair, asked, got, now - seconds);
  }

  private draw(pair: Pair, asked: Series, got: Series, now: number, seconds: number): void {
    const { unit, scale } = shown_unit(pair.unit);
    const width = this.box.clientWidth,
      height = this.box.clientHeight;
    if (width < 50 || height < 50) return;
    if (this.plotted !== pair.name || !this.plot) {
      this.plot?.destroy();
      const axis = {
        stroke: colours.get("text"),
        grid: { stroke: colours.get("grid") },
        ticks: { stroke: colours.get("grid") },
      };
      this.plot = new uPlot(
        {
          width,
          height,
          pxAlign: 0,
          cursor: { drag: { x: false, y: false } },
          scales: { x: { time: false } },
          axes: [
            { ...axis, values: (_u, list) => list.map((v) => digits(v) + " s") },
            { ...axis, size: 64, values: (_u, list) => list.map((v) => with_unit(v, unit)) },
          ],
          series: [
            { label: "time", value: (_u, v) => fixed(v, 2, "s") },
            {
              label: "commanded",
              stroke: colours.get("line2"),
              width: 2,
              dash: [8, 4],
              value: (_u, v) => fixed(v, 2, unit),
            },
            { label: "actual", stroke: colours.get("line1"), width: 2, value: (_u, v) => fixed(v, 2, unit) },
          ],
        },
        [[], [], []],
        this.box,
      );
      this.plotted = pair.name;
    }
    const legend = this.box.querySelector<HTMLElement>(".u-legend")?.offsetHeight ?? 30;
    if (this.plot.width !== width || this.plot.height !== height - legend)
      this.plot.setSize({ width, height: height - legend });
    let begin = got.t.length;
    while (begin > 0 && (got.t[begin - 1] as number) >= now - seconds) --begin;
    const every = Math.max(1, Math.floor((got.t.length - begin) / (2 * width)));
    const t: number[] = [],
      a: number[] = [],
      g: number[] = [];
    for (let i = begin; i < got.t.length; i += every) {
      const time = got.t[i] as number,
        value = got.v[i] as number;
      let want = value_at(asked, time);
      if (pair.turn > 0) want = value + (want - value - pair.turn * Math.round((want - value) / pair.turn)); // the nearest equal angle
      t.push(time);
      g.push(value * scale);
      a.push(want * scale);
    }
    if (pair.name === "course") unwrap(a, g);
    this.plot.setData([t, a, g], false);
    this.plot.batch(() => {
      this.plot?.setScale("x", { min: now - seconds, max: now });
      const all = [...a, ...g].filter(Number.isFinite);
      const low = Math.min(...all, Infinity),
        high = Math.max(...all, -Infinity),
        least = pair.least * scale * 2;
      const room = Math.max((high - low) * 0.08, (least - (high - low)) / 2);
      if (all.length > 0) this.plot?.setScale("y", { min: low - room, max: high + room });
    });
  }

  private tell(pair: Pair, asked: Series, got: Series, since: number): void {
    const { unit, scale } = shown_unit(pair.unit);
    const step = last_step(asked, got, since, pair.least, 0.4, pair.turn);
    if (!step)
      return say(
        this.figures,
        `No step of the commanded ${pair.name} of ${fixed(pair.least * scale, pair.turn ? 0 : 1, unit)} or more in this time span.`,
      );
    const time = (v: number | null) => (v === null ? "not yet" : fixed(v, 2, "s"));
    say(
      this.figures,
      `Step at ${fixed(step.at, 1, "s")}, ${fixed(step.from * scale, 1, unit)} → ${fixed(step.to * scale, 1, unit)}: ` +
        `rise time ${time(step.rise_s)}, overshoot ${step.overshoot === null ? "not yet" : fixed(100 * step.overshoot, 0, "%")}, settling within 5 % ${time(step.settling_s)}`,
    );
  }
}

/** Removes the jumps of 360 degrees. */
function unwrap(...lists: number[][]): void {
  for (const list of lists)
    for (let i = 1; i < list.length; ++i) {
      const before = list[i - 1] as number;
      list[i] = (list[i] as number) - 360 * Math.round(((list[i] as number) - before) / 360);
    }
}
