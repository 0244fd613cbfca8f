// SPDX-License-Identifier: BSD-3-Clause
// `--record PORTS[@RATE]`: what the command line wants recorded beside what the mission says.
#include <algorithm>
#include <cmath>

#include "core/graph/mission.hpp"
#include "core/graph/quantity.hpp"

namespace fulmar::core {
namespace {

/// "100 Hz" or "all"; throws Error.
std::int64_t period_of(const std::string& rate, const std::string& option) try {
  if (rate == "all") return 0;
  const double hz = quantity_in(rate, "Hz", UnitRule::required);
  if (!(hz >= 1e-3 && hz <= 1e6)) throw Error("a rate is from 0.001 to 1e6 Hz");
  return std::llround(1e9 / hz);
} catch (const Error& fault) {
  throw Error(option + ": " + fault.what() + "; give all, nav.*, or nav.*,outer.attitude@100Hz");
}

}  // namespace

void add_record_options(MissionText& mission, const std::vector<std::string>& options, Report& report) {
  if (options.empty()) return;
  mission.record = true;
  std::vector<RecordRule> rules;
  std::vector<Where> places;
  for (const std::string& text : options) {
    const std::string option = "--record " + text;
    const std::size_t at = text.find('@');
    try {
      const std::int64_t period = at == std::string::npos ? 0 : period_of(text.substr(at + 1), option);
      const std::string ports = text.substr(0, at);
      for (std::size_t from = 0; from <= ports.size();) {
        const std::size_t comma = std::min(ports.find(',', from), ports.size());
        const std::string port = ports.substr(from, comma - from);
        rules.push_back({{port == "all" ? "*" : port}, period});
        places.push_back({option, 0});
        from = comma + 1;
      }
    } catch (const Error& fault) {
      report.add({option, 0}, fault.what());
    }
  }
  if (mission.record_rules.empty())  // the rest stays as it would have been
    rules.push_back({{"*"}, RecordRule::usual}), places.push_back({"--record", 0});
  mission.record_rules.insert(mission.record_rules.begin(), rules.begin(), rules.end());
  mission.record_where.insert(mission.record_where.begin(), places.begin(), places.end());
}

}  // namespace fulmar::core
