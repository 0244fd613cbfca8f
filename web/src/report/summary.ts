// SPDX-License-Identifier: BSD-3-Clause
// The report for reading and printing: figures, map, curves, errors, events, plugins.
import { el } from "../dom";
import { names_of, plan_of, state_of } from "../names";
import type { Recording } from "../recorded";
import { MapView } from "../views/map";
import { recorded_places } from "./ground";
import { fixed } from "../units";
import { channel_charts, error_chart, type Judged, log_colours, surface_charts, width_of } from "./curves";
import { draw_charts, resize_charts, show_time } from "./chart";
import { hardware_section } from "./hardware";
import type { Log, ReportData } from "./model";
import {
  estimate_table,
  figure_tables,
  flight_table,
  innovation_table,
  parameter_table,
  phase_table,
  plugin_table,
  section,
  sentence,
  time_tables,
  told_table,
  verdict_line,
} from "./tables";

/** Series of several estimates, by quantity. */
function by_words(all: { name: string; rows: Log["innovations"] }[]): Map<string, Judged[]> {
  const out = new Map<string, Judged[]>();
  for (const { name, rows } of all)
    for (const series of rows) out.set(series.words, [...(out.get(series.words) ?? []), { name, series }]);
  return out;
}
const capital = (words: string) => words.charAt(0).toUpperCase() + words.slice(1);

export class Summary {
  readonly element = el("div", { class: "summary" });
  private readonly map = new MapView();

  constructor(
    private readonly data: ReportData,
    private readonly sources: Recording[],
  ) {}

