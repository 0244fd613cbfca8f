// SPDX-License-Identifier: BSD-3-Clause
// See diff_command.hpp.
#include "tools/fulmar_log/diff_command.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/app/compare.hpp"
#include "core/error.hpp"
#include "tools/fulmar_log/diff.hpp"
#include "tools/fulmar_log/export_log.hpp"
#include "tools/fulmar_log/figures.hpp"
#include "tools/fulmar_log/messages.hpp"
#include "tools/fulmar_log/terminal.hpp"

namespace fulmar::core {
namespace {

using nlohmann::json;

constexpr Sides sides{"figures", "first", "second"};

/// For a terminal: names and texts of a file may hold any bytes.
std::string table(FigureChanges changes) {
  for (FigureChanges::Change& c : changes.changed) {
    c.name = printable(c.name);
    for (json* const value : {&c.before, &c.after})
      if (value->is_string()) *value = printable(value->get<std::string>());
  }
  return comparison(changes, sides).substr(1);
}

struct Compared {
  LogDiff logs;
  LogFigures a, b;
  FigureChanges figures;
};

json figures_json(const FigureChanges& changes) {
  json all = json::object();
  for (const FigureChanges::Change& c : changes.changed)
    all[c.name] = {{"first", c.before}, {"second", c.after}};
  return all;
}

json diff_json(const Compared& c) {
  const LogDiff& d = c.logs;
  json o{{"equal", d.equal()},
         {"messages_equal", d.messages_equal()},
         {"only_first", d.only_a},
         {"only_second", d.only_b},
         {"metadata", d.metadata},
         {"attachments", d.attachments},
         {"first_difference", nullptr},
         {"first_tick", nullptr},
         {"figures", figures_json(c.figures)}};
  if (d.first)
    o["first_difference"] = {
        {"topic", d.first->topic}, {"component", c.a.owner(d.first->topic, d.first->time_ns)},
        {"field", d.first->field}, {"time_s", seconds(d.first->time_ns)},
        {"first", d.first->a},     {"second", d.first->b}};
  if (d.first_tick)
    o["first_tick"] = {{"tick", d.first_tick->index}, {"time_s", seconds(d.first_tick->time_ns)}};
  o["topics"] = json::object();
  for (const auto& [topic, t] : d.topics)
    o["topics"][topic] = {
        {"equal", t.equal}, {"different", t.different}, {"only_first", t.only_a}, {"only_second", t.only_b}};
  o["fault_first"] = d.fault_a.empty() ? json(nullptr) : json(d.fault_a);
  o["fault_second"] = d.fault_b.empty() ? json(nullptr) : json(d.fault_b);
  return o;
}

void print_first(const Compared& c) {
  const LogDiff& d = c.logs;
  if (d.first) {
    const MessageDiff::First& f = *d.first;
    const std::string a = c.a.owner(f.topic, f.time_ns), b = c.b.owner(f.topic, f.time_ns);
    std::string owner = a.empty() ? "" : ", of " + a;
    if (a != b && !b.empty()) owner += (a.empty() ? ", of " : ", in the second log of ") + b;
    const std::string what = f.field.empty() ? "has" : f.field + " is";
    const std::string text =
        log_tool_messages::first_difference(seconds_text(f.time_ns), printable(owner), printable(f.topic),
                                            printable(what), printable(f.a), printable(f.b))
            .text;
    std::printf("%s\n", text.c_str());
  }
  if (!d.first_tick) return;
  std::printf("The components' outputs differ from tick %llu on, at %s s.\n",
              static_cast<unsigned long long>(d.first_tick->index),
              seconds_text(d.first_tick->time_ns).c_str());
  if (!d.first)
    std::printf(
        "Nothing that both logs hold does: fulmar replay LOG --record all --log FILE records more.\n");
}

void print_diff(const Compared& c) {
  const LogDiff& d = c.logs;
  std::uint64_t messages = 0;
  for (const auto& [topic, t] : d.topics) messages += t.equal;
  if (d.messages_equal())
    std::printf("All %llu messages are equal.\n", static_cast<unsigned long long>(messages));
  else if (!c.figures.changed.empty())
    std::printf("%s\n", table(c.figures).c_str());
  print_first(c);
  for (const auto& [topic, t] : d.topics) {
    if (t.different + t.only_a + t.only_b == 0) continue;
    std::printf("  %-28s %llu equal, %llu different", printable(topic).c_str(),
                static_cast<unsigned long long>(t.equal), static_cast<unsigned long long>(t.different));
    if (t.only_a > 0) std::printf(", %llu only in the first", static_cast<unsigned long long>(t.only_a));
    if (t.only_b > 0) std::printf(", %llu only in the second", static_cast<unsigned long long>(t.only_b));
    std::printf("\n");
  }
  for (const std::string& topic : d.only_a)
    std::printf("  %s is only in the first log\n", printable(topic).c_str());
  for (const std::string& topic : d.only_b)
    std::printf("  %s is only in the second log\n", printable(topic).c_str());
  for (const std::string& m : d.metadata) std::printf("  metadata: %s\n", printable(m).c_str());
  for (const std::string& a : d.attachments) std::printf("  attachment: %s\n", printable(a).c_str());
  if (!d.fault_a.empty()) std::printf("  the first log is cut off: %s\n", printable(d.fault_a).c_str());
  if (!d.fault_b.empty()) std::printf("  the second log is cut off: %s\n", printable(d.fault_b).c_str());
}

/// Compares figures only: at least one of the two is a result of `fulmar run --json`.
int diff_results(const json& a, const json& b, bool as_json) {
  const FigureChanges changes = figure_changes(a, b);
  if (changes.changed.empty() && changes.equal == 0) throw Error(log_tool_messages::common_figure_missing());
  const bool equal = changes.changed.empty();
  if (as_json)
    print_json({{"equal", equal}, {"figures", figures_json(changes)}});
  else
    std::printf("%s", table(changes).c_str());
  return equal ? 0 : 1;
}

}  // namespace

int diff_command(const std::string& a, const std::string& b, bool as_json, bool messages_only) {
  const json result_a = result_file(a), result_b = result_file(b);
  if (!result_a.is_null() || !result_b.is_null())
    return diff_results(result_a.is_null() ? log_figures(a).figures : result_a,
                        result_b.is_null() ? log_figures(b).figures : result_b, as_json);
  Compared c{diff_logs(a, b), {}, {}, {}};
  if (!c.logs.messages_equal()) {
    c.a = log_figures(a);
    c.b = log_figures(b);
    c.figures = figure_changes(c.a.figures, c.b.figures);
  }
  as_json ? print_json(diff_json(c)) : print_diff(c);
  return (messages_only ? c.logs.messages_equal() : c.logs.equal()) ? 0 : 1;
}

}  // namespace fulmar::core
