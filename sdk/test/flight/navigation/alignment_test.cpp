// SPDX-License-Identifier: BSD-3-Clause
// The first attitude: detection of rest, and the alignment in the air.
#include <doctest/doctest.h>

#include <cmath>
#include <fulmar/flight/earth/atmosphere.hpp>
#include <fulmar/flight/navigation/alignment.hpp>
#include <numbers>

#include "flight_bench.hpp"

namespace alignment_test {

using namespace fulmar;
using namespace fulmar::navigation;

namespace {
constexpr double g = isa::g0, dt = 0.005;

/// A steady turn in moving air, with the nose into the relative wind.
struct Turning {
  double airspeed = 17, rate = 0.5;
  Vector3d wind = Vector3d::Zero();
  double bank() const { return std::atan(airspeed * rate / g); }
  Vector3d velocity(double t) const {
    return airspeed * Vector3d(std::cos(rate * t), std::sin(rate * t), 0) + wind;
  }
  Vector3d acceleration(double t) const {
    return airspeed * rate * Vector3d(-std::sin(rate * t), std::cos(rate * t), 0);
  }
  Quaterniond attitude(double t) const {
    return Quaterniond(Eigen::AngleAxisd(rate * t, Vector3d::UnitZ()) *
                       Eigen::AngleAxisd(bank(), Vector3d::UnitX()));
  }
  void feel(FlightAlignment& alignment, double from, double to) const {
    for (double t = from + dt / 2; t < to; t += dt) {
      const Quaterniond to_body = attitude(t).conjugate();
      alignment.imu(to_body * Vector3d(0, 0, rate), to_body * (acceleration(t) - Vector3d(0, 0, g)), dt);
    }
  }
};
double degrees(const std::optional<FlightAlignment::Found>& found, const Quaterniond& truth) {
  return found ? found->q_nb.angularDistance(truth) * 180 / std::numbers::pi : 180;
}
}  // namespace

TEST_CASE("a known wind is taken out of the course: the nose points into the air") {
  Turning flight;
  flight.wind = {-2, 6, 0};
  FlightAlignment alignment;
  const FlightAlignment::Known known{g, nullptr, &flight.wind, 0};
  (void)alignment.fix(flight.velocity(0), known);
  flight.feel(alignment, 0, 0.5);
  CHECK(degrees(alignment.fix(flight.velocity(0.5), known), flight.attitude(0.5)) < 3);
}

TEST_CASE("a field that is measured all along a turn is turned back to its beginning") {
  const Turning flight{.rate = 0.8};
  const Vector3d field(2e-5, 5e-6, -1e-5);  // far from the specific force
  FlightAlignment alignment;
  const FlightAlignment::Known known{g, &field, nullptr, 0};
  (void)alignment.fix(flight.velocity(0), known);
  for (double t = 0; t < 0.999; t += 0.02) {
    flight.feel(alignment, t, t + 0.02);
    alignment.mag(flight.attitude(t + 0.02).conjugate() * field);
  }
  CHECK(degrees(alignment.fix(flight.velocity(1), known), flight.attitude(1)) < 1);
}

TEST_CASE("a window with a gap of the inertial unit in it is none") {
  const Turning flight;
  for (const double gap_s : {0.05, 0.2}) {
    FlightAlignment alignment;
    const FlightAlignment::Known known{g, nullptr, nullptr, 0};
    (void)alignment.fix(flight.velocity(0), known);
    flight.feel(alignment, 0, 0.3);
    alignment.imu(Vector3d::Zero(), {0, 0, -g}, gap_s);
    flight.feel(alignment, 0.3 + gap_s, 0.6);
    CHECK(alignment.fix(flight.velocity(0.6), known).has_value() == (gap_s < 0.1));
  }
}

TEST_CASE("a unit rests after a second of blocks that agree, and after a gap it takes a second again") {
  Stillness stillness;
  const auto seconds = [&](double s, double rate) {
    for (int i = 0; i < std::lround(s / dt); ++i) stillness.update({rate, 0, 0}, {0, 0, -g}, dt);
  };
  seconds(0.7, 0.1);
  CHECK_FALSE(stillness.still());
  seconds(0.4, 0.1);
  CHECK(stillness.still());
  stillness.update({0.1, 0, 0}, {0, 0, -g}, 5);
  seconds(0.5, 0.1);
  CHECK_FALSE(stillness.still());
  seconds(0.8, 0.1);
  CHECK(stillness.still());
}

TEST_CASE("a turn that is even within each block and another in the next is no rest") {
  Stillness stillness;
  for (int block = 0; block < 12; ++block) {
    for (int i = 0; i < 50; ++i) stillness.update({0.05 * block, 0, 0}, {0, 0, -g}, dt);
    CHECK_FALSE(stillness.still());
  }
}

TEST_CASE("a fix that comes late is met with the samples of its own time, however the force has changed") {
  const auto a = [](double t) { return Vector3d(2 * std::cos(3 * t), 6 * std::sin(4 * t), 0); };
  const auto v = [](double t) { return Vector3d(17 + 2.0 / 3 * std::sin(3 * t), -1.5 * std::cos(4 * t), 0); };
  const Vector3d field(2e-5, 5e-6, -1e-5), rate(0.9, 0, 0.2);
  const auto attitude = [&](double t) { return exp_map(t * rate); };
  for (const double late : {0.1, 0.3}) {
    FlightAlignment alignment;
    const FlightAlignment::Known known{g, &field, nullptr, late};
    std::optional<FlightAlignment::Found> found;
    for (int i = 1; i <= 300; ++i) {
      const double t = i * dt;
      const Quaterniond to_body = attitude(t - dt / 2).conjugate();
      alignment.imu(rate, to_body * (a(t - dt / 2) - Vector3d(0, 0, g)), dt);
      alignment.mag(attitude(t).conjugate() * field);
      if (i % 100 == 0) found = alignment.fix(v(t - late), known);
    }
    REQUIRE(found);
    CHECK(degrees(found, attitude(1.5)) < 0.5);
    CHECK(found->then_nb.angularDistance(attitude(1.5 - late)) < 0.01);
    CHECK((found->a_n - a(1.5 - late)).norm() < 0.2);
    CHECK((found->since_n - (v(1.5) - v(1.5 - late))).norm() < 0.02);
  }
}

TEST_CASE("before the first sample the flight is assumed to continue, and the time is counted") {
  const Turning flight;
  const FlightAlignment::Known known{g, nullptr, &flight.wind, 0.2};
  FlightAlignment alignment;
  (void)alignment.fix(flight.velocity(-0.2), known);
  flight.feel(alignment, 0, 0.8);
  const auto found = alignment.fix(flight.velocity(0.6), known);
  REQUIRE(found);
  CHECK(found->unseen_s == doctest::Approx(0.2).epsilon(0.01));
  CHECK(degrees(found, flight.attitude(0.8)) < 1);
}

TEST_CASE("the field measures gyro biases across it, and has a large uncertainty along it") {
  const Vector3d rate(0.2, -0.1, 0.3), bias(0.12, -0.08, 0.05), field(2e-5, 1e-6, 4.5e-5);
  FieldDrift drift;
  Quaterniond q = Quaterniond::Identity(), turned = q;
  for (int i = 0; i <= 50; ++i) {
    const Vector3d m = (q.conjugate() * field).normalized();
    drift.add(turned * m, turned, m, 0.02 * i);
    q = q * exp_map(0.02 * rate);
    turned = turned * exp_map(0.02 * (rate + bias));
  }
  const FieldDrift::Bias found = drift.bias(0.15, 0);
  const Vector3d along = (exp_map(-0.5 * rate) * field).normalized(), off = bias - found.bias_b;
  CHECK((off - along * along.dot(off)).norm() < 0.01);
  const double std = std::sqrt(along.dot(found.covariance * along));
  CHECK(std > 0.05);
  CHECK(std::abs(along.dot(off)) < 2 * std);
  const FieldDrift::Bias nothing = FieldDrift().bias(0.15, 0);
  CHECK(nothing.bias_b.norm() == 0);
  CHECK(std::sqrt(nothing.covariance(2, 2)) == doctest::Approx(0.15));
}

TEST_CASE("what is found of the attitude was as true in the past") {
  ErrorStateEkf filter;
  ekf::Nominal x;
  x.q_nb = exp_map({0.1, 0, 0});  // truly level: without acceleration
  filter.reset(x, ekf::Vector::Ones(), 0);
  for (int i = 0; i < 60; ++i) filter.predict(Vector3d::Zero(), {0, 0, -filter.gravity_mps2}, 0.005);
  REQUIRE(filter.state().v_n.y() > 0.25);
  ekf::Vector dx = ekf::Vector::Zero();
  dx(ekf::theta) = -0.1;
  dx.segment<3>(ekf::vel) = -filter.state().v_n;
  filter.correct(dx);
  for (const double t : {0.05, 0.15, 0.25}) {
    CHECK(filter.at(t).v_n.norm() < 0.02);  // to second order
    CHECK(std::abs(filter.at(t).p_n.y() - filter.state().p_n.y()) < 0.01);
  }
}

TEST_CASE("started in a bank with a wrong delay, no flag is set while the tilt error is 5 deg") {
  using namespace synthetic;
  constexpr double reported_wrong = 0.05, deg = std::numbers::pi / 180;
  int starts = 0, soon = 0;
  for (const double hz : {1.0, 5.0, 10.0})
    for (const double wrong : {-reported_wrong, reported_wrong})
      for (const double from : {26.0, 27.5, 33.0, 36.0, 47.0, 55.5}) {
        Flown f{.quality = ublox, .from_s = from};
        f.plan.bank_rad = 0.5;
        f.plan.duration_s = from + 25;
        f.plan.seed = static_cast<std::uint64_t>(++starts);
        f.quality.gnss_hz = hz;
        f.quality.latency_s = 0.25;
        double second = 1e9, valid = 1e9, worst = 0;
        int fixes = 0;
        f.alter = [&](const Truth& x, Samples& s) {
          s.gnss_age_s = 0;  // stamped on arrival
          if (s.gnss && ++fixes == 2) second = x.t;
        };
        f.set = [&](Ekf::Params& p) {
          p.gnss_delay.value = 0.25 + wrong;
          p.gyro_bias_std.value = 0.02;
          p.accel_bias_std.value = 0.1;
        };
        f.watch = [&](const Truth& x, const VehicleState& s, Status) {
          const Vector3d down = Vector3d::UnitZ();
          const double tilt =
              std::acos(std::min((x.q_nb.conjugate() * down).dot(eigen(s.attitude).conjugate() * down), 1.0));
          const bool any = s.attitude_valid || s.velocity_valid || s.position_valid || s.height_valid ||
                           s.airspeed_valid || s.wind_valid;
          if (any) worst = std::max(worst, tilt);
          if (s.attitude_valid && s.velocity_valid && s.position_valid && s.height_valid)
            valid = std::min(valid, x.t - second);
        };
        f.run();
        CAPTURE(hz);
        CAPTURE(wrong);
        CAPTURE(from);
        CHECK(worst < 5 * deg);
        CHECK(valid > 0);
        CHECK(valid < 15);
        soon += valid <= 1.5;
      }
  CHECK(soon >= 0.4 * starts);  // banks of 29 deg, with the field along the lift
}

TEST_CASE("within two seconds the nose is no second witness: the same gust pushes it") {
  using namespace synthetic;
  Flown f{.quality = ublox, .from_s = 27.5};
  f.plan.bank_rad = 0.5;
  f.plan.duration_s = 30.5;
  f.set = [](Ekf::Params& p) {
    p.gyro_bias_std.value = 0.02;
    p.accel_bias_std.value = 0.1;
  };
  double after_s[3] = {0.5, 1.9, 2.5}, std_rad[3] = {};
  f.watch = [&](const Truth& x, const VehicleState& s, Status) {
    for (int i = 0; i < 3; ++i)
      if (f.first_s && x.t - *f.first_s < after_s[i]) std_rad[i] = s.attitude_std_rad.down;
  };
  f.run();
  CHECK(std_rad[1] > 0.85 * std_rad[0]);  // with an update each 0.3 s: 0.7
  CHECK(std_rad[2] < 0.95 * std_rad[1]);  // a second update
}

TEST_CASE("the wind is no surer than the heading through which the airspeed is seen") {
  using namespace synthetic;
  for (const double from : {27.5, 47.0, 55.5}) {
    Flown f{.quality = ublox, .from_s = from};
    f.plan.bank_rad = 0.5;
    f.plan.duration_s = from + 8;
    double least = 1e9, widest = 0;
    f.watch = [&](const Truth& x, const VehicleState& s, Status) {
      if (!s.wind_valid) return;
      const Vector3d ahead =
          x.airspeed() * (x.q_nb * Vector3d::UnitX());  // direction of the error by a wrong heading
      const double turned = s.attitude_std_rad.down;
      widest = std::max(widest, turned);
      least = std::min({least, s.wind_std_mps.north / (turned * std::abs(ahead.y())),
                        s.wind_std_mps.east / (turned * std::abs(ahead.x()))});
    };
    f.run();
    CAPTURE(from);
    CHECK(widest > 0.03);
    CHECK(least > 0.85);
  }
}

TEST_CASE("fixes that contradict the first attitude in flight end it: the alignment restarts") {
  Params p;
  Navigator n;
  n.start(p);
  const auto fix = [](double north_mps) {
    Gnss f;
    f.latitude_deg = 40;
    f.longitude_deg = -111;
    f.altitude_m = 1400;
    f.velocity_mps = {north_mps, 0, 0};
    f.speed_std_mps = 0.1;
    f.fix = FixType::fix_3d;
    return f;
  };
  double t = 0;
  const auto run = [&](double until_s) {
    for (; t < until_s - 1e-9; t += dt) n.imu({0.1, 0, 0}, {0.3 * std::sin(40 * t), 0, -g}, t + dt, p);
  };
  run(0.1);
  n.gnss(fix(17), t, p);
  run(0.7);
  n.gnss(fix(17), t, p);
  REQUIRE(n.aligned());
  CHECK(n.settling());
  run(0.8);
  n.gnss(fix(40), t, p);
  CHECK(n.aligned());  // one may be an outlier
  run(0.9);
  n.gnss(fix(40), t, p);
  CHECK_FALSE(n.aligned());
  run(1.0);
  n.gnss(fix(17), t, p);
  run(1.6);
  n.gnss(fix(17), t, p);
  CHECK(n.aligned());
}

TEST_CASE("accelerometers that are known badly do not keep the flags of a straight flight down for ever") {
  using namespace synthetic;
  Flown f{.quality = ublox, .from_s = 47};
  f.plan.bank_rad = 0;
  f.plan.duration_s = 52;
  f.set = [](Ekf::Params& p) { p.accel_bias_std.value = 1; };
  f.run();
  CHECK(f.last.attitude_valid);
}

}  // namespace alignment_test
