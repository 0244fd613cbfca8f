// SPDX-License-Identifier: BSD-3-Clause
// See compare_command.hpp. Selects the states, the logs, and the references.
#include "tools/fulmar_log/compare_command.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/types/named.hpp"
#include "core/types/text.hpp"
#include "tools/fulmar_log/compare_text.hpp"
#include "tools/fulmar_log/figures.hpp"
#include "tools/fulmar_log/messages.hpp"
#include "tools/fulmar_log/terminal.hpp"
#include "tools/log_reading/log_file.hpp"

namespace fulmar::states {
namespace {

using core::Error;
namespace fs = std::filesystem;

std::string quoted(const StateLog& log) { return log.file.string(); }

/// "/nav/state" of "/nav/state", "nav.state" and "nav".
std::string topic_named(const StateLog& log, const std::string& name, const std::string& type,
                        const std::vector<std::string>& valid) {
  std::string topic = core::slashed(name);
  if (!topic.starts_with('/')) topic = "/" + topic;
  const auto known = log.types.find(topic);
  if (known != log.types.end() && known->second != type)
    throw Error(
        located(quoted(log), log_tool_messages::topic_type_mismatch(topic, core::printable(known->second),
                                                                    type, core::choices_text("", valid))));
  if (known != log.types.end()) return topic;
  std::vector<std::string> beneath;
  for (const std::string& one : valid)
    if (one.starts_with(topic + "/")) beneath.push_back(one);
  if (beneath.size() == 1) return beneath.front();
  if (beneath.size() > 1)
    throw Error(located(quoted(log), log_tool_messages::topic_ambiguous(name, core::join(beneath))));
  throw Error(
      located(quoted(log), log_tool_messages::topic_unknown(topic, core::choices_text(topic, valid))));
}

/// Topic with a component's reported standard deviations: next to its state or, when that is a role's, under
/// the component's name.
std::string check_of(const StateLog& log, const std::string& topic) {
  const auto beside = [&](const std::string& owner) {
    for (const StateLog::Topic& check : log.checks)
      if (check.name.starts_with("/" + owner + "/")) return check.name;
    return std::string();
  };
  if (log.checks.empty()) return "";
  const std::string found = beside(topic.substr(1, topic.find('/', 1) - 1));
  if (!found.empty()) return found;
  const core::LogFigures flown = core::log_figures(log.file);
  const std::string early = flown.owner(topic, 0), late = flown.owner(topic, std::int64_t{1} << 62);
  return early.empty() || early != late ? "" : beside(early);
}

Side side_of(const StateLog& log, const std::string& topic, const CompareArguments& words) {
  Side side{&log, topic, "", "", ""};
  if (!words.truth.empty())
    side.truth = topic_named(log, words.truth, "VehicleState", log.states());
  else if (words.fixes.empty() && !log.truths.empty())
    side.truth = log.truths.front().name;
  if (!words.fixes.empty())
    side.fixes = topic_named(log, words.fixes, "Gnss", core::names_of(log.fixes));
  else if (side.truth.empty() && !log.fixes.empty()) {
    // a receiver that does not belong to the aircraft is a reference
    const auto own = [](const StateLog::Topic& t) { return t.name.starts_with("/vehicle/"); };
    const auto other = std::find_if_not(log.fixes.begin(), log.fixes.end(), own);
    side.fixes = (other == log.fixes.end() ? log.fixes.front() : *other).name;
  }
  if (!side.truth.empty()) side.check = check_of(log, topic);
  return side;
}

using Topics = std::vector<std::pair<std::string, std::string>>;

/// The topics of one log, or of two.
Topics chosen(const StateLog& a, const StateLog& b, const std::vector<std::string>& names) {
  const bool one_log = &a == &b;
  if (names.size() > 2) throw Error(log_tool_messages::too_many_states(core::join(names)));
  if (names.size() == 2)
    return {{topic_named(a, names[0], "VehicleState", a.states()),
             topic_named(b, names[1], "VehicleState", b.states())}};
  if (!one_log && names.size() == 1)
    return {{topic_named(a, names[0], "VehicleState", a.states()),
             topic_named(b, names[0], "VehicleState", b.states())}};
  Topics both;
  if (!one_log) {
    for (const StateLog::Topic& topic : a.estimates)
      if (core::find_named(b.estimates, topic.name)) both.emplace_back(topic.name, topic.name);
    return both;
  }
  if (names.empty() && a.estimates.size() == 2) return {{a.estimates[0].name, a.estimates[1].name}};
  const std::vector<std::string> valid = a.states();
  if (valid.empty()) throw Error(located(quoted(a), log_tool_messages::states_missing()));
  throw Error(located(quoted(a), log_tool_messages::state_names_required(core::join(valid))));
}

/// "nav" and "second" of "/nav/state" and "/second/state".
std::pair<std::string, std::string> short_names(const Side& a, const Side& b, const std::string& asked) {
  if (const std::size_t comma = asked.find(','); comma != std::string::npos)
    return {asked.substr(0, comma), asked.substr(comma + 1)};
  if (!asked.empty()) throw Error(log_tool_messages::names_count_invalid());
  const auto owner = [](const Side& side) { return side.topic.substr(1, side.topic.find('/', 1) - 1); };
  if (owner(a) == owner(b)) return {"first", "second"};
  return {owner(a), owner(b)};
}

Span span_of(const CompareArguments& words) {
  Span span;
  if (words.from_s) span.from_ns = std::llround(1e9 * *words.from_s);
  if (words.to_s) span.to_ns = std::llround(1e9 * *words.to_s);
  return span;
}

}  // namespace

Side usual_side(const StateLog& log, const std::string& topic) { return side_of(log, topic, {}); }

int compare_command(const CompareArguments& words) {
  std::vector<std::string> names = words.rest;
  const bool two_logs =
      !names.empty() && (fs::exists(names[0]) || names[0].ends_with(".mcap") || names[0].ends_with(".part"));
  StateLog a = look_for_states(words.log), other;
  if (two_logs) {
    core::check_log_file(names[0]);
    other = look_for_states(names[0]);
    names.erase(names.begin());
  }
  const StateLog& b = two_logs ? other : a;
  const Topics topics = chosen(a, b, names);
  nlohmann::json all = nlohmann::json::array();
  const auto nothing = log_tool_messages::common_estimate_missing();
  if (topics.empty() && !words.changed) throw Error(nothing);
  if (topics.empty() && !words.json) std::printf("%s\n", nothing.line().c_str());
  bool some = words.changed;
  for (const auto& [first, second] : topics) {
    Side x = side_of(a, first, words), y = side_of(b, second, words);
    if (x.topic == x.truth || y.topic == y.truth) x.truth = y.truth = x.check = y.check = "";
    const auto [x_name, y_name] = short_names(x, y, words.names);
    const Pair pair{x, y, x_name, y_name, compare(x, y, span_of(words))};
    some = some || pair.made.pairs > 0;
    if (words.changed && pair.made.equal) continue;
    if (words.json)
      all.push_back(json_of(pair));
    else {
      std::printf("%s%s", all.empty() ? "" : "\n", text_of(pair).c_str());
      all.push_back(nullptr);
    }
  }
  if (words.json) core::print_json({{"estimates", all}});
  return some ? 0 : 1;
}

}  // namespace fulmar::states
