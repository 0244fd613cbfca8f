// SPDX-License-Identifier: BSD-3-Clause
// One live parameter: slider or switch, input field, range, and a button that restores the value at the start of the flight.
// Angles in degrees.
import { el, mark, say } from "../dom";
import type { Flight, Param } from "../protocol/flight";
import { digits, plain, shown_unit, with_unit } from "../units";

const send_gap_ms = 80;

/** "-45 .. 45 °" */
function range_of(p: Param): string {
  const { unit, scale } = shown_unit(p.unit);
  if (
    p.min === null ||
    p.max === null ||
    (p.min === 0 && p.max === 0) ||
    p.kind === "choice" ||
    p.kind === "flag"
  )
    return "";
  return `${digits(p.min * scale)} .. ${with_unit(p.max * scale, unit)}`;
}
function words_of(p: Param, value: unknown): string {
  const { scale } = shown_unit(p.unit);
  if (typeof value === "number") return plain(p.kind === "number" ? value * scale : value);
  if (Array.isArray(value)) return value.map((v) => plain(Number(v) * scale)).join(", ");
  return String(value);
}

export class ParamRow {
  readonly element: HTMLElement;
  private readonly slider: HTMLInputElement | null = null;
  private readonly field: HTMLInputElement | HTMLSelectElement;
  private readonly back = el(
    "button",
    { class: "small", onclick: () => this.put(this.was, this.text_of(this.was)) },
    "↺",
  );
  private readonly note = el("span", { class: "faint note" });
  private readonly refusal = el("p", { class: "refusal", role: "alert", hidden: true });
  private was: unknown; // at the start of the flight
  private value: unknown;
  private waiting: string | null = null;
  private last_ms = 0;
  private timer = 0;
  private touched_ms = -1e9;

  constructor(
    private readonly flight: Flight,
    readonly component: string,
    private p: Param,
  ) {
    this.was = p.begun;
    this.value = p.value;
    const { unit, scale } = shown_unit(p.unit);
    const label = `${component}.${p.name}${unit ? ", " + unit : ""}`;
    if (p.kind === "choice") {
      const select = el(
        "select",
        { "aria-label": label },
        ...p.choices.map((c) => el("option", { value: c }, c)),
      );
      select.addEventListener("change", () => this.put(select.value, select.value));
      this.field = select;
    } else if (p.kind === "flag") {
      const box = el("input", { type: "checkbox", "aria-label": label });
      box.addEventListener("change", () => this.put(box.checked, String(box.checked)));
      this.field = box;
    } else {
      const field = el("input", {
        type: "text",
        inputMode: "decimal",
        "aria-label": label,
        size: p.kind === "vector" ? 16 : 8,
      });
      field.addEventListener("change", () => this.typed(field.value));
      this.field = field;
    }
    if (p.kind === "number" && p.min !== null && p.max !== null && p.max > p.min) {
      const slider = el("input", {
        type: "range",
        min: String(p.min * scale),
        max: String(p.max * scale),
        step: "any",
        "aria-label": label + ", slider",
      });
      slider.addEventListener("input", () =>
        this.put(slider.valueAsNumber / scale, this.text_of(slider.valueAsNumber / scale)),
      );
      // steps by key are set here: with "any" the browser chooses its own
      slider.addEventListener("keydown", (e) => this.key(e, slider));
      this.slider = slider;
    }
    this.element = el(
      "div",
      { class: "param" },
      el(
        "div",
        { class: "param_name" },
        el("b", {}, p.name),
        el("span", { class: "faint", title: p.doc }, p.doc),
      ),
      this.slider ?? el("span"),
      el("span", { class: "value" }, this.field, el("span", { class: "unit" }, unit)),
      el("span", { class: "faint range" }, range_of(p)),
      this.back,
      this.note,
      this.refusal,
    );
    this.element.dataset.param = p.name;
    mark(this.element, "vector", p.kind === "vector");
    this.show(p);
  }

