// SPDX-License-Identifier: BSD-3-Clause
// Noise parameters learnt by the estimator, and its standard deviations against its errors: with processes of
// known parameters.
#include <doctest/doctest.h>

#include <Eigen/Dense>

#include "flight_bench.hpp"

namespace honesty_test {

using namespace synthetic;
using fulmar::navigation::Gusts;
using fulmar::navigation::GustStrength;
using fulmar::navigation::Params;
using fulmar::navigation::Vector2d;

namespace {

struct Learnt {
  double std_mps = 0, time_s = 0;
};
/// Parameters learnt from gusts of `std`, `time_s` in `duration_s`, on a wind with the error `offset`; mean
/// of the second half.
Learnt learnt(double std, double time_s, double offset, std::uint64_t seed, double silent_from_s = 1e9) {
  const Params p;
  Random random(seed);
  Markov gust{std, time_s, 0};
  GustStrength strength;
  Learnt mean;
  constexpr double duration_s = 600, dt = 0.02;
  int n = 0;
  for (int k = 0; k * dt < duration_s; ++k) {
    const double t = k * dt;
    const double excess = gust.step(dt, random) + offset + 0.1 * random.normal();
    if (t > silent_from_s && t < silent_from_s + 20) continue;
    strength.add(excess + (t > silent_from_s ? 10 : 0), t, p);
    if (t < duration_s / 2) continue;
    mean.std_mps += strength.std_mps(p);
    mean.time_s += strength.time_s(p);
    ++n;
  }
  return {mean.std_mps / n, mean.time_s / n};
}

Learnt learnt_mean(double std, double time_s, double offset) {
  Learnt sum;
  constexpr int seeds = 8;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const Learnt one = learnt(std, time_s, offset, seed);
    sum.std_mps += one.std_mps / seeds;
    sum.time_s += one.time_s / seeds;
  }
  return sum;
}

}  // namespace

TEST_CASE("the strength and the time constant of gusts are learnt, for any error of the wind") {
  for (const double std : {0.5, 1.5, 3.0})
    for (const double time_s : {3.0, 6.0}) {
      CAPTURE(std);
      CAPTURE(time_s);
      const Learnt plain = learnt_mean(std, time_s, 0), offset = learnt_mean(std, time_s, 4);
      CHECK(plain.std_mps / std > 0.8);
      CHECK(plain.std_mps / std < 1.25);
      CHECK(plain.time_s / time_s > 0.6);
      CHECK(plain.time_s / time_s < 1.8);
      CHECK(offset.std_mps == doctest::Approx(plain.std_mps).epsilon(0.01));
    }
}

TEST_CASE("in calm air next to nothing is learnt, and a silence of the tube is no gust") {
  CHECK(learnt(0, 5, 3, 1).std_mps < 0.15);
  CHECK(learnt(0.5, 5, 0, 1, 400).std_mps < 0.8);  // after the silence all readings are 10 m/s higher
}

TEST_CASE("the gust along the flight matches its standard deviation, and its covariance stays valid") {
  const Params p;
  double normalised = 0;
  int n = 0, within = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Random random(seed);
    Markov north{0.5, 5, 0}, east{0.5, 5, 0};  // linear: V is 34 times as large
    Gusts gusts;
    gusts.forget({{17, 0, 0}, {0.01, 0.01}}, 0, p);
    for (int k = 1; k < 20000; ++k) {
      const double t = 0.02 * k, course = 0.1 * t;
      const Vector3d u_n(17 * std::cos(course), 17 * std::sin(course), 0);
      const Vector2d gust(north.step(0.02, random), east.step(0.02, random));
      const Vector2d air = u_n.head<2>() - gust;
      gusts.airspeed({u_n, {0.01, 0.01}}, air.norm() + 0.1 * random.normal(), t, p);
      const Eigen::Matrix2d& P = gusts.covariance();
      REQUIRE(P(0, 1) == doctest::Approx(P(1, 0)));
      REQUIRE(P.determinant() > 0);
      REQUIRE(P(0, 0) > 0);
      if (t < 100 || k % 50 != 0) continue;
      const Vector2d e = gust - gusts.gust_mps();
      const double ratio2 = e.dot(P.inverse() * e);
      normalised += ratio2;
      ++n;
      within += ratio2 < 2.296;  // of chi-square of 2 degrees of freedom 68.3 % are below
    }
  }
  CHECK(normalised / n > 1.4);
  CHECK(normalised / n < 2.8);
  CHECK(within / double(n) > 0.58);
  CHECK(within / double(n) < 0.8);
}

TEST_CASE("a receiver whose error lasts minutes: the position error matches its standard deviation") {
  double normalised = 0, reported_std_m = 0;
  int n = 0;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    Flown f{.quality = ublox};
    f.plan.seed = seed;
    f.plan.duration_s = 130;
    f.quality.position_walk_m = f.quality.reported_horizontal = 1.5;
    f.quality.position_tau = 30;
    f.quality.position_white = 0.3;
    f.set = [](Ekf::Params& p) { p.gnss_position_time.value = 30; };
    double next = 60;
    f.watch = [&](const Truth& x, const VehicleState& s, Status) {
      if (x.t < next) return;
      next += 25;
      const Vector3d e = eigen(s.position_m) - x.p_n;
      normalised += std::pow(e.x() / s.position_std_m.north, 2) + std::pow(e.y() / s.position_std_m.east, 2);
      reported_std_m += s.position_std_m.north;
      n += 2;
    };
    f.run();
  }
  CHECK(normalised / n > 0.5);
  CHECK(normalised / n < 1.8);
  CHECK(2 * reported_std_m / n > 1.0);  // a mean of fixes keeps their common error
}

