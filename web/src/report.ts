// SPDX-License-Identifier: BSD-3-Clause
// Report of one log, or of several side by side: a part for reading and printing, and each flight at any moment.
import { colours, el, fill, mark } from "./dom";
import { Recording } from "./recorded";
import { Moment } from "./report/moment";
import type { ReportData } from "./report/model";
import { Summary } from "./report/summary";

const data = JSON.parse(document.getElementById("log")?.textContent ?? "{}") as ReportData;
document.getElementById("log")?.remove();
const sources = await Promise.all(data.logs.map((log) => Recording.of(log)));
const missions = [...new Set(data.logs.map((log) => log.mission || log.name))].join(", ");
const summary = new Summary(data, sources),
  moments = new Map<Recording, Moment>();
const which = el(
  "select",
  { "aria-label": "Log" },
  ...data.logs.map((log, i) => el("option", { value: String(i) }, log.name)),
);
const controls = el("div", { class: "controls" }),
  view = el("main", { id: "view", role: "tabpanel", tabIndex: -1 });
const tabs = ["Report", "Flight"].map((name, i) =>
  el("button", { role: "tab", title: `Key ${i + 1}`, onclick: () => show(i) }, name),
);
let shown = -1;

/** View of the selected flight, created at its first use. */
function moment(): Moment {
  const source = sources[Number(which.value)] as Recording;
  let made = moments.get(source);
  if (!made) moments.set(source, (made = new Moment(source)));
  return made;
}
function show(tab: number, again = false): void {
  if (tab === shown && !again) return;
  shown = tab;
  tabs.forEach((button, i) => {
    button.setAttribute("aria-selected", String(i === tab));
    button.tabIndex = i === tab ? 0 : -1;
  });
  view.setAttribute("aria-label", tabs[tab]?.textContent ?? "");
  mark(view, "reads", tab === 0);
  fill(view, tab === 0 ? summary.element : moment().element);
  fill(controls, tab === 1 && sources.length > 1 ? which : null, tab === 1 ? moment().controls : null);
  if (tab === 0) summary.draw();
}

/** Paper has a white background and a fixed width. */
function to_paper(paper: boolean): void {
  mark(document.documentElement, "paper", paper);
  colours.forget();
  if (paper) show(0);
  summary.draw();
}

function frame(now_ms: number): void {
  requestAnimationFrame(frame);
  if (shown === 1) moment().update(now_ms);
}

document.title = missions + " – Fulmar";
const bar = el("div", { id: "tabs", role: "tablist", "aria-label": "Views" }, ...tabs);
fill(document.body, el("header", {}, el("b", { id: "mission" }, missions), bar, controls), view);
await summary.build();
show(0);
which.addEventListener("change", () => show(1, true));
bar.addEventListener("keydown", (e) => {
  if (e.key !== "ArrowRight" && e.key !== "ArrowLeft") return;
  show(1 - shown);
  tabs[shown]?.focus();
});
document.addEventListener("keydown", (e) => {
  if (e.ctrlKey || e.metaKey || e.altKey || (e.target as HTMLElement).closest("input, select, textarea"))
    return;
  if (e.key === "1" || e.key === "2") show(Number(e.key) - 1);
});
addEventListener("beforeprint", () => to_paper(true));
addEventListener("afterprint", () => to_paper(false));
requestAnimationFrame(frame);
