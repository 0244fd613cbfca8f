// SPDX-License-Identifier: BSD-3-Clause
// Gates that open again, standard deviations that match the errors, and late fixes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <fulmar/flight/navigation/alignment.hpp>
#include <numbers>

#include "flight_bench.hpp"

namespace gates_test {

using namespace fulmar;
using namespace synthetic;
using Eigen::Quaterniond;
using Eigen::Vector3d;

TEST_CASE("an alignment in a turn takes in that the fix is late") {
  constexpr double V = 17, w = 0.5, late = 0.15, dt = 0.005, g = isa::g0;
  const double bank = std::atan(V * w / g);
  const auto velocity = [&](double t) { return Vector3d(V * std::cos(w * t), V * std::sin(w * t), 0); };
  const auto attitude = [&](double t) {
    return Quaterniond(Eigen::AngleAxisd(w * t, Vector3d::UnitZ()) *
                       Eigen::AngleAxisd(bank, Vector3d::UnitX()));
  };
  const Vector3d wind = Vector3d::Zero();
  navigation::FlightAlignment alignment;
  (void)alignment.fix(velocity(-late), {g, nullptr, &wind, late});
  for (int i = 0; i < 100; ++i) {
    const double t = (i + 0.5) * dt;
    const Vector3d a(-V * w * std::sin(w * t), V * w * std::cos(w * t), 0);
    const Quaterniond to_body = attitude(t).conjugate();
    alignment.imu(to_body * Vector3d(0, 0, w), to_body * (a - Vector3d(0, 0, g)), dt);
  }
  const auto found = alignment.fix(velocity(0.5 - late), {g, nullptr, &wind, late});
  REQUIRE(found);
  CHECK(found->q_nb.angularDistance(attitude(0.5)) * 180 / std::numbers::pi < 1);
}

TEST_CASE("velocities rejected for long are accepted at last") {
  Flown f{};
  f.plan.seed = 1;
  double most = 0, tilt_std = 0;
  f.alter = [](const Truth& x, Samples& s) {
    if (s.gnss && x.t > 60) s.gnss->velocity_mps.north += 20;
  };
  f.watch = [&](const Truth& x, const VehicleState& s, Status) {
    if (x.t > 70 && x.t < 80) most = std::max(most, s.velocity_mps.north - x.v_n.x());
    if (x.t > 69 && x.t < 72) tilt_std = std::max(tilt_std, s.attitude_std_rad.north);
  };
  f.run();
  CHECK(most > 10);
  CHECK(tilt_std > 0.05);  // the cause of the velocity error may have changed the attitude too
}

TEST_CASE(
    "the height error matches its standard deviation, with a receiver whose height error lasts a minute") {
  double normalised = 0;
  int n = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Flown f{.quality = ublox};
    f.plan.seed = seed;
    f.watch = [&](const Truth& x, const VehicleState& s, Status) {
      if (x.t < 60) return;
      const double error = (s.position_m.down - x.p_n.z()) / s.position_std_m.down;
      normalised += error * error;
      ++n;
    };
    f.run();
  }
  REQUIRE(n > 0);
  CHECK(normalised / n < 2);
}

TEST_CASE("heights rejected for long are accepted at last") {
  Flown f{};
  double most = 0;
  f.alter = [](const Truth& x, Samples& s) {
    if (s.gnss && x.t > 60) s.gnss->altitude_m += 100;
  };
  f.watch = [&](const Truth& x, const VehicleState& s, Status) {
    if (x.t > 72 && x.t < 80) most = std::max(most, s.height_m + x.p_n.z());
  };
  f.run();
  CHECK(most > 50);
}

TEST_CASE("a barometer rejected for long is accepted at last, and then holds the height without GNSS") {
  Flown f{};
  double worst = 0;
  f.alter = [](const Truth& x, Samples& s) {
    if (s.baro && x.t > 60) s.baro->pressure_pa += 500;  // 45 m
    if (x.t > 80) s.gnss.reset();
  };
  f.watch = [&](const Truth& x, const VehicleState& s, Status) {
    if (x.t > 80) worst = std::max(worst, std::abs(s.height_m + x.p_n.z()));
  };
  f.run();
  CHECK(worst < 8);
}

TEST_CASE("more samples of a magnetometer are not more information: its errors last") {
  const auto yaw_std = [](double hz) {
    Flown f{};
    f.plan.duration_s = f.plan.rest_s;
    f.quality.mag_hz = hz;
    f.quality.accel_bias = 0;
    f.set = [](Ekf::Params& p) {  // no other source of yaw uncertainty
      p.mag_deviation.value = 0;
      p.accel_bias_std.value = 1e-3;
    };
    f.run();
    return f.last.attitude_std_rad.down;
  };
  CHECK(yaw_std(50) / yaw_std(10) == doctest::Approx(1).epsilon(0.1));
}

TEST_CASE("the first fix in the air is of the past, too") {
  Flown f{.quality = ublox, .from_s = 47};  // on a straight leg
  f.plan.duration_s = 50;
  f.quality.position_walk_m = f.quality.height_walk_m = f.quality.position_white = 0;
  std::optional<double> behind;
  f.watch = [&](const Truth& x, const VehicleState& s, Status) {
    if (!behind) behind = (x.p_n - eigen(s.position_m)).dot(x.v_n.normalized());
  };
  f.run();
  REQUIRE(behind);
  CHECK(std::abs(*behind) < 0.7);  // 0.15 s at 17 m/s are 2.5 m
}

