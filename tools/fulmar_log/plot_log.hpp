// SPDX-License-Identifier: BSD-3-Clause
// `fulmar plot LOG FIELD... -o x.svg`: a figure for a paper from logs of flights.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "tools/chart/figure.hpp"
#include "tools/fulmar_log/info.hpp"

namespace fulmar::plot {

struct LogPlotArguments {
  std::vector<std::string> words{};    // logs and fields: a panel per unit
  std::vector<std::string> panels{};   // further panels: fields with commas between them
  std::string over{};                  // field for x, ".field" of each curve's own port; "": time
  std::string out{}, size{}, names{};  // "x.svg"; "160x90mm"; "old,new"
  std::string labels{};                // of fields: "estimated,true"
  std::optional<double> from_s{}, to_s{};
  bool no_phases = false, no_plan = false;
};

/// An invalid command line.
struct UsageError : core::Error {
  using Error::Error;
};

/// True when a word names a log and no field of a running flight.
bool names_a_log(const std::string& word);

/// Draws the figure and reports the file; returns the exit code. Throws core::Error.
int plot_log_command(const LogPlotArguments& words);

/// Only the figure. `notes`: reports for the user.
chart::Figure log_figure(const LogPlotArguments& words, std::vector<std::string>& notes);

/// "160x90mm": width and height. Throws WrongWords.
std::pair<double, double> read_size(const std::string& text);

/// The last route of a log; empty: none.
std::vector<chart::ChartPoint> route_of(const std::filesystem::path& file, const core::LogInfo& info);

/// A figure as SVG, or converted by another program: PNG, PDF. Throws core::Error.
void write_figure(const std::filesystem::path& out, const std::string& svg);

}  // namespace fulmar::plot
