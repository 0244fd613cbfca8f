// SPDX-License-Identifier: BSD-3-Clause
// Phases, and the active component of each role. A phase is entered by two clicks.
import { el, fill, mark } from "../dom";
import type { Flight, View } from "../protocol/flight";

export class RolesPanel {
  private readonly phases = el("div", { class: "chips", role: "group", "aria-label": "Phases" });
  private readonly table = el("div", { class: "pairs" });
  private readonly said = el("p", { class: "refusal", role: "alert", hidden: true });
  readonly element = el(
    "section",
    {},
    el("h2", {}, "Phase"),
    this.phases,
    this.said,
    el("h2", {}, "Roles"),
    this.table,
  );
  private shown = "";
  private asked = ""; // phase of the first click

  constructor(private readonly flight: Flight) {}

  update(): void {
    const view = this.flight.view;
    if (!view) return;
    const now = JSON.stringify([
      view.phase,
      view.phases,
      this.asked,
      view.components.map((c) => [c.name, c.role, c.active, c.stopped]),
    ]);
    if (now === this.shown) return;
    this.shown = now;
    const focused = (document.activeElement as HTMLElement | null)?.dataset?.phase;
    fill(this.phases, ...view.phases.map((phase) => this.chip(view, phase)));
    if (focused)
      [...this.phases.querySelectorAll("button")].find((b) => b.dataset.phase === focused)?.focus();
    const roles = [...new Set(view.components.flatMap((c) => c.role.split(", ").filter(Boolean)))];
    fill(
      this.table,
      ...roles.flatMap((role) => {
        const all = view.components.filter((c) => c.role.split(", ").includes(role));
        const flies = all.filter((c) => c.active && !c.stopped),
          stopped = all.filter((c) => c.stopped);
        const words = el("b", {}, flies.map((c) => c.name).join(", ") || "none");
        mark(words, "bad", flies.length === 0);
        if (stopped.length > 0)
          words.append(el("span", { class: "bad" }, " ✕ stopped: " + stopped.map((c) => c.name).join(", ")));
        return [el("span", {}, role), words];
      }),
    );
  }

  private chip(view: View, phase: string): HTMLElement {
    const here = phase === view.phase,
      asked = phase === this.asked && !here;
    const chip = el(
      "button",
      {
        class: "chip" + (here ? " on" : asked ? " asked" : ""),
        "aria-pressed": String(here),
        disabled: here,
        title: here ? "active phase" : "Enter this phase: click twice",
        onclick: () => void this.enter(phase),
      },
      asked ? "enter " + phase + "?" : phase,
    );
    chip.dataset.phase = phase;
    return chip;
  }

  private async enter(phase: string): Promise<void> {
    if (this.asked !== phase) {
      this.asked = phase;
      setTimeout(() => (this.asked = this.asked === phase ? "" : this.asked), 3000);
      return;
    }
    this.asked = "";
    const answer = await this.flight.ask("/fulmar/phase", { phase });
    this.said.hidden = answer.accepted;
    fill(this.said, answer.accepted ? "" : answer.reason);
  }
}
