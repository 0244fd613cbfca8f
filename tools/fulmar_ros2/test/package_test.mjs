// SPDX-License-Identifier: BSD-3-Clause
// The reader of ROS 2 definitions that Foxglove uses takes every text of a package: node package_test.mjs FULMAR-ROS2 NODE_MODULES PLUGIN...
import assert from "node:assert";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, readdirSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";

const [program, modules, ...plugins] = process.argv.slice(2);
const { parse } = createRequire(join(modules, "x.js"))("@foxglove/rosmsg");
const folder = mkdtempSync(join(tmpdir(), "fulmar_ros2_"));
try {
  execFileSync(program, ["interface-package", folder, ...plugins]);
  const fields = {};
  const texts = readdirSync(join(folder, "msg")).map((file) => [file.slice(0, -4), readFileSync(join(folder, "msg", file), "utf8")]);
  for (const [name, text] of texts) {
    const [definition] = parse(text, { ros2: true, skipTypeFixup: true });
    fields[name] = definition.definitions.filter((field) => !field.isConstant);
  }
  assert.ok(Object.keys(fields).length > 10);
  const plan = Object.fromEntries(fields.Plan.map((field) => [field.name, field]));
  assert.equal(plan.waypoints.type, "fulmar_msgs/Waypoint");
  assert.equal(plan.waypoints.arrayUpperBound, 1024);
  assert.equal(plan.airspeed_mps.type, "float64");
  for (const [name, list] of Object.entries(fields)) {
    for (const { type } of list) assert.ok(!type.includes("/") || fields[type.split("/").pop()], `${name} holds ${type}, which is not there`);
  }
  for (const file of readdirSync(join(folder, "srv"))) {
    for (const half of readFileSync(join(folder, "srv", file), "utf8").split("---\n")) parse(half, { ros2: true, skipTypeFixup: true });
  }
} finally {
  rmSync(folder, { recursive: true });
}
