// SPDX-License-Identifier: BSD-3-Clause
// A server of map tiles for tests, and the colours of a page.
import { once } from "node:events";
import { createServer } from "node:http";

/** Tiles of a mission's map, each with its place written on it; the tile of `at` has four colours that meet there. */
export async function tile_server(at) {
  const asked = [],
    rad = Math.PI / 180;
  const server = createServer((request, response) => {
    const [z, x, y] = request.url.match(/\d+/g).map(Number),
      n = 2 ** z;
    asked.push({ z, x, y, referer: request.headers.referer, url: request.url });
    if (z > 16) return void response.writeHead(404).end(); // farther in there is nothing
    const u = n * (at.lon / 360 + 0.5) - x,
      v = (n / 2) * (1 - Math.asinh(Math.tan(at.lat * rad)) / Math.PI) - y;
    const here = u >= 0 && u < 1 && v >= 0 && v < 1,
      [px, py] = [256 * u, 256 * v];
    const box = (colour, x0, y0, x1, y1) =>
      `<rect x="${x0}" y="${y0}" width="${x1 - x0}" height="${y1 - y0}" fill="${colour}"/>`;
    const quarters = here
      ? box("#f00", 0, 0, px, py) +
        box("#0f0", px, 0, 256, py) +
        box("#00f", 0, py, px, 256) +
        box("#ff0", px, py, 256, 256)
      : box((x + y) % 2 ? "#9ab" : "#bca", 0, 0, 256, 256);
    response.writeHead(200, { "Content-Type": "image/svg+xml" });
    response.end(
      `<svg xmlns="http://www.w3.org/2000/svg" width="256" height="256">${quarters}<text x="20" y="40" font-size="20">${z}/${x}/${y}</text></svg>`,
    );
  }).listen(0, "127.0.0.1");
  await once(server, "listening");
  return { asked, port: server.address().port, close: () => server.close() };
}
/** Colours of a canvas at these places, by a picture of the page: a canvas with images of other servers cannot be read. */
export async function colours_at(browser, view, selector, places) {
  const picture = (await view.locator(selector).screenshot()).toString("base64");
  const empty = await browser.newPage();
  const found = await empty.evaluate(
    async ([data, list]) => {
      const image = new Image();
      image.src = "data:image/png;base64," + data;
      await image.decode();
      const canvas = new OffscreenCanvas(image.width, image.height),
        g = canvas.getContext("2d");
      g.drawImage(image, 0, 0);
      return list.map(([x, y]) => [...g.getImageData(Math.round(x), Math.round(y), 1, 1).data.slice(0, 3)]);
    },
    [picture, places],
  );
  await empty.close();
  return found;
}
