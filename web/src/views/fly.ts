// SPDX-License-Identifier: BSD-3-Clause
// Overview of the flight: view from behind, map, instruments, roles, sensors, events.
import { el, fill, mark, say } from "../dom";
import { piece_ahead } from "../flight/piece";
import { type Names, names_of, plan_of, state_of } from "../names";
import type { Flight } from "../protocol/flight";
import { type Message, number_at } from "../protocol/schema";
import { TrackRecorder } from "../track";
import { degrees, digits, fixed } from "../units";
import type { Chase } from "./chase";
import { ground_of } from "./ground";
import { draw_instruments } from "./instruments";
import { MapView } from "./map";
import type { Page } from "./page";
import { EventList } from "./events";
import { HealthPanel } from "./health";
import { RolesPanel } from "./roles";
import type { AlertStrip } from "./alerts";
import { Commands } from "./commands";
import { HandPanel } from "./hand";
import { crashed, on_ground } from "../flight/alerts";
import { places_now } from "./places";
import { PreArm, SafetyRow } from "./safety";

const said_s = 12; // the vehicle repeats its report every 10 s
/** No line break between a number and its unit. */
const whole = (words: string) => words.replace(/ /g, "\u00a0");

/** Without a voltage the battery is not measured, and neither is its current. */
const measured = (status: Message | undefined) => (number_at(status, "battery_volt") ?? 0) > 0;

export class Fly implements Page {
  readonly name = "Fly";
  readonly element: HTMLElement;
  readonly track: TrackRecorder;
  private names: Names;
  private readonly map = new MapView();
  private readonly chase_canvas = el("canvas", { role: "img", "aria-label": "The aircraft from behind" });
  private readonly chase_box = el("div", { class: "chase" }, this.chase_canvas);
  private readonly instruments = el("canvas", {
    role: "img",
    "aria-label": "Attitude, airspeed, height, heading",
  });
  private readonly figures = el("div", { class: "figures" });
  private readonly events: EventList;
  private readonly health: HealthPanel;
  private readonly roles: RolesPanel;
  private readonly safety: SafetyRow;
  private readonly prearm: PreArm;
  private readonly commands: Commands;
  private readonly hand: HandPanel;
  private chase: Chase | null = null;
  private loading = false;
  private plan_message: Message | undefined;
  private plan: ReturnType<typeof plan_of> = null;

  constructor(
    private readonly flight: Flight,
    private readonly alerts: AlertStrip,
  ) {
    this.names = names_of(flight);
    this.track = new TrackRecorder(flight, () => this.names);
    this.events = new EventList(flight);
    this.health = new HealthPanel(flight);
    this.roles = new RolesPanel(flight);
    this.safety = new SafetyRow(flight);
    this.prearm = new PreArm(flight);
    this.commands = new Commands(flight, alerts);
    this.hand = new HandPanel(flight);
    flight.heard_of_channels.push(() => {
      this.names = names_of(flight);
      this.events.begin();
    });
    this.element = el(
      "div",
      { class: "fly" },
      this.safety.element,
      this.chase_box,
      this.map.element,
      el("div", { class: "pfd" }, this.instruments),
      el(
        "div",
        { class: "desk" },
        el("div", { class: "row nowrap" }, this.commands.element, this.hand.flies),
        this.commands.refusal,
        this.hand.element,
        this.figures,
      ),
      el(
        "aside",
        { class: "side" },
        this.prearm.element,
        this.roles.element,
        this.events.element,
        this.health.element,
      ),
    );
  }

  /** The library three is most of the page: the first display does not wait for it. */
  private async load_chase(): Promise<void> {
    if (this.loading) return;
    this.loading = true;
    try {
      const { Chase } = await import("./chase");
      this.chase = new Chase(this.chase_canvas);
    } catch {
      fill(this.chase_box, el("p", { class: "absent" }, "No 3-D view: this browser does not support WebGL."));
    }
  }

