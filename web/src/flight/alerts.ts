// SPDX-License-Identifier: BSD-3-Clause
// What a pilot has to see at once: what is wrong, what the aircraft does now, what he should do. Without a browser.
import type { Message } from "../protocol/schema";

export type Level = "critical" | "warning" | "info";
export interface Alert {
  key: string; // the same cause has the same key
  level: Level;
  what: string;
  does: string;
  pilot: string;
}
export interface Moment {
  safety: Message | undefined; // SafetyState
  status: Message | undefined; // VehicleStatus
  ground: Message | undefined; // GroundState
  contact: Message | undefined; // ContactTruth
  state: Message | undefined; // VehicleState
  stopped: { name: string; role: string; heir: string }[]; // by guards; who flies in its place
}

/** What the answer of the safety monitor makes of the flight. */
export const answers: Record<string, string> = {
  none: "flies on",
  level: "levels its wings",
  glide: "glides to the nearest place, motor off",
  descend: "descends in a circle, motor off",
  wait: "circles here",
  land: "returns and lands",
  home: "returns home, circles there",
};

interface Words {
  level: Level;
  what: string;
  pilot: string;
}
/** Flags of SafetyState. One that is not listed here is shown by its name. */
export const flags: Record<string, Words & { short: string }> = {
  estimator_failed: {
    level: "critical",
    short: "estimate",
    what: "ESTIMATE NOT VALID",
    pilot: "Take over by sight now. The instruments are wrong.",
  },
  attitude_excessive: {
    level: "critical",
    short: "attitude",
    what: "ATTITUDE EXCESSIVE",
    pilot: "Let it recover. Take over if it does not within seconds.",
  },
  engine_failed: {
    level: "critical",
    short: "motor",
    what: "MOTOR FAILED",
    pilot: "Clear the landing place. Take over only for a better field.",
  },
  drifting: {
    level: "critical",
    short: "drift",
    what: "WIND ABOVE THE AIRSPEED",
    pilot: "Follow it down wind. Land by hand where it is clear.",
  },
  battery_empty: {
    level: "critical",
    short: "battery",
    what: "BATTERY EMPTY",
    pilot: "Clear the landing place. The motor stops soon.",
  },
  link_lost: {
    level: "critical",
    short: "link",
    what: "CONTROLLER LINK LOST",
    pilot: "Take over by radio. Check the cable to the flight controller.",
  },
  gnss_lost: {
    level: "critical",
    short: "GNSS",
    what: "GNSS LOST",
    pilot: "Keep it in sight. The map is an estimate. Land by hand if you can.",
  },
  fence: {
    level: "critical",
    short: "fence",
    what: "FENCE",
    pilot: "Watch the turn back. Take over if it does not turn.",
  },
  radio_lost: {
    level: "warning",
    short: "radio",
    what: "RADIO LOST",
    pilot: "Check the transmitter: power, antenna, distance.",
  },
  engine_weak: {
    level: "warning",
    short: "motor",
    what: "MOTOR WEAK",
    pilot: "Bring it home. Do not climb.",
  },
  pitot_lost: {
    level: "warning",
    short: "airspeed",
    what: "AIRSPEED LOST",
    pilot: "Expect a fast approach. Keep the speed up if you take over.",
  },
  battery_low: { level: "warning", short: "battery", what: "BATTERY LOW", pilot: "Let it land." },
  wind_excessive: {
    level: "warning",
    short: "wind",
    what: "WIND TOO STRONG",
    pilot: "Let it come home. Expect a short, steep landing.",
  },
};
const no_flags = new Set(["airborne", "ready"]); // of SafetyState: no troubles

/** Every flag of SafetyState, also one that is not listed above. */
export function flags_of(safety: Message): [string, boolean][] {
  return Object.entries(safety).filter(
    (f): f is [string, boolean] => typeof f[1] === "boolean" && !no_flags.has(f[0]),
  );
}
/** "not_in_control" -> "NOT IN CONTROL" */
const spelled = (flag: string) => flag.replace(/_/g, " ").toUpperCase();
const is = (m: Message | undefined, field: string) => m?.[field] === true;

