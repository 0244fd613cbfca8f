// SPDX-License-Identifier: BSD-3-Clause
// Position of web map tiles in the local plane; a part of words_test.mjs.
import assert from "node:assert/strict";

export const tile_tests = ({ LocalPlane, corner_of, parts_at, tile_at }, near) => ({
  "tile numbers are those of web maps"() {
    const rad = Math.PI / 180,
      top = corner_of({ z: 0, x: 0, y: 0 });
    near(top.lat / rad, 85.0511287798, 1e-9); // EPSG 3857: where the world is a square
    near(top.lon / rad, -180, 1e-9);
    // Slippy map tilenames, OpenStreetMap wiki: of Provo by its formulae in degrees
    const [lat, lon, z] = [40.2463724, -111.6474138, 15],
      t = tile_at(lat * rad, lon * rad, z);
    near(t.x, 2 ** z * ((lon + 180) / 360), 1e-6);
    near(t.y, (2 ** z * (1 - Math.log(Math.tan(lat * rad) + 1 / Math.cos(lat * rad)) / Math.PI)) / 2, 1e-6);
    const back = corner_of(t);
    near(back.lat, lat * rad, 1e-12);
    near(back.lon, lon * rad, 1e-12);
  },
  "the corners of a tile agree with the geodesy of the flight, at the origin, 5 km and 70 km from it"() {
    const rad = Math.PI / 180;
    // latitude, longitude, height of the origin; latitude and longitude of a place; its north and east by GeographicLib 2.1, LocalCartesian
    for (const [lat0, lon0, h, lat, lon, n, e] of [
      [40.2463724, -111.6474138, 1387, 40.2913724, -111.6474138, 4997.88, 0],
      [40.2463724, -111.6474138, 1387, 40.2463724, -111.5874138, 1.7274, 5106.2777],
      [40.2463724, -111.6474138, 1387, 40.2143724, -111.6054138, -3553.1777, 3576.0773],
      [40.2463724, -111.6474138, 1387, 39.7463724, -111.1474138, -55407.8473, 42863.2385],
      [-33.9, 151.2, 20, -33.855, 151.14, 4989.8016, -5552.5042],
      [63, 10, 150, 63.045, 9.94, 5017.3243, -3035.7591],
      [63, 10, 150, 63, 10, 0, 0],
    ]) {
      const plane = new LocalPlane({ lat_deg: lat0, lon_deg: lon0, alt_msl_m: h });
      const p = plane.to_plane(lat * rad, lon * rad);
      near(p.n, n, 2e-4);
      near(p.e, e, 2e-4);
      const place = plane.to_place({ n, e });
      near(place.lat / rad, lat, 1e-8);
      near(place.lon / rad, lon, 1e-8);
    }
  },
  "5 km from the origin the pixels of a tile are accurate to one pixel, at any scale"() {
    const plane = new LocalPlane({ lat_deg: 63, lon_deg: 10, alt_msl_m: 150 });
    for (const px_per_m of [0.004, 0.02, 0.1, 1, 4]) {
      const z = plane.zoom_for(px_per_m);
      const [high, low] = [
        { n: 5000, e: 5000 },
        { n: 5000 - 300 / px_per_m, e: 5000 - 300 / px_per_m },
      ];
      const list = plane.tiles_of(low, high, z);
      assert.ok(list.length > 0 && list.length < 40, `${list.length} tiles`);
      for (const t of list) {
        const size = 1 / parts_at(px_per_m);
        const { corner, right, down } = plane.frame_of(t, size);
        for (const [u, v] of [
          [1, 1],
          [0.5, 0.5],
          [1, 0.5],
        ]) {
          const c = corner_of({ z, x: t.x + u * size, y: t.y + v * size }),
            true_at = plane.to_plane(c.lat, c.lon);
          const n = corner.n + u * (right.n - corner.n) + v * (down.n - corner.n),
            e = corner.e + u * (right.e - corner.e) + v * (down.e - corner.e);
          assert.ok(Math.hypot(n - true_at.n, e - true_at.e) * px_per_m < 1, `zoom ${z}`);
        }
      }
      // all of the rectangle is covered: each of its corners lies in one of the tiles
      for (const p of [low, high, { n: low.n, e: high.e }]) {
        const place = plane.to_place(p),
          t = tile_at(place.lat, place.lon, z);
        assert.ok(list.some((k) => k.x === Math.floor(t.x) && k.y === Math.floor(t.y)));
      }
      const wide = (plane.frame_of(list[0]).right.e - plane.frame_of(list[0]).corner.e) * px_per_m;
      assert.ok(wide > 256 / 1.5 && wide < 256 * 1.5, `a tile is ${wide} pixels wide`);
    }
    assert.deepEqual(
      plane.tiles_of({ n: -5000, e: -5000 }, { n: 5000, e: 5000 }, 19),
      [],
      "no million of tiles",
    );
  },
});
