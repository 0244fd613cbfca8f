// SPDX-License-Identifier: BSD-3-Clause
// Writes active values into the files of mission and airframe: the host returns the lines that change, and a second click writes them.
import { el, fill, say } from "../dom";
import type { Flight } from "../protocol/flight";

interface SaveAnswer {
  accepted: boolean;
  reason: string;
  lines: string;
  mark: string;
}

export class SavePanel {
  private readonly buttons = el("div", { class: "row" });
  private readonly lines = el("pre", {
    class: "lines",
    hidden: true,
    tabIndex: 0,
    "aria-label": "Lines that would change",
  });
  private readonly said = el("p", { role: "alert", hidden: true });
  private readonly choice = el("div", { class: "row", hidden: true });
  readonly element = el("div", {}, this.buttons, this.lines, this.said, this.choice);
  private shown = "";
  private component = "";

  constructor(private readonly flight: Flight) {}

  /** `components`: those with changed parameters. */
  offer(components: string[]): void {
    const why_not = this.flight.view?.no_save ?? "";
    const now = JSON.stringify([components, why_not]);
    if (now === this.shown) return;
    this.shown = now;
    this.clear();
    if (why_not === "" && this.flight.has("/fulmar/save"))
      return fill(
        this.buttons,
        ...components.map((c) => el("button", { onclick: () => void this.look(c) }, `Save ${c}…`)),
      );
    const at = location.host === "127.0.0.1:8765" ? "" : " --at " + location.host;
    const command = components.map((c) => `fulmar param save ${c}${at}`).join("\n");
    const copy = el(
      "button",
      { onclick: () => void navigator.clipboard.writeText(command).then(() => say(copy, "Copied")) },
      "Copy",
    );
    fill(
      this.buttons,
      components.length > 0 &&
        el("p", { class: "faint" }, `This page cannot save: ${why_not}. Use the terminal:`),
      components.length > 0 && el("code", {}, command),
      components.length > 0 && copy,
    );
  }

  private clear(): void {
    this.lines.hidden = this.choice.hidden = this.said.hidden = true;
  }
  private async ask(mark: string): Promise<SaveAnswer> {
    const answer = await this.flight.ask("/fulmar/save", { component: this.component, mark });
    return { lines: "", mark: "", ...answer };
  }
  private tell(answer: SaveAnswer, good: string): void {
    this.said.hidden = false;
    this.said.className = answer.accepted ? "taken" : "refusal";
    say(this.said, [answer.accepted ? good : "Rejected:", answer.reason].filter(Boolean).join(" "));
  }

  private async look(component: string): Promise<void> {
    this.clear();
    this.component = component;
    const answer = await this.ask("");
    this.lines.hidden = answer.lines === "";
    fill(
      this.lines,
      ...answer.lines
        .split("\n")
        .map((line) =>
          el(
            "span",
            { class: line.startsWith("+ ") ? "added" : line.startsWith("- ") ? "removed" : "faint" },
            line + "\n",
          ),
        ),
    );
    this.tell(answer, answer.lines === "" ? "The files already contain the active values." : "");
    if (this.said.textContent === "") this.said.hidden = true;
    if (answer.mark === "") return;
    fill(
      this.choice,
      el("button", { class: "main", onclick: () => void this.write(answer.mark) }, "Write these lines"),
      el("button", { onclick: () => this.clear() }, "Cancel"),
    );
    this.choice.hidden = false;
  }
  private async write(mark: string): Promise<void> {
    this.choice.hidden = true;
    const answer = await this.ask(mark);
    this.tell(answer, answer.lines.replace(/^written:/gm, "Written:"));
  }
}