TEST_CASE(
    "what the innovations of a first-order error share is its deviation, and white noise shares nothing") {
  using fulmar::navigation::SharedError;
  for (const double ratio : {0.0, 0.5, 0.9}) {
    CAPTURE(ratio);
    Random random(3);
    SharedError shared;
    Vector2d slow = Vector2d::Zero();
    double mean = 0;
    int n = 0;
    for (int k = 1; k < 6000; ++k) {
      const double fresh = 0.3 * std::sqrt(1 - ratio * ratio);
      slow = ratio * slow + fresh * Vector2d(random.normal(), random.normal());
      shared.add(slow + 0.1 * Vector2d(random.normal(), random.normal()), 0.1 * k);
      if (k > 1000) {
        mean += shared.std_mps();
        ++n;
      }
    }
    mean /= n;
    if (ratio == 0)
      CHECK(mean < 0.1);
    else
      CHECK(mean / 0.3 == doctest::Approx(1).epsilon(0.12));
  }
}

TEST_CASE(
    "a receiver whose velocity is off for seconds: the velocity is as sure as it says, and says more than "
    "before") {
  double errors = 0, variances = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Flown f{.quality = ublox};
    f.plan.seed = seed;
    f.plan.duration_s = 130;
    Random random(seed + 100);
    Markov north{0.2, 2, 0}, east{0.2, 2, 0};
    f.alter = [&](const Truth&, Samples& s) {
      if (!s.gnss) return;
      s.gnss->velocity_mps.north += north.step(0.2, random);
      s.gnss->velocity_mps.east += east.step(0.2, random);
    };
    f.watch = [&](const Truth& x, const VehicleState& s, Status) {
      if (x.t < 60) return;
      const Vector3d e = eigen(s.velocity_mps) - x.v_n;
      errors += e.head<2>().squaredNorm();
      variances += std::pow(s.velocity_std_mps.north, 2) + std::pow(s.velocity_std_mps.east, 2);
    };
    f.run();
  }
  CHECK(std::sqrt(errors / variances) > 0.75);
  CHECK(std::sqrt(errors / variances) < 1.25);
}

TEST_CASE("half a minute without GNSS in gusts: the claim grows, and the error stays within it") {
  double errors = 0, variances = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Flown f{.quality = ublox};
    f.plan.seed = seed;
    f.plan.duration_s = 110;
    f.plan.gust_mps = 1.5;
    f.alter = [](const Truth& x, Samples& s) {
      if (x.t > 80) s.gnss.reset();
    };
    f.run();
    errors += (eigen(f.last.position_m) - f.last_truth.p_n).head<2>().squaredNorm();
    variances += std::pow(f.last.position_std_m.north, 2) + std::pow(f.last.position_std_m.east, 2);
  }
  CHECK(std::sqrt(errors / variances) < 1);  // bound on recorded data: recorded_flight_test.cpp
  CHECK(std::sqrt(variances / 12) > 5);
  CHECK(std::sqrt(variances / 12) < 50);
}

TEST_CASE("wind with gusts is better known than the mean wind alone") {
  double with = 0, without = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Flown f{.quality = ublox};
    f.plan.seed = seed;
    f.plan.gust_mps = 1.5;
    double next = 60;
    f.watch = [&](const Truth& x, const VehicleState& s, Status) {
      if (x.t < next) return;
      next += 1;
      const Vector2d e = (eigen(s.wind_mps) - x.wind_n).head<2>();
      with += e.squaredNorm();
      without += (f.plan.wind - x.wind_n).head<2>().squaredNorm();
    };
    f.run();
  }
  CHECK(with < 0.8 * without);
}

TEST_CASE("a tube that is silent, and one that sticks: the wind stays near the mean, and comes back") {
  for (const bool stuck : {false, true}) {
    CAPTURE(stuck);
    Flown f{};
    f.plan.gust_mps = 1;
    std::optional<Pitot> last;
    f.alter = [&](const Truth& x, Samples& s) {
      if (x.t < 60 || x.t > 80) last = s.pitot ? s.pitot : last;
      if (x.t >= 60 && x.t <= 80 && s.pitot) {
        if (stuck)
          s.pitot = last;
        else
          s.pitot.reset();
      }
    };
    f.watch = [&](const Truth& x, const VehicleState& s, Status) {
      if (x.t < 62) return;
      CHECK(all_finite(s));
      if (!stuck) CHECK((eigen(s.wind_mps) - f.plan.wind).head<2>().norm() < 5);
      if (x.t > 82) CHECK(std::abs(s.airspeed_mps - x.airspeed()) < 1);
    };
    f.run();
  }
}

}  // namespace honesty_test
