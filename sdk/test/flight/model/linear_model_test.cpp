// SPDX-License-Identifier: BSD-3-Clause
#include "fulmar/flight/model/linear_model.hpp"

#include <doctest/doctest.h>

#include "aerosonde_reference.hpp"
#include "fulmar/flight/model/modes.hpp"
#include "fulmar/flight/model/steady_flight.hpp"
#include "fulmar/flight/model/trim.hpp"

namespace linear_model_test {

using namespace fulmar;
using doctest::Approx;

namespace {

constexpr double degree = std::numbers::pi / 180;

struct Linearised {
  SteadyFlight flight;
  LinearModel model;
};

Linearised linearised(const Airframe& a, const SteadyCondition& c, double altitude_m) {
  const AircraftModel m(a, altitude_m);
  Linearised l;
  l.flight = steady_flight(m, c);
  REQUIRE(l.flight.found());
  l.model = linear_model(m, l.flight.x, l.flight.input);
  return l;
}

/// Altitude of a density in the standard air.
double altitude_of(double density_kgm3) {
  double low = -1000, high = 11000;
  for (int i = 0; i < 100; ++i) {
    const double mid = 0.5 * (low + high);
    (standard_air(mid).density_kgm3 > density_kgm3 ? low : high) = mid;
  }
  return low;
}

/// Coefficients of det(lambda I - A), highest first: Faddeev and Le Verrier, without eigenvectors.
std::array<double, 5> polynomial(const Eigen::Matrix4d& A) {
  std::array<double, 5> c{1};
  Eigen::Matrix4d M = Eigen::Matrix4d::Zero();
  for (int k = 1; k <= 4; ++k) {
    M = A * M + c[std::size_t(k - 1)] * Eigen::Matrix4d::Identity();
    c[std::size_t(k)] = -(A * M).trace() / k;
  }
  return c;
}

/// Relative distance of a number to a root of the polynomial, by one step of Newton's method.
double off_the_root(const std::array<double, 5>& c, std::complex<double> x) {
  std::complex<double> f = 0, slope = 0;
  for (const double coefficient : c) {
    slope = slope * x + f;
    f = f * x + coefficient;
  }
  return std::abs(f / slope) / std::abs(x);
}

const Mode& mode(const std::vector<Mode>& modes, ModeKind kind) {
  for (const Mode& m : modes)
    if (m.kind == kind) return m;
  throw std::runtime_error("no such mode");
}

/// `state` +- `h`: Richardson's extrapolation of two central differences.
template <class F>
Eigen::VectorXd slope(const F& f, double h) {
  const Eigen::VectorXd wide = (f(h) - f(-h)) / (2 * h), narrow = (f(h / 2) - f(-h / 2)) / h;
  return (4 * narrow - wide) / 3;
}

}  // namespace

TEST_CASE("A and B are the central differences of the model that flies, at three speeds and in a turn") {
  for (const char* name : {"anaconda", "aerosonde"}) {
    const Airframe a = test::airframe_file(name);
    const FlightLimits& limits = a.limits;
    std::vector<SteadyCondition> conditions(5);
    conditions[0].airspeed_mps = limits.airspeed_min_mps;
    conditions[1].airspeed_mps = limits.airspeed_cruise_mps;
    conditions[2].airspeed_mps = limits.airspeed_max_mps;
    conditions[3] = {limits.airspeed_cruise_mps, 2 * degree, Turn::bank, 35 * degree};
    conditions[4] = {limits.airspeed_cruise_mps, -2 * degree, Turn::radius, -120};
    for (const SteadyCondition& c : conditions) {
      const AircraftModel m(a, 1457);
      const Linearised l = linearised(a, c, 1457);
      // The error is relative to the largest number of its row: small numbers have small absolute errors.
      for (int k = 0; k < model::states + model::inputs; ++k) {
        const bool input = k >= model::states;
        const Eigen::VectorXd column = slope(
            [&](double h) {
              model::StateVector<double> x = l.flight.x;
              model::InputVector<double> u = l.flight.input;
              (input ? u(k - model::states) : x(k)) += h;
              return Eigen::VectorXd(m.rate<double>(x, u));
            },
            k <= model::down ? 1 : 1e-3);
        for (int i = 0; i < model::states; ++i) {
          const double exact = input ? l.model.B(i, k - model::states) : l.model.A(i, k);
          const double largest = std::max(l.model.A.row(i).cwiseAbs().maxCoeff(), 1e-6);
          CHECK(std::abs(exact - column(i)) <= 1e-6 * std::abs(exact) + 1e-9 * largest);
        }
      }
    }
  }
}

TEST_CASE("what is there of A and B is what the equations of motion have") {
  const Linearised l = linearised(test::airframe_file("anaconda"), {17}, 1457);
  const double theta = l.flight.x(model::pitch), g = 9.80665;
  CHECK(l.model.A(model::u, model::pitch) == Approx(-g * std::cos(theta)).epsilon(1e-12).scale(0));
  CHECK(l.model.A(model::w, model::pitch) == Approx(-g * std::sin(theta)).epsilon(1e-12).scale(0));
  CHECK(l.model.A(model::v, model::roll) == Approx(g * std::cos(theta)).epsilon(1e-12).scale(0));
  CHECK(l.model.A(model::roll, model::p) == 1);
  CHECK(l.model.A(model::pitch, model::q) == 1);
  CHECK(l.model.A.col(model::north).norm() == 0);
  CHECK(l.model.A.col(model::east).norm() == 0);
  // lift is proportional to the density, which has the power 4.2559 of the temperature
  CHECK(l.model.A(model::w, model::down) ==
        Approx(-g * std::cos(theta) * 4.2559 * 0.0065 / (288.15 - 0.0065 * 1457)).epsilon(1e-4).scale(0));
  CHECK(l.model.B.topRows(3).norm() == 0);
  CHECK(l.model.B(model::q, model::elevator) < 0);  // trailing edge down: nose down
  CHECK(l.model.B(model::p, model::aileron) > 0);
  CHECK(l.model.B(model::r, model::rudder) < 0);
  CHECK(l.model.B(model::u, model::throttle) > 0);
  CHECK(std::abs(l.model.B(model::q, model::throttle)) < 1e-12);
}

TEST_CASE("steady flight leaves no acceleration, level, climbing, turning") {
  for (const char* name : {"anaconda", "aerosonde"}) {
    const Airframe a = test::airframe_file(name);
    const double Va = a.limits.airspeed_cruise_mps;
    const AircraftModel m(a, 500);
    for (const double climb : {-3 * degree, 0.0, 4 * degree})
      for (const SteadyCondition& c :
           {SteadyCondition{Va, climb}, SteadyCondition{Va, climb, Turn::bank, 40 * degree},
            SteadyCondition{Va, climb, Turn::bank, -20 * degree},
            SteadyCondition{Va, climb, Turn::radius, 150},
            SteadyCondition{Va, climb, Turn::radius, -90, true},
            SteadyCondition{Va, climb, Turn::none, 0, true}}) {
        const SteadyFlight f = steady_flight(m, c);
        REQUIRE(f.found());
        const model::StateVector<double> rate = m.rate<double>(f.x, f.input);
        CHECK(rate.segment<3>(model::u).norm() < 1e-10);
        CHECK(rate.segment<3>(model::p).norm() < 1e-10);
        CHECK(std::abs(rate(model::roll)) < 1e-12);
        CHECK(std::abs(rate(model::pitch)) < 1e-12);
        CHECK(std::abs(rate(model::down) + Va * std::sin(climb)) < 1e-10);
        CHECK(std::abs(rate(model::yaw) - f.turn_radps) < 1e-12);
        if (c.turn == Turn::radius)
          CHECK(std::hypot(rate(model::north), rate(model::east)) / rate(model::yaw) ==
                Approx(c.turn_by).epsilon(1e-9));
        if (c.turn == Turn::bank) CHECK(f.x(model::roll) == Approx(c.turn_by).epsilon(1e-9));
        if (c.no_sideslip) CHECK(std::abs(f.beta_rad) < 1e-12);
      }
  }
}

TEST_CASE("straight steady flight is the trim in which the simulator starts") {
  for (const char* name : {"anaconda", "aerosonde"}) {
    const Airframe a = test::airframe_file(name);
    const double rho = standard_air(1457).density_kgm3;
    for (const double Va :
         {a.limits.airspeed_min_mps, a.limits.airspeed_cruise_mps, a.limits.airspeed_max_mps}) {
      const SteadyFlight f = steady_flight(AircraftModel(a, 1457), {Va});
      const Trim t = trimmed_flight(a, Va, rho);
      REQUIRE(f.found());
      REQUIRE(t.found);
      CHECK(f.alpha_rad == Approx(t.alpha_rad).epsilon(1e-8).scale(0));
      CHECK(f.input(model::elevator) == Approx(t.deflections.elevator).epsilon(1e-8).scale(0));
      CHECK(f.input(model::aileron) == Approx(t.deflections.aileron).epsilon(1e-6).scale(0));
      CHECK(f.input(model::throttle) == Approx(t.throttle_frac).epsilon(1e-8).scale(0));
      CHECK(f.x(model::pitch) == Approx(t.pitch_rad).epsilon(1e-8).scale(0));
    }
  }
}

TEST_CASE("a steep turn has the lift, the rates and the load of mechanics") {
  const Airframe a = test::airframe_file("anaconda");
  const SteadyFlight f = steady_flight(AircraftModel(a, 0), {20, 0, Turn::bank, 60 * degree});
  REQUIRE(f.found());
  CHECK(f.turn_radps == Approx(9.80665 * std::tan(60 * degree) / 20).epsilon(0.03));
  const Load load = AircraftModel(a, 0).load<double>(f.x.segment<3>(model::u), f.x.segment<3>(model::p),
                                                     f.deflections(), f.propeller_radps, f.density_kgm3);
  CHECK(-load.force_b.z() / (4.5 * 9.80665) == Approx(2).epsilon(0.05));
  CHECK(std::abs(load.force_b.y()) < 1e-9);  // the ball is in the middle: no side force
}

TEST_CASE("the limit that prevents a steady flight is reported") {
  const Airframe a = test::airframe_file("anaconda");
  const AircraftModel m(a, 1457);
  CHECK(steady_flight(m, {17}).limit == TrimLimit::none);
  CHECK(steady_flight(m, {8}).limit == TrimLimit::stall);
  CHECK(steady_flight(m, {17, 0, Turn::bank, 75 * degree}).limit == TrimLimit::stall);
  CHECK(steady_flight(m, {40}).limit == TrimLimit::throttle_high);
  CHECK(steady_flight(m, {17, 50 * degree}).limit == TrimLimit::throttle_high);
  CHECK(steady_flight(m, {17, -60 * degree}).limit == TrimLimit::throttle_low);
  const auto with = [&](auto change) {
    Airframe other = a;
    change(other);
    return steady_flight(AircraftModel(other, 1457), {17}).limit;
  };
  CHECK(with([](Airframe& o) { o.aero.pitch.zero_ratio = 1.2; }) == TrimLimit::elevator);
  CHECK(with([](Airframe& o) { o.aero.roll.zero_ratio = 0.2; }) == TrimLimit::aileron);
  CHECK(with([](Airframe& o) { o.aero.yaw.zero_ratio = 0.05; }) == TrimLimit::rudder);
  const auto soft_stall = [](Airframe& o) {  // a balance exists, but beyond the stall
    o.wing.stall_alpha_rad = 0.02;
    o.wing.stall_sharpness_ratio = 5;
  };
  CHECK(with(soft_stall) == TrimLimit::stall);
  CHECK(with([](Airframe& o) { o.aero.roll.aileron_ratio = 0; }) == TrimLimit::no_aileron);
  CHECK(with([](Airframe& o) { o.aero.pitch.elevator_ratio = 0; }) == TrimLimit::no_elevator);
  CHECK(with([](Airframe& o) {
          o.propulsion.ct0_ratio = o.propulsion.ct1_ratio = o.propulsion.ct2_ratio = 0;
        }) == TrimLimit::no_thrust);
}

TEST_CASE("an aircraft without a rudder banks a little against its propeller, and flies turns") {
  Airframe a = test::airframe_file("anaconda");
  a.aero.side.rudder_ratio = a.aero.roll.rudder_ratio = a.aero.yaw.rudder_ratio = 0;
  const AircraftModel m(a, 1457);
  for (const SteadyCondition& c : {SteadyCondition{17}, SteadyCondition{17, 0, Turn::bank, 30 * degree}}) {
    const SteadyFlight f = steady_flight(m, c);
    REQUIRE(f.found());
    CHECK(m.rate<double>(f.x, f.input).segment<3>(model::p).norm() < 1e-10);
    CHECK(m.rate<double>(f.x, f.input).segment<3>(model::u).norm() < 1e-10);
    CHECK(f.input(model::rudder) == 0);
  }
}

TEST_CASE("the Aerosonde's trim, A, B and eigenvalues are those of another program") {
  const auto reference = test::AerosondeReference::open();
  if (!reference) {
    MESSAGE("skipped: no " FULMAR_REFERENCE_DATA "/aero/reference/aerosonde_trim_eig_own.txt");
    return;
  }
  SteadyCondition c{25};
  c.no_sideslip = true;  // the condition of that program
  const Linearised l = linearised(test::book_aerosonde(), c, altitude_of(1.2682));
  // That program uses 9.81 m/s2, 0.034 % more, and prints five decimals.
  const auto near = [](double ours, double theirs, double part, double least) {
    INFO(ours, " and ", theirs);
    CHECK(std::abs(ours - theirs) <= part * std::abs(theirs) + least);
  };
  const auto trim = reference->after("u [de da dr dt]", 4);
  near(l.flight.alpha_rad, reference->after("alpha ", 1)[0], 2e-3, 0);
  near(l.flight.input(model::elevator), trim[0], 2e-3, 0);
  near(l.flight.input(model::aileron), trim[1], 2e-3, 1e-5);
  near(l.flight.input(model::rudder), trim[2], 1e-2, 1e-5);
  near(l.flight.input(model::throttle), trim[3], 1e-3, 0);
  near(l.flight.x(model::roll), -0.00054, 1e-2, 1e-5);
  const auto matrix = [&](const auto& ours, const char* label) {
    const auto theirs = reference->after(label, std::size_t(ours.size()));
    for (int i = 0; i < ours.rows(); ++i)
      for (int k = 0; k < ours.cols(); ++k)
        near(ours(i, k), theirs[std::size_t(i * ours.cols() + k)], 2e-3, 2e-5);
  };
  matrix(longitudinal(l.model).A, "A_lon [u w q th]");
  matrix(longitudinal(l.model).B, "B_lon [de dt]");
  matrix(lateral(l.model).A, "A_lat [v p r phi]");
  matrix(lateral(l.model).B, "B_lat [da dr]");

  const std::vector<Mode> modes = modes_of(l.model);
  const auto eig_lon = reference->after("eig lon", 8), eig_lat = reference->after("eig lat", 8);
  const auto pair = [&](ModeKind kind, double real, double imag) {
    near(mode(modes, kind).eigenvalue.real(), real, 1e-3, 2e-5);
    near(mode(modes, kind).eigenvalue.imag(), imag, 1e-3, 2e-5);
  };
  pair(ModeKind::short_period, eig_lon[0], eig_lon[1]);
  pair(ModeKind::phugoid, eig_lon[4], eig_lon[5]);
  pair(ModeKind::roll, eig_lat[0], 0);
  pair(ModeKind::dutch_roll, eig_lat[2], eig_lat[3]);
  pair(ModeKind::spiral, eig_lat[6], 0);
}

TEST_CASE("the eigenvalues are roots of the blocks' characteristic polynomials") {
  for (const char* name : {"anaconda", "aerosonde"}) {
    const Airframe a = test::airframe_file(name);
    for (const double Va :
         {a.limits.airspeed_min_mps, a.limits.airspeed_cruise_mps, a.limits.airspeed_max_mps}) {
      SteadyCondition c{Va};
      c.no_sideslip = true;
      Linearised l = linearised(a, c, 1457);
      const auto lon = polynomial(longitudinal(l.model).A), lat = polynomial(lateral(l.model).A);
      const std::vector<Mode> modes = modes_of(l.model);
      // The blocks omit the couplings by bank and by the torque of the propeller.
      for (const ModeKind kind : {ModeKind::short_period, ModeKind::phugoid})
        CHECK(off_the_root(lon, mode(modes, kind).eigenvalue) < 2e-4);
      for (const ModeKind kind : {ModeKind::dutch_roll, ModeKind::roll, ModeKind::spiral})
        CHECK(off_the_root(lat, mode(modes, kind).eigenvalue) < 2e-3);
    }
  }
}

}  // namespace linear_model_test
