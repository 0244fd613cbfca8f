// SPDX-License-Identifier: BSD-3-Clause
// Tiles below the map. Only visible tiles are fetched, from the server that the mission names. A missing tile is left out.
import { LocalPlane, type Place, type Tile, deepest, parts_at } from "../flight/tiles";
import type { View } from "../protocol/flight";

interface Point {
  n: number;
  e: number;
}
type Screen = (p: Point) => { x: number; y: number };

const at_once = 6,
  most_kept = 600,
  levels_up = 4;

export class Ground {
  private readonly plane: LocalPlane;
  private readonly images = new Map<string, HTMLImageElement | "coming" | "failed">(); // the most recently used ones are at the end
  private coming = 0;

  constructor(
    private readonly url: string,
    origin: Place,
    readonly attribution: string,
  ) {
    this.plane = new LocalPlane(origin);
  }

  /** Draws the tiles that are loaded and requests the missing ones. */
  draw(g: CanvasRenderingContext2D, low: Point, high: Point, px_per_m: number, to_screen: Screen): void {
    const z = this.plane.zoom_for(px_per_m * Math.min(2, window.devicePixelRatio || 1));
    const above = new Map<string, Tile>(); // in place of missing ones
    const there: Tile[] = [];
    for (const tile of this.plane.tiles_of(low, high, z)) {
      if (this.image(tile)) there.push(tile);
      else this.stand_in(tile, above);
    }
    for (const tile of [...above.values()].sort((a, b) => a.z - b.z)) this.put(g, tile, px_per_m, to_screen);
    for (const tile of there) this.put(g, tile, px_per_m, to_screen);
    for (const key of this.images.keys()) {
      if (this.images.size <= most_kept) break;
      if (this.images.get(key) !== "coming") this.images.delete(key);
    }
  }

  /** For a failed tile: the tile of a smaller scale that contains it. For a tile that is loading: the same, if it is already loaded. */
  private stand_in(tile: Tile, above: Map<string, Tile>): void {
    let failed = this.images.get(key_of(tile)) === "failed";
    for (let up = 1; up <= levels_up && tile.z - up >= 0; ++up) {
      const t = { z: tile.z - up, x: tile.x >> up, y: tile.y >> up };
      const known = this.images.get(key_of(t));
      if (known instanceof Image || failed) {
        if (this.image(t)) return void above.set(key_of(t), t);
        failed = this.images.get(key_of(t)) === "failed";
      }
    }
  }

  private image(tile: Tile): HTMLImageElement | null {
    const key = key_of(tile),
      known = this.images.get(key);
    if (known instanceof Image) {
      this.images.delete(key);
      this.images.set(key, known);
      return known;
    }
    if (known === undefined && this.coming < at_once && tile.z <= deepest) this.fetch(tile, key);
    return null;
  }

  private fetch(tile: Tile, key: string): void {
    const image = new Image();
    ++this.coming;
    this.images.set(key, "coming");
    const done = (result: HTMLImageElement | "failed") => {
      --this.coming;
      this.images.set(key, result);
    };
    image.onload = () => done(image);
    image.onerror = () => done("failed");
    image.referrerPolicy = "origin"; // tile servers require the origin of the page; the path with its token is not sent
    image.src = this.url
      .replace("{z}", String(tile.z))
      .replace("{x}", String(tile.x))
      .replace("{y}", String(tile.y));
  }

  private put(g: CanvasRenderingContext2D, tile: Tile, px_per_m: number, to_screen: Screen): void {
    const image = this.image(tile);
    if (!image) return;
    const parts = parts_at(px_per_m / 2 ** Math.max(0, this.plane.zoom_for(px_per_m) - tile.z)),
      size = 1 / parts;
    const [w, h] = [image.naturalWidth / parts, image.naturalHeight / parts];
    for (let i = 0; i < parts; ++i)
      for (let k = 0; k < parts; ++k) {
        const frame = this.plane.frame_of({ z: tile.z, x: tile.x + k * size, y: tile.y + i * size }, size);
        const o = to_screen(frame.corner),
          r = to_screen(frame.right),
          d = to_screen(frame.down);
        const seam = 0.5 / Math.max(1, r.x - o.x); // no line between neighbours
        g.save();
        g.transform(r.x - o.x, r.y - o.y, d.x - o.x, d.y - o.y, o.x, o.y);
        g.drawImage(image, k * w, i * h, w, h, 0, 0, 1 + seam, 1 + seam);
        g.restore();
      }
  }
}

const key_of = (t: Tile) => `${t.z}/${t.x}/${t.y}`;

let ground: Ground | null = null,
  made_of = "";
/** The tiles of the mission; null without tiles or without an origin. All maps of the page share them. */
export function ground_of(view: View | null): Ground | null {
  const of =
    view && view.tiles && view.origin ? JSON.stringify([view.tiles, view.attribution, view.origin]) : "";
  if (of !== made_of) {
    made_of = of;
    ground = of && view?.origin ? new Ground(view.tiles, view.origin, view.attribution) : null;
  }
  return ground;
}
