// SPDX-License-Identifier: BSD-3-Clause
// The plan, on the map and as a table. Every change goes into a draft, which is sent at once or on Upload.
import { el, mark, say } from "../dom";
import { as_group, edits_between } from "../flight/plan_edits";
import { piece_ahead } from "../flight/piece";
import { type Origin, type PlanFile, read_plan_file, write_plan_file } from "../flight/plan_file";
import type { Plan, Point, Waypoint } from "../flight/route";
import { names_of, plan_of, state_of } from "../names";
import type { Answer, Flight } from "../protocol/flight";
import { type Message, number_at } from "../protocol/schema";
import type { TrackRecorder } from "../track";
import { ground_of } from "./ground";
import { places_now } from "./places";
import { MapView } from "./map";
import type { Page } from "./page";
import { PlanTable } from "./plan_table";

const usual_height_m = 70,
  most_at_once = 500; // of a group: the host holds 1024
const round_m = (x: number) => Math.round(x * 10) / 10;

export class PlanPage implements Page {
  readonly name = "Plan";
  readonly element: HTMLElement;
  private readonly map = new MapView();
  private readonly table: PlanTable;
  private readonly at_once = el("input", { type: "checkbox", id: "at_once" });
  private readonly adds = el("input", { type: "checkbox", id: "adds", checked: true });
  private readonly upload = el("button", { class: "main", onclick: () => void this.send() }, "Upload");
  private readonly back = el("button", { onclick: () => this.drop() }, "Discard draft");
  private readonly told = el("p", { class: "faint", role: "status" });
  private readonly refusal = el("p", { class: "refusal", role: "alert", hidden: true });
  private readonly file = el("input", {
    type: "file",
    accept: ".yaml,.yml",
    hidden: true,
    onchange: () => void this.load(),
  });
  private flown: Plan | null = null;
  private message: Message | undefined;
  private draft: Plan | null = null;
  private chosen = -1;
  private refused = -1;
  private dragged = -1;
  private sending = false;
  private sent: Plan | null = null;
  private awaited = -1; // a later revision contains the sent edits
  private loaded: PlanFile | null = null; // the file of the plan, if any
  private decided = false; // whether the default of `at_once` is set

  constructor(
    private readonly flight: Flight,
    private readonly track: TrackRecorder,
  ) {
    this.table = new PlanTable({
      change: (plan) => this.change(plan),
      choose: (i) => this.choose(i),
      fly_to: (i) => void this.fly_to(i),
    });
    this.map.hooks = {
      press: (_at, waypoint) => this.press(waypoint),
      move: (at) => this.drag(at),
      release: (at, moved) => this.release(at, moved),
    };
    this.element = el(
      "div",
      { class: "plan" },
      this.map.element,
      el(
        "aside",
        { class: "side" },
        el(
          "section",
          {},
          el("h2", {}, "Plan"),
          el(
            "div",
            { class: "row" },
            this.upload,
            this.back,
            el("button", { onclick: () => this.file.click() }, "Load file…"),
            el("button", { onclick: () => this.save() }, "Save file"),
            this.file,
          ),
          el(
            "div",
            { class: "row checks" },
            el("label", {}, this.at_once, " send each change at once"),
            el("label", {}, this.adds, " click on the map adds a waypoint"),
          ),
          this.refusal,
          this.told,
        ),
        this.table.element,
      ),
    );
  }

  show(): void {
    this.table.forget();
  }

  private get plan(): Plan | null {
    return this.draft ?? this.flown;
  }

  // ---- changes
  private choose(i: number): void {
    this.chosen = i;
  }
  /** Makes the plan the draft, and sends it if changes are sent at once. */
  private change(plan: Plan): void {
    this.draft = plan;
    this.refused = -1;
    this.refusal.hidden = true;
    if (this.at_once.checked) void this.send();
  }
  private drop(): void {
    this.draft = null;
    this.chosen = this.refused = -1;
    this.refusal.hidden = true;
    this.table.forget();
  }
  private copy(): Plan | null {
    return this.plan ? { ...this.plan, waypoints: this.plan.waypoints.map((w) => ({ ...w })) } : null;
  }

  private press(waypoint: number): boolean {
    this.dragged = waypoint;
    if (waypoint >= 0) this.choose(waypoint);
    return waypoint >= 0;
  }
  private drag(at: Point): void {
    const plan = this.copy(),
      w = plan?.waypoints[this.dragged];
    if (!plan || !w) return;
    Object.assign(w, { north: round_m(at.n), east: round_m(at.e), geodetic: null });
    this.draft = plan;
  }
  private release(at: Point, moved: boolean): void {
    const dragged = this.dragged;
    this.dragged = -1;
    if (dragged >= 0) {
      if (moved && this.draft) this.change(this.draft);
      return;
    }
    const plan = this.copy();
    if (moved || !plan || !this.adds.checked) return;
    const near = plan.waypoints[this.chosen] ?? plan.waypoints[plan.waypoints.length - 1];
    const added: Waypoint = {
      north: round_m(at.n),
      east: round_m(at.e),
      up: near?.up ?? usual_height_m,
      course: null,
      airspeed: 0,
      id: 0,
      geodetic: null,
    };
    const place = this.chosen >= 0 ? this.chosen + 1 : plan.waypoints.length;
    plan.waypoints.splice(place, 0, added);
    this.chosen = place;
    this.change(plan);
  }

