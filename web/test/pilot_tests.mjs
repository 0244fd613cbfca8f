// SPDX-License-Identifier: BSD-3-Clause
// Displays for the pilot, without a browser: alerts, missing conditions before take-off, places, an invalid position.
import assert from "node:assert/strict";

const flying = (flags = {}, more = {}) => ({
  safety: { airborne: true, answer: "none", turn: "either", fence_margin_m: 100, ...flags },
  status: { armed: true, health: "ok", on_ground: false, crashed: false, ...more.status },
  ground: undefined,
  contact: undefined,
  state: { position_valid: true, attitude_valid: true },
  stopped: [],
  ...more.moment,
});
const keys = (list) => list.map((a) => a.key);

export const pilot_tests = (
  { AlertBook, alert_of_event, alerts_of, flags, gate_of, not_ready },
  { places_of },
  { lost_position },
  near,
) => ({
  "each flag of the safety monitor is an alert in the air and none on the ground, also an unknown one"() {
    assert.deepEqual(alerts_of(flying()), []);
    for (const flag of [...Object.keys(flags), "spoiler_jammed"]) {
      const [alert, ...others] = alerts_of(flying({ [flag]: true, answer: "home" }));
      assert.equal(alert.key, flag);
      assert.deepEqual(others, []);
      assert.ok(alert.what && alert.pilot, flag);
      assert.deepEqual(
        alerts_of(flying({ [flag]: true, airborne: false }, { status: { on_ground: true } })),
        [],
      );
    }
  },
  "every answer has a text for the response of the aircraft, and so have pilot and failsafe"() {
    const does = (moment) => alerts_of(moment)[0].does;
    const said = ["none", "level", "glide", "descend", "wait", "land", "home"].map((answer) =>
      does(flying({ gnss_lost: true, answer })),
    );
    assert.equal(new Set(said).size, 7);
    const pilot = does(flying({ gnss_lost: true, answer: "wait" }, { status: { override: true } }));
    const failsafe = does(flying({ gnss_lost: true, answer: "wait" }, { status: { failsafe: true } }));
    assert.ok(!said.includes(pilot) && !said.includes(failsafe) && pilot !== failsafe);
  },
  "the most severe alert comes first, and a crash is the only one"() {
    assert.deepEqual(
      keys(alerts_of(flying({ radio_lost: true, engine_failed: true, battery_low: true, gnss_lost: true }))),
      ["engine_failed", "gnss_lost", "radio_lost", "battery_low"],
    );
    assert.deepEqual(
      keys(alerts_of(flying({ engine_failed: true }, { status: { crashed: true, health: "failed" } }))),
      ["crashed"],
    );
    assert.deepEqual(
      keys(
        alerts_of(flying({ engine_failed: true }, { moment: { contact: { crashed: true, part: "nose" } } })),
      ),
      ["crashed"],
    );
  },
  "faults of the vehicle and stopped components are alerts, with or without a monitor; without one an invalid position too"() {
    assert.deepEqual(keys(alerts_of(flying({}, { status: { failsafe: true } }))), ["failsafe"]);
    assert.deepEqual(keys(alerts_of(flying({}, { status: { health: "failed" } }))), ["vehicle_failed"]);
    assert.deepEqual(keys(alerts_of(flying({}, { status: { health: "degraded" } }))), ["vehicle_degraded"]);
    assert.deepEqual(
      keys(alerts_of(flying({}, { moment: { stopped: [{ name: "slc", role: "outer", heir: "tecs" }] } }))),
      ["guard slc"],
    );
    assert.deepEqual(
      keys(
        alerts_of(
          flying(
            {},
            { moment: { safety: undefined, state: { position_valid: false, attitude_valid: true } } },
          ),
        ),
      ),
      ["gnss_lost"],
    );
    assert.deepEqual(
      keys(
        alerts_of(
          flying(
            {},
            { moment: { safety: undefined, state: { position_valid: false, attitude_valid: false } } },
          ),
        ),
      ),
      ["estimator_failed"],
    );
    assert.deepEqual(
      alerts_of(
        flying(
          {},
          { moment: { safety: undefined, state: { position_valid: false }, ground: { contact: "ground" } } },
        ),
      ),
      [],
    );
  },
  "an alert stays until it is acknowledged, also after its cause, and returns with its cause"() {
    const book = new AlertBook(),
      one = alerts_of(flying({ gnss_lost: true }));
    book.update(one, 10);
    book.update(one, 11);
    assert.deepEqual(
      book.list().map((h) => [h.alert.key, h.since_s, h.now]),
      [["gnss_lost", 10, true]],
    );
    book.update([], 12);
    assert.deepEqual(
      book.list().map((h) => h.now),
      [false],
    );
    book.acknowledge("gnss_lost");
    book.update([], 13);
    assert.deepEqual([book.list(), book.lasting()], [[], []]);
    book.update(one, 14);
    book.acknowledge("gnss_lost");
    book.update(one, 15);
    assert.deepEqual([book.list().length, book.lasting().length], [0, 1]);
    book.update([], 16);
    book.update(one, 17);
    assert.deepEqual(
      book.list().map((h) => h.since_s),
      [17],
    );
  },
  "severe events are alerts, except those that the strip already shows"() {
    const event = (code, severity, component, words) =>
      alert_of_event({ code, severity, component, words }, ["watch"], "continues the mission");
    for (const shown of [
      ["notice", "info", "land", "on the glide slope"],
      ["notice", "warning", "watch", "no position: wait"],
      ["guard", "warning", "slc", "slc was stopped"],
      ["notice", "warning", "fcu", "not ready: no GNSS fix"],
    ])
      assert.equal(event(...shown), null, shown[2]);
    assert.deepEqual(
      [
        event("notice", "warning", "land", "go around").level,
        event("failsafe", "critical", "slc", "failsafe").level,
      ],
      ["warning", "critical"],
    );
    assert.equal(
      event("notice", "warning", "land", "2.5 m too high").key,
      event("notice", "warning", "land", "3.1 m too high").key,
    );
    const book = new AlertBook();
    book.raise(event("notice", "warning", "land", "go around"), 5);
    book.update([], 6);
    assert.equal(book.list()[0].now, true);
    book.acknowledge(book.list()[0].alert.key);
    assert.deepEqual(book.list(), []);
  },
  "flag, estimate and all components with one cause are one alert with one end"() {
    const event = (severity, name, words) =>
      alert_of_event(
        { code: "notice", severity, component: "sensors", name, words },
        ["watch"],
        "continues the mission",
      );
    const book = new AlertBook(),
      now = () => book.list().map((h) => [h.alert.key, h.now]);
    const by_event = event("warning", "gnss_lost", "GNSS position silent: dead reckoning"),
      [by_flag] = alerts_of(flying({ gnss_lost: true }));
    assert.deepEqual(
      [by_event.what, by_event.pilot, by_event.level],
      [by_flag.what, by_flag.pilot, by_flag.level],
    );
    book.raise(by_event, 5);
    book.update([], 6);
    assert.deepEqual(now(), [["gnss_lost", true]]);
    book.update([by_flag], 7);
    assert.deepEqual(now(), [["gnss_lost", true]]);
    book.update([], 8); // the flag ended: the alert was not the event's alone
    assert.deepEqual(now(), [["gnss_lost", false]]);
    book.raise(event("warning", "barometer", "barometer stuck: height by GNSS"), 9);
    book.update([], 10);
    assert.deepEqual(now(), [
      ["barometer", true],
      ["gnss_lost", false],
    ]);
    book.over("barometer");
    assert.deepEqual(
      now().map(([, lasts]) => lasts),
      [false, false],
    );
    book.acknowledge("barometer");
    book.update([], 11);
    assert.deepEqual(now(), [["gnss_lost", false]]);
  },
  "after a crash only the crash remains"() {
    const book = new AlertBook(),
      now = () =>
        book
          .list()
          .map((h) => [h.alert.key, h.now])
          .sort();
    book.raise(
      alert_of_event(
        { code: "notice", severity: "critical", component: "sensors", name: "gyro", words: "gyro stuck" },
        ["watch"],
        "continues the mission",
      ),
      5,
    );
    book.update(alerts_of({ ...flying({}), status: { crashed: true } }), 6);
    assert.deepEqual(now(), [
      ["crashed", true],
      ["gyro", false],
    ]);
  },
  "missing conditions before take-off are a list"() {
    const event = "fcu: not ready: no GNSS fix, no height";
    assert.deepEqual(not_ready(event), ["no GNSS fix", "no height"]);
    assert.deepEqual(not_ready("the radio is lost"), []);
    assert.equal(gate_of({ airborne: false }), null);
    assert.deepEqual(gate_of({ not_ready: { radio: false, wind: true, brakes_hot: true } }).length, 2);
    assert.deepEqual(gate_of({ ready: true, not_ready: { radio: false } }), []);
    assert.deepEqual(alerts_of(flying({ ready: true })), []);
  },
  "geofence, places and runway come from records, in metres or degrees; a separate runway has priority over the plan's"() {
    const nothing = 1e9,
      origin = { lat_deg: 40, lon_deg: -111, alt_msl_m: 0 };
    const corner = (north_m, east_m) => ({ north_m, east_m, lat_deg: nothing, lon_deg: nothing });
    const strip = (north_m, length_m) => ({
      north_m,
      east_m: 5,
      heading_rad: 1,
      length_m,
      lat_deg: nothing,
      lon_deg: nothing,
    });
    const records = [
      { name: "plan", runway: strip(70, 100) },
      null,
      { corners: [corner(1, 2), corner(3, 4), corner(5, 6)] },
      { places: [corner(7, 8), { north_m: nothing, east_m: nothing, lat_deg: 40.001, lon_deg: -111 }] },
      strip(9, 300),
    ];
    const found = places_of(records, origin);
    assert.deepEqual(found.fence, [
      { n: 1, e: 2 },
      { n: 3, e: 4 },
      { n: 5, e: 6 },
    ]);
    assert.deepEqual(found.places[0], { n: 7, e: 8 });
    near(
      found.places[1].n,
      111.04,
      0.05,
      "a thousandth of a degree at 40 degrees, by the meridian's radius of 6361.8 km",
    );
    near(found.places[1].e, 0, 0.001);
    assert.deepEqual(found.runway, { n: 9, e: 5, heading: 1, length: 300 });
    assert.equal(places_of(records.slice(0, 2), origin).runway.n, 70);
    assert.deepEqual(
      places_of(
        [{ places: [{ north_m: nothing, east_m: nothing, lat_deg: 40, lon_deg: -111 }] }, strip(0, 0)],
        null,
      ),
      { fence: [], places: [], runway: null },
    );
  },
  "an invalid position is shown at the estimate with its standard deviation, or at its last place without one"() {
    const state = (valid, std) => ({
      position_valid: valid,
      position_m: { north: 30, east: 40 },
      position_std_m: { north: std, east: std / 2 },
      yaw_rad: 1,
    });
    const last = { n: 1, e: 2, t: 10 };
    assert.equal(lost_position(state(true, 3), last, 12), null);
    assert.equal(lost_position(state(false, 3), null, 12), null);
    const lost = lost_position(state(false, 20), last, 12);
    assert.deepEqual([lost.at, lost.last, lost.age_s], [{ n: 30, e: 40 }, last, 2]);
    near(lost.radius, 20 * Math.sqrt(-2 * Math.log(0.05)), 0.1); // of a round normal distribution
    assert.deepEqual(
      [lost_position(state(false, 1e9), last, 12).at, lost_position(state(false, 1e9), last, 12).radius],
      [last, null],
    );
  },
});
