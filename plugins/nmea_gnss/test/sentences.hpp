// SPDX-License-Identifier: BSD-3-Clause
// Writes sentences for the tests; shares nothing with the reader.
#pragma once
#include <cstdio>
#include <string>

inline std::string framed(const std::string& body) {
  int sum = 0;
  for (const char c : body) sum ^= c;
  char tail[8];
  std::snprintf(tail, sizeof tail, "*%02X\r\n", sum & 0xff);
  return "$" + body + tail;
}

/// GGA and RMC of second `s` of an hour: 47 deg 17.(1140 + s) min north, 8 deg 33.9159 min east, `knots` over
/// ground towards 90 deg.
inline std::string epoch_text(int s, double knots = 20) {
  char time[64], gga[192], rmc[192];
  std::snprintf(time, sizeof time, "12%02d%02d.00", s / 60 % 60, s % 60);
  std::snprintf(gga, sizeof gga, "GNGGA,%s,4717.%04d,N,00833.9159,E,1,09,1.00,500.0,M,48.0,M,,", time,
                1140 + s);
  std::snprintf(rmc, sizeof rmc, "GNRMC,%s,A,4717.%04d,N,00833.9159,E,%.3f,90.0,091202,,,A", time, 1140 + s,
                knots);
  return framed(rmc) + framed(gga);
}
