// SPDX-License-Identifier: BSD-3-Clause
// Gaps of all sensors: short gaps are coasted, long ones end in an alignment in the air. Samples with wrong
// times, and a controller that has zeroed its pitot or barometer in flight.
#include <doctest/doctest.h>

#include "flight_bench.hpp"

namespace gap_test {

using namespace synthetic;

namespace {
constexpr double deg = std::numbers::pi / 180;

bool all_valid(const VehicleState& s) {
  return s.attitude_valid && s.velocity_valid && s.position_valid && s.height_valid;
}
bool any_valid(const VehicleState& s) {
  return s.attitude_valid || s.velocity_valid || s.position_valid || s.height_valid || s.airspeed_valid ||
         s.wind_valid;
}

/// A flight with turns of 30 degrees and a gap of all sensors. During the gap the loop runs each 10 ms, as
/// without an inertial unit.
struct Gap {
  double from_s = 68, length_s = 0.1, after_s = 10;  ///< 68: in the middle of a right turn
  Quality quality = rosflight;
  std::uint64_t seed = 1;
  std::function<void(const Truth&, Samples&)> alter{};
  std::function<void(Bench<Ekf>&, const Truth&, const Samples&, double dt)> feed = feed_all;
  std::function<void(const Truth&, const VehicleState&, Status, double since_s)>
      watch{};  ///< with the time since the start of the gap

  VehicleState last{}, before{}, first{};  ///< before: before the gap; first: first valid state after it
  Truth last_truth{};
  double valid_after_s = -1;                          ///< from the end of the gap to `first`
  double coasted_attitude = 0, coasted_position = 0;  ///< errors at the end of the gap
  Vector3d mean_wind = Vector3d::Zero(), mean_before = mean_wind, mean_first = mean_wind;  ///< without gusts
  double first_attitude = 0,
         step_attitude = 0;  ///< error of `first`; largest move of the error between two states after it
  Vector3d position_jump =
      Vector3d::Zero();  ///< error of `first`; largest step of the error between two states after it
  std::uint64_t allocated = 0;

  bool silent(double t) const { return t > from_s && t < from_s + length_s; }
  Gap& run();

  /// Samples are valid at the time of the next step.
  static void feed_all(Bench<Ekf>& bench, const Truth& x, const Samples& s, double dt) {
    bench.set(bench.in.imu, s.imu, -dt);
    if (s.gnss) bench.set(bench.in.gnss, *s.gnss, s.gnss_age_s - dt);
    if (s.mag) bench.set(bench.in.mag, *s.mag, -dt);
    if (s.baro) bench.set(bench.in.baro, *s.baro, -dt);
    if (s.pitot) bench.set(bench.in.pitot, *s.pitot, -dt);
    VehicleStatus v;
    v.armed = x.t > 4.8;
    v.on_ground = x.t < 10;
    bench.set(bench.in.status, v);
  }

