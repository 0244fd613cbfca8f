// SPDX-License-Identifier: BSD-3-Clause
// Position of web map tiles in the local plane, north and east of the origin. Sources: WGS 84 (NIMA TR8350.2);
// spherical Mercator of web maps (EPSG:3857, EPSG Guidance Note 7-2); local plane: Groves, Principles of GNSS, Inertial, and Multisensor
// Integrated Navigation Systems (2013), 2.4.

export interface Place {
  lat_deg: number;
  lon_deg: number;
  alt_msl_m: number; // taken for the height above the ellipsoid: 100 m of geoid move a place 5 km away by 8 cm
}
export interface Tile {
  z: number;
  x: number;
  y: number;
}
interface Point {
  n: number;
  e: number;
}

const a_m = 6378137,
  f = 1 / 298.257223563,
  e2 = f * (2 - f),
  rad = Math.PI / 180;
export const tile_px = 256,
  deepest = 19;

/** Parts along each side of a tile, each drawn as a parallelogram: a side of S metres bends by S^2 tan(latitude) / R. */
export const parts_at = (px_per_m: number): number => (px_per_m < 0.1 ? 4 : 1);

/** The north-west corner of a tile; x and y may have fractions. */
export function corner_of(t: Tile): { lat: number; lon: number } {
  const n = 2 ** t.z;
  return { lat: Math.atan(Math.sinh(Math.PI * (1 - (2 * t.y) / n))), lon: 2 * Math.PI * (t.x / n - 0.5) };
}
/** The tile, with fractions, of a place in radians. */
export function tile_at(lat: number, lon: number, z: number): Tile {
  const n = 2 ** z;
  return { z, x: n * (lon / (2 * Math.PI) + 0.5), y: (n / 2) * (1 - Math.asinh(Math.tan(lat)) / Math.PI) };
}

/** The plane that touches the ellipsoid's parallel at an origin. */
export class LocalPlane {
  private readonly lat: number;
  private readonly lon: number;
  private readonly h: number;
  private readonly at: [number, number, number];
  constructor(origin: Place) {
    this.lat = origin.lat_deg * rad;
    this.lon = origin.lon_deg * rad;
    this.h = origin.alt_msl_m;
    this.at = this.earth_fixed(this.lat, this.lon);
  }
  private earth_fixed(lat: number, lon: number, h = this.h): [number, number, number] {
    const across = a_m / Math.sqrt(1 - e2 * Math.sin(lat) ** 2),
      r = (across + h) * Math.cos(lat);
    return [r * Math.cos(lon), r * Math.sin(lon), (across * (1 - e2) + h) * Math.sin(lat)];
  }
  /** Takes radians and a height in the frame of the origin; default: the height of the origin. */
  to_plane(lat: number, lon: number, h = this.h): Point & { up: number } {
    const p = this.earth_fixed(lat, lon, h);
    const [x, y, z] = [p[0] - this.at[0], p[1] - this.at[1], p[2] - this.at[2]];
    const sl = Math.sin(this.lon),
      cl = Math.cos(this.lon);
    const out = cl * x + sl * y,
      s = Math.sin(this.lat),
      c = Math.cos(this.lat);
    return { n: c * z - s * out, e: cl * y - sl * x, up: s * z + c * out };
  }
  /** The place of a point, in radians: by Newton's method with the radii of curvature, to a millimetre within 1000 km. */
  to_place(p: Point): { lat: number; lon: number } {
    let lat = this.lat,
      lon = this.lon;
    for (let i = 0; i < 5; ++i) {
      const w = 1 - e2 * Math.sin(lat) ** 2,
        off = this.to_plane(lat, lon);
      lat += (p.n - off.n) / ((a_m * (1 - e2)) / w ** 1.5 + this.h);
      lon += (p.e - off.e) / ((a_m / Math.sqrt(w) + this.h) * Math.max(Math.cos(lat), 0.01));
    }
    return { lat, lon };
  }

  /** The zoom at which a pixel of a tile is about one of the screen. */
  zoom_for(px_per_m: number): number {
    const most = 2 * Math.PI * a_m * Math.cos(this.lat) * px_per_m; // pixels round the earth
    return Math.min(deepest, Math.max(0, Math.round(Math.log2(most / tile_px))));
  }
  /** The tiles that show any of a rectangle. At most `limit`, else none. */
  tiles_of(low: Point, high: Point, z: number, limit = 200): Tile[] {
    const middle = { n: (low.n + high.n) / 2, e: (low.e + high.e) / 2 };
    const x: number[] = [],
      y: number[] = [];
    for (const n of [low.n, middle.n, high.n])
      for (const e of [low.e, middle.e, high.e]) {
        const place = this.to_place({ n, e });
        const t = tile_at(place.lat, place.lon, z);
        x.push(t.x);
        y.push(t.y);
      }
    const last = 2 ** z - 1;
    const range = (list: number[]) =>
      [Math.max(0, Math.floor(Math.min(...list))), Math.min(last, Math.floor(Math.max(...list)))] as const;
    const [x0, x1] = range(x),
      [y0, y1] = range(y);
    if (!((x1 - x0 + 1) * (y1 - y0 + 1) <= limit)) return [];
    const list: Tile[] = [];
    for (let i = y0; i <= y1; ++i) for (let k = x0; k <= x1; ++k) list.push({ z, x: k, y: i });
    return list;
  }
  /** Where the corner of a tile, or of a part of it, and the ends of its upper and left edges lie. */
  frame_of(t: Tile, size = 1): { corner: Point; right: Point; down: Point } {
    const at = (x: number, y: number) => {
      const c = corner_of({ z: t.z, x, y });
      return this.to_plane(c.lat, c.lon);
    };
    return { corner: at(t.x, t.y), right: at(t.x + size, t.y), down: at(t.x, t.y + size) };
  }
}
