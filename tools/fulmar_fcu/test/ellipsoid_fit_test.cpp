// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_fcu/ellipsoid_fit.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "fulmar/random.hpp"
#include "tools/fulmar_fcu/test/with_eigen.hpp"

namespace ellipsoid_fit_test {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using fulmar::fcu::test::fit_ellipsoid;
using fulmar::fcu::test::plain;
using fulmar::fcu::test::rows_of;
using fulmar::fcu::test::with_eigen;

constexpr double field = 48e-6;  // tesla

/// The reading of a distorted sensor: the firmware corrects it by A (m - b).
struct Sensor {
  Vector3d b{12e-6, -31e-6, 7e-6};
  Matrix3d A;
  double noise = 0;
  fulmar::Random random{7};
  Sensor() {
    A << 1.10, 0.04, -0.03, 0.04, 0.93, 0.05, -0.03, 0.05, 0.98;
    A /= std::cbrt(A.determinant());
  }
  Vector3d read(const Vector3d& direction) {
    const Vector3d n(random.normal(), random.normal(), random.normal());
    return A.inverse() * (field * direction.normalized()) + b + noise * n;
  }
};

Vector3d anywhere(fulmar::Random& random) {
  return Vector3d(random.normal(), random.normal(), random.normal());
}

/// The aircraft is laid on each of six sides and turned once about the vertical; the field dips by so much.
std::vector<Vector3d> six_sides(double dip_deg) {
  const double dip = dip_deg * std::numbers::pi / 180;
  std::vector<Vector3d> out;
  for (int side = 0; side < 6; ++side)
    for (int k = 0; k < 60; ++k) {
      const double a = k * std::numbers::pi / 30, up = side % 2 == 0 ? 1 : -1;
      Vector3d v;
      v(side / 2) = up * std::sin(dip);
      v((side / 2 + 1) % 3) = std::cos(dip) * std::cos(a);
      v((side / 2 + 2) % 3) = std::cos(dip) * std::sin(a);
      out.push_back(v);
    }
  return out;
}

TEST_CASE("a known distortion without noise comes back to rounding") {
  Sensor sensor;
  fulmar::Random random(1);
  std::vector<Vector3d> m;
  for (int i = 0; i < 300; ++i) m.push_back(sensor.read(anywhere(random)));
  const auto fit = fit_ellipsoid(m);
  REQUIRE(fit.ok());
  CHECK((fit.bias - sensor.b).norm() < 1e-9 * field);
  CHECK((fit.shape - sensor.A).norm() < 1e-9);
  CHECK(fit.field == doctest::Approx(field).epsilon(1e-9));
  CHECK(fit.coverage_ratio == 1);
}

TEST_CASE("six sides with 1 % noise give the heading to a degree") {
  Sensor sensor;
  sensor.noise = 0.01 * field;
  std::vector<Vector3d> m;
  for (const Vector3d& v : six_sides(65)) m.push_back(sensor.read(v));
  const auto fit = fit_ellipsoid(m);
  REQUIRE(fit.ok());
  CHECK(fulmar::fcu::objection(fit, 1e-6) == "");
  double worst_deg = 0;
  for (const Vector3d& v : six_sides(30)) {
    const Vector3d seen = fit.shape * (sensor.A.inverse() * (field * v) + sensor.b - fit.bias);
    worst_deg = std::max(
        worst_deg, std::acos(std::min(1.0, seen.normalized().dot(v.normalized()))) * 180 / std::numbers::pi);
  }
  CHECK(worst_deg < 1.5);
  CHECK(fit.residual_ratio == doctest::Approx(0.01).epsilon(0.2));
}

TEST_CASE("a few wild samples do not pull the fit away") {
  Sensor sensor;
  sensor.noise = 0.005 * field;
  fulmar::Random random(3);
  std::vector<Vector3d> m;
  for (int i = 0; i < 400; ++i) m.push_back(sensor.read(anywhere(random)) * (i % 50 == 0 ? 1.8 : 1.0));
  const auto fit = fit_ellipsoid(m);
  REQUIRE(fit.ok());
  CHECK((fit.bias - sensor.b).norm() < 0.02 * field);
  CHECK((fit.shape - sensor.A).norm() < 0.03);
}

TEST_CASE("samples that do not tell an ellipsoid are refused") {
  Sensor sensor;
  sensor.noise = 0.005 * field;
  fulmar::Random random(5);
  const auto refused = [](const std::vector<Vector3d>& m) {
    const auto fit = fit_ellipsoid(m);
    return !fit.ok() || !fulmar::fcu::objection(fit, 1e-6).empty();
  };
  std::vector<Vector3d> still, flat, half, line;
  for (int i = 0; i < 400; ++i) {
    Vector3d v = anywhere(random).normalized();
    still.push_back(sensor.read(Vector3d(1, 0, 0)));
    flat.push_back(sensor.read(Vector3d(v.x(), v.y(), 0)));
    half.push_back(sensor.read(Vector3d(v.x(), v.y(), std::fabs(v.z()) * 0.5 + 0.5)));
    line.push_back(Vector3d(1, 2, 3) * (i * 1e-7));
  }
  CHECK(refused(still));
  CHECK(refused(flat));
  CHECK(refused(half));
  CHECK(refused(line));
  CHECK(refused(std::vector<Vector3d>(400, Vector3d(1e-5, 2e-5, 3e-5))));
  CHECK(refused(std::vector<Vector3d>(10, Vector3d(1e-5, 2e-5, 3e-5))));
  CHECK(refused({}));
}

TEST_CASE("a field that is not the Earth's is refused") {
  Sensor sensor;
  fulmar::Random random(9);
  std::vector<Vector3d> m;
  for (int i = 0; i < 300; ++i) m.push_back(10 * sensor.read(anywhere(random)));
  const auto fit = fit_ellipsoid(m);
  REQUIRE(fit.ok());
  CHECK(fulmar::fcu::objection(fit, 1e-6) == "fcu.field_implausible(480)");
}

TEST_CASE(
    "a calibration that is in force is taken off before the fit, and the new one is what the firmware "
    "needs") {
  Sensor sensor;
  Matrix3d A0;
  A0 << 1.2, 0.1, 0, 0.02, 0.9, 0, 0, -0.1, 1.05;
  const Vector3d b0(-4e-6, 9e-6, 2e-6);
  const Vector3d raw = sensor.read(Vector3d(1, 2, 3)), reported = A0 * (raw - b0);
  const Vector3d found = with_eigen(fulmar::fcu::uncorrected(plain(reported), rows_of(A0), plain(b0)));
  CHECK((found - raw).norm() < 1e-15);
}

}  // namespace

}  // namespace ellipsoid_fit_test
