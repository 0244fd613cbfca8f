// SPDX-License-Identifier: BSD-3-Clause
#include "fulmar/flight/model/modes.hpp"

#include <doctest/doctest.h>

#include <set>

#include "fulmar/flight/model/steady_flight.hpp"
#include "sdk/test/flight/airframe_file.hpp"

namespace modes_test {

using namespace fulmar;
using doctest::Approx;
namespace m = fulmar::model;

namespace {

LinearModel linear(const Airframe& a, double Va, double bank_rad = 0) {
  const AircraftModel aircraft(a, 1457);
  const SteadyFlight f = steady_flight(aircraft, {Va, 0, bank_rad != 0 ? Turn::bank : Turn::none, bank_rad});
  REQUIRE(f.found());
  return linear_model(aircraft, f.x, f.input);
}

std::vector<Mode> of_kind(const std::vector<Mode>& modes, ModeKind kind) {
  std::vector<Mode> found;
  for (const Mode& mode : modes)
    if (mode.kind == kind) found.push_back(mode);
  return found;
}

/// Longitudinal and lateral motion with these eigenvalues. By construction the first two of each belong to
/// the short period and to the Dutch roll.
struct Made {
  std::complex<double> short_period, phugoid, dutch_roll;
  double roll, spiral;
};
LinearModel made(const Made& of) {
  LinearModel out;
  out.A.setZero();
  const auto pair = [&](int a, int b, std::complex<double> e) {
    out.A(a, a) = out.A(b, b) = e.real();
    out.A(a, b) = e.imag();
    out.A(b, a) = -e.imag();
  };
  pair(m::w, m::q, of.short_period);
  pair(m::u, m::pitch, of.phugoid);
  pair(m::v, m::r, of.dutch_roll);
  out.A(m::p, m::p) = of.roll;
  out.A(m::roll, m::roll) = of.spiral;
  // one-way couplings between the parts move no eigenvalue
  out.A(m::u, m::w) = 0.3;
  out.A(m::pitch, m::q) = 1;
  out.A(m::roll, m::p) = 1;
  out.A(m::p, m::v) = -2;
  out.A(m::roll, m::r) = 0.1;
  return out;
}

}  // namespace

TEST_CASE("modes are identified by their states, for any order and size") {
  const std::array<Made, 4> cases{
      {{{-5, 9}, {-0.1, 0.5}, {-1, 5}, -20, 0.05},
       {{-0.1, 0.4}, {-3, 8}, {-0.01, 0.2}, -0.3, -9},  // short period slower than the phugoid
       {{2, 3}, {0.5, 0.1}, {-30, 2}, 4, -0.001},       // unstable
       {{-1, 5}, {-1, 4.9}, {-1, 5.1}, -1.1, -1.2}}};   // close eigenvalues
  for (const Made& c : cases) {
    const std::vector<Mode> modes = modes_of(made(c));
    REQUIRE(modes.size() == 5);
    const auto is = [&](ModeKind kind, std::complex<double> eigenvalue) {
      const auto found = of_kind(modes, kind);
      REQUIRE(found.size() == 1);
      CHECK(std::abs(found[0].eigenvalue - eigenvalue) < 1e-9 * std::abs(eigenvalue));
    };
    is(ModeKind::short_period, c.short_period);
    is(ModeKind::phugoid, c.phugoid);
    is(ModeKind::dutch_roll, c.dutch_roll);
    is(ModeKind::roll, c.roll);
    is(ModeKind::spiral, c.spiral);
  }
}

TEST_CASE("frequency, damping and times of a mode are those of its eigenvalue") {
  Mode pair;
  pair.eigenvalue = {-3, 4};
  CHECK(pair.oscillates());
  CHECK(pair.stable());
  CHECK(pair.natural_radps() == Approx(5));
  CHECK(pair.damping_ratio() == Approx(0.6));
  CHECK(pair.period_s() == Approx(std::numbers::pi / 2));
  CHECK(pair.time_constant_s() == Approx(1. / 3));
  Mode growing;
  growing.eigenvalue = 0.1;
  CHECK_FALSE(growing.oscillates());
  CHECK_FALSE(growing.stable());
  CHECK(growing.half_or_double_s() == Approx(std::log(2) / 0.1));
  CHECK(growing.damping_ratio() == Approx(-1));
}

TEST_CASE("participations sum to one and do not depend on the units") {
  LinearModel l = linear(test::airframe_file("anaconda"), 17);
  const std::vector<Mode> before = modes_of(l);
  for (const Mode& mode : before) {
    double sum = 0;
    for (const double share : mode.participation) sum += share;
    CHECK(sum == Approx(1));
  }
  Eigen::Matrix<double, m::states, 1> scale;  // km/h, feet, degrees
  scale << 1, 1, 3.28, 3.6, 3.28, 0.001, 57.3, 57.3, 57.3, 1, 57.3, 1000;
  l.A = scale.asDiagonal() * l.A * scale.cwiseInverse().asDiagonal();
  const std::vector<Mode> after = modes_of(l);
  REQUIRE(after.size() == before.size());
  for (std::size_t i = 0; i < after.size(); ++i) {
    CHECK(after[i].kind == before[i].kind);
    for (std::size_t k = 0; k < 8; ++k)
      CHECK(std::abs(after[i].participation[k] - before[i].participation[k]) < 1e-6);
  }
}

TEST_CASE("the modes are about those of the handbook's approximations") {
  for (const char* name : {"anaconda", "aerosonde"}) {
    const Airframe a = test::airframe_file(name);
    const double Va = a.limits.airspeed_cruise_mps;
    const LinearModel l = linear(a, Va);
    const std::vector<Mode> modes = modes_of(l);
    const Eigen::Matrix<double, 12, 12>& A = l.A;
    const Mode short_period = of_kind(modes, ModeKind::short_period).at(0);
    // Etkin & Reid, section 6.3: omega^2 = Zw Mq - Mw Zq, 2 zeta omega = -(Zw + Mq)
    CHECK(short_period.natural_radps() ==
          Approx(std::sqrt(A(m::w, m::w) * A(m::q, m::q) - A(m::q, m::w) * A(m::w, m::q))).epsilon(0.03));
    CHECK(2 * short_period.damping_ratio() * short_period.natural_radps() ==
          Approx(-A(m::w, m::w) - A(m::q, m::q)).epsilon(0.03));
    // Lanchester: omega = sqrt(2) g / Va
    CHECK(of_kind(modes, ModeKind::phugoid).at(0).natural_radps() ==
          Approx(std::sqrt(2) * 9.80665 / Va).epsilon(0.25));
    CHECK(of_kind(modes, ModeKind::roll).at(0).eigenvalue.real() == Approx(A(m::p, m::p)).epsilon(0.05));
    // omega^2 = Yv Nr - Nv Yr, without rolling
    CHECK(of_kind(modes, ModeKind::dutch_roll).at(0).natural_radps() ==
          Approx(std::sqrt(A(m::v, m::v) * A(m::r, m::r) - A(m::r, m::v) * A(m::v, m::r)))
              .epsilon(0.25)
              .scale(0));
  }
}

TEST_CASE("every speed and bank has all modes, also where they no longer oscillate") {
  Airframe a = test::airframe_file("anaconda");
  std::set<std::size_t> counts;
  for (const double moment : {-5.0, -2.74, -0.6, -0.1, 0.3})
    for (const double weathercock : {-0.02, 0.0, 0.02, 0.1301})
      for (const double bank : {0.0, 0.6, -0.9})
        for (const double Va : {16.0, 20.0, 27.0}) {
          a.aero.pitch.alpha_ratio = moment;
          a.aero.pitch.zero_ratio = -moment * 0.05;
          a.aero.yaw.beta_ratio = weathercock;
          const std::vector<Mode> modes = modes_of(linear(a, Va, bank));
          std::array<int, 6> order{};
          double sum = 0;
          for (const Mode& mode : modes) {
            order[std::size_t(mode.kind)] += mode.oscillates() ? 2 : 1;
            sum += (mode.oscillates() ? 2 : 1) * mode.eigenvalue.real();
          }
          CHECK(order[0] == 2);
          CHECK(order[1] == 2);
          CHECK(order[2] == 2);
          CHECK(order[3] + order[4] + order[5] == 2);
          CHECK(order[3] == order[4]);
          const LinearModel l = linear(a, Va, bank);
          const Eigen::Matrix<double, 8, 8> motion = l.A(m::motion_states, m::motion_states);
          CHECK(sum == Approx(motion.trace()).epsilon(1e-9).scale(0));
          counts.insert(modes.size());
        }
  CHECK(counts.size() > 1);  // some pairs became real
}

}  // namespace modes_test
