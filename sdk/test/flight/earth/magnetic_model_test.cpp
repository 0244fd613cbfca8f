// SPDX-License-Identifier: BSD-3-Clause
// World Magnetic Model 2025 against the official test values of NOAA and BGS.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <fulmar/flight/earth/magnetic_model.hpp>
#include <numbers>
#include <sstream>
#include <string>

namespace magnetic_model_test {

using namespace fulmar;

namespace {

struct Official {
  double year, height_km, lat_deg, lon_deg, x, y, z;  // nT
};
// From the test values published with the coefficients: X, Y, Z in nT, rounded to 0.1.
constexpr Official official[] = {
    {2025.0, 0, 80, 0, 6521.6, 145.9, 54791.5},         {2025.0, 0, 0, 120, 39677.8, -109.6, -10580.2},
    {2025.0, 0, -80, 240, 6117.5, 15751.9, -52022.5},   {2025.0, 100, -80, 240, 5907.6, 14780.3, -49540.7},
    {2027.5, 0, 80, 0, 6500.8, 294.5, 54869.4},         {2027.5, 100, 0, 120, 37711.5, -148.7, -9969.8},
    {2027.5, 100, -80, 240, 5984.0, 14760.1, -49317.7},
};

void agrees(const Official& o) {
  const Eigen::Vector3d b = 1e9 * magnetic_field_ned(o.lat_deg, o.lon_deg, 1e3 * o.height_km, o.year);
  CHECK(std::abs(b.x() - o.x) < 0.06);
  CHECK(std::abs(b.y() - o.y) < 0.06);
  CHECK(std::abs(b.z() - o.z) < 0.06);
}

}  // namespace

TEST_CASE("the field is the official one to the last digit published") {
  for (const Official& o : official) agrees(o);
}

TEST_CASE("the field agrees with the whole table of official test values") {
  const std::string file = std::string(FULMAR_REFERENCE_DATA) + "/wmm/WMM2025/WMM2025_TEST_VALUES.txt";
  if (!std::filesystem::exists(file)) {
    MESSAGE("skipped: no reference data at " << file);
    return;
  }
  std::ifstream in(file);
  int rows = 0;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream cells(line);
    Official o{};
    cells >> o.year >> o.height_km >> o.lat_deg >> o.lon_deg >> o.x >> o.y >> o.z;
    agrees(o);
    ++rows;
  }
  CHECK(rows == 12);
}

TEST_CASE("the field has no source: its flux out of a small box is zero") {
  // div B = 0 in local Cartesian axes, by central differences over kilometres; the curvature terms are 2 Bz/r
  // and tan(lat) Bx/r.
  for (const double lat : {-60.0, 10.0, 55.0}) {
    const double r = 6.371e6, d = 2000, deg = 180 / std::numbers::pi;
    const auto B = [&](double n, double e, double u) {
      return magnetic_field_ned(lat + n / r * deg, 30 + e / (r * std::cos(lat / deg)) * deg, u, 2026);
    };
    const double divergence =
        (B(d, 0, 0) - B(-d, 0, 0)).x() + (B(0, d, 0) - B(0, -d, 0)).y() - (B(0, 0, d) - B(0, 0, -d)).z();
    const double curvature = -2 * d * (2 * B(0, 0, 0).z() + std::tan(lat / deg) * B(0, 0, 0).x()) / r;
    CHECK(std::abs(divergence + curvature) < 0.01 * std::abs(curvature) + 1e-10);
  }
}

TEST_CASE("south of the magnetic equator the field points up, and at the poles it stays finite") {
  CHECK(magnetic_field_ned(-37.96, 144.76, 25, 2026).z() < -4e-5);
  for (const double lat : {90.0, -90.0}) {
    const Eigen::Vector3d pole = magnetic_field_ned(lat, 0, 0, 2026),
                          near = magnetic_field_ned(lat * (1 - 1e-9), 0, 0, 2026);
    CHECK(pole.allFinite());
    CHECK((pole - near).norm() < 1e-11);
  }
}

TEST_CASE("a year passes from one to the next, leap or not") {
  constexpr std::int64_t s = 1'000'000'000;
  CHECK(decimal_year(0) == 1970);
  CHECK(decimal_year(1767225600 * s) == 2026);
  CHECK(decimal_year(1782993600 * s) == doctest::Approx(2026.5).epsilon(1e-12));  // 2026-07-02T12:00Z
  CHECK(decimal_year(1709164800 * s) == doctest::Approx(2024 + 59.0 / 366));      // 2024-02-29
  CHECK(decimal_year(951782400 * s) ==
        doctest::Approx(2000 + 59.0 / 366));  // 2000-02-29: a leap year at the turn of a century
  CHECK(decimal_year(-1 * s) == doctest::Approx(1970).epsilon(1e-9));
  CHECK(decimal_year(-1 * s) < 1970);
}

}  // namespace magnetic_model_test
