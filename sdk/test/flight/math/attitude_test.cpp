// SPDX-License-Identifier: BSD-3-Clause
// Euler angles against the rotation matrix of the book, rotation vectors against Eigen, attitude from two
// directions against the true attitude.
#include <doctest/doctest.h>

#include <cmath>
#include <fulmar/flight/math/attitude.hpp>
#include <fulmar/random.hpp>
#include <numbers>

namespace attitude_test {

using namespace fulmar;

namespace {

Eigen::Matrix3d book(double phi, double theta, double psi) {  // Beard & McLain (2.5), transposed: body to NED
  const double sf = std::sin(phi), cf = std::cos(phi), st = std::sin(theta), ct = std::cos(theta),
               ss = std::sin(psi), cs = std::cos(psi);
  Eigen::Matrix3d R;
  R << ct * cs, sf * st * cs - cf * ss, cf * st * cs + sf * ss, ct * ss, sf * st * ss + cf * cs,
      cf * st * ss - sf * cs, -st, sf * ct, cf * ct;
  return R;
}

}  // namespace

TEST_CASE("Euler angles give the book's rotation matrix and come back from it") {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Euler e{random.uniform(-3.1, 3.1), random.uniform(-1.5, 1.5), random.uniform(-3.1, 3.1)};
    const Eigen::Quaterniond q = quaternion_from(e);
    CHECK((q.toRotationMatrix() - book(e.roll_rad, e.pitch_rad, e.yaw_rad)).norm() < 1e-13);
    const Euler back = euler_from(q);
    CHECK(back.roll_rad == doctest::Approx(e.roll_rad).epsilon(1e-9));
    CHECK(back.pitch_rad == doctest::Approx(e.pitch_rad).epsilon(1e-9));
    CHECK(back.yaw_rad == doctest::Approx(e.yaw_rad).epsilon(1e-9));
  }
}

TEST_CASE("straight up and straight down the angles stay finite and give the same attitude") {
  for (const double pitch : {std::numbers::pi / 2, -std::numbers::pi / 2})
    for (const double yaw : {-2.0, 0.0, 1.0}) {
      const Eigen::Quaterniond q = quaternion_from({0.3, pitch, yaw});
      const Euler e = euler_from(q);
      CHECK(std::isfinite(e.roll_rad + e.pitch_rad + e.yaw_rad));
      CHECK(q.angularDistance(quaternion_from(e)) < 1e-6);
    }
}

TEST_CASE(
    "the exponential map agrees with an axis and an angle, small or large, and the logarithm undoes it") {
  Random random(2);
  for (const double angle : {0.0, 1e-12, 1e-6, 0.0999, 0.1001, 1.0, 3.0}) {
    const Eigen::Vector3d axis =
        Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    const Eigen::Quaterniond q = exp_map(angle * axis), expected(Eigen::AngleAxisd(angle, axis));
    CHECK((q.coeffs() - expected.coeffs()).norm() < 2e-13);
    CHECK((log_map(q) - angle * axis).norm() < 1e-9);
    CHECK((log_map(Eigen::Quaterniond(-q.coeffs())) - angle * axis).norm() < 1e-9);
  }
}

TEST_CASE("the skew matrix is the cross product") {
  const Eigen::Vector3d a(1, -2, 3), b(0.5, 4, -1);
  CHECK((skew(a) * b - a.cross(b)).norm() == 0);
  CHECK(skew(a)(2, 1) == a.x());
}

TEST_CASE("two directions give the attitude back; noise in the second leaves the first exact") {
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Quaterniond q =
        quaternion_from({random.uniform(-3, 3), random.uniform(-1.5, 1.5), random.uniform(-3, 3)});
    const Eigen::Vector3d f(0.3, -0.2, -9.8), m(2e-5, 3e-6, 4.5e-5);
    CHECK(q.angularDistance(attitude_from_directions(q.conjugate() * f, f, q.conjugate() * m, m)) < 1e-7);
    const Eigen::Quaterniond tilted =
        attitude_from_directions(q.conjugate() * f, f, q.conjugate() * m + Eigen::Vector3d(1e-6, 2e-6, 0), m);
    CHECK((tilted * (q.conjugate() * f) - f).norm() < 1e-9);
  }
}

}  // namespace attitude_test