TEST_CASE("the error of a receiver's climb rate lasts: the vertical velocity is less sure for it") {
  const auto climb_std = [](double time_s) {
    Flown f{.quality = ublox};
    f.plan.duration_s = 60;
    f.alter = [](const Truth&, Samples& s) { s.baro.reset(); };
    f.set = [&](Ekf::Params& p) { p.gnss_climb_time.value = time_s; };
    f.run();
    return f.last.velocity_std_mps.down;
  };
  CHECK(climb_std(5) > 1.5 * climb_std(0));
}

TEST_CASE("in a steep field the yaw has a larger standard deviation") {
  const auto yaw_std = [](double lat, double lon) {
    Flown f{};
    f.plan.duration_s = f.plan.rest_s;
    f.plan.lat_deg = lat;
    f.plan.lon_deg = lon;
    f.quality.accel_bias = 0;
    f.set = [](Ekf::Params& p) {
      p.mag_deviation.value = 0;
      p.accel_bias_std.value = 1e-3;
    };
    f.run();
    return f.last.attitude_std_rad.down;
  };
  CHECK(yaw_std(64.1, -21.9) > 2 * yaw_std(0.1, 36.8));  // Iceland, Kenya: dips of 75 and -22 degrees
}

TEST_CASE("the weight of the pitot's speed is a parameter") {
  const auto airspeed_std = [](double std_mps) {
    Flown f{};
    f.plan.duration_s = 60;
    f.set = [&](Ekf::Params& p) { p.pitot_speed_std.value = std_mps; };
    f.run();
    return f.last.airspeed_std_mps;
  };
  CHECK(airspeed_std(3) > 2 * airspeed_std(0.1));
}

TEST_CASE("one odd sample of the tube is no airspeed") {
  Flown f{};
  f.plan.duration_s = f.plan.rest_s;
  double most = 0;
  f.alter = [](const Truth& x, Samples& s) {
    if (s.pitot && x.t > 3.995 && x.t < 4.005) s.pitot->pressure_pa = 500;  // 30 m/s
  };
  f.watch = [&](const Truth& x, const VehicleState& s, Status) {
    if (x.t > 3.995) most = std::max(most, s.airspeed_mps);
  };
  f.run();
  CHECK(most > 0.5);
  CHECK(most < 4);
}

TEST_CASE("a pitot that is late by 95 ms is right in a throw, and the wind is not spoiled by it") {
  Flown f{};
  f.plan.start_mps2 = 40;  // hand launch to 12 m/s
  f.plan.start_radps = 30;
  f.plan.speed_mps = 12;
  f.plan.wind = {-4.6, -1.9, 0};  // against its course
  f.plan.duration_s = f.plan.rest_s + 15;
  f.quality = ublox;
  f.status = false;
  std::deque<std::optional<Pitot>> late(38);
  f.alter = [&](const Truth&, Samples& s) {
    late.push_back(s.pitot);
    s.pitot = late.front();
    late.pop_front();
  };
  double off = 0, wind_off = 0;
  f.watch = [&](const Truth& x, const VehicleState& s, Status) {
    if (x.t < f.plan.rest_s + 0.5) return;
    off = std::max(off, std::abs(s.airspeed_mps - x.airspeed()));
    wind_off =
        std::max(wind_off, std::hypot(s.wind_mps.north - x.wind_n.x(), s.wind_mps.east - x.wind_n.y()));
  };
  f.run();
  CHECK(off < 2);
  CHECK(wind_off < 3);
}

TEST_CASE("without a barometer the tube's speed is that of the air at the estimated height") {
  const navigation::Params p;
  VehicleState s;
  s.position_m = {0, 0, -3000};
  s.velocity_mps = {17, 0, 0};
  s.origin_valid = s.position_valid = true;
  s.origin_altitude_m = 500;
  navigation::Navigator navigator;
  navigator.resume(s, p, 0);
  navigator.pitot(100, p);
  CHECK(navigator.pitot_mps() / std::sqrt(2 * 100 / standard_air(3500).density_kgm3) == doctest::Approx(1));
}

TEST_CASE("once the air carries it, it does so until the airspeed is well below the least one") {
  Flown f{};
  f.plan.gust_mps = 0;
  f.plan.wind = {3.5, 0, 0};  // 13.5 to 20.5 m/s of airspeed around the circle
  f.plan.duration_s = 110;
  f.set = [](Ekf::Params& p) { p.min_airspeed.value = 18; };
  int carried = 0, dropped = 0;
  f.watch = [&](const Truth&, const VehicleState& s, Status) {
    const bool angles = s.alpha_rad != 0 || s.beta_rad != 0;
    dropped += carried > 0 && !angles ? 1 : 0;
    carried += angles ? 1 : 0;
  };
  f.run();
  CHECK(carried > 1000);
  CHECK(dropped == 0);
}

TEST_CASE("a magnetometer that wakes up after the alignment turns the yaw at once") {
  Flown f{};
  f.plan.duration_s = f.plan.rest_s;
  f.plan.initial_course_rad = 1.4;
  f.quality.mag_ratio = f.quality.accel_bias = 0;
  f.alter = [](const Truth& x, Samples& s) {
    if (x.t < 3.999) s.mag.reset();
  };
  double before = 0, worst = 0;
  f.watch = [&](const Truth& x, const VehicleState& s, Status) {
    double& most = x.t < 3.999 ? before : worst;
    if (x.t < 3.999 || x.t < 4.05) most = std::max(most, std::abs(s.yaw_rad - euler_from(x.q_nb).yaw_rad));
  };
  f.run();
  CHECK(before > 1);  // alignment with the nose to the north
  CHECK(worst < 0.01);
}

}  // namespace gates_test
