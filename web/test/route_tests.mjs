// SPDX-License-Identifier: BSD-3-Clause
// The route of a plan, compared with C++ by the program `route_points`, and the active path segment; a part of words_test.mjs.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { plan_of, point } from "./plan_tests.mjs";

export const route_tests = ({ Route, dubins, wrap }, { piece_ahead }, route_points, near) => ({
  "the fillet of a right angle is a quarter circle (Beard & McLain, 11.1)"() {
    const plan = plan_of([point(0, 0), point(400, 0), point(400, 400), point(0, 400)]);
    const { entry, middle, exit, turn } = new Route(plan).passage(1);
    near(turn, Math.PI / 2, 1e-12);
    for (const [got, want] of [
      [entry.n, 350],
      [entry.e, 0],
      [exit.n, 400],
      [exit.e, 50],
      [middle.n, 350 + 50 * Math.SQRT1_2],
      [middle.e, 50 - 50 * Math.SQRT1_2],
    ])
      near(got, want, 1e-9);
    const length = new Route(plan)
      .legs()
      .flatMap(({ points }) =>
        points.slice(1).map((p, i) => Math.hypot(p.n - points[i].n, p.e - points[i].e)),
      )
      .reduce((a, b) => a + b, 0);
    near(length, 4 * 300 + 2 * Math.PI * 50, 0.5);
  },
  "a corner too tight for a fillet is passed through, the legs are continuous, no segment is tighter than the radius"() {
    const plan = plan_of([
      point(0, 0),
      point(400, 0),
      { ...point(430, 30), course: -2 },
      point(-100, 300),
      point(-100, 300.5),
      point(-80, -200),
    ]);
    const legs = new Route(plan).legs();
    assert.equal(legs.length, 6);
    legs.forEach(({ points }, i) => {
      const before = legs[(i + 5) % 6].points;
      near(points[0].n, before[before.length - 1].n, 1e-6);
      near(points[0].e, before[before.length - 1].e, 1e-6);
      for (let k = 2; k < points.length; ++k) {
        const [a, b, c] = points.slice(k - 2, k + 1),
          l1 = Math.hypot(b.n - a.n, b.e - a.e),
          l2 = Math.hypot(c.n - b.n, c.e - b.e);
        if (l1 < 1e-6 || l2 < 1e-6) continue;
        const turn = Math.abs(wrap(Math.atan2(c.e - b.e, c.n - b.n) - Math.atan2(b.e - a.e, b.n - a.n)));
        assert.ok(turn <= (l1 + l2) / 2 / 50 + 0.02, `leg ${i} turns by ${turn} within ${l1} and ${l2} m`);
      }
    });
    const through = new Route(plan).passage(2).middle;
    assert.deepEqual([through.n, through.e, through.chi], [430, 30, -2]);
  },
  "Dubins paths have the right end and the lengths of closed forms"() {
    let seed = 1;
    const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
    for (let k = 0; k < 300; ++k) {
      const pose = () => ({ n: 600 * random() - 300, e: 600 * random() - 300, chi: 6.28 * random() - 3.14 });
      const from = pose(),
        to = pose();
      let { n, e, chi } = from;
      for (const { curvature, length } of dubins(from, to, 40)) {
        if (curvature === 0) [n, e] = [n + length * Math.cos(chi), e + length * Math.sin(chi)];
        else {
          const after = chi + curvature * length;
          [n, e, chi] = [
            n + (Math.sin(after) - Math.sin(chi)) / curvature,
            e - (Math.cos(after) - Math.cos(chi)) / curvature,
            after,
          ];
        }
      }
      near(n, to.n, 1e-6);
      near(e, to.e, 1e-6);
      near(wrap(chi - to.chi), 0, 1e-8);
    }
    const length = (from, to) => dubins(from, to, 10).reduce((sum, p) => sum + p.length, 0);
    near(length({ n: 0, e: 0, chi: 0 }, { n: 100, e: 0, chi: 0 }), 100, 1e-9);
    near(length({ n: 0, e: 0, chi: 0 }, { n: 0, e: 20, chi: Math.PI }), 10 * Math.PI, 1e-9); // half a circle to the right
    near(length({ n: 0, e: 0, chi: 0 }, { n: 0, e: 0, chi: Math.PI }), (10 * (7 * Math.PI)) / 3, 1e-6); // three arcs: pi/3, 5 pi/3, pi/3
  },
  "a plan that ends in an orbit reaches its circle along a tangent"() {
    const route = new Route(plan_of([point(0, 0), point(500, 0)], "orbit"));
    const { n, e, chi } = route.passage(1).middle;
    near(Math.hypot(n - 500, e), 50, 1e-9);
    near((n - 500) * Math.cos(chi) + e * Math.sin(chi), 0, 1e-9); // square to the radius
    near(Math.atan2(e, n), chi, 1e-9); // straight from the first waypoint
    const legs = route.legs();
    assert.deepEqual(
      legs.map((l) => l.to),
      [1, 1],
    );
    for (const p of legs[1].points) near(Math.hypot(p.n - 500, p.e), 50, 1e-9);
    assert.equal(new Route(plan_of([point(5, 5)])).legs()[0].points.length, 73);
    assert.deepEqual(new Route(plan_of([])).legs(), []);
  },
  "the drawn route is the flown one: fillets, courses, tight corners, points in one place, orbits"() {
    if (!route_points) return console.log("       not compared: route_points is not named");
    let seed = 7;
    const random = (most) => Math.floor((((seed = (seed * 16807) % 2147483647) - 1) / 2147483646) * most);
    const plans = Array.from({ length: 80 }, (_, k) =>
      plan_of(
        Array.from({ length: 2 + random(7) }, (_, i) => {
          // far apart, or some too close for their fillets, or in one place
          const spread = k % 3 === 0 ? 2000 : k % 3 === 1 ? 500 : 120;
          return {
            ...point(random(spread) - spread / 2, random(spread) - spread / 2),
            course: random(4) === 0 ? random(628) / 100 - 3.14 : null,
            id: i + 1,
          };
        }),
        k % 2 === 0 ? "circuit" : "orbit",
        20 + random(60),
      ),
    );
    plans.push(
      plan_of([point(0, 0), point(300, 0), point(300.4, 0), point(300, 300)]),
      plan_of([point(0, 0), point(400, 0), point(0, 10)]),
    );
    const input = plans
      .map(
        (p) =>
          `${p.end} ${p.radius} ${p.waypoints.length}\n` +
          p.waypoints.map((w) => `${w.north} ${w.east} ${w.course ?? "-"}\n`).join(""),
      )
      .join("");
    const flown = execFileSync(route_points, { input, maxBuffer: 1 << 28 })
      .toString()
      .trim()
      .split("\n");
    let at = 0,
      fillets = 0;
    const beside = (p, a, b) => {
      const l = Math.hypot(b.n - a.n, b.e - a.e),
        s =
          l > 0
            ? Math.min(1, Math.max(0, ((p.n - a.n) * (b.n - a.n) + (p.e - a.e) * (b.e - a.e)) / l / l))
            : 0;
      return Math.hypot(p.n - a.n - s * (b.n - a.n), p.e - a.e - s * (b.e - a.e));
    };
    const length = (points) =>
      points.slice(1).reduce((sum, p, i) => sum + Math.hypot(p.n - points[i].n, p.e - points[i].e), 0);
    for (const plan of plans) {
      const drawn = new Route(plan);
      for (const { to, points } of drawn.legs()) {
        const head = flown[at++].split(" ");
        if (head[0] === "orbit") {
          for (const p of points)
            near(Math.hypot(p.n - Number(head[1]), p.e - Number(head[2])), Number(head[3]), 1e-6);
          continue;
        }
        assert.deepEqual(head, ["leg", String(to)]);
        if (drawn.passage(to).turn !== 0) ++fillets;
        const way = [];
        for (; /^[-\d]/.test(flown[at]); ++at)
          way.push({ n: Number(flown[at].split(" ")[0]), e: Number(flown[at].split(" ")[1]) });
        if (way.length === 0) {
          // from one point to another in the same place
          near(length(points), 0, 1e-6);
          continue;
        }
        for (const [p, q] of [
          [points[0], way[0]],
          [points[points.length - 1], way[way.length - 1]],
        ])
          near(Math.hypot(p.n - q.n, p.e - q.e), 0, 1e-5, JSON.stringify(plan));
        near(length(points), length(way), 2e-3 * length(way) + 1e-6, JSON.stringify(plan)); // chords of 6 degrees against those of a metre
        for (const p of points)
          near(Math.min(...way.slice(1).map((q, i) => beside(p, way[i], q))), 0, 0.01, JSON.stringify(plan));
      }
      assert.equal(flown[at++], "end");
    }
    assert.equal(at, flown.length);
    assert.ok(fillets > 40, `${fillets} fillets`);
  },
  "the active segment starts beside the aircraft"() {
    const path = (more) => ({
      kind: "line",
      turn: "right",
      origin_m: { north: 10, east: 20 },
      direction_ratio: { north: 0, east: 0.6, down: -0.8 },
      radius_m: 50,
      remaining_m: 30,
      ...more,
    });
    const far = 1e9,
      at = { n: 13, e: 60 };
    assert.deepEqual(piece_ahead(path({}), at), [
      { n: 10, e: 60 },
      { n: 10, e: 90 },
    ]);
    assert.deepEqual(piece_ahead(path({ remaining_m: far }), at)[1], { n: 10, e: 460 });
    assert.deepEqual(piece_ahead(path({ direction_ratio: { north: 0, east: 0, down: 1 } }), at), []);
    assert.deepEqual(piece_ahead(undefined, at), []);
    for (const [turn, east] of [
      ["right", 70],
      ["left", -30],
    ]) {
      // north of the centre, a quarter on
      const arc = piece_ahead(path({ kind: "orbit", turn, remaining_m: 25 * Math.PI }), { n: 100, e: 20 });
      near(arc[0].n, 60, 1e-9);
      near(arc[0].e, 20, 1e-9);
      near(arc[arc.length - 1].n, 10, 1e-9);
      near(arc[arc.length - 1].e, east, 1e-9);
    }
    const round = piece_ahead(path({ kind: "orbit", remaining_m: far }), { n: 100, e: 20 });
    near(round[round.length - 1].n, round[0].n, 1e-9);
    // behind 30 m of line a wide fillet: a quarter to the left of a circle of 80 m, begun west of its centre
    const next = {
      kind: "orbit",
      turn: "left",
      origin_m: { north: 10, east: 170 },
      radius_m: 80,
      start_rad: -Math.PI / 2,
      length_m: 40 * Math.PI,
      is_curve: false,
    };
    const both = piece_ahead(path({ has_next: true, next }), at),
      end = both[both.length - 1];
    assert.deepEqual(both.slice(0, 2), [
      { n: 10, e: 60 },
      { n: 10, e: 90 },
    ]);
    near(both[2].n, 10, 1e-9);
    near(both[2].e, 90, 1e-9);
    near(end.n, -70, 1e-9);
    near(end.e, 170, 1e-9);
    const line = {
      kind: "line",
      origin_m: { north: 10, east: 90 },
      direction_ratio: { north: 1, east: 0 },
      length_m: 25,
      is_curve: false,
    };
    assert.deepEqual(piece_ahead(path({ has_next: true, next: line }), at).slice(2), [
      { n: 10, e: 90 },
      { n: 35, e: 90 },
    ]);
    for (const none of [
      { has_next: false, next },
      { has_next: true, next: { ...next, is_curve: true } },
      { has_next: true, next, remaining_m: far },
    ])
      assert.equal(piece_ahead(path(none), at).length, 2);
  },
});
