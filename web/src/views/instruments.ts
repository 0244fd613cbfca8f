// SPDX-License-Identifier: BSD-3-Clause
// Attitude, airspeed, height and heading: tapes that move behind a pointer, with marks at the commanded values.
import { colours, sharp } from "../dom";
import type { State } from "../names";
import { bearing, degrees, fixed } from "../units";

export interface Asked {
  air?: number | undefined; // m/s
  up?: number | undefined; // m
  course?: number | undefined; // rad
  roll?: number | undefined; // rad
  pitch?: number | undefined; // rad
}

const ribbon = 62,
  strip = 26,
  head = 0;

/** A vertical tape: larger values above. */
function tape(
  g: CanvasRenderingContext2D,
  x: number,
  height: number,
  value: number | undefined,
  asked: number | undefined,
  per_px: number,
  step: number,
  words: { name: string; unit: string; left: boolean },
): void {
  const middle = (height - strip + head) / 2;
  g.save();
  g.beginPath();
  g.rect(x, head, ribbon, height - strip - head);
  g.clip();
  g.fillStyle = colours.get("tape");
  g.fillRect(x, 0, ribbon, height);
  g.fillStyle = g.strokeStyle = colours.get("on_tape");
  g.font = "12px system-ui";
  g.textBaseline = "middle";
  g.lineWidth = 1;
  if (value !== undefined) {
    const reach = (height / 2) * per_px;
    for (let v = Math.ceil((value - reach) / step) * step; v <= value + reach; v += step) {
      const y = middle + (value - v) / per_px;
      const edge = words.left ? x + ribbon : x;
      g.beginPath();
      g.moveTo(edge, y);
      g.lineTo(edge + (words.left ? -7 : 7), y);
      g.stroke();
      g.textAlign = words.left ? "right" : "left";
      g.fillText(String(Math.round(v)), edge + (words.left ? -11 : 11), y);
    }
    if (asked !== undefined) {
      const y = Math.min(height - strip - 4, Math.max(head + 4, middle + (value - asked) / per_px));
      g.fillStyle = colours.get("asked");
      g.fillRect(words.left ? x + ribbon - 7 : x, y - 3, 7, 6);
    }
  }
  g.fillStyle = "#000";
  g.fillRect(x, middle - 12, ribbon, 24);
  g.strokeStyle = colours.get("on_tape");
  g.strokeRect(x + 0.5, middle - 12, ribbon - 1, 24);
  g.fillStyle = "#fff";
  g.font = "bold 14px system-ui";
  g.textAlign = "center";
  g.fillText(fixed(value, 1, ""), x + ribbon / 2, middle);
  g.fillStyle = colours.get("tape");
  g.fillRect(x, 0, ribbon, 34);
  g.fillStyle = colours.get("on_tape");
  g.font = "11px system-ui";
  g.fillText(words.name, x + ribbon / 2, 9);
  g.fillStyle = colours.get("asked");
  g.font = "bold 12px system-ui";
  g.fillText(asked === undefined ? words.unit : fixed(asked, 1, words.unit), x + ribbon / 2, 24);
  g.restore();
}

