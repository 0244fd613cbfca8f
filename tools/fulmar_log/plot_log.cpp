// SPDX-License-Identifier: BSD-3-Clause
// See plot_log.hpp.
#include "tools/fulmar_log/plot_log.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <tuple>

#include "core/error.hpp"
#include "core/log/events.hpp"
#include "core/types/named.hpp"
#include "tools/chart/numbers.hpp"
#include "tools/fulmar_log/log_field.hpp"
#include "tools/fulmar_log/messages.hpp"
#include "tools/fulmar_log/terminal.hpp"
#include "tools/log_reading/log_file.hpp"

namespace fulmar::plot {
namespace {

using chart::ChartPoint;
using core::Error;
namespace fs = std::filesystem;

constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t seen_ns = 100'000'000;  // tolerance at the begin of a phase

/// A field in one log.
struct Samples {
  core::LogNumber number;
  std::vector<double> t_s, value;  // by time of validity
};

struct OpenLog {
  std::string file, name;  // as given; in the legend
  core::LogInfo info;
  std::vector<Samples> fields;  // the requested ones in their order
  std::vector<Samples> over;    // x of each of them; of all; or none, for time
  const Samples* x_of(std::size_t field) const {
    return over.empty() ? nullptr : &over[std::min(field, over.size() - 1)];
  }
};

struct Asked {
  std::vector<std::string> logs, fields;         // each field once
  std::vector<std::string> labels;               // of --labels: one for each field, or none
  std::vector<std::vector<std::size_t>> panels;  // of --panel: indices into `fields`
  std::size_t in_order = 0;                      // the first ones, which go to panels by their unit
};

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

std::size_t place_of_field(std::vector<std::string>& fields, const std::string& field) {
  const auto found = std::find(fields.begin(), fields.end(), field);
  if (found != fields.end()) return static_cast<std::size_t>(found - fields.begin());
  fields.push_back(field);
  return fields.size() - 1;
}

Asked read_words(const LogPlotArguments& words) {
  Asked asked;
  for (const std::string& word : words.words) {
    if (names_a_log(word) && asked.fields.empty())
      asked.logs.push_back(word);
    else if (names_a_log(word))
      throw UsageError(log_tool_messages::log_after_fields(word));
    else
      place_of_field(asked.fields, word);
  }
  asked.in_order = asked.fields.size();
  for (const std::string& panel : words.panels) {
    asked.panels.emplace_back();
    for (const std::string& field : split(panel))
      asked.panels.back().push_back(place_of_field(asked.fields, field));
  }
  if (asked.fields.empty()) throw UsageError(log_tool_messages::fields_missing(asked.logs.at(0)));
  if (words.labels.empty()) return asked;
  asked.labels = split(words.labels);
  if (asked.labels.size() != asked.fields.size())
    throw UsageError(log_tool_messages::label_count_mismatch(asked.fields.size(), asked.labels.size()));
  return asked;
}

// ---- what logs say

std::vector<std::string> log_names(const Asked& asked, const std::string& given) {
  std::vector<std::string> names;
  if (!given.empty()) {
    names = split(given);
    if (names.size() != asked.logs.size())
      throw UsageError(log_tool_messages::name_count_mismatch(asked.logs.size(), names.size()));
    return names;
  }
  for (const std::string& log : asked.logs) {
    fs::path file(log);
    if (file.extension() == ".part") file = file.stem();
    names.push_back(file.stem().string());
  }
  for (std::size_t i = 0; i < names.size(); ++i)
    if (std::count(names.begin(), names.end(), names[i]) > 1) return asked.logs;
  return names;
}

/// Sorts late samples by time; equal times keep their order.
void sort_by_time(Samples& s) {
  if (std::is_sorted(s.t_s.begin(), s.t_s.end())) return;
  std::vector<std::size_t> order(s.t_s.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return s.t_s[a] < s.t_s[b]; });
  Samples sorted{s.number, {}, {}};
  for (const std::size_t i : order) {
    sorted.t_s.push_back(s.t_s[i]);
    sorted.value.push_back(s.value[i]);
  }
  s = std::move(sorted);
}

struct Interval {
  double from_s, to_s;
};

std::string no_number_words(const OpenLog& log, const Interval& time) {
  const auto seconds_words = [](std::int64_t ns) {
    return chart::fixed(1e-9 * static_cast<double>(ns), 1) + " s";
  };
  if (std::isinf(time.from_s) && std::isinf(time.to_s))
    return log_tool_messages::field_without_numbers().line();
  return log_tool_messages::interval_without_numbers(seconds_words(log.info.begin_ns),
                                                     seconds_words(log.info.end_ns))
      .line();
}

/// In a log that was cut off a missing port may have been in the lost part.
core::LogPlace place_of(const OpenLog& log, const std::string& field) try {
  return core::place_in_log(log.info, log.file, field);
} catch (const Error& e) {
  const std::string& fault = log.info.file.fault;
  throw Error(fault.empty() ? e.diagnostic : log_tool_messages::log_cut_off(e.diagnostic, fault));
}

/// Places of the fields, then of x: one for each, or one for all.
std::vector<core::LogPlace> places_in(const OpenLog& log, const Asked& asked, const std::string& over) {
  std::vector<core::LogPlace> places;
  for (const std::string& field : asked.fields) places.push_back(place_of(log, field));
  if (over.starts_with('.'))
    for (std::size_t i = 0; i < asked.fields.size(); ++i) places.push_back({places[i].topic, over.substr(1)});
  else if (!over.empty())
    places.push_back(place_of(log, over));
  return places;
}

OpenLog read_log(const std::string& file, const std::string& name, const Asked& asked,
                 const std::string& over, const Interval& time) {
  core::check_log_file(file);
  OpenLog log{file, name, core::read_info(file), {}, {}};
  std::vector<std::string> topics;
  const std::vector<core::LogPlace> places = places_in(log, asked, over);
  for (const core::LogPlace& place : places)
    if (std::find(topics.begin(), topics.end(), place.topic) == topics.end()) topics.push_back(place.topic);
  const core::Tables tables(file, topics);
  std::vector<Samples> all;
  for (const core::LogPlace& place : places)
    all.push_back({core::number_in_log(tables, place, file), {}, {}});
  tables.rows([](std::size_t) { return true; },
              [&](const core::Tables::Row& row) {
                const double t = 1e-9 * static_cast<double>(row.valid_ns);
                if (t < time.from_s || t > time.to_s) return;
                for (Samples& s : all) {
                  if (row.table != s.number.table) continue;
                  s.t_s.push_back(t);
                  s.value.push_back(s.number.factor * core::number_of_cell((*row.cells)[s.number.column]));
                }
              });
  for (Samples& s : all) {
    sort_by_time(s);
    if (std::none_of(s.value.begin(), s.value.end(), [](double x) { return std::isfinite(x); }))
      throw Error(
          located(file, log_tool_messages::number_missing(s.number.name, no_number_words(log, time))));
  }
  const auto behind = all.begin() + static_cast<std::ptrdiff_t>(asked.fields.size());
  log.over.assign(behind, all.end());
  all.erase(behind, all.end());
  log.fields = std::move(all);
  return log;
}

/// A value interpolated between the samples of x, at the time of a sample of y.
double value_at_time(const Samples& x, double t_s) {
  const auto after = std::lower_bound(x.t_s.begin(), x.t_s.end(), t_s);
  const auto i = static_cast<std::size_t>(after - x.t_s.begin());
  if (after == x.t_s.end()) return nowhere;
  if (*after == t_s) return x.value[i];
  if (i == 0) return nowhere;
  if (x.number.held || (x.number.angle && std::abs(x.value[i] - x.value[i - 1]) > 180)) return x.value[i - 1];
  return x.value[i - 1] + (x.value[i] - x.value[i - 1]) * (t_s - x.t_s[i - 1]) / (x.t_s[i] - x.t_s[i - 1]);
}

/// A curve is split where an angle jumps by a turn.
std::vector<ChartPoint> points_of(const Samples& y, const Samples* over) {
  std::vector<ChartPoint> points;
  const bool rows = over && over->number.table == y.number.table;
  for (std::size_t i = 0; i < y.value.size(); ++i) {
    const double x = !over ? y.t_s[i] : rows ? over->value[i] : value_at_time(*over, y.t_s[i]);
    const ChartPoint next{x, y.value[i]};
    const bool jumps =
        !points.empty() && ((y.number.angle && std::abs(next.y - points.back().y) > 180) ||
                            (over && over->number.angle && std::abs(next.x - points.back().x) > 180));
    if (jumps) points.push_back({nowhere, nowhere});
    points.push_back(next);
  }
  return points;
}

/// A ratio has no unit.
std::string with_unit(const std::string& words, const std::string& unit) {
  return unit.empty() || unit == "1" ? words : words + (words.empty() ? "[" : " [") + unit + "]";
}

class FigureMaker {
 public:
  FigureMaker(const Asked& asked, const std::vector<OpenLog>& logs, std::vector<std::string>& notes)
      : asked_(asked), logs_(logs), over_(!logs[0].over.empty()), notes_(notes) {}

