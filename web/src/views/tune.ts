// SPDX-License-Identifier: BSD-3-Clause
// Live parameters by component, beside the response of the aircraft.
import { el, fill, mark, say } from "../dom";
import type { Component, Flight } from "../protocol/flight";
import type { Page } from "./page";
import { ParamRow } from "./params";
import { Response } from "./response";
import { SavePanel } from "./save";

export class Tune implements Page {
  readonly name = "Tune";
  readonly element: HTMLElement;
  private readonly list = el("div", { class: "components", role: "listbox", "aria-label": "Components" });
  private readonly filter = el("input", {
    type: "search",
    placeholder: "find a parameter",
    "aria-label": "Find a parameter",
    oninput: () => this.sift(),
  });
  private readonly rows_box = el("div", { class: "scroll rows" });
  private readonly head = el("div", { class: "faint" });
  private readonly changed = el("div", { class: "changed_list" });
  private readonly response: Response;
  private readonly save: SavePanel;
  private rows = new Map<string, ParamRow[]>(); // by component
  private chosen = "";
  private listed = "";
  private summary = "?";

  constructor(private readonly flight: Flight) {
    this.response = new Response(flight);
    this.save = new SavePanel(flight);
    this.element = el(
      "div",
      { class: "tune" },
      el("section", {}, el("h2", {}, "Components"), this.list),
      el("section", { class: "params" }, el("div", { class: "row" }, this.head, this.filter), this.rows_box),
      el(
        "aside",
        { class: "side" },
        this.response.element,
        el("section", {}, el("h2", {}, "Changed since the start"), this.changed, this.save.element),
      ),
    );
  }

  /** Called at intervals, in every view. */
  record(): void {
    this.response.record();
  }

  private live(c: Component): ParamRow[] {
    let rows = this.rows.get(c.name);
    if (!rows)
      this.rows.set(
        c.name,
        (rows = c.params
          .filter((p) => p.live && p.kind !== "record" && p.kind !== "blob")
          .map((p) => new ParamRow(this.flight, c.name, p))),
      );
    return rows;
  }

  private choose(name: string): void {
    this.chosen = name;
    const component = this.flight.component(name);
    if (!component) return;
    const rows = this.live(component);
    fill(this.rows_box, ...rows.map((r) => r.element));
    if (rows.length === 0)
      fill(this.rows_box, el("p", { class: "faint" }, "This component has no live parameters."));
    const fixed_ones = component.params.length - rows.length;
    say(
      this.head,
      `${component.use}: ${component.doc}${fixed_ones > 0 ? ` Fixed in flight: ${fixed_ones}.` : ""}`,
    );
    this.filter.value = "";
    this.sift();
    for (const b of this.list.querySelectorAll("button"))
      b.setAttribute("aria-selected", String(b.dataset.component === name));
  }
  private sift(): void {
    const words = this.filter.value.trim().toLowerCase();
    for (const row of this.rows.get(this.chosen) ?? []) row.element.hidden = !row.matches(words);
  }

  update(now_ms: number): void {
    const view = this.flight.view;
    if (view) {
      const listed = JSON.stringify(view.components.map((c) => [c.name, c.use, c.active, c.stopped]));
      if (listed !== this.listed) {
        const swapped =
          this.listed !== "" &&
          JSON.parse(this.listed).some((c: [string, string], i: number) => c[1] !== view.components[i]?.use);
        if (swapped) this.rows = new Map(); // a component has new parameters
        this.listed = listed;
        fill(
          this.list,
          ...view.components.map((c) => {
            const button = el(
              "button",
              { role: "option", onclick: () => this.choose(c.name) },
              c.name,
              c.role ? el("span", { class: "faint" }, " " + c.role) : "",
            );
            mark(button, "idle", !c.active);
            if (!c.active) button.append(el("span", { class: "faint" }, " (inactive)"));
            button.dataset.component = c.name;
            return button;
          }),
        );
        const usual = view.components.find((c) => c.active && c.role.includes("inner")) ?? view.components[0];
        this.choose(view.components.some((c) => c.name === this.chosen) ? this.chosen : (usual?.name ?? ""));
      }
      for (const c of view.components) {
        if (c.params.some((p) => JSON.stringify(p.value) !== JSON.stringify(p.begun))) this.live(c); // also changed by another client
        const rows = this.rows.get(c.name);
        for (const row of rows ?? []) {
          const p = c.params.find((q) => q.name === row.name);
          if (p) row.show(p);
        }
      }
      this.tell();
    }
    this.response.update(now_ms);
  }

  private tell(): void {
    const changed = [...this.rows.values()].flat().filter((r) => r.changed);
    const now = changed.map((r) => r.summary).join("\n");
    if (now === this.summary) return;
    this.summary = now;
    this.save.offer([...new Set(changed.map((r) => r.component))]);
    if (changed.length === 0) return fill(this.changed, el("p", { class: "faint" }, "None."));
    fill(
      this.changed,
      el("ul", {}, ...changed.map((r) => el("li", {}, r.summary))),
      el(
        "div",
        { class: "row" },
        el("button", { onclick: () => changed.forEach((r) => r.restore()) }, "Restore all"),
      ),
    );
  }
}
