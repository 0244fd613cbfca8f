// SPDX-License-Identifier: BSD-3-Clause
// A flight in real time, and its page in a headless browser.
import { spawn } from "node:child_process";
import { once } from "node:events";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";

/** Reason to skip the tests, or "". A chromium of snap cannot read other files. */
export function absent(modules, chromium) {
  if (!existsSync(join(modules, "playwright-core")))
    return "the page's packages are missing: build the target `page`";
  if (!chromium || !existsSync(chromium)) return "chromium is missing (apt-get install chromium)";
  if (readFileSync(chromium).subarray(0, 4096).includes("snap"))
    return "this chromium is a snap, which a test cannot control";
  return "";
}

export async function free_port() {
  const server = createServer().listen(0, "127.0.0.1");
  await once(server, "listening");
  const { port } = server.address();
  server.close();
  return port;
}

/** Starts `fulmar run`; resolves when it listens. */
export async function fly(fulmar, port, mission, ...options) {
  const folder = mkdtempSync(join(tmpdir(), "fulmar-page-"));
  const child = spawn(
    fulmar,
    [
      "run",
      mission,
      "--speed",
      "real",
      "--live",
      `127.0.0.1:${port}`,
      "--log",
      join(folder, "flight.mcap"),
      ...options,
    ],
    { stdio: ["ignore", "pipe", "pipe"] },
  );
  let said = "";
  const listens = new Promise((resolve, reject) => {
    const hear = (bytes) => {
      said += bytes;
      if (said.includes("live view: ws://")) resolve();
    };
    child.stdout.on("data", hear);
    child.stderr.on("data", hear);
    child.on("exit", () => reject(new Error("the flight did not start:\n" + said)));
  });
  await listens;
  return {
    child,
    async end(signal = "SIGKILL") {
      if (child.exitCode === null && child.signalCode === null) {
        child.kill(signal);
        await once(child, "exit");
      }
      rmSync(folder, { recursive: true, force: true });
    },
  };
}

export async function browse(modules, chromium, ...more) {
  const { chromium: engine } = createRequire(join(modules, "x.js"))("playwright-core");
  return engine.launch({
    executablePath: chromium,
    args: [
      "--no-sandbox",
      "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader",
      "--disable-dev-shm-usage",
      ...more,
    ],
  });
}

/** Waits for a condition, at most `patience` seconds. */
export async function until(what, holds, patience = 15) {
  const end = Date.now() + 1000 * patience;
  for (;;) {
    const value = await holds();
    if (value) return value;
    if (Date.now() > end) throw new Error("not within " + patience + " s: " + what);
    await new Promise((go) => setTimeout(go, 40));
  }
}

export function shots_folder(modules) {
  const folder = join(modules, "../../web_shots");
  mkdirSync(folder, { recursive: true });
  return folder;
}
