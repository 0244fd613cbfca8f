// SPDX-License-Identifier: BSD-3-Clause
// Numbers of a log by displayed names: "nav.state.roll_rad", "nav.state.roll_deg", or a probe by its
// component, "attitude_signal.roll_excitation_rad".
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "tools/fulmar_log/export_table.hpp"
#include "tools/fulmar_log/info.hpp"

namespace fulmar::core {

struct LogPlace {
  std::string topic, column;  // "/nav/state", "velocity_mps.down"
};

/// "/nav/state" -> "nav.state"
std::string dotted_topic(std::string topic);

/// Throws Error with the ports of the log. `log`: its name for the message.
LogPlace place_in_log(const LogInfo& info, const std::string& log, const std::string& field);

/// NaN for a cell without a number.
double number_of_cell(const Cell& cell);

/// A number in the form in which it is drawn.
struct LogNumber {
  std::size_t table = 0, column = 0;
  std::string name;         // with degrees for radians: "nav.state.roll_deg"
  std::string words, unit;  // "roll", "deg"; a unit may be ""
  double factor = 1;        // to that unit
  bool angle = false;       // may jump by a turn
  bool held = false;        // a choice, a flag, a count: no interpolation between samples
};

/// Throws Error with the choices: for an unknown field, and for one that is no number.
LogNumber number_in_log(const Tables& tables, const LogPlace& place, const std::string& log);

/// For completion: the ports of a log, each with a dot, and the numbers of a complete port, if they begin
/// with `prefix`. Throws Error.
std::vector<std::string> numbers_beginning(const std::string& log, const std::string& prefix);

}  // namespace fulmar::core
