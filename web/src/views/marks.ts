// SPDX-License-Identifier: BSD-3-Clause
// Marks of every map besides the plan: geofence, runway, landing places, origin, aircraft, wind, and the region of an aircraft with
// an invalid position.
import { colours } from "../dom";
import type { Spot } from "../flight/labels";
import type { Places } from "../flight/places";
import type { State } from "../names";
import { bearing, degrees, fixed } from "../units";

interface Point {
  n: number;
  e: number;
}
type Screen = (p: Point) => { x: number; y: number };
type Canvas = CanvasRenderingContext2D;

/** Invalid position: the last valid one, and a circle about the estimate. */
export interface Lost {
  last: Point & { t: number };
  age_s: number;
  at: Point;
  radius: number | null; // m; null: no estimate
  yaw: number;
}

/** Text that is legible on lines and tiles. */
export function words_on(g: Canvas, words: string, x: number, y: number, colour = "text"): void {
  g.lineJoin = "round";
  g.lineWidth = 4;
  g.strokeStyle = colours.get("ground");
  g.strokeText(words, x, y);
  g.fillStyle = colours.get(colour);
  g.fillText(words, x, y);
}

function aircraft_shape(g: Canvas, yaw: number, x: number, y: number): void {
  g.translate(x, y);
  g.rotate(yaw);
  g.beginPath();
  for (const [a, b] of [
    [0, -15],
    [3, -4],
    [16, 2],
    [16, 5],
    [3, 3],
    [2, 11],
    [6, 14],
    [6, 16],
    [0, 15],
  ] as const)
    g.lineTo(a, b);
  for (const [a, b] of [
    [6, 16],
    [6, 14],
    [2, 11],
    [3, 3],
    [16, 5],
    [16, 2],
    [3, -4],
  ] as const)
    g.lineTo(-a, b);
  g.closePath();
}

function fence(g: Canvas, corners: Point[], to_screen: Screen): void {
  if (corners.length === 0) return;
  g.beginPath();
  for (const c of corners) {
    const { x, y } = to_screen(c);
    g.lineTo(x, y);
  }
  g.closePath();
  g.strokeStyle = colours.get("fence");
  g.lineWidth = 2.5;
  g.setLineDash([10, 5]);
  g.stroke();
  g.setLineDash([]);
  const top = corners.map(to_screen).reduce((a, b) => (b.y < a.y || (b.y === a.y && b.x < a.x) ? b : a));
  g.font = "11px system-ui";
  g.textAlign = "left";
  g.textBaseline = "bottom";
  words_on(g, "geofence", top.x + 4, top.y - 4, "fence");
}

function runway(g: Canvas, strip: NonNullable<Places["runway"]>, to_screen: Screen, px_per_m: number): void {
  const { x, y } = to_screen(strip),
    end = to_screen({
      n: strip.n + strip.length * Math.cos(strip.heading),
      e: strip.e + strip.length * Math.sin(strip.heading),
    });
  const width = Math.max(6, 12 * px_per_m);
  g.lineCap = "butt";
  for (const [wide, colour, dash] of [
    [width + 2, "text", []],
    [width, "runway", []],
    [1.5, "on_tape", [8, 6]],
  ] as const) {
    g.strokeStyle = colours.get(colour);
    g.lineWidth = wide;
    g.setLineDash(dash as unknown as number[]);
    g.beginPath();
    g.moveTo(x, y);
    g.lineTo(end.x, end.y);
    g.stroke();
  }
  g.setLineDash([]);
  g.lineCap = "round";
  const number = Math.round((((strip.heading * 180) / Math.PI + 360) % 360) / 10) || 36;
  g.font = "bold 11px system-ui";
  g.textAlign = "center";
  g.textBaseline = "middle";
  words_on(
    g,
    String(number).padStart(2, "0"),
    x - 20 * Math.sin(strip.heading),
    y + 20 * Math.cos(strip.heading),
  );
}

function spot(g: Canvas, { x, y }: { x: number; y: number }, letter: string): void {
  g.beginPath();
  g.arc(x, y, 9, 0, 2 * Math.PI);
  g.fillStyle = colours.get("panel");
  g.fill();
  g.strokeStyle = colours.get("place");
  g.lineWidth = 2.5;
  g.stroke();
  g.font = "bold 11px system-ui";
  g.textAlign = "center";
  g.textBaseline = "middle";
  g.fillStyle = colours.get("text");
  g.fillText(letter, x, y + 0.5);
}

/** H is home, L another landing place. */
export function draw_places(g: Canvas, places: Places, to_screen: Screen, px_per_m: number): void {
  fence(g, places.fence, to_screen);
  if (places.runway) runway(g, places.runway, to_screen, px_per_m);
  places.places.forEach((p, i) => spot(g, to_screen(p), i === 0 ? "H" : "L"));
}

/** Place of a crash. */
export function draw_crash(g: Canvas, { x, y }: { x: number; y: number }): void {
  g.strokeStyle = colours.get("alarm");
  g.lineWidth = 5;
  g.beginPath();
  for (const side of [-1, 1]) {
    g.moveTo(x - 14, y - 14 * side);
    g.lineTo(x + 14, y + 14 * side);
  }
  g.stroke();
  g.font = "bold 14px system-ui";
  g.textAlign = "center";
  g.textBaseline = "bottom";
  words_on(g, "✕ crashed", x, y - 18, "bad");
}