function horizon(
  g: CanvasRenderingContext2D,
  x: number,
  width: number,
  height: number,
  s: State,
  asked: Asked,
): void {
  const px_per_deg = height / 60,
    cx = x + width / 2,
    cy = (height - strip) / 2;
  g.save();
  g.beginPath();
  g.rect(x, 0, width, height - strip);
  g.clip();
  g.translate(cx, cy);
  g.rotate(-s.roll);
  const shift = s.pitch * degrees * px_per_deg,
    far = width + height;
  g.fillStyle = colours.get("sky");
  g.fillRect(-far, -far, 2 * far, far + shift);
  g.fillStyle = colours.get("earth");
  g.fillRect(-far, shift, 2 * far, far);
  g.strokeStyle = g.fillStyle = "#fff";
  g.lineWidth = 1.5;
  g.font = "11px system-ui";
  g.textBaseline = "middle";
  for (let d = -90; d <= 90; d += 5) {
    const y = shift - d * px_per_deg;
    if (Math.abs(y) > height * 0.42) continue;
    const half = d === 0 ? far : d % 10 === 0 ? 34 : 16;
    g.beginPath();
    g.moveTo(-half, y);
    g.lineTo(half, y);
    g.stroke();
    if (d === 0 || d % 10 !== 0) continue;
    g.textAlign = "right";
    g.fillText(String(d), -half - 5, y);
    g.textAlign = "left";
    g.fillText(String(d), half + 5, y);
  }
  g.rotate(s.roll);
  const radius = Math.min(width, height - strip) * 0.43;
  for (const d of [-60, -45, -30, -20, -10, 0, 10, 20, 30, 45, 60]) {
    const a = (d - 90) / degrees,
      long = d % 30 === 0 ? 10 : 6;
    g.beginPath();
    g.moveTo(radius * Math.cos(a), radius * Math.sin(a));
    g.lineTo((radius + long) * Math.cos(a), (radius + long) * Math.sin(a));
    g.stroke();
  }
  const pointer = (roll: number, colour: string) => {
    g.save();
    g.rotate(-roll);
    g.beginPath();
    g.moveTo(0, -radius + 1);
    g.lineTo(-6, -radius + 11);
    g.lineTo(6, -radius + 11);
    g.closePath();
    g.fillStyle = colour;
    g.fill();
    g.restore();
  };
  if (asked.roll !== undefined) pointer(asked.roll, colours.get("asked"));
  pointer(s.roll, "#fff");
  if (asked.pitch !== undefined) {
    const y = (s.pitch - asked.pitch) * degrees * px_per_deg;
    g.strokeStyle = colours.get("asked");
    g.lineWidth = 3;
    g.beginPath();
    for (const side of [-1, 1]) {
      g.moveTo(side * 44, y);
      g.lineTo(side * 62, y);
    }
    g.stroke();
  }
  g.strokeStyle = "#000";
  for (const [width_, colour] of [
    [6, "#000"],
    [3, "#ffd21f"],
  ] as const) {
    g.lineWidth = width_;
    g.strokeStyle = colour;
    g.beginPath();
    for (const side of [-1, 1]) {
      g.moveTo(side * 46, 0);
      g.lineTo(side * 18, 0);
      g.lineTo(side * 10, 8);
    }
    g.stroke();
  }
  g.fillStyle = "#fff";
  g.font = "bold 12px system-ui";
  g.textAlign = "center";
  g.strokeStyle = "#000";
  g.lineWidth = 3;
  const words = "roll " + fixed(s.roll * degrees, 0, "°") + "   pitch " + fixed(s.pitch * degrees, 0, "°");
  g.strokeText(words, 0, (height - strip) / 2 - 10);
  g.fillText(words, 0, (height - strip) / 2 - 10);
  g.restore();
}

function compass(g: CanvasRenderingContext2D, width: number, height: number, s: State, asked: Asked): void {
  const y = height - strip,
    px_per_deg = 3,
    cx = width / 2,
    heading = s.yaw * degrees;
  g.save();
  g.beginPath();
  g.rect(0, y, width, strip);
  g.clip();
  g.fillStyle = colours.get("tape");
  g.fillRect(0, y, width, strip);
  g.fillStyle = g.strokeStyle = colours.get("on_tape");
  g.font = "12px system-ui";
  g.textAlign = "center";
  g.textBaseline = "middle";
  const names: Record<number, string> = { 0: "N", 90: "E", 180: "S", 270: "W" };
  const reach = Math.ceil(width / 2 / px_per_deg / 15 + 1) * 15;
  for (let d = Math.ceil((heading - reach) / 15) * 15; d < heading + reach; d += 15) {
    const whole = ((d % 360) + 360) % 360,
      x = cx + (d - heading) * px_per_deg;
    g.fillText(names[whole] ?? (whole % 30 === 0 ? String(whole) : "·"), x, y + 13);
  }
  const mark = (angle: number, colour: string, top: number) => {
    const off = ((((angle * degrees - heading) % 360) + 540) % 360) - 180;
    const x = Math.min(width - 5, Math.max(5, cx + off * px_per_deg));
    g.fillStyle = colour;
    g.fillRect(x - 3, top, 6, 5);
  };
  if (s.valid.velocity) mark(s.course, colours.get("track"), y);
  if (asked.course !== undefined) mark(asked.course, colours.get("asked"), y + strip - 5);
  g.fillStyle = "#000";
  g.fillRect(cx - 27, y + 2, 54, strip - 4);
  g.fillStyle = "#fff";
  g.font = "bold 13px system-ui";
  g.fillText(bearing(s.yaw), cx, y + 14);
  g.restore();
}

export function draw_instruments(canvas: HTMLCanvasElement, s: State | null, asked: Asked): void {
  const width = canvas.clientWidth,
    height = canvas.clientHeight;
  if (width === 0 || height === 0) return;
  const g = sharp(canvas);
  g.clearRect(0, 0, width, height);
  if (!s || !s.valid.attitude) {
    g.fillStyle = colours.get("tape");
    g.fillRect(0, 0, width, height);
    g.fillStyle = colours.get("on_tape");
    g.font = "bold 15px system-ui";
    g.textAlign = "center";
    g.textBaseline = "middle";
    g.fillText("✕ no attitude", width / 2, height / 2);
    return;
  }
  horizon(g, ribbon, width - 2 * ribbon, height, s, asked);
  tape(g, 0, height, s.valid.airspeed ? s.air : undefined, asked.air, 0.09, 2, {
    name: "airspeed",
    unit: "m/s",
    left: true,
  });
  tape(g, width - ribbon, height, s.valid.height ? s.up : undefined, asked.up, 0.5, 10, {
    name: "height",
    unit: "m",
    left: false,
  });
  compass(g, width, height, s, asked);
}
