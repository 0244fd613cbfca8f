// SPDX-License-Identifier: BSD-3-Clause
// Look-up tables of an airframe: parts of its coefficients over angle of attack, sideslip, Mach number or
// deflections.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

#include "fulmar/flight/messages.hpp"
#include "fulmar/msg/airframe.hpp"

namespace fulmar {

/// Variables of tables, at the index of their TableVariable; the first one is unused.
template <class S>
using TablePoint = std::array<S, 7>;

namespace detail {

/// Segment of x between two points of an axis: index of the lower point, and the fraction to the next. Beyond
/// the ends: the end, with zero slope.
template <class S>
struct Between {
  std::size_t low = 0;
  S part = 0;
};
template <class S, std::size_t N>
Between<S> between(const List<double, N>& at, const S& x) {
  if (at.size() < 2 || !(x > at[0])) return {};
  const std::size_t last = at.size() - 1;
  if (!(x < at[last])) return {last - 1, S(1.0)};
  std::size_t low = 0;
  while (x >= at[low + 1]) ++low;
  return {low, (x - at[low]) / (at[low + 1] - at[low])};
}

template <class S>
S straight(const S& part, double from, double to) {
  return from + part * (to - from);
}

}  // namespace detail

/// Linear or bilinear value. The derivative is that of the segment of the point; at a point of the table, of
/// the upper segment.
template <class S>
S value_of(const CoefficientTable& t, const TablePoint<S>& point) {
  const auto row = detail::between(t.at_ratio, point[std::size_t(t.over)]);
  const bool more_rows = t.at_ratio.size() > 1;
  if (t.and_over == TableVariable::none)
    return detail::straight(row.part, t.values_ratio[row.low], t.values_ratio[row.low + more_rows]);
  const auto column = detail::between(t.and_at_ratio, point[std::size_t(t.and_over)]);
  const std::size_t columns = t.and_at_ratio.size(), first = row.low * columns + column.low;
  const std::size_t next_column = columns > 1, next_row = more_rows ? columns : 0;
  const auto along = [&](std::size_t at) {
    return detail::straight(column.part, t.values_ratio[at], t.values_ratio[at + next_column]);
  };
  const S here = along(first);
  return here + row.part * (along(first + next_row) - here);
}

/// Range of tables; infinite without a table over the variable.
struct TableRange {
  double min = -std::numeric_limits<double>::infinity(), max = std::numeric_limits<double>::infinity();
  bool holds(double x) const { return x >= min && x <= max; }
};
/// The widest range of all tables over this variable.
inline TableRange table_range(const Aerodynamics& aero, TableVariable of) {
  TableRange range;
  bool any = false;
  const auto widen = [&](const auto& at) {
    if (at.empty()) return;
    range.min = any ? std::min(range.min, at[0]) : at[0];
    range.max = any ? std::max(range.max, at[at.size() - 1]) : at[at.size() - 1];
    any = true;
  };
  for (const CoefficientTable& t : aero.tables) {
    if (t.over == of) widen(t.at_ratio);
    if (t.and_over == of) widen(t.and_at_ratio);
  }
  return range;
}

/// Error in the points of a table, at the path `path`; "" if they are valid.
template <class Points>
std::string table_points_fault(const std::string& path, TableVariable over, const Points& at) {
  for (std::size_t i = 1; i < at.size(); ++i)
    if (!(at[i] > at[i - 1]))
      return located(path, flight_messages::table_points_not_rising(at[i], at[i - 1]));
  if (over == TableVariable::mach || at.empty()) return "";
  for (const double angle : {at[0], at[at.size() - 1]})
    if (std::abs(angle) > 3.2) return located(path, flight_messages::table_angle_large(angle));
  return "";
}

/// Error in a table: "values: ...", or "" if it is valid.
inline std::string table_fault(const CoefficientTable& t) {
  if (t.over == TableVariable::none) return located("over", flight_messages::table_variable_missing());
  if (t.at_ratio.empty()) return located("at", flight_messages::table_points_missing());
  if (std::string fault = table_points_fault("at", t.over, t.at_ratio); !fault.empty()) return fault;
  const bool two = t.and_over != TableVariable::none;
  if (two && t.and_over == t.over) return located("and_over", flight_messages::table_variables_equal());
  if (two && t.and_at_ratio.empty()) return located("and_at", flight_messages::table_second_points_missing());
  if (!two && !t.and_at_ratio.empty())
    return located("and_over", flight_messages::table_second_variable_missing());
  if (std::string fault = table_points_fault("and_at", t.and_over, t.and_at_ratio); !fault.empty())
    return fault;
  const std::size_t rows = t.at_ratio.size(), columns = two ? t.and_at_ratio.size() : 1;
  if (t.values_ratio.size() == rows * columns) return "";
  const std::size_t found = t.values_ratio.size();
  if (two)
    return located("values", flight_messages::table_grid_mismatched(found, rows, columns, rows * columns));
  return located("values", rows == 1 ? flight_messages::table_values_of_one_point(found)
                                     : flight_messages::table_values_mismatched(found, rows));
}

}  // namespace fulmar
