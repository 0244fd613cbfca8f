// SPDX-License-Identifier: BSD-3-Clause
// Flight controller of a flight: firmware, time in control, radio, battery, link, calibration.
import { el } from "../dom";
import { fixed, none } from "../units";
import type { Hardware, Log } from "./model";
import { section, table } from "./tables";

type Row = [words: string, of: (h: Hardware) => string];

const number = (value: number | null | undefined, digits: number, unit: string) =>
  value === null || value === undefined ? none : fixed(value, digits, unit);
const battery = (key: string, unit: string) => (h: Hardware) => number(h.battery?.[key], 2, unit);
const flew = (who: string) => (h: Hardware) => number(h.who_flew_s ? (h.who_flew_s[who] ?? 0) : null, 1, "s");
const link = (key: string) => (h: Hardware) => String(h.link[key] ?? none);

const rows: Row[] = [
  ["firmware", (h) => h.firmware ?? none],
  ["computer in control", flew("computer")],
  ["pilot in control", flew("pilot")],
  ["failsafe active", flew("failsafe")],
  ["armed, neither in control", flew("neither")],
  ["disarmed", flew("disarmed")],
  ["longest gap of the radio, armed", (h) => number(h.radio_age_max_s, 2, "s")],
  ["battery, first", battery("first_volt", "V")],
  ["battery, lowest", battery("least_volt", "V")],
  ["battery, last", battery("last_volt", "V")],
  ["largest current", battery("most_amp", "A")],
  ["frames", link("frames")],
  ["frames lost", link("missing")],
  ["frames damaged", link("bad")],
  ["gaps in inertial samples", link("imu_gaps")],
  ["longest gap", (h) => number(h.link.worst_gap_s, 3, "s")],
  ["commands", link("commands")],
  ["reboots", link("reboots")],
  ["parameters changed in flight", (h) => String(h.parameters_changed)],
];

/** "" without a log of hardware. */
export function hardware_section(logs: Log[]): HTMLElement | string {
  if (!logs.some((log) => log.hardware)) return "";
  const one = logs.length === 1,
    cell = (log: Log, of: (h: Hardware) => string) => (log.hardware ? of(log.hardware) : none);
  const names = [...new Set(logs.flatMap((log) => Object.keys(log.hardware?.calibration ?? {})))];
  const heads = ["", ...logs.map((log) => (one ? "" : log.name))];
  return section(
    "Flight controller",
    el(
      "div",
      { class: "tables" },
      table(
        heads,
        rows.map(([words, of]) => [words, ...logs.map((log) => cell(log, of))]),
      ),
      table(
        ["calibration", ...heads.slice(1)],
        names.map((name) => [name, ...logs.map((log) => cell(log, (h) => h.calibration?.[name] ?? none))]),
      ),
    ),
  );
}
