// SPDX-License-Identifier: BSD-3-Clause
// Events of the host and notices of components, newest first.
import { el, fill } from "../dom";
import type { Source } from "../source";
import { clock } from "../units";

const most = 200;
const signs: Record<string, string> = { info: "·", warning: "⚠", error: "✕", critical: "✕✕" };

export class EventList {
  private readonly list = el("ol", {
    class: "events",
    "aria-live": "polite",
    tabIndex: 0,
    "aria-label": "Events",
  });
  readonly element = el("section", { class: "grow" }, el("h2", {}, "Events"), this.list);
  private stop: () => void = () => {};
  private empty = true;

  constructor(private readonly source: Source) {}

  /** Called when the topics are known: the host sends its last hundred events again. */
  begin(): void {
    this.stop();
    this.empty = true;
    fill(this.list, el("li", { class: "faint" }, "No events yet."));
    this.stop = this.source.listen("/fulmar/event", (m, t) => {
      const severity = String(m.severity);
      if (this.empty) fill(this.list);
      this.empty = false;
      // a slider or a stick sets a parameter many times: only the last value is listed
      const of = m.code === "parameter_set" ? `${m.component}.${m.name}` : "";
      if (of !== "")
        [...this.list.children]
          .slice(0, 6)
          .find((e) => (e as HTMLElement).dataset.of === of)
          ?.remove();
      const words = String(m.words) || [m.code, m.component, m.name, m.cause].filter(Boolean).join(" ");
      const line = el(
        "li",
        { class: severity },
        el("time", {}, clock(t)),
        el("b", { title: severity }, signs[severity] ?? "·"),
        el("span", {}, words),
      );
      line.dataset.of = of;
      this.list.prepend(line);
      while (this.list.childElementCount > most) this.list.lastElementChild?.remove();
    });
  }
}
