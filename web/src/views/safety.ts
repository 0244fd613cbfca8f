// SPDX-License-Identifier: BSD-3-Clause
// The safety row: every flag of the safety monitor, its answer, and the place of the aircraft; and the missing conditions before take-off.
import { el, fill } from "../dom";
import { answers, flags, flags_of, gate_of } from "../flight/alerts";
import { type Names, state_of } from "../names";
import { type Message, number_at } from "../protocol/schema";
import type { Source } from "../source";
import { fixed } from "../units";

type Good = boolean | null; // null: not known, or neither
export interface Item {
  key: string;
  words: string;
  value: string;
  good: Good;
}

const short = (flag: string) => flags[flag]?.short ?? flag.replace(/_/g, " ");
const no_fence = 1e8;

/** One word for each cause; two flags of one cause, such as battery_low and battery_empty, are one item. */
function flag_items(safety: Message): Item[] {
  const items = new Map<string, Item>();
  for (const [flag, up] of flags_of(safety)) {
    const words = short(flag),
      known = items.get(words);
    if (known && !up) continue;
    items.set(words, { key: flag, words, value: "", good: !up });
  }
  const fence = items.get("geofence"),
    margin = Math.min(
      number_at(safety, "fence_margin_m") ?? Infinity,
      number_at(safety, "height_margin_m") ?? Infinity,
    );
  if (fence) fence.value = margin < no_fence ? fixed(margin, 0, "m") : "none";
  if (fence && !(margin < no_fence) && fence.good) fence.good = null;
  return [...items.values()];
}
function without_monitor(source: Source, names: Names): Item[] {
  const s = state_of(source.latest(names.state)),
    rc = source.latest(names.rc);
  const items: Item[] = [
    { key: "monitor", words: "safety monitor", value: "none in this mission", good: null },
  ];
  if (s)
    items.push(
      { key: "estimator_failed", words: "estimate", value: "", good: s.valid.attitude && s.valid.height },
      { key: "gnss_lost", words: "GNSS", value: "", good: s.valid.position },
      { key: "pitot_lost", words: "airspeed", value: "", good: s.valid.airspeed },
    );
  if (rc) items.push({ key: "radio_lost", words: "radio", value: "", good: rc.link === true });
  return items;
}
function place(source: Source, names: Names): Item {
  const ground = source.latest(names.ground),
    contact = source.latest(names.contact),
    status = source.latest(names.status);
  const lies = status?.crashed === true || contact?.crashed === true;
  const where = ground
    ? String(ground.contact)
    : status?.on_ground === true
      ? "ground"
      : status
        ? "air"
        : "unknown";
  const locked = ground?.throttle_locked === true ? ", throttle locked" : "";
  return {
    key: "contact",
    words: "aircraft",
    value: lies
      ? "crashed"
      : (where === "air" ? "in the air" : where === "ground" ? "on the ground" : "unknown") + locked,
    good: lies ? false : null,
  };
}

export function safety_items(source: Source, names: Names): Item[] {
  const safety = source.latest(names.safety);
  if (!safety) return [place(source, names), ...without_monitor(source, names)];
  const answer = String(safety.answer);
  return [
    place(source, names),
    {
      key: "answer",
      words: "answer",
      value: answer === "none" ? "none" : (answers[answer] ?? answer),
      good: answer === "none" ? true : false,
    },
    ...flag_items(safety),
  ];
}

/** Conditions that prevent a take-off: those of the vehicle, and those from the messages here. */
export function missing(source: Source, names: Names, said: string[]): string[] {
  const list = [...said],
    s = state_of(source.latest(names.state)),
    safety = source.latest(names.safety);
  const rc = source.latest(names.rc),
    status = source.latest(names.status);
  const add = (lacks: boolean, words: string, known: RegExp) =>
    lacks && !list.some((w) => known.test(w)) && list.push(words);
  add(!s || !s.valid.attitude, "no attitude", /attitude/);
  add(!s || !s.valid.position, "no position", /position|GNSS/);
  add(!s || !s.valid.height, "no height", /height|barometer/);
  add(rc !== undefined && rc.link !== true, "no radio", /radio/);
  add(
    status !== undefined && status.health !== "ok",
    "flight controller: " + String(status?.health),
    /controller/,
  );
  const gate = gate_of(safety);
  for (const words of gate ?? []) add(true, words, new RegExp(words.split(" ").pop() ?? "", "i"));
  if (safety && !gate)
    for (const [flag, up] of flags_of(safety))
      add(up, short(flag) + ": " + flag.replace(/_/g, " "), new RegExp(short(flag), "i"));
  return list;
}

export class SafetyRow {
  readonly element = el("div", { class: "safety", role: "group", "aria-label": "Safety" });
  private shown = "";
  constructor(private readonly source: Source) {}

  update(names: Names): void {
    const items = safety_items(this.source, names),
      now = JSON.stringify(items);
    if (now === this.shown) return;
    this.shown = now;
    fill(
      this.element,
      ...items.map((i) => {
        const sign = i.good === null ? "" : i.good ? "✓ " : "✕ ";
        const item = el(
          "span",
          { class: "flag " + (i.good === null ? "unknown" : i.good ? "good" : "bad") },
          sign + i.words,
          i.value && el("b", {}, " " + i.value),
        );
        item.dataset.flag = i.key;
        item.dataset.good = String(i.good);
        return item;
      }),
    );
  }
}

/** Shown on the ground, before the flight. */
export class PreArm {
  private readonly list = el("ul", {});
  readonly element = el(
    "section",
    { class: "prearm", hidden: true },
    el("h2", {}, "Before take-off"),
    this.list,
  );
  private shown = "";
  constructor(private readonly source: Source) {}

  update(names: Names, waits: boolean, said: string[]): void {
    this.element.hidden = !waits;
    if (!waits) return;
    const lacks = missing(this.source, names, said),
      now = JSON.stringify(lacks);
    if (now === this.shown) return;
    this.shown = now;
    this.element.dataset.ready = String(lacks.length === 0);
    fill(
      this.list,
      ...(lacks.length === 0
        ? [el("li", { class: "good" }, "✓ ready")]
        : lacks.map((w) => el("li", { class: "bad" }, "✕ " + w))),
    );
  }
}
