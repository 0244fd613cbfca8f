// SPDX-License-Identifier: BSD-3-Clause
// Texts of loops and gains.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/fulmar_aero/gains.hpp"
#include "tools/fulmar_aero/gains_file.hpp"

namespace fulmar::aero {

/// A set of gains and its effect on the aircraft.
struct Judged {
  std::vector<LoopFigures> loops;
  int unstable = 0;
  /// One sentence for each margin that is too small; `title` begins it: "anaconda: computed".
  std::vector<std::string> faults(const std::string& title) const;
};
Judged judge(const Plant& plant, const Laws& laws);

/// Bandwidth of the response to the command, of a damper its crossover, rad/s; "-" for a damper without one.
std::string bandwidth_words(const LoopFigures& figures);
std::string loops_text(const std::string& title, const Judged& judged);
nlohmann::json loops_json(const Judged& judged);
/// The section as YAML with the present values of the file.
std::string gains_text(const std::vector<Gain>& gains, const std::vector<Gain>& shipped);

}  // namespace fulmar::aero
