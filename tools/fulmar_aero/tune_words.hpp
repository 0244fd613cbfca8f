// SPDX-License-Identifier: BSD-3-Clause
// Loops and gains in words.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/fulmar_aero/gains.hpp"
#include "tools/fulmar_aero/gains_file.hpp"

namespace fulmar::aero {

/// A set of gains and what it does to the aircraft.
struct Judged {
  std::vector<LoopFigures> loops;
  int unstable = 0;
  /// One sentence for each thing that is too little; `title` begins it: "anaconda: computed".
  std::vector<std::string> faults(const std::string& title) const;
};
Judged judge(const Plant& plant, const Laws& laws);

/// Of the answer to the command, of a damper its crossover, rad/s; "-" where a damper has none.
std::string bandwidth_words(const LoopFigures& figures);
std::string loops_text(const std::string& title, const Judged& judged);
nlohmann::json loops_json(const Judged& judged);
/// The section as YAML, what the file has beside it.
std::string gains_text(const std::vector<Gain>& gains, const std::vector<Gain>& shipped);

}  // namespace fulmar::aero
