// SPDX-License-Identifier: BSD-3-Clause
// Three large buttons: return, land, hold. They set the answer of the safety monitor; without a monitor they enter a phase of the mission.
import { el, mark, say } from "../dom";
import { names_of } from "../names";
import { crashed, on_ground } from "../flight/alerts";
import type { AlertStrip } from "./alerts";
import { type Component, type Flight, publishers } from "../protocol/flight";

interface Command {
  key: "return" | "land" | "hold";
  words: string;
  title: string;
  answer: string; // of SafetyAnswer
  phases: string[]; // the first one in the mission is used
}
const commands: Command[] = [
  {
    key: "return",
    words: "⌂ Return",
    title: "Return home and circle there",
    answer: "home",
    phases: ["return", "home"],
  },
  {
    key: "land",
    words: "⤓ Land",
    title: "Return and land",
    answer: "land",
    phases: ["land", "landing", "approach", "settle"],
  },
  {
    key: "hold",
    words: "⟳ Hold",
    title: "Circle here at constant height",
    answer: "wait",
    phases: ["loiter", "wait"],
  },
];
const sure_ms = 3000,
  looked_at_ms = 1500;

export class Commands {
  private readonly said = el("p", { class: "refusal", role: "alert", hidden: true });
  private readonly buttons = commands.map((c) => {
    const button = el(
      "button",
      { class: "command", onclick: () => void this.press(c) },
      el("b", {}),
      el("small", {}),
    );
    button.dataset.command = c.key;
    return button;
  });
  readonly element = el(
    "div",
    { class: "commands", role: "group", "aria-label": "Commands" },
    ...this.buttons,
  );
  readonly refusal = this.said;
  private sure: { key: string; until_ms: number } = { key: "", until_ms: 0 };

  constructor(
    private readonly flight: Flight,
    private readonly alerts: AlertStrip,
  ) {}

  /** The safety monitor with a live parameter `asked`; "" without one. */
  private monitor(): string {
    const has = (c: Component) =>
      c.params.some((p) => p.name === "asked" && p.live && p.choices.includes("home"));
    return publishers(this.flight, names_of(this.flight).safety).find((c) => has(c))?.name ?? "";
  }
  private asked(monitor: string): string {
    return String(this.flight.component(monitor)?.params.find((p) => p.name === "asked")?.value ?? "none");
  }
  private phase(c: Command): string {
    const phases = this.flight.view?.phases ?? [];
    return c.phases.find((p) => phases.includes(p) && p !== phases[0]) ?? "";
  }
  private state(c: Command): { on: boolean; why_not: string } {
    const f = this.flight,
      monitor = this.monitor(),
      phase = this.phase(c);
    const on = monitor !== "" ? this.asked(monitor) === c.answer : phase !== "" && f.view?.phase === phase;
    // the answer to a failure has priority over the pilot's command
    const answer = String(f.latest(names_of(f).safety)?.answer ?? "none"),
      overruled = !on && monitor !== "" && answer !== "none" && answer !== this.asked(monitor);
    const moment = this.alerts.moment();
    const why_not = !f.view
      ? "no flight"
      : monitor === "" && phase === ""
        ? "not in this mission"
        : crashed(moment)
          ? "crashed"
          : !f.view.armed
            ? "disarmed"
            : on_ground(moment)
              ? "on the ground"
              : moment.status?.override === true
                ? "pilot in control"
                : overruled
                  ? "safety has priority"
                  : "";
    return { on, why_not };
  }

  /** Landing is final and takes two clicks. */
  private async press(c: Command): Promise<void> {
    const { on } = this.state(c),
      monitor = this.monitor(),
      now = performance.now();
    if (c.key === "land" && !on && !(this.sure.key === c.key && now < this.sure.until_ms)) {
      this.sure = { key: c.key, until_ms: now + sure_ms };
      return;
    }
    this.sure = { key: "", until_ms: 0 };
    const before = this.flight.view?.phase ?? "";
    const answer =
      monitor !== ""
        ? await this.flight.set_parameter(monitor, "asked", on ? "none" : c.answer)
        : await this.flight.ask("/fulmar/phase", { phase: this.phase(c) });
    this.said.hidden = answer.accepted;
    say(this.said, "Rejected: " + answer.reason);
    if (answer.accepted) setTimeout(() => this.look(c, monitor !== "", before), looked_at_ms);
  }
  /** The transitions of a phase may ignore the answer, and a mission may leave a phase at once. */
  private look(c: Command, asked: boolean, before: string): void {
    const phase = this.flight.view?.phase ?? "",
      follows = asked ? phase !== before : phase === this.phase(c);
    this.said.hidden = follows;
    say(
      this.said,
      asked
        ? `Phase ${phase} continues: its transitions do not use this command. Select another phase.`
        : `A transition of the mission changed phase ${this.phase(c)} to ${phase} at once.`,
    );
  }

  update(): void {
    commands.forEach((c, i) => {
      const button = this.buttons[i] as HTMLButtonElement,
        { on, why_not } = this.state(c);
      const sure = this.sure.key === c.key && performance.now() < this.sure.until_ms;
      button.disabled = why_not !== "";
      button.title = why_not || c.title;
      say(button.firstElementChild as Element, sure ? "press again" : c.words);
      say(
        button.lastElementChild as Element,
        why_not || (on ? (this.monitor() === "" ? "active" : "on: press to cancel") : ""),
      );
      button.setAttribute("aria-pressed", String(on));
      button.dataset.on = String(on);
      button.dataset.why = why_not;
      mark(button, "on", on);
      mark(button, "asked", sure);
    });
  }
}
