// SPDX-License-Identifier: BSD-3-Clause
// Computations of the views, without a browser.
import assert from "node:assert/strict";

export const view_tests = ({ label_side }, { Rates }, { last_step, value_at }, near) => ({
  "a rate is measured over a full interval of flight time; the first interval gives none"() {
    const rates = new Rates(),
      seen = [];
    const count = (t, imu) => {
      rates.count(t, [
        ["imu", imu],
        ["rare", 0],
      ]);
      seen.push(rates.of("imu"), rates.of("rare"));
    };
    rates.begin();
    (count(10, 0), count(11, 237), count(12, 637), count(14, 1437));
    rates.begin(); // shown again, after it was not listened to
    (count(90, 1437), count(91, 1500), count(93, 2300));
    const none = undefined;
    assert.deepEqual(seen, [none, none, none, none, 400, 0, 400, 0, none, none, none, none, 400, 0]);
  },
  "the height label of a waypoint is away from its legs, at the right where both sides are equal"() {
    const side = (at, ...next) =>
      Object.values(
        label_side(
          { x: at[0], y: at[1] },
          next.map(([x, y]) => ({ x, y })),
        ),
      );
    const box = [
      [0, 0],
      [10, 40],
      [0, 40],
      [10, 0],
    ]; // an hourglass: its corners, in the order of flight
    assert.deepEqual(
      box.map((at, i) => side(at, box[(i + 3) % 4], box[(i + 1) % 4])),
      [
        [-1, 0],
        [1, 0],
        [-1, 0],
        [1, 0],
      ],
    );
    assert.deepEqual(side([0, 0], [0, -9], [0, 9]), [1, 0]);
    assert.deepEqual(side([0, 0], [-9, 0], [9, 0]), [0, -1]);
    assert.deepEqual(side([0, 0], [-9, -1], [9, -1]), [0, 1]);
    assert.deepEqual(
      [side([0, 0]), side([5, 5], [5, 5])],
      [
        [1, 0],
        [1, 0],
      ],
    );
  },
  "the figures of a second-order step equal its closed form"() {
    const zeta = 0.4,
      omega = 5,
      wd = omega * Math.sqrt(1 - zeta * zeta),
      asked = { t: [], v: [] },
      got = { t: [], v: [] };
    const y = (t) =>
      1 -
      Math.exp(-zeta * omega * t) *
        (Math.cos(wd * t) + (zeta / Math.sqrt(1 - zeta * zeta)) * Math.sin(wd * t));
    for (let i = 0; i <= 1500; ++i) {
      const t = i / 100;
      asked.t.push(t);
      asked.v.push(t <= 5 ? 0.1 : 0.5);
      got.t.push(t);
      got.v.push(t <= 5 ? 0.1 : 0.1 + 0.4 * y(t - 5));
    }
    const step = last_step(asked, got, 0, 0.05);
    near(step.at, 5, 0.011);
    near(step.from, 0.1, 1e-9);
    near(step.to, 0.5, 1e-9);
    near(step.overshoot, Math.exp((-zeta * Math.PI) / Math.sqrt(1 - zeta * zeta)), 0.002); // 25.4 %
    const crossing = (level) => {
      let t = 0;
      while (y(t) < level) t += 1e-4;
      return t;
    };
    near(step.rise_s, crossing(0.9) - crossing(0.1), 0.021);
    let left = 0;
    for (let t = 0; t < 10; t += 1e-4) if (Math.abs(y(t) - 1) > 0.05) left = t;
    near(step.settling_s, left, 0.021);
    const down = last_step(
      { t: asked.t, v: asked.v.map((v) => -v) },
      { t: got.t, v: got.v.map((v) => -v) },
      0,
      0.05,
    );
    near(down.overshoot, step.overshoot, 1e-9);
  },
  "a ramp, a small change, a step before the window, and a step that is too recent are no steps; an angle steps across south"() {
    const t = Array.from({ length: 1000 }, (_, i) => i / 100),
      series = (f) => ({ t, v: t.map(f) });
    const flat = series(() => 0);
    assert.equal(
      last_step(
        series((x) => 0.1 * x),
        flat,
        0,
        0.05,
      ),
      null,
    );
    assert.equal(
      last_step(
        series((x) => (x > 5 ? 0.04 : 0)),
        flat,
        0,
        0.05,
      ),
      null,
    );
    assert.equal(
      last_step(
        series((x) => (x > 5 ? 1 : 0)),
        flat,
        6,
        0.05,
      ),
      null,
    );
    assert.equal(
      last_step(
        series((x) => (x > 9.8 ? 1 : 0)),
        flat,
        0,
        0.05,
      ),
      null,
    );
    assert.equal(last_step({ t: [], v: [] }, flat, 0, 0.05), null);
    const south = last_step(
      series((x) => (x > 5 ? -3.1 : 3.1)),
      series((x) => (x > 6 ? -3.1 : 3.1)),
      0,
      0.05,
      0.4,
      2 * Math.PI,
    );
    near(Math.abs(south.to - south.from), 2 * Math.PI - 6.2, 1e-9);
    near(south.settling_s, 1, 0.02);
    assert.deepEqual(
      [
        value_at(flat, -1),
        value_at(
          series((x) => x),
          5.004,
        ),
        value_at({ t: [], v: [] }, 1),
      ],
      [0, 5, NaN],
    );
  },
});
