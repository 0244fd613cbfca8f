// SPDX-License-Identifier: BSD-3-Clause
// Displayed numbers: degrees for radians, a unit after every number, an en dash for a missing value.

export const degrees = 180 / Math.PI;
export const none = "–";

/** Significant digits: 0.0123, 1.23, 12.3, 123. */
export function digits(value: number): string {
  if (!Number.isFinite(value)) return none;
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e6)) return value.toExponential(2);
  const places = size >= 100 ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : size >= 0.1 ? 3 : 4;
  return String(Number(value.toFixed(places)));
}

/** Text of an input field: at most six significant digits. */
export function plain(value: number): string {
  return Number.isFinite(value) ? String(Number(value.toPrecision(6))) : "";
}

export function fixed(value: number | undefined, places: number, unit: string): string {
  if (value === undefined || !Number.isFinite(value)) return none;
  const text = value.toFixed(places);
  return (
    (Number(text) === 0 ? text.replace("-", "") : text) +
    (unit === "" || unit.startsWith("°") ? unit : " " + unit)
  );
}

/** Displayed unit of a parameter or field, factor from the original unit, and unit to send for a typed value. */
export function shown_unit(unit: string): { unit: string; scale: number; typed: string } {
  if (unit === "rad") return { unit: "°", scale: degrees, typed: "deg" };
  if (unit === "rad/s") return { unit: "°/s", scale: degrees, typed: "deg/s" };
  return { unit: unit.replace("m/s2", "m/s²"), scale: 1, typed: "" };
}

/** "70 m", "12°" */
export function with_unit(value: number, unit: string): string {
  return digits(value) + (unit === "" || unit.startsWith("°") ? unit : " " + unit);
}

/** 0 to 360 degrees, clockwise from north. */
export function bearing(rad: number | undefined): string {
  if (rad === undefined || !Number.isFinite(rad)) return none;
  const whole = Math.round((((rad * degrees) % 360) + 360) % 360) % 360;
  return String(whole).padStart(3, "0") + "°";
}

/** "12:05.3" of flight; negative before the first armed tick. */
export function clock(seconds: number): string {
  if (!Number.isFinite(seconds)) return none;
  const size = Math.abs(seconds),
    minutes = Math.floor(size / 60);
  return (seconds < -0.05 ? "−" : "") + minutes + ":" + (size - 60 * minutes).toFixed(1).padStart(4, "0");
}
