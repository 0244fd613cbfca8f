// SPDX-License-Identifier: BSD-3-Clause
// Faults of a description, alone or with its files, and reports of skipped rows. The host has checked keys,
// types, units and choices before.
#pragma once
#include <cstdio>

#include "series.hpp"

namespace fulmar::sensor_log {

inline std::string seconds(double s) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g s", s);
  return text;
}
inline std::string seconds_of(std::int64_t ns) { return seconds(1e-9 * static_cast<double>(ns)); }

template <class Log>
bool used(const Log& log) {
  return !log.from.file.view().empty();
}

inline std::string files_of(const Description& d) {
  std::vector<std::string> names;
  const auto add = [&](const auto& log) {
    const std::string name(log.from.file.view());
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  add(d.imu);
  add(d.mag);
  add(d.baro);
  add(d.pitot);
  add(d.gnss);
  return all_of(names);
}

inline void refuse_window(const Window& w, const std::string& key) {
  if (w.to_s <= w.from_s) refuse(key, sensor_log_messages::window_empty(seconds(w.from_s), seconds(w.to_s)));
}

template <class Log>
void refuse_sensor(const Log& log, const std::string& key, bool has_columns) {
  for (std::size_t i = 0; i < log.withhold.size(); ++i)
    refuse_window(log.withhold[i], key + ".withhold[" + std::to_string(i) + "]");
  if (!used(log) && (has_columns || !log.from.time.view().empty()))
    refuse(key + ".from.file", sensor_log_messages::file_not_named(key));
}

inline void refuse_description(const Description& d) {
  const auto said = [](const auto& columns) { return !columns[0].view().empty(); };
  refuse_sensor(d.imu, "log.imu", said(d.imu.rate.columns) || said(d.imu.specific_force.columns));
  refuse_sensor(d.mag, "log.mag", said(d.mag.field.columns));
  refuse_sensor(d.baro, "log.baro", !d.baro.pressure.column.view().empty());
  refuse_sensor(d.pitot, "log.pitot", !d.pitot.pressure.column.view().empty());
  refuse_sensor(d.gnss, "log.gnss", said(d.gnss.position.columns));
  if (files_of(d).empty()) refuse("log", sensor_log_messages::sensors_missing());
  refuse_window(d.use, "log.use");
  refuse_window(d.armed, "log.armed");
  refuse_window(d.airborne, "log.airborne");
}

/// Checks that the times of the files overlap: without overlap their clocks differ.
class Meeting {
 public:
  template <class M>
  void with(const Series<M>& s) {
    if (s.at_ns.empty()) return;
    if (path_.empty()) {
      path_ = s.path;
      first_ns_ = s.at_ns.front();
      last_ns_ = s.at_ns.back();
    }
    if (s.at_ns.front() <= last_ns_ && s.at_ns.back() >= first_ns_) return;
    refuse(s.key + ".from",
           sensor_log_messages::times_apart(s.path, seconds_of(s.at_ns.front()), seconds_of(s.at_ns.back()),
                                            path_, seconds_of(first_ns_), seconds_of(last_ns_)));
  }

 private:
  std::string path_;
  std::int64_t first_ns_ = 0, last_ns_ = 0;
};

/// A file that is cut between two rows looks complete. Its end is checked only against the end of `use`.
template <class M>
void refuse_early_end(const Series<M>& s, const Window& use) {
  if (use.to_s == Window{}.to_s || s.at_ns.back() >= ns_of(use.to_s)) return;
  const std::string place =
      s.line_word == std::string_view("line") ? ":" : std::string(": ") + s.line_word + " ";
  refuse(s.key + ".from.file",
         sensor_log_messages::file_ends_early(s.path + place + std::to_string(s.last_line),
                                              seconds_of(s.at_ns.back()), seconds(use.to_s)));
}

inline std::string cut_words(const std::string& path, std::size_t at, std::int64_t last_ns) {
  return sensor_log_messages::file_cut(path.substr(path.rfind('/') + 1), at, seconds_of(last_ns));
}

template <class M>
std::string words_of(const Series<M>& s) {
  const LeftOut& out = s.left_out;
  std::vector<std::string> reasons;
  const auto add = [&](std::uint64_t n, const char* why) {
    if (n > 0) reasons.push_back(std::to_string(n) + why);
  };
  add(out.not_finite, " not finite");
  add(out.out_of_range, " out of range");
  add(out.out_of_order, " out of order");
  const std::string file = s.path.substr(s.path.rfind('/') + 1);
  const std::string first = s.line_word + (" " + std::to_string(out.first_line));
  if (out.all() == 1) return sensor_log_messages::row_left_out(file, first, all_of(reasons));
  return sensor_log_messages::rows_left_out(file, out.all(), first, all_of(reasons));
}

}  // namespace fulmar::sensor_log
