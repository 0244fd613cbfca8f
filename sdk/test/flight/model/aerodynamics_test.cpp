// SPDX-License-Identifier: BSD-3-Clause
#include "fulmar/flight/model/aerodynamics.hpp"

#include <doctest/doctest.h>

#include <array>
#include <functional>

#include "sdk/test/flight/airframe_file.hpp"

namespace aerodynamics_test {

using namespace fulmar;
using doctest::Approx;
using Eigen::Vector3d;

namespace {

/// An aircraft with all derivatives, no two of them equal.
Airframe full() {
  Airframe a = test::airframe_file("anaconda");
  double value = 0.11;
  const auto fill = [&](Derivatives& d) {
    for (double* c : {&d.zero_ratio, &d.alpha_ratio, &d.beta_ratio, &d.p_ratio, &d.q_ratio, &d.r_ratio,
                      &d.aileron_ratio, &d.elevator_ratio, &d.rudder_ratio})
      *c = (value += 0.037);
  };
  for (Derivatives* d : {&a.aero.lift, &a.aero.drag, &a.aero.side, &a.aero.roll, &a.aero.pitch, &a.aero.yaw})
    fill(*d);
  return a;
}

struct Point {
  double alpha = 0, beta = 0, p = 0, q = 0, r = 0;
  Deflections d;
};

constexpr double Va = 17, rho = 1.1;

/// CL, CD, CY, Cl, Cm, Cn at a point, from force and moment.
std::array<double, 6> coefficients(const Airframe& a, const Point& at) {
  const Vector3d v(Va * std::cos(at.alpha) * std::cos(at.beta), Va * std::sin(at.beta),
                   Va * std::sin(at.alpha) * std::cos(at.beta));
  const Load l = Aerodynamic(a).load(v, {at.p, at.q, at.r}, at.d, rho);
  const double qS = 0.5 * rho * Va * Va * a.wing.area_m2, b = a.wing.span_m, c = a.wing.chord_m;
  const double L = l.force_b.x() * std::sin(at.alpha) - l.force_b.z() * std::cos(at.alpha);
  const double D = -l.force_b.x() * std::cos(at.alpha) - l.force_b.z() * std::sin(at.alpha);
  return {L / qS,
          D / qS,
          l.force_b.y() / qS,
          l.moment_b.x() / (qS * b),
          l.moment_b.y() / (qS * c),
          l.moment_b.z() / (qS * b)};
}

}  // namespace

TEST_CASE("finite differences of force and moment give back every derivative of the airframe") {
  const Airframe a = full();
  const std::array<const Derivatives*, 6> tables{&a.aero.lift, &a.aero.drag,  &a.aero.side,
                                                 &a.aero.roll, &a.aero.pitch, &a.aero.yaw};
  using Access = std::function<double&(Point&)>;
  struct Axis {
    Access of;
    double Derivatives::*derivative;
    double scale;  // factor from the variable to the dimensionless one
  };
  const double b = a.wing.span_m / (2 * Va), c = a.wing.chord_m / (2 * Va);
  const std::array<Axis, 8> axes{
      {{[](Point& x) -> double& { return x.alpha; }, &Derivatives::alpha_ratio, 1},
       {[](Point& x) -> double& { return x.beta; }, &Derivatives::beta_ratio, 1},
       {[](Point& x) -> double& { return x.p; }, &Derivatives::p_ratio, b},
       {[](Point& x) -> double& { return x.q; }, &Derivatives::q_ratio, c},
       {[](Point& x) -> double& { return x.r; }, &Derivatives::r_ratio, b},
       {[](Point& x) -> double& { return x.d.aileron; }, &Derivatives::aileron_ratio, 1},
       {[](Point& x) -> double& { return x.d.elevator; }, &Derivatives::elevator_ratio, 1},
       {[](Point& x) -> double& { return x.d.rudder; }, &Derivatives::rudder_ratio, 1}}};
  for (const Axis& axis : axes) {
    Point up, down;
    axis.of(up) += 1e-4;
    axis.of(down) -= 1e-4;
    const auto high = coefficients(a, up), low = coefficients(a, down);
    for (std::size_t i = 0; i < tables.size(); ++i) {
      const bool induced = i == 1 && axis.derivative == &Derivatives::alpha_ratio;
      const double AR = a.wing.span_m * a.wing.span_m / a.wing.area_m2;
      const double polar = induced ? 2 * a.aero.lift.zero_ratio * a.aero.lift.alpha_ratio /
                                         (std::numbers::pi * a.wing.oswald_ratio * AR)
                                   : 0;
      CHECK((high[i] - low[i]) / (2e-4 * axis.scale) ==
            Approx(tables[i]->*axis.derivative + polar).epsilon(1e-3));
    }
  }
}

TEST_CASE("drag at a given lift is parasite plus induced drag") {
  const Airframe a = test::airframe_file("anaconda");
  Point at;
  at.alpha = 0.05;
  const auto c = coefficients(a, at);
  const double CL = 0.506 + 5.61 * 0.05;
  CHECK(c[0] == Approx(CL).epsilon(1e-3));
  CHECK(c[1] == Approx(0.043 + CL * CL / (3.14159265 * 0.9 * 2.08 * 2.08 / 0.52)).epsilon(1e-3));
}

TEST_CASE("the stall blending is the book's: nothing below, half at the stall angle, all beyond") {
  const Airframe a = test::airframe_file("anaconda");
  const Aerodynamic aero(a);
  const double stall = a.wing.stall_alpha_rad;
  CHECK(aero.stall(0) < 1e-4);
  CHECK(aero.stall(stall) == Approx(0.5).epsilon(1e-3));
  CHECK(aero.stall(-stall) == Approx(0.5).epsilon(1e-3));
  CHECK(aero.stall(stall + 0.2) > 0.999);
  // Beard & McLain (4.10), written out independently, at an angle in between
  const double M = 50, x = 0.22, e1 = std::exp(-M * (x - stall)), e2 = std::exp(M * (x + stall));
  CHECK(aero.stall(x) == Approx((1 + e1 + e2) / ((1 + e1) * (1 + e2))));
}

TEST_CASE("beyond the stall the wing is a flat plate, whichever way the air comes") {
  const Airframe a = test::airframe_file("anaconda");
  for (double alpha : {0.8, 1.5707963, 2.4, -0.9, -2.0, 3.14}) {
    Point at;
    at.alpha = alpha;
    const auto c = coefficients(a, at);
    const double s = std::sin(alpha);
    CHECK(c[0] == Approx(std::copysign(2 * s * s, alpha) * std::cos(alpha)).epsilon(1e-6));
    CHECK(c[1] == Approx(a.aero.parasite_drag_ratio + 2 * std::abs(s * s * s)).epsilon(1e-6));
  }
}

TEST_CASE("lift rises to the stall and falls behind it") {
  const Airframe a = test::airframe_file("anaconda");
  const auto lift = [&](double degrees) {
    Point at;
    at.alpha = degrees * std::numbers::pi / 180;
    return coefficients(a, at)[0];
  };
  CHECK(lift(12) > lift(10));
  CHECK(lift(20) < lift(13));
  CHECK(lift(13) > 1.2);
  CHECK(lift(13) < 1.8);
}

TEST_CASE("there is no air force without airspeed, and none jumps on the way there") {
  const Airframe a = full();
  const Aerodynamic aero(a);
  const Vector3d direction = Vector3d(0.8, 0.3, 0.5).normalized(), omega(3, -2, 1);
  Load before = aero.load(Vector3d::Zero(), omega, {0.3, 0.3, 0.3}, rho);
  CHECK(before.force_b.norm() == 0);
  CHECK(before.moment_b.norm() == 0);
  for (int i = 1; i <= 2000; ++i) {
    const Load now = aero.load(0.001 * i * direction, omega, {0.3, 0.3, 0.3}, rho);
    CHECK((now.force_b - before.force_b).norm() < 0.03);
    CHECK((now.moment_b - before.moment_b).norm() < 0.03);
    before = now;
  }
}

TEST_CASE("force and moment do not jump as the air comes round from all sides") {
  const Airframe a = test::airframe_file("anaconda");
  const Aerodynamic aero(a);
  const auto load = [&](int i) {
    const double alpha = 0.001 * i;
    return aero.load(Va * Vector3d(std::cos(alpha), 0, std::sin(alpha)), Vector3d::Zero(), {}, rho);
  };
  for (int i = -3142; i < 3142; ++i) {
    CHECK((load(i + 1).force_b - load(i).force_b).norm() < 2);
    CHECK((load(i + 1).moment_b - load(i).moment_b).norm() < 2);
  }
}

TEST_CASE("force and moment do not jump as the air comes round over the wing tip") {
  const Airframe a = test::airframe_file("anaconda");
  const Aerodynamic aero(a);
  for (double tilt :
       {0.0, 0.3, 1.2}) {  // the plane of the rotating wind contains the wing; through 90 degrees of sideslip
                           // alpha jumps by pi degrees of sideslip alpha leaps by pi
    const Vector3d ahead(std::cos(tilt), 0, std::sin(tilt));
    const auto load = [&](int i) {
      return aero.load(Va * (std::cos(0.001 * i) * ahead + std::sin(0.001 * i) * Vector3d::UnitY()),
                       Vector3d::Zero(), {}, rho);
    };
    for (int i = 1400; i < 1740; ++i) {
      CHECK((load(i + 1).force_b - load(i).force_b).norm() < 1);
      CHECK((load(i + 1).moment_b - load(i).moment_b).norm() < 1);
    }
  }
}

TEST_CASE("controls turn the aircraft the way that the conventions say") {
  const Airframe a = test::airframe_file("anaconda");
  Point right, down, left;
  right.d.aileron = down.d.elevator = left.d.rudder = 0.1;
  const auto rest = coefficients(a, {});
  CHECK(coefficients(a, right)[3] > rest[3]);  // aileron: rolls right
  CHECK(coefficients(a, down)[4] < rest[4]);   // elevator: nose down
  CHECK(coefficients(a, left)[5] < rest[5]);   // rudder: nose left
}

}  // namespace aerodynamics_test
