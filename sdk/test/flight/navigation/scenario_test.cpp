// SPDX-License-Identifier: BSD-3-Clause
// The component on synthetic flights with known truth: accuracy, start, loss of each sensor, places on the
// Earth, switches.
#define FULMAR_COUNT_ALLOCATIONS
#include <doctest/doctest.h>

#include "flight_bench.hpp"
#include "fulmar/testing.hpp"

namespace scenario_test {

using namespace synthetic;

namespace {
constexpr double deg = std::numbers::pi / 180;
Plan shorter(double duration_s, std::uint64_t seed = 1) {
  Plan p;
  p.duration_s = duration_s;
  p.seed = seed;
  return p;
}
}  // namespace

TEST_CASE(
    "with the sensors of the ROSflight simulator the errors are below the published ones of ROSplane 2.0") {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    Flown f{.plan = shorter(150, seed)};
    const Errors e = f.run();
    CHECK(e.body_velocity.x() < 0.045);
    CHECK(e.body_velocity.y() < 0.089);
    CHECK(e.body_velocity.z() < 0.105);
    CHECK(e.euler.x() < 0.189 * deg);
    CHECK(e.euler.y() < 0.074 * deg);
    CHECK(e.course < 0.112 * deg);
    CHECK(e.position.x() < 1.05 * e.gnss.x());
    CHECK(e.position.y() < 1.05 * e.gnss.y());
    CHECK(e.airspeed < 0.3);
  }
}

TEST_CASE("biases are found: gyros at rest, accelerometers in the turns") {
  Flown f{.plan = shorter(100)};
  f.run();
  Sensors same(rosflight, f.plan, f.plan.seed + 100);  // with the same biases
  CHECK((eigen(f.last.gyro_bias_radps) - same.gyro_bias).norm() < 1e-3);
  CHECK((eigen(f.last.accel_bias_mps2) - same.accel_bias).norm() < 0.03);
}

TEST_CASE("a receiver that is 0.15 s late is used at its time: velocity stays good in turns") {
  Flown late{.plan = shorter(150), .quality = ublox};
  const Errors e = late.run();
  CHECK(e.body_velocity.norm() < 0.2);
  CHECK(e.euler.norm() < 0.6 * deg);
  // The same fixes used as present ones: with the delay fixed, and learnt.
  for (const double known_s : {0.0, 0.05}) {
    CAPTURE(known_s);
    Flown ignored{.plan = shorter(150), .quality = ublox};
    ignored.alter = [](const Truth&, Samples& s) { s.gnss_age_s = 0; };
    ignored.set = [&](Ekf::Params& p) { p.gnss_delay_std.value = known_s; };
    const double ratio = ignored.run().body_velocity.norm() / e.body_velocity.norm();
    if (known_s == 0)
      CHECK(ratio > 3);
    else
      CHECK(ratio < 1.2);
  }
}

TEST_CASE(
    "a delay that is told wrong is learnt, either way, and an outage afterwards is as short as with the "
    "right one") {
  for (const double wrong_s : {0.1, -0.1}) {
    CAPTURE(wrong_s);
    Flown f{.plan = shorter(150), .quality = ublox};
    f.quality.latency_s = 0.15;
    f.alter = [&](const Truth& x, Samples& s) {
      s.gnss_age_s += wrong_s;
      if (x.t > 140) s.gnss.reset();
    };
    const Errors e = f.run();
    CHECK(e.body_velocity.norm() < 0.2);
    CHECK((eigen(f.last.position_m) - f.last_truth.p_n).head<2>().norm() < 12);
    CHECK(std::abs(f.gnss_delay_s + wrong_s) < 0.03);  // reported too old: the learnt delay is smaller
  }
}

TEST_CASE("a receiver that is later than any delay that is learnt is used all the same") {
  Flown f{.plan = shorter(150), .quality = ublox};
  f.quality.latency_s = 0.6;  // with no reported delay
  f.alter = [&](const Truth&, Samples& s) { s.gnss_age_s = 0; };
  f.run();
  CHECK(f.gnss_delay_s < 0.21);  // four initial standard deviations
  CHECK(f.last.position_valid);
  CHECK((eigen(f.last.position_m) - f.last_truth.p_n).head<2>().norm() < 25);
}

