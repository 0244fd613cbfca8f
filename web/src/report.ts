// SPDX-License-Identifier: BSD-3-Clause
// A log to look at: the views of the page with what was recorded, at the moment that the slider is at.
import { el, fill, say } from "./dom";
import { piece_ahead } from "./flight/piece";
import { names_of, plan_of, state_of } from "./names";
import { number_at } from "./protocol/schema";
import { type Log, Recording } from "./recorded";
import { clock } from "./units";
import { Chase } from "./views/chase";
import { EventList } from "./views/events";
import { HealthPanel } from "./views/health";
import { draw_instruments } from "./views/instruments";
import { MapView } from "./views/map";
import { Response } from "./views/response";

const log = JSON.parse(document.getElementById("log")?.textContent ?? "{}") as Log;
const source = await Recording.of(log), names = names_of(source);
const slider = el("input", { type: "range", min: String(log.begin_s), max: String(log.end_s), step: "any", value: String(log.begin_s), "aria-label": "Moment of the flight" });
const play = el("button", { class: "main", onclick: () => (plays = !plays) }, "Play");
const speed = el("select", { "aria-label": "Speed" }, ...[1, 2, 5, 10, 30].map((s) => el("option", { value: String(s) }, s + " ×")));
const time = el("b", { class: "big" }), phase = el("b");
const map = new MapView(), health = new HealthPanel(source), events = new EventList(source), response = new Response(source);
const instruments = el("canvas", { role: "img", "aria-label": "Attitude, airspeed, height, heading" });
const chase_canvas = el("canvas", { role: "img", "aria-label": "The aircraft from behind" }), chase_box = el("div", { class: "chase" }, chase_canvas);
let plays = false, chase: Chase | null = null, plan_message: unknown, plan: ReturnType<typeof plan_of> = null, last_ms = 0;

/** Phases, from the events: when each began. */
const phases: [number, string][] = [];
source.listen("/fulmar/event", (m, t) => {
  if (m.code === "phase_entered") phases.push([t, String(m.name)]);
});

function about(): HTMLElement {
  const facts = { ...log.metadata.fulmar };
  delete facts.epoch_ns;
  const rows: [string, string][] = [["log", log.name], ["time", `${clock(log.begin_s)} to ${clock(log.end_s)}`], ...Object.entries(facts)];
  if (log.fault) rows.push(["ends early", log.fault]);
  for (const [key, value] of Object.entries(log.metadata.result ?? {})) rows.push([key, value]);
  return el("section", {}, el("h2", {}, "Flight"), el("div", { class: "pairs" }, ...rows.flatMap(([k, v]) => [el("span", {}, k), el("b", {}, v)])));
}

function begin(): void {
  document.title = (log.mission || log.name) + " – Fulmar";
  fill(document.body, el("header", {}, el("b", { id: "mission" }, log.mission || log.name), play, speed, time, el("span", {}, el("i", {}, "phase "), phase), slider),
    el("main", { id: "view" }, el("div", { class: "fly report" }, chase_box, map.element, el("div", { class: "pfd" }, instruments), response.element,
      el("aside", { class: "side" }, about(), health.element, events.element))));
  events.begin();
  slider.addEventListener("input", () => (source.now = slider.valueAsNumber));
  try {
    chase = new Chase(chase_canvas);
  } catch {
    fill(chase_box, el("p", { class: "absent" }, "This browser shows no 3-D view: it has no WebGL."));
  }
  requestAnimationFrame(frame);
}

function frame(now_ms: number): void {
  requestAnimationFrame(frame);
  const passed = Math.min(0.2, (now_ms - last_ms) / 1000);
  if (passed < 0.03) return;
  last_ms = now_ms;
  if (plays) {
    source.now = Math.min(log.end_s, source.now + passed * Number(speed.value));
    plays = source.now < log.end_s;
    slider.valueAsNumber = source.now;
  }
  say(play, plays ? "Stop" : "Play");
  say(time, clock(source.now));
  say(phase, phases.filter(([t]) => t <= source.now + 1e-6).pop()?.[1] ?? "–");
  show();
  response.update(now_ms);
}

function show(): void {
  const state = state_of(source.latest(names.state)), message = source.latest(names.plan);
  if (message !== plan_message) {
    plan_message = message;
    plan = plan_of(message);
  }
  const track = { n: source.series(names.state, "position_m.north").v as number[], e: source.series(names.state, "position_m.east").v as number[] };
  map.draw({
    plan, draft: false, state, track, item: number_at(source.latest(names.progress), "item") ?? -1, chosen: -1, refused: -1,
    piece: state?.valid.position ? piece_ahead(source.latest(names.path), state) : [],
  });
  const command = source.latest(names.command), attitude = source.latest(names.attitude), actuators = source.latest(names.actuators);
  draw_instruments(instruments, state, {
    air: number_at(command, "airspeed_mps"), up: number_at(command, "height_m"), course: number_at(command, "course_rad"),
    roll: number_at(attitude, "roll_rad"), pitch: number_at(attitude, "pitch_rad"),
  });
  const x = (path: string) => number_at(actuators, path) ?? 0;
  chase?.draw(state, actuators ? { aileron: x("aileron_rad"), elevator: x("elevator_rad"), rudder: x("rudder_rad"), throttle: x("throttle_frac") } : null, plan);
  health.update(names);
}

begin();
