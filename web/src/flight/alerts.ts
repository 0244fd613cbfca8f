// SPDX-License-Identifier: BSD-3-Clause
// Alerts for the pilot: fault, response of the aircraft, action for the pilot. Without a browser.
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
  stopped: { name: string; role: string; heir: string }[]; // by guards; `heir` is the component now active
}

/** Response of the aircraft to each answer of the safety monitor. */
export const answers: Record<string, string> = {
  none: "continues the mission",
  level: "levels its wings",
  glide: "glides to the nearest landing place, motor off",
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
    short: "geofence",
    what: "GEOFENCE",
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
const no_flags = new Set(["airborne", "ready"]); // of SafetyState: these are no faults

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

/** Present action of the aircraft, from flight controller and safety monitor. */
export function doing(m: Moment): string {
  if (crashed(m)) return "is on the ground after a crash";
  if (is(m.status, "failsafe")) return "executes the failsafe of the flight controller";
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
      does: heir ? `uses ${heir}${role ? " as " + role : ""}` : does,
      pilot: "Land soon. The event list has the reason.",
    });
  return list;
}
/** Alerts from the validity of the estimate, without a safety monitor. */
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

/** Present faults, the most severe first. Faults on the ground before a flight are no alerts: see `not_ready`. */
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

/** An alert until it is acknowledged, also after its cause has ended. */
export interface Held {
  alert: Alert;
  since_s: number; // of flight
  now: boolean; // the cause is present
  seen: boolean; // acknowledged
  told: boolean; // raised by an event: only an event or a flag of the same key ends it
}
export class AlertBook {
  private held = new Map<string, Held>();

  /** Present faults. Alerts whose cause has ended stay until they are acknowledged. */
  update(alerts: Alert[], now_s: number): void {
    const lies = alerts.some((a) => a.key === "crashed"); // after a crash all other causes end
    for (const h of this.held.values()) if (!h.told || lies) Object.assign(h, { now: false, told: false });
    for (const alert of alerts) this.raise(alert, now_s, false);
    for (const [key, h] of this.held) if (!h.now && h.seen) this.held.delete(key);
  }
  /** Alert of an event; another event may end it. */
  raise(alert: Alert, now_s: number, told = true): void {
    const h = this.held.get(alert.key);
    if (h) Object.assign(h, { alert, now: true, told });
    else this.held.set(alert.key, { alert, since_s: now_s, now: true, seen: false, told });
  }
  /** An event reports the end of this cause. */
  over(key: string): void {
    const h = this.held.get(key);
    if (h?.told) Object.assign(h, { now: false, told: false });
  }
  acknowledge(key: string): void {
    const h = this.held.get(key);
    if (!h) return;
    h.seen = true;
    if (h.told && key.startsWith("event ")) this.held.delete(key); // no event ends it
  }
  /** Alerts to acknowledge: the most severe first, then the newest. */
  list(): Held[] {
    const rank = (h: Held) => (h.now ? 0 : 2) + (h.alert.level === "critical" ? 0 : 1);
    return [...this.held.values()]
      .filter((h) => !h.seen)
      .sort((a, b) => rank(a) - rank(b) || b.since_s - a.since_s);
  }
  /** Acknowledged alerts whose cause is present. */
  lasting(): Held[] {
    return [...this.held.values()].filter((h) => h.seen && h.now);
  }
}

/** Cause of a notice, the same word as the flag of a monitor; "" for other events. */
export const cause_of = (event: Message): string => (event.code === "notice" ? String(event.name ?? "") : "");

/** Alert of a host event; null for events that need none. `monitors`: components whose notices are flags as well. */
export function alert_of_event(event: Message, monitors: string[], does: string): Alert | null {
  const code = String(event.code),
    component = String(event.component),
    words = String(event.words);
  const severity = String(event.severity);
  if (
    severity === "info" ||
    ["guard", "hung", "over_budget", "died", "took_over", "cannot_take_over", "concluded"].includes(code)
  )
    return null; // a stopped component has an alert of its own
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
  pitot: "no valid airspeed",
  radio: "no radio",
  battery: "battery low",
  wind: "excessive wind",
  fence: "outside the geofence or near its border",
  height: "above the geofence or near its ceiling",
  motor: "motor gives no thrust",
};
/** Conditions of the safety monitor that prevent a take-off; null without such a check. */
export function gate_of(safety: Message | undefined): string[] | null {
  const gate = safety?.not_ready;
  if (typeof gate !== "object" || gate === null) return null;
  return Object.entries(gate)
    .filter(([, on]) => on === true)
    .map(([cause]) => gate_words[cause] ?? cause.replace(/_/g, " "));
}

/** "fcu: not ready: no GNSS fix, no height" -> the missing conditions; [] for other texts. */
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