TEST_CASE("nothing is published before the first attitude, and then it is already near") {
  Flown f{.plan = shorter(8)};
  bool zero = false;
  f.watch = [&](const Truth& x, const VehicleState& s, Status) {
    zero = zero || (eigen(s.attitude).coeffs() - Quaterniond::Identity().coeffs()).norm() < 1e-9;
    if (x.t < 4.5) CHECK(eigen(s.velocity_mps).norm() < 0.2);
  };
  f.run();
  REQUIRE(f.first_s);
  CHECK(*f.first_s > 0.5);
  CHECK(*f.first_s < 3);
  CHECK_FALSE(zero);
}

TEST_CASE("what is published is consistent with itself") {
  Flown f{.plan = shorter(60)};
  f.watch = [](const Truth& x, const VehicleState& s, Status) {
    if (std::fmod(x.t, 0.5) > 1e-3 && std::fmod(x.t, 0.5) < 0.4999) return;
    CHECK(all_finite(s));
    CHECK(s.height_m == -s.position_m.down);
    CHECK(s.climb_rate_mps == -s.velocity_mps.down);
    CHECK(s.ground_speed_mps == doctest::Approx(std::hypot(s.velocity_mps.north, s.velocity_mps.east)));
    CHECK(eigen(s.attitude).norm() == doctest::Approx(1).epsilon(1e-6));
    if (s.ground_speed_mps > 3)
      CHECK(std::abs(wrap_pi(s.course_rad - std::atan2(s.velocity_mps.east, s.velocity_mps.north))) < 1e-9);
    if (s.ground_speed_mps < 1) CHECK(s.course_rad == s.yaw_rad);
    CHECK(s.origin_altitude_m == 1387);
    if (x.t > 15) {
      const Vector3d u_b = eigen(s.attitude).conjugate() * (eigen(s.velocity_mps) - eigen(s.wind_mps));
      CHECK(s.alpha_rad == doctest::Approx(std::atan2(u_b.z(), u_b.x())).epsilon(1e-6));
      CHECK(s.beta_rad == doctest::Approx(std::asin(u_b.y() / u_b.norm())).epsilon(1e-6));
      CHECK((eigen(s.rate_radps) - x.omega_b).norm() < 0.05);
    }
  };
  f.run();
}

TEST_CASE("the errors match the standard deviations of the filter") {
  Flown f{.plan = shorter(150)};
  double squares = 0;
  int n = 0;
  f.watch = [&](const Truth& x, const VehicleState& s, Status) {
    if (x.t < 20) return;
    const Vector3d theta = log_map(x.q_nb * eigen(s.attitude).conjugate()), std = eigen(s.attitude_std_rad);
    const Vector3d dv = x.v_n - eigen(s.velocity_mps), vstd = eigen(s.velocity_std_mps);
    squares += theta.cwiseQuotient(std).squaredNorm() + dv.cwiseQuotient(vstd).squaredNorm();
    n += 6;
  };
  f.run();
  CHECK(squares / n < 1.5);   // not too small a standard deviation
  CHECK(squares / n > 0.02);  // not too large either
}

TEST_CASE("at any field elevation height is right to two per cent and airspeed to one") {
  for (const double elevation : {0.0, 1387.0, 3000.0}) {
    Flown f{.plan = shorter(90)};
    f.plan.alt_m = elevation;
    f.plan.gust_mps = 0;
    f.quality.position_walk_m = f.quality.height_walk_m = 0;
    double height = 0, airspeed = 0;
    int n = 0;
    f.watch = [&](const Truth& x, const VehicleState& s, Status) {
      if (x.t < 50) return;
      height += s.height_m + x.p_n.z();
      airspeed += s.airspeed_mps - x.airspeed();
      ++n;
    };
    f.run();
    CHECK(std::abs(height / n) < 0.02 * 70);
    CHECK(std::abs(airspeed / n) < 0.01 * 17);
  }
}

TEST_CASE("south of the equator, east of Greenwich, it is as good") {
  for (const auto& [lat, lon] :
       {std::pair{-37.96, 144.76}, std::pair{-54.8, -68.3}, std::pair{64.1, -21.9}, std::pair{0.1, 36.8}}) {
    Flown f{.plan = shorter(90)};
    f.plan.lat_deg = lat;
    f.plan.lon_deg = lon;
    const Errors e = f.run();
    CHECK(e.euler.norm() < 0.5 * deg);
    CHECK(e.course < 0.15 * deg);
  }
}