export function on_ground(m: Moment): boolean {
  if (m.ground && m.ground.contact !== "unknown") return m.ground.contact === "ground";
  return is(m.status, "on_ground") || (m.safety !== undefined && m.safety.airborne === false);
}
export const crashed = (m: Moment): boolean => is(m.status, "crashed") || is(m.contact, "crashed");

/** What the aircraft does now, as far as its controller and its safety monitor say. */
export function doing(m: Moment): string {
  if (crashed(m)) return "lies on the ground";
  if (is(m.status, "failsafe")) return "flies by the failsafe of its controller";
  if (is(m.status, "override")) return "follows the pilot's sticks";
  if (on_ground(m)) return "is on the ground";
  const answer = String(m.safety?.answer ?? "none");
  return answers[answer] ?? answer.replace(/_/g, " ");
}

function of_vehicle(m: Moment, does: string): Alert[] {
  const part = String(m.contact?.part ?? "");
  if (crashed(m))
    return [
      {
        key: "crashed",
        level: "critical",
        what: "CRASHED" + (part ? `: ${part}` : ""),
        does,
        pilot: "Switch the motor off. The map shows the place.",
      },
    ];
  const list: Alert[] = [];
  if (is(m.status, "failsafe"))
    list.push({
      key: "failsafe",
      level: "critical",
      what: "FAILSAFE OF THE FLIGHT CONTROLLER",
      does,
      pilot: "Take over by radio now.",
    });
  if (m.status?.health === "failed")
    list.push({
      key: "vehicle_failed",
      level: "critical",
      what: "FLIGHT CONTROLLER FAILED",
      does,
      pilot: "Take over by radio now.",
    });
  if (m.status?.health === "degraded")
    list.push({
      key: "vehicle_degraded",
      level: "warning",
      what: "FLIGHT CONTROLLER REPORTS ERRORS",
      does,
      pilot: "Land soon. Read its error bits before the next flight.",
    });
  for (const { name, role, heir } of m.stopped)
    list.push({
      key: "guard " + name,
      level: "warning",
      what: `${name.toUpperCase()} STOPPED BY A GUARD`,
      does: heir ? `flies with ${heir}${role ? " as " + role : ""}` : does,
      pilot: "Land soon. The event list has the reason.",
    });
  return list;
}
/** A mission without a safety monitor still has an estimate. */
function of_estimate(m: Moment, does: string): Alert[] {
  if (m.safety || !m.state || on_ground(m) || crashed(m)) return [];
  const one = (flag: string): Alert => ({
    key: flag,
    does,
    level: flags[flag]?.level ?? "critical",
    what: flags[flag]?.what ?? spelled(flag),
    pilot: flags[flag]?.pilot ?? "",
  });
  if (m.state.attitude_valid === false) return [one("estimator_failed")];
  return m.state.position_valid === false ? [one("gnss_lost")] : [];
}

/** What is wrong in this moment, the worst first. What is wrong on the ground before a flight is no alert: see `not_ready`. */
export function alerts_of(m: Moment): Alert[] {
  const does = doing(m),
    list = [...of_vehicle(m, does), ...of_estimate(m, does)];
  if (m.safety && !on_ground(m) && !crashed(m)) {
    const order = Object.keys(flags),
      up = flags_of(m.safety)
        .filter(([, on]) => on)
        .map(([flag]) => flag);
    up.sort((a, b) => order.indexOf(a) - order.indexOf(b));
    for (const flag of up) {
      const words = flags[flag] ?? {
        level: "warning" as const,
        what: spelled(flag),
        pilot: "Watch it. Take over if it gets worse.",
      };
      list.push({ key: flag, level: words.level, what: words.what, does, pilot: words.pilot });
    }
  }
  return list.sort((a, b) => Number(b.level === "critical") - Number(a.level === "critical"));
}

/** An alert until it is acknowledged, also when its cause is over. */
export interface Held {
  alert: Alert;
  since_s: number; // of flight
  now: boolean; // the cause lasts
  seen: boolean; // acknowledged
  told: boolean; // by an event: nothing but an event, or a flag of the same key, ends it
}
export class AlertBook {
  private held = new Map<string, Held>();