  async build(): Promise<void> {
    const { logs } = this.data,
      one = logs.length === 1,
      phases = one ? (logs[0] as Log).phases : [];
    const [height, ...rest] = channel_charts(this.sources, phases);
    const each = (of: (log: Log) => HTMLElement) =>
      logs.map((log) => (one ? of(log) : el("div", {}, el("h3", {}, log.name), of(log))));
    this.element.append(
      section("Verdict", ...each(verdict_line)),
      section("Flights", flight_table(logs)),
      section("Figures of merit", ...figure_tables(logs)),
      this.time_bar(),
      section("Map and height", this.map.element, this.key_of_map(), height ? height.element : null),
      section(
        "Commanded and actual",
        el(
          "div",
          { class: "charts" },
          ...rest.map((c) => c.element),
          ...surface_charts(this.sources, phases).map((c) => c.element),
        ),
      ),
      await this.errors(),
      await this.innovations(),
      section("Phases", ...each(phase_table)),
      section("Guards and changes", ...each(told_table)),
      section("Times", ...time_tables(logs)),
      section("Parameters that differ", parameter_table(this.data)),
      hardware_section(logs),
      section("Plugins", plugin_table(logs)),
    );
    for (const event of ["pointerdown", "pointermove", "wheel", "keydown", "click"])
      this.map.element.addEventListener(event, () => requestAnimationFrame(() => this.draw_map()), {
        passive: true,
      });
    new ResizeObserver(() => this.resize()).observe(this.element);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.draw());
  }

  private async errors(): Promise<HTMLElement> {
    const { logs } = this.data,
      one = logs.length === 1;
    const all = logs.flatMap((log) =>
      log.estimates.map((e) => ({
        log,
        e,
        name:
          [one ? "" : log.name, log.estimates.length > 1 ? e.topic : ""].filter(Boolean).join(" ") || e.topic,
      })),
    );
    if (all.length === 0)
      return section(
        "Errors of the estimate",
        sentence("The log has no estimate, or no truth and no fixes of a receiver to compare it with."),
      );
    const charts: HTMLElement[] = [];
    for (const [words, judged] of by_words(
      all.slice(0, log_colours.length).map(({ e, name }) => ({ name, rows: e.rows })),
    ))
      charts.push(
        (await error_chart(capital(words), judged, all.length === 1 && one ? (logs[0] as Log).phases : []))
          .element,
      );
    const tables = all.map(({ log, e }) =>
      el(
        "div",
        {},
        el("h3", {}, (one ? "" : log.name + ": ") + `${e.topic} against ${e.reference}`),
        e.truth
          ? null
          : sentence(
              "The log has no truth. These are differences to the fixes of a receiver, which the filter may have used: they contain the errors of both.",
            ),
        estimate_table(e),
        e.nees
          ? sentence(
              `NEES of 9 states: mean ${fixed(e.nees.mean, 2, "")} (9 expected for a consistent filter), ${fixed(100 * e.nees.inside, 1, "%")} of the time inside the 95 % interval 2.70 to 19.02.`,
            )
          : null,
      ),
    );
    return section(
      "Errors of the estimate",
      ...tables,
      sentence(
        "Estimate minus reference. Each point is the largest error of its time interval; σ is the standard deviation that the estimate reports at that time.",
      ),
      el("div", { class: "charts" }, ...charts),
    );
  }

  private async innovations(): Promise<HTMLElement> {
    const { logs } = this.data,
      one = logs.length === 1,
      some = logs.filter((log) => log.innovations.length > 0);
    if (some.length === 0)
      return section("Innovations", sentence("The log has no innovations (FilterCheck, NavigationHealth)."));
    const charts: HTMLElement[] = [];
    for (const [words, judged] of by_words(some.map((log) => ({ name: log.name, rows: log.innovations }))))
      charts.push((await error_chart(words, judged, one ? (logs[0] as Log).phases : [], true)).element);
    return section(
      "Innovations",
      sentence(
        "Measured minus expected value, in expected standard deviations (σ). For a consistent filter 68.3 % are within 1 σ and 95.4 % within 2 σ.",
      ),
      ...some.map((log) =>
        one ? innovation_table(log) : el("div", {}, el("h3", {}, log.name), innovation_table(log)),
      ),
      el("div", { class: "charts" }, ...charts),
    );
  }

  /** Time span of all charts. */
  private time_bar(): HTMLElement {
    const { logs } = this.data;
    const begin = Math.min(...logs.map((log) => log.begin_s)),
      end = Math.max(...logs.map((log) => log.end_s));
    const field = (label: string, value: number) =>
      el("input", {
        type: "number",
        step: "any",
        min: String(begin),
        max: String(end),
        value: value.toFixed(1),
        "aria-label": label,
      });
    const from = field("Shown from, s", begin),
      to = field("Shown to, s", end);
    const show = () =>
      from.valueAsNumber < to.valueAsNumber && show_time(from.valueAsNumber, to.valueAsNumber);
    from.addEventListener("change", show);
    to.addEventListener("change", show);
    const whole = el(
      "button",
      {
        class: "small",
        onclick: () => {
          from.value = begin.toFixed(1);
          to.value = end.toFixed(1);
          show_time(begin, end);
        },
      },
      "All",
    );
    return el(
      "div",
      { class: "row timebar" },
      el("span", {}, "Time of all charts, from"),
      from,
      el("span", {}, "s to"),
      to,
      el("span", {}, "s"),
      whole,
      el("span", { class: "faint" }, "or drag in a chart; a double click shows the full time"),
    );
  }

  private key_of_map(): HTMLElement | null {
    if (this.data.logs.length === 1) return null;
    return el(
      "p",
      { class: "key" },
      ...this.data.logs.map((log, i) =>
        el("span", {}, el("i", { class: "sample " + log_colours[i] }), log.name),
      ),
    );
  }

  private draw_map(): void {
    const tracks = this.sources.map((source, i) => {
      const n = names_of(source);
      return {
        n: source.whole(n.state, "position_m.north").v as number[],
        e: source.whole(n.state, "position_m.east").v as number[],
        colour: log_colours[i] as string,
        width: 0.6 + width_of(i, this.sources.length),
      };
    });
    const first = this.sources[0] as Recording,
      names = names_of(first),
      now = first.now;
    first.now = first.log.end_s; // the final plan
    const plan = plan_of(first.latest(names.plan)),
      state = state_of(first.latest(names.state));
    first.now = now;
    this.map.draw({
      plan,
      draft: false,
      state: this.sources.length === 1 ? state : null,
      track: { n: [], e: [] },
      tracks,
      places: recorded_places(first),
      item: -1,
      chosen: -1,
      refused: -1,
      piece: [],
    });
  }
  draw(): void {
    draw_charts();
    this.draw_map();
  }
  private resize(): void {
    resize_charts();
    this.draw_map();
  }
}