TEST_CASE(
    "started in the air it finds its attitude to five degrees within thirty seconds, with and without "
    "magnetometer and status") {
  for (const bool magnetometer : {true, false})
    for (const double from : {30.0, 47.0, 61.0}) {  // in a turn, in a straight leg, in the next turn
      Flown f{.plan = shorter(110),
              .from_s = from,
              .judge_from_s = from + 30,
              .origin_given = false,
              .status = magnetometer};
      if (!magnetometer) f.alter = [](const Truth&, Samples& s) { s.mag.reset(); };
      double worst = 0;
      f.watch = [&](const Truth& x, const VehicleState& s, Status) {
        CHECK_MESSAGE(all_finite(s), "at " << x.t);
        if (x.t > from + 30) worst = std::max(worst, attitude_error(s, x));
      };
      f.run();
      REQUIRE(f.first_s);
      CHECK(*f.first_s < from + 3);
      CHECK(worst < 5 * deg);
      CHECK(f.last.position_valid);
    }
}

TEST_CASE(
    "without a magnetometer the take-off run shows the yaw, and until then attitude is not called valid") {
  Flown f{.plan = shorter(90)};
  f.alter = [](const Truth&, Samples& s) { s.mag.reset(); };
  f.watch = [](const Truth& x, const VehicleState& s, Status) {
    if (x.t < 5) CHECK_FALSE(s.attitude_valid);
    if (s.attitude_valid) CHECK(attitude_error(s, x) < 25 * deg);
    if (x.t > 50) CHECK(attitude_error(s, x) < 2 * deg);
  };
  f.run();
  CHECK(f.last.attitude_valid);
}

TEST_CASE("a minute without GNSS is reported, and the position error is below a hundred metres") {
  Flown f{.plan = shorter(150)};
  double worst = 0, worst_attitude = 0;
  f.alter = [](const Truth& x, Samples& s) {
    if (x.t > 60 && x.t < 120) s.gnss.reset();
  };
  f.watch = [&](const Truth& x, const VehicleState& s, Status status) {
    if (x.t > 66 && x.t < 120) {
      CHECK_FALSE(s.position_valid);
      CHECK(status == Status::degraded);
    }
    if (x.t > 60 && x.t < 120) {
      worst = std::max(worst, (eigen(s.position_m) - x.p_n).norm());
      worst_attitude = std::max(worst_attitude, attitude_error(s, x));
      CHECK(s.height_valid);
    }
  };
  f.run();
  CHECK(worst < 100);
  CHECK(worst > 0.5);
  CHECK(worst_attitude < 2 * deg);
  CHECK(f.last.position_valid);
  CHECK((eigen(f.last.position_m) - f.last_truth.p_n).norm() < 6);
}

TEST_CASE("without a pitot airspeed comes from ground velocity and wind, with its standard deviation") {
  Flown f{.plan = shorter(150)};
  f.alter = [](const Truth&, Samples& s) { s.pitot.reset(); };
  f.watch = [](const Truth& x, const VehicleState& s, Status) {
    if (x.t < 4) CHECK_FALSE(s.airspeed_valid);  // without pitot and flight the airspeed is unknown
    if (x.t > 80) {
      CHECK(s.airspeed_valid);
      CHECK(std::abs(s.airspeed_mps - x.airspeed()) < 5 * std::hypot(s.airspeed_std_mps, 0.3));
      CHECK(s.airspeed_mps > 10);
    }
  };
  f.run();
}

TEST_CASE("a tube that ices over in flight is refused, not followed") {
  Flown f{.plan = shorter(120)};
  f.alter = [](const Truth& x, Samples& s) {
    if (x.t > 60 && s.pitot) s.pitot->pressure_pa = 3;
  };
  f.watch = [](const Truth& x, const VehicleState& s, Status) {
    if (x.t > 60) CHECK(std::abs(s.airspeed_mps - x.airspeed()) < 5);
  };
  f.run();
  CHECK(f.last.wind_valid);
}

