// SPDX-License-Identifier: BSD-3-Clause
// A map: north up, metres from the origin, on a canvas, over the tiles of the mission. Dragging moves it; the wheel and + - zoom.
import { colours, el, say, sharp } from "../dom";
import { type Plan, type Point, Route } from "../flight/route";
import { type Spot, label_side } from "../flight/labels";
import type { State } from "../names";
import type { Places } from "../flight/places";
import type { Ground } from "./ground";
import {
  type Lost,
  draw_aircraft,
  draw_crash,
  draw_home,
  draw_lost,
  draw_places,
  draw_scale,
  draw_wind,
  words_on,
} from "./marks";
import { digits } from "../units";

export type { Lost } from "./marks";
export interface Track {
  n: number[];
  e: number[];
}
export interface Scene {
  plan: Plan | null;
  draft: boolean; // the plan is not the active one
  state: State | null;
  track: Track;
  item: number; // target waypoint, from 0; -1: none
  chosen: number; // selected waypoint; -1: none
  refused: number; // waypoint whose last edit was rejected; -1: none
  ground?: Ground | null; // tiles below the map
  places?: Places | null; // geofence, runway, landing places
  crashed?: boolean;
  lost?: Lost | null; // while the position is invalid
  piece: Point[]; // of the active path
  tracks?: (Track & { colour: string; width: number })[]; // of a report: the complete track of each flight
}
export interface Hooks {
  press?(at: Point, waypoint: number): boolean; // true: the map ignores the press
  move?(at: Point): void;
  release?(at: Point, moved: boolean): void;
}

const steps = [1, 2, 5];
const click_px = 4,
  reach_px = 14,
  margin_px = 56,
  most_labels = 100;

export class MapView {
  readonly canvas = el("canvas", {
    class: "map",
    tabIndex: 0,
    role: "img",
    "aria-label": "Map: plan, track and aircraft",
  });
  readonly element: HTMLElement;
  private readonly attribution = el("div", { class: "attribution", hidden: true });
  hooks: Hooks = {};
  private centre: Point = { n: 0, e: 0 };
  private px_per_m = 0;
  private follows = false;
  private touched = false;
  private fitted = ""; // canvas size at the last fit
  private plan_drawn: { plan: Plan; legs: { to: number; points: Point[] }[] } | null = null;
  private seen: Scene | null = null;

  constructor() {
    const button = (words: string, label: string, onclick: () => void) =>
      el("button", { class: "small", onclick, "aria-label": label, title: label }, words);
    this.element = el(
      "div",
      { class: "mapbox" },
      this.canvas,
      this.attribution,
      el(
        "div",
        { class: "mapkeys" },
        button("+", "Zoom in", () => this.zoom(1.4)),
        button("−", "Zoom out", () => this.zoom(1 / 1.4)),
        button("Fit", "Show the complete plan", () => this.fit()),
        button("Follow", "Keep the aircraft in the centre", () => (this.follows = !this.follows)),
      ),
    );
    this.canvas.addEventListener("pointerdown", (e) => this.press(e));
    this.canvas.addEventListener(
      "wheel",
      (e) => {
        e.preventDefault();
        this.zoom(Math.exp(-e.deltaY * 0.0015), { x: e.offsetX, y: e.offsetY });
      },
      { passive: false },
    );
    this.canvas.addEventListener("keydown", (e) => this.key(e));
  }

