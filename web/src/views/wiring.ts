// SPDX-License-Identifier: BSD-3-Clause
// Drawing of the components and their connections: layers from left to right, active components dark, connections of the selected one highlighted.
import { fill, mark, say, svg } from "../dom";
import { type Box, type Drawing, type Part, type Wire, draw_wiring, small_letter } from "../flight/wiring";
import type { Component, View } from "../protocol/flight";

/** Figures of a component's steps and of a connection. */
export interface Figures {
  steps(c: Component): string;
  wire(source: string): { rate: string; age: string; silent: boolean };
}
interface Node {
  box: Box;
  group: SVGGElement;
  title: Element;
  name: Element;
  below: Element;
  last: Element;
}

const plugin = (c: Component) => c.use.slice(c.use.lastIndexOf("/") + 1);
const state = (c: Component) => (c.stopped ? "stopped by a guard" : c.active ? "active" : "inactive");
const sign = (c: Component) => (c.stopped ? "✕ " : c.active ? "✓ " : "");
const least_letters = 16; // width of the lines below the name

export class Wiring {
  readonly element = svg("svg", {
    class: "wiring",
    role: "group",
    "aria-label": "Components and connections; arrow keys select a component",
  });
  private drawing: Drawing = { width: 0, height: 0, boxes: [], wires: [] };
  private nodes = new Map<string, Node>();
  private lines: { wire: Wire; path: SVGPathElement; title: Element }[] = [];
  private chosen = "";

  constructor(private readonly choose: (name: string) => void) {
    this.element.addEventListener("keydown", (e) => this.key(e));
  }

  /** Called when the components change. */
  draw(view: View): void {
    const below = (p: Part) => Math.max(least_letters, (p.role || plugin(p as Component)).length);
    this.drawing = draw_wiring(view.components, below);
    const { width, height, boxes, wires } = this.drawing;
    this.element.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.element.setAttribute("width", String(width));
    this.lines = wires.map((wire) => {
      const title = svg("title"),
        path = svg("path", { class: "wire", d: "M" + wire.points.map((p) => p.join(" ")).join("L") }, title);
      return { wire, path, title };
    });
    const held = this.element.contains(document.activeElement)
      ? (document.activeElement as SVGElement).dataset.component
      : undefined;
    this.nodes = new Map(boxes.map((box) => [box.name, this.node(box)]));
    fill(this.element, ...this.lines.map((l) => l.path), ...[...this.nodes.values()].map((n) => n.group));
    if (held) this.nodes.get(held)?.group.focus(); // keeps the keyboard focus
  }
  private node(box: Box): Node {
    const line = (at: number, name: string) => svg("text", { class: name, x: box.x + 7, y: box.y + at });
    const title = svg("title"),
      name = line(16, "name"),
      below = line(31, "small"),
      last = line(45, "small");
    const group = svg(
      "g",
      { class: "component", role: "button", tabindex: "-1", "data-component": box.name },
      title,
      svg("rect", { x: box.x, y: box.y, width: box.width, height: box.height, rx: 5 }),
      name,
      below,
      last,
    );
    group.addEventListener("click", () => this.choose(box.name));
    return { box, group, title, name, below, last };
  }

  private key(e: KeyboardEvent): void {
    const here = this.nodes.get((e.target as HTMLElement).dataset.component ?? "")?.box;
    const way = (
      { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowDown: [0, 1], ArrowUp: [0, -1] } as Record<
        string,
        [number, number]
      >
    )[e.key];
    if (!here || !way) return;
    e.preventDefault();
    const ahead = (b: Box) =>
      (b.layer - here.layer) * way[0] + (b.layer === here.layer ? (b.row - here.row) * way[1] : 0);
    const far = (b: Box) => 100 * ahead(b) + Math.abs(b.row - here.row);
    const next = this.drawing.boxes.filter((b) => ahead(b) > 0).sort((a, b) => far(a) - far(b))[0];
    if (!next) return;
    this.choose(next.name);
    this.nodes.get(next.name)?.group.focus();
  }

  update(view: View, chosen: string, figures: Figures): void {
    this.chosen = chosen;
    const flies = new Map(view.components.map((c) => [c.name, c.active && !c.stopped]));
    const ports = new Map<string, Set<string>>(); // by neighbour of the selected component: connected ports
    for (const { wire, path, title } of this.lines) {
      const lit = wire.from === chosen || wire.to === chosen,
        other = wire.from === chosen ? wire.to : wire.from;
      if (lit) ports.set(other, (ports.get(other) ?? new Set()).add(wire.source));
      const { rate, age, silent } = figures.wire(wire.source);
      mark(path, "lit", lit);
      mark(path, "idle", !flies.get(wire.from) || !flies.get(wire.to));
      mark(path, "silent", silent);
      say(title, `${wire.source} → ${wire.to}.${wire.input}: ${rate}, ${age} old`);
    }
    for (const c of view.components) {
      const n = this.nodes.get(c.name);
      if (!n) continue;
      const steps = figures.steps(c),
        over = c.budget_us > 0 && c.step_max_us > c.budget_us;
      say(n.name, sign(c) + c.name);
      say(n.below, c.role || plugin(c));
      say(
        n.last,
        this.wires_text([...(ports.get(c.name) ?? [])], n.box, figures) ?? (c.stopped ? "stopped" : steps),
      );
      mark(n.last, "bad", over || c.stopped);
      const words = `${c.name}${c.role ? ", role " + c.role : ""}: ${state(c)}, ${steps}${over ? ", over budget" : ""}`;
      say(n.title, words);
      n.group.setAttribute("aria-label", words);
      n.group.setAttribute("aria-pressed", String(c.name === chosen));
      n.group.setAttribute("tabindex", c.name === chosen ? "0" : "-1");
      mark(n.group, "chosen", c.name === chosen);
      mark(n.group, "near", ports.has(c.name));
      mark(n.group, "waits", !c.active);
      mark(n.group, "stopped", c.stopped);
    }
  }

  /** Connections of a box with the selected one, shortened to fit. */
  private wires_text(sources: string[], box: Box, figures: Figures): string | null {
    if (sources.length === 0 || box.name === this.chosen) return null;
    const names = sources.map((s) => s.replace(/^[^.]*\./, "")),
      { rate, age } = figures.wire(sources[0] as string);
    const tries =
      sources.length === 1
        ? [`${names[0]} ${rate} ${age}`, `${names[0]} ${rate}`, `${names[0]}`, "1 wire"]
        : [names.join(", "), `${names.length} wires`];
    return tries.find((t) => t.length * small_letter < box.width - 14) ?? "";
  }
}