  void add_panel(const std::vector<std::size_t>& fields) {
    chart::FigurePanel panel;
    const core::LogNumber& first = logs_[0].fields[fields[0]].number;
    bool one_unit = true, one_word = true;
    for (const std::size_t f : fields)
      for (const OpenLog& log : logs_) {
        one_unit = one_unit && log.fields[f].number.unit == first.unit;
        one_word = one_word && log.fields[f].number.words == first.words;
      }
    if (one_unit) panel.y = with_unit(one_word ? first.words : "", first.unit);
    for (const std::size_t f : fields)
      for (const OpenLog& log : logs_) {
        const Samples& s = log.fields[f];
        std::string name = asked_.labels.empty() ? s.number.name : asked_.labels[f];
        if (logs_.size() > 1) name = fields.size() > 1 ? log.name + ": " + name : log.name;
        if (!one_unit) name = with_unit(name, s.number.unit);
        panel.curves.push_back({name, points_of(s, log.x_of(f)), s.number.held && !over_});
      }
    if (panel.curves.size() > chart::max_curves)
      throw Error(log_tool_messages::too_many_curves(panel.curves.size(), chart::max_curves));
    figure.panels.push_back(std::move(panel));
  }

  void set_x() {
    figure.track = over_;
    figure.x = "time [s]";
    if (!over_) return;
    const core::LogNumber& x = logs_[0].over[0].number;
    figure.x = with_unit(x.words, x.unit);
    const auto in_metres = [](const Samples& s) { return s.number.unit == "m"; };
    figure.even = figure.panels.size() == 1 &&
                  std::all_of(logs_[0].over.begin(), logs_[0].over.end(), in_metres) &&
                  std::all_of(logs_[0].fields.begin(), logs_[0].fields.end(), in_metres);
  }