  /** What is wrong now. Causes that are over stay until they are acknowledged. */
  update(alerts: Alert[], now_s: number): void {
    const lies = alerts.some((a) => a.key === "crashed"); // of an aircraft that lies on the ground nothing else lasts
    for (const h of this.held.values()) if (!h.told || lies) Object.assign(h, { now: false, told: false });
    for (const alert of alerts) this.raise(alert, now_s, false);
    for (const [key, h] of this.held) if (!h.now && h.seen) this.held.delete(key);
  }
  /** Of an event: its end is another one, if there is any. */
  raise(alert: Alert, now_s: number, told = true): void {
    const h = this.held.get(alert.key);
    if (h) Object.assign(h, { alert, now: true, told });
    else this.held.set(alert.key, { alert, since_s: now_s, now: true, seen: false, told });
  }
  /** An event says that this cause is over. */
  over(key: string): void {
    const h = this.held.get(key);
    if (h?.told) Object.assign(h, { now: false, told: false });
  }
  acknowledge(key: string): void {
    const h = this.held.get(key);
    if (!h) return;
    h.seen = true;
    if (h.told && key.startsWith("event ")) this.held.delete(key); // it has no end
  }
  /** Those to be acknowledged: the worst first, then the newest. */
  list(): Held[] {
    const rank = (h: Held) => (h.now ? 0 : 2) + (h.alert.level === "critical" ? 0 : 1);
    return [...this.held.values()]
      .filter((h) => !h.seen)
      .sort((a, b) => rank(a) - rank(b) || b.since_s - a.since_s);
  }
  /** Acknowledged, and not over. */
  lasting(): Held[] {
    return [...this.held.values()].filter((h) => h.seen && h.now);
  }
}

/** What a notice is about: a word of its component, the same as the flag of a monitor; "" of other events. */
export const cause_of = (event: Message): string => (event.code === "notice" ? String(event.name ?? "") : "");

/** An event of the host that a pilot has to see; null for all others. `monitor`: whose notices are flags as well. */
export function alert_of_event(event: Message, monitors: string[], does: string): Alert | null {
  const code = String(event.code),
    component = String(event.component),
    words = String(event.words);
  const severity = String(event.severity);
  if (
    severity === "info" ||
    ["guard", "hung", "over_budget", "died", "took_over", "cannot_take_over", "concluded"].includes(code)
  )
    return null; // a stopped component has its own
  if (code === "notice" && (monitors.includes(component) || not_ready(words).length > 0)) return null;
  const level: Level = severity === "warning" ? "warning" : "critical";
  const cause = cause_of(event),
    known = flags[cause];
  if (known) return { key: cause, level: known.level, what: known.what, does, pilot: known.pilot };
  if (cause)
    return { key: cause, level, what: words, does, pilot: level === "critical" ? "Take over by radio." : "" };
  return {
    key: `event ${code} ${component} ${words.replace(/[-\d.]+/g, "#")}`,
    level,
    what: words,
    does,
    pilot: level === "critical" ? "Take over by radio." : "",
  };
}

const gate_words: Record<string, string> = {
  estimator: "estimate not valid",
  position: "no position",
  pitot: "airspeed sensor",
  radio: "no radio",
  battery: "battery low",
  wind: "too much wind",
  fence: "outside the fence, or too near",
  height: "above the ceiling of the fence, or too near",
  motor: "motor gives no thrust",
};
/** What the safety monitor has against a take-off; null of a monitor that does not judge it. */
export function gate_of(safety: Message | undefined): string[] | null {
  const gate = safety?.not_ready;
  if (typeof gate !== "object" || gate === null) return null;
  return Object.entries(gate)
    .filter(([, on]) => on === true)
    .map(([cause]) => gate_words[cause] ?? cause.replace(/_/g, " "));
}

/** "fcu: not ready: no GNSS fix, no height" -> what is missing; [] of other words. */
export function not_ready(words: string): string[] {
  const at = words.indexOf("not ready: ");
  return at < 0
    ? []
    : words
        .slice(at + 11)
        .split(/, |; /)
        .map((w) => w.trim().replace(/\.$/, ""))
        .filter(Boolean);
}
