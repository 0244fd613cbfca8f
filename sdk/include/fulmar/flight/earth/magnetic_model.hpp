// SPDX-License-Identifier: BSD-3-Clause
// World Magnetic Model 2025 (NOAA/NCEI and BGS, public domain): main field of the Earth, spherical harmonics
// of degree 12, valid 2025.0 to 2030.0. Source: Chulliat et al., The US/UK World Magnetic Model for
// 2025-2030, technical report (2024), equations (4) to (19).
#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace fulmar {
namespace wmm {

inline constexpr int degree = 12;
inline constexpr double epoch_year = 2025.0;

/// g, h in nT and their change in nT/year, Schmidt semi-normalised, in the order (1,0) (1,1) (2,0) (2,1)
/// (2,2) ...
struct Coefficient {
  double g, h, g_dot, h_dot;
};
// clang-format off
inline constexpr std::array<Coefficient, 90> coefficients{{
  {-29351.8, 0, 12, 0}, {-1410.8, 4545.4, 9.7, -21.5}, {-2556.6, 0, -11.6, 0}, {2951.1, -3133.6, -5.2, -27.7},
  {1649.3, -815.1, -8, -12.1}, {1361, 0, -1.3, 0}, {-2404.1, -56.6, -4.2, 4}, {1243.8, 237.5, 0.4, -0.3}, {453.6, -549.5, -15.6, -4.1},
  {895, 0, -1.6, 0}, {799.5, 278.6, -2.4, -1.1}, {55.7, -133.9, -6, 4.1}, {-281.1, 212, 5.6, 1.6}, {12.1, -375.6, -7, -4.4},
  {-233.2, 0, 0.6, 0}, {368.9, 45.4, 1.4, -0.5}, {187.2, 220.2, 0, 2.2}, {-138.7, -122.9, 0.6, 0.4}, {-142, 43, 2.2, 1.7},
  {20.9, 106.1, 0.9, 1.9}, {64.4, 0, -0.2, 0}, {63.8, -18.4, -0.4, 0.3}, {76.9, 16.8, 0.9, -1.6}, {-115.7, 48.8, 1.2, -0.4},
  {-40.9, -59.8, -0.9, 0.9}, {14.9, 10.9, 0.3, 0.7}, {-60.7, 72.7, 0.9, 0.9}, {79.5, 0, 0, 0}, {-77, -48.9, -0.1, 0.6},
  {-8.8, -14.4, -0.1, 0.5}, {59.3, -1, 0.5, -0.8}, {15.8, 23.4, -0.1, 0}, {2.5, -7.4, -0.8, -1}, {-11.1, -25.1, -0.8, 0.6},
  {14.2, -2.3, 0.8, -0.2}, {23.2, 0, -0.1, 0}, {10.8, 7.1, 0.2, -0.2}, {-17.5, -12.6, 0, 0.5}, {2, 11.4, 0.5, -0.4},
  {-21.7, -9.7, -0.1, 0.4}, {16.9, 12.7, 0.3, -0.5}, {15, 0.7, 0.2, -0.6}, {-16.8, -5.2, 0, 0.3}, {0.9, 3.9, 0.2, 0.2}, {4.6, 0, 0, 0},
  {7.8, -24.8, -0.1, -0.3}, {3, 12.2, 0.1, 0.3}, {-0.2, 8.3, 0.3, -0.3}, {-2.5, -3.3, -0.3, 0.3}, {-13.1, -5.2, 0, 0.2},
  {2.4, 7.2, 0.3, -0.1}, {8.6, -0.6, -0.1, -0.2}, {-8.7, 0.8, 0.1, 0.4}, {-12.9, 10, -0.1, 0.1}, {-1.3, 0, 0.1, 0}, {-6.4, 3.3, 0, 0},
  {0.2, 0, 0.1, 0}, {2, 2.4, 0.1, -0.2}, {-1, 5.3, 0, 0.1}, {-0.6, -9.1, -0.3, -0.1}, {-0.9, 0.4, 0, 0.1}, {1.5, -4.2, -0.1, 0},
  {0.9, -3.8, -0.1, -0.1}, {-2.7, 0.9, 0, 0.2}, {-3.9, -9.1, 0, 0}, {2.9, 0, 0, 0}, {-1.5, 0, 0, 0}, {-2.5, 2.9, 0, 0.1},
  {2.4, -0.6, 0, 0}, {-0.6, 0.2, 0, 0.1}, {-0.1, 0.5, -0.1, 0}, {-0.6, -0.3, 0, 0}, {-0.1, -1.2, 0, 0.1}, {1.1, -1.7, -0.1, 0},
  {-1, -2.9, -0.1, 0}, {-0.2, -1.8, -0.1, 0}, {2.6, -2.3, -0.1, 0}, {-2, 0, 0, 0}, {-0.2, -1.3, 0, 0}, {0.3, 0.7, 0, 0},
  {1.2, 1, 0, -0.1}, {-1.3, -1.4, 0, 0.1}, {0.6, 0, 0, 0}, {0.6, 0.6, 0.1, 0}, {0.5, -0.1, 0, 0}, {-0.1, 0.8, 0, 0}, {-0.4, 0.1, 0, 0},
  {-0.2, -1, -0.1, 0}, {-1.3, 0.1, 0, 0}, {-0.7, 0.2, -0.1, -0.1},
}};
// clang-format on

/// Index of degree `n` and order `m` in `coefficients`: 1 <= n <= 12, 0 <= m <= n.
inline constexpr std::size_t index(int n, int m) { return static_cast<std::size_t>(n * (n + 1) / 2 + m - 1); }

/// Schmidt semi-normalised associated Legendre functions of sin(phi') and their derivative by phi', n and m
/// up to 12.
struct Legendre {
  std::array<std::array<double, degree + 1>, degree + 1> p{}, dp{};

