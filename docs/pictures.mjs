// SPDX-License-Identifier: BSD-3-Clause
// node pictures.mjs FULMAR NODE_MODULES CHROMIUM MISSION REPORT AIRCRAFT OUT: screenshots of the page in flight, of a report and of the page of
// `fulmar aero see`. docs/pictures.sh starts it.
import { execFileSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { absent, browse, fly, free_port, until } from "../web/test/fixture.mjs";

const [fulmar, modules, chromium, mission, report, aircraft, out] = process.argv.slice(2).map((p) => resolve(p));
const missing = absent(modules, chromium);
if (missing) {
  console.error(missing);
  process.exit(1);
}
const turn_s = 110.5; // flight time of the picture
const browser = await browse(modules, chromium);
const open = async (url, width, height) => {
  const page = await browser.newPage({ viewport: { width, height }, colorScheme: "light" });
  page.on("pageerror", (e) => {
    throw e;
  });
  await page.goto(url);
  return page;
};

/** The view `Fly` in the second turn: fast until shortly before it, then to the same tick, then real time. */
async function flight() {
  const port = await free_port();
  const host = await fly(fulmar, port, mission);
  try {
    const ask = (...words) => execFileSync(fulmar, [...words, "--at", `127.0.0.1:${port}`]).toString();
    const time_s = () => Number(/, (-?[\d.]+) s, /.exec(ask("list"))[1]);
    const page = await open(`http://127.0.0.1:${port}/`, 1280, 800);
    ask("speed", "4");
    await until("the turn", () => time_s() > turn_s - 8, 60);
    ask("pause");
    ask("step", String(Math.round((turn_s - 3 - time_s()) * 400)));
    ask("speed", "1");
    await until("the turn", () => time_s() >= turn_s);
    await page.screenshot({ path: join(out, "page.png") });
  } finally {
    await host.end();
  }
}

/** The report's map and height, then commanded and actual values. */
async function report_of_flight() {
  const page = await open(pathToFileURL(report).href, 1200, 1080);
  await until("the map", async () => (await page.locator("#map_and_height canvas").count()) > 0);
  await page.locator("#map_and_height").evaluate((e) => {
    e.style.scrollMarginTop = "50px"; // below the bar with the times
    e.scrollIntoView();
  });
  await page.waitForTimeout(1000);
  await page.screenshot({ path: join(out, "report.png") });
}

/** The first drawing of the aircraft's page, with its legend, as one SVG file that needs no style of a page. */
async function drawing() {
  const page = await open(pathToFileURL(aircraft).href, 1200, 800);
  const svg = await page.evaluate(() => {
    const copy = (from, to) => {
      const style = getComputedStyle(from);
      for (const name of ["fill", "stroke", "stroke-width", "opacity", "font-size", "text-anchor"])
        if (style.getPropertyValue(name)) to.setAttribute(name, style.getPropertyValue(name));
      to.removeAttribute("class");
      [...from.children].forEach((child, i) => copy(child, to.children[i]));
    };
    const figure = document.querySelector("figure"),
      from = figure.querySelector("svg"),
      to = from.cloneNode(true);
    copy(from, to);
    const set = (e, values) => Object.entries(values).forEach(([name, value]) => e.setAttribute(name, value));
    to.setAttribute("viewBox", "0 0 460 290");
    set(to, { xmlns: "http://www.w3.org/2000/svg", width: 575, height: 362, "font-family": "sans-serif" });
    const ground = document.createElementNS("http://www.w3.org/2000/svg", "rect");
    set(ground, { width: "100%", height: "100%", fill: "#ffffff" });
    to.prepend(ground);
    return to.outerHTML;
  });
  writeFileSync(join(out, "petrel.svg"), svg + "\n");
}

try {
  await drawing();
  await report_of_flight();
  await flight();
} finally {
  await browser.close();
}
