// SPDX-License-Identifier: BSD-3-Clause
// The views of the page with recorded data, at the time of the slider.
import { el, fill, say } from "../dom";
import { piece_ahead } from "../flight/piece";
import { names_of, plan_of, state_of } from "../names";
import { number_at } from "../protocol/schema";
import type { Recording } from "../recorded";
import { clock } from "../units";
import { recorded_lost, recorded_places } from "./ground";
import { Chase } from "../views/chase";
import { EventList } from "../views/events";
import { HealthPanel } from "../views/health";
import { SafetyRow } from "../views/safety";
import { draw_instruments } from "../views/instruments";
import { MapView } from "../views/map";
import { Response } from "../views/response";

export class Moment {
  private readonly names;
  private readonly slider;
  private readonly play;
  private readonly speed;
  private readonly time = el("b", { class: "big" });
  private readonly phase = el("b");
  private readonly map = new MapView();
  private readonly safety;
  private readonly health;
  private readonly events;
  private readonly response;
  private readonly instruments = el("canvas", {
    role: "img",
    "aria-label": "Attitude, airspeed, height, heading",
  });
  private readonly chase_canvas = el("canvas", { role: "img", "aria-label": "The aircraft from behind" });
  private readonly chase_box = el("div", { class: "chase" }, this.chase_canvas);
  private plays = false;
  private chase: Chase | null = null;
  private begun = false;
  private plan_message: unknown;
  private plan: ReturnType<typeof plan_of> = null;
  private last_ms = 0;
  readonly controls: HTMLElement;
  readonly element: HTMLElement;

  constructor(private readonly source: Recording) {
    const { log } = source;
    this.names = names_of(source);
    this.slider = el("input", {
      type: "range",
      min: String(log.begin_s),
      max: String(log.end_s),
      step: "any",
      value: String(log.begin_s),
      "aria-label": "Moment of the flight",
    });
    this.play = el("button", { class: "main", onclick: () => (this.plays = !this.plays) }, "Play");
    this.speed = el(
      "select",
      { "aria-label": "Speed" },
      ...[1, 2, 5, 10, 30].map((s) => el("option", { value: String(s) }, s + " ×")),
    );
    this.health = new HealthPanel(source);
    this.safety = new SafetyRow(source);
    this.events = new EventList(source);
    this.response = new Response(source);
    this.slider.addEventListener("input", () => (source.now = this.slider.valueAsNumber));
    this.controls = el(
      "div",
      { class: "row moment" },
      this.play,
      this.speed,
      this.time,
      el("span", {}, el("i", {}, "phase "), this.phase),
      this.slider,
    );
    this.element = el(
      "div",
      { class: "fly report" },
      this.safety.element,
      this.chase_box,
      this.map.element,
      el("div", { class: "pfd" }, this.instruments),
      this.response.element,
      el("aside", { class: "side" }, this.health.element, this.events.element),
    );
  }

  /** Expensive parts, created at the first use. */
  private begin(): void {
    this.begun = true;
    this.events.begin();
    try {
      this.chase = new Chase(this.chase_canvas);
    } catch {
      fill(this.chase_box, el("p", { class: "absent" }, "No 3-D view: this browser does not support WebGL."));
    }
  }

  update(now_ms: number): void {
    if (!this.begun) this.begin();
    const { source } = this,
      { log } = source;
    const passed = Math.min(0.2, (now_ms - this.last_ms) / 1000);
    if (passed < 0.03) return;
    this.last_ms = now_ms;
    if (this.plays) {
      source.now = Math.min(log.end_s, source.now + passed * Number(this.speed.value));
      this.plays = source.now < log.end_s;
      this.slider.valueAsNumber = source.now;
    }
    say(this.play, this.plays ? "Stop" : "Play");
    say(this.time, clock(source.now));
    say(this.phase, log.phases.filter((p) => p.from_s <= source.now + 1e-6).pop()?.name ?? "–");
    this.show();
    this.response.update(now_ms);
  }

  private show(): void {
    const { source, names } = this;
    const state = state_of(source.latest(names.state)),
      message = source.latest(names.plan);
    if (message !== this.plan_message) {
      this.plan_message = message;
      this.plan = plan_of(message);
    }
    const track = {
      n: source.series(names.state, "position_m.north").v as number[],
      e: source.series(names.state, "position_m.east").v as number[],
    };
    this.map.draw({
      plan: this.plan,
      draft: false,
      state,
      track,
      item: number_at(source.latest(names.progress), "item") ?? -1,
      chosen: -1,
      refused: -1,
      places: recorded_places(source),
      lost: recorded_lost(source, names),
      piece: state?.valid.position ? piece_ahead(source.latest(names.path), state) : [],
    });
    const command = source.latest(names.command),
      attitude = source.latest(names.attitude),
      actuators = source.latest(names.actuators);
    draw_instruments(this.instruments, state, {
      air: number_at(command, "airspeed_mps"),
      up: number_at(command, "height_m"),
      course: number_at(command, "course_rad"),
      roll: number_at(attitude, "roll_rad"),
      pitch: number_at(attitude, "pitch_rad"),
    });
    const x = (path: string) => number_at(actuators, path) ?? 0;
    this.chase?.draw(
      state,
      actuators
        ? {
            aileron: x("aileron_rad"),
            elevator: x("elevator_rad"),
            rudder: x("rudder_rad"),
            throttle: x("throttle_frac"),
          }
        : null,
      this.plan,
    );
    this.health.update(names);
    this.safety.update(names);
  }
}