  // ---- coordinates
  get width(): number {
    return this.canvas.clientWidth;
  }
  get height(): number {
    return this.canvas.clientHeight;
  }
  to_screen(p: Point): { x: number; y: number } {
    return {
      x: this.width / 2 + (p.e - this.centre.e) * this.px_per_m,
      y: this.height / 2 - (p.n - this.centre.n) * this.px_per_m,
    };
  }
  to_ground(x: number, y: number): Point {
    return {
      n: this.centre.n - (y - this.height / 2) / this.px_per_m,
      e: this.centre.e + (x - this.width / 2) / this.px_per_m,
    };
  }
  private zoom(factor: number, at = { x: this.width / 2, y: this.height / 2 }): void {
    this.touched = true;
    const fixed_point = this.to_ground(at.x, at.y);
    this.px_per_m = Math.min(50, Math.max(0.002, this.px_per_m * factor));
    const moved = this.to_ground(at.x, at.y);
    this.centre = { n: this.centre.n + fixed_point.n - moved.n, e: this.centre.e + fixed_point.e - moved.e };
  }
  fit(): void {
    this.follows = false;
    this.fitted = `${this.width} ${this.height}`;
    const points: Point[] = [{ n: 0, e: 0 }];
    for (const w of this.seen?.plan?.waypoints ?? []) points.push({ n: w.north, e: w.east });
    if (this.seen?.state?.valid.position) points.push(this.seen.state);
    const places = this.seen?.places;
    points.push(...(places?.fence ?? []), ...(places?.places ?? []));
    for (const track of this.seen?.tracks ?? [])
      track.n.forEach((n, i) => Number.isFinite(n) && points.push({ n, e: track.e[i] as number }));
    const n = points.map((p) => p.n),
      e = points.map((p) => p.e);
    const least = (list: number[]) => list.reduce((a, b) => Math.min(a, b)),
      largest = (list: number[]) => list.reduce((a, b) => Math.max(a, b));
    const [n0, n1, e0, e1] = [least(n), largest(n), least(e), largest(e)];
    this.centre = { n: (n0 + n1) / 2, e: (e0 + e1) / 2 };
    const room = (px: number, m: number) => Math.max(1, px - 2 * margin_px) / Math.max(m, 100);
    this.px_per_m = Math.min(room(this.height, n1 - n0), room(this.width, e1 - e0));
  }

  // ---- pointer and keys
  private waypoint_at(x: number, y: number): number {
    let best = -1,
      nearest = reach_px;
    this.seen?.plan?.waypoints.forEach((w, i) => {
      const at = this.to_screen({ n: w.north, e: w.east });
      const distance = Math.hypot(at.x - x, at.y - y);
      if (distance < nearest) [best, nearest] = [i, distance];
    });
    return best;
  }
  private press(e: PointerEvent): void {
    if (e.button !== 0) return;
    this.canvas.setPointerCapture(e.pointerId);
    const box = this.canvas.getBoundingClientRect();
    const at = (event: PointerEvent) => ({ x: event.clientX - box.left, y: event.clientY - box.top });
    const begin = at(e),
      centre = { ...this.centre };
    const taken =
      this.hooks.press?.(this.to_ground(begin.x, begin.y), this.waypoint_at(begin.x, begin.y)) ?? false;
    let moved = false;
    const move = (event: PointerEvent) => {
      const now = at(event);
      moved = moved || Math.hypot(now.x - begin.x, now.y - begin.y) > click_px;
      if (!moved) return;
      if (taken) return this.hooks.move?.(this.to_ground(now.x, now.y));
      this.follows = false;
      this.touched = true;
      this.centre = {
        n: centre.n + (now.y - begin.y) / this.px_per_m,
        e: centre.e - (now.x - begin.x) / this.px_per_m,
      };
    };
    const up = (event: PointerEvent) => {
      this.canvas.removeEventListener("pointermove", move);
      this.canvas.removeEventListener("pointerup", up);
      this.canvas.removeEventListener("pointercancel", up);
      const now = at(event);
      if (taken || !moved) this.hooks.release?.(this.to_ground(now.x, now.y), moved);
    };
    this.canvas.addEventListener("pointermove", move);
    this.canvas.addEventListener("pointerup", up);
    this.canvas.addEventListener("pointercancel", up);
  }
  private key(e: KeyboardEvent): void {
    const step = 60 / this.px_per_m;
    const moves: Record<string, () => void> = {
      ArrowUp: () => (this.centre.n += step),
      ArrowDown: () => (this.centre.n -= step),
      ArrowLeft: () => (this.centre.e -= step),
      ArrowRight: () => (this.centre.e += step),
      "+": () => this.zoom(1.4),
      "-": () => this.zoom(1 / 1.4),
      f: () => this.fit(),
    };
    const move = moves[e.key];
    if (!move || e.ctrlKey || e.metaKey || e.altKey) return;
    e.preventDefault();
    this.touched = true;
    this.follows = this.follows && !e.key.startsWith("Arrow");
    move();
  }

