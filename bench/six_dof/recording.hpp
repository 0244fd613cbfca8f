// SPDX-License-Identifier: BSD-3-Clause
// What one of NASA's simulators recorded of a check case (NASA/TM-2015-218675): the columns that are
// compared, in metres, degrees and seconds, at every tenth of a second.
#pragma once
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "messages.hpp"

namespace fulmar::six_dof {

/// A fault of the files: a message with file and line if known.
struct Fault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline constexpr double foot = 0.3048, knot = 1852.0 / 3600, sample_s = 0.1;
inline constexpr int samples = 301;  ///< 30 s

enum Column : std::size_t {
  altitude,
  lat,
  lon,
  v_north,
  v_east,
  v_down,
  roll,
  pitch,
  yaw,
  p,
  q,
  r,
  airspeed,
  columns
};

struct ColumnSpec {
  const char* name;
  double unit;
  bool must_be;  ///< some simulators have three degrees of freedom, or no airspeed
};
inline constexpr std::array<ColumnSpec, columns> column_specs{{{"altitudeMsl_ft", foot, true},
                                                               {"latitude_deg", 1, true},
                                                               {"longitude_deg", 1, true},
                                                               {"feVelocity_ft_s_X", foot, true},
                                                               {"feVelocity_ft_s_Y", foot, true},
                                                               {"feVelocity_ft_s_Z", foot, true},
                                                               {"eulerAngle_deg_Roll", 1, false},
                                                               {"eulerAngle_deg_Pitch", 1, false},
                                                               {"eulerAngle_deg_Yaw", 1, false},
                                                               {"bodyAngularRateWrtEi_deg_s_Roll", 1, false},
                                                               {"bodyAngularRateWrtEi_deg_s_Pitch", 1, false},
                                                               {"bodyAngularRateWrtEi_deg_s_Yaw", 1, false},
                                                               {"trueAirspeed_nmi_h", knot, false}}};

struct Recording {
  int simulator = 0;
  std::array<std::vector<double>, columns> of;  ///< empty: not recorded by this simulator

  bool has(Column c) const { return !of[c].empty(); }
  bool has_attitude() const { return has(roll) && has(pitch) && has(yaw); }
};

namespace detail {

inline std::vector<std::string_view> cells(std::string_view line) {
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  std::vector<std::string_view> out;
  for (std::size_t begin = 0;;) {
    const std::size_t end = line.find(',', begin);
    out.push_back(line.substr(begin, end - begin));
    if (end == std::string_view::npos) return out;
    begin = end + 1;
  }
}

inline double number(std::string_view cell, const std::string& where) {
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value))
    throw Fault(where + six_dof_messages::number_expected(cell).text);
  return value;
}

}  // namespace detail

class RecordingFile {
 public:
  explicit RecordingFile(const std::filesystem::path& file) : name_(file.string()), in_(file) {
    if (!in_) throw Fault(six_dof_messages::file_not_readable(name_));
  }

  Recording read() {
    std::string line;
    if (!next(line)) throw fault(six_dof_messages::file_empty());
    read_header(line);
    while (next(line)) add(line);
    if (static_cast<int>(taken_) != samples) throw fault(six_dof_messages::recording_short(time_));
    return std::move(recording_);
  }

 private:
  bool next(std::string& line) {
    ++line_;
    return static_cast<bool>(std::getline(in_, line));
  }
  std::string where() const { return name_ + ":" + std::to_string(line_) + ": "; }
  Fault fault(const Diagnostic& message) const { return Fault(where() + message.text); }

  void read_header(const std::string& line) {
    const auto names = detail::cells(line);
    width_ = names.size();
    if (names.front() != "time") throw fault(six_dof_messages::first_column_not_time());
    for (std::size_t c = 0; c < columns; ++c) {
      const auto found = std::find(names.begin(), names.end(), column_specs[c].name);
      if (found != names.end())
        place_[c] = static_cast<std::size_t>(found - names.begin());
      else if (column_specs[c].must_be)
        throw fault(six_dof_messages::column_missing(column_specs[c].name));
    }
  }

  /// Keeps the rows at tenths of a second: some simulators have more.
  void add(const std::string& line) {
    const auto row = detail::cells(line);
    if (row.size() != width_) throw fault(six_dof_messages::cell_count_mismatch(row.size(), width_));
    const double time = detail::number(row.front(), where());
    if (time < time_) throw fault(six_dof_messages::time_backwards());
    time_ = time;
    std::array<double, columns> values{};
    for (std::size_t c = 0; c < columns; ++c)
      if (place_[c]) values[c] = column_specs[c].unit * detail::number(row[*place_[c]], where());
    const double due = static_cast<double>(taken_) * sample_s;
    if (time > due + 1e-4 && taken_ < samples) throw fault(six_dof_messages::row_missing(due));
    if (std::abs(time - due) > 1e-4 || taken_ == samples) return;
    ++taken_;
    for (std::size_t c = 0; c < columns; ++c)
      if (place_[c]) recording_.of[c].push_back(values[c]);
  }

  std::string name_;
  std::ifstream in_;
  std::size_t line_ = 0, width_ = 0, taken_ = 0;
  double time_ = 0;
  std::array<std::optional<std::size_t>, columns> place_;
  Recording recording_;
};

/// All recordings of a case, by number of the simulator.
inline std::vector<Recording> recordings(const std::filesystem::path& folder, const std::string& number) {
  namespace fs = std::filesystem;
  std::error_code none;
  if (!fs::is_directory(folder, none)) throw Fault(six_dof_messages::check_cases_missing(folder.string()));
  std::vector<fs::path> files;
  const std::string begin = "Atmos_" + number + "_";
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string().starts_with(begin))
      for (const auto& file : fs::directory_iterator(entry.path()))
        if (file.path().extension() == ".csv") files.push_back(file.path());
  if (files.size() < 3) throw Fault(six_dof_messages::recordings_missing(folder.string(), number));
  std::sort(files.begin(), files.end());
  std::vector<Recording> all;
  for (const fs::path& file : files) {
    all.push_back(RecordingFile(file).read());
    all.back().simulator = file.stem().string().back() - '0';
  }
  return all;
}

}  // namespace fulmar::six_dof
