// SPDX-License-Identifier: BSD-3-Clause
// See response_series.hpp.
#include "tools/fulmar_log/response_series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "core/types/named.hpp"
#include "tools/fulmar_log/log_field.hpp"
#include "tools/fulmar_log/messages.hpp"

namespace fulmar::response {
namespace {

using core::Error;

/// The unit at the end of the last part of a name that has one, and the name with degrees.
void take_unit(Signal& s) {
  constexpr std::array<std::string_view, 14> units{"rad", "radps", "radps2", "deg",    "m", "mps", "mps2",
                                                   "pa",  "volt",  "amp",    "newton", "s", "ns",  "kelvin"};
  for (std::size_t end = s.name.size(); end != std::string::npos && end > 0;) {
    const std::size_t dot = s.name.rfind('.', end - 1);
    const std::string part = s.name.substr(dot + 1, end - dot - 1);
    const std::string suffix = part.substr(part.rfind('_') + 1, part.find('[') - part.rfind('_') - 1);
    if (part.rfind('_') != std::string::npos &&
        std::find(units.begin(), units.end(), suffix) != units.end()) {
      s.unit = suffix;
      if (!suffix.starts_with("rad")) return;
      s.unit.replace(0, 3, "deg");
      s.name.replace(dot + 1 + part.rfind('_') + 1, 3, "deg");
      for (double& x : s.series.x) x *= 180 / std::numbers::pi;
      return;
    }
    end = dot;
  }
}

void unwrap(std::vector<double>& degrees) {
  for (std::size_t i = 1; i < degrees.size(); ++i)
    degrees[i] += 360 * std::round((degrees[i - 1] - degrees[i]) / 360);
}

/// From and to, s.
std::pair<double, double> bounds_of(const core::LogInfo& info, const std::string& log, const Window& w) {
  double from_s = w.from_s.value_or(-std::numeric_limits<double>::infinity()),
         to_s = w.to_s.value_or(std::numeric_limits<double>::infinity());
  if (w.phase.empty()) return {from_s, to_s};
  if (const core::LogInfo::Phase* const phase = core::find_named(info.phases, w.phase))
    return {std::max(from_s, 1e-9 * static_cast<double>(phase->begin_ns)),
            std::min(to_s, 1e-9 * static_cast<double>(phase->end_ns))};
  throw Error(located(log, core::has_no("the flight", "phase", w.phase, info.phases)));
}

}  // namespace

std::array<Signal, 2> read_signals(const std::filesystem::path& log, const std::array<std::string, 2>& fields,
                                   const Window& window) {
  const std::string name = log.string();
  const core::LogInfo info = core::read_info(log);
  const auto [from_s, to_s] = bounds_of(info, name, window);
  const std::array places{core::place_in_log(info, name, fields[0]),
                          core::place_in_log(info, name, fields[1])};
  std::vector<std::string> topics{places[0].topic};
  if (places[1].topic != places[0].topic) topics.push_back(places[1].topic);
  const core::Tables tables(log, topics);
  std::array<Signal, 2> out;
  std::array<std::pair<std::size_t, std::size_t>, 2> cells;  // table and column
  for (std::size_t i = 0; i < 2; ++i) {
    out[i].name = fields[i];
    for (std::size_t t = 0; t < tables.list().size(); ++t)
      if (tables.list()[t].topic == places[i].topic) cells[i].first = t;
    const std::vector<core::Column>& columns = tables.list()[cells[i].first].columns;
    const int column = core::index_named(columns, places[i].column);
    if (column < 0)
      throw Error(located(
          name, core::has_no(core::dotted_topic(places[i].topic), "field", places[i].column, columns)));
    cells[i].second = static_cast<std::size_t>(column);
  }
  const auto take = [&, from = from_s, to = to_s](const core::Tables::Row& row) {
    const double t = 1e-9 * static_cast<double>(row.valid_ns);
    if (t < from || t > to) return;
    for (std::size_t i = 0; i < 2; ++i) {
      if (row.table != cells[i].first) continue;
      Series& s = out[i].series;
      const double x = core::number_of_cell((*row.cells)[cells[i].second]);
      if (!std::isfinite(x) || (!s.t_s.empty() && t <= s.t_s.back())) {
        ++out[i].left_out;
        continue;
      }
      s.t_s.push_back(t);
      s.x.push_back(x);
    }
  };
  tables.rows([](std::size_t) { return true; }, take);
  for (Signal& s : out) {
    if (s.series.x.empty()) throw Error(located(name, log_tool_messages::numbers_missing(s.name)));
    take_unit(s);
    if (s.unit == "deg") unwrap(s.series.x);
  }
  return out;
}

std::optional<double> limited_share(const std::filesystem::path& log, double from_s, double to_s) {
  std::vector<std::string> topics;
  for (const core::LogInfo::Topic& t : core::read_info(log).topics)
    if (t.topic.ends_with("/probes")) topics.push_back(t.topic);
  if (topics.empty()) return std::nullopt;
  const core::Tables tables(log, topics);
  std::vector<int> columns;
  for (const core::Table& table : tables.list())
    columns.push_back(core::index_named(table.columns, "limited_ratio"));
  std::vector<double> sums(columns.size()), counts(columns.size());
  tables.rows([&](std::size_t table) { return columns[table] >= 0; },
              [&](const core::Tables::Row& row) {
                const double t = 1e-9 * static_cast<double>(row.valid_ns);
                if (t < from_s || t > to_s) return;
                const double x =
                    core::number_of_cell((*row.cells)[static_cast<std::size_t>(columns[row.table])]);
                if (!std::isfinite(x)) return;
                sums[row.table] += x;
                counts[row.table] += 1;
              });
  std::optional<double> most;
  for (std::size_t i = 0; i < sums.size(); ++i)
    if (counts[i] > 0) most = std::max(most.value_or(0), sums[i] / counts[i]);
  return most;
}

}  // namespace fulmar::response
