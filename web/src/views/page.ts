// SPDX-License-Identifier: BSD-3-Clause
/** One view of the page: its element is in the document while it is shown. */
export interface Page {
  readonly name: string;
  readonly element: HTMLElement;
  show?(): void;
  hide?(): void;
  /** About 30 times per second while it is shown. */
  update(now_ms: number): void;
}
