// SPDX-License-Identifier: BSD-3-Clause
// A component of an author that contains the estimator, and fuses one more sensor: a height. It runs next to
// the shipped one with the same samples.
#include <doctest/doctest.h>

#include <cstring>

#include "flight_bench.hpp"

namespace hook_test {

using namespace synthetic;

namespace {

struct Height {
  double height_m = 0;
};

struct WithHeight {
  struct Inputs {
    navigation::Inputs sensors;
    Optional<Height> height;
  };
  struct Outputs {
    Probe hooked_ratio;
    navigation::Outputs nav;
  };
  struct Params {
    navigation::Params nav;
    Param doubt{0, "m", 0, 100, "after a second of refusals"};
    Param bias_std{0, "m", 0, 100, "what it may read wrong; 0: nothing, and the filter has no such state"};
  };
  void configure(const Params& p) {
    ekf.configure(p.nav);
    if (p.bias_std > 0) bias = ekf.append({.std = p.bias_std});
  }
  Status activate(const Tick& tick, const Inputs& in, const Params& p, const Applied<Outputs>& last) {
    return ekf.activate(tick, in.sensors, p.nav, last.part(last->nav));
  }
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    out.hooked_ratio = 0;
    return ekf.step(tick, in.sensors, p.nav, out.nav, [&](navigation::Navigator& navigator) {
      out.hooked_ratio = 1;
      if (!in.height || !in.height.fresh()) return;
      const ErrorStateEkf& f = navigator.filter();
      ekf::Scalar z = ekf::position(f, f.at(f.time_s()), 2, -in.height->height_m);
      if (bias >= 0) {  // a positive bias means too small a down position
        z.innovation += f.more().value(bias);
        z.more(bias) = -1;
        learnt = f.more();
      }
      if (p.doubt > 0 && navigator.refused_for_s(aid) > 1)
        navigator.doubt({ekf::pos + 2, ekf::baro}, p.doubt, aid);
      navigator.fuse(z, 0.25, 5, aid);
      refused_for_s = navigator.refused_for_s(aid);
    });
  }
  navigation::Ekf ekf;
  navigation::Aid aid;
  double refused_for_s = 0;
  int bias = -1;                 ///< index of the state: bias, m
  ErrorStateEkf::More learnt{};  ///< at the last height
};

template <class S>
bool equal(const S& a, const S& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

/// The same samples for both. `height` returns the 20 Hz sample of ours from the truth; no sample if it is
/// empty.
struct Both {
  Bench<Ekf> shipped;
  Bench<WithHeight> ours;
  std::function<std::optional<double>(const Truth&)> height{};
  std::function<void(const Truth&, Status, Status)> watch{};
  double silent_from_s = 1e9, silent_s = 0;

  void run(double duration_s) {
    Plan plan;
    plan.duration_s = duration_s;
    const std::vector<Truth> flight = fly(plan);
    Sensors sensors(rosflight, plan, 7);
    shipped.params.origin.value = {plan.lat_deg, plan.lon_deg, plan.alt_m, true};
    shipped.params.origin.is_given = true;
    ours.params.nav = shipped.params;
    double waited = 0;
    for (std::size_t k = 0; k < flight.size(); ++k) {
      const Truth& x = flight[k];
      const Samples s = sensors.at(flight, k);
      waited += 1 / plan.rate_hz;
      const bool silent = x.t > silent_from_s && x.t < silent_from_s + silent_s;
      if (silent && waited < 0.01 - 1e-9) continue;
      if (!silent) {
        feed(shipped, shipped.in, x, s, waited);
        feed(ours, ours.in.sensors, x, s, waited);
        const std::optional<double> h = height ? height(x) : std::nullopt;
        if (h && k % 20 == 0) ours.set(ours.in.height, Height{*h}, -waited);
      }
      const Status a = shipped.step(waited), b = ours.step(waited);
      waited = 0;
      if (watch) watch(x, a, b);
    }
  }
  template <class Bench>
  static void feed(Bench& bench, const navigation::Inputs& in, const Truth& x, const Samples& s, double dt) {
    bench.set(in.imu, s.imu, -dt);
    if (s.gnss) bench.set(in.gnss, *s.gnss, s.gnss_age_s - dt);
    if (s.mag) bench.set(in.mag, *s.mag, -dt);
    if (s.baro) bench.set(in.baro, *s.baro, -dt);
    if (s.pitot) bench.set(in.pitot, *s.pitot, -dt);
    VehicleStatus v;
    v.armed = x.t > 4.8;
    v.on_ground = x.t < 10;
    bench.set(in.status, v);
  }
  bool same() const {
    return shipped.out.state.written == ours.out.nav.state.written &&
           equal(shipped.out.state.value, ours.out.nav.state.value) &&
           equal(shipped.out.check.value, ours.out.nav.check.value) &&
           shipped.out.refused_ratio.value == ours.out.nav.refused_ratio.value;
  }
  double difference_m() const { return ours.out.nav.state.value.height_m - shipped.out.state.value.height_m; }
};

}  // namespace

TEST_CASE("a component that fuses nothing more is the shipped estimator to the last bit, in gaps as well") {
  for (const double gap_s : {0.0, 0.2, 3.0}) {
    CAPTURE(gap_s);
    Both both;
    both.silent_from_s = 40;
    both.silent_s = gap_s;
    bool same = true, hooked_before = false, hooked_in_gap = false, hooked_after = false;
    both.watch = [&](const Truth& x, Status a, Status b) {
      same = same && a == b && both.same();
      const bool hooked = both.ours.out.hooked_ratio.value > 0;
      if (x.t > 39 && x.t < 40) hooked_before = hooked;
      if (x.t > 40.02 && x.t < 40 + gap_s) hooked_in_gap = hooked_in_gap || hooked;
      if (x.t > 44) hooked_after = hooked;
    };
    both.run(46);
    CHECK(same);
    CHECK(hooked_before);
    CHECK_FALSE(hooked_in_gap);
    CHECK(hooked_after);
  }
}

TEST_CASE("what the hook fuses moves the state that is published, and is counted") {
  Both both;
  both.height = [](const Truth& x) { return std::optional(2 - x.p_n.z()); };
  both.run(30);
  CHECK(both.difference_m() == doctest::Approx(2).epsilon(0.25));
  const navigation::Aid& aid = both.ours.component().aid;
  CHECK(aid.accepted > 400);
  CHECK(aid.refused == 0);
  CHECK(std::abs(aid.ratio) < 3);
  CHECK(both.ours.out.nav.state.value.position_std_m.down < both.shipped.out.state.value.position_std_m.down);
}

TEST_CASE(
    "what the gate refuses leaves the state as it is; it is counted, here and with all that was refused") {
  Both both;
  both.height = [](const Truth& x) { return x.t > 20 ? std::optional(60 - x.p_n.z()) : std::nullopt; };
  bool same = true;
  both.watch = [&](const Truth&, Status, Status) {
    same = same && equal(both.shipped.out.state.value, both.ours.out.nav.state.value);
  };
  both.run(25);
  CHECK(same);
  const navigation::Aid& aid = both.ours.component().aid;
  CHECK(aid.refused == 99);  // at 20 Hz in less than 5 s
  CHECK(aid.accepted == 0);
  CHECK(aid.ratio < -5);
  CHECK(both.ours.out.nav.refused_ratio.value == both.shipped.out.refused_ratio.value + 99);
  CHECK(both.ours.component().refused_for_s == doctest::Approx(4.9).epsilon(0.01));
}

TEST_CASE(
    "a state that is doubted lets in what its gate had refused, as far as it is doubted and no farther") {
  for (const double doubt_m : {2.0, 12.0}) {
    Both both;
    both.ours.params.doubt.value = doubt_m;
    both.height = [](const Truth& x) { return x.t > 20 ? std::optional(30 - x.p_n.z()) : std::nullopt; };
    both.run(25);
    CAPTURE(doubt_m);
    CHECK((both.ours.component().aid.accepted > 0) == (doubt_m > 6));
    CHECK((both.difference_m() > 10) == (doubt_m > 6));
  }
}

TEST_CASE("an appended state learns the bias of the sensor, with its standard deviation") {
  for (const double high_m : {-3.0, 3.0}) {
    CAPTURE(high_m);
    Both both;
    both.ours.params.bias_std.value = 5;
    both.height = [&](const Truth& x) { return std::optional(high_m - x.p_n.z()); };
    both.run(60);
    const WithHeight& ours = both.ours.component();
    REQUIRE(ours.learnt.count() == 1);
    const double bias_m = ours.learnt.value(0), std_m = ours.learnt.std(0);
    CHECK(ours.aid.refused == 0);
    CHECK(bias_m / high_m == doctest::Approx(1).epsilon(0.25));
    CHECK(std::abs(bias_m - high_m) < 2 * std_m);
    // Its accuracy is that of the height: both are one unknown.
    const double height_std_m = both.ours.out.nav.state.value.position_std_m.down;
    CHECK(std_m / height_std_m == doctest::Approx(1).epsilon(0.1));
    // A sensor with a constant bias measures changes of the height, and little of the height itself.
    const double of_shipped = height_std_m / both.shipped.out.state.value.position_std_m.down;
    CHECK(of_shipped < 1.01);
    CHECK(of_shipped > 0.75);
    CHECK(std::abs(both.difference_m()) < 0.3);
  }
}

TEST_CASE("appended states survive a gap, and restart at a switch or at set-up") {
  Both both;
  both.silent_from_s = 30;
  both.silent_s = 3;
  both.ours.params.bias_std.value = 5;
  both.height = [](const Truth& x) { return std::optional(3 - x.p_n.z()); };
  ErrorStateEkf::More before;
  both.watch = [&](const Truth& x, Status, Status) {
    if (x.t < 30) before = both.ours.component().learnt;
  };
  both.run(40);
  CHECK(before.std(0) < 1.5);
  CHECK(both.ours.component().learnt.value(0) == doctest::Approx(before.value(0)).epsilon(0.3));
  navigation::Ekf ekf;
  const navigation::Params p = both.shipped.params;
  for (int i = 0; i < 3; ++i) {  // after repeated configurations: one state, not three
    ekf.configure(p);
    CHECK(ekf.append({.std = 2}) == 0);
  }
  navigation::Navigator navigator;
  navigator.start(p);
  navigator.filter().append({.std = 2});
  navigator.filter().more().set(0, 1, 0.5);
  navigator.resume(both.shipped.out.state.value, p, 40);
  REQUIRE(navigator.filter().more().count() == 1);
  CHECK(navigator.filter().more().value(0) == 0);
  CHECK(navigator.filter().more().std(0) == doctest::Approx(2));
}

TEST_CASE("after a gap that ends in an alignment what the hook fuses moves the state again") {
  Both both;
  both.silent_from_s = 30;
  both.silent_s = 3;
  both.height = [](const Truth& x) { return std::optional(2 - x.p_n.z()); };
  std::uint32_t before = 0;
  both.watch = [&](const Truth& x, Status, Status) {
    if (x.t < 33) before = both.ours.component().aid.accepted;
  };
  both.run(40);
  CHECK(both.ours.component().aid.accepted > before + 100);
  CHECK(both.difference_m() == doctest::Approx(2).epsilon(0.35));
}

TEST_CASE("it takes over from the state that was applied last, as the shipped one does") {
  Both both;
  both.run(25);
  const VehicleState flown = both.shipped.out.state.value;
  Bench<WithHeight> after;
  after.params.nav = both.shipped.params;
  after.tick.now_ns = 25'000'000'000;
  after.set(after.in.sensors.imu, Imu{});
  Applied<WithHeight::Outputs> last;
  last.outputs.nav.state.value = flown;
  last.made_bits = 0b10;  // bit after the probe: the state
  REQUIRE(after.activate(last) == Status::ok);
  after.set(after.in.sensors.imu, Imu{{0, 0, -9.8}, {}}, -0.0025);
  after.step(0.0025);
  REQUIRE(after.out.nav.state.written);
  CHECK(after.out.nav.state.value.height_m == doctest::Approx(flown.height_m).epsilon(0.01));
  Bench<WithHeight> nobody;
  nobody.params.nav = both.shipped.params;
  nobody.set(nobody.in.sensors.imu, Imu{});
  last.made_bits = 0b01;  // the probe alone
  REQUIRE(nobody.activate(last) == Status::ok);
  nobody.step(0.0025);
  CHECK_FALSE(nobody.out.nav.state.written);
}

}  // namespace hook_test