  /// For a track over the ground: the plan of the first log.
  void add_plan() {
    const bool ground =
        figure.even && figure.x == "position east [m]" && figure.panels[0].y == "position north [m]";
    const auto route = ground ? route_of(logs_[0].file, logs_[0].info) : std::vector<ChartPoint>{};
    if (!route.empty()) figure.panels[0].curves.push_back({"plan", route, false, true});
  }

  /// Limits the requested interval to the flight.
  void show(const Interval& time) {
    chart::AxisRange flights;
    for (const OpenLog& log : logs_)
      for (const std::int64_t ns : {log.info.begin_ns, log.info.end_ns}) flights.take(1e-9 * double(ns));
    for (const double end_s : {time.from_s, time.to_s})
      if (end_s >= flights.min && end_s <= flights.max) figure.shown.take(end_s);
  }

  /// Phases of the first log.
  void set_phases() {
    for (const core::LogInfo::Phase& p : logs_[0].info.phases)
      figure.bands.push_back({p.name, 1e-9 * double(p.begin_ns), 1e-9 * double(p.end_ns)});
    for (const OpenLog& log : logs_)
      if (!same_phases(log.info.phases, logs_[0].info.phases))
        return notes_.push_back(log_tool_messages::phases_differ(logs_[0].file, log.file));
  }

  chart::Figure figure;

 private:
  static bool same_phases(const std::vector<core::LogInfo::Phase>& a,
                          const std::vector<core::LogInfo::Phase>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
      return x.name == y.name && std::abs(x.begin_ns - y.begin_ns) <= seen_ns;
    });
  }
  const Asked& asked_;
  const std::vector<OpenLog>& logs_;
  bool over_;
  std::vector<std::string>& notes_;
};