  void judge(const Truth& x);
  Vector3d offset = Vector3d::Zero();  ///< error of the position before the gap
  double error = 0;                    ///< attitude error of the previous state
};

Gap& Gap::run() {
  Plan plan;
  plan.duration_s = from_s + length_s + after_s;
  plan.seed = seed;
  plan.bank_rad = 30 * deg;
  const std::vector<Truth> flight = fly(plan);
  Sensors sensors(quality, plan, plan.seed + 100);
  Bench<Ekf> bench;
  bench.params.origin.value = {plan.lat_deg, plan.lon_deg, plan.alt_m, true};
  bench.params.origin.is_given = true;
  bench.configure();
  double waited = 0;
  for (std::size_t k = 0; k < flight.size(); ++k) {
    const Truth& x = flight[k];
    Samples s = sensors.at(flight, k);
    if (alter) alter(x, s);
    waited += 1 / plan.rate_hz;
    if (silent(x.t) && waited < 0.01 - 1e-9) continue;
    if (!silent(x.t)) feed(bench, x, s, waited);
    Status status{};
    allocated += allocations([&] { status = bench.step(waited); });
    waited = 0;
    if (!bench.out.state.written) {
      CHECK_FALSE((silent(x.t) && x.t > from_s + 0.03));  // up to 0.03 s it may be the rate of a slow unit
      continue;
    }
    last = bench.out.state.value;
    last_truth = x;
    mean_wind =
        eigen(last.wind_mps) - Vector3d(bench.out.gust_north_mps.value, bench.out.gust_east_mps.value, 0);
    judge(x);
    if (watch) watch(x, last, status, x.t - from_s);
  }
  return *this;
}

void Gap::judge(const Truth& x) {
  const double before_it = error;
  error = attitude_error(last, x);
  const Vector3d position_error = eigen(last.position_m) - x.p_n;
  if (x.t <= from_s) {
    before = last;
    offset = position_error;
    mean_before = mean_wind;
  }
  if (silent(x.t)) {
    coasted_attitude = error;
    coasted_position = (position_error - offset).norm();
  }
  if (x.t < from_s + length_s) return;
  if (valid_after_s >= 0) step_attitude = std::max(step_attitude, std::abs(error - before_it));
  if (valid_after_s < 0 && all_valid(last)) {
    valid_after_s = x.t - from_s - length_s;
    first_attitude = error;
    first = last;
    mean_first = mean_wind;
    position_jump = position_error - offset;
  }
}

/// Straight, roll-in, turn, roll-out.
constexpr double places[] = {58, 64.6, 68, 74.5};
}  // namespace

TEST_CASE("a gap of 0.1 s is coasted and flagged, in a turn as well, and nothing is called invalid") {
  for (const Quality& quality : {rosflight, ublox})
    for (const double from : places) {
      Gap g{.from_s = from, .quality = quality};
      g.watch = [](const Truth&, const VehicleState& s, Status status, double since) {
        if (since < -30) return;
        CHECK(all_valid(s));
        if (since > 0.03 && since < 0.099) CHECK(status == Status::degraded);
        if (since > 0.11 || since < 0) CHECK(status == Status::ok);
      };
      g.run();
      CHECK(g.coasted_attitude < 0.5 * deg);
      CHECK(g.coasted_position < 0.02);
      CHECK(g.valid_after_s < 0.01);
      CHECK(g.step_attitude < 0.2 * deg);
      CHECK(attitude_error(g.last, g.last_truth) < 0.8 * deg);
      CHECK(g.allocated == 0);
    }
}

TEST_CASE("after the longest coast the state is invalid, and its standard deviations grow") {
  Gap g{.length_s = 5};
  VehicleState previous;
  g.watch = [&](const Truth&, const VehicleState& s, Status status, double since) {
    if (since > 0.03 && since < 5) {
      CHECK(status == Status::degraded);
      CHECK(all_finite(s));
      if (since < 0.29) CHECK(all_valid(s));
      if (since > 0.31) CHECK_FALSE(any_valid(s));
      CHECK(s.origin_valid);
      if (since > 0.06) {
        CHECK(s.attitude_std_rad.north >= previous.attitude_std_rad.north);
        CHECK(s.velocity_std_mps.east > previous.velocity_std_mps.east);
        CHECK(s.position_std_m.down > previous.position_std_m.down);
        CHECK(s.airspeed_std_mps > previous.airspeed_std_mps);
      }
      if (since > 0.33) CHECK(eigen(s.position_m) == eigen(previous.position_m));  // a constant stand-in
    }
    previous = s;
  };
  g.run();
  CHECK(g.valid_after_s > 0);
  CHECK(g.allocated == 0);
}

TEST_CASE(
    "after a long gap the attitude is found again in the air, in wind, in turns, with what was known kept") {
  for (const bool fine : {true, false})
    for (const double from : places)
      for (const double length : {0.5, 2.0, 5.0})
        for (const std::uint64_t seed : {1u, 2u}) {
          CAPTURE(from);
          CAPTURE(length);
          CAPTURE(fine);
          Gap g{.from_s = from, .length_s = length, .quality = fine ? rosflight : ublox, .seed = seed};
          g.watch = [&](const Truth& x, const VehicleState& s, Status, double since) {
            CHECK(all_finite(s));
            if (since > length + 3) CHECK(attitude_error(s, x) < (fine ? 1 : 7) * deg);
            if (since > length + 3) CHECK((eigen(s.velocity_mps) - x.v_n).norm() < 0.6);
          };
          g.run();
          REQUIRE(g.valid_after_s > 0.4);
          CHECK(g.valid_after_s < 1.5);
          CHECK(g.first_attitude < (fine ? 3 : 7) * deg);
          CHECK(g.step_attitude < 2 * deg);
          CHECK(g.position_jump.head<2>().norm() < 2);
          CHECK(std::abs(g.position_jump.z()) < 1);
          CHECK((eigen(g.first.gyro_bias_radps) - eigen(g.before.gyro_bias_radps)).norm() < 0.003);
          CHECK((eigen(g.first.accel_bias_mps2) - eigen(g.before.accel_bias_mps2)).norm() < 0.1);
          CHECK((g.mean_first - g.mean_before).norm() < 1);
        }
}

TEST_CASE(
    "with the controller's own attitude a gap of up to 2 s ends at once, without a fix as well, in turns") {
  for (const bool receiver : {true, false})
    for (const double from : places)
      for (const double length : {0.5, 1.0, 2.0}) {
        CAPTURE(receiver);
        CAPTURE(from);
        CAPTURE(length);
        Gap g{.from_s = from, .length_s = length, .after_s = 20};
        g.feed = [&](Bench<Ekf>& bench, const Truth& x, const Samples& s, double dt) {
          Samples some = s;
          if (!receiver && x.t > from - 3) some.gnss.reset();
          Gap::feed_all(bench, x, some, dt);
          // Its frame is arbitrary: here rotated by 70 deg and tilted by 3.
          const Eigen::Quaterniond frame = quaternion_from({3 * deg, 0, 70 * deg}) * x.q_nb;
          ControllerAttitude a;
          a.attitude = {frame.w(), frame.x(), frame.y(), frame.z()};
          bench.set(bench.in.attitude, a, -dt);
        };
        double worst = 0, known_s = -1;  // the position is that of a fix, and follows it
        g.watch = [&](const Truth& x, const VehicleState& s, Status, double since) {
          CHECK(all_finite(s));
          if (since > length) worst = std::max(worst, attitude_error(s, x));
          if (since > length && known_s < 0 && s.attitude_valid && s.velocity_valid && s.height_valid)
            known_s = since - length;
        };
        g.run();
        CHECK(known_s >= 0);
        CHECK(known_s < 0.02);
        CHECK(g.first_attitude < 3 * deg);
        CHECK(worst < 4 * deg);
        if (receiver) CHECK(g.position_jump.norm() < 1 + 4 * length);
        CHECK(g.allocated == 0);
      }
}

TEST_CASE("a gap of more than 2 s is not bridged: without a fix the attitude stays unknown") {
  Gap g{.length_s = 2.5};
  g.feed = [&](Bench<Ekf>& bench, const Truth& x, const Samples& s, double dt) {
    Samples some = s;
    if (x.t > 65) some.gnss.reset();
    Gap::feed_all(bench, x, some, dt);
    ControllerAttitude a;
    a.attitude = {x.q_nb.w(), x.q_nb.x(), x.q_nb.y(), x.q_nb.z()};
    bench.set(bench.in.attitude, a, -dt);
  };
  g.run();
  CHECK(g.valid_after_s == -1);
}

TEST_CASE("a second gap before the attitude is found restarts the alignment") {
  Gap g{.length_s = 2};
  g.feed = [](Bench<Ekf>& bench, const Truth& x, const Samples& s, double dt) {
    if (x.t < 70.3 || x.t > 71.3) Gap::feed_all(bench, x, s, dt);
  };
  g.watch = [](const Truth& x, const VehicleState& s, Status, double) {
    if (x.t > 68.4 && x.t < 71.3) CHECK_FALSE(any_valid(s));
  };
  g.run();
  CHECK(g.valid_after_s > 1.3);
  CHECK(g.valid_after_s < 2.5);
  CHECK(g.first_attitude < 3 * deg);
}

TEST_CASE("a gap on the ground, disarmed or armed, ends in an alignment at rest, and the flight is as good") {
  for (const double from : {2.0, 4.5}) {  // armed at 4.8: the take-off run is delayed
    Gap g{.from_s = from, .length_s = 0.4, .after_s = 60};
    Vector3d worst = Vector3d::Zero();
    g.watch = [&](const Truth& x, const VehicleState& s, Status, double since) {
      CHECK(all_finite(s));
      if (x.t > 45) CHECK(attitude_error(s, x) < 1 * deg);
      if (since > 5) worst = worst.cwiseMax((eigen(s.position_m) - x.p_n).cwiseAbs());
    };
    g.run();
    CHECK(g.valid_after_s < 6);
    CHECK(worst.z() < 3);
  }
}

TEST_CASE(
    "a pitot tube that was zeroed in flight is not believed, and the airspeed goes on from wind and "
    "velocity") {
  for (const double length : {0.1, 5.0}) {
    Gap g{.length_s = length, .after_s = 40};
    double zero_pa = 0, worst = 0;
    g.alter = [&](const Truth& x, Samples& s) {
      if (!s.pitot) return;
      if (x.t < 68) zero_pa = s.pitot->pressure_pa;  // zero of the controller
      if (x.t > 68) s.pitot->pressure_pa -= zero_pa;
    };
    g.watch = [&](const Truth& x, const VehicleState& s, Status, double since) {
      if (since < length + 2) return;
      CHECK(s.airspeed_valid);
      worst = std::max(worst, std::abs(s.airspeed_mps - x.airspeed()));
      CHECK(std::abs(s.airspeed_mps - x.airspeed()) < 4 * s.airspeed_std_mps);
    };
    g.run();
    CHECK(zero_pa > 100);
    CHECK(worst < 4);
    CHECK((eigen(g.last.wind_mps) - Vector3d(3, -4, 0)).norm() < 1.5);
  }
}

TEST_CASE("a barometer that reads 500 Pa more after the gap does not move the height by its 40 metres") {
  for (const Quality& quality : {rosflight, ublox}) {
    Gap g{.length_s = 5, .after_s = 20, .quality = quality};
    g.alter = [](const Truth& x, Samples& s) {
      if (s.baro && x.t > 70) s.baro->pressure_pa += 500;
    };
    g.watch = [](const Truth& x, const VehicleState& s, Status, double since) {
      if (since > 7) CHECK(std::abs(s.height_m + x.p_n.z()) < 6);
    };
    g.run();
    CHECK(std::abs(g.position_jump.z()) < 4);
  }
}

TEST_CASE("gyro biases that changed in the gap are learnt again") {
  Gap g{.length_s = 5, .after_s = 30};
  g.alter = [](const Truth& x, Samples& s) {
    if (x.t > 70) {
      s.imu.rate_radps.x += 0.02;
      s.imu.rate_radps.z -= 0.02;
    }
  };
  g.watch = [](const Truth& x, const VehicleState& s, Status, double since) {
    if (since > 15) CHECK(attitude_error(s, x) < 3 * deg);
  };
  g.run();
  CHECK(g.last.gyro_bias_radps.x - g.before.gyro_bias_radps.x == doctest::Approx(0.02).epsilon(0.2).scale(0));
  CHECK(g.last.gyro_bias_radps.z - g.before.gyro_bias_radps.z ==
        doctest::Approx(-0.02).epsilon(0.2).scale(0));
}

TEST_CASE("samples whose time repeats, jumps back or lies in the future are left out") {
  Gap g{.from_s = 60, .length_s = 0, .after_s = 20};
  int wrong = 0;
  g.feed = [&](Bench<Ekf>& bench, const Truth& x, const Samples& s, double dt) {
    const int k = static_cast<int>(std::lround(x.t * 400));
    const bool odd = x.t > 60 && k % 40 < 3;
    Samples other = s;
    if (odd) {
      ++wrong;
      other.imu.rate_radps = {9, -9, 9};
      if (other.mag) other.mag->field_tesla = {-2e-5, 3e-5, 1e-5};
      if (other.baro) other.baro->pressure_pa -= 1000;
      if (other.gnss) other.gnss->latitude_deg += 1e-4;
      if (other.gnss) other.gnss->velocity_mps.north += 1;
    }
    Gap::feed_all(bench, x, other,
                  odd ? k % 40 == 0   ? 0
                        : k % 40 == 1 ? -3600
                                      : 3600
                      : dt);  // repeated, an hour back, an hour ahead
  };
  g.watch = [](const Truth& x, const VehicleState& s, Status, double since) {
    CHECK(all_finite(s));
    if (since > 0) CHECK(attitude_error(s, x) < 0.7 * deg);
    if (since > 0) CHECK(s.attitude_valid);
  };
  g.run();
  CHECK(wrong > 500);
  CHECK((eigen(g.last.position_m) - g.last_truth.p_n).norm() < 5);
}

TEST_CASE("when only the newest of several inertial samples is seen, attitude stays good") {
  Gap g{.from_s = 60, .length_s = 0, .after_s = 30};
  Random random(5);
  int skip = 0;
  g.feed = [&](Bench<Ekf>& bench, const Truth& x, const Samples& s, double dt) {
    if (x.t > 60 && --skip > 0) {
      VehicleStatus v;
      v.armed = true;
      bench.set(bench.in.status, v);
      return;
    }
    skip = static_cast<int>(random.uniform(1, 8));  // one to seven periods of 2.5 ms
    Gap::feed_all(bench, x, s, dt);
  };
  g.watch = [](const Truth& x, const VehicleState& s, Status status, double since) {
    if (since < 0) return;
    CHECK(status == Status::ok);
    CHECK(attitude_error(s, x) < 0.7 * deg);
  };
  g.run();
}

TEST_CASE("found again in a turn it has the velocity of now, not that of the late fix") {
  double sum = 0;  // of ten seeds: the fix has an error of some decimetres per second
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Gap gap{.length_s = 3, .quality = ublox, .seed = seed};
    gap.quality.velocity = 0;
    std::optional<double> off;
    gap.watch = [&](const Truth& x, const VehicleState& s, Status, double since_s) {
      if (off || since_s < 3 || eigen(s.specific_force_mps2).norm() == 0) return;
      off = (eigen(s.velocity_mps) - x.v_n).head<2>().norm();
    };
    gap.run();
    REQUIRE(off);
    sum += *off;
  }
  CHECK(sum / 10 < 0.55);  // 0.15 s of the turn's acceleration are 0.85 m/s
}

