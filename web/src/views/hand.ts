// SPDX-License-Identifier: BSD-3-Clause
// The pilot's sticks of a simulated aircraft, by keys or a gamepad. They are parameters of the vehicle, so that the log contains them.
import { el, fill, say } from "../dom";
import type { Flight } from "../protocol/flight";
import { fixed } from "../units";

const send_ms = 40,
  per_s = 2.5,
  back_per_s = 4,
  throttle_per_s = 0.6,
  dead = 0.06;
const sticks = ["stick_roll", "stick_pitch", "stick_yaw", "stick_throttle"] as const;

export class HandPanel {
  private readonly pad = el("div", {
    class: "sticks",
    tabIndex: 0,
    role: "application",
    "aria-label": "Sticks: click, then use the keys",
  });
  readonly flies = el("button", { class: "take", onclick: () => void this.toggle() }, "Take the sticks");
  private readonly said = el("p", { class: "refusal", role: "alert", hidden: true });
  private readonly words = el("p", { class: "faint" });
  private readonly knobs = [el("i"), el("i")];
  readonly element = el("section", { class: "hand" }, this.pad, this.words, this.said);
  private held = new Set<string>();
  private position = { roll: 0, pitch: 0, yaw: 0, throttle: 0 };
  private sent = "";
  private last_ms = 0;

  constructor(private readonly flight: Flight) {
    fill(
      this.pad,
      el("div", { class: "stick" }, this.knobs[0] as HTMLElement),
      el("div", { class: "stick" }, this.knobs[1] as HTMLElement),
    );
    this.pad.addEventListener("keydown", (e) => {
      if (e.key === "Tab" || e.ctrlKey || e.metaKey) return;
      if (e.key === "x") this.position.throttle = 0;
      this.held.add(e.key);
      e.preventDefault();
      e.stopPropagation();
    });
    this.pad.addEventListener("keyup", (e) => this.held.delete(e.key));
    this.pad.addEventListener("blur", () => this.held.clear());
  }

  /** The simulated vehicle with sticks; "" without one. */
  private vehicle(): string {
    return (
      this.flight.view?.components.find((c) => c.active && c.params.some((p) => p.name === "pilot_flies"))
        ?.name ?? ""
    );
  }
  get has(): boolean {
    return (
      this.flight.component(this.vehicle())?.params.find((p) => p.name === "pilot_flies")?.value === true
    );
  }
  private async toggle(): Promise<void> {
    const vehicle = this.vehicle(),
      take = !this.has;
    if (take) this.begin();
    const answer = await this.flight.set_parameter(vehicle, "pilot_flies", String(take));
    this.said.hidden = answer.accepted;
    say(this.said, "Rejected: " + answer.reason);
    await this.flight.refresh();
    this.element.hidden = this.pad.hidden = !this.has; // a hidden element cannot receive keys
    if (this.has) this.pad.focus();
  }
  /** Throttle at the value of the autopilot, the other sticks at the centre. */
  private begin(): void {
    const topic = this.flight.topics().find((t) => t.type.endsWith("/Actuators"))?.name ?? "";
    const throttle = Number(this.flight.latest(topic)?.throttle_frac ?? 0);
    this.position = { roll: 0, pitch: 0, yaw: 0, throttle: Math.min(1, Math.max(0, throttle)) };
    this.sent = "";
    this.send();
  }
  private send(): void {
    const p = this.position,
      vehicle = this.vehicle();
    const values = [p.roll, p.pitch, p.yaw, p.throttle].map((v) => Math.round(v * 1000) / 1000);
    const now = values.join();
    if (now === this.sent || vehicle === "") return;
    this.sent = now;
    this.flight.set_quickly(sticks.map((name, i) => ({ name: `${vehicle}.${name}`, value: values[i] })));
  }

  private key(plus: string[], minus: string[]): number {
    const down = (keys: string[]) => keys.some((k) => this.held.has(k));
    return (down(plus) ? 1 : 0) - (down(minus) ? 1 : 0);
  }
  private move(seconds: number): void {
    const p = this.position,
      pad = navigator.getGamepads?.().find((g) => g !== null && g.axes.length >= 4);
    const towards = (now: number, key: number) =>
      key !== 0
        ? Math.max(-1, Math.min(1, now + key * per_s * seconds))
        : Math.sign(now) * Math.max(0, Math.abs(now) - back_per_s * seconds);
    p.roll = towards(p.roll, this.key(["ArrowRight", "d"], ["ArrowLeft", "a"]));
    p.pitch = towards(p.pitch, this.key(["ArrowDown", "s"], ["ArrowUp", "w"]));
    p.yaw = towards(p.yaw, this.key(["e"], ["q"]));
    p.throttle = Math.max(
      0,
      Math.min(1, p.throttle + this.key(["r", "PageUp"], ["f", "PageDown"]) * throttle_per_s * seconds),
    );
    if (!pad) return;
    const axis = (i: number) => {
      const v = pad.axes[i] ?? 0;
      return Math.abs(v) < dead ? 0 : v;
    };
    if (axis(2) !== 0) p.roll = axis(2);
    if (axis(3) !== 0) p.pitch = axis(3);
    if (axis(0) !== 0) p.yaw = axis(0);
    p.throttle = Math.max(0, Math.min(1, p.throttle - axis(1) * throttle_per_s * seconds));
  }

  update(): void {
    const vehicle = this.vehicle(),
      has = this.has,
      now = performance.now();
    this.flies.hidden = vehicle === "";
    this.element.hidden = !has && this.said.hidden;
    say(this.flies, has ? "Release the sticks" : "Take the sticks");
    this.pad.hidden = !has;
    const p = this.position;
    say(
      this.words,
      `Arrows or W A S D: roll and pitch; Q E: yaw; R F: throttle; X: throttle 0; or a gamepad. Throttle ${fixed(p.throttle * 100, 0, "%")}.`,
    );
    const seconds = (now - this.last_ms) / 1000;
    if (!has || seconds * 1000 < send_ms) return;
    this.last_ms = now;
    this.move(Math.min(seconds, 0.2));
    this.send();
    const place = (knob: HTMLElement | undefined, x: number, y: number) => {
      if (knob) knob.style.transform = `translate(${32 * x}px, ${32 * y}px)`;
    };
    place(this.knobs[0], p.yaw, 1 - 2 * p.throttle);
    place(this.knobs[1], p.roll, p.pitch);
  }
}