  get changed(): boolean {
    return JSON.stringify(this.value) !== JSON.stringify(this.was);
  }
  get name(): string {
    return this.p.name;
  }
  get summary(): string {
    const { unit } = shown_unit(this.p.unit);
    return `${this.component}.${this.p.name}: ${words_of(this.p, this.was)} → ${words_of(this.p, this.value)}${unit ? " " + unit : ""}`;
  }
  restore(): void {
    if (this.changed) this.put(this.was, this.text_of(this.was));
  }
  matches(words: string): boolean {
    return words === "" || (this.p.name + " " + this.p.doc).toLowerCase().includes(words);
  }

  private key(e: KeyboardEvent, slider: HTMLInputElement): void {
    const steps: Record<string, number> = {
      ArrowRight: 1,
      ArrowUp: 1,
      ArrowLeft: -1,
      ArrowDown: -1,
      PageUp: 10,
      PageDown: -10,
    };
    const step = steps[e.key];
    if (step === undefined) return;
    e.preventDefault();
    slider.valueAsNumber += (step * (Number(slider.max) - Number(slider.min))) / 200;
    slider.dispatchEvent(new Event("input"));
  }

  /** Text with unit, as in a mission file. */
  private text_of(value: unknown): string {
    const { scale, typed } = shown_unit(this.p.unit);
    if (typeof value === "number" && this.p.kind === "number")
      return typed ? `${value * scale} ${typed}` : String(value);
    if (Array.isArray(value)) return JSON.stringify(value);
    return String(value);
  }
  private typed(text: string): void {
    const { scale, typed } = shown_unit(this.p.unit);
    const bare = text.trim() !== "" && Number.isFinite(Number(text));
    if (this.p.kind === "vector") {
      const list = text
        .replace(/[[\]]/g, "")
        .split(/[,\s]+/)
        .filter(Boolean);
      const numbers = list.map(Number);
      return this.put(
        this.value,
        numbers.every(Number.isFinite) && typed
          ? JSON.stringify(numbers.map((x) => x / scale))
          : `[${list.join(", ")}]`,
      );
    }
    this.put(this.value, bare && typed && this.p.kind === "number" ? `${text.trim()} ${typed}` : text);
  }

  /** A slider calls this many times per second: the last value is sent. */
  private put(value: unknown, text: string): void {
    this.touched_ms = performance.now();
    this.value = value;
    this.waiting = text;
    this.show_value();
    if (this.timer === 0)
      this.timer = window.setTimeout(
        () => void this.send(),
        Math.max(0, send_gap_ms - (performance.now() - this.last_ms)),
      );
  }
  private async send(): Promise<void> {
    const text = this.waiting ?? "";
    this.waiting = null;
    this.last_ms = performance.now();
    const answer = await this.flight.set_parameter(this.component, this.p.name, text);
    this.timer = 0;
    this.touched_ms = answer.accepted ? performance.now() : -1e9;
    this.refusal.hidden = answer.accepted;
    say(this.refusal, "Rejected: " + answer.reason);
    if (!answer.accepted) this.value = this.p.value;
    this.show_value(!answer.accepted);
    if (this.waiting !== null) this.timer = window.setTimeout(() => void this.send(), send_gap_ms);
  }

  /** Value of the host. Ignored while the user edits it. */
  show(p: Param): void {
    this.p = p;
    if (this.waiting === null && this.timer === 0 && performance.now() - this.touched_ms > 400)
      this.value = p.value;
    this.show_value();
  }
  private show_value(by_force = false): void {
    const p = this.p,
      { unit, scale } = shown_unit(p.unit);
    if (this.field instanceof HTMLInputElement && p.kind === "flag") this.field.checked = this.value === true;
    else if (document.activeElement !== this.field || p.kind === "choice" || by_force)
      this.field.value = words_of(p, this.value);
    if (this.slider && document.activeElement !== this.slider)
      this.slider.valueAsNumber = Number(this.value) * scale;
    this.back.disabled = !this.changed;
    const was = words_of(p, this.was) + (unit ? " " + unit : "");
    this.back.title = "Restore " + was;
    this.back.setAttribute("aria-label", `Restore ${was}, ${p.name}`);
    say(this.note, p.overlaid ? "other value in this phase" : this.changed ? "was " + was : "");
    mark(this.element, "changed", this.changed);
  }
}