  Legendre(double s, double c) {
    p[0][0] = 1;
    for (std::size_t n = 1; n <= degree; ++n) {
      const double dn = static_cast<double>(n);
      for (std::size_t m = 0; m <= n; ++m) {
        const double dm = static_cast<double>(m);
        if (m == n) {  // sectorial: P_nn = sqrt((2n-1)/2n) cos P_n-1,n-1, the factor is 1 for n = 1
          const double k = n == 1 ? 1 : std::sqrt((2 * dn - 1) / (2 * dn));
          p[n][n] = k * c * p[n - 1][n - 1];
          dp[n][n] = k * (c * dp[n - 1][n - 1] - s * p[n - 1][n - 1]);
        } else {
          const double k = 1 / std::sqrt(dn * dn - dm * dm);
          const double below = m + 2 <= n ? std::sqrt((dn - 1) * (dn - 1) - dm * dm) : 0;
          const double p2 = n >= 2 ? p[n - 2][m] : 0;
          const double dp2 = n >= 2 ? dp[n - 2][m] : 0;
          p[n][m] = k * ((2 * dn - 1) * s * p[n - 1][m] - below * p2);
          dp[n][m] = k * ((2 * dn - 1) * (c * p[n - 1][m] + s * dp[n - 1][m]) - below * dp2);
        }
      }
    }
  }
};

/// Geodetic on WGS-84 -> geocentric latitude (sine, cosine) and radius in metres.
struct Geocentric {
  double s, c, r;

  Geocentric(double lat_rad, double height_m) {
    constexpr double a = 6378137.0, f = 1 / 298.257223563, e2 = f * (2 - f);
    const double sl = std::sin(lat_rad), cl = std::cos(lat_rad);
    const double rc = a / std::sqrt(1 - e2 * sl * sl);
    const double p = (rc + height_m) * cl, z = (rc * (1 - e2) + height_m) * sl;
    r = std::hypot(p, z);
    s = z / r;
    c = p / r;
  }
};

}  // namespace wmm

/// Decimal year for the magnetic model: 2026-07-02T12:00Z is 2026.5.
inline double decimal_year(std::int64_t unix_ns) {
  constexpr std::int64_t day_ns = 86'400'000'000'000;
  const auto leap = [](std::int64_t y) { return (y % 4 == 0 && y % 100 != 0) || y % 400 == 0; };
  std::int64_t days = unix_ns / day_ns, rest_ns = unix_ns % day_ns;
  if (rest_ns < 0) {
    rest_ns += day_ns;
    --days;
  }
  // Civil calendar: 400-year cycles of 146097 days, then whole years.
  std::int64_t year = 1970;
  const std::int64_t cycles = days >= 0 ? days / 146097 : (days - 146096) / 146097;
  year += 400 * cycles;
  days -= 146097 * cycles;
  while (days >= (leap(year) ? 366 : 365)) {
    days -= leap(year) ? 366 : 365;
    ++year;
  }
  const double length = leap(year) ? 366 : 365;
  return static_cast<double>(year) +
         (static_cast<double>(days) + static_cast<double>(rest_ns) / static_cast<double>(day_ns)) / length;
}

/// Main magnetic field of the Earth, north, east, down, tesla. Height above the WGS-84 ellipsoid; mean sea
/// level is accurate enough (30 m are 1 nT). Valid at any point; at a pole `north` is along the meridian
/// `lon_deg`. Outside 2025-2030 the model is extrapolated.
inline Eigen::Vector3d magnetic_field_ned(double lat_deg, double lon_deg, double height_m, double year) {
  constexpr double rad = std::numbers::pi / 180, reference_radius_m = 6371200.0;
  const double lat = lat_deg * rad, lon = lon_deg * rad, t = year - wmm::epoch_year;
  const wmm::Geocentric at(lat, height_m);
  const double cos_or_tiny =
      at.c > 1e-10 ? at.c
                   : 1e-10;  // P_nm of m > 0 goes to zero with the cosine: the ratio below stays finite
  const wmm::Legendre legendre(at.s, cos_or_tiny);
  const double ratio = reference_radius_m / at.r;
  double power = ratio * ratio, north = 0, east = 0, down = 0;  // geocentric axes
  for (int n = 1; n <= wmm::degree; ++n) {
    power *= ratio;
    for (int m = 0; m <= n; ++m) {
      const wmm::Coefficient& k = wmm::coefficients[wmm::index(n, m)];
      const double g = k.g + t * k.g_dot, h = k.h + t * k.h_dot;
      const double cm = std::cos(m * lon), sm = std::sin(m * lon);
      const double p = legendre.p[static_cast<std::size_t>(n)][static_cast<std::size_t>(m)];
      const double dp = legendre.dp[static_cast<std::size_t>(n)][static_cast<std::size_t>(m)];
      north -= power * (g * cm + h * sm) * dp;                  // (10)
      east += power * m * (g * sm - h * cm) * p / cos_or_tiny;  // (11)
      down -= power * (n + 1) * (g * cm + h * sm) * p;          // (12)
    }
  }
  const double turn = std::atan2(at.s, at.c) - lat;  // geocentric to geodetic axes, (17)
  const double ct = std::cos(turn), st = std::sin(turn);
  return Eigen::Vector3d(north * ct - down * st, east, north * st + down * ct) * 1e-9;
}

}  // namespace fulmar
