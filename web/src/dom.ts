// SPDX-License-Identifier: BSD-3-Clause
// Elements without HTML: data of a flight becomes text, never markup.

type Child = Node | string | null | undefined | false;
type Props = Record<string, unknown>;

/** el("button", {class: "small", onclick: f, "aria-label": "Pause"}, "Pause") */
export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  props: Props = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(props)) {
    if (value === undefined || value === null || value === false) continue;
    if (key === "class") element.className = String(value);
    else if (key.startsWith("on")) element.addEventListener(key.slice(2), value as EventListener);
    else if (key.includes("-") || key === "role" || key === "for") element.setAttribute(key, String(value));
    else (element as unknown as Props)[key] = value;
  }
  for (const child of children) if (child) element.append(child);
  return element;
}

/** The same for a drawing: svg("line", {class: "wire", x1: 3}) */
export function svg<K extends keyof SVGElementTagNameMap>(
  tag: K,
  props: Record<string, string | number> = {},
  ...children: Child[]
): SVGElementTagNameMap[K] {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [key, value] of Object.entries(props)) element.setAttribute(key, String(value));
  for (const child of children) if (child) element.append(child);
  return element;
}

/** Writes only changes, so that the browser does not lay out the rest of the page again. */
export function say(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}
export function mark(element: Element, name: string, on: boolean): void {
  if (element.classList.contains(name) !== on) element.classList.toggle(name, on);
}
export function fill(element: Element, ...children: Child[]): void {
  element.replaceChildren(...(children.filter(Boolean) as (Node | string)[]));
}

/** A canvas at the resolution of the screen: sized to its box, with coordinates in CSS pixels. */
export function sharp(canvas: HTMLCanvasElement): CanvasRenderingContext2D {
  const ratio = window.devicePixelRatio || 1;
  const width = Math.round(canvas.clientWidth * ratio),
    height = Math.round(canvas.clientHeight * ratio);
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  const g = canvas.getContext("2d") as CanvasRenderingContext2D;
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  return g;
}

/** Colours of the style sheet, for canvases; read again when the colour scheme changes. */
export class Colours {
  private cache = new Map<string, string>();
  constructor() {
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.cache.clear());
  }
  forget(): void {
    this.cache.clear();
  }
  get(name: string): string {
    let value = this.cache.get(name);
    if (value === undefined) {
      value =
        getComputedStyle(document.documentElement)
          .getPropertyValue("--" + name)
          .trim() || "#888";
      this.cache.set(name, value);
    }
    return value;
  }
}
export const colours = new Colours();