/// A log may hold any bytes, but a figure is UTF-8.
void clean_texts(chart::Figure& figure) {
  const auto clean = [](std::string& text) { core::make_printable(text.data()); };
  clean(figure.title);
  clean(figure.x);
  for (chart::FigureBand& band : figure.bands) clean(band.name);
  for (chart::FigurePanel& panel : figure.panels) {
    clean(panel.y);
    for (chart::FigureCurve& curve : panel.curves) clean(curve.name);
  }
}

/// Panels by unit, in the order in which the units come.
std::vector<std::vector<std::size_t>> by_unit(const OpenLog& log, std::size_t count) {
  std::vector<std::vector<std::size_t>> panels;
  for (std::size_t f = 0; f < count; ++f) {
    const auto same = [&](const std::vector<std::size_t>& panel) {
      return log.fields[panel[0]].number.unit == log.fields[f].number.unit;
    };
    const auto found = std::find_if(panels.begin(), panels.end(), same);
    if (found == panels.end())
      panels.push_back({f});
    else
      found->push_back(f);
  }
  return panels;
}

}  // namespace

bool names_a_log(const std::string& word) {
  std::error_code none;
  return word.ends_with(".mcap") || word.ends_with(".mcap.part") || fs::exists(word, none);
}

chart::Figure log_figure(const LogPlotArguments& words, std::vector<std::string>& notes) {
  const Asked asked = read_words(words);
  constexpr double all = std::numeric_limits<double>::infinity();
  const Interval time{words.from_s.value_or(-all), words.to_s.value_or(all)};
  if (time.from_s >= time.to_s)
    throw UsageError(
        log_tool_messages::time_range_invalid(chart::figures(time.from_s, 9), chart::figures(time.to_s, 9)));
  const std::vector<std::string> names = log_names(asked, words.names);
  std::vector<OpenLog> logs;
  for (std::size_t i = 0; i < asked.logs.size(); ++i) {
    logs.push_back(read_log(asked.logs[i], names[i], asked, words.over, time));
    if (!logs.back().info.file.fault.empty())
      notes.push_back(log_tool_messages::log_incomplete(asked.logs[i], logs.back().info.file.fault));
  }
  FigureMaker maker(asked, logs, notes);
  for (const auto& panel : by_unit(logs[0], asked.in_order)) maker.add_panel(panel);
  for (const auto& panel : asked.panels) maker.add_panel(panel);
  maker.set_x();
  if (!words.no_plan) maker.add_plan();
  if (words.over.empty()) maker.show(time);
  if (words.over.empty() && !words.no_phases) maker.set_phases();
  chart::Figure& figure = maker.figure;
  for (const std::string& name : names) figure.title += (figure.title.empty() ? "" : ", ") + name;
  clean_texts(figure);
  figure.high_mm = 40 + 50 * static_cast<double>(figure.panels.size());
  if (figure.even) chart::fit_even(figure);
  if (!words.size.empty()) std::tie(figure.wide_mm, figure.high_mm) = read_size(words.size);
  if (const std::string why = chart::too_small(figure); !why.empty())
    throw UsageError(log_tool_messages::size_too_small(chart::figures(figure.wide_mm, 6),
                                                       chart::figures(figure.high_mm, 6), why));
  return std::move(maker.figure);
}

int plot_log_command(const LogPlotArguments& words) {
  const auto no_out = log_tool_messages::output_missing();
  if (words.out.empty()) throw UsageError(no_out);
  std::error_code none;
  for (const std::string& log : words.words)
    if (fs::equivalent(words.out, log, none))
      throw Error(log_tool_messages::output_is_log(words.out, no_out));
  std::vector<std::string> notes;
  const chart::Figure figure = log_figure(words, notes);
  write_figure(words.out, chart::figure_svg(figure));
  std::size_t curves = 0;
  for (const chart::FigurePanel& panel : figure.panels) curves += panel.curves.size();
  const auto counted = [](std::size_t n, const char* what) {
    return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
  };
  std::printf("%s: %s in %s, %g x %g mm\n", core::printable(words.out).c_str(),
              counted(curves, "curve").c_str(), counted(figure.panels.size(), "panel").c_str(),
              figure.wide_mm, figure.high_mm);
  for (const std::string& note : notes) std::fprintf(stderr, "%s\n", core::printable(note).c_str());
  return 0;
}

}  // namespace fulmar::plot
