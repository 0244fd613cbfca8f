// SPDX-License-Identifier: BSD-3-Clause
// What views compute of figures and places, without a browser.
import assert from "node:assert/strict";

export const view_tests = ({ label_side }, { Rates }) => ({
  "a rate is measured over a whole interval, by flight time: the first one, in which samples start to come, gives none"() {
    const rates = new Rates(), seen = [];
    const count = (t, imu) => {
      rates.count(t, [["imu", imu], ["rare", 0]]);
      seen.push(rates.of("imu"), rates.of("rare"));
    };
    rates.begin();
    count(10, 0), count(11, 237), count(12, 637), count(14, 1437);
    rates.begin(); // shown again, after it was not listened to
    count(90, 1437), count(91, 1500), count(93, 2300);
    const none = undefined;
    assert.deepEqual(seen, [none, none, none, none, 400, 0, 400, 0, none, none, none, none, 400, 0]);
  },
  "a waypoint's height stands away from the legs that meet there, at the right where both sides are as good"() {
    const side = (at, ...next) => Object.values(label_side({ x: at[0], y: at[1] }, next.map(([x, y]) => ({ x, y }))));
    const box = [[0, 0], [10, 40], [0, 40], [10, 0]]; // an hourglass: its corners, in the order of flight
    assert.deepEqual(box.map((at, i) => side(at, box[(i + 3) % 4], box[(i + 1) % 4])), [[-1, 0], [1, 0], [-1, 0], [1, 0]]);
    assert.deepEqual(side([0, 0], [0, -9], [0, 9]), [1, 0]);
    assert.deepEqual(side([0, 0], [-9, 0], [9, 0]), [0, -1]);
    assert.deepEqual(side([0, 0], [-9, -1], [9, -1]), [0, 1]);
    assert.deepEqual([side([0, 0]), side([5, 5], [5, 5])], [[1, 0], [1, 0]]);
  },
});
