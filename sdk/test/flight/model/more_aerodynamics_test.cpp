// SPDX-License-Identifier: BSD-3-Clause
// Optional terms of an airframe besides its derivatives. Expected values are computed by hand.
#include "fulmar/flight/model/more_aerodynamics.hpp"

#include <doctest/doctest.h>

#include "fulmar/flight/math/dual.hpp"
#include "fulmar/flight/model/aerodynamics.hpp"
#include "fulmar/flight/model/steady_flight.hpp"
#include "fulmar/flight/model/trim.hpp"
#include "sdk/test/flight/airframe_file.hpp"

namespace more_aerodynamics_test {

using namespace fulmar;
using doctest::Approx;
using Eigen::Vector3d;

namespace {

constexpr double Va = 17, rho = 1.1;

const Airframe& plain() {
  static const Airframe a = test::airframe_file("anaconda");
  return a;
}

Vector3d velocity(double alpha, double beta) { return air_velocity<double>(Va, alpha, beta); }

struct Six {
  double lift, drag, side, roll, pitch, yaw;
};
/// CL, CD, CY, Cl, Cm, Cn of `a` minus those of the plain aircraft, with the full dynamic pressure.
Six more(const Airframe& a, double alpha, double beta, const Deflections& d) {
  const Vector3d v = velocity(alpha, beta);
  const Load with = Aerodynamic(a).load(v, {0.3, -0.2, 0.1}, d, rho);
  const Load without = Aerodynamic(plain()).load(v, {0.3, -0.2, 0.1}, d, rho);
  const double qS = 0.5 * rho * Va * Va * a.wing.area_m2;
  const Vector3d f = (with.force_b - without.force_b) / qS, m = (with.moment_b - without.moment_b) / qS;
  return {f.x() * std::sin(alpha) - f.z() * std::cos(alpha),
          -f.x() * std::cos(alpha) - f.z() * std::sin(alpha),
          f.y(),
          m.x() / a.wing.span_m,
          m.y() / a.wing.chord_m,
          m.z() / a.wing.span_m};
}

CoefficientTable table(Coefficient of, TableVariable over, std::initializer_list<double> at,
                       std::initializer_list<double> values) {
  CoefficientTable t;
  t.coefficient = of;
  t.over = over;
  for (const double x : at) t.at_ratio.push_back(x);
  for (const double x : values) t.values_ratio.push_back(x);
  return t;
}

Airframe with(const CoefficientTable& t) {
  Airframe a = plain();
  a.aero.tables.push_back(t);
  return a;
}

/// Pitch over angle of attack and elevator: three rows of two.
CoefficientTable grid() {
  CoefficientTable t = table(Coefficient::pitch, TableVariable::alpha, {-0.1, 0, 0.3}, {1, 2, 3, 5, 9, 7});
  t.and_over = TableVariable::elevator;
  t.and_at_ratio.push_back(-0.2);
  t.and_at_ratio.push_back(0.2);
  return t;
}

}  // namespace

TEST_CASE("drag over squares is the same to either side") {
  Airframe a = plain();
  a.aero.drag_squared = {0.15, 0.5, 0.06, 0.7};
  CHECK_FALSE(has_more(plain().aero));
  CHECK(has_more(a.aero));
  for (const double sign : {-1.0, 1.0}) {
    const double in_plane =
        std::cos(0.2) * std::cos(0.2);  // drag acts with the flow in the plane of symmetry
    CHECK(more(a, 0.1, sign * 0.2, {}).drag == Approx(in_plane * 0.15 * 0.04).epsilon(1e-6).scale(0));
    CHECK(more(a, 0.1, 0, {sign * 0.3, 0, 0}).drag == Approx(0.5 * 0.09).epsilon(1e-6).scale(0));
    CHECK(more(a, 0.1, 0, {0, sign * 0.3, 0}).drag == Approx(0.06 * 0.09).epsilon(1e-6).scale(0));
    CHECK(more(a, 0.1, 0, {0, 0, sign * 0.3}).drag == Approx(0.7 * 0.09).epsilon(1e-6).scale(0));
    CHECK(std::abs(more(a, 0.1, sign * 0.2, {0.3, 0.3, 0.3}).lift) < 1e-12);
    CHECK(std::abs(more(a, 0.1, sign * 0.2, {0.3, 0.3, 0.3}).pitch) < 1e-12);
  }
}

TEST_CASE("beyond the stall the pitching moment is that of a plate, if the airframe selects it") {
  Airframe a = plain();
  a.aero.pitch_stalled_ratio = -0.2168;
  for (const double alpha : {-2.5, -1.2, -0.7, 0.7, 1.2, 2.5}) {  // separated flow: Cm_fp sign(a) sin^2(a)
    const Load l = Aerodynamic(a).load(velocity(alpha, 0), Vector3d::Zero(), {}, rho);
    const double Cm = l.moment_b.y() / (0.5 * rho * Va * Va * a.wing.area_m2 * a.wing.chord_m);
    CHECK(Cm ==
          Approx((alpha > 0 ? -0.2168 : 0.2168) * std::sin(alpha) * std::sin(alpha)).epsilon(1e-6).scale(0));
  }
  for (const double alpha : {-0.1, 0.0, 0.1}) CHECK(std::abs(more(a, alpha, 0, {}).pitch) < 1e-3);
  const double sigma = Aerodynamic(a).stall(0.26), s2 = std::sin(0.26) * std::sin(0.26);
  REQUIRE(sigma > 0.3);
  REQUIRE(sigma < 0.7);
  const Load l = Aerodynamic(a).load(velocity(0.26, 0), Vector3d::Zero(), {}, rho);
  CHECK(
      l.moment_b.y() / (0.5 * rho * Va * Va * a.wing.area_m2 * a.wing.chord_m) ==
      Approx((1 - sigma) * (a.aero.pitch.zero_ratio + a.aero.pitch.alpha_ratio * 0.26) - sigma * 0.2168 * s2)
          .epsilon(1e-9)
          .scale(0));
}

TEST_CASE("a table is linear between its points and held beyond them") {
  const Airframe a = with(table(Coefficient::side, TableVariable::beta, {-0.2, 0.1, 0.3}, {4, 1, 2}));
  for (const auto& [beta, value] :
       {std::pair{-0.4, 4.0}, {-0.2, 4.0}, {-0.05, 2.5}, {0.1, 1.0}, {0.2, 1.5}, {0.3, 2.0}, {1.0, 2.0}})
    CHECK(more(a, 0.05, beta, {}).side == Approx(value).epsilon(1e-9).scale(0));
  CHECK(std::abs(more(a, 0.05, 0.1, {}).lift) < 1e-12);
  const Airframe one = with(table(Coefficient::roll, TableVariable::aileron, {0.1}, {0.4}));
  CHECK(more(one, 0.05, 0, {-1, 0, 0}).roll == Approx(0.4));
  CHECK(more(one, 0.05, 0, {1, 0, 0}).roll == Approx(0.4));
}

TEST_CASE("each coefficient and each variable has its own table") {
  const Deflections d{0.02, 0.03, 0.04};
  const double sound = 340.29;
  for (const auto& [over, x] : {std::pair{TableVariable::alpha, 0.1},
                                {TableVariable::beta, 0.0},
                                {TableVariable::mach, Va / sound},
                                {TableVariable::aileron, 0.02},
                                {TableVariable::elevator, 0.03},
                                {TableVariable::rudder, 0.04}})
    for (const Coefficient of : {Coefficient::lift, Coefficient::drag, Coefficient::side, Coefficient::roll,
                                 Coefficient::pitch, Coefficient::yaw}) {
      const Six six = more(with(table(of, over, {x - 0.01, x + 0.03}, {0, 4})), 0.1, 0, d);
      const std::array<double, 6> all{six.lift, six.drag, six.side, six.roll, six.pitch, six.yaw};
      for (std::size_t i = 0; i < all.size(); ++i)
        CHECK(std::abs(all[i] - (i == std::size_t(of) ? 1 : 0)) < 1e-9);
    }
}

TEST_CASE("two variables: bilinear, by rows of the first") {
  const Airframe a = with(grid());
  for (const auto& [alpha, elevator, value] : {std::tuple{-0.1, -0.2, 1.0},
                                               {-0.1, 0.2, 2.0},
                                               {0.0, -0.2, 3.0},
                                               {0.0, 0.2, 5.0},
                                               {0.3, -0.2, 9.0},
                                               {0.3, 0.2, 7.0},
                                               {-0.05, 0.0, 2.75},
                                               {0.15, 0.1, 6.0},
                                               {-1.0, 0.4, 2.0},
                                               {0.3, 0.0, 8.0}})
    CHECK(more(a, alpha, 0, {0, elevator, 0}).pitch == Approx(value).epsilon(1e-9).scale(0));
}

TEST_CASE("derivatives go through a table: the slope of its segment, none beyond its ends") {
  const CoefficientTable t = grid();
  using D = Dual<2>;
  const auto at = [&](double alpha, double elevator) {
    return value_of<D>(
        t, {D(0.0), D::variable(alpha, 0), D(0.0), D(0.0), D(0.0), D::variable(elevator, 1), D(0.0)});
  };
  const D inside = at(0.15, 0.1);
  const double h = 1e-6;
  CHECK(inside.d[0] == Approx((at(0.15 + h, 0.1).v - at(0.15 - h, 0.1).v) / (2 * h)).epsilon(1e-6));
  CHECK(inside.d[1] == Approx((at(0.15, 0.1 + h).v - at(0.15, 0.1 - h).v) / (2 * h)).epsilon(1e-6));
  CHECK(at(-0.05, -0.2).d[0] == Approx(20));
  CHECK(at(0.4, 0.1).d[0] == 0);
  CHECK(at(0.15, -0.3).d[1] == 0);
  CHECK(at(0.4, 0.1).d[1] == Approx(-5));
}

TEST_CASE("the range of the tables is the widest over a variable, and infinite without one") {
  Airframe a = with(table(Coefficient::lift, TableVariable::alpha, {-0.1, 0.3}, {0, 0}));
  CHECK_FALSE(Aerodynamic(a).beyond_tables(0.3, 3));
  CHECK(Aerodynamic(a).beyond_tables(0.31, 0));
  CHECK(Aerodynamic(a).beyond_tables(-0.11, 0));
  CHECK(Aerodynamic(a).beyond_tables(std::nan(""), 0));
  CHECK_FALSE(Aerodynamic(plain()).beyond_tables(3, -3));
  CoefficientTable wide = table(Coefficient::yaw, TableVariable::beta, {-0.5, 0.5}, {0, 0, 0, 0});
  wide.and_over = TableVariable::alpha;
  wide.and_at_ratio.push_back(-0.2);
  wide.and_at_ratio.push_back(0.2);
  a.aero.tables.push_back(wide);
  const Aerodynamic both(a);
  CHECK(both.alpha_range().min == -0.2);
  CHECK(both.alpha_range().max == 0.3);
  CHECK(both.beyond_tables(0, 0.51));
  CHECK(both.beyond_tables(0, -0.51));
  CHECK_FALSE(both.beyond_tables(-0.2, -0.5));
}

TEST_CASE("an invalid table is reported with its error") {
  CHECK(table_fault(grid()).empty());
  CoefficientTable t = grid();
  t.values_ratio.count = 5;
  CHECK(table_fault(t) == "values: flight.table_grid_mismatched(5, 3, 2, 6)");
  t = grid();
  t.at_ratio[2] = -0.05;
  CHECK(table_fault(t) == "at: flight.table_points_not_rising(-0.05, 0)");
  t = grid();
  t.and_at_ratio[1] = -0.2;
  CHECK(table_fault(t) == "and_at: flight.table_points_not_rising(-0.2, -0.2)");
  t = grid();
  t.at_ratio[2] = 30;
  CHECK(table_fault(t) == "at: flight.table_angle_large(30)");
  t = grid();
  t.and_over = TableVariable::alpha;
  CHECK(table_fault(t) == "and_over: flight.table_variables_equal");
  t.and_over = TableVariable::none;
  CHECK(table_fault(t) == "and_over: flight.table_second_variable_missing");
  t = grid();
  t.and_at_ratio.clear();
  CHECK(table_fault(t) == "and_at: flight.table_second_points_missing");
  t.over = TableVariable::none;
  CHECK(table_fault(t) == "over: flight.table_variable_missing");
}

TEST_CASE("flaps act on every coefficient by their derivative") {
  Airframe a = plain();
  a.aero.lift.flap_ratio = 0.9;
  a.aero.drag.flap_ratio = 0.1;
  a.aero.pitch.flap_ratio = -0.2;
  CHECK(has_flaps(a.aero));
  CHECK_FALSE(has_flaps(plain().aero));
  for (const double flap : {-0.1, 0.0, 0.5}) {
    const Six six = more(a, 0.1, 0, {0, 0, 0, flap});
    CHECK(std::abs(six.lift - 0.9 * flap) < 1e-12);
    CHECK(std::abs(six.drag - 0.1 * flap) < 1e-12);
    CHECK(std::abs(six.pitch + 0.2 * flap) < 1e-12);
  }
}

TEST_CASE("elevator and rudder work in the slipstream's dynamic pressure, q + T / A") {
  Airframe a = plain();
  a.aero.wash_frac = 0.6;
  const double D = a.propulsion.propeller_diameter_m, A = std::numbers::pi / 4 * D * D;
  const Deflections d{0.2, -0.1, 0.15};
  const Vector3d v = velocity(0.05, 0);
  for (const double thrust : {-5.0, 0.0, 20.0}) {
    Load with = Aerodynamic(a).load(v, Vector3d::Zero(), d, rho), before = with;
    Aerodynamic(a).add_wash<double>(v, d, thrust, rho, with);
    const double more_q = 0.6 * thrust / A, S = a.wing.area_m2;
    const Vector3d m = with.moment_b - before.moment_b;
    CHECK(m.y() == Approx(more_q * S * a.wing.chord_m * a.aero.pitch.elevator_ratio * -0.1));
    CHECK(m.z() == Approx(more_q * S * a.wing.span_m * a.aero.yaw.rudder_ratio * 0.15));
    CHECK(with.force_b.y() - before.force_b.y() == Approx(more_q * S * a.aero.side.rudder_ratio * 0.15));
  }
  Load brake = Aerodynamic(a).load(v, Vector3d::Zero(), {0, 0.1, 0}, rho), still = brake;
  Aerodynamic(a).add_wash<double>(v, {0, 0.1, 0}, -1e4, rho, brake);  // at most all of the flow
  CHECK(brake.moment_b.y() - still.moment_b.y() ==
        Approx(-0.6 * 0.5 * rho * Va * Va * a.wing.area_m2 * a.wing.chord_m * a.aero.pitch.elevator_ratio *
               0.1));
  const Trim washed = trimmed_flight(a, Va, rho), dry = trimmed_flight(plain(), Va, rho);
  REQUIRE(washed.found);
  CHECK(std::abs(washed.deflections.elevator) < 0.9 * std::abs(dry.deflections.elevator));
}

TEST_CASE("the disc motor: thrust, torque and speed by hand") {
  Propulsion p;
  p.disc = {0.1, 0.25, 37, 1.2e-6, 800};
  const Propeller disc(p);
  // half throttle at 17 m/s: the exit speed is 17 + 0.5 20 = 27; 1.1/2 0.1 0.25 27 10 N
  CHECK(disc.steady_speed(0.5, 17, 1.1) == Approx(400));
  CHECK(disc.thrust(400, 17, 1.1) == Approx(3.7125));
  CHECK(disc.thrust(400, 47, 1.1) == Approx(-0.5 * 1.1 * 0.1 * 0.25 * 42 * 5));
  CHECK(disc.thrust(0, 17, 1.1) == 0);
  CHECK(disc.torque(400, 17, 1.1) == Approx(1.2e-6 * 160000));
  CHECK(disc.throttle_for(400, 17, 1.1) == Approx(0.5));
  CHECK(0.5 * disc.current(0.5, 400) == Approx(1.2e-6 * 160000 * 400 / p.battery_volt));
  CHECK(disc.steady_speed(-1, 17, 1.1) == 0);
  CHECK(has_thrust(p));
  CHECK_FALSE(has_thrust(Propulsion{}));
  CHECK(propeller_disc(p) == 0.1);
}

TEST_CASE("without a rudder both trims agree, with a bank that holds the heading") {
  const Airframe a = test::airframe_file("x8");
  for (const double speed : {12.0, 18.0, 24.0})
    for (const double climb : {0.0, 0.05}) {
      const SteadyFlight f = steady_flight(AircraftModel(a, 0), {speed, climb});
      const Trim t = trimmed_flight(a, speed, isa::sea_level_density, climb);
      REQUIRE(f.found());
      REQUIRE(t.found);
      CHECK(std::abs(t.alpha_rad - f.alpha_rad) < 1e-8);
      CHECK(std::abs(t.beta_rad - f.beta_rad) < 1e-8);
      CHECK(std::abs(t.roll_rad - f.x(model::roll)) < 1e-8);
      CHECK(std::abs(t.pitch_rad - f.x(model::pitch)) < 1e-8);
      CHECK(std::abs(t.throttle_frac - f.input(model::throttle)) < 1e-8);
      CHECK(std::abs(t.roll_rad) > 1e-5);  // sideslip and aileron balance the torque of the propeller
      CHECK(t.deflections.rudder == 0);
    }
}

}  // namespace more_aerodynamics_test
