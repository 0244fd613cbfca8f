// SPDX-License-Identifier: BSD-3-Clause
// The published state against its filter: each field by its definition, with fixes and without, in moving air
// and in tilted turns.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "flight_bench.hpp"

namespace claims_test {

using namespace synthetic;
using fulmar::navigation::Navigator;

namespace {

/// The shipped estimator, with access to its navigator.
struct Seen {
  struct Inputs {
    navigation::Inputs sensors;
  };
  struct Outputs {
    navigation::Outputs nav;
  };
  struct Params {
    navigation::Params nav;
  };
  void configure(const Params& p) { ekf.configure(p.nav); }
  Status step(const Tick& tick, const Inputs& in, const Params& p, Outputs& out) {
    navigator = nullptr;
    return ekf.step(tick, in.sensors, p.nav, out.nav, [&](Navigator& n) { navigator = &n; });
  }
  navigation::Ekf ekf;
  Navigator* navigator = nullptr;
};

struct Flight {
  Plan plan{};
  Quality quality = ublox;
  std::function<void(const Truth&, Samples&)> alter{};
  Bench<Seen> bench{};
  /// Calls `watch` with each state and its navigator.
  void run(const std::function<void(const Truth&, const VehicleState&, const Navigator&)>& watch) {
    const std::vector<Truth> flight = fly(plan);
    Sensors sensors(quality, plan, 7);
    bench.params.nav.origin.value = {plan.lat_deg, plan.lon_deg, plan.alt_m, true};
    bench.params.nav.origin.is_given = true;
    for (std::size_t k = 0; k < flight.size(); ++k) {
      const Truth& x = flight[k];
      Samples s = sensors.at(flight, k);
      if (alter) alter(x, s);
      auto& in = bench.in.sensors;
      bench.set(in.imu, s.imu);
      if (s.gnss) bench.set(in.gnss, *s.gnss, s.gnss_age_s);
      if (s.mag) bench.set(in.mag, *s.mag);
      if (s.baro) bench.set(in.baro, *s.baro);
      if (s.pitot) bench.set(in.pitot, *s.pitot);
      VehicleStatus v;
      v.armed = x.t > plan.rest_s - 0.2;
      v.on_ground = x.t < plan.rest_s + 5;
      bench.set(in.status, v);
      bench.step(1 / plan.rate_hz);
      const Navigator* n = bench.component().navigator;
      if (n && bench.out.nav.state.written) watch(x, bench.out.nav.state.value, *n);
    }
  }
};

Plan windy(double duration_s) {
  Plan plan;
  plan.duration_s = duration_s;
  plan.rate_hz = 200;
  plan.wind = {3, -4, 0};
  plan.gust_mps = 1.2;
  return plan;
}
bool same(double a, double b) { return std::abs(a - b) < 1e-9 * (1 + std::abs(b)); }
bool same(const Vec3<Ned>& a, double north, double east, double down) {
  return same(a.north, north) && same(a.east, east) && same(a.down, down);
}

}  // namespace

TEST_CASE("each field of the state is the filter's by its definition") {
  Flight f{.plan = windy(50)};
  int wrong_kinematics = 0, wrong_air = 0, airborne = 0, rolling = 0;
  f.run([&](const Truth& x, const VehicleState& s, const Navigator& n) {
    const ekf::Nominal& e = n.filter().state();
    const Eigen::Matrix3d R = e.q_nb.toRotationMatrix();
    const bool kinematics =
        same(s.position_m, e.p_n.x(), e.p_n.y(), e.p_n.z()) &&
        same(s.velocity_mps, e.v_n.x(), e.v_n.y(), e.v_n.z()) && same(s.height_m, -e.p_n.z()) &&
        same(s.climb_rate_mps, -e.v_n.z()) && same(s.ground_speed_mps, std::hypot(e.v_n.x(), e.v_n.y())) &&
        same(s.roll_rad, std::atan2(R(2, 1), R(2, 2))) && same(s.pitch_rad, -std::asin(R(2, 0))) &&
        same(s.yaw_rad, std::atan2(R(1, 0), R(0, 0))) &&
        (eigen(s.rate_radps) - n.filter().rate_b()).norm() < 1e-12 &&
        (eigen(s.specific_force_mps2) - n.filter().specific_force_b()).norm() < 1e-12 &&
        (eigen(s.gyro_bias_radps) - e.gyro_bias).norm() < 1e-12 &&
        (eigen(s.accel_bias_mps2) - e.accel_bias).norm() < 1e-12;
    wrong_kinematics += !kinematics;
    const double V = s.ground_speed_mps, t = std::clamp((V - 1) / 2, 0.0, 1.0);
    const double moving = t * t * (3 - 2 * t), track = std::atan2(e.v_n.y(), e.v_n.x());
    const double course = s.yaw_rad + moving * wrap_pi(track - s.yaw_rad);
    wrong_kinematics += std::abs(wrap_pi(s.course_rad - course)) > 1e-9;
    const Vector3d wind(e.wind.x() + n.gusts().gust_mps().x(), e.wind.y() + n.gusts().gust_mps().y(), 0);
    wrong_air += !same(s.wind_mps, wind.x(), wind.y(), 0);
    if (!n.airborne()) {
      rolling += x.t > 6;
      wrong_air += !(s.airspeed_mps == n.pitot_mps() && s.alpha_rad == 0 && s.beta_rad == 0);
      return;
    }
    ++airborne;
    const Vector3d u_b = R.transpose() * (e.v_n - wind), u_n = e.v_n - Vector3d(e.wind.x(), e.wind.y(), 0);
    wrong_air +=
        !(same(s.airspeed_mps, u_n.norm() + e.gust_mps) && same(std::tan(s.alpha_rad), u_b.z() / u_b.x()) &&
          same(std::sin(s.beta_rad), u_b.y() / u_b.norm()));
  });
  CHECK(wrong_kinematics == 0);
  CHECK(wrong_air == 0);
  CHECK(airborne > 5000);
  CHECK(rolling > 50);
}

TEST_CASE(
    "reported standard deviations are the filter's, widened by unmodelled errors, with fixes and without") {
  for (const double fixes_until_s : {1e9, 40.0}) {
    Flight f{.plan = windy(60)};
    f.alter = [&](const Truth& x, Samples& s) {
      if (x.t > fixes_until_s) s.gnss.reset();
    };
    navigation::Params& p = f.bench.params.nav;
    p.pitot_scale_std.value = 0.03;
    p.rate_filter.value = 0;
    int wrong = 0, renewed = 0, out = 0;
    Vec3<Ned> before{};
    double max_speed = 0;
    f.run([&](const Truth& x, const VehicleState& s, const Navigator& n) {
      if (x.t < 20 || !n.airborne() || s.attitude_std_rad.down == before.down) return;
      before = s.attitude_std_rad;
      ++renewed;
      const ErrorStateEkf& filter = n.filter();
      const auto P = [&](int i) { return filter.covariance()(i, i); };
      const double silent_s = n.time_s() - n.health().velocity.accepted_s, T = silent_s > 1.5 ? silent_s : 0;
      const double speed = n.gusts().std_mps(p) * (1 - std::exp(-T / n.gusts().time_s(p))),
                   way = speed * T / 2, shared = n.shared_speed_mps();
      out += T > 0;
      max_speed = std::max(max_speed, speed);
      const Vector3d u_n = ekf::air_velocity(filter.state());
      const double v_north2 = P(ekf::vel) + shared * shared + speed * speed,
                   v_east2 = P(ekf::vel + 1) + shared * shared + speed * speed, yaw2 = P(ekf::theta + 2);
      const Eigen::Matrix2d& G = n.gusts().covariance();
      const auto square = [](double a) { return a * a; };
      ekf::Row H = ekf::Row::Zero();  // of the airspeed, by definition
      H.segment<3>(ekf::vel) = u_n.normalized().transpose();
      H.segment<2>(ekf::wind) = -u_n.normalized().head<2>().transpose();
      H(ekf::gust) = 1;
      const bool right =
          same(s.attitude_std_rad, std::sqrt(P(0)), std::sqrt(P(1)), std::sqrt(P(2))) &&
          same(s.velocity_std_mps, std::sqrt(v_north2), std::sqrt(v_east2), std::sqrt(P(ekf::vel + 2))) &&
          same(s.position_std_m, std::hypot(filter.std(ekf::pos), way),
               std::hypot(filter.std(ekf::pos + 1), way), filter.std(ekf::pos + 2)) &&
          same(s.wind_std_mps.north,
               std::sqrt(G(0, 0) + square(0.03 * u_n.x()) + yaw2 * square(u_n.y()) + v_north2)) &&
          same(s.wind_std_mps.east,
               std::sqrt(G(1, 1) + square(0.03 * u_n.y()) + yaw2 * square(u_n.x()) + v_east2)) &&
          same(s.airspeed_std_mps,
               std::sqrt((H * filter.covariance() * H.transpose()).value() + square(0.03 * s.airspeed_mps)));
      wrong += !right;
      const bool level = n.time_s() - n.health().horizontal.accepted_s < p.gnss_timeout &&
                         std::max(s.position_std_m.north, s.position_std_m.east) < 50;
      wrong += s.position_valid != level || !s.attitude_valid || !s.height_valid || !s.airspeed_valid;
      wrong += s.velocity_valid != (std::max(v_north2, v_east2) < 9);
      wrong += s.wind_valid != (std::max(s.wind_std_mps.north, s.wind_std_mps.east) < 3);
    });
    CHECK(wrong == 0);
    CHECK(renewed > 2000);
    CHECK(renewed < 4100);  // at 100 Hz
    CHECK((out > 1000) == (fixes_until_s < 100));
    CHECK((max_speed > 0.5) == (fixes_until_s < 100));
  }
}

TEST_CASE("the published rate lags behind the filter's by a first-order low-pass of its cut-off") {
  Flight f{.plan = windy(32)};
  f.bench.params.nav.rate_filter.value = 3;
  Vector3d lag = Vector3d::Zero();
  bool begun = false;
  double off = 0, most = 0;
  f.run([&](const Truth&, const VehicleState& s, const Navigator& n) {
    const Vector3d rate = n.filter().rate_b();
    lag = begun ? Vector3d(lag + (1 - std::exp(-2 * std::numbers::pi * 3 * 0.005)) * (rate - lag)) : rate;
    begun = true;
    off = std::max(off, (eigen(s.rate_radps) - lag).norm());
    most = std::max(most, (rate - lag).norm());
  });
  CHECK(off < 1e-9);
  CHECK(most > 0.01);
}

TEST_CASE("probes and the check say of each sensor its own, and correlations are those of the filter") {
  Flight f{.plan = windy(40)};
  int wrong = 0, checks = 0;
  f.run([&](const Truth& x, const VehicleState&, const Navigator& n) {
    if (x.t < 25) return;
    const auto& out = f.bench.out.nav;
    const navigation::Health& h = n.health();
    const ekf::Nominal& e = n.filter().state();
    wrong +=
        !(out.horizontal_ratio.value == std::abs(h.horizontal.ratio) &&
          out.height_ratio.value == std::abs(h.height.ratio) &&
          out.velocity_ratio.value == std::abs(h.velocity.ratio) && out.baro_ratio.value == h.baro.ratio &&
          out.pitot_ratio.value == h.pitot.ratio && out.sideslip_ratio.value == h.sideslip.ratio &&
          out.heading_ratio.value == h.heading.ratio && out.refused_ratio.value == h.refused &&
          out.gust_mps.value == e.gust_mps && out.gust_north_mps.value == n.gusts().gust_mps().x() &&
          out.gust_east_mps.value == n.gusts().gust_mps().y() && out.baro_bias_m.value == e.baro_m &&
          out.static_port_ratio.value == e.port_ratio && out.heading_deviation_rad.value == e.heading_rad &&
          out.gnss_delay_s.value == e.gnss_delay_s);
    if (!out.check.written) return;
    ++checks;
    const FilterCheck& c = out.check.value;
    const ekf::Covariance& P = n.filter().covariance();
    std::size_t k = 0;
    for (int i = 1; i < 9; ++i)
      for (int j = 0; j < i; ++j, ++k)
        wrong += std::abs(c.correlation_ratio[k] - P(i, j) / std::sqrt(P(i, i) * P(j, j))) > 1e-6;
    wrong += !same(c.mean_wind_mps, e.wind.x(), e.wind.y(), 0);
    const Eigen::Vector2d by_gusts = n.wind_error().std_mps();
    wrong += !same(c.mean_wind_std_mps.north, std::hypot(n.filter().std(ekf::wind), by_gusts.x())) ||
             !same(c.mean_wind_std_mps.east, std::hypot(n.filter().std(ekf::wind + 1), by_gusts.y()));
    wrong += eigen(c.position_innovation_ratio) != h.position_innovation ||
             eigen(c.velocity_innovation_ratio) != h.velocity_innovation;
  });
  CHECK(wrong == 0);
  CHECK(checks == 75);
}

TEST_CASE("where the aircraft was while it accelerated is remembered to a millimetre") {
  ErrorStateEkf filter;
  ekf::Nominal x;
  x.v_n = {15, -4, 1};
  x.p_n = {100, 50, -70};
  filter.reset(x, ekf::Vector::Ones(), 3);
  const Vector3d a(3, -2, 1.5);
  for (int k = 0; k < 120; ++k)
    filter.predict(Vector3d::Zero(), a - Vector3d(0, 0, filter.gravity_mps2), 0.0045);
  for (const double t : {3.543, 3.5385, 3.5, 3.32, 3.1, 3.0}) {
    CAPTURE(t);
    const double s = t - 3;
    const ErrorStateEkf::Past past = filter.at(std::min(t, filter.time_s()));
    if (t > filter.time_s()) continue;
    CHECK(past.known);
    CHECK(past.age_s == doctest::Approx(0.54 - s));
    CHECK((past.v_n - (x.v_n + s * a)).norm() < 1e-6);
    CHECK((past.p_n - (x.p_n + s * x.v_n + 0.5 * s * s * a)).norm() < 1e-3);
  }
  CHECK_FALSE(filter.at(2.99).known);
}

}  // namespace claims_test
