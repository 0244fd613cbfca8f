// SPDX-License-Identifier: BSD-3-Clause
// The integrator against the exact motion of a free rigid body with three different moments of inertia.
// Landau & Lifshitz, Mechanics, section 37, axes ordered so that J1 < J2 < J3 and L^2 > 2 E J2; R. van Zon,
// J. Schofield, Journal of Computational Physics 225 (2007) 145-164.
#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "fulmar/flight/math/attitude.hpp"
#include "fulmar/flight/model/rigid_body.hpp"

namespace free_body_test {

using namespace fulmar;
using Eigen::Vector3d;

namespace {

struct Jacobi {
  double sn, cn, dn;
};

/// Jacobi elliptic functions by the arithmetic-geometric mean. Abramowitz & Stegun 16.4. `m` is the squared
/// modulus.
Jacobi jacobi(double u, double m) {
  std::array<double, 12> a{}, c{};
  a[0] = 1;
  c[0] = std::sqrt(m);
  double b = std::sqrt(1 - m);
  std::size_t n = 0;
  while (std::abs(c[n]) > 1e-16 && n + 1 < a.size()) {
    a[n + 1] = (a[n] + b) / 2;
    c[n + 1] = (a[n] - b) / 2;
    b = std::sqrt(a[n] * b);
    ++n;
  }
  double phi = std::ldexp(a[n] * u, static_cast<int>(n));
  for (; n > 0; --n) phi = (phi + std::asin(c[n] / a[n] * std::sin(phi))) / 2;
  const double s = std::sin(phi);
  return {s, std::cos(phi), std::sqrt(1 - m * s * s)};
}

const Vector3d J(0.21, 0.38, 0.56);
const MassProperties body(4.5, J.asDiagonal());

/// Exact motion that starts without a rate about the middle axis.
struct Exact {
  Vector3d amplitude;
  double L = 0, rate = 0, m = 0;

  Exact(double w1, double w3) {
    const double E2 = J.x() * w1 * w1 + J.z() * w3 * w3;  // 2 E
    L = std::hypot(J.x() * w1, J.z() * w3);
    const double A = E2 * J.z() - L * L, B = L * L - E2 * J.x();
    amplitude = {std::sqrt(A / (J.x() * (J.z() - J.x()))), std::sqrt(A / (J.y() * (J.z() - J.y()))),
                 std::sqrt(B / (J.z() * (J.z() - J.x())))};
    rate = std::sqrt((J.z() - J.y()) * B / J.prod());
    m = (J.y() - J.x()) * A / ((J.z() - J.y()) * B);
  }

  Vector3d omega(double t) const {  // (37.10)
    const Jacobi f = jacobi(rate * t, m);
    return amplitude.cwiseProduct(Vector3d(f.cn, f.sn, f.dn));
  }

  /// Rate about the angular momentum, which is the third axis of space. (37.17), from the angles of (37.14).
  double precession_rate(double t) const {
    const Vector3d w = omega(t);
    const double a = J.x() * w.x(), b = J.y() * w.y();
    return L * (a * w.x() + b * w.y()) / (a * a + b * b);
  }

