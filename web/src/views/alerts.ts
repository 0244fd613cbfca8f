// SPDX-License-Identifier: BSD-3-Clause
// The strip below the header: fault, response of the aircraft, and action for the pilot, until the pilot acknowledges it.
import { el, fill, mark, say } from "../dom";
import {
  type Alert,
  AlertBook,
  type Held,
  type Moment,
  alert_of_event,
  alerts_of,
  cause_of,
  doing,
  not_ready,
} from "../flight/alerts";
import { names_of } from "../names";
import { type Flight, publishers } from "../protocol/flight";
import { clock } from "../units";

const most = 2,
  fresh_s = 10;

export class AlertStrip {
  private readonly rows = el("div", { class: "alert_rows", role: "alert" });
  private readonly lasting = el("div", { class: "alert_lasting", hidden: true });
  readonly element = el("div", { id: "alerts", hidden: true }, this.rows, this.lasting);
  private readonly book = new AlertBook();
  private stop: () => void = () => {};
  private shown = "";
  /** Missing conditions of the vehicle before take-off, with the flight time of the report, which is repeated. */
  readonly lacks = { what: [] as string[], t: -Infinity };

  constructor(private readonly flight: Flight) {}

  /** Called when the topics are known. Earlier events are in the event list only. */
  begin(): void {
    this.stop();
    this.stop = this.flight.listen("/fulmar/event", (m, t) => {
      if (m.code === "phase_entered") void this.flight.refresh();
      const lacks = not_ready(String(m.words));
      if (lacks.length > 0) Object.assign(this.lacks, { what: lacks, t });
      if (m.severity === "info" && cause_of(m)) this.book.over(cause_of(m));
      const alert = alert_of_event(m, this.monitors(), doing(this.moment()));
      if (alert && this.flight.now - t < fresh_s) this.book.raise(alert, t);
    });
  }
  /** Components whose notices are flags as well. */
  private monitors(): string[] {
    return publishers(this.flight, names_of(this.flight).safety).map((c) => c.name);
  }
  moment(): Moment {
    const f = this.flight,
      n = names_of(f),
      view = f.view;
    const stopped = (view?.components ?? [])
      .filter((c) => c.stopped)
      .map((c) => ({
        name: c.name,
        role: c.role,
        heir:
          view?.components.find((o) => o.active && !o.stopped && o.role !== "" && o.role === c.role)?.name ??
          "",
      }));
    return {
      safety: f.latest(n.safety),
      status: f.latest(n.status),
      ground: f.latest(n.ground),
      contact: f.latest(n.contact),
      state: f.latest(n.state),
      stopped,
    };
  }

  update(): void {
    this.book.update(alerts_of(this.moment()), this.flight.now);
    const list = this.book.list(),
      lasting = this.book.lasting();
    const now = JSON.stringify([list, lasting.map((h) => h.alert.what)]);
    if (now === this.shown) return;
    this.shown = now;
    this.element.hidden = list.length === 0 && lasting.length === 0;
    this.element.dataset.level = list.some((h) => h.alert.level === "critical" && h.now)
      ? "critical"
      : list.length > 0
        ? "warning"
        : "none";
    const focused = (document.activeElement as HTMLElement | null)?.dataset?.acknowledge;
    const large = list.filter((h, i) => (h.now || i === 0) && i < most),
      rest = list.filter((h) => !large.includes(h));
    fill(this.rows, ...large.map((h) => this.row(h)), rest.length > 0 && this.more(rest));
    if (focused)
      [...this.rows.querySelectorAll("button")].find((b) => b.dataset.acknowledge === focused)?.focus();
    this.lasting.hidden = lasting.length === 0;
    say(
      this.lasting,
      lasting.length === 0
        ? ""
        : "Acknowledged, still active: " + lasting.map((h) => h.alert.what).join(" · "),
    );
  }

  private row(h: Held): HTMLElement {
    const { alert } = h,
      event = alert.key.startsWith("event ");
    const row = el(
      "div",
      { class: `alert ${alert.level}${event ? " told" : ""}` },
      el("b", { class: "what" }, (alert.level === "critical" ? "✕ " : "⚠ ") + alert.what),
      el(
        "span",
        { class: "since" },
        event
          ? "at " + clock(h.since_s)
          : h.now
            ? "since " + clock(h.since_s)
            : "past, began at " + clock(h.since_s),
      ),
      el("span", { class: "does" }, el("i", {}, "Aircraft "), alert.does),
      el("span", { class: "pilot" }, alert.pilot && el("i", {}, "Pilot "), alert.pilot),
      this.button("Acknowledge", [alert]),
    );
    row.dataset.alert = alert.key;
    row.dataset.now = String(h.now);
    mark(row, "over", !h.now);
    return row;
  }
  private more(rest: Held[]): HTMLElement {
    return el(
      "div",
      { class: "alert more" },
      el(
        "span",
        { class: "what" },
        `and ${rest.length} more: ` + rest.map((h) => h.alert.what + (h.now ? "" : " (past)")).join(" · "),
      ),
      this.button(
        "Acknowledge these",
        rest.map((h) => h.alert),
      ),
    );
  }
  private button(words: string, alerts: Alert[]): HTMLElement {
    const button = el(
      "button",
      {
        onclick: () => {
          for (const a of alerts) this.book.acknowledge(a.key);
          this.update();
        },
      },
      words,
    );
    button.dataset.acknowledge = alerts[0]?.key ?? "";
    return button;
  }
}
