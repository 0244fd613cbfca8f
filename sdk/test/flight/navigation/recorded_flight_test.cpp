// SPDX-License-Identifier: BSD-3-Clause
// A real flight: Skywalker X-8, 2013, aerobatics included. There is no attitude truth: agreement with the
// on-board estimate is a sanity check; GNSS velocity and the drift without GNSS are measurements.
#include "recorded_flight.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fulmar/testing.hpp>
#include <optional>

#include "fulmar/flight/navigation/estimator.hpp"

namespace recorded_flight_test {

using namespace fulmar;
using fulmar::navigation::Ekf;
using fulmar::navigation::Vector3d;

namespace {

constexpr double deg = std::numbers::pi / 180;

struct Estimate {
  double t;
  VehicleState state;
  double gust_north_mps = 0;
};

struct Window {
  double start_s = 0, end_s = 600, drop_from_s = 1e9, drop_to_s = 1e9;
};

/// Replays the samples in the order of their arrival.
std::vector<Estimate> replay(const recorded::Flight& f, const Window& w) {
  Bench<Ekf> bench;
  std::vector<Estimate> estimates;
  std::size_t gnss = 0, mag = 0, air = 0;
  double last = -1;
  for (const auto& [t, imu] : f.imu) {
    if (t < w.start_s || t > w.end_s || t <= last) continue;
    const double dt = last < 0 ? 0.02 : t - last;
    last = t;
    bench.tick.now_ns = std::llround(t * 1e9);
    bench.set(bench.in.imu, imu);
    for (; mag < f.mag.size() && f.mag[mag].first <= t; ++mag) bench.set(bench.in.mag, f.mag[mag].second);
    for (; air < f.baro.size() && f.baro[air].first <= t; ++air) {
      bench.set(bench.in.baro, f.baro[air].second);
      bench.set(bench.in.pitot, f.pitot[air].second);
    }
    for (; gnss < f.gnss.size() && f.gnss[gnss].t <= t; ++gnss) {
      const double arrived = f.gnss[gnss].t;
      if (arrived > t - 0.2 && !(arrived >= w.drop_from_s && arrived < w.drop_to_s))
        bench.set(bench.in.gnss, f.gnss[gnss].gnss, t - arrived + f.gnss_delay_s);
    }
    bench.step(dt);
    if (bench.out.state.written)
      estimates.push_back({t, bench.out.state.value, bench.out.gust_north_mps.value});
  }
  return estimates;
}

const VehicleState& at(const std::vector<Estimate>& e, double t) {
  auto i = std::lower_bound(e.begin(), e.end(), t, [](const Estimate& a, double time) { return a.t < time; });
  return i == e.end() ? e.back().state : i->state;
}

struct Agreement {
  Vector3d attitude = Vector3d::Zero(), velocity = Vector3d::Zero();
};

Agreement agreement(const recorded::Flight& f, const std::vector<Estimate>& e, double from_s) {
  Agreement sum;
  int attitudes = 0, fixes = 0;
  for (const recorded::Reference& r : f.reference) {
    if (r.t < from_s || r.t > 560 || std::abs(r.pitch_rad) > 45 * deg) continue;
    const VehicleState& s = at(e, r.t);
    sum.attitude += Vector3d(wrap_pi(s.roll_rad - r.roll_rad), wrap_pi(s.pitch_rad - r.pitch_rad),
                             wrap_pi(s.yaw_rad - r.yaw_rad))
                        .cwiseAbs2();
    ++attitudes;
  }
  for (const recorded::Fix& fix : f.gnss) {
    if (fix.t < from_s || fix.t > 560) continue;
    sum.velocity +=
        (eigen(at(e, fix.t - f.gnss_delay_s).velocity_mps) - eigen(fix.gnss.velocity_mps)).cwiseAbs2();
    ++fixes;
  }
  sum.attitude = (sum.attitude / attitudes).cwiseSqrt();
  sum.velocity = (sum.velocity / fixes).cwiseSqrt();
  return sum;
}

struct Outage {
  double error_m, reported_m;
};
/// Horizontal distance to the last real fix before the end of the outage, and its reported standard
/// deviation.
Outage outage(const recorded::Flight& f, double t0, double duration) {
  const std::vector<Estimate> e = replay(f, {0, t0 + duration + 1, t0, t0 + duration});
  const recorded::Fix* last = nullptr;
  for (const recorded::Fix& fix : f.gnss)
    if (fix.t < t0 + duration - 0.5) last = &fix;
  const VehicleState& s = at(e, last->t - f.gnss_delay_s);
  const LocalFrame frame(s.origin_latitude_deg, s.origin_longitude_deg, s.origin_altitude_m);
  const Vector3d p = frame.to_ned(last->gnss.latitude_deg, last->gnss.longitude_deg, last->gnss.altitude_m);
  return {(eigen(s.position_m) - p).head<2>().norm(),
          std::hypot(s.position_std_m.north, s.position_std_m.east)};
}

std::optional<recorded::Flight> flight() {
  const std::string folder = std::string(FULMAR_REFERENCE_DATA) + "/flights/skywalker_x8";
  if (!std::filesystem::exists(folder + "/imu.csv")) {
    MESSAGE("skipped: no recorded flight at " << folder);
    return std::nullopt;
  }
  return recorded::skywalker_x8(folder);
}

}  // namespace

TEST_CASE(
    "on a real flight attitude agrees with the estimate made on board, velocity with GNSS, wind with the "
    "velocity triangle") {
  const auto f = flight();
  if (!f) return;
  const std::vector<Estimate> e = replay(*f, {});
  const Agreement a = agreement(*f, e, 270);
  CHECK(a.attitude.x() < 3.3 * deg);
  CHECK(a.attitude.y() < 3.3 * deg);
  CHECK(a.attitude.z() < 5.1 * deg);
  CHECK(a.velocity.head<2>().maxCoeff() < 1.2);
  CHECK(a.velocity.z() <
        1.5);  // includes the slow error of the receiver, against which the filter uses the barometer
  double north = 0, east = 0, mean = 0, squares = 0;  // the last two without gusts
  int n = 0;
  for (const Estimate& estimate : e) {
    const double t = estimate.t;
    const VehicleState& s = estimate.state;
    if (t < 270 || t > 560) continue;
    north += s.wind_mps.north;
    east += s.wind_mps.east;
    const double steady = s.wind_mps.north - estimate.gust_north_mps;
    mean += steady;
    squares += steady * steady;
    ++n;
    CHECK_MESSAGE((s.attitude_valid && s.velocity_valid && s.position_valid && s.height_valid &&
                   s.airspeed_valid && s.wind_valid),
                  "at " << t);
  }
  CHECK(std::hypot(north / n - 5.84, east / n - 0.20) < 1);
  CHECK(std::sqrt(squares / n - mean / n * mean / n) < 0.6);
}

TEST_CASE("on a real flight the height keeps with the receiver's, and takes no step") {
  const auto f = flight();
  if (!f) return;
  const std::vector<Estimate> e = replay(*f, {});
  double squares = 0, step_m = 0;
  int n = 0;
  for (const recorded::Fix& fix : f->gnss) {
    if (fix.t < 250 || fix.t > 565) continue;
    const VehicleState& s = at(e, fix.t - f->gnss_delay_s);
    const double off = s.height_m + s.origin_altitude_m - fix.gnss.altitude_m;
    squares += off * off;
    ++n;
  }
  for (std::size_t i = 1; i < e.size(); ++i)
    if (e[i].t > 250 && e[i].t < 565) {
      const double climbed = e[i].state.climb_rate_mps * (e[i].t - e[i - 1].t);
      step_m = std::max(step_m, std::abs(e[i].state.height_m - e[i - 1].state.height_m - climbed));
    }
  REQUIRE(n > 1000);
  CHECK(std::sqrt(squares / n) < 4);
  CHECK(step_m < 3);
}

TEST_CASE("on a real flight it starts in the air, in any manoeuvre, and agrees half a minute later") {
  const auto f = flight();
  if (!f) return;
  for (const double start : {300.0, 330.0, 400.0, 450.0}) {
    const std::vector<Estimate> e = replay(*f, {.start_s = start});
    REQUIRE(!e.empty());
    CHECK(e.front().t < start + 3);
    const Agreement a = agreement(*f, e, start + 30);
    CHECK(a.attitude.x() < 5 * deg);
    CHECK(a.attitude.y() < 5 * deg);
    CHECK(a.attitude.z() < 8 * deg);
    CHECK(a.velocity.head<2>().maxCoeff() < 1.5);
    CHECK(a.velocity.z() < 1.8);
  }
}

TEST_CASE("on a real flight ten and thirty seconds without GNSS stay within the drift of good estimators") {
  const auto f = flight();
  if (!f) return;
  for (const auto& [duration, median, worst] : {std::tuple{10.0, 9.0, 20.0}, std::tuple{30.0, 27.0, 42.0}}) {
    std::vector<double> errors;
    double squares = 0, reported = 0;
    for (double t0 = 280; t0 <= 520; t0 += 30) {
      const Outage o = outage(*f, t0, duration);
      errors.push_back(o.error_m);
      squares += o.error_m * o.error_m;
      reported += o.reported_m * o.reported_m;
    }
    std::sort(errors.begin(), errors.end());
    const double seconds = duration;
    CAPTURE(seconds);
    CHECK(errors[errors.size() / 2] < median);
    CHECK(errors.back() < worst);
    CHECK(std::sqrt(squares / reported) > 0.7);  // as reported
    CHECK(std::sqrt(squares / reported) < 1.7);
  }
}

}  // namespace recorded_flight_test