  /// Attitude by the integral of the rate, with Simpson's rule in steps of 5 ms: accurate to 1e-11 rad.
  Eigen::Quaterniond attitude(double t) const {
    const int n = 2 + 2 * static_cast<int>(t / 0.01);
    double phi = 0;
    for (int i = 0; i <= n; ++i)
      phi += (i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2) * precession_rate(t * i / n);
    phi *= t / n / 3;
    const Vector3d l = J.cwiseProduct(omega(t)) / L;  // (37.14)
    const double theta = std::acos(l.z()), psi = std::atan2(l.x(), l.y());
    return Eigen::Quaterniond(Eigen::AngleAxisd(phi, Vector3d::UnitZ()) *
                              Eigen::AngleAxisd(theta, Vector3d::UnitX()) *
                              Eigen::AngleAxisd(psi, Vector3d::UnitZ()));
  }
};

RigidBody integrated(const Exact& exact, double dt, double duration) {
  RigidBody x;
  x.omega_b = exact.omega(0);
  x.q_nb = exact.attitude(0);
  const auto nothing = [](const RigidBody&, double) { return Load{}; };
  for (int i = 0; i < std::lround(duration / dt); ++i)
    x = runge_kutta(x, {}, dt, body, Vector3d::Zero(), nothing);
  return x;
}

}  // namespace

TEST_CASE("Jacobi's functions are circular ones at modulus 0, hyperbolic ones at 1, and as tabled between") {
  CHECK(jacobi(0.7, 0).sn == doctest::Approx(std::sin(0.7)).epsilon(1e-14));
  CHECK(jacobi(0.7, 1 - 1e-15).sn == doctest::Approx(std::tanh(0.7)).epsilon(1e-12));
  // a quarter period is K(m): sn = 1, cn = 0, dn = sqrt(1 - m); K(0.5) = 1.854074677301372
  const Jacobi quarter = jacobi(1.854074677301372, 0.5);
  CHECK(quarter.sn == doctest::Approx(1).epsilon(1e-14));
  CHECK(std::abs(quarter.cn) < 1e-12);
  CHECK(quarter.dn == doctest::Approx(std::sqrt(0.5)).epsilon(1e-13));
}

TEST_CASE("a free body with three moments of inertia tumbles as its exact solution, for 100 s at 400 Hz" *
          doctest::test_suite("amounts")) {
  for (const double w1 : {0.3, -0.8}) {
    const Exact exact(std::abs(w1), 0.9);
    REQUIRE(exact.m > 0);
    REQUIRE(exact.m < 1);
    const RigidBody x = integrated(exact, 0.0025, 100);
    CHECK((x.omega_b - exact.omega(100)).norm() < 1e-9);
    CHECK(x.q_nb.angularDistance(exact.attitude(100)) < 1e-9);
    CHECK((x.omega_b - exact.omega(0)).norm() > 0.1);  // not a whole number of periods
  }
}

TEST_CASE("the exact free body is met with fourth order: half the step, a sixteenth of the error") {
  const Exact exact(1.4, 2.1);
  const Vector3d omega = exact.omega(20);
  const Eigen::Quaterniond q = exact.attitude(20);
  double rate_before = 0, angle_before = 0;
  for (const double dt : {0.02, 0.01, 0.005}) {
    const RigidBody x = integrated(exact, dt, 20);
    const double rate = (x.omega_b - omega).norm(), angle = x.q_nb.angularDistance(q);
    if (rate_before > 0) {
      CHECK(rate_before / rate == doctest::Approx(16).epsilon(0.1));
      CHECK(angle_before / angle == doctest::Approx(16).epsilon(0.1));
    }
    rate_before = rate;
    angle_before = angle;
  }
}

TEST_CASE("without forces energy and angular momentum are kept to a billionth for a minute at 400 Hz" *
          doctest::test_suite("amounts")) {
  Eigen::Matrix3d skewed = J.asDiagonal();
  skewed(0, 2) = skewed(2, 0) = -0.06;
  const MassProperties aircraft(4.5, skewed);
  const auto nothing = [](const RigidBody&, double) { return Load{}; };
  for (const Vector3d& omega : {Vector3d(1, 0.05, 0), Vector3d(0.05, 1, -0.05), Vector3d(-0.5, 0.6, 0.6)}) {
    RigidBody x;
    x.omega_b = omega;
    const double energy = omega.dot(skewed * omega);
    const Vector3d momentum = skewed * omega;
    double energy_error = 0, momentum_error = 0;
    for (int i = 0; i < 24000; ++i) {
      x = runge_kutta(x, {}, 0.0025, aircraft, Vector3d::Zero(), nothing);
      energy_error = std::max(energy_error, std::abs(x.omega_b.dot(skewed * x.omega_b) / energy - 1));
      momentum_error =
          std::max(momentum_error, (x.q_nb * (skewed * x.omega_b) - momentum).norm() / momentum.norm());
    }
    CHECK(energy_error < 1e-9);
    CHECK(momentum_error < 1e-9);
  }
}

}  // namespace free_body_test