  update(): void {
    const f = this.flight,
      names = this.names;
    const state = state_of(f.latest(names.state));
    const plan_message = f.latest(names.plan);
    if (plan_message !== this.plan_message) {
      this.plan_message = plan_message;
      this.plan = plan_of(plan_message);
    }
    const progress = f.latest(names.progress),
      command = f.latest(names.command),
      attitude = f.latest(names.attitude);
    const item = number_at(progress, "item") ?? -1;
    this.map.draw({
      plan: this.plan,
      draft: false,
      state,
      track: this.track,
      ground: ground_of(f.view),
      places: places_now(f, names),
      lost: this.track.lost(),
      crashed: crashed(this.alerts.moment()),
      item,
      chosen: -1,
      refused: -1,
      piece: state?.valid.position ? piece_ahead(f.latest(names.path), state) : [],
    });
    draw_instruments(this.instruments, state, {
      air: number_at(command, "airspeed_mps"),
      up: number_at(command, "height_m"),
      course: number_at(command, "course_rad"),
      roll: number_at(attitude, "roll_rad"),
      pitch: number_at(attitude, "pitch_rad"),
    });
    const actuators = f.latest(names.actuators);
    if (this.chase) {
      const x = (path: string) => number_at(actuators, path) ?? 0;
      this.chase.draw(
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
    } else if (state) {
      void this.load_chase();
    }
    this.show_figures(state, actuators, progress);
    this.roles.update();
    this.health.update(names);
    this.safety.update(names);
    this.commands.update();
    this.hand.update();
    mark(this.figures, "few", this.hand.has);
    const moment = this.alerts.moment(),
      lacks = this.alerts.lacks;
    const lift_offs = number_at(moment.ground, "lift_offs");
    const flown = lift_offs === undefined ? f.now > 20 : lift_offs > 0; // not after a flight
    this.prearm.update(
      names,
      f.view !== null && (on_ground(moment) || !f.view.armed) && !(flown && f.view.armed),
      f.now - lacks.t < said_s ? lacks.what : [],
    );
  }

  /** Mean over the last second, since gusts change the current of a propeller fast. A current that was never above 0 is not measured. */
  private current(): string {
    const { t, v } = this.flight.series(this.names.status, "battery_amp"),
      since = this.flight.now - 1;
    let from = t.length;
    while (from > 0 && (t[from - 1] as number) > since) --from;
    const last = v.slice(from);
    this.has_current = this.has_current || last.some((amp) => amp > 0);
    return this.has_current && last.length > 0
      ? fixed(last.reduce((a, b) => a + b) / last.length, 1, "A")
      : "–";
  }
  private has_current = false;

  private show_figures(
    s: ReturnType<typeof state_of>,
    actuators: Message | undefined,
    progress: Message | undefined,
  ): void {
    const status = this.flight.latest(this.names.status);
    const angle = (path: string) => fixed((number_at(actuators, path) ?? NaN) * degrees, 1, "°");
    const items = number_at(progress, "items");
    const list: [string, string, boolean?][] = [
      ["ground speed", s?.valid.velocity ? fixed(s.ground, 1, "m/s") : "–"],
      ["climb rate", s?.valid.velocity ? fixed(s.climb, 1, "m/s") : "–"],
      ["throttle", fixed((number_at(actuators, "throttle_frac") ?? NaN) * 100, 0, "%")],
      [
        "battery",
        measured(status)
          ? `${whole(fixed(number_at(status, "battery_volt"), 1, "V"))} ${whole(fixed((number_at(status, "battery_frac") ?? NaN) * 100, 0, "%"))}`
          : "not measured",
        measured(status) && (number_at(status, "battery_frac") ?? 1) < 0.2,
      ],
      ["aileron", angle("aileron_rad")],
      ["elevator", angle("elevator_rad")],
      ["rudder", angle("rudder_rad")],
      ["waypoint", items ? `${number_at(progress, "item")} of ${items}` : "–"],
      ["to waypoint", items ? digits(number_at(progress, "distance_m") ?? NaN) + " m" : "–"],
      ["circuits", items ? String(number_at(progress, "circuits") ?? "–") : "–"],
      ["from origin", s?.valid.position ? digits(Math.hypot(s.n, s.e)) + " m" : "–"],
      ["current", measured(status) ? this.current() : "–"],
    ];
    if (this.figures.childElementCount === 0)
      fill(this.figures, ...list.map(([name]) => el("div", {}, el("span", {}, name), el("b", {}))));
    list.forEach(([, value, bad], i) => {
      const cell = this.figures.children[i] as HTMLElement;
      say(cell.lastElementChild as HTMLElement, value);
      mark(cell, "bad", bad === true);
    });
  }
}
