// SPDX-License-Identifier: BSD-3-Clause
// The height with two contradicting sensors: a static port with dynamic pressure, a barometer with noise
// under load, a receiver with a temporary or a constant error.
#include <doctest/doctest.h>

#include "flight_bench.hpp"

namespace height_test {

using namespace synthetic;

namespace {

/// Height after `from_s`: largest step beyond the vertical velocity, mean and RMS error.
struct Heights {
  double from_s = 0, step_m = 0, mean_m = 0, rms_m = 0, before_m = 0, before_s = -1;
  int n = 0;
  void see(const Truth& x, const VehicleState& s) {
    const double climbed = s.climb_rate_mps * (x.t - before_s);
    if (before_s > 0) step_m = std::max(step_m, std::abs(s.height_m - before_m - climbed));
    before_m = s.height_m;
    before_s = x.t;
    if (x.t < from_s) return;
    const double e = s.height_m + x.p_n.z();
    ++n;
    mean_m += e;
    rms_m += e * e;
  }
  void end() {
    mean_m /= n;
    rms_m = std::sqrt(rms_m / n);
  }
};

/// The aircraft changes its speed; the static port has `share` of the dynamic pressure.
Flown with_port(const std::function<double(double)>& share) {
  Flown f{};
  f.quality.height_walk_m = 0;
  f.alter = [share](const Truth& x, Samples& s) {
    if (!s.baro) return;
    const Air air = standard_air(1387 - x.p_n.z());
    s.baro->pressure_pa += share(x.t) * 0.5 * air.density_kgm3 * x.airspeed() * x.airspeed();
  };
  return f;
}

}  // namespace

TEST_CASE("a static port that sees a share of the dynamic pressure is learnt, either way") {
  for (const double share : {0.15, -0.15}) {
    CAPTURE(share);
    Flown f = with_port([&](double) { return share; });
    const double naive_m = std::abs(share) * 17 * 17 / (2 * 9.80665);  // 2.2 m: error of the barometer
    Heights h{40};
    f.watch = [&](const Truth& x, const VehicleState& s, Status) { h.see(x, s); };
    f.run();
    h.end();
    CHECK(h.rms_m < 0.5 * naive_m);
    CHECK(h.step_m < 0.5);
  }
}

TEST_CASE("a static port whose share changes in flight is followed when a receiver is there to tell") {
  Flown f = with_port([](double t) { return t < 60 ? 0.0 : 0.5; });  // 7.4 m between two samples
  f.plan.duration_s = 200;
  Heights h{140};
  f.watch = [&](const Truth& x, const VehicleState& s, Status) { h.see(x, s); };
  f.run();
  h.end();
  CHECK(std::abs(h.mean_m) < 4);
  CHECK(h.step_m < 1);
}

TEST_CASE("a barometer that steps, and steps back, moves the height by nothing, in turns as well") {
  for (const double step_pa : {240.0, 40.0, -40.0})
    for (const double bank_rad : {0.0, 0.7}) {
      CAPTURE(step_pa);
      CAPTURE(bank_rad);
      const auto height_off = [&](double pa) {
        Flown f{};
        f.plan.duration_s = 110;
        f.plan.bank_rad = bank_rad;
        f.quality.height_walk_m = 0;
        f.alter = [&](const Truth& x, Samples& s) {
          if (s.baro && x.t > 60 && x.t < 80) s.baro->pressure_pa += pa;
        };
        Heights h{60};
        f.watch = [&](const Truth& x, const VehicleState& s, Status) { h.see(x, s); };
        f.run();
        h.end();
        return h;
      };
      const Heights as_ever = height_off(0), stepped = height_off(step_pa);
      CHECK(std::abs(stepped.mean_m - as_ever.mean_m) < 0.3);  // of 23 m and of 4
      CHECK(stepped.rms_m < as_ever.rms_m + 0.3);
      CHECK(stepped.step_m < 0.3);
    }
}

TEST_CASE("a barometer that goes off within half a second, or scatters, has not stepped") {
  navigation::BaroStep ramp, scatter, gap, goes_on;
  Random r(3);
  bool reported = false;
  for (int k = 0; k < 500; ++k) {
    const double t = 0.02 * k;
    const double off = std::clamp((t - 5) * 8, 0.0, 4.0);  // 8 m/s
    reported = reported || ramp.sampled(off, 0.3, off < 1.5, t);
    const double wild = t < 5 ? 0 : 4 + 3 * r.normal();
    reported = reported || scatter.sampled(wild, 0.3, std::abs(wild) < 1.5, t);
    reported = reported || goes_on.sampled(t < 5 ? 0 : 4 + 4 * (t - 5), 0.3, t < 5, t);
    if (t < 5 || t > 6)
      reported =
          reported || gap.sampled(t < 5 ? 0 : 4, 0.3, t < 5, t);  // the second is reported to no component
  }
  CHECK_FALSE(reported);
}

TEST_CASE("how far the port may be off makes the height less sure, in the air alone") {
  const auto height_std = [](double walk, double duration_s) {
    Flown f{};
    f.plan.duration_s = duration_s;
    f.alter = [](const Truth& x, Samples& s) {
      if (x.t > 3) s.gnss.reset();
    };
    f.set = [&](Ekf::Params& p) { p.static_port_walk.value = walk; };
    f.run();
    return f.last.position_std_m.down;
  };
  CHECK(height_std(0.05, 40) > 1.5 * height_std(0, 40));
  CHECK(height_std(0.05, 5) / height_std(0, 5) == doctest::Approx(1));
}

TEST_CASE("under load a barometer counts for less") {
  const auto height_std = [](double error) {
    Flown f{};
    f.plan.duration_s = 33;  // banked 45 degrees: 1.4 g
    f.plan.bank_rad = 0.8;
    f.alter = [](const Truth& x, Samples& s) {
      if (x.t > 3) s.gnss.reset();
    };
    f.set = [&](Ekf::Params& p) { p.baro_load_error.value = error; };
    f.run();
    return f.last.position_std_m.down;
  };
  CHECK(height_std(1) > 1.05 * height_std(0));
}

TEST_CASE("a receiver with a constant error of 20 m is accepted in seconds, and the height has no step") {
  for (const double off_m : {20.0, -20.0}) {
    CAPTURE(off_m);
    Flown f{};
    f.plan.duration_s = 140;
    f.quality.height_walk_m = 0;
    f.alter = [&](const Truth& x, Samples& s) {
      if (s.gnss && x.t > 60) s.gnss->altitude_m += off_m;
    };
    Heights h{110};
    double after_5_s = 0;
    f.watch = [&](const Truth& x, const VehicleState& s, Status) {
      h.see(x, s);
      if (x.t < 65) after_5_s = s.height_m + x.p_n.z();
      CHECK(s.height_valid);
    };
    f.run();
    h.end();
    CHECK(std::abs(after_5_s) < 10);
    CHECK(h.mean_m / off_m > 0.6);
    CHECK(h.mean_m / off_m < 1.05);
    CHECK(h.step_m < 1);
  }
}

TEST_CASE("a receiver that is off by 20 m for two seconds moves the height by little, and it comes back") {
  Flown f{};
  f.quality.height_walk_m = 0;
  f.alter = [](const Truth& x, Samples& s) {
    if (s.gnss && x.t > 60 && x.t < 62) s.gnss->altitude_m += 20;
  };
  Heights h{75};
  double most = 0;
  f.watch = [&](const Truth& x, const VehicleState& s, Status) {
    h.see(x, s);
    if (x.t > 60) most = std::max(most, std::abs(s.height_m + x.p_n.z()));
  };
  f.run();
  h.end();
  CHECK(most < 4);
  CHECK(h.rms_m < 2);
}

TEST_CASE("what is off by 80 m is refused for ten seconds and then set: no flight resolves it by degrees") {
  Flown f{};
  f.quality.height_walk_m = 0;
  f.alter = [](const Truth& x, Samples& s) {
    if (s.gnss && x.t > 60) s.gnss->altitude_m += 80;
  };
  double before = 0, after = 0;
  f.watch = [&](const Truth& x, const VehicleState& s, Status) {
    const double e = s.height_m + x.p_n.z();
    if (x.t > 60 && x.t < 69) before = std::max(before, std::abs(e));
    if (x.t > 72 && after == 0) after = e;
  };
  f.run();
  CHECK(before < 5);
  CHECK(std::abs(after - 80) < 5);
}

TEST_CASE("a receiver with a large reported height deviation is not accepted for being far off") {
  Flown f{};
  f.plan.duration_s = 110;
  f.quality.height_walk_m = 0;
  f.alter = [](const Truth& x, Samples& s) {
    if (!s.gnss || x.t < 60) return;
    s.gnss->altitude_m += 20;
    s.gnss->vertical_std_m = 20;
  };
  Heights h{80};
  f.watch = [&](const Truth& x, const VehicleState& s, Status) { h.see(x, s); };
  f.run();
  h.end();
  CHECK(h.mean_m < 2);
}

TEST_CASE(
    "a receiver whose climb contradicts by more than the doubt is followed, below it counts by its time") {
  // Change of the vertical velocity two seconds after a change of the receiver's by `off_mps`.
  const auto moved = [](double off_mps, double doubt) {
    Flown f{.quality = ublox};
    f.plan.duration_s = 63;
    f.alter = [&](const Truth& x, Samples& s) {
      if (s.gnss && x.t > 60) s.gnss->velocity_mps.down -= off_mps;
      if (s.baro && x.t > 55) s.baro.reset();
    };
    f.set = [&](Ekf::Params& p) { p.gnss_climb_doubt.value = doubt; };
    f.run();
    return (f.last.climb_rate_mps + f.last_truth.v_n.z()) / off_mps;
  };
  for (const double sign : {1.0, -1.0}) {
    CAPTURE(sign);
    CHECK(moved(sign * 1.2, 0.5) > 0.4);
    CHECK(moved(sign * 1.2, 100) < 0.2);
    CHECK(moved(sign * 0.4, 1) / moved(sign * 0.4, 100) == doctest::Approx(1).epsilon(0.02));
  }
}

TEST_CASE("a receiver whose position scatters by 60 m for half a minute moves neither height nor place") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    Flown f{};
    f.plan.seed = seed;
    f.plan.duration_s = 95;
    f.quality.height_walk_m = 0;
    Random random(seed);
    f.alter = [&](const Truth& x, Samples& s) {
      if (!s.gnss || x.t < 60) return;
      s.gnss->altitude_m += 60 * random.normal();
      s.gnss->latitude_deg += 60 / 111'000.0 * random.normal();
    };
    double height_m = 0, north_m = 0;
    f.watch = [&](const Truth& x, const VehicleState& s, Status) {
      height_m = std::max(height_m, std::abs(s.height_m + x.p_n.z()));
      if (x.t > 60) north_m = std::max(north_m, std::abs(s.position_m.north - x.p_n.x()));
    };
    f.run();
    CHECK(height_m < 6);
    CHECK(north_m < 15);
  }
}

}  // namespace height_test
