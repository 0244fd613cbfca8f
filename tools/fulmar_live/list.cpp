// SPDX-License-Identifier: BSD-3-Clause
// `fulmar list`: components, topics and requests.
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "core/tap/pace.hpp"
#include "tools/fulmar_live/commands.hpp"
#include "tools/fulmar_live/messages.hpp"
#include "tools/fulmar_live/ports.hpp"
#include "tools/fulmar_live/session.hpp"
#include "tools/fulmar_live/table.hpp"

namespace fulmar::core {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

/// Samples per second of real time of every topic, counted for a second.
std::map<std::string, double> measure(Session& session) {
  std::map<std::string, double> counts;
  for (const auto& [topic, channel] : session.channels()) {
    session.subscribe(topic);
    counts[topic] = 0;
  }
  const auto begin = Clock::now(), end = begin + std::chrono::seconds(1);
  for (auto now = begin; now < end; now = Clock::now())
    if (const auto sample = session.next(std::chrono::duration_cast<Session::Milliseconds>(end - now)))
      counts[sample->topic] += 1;
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  for (auto& [topic, count] : counts) count /= seconds;
  return counts;
}

std::string short_type(const std::string& ros_name) { return ros_name.substr(ros_name.rfind('/') + 1); }

std::string rate_text(double hz) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, hz < 10 ? "%.1f Hz" : "%.0f Hz", hz);
  return buffer;
}

/// Empty for a flight in real time.
std::string pace_of(const json& view) {
  const double speed = view.value("speed", 1.0);
  return (view.value("paused", false) ? ", paused" : "") + (speed == 1 ? "" : ", speed " + speed_text(speed));
}

std::string state_of(const json& component) {
  if (component.value("stopped", false)) return remote_messages::stopped_by_guard().line();
  return component.value("active", false) ? "flies" : "waits";
}

void print_component(const json& c, const std::map<std::string, double>& rates, bool with_rates) {
  const std::string role = c.value("role", ""), run = c.value("run", ""), name = c.value("name", "");
  std::printf("\n%s: %s%s%s, %s\n", name.c_str(), c.value("use", "").c_str(),
              role.empty() ? "" : (", fills " + role).c_str(),
              run.empty() || run == "tick" ? "" : (", run: " + run).c_str(), state_of(c).c_str());
  std::vector<std::vector<std::string>> rows;
  for (const json& p : c.value("outputs", json::array())) {
    const std::string topic = p.value("topic", ""), type = p.value("type", "");
    std::string port = port_of(topic);
    if (type.empty() || topic.empty()) port = name + "." + p.value("name", "");
    rows.push_back({port, type.empty() ? "probe" : short_type(type)});
    const auto rate = rates.find(topic);
    if (with_rates) rows.back().push_back(rate == rates.end() ? "-" : rate_text(rate->second));
  }
  for (const json& p : c.value("inputs", json::array())) {
    const std::string port = name + "." + p.value("name", "");
    if (p.value("request", false)) rows.push_back({port, short_type(p.value("type", "")), "request"});
    if (p.value("imported", false)) rows.push_back({port, short_type(p.value("type", "")), "imported"});
  }
  std::fputs(table_text(rows, "  ").c_str(), stdout);
}

}  // namespace

int list_command(const LiveAddress& target, bool rates, bool as_json) {
  Session session(target);
  json view = session.view();
  const std::map<std::string, double> measured = rates ? measure(session) : std::map<std::string, double>();
  if (as_json) {
    if (rates) view["rates_hz"] = measured;
    std::printf("%s\n", view.dump().c_str());
    return 0;
  }
  const Fixed time_s{static_cast<double>(view.value("now_ns", std::int64_t{0})) * 1e-9, 1};
  const std::string state = std::string(view.value("armed", false) ? "armed" : "not armed") +
                            (view.value("over", false) ? ", over" : "") + pace_of(view);
  std::printf("%s\n", remote_messages::flight_state(view.value("mission", ""), view.value("io", ""),
                                                    view.value("phase", ""), time_s, state)
                          .text.c_str());
  std::vector<std::string> phases = view.value("phases", std::vector<std::string>());
  std::printf("phases: %s\n", join(phases).c_str());
  for (const json& c : view.value("components", json::array())) print_component(c, measured, rates);
  return 0;
}

}  // namespace fulmar::core