TEST_CASE("a GNSS position that jumps 20 m for five seconds moves the estimate by less than a metre") {
  Flown f{.plan = shorter(90), .quality = ublox};
  LocalFrame frame(f.plan.lat_deg, f.plan.lon_deg, f.plan.alt_m);
  f.alter = [&](const Truth& x, Samples& s) {
    if (s.gnss && x.t > 60 && x.t < 65) s.gnss->latitude_deg += 20 / 111e3;
  };
  Vector3d before = Vector3d::Zero();
  f.watch = [&](const Truth& x, const VehicleState& s, Status) {
    const Vector3d error = eigen(s.position_m) - x.p_n;
    if (x.t < 60) before = error;
    if (x.t > 60 && x.t < 66) CHECK((error - before).head<2>().norm() < 1);
  };
  f.run();
}

TEST_CASE("fixes rejected for long are accepted at last") {
  Flown f{.plan = shorter(120)};
  f.alter = [](const Truth& x, Samples& s) {
    if (s.gnss && x.t > 60) s.gnss->latitude_deg += 50 / 111e3;
  };
  f.run();
  CHECK(f.last.position_m.north - f.last_truth.p_n.x() > 40);
  CHECK(f.last.position_valid);
}

TEST_CASE("a fix with time alone, a fix without solution and non-finite samples are not used") {
  Flown f{.plan = shorter(70)};
  f.alter = [](const Truth& x, Samples& s) {
    if (x.t < 40) return;
    const double nan = std::nan("");
    if (s.gnss && std::fmod(x.t, 0.2) > 0.05) {
      s.gnss->fix = x.t < 50 ? FixType::time_only : FixType::none;
      s.gnss->latitude_deg = 0;
      s.gnss->velocity_mps = {300, 0, 0};
    }
    if (s.mag && std::fmod(x.t, 1) < 0.3) s.mag->field_tesla.x = nan;
    if (s.baro && std::fmod(x.t, 1) < 0.3) s.baro->pressure_pa = nan;
    if (s.pitot && std::fmod(x.t, 1) < 0.3) s.pitot->pressure_pa = nan;
    if (std::fmod(x.t, 1) < 0.01) s.imu.rate_radps.y = nan;
  };
  f.watch = [](const Truth& x, const VehicleState& s, Status) {
    CHECK(all_finite(s));
    if (x.t > 40) CHECK(attitude_error(s, x) < 1 * deg);
  };
  f.run();
}

TEST_CASE("a magnetometer beside a magnet does not turn the aircraft") {
  Flown f{.plan = shorter(100)};
  f.alter = [](const Truth& x, Samples& s) {
    if (s.mag && x.t > 60) s.mag->field_tesla = {2e-5, -3e-5, 1e-5};  // stuck
  };
  f.watch = [](const Truth& x, const VehicleState& s, Status) {
    CHECK((x.t < 60 || attitude_error(s, x) < 3 * deg));
  };
  f.run();
}

TEST_CASE("the origin is the mean of the first fixes on the ground when the mission gives none") {
  Flown f{.plan = shorter(40), .origin_given = false};
  f.run();
  LocalFrame frame(f.plan.lat_deg, f.plan.lon_deg, f.plan.alt_m);
  REQUIRE(f.last.origin_valid);
  CHECK(
      frame.to_ned(f.last.origin_latitude_deg, f.last.origin_longitude_deg, f.last.origin_altitude_m).norm() <
      8);
  CHECK((eigen(f.last.position_m) - f.last_truth.p_n).norm() < 9);
}

TEST_CASE("tuning does not depend on the rate of the inertial unit") {
  const auto deviations = [](double hz) {
    Flown f{.plan = shorter(80)};
    f.plan.rate_hz = hz;
    f.quality.accel *= std::sqrt(hz / 400);  // the same noise density
    f.quality.gyro *= std::sqrt(hz / 400);
    f.plan.gust_mps = 0;  // the strength of gusts is learnt from gusts
    f.run();
    return std::pair{f.last, f.last_truth};
  };
  const auto [slow, x1] = deviations(200);
  const auto [fast, x2] = deviations(400);
  CHECK(slow.attitude_std_rad.north == doctest::Approx(fast.attitude_std_rad.north).epsilon(0.05).scale(0));
  CHECK(slow.velocity_std_mps.north == doctest::Approx(fast.velocity_std_mps.north).epsilon(0.05).scale(0));
  CHECK(slow.wind_std_mps.east == doctest::Approx(fast.wind_std_mps.east).epsilon(0.05).scale(0));
  CHECK(attitude_error(slow, x1) < 0.3 * deg);
  CHECK(attitude_error(fast, x2) < 0.3 * deg);
}

