// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/import/analysis.hpp"

#include <cmath>

namespace fulmar::aero::imports {
namespace {

/// a ca + b cb, with its origin.
Value turned(const Value& a, double ca, const Value& b, double cb) {
  constexpr const char* words = ", turned to body axes";
  Value sum = a;
  sum.x = a.x * ca + b.x * cb;
  sum.known = a.known && b.known;
  if (sum.from.find(words) == std::string::npos) sum.from += words;
  return sum;
}

}  // namespace

const char* force_symbol(Force force) {
  constexpr std::array<const char*, forces> names{"CL", "CD", "CY", "Cl", "Cm", "Cn"};
  return names[force];
}

const char* by_symbol(By by) {
  constexpr std::array<const char*, bys> names{"alpha", "beta", "p", "q", "r"};
  return names[by];
}

void turn_moments(Column& column, double alpha) {
  const double c = std::cos(alpha), s = std::sin(alpha);
  const Value l = column[roll], n = column[yaw];
  column[roll] = turned(l, c, n, -s);
  column[yaw] = turned(n, c, l, s);
}

void turn_rates(std::array<Column, bys>& slope, double alpha) {
  const double c = std::cos(alpha), s = std::sin(alpha);
  // p' = p cos + r sin, r' = -p sin + r cos
  for (const Force force : {side, roll, yaw}) {
    const Value by_p = slope[p][force], by_r = slope[r][force];
    slope[p][force] = turned(by_p, c, by_r, -s);
    slope[r][force] = turned(by_r, c, by_p, s);
  }
  turn_moments(slope[p], alpha);
  turn_moments(slope[r], alpha);
}

}  // namespace fulmar::aero::imports