  // ---- to the flight
  private async send(): Promise<void> {
    const service = this.flight.request_of_type("PlanEdit");
    if (this.sending || !this.draft || !this.flown) return;
    if (service === "") return this.refuse(-1, "No component of this flight accepts plan edits.");
    const draft = this.draft;
    const edits = as_group(edits_between(this.flown, draft), 1 + Math.floor(Math.random() * 0xfffffffe));
    if (edits.length === 0) return this.drop();
    this.sending = true;
    const revision = number_at(this.message, "revision") ?? 0;
    const answers: Answer[] = [];
    for (let i = 0; i < edits.length; i += most_at_once)
      answers.push(
        ...(await Promise.all(edits.slice(i, i + most_at_once).map((e) => this.flight.ask(service, e.edit)))),
      );
    this.sending = false;
    // one rejected edit rejects its group
    const reasons = answers
      .map((a, i) => ({ ...a, waypoint: edits[i]?.waypoint ?? -1 }))
      .filter((a) => !a.accepted);
    const first = reasons.find((r) => !r.reason.includes("another edit of its group")) ?? reasons[0];
    if (first) return this.refuse(first.waypoint, first.reason);
    this.awaited = revision;
    this.sent = draft;
    if (this.draft !== draft && this.at_once.checked) void this.send(); // changed again in the meantime
  }
  private refuse(waypoint: number, reason: string): void {
    this.refused = waypoint;
    this.refusal.hidden = waypoint >= 0;
    say(this.refusal, "Rejected: " + reason);
    this.table.refuse(waypoint, reason);
  }
  private async fly_to(i: number): Promise<void> {
    const w = this.flown?.waypoints[i];
    if (this.draft || !w)
      return this.refuse(i, "Upload the draft first: only a waypoint of the active plan can be the target.");
    const answer = await this.flight.ask(this.flight.request_of_type("PlanEdit"), {
      kind: "set_current",
      waypoint_id: w.id,
      index: i,
    });
    if (!answer.accepted) this.refuse(i, answer.reason);
  }

  // ---- files
  private async load(): Promise<void> {
    const file = this.file.files?.[0];
    this.file.value = "";
    if (!file || !this.flown) return;
    try {
      const plan = read_plan_file(await file.text(), this.flown, this.origin()),
        flown = this.flown.waypoints;
      plan.waypoints.forEach((w, i) => (w.id = flown[i]?.id ?? 0)); // as edits of the active waypoints: the active leg continues if its waypoints stay
      this.loaded = { waypoints: plan.waypoints.map((w) => ({ ...w })), runway: plan.runway };
      this.at_once.checked = false; // a loaded plan is checked before the upload
      this.chosen = -1;
      this.change(plan);
      this.map.fit();
    } catch (fault) {
      this.refuse(-1, `${file.name}: ${(fault as Error).message}`);
    }
  }
  private origin(): Origin | null {
    const state = this.flight.latest(names_of(this.flight).state);
    if (state?.origin_valid !== true) return null;
    const x = (field: string) => number_at(state, field) ?? 0;
    return {
      latitude: x("origin_latitude_deg"),
      longitude: x("origin_longitude_deg"),
      altitude: x("origin_altitude_m"),
    };
  }
  private save(): void {
    if (!this.plan) return;
    const text = write_plan_file(this.plan, this.flight.view?.mission ?? "plan", this.loaded);
    const url = URL.createObjectURL(new Blob([text], { type: "application/yaml" }));
    el("a", { href: url, download: "plan.yaml" }).click();
    setTimeout(() => URL.revokeObjectURL(url), 10_000);
  }

  update(): void {
    const names = names_of(this.flight),
      f = this.flight;
    const message = f.latest(names.plan);
    if (message && message !== this.message) {
      this.message = message;
      this.flown = plan_of(message);
    }
    if (this.awaited >= 0 && (number_at(this.message, "revision") ?? 0) > this.awaited) {
      this.awaited = -1;
      if (this.draft === this.sent) this.draft = null;
    }
    if (f.view && !this.decided) {
      this.decided = true;
      this.at_once.checked = f.view.io === "sim"; // on a real aircraft only by Upload
    }
    const state = state_of(f.latest(names.state));
    const item = number_at(f.latest(names.progress), "item") ?? -1;
    const draft = this.draft !== null && this.awaited < 0;
    this.map.draw({
      plan: this.plan,
      draft: this.draft !== null,
      state,
      track: this.track,
      ground: ground_of(f.view),
      places: places_now(f, names),
      lost: this.track.lost(),
      item: this.draft ? -1 : item,
      chosen: this.chosen,
      refused: this.refused,
      piece: state?.valid.position ? piece_ahead(f.latest(names.path), state) : [],
    });
    this.table.update(this.plan, this.chosen, this.draft ? -1 : item);
    this.upload.disabled = !draft || this.sending;
    this.back.disabled = this.draft === null;
    mark(this.element, "draft", draft);
    const paused = this.awaited >= 0 && f.view?.paused === true;
    say(
      this.told,
      names.plan === ""
        ? "No component of this flight publishes a plan."
        : this.sending
          ? f.view?.paused
            ? "Sent; the planner answers when the simulation resumes."
            : "Sent; waiting for the planner."
          : paused
            ? "Accepted; active when the simulation resumes."
            : draft
              ? "Draft: the aircraft follows the active plan until the upload."
              : "This plan is active.",
    );
  }
}
