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
  std::vector<std::string> words{};    // logs, and fields behind them: a panel per unit
  std::vector<std::string> panels{};   // further panels: fields with commas between them
  std::string over{};                  // field that is x, ".field" of each curve's own port; "": time
  std::string out{}, size{}, names{};  // "x.svg"; "160x90mm"; "old,new"
  std::string labels{};                // of fields: "estimated,true"
  std::optional<double> from_s{}, to_s{};
  bool no_phases = false, no_plan = false;
};

/// What was typed cannot be meant.
struct UsageError : core::Error {
  using Error::Error;
};

/// Whether a word names a log and no field of a running flight.
bool names_a_log(const std::string& word);

/// Draws it and says so; the exit code. Throws core::Error.
int plot_log_command(const LogPlotArguments& words);

/// The figure alone. `notes`: what is to be told beside it.
chart::Figure log_figure(const LogPlotArguments& words, std::vector<std::string>& notes);

/// "160x90mm": width and height. Throws WrongWords.
std::pair<double, double> read_size(const std::string& text);

/// The route that a log has last; empty: none.
std::vector<chart::ChartPoint> route_of(const std::filesystem::path& file, const core::LogInfo& info);

/// A figure as SVG, or as what a program makes of it: PNG, PDF. Throws core::Error.
void write_figure(const std::filesystem::path& out, const std::string& svg);

}  // namespace fulmar::plot