TEST_CASE("it takes over from another estimate in flight without a step and without a new alignment") {
  Plan plan = shorter(90);
  const std::vector<Truth> flight = fly(plan);
  Sensors sensors(rosflight, plan, 9);
  Bench<Ekf> bench;
  std::optional<double> first;
  for (std::size_t k = 0; k < flight.size(); ++k) {
    const Truth& x = flight[k];
    const Samples s = sensors.at(flight, k);
    if (x.t < 50) continue;
    bench.set(bench.in.imu, s.imu);
    if (!first && k % 7 == 0 && x.t > 50.01) {
      Ekf::Outputs applied;
      VehicleState& v = applied.state.value;
      v.position_m = from_eigen<Ned>(x.p_n);
      v.velocity_mps = from_eigen<Ned>(x.v_n);
      v.attitude = from_eigen(x.q_nb);
      v.gyro_bias_radps = from_eigen<Body>(sensors.gyro_bias);
      v.accel_bias_mps2 = from_eigen<Body>(sensors.accel_bias);
      v.wind_mps = from_eigen<Ned>(plan.wind);
      v.wind_std_mps = {0.5, 0.5, 0.5};
      v.origin_latitude_deg = plan.lat_deg;
      v.origin_longitude_deg = plan.lon_deg;
      v.origin_altitude_m = plan.alt_m;
      v.origin_valid = v.attitude_valid = v.velocity_valid = v.position_valid = true;
      REQUIRE(bench.activate(applied) == Status::ok);
      first = x.t;
      bench.set(bench.in.imu, s.imu);
    }
    if (!first) continue;
    if (s.gnss) bench.set(bench.in.gnss, *s.gnss);
    if (s.mag) bench.set(bench.in.mag, *s.mag);
    if (s.baro) bench.set(bench.in.baro, *s.baro);
    if (s.pitot) bench.set(bench.in.pitot, *s.pitot);
    bench.step(1 / plan.rate_hz);
    if (x.t > *first + 0.01) {
      REQUIRE(bench.out.state.written);
      CHECK(attitude_error(bench.out.state.value, x) < 2 * deg);
      CHECK((eigen(bench.out.state.value.velocity_mps) - x.v_n).norm() < 0.5);
    }
    if (x.t > *first + 0.01 && x.t < *first + 0.1) {  // biases of the other component are kept
      CHECK((eigen(bench.out.state.value.accel_bias_mps2) - sensors.accel_bias).norm() < 0.1);
      CHECK((eigen(bench.out.state.value.wind_mps) - plan.wind).norm() < 1);
    }
  }
}

TEST_CASE("a step allocates nothing, from the first sample through the whole flight") {
  const Plan plan = shorter(40);
  const std::vector<Truth> flight = fly(plan);
  Sensors sensors(rosflight, plan, 3);
  Bench<Ekf> bench;
  std::uint64_t count = 0;
  for (std::size_t k = 0; k < flight.size(); ++k) {
    const Samples s = sensors.at(flight, k);
    bench.set(bench.in.imu, s.imu);
    if (s.gnss) bench.set(bench.in.gnss, *s.gnss);
    if (s.mag) bench.set(bench.in.mag, *s.mag);
    if (s.baro) bench.set(bench.in.baro, *s.baro);
    if (s.pitot) bench.set(bench.in.pitot, *s.pitot);
    if (k == 0) bench.configure();
    count += allocations([&] { bench.step(1 / plan.rate_hz); });
  }
  CHECK(count == 0);
  static int* volatile sink = nullptr;
  CHECK(allocations([] { sink = new int; }) == 1);  // check of the counter
  delete sink;
}

TEST_CASE("the origin is known with the fix that completes the mean") {
  Flown f{.plan = shorter(4), .origin_given = false};
  f.set = [](Ekf::Params& p) { p.origin_fixes.value = 25; };
  std::optional<double> known_s;
  f.watch = [&](const Truth& x, const VehicleState& s, Status) {
    if (s.origin_valid && !known_s) known_s = x.t;
  };
  f.run();
  REQUIRE(known_s);
  CHECK(*known_s == doctest::Approx(2.4).epsilon(0.01));  // ten in a second, the first at 0
}

}  // namespace scenario_test
