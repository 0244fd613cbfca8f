// SPDX-License-Identifier: BSD-3-Clause
// The page of a running flight: connects to the server that sent it and shows one view at a time.
import { el, fill, mark, say } from "./dom";
import { names_of } from "./names";
import { Flight } from "./protocol/flight";
import { clock } from "./units";
import { AlertStrip } from "./views/alerts";
import { Fly } from "./views/fly";
import type { Page } from "./views/page";
import { PlanPage } from "./views/plan";
import { Simulation } from "./views/sim";
import { Tune } from "./views/tune";
import { Wires } from "./views/wires";

const flight = new Flight(location.href.replace(/^http/, "ws").replace(/#.*$/, ""));
const lost_for_ms = 300,
  old_ms = 1000,
  behind_ms = 600,
  least_often_ms = 1000;

function byId(id: string): HTMLElement {
  return document.getElementById(id) as HTMLElement;
}

const alerts = new AlertStrip(flight);
const fly = new Fly(flight, alerts),
  tune = new Tune(flight);
flight.heard_of_channels.push(() => alerts.begin());
const pages: Page[] = [fly, new PlanPage(flight, fly.track), tune, new Wires(flight), new Simulation(flight)];
let shown: Page | null = null;

function show(page: Page): void {
  if (page === shown) return;
  shown?.hide?.();
  shown = page;
  fill(byId("view"), page.element);
  page.show?.();
  for (const button of byId("tabs").querySelectorAll("button")) {
    const here = button.dataset.page === page.name;
    button.setAttribute("aria-selected", String(here));
    button.tabIndex = here ? 0 : -1;
  }
  byId("view").setAttribute("aria-label", page.name);
  history.replaceState(null, "", "#" + page.name.toLowerCase().replace(/ /g, "_"));
}

function tabs(): void {
  const bar = byId("tabs");
  pages.forEach((page, i) => {
    const button = el("button", { role: "tab", title: `Key ${i + 1}`, onclick: () => show(page) }, page.name);
    button.dataset.page = page.name;
    bar.append(button);
  });
  bar.addEventListener("keydown", (e) => {
    const step = e.key === "ArrowRight" ? 1 : e.key === "ArrowLeft" ? -1 : 0;
    if (step === 0 || !shown) return;
    show(pages[(pages.indexOf(shown) + step + pages.length) % pages.length] as Page);
    bar.querySelector<HTMLElement>("[aria-selected=true]")?.focus();
  });
  document.addEventListener("keydown", (e) => {
    if (e.ctrlKey || e.metaKey || e.altKey || (e.target as HTMLElement).closest("input, select, textarea"))
      return;
    const page = pages[Number(e.key) - 1];
    if (page) show(page);
  });
}

/** Shows a banner while the flight does not answer. */
function link(now_ms: number): void {
  const { up, since_ms, why } = flight.link;
  const down = !up && now_ms - since_ms > lost_for_ms;
  mark(document.body, "lost", down);
  const banner = byId("banner");
  banner.hidden = !down;
  const seconds = Math.max(0, Math.floor((now_ms - since_ms) / 1000));
  const ended = why.includes("ended");
  const what =
    flight.view === null ? "No answer from the flight" : ended ? "The flight has ended" : "Connection lost";
  const shown =
    flight.view === null ? "" : ended ? " The page shows its last data." : " The displayed data is old.";
  mark(banner, "ended", ended); // an end is no fault
  if (down)
    say(
      banner,
      `✕ ${what}, ${seconds} s ago.${shown} ${ended ? "Waiting for the next flight." : "Reconnecting."}`,
    );
}

/** Age of the displayed data: the largest of transport, this browser, the estimate itself, and the time since the last frame. */
function shown_age_ms(now_ms: number): number {
  const view = flight.view,
    state = names_of(flight).state,
    stands = !view || view.paused || view.over;
  const sample = stands || state === "" ? 0 : flight.age(state) / Math.max(1, view.speed);
  return Math.max(flight.age_ms(), Number.isFinite(sample) ? 1000 * sample : 0, now_ms - drawn_ms);
}
function age(now_ms: number): void {
  const field = byId("age"),
    ms = Math.max(0, shown_age_ms(now_ms)),
    old = ms > old_ms && flight.view !== null;
  say(
    field,
    flight.view === null ? "–" : ms < 10_000 ? (ms / 1000).toFixed(1) + " s" : Math.round(ms / 1000) + " s",
  );
  field.dataset.ms = String(Math.round(ms));
  mark(field, "old", old);
  mark(document.body, "stale", old);
}

function head(): void {
  const view = flight.view;
  if (!view) return;
  say(byId("mission"), view.mission);
  document.title = (alerts.element.dataset.level === "critical" ? "✕ " : "") + view.mission + " – Fulmar"; // also in the title of a tab in the background
  say(byId("phase"), view.phase);
  say(byId("clock"), clock(flight.now));
  say(byId("armed"), view.armed ? "armed" : "disarmed");
  mark(byId("armed"), "warn", view.armed && view.io !== "sim");
  const pace = view.paused
    ? "paused"
    : view.io !== "sim"
      ? "hardware"
      : view.speed === 0
        ? "max speed"
        : view.speed === 1
          ? "real time"
          : view.speed + " ×";
  say(byId("pace"), pace);
  mark(byId("pace"), "warn", view.paused);
}

flight.on_link = () => link(performance.now());

let drawn_ms = performance.now(); // when the views were drawn last
let toast_timer = 0;
flight.on_status = (level, words) => {
  const toast = byId("toast");
  say(toast, (level >= 2 ? "✕ " : "⚠ ") + words);
  toast.hidden = false;
  clearTimeout(toast_timer);
  toast_timer = window.setTimeout(() => (toast.hidden = true), 6000);
};

tabs();
const wanted = location.hash.slice(1);
show(pages.find((p) => p.name.toLowerCase().replace(/ /g, "_") === wanted) ?? (pages[0] as Page));
let last_ms = 0,
  took_ms = 0; // by the last frame
function frame(now_ms: number): void {
  requestAnimationFrame(frame);
  // about 30 frames per second; a late browser first reads the received data and draws a fifth of the time
  const rest_ms = flight.late_ms() > behind_ms ? Math.max(least_often_ms, 4 * took_ms) : 30;
  const begun_ms = performance.now();
  if (begun_ms - last_ms < rest_ms) return;
  link(begun_ms);
  head();
  alerts.update();
  fly.track.update(); // in every view
  shown?.update(now_ms);
  drawn_ms = last_ms = performance.now();
  took_ms = drawn_ms - begun_ms;
}
requestAnimationFrame(frame);
setInterval(() => tune.record(), 1000);
setInterval(() => {
  link(performance.now()); // also while the browser requests no frames
  age(performance.now());
}, 200);
byId("alerts").replaceWith(alerts.element);