export function draw_lost(g: Canvas, lost: Lost, to_screen: Screen, px_per_m: number): void {
  const was = to_screen(lost.last),
    at = to_screen(lost.at);
  g.strokeStyle = g.fillStyle = colours.get("bad");
  if (lost.radius !== null) {
    g.beginPath();
    g.arc(at.x, at.y, Math.max(20, lost.radius * px_per_m), 0, 2 * Math.PI);
    g.globalAlpha = 0.15;
    g.fill();
    g.globalAlpha = 1;
    g.lineWidth = 2.5;
    g.setLineDash([6, 4]);
    g.stroke();
    g.setLineDash([]);
  }
  g.lineWidth = 3;
  g.beginPath();
  for (const [a, b] of [
    [-7, 7],
    [7, -7],
  ] as const) {
    g.moveTo(was.x + a, was.y + a);
    g.lineTo(was.x + b, was.y + b);
    g.moveTo(was.x - a, was.y + a);
    g.lineTo(was.x - b, was.y + b);
  }
  g.stroke();
  if (lost.radius !== null) {
    g.save();
    aircraft_shape(g, lost.yaw, at.x, at.y);
    g.fillStyle = colours.get("panel");
    g.fill();
    g.lineWidth = 2;
    g.stroke();
    g.restore();
  }
  const lines = [
    `✕ position lost ${Math.round(lost.age_s)} s ago`,
    lost.radius === null
      ? "no position estimate"
      : `95 %: within ${Math.round(lost.radius)} m of the estimate`,
  ];
  g.font = "bold 13px system-ui";
  g.fillStyle = colours.get("alarm");
  const width = Math.max(...lines.map((l) => g.measureText(l).width)) + 16,
    top = width + 200 < g.canvas.clientWidth ? 8 : 42; // beside the buttons or below them
  g.fillRect(8, top, width, 42);
  g.fillStyle = "#fff";
  g.textAlign = "left";
  g.textBaseline = "middle";
  lines.forEach((l, i) => g.fillText(l, 16, top + 12 + 18 * i));
}

/** A bar of `step` metres in one corner and the north arrow; on tiles with a background. */
export function draw_scale(
  g: Canvas,
  step: number,
  px_per_m: number,
  map: { width: number; height: number },
  on_tiles: boolean,
): void {
  const length = step * px_per_m,
    x = map.width - 14 - length,
    y = map.height - 12;
  if (on_tiles) {
    g.fillStyle = colours.get("panel");
    g.fillRect(x - 6, y - 20, length + 12, 26);
    g.fillRect(8, map.height - 56, 30, 20);
  }
  g.font = "11px system-ui";
  g.strokeStyle = g.fillStyle = colours.get("text");
  g.lineWidth = 2;
  g.beginPath();
  g.moveTo(x, y - 5);
  g.lineTo(x, y);
  g.lineTo(x + length, y);
  g.lineTo(x + length, y - 5);
  g.stroke();
  g.textAlign = "center";
  g.textBaseline = "bottom";
  g.fillText(step >= 1000 ? step / 1000 + " km" : step + " m", x + length / 2, y - 3);
  g.textAlign = "left";
  g.textBaseline = "middle";
  g.fillText("N ↑", 12, map.height - 46);
}

export function draw_home(g: Canvas, { x, y }: Spot): void {
  g.strokeStyle = g.fillStyle = colours.get("text");
  g.lineWidth = 2;
  g.strokeRect(x - 5, y - 3, 10, 8);
  g.beginPath();
  g.moveTo(x - 8, y - 3);
  g.lineTo(x, y - 10);
  g.lineTo(x + 8, y - 3);
  g.stroke();
  g.font = "11px system-ui";
  g.textAlign = "center";
  g.textBaseline = "top";
  words_on(g, "origin", x, y + 8);
}

export function draw_aircraft(g: Canvas, yaw: number, { x, y }: Spot): void {
  g.save();
  aircraft_shape(g, yaw, x, y);
  g.fillStyle = colours.get("aircraft");
  g.strokeStyle = colours.get("ground");
  g.lineWidth = 1.5;
  g.fill();
  g.stroke();
  g.restore();
}

/** An arrow and text in the lower corner of a map of this height. */
export function draw_wind(g: Canvas, s: State, height: number): void {
  const speed = Math.hypot(s.wind_n, s.wind_e),
    to = Math.atan2(s.wind_e, s.wind_n);
  const words = "wind " + fixed(speed, 1, "m/s") + " from " + bearing(to + Math.PI);
  g.font = "12px system-ui";
  g.textAlign = "left";
  g.textBaseline = "middle";
  const width = g.measureText(words).width + 52,
    y = height - 22;
  g.fillStyle = colours.get("panel");
  g.fillRect(8, y - 15, width, 30);
  g.fillStyle = g.strokeStyle = colours.get("text");
  g.fillText(words, 44, y);
  g.save();
  g.translate(26, y);
  g.rotate(Math.round(to * degrees) / degrees || 0);
  g.lineWidth = 2;
  g.beginPath();
  for (const [a, b] of [
    [0, 10],
    [0, -10],
    [-4, -4],
    [0, -10],
    [4, -4],
  ] as const)
    g.lineTo(a, b);
  g.stroke();
  g.restore();
}