TEST_CASE("found again after a gap the gust of before it is over") {
  double before_mps = 0;
  std::optional<double> after_mps;
  Gap gap{.length_s = 5};
  gap.alter = [&](const Truth& x, Samples& s) {
    if (x.t > 64 && s.pitot) s.pitot->pressure_pa *= 1 + 0.2 * std::min(x.t - 64, 1.0);  // a gust from ahead
    if (x.t > gap.from_s) s.pitot.reset();  // the change is not measured
  };
  gap.feed = [&](Bench<Ekf>& bench, const Truth& x, const Samples& s, double dt) {
    const bool known = bench.out.state.written && bench.out.state.value.attitude_valid;
    if (x.t < gap.from_s) before_mps = bench.out.gust_mps.value;
    if (x.t > gap.from_s + gap.length_s && known && !after_mps) after_mps = bench.out.gust_mps.value;
    Gap::feed_all(bench, x, s, dt);
  };
  gap.run();
  REQUIRE(before_mps > 0.3);
  REQUIRE(after_mps);
  CHECK(std::abs(*after_mps) < 0.02);
}

TEST_CASE("after a gap that was coasted the velocity is less sure") {
  double before = 0, after = 0;
  Gap gap{.length_s = 0.25};
  gap.watch = [&](const Truth&, const VehicleState& s, Status, double since_s) {
    if (since_s < 0) before = s.velocity_std_mps.north;
    if (since_s > 0.255 && after == 0) after = s.velocity_std_mps.north;
  };
  gap.run();
  CHECK(after > before + 0.03);
}

}  // namespace gap_test