  // ---- drawing
  draw(scene: Scene): void {
    const comes = (had: unknown, has: unknown) => !had && Boolean(has);
    const news =
      this.px_per_m === 0 ||
      (!this.touched &&
        (comes(this.seen?.plan, scene.plan) ||
          comes(this.seen?.places?.fence.length, scene.places?.fence.length)));
    this.seen = scene;
    if (this.width === 0) return;
    const resized = !this.touched && this.fitted !== "" && this.fitted !== `${this.width} ${this.height}`;
    if ((news || resized) && (scene.plan || scene.state || scene.tracks)) this.fit(); // until the user moves the map
    if (this.px_per_m === 0) return;
    const middle = scene.lost?.at ?? scene.state;
    if (this.follows && middle) this.centre = { n: middle.n, e: middle.e };
    // for tests and assistive tools: north and east of the centre in m, pixels per metre
    this.canvas.dataset.view = [this.centre.n, this.centre.e, this.px_per_m].join();
    const g = sharp(this.canvas);
    g.fillStyle = colours.get("ground");
    g.fillRect(0, 0, this.width, this.height);
    g.lineJoin = g.lineCap = "round";
    const step = this.grid(g);
    scene.ground?.draw(g, this.to_ground(0, this.height), this.to_ground(this.width, 0), this.px_per_m, (p) =>
      this.to_screen(p),
    );
    this.attribution.hidden = !scene.ground?.attribution;
    say(this.attribution, scene.ground?.attribution ?? "");
    draw_scale(g, step, this.px_per_m, this, Boolean(scene.ground));
    if (scene.places) draw_places(g, scene.places, (p) => this.to_screen(p), this.px_per_m);
    this.route(g, scene);
    this.trail(g, scene.track); // above the route, which hides it on the path
    for (const track of scene.tracks ?? []) this.trail(g, track, track.colour, track.width);
    g.strokeStyle = colours.get("track");
    g.lineWidth = 3;
    g.setLineDash([1, 6]);
    this.line(g, scene.piece);
    g.setLineDash([]);
    const aircraft = () =>
      scene.state?.valid.position && draw_aircraft(g, scene.state.yaw, this.to_screen(scene.state));
    if (scene.tracks) aircraft(); // in a report below the waypoint numbers
    this.waypoints(g, scene);
    if (!scene.places?.places.length) draw_home(g, this.to_screen({ n: 0, e: 0 }));
    if (scene.lost) draw_lost(g, scene.lost, (p) => this.to_screen(p), this.px_per_m);
    this.data(scene);
    if (!scene.tracks) aircraft();
    if (scene.crashed && scene.state) draw_crash(g, this.to_screen(scene.lost?.at ?? scene.state));
    if (scene.state?.valid.wind) draw_wind(g, scene.state, this.height);
  }
  /** Contents of the map, for tests and assistive tools. */
  private data(scene: Scene): void {
    const { places, lost } = scene,
      data = this.canvas.dataset;
    data.fence = String(places?.fence.length ?? 0);
    data.places = String(places?.places.length ?? 0);
    data.runway = places?.runway ? String(Math.round(places.runway.length)) : "";
    data.aircraft = scene.state?.valid.position ? "known" : lost ? "lost" : "none";
    data.crashed = String(scene.crashed === true);
    data.lost = lost ? [lost.at.n, lost.at.e, lost.radius ?? ""].join() : "";
  }
  private grid(g: CanvasRenderingContext2D): number {
    let step = 1;
    for (let i = 0; step * this.px_per_m < 55; ++i) step = (steps[i % 3] as number) * 10 ** Math.floor(i / 3);
    const low = this.to_ground(0, this.height),
      high = this.to_ground(this.width, 0);
    g.strokeStyle = colours.get("grid");
    g.fillStyle = colours.get("faint");
    g.lineWidth = 1;
    g.font = "11px system-ui";
    g.beginPath();
    for (let e = Math.ceil(low.e / step) * step; e < high.e; e += step) {
      const x = Math.round(this.to_screen({ n: 0, e }).x) + 0.5;
      g.moveTo(x, 0);
      g.lineTo(x, this.height);
    }
    for (let n = Math.ceil(low.n / step) * step; n < high.n; n += step) {
      const y = Math.round(this.to_screen({ n, e: 0 }).y) + 0.5;
      g.moveTo(0, y);
      g.lineTo(this.width, y);
    }
    g.stroke();
    return step;
  }
  private line(g: CanvasRenderingContext2D, points: Point[]): void {
    g.beginPath();
    points.forEach((p, i) => {
      const at = this.to_screen(p);
      if (i === 0) g.moveTo(at.x, at.y);
      else g.lineTo(at.x, at.y);
    });
    g.stroke();
  }
  private trail(g: CanvasRenderingContext2D, track: Track, colour = "track", width = 2): void {
    g.strokeStyle = colours.get(colour);
    g.lineWidth = width;
    g.beginPath();
    let last = { x: 1e9, y: 1e9 };
    for (let i = 0; i < track.n.length; ++i) {
      const at = this.to_screen({ n: track.n[i] as number, e: track.e[i] as number });
      if (Math.abs(at.x - last.x) + Math.abs(at.y - last.y) < 1.5 && i + 1 < track.n.length) continue;
      if (i === 0) g.moveTo(at.x, at.y);
      else g.lineTo(at.x, at.y);
      last = at;
    }
    g.stroke();
  }
  private route(g: CanvasRenderingContext2D, scene: Scene): void {
    const plan = scene.plan;
    if (!plan) return;
    if (this.plan_drawn?.plan !== plan) this.plan_drawn = { plan, legs: new Route(plan).legs() };
    g.setLineDash(scene.draft ? [7, 5] : []);
    for (const leg of this.plan_drawn.legs) {
      g.strokeStyle = colours.get("route");
      g.lineWidth = leg.to === scene.item && !scene.draft ? 4 : 2;
      this.line(g, leg.points);
    }
    g.setLineDash([]);
  }
  private waypoints(g: CanvasRenderingContext2D, scene: Scene): void {
    const plan = scene.plan;
    if (!plan) return;
    g.font = "bold 12px system-ui";
    g.textBaseline = "middle";
    const places = plan.waypoints.map((w) => this.to_screen({ n: w.north, e: w.east }));
    plan.waypoints.forEach((w, i) => {
      const at = places[i] as Spot;
      if (at.x < -50 || at.y < -50 || at.x > this.width + 50 || at.y > this.height + 50) return;
      const radius = i === scene.chosen ? 12 : 10;
      g.beginPath();
      g.arc(at.x, at.y, radius, 0, 2 * Math.PI);
      g.fillStyle =
        i === scene.refused
          ? colours.get("bad")
          : i === scene.item
            ? colours.get("route")
            : colours.get("panel");
      g.fill();
      g.strokeStyle = i === scene.chosen ? colours.get("text") : colours.get("route");
      g.lineWidth = i === scene.chosen ? 3 : 2;
      g.stroke();
      g.fillStyle = i === scene.refused || i === scene.item ? colours.get("on_colour") : colours.get("text");
      g.textAlign = "center";
      g.fillText(String(i), at.x, at.y + 0.5);
      if (places.length <= most_labels || i === scene.chosen)
        this.height_label(g, digits(w.up) + " m", places, i, plan.end === "circuit", i === scene.chosen);
      g.strokeStyle = g.fillStyle = colours.get("text");
      g.lineWidth = 2;
      if (w.course === null) return;
      g.beginPath();
      g.moveTo(at.x + 12 * Math.sin(w.course), at.y - 12 * Math.cos(w.course));
      g.lineTo(at.x + 26 * Math.sin(w.course), at.y - 26 * Math.cos(w.course));
      g.stroke();
    });
  }
  /** Of waypoint `i`, away from its legs; left out where it would cover another waypoint, unless the waypoint is selected. */
  private height_label(
    g: CanvasRenderingContext2D,
    words: string,
    places: Spot[],
    i: number,
    closed: boolean,
    chosen: boolean,
  ): void {
    const at = places[i] as Spot,
      count = places.length,
      half = g.measureText(words).width / 2;
    const next = [i - 1, i + 1]
      .map((k) => places[closed ? (k + count) % count : k])
      .filter((p) => p !== undefined);
    const side = label_side(at, next),
      x = at.x + side.x * (15 + half),
      y = at.y + side.y * 21;
    if (!chosen && places.some((p, k) => k !== i && Math.abs(p.y - y) < 17 && Math.abs(p.x - x) < half + 12))
      return;
    g.textAlign = "center";
    words_on(g, words, x, y);
  }
}
